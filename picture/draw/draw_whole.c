/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whole pixels: those with antialiasing all of whose rays hit one sphere or capsule, in the same hard lights and of
 * the same colour, where that is nearly flat and no layer lies before it. There antialiasing has nothing to do: such a
 * pixel goes on as one ray through its centre, which takes the rays to the sky and to soft lights of all of them, and
 * is averaged and shaded once. What it sees is laid on its rays then, whose neighbours of other pixels average over
 * it, too. */
#include <math.h>
#include <string.h>

#include "draw/draw.h"

static const float least_mean = 0.995f; /* length of the mean of the rays' normals */

/* Whether all rays of a pixel, n in each of n rows, k the first, are alike but for the normal. */
static inline int is_alike(const drawing *d, size_t k, uint32_t n)
{
    const uint32_t primitive = d->primitive[k], geometry = d->geometry[k];
    const picture_look *const look = draw_look(d, geometry);
    uint32_t differ = 0;
    for (uint32_t j = 0; j < n; j++)
        for (uint32_t i = 0; i < n; i++) {
            const size_t other = k + (size_t)j * d->ray_width + i;
            differ |= (d->primitive[other] ^ primitive) | (d->geometry[other] ^ geometry);
        }
    for (uint32_t l = 0; l < d->options->lighting.light_count; l++)
        for (uint32_t i = 0; i < n * n && d->occluded[l]; i++)
            differ |= d->occluded[l][k + (size_t)(i / n) * d->ray_width + i % n] ^ d->occluded[l][k];
    for (uint32_t l = 0; l < d->layers; l++) /* CGT_INVALID_ID is all ones */
        for (uint32_t i = 0; i < n * n; i++)
            differ |= ~d->layer[l].primitive[k + (size_t)(i / n) * d->ray_width + i % n];
    for (uint32_t i = 0; i < n * n && look->of.halves; i++)
        differ |= (d->u[k + (size_t)(i / n) * d->ray_width + i % n] > 0.5f) != (d->u[k] > 0.5f);
    return !differ && !look->is_triangles;
}

/* Sets element `to` of the whole pixels to the mean of the rays, unless they are too round. */
static inline int take_mean(const drawing *d, size_t k, uint32_t n, size_t to)
{
    const drawing *const w = d->whole;
    float t = 0.0f, normal[3] = {0.0f, 0.0f, 0.0f}, square = 0.0f;
    for (uint32_t j = 0; j < n; j++)
        for (uint32_t i = 0; i < n; i++) {
            const size_t other = k + (size_t)j * d->ray_width + i;
            t += d->t[other];
            for (int c = 0; c < 3; c++)
                normal[c] += d->normal[c][other];
        }
    for (int c = 0; c < 3; c++)
        square += normal[c] * normal[c];
    const float length = sqrtf(square);
    if (!(length * d->share > least_mean))
        return 0;
    w->t[to] = t * d->share;
    for (int c = 0; c < 3; c++)
        w->normal[c][to] = normal[c] / length;
    w->primitive[to] = d->primitive[k];
    w->geometry[to] = d->geometry[k];
    if (w->u)
        w->u[to] = d->u[k];
    for (uint32_t l = 0; l < d->options->lighting.light_count; l++)
        if (d->occluded[l])
            w->occluded[l][to] = d->occluded[l][k];
    return 1;
}

static inline void find_in_row_of(const drawing *d, uint32_t y, uint32_t n)
{
    const drawing *const w = d->whole;
    const size_t first = (size_t)y * n * d->ray_width;
    memcpy(d->rest_plane + first, d->primitive + first, (size_t)n * d->ray_width * sizeof *d->rest_plane);
    for (uint32_t x = 0; x < w->ray_width; x++) {
        const size_t to = (size_t)y * w->ray_width + x, k = first + (size_t)x * n;
        w->primitive[to] = w->geometry[to] = CGT_INVALID_ID;
        if (d->primitive[k] == CGT_INVALID_ID || !is_alike(d, k, n) || !take_mean(d, k, n, to))
            continue;
        for (uint32_t j = 0; j < n; j++)
            for (uint32_t i = 0; i < n; i++)
                d->rest_plane[k + (size_t)j * d->ray_width + i] = CGT_INVALID_ID;
    }
}

/* Copies with constants. */
static void find_in_row(void *argument, uint32_t index)
{
    const drawing *const d = argument;
    const uint32_t y = d->whole->first_ray_row + index;
    if (d->options->antialias == 2)
        find_in_row_of(d, y, 2);
    else
        find_in_row_of(d, y, 4);
}

cgt_result cgt_draw_find_whole(drawing *d)
{
    cgt_draw_forget_light(d->whole);
    d->whole->u = NULL;
    if (d->has_halves && cgt_draw_make_uv(d->whole))
        return CGT_ERROR_OUT_OF_MEMORY;
    return cgt_context_run_tasks(d->context, find_in_row, d, d->whole->ray_rows);
}

/* Lays a plane of the whole pixels on those of their rays. */
static void spread(const drawing *d, uint32_t y, const float *from, float *to)
{
    const uint32_t n = d->options->antialias;
    const size_t first = (size_t)y * d->whole->ray_width;
    for (uint32_t x = 0; x < d->whole->ray_width && from; x++)
        if (d->whole->primitive[first + x] != CGT_INVALID_ID)
            for (uint32_t j = 0; j < n; j++)
                for (uint32_t i = 0; i < n; i++)
                    to[((size_t)y * n + j) * d->ray_width + (size_t)x * n + i] = from[first + x];
}

static void spread_row(void *argument, uint32_t index)
{
    const drawing *const d = argument;
    const uint32_t y = d->whole->first_ray_row + index;
    spread(d, y, d->whole->sky, d->sky_plane);
    for (uint32_t l = 0; l < d->options->lighting.light_count; l++)
        spread(d, y, d->whole->reach[l], d->reach_plane[l]);
}

cgt_result cgt_draw_spread_whole(drawing *d)
{
    return cgt_context_run_tasks(d->context, spread_row, d, d->whole->ray_rows);
}
