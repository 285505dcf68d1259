/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A tile: up to 64x64 pixels of a camera that are traced together. Its state fits into the first-level cache.
 *
 * Each pixel has its closest primitive so far and a depth q. With N = 1 + |right|^2 px^2 + |up|^2 py^2, a number near
 * d.d that depends on the pixel alone, a hit's depth is q = t N. The exact q of a pixel's closest hit lies in
 * [z, z + depth_error], where depth_error is one number for the whole tile. A pixel without a hit has z at the end of
 * the camera's range. A pixel outside the region has z = -infinity and never gets a hit.
 *
 *   kind          when                     depth   exact depth lies in
 *   perspective   spheres, or both kinds   t N     [z, z + depth_error]
 *   linear        triangles only           -1/t    [z, z (1 - TILE_LINEAR_ERROR)]: relative, the same near and far
 *   parallel      orthographic camera      t       [z, z + depth_error]; N is 1
 * A linear depth is linear on the screen, and so cheaper to compute.
 *
 * Pixels are stored as pairs of rows, interleaved: (x, y) at y / 2 * 128 + 2 x + y % 2. A vector that starts at any
 * column holds CGT_LANES / 2 columns of two rows, whatever its width:
 *
 *   row y      0 2 4 6 8 ...  126
 *   row y + 1  1 3 5 7 9 ...  127       of rows y + 2 and y + 3: 128 and on */
#ifndef CGT_TILE_H
#define CGT_TILE_H

#include "kernel/primitive/filter.h"

#define TILE_EDGE 64u
#define TILE_PIXELS (TILE_EDGE * TILE_EDGE)
#define TILE_ROW_PAIR (2 * TILE_EDGE) /* pixels of a pair of rows */
#define TILE_PAD 16u                  /* a vector may start in the last column */
#define TILE_PARTS 4u                 /* parts of 16x16 pixels along an edge */
#define TILE_MAX_TRIANGLES 2048u      /* triangles that a tile lists */

/* The relative depth error of linear tiles. With a smaller one, single precision cannot decide planes that are seen at
 * a slant; with a larger one, more layers are too close to each other. */
#define TILE_LINEAR_ERROR 0x1p-9
#define TILE_LINEAR_FACTOR (1 - TILE_LINEAR_ERROR)

#define TILE_EPS_ORIGIN (2 * FILTER_ROUNDOFF)      /* times origin_error: of a parallel ray's origin */
#define TILE_FAR_FACTOR (1 + 16 * FILTER_ROUNDOFF) /* 1 + 2^-20, for a few roundings */

/* Which depths a tile has; a constant where functions are called. */
typedef enum tile_kind { TILE_PERSPECTIVE, TILE_LINEAR, TILE_PARALLEL } tile_kind;

/* The camera. Its axes are orthogonal except for rounding, which tile_limits.h checks. A point c' seen from the eye is
 * c' = z forward + x right / |right| + y up / |up|, where z, x, y are the products of c' and `dual`, the rows of the
 * inverse of exactly these axes. So a defect of the axes is an error of the metric only. */
typedef struct tile_camera {
    float dual[3][3];
    float right, up;   /* lengths */
    float a, b;        /* of N: squares of them, 0 where rays are parallel */
    float rright, rup; /* reciprocals */
} tile_camera;

/* An axis of the screen: x / z of camera space times `scale`, minus `first`, is a column (or row), counted from the
 * middle of the tile's first one. */
typedef struct tile_span {
    float scale, first;
    float pixels, last; /* their number, and that minus one */
} tile_span;

typedef struct tile {
    _Alignas(64) float z[TILE_PIXELS + TILE_PAD];
    _Alignas(64) uint32_t prim[TILE_PIXELS + TILE_PAD]; /* CGT_INVALID_ID: none yet */
    _Alignas(64) uint32_t slot[TILE_PIXELS + TILE_PAD]; /* linear: index of a pixel's primitive in `triangles` */
    _Alignas(64) float px[TILE_ROW_PAIR + TILE_PAD];    /* of a pair of rows; NaN beyond the tile */
    _Alignas(64) float py[TILE_EDGE / 2][CGT_LANES];    /* the two rows of a pair, alternating */
    /* of each part of 16x16 pixels: the farthest distance at which it can still be hit; anything beyond is occluded */
    _Alignas(64) float far_distance[TILE_PARTS * TILE_PARTS];
    _Alignas(64) float rlength[TILE_PARTS * TILE_PARTS]; /* at least 1 / sqrt(N) of any pixel of a part */
    float max_far_distance, max_far_t;                   /* the largest of all parts, as distance and as t */
    bool initialised;                                    /* false: z and prim are not set yet */
    bool linear;                                         /* depths are -1/t; far_distance is a t */
    bool parallel;                                       /* depths are t; all rays have one direction */
    _Alignas(64) float part_x[TILE_PARTS * TILE_PARTS];  /* the parts' middles, in px and py */
    _Alignas(64) float part_y[TILE_PARTS * TILE_PARTS];
    _Alignas(64) float part_half_width[TILE_PARTS * TILE_PARTS]; /* half their sizes, rounded up */
    _Alignas(64) float part_half_height[TILE_PARTS * TILE_PARTS];
    /* linear tiles: triangles that have been the closest one of a pixel; some have lost all of theirs since */
    _Alignas(64) uint32_t triangles[TILE_MAX_TRIANGLES + CGT_LANES];
    uint32_t triangle_count;                 /* TILE_MAX_TRIANGLES: too many to list */
    float column[TILE_EDGE], row[TILE_EDGE]; /* px and py; the last one is repeated beyond the region */
    uint32_t columns, rows;                  /* in the region */
    tile_span column_span, row_span;
    float span_ratio;                      /* ratio of their scales */
    float depth_error, padded_depth_error; /* padded: with the rounding of differences */
    float max_norm, min_norm;              /* bounds of N over all pixels */
    float max_dir_length;                  /* at least sqrt(max_norm) */
    float length_error;                    /* absolute error of lengths: underflow, and twice the error of origins */
    float origin_error;                    /* parallel rays: u times this bounds the error of an origin */
    float origin_offset;                   /* parallel rays: the largest distance of an origin from the eye */
    const cgt_camera_rays *rays;
    tile_camera camera;
    float axis[3], tangent, secant; /* a cone around all rays, as z, x, y; secant 0: they are too wide for one */
} tile;

CGT_SPU_INLINE uint32_t tile_column(uint32_t i) { return (i & (TILE_ROW_PAIR - 1)) >> 1; }
CGT_SPU_INLINE uint32_t tile_row(uint32_t i) { return i / TILE_ROW_PAIR * 2 + (i & 1); }
CGT_SPU_INLINE uint32_t tile_index(uint32_t x, uint32_t y) { return y / 2 * TILE_ROW_PAIR + 2 * x + (y & 1); }

CGT_SPU_INLINE double tile_norm(const tile *t, uint32_t i)
{
    const double px = (double)t->column[tile_column(i)], py = (double)t->row[tile_row(i)];
    return 1 + (double)t->camera.a * px * px + (double)t->camera.b * py * py;
}

CGT_SPU_INLINE tile_kind tile_get_kind(const tile *t)
{
    return t->linear ? TILE_LINEAR : t->parallel ? TILE_PARALLEL : TILE_PERSPECTIVE;
}

/* ---- the pixels ---- */

/* The z for a hit of pixel i at hit_t: the exact depth is in the middle of the interval that z stands for. A linear
 * depth stays finite, because -infinity would disable the pixel. */
CGT_SPU_INLINE float tile_compute_depth(const tile *t, uint32_t i, double hit_t)
{
    if (!t->linear)
        return (float)(hit_t * tile_norm(t, i) - 0.5 * (double)t->depth_error);
    const double depth = -1 / hit_t * (1 + 0.5 * TILE_LINEAR_ERROR);
    return hit_t > 0x1p-120 ? (float)depth : -0x1p120f;
}

/* An upper bound of the exact depth of a pixel with this z. */
CGT_SPU_INLINE double tile_depth_bound(const tile *t, double z)
{
    return t->linear ? z * TILE_LINEAR_FACTOR : z + (double)t->depth_error;
}

/* Recomputes far_distance of each part from its pixels' z. It is rounded three times, up to max_far_t five times. */
CGT_SPU_INLINE void tile_update_far_distances(tile *t)
{
    float max_far_distance = -INFINITY, max_far_t = -INFINITY;
    for (uint32_t k = 0; k < TILE_PARTS * TILE_PARTS; k++) {
        const float *part_z = t->z + k / TILE_PARTS * 8 * TILE_ROW_PAIR + k % TILE_PARTS * 32;
        vfloat upper = spux_vfloat(-INFINITY);
        for (uint32_t y = 0; y < 8; y++)
            for (uint32_t x = 0; x < 32; x += CGT_LANES)
                upper = spux_max(upper, spux_load(part_z + y * TILE_ROW_PAIR + x));
        const float z = spux_hmax(upper);
        if (t->linear)
            t->far_distance[k] =
                z < 0 ? (z == -INFINITY ? z : -TILE_FAR_FACTOR / (z * (float)TILE_LINEAR_FACTOR)) : INFINITY;
        else
            t->far_distance[k] = (z + t->padded_depth_error) * t->rlength[k] * TILE_FAR_FACTOR;
        const float far_t = t->linear ? t->far_distance[k] : t->far_distance[k] * t->rlength[k];
        max_far_distance = t->far_distance[k] > max_far_distance ? t->far_distance[k] : max_far_distance;
        max_far_t = far_t > max_far_t ? far_t : max_far_t;
    }
    t->max_far_distance = max_far_distance;
    t->max_far_t = max_far_t * TILE_FAR_FACTOR;
}

/* Disables the pixels of a vector that lie outside the region. */
CGT_SPU_INLINE void tile_disable_outside_pixels(tile *t, uint32_t first)
{
    if (tile_row(first) >= t->rows || tile_column(first) >= t->columns)
        spux_store(t->z + first, spux_vfloat(-INFINITY));
    else if (tile_row(first) + 1 >= t->rows || tile_column(first + CGT_LANES - 1) >= t->columns)
        for (uint32_t i = first; i < first + CGT_LANES; i++)
            if (tile_column(i) >= t->columns || tile_row(i) >= t->rows)
                t->z[i] = -INFINITY;
}

/* Sets all pixels to no hit, with an infinite range. */
CGT_SPU_INLINE void tile_clear_pixels(tile *t)
{
    t->initialised = true;
    for (uint32_t i = 0; i < TILE_PIXELS + TILE_PAD; i += CGT_LANES) {
        spux_store(t->z + i, spux_vfloat(INFINITY));
        spux_store_uint(t->prim + i, spux_vuint(CGT_INVALID_ID));
    }
}

/* Pixels start with the end of the range; those outside the region are disabled. far_t: no primitive is hit beyond this
 * t, so a larger end of the range is none. If all pixels would be set alike, that is deferred to the first visible
 * primitive (tile_ensure_pixels): many sky tiles never need it. */
CGT_SPU_INLINE void tile_init_pixels(tile *t, float far_t)
{
    const bool has_end = t->rays->t_max < far_t, full = t->columns == TILE_EDGE && t->rows == TILE_EDGE;
    t->triangle_count = 0;
    t->initialised = false;
    for (uint32_t k = 0; k < TILE_PARTS * TILE_PARTS; k++)
        t->far_distance[k] = INFINITY;
    t->max_far_distance = t->max_far_t = INFINITY;
    if (!has_end && full)
        return;
    tile_clear_pixels(t);
    if (has_end)
        for (uint32_t i = 0; i < TILE_PIXELS; i++)
            t->z[i] = t->linear ? tile_compute_depth(t, i, (double)t->rays->t_max)
                                : (float)((double)t->rays->t_max * tile_norm(t, i) * (1 - 0x1p-20));
    for (uint32_t i = 0; !full && i < TILE_PIXELS; i += CGT_LANES)
        tile_disable_outside_pixels(t, i);
    tile_update_far_distances(t);
}

/* To be called before the first primitive is rasterised. */
CGT_SPU_INLINE void tile_ensure_pixels(tile *t)
{
    if (!t->initialised)
        tile_clear_pixels(t);
}

/* Lists a triangle if it has become the closest one of a pixel; those pixels have the old triangle_count as their
 * slot. */
CGT_SPU_INLINE void tile_append_triangle(tile *t, uint32_t prim, bool won)
{
    t->triangles[t->triangle_count] = prim;
    t->triangle_count += won && t->triangle_count < TILE_MAX_TRIANGLES;
}

/* Makes a primitive the closest one of pixel i. */
CGT_SPU_INLINE void tile_set_closest(tile *t, uint32_t i, uint32_t prim)
{
    t->prim[i] = prim;
    if (!t->linear)
        return;
    if (!t->triangle_count || t->triangles[t->triangle_count - 1] != prim)
        tile_append_triangle(t, prim, true);
    t->slot[i] = t->triangle_count - 1;
}

/* The canonical directions for px and py, or origins of parallel rays, computed in the order of camera.h. */
CGT_SPU_INLINE void tile_compute_directions(const tile *t, bool parallel, vfloat px, vfloat py, vfloat dir[3])
{
    const cgt_camera_rays *c = t->rays;
    const float *from = parallel ? c->eye : c->fwd;
    for (int a = 0; a < 3; a++) {
        const vfloat column_sum = spu_add(spux_vfloat(from[a]), spu_mul(px, spux_vfloat(c->right[a])));
        dir[a] = spu_add(column_sum, spu_mul(py, spux_vfloat(c->up[a])));
    }
}

/* The canonical directions of `count` pixels, at most a vector; lanes beyond repeat the first. */
CGT_SPU_INLINE void tile_gather_directions(const tile *t, const uint16_t *pixel, uint32_t count, vfloat dir[3])
{
    _Alignas(CGT_VECTOR_BYTES) float px[CGT_LANES], py[CGT_LANES];
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        const uint32_t i = pixel[k < count ? k : 0];
        px[k] = t->column[tile_column(i)];
        py[k] = t->row[tile_row(i)];
    }
    tile_compute_directions(t, false, spux_load(px), spux_load(py), dir);
}

/* The canonical line of a pixel, computed in the order of camera.h. */
CGT_SPU_INLINE cgt_exact_ray tile_pixel_line(const cgt_camera_rays *c, bool parallel, float px, float py)
{
    const float *from = parallel ? c->eye : c->fwd;
    cgt_exact_ray line;
    for (int a = 0; a < 3; a++) {
        const float sum = (from[a] + px * c->right[a]) + py * c->up[a];
        line.org[a] = parallel ? sum : c->eye[a];
        line.dir[a] = parallel ? c->fwd[a] : sum;
    }
    return line;
}

CGT_SPU_INLINE cgt_ray tile_pixel_ray(const tile *t, uint32_t i)
{
    const cgt_camera_rays *c = t->rays;
    return (cgt_ray){.line = tile_pixel_line(c, c->orthographic, t->column[tile_column(i)], t->row[tile_row(i)]),
                     .t_min = c->t_min,
                     .t_max = c->t_max};
}

#endif
