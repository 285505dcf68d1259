/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The cells of a loose grid that the rays of a tile may need, front to back. The march goes along w, the axis that the
 * rays mostly run along. All levels are marched together: the next slice of cells is always the one that begins
 * nearest.
 *
 * The primitives of a slice lie between two planes w = low and w = high: its cells, enlarged by the level's reach. Rays
 * start at the eye and none runs against the march. They are convex combinations of the corner rays, except for
 * rounding. So between the planes their other two coordinates lie between those of the corner rays. With the corner
 * rays' slopes m = d_u / d_w that is a rectangle of cells, again enlarged by the reach.
 *
 * Parallel rays have one slope and different origins. They start at a w between the least and the largest one of the
 * corner rays' origins, and their lines pass w = 0 between the corner rays' lines.
 *
 * Rounding: a canonical direction lies within 3.5 u |d| of the exact one, u = 2^-24, and its slope within
 * 3.5 u (1 + |m|) |d| / d_w of the combination's; 2^-21 = 8 u is taken for 3.5 u. A parallel ray's direction is exact,
 * its origin is off by at most u origin_error (tile.h), of which 2 u are taken. All other arithmetic is double; for its
 * rounding are 2^-48 of the largest number, 2^-20 of a cell and 2^-40 of a t. If the corner rays are too wide for these
 * bounds, all cells are visited.
 *
 * A test checks the bounds of directions and origins, and tightens them until it sees them break. Those of double are
 * far below. */
#ifndef CGT_TILE_MARCH_H
#define CGT_TILE_MARCH_H

#include "kernel/tile/tile.h"

#define TILE_EPS_MARCH (8 * FILTER_ROUNDOFF) /* 2^-21 */

/* A level, seen from the eye; w grows in the direction of the march, slices are numbered from 0. */
typedef struct tile_march_level {
    uint32_t next_slice, slices;   /* the number of the next one; how many */
    double begin, step, thickness; /* w where slice 0 begins; from slice to slice; of one, with the reach */
    /* of the other two axes: the grid's corner; cells per length; the reach and the rounding, in cells */
    double base[2], rcell[2], reach[2], cell_error[2];
} tile_march_level;

typedef struct tile_march {
    const cgt_loose_grid *grid;
    uint32_t w, u, v; /* axes, u < v */
    double slope_low[2], slope_high[2];
    double base_low[2], base_high[2]; /* parallel rays: where they pass w = 0, from the eye; else 0 */
    double start_low, start_high;     /* parallel rays: w where they start; else 0 */
    double rspeed;                    /* at most the t per length along w */
    bool forward;
    bool brute_force;
    tile_march_level level[CGT_LOOSE_LEVELS];
} tile_march;

/* The cells of one slice that the rays may need. */
typedef struct tile_slice {
    uint32_t level, cell; /* the number of its layer of cells along w */
    uint32_t low[2], high[2];
    double near_t; /* no ray hits a primitive of this or a later slice before this t */
} tile_slice;

CGT_SPU_INLINE double tile_min(double a, double b) { return a < b ? a : b; }
CGT_SPU_INLINE double tile_max(double a, double b) { return a > b ? a : b; }

/* The range of slopes and the largest speed, from the four corner rays. */
CGT_SPU_INLINE void tile_march_init_perspective(const tile *t, tile_march *m)
{
    const cgt_camera_rays *c = t->rays;
    const uint32_t axis[2] = {m->u, m->v};
    double d[4][3], lower = INFINITY, upper = 0;
    m->start_low = m->start_high = m->base_low[0] = m->base_low[1] = m->base_high[0] = m->base_high[1] = 0;
    for (uint32_t k = 0; k < 4; k++) {
        const double px = (double)t->column[k & 1 ? TILE_EDGE - 1 : 0], py = (double)t->row[k & 2 ? TILE_EDGE - 1 : 0];
        for (int a = 0; a < 3; a++)
            d[k][a] = ((double)c->fwd[a] + px * (double)c->right[a] + py * (double)c->up[a]) *
                      (m->forward || a != (int)m->w ? 1 : -1);
        lower = tile_min(lower, d[k][m->w]);
        upper = tile_max(upper, d[k][m->w]);
    }
    const double max_dir_length = (double)t->max_dir_length, share = max_dir_length / lower * (double)TILE_EPS_MARCH;
    m->brute_force = !(lower > 0x1p-6 * max_dir_length);
    m->rspeed = 1 / (upper + max_dir_length * (double)TILE_EPS_MARCH);
    for (int k = 0; k < 2; k++) {
        m->slope_low[k] = INFINITY;
        m->slope_high[k] = -INFINITY;
        for (int i = 0; i < 4; i++) {
            const double slope = d[i][axis[k]] / d[i][m->w], error = (1 + fabs(slope)) * share;
            m->slope_low[k] = tile_min(m->slope_low[k], slope - error);
            m->slope_high[k] = tile_max(m->slope_high[k], slope + error);
        }
    }
}

/* The same for parallel rays, from the origins at the corners. */
CGT_SPU_INLINE void tile_march_init_parallel(const tile *t, tile_march *m)
{
    const cgt_camera_rays *c = t->rays;
    const uint32_t axis[2] = {m->u, m->v};
    const double sign = m->forward ? 1 : -1, speed = fabs((double)c->fwd[m->w]),
                 off = (double)t->origin_error * (double)TILE_EPS_ORIGIN;
    m->brute_force = false;
    m->rspeed = 1 / speed;
    m->start_low = INFINITY;
    m->start_high = -INFINITY;
    for (int k = 0; k < 2; k++) {
        m->slope_low[k] = m->slope_high[k] = (double)c->fwd[axis[k]] / speed;
        m->base_low[k] = INFINITY;
        m->base_high[k] = -INFINITY;
    }
    for (uint32_t i = 0; i < 4; i++) {
        const double px = (double)t->column[i & 1 ? TILE_EDGE - 1 : 0], py = (double)t->row[i & 2 ? TILE_EDGE - 1 : 0];
        const double start = sign * (px * (double)c->right[m->w] + py * (double)c->up[m->w]);
        m->start_low = tile_min(m->start_low, start - off);
        m->start_high = tile_max(m->start_high, start + off);
        for (int k = 0; k < 2; k++) {
            const double position = px * (double)c->right[axis[k]] + py * (double)c->up[axis[k]];
            const double base = position - start * m->slope_low[k], error = off * (1 + fabs(m->slope_low[k]));
            m->base_low[k] = tile_min(m->base_low[k], base - error);
            m->base_high[k] = tile_max(m->base_high[k], base + error);
        }
    }
}

CGT_SPU_INLINE void tile_march_init_level(const float eye[3], const tile_march *m, const cgt_loose_level *grid_level,
                                          tile_march_level *l)
{
    const uint32_t w = m->w, axis[2] = {m->u, m->v};
    const double cell = (double)grid_level->cell[w], reach = (double)grid_level->reach[w];
    const double low = (double)grid_level->low[w] - (double)eye[w], length = cell * grid_level->size[w];
    const double rounding = (fabs(low) + length + reach) * 0x1p-48;
    l->slices = grid_level->prims ? grid_level->size[w] : 0;
    l->begin = (m->forward ? low : -(low + length)) - reach - rounding;
    l->step = cell;
    l->thickness = cell + 2 * (reach + rounding);
    /* skip the slices that end before the rays start */
    const double behind = m->brute_force ? -1 : (m->start_low - (l->begin + l->thickness)) / cell;
    l->next_slice = behind > 0 ? behind < l->slices ? (uint32_t)behind : l->slices : 0;
    const double end = tile_max(l->begin + l->slices * cell + l->thickness, -m->start_low);
    for (int k = 0; k < 2; k++) {
        const uint32_t a = axis[k];
        const double steepest = tile_max(fabs(m->slope_low[k]), fabs(m->slope_high[k]));
        l->rcell[k] = 1 / (double)grid_level->cell[a];
        l->base[k] = (double)grid_level->low[a] - (double)eye[a];
        l->reach[k] = (double)grid_level->reach[a] * l->rcell[k];
        const double base = fabs(l->base[k]) + fabs(m->base_low[k]) + fabs(m->base_high[k]);
        l->cell_error[k] =
            0x1p-20 + (end * steepest + base) * l->rcell[k] * 0x1p-48 + (grid_level->size[a] + l->reach[k]) * 0x1p-48;
    }
}

CGT_SPU_INLINE void tile_march_init(const tile *t, const cgt_loose_grid *grid, tile_march *m)
{
    const cgt_camera_rays *c = t->rays;
    const float px = 0.5f * (t->column[0] + t->column[TILE_EDGE - 1]), py = 0.5f * (t->row[0] + t->row[TILE_EDGE - 1]);
    float d[3];
    m->grid = grid;
    m->w = 0;
    for (uint32_t a = 0; a < 3; a++) {
        d[a] = t->parallel ? c->fwd[a] : c->fwd[a] + px * c->right[a] + py * c->up[a];
        m->w = fabsf(d[a]) > fabsf(d[m->w]) ? a : m->w;
    }
    m->u = m->w == 0 ? 1 : 0;
    m->v = m->w == 2 ? 1 : 2;
    m->forward = d[m->w] > 0;
    if (t->parallel)
        tile_march_init_parallel(t, m);
    else
        tile_march_init_perspective(t, m);
    for (uint32_t i = 0; i < grid->levels; i++)
        tile_march_init_level(c->eye, m, &grid->level[i], &m->level[i]);
}

/* The cells along axis k of a slice from near_w to far_w. Returns false if there are none. */
CGT_SPU_INLINE bool tile_march_compute_cells(const tile_march *m, const tile_march_level *l, int k, double near_w,
                                             double far_w, uint32_t size, tile_slice *s)
{
    s->low[k] = 0;
    s->high[k] = size - 1;
    if (m->brute_force)
        return true;
    const double low = tile_min(near_w * m->slope_low[k], far_w * m->slope_low[k]) + m->base_low[k];
    const double high = tile_max(near_w * m->slope_high[k], far_w * m->slope_high[k]) + m->base_high[k];
    const double margin = l->reach[k] + l->cell_error[k];
    const double first = (low - l->base[k]) * l->rcell[k] - margin - 1, end = size;
    const double last = (high - l->base[k]) * l->rcell[k] + margin;
    if (!(last >= 0) || !(first <= end))
        return !(last < 0) && !(first > end);
    if (first > 0) {
        s->low[k] = (uint32_t)first;
        s->low[k] += s->low[k] < first;
    }
    s->high[k] = last < size - 1 ? (uint32_t)last : size - 1;
    return s->low[k] <= s->high[k];
}

/* Finds the next slice with cells that the rays may need. Returns false at the end of the grid. */
CGT_SPU_INLINE bool tile_march_next_slice(tile_march *m, tile_slice *s)
{
    for (;;) {
        /* the level whose next slice begins nearest */
        double next_begin = INFINITY;
        s->level = CGT_LOOSE_LEVELS;
        for (uint32_t i = 0; i < m->grid->levels; i++) {
            const tile_march_level *l = &m->level[i];
            const double begin = l->begin + l->next_slice * l->step;
            if (l->next_slice < l->slices && (s->level == CGT_LOOSE_LEVELS || begin < next_begin)) {
                next_begin = begin;
                s->level = i;
            }
        }
        if (s->level == CGT_LOOSE_LEVELS)
            return false;
        /* its cells, if the rays meet any */
        tile_march_level *l = &m->level[s->level];
        const cgt_loose_level *grid_level = &m->grid->level[s->level];
        const double start = m->start_low, near_w = tile_max(next_begin, start),
                     far_w = tile_max(next_begin + l->thickness, start);
        s->cell = m->forward ? l->next_slice : l->slices - 1 - l->next_slice;
        s->near_t = m->brute_force ? 0 : tile_max(near_w - m->start_high, 0) * m->rspeed * (1 - 0x1p-40);
        l->next_slice++;
        if (tile_march_compute_cells(m, l, 0, near_w, far_w, grid_level->size[m->u], s) &&
            tile_march_compute_cells(m, l, 1, near_w, far_w, grid_level->size[m->v], s))
            return true;
    }
}

/* The number of runs of references of a slice. Cells along x lie side by side in the grid's arrays, so a row of them is
 * one run. */
CGT_SPU_INLINE uint32_t tile_slice_run_count(const tile_march *m, const tile_slice *s)
{
    const uint32_t rows = s->high[1] - s->low[1] + 1;
    return m->w == 0 ? rows * (s->high[0] - s->low[0] + 1) : rows;
}

/* Run number `run`: its references and their count. */
CGT_SPU_INLINE const uint32_t *tile_slice_get_run(const tile_march *m, const tile_slice *s, uint32_t run,
                                                  uint32_t *count)
{
    const cgt_loose_level *l = &m->grid->level[s->level];
    uint32_t position[3], end;
    if (m->w == 0) {
        const uint32_t width = s->high[0] - s->low[0] + 1;
        position[0] = end = s->cell;
        position[1] = s->low[0] + run % width;
        position[2] = s->low[1] + run / width;
    } else {
        position[0] = s->low[0];
        end = s->high[0];
        position[m->v] = s->low[1] + run;
        position[m->w] = s->cell;
    }
    const uint32_t row = l->first + (position[2] * l->size[1] + position[1]) * l->size[0];
    const uint32_t first = m->grid->start[row + position[0]];
    *count = m->grid->start[row + end + 1] - first;
    return m->grid->prim + first;
}

#endif
