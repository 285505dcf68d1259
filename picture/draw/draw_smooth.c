/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Averages what was sampled with few rays, the sky and soft lights, over a window of 5x5 pixels, among those that hit
 * the same sphere, or the same plane of a mesh. With antialiasing each ray of a pixel takes those in its own place of
 * the neighbours, and the pixel's mean over its rays has all of them. The outer rows and columns count half, so that
 * the window has each of the 4x4 runs of draw_light.c, and of the parts of the sky, as often as any other. The more
 * normals differ, the less a neighbour counts: what a sphere sees changes across a few pixels, and an even mean errs
 * more by that than by having few rays. A row of rays goes through the places of the window one after the other, in
 * loops without branches, which a compiler vectorises: each ray adds up its neighbours in the order of the window. */
#include <math.h>
#include <string.h>

#include "draw/draw.h"

enum { REACH = DRAW_NEIGHBOURS }; /* pixels of the window to each side of its centre */

static const float least_cosine = 0.9f; /* between normals */

/* Some rays of a row: those from the first hit of a block to the last. */
typedef struct smooth_rays {
    const drawing *drawing;
    const float *plane[DRAW_SMOOTHED];
    uint32_t planes;
    uint32_t x, y, count;
    int has_triangles;
    uint8_t triangle[DRAW_BLOCK]; /* 1 where a ray hits one */
    float weight[DRAW_BLOCK];     /* of its neighbour at one place of the window */
    float total[DRAW_BLOCK];      /* of its weights */
    float *sum[DRAW_SMOOTHED];    /* of what its neighbours see */
} smooth_rays;

/* The planes to average; hard shadows stay sharp. */
static void find_planes(smooth_rays *r)
{
    const drawing *d = r->drawing;
    r->planes = 0;
    if (d->sky)
        r->plane[r->planes++] = d->sky;
    for (uint32_t i = 0; i < d->options->lighting.light_count; i++)
        if (d->reach[i])
            r->plane[r->planes++] = d->reach[i];
}

/* Cuts misses off at both ends. */
static void skip_misses(smooth_rays *r)
{
    const uint32_t *primitive = r->drawing->primitive + (size_t)r->y * r->drawing->ray_width + r->x;
    while (r->count && primitive[r->count - 1] == CGT_INVALID_ID)
        r->count--;
    for (; r->count && *primitive == CGT_INVALID_ID; primitive++) {
        r->x++;
        r->count--;
    }
}

static void find_triangles(smooth_rays *r)
{
    const drawing *d = r->drawing;
    const uint32_t *geometry = d->geometry + (size_t)r->y * d->ray_width + r->x;
    r->has_triangles = 0;
    for (uint32_t i = 0; i < r->count; i++) {
        r->triangle[i] = geometry[i] != CGT_INVALID_ID && draw_look(d, geometry[i])->is_triangles;
        r->has_triangles |= r->triangle[i];
    }
}

/* Sets the weights of `count` rays from element a of the planes on, whose neighbours begin at b: above 0 where a
 * neighbour hits the same surface, `most` times what the cosine is above its least. Here of spheres alone. */
static void weigh_spheres(const drawing *d, size_t a, size_t b, uint32_t count, float most, float *restrict weight)
{
    const float *const ax = d->normal[0] + a, *const ay = d->normal[1] + a, *const az = d->normal[2] + a;
    const float *const bx = d->normal[0] + b, *const by = d->normal[1] + b, *const bz = d->normal[2] + b;
    const uint32_t *const ag = d->geometry + a, *const ap = d->primitive + a;
    const uint32_t *const bg = d->geometry + b, *const bp = d->primitive + b;
    for (uint32_t i = 0; i < count; i++) {
        const float above = fabsf(ax[i] * bx[i] + ay[i] * by[i] + az[i] * bz[i]) - least_cosine;
        const uint32_t differs = (ag[i] ^ bg[i]) | (ap[i] ^ bp[i]);
        weight[i] = (above > 0.0f ? differs : 1u) == 0u ? most * above : 0.0f;
    }
}

/* The same where there are triangles, `triangle` says which: of them neighbours in the same plane count. */
static void weigh(const drawing *d, size_t a, size_t b, uint32_t count, float most, const uint8_t *triangle,
                  float *restrict weight)
{
    for (uint32_t i = 0; i < count; i++) {
        const size_t k = a + i, n = b + i;
        const float above = fabsf(d->normal[0][k] * d->normal[0][n] + d->normal[1][k] * d->normal[1][n] +
                                  d->normal[2][k] * d->normal[2][n]) -
                            least_cosine;
        const int same =
            triangle[i] ? !(fabsf(d->t[n] - d->t[k]) > 0.02f * d->t[k]) : d->primitive[k] == d->primitive[n];
        weight[i] = d->geometry[k] == d->geometry[n] && same && above > 0.0f ? most * above : 0.0f;
    }
}

/* 0 times a share of light is 0, and adds nothing. */
static void add(float *restrict sum, const float *restrict weight, const float *restrict plane, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        sum[i] += weight[i] * plane[i];
}

/* Adds the neighbours so many pixels below and to the right, where the picture has them. */
static void add_neighbours(smooth_rays *r, int32_t below, int32_t right)
{
    const drawing *d = r->drawing;
    const int64_t step = d->options->antialias, width = d->ray_width, x = r->x, end = x + r->count;
    const int64_t aside = step * right, row = r->y + step * below;
    const int64_t from = x + aside < 0 ? -aside : x, to = end + aside > width ? width - aside : end;
    if (row < 0 || row >= d->ray_height || from >= to)
        return;
    const size_t center = (size_t)r->y * d->ray_width + (size_t)from;
    const size_t neighbour = (size_t)row * d->ray_width + (size_t)(from + aside);
    const uint32_t first = (uint32_t)(from - x), count = (uint32_t)(to - from);
    const float most =
        (below == -REACH || below == REACH ? 0.5f : 1.0f) * (right == -REACH || right == REACH ? 0.5f : 1.0f);
    if (r->has_triangles)
        weigh(d, center, neighbour, count, most, r->triangle + first, r->weight);
    else
        weigh_spheres(d, center, neighbour, count, most, r->weight);
    for (uint32_t i = 0; i < count; i++)
        r->total[first + i] += r->weight[i];
    for (uint32_t k = 0; k < r->planes; k++)
        add(r->sum[k] + first, r->weight, r->plane[k] + neighbour, count);
}

void cgt_draw_smooth(const drawing *d, uint32_t x, uint32_t y, uint32_t count, draw_means *means)
{
    smooth_rays r = {.drawing = d, .x = x, .y = y, .count = count};
    find_planes(&r);
    if (r.planes)
        skip_misses(&r);
    if (!r.planes || !r.count)
        return;
    find_triangles(&r);
    for (uint32_t k = 0; k < r.planes; k++) {
        r.sum[k] = means->mean[k] + (r.x - x);
        memset(r.sum[k], 0, r.count * sizeof *r.sum[k]);
    }
    for (int32_t below = -REACH; below <= REACH; below++)
        for (int32_t right = -REACH; right <= REACH; right++)
            add_neighbours(&r, below, right);
    /* A hit counts itself, unless its normal is no unit vector; means of misses are not used. */
    const size_t own = (size_t)y * d->ray_width + r.x;
    for (uint32_t k = 0; k < r.planes; k++)
        for (uint32_t i = 0; i < r.count; i++)
            r.sum[k][i] = r.total[i] > 0.0f ? r.sum[k][i] / r.total[i] : r.plane[k][own + i];
}
