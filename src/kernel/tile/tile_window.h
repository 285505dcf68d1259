/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Windows: the columns and rows of a tile's pixels that a primitive or a box may reach, found for a vector of them at a
 * time, and the parts of 16x16 pixels under a window. Each part knows the farthest distance at which it can still be
 * hit (tile.h). A window that spans at most two parts along each axis has a corner in each part that it meets, so four
 * lookups tell whether all of it is occluded. */
#ifndef CGT_TILE_WINDOW_H
#define CGT_TILE_WINDOW_H

#include "kernel/tile/tile.h"

#define TILE_WINDOW_PAD (0x1p20f * FILTER_ROUNDOFF)   /* 1/16 */
#define TILE_EPS_MIN_DISTANCE (128 * FILTER_ROUNDOFF) /* 2^-17 */

/* ---- a vector of windows ---- */

/* Columns x0 to x1 and rows y0 to y1, both ends included. */
typedef struct tile_windows {
    _Alignas(64) uint32_t x0[CGT_LANES], x1[CGT_LANES], y0[CGT_LANES], y1[CGT_LANES];
} tile_windows;

/* The columns (or rows) from low to high, cut to the tile. Returns the lanes without any; their first and last are not
 * defined. */
CGT_SPU_INLINE vmask tile_compute_window(vfloat low, vfloat high, const tile_span *span, uint32_t *first,
                                         uint32_t *last)
{
    /* the first column above low - 1/16: the bounds ask for those from low - 1/32 on */
    const vfloat low_column = spux_max(spu_add(low, spux_vfloat(1 - TILE_WINDOW_PAD)), spux_vfloat(0));
    const vfloat to = spux_min(spu_add(high, spux_vfloat(TILE_WINDOW_PAD)), spux_vfloat(span->last));
    const vint from = spux_truncate(spux_min(low_column, spux_vfloat(span->pixels)));
    spux_store_uint(first, (vuint)from);
    spux_store_uint(last, (vuint)spux_truncate(to));
    return spu_cmpgt((vfloat)spu_convtf(from, 0), to);
}

/* The columns (or rows) from low to high that parallel rays see of what lies within half_width of x. */
CGT_SPU_INLINE void tile_compute_parallel_span(const tile_span *span, vfloat x, vfloat half_width, vfloat *low,
                                               vfloat *high)
{
    *low = spu_msub(spu_sub(x, half_width), spux_vfloat(span->scale), spux_vfloat(span->first));
    *high = spu_msub(spu_add(x, half_width), spux_vfloat(span->scale), spux_vfloat(span->first));
}

/* Windows of boxes in a tile of parallel rays. Returns the lanes without one. */
CGT_SPU_INLINE vmask tile_compute_parallel_windows(const tile *t, vfloat x, vfloat y, vfloat half_width,
                                                   vfloat half_height, tile_windows *w)
{
    vfloat low, top;
    tile_compute_parallel_span(&t->column_span, x, half_width, &low, &top);
    const vmask outside_x = tile_compute_window(low, top, &t->column_span, w->x0, w->x1);
    /* rows run down */
    tile_compute_parallel_span(&t->row_span, y, half_height, &top, &low);
    return spu_or(outside_x, tile_compute_window(low, top, &t->row_span, w->y0, w->y1));
}

/* Sets the windows of these lanes, as bits, to the whole tile. */
CGT_SPU_INLINE void tile_set_full_windows(const tile *t, unsigned lanes, tile_windows *w)
{
    for (; lanes; lanes &= lanes - 1) {
        const int k = __builtin_ctz(lanes);
        w->x0[k] = w->y0[k] = 0;
        w->x1[k] = t->columns - 1;
        w->y1[k] = t->rows - 1;
    }
}

/* z times this is at most the distance as far_distance counts it: t is z except for the rounding of the canonical
 * direction, 3.5 u |d| of it. |d| is at most 11.4 (CGT_TILE_MAX_EXTENT), 40 u together; root and products lose 3 u. */
CGT_SPU_INLINE float tile_min_distance_scale(const tile *t)
{
    return (t->linear ? 1 : sqrtf(t->min_norm)) * (1 - TILE_EPS_MIN_DISTANCE);
}

/* far_distance of the parts with these numbers; lanes without a window may have any number. */
CGT_SPU_INLINE vfloat tile_gather_far_distance(const tile *t, vuint part)
{
#if CGT_LANES == 16
    return spux_permute(spux_load(t->far_distance), part);
#else
    return spux_gather(t->far_distance, (vint)spu_and(part, spux_vuint(TILE_PARTS * TILE_PARTS - 1)));
#endif
}

/* The largest far_distance of the parts under the corners of windows. large_windows: those that span more than two
 * parts along an axis, so that the corners do not tell. */
CGT_SPU_INLINE vfloat tile_window_far_distance(const tile *t, const tile_windows *w, vmask *large_windows)
{
    const vuint row = spux_vuint(3 * TILE_PARTS), one = spux_vuint(1);
    const vuint left_part = spu_sr(spux_load_uint(w->x0), 4), right_part = spu_sr(spux_load_uint(w->x1), 4);
    const vuint y[2] = {spux_load_uint(w->y0), spux_load_uint(w->y1)};
    const vuint top = spu_and(spu_sr(y[0], 2), row), bottom = spu_and(spu_sr(y[1], 2), row);
    const vfloat above = spux_max(tile_gather_far_distance(t, spu_or(top, left_part)),
                                  tile_gather_far_distance(t, spu_or(top, right_part)));
    const vfloat below = spux_max(tile_gather_far_distance(t, spu_or(bottom, left_part)),
                                  tile_gather_far_distance(t, spu_or(bottom, right_part)));
    *large_windows =
        spu_or(spu_cmpgt(spu_sub(right_part, left_part), one), spu_cmpgt(spu_sub(bottom, top), spux_vuint(TILE_PARTS)));
    return spux_max(above, below);
}

/* ---- one window ---- */

typedef struct tile_rect {
    uint32_t x0, x1, y0, y1;
} tile_rect;

CGT_SPU_INLINE tile_rect tile_window_rect(const tile_windows *w, int k)
{
    return (tile_rect){.x0 = w->x0[k], .x1 = w->x1[k], .y0 = w->y0[k], .y1 = w->y1[k]};
}

/* The parts, as bits, in which something at this distance can still be visible. */
CGT_SPU_INLINE unsigned tile_visible_parts(const tile *t, float min_distance)
{
    unsigned visible = 0;
    for (uint32_t i = 0; i < TILE_PARTS * TILE_PARTS; i += CGT_LANES)
        visible |=
            (~spux_mask_bits(spu_cmpgt(spux_vfloat(min_distance), spux_load(t->far_distance + i))) & CGT_ALL_LANES)
            << i;
    return visible;
}

/* The parts under a window, as bits. */
CGT_SPU_INLINE unsigned tile_window_parts(const tile_windows *w, int k)
{
    const uint32_t u0 = w->x0[k] / 16, u1 = w->x1[k] / 16, v0 = w->y0[k] / 16, v1 = w->y1[k] / 16;
    const unsigned column_mask = (2u << u1) - (1u << u0), row_mask = (2u << 4 * v1) - (1u << 4 * v0);
    return column_mask * 0x1111u & (row_mask | row_mask << 1 | row_mask << 2 | row_mask << 3);
}

/* A window cut to columns u0 to u1 and rows v0 to v1 of parts. */
CGT_SPU_INLINE tile_rect tile_cut_window(const tile_windows *w, int k, uint32_t u0, uint32_t u1, uint32_t v0,
                                         uint32_t v1)
{
    const uint32_t x_first = 16 * u0, x_last = 16 * u1 + 15, y_first = 16 * v0, y_last = 16 * v1 + 15;
    return (tile_rect){.x0 = w->x0[k] > x_first ? w->x0[k] : x_first,
                       .x1 = w->x1[k] < x_last ? w->x1[k] : x_last,
                       .y0 = w->y0[k] > y_first ? w->y0[k] : y_first,
                       .y1 = w->y1[k] < y_last ? w->y1[k] : y_last};
}

/* Cuts a window to the box around its parts that can still see `min_distance`; false where none can. */
CGT_SPU_INLINE bool tile_clip_window(const tile *t, const tile_windows *w, int k, float min_distance, tile_rect *rect)
{
    const unsigned parts = tile_visible_parts(t, min_distance) & tile_window_parts(w, k);
    if (!parts)
        return false;
    const unsigned columns = (parts | parts >> 4 | parts >> 8 | parts >> 12) & 15;
    *rect = tile_cut_window(w, k, (uint32_t)__builtin_ctz(columns), 31 - (uint32_t)__builtin_clz(columns),
                            (uint32_t)__builtin_ctz(parts) / 4, (31 - (uint32_t)__builtin_clz(parts)) / 4);
    return true;
}

/* Whether a window has a corner in every part that it overlaps: then tile_window_far_distance has tested all of it. */
CGT_SPU_INLINE bool tile_window_is_small(const tile_windows *w, int k)
{
    return w->x1[k] / 16 - w->x0[k] / 16 <= 1 && w->y1[k] / 16 - w->y0[k] / 16 <= 1;
}

#endif
