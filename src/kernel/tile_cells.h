/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which cells of a slice a tile wants: a vector of cells at a time, as boxes with the level's reach around them, against
 * the tile's window and what its parts still see. So objects of hidden cells are not read.
 *
 * In camera space (tile.h) a box is z, x, y of its middle and half its extents along those. All of it is in front of the
 * eye where z is above its extent; the columns under it are then between the least and the most of x / z of its ends.
 * Of parallel rays, any box's are those under x, and its extents have what origins are off by in them.
 *
 * Rounding, with u = 2^-24 and c the sum over the axes of all that a middle is made of, far from the eye as the grid may
 * be: the middle is off by 2 u c, its product with `dual` by 4 u c more, and a canonical direction by 3.5 u |d|, which is
 * 3.5 u c where a box is. 2^-19 c is added to the extents, and 1/16 of a column to the windows (tile_spheres.h). */
#ifndef CGT_TILE_CELLS_H
#define CGT_TILE_CELLS_H

#include "tile_march.h"
#include "tile_parallel_spheres.h"
#include "tile_triangles.h"

/* The cells of a slice, as the camera sees them. */
typedef struct tile_cells {
    const tile_march *march;
    const tile_slice *slice;
    float middle[3]; /* of the first one, from the eye */
    float step[3];   /* 0 along the march */
    float half[3];   /* extents along z, x, y */
    uint32_t across, count;
} tile_cells;

CGT_SPU_INLINE tile_cells tile_cells_make(const tile *t, const tile_march *m, const tile_slice *s)
{
    const cgt_loose_level *l = &m->grid->level[s->level];
    const uint32_t axis[2] = {m->u, m->v};
    tile_cells c = {.march = m, .slice = s, .across = s->high[0] - s->low[0] + 1};
    double at[3], sum = 0;
    at[m->w] = s->cell;
    c.count = c.across * (s->high[1] - s->low[1] + 1);
    for (int k = 0; k < 2; k++) {
        at[axis[k]] = s->low[k];
        c.step[axis[k]] = l->cell[axis[k]];
    }
    for (int a = 0; a < 3; a++) {
        const double low = (double)l->low[a] - (double)t->rays->eye[a], cell = (double)l->cell[a];
        c.middle[a] = (float)(low + (at[a] + 0.5) * cell);
        sum += fabs(low) + (l->size[a] + 1) * cell + (double)l->reach[a];
    }
    for (int k = 0; k < 3; k++) {
        double half = sum * 0x1p-19 + (t->parallel ? (double)t->slack : 0);
        for (int a = 0; a < 3; a++)
            half += fabs((double)t->camera.dual[k][a]) * (0.5 * (double)l->cell[a] + (double)l->reach[a]);
        c.half[k] = (float)half;
    }
    return c;
}

/* The columns or rows, from the tile's first, that boxes in front cover; r: the reciprocals of their least and most z. */
CGT_SPU_INLINE vmask tile_cells_window(const tile_span *of, vfloat middle, float half, const vfloat r[2],
                                       uint32_t *from, uint32_t *to)
{
    const vfloat low = spu_sub(middle, spux_vfloat(half)), high = spu_add(middle, spux_vfloat(half));
    const vfloat least = spux_min(spu_mul(low, r[0]), spu_mul(low, r[1]));
    const vfloat most = spux_max(spu_mul(high, r[0]), spu_mul(high, r[1]));
    const vfloat a = spu_mul(least, spux_vfloat(of->scale)), b = spu_mul(most, spux_vfloat(of->scale));
    return tile_window(spu_sub(spux_min(a, b), spux_vfloat(of->first)), spu_sub(spux_max(a, b), spux_vfloat(of->first)),
                       of, from, to);
}

CGT_SPU_INLINE void tile_cells_seen(const tile *t, const vfloat middle[3], vfloat v[3])
{
    const float(*dual)[3] = t->camera.dual;
    for (int k = 0; k < 3; k++)
        v[k] = spu_madd(middle[0], spux_vfloat(dual[k][0]),
                        spu_madd(middle[1], spux_vfloat(dual[k][1]), spu_mul(middle[2], spux_vfloat(dual[k][2]))));
}

/* Boxes that a tile of parallel rays does not want. */
CGT_SPU_INLINE vmask tile_parallel_cells_unwanted(const tile *t, const tile_cells *c, const vfloat middle[3])
{
    _Alignas(64) uint32_t x0[CGT_LANES], x1[CGT_LANES], y0[CGT_LANES], y1[CGT_LANES];
    vfloat v[3];
    vmask apart;
    tile_cells_seen(t, middle, v);
    const vfloat nearest = spu_sub(v[0], spux_vfloat(c->half[0])), far = spu_add(v[0], spux_vfloat(c->half[0]));
    const vmask outside =
        tile_parallel_windows(t, v[1], v[2], spux_vfloat(c->half[1]), spux_vfloat(c->half[2]), x0, x1, y0, y1);
    const vfloat seen = tile_windows_far(t, x0, x1, y0, y1, &apart);
    const vmask hidden =
        spu_or(spu_cmpgt(nearest, spux_vfloat(t->farthest)), spu_andc(spu_cmpgt(nearest, seen), apart));
    return spu_or(spu_cmpgt(spux_vfloat(0), far), spu_or(outside, hidden));
}

/* Boxes that the tile does not want. */
CGT_SPU_INLINE vmask tile_cells_unwanted(const tile *t, const tile_cells *c, const vfloat middle[3])
{
    _Alignas(64) uint32_t x0[CGT_LANES], x1[CGT_LANES], y0[CGT_LANES], y1[CGT_LANES];
    vfloat v[3], r[2];
    vmask apart;
    tile_cells_seen(t, middle, v);
    const vfloat near = spu_sub(v[0], spux_vfloat(c->half[0])), far = spu_add(v[0], spux_vfloat(c->half[0]));
    const vmask front = spu_cmpgt(near, spux_vfloat(c->half[0] * 0x1p-10f)), behind = spu_cmpgt(spux_vfloat(0), far);
    const vfloat nearest = spu_mul(near, spux_vfloat(tile_nearest_scale(t)));
    r[0] = spux_div(spux_vfloat(1), near);
    r[1] = spux_div(spux_vfloat(1), far);
    const vmask beside = tile_cells_window(&t->across, v[1], c->half[1], r, x0, x1);
    const vmask above = tile_cells_window(&t->down, v[2], c->half[2], r, y0, y1);
    const vfloat seen = tile_windows_far(t, x0, x1, y0, y1, &apart);
    const vmask hidden =
        spu_or(spu_cmpgt(nearest, spux_vfloat(t->farthest)), spu_andc(spu_cmpgt(nearest, seen), apart));
    return spu_or(behind, spu_and(front, spu_or(spu_or(beside, above), hidden)));
}

/* Of a vector of cells from cell `first` on, row by row, those that the tile wants, as bits. */
CGT_SPU_INLINE unsigned tile_cells_wanted(const tile *t, const tile_cells *c, uint32_t first)
{
    const uint32_t left = c->count - first;
    const vfloat number = spu_add(spu_convtf(spux_lane_index(), 0), spux_vfloat((float)first));
    /* counts are below 2^21: 1/2 keeps what rounding does from whole numbers */
    const vfloat share = spu_mul(spu_add(number, spux_vfloat(0.5f)), spux_vfloat(1 / (float)c->across));
    const vfloat row = spu_convtf(spu_convts(share, 0), 0);
    const vfloat column = spu_nmsub(row, spux_vfloat((float)c->across), number);
    vfloat middle[3];
    for (uint32_t a = 0; a < 3; a++)
        middle[a] = a == c->march->w
                        ? spux_vfloat(c->middle[a])
                        : spu_madd(a == c->march->u ? column : row, spux_vfloat(c->step[a]), spux_vfloat(c->middle[a]));
    const vmask unwanted = t->parallel ? tile_parallel_cells_unwanted(t, c, middle) : tile_cells_unwanted(t, c, middle);
    return ~spux_mask_bits(unwanted) & (left < CGT_LANES ? (1u << left) - 1 : CGT_ALL_LANES);
}

/* Where cell i of the slice lies in the grid's `start`. */
CGT_SPU_INLINE uint32_t tile_cells_index(const tile_cells *c, uint32_t i)
{
    const cgt_loose_level *l = &c->march->grid->level[c->slice->level];
    uint32_t at[3];
    at[c->march->w] = c->slice->cell;
    at[c->march->u] = c->slice->low[0] + i % c->across;
    at[c->march->v] = c->slice->low[1] + i / c->across;
    return l->first + (at[2] * l->size[1] + at[1]) * l->size[0] + at[0];
}

#endif
