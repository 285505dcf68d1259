/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which cells of a slice a tile wants: a vector of cells at a time, as boxes with the level's reach around them
 * (tile_cull.h). So objects of hidden cells are not read. Cells may be far from the eye: c is what the whole grid's
 * coordinates come to. */
#ifndef CGT_TILE_CELLS_H
#define CGT_TILE_CELLS_H

#include "kernel/tile_frame/tile_cull.h"
#include "kernel/tile/tile_march.h"

/* The cells of a slice, as the camera sees them. */
typedef struct tile_cells {
    const tile_march *march;
    const tile_slice *slice;
    float middle[3]; /* of the first one, from the eye */
    float step[3];   /* 0 along the march */
    float half[3];   /* extents along z, x, y */
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
        double half = sum * 0x1p-19 + (t->parallel ? (double)t->length_error : 0);
        for (int a = 0; a < 3; a++)
            half += fabs((double)t->camera.dual[k][a]) * (0.5 * (double)l->cell[a] + (double)l->reach[a]);
        c.half[k] = (float)half;
    }
    return c;
}

/* Of a vector of cells from cell `first` on, row by row, those that the tile wants, as bits. */
CGT_SPU_INLINE unsigned tile_visible_cells(const tile *t, const tile_cells *c, uint32_t first)
{
    const uint32_t remaining = c->count - first;
    const vfloat number = spu_add(spu_convtf(spux_lane_index(), 0), spux_vfloat((float)first));
    /* counts are below 2^21: 1/2 keeps what rounding does from whole numbers */
    const vfloat share = spu_mul(spu_add(number, spux_vfloat(0.5f)), spux_vfloat(1 / (float)c->row_length));
    const vfloat row = spu_convtf(spu_convts(share, 0), 0);
    const vfloat column = spu_nmsub(row, spux_vfloat((float)c->row_length), number);
    vfloat middle[3];
    for (uint32_t a = 0; a < 3; a++)
        middle[a] = a == c->march->w
                        ? spux_vfloat(c->middle[a])
                        : spu_madd(a == c->march->u ? column : row, spux_vfloat(c->step[a]), spux_vfloat(c->middle[a]));
    const vfloat half[3] = {spux_vfloat(c->half[0]), spux_vfloat(c->half[1]), spux_vfloat(c->half[2])};
    return ~spux_mask_bits(tile_cull_boxes(t, middle, half)) &
           (remaining < CGT_LANES ? (1u << remaining) - 1 : CGT_ALL_LANES);
}

/* Where cell i of the slice lies in the grid's `start`. */
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
