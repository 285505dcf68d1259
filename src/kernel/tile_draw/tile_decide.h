/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The queue of what single precision leaves open in a tile: pairs of a pixel and an object that may be its nearest. They
 * are decided later, together. That is right, since a pixel's best hit is replaced only by one that is certainly nearer:
 * the nearest is the best of the end, or in the queue.
 *
 * Where rays have one origin, spheres of one array go a vector at a time (tile_decide_spheres.h), and triangles by runs of
 * one pair of them (tile_decide_triangles.h). */
#ifndef CGT_TILE_DECIDE_H
#define CGT_TILE_DECIDE_H

#include "kernel/tile_draw/tile_decide_spheres.h"
#include "kernel/tile_draw/tile_decide_triangles.h"

/* ---- deciding ---- */

/* The bits of a shape that is as good as the winner make it a hit; the lower object wins. */
CGT_SPU_INLINE bool tile_same_primitive(const cgt_primitives *prims, uint32_t a, uint32_t b)
{
    const cgt_primitive p = cgt_primitives_get(prims, a), q = cgt_primitives_get(prims, b);
    if (p.kind != q.kind)
        return false;
    return p.kind == CGT_KIND_SPHERES ? !memcmp(&p.sphere, &q.sphere, sizeof p.sphere)
                                      : !memcmp(&p.triangle, &q.triangle, sizeof p.triangle);
}

/* Of any two objects. */
CGT_SPU_INLINE void tile_decide(const cgt_primitives *prims, tile *t, uint32_t i, uint32_t prim, cgt_counts *counts)
{
    const uint32_t closest = t->prim[i];
    double hit_t;
    if (closest == prim || t->z[i] == -INFINITY)
        return;
    if (closest != CGT_INVALID_ID && tile_same_primitive(prims, prim, closest)) {
        tile_set_closest(t, i, prim < closest ? prim : closest);
        return;
    }
    const cgt_ray ray = tile_pixel_ray(t, i);
    if (!filter_is_closer(prims, &ray, closest, prim, &hit_t, counts))
        return;
    tile_set_closest(t, i, prim);
    t->z[i] = tile_compute_depth(t, i, hit_t);
}

/* One entry, by what is kept of triangles. */
CGT_SPU_INLINE void tile_flush_entry(const cgt_primitives *prims, tile *t, const tile_queue *q, uint32_t k,
                                     tile_pair_cache *s, cgt_counts *counts)
{
    const uint32_t i = q->pixel[k], prim = q->prim[k], closest = t->prim[i];
    double hit_t = 0;
    if (closest == prim || t->z[i] == -INFINITY)
        return;
    const cgt_ray ray = tile_pixel_ray(t, i);
    const tile_decision decision = tile_decide_pair(prims, &ray, closest, prim, s, &hit_t, counts);
    if (decision == TILE_UNDECIDED) {
        tile_decide(prims, t, i, prim, counts);
        return;
    }
    counts->double_tests++;
    if (decision == TILE_ACCEPTED) {
        tile_set_closest(t, i, prim);
        t->z[i] = tile_compute_depth(t, i, hit_t);
    }
}

/* How many entries from k on, at most a vector, are of one object and one winner. */
CGT_SPU_INLINE uint32_t tile_run_length(const tile *t, const tile_queue *q, uint32_t k)
{
    const uint32_t prim = q->prim[k], closest = t->prim[q->pixel[k]];
    const uint32_t limit = q->entries - k < CGT_LANES ? q->entries - k : CGT_LANES;
    uint32_t length = 1;
    while (length < limit && q->prim[k + length] == prim && t->prim[q->pixel[k + length]] == closest)
        length++;
    return length;
}

/* Such a run. */
CGT_SPU_INLINE void tile_flush_run(const cgt_primitives *prims, tile *t, const tile_queue *q, uint32_t first,
                                   uint32_t count, tile_pair_cache *s, cgt_counts *counts)
{
    const uint32_t prim = q->prim[first], closest = t->prim[q->pixel[first]];
    const float *eye = t->rays->eye;
    tile_run_result r = {.accepted = 0};
    if (closest == prim)
        return;
    if (tile_cache_prim(prims, eye, prim, s) &&
        (closest == CGT_INVALID_ID || tile_cache_closest(prims, eye, closest, s)))
        tile_decide_run(t, s, closest, q->pixel + first, count, &r, counts);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = q->pixel[first + k];
        if (!((r.accepted | r.rejected) >> k & 1) || t->z[i] == -INFINITY) {
            tile_flush_entry(prims, t, q, first + k, s, counts);
            continue;
        }
        counts->double_tests++;
        if (r.accepted >> k & 1) {
            tile_set_closest(t, i, prim);
            t->z[i] = tile_compute_depth(t, i, r.t[k]);
        }
    }
}

/* Where rays have one origin, and there are triangles. */
__attribute__((noinline, unused)) static void tile_flush_triangles(const cgt_primitives *prims, tile *t,
                                                                   const tile_queue *q, cgt_counts *counts)
{
    tile_pair_cache s; /* large: not all of it is set */
    s.prim.prim = s.closest.prim = CGT_INVALID_ID;
    s.planes = TILE_PLANES_UNKNOWN;
    for (uint32_t k = 0, run; k < q->entries; k += run) {
        run = tile_run_length(t, q, k);
        if (run >= TILE_MIN_RUN)
            tile_flush_run(prims, t, q, k, run, &s, counts);
        else
            for (uint32_t i = k; i < k + run; i++)
                tile_flush_entry(prims, t, q, i, &s, counts);
    }
}

/* Where rays have one origin, and there are spheres of one array. */
__attribute__((noinline, unused)) static void tile_flush_spheres(const cgt_primitives *prims, tile *t,
                                                                 const tile_queue *q, cgt_counts *counts)
{
    tile_decisions v;
    for (uint32_t first = 0; first < q->entries; first += CGT_LANES) {
        tile_decide_spheres(prims->array, t, q, first, &v);
        for (uint32_t k = 0; k < CGT_LANES && first + k < q->entries; k++) {
            const uint32_t i = q->pixel[first + k], prim = q->prim[first + k];
            if (!((v.accepted | v.rejected) >> k & 1) || t->prim[i] != v.closest[k] || t->z[i] == -INFINITY) {
                tile_decide(prims, t, i, prim, counts); /* another entry of the vector may have won the pixel */
                continue;
            }
            counts->double_tests++;
            if (v.accepted >> k & 1) {
                tile_set_closest(t, i, prim);
                t->z[i] = tile_compute_depth(t, i, v.t[k]);
            }
        }
    }
}

__attribute__((noinline, unused)) static void tile_flush(const cgt_primitives *prims, tile *t, tile_queue *q,
                                                         cgt_counts *counts)
{
    if (prims->triangles && !t->parallel)
        tile_flush_triangles(prims, t, q, counts);
    else if (prims->arrays == 1 && !t->parallel)
        tile_flush_spheres(prims, t, q, counts);
    else
        for (uint32_t k = 0; k < q->entries; k++)
            tile_decide(prims, t, q->pixel[k], q->prim[k], counts);
    q->entries = 0;
}

CGT_SPU_INLINE void tile_queue_push(const cgt_primitives *prims, tile *t, tile_queue *q, uint32_t pixel, uint32_t prim,
                                    cgt_counts *counts)
{
    if (q->entries == TILE_QUEUE_CAPACITY)
        tile_flush(prims, t, q, counts);
    q->pixel[q->entries] = (uint16_t)pixel;
    q->prim[q->entries++] = prim;
}

#endif
