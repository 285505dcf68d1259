/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Orders of the rays of a wave: a key for each ray, sorted by digits from the last to the first. What a renderer would
 * have to do for an order is timed: keys, sorting, and copying the rays. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"
#include "sets/bounces.h"

const char *const bench_wave_orders[] = {"waves", "made", "octant", "wave-morton", "origin", "octant-morton", NULL};

enum { MORTON_BITS = 8, DIGIT = 8, DIGITS = 1 << DIGIT };

typedef struct item {
    uint64_t key;
    uint32_t ray;
} item;

static uint64_t octant_of(const bounces_ray *ray)
{
    return (uint64_t)(ray->dir[0] < 0) | (uint64_t)(ray->dir[1] < 0) << 1 | (uint64_t)(ray->dir[2] < 0) << 2;
}

/* The bits of the origin's place in the box of all origins, x, y, z in turn. */
static uint64_t morton_of(const bounces_ray *ray, const float low[3], const float scale[3])
{
    uint64_t code = 0;
    for (int a = 0; a < 3; a++) {
        const uint32_t cell = (uint32_t)((ray->org[a] - low[a]) * scale[a]);
        for (int bit = 0; bit < MORTON_BITS; bit++)
            code |= (uint64_t)(cell >> bit & 1) << (3 * bit + a);
    }
    return code;
}

static void find_box(const bounces_wave *wave, float low[3], float scale[3])
{
    for (int a = 0; a < 3; a++) {
        float high = -INFINITY;
        low[a] = INFINITY;
        for (uint64_t i = 0; i < wave->count; i++) {
            low[a] = fminf(low[a], wave->ray[i].org[a]);
            high = fmaxf(high, wave->ray[i].org[a]);
        }
        scale[a] = high > low[a] ? ((1 << MORTON_BITS) - 0.5f) / (high - low[a]) : 0.0f;
    }
}

/* The number of bits that are used. */
static int set_keys(const bounces_wave *wave, bounces_order order, item *items)
{
    float low[3], scale[3];
    uint64_t all = 0;
    find_box(wave, low, scale);
    for (uint64_t i = 0; i < wave->count; i++) {
        const uint64_t call = i / BOUNCES_CALL, octant = octant_of(&wave->ray[i]);
        uint64_t key = call << 3 | octant;
        if (order != BOUNCES_OCTANT) {
            const uint64_t morton = morton_of(&wave->ray[i], low, scale);
            key = order == BOUNCES_ORIGIN ? morton << 3 | octant
                                          : (order == BOUNCES_WAVE_MORTON ? key : octant) << 3 * MORTON_BITS | morton;
        }
        items[i] = (item){key, (uint32_t)i};
        all |= key;
    }
    int bits = 0;
    while (bits < 64 && all >> bits)
        bits++;
    return bits;
}

/* Returns the one of the two arrays that has the result. */
static item *sort(item *from, item *to, uint64_t count, int bits)
{
    for (int shift = 0; shift < bits; shift += DIGIT) {
        uint64_t begin[DIGITS + 1] = {0};
        for (uint64_t i = 0; i < count; i++)
            begin[(from[i].key >> shift) % DIGITS + 1]++;
        for (int d = 0; d < DIGITS; d++)
            begin[d + 1] += begin[d];
        for (uint64_t i = 0; i < count; i++)
            to[begin[(from[i].key >> shift) % DIGITS]++] = from[i];
        item *const other = from;
        from = to;
        to = other;
    }
    return from;
}

static void copy(const bounces_wave *wave, const item *items, bounces_rays *rays)
{
    for (uint64_t i = 0; i < wave->count; i++) {
        const bounces_ray *ray = &wave->ray[items ? items[i].ray : i];
        for (int a = 0; a < 3; a++) {
            rays->org[a][i] = ray->org[a];
            rays->dir[a][i] = ray->dir[a];
        }
        rays->t_min[i] = ray->t_min;
        rays->t_max[i] = ray->t_max;
        rays->offset[i] = ray->offset;
        rays->skip[i] = ray->skip;
    }
}

static int allocate(uint64_t count, bounces_rays *rays)
{
    enum { WORDS = 10 }; /* arrays of four bytes an element */
    const size_t room = (size_t)count + 16;
    memset(rays, 0, sizeof *rays);
    float *next = calloc(room, WORDS * sizeof(float));
    if (!next)
        return -1;
    rays->memory = next;
    rays->count = count;
    float **const floats[] = {&rays->org[0], &rays->org[1], &rays->org[2], &rays->dir[0], &rays->dir[1],
                              &rays->dir[2], &rays->t_min,  &rays->t_max,  &rays->offset};
    for (size_t k = 0; k < sizeof floats / sizeof floats[0]; k++, next += room)
        *floats[k] = next;
    rays->skip = (uint32_t *)(void *)next;
    return 0;
}

int bounces_rays_make(const bounces_wave *wave, bounces_order order, bounces_rays *rays)
{
    if (allocate(wave->count, rays))
        return -1;
    if (order == BOUNCES_WAVES || order == BOUNCES_MADE) {
        copy(wave, NULL, rays);
        return 0;
    }
    item *items = malloc(2 * ((size_t)wave->count + 1) * sizeof *items);
    if (!items) {
        bounces_rays_release(rays);
        return -1;
    }
    copy(wave, NULL, rays); /* the pages are there */
    const double begin = bench_cpu_ms();
    const int bits = set_keys(wave, order, items);
    copy(wave, sort(items, items + wave->count, wave->count, bits), rays);
    rays->ms = bench_cpu_ms() - begin;
    free(items);
    return 0;
}

void bounces_rays_release(bounces_rays *rays)
{
    free(rays->memory);
    memset(rays, 0, sizeof *rays);
}
