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
    vfloat X, Y, a, b, c, d0, dx, dy, q0, qx, qy, certain, depth_error, minus_depth_error;
    vuint prim;
} tile_sphere;

CGT_SPU_INLINE tile_sphere tile_broadcast_sphere(const tile *t, const tile_spheres *s, int k)
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
                         .depth_error = spux_vfloat(t->padded_depth_error),
                         .minus_depth_error = spux_vfloat(-t->padded_depth_error),
                         .prim = spux_vuint(s->prim[k])};
}

/* The parts of 16x16 pixels, as bits, that still want something as near as this sphere. */
CGT_SPU_INLINE unsigned tile_visible_parts(const tile *t, float min_distance)
{
    unsigned visible = 0;
    for (uint32_t i = 0; i < TILE_PARTS * TILE_PARTS; i += CGT_LANES)
        visible |=
            (~spux_mask_bits(spu_cmpgt(spux_vfloat(min_distance), spux_load(t->far_distance + i))) & CGT_ALL_LANES)
            << i;
    return visible;
}

/* A window as columns x0 to x1 and rows y0 to y1. */
typedef struct tile_rect {
    uint32_t x0, x1, y0, y1;
} tile_rect;

/* Cuts the window to the open parts; false where none is. */
CGT_SPU_INLINE bool tile_clip_window(const tile *t, const tile_spheres *s, int k, tile_rect *b)
{
    const uint32_t u0 = s->window.x0[k] / 16, u1 = s->window.x1[k] / 16, v0 = s->window.y0[k] / 16,
                   v1 = s->window.y1[k] / 16;
    const unsigned column_mask = (2u << u1) - (1u << u0), row_mask = (2u << 4 * v1) - (1u << 4 * v0);
    const unsigned parts = tile_visible_parts(t, s->min_distance[k]) & column_mask * 0x1111u &
                           (row_mask | row_mask << 1 | row_mask << 2 | row_mask << 3);
    if (!parts)
        return false;
    const unsigned part_columns = (parts | parts >> 4 | parts >> 8 | parts >> 12) & 15;
    const uint32_t x_first = 16 * (uint32_t)__builtin_ctz(part_columns),
                   x_last = 16 * (31 - (uint32_t)__builtin_clz(part_columns)) + 15;
    const uint32_t y_first = (uint32_t)__builtin_ctz(parts) / 4 * 16;
    const uint32_t y_last = (31 - (uint32_t)__builtin_clz(parts)) / 4 * 16 + 15;
    b->x0 = s->window.x0[k] > x_first ? s->window.x0[k] : x_first;
    b->x1 = s->window.x1[k] < x_last ? s->window.x1[k] : x_last;
    b->y0 = s->window.y0[k] > y_first ? s->window.y0[k] : y_first;
    b->y1 = s->window.y1[k] < y_last ? s->window.y1[k] : y_last;
    return true;
}

/* What a vector of columns has in common for one sphere. */
typedef struct tile_columns {
    vfloat dx, slope, q0;
} tile_columns;

CGT_SPU_INLINE tile_columns tile_prepare_columns(const tile_sphere *q, const float *columns)
{
    const vfloat px = spux_load_unaligned(columns), dx = spu_sub(px, q->X);
    return (tile_columns){.dx = dx, .slope = spu_nmsub(q->a, dx, q->dx), .q0 = spu_madd(px, q->qx, q->q0)};
}

/* What a pair of rows has in common for one sphere. */
typedef struct tile_row_pair {
    vfloat py, dy, d0;
} tile_row_pair;

CGT_SPU_INLINE tile_row_pair tile_prepare_rows(const tile *t, const tile_sphere *q, uint32_t pair)
{
    const vfloat py = spux_load(t->py[pair]), dy = spu_sub(py, q->Y);
    return (tile_row_pair){.py = py, .dy = dy, .d0 = spu_madd(dy, spu_nmsub(q->c, dy, q->dy), q->d0)};
}

/* The test of a vector of pixels. A depth that is not a number is none of both: that of the px beyond the tile, and where d
 * is below 0. Denormal d may be possible, which costs a look in double precision. */
typedef struct tile_pixel_test {
    vfloat depth;
    vmask certain, possible;
} tile_pixel_test;

CGT_SPU_INLINE tile_pixel_test tile_test_sphere(const tile_sphere *q, const tile_columns *c, const tile_row_pair *row,
                                                const float *best)
{
    const vfloat d = spu_madd(c->dx, spu_madd(q->b, row->dy, c->slope), row->d0);
    const vfloat depth = spu_nmsub(d, spux_rsqrte(d), spu_madd(row->py, q->qy, c->q0));
    const vfloat depth_difference = spu_sub(depth, spux_load_unaligned(best));
    return (tile_pixel_test){.depth = depth,
                             .certain =
                                 spu_and(spu_cmpgt(d, q->certain), spu_cmpgt(q->minus_depth_error, depth_difference)),
                             .possible = spux_cmpge(q->depth_error, depth_difference)};
}

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

/* Lanes of the windows of a drawn sphere that are left open, as bits, a window after the other, padded to eight bytes. */
#define TILE_MAX_WINDOWS (TILE_EDGE / 2 * (TILE_EDGE / (CGT_LANES / 2)))

/* Queues what a drawn sphere left open. */
__attribute__((noinline, unused)) static void tile_queue_undecided(const cgt_primitives *prims, tile *t, uint32_t prim,
                                                                   tile_rect rect, uint32_t windows,
                                                                   const uint16_t *undecided, tile_queue *queue,
                                                                   cgt_counts *counts)
{
    const uint32_t end = windows * (rect.y1 / 2 - rect.y0 / 2 + 1);
    for (uint32_t k = 0; k < end; k += 4) {
        uint64_t four;
        memcpy(&four, undecided + k, sizeof four);
        for (uint32_t w = k; four && w < k + 4 && w < end; w++) {
            const uint32_t i = (rect.y0 / 2 + w / windows) * TILE_ROW_PAIR + 2 * rect.x0 + w % windows * CGT_LANES;
            for (unsigned undecided_lanes = undecided[w]; undecided_lanes; undecided_lanes &= undecided_lanes - 1)
                tile_queue_push(prims, t, queue, i + (uint32_t)__builtin_ctz(undecided_lanes), prim, counts);
        }
    }
}

/* One or two vectors of columns from x on, over all pairs of rows. Returns whether any lane is left open; the lanes go to
 * `open`, which goes on by `windows` from one pair to the next. */
CGT_SPU_INLINE unsigned tile_rasterise_strip(tile *t, const tile_sphere *q, tile_rect rect, uint32_t x, uint32_t count,
                                             uint32_t windows, uint16_t *undecided)
{
    unsigned any = 0;
    tile_columns c[2];
    for (uint32_t w = 0; w < count; w++)
        c[w] = tile_prepare_columns(q, t->px + 2 * x + w * CGT_LANES);
    for (uint32_t pair = rect.y0 / 2; pair <= rect.y1 / 2; pair++, undecided += windows) {
        const tile_row_pair row = tile_prepare_rows(t, q, pair);
        for (uint32_t w = 0; w < count; w++) {
            const uint32_t i = pair * TILE_ROW_PAIR + 2 * x + w * CGT_LANES;
            const tile_pixel_test f = tile_test_sphere(q, &c[w], &row, t->z + i);
            const unsigned undecided_lanes = spux_mask_bits(spu_andc(f.possible, f.certain));
            tile_store_certain(t, i, &f, q->prim);
            any |= undecided_lanes;
            undecided[w] = (uint16_t)undecided_lanes;
        }
    }
    return any;
}

/* The windows of all pairs of rows, so many side by side. */
CGT_SPU_INLINE unsigned tile_rasterise_windows(tile *t, const tile_sphere *q, tile_rect rect, uint32_t windows,
                                               uint16_t *undecided)
{
    unsigned any = 0;
    uint32_t w = 0;
    for (; w + 2 <= windows; w += 2)
        any |= tile_rasterise_strip(t, q, rect, rect.x0 + w * (CGT_LANES / 2), 2, windows, undecided + w);
    if (w < windows)
        any |= tile_rasterise_strip(t, q, rect, rect.x0 + w * (CGT_LANES / 2), 1, windows, undecided + w);
    return any;
}

CGT_SPU_INLINE void tile_rasterise_sphere(const cgt_primitives *prims, tile *t, const tile_spheres *s, int k,
                                          tile_rect rect, tile_queue *queue, cgt_counts *counts)
{
    const tile_sphere q = tile_broadcast_sphere(t, s, k);
    const uint32_t windows = (rect.x1 - rect.x0) / (CGT_LANES / 2) + 1, pairs = rect.y1 / 2 - rect.y0 / 2 + 1;
    uint16_t undecided[TILE_MAX_WINDOWS + 4];
    unsigned any;
    switch (windows) { /* small spheres without the branches of a loop */
    case 1: any = tile_rasterise_windows(t, &q, rect, 1, undecided); break;
    case 2: any = tile_rasterise_windows(t, &q, rect, 2, undecided); break;
    default: any = tile_rasterise_windows(t, &q, rect, windows, undecided); break;
    }
    counts->packet_tests++;
    counts->ray_tests += (uint64_t)windows * pairs * CGT_LANES;
    if (any)
        tile_queue_undecided(prims, t, s->prim[k], rect, windows, undecided, queue, counts);
}

/* Queues lanes that a small sphere left open: sixteen bits of each pair of rows. */
__attribute__((noinline, unused)) static void tile_queue_small_undecided(const cgt_primitives *prims, tile *t,
                                                                         uint32_t prim, uint32_t first,
                                                                         uint64_t undecided, tile_queue *queue,
                                                                         cgt_counts *counts)
{
    for (; undecided; undecided &= undecided - 1) {
        const uint32_t bit = (uint32_t)__builtin_ctzll(undecided);
        tile_queue_push(prims, t, queue, first + bit / 16 * TILE_ROW_PAIR + bit % 16, prim, counts);
    }
}

/* A small sphere (tile_spheres.h), of no more than so many pairs of rows: those beyond its window are tested as well, which
 * costs less than a branch that nobody can predict. Its window is not cut to the open parts: it spans two of them at
 * most, so that culling has looked at all. */
CGT_SPU_INLINE void tile_rasterise_small_sphere(const cgt_primitives *prims, tile *t, const tile_spheres *s, int k,
                                                uint32_t pairs, tile_queue *queue, cgt_counts *counts)
{
    const tile_sphere q = tile_broadcast_sphere(t, s, k);
    const uint32_t last = TILE_EDGE / 2 - pairs, pair = s->window.y0[k] / 2 < last ? s->window.y0[k] / 2 : last;
    const uint32_t column = 2 * s->window.x0[k], first = pair * TILE_ROW_PAIR + column;
    const tile_columns c = tile_prepare_columns(&q, t->px + column);
    uint64_t undecided = 0;
#pragma GCC unroll 4
    for (uint32_t j = 0; j < pairs; j++) {
        const tile_row_pair row = tile_prepare_rows(t, &q, pair + j);
        const tile_pixel_test f = tile_test_sphere(&q, &c, &row, t->z + first + j * TILE_ROW_PAIR);
        tile_store_certain(t, first + j * TILE_ROW_PAIR, &f, q.prim);
        undecided |= (uint64_t)spux_mask_bits(spu_andc(f.possible, f.certain)) << 16 * j;
    }
    counts->packet_tests++;
    counts->ray_tests += pairs * CGT_LANES;
    if (__builtin_expect(undecided != 0, 0))
        tile_queue_small_undecided(prims, t, s->prim[k], first, undecided, queue, counts);
}

#endif
