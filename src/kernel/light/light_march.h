/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The march of a tile of points through a loose grid, from the light on, and the cells of a slice that the tile still
 * needs. Apart from light_grid.c, which includes it alone, for its length.
 *
 * A cell's box holds the bounds of all its primitives: low + i cell - reach to low + (i + 1) cell + reach, exactly
 * (model/loose_grid.h). It is projected as a cluster's box is (light_groups.h). With u = 2^-24 its middle is off by
 * 2 u (|low| + size cell), its half h by 2 u h, and LIGHT_CELL_SLACK of |low| + size cell + reach is more than that.
 * Middles lie within the scene's bounds and a cell, so all numbers of a box are at most those that the tile's margin
 * covers (M of light_packet.h) plus 3 h. What rounding makes of these 3 h, at most 2^-20 of them by the quotients and
 * 4 u by the rest, is below 2^-16 h, by which h is enlarged. A test tightens the first without the tile's margin. */
#ifndef CGT_LIGHT_MARCH_H
#define CGT_LIGHT_MARCH_H

#include "kernel/light/light_groups.h"
#include "kernel/tile/tile_march.h"

/* A table of the groups that are open is made once a chunk has met this many references, if they lie closer together
 * than an even scene's, which has about 8 in a cell: then much lies behind what is already hit. Measured: in a million
 * even spheres it spares a tenth of the references, and costs 4 %. */
#define LIGHT_TABLE_REFERENCES 4096u
#define LIGHT_TABLE_CROWDING 10u /* references in a cell */

/* A chunk's table is given up where, of so many references or more, it keeps a larger part than this. Measured. */
#define LIGHT_TABLE_TRIAL 4096u
#define LIGHT_TABLE_KEEPS 0.87f

#define LIGHT_CELL_SLACK (16 * FILTER_ROUNDOFF)       /* 2^-20 */
#define LIGHT_CELL_FACTOR (1 + 256 * FILTER_ROUNDOFF) /* 1 + 2^-16 */

/* ---- the march ---- */

/* The march's slopes and offsets, with the tile's margin as an offset. */
static inline void light_march_set_slopes(const light_tile *t, tile_march *m)
{
    const double margin = (double)t->margin;
    for (int k = 0; k < 2; k++) {
        const int a = (k ? m->v : m->u) == (uint32_t)t->packet[0].axis[1] ? 0 : 1;
        const double low = (double)t->lower[a], high = (double)t->upper[a], slope = (double)t->slope[a];
        m->slope_low[k] = t->is_point ? low : slope;
        m->slope_high[k] = t->is_point ? high : slope;
        m->base_low[k] = (t->is_point ? 0 : low) - margin;
        m->base_high[k] = (t->is_point ? 0 : high) + margin;
    }
}

/* The margin of a level's own coordinates, in its cells. */
static inline void light_march_add_margin(const cgt_loose_level *grid_level, tile_march_level *l)
{
    double magnitude = 0;
    for (int a = 0; a < 3; a++) {
        const double reach = (double)grid_level->reach[a], low = (double)grid_level->low[a];
        const double high = low + (double)grid_level->cell[a] * grid_level->size[a];
        magnitude = tile_max(magnitude, tile_max(fabs(low), fabs(high)) + reach);
    }
    for (int k = 0; k < 2; k++)
        l->cell_error[k] += magnitude * ((double)LIGHT_MARGIN * (1 + (double)LIGHT_MAX_SLOPE)) * l->rcell[k];
}

/* A w before all of the scene, by its size: whatever rounding does, nothing lies nearer to a light at infinity. */
static inline double light_march_begin(const light_tile *t)
{
    const light_packet *l = &t->packet[0];
    const int main = l->axis[0];
    const double origin = (double)l->origin[main], sign = (double)l->sign;
    const double one = ((double)t->committed_scene->low[main] - origin) * sign,
                 other = ((double)t->committed_scene->high[main] - origin) * sign;
    return tile_min(one, other) - fabs(one - other) - (double)t->margin;
}

static inline void light_march_init(const light_tile *t, tile_march *m)
{
    const light_packet *l = &t->packet[0];
    m->grid = &t->committed_scene->loose;
    m->w = (uint32_t)l->axis[0];
    m->u = m->w == 0 ? 1 : 0;
    m->v = m->w == 2 ? 1 : 2;
    m->forward = l->sign > 0;
    m->brute_force = false;
    m->rspeed = 1;
    m->start_low = t->is_point ? -(double)t->margin : light_march_begin(t); /* rays may end slightly behind the light */
    m->start_high = t->is_point ? 0 : m->start_low;
    light_march_set_slopes(t, m);
    for (uint32_t i = 0; i < m->grid->levels; i++) {
        tile_march_init_level(l->origin, m, &m->grid->level[i], &m->level[i]);
        if (t->is_wide)
            light_march_add_margin(&m->grid->level[i], &m->level[i]);
    }
}

/* ---- cells ---- */

/* The boxes of a slice's cells: of cell (i, k) of its rectangle, at most CGT_LANES of them at a time. */
typedef struct light_slice {
    const cgt_loose_level *grid_level;
    uint32_t axis[3]; /* w, u, v of the march */
    float middle_w;   /* of all cells */
    float half[3];    /* along x, y, z, enlarged */
    uint32_t width;   /* cells along u */
    uint32_t cells;   /* of the rectangle */
} light_slice;

static void light_slice_init(const tile_march *m, const tile_slice *s, light_slice *l)
{
    const cgt_loose_level *g = &m->grid->level[s->level];
    l->grid_level = g;
    l->axis[0] = m->w;
    l->axis[1] = m->u;
    l->axis[2] = m->v;
    l->middle_w = g->low[m->w] + ((float)s->cell + 0.5f) * g->cell[m->w];
    for (int a = 0; a < 3; a++) {
        const float slack = LIGHT_CELL_SLACK * (fabsf(g->low[a]) + (float)g->size[a] * g->cell[a] + g->reach[a]);
        l->half[a] = (0.5f * g->cell[a] + g->reach[a]) * LIGHT_CELL_FACTOR + slack;
    }
    l->width = s->high[0] - s->low[0] + 1;
    l->cells = l->width * (s->high[1] - s->low[1] + 1);
}

/* Columns and rows of a vector of cells from number `first` on, row by row. */
typedef struct light_cells {
    _Alignas(CGT_VECTOR_BYTES) float at[2][CGT_LANES];
    uint32_t position[2][CGT_LANES];
} light_cells;

CGT_SPU_INLINE void light_place_cells(const tile_slice *s, const light_slice *l, uint32_t first, light_cells *cells)
{
    uint32_t column = first % l->width, row = first / l->width;
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        cells->position[0][k] = s->low[0] + column;
        cells->position[1][k] = s->low[1] + row;
        for (int a = 0; a < 2; a++)
            cells->at[a][k] = (float)cells->position[a][k] + 0.5f;
        const bool ends = ++column == l->width;
        column = ends ? 0 : column;
        row += ends;
    }
}

/* The cells of a vector that the tile still needs, as bits. */
CGT_SPU_INLINE unsigned light_visible_cells(const light_tile *t, const light_slice *l, const light_cells *cells)
{
    const cgt_loose_level *g = l->grid_level;
    vfloat middle[3], half[3];
    light_windows windows;
    middle[l->axis[0]] = spux_vfloat(l->middle_w);
    for (int a = 0; a < 2; a++) {
        const uint32_t axis = l->axis[a + 1];
        middle[axis] = spu_madd(spux_load(cells->at[a]), spux_vfloat(g->cell[axis]), spux_vfloat(g->low[axis]));
    }
    for (int a = 0; a < 3; a++)
        half[a] = spux_vfloat(l->half[a]);
    return light_project_boxes(t, middle, half, true, &windows);
}

/* Queues the references of cells k to end - 1 of a vector, which lie side by side in the grid's arrays. */
CGT_SPU_INLINE void light_append_cells(light_tile *t, const tile_march *m, const tile_slice *s,
                                       const light_cells *cells, uint32_t k, uint32_t end, const prefetch_tests *tests)
{
    const cgt_loose_level *g = &m->grid->level[s->level];
    uint32_t position[3];
    position[m->w] = s->cell;
    position[m->u] = cells->position[0][k];
    position[m->v] = cells->position[1][k];
    const uint32_t cell = g->first + (position[2] * g->size[1] + position[1]) * g->size[0] + position[0];
    const uint32_t first = m->grid->start[cell], count = m->grid->start[cell + (end - k)] - first;
    t->table_kept += count;
    if (count)
        prefetch_append_run(&t->prefetch, tests, m->grid->prim + first, count);
}

/* Counts the references of the slice's cells. */
CGT_SPU_INLINE void light_count_slice(light_tile *t, const tile_march *m, const tile_slice *s)
{
    const uint32_t runs = tile_slice_run_count(m, s);
    for (uint32_t k = 0; k < runs; k++) {
        uint32_t count;
        tile_slice_get_run(m, s, k, &count);
        t->table_read += count;
    }
}

/* Whether the table spares little: then asking costs more. */
CGT_SPU_INLINE bool light_table_pays(const light_tile *t)
{
    return t->table_read < LIGHT_TABLE_TRIAL || (float)t->table_kept <= LIGHT_TABLE_KEEPS * (float)t->table_read;
}

/* Whether a table of open groups is likely to spare more than it costs. */
CGT_SPU_INLINE bool light_wants_table(const light_tile *t)
{
    return t->met_references >= LIGHT_TABLE_REFERENCES && t->met_references > LIGHT_TABLE_CROWDING * t->met_cells &&
           light_table_pays(t);
}

/* Queues the references of the slice's cells that the tile still needs. */
__attribute__((noinline)) static void light_append_slice(light_tile *t, const tile_march *m, const tile_slice *s,
                                                         const prefetch_tests *tests)
{
    light_slice l;
    light_slice_init(m, s, &l);
    light_count_slice(t, m, s);
    for (uint32_t first = 0; first < l.cells && !tests->is_done(t); first += CGT_LANES) {
        const uint32_t lanes = l.cells - first < CGT_LANES ? l.cells - first : CGT_LANES;
        light_cells cells;
        light_place_cells(s, &l, first, &cells);
        unsigned visible = light_visible_cells(t, &l, &cells) & (CGT_ALL_LANES >> (CGT_LANES - lanes));
        t->counts->cells += lanes;
        while (visible) {
            const uint32_t k = (uint32_t)__builtin_ctz(visible);
            uint32_t end = k + 1;
            /* neighbours along x are one run */
            while (m->u == 0 && end < lanes && visible >> end & 1 && cells.position[1][end] == cells.position[1][k])
                end++;
            light_append_cells(t, m, s, &cells, k, end, tests);
            visible &= ~((1u << end) - 1);
        }
    }
}

#endif
