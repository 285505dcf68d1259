/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sets of rays of cgt-bench structures, and their orders. */
#include <stdlib.h>
#include <string.h>

#include "common/bench_random.h"
#include "structures/bench_structures.h"

/* ---- Making -------------------------------------------------------------------------------------------------- */

static uint32_t tile_columns(const structures_job *job)
{
    return (job->axes.width + BENCH_TILE_EDGE - 1) / BENCH_TILE_EDGE;
}

/* The tile of the pixel at a position of the tile-by-tile order. Tiles of the lowest row may be cut. */
static uint32_t tile_at(const structures_job *job, uint64_t place)
{
    const uint64_t row = (uint64_t)BENCH_TILE_EDGE * job->axes.width; /* pixels of a row of tiles that is not cut */
    const uint32_t down = (uint32_t)(place / row), left = job->axes.height - down * BENCH_TILE_EDGE;
    const uint32_t rows = left < BENCH_TILE_EDGE ? left : BENCH_TILE_EDGE;
    return down * tile_columns(job) + (uint32_t)(place % row) / (BENCH_TILE_EDGE * rows);
}

static cgt_result make_camera_rays(const structures_job *job, bench_ray_array *rays)
{
    const uint64_t pixels = (uint64_t)job->axes.width * job->axes.height;
    rays->count = 0;
    rays->bounded = 0;
    const cgt_result result = bench_ray_array_reserve(rays, pixels);
    if (result != CGT_OK)
        return result;
    for (uint32_t tile = 0; tile < bench_tiles(&job->axes); tile++) {
        uint32_t pixel[BENCH_TILE_PIXELS];
        const uint32_t in_tile = bench_tile_pixels(&job->axes, tile, pixel);
        for (uint32_t i = 0; i < in_tile; i++, rays->count++) {
            float dir[3];
            bench_camera_direction(&job->axes, pixel[i] & 0xffff, pixel[i] >> 16, dir);
            for (int a = 0; a < 3; a++) {
                rays->org[a][rays->count] = job->axes.eye[a];
                rays->dir[a][rays->count] = dir[a];
            }
        }
    }
    return CGT_OK;
}

static cgt_result make_rays(structures_job *job, structures_kind kind)
{
    const structures_settings *settings = job->settings;
    const cgt_scene_statistics *built = &structures_first(job)->build.built;
    bench_ray_array *rays = &job->set.made;
    switch (kind) {
    case STRUCTURES_CAMERA: return make_camera_rays(job, rays);
    case STRUCTURES_SHADOW: return bench_ray_array_shadow(rays, job->maker, settings->secondary.light);
    case STRUCTURES_AO: return bench_ray_array_ao(rays, job->maker, settings->secondary.ao);
    case STRUCTURES_BOUNCE: return bench_ray_array_bounce(rays, job->maker);
    default: return bench_ray_array_random(rays, settings->random, built->bounds_min, built->bounds_max);
    }
}

static uint32_t tile_of_ray(const structures_job *job, structures_kind kind, uint64_t ray)
{
    if (kind == STRUCTURES_RANDOM)
        return 0;
    if (kind == STRUCTURES_CAMERA)
        return tile_at(job, ray);
    const uint32_t pixel = bench_rays_pixel(job->maker, ray, kind == STRUCTURES_AO ? job->settings->secondary.ao : 1);
    return (pixel >> 16) / BENCH_TILE_EDGE * tile_columns(job) + (pixel & 0xffff) / BENCH_TILE_EDGE;
}

cgt_result structures_make_set(structures_job *job, structures_kind kind)
{
    structures_set *set = &job->set;
    const uint64_t limit = kind == STRUCTURES_RANDOM ? UINT64_MAX : job->settings->rays;
    set->kind = kind;
    set->count = (uint64_t)job->axes.width * job->axes.height;
    if (kind == STRUCTURES_FRAME)
        return CGT_OK;
    const cgt_result result = make_rays(job, kind);
    if (result != CGT_OK)
        return result;
    set->count = set->made.count < limit ? set->made.count : limit;
    set->first = (set->made.count - set->count) / 2;
    if (set->count >= SIZE_MAX / sizeof *set->tile)
        return CGT_ERROR_TOO_LARGE;
    free(set->tile);
    free(set->turn);
    set->tile = malloc(((size_t)set->count + 1) * sizeof *set->tile);
    set->turn = malloc(((size_t)set->count + 1) * sizeof *set->turn);
    if (!set->tile || !set->turn)
        return CGT_ERROR_OUT_OF_MEMORY;
    for (uint64_t i = 0; i < set->count; i++)
        set->tile[i] = tile_of_ray(job, kind, set->first + i);
    return CGT_OK;
}

void structures_release_set(structures_set *set)
{
    bench_ray_array_release(&set->made);
    bench_ray_array_release(&set->ordered);
    free(set->tile);
    free(set->turn);
}

/* ---- Orders -------------------------------------------------------------------------------------------------- */

/* Fisher-Yates shuffle. */
static void shuffle(uint32_t *turn, uint64_t count, uint64_t *state)
{
    for (uint64_t i = count; i > 1; i--) {
        bench_random(state);
        const uint64_t j = *state % i;
        const uint32_t swapped = turn[i - 1];
        turn[i - 1] = turn[j];
        turn[j] = swapped;
    }
}

/* Sorted by tile, then each tile shuffled. */
static cgt_result order_tiles(const structures_job *job, uint64_t *state)
{
    const structures_set *set = &job->set;
    const uint32_t tiles = bench_tiles(&job->axes);
    uint64_t *end = calloc((size_t)tiles + 1, sizeof *end); /* of the tile before; after filling of the tile itself */
    if (!end)
        return CGT_ERROR_OUT_OF_MEMORY;
    for (uint64_t i = 0; i < set->count; i++)
        end[set->tile[i] + 1]++;
    for (uint32_t tile = 0; tile < tiles; tile++)
        end[tile + 1] += end[tile];
    for (uint64_t i = 0; i < set->count; i++)
        set->turn[end[set->tile[i]]++] = (uint32_t)i;
    for (uint32_t tile = 0; tile < tiles; tile++) {
        const uint64_t begin = tile ? end[tile - 1] : 0;
        shuffle(set->turn + begin, end[tile] - begin, state);
    }
    free(end);
    return CGT_OK;
}

static cgt_result gather(structures_set *set)
{
    const bench_ray_array *from = &set->made;
    bench_ray_array *to = &set->ordered;
    to->count = 0;
    to->bounded = from->bounded;
    const cgt_result result = bench_ray_array_reserve(to, set->count);
    if (result != CGT_OK)
        return result;
    for (uint64_t i = 0; i < set->count; i++) {
        const uint64_t which = set->first + set->turn[i];
        for (int a = 0; a < 3; a++) {
            to->org[a][i] = from->org[a][which];
            to->dir[a][i] = from->dir[a][which];
        }
        if (from->bounded)
            to->t_max[i] = from->t_max[which];
    }
    to->count = set->count;
    return CGT_OK;
}

cgt_result structures_order_set(structures_job *job, structures_order order)
{
    structures_set *set = &job->set;
    uint64_t state = bench_random_start;
    cgt_result result = CGT_OK;
    set->order = order;
    if (set->kind == STRUCTURES_FRAME)
        return CGT_OK;
    for (uint64_t i = 0; i < set->count; i++)
        set->turn[i] = (uint32_t)i;
    if (order == STRUCTURES_TILES)
        result = order_tiles(job, &state);
    else if (order == STRUCTURES_SHUFFLED)
        shuffle(set->turn, set->count, &state);
    return result == CGT_OK ? gather(set) : result;
}
