/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Loads vectors of primitives from the caller's arrays, at any stride. load_*: consecutive ones; gather_*: by numbers.
 * Records of three numbers are read as four if another record follows, since its bytes are the caller's, too. Near the
 * end of an array they are read one by one. */
#ifndef CGT_GATHER_PRIMITIVES_H
#define CGT_GATHER_PRIMITIVES_H

#include "model/triangle_cluster.h"
#include "dispatch/kernel.h"
#include "vector.h"

/* Spheres i to i + count - 1: x, y, z, radius; 0 in the lanes beyond. */
CGT_SPU_INLINE void load_spheres(const cgt_primitive_array *a, uint32_t i, uint32_t count, vfloat d[4])
{
    const bool inside = count == CGT_LANES && a->count - i > CGT_LANES;
    const bool records = a->radius == a->point + 3 * sizeof(float) && a->radius_stride == a->point_stride;
    if (inside && (records || a->radius_stride == sizeof(float) || !a->radius_stride)) {
        const float *radius = (const float *)(const void *)(a->radius + (size_t)i * a->radius_stride);
        spux_load_records4(cgt_array_point(a, i), a->point_stride / sizeof(float), d);
        if (!records)
            d[3] = a->radius_stride ? spux_load_unaligned(radius) : spux_vfloat(*radius);
        return;
    }
    _Alignas(CGT_VECTOR_BYTES) float row[4][CGT_LANES] = {{0}};
    for (uint32_t k = 0; k < count; k++) {
        const cgt_sphere q = cgt_array_sphere(a, i + k);
        row[0][k] = q.x;
        row[1][k] = q.y;
        row[2][k] = q.z;
        row[3][k] = q.r;
    }
    for (int k = 0; k < 4; k++)
        d[k] = spux_load(row[k]);
}

/* Numbers times a stride: with vector operations for the usual strides. */
CGT_SPU_INLINE void compute_offsets(vuint number, uint32_t stride, uint32_t offset[CGT_LANES])
{
    if (stride == 4) {
        spux_store_uint(offset, spu_sl(number, 2));
        return;
    }
    if (stride == 3) {
        spux_store_uint(offset, spu_add(number, spu_sl(number, 1)));
        return;
    }
    spux_store_uint(offset, number);
    for (int k = 0; k < CGT_LANES; k++)
        offset[k] *= stride;
}

/* Spheres of one array; lane by lane if offsets exceed 32 bits, or if one is the last record. */
CGT_SPU_INLINE void gather_spheres(const cgt_primitive_array *a, vuint number, vfloat d[4])
{
    const bool records = a->radius == a->point + 3 * sizeof(float) && a->radius_stride == a->point_stride;
    const bool fit = (uint64_t)a->count * (a->point_stride / sizeof(float)) <= UINT32_MAX;
    _Alignas(CGT_VECTOR_BYTES) uint32_t offset[CGT_LANES];
    _Alignas(CGT_VECTOR_BYTES) float row[4][CGT_LANES];
    if (fit && (records || spux_all(spu_cmpgt(spux_vuint(a->count - 1), number)))) {
        compute_offsets(number, (uint32_t)(a->point_stride / sizeof(float)), offset);
        spux_load_records4_at(cgt_array_point(a, 0), offset, d);
        if (records)
            return;
        spux_store_uint(offset, number);
        for (int k = 0; k < CGT_LANES; k++)
            row[3][k] = *(const float *)(const void *)(a->radius + (size_t)offset[k] * a->radius_stride);
        d[3] = spux_load(row[3]);
        return;
    }
    spux_store_uint(offset, number);
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        const cgt_sphere q = cgt_array_sphere(a, offset[k]);
        row[0][k] = q.x;
        row[1][k] = q.y;
        row[2][k] = q.z;
        row[3][k] = q.r;
    }
    for (int k = 0; k < 4; k++)
        d[k] = spux_load(row[k]);
}

/* The vertex numbers of triangles i to i + count - 1; 0 in the lanes beyond. */
CGT_SPU_INLINE void load_corners(const cgt_primitive_array *a, uint32_t i, uint32_t count, vuint corner[3])
{
    if (a->index && count == CGT_LANES && a->count - i > CGT_LANES) {
        vfloat d[4];
        spux_load_records4((const float *)(const void *)(a->index + (size_t)i * a->index_stride),
                           a->index_stride / sizeof(uint32_t), d);
        for (int k = 0; k < 3; k++)
            corner[k] = (vuint)d[k];
        return;
    }
    _Alignas(CGT_VECTOR_BYTES) uint32_t row[3][CGT_LANES] = {{0}};
    for (uint32_t k = 0; k < count; k++) {
        uint32_t c[3];
        cgt_array_corners(a, i + k, c);
        for (int j = 0; j < 3; j++)
            row[j][k] = c[j];
    }
    for (int j = 0; j < 3; j++)
        corner[j] = spux_load_uint(row[j]);
}

/* The vertex numbers of triangles of one array; lane by lane if offsets exceed 32 bits, or if one is the last
 * record. */
CGT_SPU_INLINE void gather_corners(const cgt_primitive_array *a, vuint number, vuint corner[3])
{
    const bool fit = (uint64_t)a->count * (a->index_stride / sizeof(uint32_t)) <= UINT32_MAX;
    _Alignas(CGT_VECTOR_BYTES) uint32_t offset[CGT_LANES], row[3][CGT_LANES];
    if (!a->index) {
        for (uint32_t k = 0; k < 3; k++)
            corner[k] = spu_add(spu_add(number, spu_sl(number, 1)), spux_vuint(k));
        return;
    }
    if (fit && spux_all(spu_cmpgt(spux_vuint(a->count - 1), number))) {
        vfloat d[4];
        compute_offsets(number, (uint32_t)(a->index_stride / sizeof(uint32_t)), offset);
        spux_load_records4_at((const float *)(const void *)a->index, offset, d);
        for (int k = 0; k < 3; k++)
            corner[k] = (vuint)d[k];
        return;
    }
    spux_store_uint(offset, number);
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        uint32_t c[3];
        cgt_array_corners(a, offset[k], c);
        for (int j = 0; j < 3; j++)
            row[j][k] = c[j];
    }
    for (int j = 0; j < 3; j++)
        corner[j] = spux_load_uint(row[j]);
}

/* Whether offsets of vertices, in floats, fit into 32 bits. */
CGT_SPU_INLINE bool vertices_fit_offsets(const cgt_primitive_array *a)
{
    return (uint64_t)a->points * (a->point_stride / sizeof(float)) <= UINT32_MAX;
}

/* Vertices by their numbers, which are in range. before_last: none is the last one, and offsets fit into 32 bits. */
CGT_SPU_INLINE void gather_vertices(const cgt_primitive_array *a, vuint corner, bool before_last, vfloat v[3])
{
    _Alignas(CGT_VECTOR_BYTES) uint32_t offset[CGT_LANES];
    if (before_last) {
        vfloat d[4];
        compute_offsets(corner, (uint32_t)(a->point_stride / sizeof(float)), offset);
        spux_load_records4_at((const float *)(const void *)a->point, offset, d);
        for (int k = 0; k < 3; k++)
            v[k] = d[k];
        return;
    }
    _Alignas(CGT_VECTOR_BYTES) float row[3][CGT_LANES];
    spux_store_uint(offset, corner);
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        const float *p = cgt_array_point(a, offset[k]);
        for (int j = 0; j < 3; j++)
            row[j][k] = p[j];
    }
    for (int j = 0; j < 3; j++)
        v[j] = spux_load(row[j]);
}

/* Triangles of one array. */
CGT_SPU_INLINE void gather_triangles(const cgt_primitive_array *a, vuint number, vfloat vertex[3][3])
{
    const bool fit = vertices_fit_offsets(a);
    vuint corner[3];
    gather_corners(a, number, corner);
    for (int k = 0; k < 3; k++)
        gather_vertices(a, corner[k], fit && spux_all(spu_cmpgt(spux_vuint(a->points - 1), corner[k])), vertex[k]);
}

/* Prefetches the vertices of triangles whose indices are in the cache. */
CGT_SPU_INLINE void prefetch_triangles(const cgt_primitive_array *a, const uint32_t *reference, uint32_t count)
{
    for (uint32_t k = 0; k < count; k++) {
        const char *index = a->index + (size_t)reference[k] * a->index_stride;
        uint32_t corner[3];
        memcpy(corner, index, sizeof corner);
        for (int i = 0; i < 3; i++)
            __builtin_prefetch(a->point + corner[i] * a->point_stride);
    }
}

/* ---- any primitives of a scene ---- */

/* The first lanes, as bits. */
CGT_SPU_INLINE unsigned first_lanes(uint32_t count) { return count < CGT_LANES ? (1u << count) - 1 : CGT_ALL_LANES; }

/* Loads references; lanes beyond count repeat the first one. */
CGT_SPU_INLINE vuint load_references(const uint32_t *reference, uint32_t count)
{
    if (count >= CGT_LANES)
        return spux_load_unaligned_uint(reference);
    _Alignas(CGT_VECTOR_BYTES) uint32_t padded[CGT_LANES];
    for (uint32_t k = 0; k < CGT_LANES; k++)
        padded[k] = reference[k < count ? k : 0];
    return spux_load_uint(padded);
}

/* Spheres of any arrays: x, y, z, radius; one by one where they lie in several. */
CGT_SPU_INLINE void gather_scene_spheres(const cgt_primitives *prims, vuint prim, vfloat sphere[4])
{
    if (prims->arrays == 1) { /* its first primitive is 0 */
        gather_spheres(prims->array, prim, sphere);
        return;
    }
    _Alignas(CGT_VECTOR_BYTES) uint32_t number[CGT_LANES];
    _Alignas(CGT_VECTOR_BYTES) float row[4][CGT_LANES];
    spux_store_uint(number, prim);
    const cgt_primitive_array *a = cgt_primitives_array(prims, number[0]);
    const vuint own = spu_sub(prim, spux_vuint(a->first));
    if (spux_all(spu_cmpgt(spux_vuint(a->count), own))) {
        gather_spheres(a, own, sphere);
        return;
    }
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        const cgt_sphere q = cgt_primitives_sphere(prims, number[k]);
        row[0][k] = q.x;
        row[1][k] = q.y;
        row[2][k] = q.z;
        row[3][k] = q.r;
    }
    for (int i = 0; i < 4; i++)
        sphere[i] = spux_load(row[i]);
}

/* Triangles of any arrays; one by one where they lie in several. */
CGT_SPU_INLINE void gather_scene_triangles(const cgt_primitives *prims, const uint32_t prim[CGT_LANES],
                                           vfloat vertex[3][3])
{
    const cgt_primitive_array *a = prims->arrays == 1 ? prims->array : cgt_primitives_array(prims, prim[0]);
    const vuint number = spu_sub(spux_load_uint(prim), spux_vuint(a->first));
    if (prims->arrays == 1 || spux_all(spu_cmpgt(spux_vuint(a->count), number))) {
        gather_triangles(a, number, vertex);
        return;
    }
    _Alignas(CGT_VECTOR_BYTES) float row[3][3][CGT_LANES];
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        const cgt_triangle q = cgt_primitives_triangle(prims, prim[k]);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                row[i][j][k] = q.v[i][j];
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            vertex[i][j] = spux_load(row[i][j]);
}

CGT_SPU_INLINE void capsule_to_lane(cgt_capsule q, float row[7][CGT_LANES], uint32_t k)
{
    for (int i = 0; i < 3; i++) {
        row[i][k] = q.p[i];
        row[3 + i][k] = q.q[i];
    }
    row[6][k] = q.r;
}

/* Capsules of any arrays, one by one: the numbers of cgt_capsule. Lanes beyond count repeat the first one. */
CGT_SPU_INLINE void gather_scene_capsules(const cgt_primitives *prims, const uint32_t *prim, uint32_t count,
                                          vfloat capsule[7])
{
    _Alignas(CGT_VECTOR_BYTES) float row[7][CGT_LANES];
    const cgt_primitive_array *a = prims->array;
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        const uint32_t number = prim[k < count ? k : 0];
        if (number - a->first >= a->count)
            a = cgt_primitives_array(prims, number);
        capsule_to_lane(cgt_array_capsule(a, number - a->first), row, k);
    }
    for (int i = 0; i < 7; i++)
        capsule[i] = spux_load(row[i]);
}

/* ---- clusters ---- */

/* A vector of clusters, as they lie in memory: middle, valid, half, size. */
CGT_SPU_INLINE void gather_clusters(const cgt_cluster *cluster, const uint32_t number[CGT_LANES], vfloat d[8])
{
    uint32_t offset[CGT_LANES];
    for (uint32_t k = 0; k < CGT_LANES; k++)
        offset[k] = number[k] * (uint32_t)(sizeof *cluster / sizeof(float));
    spux_load_records8_at(cluster->middle, offset, d);
}

/* The first `count` clusters; lanes beyond repeat the last one. */
CGT_SPU_INLINE void load_clusters(const cgt_cluster *cluster, uint32_t count, vfloat d[8])
{
    uint32_t number[CGT_LANES];
    for (uint32_t k = 0; k < CGT_LANES; k++)
        number[k] = k < count ? k : count - 1;
    gather_clusters(cluster, number, d);
}

/* Clusters of references; lanes beyond count repeat the first one. */
CGT_SPU_INLINE void gather_cluster_list(const cgt_cluster *cluster, const uint32_t *reference, uint32_t count,
                                        vfloat d[8])
{
    uint32_t number[CGT_LANES];
    for (uint32_t k = 0; k < CGT_LANES; k++)
        number[k] = reference[k < count ? k : 0];
    gather_clusters(cluster, number, d);
}

/* ---- keys ---- */

/* Stores the keys of the first `count` lanes. */
CGT_SPU_INLINE void store_keys(uint32_t *to, vuint key, uint32_t count)
{
    if (count >= CGT_LANES)
        spux_store_unaligned_uint(to, key);
    else
        spux_store_mask_uint(to, key, spux_mask_first(count));
}

#endif
