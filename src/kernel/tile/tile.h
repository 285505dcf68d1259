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

CGT_SPU_INLINE void tile_cross(const float p[3], const float q[3], double cross[3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        cross[a] = (double)p[b] * (double)q[c] - (double)p[c] * (double)q[b];
    }
}

CGT_SPU_INLINE void tile_init_camera(const cgt_camera_rays *c, tile_camera *q)
{
    double normal[3][3], right = 0, up = 0, volume = 0;
    tile_cross(c->right, c->up, normal[0]);
    tile_cross(c->up, c->fwd, normal[1]);
    tile_cross(c->fwd, c->right, normal[2]);
    for (int a = 0; a < 3; a++) {
        right += (double)c->right[a] * (double)c->right[a];
        up += (double)c->up[a] * (double)c->up[a];
        volume += (double)c->fwd[a] * normal[0][a];
    }
    const double length[3] = {1, sqrt(right), sqrt(up)};
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            q->dual[k][a] = (float)(normal[k][a] / volume * length[k]);
    q->right = (float)length[1];
    q->up = (float)length[2];
    q->a = c->orthographic ? 0 : (float)right;
    q->b = c->orthographic ? 0 : (float)up;
    q->rright = (float)(1 / length[1]);
    q->rup = (float)(1 / length[2]);
}

/* ---- the tables ---- */

CGT_SPU_INLINE tile_span tile_compute_span(float scale, float first, float pixel, uint32_t pixels)
{
    return (tile_span){scale / pixel, first / pixel, (float)pixels, (float)(pixels - 1)};
}

CGT_SPU_INLINE void tile_init_tables(tile *t, uint32_t x0, uint32_t y0)
{
    const float *pixel = t->rays->pixel;
    const uint32_t last_column = t->columns - 1, last_row = t->rows - 1;
    const vmask second = spu_cmpeq(spu_and(spux_lane_index(), spux_vuint(1)), spux_vuint(1));
    for (uint32_t k = 0; k < TILE_EDGE; k++) { /* in the order of camera.h */
        t->column[k] = ((float)(int32_t)(x0 + (k < last_column ? k : last_column)) + 0.5f) * pixel[0] - 1;
        t->row[k] = 1 - ((float)(int32_t)(y0 + (k < last_row ? k : last_row)) + 0.5f) * pixel[1];
    }
    for (uint32_t k = 0; k < TILE_EDGE; k++)
        t->px[2 * k] = t->px[2 * k + 1] = t->column[k];
    for (uint32_t k = 0; k < TILE_PAD; k++)
        t->px[TILE_ROW_PAIR + k] = NAN;
    for (uint32_t y = 0; y < TILE_EDGE; y += 2)
        spux_store(t->py[y / 2], spux_select(spux_vfloat(t->row[y]), spux_vfloat(t->row[y + 1]), second));
    t->column_span = tile_compute_span(t->camera.rright, t->column[0], pixel[0], t->columns);
    t->row_span = tile_compute_span(-t->camera.rup, -t->row[0], pixel[1], t->rows); /* rows run down */
    t->span_ratio = t->row_span.scale / t->column_span.scale;
}

CGT_SPU_INLINE float tile_min_square(float a, float b)
{
    const float low = fabsf(a) < fabsf(b) ? fabsf(a) : fabsf(b);
    return (a < 0) != (b < 0) ? 0 : low * low;
}
CGT_SPU_INLINE float tile_max_square(float a, float b)
{
    const float high = fabsf(a) > fabsf(b) ? fabsf(a) : fabsf(b);
    return high * high;
}

/* Each coordinate of a canonical origin is made with four roundings, of px right, eye + px right, py up and the sum:
 * with |px| and |py| at most 1 it is off by u (2 |eye| + 3 |right| + 2 |up|) of that axis, and as a vector by u times the
 * sum of those lengths. The inverse of the axes takes it to camera space as it is, but for a share of 4 u. */
CGT_SPU_INLINE void tile_init_parallel(tile *t)
{
    const cgt_camera_rays *c = t->rays;
    const double e[3] = {(double)c->eye[0], (double)c->eye[1], (double)c->eye[2]};
    const double eye = sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    const double right = (double)t->camera.right, up = (double)t->camera.up;
    t->parallel = c->orthographic;
    t->origin_error = t->parallel ? (float)((2 * eye + 3 * right + 2 * up) * (1 + 0x1p-18)) : 0;
    t->origin_offset = t->parallel ? (float)((right + up) * (1 + 0x1p-18)) : 0;
    t->length_error = 0x1p-60f + t->origin_error * 0x1p-23f;
}

/* The range of N, of the tile and of its parts, rounded outwards. */
CGT_SPU_INLINE void tile_init_norms(tile *t)
{
    const float *x = t->column, *y = t->row, a = t->camera.a, b = t->camera.b;
    const uint32_t last = TILE_EDGE - 1;
    t->max_norm = (1 + a * tile_max_square(x[0], x[last]) + b * tile_max_square(y[0], y[last])) * (1 + 0x1p-20f);
    t->min_norm = (1 + a * tile_min_square(x[0], x[last]) + b * tile_min_square(y[0], y[last])) * (1 - 0x1p-20f);
    t->max_dir_length = sqrtf(t->max_norm) * (1 + 0x1p-20f);
    for (uint32_t k = 0; k < TILE_PARTS * TILE_PARTS; k++) {
        const uint32_t u = k % TILE_PARTS * 16, v = k / TILE_PARTS * 16;
        const float min_norm = 1 + a * tile_min_square(x[u], x[u + 15]) + b * tile_min_square(y[v], y[v + 15]);
        t->rlength[k] = 1 / sqrtf(min_norm) * (1 + 0x1p-20f);
    }
}

CGT_SPU_INLINE void tile_init_parts(tile *t)
{
    for (uint32_t k = 0; k < TILE_PARTS * TILE_PARTS; k++) {
        const float *x = t->column + k % TILE_PARTS * 16, *y = t->row + k / TILE_PARTS * 16;
        t->part_x[k] = 0.5f * (x[0] + x[15]);
        t->part_y[k] = 0.5f * (y[0] + y[15]);
        t->part_half_width[k] = 0.5f * fabsf(x[15] - x[0]) + 0x1p-22f;
        t->part_half_height[k] = 0.5f * fabsf(y[15] - y[0]) + 0x1p-22f;
    }
}

/* Rays lie in the cone about the axis through the middle that holds those at the corners. The tile's slack in culling
 * (2^-18) is more than what rounding of the axis comes to. */
CGT_SPU_INLINE void tile_init_cone(tile *t)
{
    const uint32_t last = TILE_EDGE - 1;
    const float gx[2] = {t->column[0] * t->camera.right, t->column[last] * t->camera.right};
    const float gy[2] = {t->row[0] * t->camera.up, t->row[last] * t->camera.up};
    const float mx = 0.5f * (gx[0] + gx[1]), my = 0.5f * (gy[0] + gy[1]), r = 1 / sqrtf(1 + mx * mx + my * my);
    float sine2 = 0;
    bool narrow = !t->parallel;
    t->axis[0] = r;
    t->axis[1] = mx * r;
    t->axis[2] = my * r;
    for (int k = 0; k < 4; k++) {
        const float x = gx[k & 1], y = gy[k >> 1], s = r + x * t->axis[1] + y * t->axis[2];
        const float ez = 1 - s * t->axis[0], ex = x - s * t->axis[1], ey = y - s * t->axis[2];
        const float square = (ex * ex + ey * ey + ez * ez) / (1 + x * x + y * y);
        sine2 = square > sine2 ? square : sine2;
        narrow = narrow && s > 0;
    }
    sine2 = sine2 * (1 + 0x1p-18f) + 0x1p-40f;
    narrow = narrow && sine2 < 0.5f;
    t->secant = narrow ? 1 / sqrtf(1 - sine2) * (1 + 0x1p-18f) : 0;
    t->tangent = narrow ? sqrtf(sine2) * t->secant : 0;
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
