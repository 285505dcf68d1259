/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points that lights may reach: what the camera sees, just before its hits, and random ones, in several orders. */
#include "sets/light_points.h"

#include <stdlib.h>
#include <string.h>

#include "common/bench_random.h"

const char *const bench_light_orders[] = {"tiles", "skipping", "frame", "shuffled", "scattered", "sorted", NULL};

/* Room for `most` points in at most `calls` calls. */
static int reserve(light_points *p, uint64_t most, uint32_t calls)
{
    p->end = calloc(calls, sizeof *p->end);
    p->memory = calloc((size_t)most + 1, sizeof(float[3]));
    for (int a = 0; a < 3; a++)
        p->position[a] = (float *)p->memory + (size_t)a * ((size_t)most + 1);
    if (p->order == LIGHT_SKIPPING) {
        p->primitive = calloc((size_t)most + 1, sizeof *p->primitive);
        p->offset = calloc((size_t)most + 1, sizeof *p->offset);
    }
    for (uint64_t i = 0; p->offset && i < most; i++)
        p->offset[i] = 1e-4f; /* of the way to a light with a place */
    return p->end && p->memory && (p->order != LIGHT_SKIPPING || (p->primitive && p->offset)) ? 0 : -1;
}

static void add_tile(const light_scene *s, uint32_t tile, light_points *p)
{
    const bench_camera_axes *axes = &s->job->session.axes;
    const bench_planes *planes = &s->job->planes;
    const float back = p->order == LIGHT_SKIPPING ? 1 : 0.9999f;
    uint32_t pixel[BENCH_TILE_PIXELS + 1];
    float t[BENCH_TILE_PIXELS + 1];
    const uint32_t count = bench_tile_hits(axes, planes->t, tile, pixel, t);
    for (uint32_t k = 0; k < count; k++) {
        float dir[3];
        bench_camera_direction(axes, pixel[k] & 0xffff, pixel[k] >> 16, dir);
        for (int a = 0; a < 3; a++)
            p->position[a][p->count] = axes->eye[a] + back * t[k] * dir[a];
        if (p->primitive)
            p->primitive[p->count] = planes->primitive[(size_t)(pixel[k] >> 16) * axes->width + (pixel[k] & 0xffff)];
        p->count++;
    }
    if (count)
        p->end[p->calls++] = p->count;
}

static void swap_points(light_points *p, uint64_t i, uint64_t k)
{
    for (int a = 0; a < 3; a++) {
        const float held = p->position[a][i];
        p->position[a][i] = p->position[a][k];
        p->position[a][k] = held;
    }
}

static void shuffle(light_points *p)
{
    uint64_t random = bench_random_start;
    for (uint64_t i = p->count; i > 1; i--) {
        const uint64_t k = (uint64_t)(bench_random(&random) * (float)i);
        swap_points(p, i - 1, k < i ? k : i - 1);
    }
}

static void add_random(const light_scene *s, light_points *p)
{
    uint64_t random = bench_random_start;
    for (p->count = 0; p->count < LIGHT_SCATTERED_POINTS; p->count++)
        for (int a = 0; a < 3; a++)
            p->position[a][p->count] = s->low[a] + bench_random(&random) * (s->high[a] - s->low[a]);
}

/* ---- a Morton curve ---- */

typedef struct keyed_point {
    uint32_t key;
    float at[3];
} keyed_point;

static uint32_t curve_key(const light_scene *s, const float at[3])
{
    uint32_t key = 0;
    for (int a = 0; a < 3; a++) {
        const float extent = s->high[a] - s->low[a];
        const float share = extent > 0 ? (at[a] - s->low[a]) / extent : 0;
        const uint32_t cell = (uint32_t)(share * 1023);
        for (uint32_t bit = 0; bit < 10; bit++)
            key |= (cell >> bit & 1) << (3 * bit + (uint32_t)a);
    }
    return key;
}

static int compare_keys(const void *a, const void *b)
{
    const uint32_t x = ((const keyed_point *)a)->key, y = ((const keyed_point *)b)->key;
    return (x > y) - (x < y);
}

static int sort_points(const light_scene *s, light_points *p)
{
    keyed_point *sorted = malloc(p->count * sizeof *sorted);
    if (!sorted)
        return -1;
    for (uint64_t i = 0; i < p->count; i++) {
        for (int a = 0; a < 3; a++)
            sorted[i].at[a] = p->position[a][i];
        sorted[i].key = curve_key(s, sorted[i].at);
    }
    qsort(sorted, p->count, sizeof *sorted, compare_keys);
    for (uint64_t i = 0; i < p->count; i++)
        for (int a = 0; a < 3; a++)
            p->position[a][i] = sorted[i].at[a];
    free(sorted);
    return 0;
}

int light_points_make(const light_scene *scene, light_order order, light_points *points)
{
    const uint32_t tiles = bench_tiles(&scene->job->session.axes);
    const bool seen = order <= LIGHT_SHUFFLED;
    *points = (light_points){.order = order};
    int failed = reserve(points, seen ? (uint64_t)tiles * BENCH_TILE_PIXELS : LIGHT_SCATTERED_POINTS, tiles + 1);
    if (!failed) {
        for (uint32_t k = 0; k < tiles && seen; k++)
            add_tile(scene, k, points);
        if (!seen)
            add_random(scene, points);
        if (order == LIGHT_SHUFFLED)
            shuffle(points);
        if (order == LIGHT_SORTED)
            failed = sort_points(scene, points);
        if (order >= LIGHT_SHUFFLED) {
            points->calls = 1;
            points->end[0] = points->count;
        }
    }
    if (failed)
        light_points_release(points);
    return failed;
}

void light_points_release(light_points *points)
{
    free(points->memory);
    free(points->end);
    free(points->primitive);
    free(points->offset);
    memset(points, 0, sizeof *points);
}
