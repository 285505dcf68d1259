/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which cell of the loose grid each primitive, or each cluster, lies in.
 *
 * Along an axis of n cells, with m a primitive's middle, G = (m - low) / cell in exact arithmetic and u = 2^-24: the
 * difference, the reciprocal of the cell and the product are rounded once each, so the computed g is within 3.1 u G of
 * G, and 2^-149 where the product underflows. The plan (size_levels.c) guarantees 0 <= G <= n for every middle,
 * so g is within 4 u n of it, and not below 0. The cell is i = the integer part of g, or n - 1. So
 *     i - 4 u n <= G <= i + 1 + 4 u n,
 * and a primitive, which lies within its half extent of its middle, lies within that plus 4 u n cells of cell i: that
 * is `reach`. Sums and products of cell numbers are integers below 2^24: exact in float.
 *
 * Measuring assigns levels by the same rule, before their cells are laid out. */
#include "kernel/builders/array_keys.h"
#include "kernel/builders/size_gather.h"

/* Cells of a vector of middles, in a level. */
CGT_SPU_INLINE vuint find_cells(const cgt_loose_level *level, const vfloat middle[3])
{
    vfloat i[3];
    for (int a = 0; a < 3; a++) {
        const vfloat g = spu_mul(spu_sub(middle[a], spux_vfloat(level->low[a])), spux_vfloat(level->rcell[a]));
        const vfloat clamped = spux_min(spux_max(g, spux_vfloat(0)), spux_vfloat((float)(level->size[a] - 1)));
        i[a] = spu_convtf(spu_convts(clamped, 0), 0);
    }
    const vfloat row = spux_vfloat((float)level->size[0]);
    const vfloat plane = spux_vfloat((float)(level->size[0] * level->size[1]));
    const vfloat cell = spu_madd(i[2], plane, spu_madd(i[1], row, i[0]));
    return spu_add((vuint)spu_convts(cell, 0), spux_vuint(level->first));
}

/* Which middles lie in a level's region. */
CGT_SPU_INLINE vmask find_region(const cgt_loose_level *level, const vfloat middle[3])
{
    vmask in = spux_mask_all();
    for (int a = 0; a < 3; a++) {
        in = spu_and(in, spux_cmpge(middle[a], spux_vfloat(level->region_low[a])));
        in = spu_and(in, spux_cmpge(spux_vfloat(level->region_high[a]), middle[a]));
    }
    return in;
}

/* Those of `remaining` that belong to level k, where no level before takes them. */
CGT_SPU_INLINE vmask find_level(const cgt_loose_grid *g, uint32_t k, const vfloat middle[3], vfloat size,
                                vmask remaining)
{
    const vmask in = spu_and(remaining, spux_cmpge(size, spux_vfloat(g->level[k].least)));
    return g->level[k].has_region ? spu_and(in, find_region(&g->level[k], middle)) : in;
}

/* A find_keys_fn; space: cgt_loose_grid. */
CGT_SPU_INLINE vuint find_keys(const void *space, uint32_t skipped, const vfloat middle[3], vfloat size, vmask valid)
{
    const cgt_loose_grid *g = space;
    vuint key = spux_vuint(skipped);
    vmask remaining = valid;
    if (g->levels == 1)
        return spux_select(key, find_cells(&g->level[0], middle), valid);
    for (uint32_t k = 0; k < g->levels && spux_any(remaining); k++) {
        const vmask in = find_level(g, k, middle, size, remaining);
        if (!spux_any(in))
            continue;
        key = spux_select(key, find_cells(&g->level[k], middle), in);
        remaining = spu_andc(remaining, in);
    }
    return key;
}

void CGT_KERNEL(cgt_loose_grid_keys)(const cgt_cell_keys *keys, const cgt_primitive_array *array, uint32_t first,
                                     uint32_t end, uint32_t *key)
{
    array_keys(keys, array, first, end, find_keys, keys->plan, key);
}

void CGT_KERNEL(cgt_loose_grid_cluster_keys)(const cgt_cell_keys *keys, const cgt_cluster *cluster, uint32_t count,
                                             uint32_t *key)
{
    cluster_keys(keys, cluster, count, find_keys, keys->plan, key);
}

/* ---- measuring ---- */

typedef struct level_gather {
    const cgt_loose_grid *grid;
    size_gather *sizes; /* of levels, in place of classes */
} level_gather;

/* A find_keys_fn that adds to a level_gather; space: that. Its keys are not used. */
CGT_SPU_INLINE vuint gather_levels(const void *space, uint32_t skipped, const vfloat middle[3], vfloat size,
                                   vmask valid)
{
    const level_gather *g = space;
    const vfloat half = spux_abs(size); /* -0 is a radius too */
    vmask remaining = valid;
    for (uint32_t k = 0; k < g->grid->levels && spux_any(remaining); k++) {
        const vmask in = find_level(g->grid, k, middle, size, remaining);
        if (!spux_any(in))
            continue;
        remaining = spu_andc(remaining, in);
        size_gather_open_class(g->sizes, k);
        size_gather_class(g->sizes, k, middle, &half, 1, in);
    }
    return spux_vuint(skipped);
}

void CGT_KERNEL(cgt_loose_grid_measure)(const cgt_cell_keys *keys, const cgt_primitive_array *array, uint32_t first,
                                        uint32_t end, uint32_t *key, cgt_size_classes *levels, cgt_scratch *scratch)
{
    size_gather *sizes = cgt_scratch_take(scratch, sizeof *sizes);
    const level_gather g = {keys->plan, sizes};
    size_gather_clear(sizes);
    array_keys(keys, array, first, end, gather_levels, &g, key);
    size_gather_store(sizes, 1, levels);
    cgt_scratch_return(scratch, sizes);
}

void CGT_KERNEL(cgt_loose_grid_measure_clusters)(const cgt_cell_keys *keys, const cgt_cluster *cluster, uint32_t count,
                                                 uint32_t *key, cgt_size_classes *levels, cgt_scratch *scratch)
{
    size_gather *sizes = cgt_scratch_take(scratch, sizeof *sizes);
    const level_gather g = {keys->plan, sizes};
    size_gather_clear(sizes);
    cluster_keys(keys, cluster, count, gather_levels, &g, key);
    size_gather_store(sizes, 1, levels);
    cgt_scratch_return(scratch, sizes);
}
