/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A sphere over the pixels of its window in a tile, without branches: what it certainly wins is kept, what it may win is
 * queued. tile_spheres.h says what is computed, and with which bounds. */
#ifndef CGT_TILE_DRAW_H
#define CGT_TILE_DRAW_H

#include "kernel/tile_draw/tile_spheres.h"

/* What the loops take of one sphere. */
typedef struct tile_sphere {
    vfloat X, Y, a, b, c, d0, dx, dy, q0, qx, qy, certain, gap, minus_gap;
    vuint object;
} tile_sphere;

CGT_SPU_INLINE tile_sphere tile_sphere_get(const tile *t, const tile_spheres *s, int k)
{
    return (tile_sphere){.X = spux_vfloat(s->X[k]),
                         .Y = spux_vfloat(s->Y[k]),
                         .a = spux_vfloat(s->a[k]),
                         .b = spux_vfloat(s->b[k]),
                         .c = spux_vfloat(s->c[k]),
                         .d0 = spux_vfloat(s->d0[k]),
                         .dx = spux_vfloat(s->dx[k]),
                         .dy = spux_vfloat(s->dy[k]),
                         .q0 = spux_vfloat(s->q0[k]),
                         .qx = spux_vfloat(s->qx[k]),
                         .qy = spux_vfloat(s->qy[k]),
                         .certain = spux_vfloat(s->certain[k]),
                         .gap = spux_vfloat(t->wide_gap),
                         .minus_gap = spux_vfloat(-t->wide_gap),
                         .object = spux_vuint(s->object[k])};
}

/* The parts of 16x16 pixels, as bits, that still want something as near as this sphere. */
CGT_SPU_INLINE unsigned tile_parts_open(const tile *t, float nearest)
{
    unsigned open = 0;
    for (uint32_t i = 0; i < TILE_PARTS * TILE_PARTS; i += CGT_LANES)
        open |= (~spux_mask_bits(spu_cmpgt(spux_vfloat(nearest), spux_load(t->far + i))) & CGT_ALL_LANES) << i;
    return open;
}

/* A window as columns x0 to x1 and rows y0 to y1. */
typedef struct tile_box {
    uint32_t x0, x1, y0, y1;
} tile_box;

/* Cuts the window to the open parts; false where none is. */
CGT_SPU_INLINE bool tile_clip(const tile *t, const tile_spheres *s, int k, tile_box *b)
{
    const uint32_t u0 = s->window.x0[k] / 16, u1 = s->window.x1[k] / 16, v0 = s->window.y0[k] / 16,
                   v1 = s->window.y1[k] / 16;
    const unsigned across = (2u << u1) - (1u << u0), down = (2u << 4 * v1) - (1u << 4 * v0);
    const unsigned parts =
        tile_parts_open(t, s->nearest[k]) & across * 0x1111u & (down | down << 1 | down << 2 | down << 3);
    if (!parts)
        return false;
    const unsigned some = (parts | parts >> 4 | parts >> 8 | parts >> 12) & 15;
    const uint32_t left = 16 * (uint32_t)__builtin_ctz(some), right = 16 * (31 - (uint32_t)__builtin_clz(some)) + 15;
    const uint32_t top = (uint32_t)__builtin_ctz(parts) / 4 * 16;
    const uint32_t bottom = (31 - (uint32_t)__builtin_clz(parts)) / 4 * 16 + 15;
    b->x0 = s->window.x0[k] > left ? s->window.x0[k] : left;
    b->x1 = s->window.x1[k] < right ? s->window.x1[k] : right;
    b->y0 = s->window.y0[k] > top ? s->window.y0[k] : top;
    b->y1 = s->window.y1[k] < bottom ? s->window.y1[k] : bottom;
    return true;
}

/* What a vector of columns has in common for one sphere. */
typedef struct tile_columns {
    vfloat dx, slope, q0;
} tile_columns;

CGT_SPU_INLINE tile_columns tile_sphere_columns(const tile_sphere *q, const float *columns)
{
    const vfloat px = spux_load_unaligned(columns), dx = spu_sub(px, q->X);
    return (tile_columns){.dx = dx, .slope = spu_nmsub(q->a, dx, q->dx), .q0 = spu_madd(px, q->qx, q->q0)};
}

/* What a pair of rows has in common for one sphere. */
typedef struct tile_pair {
    vfloat py, dy, d0;
} tile_pair;

CGT_SPU_INLINE tile_pair tile_sphere_pair(const tile *t, const tile_sphere *q, uint32_t pair)
{
    const vfloat py = spux_load(t->py[pair]), dy = spu_sub(py, q->Y);
    return (tile_pair){.py = py, .dy = dy, .d0 = spu_madd(dy, spu_nmsub(q->c, dy, q->dy), q->d0)};
}

/* The test of a vector of pixels. A depth that is not a number is none of both: that of the px beyond the tile, and where d
 * is below 0. Denormal d may be possible, which costs a look in double precision. */
typedef struct tile_test {
    vfloat depth;
    vmask certain, possible;
} tile_test;

CGT_SPU_INLINE tile_test tile_sphere_test(const tile_sphere *q, const tile_columns *c, const tile_pair *row,
                                          const float *best)
{
    const vfloat d = spu_madd(c->dx, spu_madd(q->b, row->dy, c->slope), row->d0);
    const vfloat depth = spu_nmsub(d, spux_rsqrte(d), spu_madd(row->py, q->qy, c->q0));
    const vfloat behind = spu_sub(depth, spux_load_unaligned(best));
    return (tile_test){.depth = depth,
                       .certain = spu_and(spu_cmpgt(d, q->certain), spu_cmpgt(q->minus_gap, behind)),
                       .possible = spux_cmpge(q->gap, behind)};
}

/* Stores the lanes of a mask. */
CGT_SPU_INLINE void tile_keep_lanes(uint32_t *to, vuint v, vmask lanes)
{
#if CGT_LANES == 16
    spux_store_mask_uint(to, v, lanes);
#else /* their masked stores are slow */
    spux_store_unaligned_uint(to, spux_select(spux_load_unaligned_uint(to), v, lanes));
#endif
}

CGT_SPU_INLINE void tile_keep(tile *t, uint32_t i, const tile_test *f, vuint object)
{
    tile_keep_lanes((uint32_t *)(void *)(t->z + i), (vuint)f->depth, f->certain);
    tile_keep_lanes(t->object + i, object, f->certain);
}

/* Lanes of the windows of a drawn sphere that are left open, as bits, a window after the other, padded to eight bytes. */
#define TILE_WINDOWS (TILE_EDGE / 2 * (TILE_EDGE / (CGT_LANES / 2)))

/* Queues what a drawn sphere left open. */
__attribute__((noinline, unused)) static void tile_sphere_queue(const cgt_objects *objects, tile *t, uint32_t object,
                                                                tile_box box, uint32_t windows, const uint16_t *open,
                                                                tile_queue *queue, cgt_counts *counts)
{
    const uint32_t end = windows * (box.y1 / 2 - box.y0 / 2 + 1);
    for (uint32_t k = 0; k < end; k += 4) {
        uint64_t four;
        memcpy(&four, open + k, sizeof four);
        for (uint32_t w = k; four && w < k + 4 && w < end; w++) {
            const uint32_t i = (box.y0 / 2 + w / windows) * TILE_PAIR + 2 * box.x0 + w % windows * CGT_LANES;
            for (unsigned left = open[w]; left; left &= left - 1)
                tile_queue_push(objects, t, queue, i + (uint32_t)__builtin_ctz(left), object, counts);
        }
    }
}

/* One or two vectors of columns from x on, over all pairs of rows. Returns whether any lane is left open; the lanes go to
 * `open`, which goes on by `windows` from one pair to the next. */
CGT_SPU_INLINE unsigned tile_sphere_strip(tile *t, const tile_sphere *q, tile_box box, uint32_t x, uint32_t some,
                                          uint32_t windows, uint16_t *open)
{
    unsigned any = 0;
    tile_columns c[2];
    for (uint32_t w = 0; w < some; w++)
        c[w] = tile_sphere_columns(q, t->px + 2 * x + w * CGT_LANES);
    for (uint32_t pair = box.y0 / 2; pair <= box.y1 / 2; pair++, open += windows) {
        const tile_pair row = tile_sphere_pair(t, q, pair);
        for (uint32_t w = 0; w < some; w++) {
            const uint32_t i = pair * TILE_PAIR + 2 * x + w * CGT_LANES;
            const tile_test f = tile_sphere_test(q, &c[w], &row, t->z + i);
            const unsigned left = spux_mask_bits(spu_andc(f.possible, f.certain));
            tile_keep(t, i, &f, q->object);
            any |= left;
            open[w] = (uint16_t)left;
        }
    }
    return any;
}

/* The windows of all pairs of rows, so many side by side. */
CGT_SPU_INLINE unsigned tile_sphere_windows(tile *t, const tile_sphere *q, tile_box box, uint32_t windows,
                                            uint16_t *open)
{
    unsigned any = 0;
    uint32_t w = 0;
    for (; w + 2 <= windows; w += 2)
        any |= tile_sphere_strip(t, q, box, box.x0 + w * (CGT_LANES / 2), 2, windows, open + w);
    if (w < windows)
        any |= tile_sphere_strip(t, q, box, box.x0 + w * (CGT_LANES / 2), 1, windows, open + w);
    return any;
}

CGT_SPU_INLINE void tile_sphere_draw(const cgt_objects *objects, tile *t, const tile_spheres *s, int k, tile_box box,
                                     tile_queue *queue, cgt_counts *counts)
{
    const tile_sphere q = tile_sphere_get(t, s, k);
    const uint32_t windows = (box.x1 - box.x0) / (CGT_LANES / 2) + 1, pairs = box.y1 / 2 - box.y0 / 2 + 1;
    uint16_t open[TILE_WINDOWS + 4];
    unsigned any;
    switch (windows) { /* small spheres without the branches of a loop */
    case 1: any = tile_sphere_windows(t, &q, box, 1, open); break;
    case 2: any = tile_sphere_windows(t, &q, box, 2, open); break;
    default: any = tile_sphere_windows(t, &q, box, windows, open); break;
    }
    counts->packet_tests++;
    counts->ray_tests += (uint64_t)windows * pairs * CGT_LANES;
    if (any)
        tile_sphere_queue(objects, t, s->object[k], box, windows, open, queue, counts);
}

/* Queues lanes that a small sphere left open: sixteen bits of each pair of rows. */
__attribute__((noinline, unused)) static void tile_sphere_queue_small(const cgt_objects *objects, tile *t,
                                                                      uint32_t object, uint32_t first, uint64_t open,
                                                                      tile_queue *queue, cgt_counts *counts)
{
    for (; open; open &= open - 1) {
        const uint32_t bit = (uint32_t)__builtin_ctzll(open);
        tile_queue_push(objects, t, queue, first + bit / 16 * TILE_PAIR + bit % 16, object, counts);
    }
}

/* A small sphere (tile_spheres.h), of no more than so many pairs of rows: those beyond its window are tested as well, which
 * costs less than a branch that nobody can predict. Its window is not cut to the open parts: it spans two of them at
 * most, so that culling has looked at all. */
CGT_SPU_INLINE void tile_sphere_draw_small(const cgt_objects *objects, tile *t, const tile_spheres *s, int k,
                                           uint32_t pairs, tile_queue *queue, cgt_counts *counts)
{
    const tile_sphere q = tile_sphere_get(t, s, k);
    const uint32_t last = TILE_EDGE / 2 - pairs, pair = s->window.y0[k] / 2 < last ? s->window.y0[k] / 2 : last;
    const uint32_t column = 2 * s->window.x0[k], first = pair * TILE_PAIR + column;
    const tile_columns c = tile_sphere_columns(&q, t->px + column);
    uint64_t open = 0;
#pragma GCC unroll 4
    for (uint32_t j = 0; j < pairs; j++) {
        const tile_pair row = tile_sphere_pair(t, &q, pair + j);
        const tile_test f = tile_sphere_test(&q, &c, &row, t->z + first + j * TILE_PAIR);
        tile_keep(t, first + j * TILE_PAIR, &f, q.object);
        open |= (uint64_t)spux_mask_bits(spu_andc(f.possible, f.certain)) << 16 * j;
    }
    counts->packet_tests++;
    counts->ray_tests += pairs * CGT_LANES;
    if (__builtin_expect(open != 0, 0))
        tile_sphere_queue_small(objects, t, s->object[k], first, open, queue, counts);
}

#endif
