/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A triangle over the pixels of its window in a tile, without branches: what it certainly wins is kept, what it may win
 * is queued. tile_triangles.h says what is computed, and with which bounds. `kind` is a constant where these are
 * called. */
#ifndef CGT_TILE_TRIANGLE_DRAW_H
#define CGT_TILE_TRIANGLE_DRAW_H

#include "kernel/tile_draw/tile_sphere_draw.h"
#include "kernel/tile_draw/tile_triangles.h"

/* What the loops take of one triangle. */
typedef struct tile_triangle {
    vfloat side[3][3], plane[3], certain;
    vfloat kept;                 /* linear: what is kept of a depth at least */
    vfloat gap, minus_gap, a, b; /* not linear: the gap and N */
    vuint object;
} tile_triangle;

CGT_SPU_INLINE tile_triangle tile_triangle_get(const tile *t, const tile_triangles *s, int k, tile_kind kind)
{
    tile_triangle q = {.certain = spux_vfloat(s->certain[k]), .object = spux_vuint(s->object[k])};
    for (int i = 0; i < 3; i++) {
        q.plane[i] = spux_vfloat(s->plane[i][k]);
        for (int a = 0; a < 3; a++)
            q.side[i][a] = spux_vfloat(s->side[i][a][k]);
    }
    q.kept = spux_vfloat((float)TILE_KEPT);
    if (kind != TILE_LINEAR) {
        q.gap = spux_vfloat(t->wide_gap);
        q.minus_gap = spux_vfloat(-t->wide_gap);
        q.a = spux_vfloat(t->camera.a);
        q.b = spux_vfloat(t->camera.b);
    }
    return q;
}

/* What a pair of rows has in common for one triangle. */
typedef struct tile_triangle_pair {
    vfloat side[3], plane, minus_norm;
} tile_triangle_pair;

CGT_SPU_INLINE tile_triangle_pair tile_triangle_rows(const tile *t, const tile_triangle *q, uint32_t pair,
                                                     tile_kind kind)
{
    const vfloat py = spux_load(t->py[pair]);
    tile_triangle_pair row = {.plane = spu_madd(py, q->plane[2], q->plane[0])};
    for (int k = 0; k < 3; k++)
        row.side[k] = spu_madd(py, q->side[k][2], q->side[k][0]);
    if (kind == TILE_PERSPECTIVE)
        row.minus_norm = spu_nmsub(spu_mul(py, py), q->b, spux_vfloat(-1));
    return row;
}

/* The test of a vector of pixels. What is not a number is neither certain nor possible: the px beyond the tile. Within
 * the cone no depth is. */
CGT_SPU_INLINE tile_test tile_triangle_test(const tile_triangle *q, const tile_triangle_pair *row, const float *columns,
                                            const float *best, tile_kind kind)
{
    const vfloat px = spux_load_unaligned(columns), z = spux_load_unaligned(best);
    const vfloat least =
        tile_least(spu_madd(px, q->side[0][1], row->side[0]), spu_madd(px, q->side[1][1], row->side[1]),
                   spu_madd(px, q->side[2][1], row->side[2]));
    const vfloat plane = spu_madd(px, q->plane[1], row->plane);
    const vmask inside = spu_cmpgt(least, q->certain), near = spux_cmpge(least, spux_vfloat(0));
    if (kind == TILE_LINEAR)
        return (tile_test){.depth = plane,
                           .certain = spu_and(inside, spu_cmpgt(z, spu_mul(plane, q->kept))),
                           .possible = spu_and(near, spux_cmpge(spu_mul(z, q->kept), plane))};
    const vfloat depth =
        kind == TILE_PARALLEL ? plane : spux_div(spu_nmsub(spu_mul(px, px), q->a, row->minus_norm), plane);
    const vfloat behind = spu_sub(depth, z);
    return (tile_test){.depth = depth,
                       .certain = spu_and(inside, spu_cmpgt(q->minus_gap, behind)),
                       .possible = spu_and(near, spux_cmpge(q->gap, behind))};
}

/* So many windows side by side in so many pairs of rows, from the box's first ones on. Returns whether any lane is left
 * open; the lanes go to `open`. */
CGT_SPU_INLINE unsigned tile_triangle_windows(tile *t, const tile_triangle *q, uint32_t object, tile_box box,
                                              uint32_t windows, uint32_t pairs, uint16_t *open, tile_kind kind)
{
    const vuint slot = spux_vuint(t->lists);
    unsigned any = 0;
    vmask won = spux_mask_none();
    for (uint32_t p = 0; p < pairs; p++) {
        const uint32_t pair = box.y0 / 2 + p;
        const tile_triangle_pair row = tile_triangle_rows(t, q, pair, kind);
        const float *px = t->px + 2 * box.x0;
        uint32_t i = pair * TILE_PAIR + 2 * box.x0;
        for (uint32_t w = 0; w < windows; w++, i += CGT_LANES, px += CGT_LANES) {
            const tile_test f = tile_triangle_test(q, &row, px, t->z + i, kind);
            const unsigned left = spux_mask_bits(spu_andc(f.possible, f.certain));
            tile_keep(t, i, &f, q->object);
            if (kind == TILE_LINEAR)
                tile_keep_lanes(t->slot + i, slot, f.certain);
            won = spu_or(won, f.certain);
            any |= left;
            *open++ = (uint16_t)left;
        }
    }
    if (kind == TILE_LINEAR)
        tile_list(t, object, spux_any(won));
    return any;
}

/* Small triangles go without the branches of loops: pairs of rows more than they need cost less. */
CGT_SPU_INLINE void tile_triangle_box(const cgt_objects *objects, tile *t, const tile_triangle *q, uint32_t object,
                                      tile_box box, tile_kind kind, tile_queue *queue, cgt_counts *counts)
{
    const uint32_t windows = (box.x1 - box.x0) / (CGT_LANES / 2) + 1;
    uint32_t pairs = box.y1 / 2 - box.y0 / 2 + 1;
    uint16_t open[TILE_WINDOWS + 4];
    unsigned any;
    if (windows == 1 && pairs <= 2) {
        const uint32_t last = TILE_EDGE - 4;
        box.y0 = box.y0 < last ? box.y0 : last;
        box.y1 = box.y0 + 2;
        pairs = 2;
        any = tile_triangle_windows(t, q, object, box, 1, 2, open, kind);
    } else if (windows == 1) {
        any = tile_triangle_windows(t, q, object, box, 1, pairs, open, kind);
    } else if (windows == 2) {
        any = tile_triangle_windows(t, q, object, box, 2, pairs, open, kind);
    } else {
        any = tile_triangle_windows(t, q, object, box, windows, pairs, open, kind);
    }
    counts->ray_tests += (uint64_t)windows * pairs * CGT_LANES;
    if (any)
        tile_sphere_queue(objects, t, object, box, windows, open, queue, counts);
}

/* ---- large triangles ---- */

/* The most that a linear form comes to in each of a vector of parts, from part i on. */
CGT_SPU_INLINE vfloat tile_parts_most(const tile *t, uint32_t i, float at0, float atx, float aty)
{
    const vfloat x = spux_vfloat(atx), y = spux_vfloat(aty);
    const vfloat middle =
        spu_madd(spux_load(t->part_x + i), x, spu_madd(spux_load(t->part_y + i), y, spux_vfloat(at0)));
    return spu_madd(spux_load(t->part_wide + i), spux_abs(x),
                    spu_madd(spux_load(t->part_high + i), spux_abs(y), middle));
}

/* The parts, as bits, that a triangle may reach and that look as far as its plane is there. */
CGT_SPU_INLINE unsigned tile_triangle_parts(const tile *t, const tile_triangles *s, int k)
{
    unsigned reached = 0;
    for (uint32_t i = 0; i < TILE_PARTS * TILE_PARTS; i += CGT_LANES) {
        const vfloat far = spux_load(t->far + i), speed = spux_vfloat(1 + 0x1p-16f);
        const vfloat far_t = spu_mul(t->linear ? far : spu_mul(far, spux_load(t->rlength + i)), speed);
        /* 1/t at most, where that is above 0; -t of parallel rays */
        const vfloat most = tile_parts_most(t, i, -s->plane[0][k], -s->plane[1][k], -s->plane[2][k]);
        vmask missed = t->parallel ? spu_cmpgt(spu_sub(spux_vfloat(0), most), far)
                                   : spu_cmpgt(spux_vfloat(1), spu_mul(most, far_t));
        for (int e = 0; e < 3; e++) {
            const vfloat side = tile_parts_most(t, i, s->side[e][0][k], s->side[e][1][k], s->side[e][2][k]);
            missed = spu_or(missed, spu_cmpgt(spux_vfloat(-1), side));
        }
        reached |= (~spux_mask_bits(missed) & CGT_ALL_LANES) << i;
    }
    return reached;
}

/* The parts under a window, as bits. */
CGT_SPU_INLINE unsigned tile_window_parts(const tile_triangles *s, int k)
{
    const uint32_t u0 = s->x0[k] / 16, u1 = s->x1[k] / 16, v0 = s->y0[k] / 16, v1 = s->y1[k] / 16;
    const unsigned across = (2u << u1) - (1u << u0), down = (2u << 4 * v1) - (1u << 4 * v0);
    return across * 0x1111u & (down | down << 1 | down << 2 | down << 3);
}

/* The part of a window in one row of parts, from the first to the last of the parts there. */
CGT_SPU_INLINE tile_box tile_row_box(const tile_triangles *s, int k, uint32_t v, unsigned parts)
{
    const uint32_t left = 16 * (uint32_t)__builtin_ctz(parts), right = 16 * (31 - (uint32_t)__builtin_clz(parts)) + 15;
    const uint32_t top = 16 * v, bottom = top + 15;
    return (tile_box){.x0 = s->x0[k] > left ? s->x0[k] : left,
                      .x1 = s->x1[k] < right ? s->x1[k] : right,
                      .y0 = s->y0[k] > top ? s->y0[k] : top,
                      .y1 = s->y1[k] < bottom ? s->y1[k] : bottom};
}

/* A window with a corner in every part that it meets: whether the tile is open there was asked of the whole vector. */
CGT_SPU_INLINE bool tile_window_small(const tile_triangles *s, int k)
{
    return s->x1[k] / 16 - s->x0[k] / 16 <= 1 && s->y1[k] / 16 - s->y0[k] / 16 <= 1;
}

CGT_SPU_INLINE bool tile_triangle_rows_of_parts(const cgt_objects *objects, tile *t, const tile_triangles *s, int k,
                                                tile_kind kind, tile_queue *queue, cgt_counts *counts)
{
    const tile_triangle q = tile_triangle_get(t, s, k, kind);
    unsigned parts = tile_window_parts(s, k) & tile_parts_open(t, s->nearest[k]);
    if (parts)
        parts &= tile_triangle_parts(t, s, k);
    for (uint32_t v = 0; v < TILE_PARTS; v++) {
        const unsigned here = parts >> 4 * v & 15;
        if (here)
            tile_triangle_box(objects, t, &q, s->object[k], tile_row_box(s, k, v, here), kind, queue, counts);
    }
    return parts != 0;
}

__attribute__((noinline, unused)) static bool tile_triangle_draw_large(const cgt_objects *objects, tile *t,
                                                                       const tile_triangles *s, int k,
                                                                       tile_queue *queue, cgt_counts *counts)
{
    switch (tile_kind_of(t)) {
    case TILE_LINEAR: return tile_triangle_rows_of_parts(objects, t, s, k, TILE_LINEAR, queue, counts);
    case TILE_PARALLEL: return tile_triangle_rows_of_parts(objects, t, s, k, TILE_PARALLEL, queue, counts);
    default: return tile_triangle_rows_of_parts(objects, t, s, k, TILE_PERSPECTIVE, queue, counts);
    }
}

/* Draws a triangle where the tile is open for it; false where it is not. */
CGT_SPU_INLINE bool tile_triangle_draw(const cgt_objects *objects, tile *t, const tile_triangles *s, int k,
                                       tile_kind kind, tile_queue *queue, cgt_counts *counts)
{
    counts->packet_tests++;
    if (!tile_window_small(s, k))
        return tile_triangle_draw_large(objects, t, s, k, queue, counts);
    const tile_triangle q = tile_triangle_get(t, s, k, kind);
    const tile_box box = {.x0 = s->x0[k], .x1 = s->x1[k], .y0 = s->y0[k], .y1 = s->y1[k]};
    tile_triangle_box(objects, t, &q, s->object[k], box, kind, queue, counts);
    return true;
}

#endif
