/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A run of primitives of one kind, at most a vector of them; lanes beyond its end repeat the last one. */
#ifndef CGT_BVH_FETCH_H
#define CGT_BVH_FETCH_H

#include "kernel/primitive/gather_primitives.h"

/* A run, and the array that holds all of it, or NULL. */
typedef struct prim_run {
    const cgt_primitives *prims;
    const cgt_primitive_array *array;
    vuint prim;
} prim_run;

CGT_SPU_INLINE prim_run prim_run_load(const cgt_primitives *prims, const uint32_t *prim, uint32_t count)
{
    prim_run r = {.prims = prims, .array = prims->array};
    r.prim = spux_load_mask_uint(prim, spux_mask_first(count));
    if (count < CGT_LANES)
        r.prim = spux_select(spux_vuint(prim[count - 1]), r.prim, spux_mask_first(count));
    if (prims->arrays > 1) {
        const uint32_t last = spux_hmax(r.prim);
        r.array = cgt_primitives_array(prims, spux_hmin(r.prim));
        if (last - r.array->first >= r.array->count)
            r.array = NULL;
    }
    return r;
}

/* Primitives are scattered over their arrays: they are prefetched this far ahead, and triangles' indices twice as far;
 * those of another array are not. */
#define PREFETCH_DISTANCE 32u

CGT_SPU_INLINE void prefetch_points(const cgt_primitive_array *a, const uint32_t *prim, uint32_t count)
{
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t number = prim[k] - a->first;
        uint32_t point[3];
        if (number >= a->count)
            continue;
        const uint32_t points = cgt_array_points(a, number, point);
        for (uint32_t j = 0; j < points; j++)
            __builtin_prefetch(cgt_array_point(a, point[j]));
    }
}

CGT_SPU_INLINE void prefetch_indices(const cgt_primitive_array *a, const uint32_t *prim, uint32_t count)
{
    for (uint32_t k = 0; a->index && k < count; k++)
        if (prim[k] - a->first < a->count)
            __builtin_prefetch(a->index + (size_t)(prim[k] - a->first) * a->index_stride);
}

/* After primitives i to i + count - 1 of a list were fetched: prefetches as many later ones. */
CGT_SPU_INLINE void prefetch_run(const prim_run *r, const uint32_t *prim, uint32_t i, uint32_t count, uint32_t end)
{
    if (!r->array || end - i < 2 * PREFETCH_DISTANCE + count)
        return;
    if (r->array->kind != CGT_KIND_SPHERES)
        prefetch_indices(r->array, prim + i + 2 * PREFETCH_DISTANCE, count);
    prefetch_points(r->array, prim + i + PREFETCH_DISTANCE, count);
}

/* x, y, z, radius. */
CGT_SPU_INLINE void prim_run_gather_spheres(const prim_run *r, vfloat d[4])
{
    _Alignas(CGT_VECTOR_BYTES) uint32_t number[CGT_LANES];
    _Alignas(CGT_VECTOR_BYTES) float row[4][CGT_LANES];
    if (r->array) {
        gather_spheres(r->array, spu_sub(r->prim, spux_vuint(r->array->first)), d);
        return;
    }
    spux_store_uint(number, r->prim);
    for (int k = 0; k < CGT_LANES; k++) {
        const cgt_sphere q = cgt_primitives_sphere(r->prims, number[k]);
        row[0][k] = q.x;
        row[1][k] = q.y;
        row[2][k] = q.z;
        row[3][k] = q.r;
    }
    for (int k = 0; k < 4; k++)
        d[k] = spux_load(row[k]);
}

CGT_SPU_INLINE void prim_run_gather_triangles(const prim_run *r, vfloat vertex[3][3])
{
    _Alignas(CGT_VECTOR_BYTES) uint32_t number[CGT_LANES];
    _Alignas(CGT_VECTOR_BYTES) float row[3][3][CGT_LANES];
    if (r->array) {
        gather_triangles(r->array, spu_sub(r->prim, spux_vuint(r->array->first)), vertex);
        return;
    }
    spux_store_uint(number, r->prim);
    for (int k = 0; k < CGT_LANES; k++) {
        const cgt_triangle q = cgt_primitives_triangle(r->prims, number[k]);
        for (int v = 0; v < 3; v++)
            for (int a = 0; a < 3; a++)
                row[v][a][k] = q.v[v][a];
    }
    for (int v = 0; v < 3; v++)
        for (int a = 0; a < 3; a++)
            vertex[v][a] = spux_load(row[v][a]);
}

/* The numbers of cgt_capsule. */
CGT_SPU_INLINE void prim_run_gather_capsules(const prim_run *r, vfloat capsule[7])
{
    _Alignas(CGT_VECTOR_BYTES) uint32_t number[CGT_LANES];
    spux_store_uint(number, r->prim);
    gather_scene_capsules(r->prims, number, CGT_LANES, capsule);
}

/* Middles of bounds. */
CGT_SPU_INLINE void prim_run_centroids(const prim_run *r, cgt_kind kind, vfloat middle[3])
{
    const vfloat half = spux_vfloat(0.5f);
    if (kind == CGT_KIND_SPHERES) {
        vfloat d[4];
        prim_run_gather_spheres(r, d);
        for (int a = 0; a < 3; a++)
            middle[a] = d[a];
        return;
    }
    if (kind == CGT_KIND_CAPSULES) {
        vfloat d[7];
        prim_run_gather_capsules(r, d);
        for (int a = 0; a < 3; a++)
            middle[a] = spu_add(spu_mul(d[a], half), spu_mul(d[3 + a], half));
        return;
    }
    vfloat v[3][3];
    prim_run_gather_triangles(r, v);
    for (int a = 0; a < 3; a++) {
        const vfloat low = spux_min(v[0][a], spux_min(v[1][a], v[2][a]));
        const vfloat high = spux_max(v[0][a], spux_max(v[1][a], v[2][a]));
        middle[a] = spu_add(spu_mul(low, half), spu_mul(high, half));
    }
}

#endif
