/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The queue of what single precision leaves open in a tile: pairs of a pixel and an object that may be its nearest. They
 * are decided later, together. That is right, since a pixel's best hit is replaced only by one that is certainly nearer:
 * the nearest is the best of the end, or in the queue. */
#ifndef CGT_TILE_DECIDE_H
#define CGT_TILE_DECIDE_H

#include "tile.h"

#define TILE_QUEUE 1024u

typedef struct tile_queue {
    uint32_t entries;
    uint16_t pixel[TILE_QUEUE];
    uint32_t object[TILE_QUEUE];
} tile_queue;

/* The bits of a shape that is as good as the winner make it a hit; the lower object wins. */
CGT_SPU_INLINE bool tile_same_shape(const cgt_objects *objects, uint32_t a, uint32_t b)
{
    const cgt_shape p = cgt_objects_shape(objects, a), q = cgt_objects_shape(objects, b);
    if (p.kind != q.kind)
        return false;
    return p.kind == CGT_KIND_SPHERES ? !memcmp(&p.sphere, &q.sphere, sizeof p.sphere)
                                      : !memcmp(&p.triangle, &q.triangle, sizeof p.triangle);
}

CGT_SPU_INLINE void tile_decide(const cgt_objects *objects, tile *t, uint32_t i, uint32_t object, cgt_counts *counts)
{
    const uint32_t winner = t->object[i];
    double hit_t;
    if (winner == object || t->z[i] == -INFINITY)
        return;
    if (winner != CGT_NONE && tile_same_shape(objects, object, winner)) {
        t->object[i] = object < winner ? object : winner;
        return;
    }
    const cgt_ray ray = tile_ray(t, i);
    if (!filter_beats(objects, &ray, winner, object, &hit_t, counts))
        return;
    t->object[i] = object;
    t->z[i] = tile_depth(t, i, hit_t);
}

__attribute__((noinline, unused)) static void tile_flush(const cgt_objects *objects, tile *t, tile_queue *q,
                                                         cgt_counts *counts)
{
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
