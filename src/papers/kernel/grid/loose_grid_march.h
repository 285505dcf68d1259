/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which cells of a loose grid the rays of a packet may need, front to back. The packet's frustum (frustum.h) lives in a
 * space of its own, the bounds of all primitives, so that one frustum serves all levels. The march advances along its
 * main axis w through all levels together: the next slice of cells is always the one that begins nearest.
 *
 * A slice of cells holds primitives between two planes: those of its cells, moved outwards by the level's reach
 * (loose_grid.h). Rays meet no primitive outside the bounds of all, nor where the frustum does not pass these; between
 * the remaining planes the frustum's bounds are lines over w, so that their values at both ends give a rectangle of
 * cells, enlarged by the reach, too: a primitive that a ray meets touches it.
 *
 * Rounding. Planes and lines are brought to a level's cells in double and kept in float. Planes are within 2^-24 of the
 * largest number M on the way from level to slice, each 4 times; 2^-20 M is taken on either side. A line's value at a
 * plane is within 3 2^-24 of the sum of sizes of its terms; 2^-20 of that is taken off. Lines that are too steep for
 * float, in a level that is very small compared with the scene, bound nothing. */
#ifndef CGT_LOOSE_GRID_MARCH_H
#define CGT_LOOSE_GRID_MARCH_H

#include "papers/kernel/packet/frustum.h"

#define LOOSE_GRID_SPACE_CELLS 1024u /* divisions of the space: how near to its first ray the frustum begins */

/* A level, seen along the frustum; w counts from the frustum's w0. */
typedef struct loose_grid_march_level {
    vec_float4 bound, step, last_cells; /* lower bounds of cells u, -u, v, -v, as lines over w; the last cells */
    float begin, pitch;                 /* where primitives of slice 0 begin; from one slice to the next */
    float thickness;                    /* of a slice and its reach */
    uint32_t next, end;                 /* slices, counted along the rays */
} loose_grid_march_level;

typedef struct loose_grid_march {
    const cgt_loose_grid *grid;
    const frustum *frustum;
    float low, high; /* w of the part of the frustum that passes the space */
    loose_grid_march_level level[CGT_LOOSE_LEVELS];
} loose_grid_march;

/* Cells low to high of u, then of v. */
typedef struct loose_grid_slice {
    const cgt_loose_level *level;
    uint32_t w_cell; /* the cell along w */
    vec_int4 cells;
} loose_grid_slice;

/* The bounds of all primitives as a space, nowhere thinner than float can divide. */
CGT_SPU_INLINE void loose_grid_init_space(const cgt_committed_scene *committed_scene, frustum_space *s)
{
    double extent[3], largest = 0, magnitude = 0;
    for (int a = 0; a < 3; a++) {
        const double low = (double)committed_scene->low[a], high = (double)committed_scene->high[a];
        extent[a] = high - low;
        largest = extent[a] > largest ? extent[a] : largest;
        magnitude = -low > magnitude ? -low : magnitude;
        magnitude = high > magnitude ? high : magnitude;
    }
    double min_extent = largest * 0x1p-10 > magnitude * 0x1p-18 ? largest * 0x1p-10 : magnitude * 0x1p-18;
    min_extent = min_extent > 0x1p-50 ? min_extent : 0x1p-50;
    for (int a = 0; a < 3; a++) {
        const double padding = extent[a] < min_extent ? min_extent - extent[a] : 0;
        s->org[a] = (float)((double)committed_scene->low[a] - padding / 2);
        const double rest = (double)committed_scene->high[a] - (double)s->org[a];
        s->rcell[a] = (float)(LOOSE_GRID_SPACE_CELLS / (rest > min_extent ? rest : min_extent));
        /* 16 roundings of 2^-24 each, of the coordinate and of the point behind it */
        s->cell_error[a] = 0x1p-20f * ((float)LOOSE_GRID_SPACE_CELLS + (float)magnitude * s->rcell[a]);
        s->resolution[a] = LOOSE_GRID_SPACE_CELLS;
    }
}

/* The lines of axis k (0: u, 1: v) in the level's cells: with U = (x - org) R in the space, a point's cell coordinate
 * (x - low) / cell is U / (R cell) + (org - low) / cell. */
CGT_SPU_INLINE void loose_grid_march_init_lines(const loose_grid_march *m, const frustum_space *s,
                                                const cgt_loose_level *grid_level, int k, loose_grid_march_level *l)
{
    const frustum *f = m->frustum;
    const int axis = k ? f->v : f->u;
    const double rcell = 1 / (double)grid_level->cell[axis], scale = rcell / (double)s->rcell[axis];
    const double shift = ((double)s->org[axis] - (double)grid_level->low[axis]) * rcell;
    const double reach = (double)grid_level->reach[axis] * rcell;
    for (int i = 2 * k; i < 2 * k + 2; i++) {
        const double bound = scale * (double)f->bound[i], step = scale * (double)f->step[i];
        const double size = fabs(bound) + fabs(shift) + reach + fabs(step) * (double)m->high + 1;
        const double lower = bound + (i & 1 ? -shift : shift) - reach - size * 0x1p-20;
        const bool steep = !(size < 0x1p60);
        l->bound[i] = steep ? -0x1p24f : (float)lower;
        l->step[i] = steep ? 0 : (float)step;
    }
}

CGT_SPU_INLINE void loose_grid_march_init_slices(const loose_grid_march *m, const frustum_space *s,
                                                 const cgt_loose_level *grid_level, loose_grid_march_level *l)
{
    const frustum *f = m->frustum;
    const int w = f->w;
    const double r = (double)s->rcell[w], cell = (double)grid_level->cell[w], reach = (double)grid_level->reach[w];
    const double low = (double)grid_level->low[w] - (double)s->org[w], length = cell * grid_level->size[w];
    const double first =
        (f->reverse ? s->resolution[w] - (low + length + reach) * r : (low - reach) * r) - (double)f->w0;
    const double pitch = cell * r, thickness = (cell + 2 * reach) * r;
    const double error = (fabs(first) + length * r + thickness + s->resolution[w]) * 0x1p-20;
    const double begin = first - error, padded_thickness = thickness + 2 * error;
    const double first_slice = ((double)m->low - begin - padded_thickness) / pitch,
                 last = ((double)m->high - begin) / pitch + 1;
    l->begin = (float)begin;
    l->pitch = (float)pitch;
    l->thickness = (float)(padded_thickness + error);
    l->next = first_slice > 0 ? first_slice < grid_level->size[w] ? (uint32_t)first_slice : grid_level->size[w] : 0;
    l->end = last < grid_level->size[w] ? last > 0 ? (uint32_t)last : 0 : grid_level->size[w];
}

/* The frustum and its space do not change during the march. */
CGT_SPU_INLINE void loose_grid_march_init(const cgt_loose_grid *grid, const frustum_space *s, const frustum *f,
                                          loose_grid_march *m)
{
    m->grid = grid;
    m->frustum = f;
    m->level[0] = (loose_grid_march_level){0}; /* there is one, which the compiler cannot know */
    m->low = (float)f->first - f->w0;
    m->high = (float)f->end - f->w0;
    for (uint32_t i = 0; i < grid->levels; i++) {
        const cgt_loose_level *grid_level = &grid->level[i];
        loose_grid_march_level *l = &m->level[i];
        l->next = l->end = 0;
        l->last_cells = frustum_max_cells((float)(grid_level->size[f->u] - 1), (float)(grid_level->size[f->v] - 1));
        loose_grid_march_init_lines(m, s, grid_level, 0, l);
        loose_grid_march_init_lines(m, s, grid_level, 1, l);
        loose_grid_march_init_slices(m, s, grid_level, l);
    }
}

/* Cells of slice k of a level that the frustum may need. */
CGT_SPU_INLINE vec_int4 loose_grid_march_cells(const loose_grid_march *m, const loose_grid_march_level *l, uint32_t k)
{
    const float begin = l->begin + (float)k * l->pitch, end = begin + l->thickness;
    const float w_begin = begin > m->low ? begin : m->low, w_end = end < m->high ? end : m->high;
    return frustum_cells(spu_madd(l->step, spu_splats(w_begin), l->bound),
                         spu_madd(l->step, spu_splats(w_end), l->bound), l->last_cells);
}

/* The level whose next slice begins nearest, and where; NULL: none has any left. */
CGT_SPU_INLINE loose_grid_march_level *loose_grid_march_nearest(loose_grid_march *m, float *begin)
{
    loose_grid_march_level *nearest = NULL;
    for (uint32_t i = 0; i < m->grid->levels; i++) {
        loose_grid_march_level *l = &m->level[i];
        const float level_begin = l->begin + (float)l->next * l->pitch;
        if (l->next < l->end && (!nearest || level_begin < *begin)) {
            nearest = l;
            *begin = level_begin;
        }
    }
    return nearest;
}

CGT_SPU_INLINE loose_grid_slice loose_grid_march_next_slice(loose_grid_march *m, loose_grid_march_level *l)
{
    loose_grid_slice s = {.level = &m->grid->level[l - m->level], .cells = loose_grid_march_cells(m, l, l->next)};
    s.w_cell = m->frustum->reverse ? s.level->size[m->frustum->w] - 1 - l->next : l->next;
    l->next++;
    return s;
}

/* The primitives of cells (x, y, z) to (x + more, y, z). */
CGT_SPU_INLINE const uint32_t *loose_grid_cell_run(const cgt_loose_grid *grid, const cgt_loose_level *l, uint32_t x,
                                                   uint32_t y, uint32_t z, uint32_t extra, uint32_t *count)
{
    const uint32_t cell = l->first + (z * l->size[1] + y) * l->size[0] + x;
    const uint32_t first = grid->start[cell];
    *count = grid->start[cell + extra + 1] - first;
    return grid->prim + first;
}

#endif
