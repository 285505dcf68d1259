/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which cell of the wide tree's parts each object lies in. Whatever rounding does to a middle, the cell is one of the
 * part's, and boxes are those of objects, not of cells. */
#include "kernel/build_bvh/bvh_cells.h"

#include <math.h>

typedef struct part_list {
    const cgt_wide_part *part;
    uint32_t parts;
} part_list;

CGT_SPU_INLINE vuint keys_of(const part_list *l, uint32_t skipped, const vfloat middle[3], vfloat size, vmask valid)
{
    vuint key = spux_vuint(skipped);
    vmask left = valid;
    if (l->parts == 1)
        return spux_select(key, spu_add(wide_cells_of(&l->part->curve, middle), spux_vuint(l->part->first)), valid);
    for (uint32_t k = 0; k < l->parts && spux_any(left); k++) {
        const cgt_wide_part *part = &l->part[k];
        const vmask in = spu_and(left, spux_cmpge(size, spux_vfloat(part->least)));
        if (!spux_any(in))
            continue;
        key = spux_select(key, spu_add(wide_cells_of(&part->curve, middle), spux_vuint(part->first)), in);
        left = spu_andc(left, in);
    }
    return key;
}

/* Spheres i to i + count - 1. */
CGT_SPU_INLINE vuint sphere_keys(const part_list *l, uint32_t skipped, const cgt_object_array *a, uint32_t i,
                                 uint32_t count)
{
    const vfloat infinity = spux_vfloat(INFINITY);
    vfloat d[4];
    fetch_spheres(a, i, count, d);
    vmask valid = spux_cmpge(d[3], spux_vfloat(0));
    for (int k = 0; k < 4; k++)
        valid = spu_and(valid, spu_cmpgt(infinity, spux_abs(d[k])));
    return keys_of(l, skipped, d, d[3], valid);
}

CGT_SPU_INLINE vuint triangle_keys(const part_list *l, const cgt_wide_keys *job, uint32_t number, uint32_t count)
{
    const vmask there = spux_mask_first(count);
    vfloat d[4];
    for (int k = 0; k < 4; k++) {
        const float *from = job->middle + (size_t)k * job->triangles + number;
        d[k] = count == CGT_LANES ? spux_load_unaligned(from) : spux_load_mask(from, there);
    }
    return keys_of(l, job->skipped, d, d[3], spux_cmpge(d[3], spux_vfloat(0)));
}

void CGT_KERNEL(cgt_wide_tree_keys)(const cgt_wide_keys *job, const cgt_object_array *array, uint32_t first,
                                    uint32_t end, uint32_t *key)
{
    const cgt_wide_plan *p = job->plan;
    const bool spheres = array->kind == CGT_KIND_SPHERES;
    const part_list l = {spheres ? p->part : p->part + p->parts[0], p->parts[array->kind]};
    for (uint32_t done = 0; done < end - first;) {
        const uint32_t object = first + done, left = end - object, count = left < CGT_LANES ? left : CGT_LANES;
        const vuint k = spheres ? sphere_keys(&l, job->skipped, array, object - array->first, count)
                                : triangle_keys(&l, job, cgt_array_triangle_number(array, object), count);
        store_keys(key + done, k, count);
        done += count;
    }
}

void CGT_KERNEL(cgt_wide_tree_cluster_keys)(const cgt_wide_keys *job, const cgt_cluster *cluster, uint32_t count,
                                            uint32_t *key)
{
    const part_list l = {job->plan->part + job->plan->parts[0], job->plan->parts[1]};
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vfloat d[8];
        fetch_clusters(cluster + k, count - k, d);
        store_keys(key + k, keys_of(&l, job->skipped, d, d[7], spux_cmpge(d[7], spux_vfloat(0))), count - k);
    }
}
