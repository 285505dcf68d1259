/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Averages what was sampled with few rays, the sky and soft lights, over a window of 5x5 pixels, among those that hit
 * the same sphere, or the same plane of a mesh. With antialiasing each ray of a pixel takes those in its own place of
 * the neighbours, and the pixel's mean over its rays has all of them. The outer rows and columns count half, so that
 * the window has each of the 4x4 runs of draw_light.c, and of the parts of the sky, as often as any other. The more
 * normals differ, the less a neighbour counts: what a sphere sees changes across a few pixels, and an even mean errs
 * more by that than by having few rays. Four rays of a row go side by side, and each adds up its neighbours in the
 * order of the window; rays whose window leaves the picture go one by one. */
#include <math.h>
#include <string.h>

#include "draw/draw.h"

enum { REACH = DRAW_NEIGHBOURS, LANES = DRAW_PAD }; /* REACH: pixels of the window to each side of its centre */

static const float least_cosine = 0.9f; /* between normals */
static const float least_step = 0.02f;  /* share of t by which triangles of one plane differ at most */

typedef float floats __attribute__((vector_size(LANES * sizeof(float))));
typedef int32_t ints __attribute__((vector_size(LANES * sizeof(int32_t)))); /* and masks, all ones where they hold */

typedef struct smooth_planes {
    const drawing *drawing;
    const float *plane[DRAW_SMOOTHED]; /* to average */
    uint32_t count;
} smooth_planes;

/* Hard shadows stay sharp. */
static void find_planes(const drawing *d, smooth_planes *s)
{
    s->drawing = d;
    s->count = 0;
    if (d->sky)
        s->plane[s->count++] = d->sky;
    for (uint32_t i = 0; i < d->options->lighting.light_count; i++)
        if (d->reach[i])
            s->plane[s->count++] = d->reach[i];
}

/* The most that a neighbour counts, which is where normals are the same. */
static inline float most_of(int32_t below, int32_t right)
{
    return (below == -REACH || below == REACH ? 0.5f : 1.0f) * (right == -REACH || right == REACH ? 0.5f : 1.0f);
}

/* ---- One ray ------------------------------------------------------------------------------------------------- */

/* How much neighbour k of ray `own` counts: above 0 where it hits the same surface, `most` times what the cosine
 * between normals is above its least. Of triangles neighbours in the same plane count. */
static float weigh(const drawing *d, size_t own, size_t k, float most)
{
    const int same = draw_look(d, d->geometry[own])->is_triangles
                         ? !(fabsf(d->t[k] - d->t[own]) > least_step * d->t[own])
                         : d->primitive[k] == d->primitive[own];
    if (!same || d->geometry[k] != d->geometry[own])
        return 0.0f;
    const float above = fabsf(d->normal[0][own] * d->normal[0][k] + d->normal[1][own] * d->normal[1][k] +
                              d->normal[2][own] * d->normal[2][k]) -
                        least_cosine;
    return above > 0.0f ? most * above : 0.0f;
}

/* Averages over those neighbours of ray (x, y) that the picture has. Element i of each mean is the ray's. */
static void smooth_ray(const smooth_planes *s, uint32_t x, uint32_t y, uint32_t i, draw_means *means)
{
    const drawing *const d = s->drawing;
    const int64_t n = d->antialias;
    const size_t own = (size_t)y * d->ray_width + x;
    float sum[DRAW_SMOOTHED] = {0.0f}, total = 0.0f;
    for (int32_t below = -REACH; below <= REACH; below++)
        for (int32_t right = -REACH; right <= REACH; right++) {
            const int64_t column = x + n * right, row = y + n * below;
            if (column < 0 || column >= d->ray_width || row < 0 || row >= d->ray_height)
                continue;
            const size_t k = (size_t)row * d->ray_width + (size_t)column;
            const float weight = weigh(d, own, k, most_of(below, right));
            total += weight;
            for (uint32_t p = 0; p < s->count; p++)
                sum[p] += weight * s->plane[p][k];
        }
    for (uint32_t p = 0; p < s->count; p++)
        means->mean[p][i] = total > 0.0f ? sum[p] / total : s->plane[p][own];
}

/* ---- Four rays ----------------------------------------------------------------------------------------------- */

static inline floats load(const float *from)
{
    floats v;
    memcpy(&v, from, sizeof v);
    return v;
}

static inline ints load_ids(const uint32_t *from)
{
    ints v;
    memcpy(&v, from, sizeof v);
    return v;
}

static inline floats absolute(floats v) { return (floats)((ints)v & INT32_MAX); }

static inline floats select(floats a, floats b, ints mask) { return (floats)(((ints)a & ~mask) | ((ints)b & mask)); }

/* Four rays side by side, the first is `own`. */
typedef struct smooth_lanes {
    floats normal[3], t;
    ints geometry, primitive, triangles;
    int has_triangles;
} smooth_lanes;

static inline smooth_lanes load_lanes(const drawing *d, size_t own)
{
    smooth_lanes l = {.geometry = load_ids(d->geometry + own), .primitive = load_ids(d->primitive + own)};
    for (int c = 0; c < 3; c++)
        l.normal[c] = load(d->normal[c] + own);
    l.has_triangles = 0;
    for (int i = 0; i < LANES && d->has_triangles; i++) {
        const uint32_t geometry = d->geometry[own + (size_t)i];
        const int is_triangle = geometry != CGT_INVALID_ID && draw_look(d, geometry)->is_triangles;
        l.triangles[i] = -is_triangle;
        l.has_triangles |= is_triangle;
    }
    if (l.has_triangles)
        l.t = load(d->t + own);
    return l;
}

/* weigh() of their neighbours, which begin at k. */
static inline floats weigh_lanes(const drawing *d, const smooth_lanes *l, size_t k, float most)
{
    const floats above = absolute(l->normal[0] * load(d->normal[0] + k) + l->normal[1] * load(d->normal[1] + k) +
                                  l->normal[2] * load(d->normal[2] + k)) -
                         least_cosine;
    ints same = load_ids(d->primitive + k) == l->primitive;
    if (l->has_triangles) {
        const ints near = ~(absolute(load(d->t + k) - l->t) > least_step * l->t);
        same = (same & ~l->triangles) | (near & l->triangles);
    }
    same &= (load_ids(d->geometry + k) == l->geometry) & (above > 0.0f);
    return (floats)((ints)(most * above) & same);
}

/* smooth_ray() of four rays whose windows lie within the picture's width. */
static inline void smooth_lanes_of(const smooth_planes *s, uint32_t planes, uint32_t x, uint32_t y, uint32_t i,
                                   draw_means *means)
{
    const drawing *const d = s->drawing;
    const int64_t n = d->antialias, width = d->ray_width;
    const size_t own = (size_t)y * d->ray_width + x;
    const smooth_lanes l = load_lanes(d, own);
    floats total = {0.0f}, sum[DRAW_SMOOTHED];
    for (uint32_t p = 0; p < planes; p++)
        sum[p] = (floats){0.0f};
    for (int32_t below = -REACH; below <= REACH; below++) {
        const int64_t row = y + n * below;
        if (row < 0 || row >= d->ray_height)
            continue;
        for (int32_t right = -REACH; right <= REACH; right++) {
            const size_t k = (size_t)(row * width + x + n * right);
            const floats weight = weigh_lanes(d, &l, k, most_of(below, right));
            total += weight;
            for (uint32_t p = 0; p < planes; p++)
                sum[p] += weight * load(s->plane[p] + k);
        }
    }
    /* A hit counts itself, unless its normal is no unit vector. */
    for (uint32_t p = 0; p < planes; p++) {
        const floats mean = select(load(s->plane[p] + own), sum[p] / total, total > 0.0f);
        memcpy(means->mean[p] + i, &mean, sizeof mean);
    }
}

static int are_misses(const uint32_t *primitive, uint32_t count)
{
    uint32_t combined = CGT_INVALID_ID;
    for (uint32_t i = 0; i < count; i++)
        combined &= primitive[i];
    return combined == CGT_INVALID_ID;
}

void cgt_draw_smooth(const drawing *d, uint32_t x, uint32_t y, uint32_t count, draw_means *means)
{
    const uint32_t *const primitive = d->primitive + (size_t)y * d->ray_width + x;
    const uint32_t aside = REACH * d->antialias;
    smooth_planes s;
    find_planes(d, &s);
    for (uint32_t i = 0; i < count && s.count; i += LANES) {
        const uint32_t lanes = count - i < LANES ? count - i : LANES, first = x + i;
        if (are_misses(primitive + i, lanes))
            continue;
        if (first < aside || first + LANES + aside > d->ray_width) {
            for (uint32_t k = i; k < i + lanes; k++)
                if (primitive[k] != CGT_INVALID_ID)
                    smooth_ray(&s, x + k, y, k, means);
        } else if (s.count == 1) /* a copy without loops over planes */
            smooth_lanes_of(&s, 1, first, y, i, means);
        else
            smooth_lanes_of(&s, s.count, first, y, i, means);
    }
}
