/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which cell of the wide tree's parts each object lies in. Whatever rounding does to a middle, the cell is one of the
 * part's, and boxes are those of objects, not of cells. */
#include "kernel/builders/bvh/bvh_cells.h"

#include <math.h>

typedef struct part_list {
    const cgt_bvh_part *part;
    uint32_t parts;
} part_list;

CGT_SPU_INLINE vuint find_keys(const part_list *l, uint32_t skipped, const vfloat middle[3], vfloat size, vmask valid)
{
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

/* Spheres i to i + count - 1. */
CGT_SPU_INLINE vuint sphere_keys(const part_list *l, uint32_t skipped, const cgt_primitive_array *a, uint32_t i,
                                 uint32_t count)
{
    const vfloat infinity = spux_vfloat(INFINITY);
    vfloat d[4];
    load_spheres(a, i, count, d);
    vmask valid = spux_cmpge(d[3], spux_vfloat(0));
    for (int k = 0; k < 4; k++)
        valid = spu_and(valid, spu_cmpgt(infinity, spux_abs(d[k])));
    return find_keys(l, skipped, d, d[3], valid);
}

CGT_SPU_INLINE vuint triangle_keys(const part_list *l, const cgt_bvh_keys_job *job, uint32_t number, uint32_t count)
{
    const vmask present = spux_mask_first(count);
    vfloat d[4];
    for (int k = 0; k < 4; k++) {
        const float *from = job->middle + (size_t)k * job->triangles + number;
        d[k] = count == CGT_LANES ? spux_load_unaligned(from) : spux_load_mask(from, present);
    }
    return find_keys(l, job->skipped, d, d[3], spux_cmpge(d[3], spux_vfloat(0)));
}

void CGT_KERNEL(cgt_bvh_compute_keys)(const cgt_bvh_keys_job *job, const cgt_primitive_array *array, uint32_t first,
                                      uint32_t end, uint32_t *key)
{
    const cgt_bvh_plan *p = job->plan;
    const bool spheres = array->kind == CGT_KIND_SPHERES;
    const part_list l = {spheres ? p->part : p->part + p->parts[0], p->parts[array->kind]};
    for (uint32_t count_done = 0; count_done < end - first;) {
        const uint32_t prim = first + count_done, remaining = end - prim,
                       count = remaining < CGT_LANES ? remaining : CGT_LANES;
        const vuint k = spheres ? sphere_keys(&l, job->skipped, array, prim - array->first, count)
                                : triangle_keys(&l, job, cgt_array_triangle_number(array, prim), count);
        store_keys(key + count_done, k, count);
        count_done += count;
    }
}

void CGT_KERNEL(cgt_bvh_compute_cluster_keys)(const cgt_bvh_keys_job *job, const cgt_cluster *cluster, uint32_t count,
                                              uint32_t *key)
{
    const part_list l = {job->plan->part + job->plan->parts[0], job->plan->parts[1]};
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vfloat d[8];
        load_clusters(cluster + k, count - k, d);
        store_keys(key + k, find_keys(&l, job->skipped, d, d[7], spux_cmpge(d[7], spux_vfloat(0))), count - k);
    }
}
