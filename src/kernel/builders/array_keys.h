/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The keys of an array's primitives, or of clusters, a vector at a time; how a structure finds its cells is a
 * parameter. */
#ifndef ARRAY_KEYS_H
#define ARRAY_KEYS_H

#include <math.h>

#include "dispatch/kernel.h"
#include "kernel/primitive/gather_primitives.h"

/* The keys of a vector of middles and sizes in the structure's space; of those that are not valid, `skipped`. */
typedef vuint find_keys_fn(const void *space, uint32_t skipped, const vfloat middle[3], vfloat size, vmask valid);

/* Spheres i to i + count - 1. */
CGT_SPU_INLINE vuint sphere_keys(const cgt_primitive_array *a, uint32_t i, uint32_t count, find_keys_fn *find,
                                 const void *space, uint32_t skipped)
{
    const vfloat infinity = spux_vfloat(INFINITY);
    vfloat d[4];
    load_spheres(a, i, count, d);
    vmask valid = spu_and(spux_cmpge(d[3], spux_vfloat(0)), spux_mask_first(count));
    for (int k = 0; k < 4; k++)
        valid = spu_and(valid, spu_cmpgt(infinity, spux_abs(d[k])));
    return find(space, skipped, d, d[3], valid);
}

/* Primitives number i to i + count - 1 of those whose middles are known. */
CGT_SPU_INLINE vuint boxed_keys(const cgt_cell_keys *keys, uint32_t i, uint32_t count, find_keys_fn *find,
                                const void *space)
{
    const vmask present = spux_mask_first(count);
    vfloat d[4];
    for (int k = 0; k < 4; k++) {
        const float *from = keys->middle + (size_t)k * keys->boxed + i;
        d[k] = count == CGT_LANES ? spux_load_unaligned(from) : spux_load_mask(from, present);
    }
    return find(space, keys->skipped, d, d[3], spu_and(spux_cmpge(d[3], spux_vfloat(0)), present));
}

/* As cgt_prim_keys_fn. */
CGT_SPU_INLINE void array_keys(const cgt_cell_keys *keys, const cgt_primitive_array *array, uint32_t first,
                               uint32_t end, find_keys_fn *find, const void *space, uint32_t *key)
{
    const bool spheres = array->kind == CGT_KIND_SPHERES;
    for (uint32_t prim = first; prim < end;) {
        const uint32_t remaining = end - prim, count = remaining < CGT_LANES ? remaining : CGT_LANES;
        const vuint k = spheres ? sphere_keys(array, prim - array->first, count, find, space, keys->skipped)
                                : boxed_keys(keys, cgt_array_boxed_number(array, prim), count, find, space);
        store_keys(key + (prim - first), k, count);
        prim += count;
    }
}

/* As cgt_cluster_keys_fn. */
CGT_SPU_INLINE void cluster_keys(const cgt_cell_keys *keys, const cgt_cluster *cluster, uint32_t count,
                                 find_keys_fn *find, const void *space, uint32_t *key)
{
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vfloat d[8];
        load_clusters(cluster + k, count - k, d);
        const vmask valid = spu_and(spux_cmpge(d[7], spux_vfloat(0)), spux_mask_first(count - k));
        store_keys(key + k, find(space, keys->skipped, d, d[7], valid), count - k);
    }
}

#endif
