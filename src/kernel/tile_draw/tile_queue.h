/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The queue of what single precision leaves undecided in a tile: pairs of a pixel and a primitive that may be its
 * nearest. They are decided later, together (tile_decide.c). That is right because a pixel's closest hit is only ever
 * replaced by one that is certainly nearer: at the end the nearest primitive is the pixel's closest one, or still in
 * the queue. */
#ifndef CGT_TILE_QUEUE_H
#define CGT_TILE_QUEUE_H

#include "kernel/tile/tile_window.h"

#define TILE_QUEUE_CAPACITY 1024u

/* Lanes that a window's vectors leave undecided, as bits: one vector of columns after the other, one pair of rows after
 * the other, padded to eight bytes. */
#define TILE_MAX_VECTORS (TILE_EDGE / 2 * (TILE_EDGE / (CGT_LANES / 2)))

typedef struct tile_queue {
    uint32_t entries;
    bool has_overflowed; /* it was full: primitives are crowded */
    uint16_t pixel[TILE_QUEUE_CAPACITY];
    uint32_t prim[TILE_QUEUE_CAPACITY];
} tile_queue;

/* Decides all entries of the queue exactly, and empties it. */
void CGT_KERNEL(cgt_tile_flush)(const cgt_primitives *prims, tile *t, tile_queue *q, cgt_counts *counts);
void CGT_KERNEL(cgt_tile_flush_spheres)(const cgt_primitives *prims, tile *t, const tile_queue *q, cgt_counts *counts);
void CGT_KERNEL(cgt_tile_flush_triangles)(const cgt_primitives *prims, tile *t, const tile_queue *q,
                                          cgt_counts *counts);

/* Decides whether a primitive, of any kind, is the nearest of pixel i. */
void CGT_KERNEL(cgt_tile_decide)(const cgt_primitives *prims, tile *t, uint32_t i, uint32_t prim, cgt_counts *counts);

/* Queues the undecided lanes of a window's vectors. */
void CGT_KERNEL(cgt_tile_queue_undecided)(const cgt_primitives *prims, tile *t, uint32_t prim, tile_rect rect,
                                          uint32_t vectors, const uint16_t *undecided, tile_queue *queue,
                                          cgt_counts *counts);

/* The same of a small sphere (tile_sphere_draw.h): sixteen bits for each pair of rows from pixel `first` on. */
void CGT_KERNEL(cgt_tile_queue_small)(const cgt_primitives *prims, tile *t, uint32_t prim, uint32_t first,
                                      uint64_t undecided, tile_queue *queue, cgt_counts *counts);

/* Tests the pixels of a window in double precision (tile_double.c). */
void CGT_KERNEL(cgt_tile_rasterise_double)(const cgt_primitives *prims, tile *t, uint32_t prim, tile_rect rect,
                                           tile_queue *queue, cgt_counts *counts);

CGT_SPU_INLINE void tile_queue_push(const cgt_primitives *prims, tile *t, tile_queue *q, uint32_t pixel, uint32_t prim,
                                    cgt_counts *counts)
{
    if (q->entries == TILE_QUEUE_CAPACITY) {
        CGT_KERNEL(cgt_tile_flush)(prims, t, q, counts);
        q->has_overflowed = true;
    }
    q->pixel[q->entries] = (uint16_t)pixel;
    q->prim[q->entries++] = prim;
}

/* ---- pixels ---- */

/* The test of a vector of pixels. A NaN depth is neither certain nor possible: px is NaN beyond the tile, and d
 * may be below 0. A denormal d may be possible, which costs a test in double precision. */
typedef struct tile_pixel_test {
    vfloat depth;
    vmask certain, possible;
} tile_pixel_test;

/* Stores the lanes of a mask. */
CGT_SPU_INLINE void tile_store_lanes(uint32_t *to, vuint v, vmask lanes)
{
#if CGT_LANES == 16
    spux_store_mask_uint(to, v, lanes);
#else /* their masked stores are slow */
    spux_store_unaligned_uint(to, spux_select(spux_load_unaligned_uint(to), v, lanes));
#endif
}

CGT_SPU_INLINE void tile_store_certain(tile *t, uint32_t i, const tile_pixel_test *f, vuint prim)
{
    tile_store_lanes((uint32_t *)(void *)(t->z + i), (vuint)f->depth, f->certain);
    tile_store_lanes(t->prim + i, prim, f->certain);
}

#endif
