/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rasterises a sphere over the pixels of its window, without branches: pixels that it certainly wins are stored, those
 * that it may win are queued. tile_spheres.h has the formulas and their bounds. */
#ifndef CGT_TILE_SPHERE_DRAW_H
#define CGT_TILE_SPHERE_DRAW_H

#include "kernel/tile_draw/tile_queue.h"
#include "kernel/tile_draw/tile_spheres.h"

/* One sphere as the vectors of the loops. */
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

/* The terms of a vector of columns for one sphere. */
typedef struct tile_columns {
    vfloat dx, slope, q0;
} tile_columns;

CGT_SPU_INLINE tile_columns tile_prepare_columns(const tile_sphere *q, const float *columns)
{
    const vfloat px = spux_load_unaligned(columns), dx = spu_sub(px, q->X);
    return (tile_columns){.dx = dx, .slope = spu_nmsub(q->a, dx, q->dx), .q0 = spu_madd(px, q->qx, q->q0)};
}

/* The terms of a pair of rows for one sphere. */
typedef struct tile_row_pair {
    vfloat py, dy, d0;
} tile_row_pair;

CGT_SPU_INLINE tile_row_pair tile_prepare_rows(const tile *t, const tile_sphere *q, uint32_t pair)
{
    const vfloat py = spux_load(t->py[pair]), dy = spu_sub(py, q->Y);
    return (tile_row_pair){.py = py, .dy = dy, .d0 = spu_madd(dy, spu_nmsub(q->c, dy, q->dy), q->d0)};
}

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

/* Rasterises one or two vectors of columns from x on over all pairs of rows. Stores the undecided lanes of each vector,
 * `vectors` of which make a pair of rows. Returns the union of them. */
CGT_SPU_INLINE unsigned tile_rasterise_strip(tile *t, const tile_sphere *q, tile_rect rect, uint32_t x, uint32_t count,
                                             uint32_t vectors, uint16_t *undecided)
{
    unsigned any = 0;
    tile_columns c[2];
    for (uint32_t w = 0; w < count; w++)
        c[w] = tile_prepare_columns(q, t->px + 2 * x + w * CGT_LANES);
    for (uint32_t pair = rect.y0 / 2; pair <= rect.y1 / 2; pair++, undecided += vectors) {
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

/* The whole window: `vectors` vectors side by side in each pair of rows. */
CGT_SPU_INLINE unsigned tile_rasterise_windows(tile *t, const tile_sphere *q, tile_rect rect, uint32_t vectors,
                                               uint16_t *undecided)
{
    unsigned any = 0;
    uint32_t w = 0;
    for (; w + 2 <= vectors; w += 2)
        any |= tile_rasterise_strip(t, q, rect, rect.x0 + w * (CGT_LANES / 2), 2, vectors, undecided + w);
    if (w < vectors)
        any |= tile_rasterise_strip(t, q, rect, rect.x0 + w * (CGT_LANES / 2), 1, vectors, undecided + w);
    return any;
}

CGT_SPU_INLINE void tile_rasterise_sphere(const cgt_primitives *prims, tile *t, const tile_spheres *s, int k,
                                          tile_rect rect, tile_queue *queue, cgt_counts *counts)
{
    const tile_sphere q = tile_broadcast_sphere(t, s, k);
    const uint32_t vectors = (rect.x1 - rect.x0) / (CGT_LANES / 2) + 1, pairs = rect.y1 / 2 - rect.y0 / 2 + 1;
    uint16_t undecided[TILE_MAX_VECTORS + 4];
    unsigned any;
    switch (vectors) { /* small spheres: without the branches of a loop */
    case 1: any = tile_rasterise_windows(t, &q, rect, 1, undecided); break;
    case 2: any = tile_rasterise_windows(t, &q, rect, 2, undecided); break;
    default: any = tile_rasterise_windows(t, &q, rect, vectors, undecided); break;
    }
    counts->packet_tests++;
    counts->ray_tests += (uint64_t)vectors * pairs * CGT_LANES;
    if (any)
        CGT_KERNEL(cgt_tile_queue_undecided)(prims, t, s->prim[k], rect, vectors, undecided, queue, counts);
}

/* A small sphere (tile_spheres.h) of at most `pairs` pairs of rows. Always tests as many, which costs less than a
 * branch that cannot be predicted. The window is not cut to visible parts: it spans at most two along each axis, so
 * culling has tested them all. */
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
        CGT_KERNEL(cgt_tile_queue_small)(prims, t, s->prim[k], first, undecided, queue, counts);
}

#endif
