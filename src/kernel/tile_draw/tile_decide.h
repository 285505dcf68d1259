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
CGT_SPU_INLINE bool tile_same_shape(const cgt_objects *objects, uint32_t a, uint32_t b)
{
    const cgt_shape p = cgt_objects_shape(objects, a), q = cgt_objects_shape(objects, b);
    if (p.kind != q.kind)
        return false;
    return p.kind == CGT_KIND_SPHERES ? !memcmp(&p.sphere, &q.sphere, sizeof p.sphere)
                                      : !memcmp(&p.triangle, &q.triangle, sizeof p.triangle);
}

/* Of any two objects. */
CGT_SPU_INLINE void tile_decide(const cgt_objects *objects, tile *t, uint32_t i, uint32_t object, cgt_counts *counts)
{
    const uint32_t winner = t->object[i];
    double hit_t;
    if (winner == object || t->z[i] == -INFINITY)
        return;
    if (winner != CGT_INVALID_ID && tile_same_shape(objects, object, winner)) {
        tile_win(t, i, object < winner ? object : winner);
        return;
    }
    const cgt_ray ray = tile_ray(t, i);
    if (!filter_beats(objects, &ray, winner, object, &hit_t, counts))
        return;
    tile_win(t, i, object);
    t->z[i] = tile_depth(t, i, hit_t);
}

/* One entry, by what is kept of triangles. */
CGT_SPU_INLINE void tile_flush_pair(const cgt_objects *objects, tile *t, const tile_queue *q, uint32_t k,
                                    tile_pair_seen *s, cgt_counts *counts)
{
    const uint32_t i = q->pixel[k], object = q->object[k], winner = t->object[i];
    double hit_t = 0;
    if (winner == object || t->z[i] == -INFINITY)
        return;
    const cgt_ray ray = tile_ray(t, i);
    const tile_answer answer = tile_decide_pair(objects, &ray, winner, object, s, &hit_t, counts);
    if (answer == TILE_OPEN) {
        tile_decide(objects, t, i, object, counts);
        return;
    }
    counts->double_tests++;
    if (answer == TILE_BEATS) {
        tile_win(t, i, object);
        t->z[i] = tile_depth(t, i, hit_t);
    }
}

/* How many entries from k on, at most a vector, are of one object and one winner. */
CGT_SPU_INLINE uint32_t tile_run_length(const tile *t, const tile_queue *q, uint32_t k)
{
    const uint32_t object = q->object[k], winner = t->object[q->pixel[k]];
    const uint32_t most = q->entries - k < CGT_LANES ? q->entries - k : CGT_LANES;
    uint32_t length = 1;
    while (length < most && q->object[k + length] == object && t->object[q->pixel[k + length]] == winner)
        length++;
    return length;
}

/* Such a run. */
CGT_SPU_INLINE void tile_flush_run(const cgt_objects *objects, tile *t, const tile_queue *q, uint32_t first,
                                   uint32_t count, tile_pair_seen *s, cgt_counts *counts)
{
    const uint32_t object = q->object[first], winner = t->object[q->pixel[first]];
    const float *eye = t->rays->eye;
    tile_run r = {.beats = 0};
    if (winner == object)
        return;
    if (tile_see_object(objects, eye, object, s) &&
        (winner == CGT_INVALID_ID || tile_see_winner(objects, eye, winner, s)))
        tile_judge_run(t, s, winner, q->pixel + first, count, &r, counts);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = q->pixel[first + k];
        if (!((r.beats | r.loses) >> k & 1) || t->z[i] == -INFINITY) {
            tile_flush_pair(objects, t, q, first + k, s, counts);
            continue;
        }
        counts->double_tests++;
        if (r.beats >> k & 1) {
            tile_win(t, i, object);
            t->z[i] = tile_depth(t, i, r.t[k]);
        }
    }
}

/* Where rays have one origin, and there are triangles. */
__attribute__((noinline, unused)) static void tile_flush_pairs(const cgt_objects *objects, tile *t, const tile_queue *q,
                                                               cgt_counts *counts)
{
    tile_pair_seen s; /* large: not all of it is set */
    s.object.object = s.winner.object = CGT_INVALID_ID;
    s.planes = TILE_PLANES_UNKNOWN;
    for (uint32_t k = 0, run; k < q->entries; k += run) {
        run = tile_run_length(t, q, k);
        if (run >= TILE_RUN)
            tile_flush_run(objects, t, q, k, run, &s, counts);
        else
            for (uint32_t i = k; i < k + run; i++)
                tile_flush_pair(objects, t, q, i, &s, counts);
    }
}

/* Where rays have one origin, and there are spheres of one array. */
__attribute__((noinline, unused)) static void tile_flush_spheres(const cgt_objects *objects, tile *t,
                                                                 const tile_queue *q, cgt_counts *counts)
{
    tile_verdicts v;
    for (uint32_t first = 0; first < q->entries; first += CGT_LANES) {
        tile_judge_spheres(objects->array, t, q, first, &v);
        for (uint32_t k = 0; k < CGT_LANES && first + k < q->entries; k++) {
            const uint32_t i = q->pixel[first + k], object = q->object[first + k];
            if (!((v.beats | v.loses) >> k & 1) || t->object[i] != v.winner[k] || t->z[i] == -INFINITY) {
                tile_decide(objects, t, i, object, counts); /* another entry of the vector may have won the pixel */
                continue;
            }
            counts->double_tests++;
            if (v.beats >> k & 1) {
                tile_win(t, i, object);
                t->z[i] = tile_depth(t, i, v.t[k]);
            }
        }
    }
}

__attribute__((noinline, unused)) static void tile_flush(const cgt_objects *objects, tile *t, tile_queue *q,
                                                         cgt_counts *counts)
{
    if (objects->triangles && !t->parallel)
        tile_flush_pairs(objects, t, q, counts);
    else if (objects->arrays == 1 && !t->parallel)
        tile_flush_spheres(objects, t, q, counts);
    else
        for (uint32_t k = 0; k < q->entries; k++)
            tile_decide(objects, t, q->pixel[k], q->object[k], counts);
    q->entries = 0;
}

CGT_SPU_INLINE void tile_queue_push(const cgt_objects *objects, tile *t, tile_queue *q, uint32_t pixel, uint32_t object,
                                    cgt_counts *counts)
{
    if (q->entries == TILE_QUEUE)
        tile_flush(objects, t, q, counts);
    q->pixel[q->entries] = (uint16_t)pixel;
    q->object[q->entries++] = object;
}

#endif
