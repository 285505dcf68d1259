/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A tile: up to 64x64 pixels of a camera, traced together, with all that is kept of them small enough for the first
 * cache.
 *
 * Per pixel an object and a depth q are kept. With N = 1 + |right|^2 px^2 + |up|^2 py^2, a number near d.d that is the
 * same for all objects, a hit's depth is q = t N. The exact q of a pixel's best hit lies in [z, z + gap], where gap is
 * one number for the whole tile. A pixel without a hit has the end of the camera's range there; a pixel beyond the
 * region has -infinity, and takes no part.
 *
 * Where a scene has triangles alone, the depth is -1/t: it is linear on the screen, and cheaper. Its exact value lies in
 * [z, z (1 - TILE_LINEAR_ERROR)] then, which is as wide near the eye as far away. Such tiles are called linear.
 *
 * Rays of an orthographic camera are parallel; N is 1 for them, and depths are t. Such tiles are called parallel.
 *
 * Pixels are stored as pairs of rows, interleaved: (x, y) at y / 2 * 128 + 2 x + y % 2. So a vector that starts at any
 * column holds CGT_LANES / 2 columns of two rows, at every width. */
#ifndef CGT_TILE_H
#define CGT_TILE_H

#include "kernel/primitive/filter.h"

#define TILE_EDGE 64u
#define TILE_PIXELS (TILE_EDGE * TILE_EDGE)
#define TILE_ROW_PAIR (2 * TILE_EDGE) /* pixels of a pair of rows */
#define TILE_PAD 16u                  /* a window may begin in the last column */
#define TILE_PARTS 4u                 /* parts of 16x16 pixels along an edge */
#define TILE_MAX_TRIANGLES 2048u      /* triangles that a tile lists */

/* Of 1/t, in linear tiles: what the best hit's may be less than z says. Less, and planes that are seen at a slant are
 * too coarse; more, and more layers are too near to each other. */
#define TILE_LINEAR_ERROR 0x1p-9
#define TILE_LINEAR_FACTOR (1 - TILE_LINEAR_ERROR)

/* How a tile's depths come about; a constant where functions are called. */
typedef enum tile_kind { TILE_PERSPECTIVE, TILE_LINEAR, TILE_PARALLEL } tile_kind;

/* What a tile's arithmetic knows of the camera. The axes are orthogonal but for rounding, which tile_limits.h checks,
 * and a point c' seen from the eye is c' = z forward + x right / |right| + y up / |up| with z, x, y the products of c'
 * and `dual`, the rows of the inverse of exactly these axes. So what the axes lack is an error of the metric alone. */
typedef struct tile_camera {
    float dual[3][3];
    float right, up;   /* lengths */
    float a, b;        /* of N: squares of them, 0 where rays are parallel */
    float rright, rup; /* reciprocals */
} tile_camera;

/* Columns or rows: x / z of camera space times `scale`, less `first`, counts from the middle of the tile's first one. */
typedef struct tile_span {
    float scale, first;
    float pixels, last; /* how many, and that less one */
} tile_span;

typedef struct tile {
    _Alignas(64) float z[TILE_PIXELS + TILE_PAD];
    _Alignas(64) uint32_t prim[TILE_PIXELS + TILE_PAD]; /* CGT_INVALID_ID: none yet */
    _Alignas(64) uint32_t slot[TILE_PIXELS + TILE_PAD]; /* linear: where in `listed` a pixel's object is */
    _Alignas(64) float px[TILE_ROW_PAIR + TILE_PAD];    /* of a pair of rows; NaN where a window leaves the tile */
    _Alignas(64) float py[TILE_EDGE / 2][CGT_LANES];    /* the two rows of a pair by turns */
    _Alignas(
        64) float far_distance[TILE_PARTS * TILE_PARTS]; /* beyond this distance a part of 16x16 pixels wants nothing */
    _Alignas(64) float rlength[TILE_PARTS * TILE_PARTS]; /* at least 1 / sqrt(N) of any pixel of a part */
    float max_far_distance, max_far_t;                   /* of all parts, as distance and as t */
    bool initialised; /* pixels have been opened: until then nothing is in z and object */
    bool linear;      /* depths are -1/t; `far` and `farthest` are t then */
    bool parallel;    /* depths are t, and the rays have one direction */
    _Alignas(64) float part_x[TILE_PARTS * TILE_PARTS]; /* middles of the parts, as px and py */
    _Alignas(64) float part_y[TILE_PARTS * TILE_PARTS];
    _Alignas(64) float part_half_width[TILE_PARTS * TILE_PARTS]; /* half their sizes, rounded up */
    _Alignas(64) float part_half_height[TILE_PARTS * TILE_PARTS];
    _Alignas(
        64) uint32_t triangles[TILE_MAX_TRIANGLES + CGT_LANES]; /* what has won pixels; it may have lost them since */
    uint32_t triangle_count;                                    /* how many; TILE_MAX_TRIANGLES: there were too many */
    float column[TILE_EDGE], row[TILE_EDGE];                    /* px and py; beyond the region the last ones again */
    uint32_t columns, rows;                                     /* in the region */
    tile_span column_span, row_span;
    float span_ratio;                      /* ratio of their scales */
    float depth_error, padded_depth_error; /* wide: what rounding of differences adds is in it */
    float max_norm, min_norm;              /* N of any pixel is between these */
    float max_dir_length;                  /* at least sqrt(most) */
    float length_error;                    /* of lengths: what underflows, and what origins are off by twice */
    float origin_error,
        origin_offset; /* of parallel rays: origins are off by u times this; the farthest one beside the eye */
    const cgt_camera_rays *rays;
    tile_camera camera;
    float axis[3], tangent, secant; /* a cone about all rays, as z, x, y; secant 0: too wide for one */
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

/* Of a hit at t of pixel i, the depth that is kept: the exact one is in the middle of what it tells. A linear one stays
 * finite, since -infinity would close the pixel. */
CGT_SPU_INLINE float tile_compute_depth(const tile *t, uint32_t i, double hit_t)
{
    if (!t->linear)
        return (float)(hit_t * tile_norm(t, i) - 0.5 * (double)t->depth_error);
    const double depth = -1 / hit_t * (1 + 0.5 * TILE_LINEAR_ERROR);
    return hit_t > 0x1p-120 ? (float)depth : -0x1p120f;
}

/* The exact depth of a best hit is not beyond this. */
CGT_SPU_INLINE double tile_depth_bound(const tile *t, double z)
{
    return t->linear ? z * TILE_LINEAR_FACTOR : z + (double)t->depth_error;
}

/* Refreshes how far each part still looks. */
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
                z < 0 ? (z == -INFINITY ? z : -(1 + 0x1p-20f) / (z * (float)TILE_LINEAR_FACTOR)) : INFINITY;
        else
            t->far_distance[k] = (z + t->padded_depth_error) * t->rlength[k] * (1 + 0x1p-20f);
        const float far_t = t->linear ? t->far_distance[k] : t->far_distance[k] * t->rlength[k];
        max_far_distance = t->far_distance[k] > max_far_distance ? t->far_distance[k] : max_far_distance;
        max_far_t = far_t > max_far_t ? far_t : max_far_t;
    }
    t->max_far_distance = max_far_distance;
    t->max_far_t = max_far_t * (1 + 0x1p-20f);
}

/* Closes the pixels of a vector that are beyond the region. */
CGT_SPU_INLINE void tile_disable_outside_pixels(tile *t, uint32_t first)
{
    if (tile_row(first) >= t->rows || tile_column(first) >= t->columns)
        spux_store(t->z + first, spux_vfloat(-INFINITY));
    else if (tile_row(first) + 1 >= t->rows || tile_column(first + CGT_LANES - 1) >= t->columns)
        for (uint32_t i = first; i < first + CGT_LANES; i++)
            if (tile_column(i) >= t->columns || tile_row(i) >= t->rows)
                t->z[i] = -INFINITY;
}

/* Pixels without a hit, and without an end of the range. */
CGT_SPU_INLINE void tile_clear_pixels(tile *t)
{
    t->initialised = true;
    for (uint32_t i = 0; i < TILE_PIXELS + TILE_PAD; i += CGT_LANES) {
        spux_store(t->z + i, spux_vfloat(INFINITY));
        spux_store_uint(t->prim + i, spux_vuint(CGT_INVALID_ID));
    }
}

/* Open pixels begin with the range's end, those beyond the region closed. far_t: no object is hit beyond this t; an end
 * there is none. Where every pixel would be as the others, that waits for the first object that the tile may see: many
 * a tile of the sky never has one. */
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

/* Before an object comes to the pixels. */
CGT_SPU_INLINE void tile_ensure_pixels(tile *t)
{
    if (!t->initialised)
        tile_clear_pixels(t);
}

/* Lists an object, if it has won any pixel: with slot `lists`, as it was. */
CGT_SPU_INLINE void tile_append_triangle(tile *t, uint32_t prim, bool won)
{
    t->triangles[t->triangle_count] = prim;
    t->triangle_count += won && t->triangle_count < TILE_MAX_TRIANGLES;
}

/* Gives a pixel to an object. */
CGT_SPU_INLINE void tile_set_closest(tile *t, uint32_t i, uint32_t prim)
{
    t->prim[i] = prim;
    if (!t->linear)
        return;
    if (!t->triangle_count || t->triangles[t->triangle_count - 1] != prim)
        tile_append_triangle(t, prim, true);
    t->slot[i] = t->triangle_count - 1;
}

/* The canonical directions of px and py, or the origins of parallel rays, in the order of camera.h. */
CGT_SPU_INLINE void tile_compute_directions(const tile *t, bool parallel, vfloat px, vfloat py, vfloat dir[3])
{
    const cgt_camera_rays *c = t->rays;
    const float *from = parallel ? c->eye : c->fwd;
    for (int a = 0; a < 3; a++) {
        const vfloat column_sum = spu_add(spux_vfloat(from[a]), spu_mul(px, spux_vfloat(c->right[a])));
        dir[a] = spu_add(column_sum, spu_mul(py, spux_vfloat(c->up[a])));
    }
}

/* The canonical directions of so many pixels, at most a vector; the first one again beyond them. */
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

/* The canonical line of a pixel, in the order of camera.h. */
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
