/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The boxes of clusters, gathered from vectors of triangles: one triangle of each of a vector of clusters, which needs
 * no exchange between lanes; or, where an array ends inside a cluster, triangles in ascending order. */
#ifndef CGT_CLUSTER_BOUNDS_H
#define CGT_CLUSTER_BOUNDS_H

#include <math.h>

#include "kernel/primitive/gather_primitives.h"
#include "kernel/builders/size_gather.h"

/* ---- vertices of a vector of clusters ---- */

CGT_SPU_INLINE const uint32_t *cluster_corners(const cgt_primitive_array *a, uint32_t i)
{
    return (const uint32_t *)(const void *)a->index + 3 * (size_t)i;
}

/* Whether gather_cluster_corners may fetch these: a vector of whole clusters, whose indices lie side by side and are in
 * range. The last vertex is not one of them, since another one follows. */
static bool clusters_fit_gather(const cgt_primitive_array *a, uint32_t i, uint32_t count)
{
    vuint largest = spux_vuint(0);
    if (count < CGT_LANES * CGT_CLUSTER)
        return false;
    if (!a->index)
        return 3 * (i + (uint64_t)count) < a->points;
    if (!a->points || a->index_stride != 3 * sizeof(uint32_t))
        return false;
    const uint32_t *index = cluster_corners(a, i);
    for (size_t k = 0; k < 3 * CGT_CLUSTER; k++)
        largest = spux_max(largest, spux_load_unaligned_uint(index + k * CGT_LANES));
    return spux_all(spu_cmpgt(spux_vuint(a->points - 1), largest));
}

/* Corner k of triangles i, i + CGT_CLUSTER and so on. Indices become addresses without passing through vectors. */
CGT_SPU_INLINE void gather_cluster_corners(const cgt_primitive_array *a, uint32_t i, uint32_t k, vfloat v[3])
{
    const float *point = cgt_array_point(a, 0);
    const size_t stride = a->point_stride / sizeof(float), step = 3 * CGT_CLUSTER;
    vfloat d[4];
    if (!a->index)
        spux_load_records4(point + (3 * (size_t)i + k) * stride, step * stride, d);
    else if (stride == 3)
        spux_load_records4_by(point, 3, cluster_corners(a, i) + k, step, d);
    else
        spux_load_records4_by(point, stride, cluster_corners(a, i) + k, step, d);
    for (int c = 0; c < 3; c++)
        v[c] = d[c];
}

/* Prefetches the vertices of a vector of triangles, by one corner of each, and the indices that follow. They are
 * prefetched in their order, but loaded in another, which hardware prefetchers do not predict. */
CGT_SPU_INLINE void prefetch_cluster_corners(const cgt_primitive_array *a, uint32_t i)
{
    if (!a->index || a->count < CGT_LANES || i > a->count - CGT_LANES)
        return;
    const uint32_t *index = cluster_corners(a, i);
    for (uint32_t k = 0; k < CGT_LANES; k++)
        __builtin_prefetch(a->point + (size_t)index[3 * k] * a->point_stride);
    for (uint32_t k = 0; k < CGT_LANES; k += 5) /* a line has the indices of as many triangles */
        __builtin_prefetch(index + 3 * (CGT_LANES * CGT_CLUSTER + k));
}

/* ---- boxes ---- */

static inline void cluster_clear(cgt_cluster *c)
{
    for (int a = 0; a < 3; a++) {
        c->middle[a] = INFINITY;
        c->half[a] = -INFINITY;
    }
    c->valid = 0;
}

static inline void cluster_add(cgt_cluster *c, const float low[3], const float high[3])
{
    for (int a = 0; a < 3; a++) {
        c->middle[a] = low[a] < c->middle[a] ? low[a] : c->middle[a];
        c->half[a] = high[a] > c->half[a] ? high[a] : c->half[a];
    }
}

/* Adds consecutive triangles from `primitive` on, in the first `count` lanes. */
__attribute__((noinline)) static void clusters_add(cgt_cluster *cluster, uint32_t prim, uint32_t count,
                                                   const vfloat low[3], const vfloat high[3], vmask valid)
{
    _Alignas(CGT_VECTOR_BYTES) float l[3][CGT_LANES], h[3][CGT_LANES];
    const unsigned bits = spux_mask_bits(valid);
    for (int a = 0; a < 3; a++) {
        spux_store(l[a], low[a]);
        spux_store(h[a], high[a]);
    }
    for (uint32_t k = 0; k < count; k++) {
        cgt_cluster *c = &cluster[(prim + k) / CGT_CLUSTER];
        if ((prim + k) % CGT_CLUSTER == 0)
            cluster_clear(c);
        if (!(bits >> k & 1))
            continue;
        cluster_add(c, (const float[3]){l[0][k], l[1][k], l[2][k]}, (const float[3]){h[0][k], h[1][k], h[2][k]});
        c->valid |= 1u << (prim + k) % CGT_CLUSTER;
    }
}

/* A vector of clusters, of each a triangle at a time. */
typedef struct cluster_gather {
    vfloat low[3], high[3];
    vuint valid;
} cluster_gather;

CGT_SPU_INLINE void cluster_gather_clear(cluster_gather *g)
{
    for (int a = 0; a < 3; a++) {
        g->low[a] = spux_vfloat(INFINITY);
        g->high[a] = spux_vfloat(-INFINITY);
    }
    g->valid = spux_vuint(0);
}

/* Triangle `number` of every cluster. */
CGT_SPU_INLINE void cluster_gather_add(cluster_gather *g, uint32_t number, const vfloat low[3], const vfloat high[3],
                                       vmask valid)
{
    for (int a = 0; a < 3; a++) {
        g->low[a] = spux_select(g->low[a], spux_min(g->low[a], low[a]), valid);
        g->high[a] = spux_select(g->high[a], spux_max(g->high[a], high[a]), valid);
    }
    g->valid = spux_select(g->valid, spu_or(g->valid, spux_vuint(1u << number)), valid);
}

/* The first clusters of a vector. */
CGT_SPU_INLINE void cluster_gather_store(const cluster_gather *g, cgt_cluster *cluster, uint32_t count)
{
    const size_t stride = sizeof *cluster / sizeof(float);
    const vfloat first[4] = {g->low[0], g->low[1], g->low[2], (vfloat)g->valid};
    const vfloat second[4] = {g->high[0], g->high[1], g->high[2], spux_vfloat(0)};
    cgt_cluster padded[CGT_LANES], *to = count < CGT_LANES ? padded : cluster;
    spux_store_records4(to->middle, stride, first);
    spux_store_records4(to->half, stride, second);
    if (count < CGT_LANES) /* what follows may be another thread's */
        memcpy(cluster, padded, count * sizeof *padded);
}

/* Middles and extents of clusters whose corners are gathered, and their sizes. Returns how many have more half area
 * than max_half_area. */
CGT_SPU_INLINE uint32_t clusters_compute_size(cgt_cluster *cluster, uint32_t count, float max_half_area,
                                              size_gather *sizes)
{
    uint32_t large = 0;
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vfloat d[8], middle[3], half[3], size = spux_vfloat(0);
        const uint32_t remaining = count - k;
        load_clusters(cluster + k, remaining, d);
        const vmask has_valid = spux_not(spu_cmpeq((vuint)d[3], spux_vuint(0)));
        center_and_half(d, d + 4, middle, half);
        for (int a = 0; a < 3; a++) {
            /* +0, whichever zero came first */
            middle[a] = spu_add(spux_select(spux_vfloat(0), middle[a], has_valid), spux_vfloat(0));
            half[a] = spux_select(spux_vfloat(0), half[a], has_valid);
            size = spux_max(size, half[a]);
        }
        size = spux_select(spux_vfloat(-1), size, has_valid);
        const vmask present = spu_and(has_valid, spux_mask_first(remaining < CGT_LANES ? remaining : CGT_LANES));
        const vfloat sides = spu_madd(half[0], spu_add(half[1], half[2]), spu_mul(half[1], half[2]));
        const vmask is_large = spu_cmpgt(sides, spux_vfloat(max_half_area * 0.25f)); /* extents are twice the halves */
        large += spux_count_bits(spux_mask_bits(spu_and(present, is_large)));
        size_gather_add(sizes, middle, half, 3, size, present);
        const size_t stride = sizeof *cluster / sizeof(float);
        const vfloat first[4] = {middle[0], middle[1], middle[2], d[3]}, second[4] = {half[0], half[1], half[2], size};
        spux_store_records4(cluster[k].middle, stride, first); /* there is room for whole vectors */
        spux_store_records4(cluster[k].half, stride, second);
    }
    return large;
}

#endif
