/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Makes secondary rays in batches or tile by tile, and has them traced. bench_rays.h has the definitions. */
#include "rays/bench_rays.h"

#include "common/bench_clones.h"
#include "rays/bench_hit_rays.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum {
    GROUP = BENCH_GROUP,
    GROUPS_PER_PIECE = 64, /* groups that one call of a task makes */
    /* Hits are listed a round of tiles at a time, rays are made and traced a batch at a time: as many as fit in a
     * cache. With several threads each gets twice as many, since waking them takes as long as tracing some thousand
     * rays; more gain nothing. MOST_SHARES limits the memory of many threads. */
    TILES_PER_ROUND = 8,
    RAYS_PER_BATCH = 32 * 1024,
    MOST_SHARES = 64
};

struct bench_rays {
    cgt_context *context;
    const bench_camera_axes *axes;
    const bench_planes *planes;
    uint32_t tiles;
    uint32_t round_tiles; /* of a round */
    uint32_t round_first; /* the first tile whose hits are not listed yet */
    uint32_t tile_hits[TILES_PER_ROUND * MOST_SHARES];
    uint32_t *of_tile; /* hit pixels of each tile of a round: x + 65536 y */
    float *t_of_tile;
    uint32_t *hit; /* of all tiles, without gaps */
    float *hit_t;
    uint64_t hits;
    uint64_t batch_rays; /* rays that the arrays hold */
    float *org[3], *dir[3];
    float *ones; /* the far end of all shadow rays */
    uint8_t *occluded;
    float *t; /* a sink's scratch */
    uint32_t *primitive;
    /* the batch in work */
    uint64_t batch_first; /* first hit pixel */
    uint64_t batch_hits;
    uint32_t samples;
    int diffuse; /* 1: bounces, in place of ambient-occlusion rays */
    float light[3];
};

/* ---- Memory -------------------------------------------------------------------------------------------------- */

bench_rays *bench_rays_create(cgt_context *context, const bench_camera_axes *axes, const bench_planes *planes,
                              uint32_t most_ao)
{
    bench_rays *rays = calloc(1, sizeof *rays);
    const uint32_t workers = cgt_context_get_threads(context), most = MOST_SHARES / 2;
    const uint32_t shares = workers == 1 ? 1 : 2 * (workers < most ? workers : most);
    if (!rays)
        return NULL;
    rays->context = context;
    rays->axes = axes;
    rays->planes = planes;
    rays->tiles = bench_tiles(axes);
    rays->round_tiles = TILES_PER_ROUND * shares;
    const size_t listed = (size_t)rays->round_tiles * (BENCH_TILE_PIXELS + 1);
    const size_t pixels = (size_t)axes->width * axes->height + 1;
    rays->of_tile = calloc(listed, sizeof *rays->of_tile);
    rays->t_of_tile = calloc(listed, sizeof *rays->t_of_tile);
    rays->hit = calloc(pixels, sizeof *rays->hit);
    rays->hit_t = calloc(pixels, sizeof *rays->hit_t);
    rays->batch_rays = (uint64_t)GROUP * (most_ao > 1 ? most_ao : 1);
    if (rays->batch_rays < RAYS_PER_BATCH * shares)
        rays->batch_rays = RAYS_PER_BATCH * shares;

    const size_t batch = (size_t)rays->batch_rays;
    int complete = rays->of_tile && rays->t_of_tile && rays->hit && rays->hit_t;
    for (int i = 0; i < 3; i++) {
        rays->org[i] = malloc(batch * sizeof(float));
        rays->dir[i] = malloc(batch * sizeof(float));
        complete = complete && rays->org[i] && rays->dir[i];
    }
    rays->ones = malloc(batch * sizeof(float));
    rays->occluded = malloc(batch);
    rays->t = malloc(batch * sizeof(float));
    rays->primitive = malloc(batch * sizeof(uint32_t));
    if (!complete || !rays->ones || !rays->occluded || !rays->t || !rays->primitive) {
        bench_rays_release(rays);
        return NULL;
    }
    for (size_t i = 0; i < batch; i++)
        rays->ones[i] = 1.0f;
    return rays;
}

void bench_rays_release(bench_rays *rays)
{
    if (!rays)
        return;
    free(rays->primitive);
    free(rays->t);
    free(rays->occluded);
    free(rays->ones);
    for (int i = 0; i < 3; i++) {
        free(rays->dir[i]);
        free(rays->org[i]);
    }
    free(rays->hit_t);
    free(rays->hit);
    free(rays->t_of_tile);
    free(rays->of_tile);
    free(rays);
}

/* ---- The hit pixels, round by round --------------------------------------------------------------------------- */

/* Lists the hits of one tile of a round in the tile's own part of the list. */
static void list_one(void *argument, uint32_t index)
{
    bench_rays *rays = argument;
    rays->tile_hits[index] = bench_tile_hits(rays->axes, rays->planes->t, rays->round_first + index,
                                             rays->of_tile + (size_t)index * (BENCH_TILE_PIXELS + 1),
                                             rays->t_of_tile + (size_t)index * (BENCH_TILE_PIXELS + 1));
}

/* Appends the hits of the next `tiles` tiles. */
static void list_round(bench_rays *rays, uint32_t tiles)
{
    if (cgt_context_get_threads(rays->context) == 1) {
        for (uint32_t i = 0; i < tiles; i++)
            rays->hits += bench_tile_hits(rays->axes, rays->planes->t, rays->round_first + i, rays->hit + rays->hits,
                                          rays->hit_t + rays->hits);
        rays->round_first += tiles;
        return;
    }
    cgt_context_run_tasks(rays->context, list_one, rays, tiles);
    for (uint32_t i = 0; i < tiles; i++) {
        const size_t hits = rays->tile_hits[i], from = (size_t)i * (BENCH_TILE_PIXELS + 1);
        memcpy(rays->hit + rays->hits, rays->of_tile + from, hits * sizeof *rays->hit);
        memcpy(rays->hit_t + rays->hits, rays->t_of_tile + from, hits * sizeof *rays->hit_t);
        rays->hits += hits;
    }
    rays->round_first += tiles;
}

/* ---- Making rays --------------------------------------------------------------------------------------------- */

/* The hits of a batch that a piece of work covers. */
static uint64_t piece_begin(uint32_t piece) { return (uint64_t)piece * GROUPS_PER_PIECE * GROUP; }
static uint64_t piece_end(const bench_rays *rays, uint32_t piece)
{
    const uint64_t end = piece_begin(piece) + GROUPS_PER_PIECE * GROUP;
    return end < rays->batch_hits ? end : rays->batch_hits;
}

/* Of a piece of a batch, for a sink. */
static void make_shadow_piece(void *argument, uint32_t piece)
{
    const bench_rays *rays = argument;
    const uint64_t first = piece_begin(piece), hit = rays->batch_first + first;
    float *org[3], *dir[3];
    for (int a = 0; a < 3; a++) {
        org[a] = rays->org[a] + first;
        dir[a] = rays->dir[a] + first;
    }
    bench_make_shadow_rays(rays->axes, rays->light, rays->hit + hit, rays->hit_t + hit,
                           (uint32_t)(piece_end(rays, piece) - first), org, dir);
}

static void make_sky_piece(void *argument, uint32_t piece)
{
    const bench_rays *rays = argument;
    const bench_sky_rays sky = {.axes = rays->axes,
                                .planes = rays->planes,
                                .hit = rays->hit + rays->batch_first,
                                .t = rays->hit_t + rays->batch_first,
                                .hits = rays->batch_hits,
                                .samples = rays->samples,
                                .diffuse = rays->diffuse,
                                .org = {rays->org[0], rays->org[1], rays->org[2]},
                                .dir = {rays->dir[0], rays->dir[1], rays->dir[2]}};
    bench_make_sky_rays(&sky, piece_begin(piece), piece_end(rays, piece));
}

/* ---- Passes -------------------------------------------------------------------------------------------------- */

/* Rays as a structure of arrays. Shadow rays end at t = 1. */
static cgt_rays array_of(const bench_rays *rays, float *const org[3], float *const dir[3], uint64_t count, int light)
{
    cgt_rays array;
    memset(&array, 0, sizeof array);
    array.count = count;
    for (int i = 0; i < 3; i++) {
        array.org[i] = org[i];
        array.dir[i] = dir[i];
    }
    array.t_max = light ? rays->ones : NULL;
    return array;
}

static cgt_result trace_batch(const bench_rays *rays, const bench_rays_sink *sink, uint64_t count, int light)
{
    const cgt_rays array = array_of(rays, rays->org, rays->dir, count, light);
    const cgt_hits scratch = {.t = rays->t, .primitive = rays->primitive};
    return sink->batch(sink->user, &array, &scratch, rays->occluded);
}

BENCH_CLONES
static uint64_t sum_bytes(const uint8_t *byte, uint64_t count)
{
    uint64_t sum = 0;
    for (uint64_t i = 0; i < count; i++)
        sum += byte[i];
    return sum;
}

/* One pass over all hit pixels with `samples` rays each; shadow rays where light is 1. */
static cgt_result trace_pass(bench_rays *rays, const bench_rays_sink *sink, uint32_t samples, int light,
                             uint64_t *occluded)
{
    const uint64_t batch = rays->batch_rays / samples / GROUP * GROUP; /* hit pixels: at least one group */
    const uint64_t per_piece = (uint64_t)GROUPS_PER_PIECE * GROUP;

    *occluded = 0;
    rays->samples = samples;
    rays->hits = rays->batch_first = rays->round_first = 0;
    while (rays->round_first < rays->tiles) {
        const uint32_t tiles = rays->tiles - rays->round_first;
        list_round(rays, tiles < rays->round_tiles ? tiles : rays->round_tiles);
        /* whole groups, but for the last one */
        const uint64_t end = rays->round_first < rays->tiles ? rays->hits / GROUP * GROUP : rays->hits;
        for (; rays->batch_first < end; rays->batch_first += rays->batch_hits) {
            const uint64_t left = end - rays->batch_first;
            rays->batch_hits = left < batch ? left : batch;
            const uint32_t pieces = (uint32_t)((rays->batch_hits + per_piece - 1) / per_piece);
            cgt_context_run_tasks(rays->context, light ? make_shadow_piece : make_sky_piece, rays, pieces);

            const uint64_t count = rays->batch_hits * samples;
            const cgt_result result = trace_batch(rays, sink, count, light);
            if (result != CGT_OK)
                return result;
            *occluded += sum_bytes(rays->occluded, count);
        }
    }
    return CGT_OK;
}

/* ---- Shadow rays tile by tile -------------------------------------------------------------------------------- */

typedef struct shadow_pass {
    const bench_rays *rays;
    const bench_rays_sink *sink;
    atomic_uint_least64_t hits, hidden;
    atomic_int failed; /* the last failure; 0: none */
} shadow_pass;

/* A thread's memory for a tile. */
typedef struct shadow_tile {
    uint32_t pixel[BENCH_TILE_PIXELS + 1];
    float t[BENCH_TILE_PIXELS + 1];
    float org[3][BENCH_TILE_PIXELS], dir[3][BENCH_TILE_PIXELS];
    uint8_t occluded[BENCH_TILE_PIXELS];
} shadow_tile;

static cgt_result trace_shadow_tile(const shadow_pass *pass, shadow_tile *s, uint32_t count)
{
    const bench_rays *rays = pass->rays;
    float *const org[3] = {s->org[0], s->org[1], s->org[2]}, *const dir[3] = {s->dir[0], s->dir[1], s->dir[2]};
    bench_make_shadow_rays(rays->axes, rays->light, s->pixel, s->t, count, org, pass->sink->wants_dir ? dir : NULL);
    const cgt_rays array = array_of(rays, org, dir, count, 1);
    return pass->sink->tile(pass->sink->user, rays->light, &array, s->occluded);
}

static void shadow_one(void *argument, uint32_t tile)
{
    shadow_pass *pass = argument;
    shadow_tile s;
    const uint32_t count = bench_tile_hits(pass->rays->axes, pass->rays->planes->t, tile, s.pixel, s.t);
    const cgt_result result = count ? trace_shadow_tile(pass, &s, count) : CGT_OK;
    if (result != CGT_OK)
        atomic_store(&pass->failed, (int)result);
    else if (count)
        atomic_fetch_add(&pass->hidden, sum_bytes(s.occluded, count));
    atomic_fetch_add(&pass->hits, count);
}

cgt_result bench_rays_shadow(bench_rays *rays, const bench_rays_sink *sink, const float light[3], uint64_t *hidden)
{
    shadow_pass pass = {.rays = rays, .sink = sink};
    memcpy(rays->light, light, sizeof rays->light);
    if (!sink->tile)
        return trace_pass(rays, sink, 1, 1, hidden);
    atomic_init(&pass.hits, 0);
    atomic_init(&pass.hidden, 0);
    atomic_init(&pass.failed, 0);
    cgt_context_run_tasks(rays->context, shadow_one, &pass, rays->tiles);
    rays->hits = atomic_load(&pass.hits);
    *hidden = atomic_load(&pass.hidden);
    return (cgt_result)atomic_load(&pass.failed);
}

/* ---- The others ---------------------------------------------------------------------------------------------- */

cgt_result bench_rays_ao(bench_rays *rays, const bench_rays_sink *sink, uint32_t samples, uint64_t *open)
{
    uint64_t occluded = 0;
    const cgt_result result = trace_pass(rays, sink, samples, 0, &occluded);
    *open = rays->hits * samples - occluded;
    return result;
}

cgt_result bench_rays_bounce(bench_rays *rays, const bench_rays_sink *sink)
{
    uint64_t occluded = 0;
    rays->diffuse = 1;
    const cgt_result result = trace_pass(rays, sink, 1, 0, &occluded);
    rays->diffuse = 0;
    return result;
}

uint32_t bench_rays_pixel(const bench_rays *rays, uint64_t ray, uint32_t samples)
{
    const uint64_t first = ray / ((uint64_t)GROUP * samples) * GROUP, left = rays->hits - first;
    const uint64_t pixels = left < GROUP ? left : GROUP;
    return rays->hit[first + (ray - first * samples) % pixels];
}
