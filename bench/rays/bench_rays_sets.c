/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sets of rays of cgt-bench rays, and their orders. */
#include <stdlib.h>
#include <string.h>

#include "common/bench_random.h"
#include "rays/bench_rays.h"

/* ---- Making -------------------------------------------------------------------------------------------------- */

static uint32_t tile_columns(const sweep_job *job) { return (job->axes.width + BENCH_TILE_EDGE - 1) / BENCH_TILE_EDGE; }

/* The tile of the pixel that comes `place`-th, tile by tile; those of the lowest row may be cut. */
static uint32_t tile_at(const sweep_job *job, uint64_t place)
{
    const uint64_t row = (uint64_t)BENCH_TILE_EDGE * job->axes.width; /* pixels of a row of tiles that is not cut */
    const uint32_t down = (uint32_t)(place / row), left = job->axes.height - down * BENCH_TILE_EDGE;
    const uint32_t rows = left < BENCH_TILE_EDGE ? left : BENCH_TILE_EDGE;
    return down * tile_columns(job) + (uint32_t)(place % row) / (BENCH_TILE_EDGE * rows);
}

static cgt_result make_camera_rays(const sweep_job *job, structures_rays *rays)
{
    const uint64_t pixels = (uint64_t)job->axes.width * job->axes.height;
    rays->count = 0;
    rays->bounded = 0;
    const cgt_result result = structures_rays_reserve(rays, pixels);
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

static cgt_result make_rays(sweep_job *job, sweep_kind kind)
{
    const sweep_settings *settings = job->settings;
    const cgt_scene_statistics *built = &sweep_first(job)->build.built;
    structures_rays *rays = &job->rays.made;
    switch (kind) {
    case SWEEP_CAMERA: return make_camera_rays(job, rays);
    case SWEEP_SHADOW: return structures_rays_shadow(rays, job->maker, settings->light);
    case SWEEP_AO: return structures_rays_ao(rays, job->maker, settings->ao);
    case SWEEP_BOUNCE: return structures_rays_bounce(rays, job->maker);
    default: return structures_rays_random(rays, (uint32_t)settings->rays, built->bounds_min, built->bounds_max);
    }
}

static uint32_t tile_of_ray(const sweep_job *job, sweep_kind kind, uint64_t ray)
{
    if (kind == SWEEP_RANDOM)
        return 0;
    if (kind == SWEEP_CAMERA)
        return tile_at(job, ray);
    const uint32_t pixel = bench_rays_pixel(job->maker, ray, kind == SWEEP_AO ? job->settings->ao : 1);
    return (pixel >> 16) / BENCH_TILE_EDGE * tile_columns(job) + (pixel & 0xffff) / BENCH_TILE_EDGE;
}

cgt_result sweep_rays_make(sweep_job *job, sweep_kind kind)
{
    sweep_rays *rays = &job->rays;
    const cgt_result result = make_rays(job, kind);
    if (result != CGT_OK)
        return result;
    rays->count = rays->made.count < job->settings->rays ? rays->made.count : job->settings->rays;
    rays->first = (rays->made.count - rays->count) / 2;
    free(rays->tile);
    free(rays->turn);
    rays->tile = malloc(((size_t)rays->count + 1) * sizeof *rays->tile);
    rays->turn = malloc(((size_t)rays->count + 1) * sizeof *rays->turn);
    if (!rays->tile || !rays->turn)
        return CGT_ERROR_OUT_OF_MEMORY;
    for (uint64_t i = 0; i < rays->count; i++)
        rays->tile[i] = tile_of_ray(job, kind, rays->first + i);
    return CGT_OK;
}

void sweep_rays_release(sweep_rays *rays)
{
    structures_rays_release(&rays->made);
    structures_rays_release(&rays->ordered);
    free(rays->tile);
    free(rays->turn);
}

/* ---- Orders -------------------------------------------------------------------------------------------------- */

/* Fisher and Yates. */
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
static cgt_result order_tiles(const sweep_job *job, uint64_t *state)
{
    const sweep_rays *rays = &job->rays;
    const uint32_t tiles = bench_tiles(&job->axes);
    uint64_t *end = calloc((size_t)tiles + 1, sizeof *end); /* of the tile before; after filling of the tile itself */
    if (!end)
        return CGT_ERROR_OUT_OF_MEMORY;
    for (uint64_t i = 0; i < rays->count; i++)
        end[rays->tile[i] + 1]++;
    for (uint32_t tile = 0; tile < tiles; tile++)
        end[tile + 1] += end[tile];
    for (uint64_t i = 0; i < rays->count; i++)
        rays->turn[end[rays->tile[i]]++] = (uint32_t)i;
    for (uint32_t tile = 0; tile < tiles; tile++) {
        const uint64_t begin = tile ? end[tile - 1] : 0;
        shuffle(rays->turn + begin, end[tile] - begin, state);
    }
    free(end);
    return CGT_OK;
}

static cgt_result gather(sweep_rays *rays)
{
    const structures_rays *from = &rays->made;
    structures_rays *to = &rays->ordered;
    to->count = 0;
    to->bounded = from->bounded;
    const cgt_result result = structures_rays_reserve(to, rays->count);
    if (result != CGT_OK)
        return result;
    for (uint64_t i = 0; i < rays->count; i++) {
        const uint64_t which = rays->first + rays->turn[i];
        for (int a = 0; a < 3; a++) {
            to->org[a][i] = from->org[a][which];
            to->dir[a][i] = from->dir[a][which];
        }
        if (from->bounded)
            to->t_max[i] = from->t_max[which];
    }
    to->count = rays->count;
    return CGT_OK;
}

cgt_result sweep_rays_order(sweep_job *job, sweep_order order)
{
    sweep_rays *rays = &job->rays;
    uint64_t state = bench_random_start;
    cgt_result result = CGT_OK;
    for (uint64_t i = 0; i < rays->count; i++)
        rays->turn[i] = (uint32_t)i;
    if (order == SWEEP_TILES)
        result = order_tiles(job, &state);
    else if (order == SWEEP_SHUFFLED)
        shuffle(rays->turn, rays->count, &state);
    return result == CGT_OK ? gather(rays) : result;
}
