/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Culls cells and clusters, as boxes, against a tile: a vector of boxes at a time, by their windows and by the distance
 * at which each part of the tile can still be hit. Primitives of culled cells are never read. Apart from tile_trace.c,
 * which inlines it, because of its bounds.
 *
 * In camera space (tile.h) a box is z, x, y of its middle and its half extents. It is in front of the eye if z exceeds
 * its half extent; its columns are then between the least and the largest x / z of its corners. With parallel rays a
 * box's columns are given by x alone, and the half extents include the error of origins.
 *
 * Rounding: u = 2^-24, c is the sum over the axes of all terms of a middle and its half extents. The middle, seen from
 * the eye, is off by 2 u c, its product with `dual` by another 4 u c, and a canonical direction by 3.5 u |d|, which is
 * 3.5 u c at the box; half extents and their products lose 4 u c. A column is a quotient of coordinates below c, of
 * which sums, reciprocal and products lose 12 u: as much as 12 u c of the coordinate. 2^-19 c = 32 u c is added to the
 * half extents, and 1/16 of a column to the windows (tile_spheres.h). Cells may be far from the eye: their c is that of
 * the whole grid. Products of boxes of a few of the least floats, with the eye next to them, underflow: 2^-60, as of
 * spheres, keeps such boxes from being in front.
 *
 * A test checks these bounds, and tightens them until it sees them break. */
#ifndef CGT_TILE_CULL_H
#define CGT_TILE_CULL_H

#include "kernel/primitive/gather_primitives.h"
#include "kernel/tile/tile_march.h"
#include "kernel/tile/tile_window.h"

#define TILE_EPS_BOX (32 * FILTER_ROUNDOFF) /* 2^-19 */

/* The columns (or rows) of boxes in front. r: the reciprocals of their least and largest z. */
CGT_SPU_INLINE vmask tile_compute_box_windows(const tile_span *span, vfloat middle, vfloat half, const vfloat r[2],
                                              uint32_t *from, uint32_t *to)
{
    const vfloat low = spu_sub(middle, half), high = spu_add(middle, half);
    const vfloat lower = spux_min(spu_mul(low, r[0]), spu_mul(low, r[1]));
    const vfloat upper = spux_max(spu_mul(high, r[0]), spu_mul(high, r[1]));
    const vfloat a = spu_mul(lower, spux_vfloat(span->scale)), b = spu_mul(upper, spux_vfloat(span->scale));
    return tile_compute_window(spu_sub(spux_min(a, b), spux_vfloat(span->first)),
                               spu_sub(spux_max(a, b), spux_vfloat(span->first)), span, from, to);
}

CGT_SPU_INLINE vmask tile_cull_parallel_boxes(const tile *t, const vfloat v[3], const vfloat half[3])
{
    tile_windows w;
    vmask large_windows;
    const vfloat min_distance = spu_sub(v[0], half[0]), far_z = spu_add(v[0], half[0]);
    const vmask outside = tile_compute_parallel_windows(t, v[1], v[2], half[1], half[2], &w);
    const vfloat far_distance = tile_window_far_distance(t, &w, &large_windows);
    const vmask occluded = spu_or(spu_cmpgt(min_distance, spux_vfloat(t->max_far_distance)),
                                  spu_andc(spu_cmpgt(min_distance, far_distance), large_windows));
    return spu_or(spu_cmpgt(spux_vfloat(0), far_z), spu_or(outside, occluded));
}

CGT_SPU_INLINE vmask tile_cull_perspective_boxes(const tile *t, const vfloat v[3], const vfloat half[3])
{
    tile_windows w;
    vfloat r[2];
    vmask large_windows;
    const vfloat near_z = spu_sub(v[0], half[0]), far_z = spu_add(v[0], half[0]);
    const vmask in_front = spu_cmpgt(near_z, spu_mul(half[0], spux_vfloat(0x1p-10f)));
    const vmask behind = spu_cmpgt(spux_vfloat(0), far_z);
    const vfloat min_distance = spu_mul(near_z, spux_vfloat(tile_min_distance_scale(t)));
    r[0] = spux_div(spux_vfloat(1), near_z);
    r[1] = spux_div(spux_vfloat(1), far_z);
    const vmask outside_x = tile_compute_box_windows(&t->column_span, v[1], half[1], r, w.x0, w.x1);
    const vmask outside_y = tile_compute_box_windows(&t->row_span, v[2], half[2], r, w.y0, w.y1);
    const vfloat far_distance = tile_window_far_distance(t, &w, &large_windows);
    const vmask occluded = spu_or(spu_cmpgt(min_distance, spux_vfloat(t->max_far_distance)),
                                  spu_andc(spu_cmpgt(min_distance, far_distance), large_windows));
    return spu_or(behind, spu_and(in_front, spu_or(spu_or(outside_x, outside_y), occluded)));
}

/* Boxes outside the tile or occluded. middle: from the eye, along the world's axes; half: along z, x, y of the
 * camera. */
CGT_SPU_INLINE vmask tile_cull_boxes(const tile *t, const vfloat middle[3], const vfloat half[3])
{
    const float(*dual)[3] = t->camera.dual;
    vfloat v[3];
    for (int k = 0; k < 3; k++)
        v[k] = spu_madd(middle[0], spux_vfloat(dual[k][0]),
                        spu_madd(middle[1], spux_vfloat(dual[k][1]), spu_mul(middle[2], spux_vfloat(dual[k][2]))));
    return t->parallel ? tile_cull_parallel_boxes(t, v, half) : tile_cull_perspective_boxes(t, v, half);
}

/* ---- clusters and cells ---- */

/* The visible ones of a vector of clusters, as bits. */
CGT_SPU_INLINE unsigned tile_visible_clusters(const tile *t, const cgt_cluster *cluster, const uint32_t *reference,
                                              uint32_t count)
{
    vfloat d[8], middle[3], half[3], sum = spux_vfloat(0);
    gather_cluster_list(cluster, reference, count, d);
    for (int a = 0; a < 3; a++) {
        middle[a] = spu_sub(d[a], spux_vfloat(t->rays->eye[a]));
        sum = spu_add(sum, spu_add(spux_abs(middle[a]), d[4 + a]));
    }
    const vfloat length_error = spu_madd(sum, spux_vfloat(TILE_EPS_BOX), spux_vfloat(t->length_error));
    for (int k = 0; k < 3; k++) {
        const float *dual = t->camera.dual[k];
        half[k] = spu_madd(
            d[4], spux_vfloat(fabsf(dual[0])),
            spu_madd(d[5], spux_vfloat(fabsf(dual[1])), spu_madd(d[6], spux_vfloat(fabsf(dual[2])), length_error)));
    }
    return ~spux_mask_bits(tile_cull_boxes(t, middle, half)) & first_lanes(count);
}

/* The cells of a slice, as boxes with the level's reach around them. */
typedef struct tile_cells {
    const tile_march *march;
    const tile_slice *slice;
    float middle[3]; /* of the first cell, from the eye */
    float step[3];   /* from cell to cell; 0 along the march */
    float half[3];   /* half extents along z, x, y */
    uint32_t row_length, count;
} tile_cells;

CGT_SPU_INLINE tile_cells tile_init_cells(const tile *t, const tile_march *m, const tile_slice *s)
{
    const cgt_loose_level *l = &m->grid->level[s->level];
    const uint32_t axis[2] = {m->u, m->v};
    tile_cells c = {.march = m, .slice = s, .row_length = s->high[0] - s->low[0] + 1};
    double position[3], sum = 0;
    position[m->w] = s->cell;
    c.count = c.row_length * (s->high[1] - s->low[1] + 1);
    for (int k = 0; k < 2; k++) {
        position[axis[k]] = s->low[k];
        c.step[axis[k]] = l->cell[axis[k]];
    }
    for (int a = 0; a < 3; a++) {
        const double low = (double)l->low[a] - (double)t->rays->eye[a], cell = (double)l->cell[a];
        c.middle[a] = (float)(low + (position[a] + 0.5) * cell);
        sum += fabs(low) + (l->size[a] + 1) * cell + (double)l->reach[a];
    }
    for (int k = 0; k < 3; k++) {
        double half = sum * (double)TILE_EPS_BOX + (double)t->length_error;
        for (int a = 0; a < 3; a++)
            half += fabs((double)t->camera.dual[k][a]) * (0.5 * (double)l->cell[a] + (double)l->reach[a]);
        c.half[k] = (float)half;
    }
    return c;
}

/* The visible ones of a vector of cells from number `first` on, row by row, as bits. */
CGT_SPU_INLINE unsigned tile_visible_cells(const tile *t, const tile_cells *c, uint32_t first)
{
    const uint32_t remaining = c->count - first;
    const vfloat number = spu_add(spu_convtf(spux_lane_index(), 0), spux_vfloat((float)first));
    /* counts are below 2^21: adding 1/2 keeps rounding away from whole numbers */
    const vfloat share = spu_mul(spu_add(number, spux_vfloat(0.5f)), spux_vfloat(1 / (float)c->row_length));
    const vfloat row = spu_convtf(spu_convts(share, 0), 0);
    const vfloat column = spu_nmsub(row, spux_vfloat((float)c->row_length), number);
    vfloat middle[3];
    for (uint32_t a = 0; a < 3; a++)
        middle[a] = a == c->march->w
                        ? spux_vfloat(c->middle[a])
                        : spu_madd(a == c->march->u ? column : row, spux_vfloat(c->step[a]), spux_vfloat(c->middle[a]));
    const vfloat half[3] = {spux_vfloat(c->half[0]), spux_vfloat(c->half[1]), spux_vfloat(c->half[2])};
    return ~spux_mask_bits(tile_cull_boxes(t, middle, half)) & first_lanes(remaining);
}

/* The index of cell i of the slice in the grid's `start`. */
CGT_SPU_INLINE uint32_t tile_cell_index(const tile_cells *c, uint32_t i)
{
    const cgt_loose_level *l = &c->march->grid->level[c->slice->level];
    uint32_t position[3];
    position[c->march->w] = c->slice->cell;
    position[c->march->u] = c->slice->low[0] + i % c->row_length;
    position[c->march->v] = c->slice->low[1] + i / c->row_length;
    return l->first + (position[2] * l->size[1] + position[1]) * l->size[0] + position[0];
}

#endif
