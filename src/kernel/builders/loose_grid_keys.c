/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which cell of the loose grid each object, or each cluster of them, lies in.
 *
 * Along an axis of n cells, with m an object's middle, G = (m - low) / cell in exact arithmetic and u = 2^-24: the
 * difference, the reciprocal of the cell and the product are rounded once each, so the computed g is within 3.1 u G of
 * G, and 2^-149 where the product underflows. The planner makes 0 <= G <= n hold for every middle (size_levels.c),
 * so g is within 4 u n of it, and not below 0. The cell is i = the integer part of g, or n - 1. So
 *     i - 4 u n <= G <= i + 1 + 4 u n,
 * and an object, which lies within its half extent of its middle, lies within that plus 4 u n cells of cell i: that is
 * `reach`. Sums and products of cell numbers are integers below 2^24: exact in float. */
#include "dispatch/kernel.h"

#include <math.h>

#include "kernel/primitive/gather_primitives.h"

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

CGT_SPU_INLINE vuint find_keys(const cgt_loose_keys_job *job, const vfloat middle[3], vfloat size, vmask valid)
{
    const cgt_loose_grid *g = job->grid;
    vuint key = spux_vuint(job->skipped);
    vmask remaining = valid;
    if (g->levels == 1)
        return spux_select(key, find_cells(&g->level[0], middle), valid);
    for (uint32_t k = 0; k < g->levels && spux_any(remaining); k++) {
        const vmask in = spu_and(remaining, spux_cmpge(size, spux_vfloat(g->level[k].least)));
        if (!spux_any(in))
            continue;
        key = spux_select(key, find_cells(&g->level[k], middle), in);
        remaining = spu_andc(remaining, in);
    }
    return key;
}

/* Spheres i to i + count - 1. */
CGT_SPU_INLINE vuint sphere_keys(const cgt_loose_keys_job *job, const cgt_primitive_array *a, uint32_t i,
                                 uint32_t count)
{
    const vfloat infinity = spux_vfloat(INFINITY);
    vfloat d[4];
    load_spheres(a, i, count, d);
    vmask valid = spux_cmpge(d[3], spux_vfloat(0));
    for (int k = 0; k < 4; k++)
        valid = spu_and(valid, spu_cmpgt(infinity, spux_abs(d[k])));
    return find_keys(job, d, d[3], valid);
}

CGT_SPU_INLINE vuint triangle_keys(const cgt_loose_keys_job *job, uint32_t number, uint32_t count)
{
    const vmask present = spux_mask_first(count);
    vfloat d[4];
    for (int k = 0; k < 4; k++) {
        const float *from = job->middle + (size_t)k * job->triangles + number;
        d[k] = count == CGT_LANES ? spux_load_unaligned(from) : spux_load_mask(from, present);
    }
    return find_keys(job, d, d[3], spux_cmpge(d[3], spux_vfloat(0)));
}

void CGT_KERNEL(cgt_loose_grid_compute_keys)(const cgt_loose_keys_job *job, const cgt_primitive_array *array,
                                             uint32_t first, uint32_t end, uint32_t *key)
{
    const bool spheres = array->kind == CGT_KIND_SPHERES;
    for (uint32_t count_done = 0; count_done < end - first;) {
        const uint32_t prim = first + count_done, remaining = end - prim,
                       count = remaining < CGT_LANES ? remaining : CGT_LANES;
        const vuint k = spheres ? sphere_keys(job, array, prim - array->first, count)
                                : triangle_keys(job, cgt_array_triangle_number(array, prim), count);
        store_keys(key + count_done, k, count);
        count_done += count;
    }
}

void CGT_KERNEL(cgt_loose_grid_cluster_keys)(const cgt_loose_keys_job *job, const cgt_cluster *cluster, uint32_t count,
                                             uint32_t *key)
{
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vfloat d[8];
        load_clusters(cluster + k, count - k, d);
        store_keys(key + k, find_keys(job, d, d[7], spux_cmpge(d[7], spux_vfloat(0))), count - k);
    }
}
