/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The boxes of clusters, gathered from vectors of triangles in ascending order. */
#ifndef CGT_CLUSTER_BOUNDS_H
#define CGT_CLUSTER_BOUNDS_H

#include <math.h>

#include "object_fetch.h"
#include "size_gather.h"

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

/* Lanes hold triangles from `object` on, the first `count` of them: one after the other. */
__attribute__((noinline)) static void clusters_add_some(cgt_cluster *cluster, uint32_t object, uint32_t count,
                                                        const vfloat low[3], const vfloat high[3], vmask valid)
{
    _Alignas(CGT_VECTOR_BYTES) float l[3][CGT_LANES], h[3][CGT_LANES];
    const unsigned bits = spux_mask_bits(valid);
    for (int a = 0; a < 3; a++) {
        spux_store(l[a], low[a]);
        spux_store(h[a], high[a]);
    }
    for (uint32_t k = 0; k < count; k++) {
        cgt_cluster *c = &cluster[(object + k) / CGT_CLUSTER];
        if ((object + k) % CGT_CLUSTER == 0)
            cluster_clear(c);
        if (!(bits >> k & 1))
            continue;
        cluster_add(c, (const float[3]){l[0][k], l[1][k], l[2][k]}, (const float[3]){h[0][k], h[1][k], h[2][k]});
        c->valid |= 1u << (object + k) % CGT_CLUSTER;
    }
}

/* A whole vector, `object` a multiple of CGT_LANES: lanes of one cluster are narrowed to one number together. */
CGT_SPU_INLINE void clusters_add_vector(cgt_cluster *cluster, uint32_t object, const vfloat low[3],
                                        const vfloat high[3], vmask valid)
{
    _Alignas(CGT_VECTOR_BYTES) float l[3][CGT_LANES], h[3][CGT_LANES];
    const unsigned bits = spux_mask_bits(valid);
    const uint32_t step = CGT_LANES < CGT_CLUSTER ? CGT_LANES : CGT_CLUSTER;
    for (int a = 0; a < 3; a++) {
        vfloat least = spux_select(spux_vfloat(INFINITY), low[a], valid);
        vfloat most = spux_select(spux_vfloat(-INFINITY), high[a], valid);
        for (uint32_t d = 1; d < step; d *= 2) {
            const vuint other = spu_xor(spux_lane_index(), spux_vuint(d));
            least = spux_min(least, spux_permute(least, other));
            most = spux_max(most, spux_permute(most, other));
        }
        spux_store(l[a], least);
        spux_store(h[a], most);
    }
    for (uint32_t k = 0; k < CGT_LANES; k += step) {
        cgt_cluster *c = &cluster[(object + k) / CGT_CLUSTER];
        if ((object + k) % CGT_CLUSTER == 0)
            cluster_clear(c);
        cluster_add(c, (const float[3]){l[0][k], l[1][k], l[2][k]}, (const float[3]){h[0][k], h[1][k], h[2][k]});
        c->valid |= (bits >> k & ((1u << step) - 1)) << (object + k) % CGT_CLUSTER;
    }
}

CGT_SPU_INLINE void clusters_add(cgt_cluster *cluster, uint32_t object, uint32_t count, const vfloat low[3],
                                 const vfloat high[3], vmask valid)
{
    if (count == CGT_LANES && object % CGT_LANES == 0)
        clusters_add_vector(cluster, object, low, high, valid);
    else
        clusters_add_some(cluster, object, count, low, high, valid);
}

/* Middles and extents of clusters whose corners are gathered, and their sizes. */
CGT_SPU_INLINE void clusters_finish(cgt_cluster *cluster, uint32_t count, size_gather *sizes)
{
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vfloat d[8], middle[3], half[3], size = spux_vfloat(0);
        const uint32_t left = count - k;
        fetch_clusters(cluster + k, left, d);
        const vmask some = spux_not(spu_cmpeq((vuint)d[3], spux_vuint(0)));
        box_of_bounds(d, d + 4, middle, half);
        for (int a = 0; a < 3; a++) {
            /* +0, whichever zero came first */
            middle[a] = spu_add(spux_select(spux_vfloat(0), middle[a], some), spux_vfloat(0));
            half[a] = spux_select(spux_vfloat(0), half[a], some);
            size = spux_max(size, half[a]);
        }
        size = spux_select(spux_vfloat(-1), size, some);
        size_gather_add(sizes, middle, half, 3, size,
                        spu_and(some, spux_mask_first(left < CGT_LANES ? left : CGT_LANES)));
        const size_t stride = sizeof *cluster / sizeof(float);
        const vfloat first[4] = {middle[0], middle[1], middle[2], d[3]}, second[4] = {half[0], half[1], half[2], size};
        spux_store_records4(cluster[k].middle, stride, first); /* there is room for whole vectors */
        spux_store_records4(cluster[k].half, stride, second);
    }
}

#endif
