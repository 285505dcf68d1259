/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which cell of the BVH's parts each primitive lies in. Whatever rounding does to a middle, the cell is one of the
 * part's; boxes are those of primitives, not of cells. */
#include "dispatch/bvh_builder.h"
#include "kernel/builders/array_keys.h"
#include "kernel/builders/bvh/morton_cells.h"

typedef struct part_list {
    const cgt_bvh_part *part;
    uint32_t parts;
} part_list;

static part_list parts_of(const cgt_bvh_plan *p, cgt_kind kind)
{
    return (part_list){p->part + p->first[kind], p->first[kind + 1] - p->first[kind]};
}

/* A find_keys_fn; space: part_list. */
CGT_SPU_INLINE vuint find_keys(const void *space, uint32_t skipped, const vfloat middle[3], vfloat size, vmask valid)
{
    const part_list *l = space;
    vuint key = spux_vuint(skipped);
    vmask remaining = valid;
    if (l->parts == 1)
        return spux_select(key, spu_add(morton_cells(&l->part->curve, middle), spux_vuint(l->part->first)), valid);
    for (uint32_t k = 0; k < l->parts && spux_any(remaining); k++) {
        const cgt_bvh_part *part = &l->part[k];
        const vmask in = spu_and(remaining, spux_cmpge(size, spux_vfloat(part->least)));
        if (!spux_any(in))
            continue;
        key = spux_select(key, spu_add(morton_cells(&part->curve, middle), spux_vuint(part->first)), in);
        remaining = spu_andc(remaining, in);
    }
    return key;
}

void CGT_KERNEL(cgt_bvh_keys)(const cgt_cell_keys *keys, const cgt_primitive_array *array, uint32_t first, uint32_t end,
                              uint32_t *key)
{
    const part_list parts = parts_of(keys->plan, array->kind);
    array_keys(keys, array, first, end, find_keys, &parts, key);
}

void CGT_KERNEL(cgt_bvh_cluster_keys)(const cgt_cell_keys *keys, const cgt_cluster *cluster, uint32_t count,
                                      uint32_t *key)
{
    const part_list parts = parts_of(keys->plan, CGT_KIND_TRIANGLES);
    cluster_keys(keys, cluster, count, find_keys, &parts, key);
}
