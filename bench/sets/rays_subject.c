/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench rays: sets of rays of a kind, in an order, for a query, traced in calls of a given size. */
#include <stdlib.h>
#include <string.h>

#include "common/bench_random.h"
#include "sets/bench_sets.h"

const char *const bench_rays_kinds[] = {"frame", "camera", "shadow", "ao", "bounce", "random", NULL};
const char *const bench_rays_orders[] = {"camera", "tile", "shuffled", NULL};
const char *const bench_queries[] = {"nearest", "any", "four", NULL};

enum { FRAME, CAMERA, SHADOW, AO, BOUNCE, RANDOM, KINDS };
enum {
    BLOCKS,   /* tiles of 64x64 pixels, within them blocks of 4x4 along a Morton curve */
    TILES,    /* tiles of 64x64 pixels, row by row, each shuffled */
    SHUFFLED, /* as a whole */
    ORDERS
};
enum { NEAREST, ANY, FOUR, QUERIES };

/* The queries of a kind that are measured by default. A frame has no other. */
static const int usual[KINDS][QUERIES] = {{1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};

/* Arrays of rays that are made once and traced many times. */
typedef struct ray_array {
    uint64_t count, room;
    float *org[3], *dir[3];
    float *t_max;
    uint8_t bounded; /* 1: t_max holds; 0: the rays do not end */
} ray_array;

/* The current set. */
typedef struct rays_set {
    int kind;
    bench_rays *maker;
    uint64_t count;    /* rays */
    ray_array made;    /* in the order of blocks */
    uint64_t first;    /* the set is `count` rays of `made` from here on: those of the picture's middle */
    uint32_t *tile;    /* of each ray of the set */
    uint32_t *turn;    /* the ray at each position of the order */
    ray_array ordered; /* the rays in that order */
} rays_set;

/* ---- arrays ---- */

/* Makes room for `more` rays behind the last one. */
static cgt_result ray_array_reserve(ray_array *rays, uint64_t more)
{
    if (more > SIZE_MAX / 4 / sizeof(float) - rays->count)
        return CGT_ERROR_TOO_LARGE;
    if (rays->count + more <= rays->room)
        return CGT_OK;
    uint64_t room = rays->count + more;
    if (room < 2 * rays->room)
        room = 2 * rays->room;
    float **const arrays[] = {&rays->org[0], &rays->org[1], &rays->org[2], &rays->dir[0],
                              &rays->dir[1], &rays->dir[2], &rays->t_max};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        float *larger = realloc(*arrays[i], (size_t)room * sizeof *larger);
        if (!larger)
            return CGT_ERROR_OUT_OF_MEMORY;
        *arrays[i] = larger;
    }
    rays->room = room;
    return CGT_OK;
}

/* Keeps the rays of bench_rays.h, batch by batch. */
static cgt_result keep_batch(void *user, const cgt_rays *batch, const cgt_hits *scratch, uint8_t *occluded)
{
    (void)scratch;
    ray_array *rays = user;
    const cgt_result result = ray_array_reserve(rays, batch->count);
    if (result != CGT_OK)
        return result;
    const size_t bytes = (size_t)batch->count * sizeof(float);
    for (int a = 0; a < 3; a++) {
        memcpy(rays->org[a] + rays->count, batch->org[a], bytes);
        memcpy(rays->dir[a] + rays->count, batch->dir[a], bytes);
    }
    rays->bounded = batch->t_max != NULL;
    if (batch->t_max)
        memcpy(rays->t_max + rays->count, batch->t_max, bytes);
    rays->count += batch->count;
    memset(occluded, 0, (size_t)batch->count);
    return CGT_OK;
}

/* Rays from a random point of a box towards another, in no order; the same in each call. */
static cgt_result ray_array_random(ray_array *rays, uint32_t count, const float low[3], const float high[3])
{
    uint64_t state = bench_random_start;
    rays->count = 0;
    rays->bounded = 0;
    const cgt_result result = ray_array_reserve(rays, count);
    if (result != CGT_OK)
        return result;
    for (uint32_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++) {
            const float size = high[a] - low[a];
            const float from = low[a] + bench_random(&state) * size, to = low[a] + bench_random(&state) * size;
            rays->org[a][i] = from;
            rays->dir[a][i] = to - from;
        }
    rays->count = count;
    return CGT_OK;
}

/* The array in the form that the library takes. */
static cgt_rays ray_array_view(const ray_array *rays)
{
    cgt_rays array;
    memset(&array, 0, sizeof array);
    array.count = rays->count;
    for (int a = 0; a < 3; a++) {
        array.org[a] = rays->org[a];
        array.dir[a] = rays->dir[a];
    }
    array.t_max = rays->bounded ? rays->t_max : NULL;
    return array;
}

static void ray_array_release(ray_array *rays)
{
    for (int a = 0; a < 3; a++) {
        free(rays->org[a]);
        free(rays->dir[a]);
    }
    free(rays->t_max);
    memset(rays, 0, sizeof *rays);
}

/* ---- making ---- */

static uint32_t tile_columns(const bench_camera_axes *axes)
{
    return (axes->width + BENCH_TILE_EDGE - 1) / BENCH_TILE_EDGE;
}

/* The tile of the pixel at a position of the tile-by-tile order. Tiles of the lowest row may be cut. */
static uint32_t tile_at(const bench_camera_axes *axes, uint64_t place)
{
    const uint64_t row = (uint64_t)BENCH_TILE_EDGE * axes->width; /* pixels of a row of tiles that is not cut */
    const uint32_t down = (uint32_t)(place / row), left = axes->height - down * BENCH_TILE_EDGE;
    const uint32_t rows = left < BENCH_TILE_EDGE ? left : BENCH_TILE_EDGE;
    return down * tile_columns(axes) + (uint32_t)(place % row) / (BENCH_TILE_EDGE * rows);
}

static cgt_result make_camera_rays(const bench_camera_axes *axes, ray_array *rays)
{
    rays->count = 0;
    rays->bounded = 0;
    const cgt_result result = ray_array_reserve(rays, (uint64_t)axes->width * axes->height);
    if (result != CGT_OK)
        return result;
    for (uint32_t tile = 0; tile < bench_tiles(axes); tile++) {
        uint32_t pixel[BENCH_TILE_PIXELS];
        const uint32_t in_tile = bench_tile_pixels(axes, tile, pixel);
        for (uint32_t i = 0; i < in_tile; i++, rays->count++) {
            float dir[3];
            bench_camera_direction(axes, pixel[i] & 0xffff, pixel[i] >> 16, dir);
            for (int a = 0; a < 3; a++) {
                rays->org[a][rays->count] = axes->eye[a];
                rays->dir[a][rays->count] = dir[a];
            }
        }
    }
    return CGT_OK;
}

static cgt_result make_rays(const sets_job *job, rays_set *set)
{
    const bench_rays_sink sink = {.batch = keep_batch, .user = &set->made};
    uint64_t hits = 0; /* none: they are not traced */
    const bench_settings *s = job->settings;
    const cgt_scene_statistics *built = &bench_session_first(&job->session)->built_by->built;
    set->made.count = 0;
    switch (set->kind) {
    case CAMERA: return make_camera_rays(&job->session.axes, &set->made);
    case SHADOW: return bench_rays_shadow(set->maker, &sink, s->light, &hits);
    case AO: return bench_rays_ao(set->maker, &sink, s->ao, &hits);
    case BOUNCE: return bench_rays_bounce(set->maker, &sink);
    default: return ray_array_random(&set->made, s->random, built->bounds_min, built->bounds_max);
    }
}

static uint32_t tile_of_ray(const sets_job *job, const rays_set *set, uint64_t ray)
{
    if (set->kind == RANDOM)
        return 0;
    if (set->kind == CAMERA)
        return tile_at(&job->session.axes, ray);
    const uint32_t pixel = bench_rays_pixel(set->maker, ray, set->kind == AO ? job->settings->ao : 1);
    return (pixel >> 16) / BENCH_TILE_EDGE * tile_columns(&job->session.axes) + (pixel & 0xffff) / BENCH_TILE_EDGE;
}

static int make_set(const sets_job *job, rays_set *set)
{
    const uint64_t limit = set->kind == RANDOM ? UINT64_MAX : job->settings->rays;
    if (set->kind == FRAME)
        return PROGRAM_OK;
    if (make_rays(job, set) != CGT_OK)
        return sets_out_of_memory();
    set->count = set->made.count < limit ? set->made.count : limit;
    set->first = (set->made.count - set->count) / 2;
    free(set->tile);
    free(set->turn);
    set->tile = calloc((size_t)set->count + 1, sizeof *set->tile);
    set->turn = calloc((size_t)set->count + 1, sizeof *set->turn);
    if (!set->tile || !set->turn)
        return sets_out_of_memory();
    for (uint64_t i = 0; i < set->count; i++)
        set->tile[i] = tile_of_ray(job, set, set->first + i);
    return PROGRAM_OK;
}

/* ---- orders ---- */

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
static int order_tiles(const sets_job *job, const rays_set *set, uint64_t *state)
{
    const uint32_t tiles = bench_tiles(&job->session.axes);
    uint64_t *end = calloc((size_t)tiles + 1, sizeof *end); /* of the tile before; after filling of the tile itself */
    if (!end)
        return sets_out_of_memory();
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
    return PROGRAM_OK;
}

static int gather(rays_set *set)
{
    const ray_array *from = &set->made;
    ray_array *to = &set->ordered;
    to->count = 0;
    to->bounded = from->bounded;
    if (ray_array_reserve(to, set->count) != CGT_OK)
        return sets_out_of_memory();
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
    return PROGRAM_OK;
}

static int order_set(const sets_job *job, rays_set *set, int order)
{
    uint64_t state = bench_random_start;
    int code = PROGRAM_OK;
    if (set->kind == FRAME)
        return PROGRAM_OK;
    for (uint64_t i = 0; i < set->count; i++)
        set->turn[i] = (uint32_t)i;
    if (order == TILES)
        code = order_tiles(job, set, &state);
    else if (order == SHUFFLED)
        shuffle(set->turn, set->count, &state);
    return code == PROGRAM_OK ? gather(set) : code;
}

/* ---- what is measured ---- */

/* A frame only comes in the camera's order, random rays only shuffled. */
static int has_order(const bench_settings *s, int kind, int order)
{
    if (kind == FRAME || kind == RANDOM)
        return order == (kind == FRAME ? BLOCKS : SHUFFLED);
    return s->order[BLOCKS] || s->order[TILES] || s->order[SHUFFLED] ? s->order[order] : order == BLOCKS;
}

static int has_query(const bench_settings *s, int kind, int query)
{
    return kind == FRAME || (!s->query[NEAREST] && !s->query[ANY] && !s->query[FOUR]) ? usual[kind][query]
                                                                                      : s->query[query];
}

static int run_order(sets_job *job, rays_set *rays, int order)
{
    const bench_settings *s = job->settings;
    int code = order_set(job, rays, order);
    for (int query = 0; query < QUERIES && code == PROGRAM_OK; query++) {
        const bench_set set = {.kind = bench_rays_kinds[rays->kind],
                               .order = bench_rays_orders[order],
                               .query = rays->kind == FRAME ? BENCH_PICTURE
                                        : query == ANY      ? BENCH_ANY
                                        : query == FOUR     ? BENCH_FOUR
                                                            : BENCH_NEAREST,
                               .rays = ray_array_view(&rays->ordered)};
        if (has_query(s, rays->kind, query))
            code = sets_measure(job, &set, s->batch, s->batches, 0);
    }
    return code;
}

static int run_kind(sets_job *job, rays_set *rays)
{
    int code = make_set(job, rays);
    for (int order = 0; order < ORDERS && code == PROGRAM_OK; order++)
        if ((rays->count || rays->kind == FRAME) && has_order(job->settings, rays->kind, order))
            code = run_order(job, rays, order);
    return code;
}

static int run_file(sets_job *job)
{
    rays_set set = {0};
    set.maker = bench_rays_create(job->session.context, &job->session.axes, &job->planes, job->settings->ao);
    int code = set.maker ? PROGRAM_OK : sets_out_of_memory();
    for (set.kind = 0; set.kind < KINDS && code == PROGRAM_OK; set.kind++)
        if (bench_is_chosen(job->settings->kind, KINDS, set.kind))
            code = run_kind(job, &set);
    ray_array_release(&set.made);
    ray_array_release(&set.ordered);
    free(set.tile);
    free(set.turn);
    bench_rays_release(set.maker);
    return code;
}

int bench_rays_of_kinds(const bench_settings *settings) { return sets_run(settings, run_file); }
