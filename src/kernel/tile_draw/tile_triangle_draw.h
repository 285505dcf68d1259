/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rasterises a triangle over the pixels of its window, without branches: pixels that it certainly wins are stored,
 * those that it may win are queued. tile_triangles.h has the formulas and their bounds. `kind` is a constant in every
 * call. */
#ifndef CGT_TILE_TRIANGLE_DRAW_H
#define CGT_TILE_TRIANGLE_DRAW_H

#include "kernel/tile_draw/tile_queue.h"
#include "kernel/tile_draw/tile_triangles.h"

/* One triangle as the vectors of the loops. */
typedef struct tile_triangle {
    vfloat side[3][3], plane[3], certain;
    vfloat depth_factor;                         /* linear: TILE_LINEAR_FACTOR */
    vfloat depth_error, minus_depth_error, a, b; /* not linear: the depth error, and the factors of N */
    vuint prim;
} tile_triangle;

CGT_SPU_INLINE tile_triangle tile_broadcast_triangle(const tile *t, const tile_triangles *s, int k, tile_kind kind)
{
    tile_triangle q = {.certain = spux_vfloat(s->certain[k]), .prim = spux_vuint(s->prim[k])};
    for (int i = 0; i < 3; i++) {
        q.plane[i] = spux_vfloat(s->plane[i][k]);
        for (int a = 0; a < 3; a++)
            q.side[i][a] = spux_vfloat(s->side[i][a][k]);
    }
    q.depth_factor = spux_vfloat((float)TILE_LINEAR_FACTOR);
    if (kind != TILE_LINEAR) {
        q.depth_error = spux_vfloat(t->padded_depth_error);
        q.minus_depth_error = spux_vfloat(-t->padded_depth_error);
        q.a = spux_vfloat(t->camera.a);
        q.b = spux_vfloat(t->camera.b);
    }
    return q;
}

/* The terms of a pair of rows for one triangle. */
typedef struct tile_triangle_row_pair {
    vfloat side[3], plane, minus_norm;
} tile_triangle_row_pair;

CGT_SPU_INLINE tile_triangle_row_pair tile_prepare_triangle_rows(const tile *t, const tile_triangle *q, uint32_t pair,
                                                                 tile_kind kind)
{
    const vfloat py = spux_load(t->py[pair]);
    tile_triangle_row_pair row = {.plane = spu_madd(py, q->plane[2], q->plane[0])};
    for (int k = 0; k < 3; k++)
        row.side[k] = spu_madd(py, q->side[k][2], q->side[k][0]);
    if (kind == TILE_PERSPECTIVE)
        row.minus_norm = spu_nmsub(spu_mul(py, py), q->b, spux_vfloat(-1));
    return row;
}

/* Tests a vector of pixels. NaN is neither certain nor possible: px is NaN beyond the tile. Inside the triangle's cone
 * no depth is NaN. */
CGT_SPU_INLINE tile_pixel_test tile_test_triangle(const tile_triangle *q, const tile_triangle_row_pair *row,
                                                  const float *columns, const float *best, tile_kind kind)
{
    const vfloat px = spux_load_unaligned(columns), z = spux_load_unaligned(best);
    const vfloat lower = tile_min3(spu_madd(px, q->side[0][1], row->side[0]), spu_madd(px, q->side[1][1], row->side[1]),
                                   spu_madd(px, q->side[2][1], row->side[2]));
    const vfloat plane = spu_madd(px, q->plane[1], row->plane);
    const vmask inside = spu_cmpgt(lower, q->certain), near = spux_cmpge(lower, spux_vfloat(0));
    if (kind == TILE_LINEAR)
        return (tile_pixel_test){.depth = plane,
                                 .certain = spu_and(inside, spu_cmpgt(z, spu_mul(plane, q->depth_factor))),
                                 .possible = spu_and(near, spux_cmpge(spu_mul(z, q->depth_factor), plane))};
    const vfloat depth =
        kind == TILE_PARALLEL ? plane : spux_div(spu_nmsub(spu_mul(px, px), q->a, row->minus_norm), plane);
    const vfloat depth_difference = spu_sub(depth, z);
    return (tile_pixel_test){.depth = depth,
                             .certain = spu_and(inside, spu_cmpgt(q->minus_depth_error, depth_difference)),
                             .possible = spu_and(near, spux_cmpge(q->depth_error, depth_difference))};
}

/* Rasterises `vectors` vectors in each of `pairs` pairs of rows, from the first pixels of `rect` on. Stores the
 * undecided lanes of each vector. Returns the union of them. */
CGT_SPU_INLINE unsigned tile_rasterise_triangle_rows(tile *t, const tile_triangle *q, uint32_t prim, tile_rect rect,
                                                     uint32_t vectors, uint32_t pairs, uint16_t *undecided,
                                                     tile_kind kind)
{
    const vuint slot = spux_vuint(t->triangle_count);
    unsigned any = 0;
    vmask certain_lanes = spux_mask_none();
    for (uint32_t p = 0; p < pairs; p++) {
        const uint32_t pair = rect.y0 / 2 + p;
        const tile_triangle_row_pair row = tile_prepare_triangle_rows(t, q, pair, kind);
        const float *px = t->px + 2 * rect.x0;
        uint32_t i = pair * TILE_ROW_PAIR + 2 * rect.x0;
        for (uint32_t w = 0; w < vectors; w++, i += CGT_LANES, px += CGT_LANES) {
            const tile_pixel_test f = tile_test_triangle(q, &row, px, t->z + i, kind);
            const unsigned undecided_lanes = spux_mask_bits(spu_andc(f.possible, f.certain));
            tile_store_certain(t, i, &f, q->prim);
            if (kind == TILE_LINEAR)
                tile_store_lanes(t->slot + i, slot, f.certain);
            certain_lanes = spu_or(certain_lanes, f.certain);
            any |= undecided_lanes;
            *undecided++ = (uint16_t)undecided_lanes;
        }
    }
    if (kind == TILE_LINEAR)
        tile_append_triangle(t, prim, spux_any(certain_lanes));
    return any;
}

/* Small triangles are rasterised without the branches of loops: a superfluous pair of rows costs less. */
CGT_SPU_INLINE void tile_rasterise_triangle_rect(const cgt_primitives *prims, tile *t, const tile_triangle *q,
                                                 uint32_t prim, tile_rect rect, tile_kind kind, tile_queue *queue,
                                                 cgt_counts *counts)
{
    const uint32_t vectors = (rect.x1 - rect.x0) / (CGT_LANES / 2) + 1;
    uint32_t pairs = rect.y1 / 2 - rect.y0 / 2 + 1;
    uint16_t undecided[TILE_MAX_VECTORS + 4];
    unsigned any;
    if (vectors == 1 && pairs <= 2) {
        const uint32_t last = TILE_EDGE - 4;
        rect.y0 = rect.y0 < last ? rect.y0 : last;
        rect.y1 = rect.y0 + 2;
        pairs = 2;
        any = tile_rasterise_triangle_rows(t, q, prim, rect, 1, 2, undecided, kind);
    } else if (vectors == 1) {
        any = tile_rasterise_triangle_rows(t, q, prim, rect, 1, pairs, undecided, kind);
    } else if (vectors == 2) {
        any = tile_rasterise_triangle_rows(t, q, prim, rect, 2, pairs, undecided, kind);
    } else {
        any = tile_rasterise_triangle_rows(t, q, prim, rect, vectors, pairs, undecided, kind);
    }
    counts->ray_tests += (uint64_t)vectors * pairs * CGT_LANES;
    if (any)
        CGT_KERNEL(cgt_tile_queue_undecided)(prims, t, prim, rect, vectors, undecided, queue, counts);
}

/* ---- large triangles ---- */

/* Upper bounds of a linear form in each of a vector of parts, from part i on. */
CGT_SPU_INLINE vfloat tile_part_upper_bounds(const tile *t, uint32_t i, float constant, float slope_x, float slope_y)
{
    const vfloat x = spux_vfloat(slope_x), y = spux_vfloat(slope_y);
    const vfloat middle =
        spu_madd(spux_load(t->part_x + i), x, spu_madd(spux_load(t->part_y + i), y, spux_vfloat(constant)));
    return spu_madd(spux_load(t->part_half_width + i), spux_abs(x),
                    spu_madd(spux_load(t->part_half_height + i), spux_abs(y), middle));
}

/* The parts, as bits, that a triangle may reach and in which its plane is not occluded. */
CGT_SPU_INLINE unsigned tile_visible_triangle_parts(const tile *t, const tile_triangles *s, int k)
{
    unsigned reached = 0;
    for (uint32_t i = 0; i < TILE_PARTS * TILE_PARTS; i += CGT_LANES) {
        const vfloat far_distance = spux_load(t->far_distance + i), speed = spux_vfloat(1 + 0x1p-16f);
        const vfloat far_t =
            spu_mul(t->linear ? far_distance : spu_mul(far_distance, spux_load(t->rlength + i)), speed);
        /* at most 1/t where that is above 0; -t of parallel rays */
        const vfloat upper = tile_part_upper_bounds(t, i, -s->plane[0][k], -s->plane[1][k], -s->plane[2][k]);
        vmask missed = t->parallel ? spu_cmpgt(spu_sub(spux_vfloat(0), upper), far_distance)
                                   : spu_cmpgt(spux_vfloat(1), spu_mul(upper, far_t));
        for (int e = 0; e < 3; e++) {
            const vfloat side = tile_part_upper_bounds(t, i, s->side[e][0][k], s->side[e][1][k], s->side[e][2][k]);
            missed = spu_or(missed, spu_cmpgt(spux_vfloat(-1), side));
        }
        reached |= (~spux_mask_bits(missed) & CGT_ALL_LANES) << i;
    }
    return reached;
}

/* A window of many parts: one rectangle in each row of parts, from the first to the last visible one. */
CGT_SPU_INLINE bool tile_rasterise_part_rows(const cgt_primitives *prims, tile *t, const tile_triangles *s, int k,
                                             tile_kind kind, tile_queue *queue, cgt_counts *counts)
{
    const tile_triangle q = tile_broadcast_triangle(t, s, k, kind);
    unsigned parts = tile_window_parts(&s->window, k) & tile_visible_parts(t, s->min_distance[k]);
    if (parts)
        parts &= tile_visible_triangle_parts(t, s, k);
    for (uint32_t v = 0; v < TILE_PARTS; v++) {
        const unsigned row_parts = parts >> 4 * v & 15;
        if (row_parts)
            tile_rasterise_triangle_rect(prims, t, &q, s->prim[k],
                                         tile_cut_window(&s->window, k, (uint32_t)__builtin_ctz(row_parts),
                                                         31 - (uint32_t)__builtin_clz(row_parts), v, v),
                                         kind, queue, counts);
    }
    return parts != 0;
}

__attribute__((noinline, unused)) static bool tile_rasterise_large_triangle(const cgt_primitives *prims, tile *t,
                                                                            const tile_triangles *s, int k,
                                                                            tile_queue *queue, cgt_counts *counts)
{
    switch (tile_get_kind(t)) {
    case TILE_LINEAR: return tile_rasterise_part_rows(prims, t, s, k, TILE_LINEAR, queue, counts);
    case TILE_PARALLEL: return tile_rasterise_part_rows(prims, t, s, k, TILE_PARALLEL, queue, counts);
    default: return tile_rasterise_part_rows(prims, t, s, k, TILE_PERSPECTIVE, queue, counts);
    }
}

/* Rasterises a triangle. Returns false if it is occluded everywhere. */
CGT_SPU_INLINE bool tile_rasterise_triangle(const cgt_primitives *prims, tile *t, const tile_triangles *s, int k,
                                            tile_kind kind, tile_queue *queue, cgt_counts *counts)
{
    counts->packet_tests++;
    if (!tile_window_is_small(&s->window, k))
        return tile_rasterise_large_triangle(prims, t, s, k, queue, counts);
    const tile_triangle q = tile_broadcast_triangle(t, s, k, kind);
    const tile_rect rect = tile_window_rect(&s->window, k);
    tile_rasterise_triangle_rect(prims, t, &q, s->prim[k], rect, kind, queue, counts);
    return true;
}

#endif
