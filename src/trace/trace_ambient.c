/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ambient occlusion of a frame: cut into tiles, each a task. The rays of a tile's pixels go through the structure in
 * batches of neighbours, as those of cgt_occluded_rays do. */
#include <math.h>
#include <string.h>

#include "query/ambient_directions.h"
#include "core/scratch_tasks.h"
#include "dispatch/kernel.h"
#include "trace/trace_call.h"
#include "trace/bands/band_trace.h"

#define SQUARE_BITS 5u
#define SQUARE_EDGE (1u << SQUARE_BITS)
#define LEAST_SQUARES 2u /* side by side, they make a tile: with four rays a pixel it fills a batch */
#define MOST_SQUARES 8u  /* the same where hits are few */
#define TASKS_PER_THREAD 16u
#define LINE 16u /* pixels of a cache line */
#define BLOCK 4u /* pixels of a square come in blocks of so many across and down */
#define BLOCK_PIXELS (BLOCK * BLOCK)
#define WHOLE_BLOCK 0xffffu
#define BATCH_PIXELS (LEAST_SQUARES * SQUARE_EDGE * SQUARE_EDGE) /* at most */
#define SQUARE_BLOCKS (SQUARE_EDGE * SQUARE_EDGE / BLOCK_PIXELS)
#define BATCH CGT_STREAM_CHUNK /* rays, at most */

typedef struct ambient_job {
    const cgt_scene *scene;
    const cgt_frame *frame;
    cgt_ambient_options ambient;
    float *visibility;
    cgt_camera_rays camera;
    bool has_masks; /* the camera's mask leaves something out */
    cgt_trace_settings settings;
    size_t row_stride, vector_stride;
    uint32_t squares; /* of a tile */
    uint32_t tiles_across;
    uint32_t batch; /* rays that are traced together */
    cgt_trace_counter *counter;
    const cgt_band_call *bands; /* NULL: the scene has none */
    cgt_visits *visits;
} ambient_job;

/* A task's state, in its scratch. */
typedef struct ray_batch {
    cgt_ambient_pixels pixels;
    cgt_ambient_rays rays;
    float t_max[BATCH];
    uint32_t mask[BATCH];
    uint8_t occluded[BATCH + CGT_AMBIENT_PAD];
    size_t element[BATCH_PIXELS]; /* of the planes, of each pixel */
    cgt_ambient_points points;
    cgt_counts counts;
} ray_batch;

_Static_assert(BATCH_PIXELS <= CGT_AMBIENT_PIXELS, "a batch has room for its pixels");
_Static_assert(SQUARE_BLOCKS == 64, "even_bits takes six bits");

/* ---- batches ---- */

/* Sums up the rays of each pixel, in the order that cgt_ambient_rays has them. */
static void store_visibility(const ambient_job *job, const ray_batch *b)
{
    const uint32_t lanes = job->scene->context->kernel->lanes, samples = job->ambient.samples;
    for (uint32_t i = 0; i < b->pixels.count; i += lanes) {
        const uint32_t count = b->pixels.count - i < lanes ? b->pixels.count - i : lanes;
        const uint8_t *occluded = b->occluded + (size_t)i * samples;
        uint16_t hits[CGT_AMBIENT_PAD] = {0};
        /* all of them, which compilers turn into vectors; those beyond `count` are not used */
        for (uint32_t k = 0; k < samples; k++, occluded += count)
            for (uint32_t j = 0; j < CGT_AMBIENT_PAD; j++)
                hits[j] = (uint16_t)(hits[j] + occluded[j]);
        for (uint32_t j = 0; j < count; j++)
            job->visibility[b->element[i + j]] = (float)(samples - hits[j]) / (float)samples;
    }
}

/* Completes the pixels: their scrambles, and zeros that vectors beyond the last one load. */
static void finish_pixels(const cgt_ambient_options *ambient, cgt_ambient_pixels *p)
{
    float *const reals[] = {p->x, p->y, p->t, p->normal[0], p->normal[1], p->normal[2]};
    uint32_t *const numbers[] = {p->primitive, p->geometry, p->scramble[0], p->scramble[1]};
    for (size_t k = 0; k < p->count; k++) {
        uint32_t scramble[2];
        cgt_ambient_scramble(ambient, (uint32_t)p->x[k], (uint32_t)p->y[k], scramble);
        p->scramble[0][k] = scramble[0];
        p->scramble[1][k] = scramble[1];
    }
    for (uint32_t k = 0; k < sizeof reals / sizeof *reals; k++)
        memset(reals[k] + p->count, 0, CGT_AMBIENT_PAD * sizeof(float));
    for (uint32_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        memset(numbers[k] + p->count, 0, CGT_AMBIENT_PAD * sizeof(uint32_t));
}

static void trace_batch(const ambient_job *job, uint32_t tile, ray_batch *b)
{
    const cgt_scene *s = job->scene;
    const cgt_kernel *kernel = s->context->kernel;
    const cgt_ambient_rays *from = &b->rays;
    const cgt_rays rays = {.count = (uint64_t)b->pixels.count * job->ambient.samples,
                           .org = {from->org[0], from->org[1], from->org[2]},
                           .dir = {from->dir[0], from->dir[1], from->dir[2]},
                           .t_max = isinf(job->ambient.radius) ? NULL : b->t_max,
                           .mask = job->has_masks ? b->mask : NULL,
                           .skip_primitive = from->primitive,
                           .skip_geometry = from->geometry};
    if (!b->pixels.count)
        return;
    finish_pixels(&job->ambient, &b->pixels);
    kernel->ambient_rays(&job->camera, &b->pixels, job->ambient.samples, &b->points, &b->rays);
    if (job->bands)
        cgt_bands_trace(job->bands, tile % job->bands->slots, &rays, NULL, 0, rays.count, NULL, b->occluded,
                        &b->counts);
    else
        kernel->trace_rays(&s->committed_scene, &rays, 0, rays.count, &job->settings, NULL, b->occluded, &b->counts);
    store_visibility(job, b);
    b->pixels.count = 0;
}

/* Appends `count` pixels of a row, all with hits, to the batch; the first one is an element of the planes. */
static inline __attribute__((always_inline)) void append_pixels(const ambient_job *job, uint32_t x, uint32_t y,
                                                                size_t element, uint32_t count, ray_batch *b)
{
    const cgt_frame *f = job->frame;
    cgt_ambient_pixels *p = &b->pixels;
    const size_t i = p->count, stride = job->vector_stride;
    for (uint32_t k = 0; k < count; k++) {
        p->x[i + k] = (float)(int32_t)(x + k);
        p->y[i + k] = (float)(int32_t)y;
        b->element[i + k] = element + k;
    }
    memcpy(p->t + i, f->t + element, count * sizeof(float));
    memcpy(p->primitive + i, f->primitive + element, count * sizeof(uint32_t));
    memcpy(p->geometry + i, f->geometry + element, count * sizeof(uint32_t));
    for (int a = 0; a < 3; a++)
        if (stride == 1)
            memcpy(p->normal[a] + i, f->normal[a] + element, count * sizeof(float));
        else
            for (uint32_t k = 0; k < count; k++)
                p->normal[a][i + k] = f->normal[a][(element + k) * stride];
    p->count += count;
}

/* Traces the batch if it has no room for so many pixels more. */
static inline void make_room(const ambient_job *job, uint32_t tile, uint32_t pixels, ray_batch *b)
{
    const uint32_t count = b->pixels.count + pixels;
    if (count * job->ambient.samples > job->batch || count > BATCH_PIXELS)
        trace_batch(job, tile, b);
}

/* The hits of a square: a bit for each pixel of a row. */
typedef struct square_hits {
    uint32_t row[SQUARE_EDGE];
} square_hits;

_Static_assert(SQUARE_EDGE == 32, "a row's hits are 32 bits");

static void prefetch_primitives(const ambient_job *job, uint32_t x0, uint32_t y0)
{
    const cgt_frame *f = job->frame;
    const uint32_t width = f->width - x0 < SQUARE_EDGE ? f->width - x0 : SQUARE_EDGE;
    for (uint32_t y = y0; y < y0 + SQUARE_EDGE && y < f->height; y++) {
        const uint32_t *const row = f->primitive + (size_t)y * job->row_stride + x0;
        for (uint32_t x = 0; x < width; x += LINE)
            __builtin_prefetch(row + x);
        __builtin_prefetch(row + width - 1); /* rows begin anywhere in a line */
    }
}

/* CGT_INVALID_ID is all ones. */
static inline bool are_misses(const uint32_t *primitive, uint32_t count)
{
    uint32_t all = CGT_INVALID_ID;
    for (uint32_t x = 0; x < count; x++)
        all &= primitive[x];
    return all == CGT_INVALID_ID;
}

/* Finds the hits of a square; the other pixels see the whole sky. Returns whether there are any. */
static bool find_hits(const ambient_job *job, uint32_t x0, uint32_t y0, square_hits *hits)
{
    const cgt_frame *f = job->frame;
    const uint32_t width = f->width - x0 < SQUARE_EDGE ? f->width - x0 : SQUARE_EDGE;
    uint32_t any = 0;
    for (uint32_t y = 0; y < SQUARE_EDGE; y++) {
        const size_t first = (size_t)(y0 + y) * job->row_stride + x0;
        const uint32_t count = y0 + y < f->height ? width : 0;
        uint32_t row = 0;
        if (count && !are_misses(f->primitive + first, count))
            for (uint32_t x = 0; x < count; x++)
                row |= (uint32_t)(f->primitive[first + x] != CGT_INVALID_ID) << x;
        for (uint32_t x = 0; x < count && row != UINT32_MAX; x++)
            job->visibility[first + x] = 1;
        hits->row[y] = row;
        any |= row;
    }
    return any != 0;
}

/* Appends the pixels with a hit of a block that begins at (x, y) of the square at (x0, y0). */
static void append_block(const ambient_job *job, uint32_t tile, const square_hits *of, uint32_t x0, uint32_t y0,
                         uint32_t x, uint32_t y, ray_batch *b)
{
    const size_t first = (size_t)(y0 + y) * job->row_stride + x0 + x;
    uint32_t hits = 0;
    for (uint32_t row = 0; row < BLOCK; row++)
        hits |= (of->row[y + row] >> x & 0xf) << (row * BLOCK);
    if (hits == WHOLE_BLOCK && BLOCK_PIXELS * job->ambient.samples <= job->batch) {
        make_room(job, tile, BLOCK_PIXELS, b);
        for (uint32_t row = 0; row < BLOCK; row++)
            append_pixels(job, x0 + x, y0 + y + row, first + row * job->row_stride, BLOCK, b);
        return;
    }
    for (; hits; hits &= hits - 1) {
        const uint32_t bit = (uint32_t)__builtin_ctz(hits), aside = bit % BLOCK, below = bit / BLOCK;
        make_room(job, tile, 1, b);
        append_pixels(job, x0 + x + aside, y0 + y + below, first + below * job->row_stride + aside, 1, b);
    }
}

/* Bits 0, 2 and 4 of i: x of a block's Morton code in its square; of i >> 1: y. */
static uint32_t even_bits(uint32_t i) { return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4); }

/* Prefetches what a square reads of the planes where there are hits: along a Morton curve no machine foresees it. */
static void prefetch_hits(const ambient_job *job, const square_hits *hits, uint32_t x0, uint32_t y0)
{
    const cgt_frame *f = job->frame;
    const size_t apart = job->vector_stride;
    const struct {
        const void *elements;
        size_t stride; /* from one pixel to the next */
    } plane[] = {
        {f->t, 1},           {f->geometry, 1}, {f->normal[0], apart}, {f->normal[1], apart}, {f->normal[2], apart},
        {job->visibility, 1}};
    for (uint32_t y = 0; y < SQUARE_EDGE; y++)
        for (uint32_t part = 0; part < SQUARE_EDGE / LINE; part++) {
            const uint32_t x = part * LINE, width = f->width - x0 - x < LINE ? f->width - x0 - x : LINE;
            if (!(hits->row[y] >> x & 0xffff))
                continue;
            for (uint32_t k = 0; k < sizeof plane / sizeof *plane; k++) {
                const size_t bytes = plane[k].stride * sizeof(float);
                const size_t first = (size_t)(y0 + y) * job->row_stride + x0 + x;
                const char *row = (const char *)plane[k].elements + first * bytes;
                const size_t step = bytes > LINE * sizeof(float) ? bytes : LINE * sizeof(float);
                for (size_t i = 0; i < width * bytes; i += step)
                    __builtin_prefetch(row + i);
                __builtin_prefetch(row + (width - 1) * bytes); /* rows begin anywhere in a line */
            }
        }
}

static void visit_tile(const ambient_job *job, uint32_t x, uint32_t y)
{
    const cgt_frame *f = job->frame;
    const uint32_t edge = job->squares * SQUARE_EDGE, width = f->width - x < edge ? f->width - x : edge;
    const uint32_t height = f->height - y < SQUARE_EDGE ? f->height - y : SQUARE_EDGE;
    cgt_visits_enter(job->visits);
    cgt_visits_leave(job->visits, job->ambient.visitor(job->ambient.visitor_user, x, y, width, height));
}

/* Blocks of pixels along a Morton curve in each square, so that those of a batch are neighbours. */
static void trace_ambient_tile(void *argument, uint32_t index, cgt_scratch *scratch)
{
    const ambient_job *job = argument;
    const cgt_frame *f = job->frame;
    const uint32_t edge = job->squares * SQUARE_EDGE, x0 = index % job->tiles_across * edge;
    const uint32_t end = f->width - x0 < edge ? f->width : x0 + edge;
    const uint32_t y0 = f->first_row + index / job->tiles_across * SQUARE_EDGE;
    if (cgt_visits_stopped(job->visits))
        return;
    ray_batch *b = cgt_scratch_take(scratch, sizeof *b);
    b->counts = (cgt_counts){.scratch = scratch};
    b->pixels.count = 0;
    memset(b->occluded, 0, sizeof b->occluded);
    cgt_ambient_points_init(job->ambient.first, job->ambient.samples, &b->points);
    const uint32_t all = BATCH_PIXELS * job->ambient.samples, most = all < job->batch ? all : job->batch;
    for (uint32_t i = 0; i < most && !isinf(job->ambient.radius); i++)
        b->t_max[i] = job->ambient.radius;
    for (uint32_t i = 0; i < most && job->has_masks; i++)
        b->mask[i] = job->camera.mask;
    prefetch_primitives(job, x0, y0);
    for (uint32_t x = x0; x < end; x += SQUARE_EDGE) {
        square_hits hits;
        if (x + SQUARE_EDGE < end)
            prefetch_primitives(job, x + SQUARE_EDGE, y0);
        if (!find_hits(job, x, y0, &hits))
            continue;
        prefetch_hits(job, &hits, x, y0);
        for (uint32_t i = 0; i < SQUARE_BLOCKS; i++)
            append_block(job, index, &hits, x, y0, even_bits(i) * BLOCK, even_bits(i >> 1) * BLOCK, b);
    }
    trace_batch(job, index, b);
    cgt_trace_counter_add(job->counter, &b->counts);
    cgt_scratch_return(scratch, b);
    if (job->ambient.visitor)
        visit_tile(job, x0, y0);
}

/* ---- the call ---- */

void cgt_ambient_options_init(cgt_ambient_options *ambient)
{
    *ambient = (cgt_ambient_options){.samples = 16, .radius = INFINITY};
}

/* The options with the defaults in place of zeros; ambient may be NULL. */
static cgt_ambient_options with_defaults(const cgt_ambient_options *ambient)
{
    cgt_ambient_options a, defaults;
    cgt_ambient_options_init(&defaults);
    a = ambient ? *ambient : defaults;
    a.samples = a.samples ? a.samples : defaults.samples;
    a.radius = cgt_is_zero(a.radius) ? defaults.radius : a.radius;
    return a;
}

static cgt_result check_ambient(cgt_context *c, const cgt_ambient_options *a, const cgt_frame *f)
{
    if (a->samples > CGT_AMBIENT_SAMPLES)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "ambient: %u samples: at most %u", a->samples,
                        CGT_AMBIENT_SAMPLES);
    if (a->first > UINT32_MAX - a->samples)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "ambient: first %u: beyond 2^32 - 1 with its %u samples",
                        a->first, a->samples);
    if (isnan(a->radius) || signbit(a->radius))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "ambient: radius %g: 0 or more", (double)a->radius);
    if (!f->t || !f->primitive || !f->geometry || !f->normal[0])
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT,
                        "ambient: the frame needs its planes t, primitive, geometry and normal");
    return CGT_OK;
}

/* Checks all arguments and makes the camera's rays. */
static cgt_result prepare_job(ambient_job *job, const cgt_camera *camera, const cgt_frame *f,
                              const cgt_trace_options *options, cgt_trace_counter *counter)
{
    cgt_context *c = job->scene->context;
    cgt_result result = cgt_trace_prepare(job->scene, options, false, &job->settings, counter);
    if (result == CGT_OK)
        result = cgt_check_frame(c, f);
    if (result == CGT_OK)
        result = check_ambient(c, &job->ambient, f);
    return result == CGT_OK ? cgt_prepare_camera(c, camera, f, &job->camera) : result;
}

/* Cuts the frame into tiles and returns how many: wide ones as long as there are enough for all threads, since a tile's
 * last batch is seldom full. A caller's runner counts as 64 threads. */
static uint32_t cut_tiles(ambient_job *job)
{
    const uint32_t threads = job->scene->context->threads ? job->scene->context->threads : 64;
    const uint32_t down = (job->frame->row_count + SQUARE_EDGE - 1) / SQUARE_EDGE, width = job->frame->width;
    for (job->squares = MOST_SQUARES;; job->squares /= 2) {
        job->tiles_across = (width + job->squares * SQUARE_EDGE - 1) / (job->squares * SQUARE_EDGE);
        if (job->squares == LEAST_SQUARES || job->tiles_across * (uint64_t)down >= (uint64_t)threads * TASKS_PER_THREAD)
            return job->tiles_across * down;
    }
}

cgt_result cgt_ambient_occlusion(const cgt_scene *scene, const cgt_camera *camera, const cgt_frame *frame,
                                 const cgt_ambient_options *ambient, float *visibility,
                                 const cgt_trace_options *options)
{
    cgt_trace_counter counter;
    cgt_visits visits;
    if (!scene || !camera || !frame || !visibility)
        return cgt_fail_null(scene, __func__);
    ambient_job job = {.scene = scene,
                       .ambient = with_defaults(ambient),
                       .visibility = visibility,
                       .counter = &counter,
                       .visits = &visits};
    cgt_result result = prepare_job(&job, camera, frame, options, &counter);
    if (result != CGT_OK)
        return result;
    const cgt_frame cut = cgt_cut_frame(frame);
    job.frame = &cut;
    const uint64_t rays = (uint64_t)cut.width * cut.row_count * job.ambient.samples;
    cgt_band_call bands;
    if (scene->in_bands) {
        result = cgt_bands_begin(scene, &job.settings, rays, CGT_RAYS_CHUNK, &bands);
        if (result == CGT_OK && (result = cgt_bands_build_bvh(&bands, rays)) != CGT_OK)
            cgt_bands_end(&bands);
    } else
        result = cgt_ready_structures(scene, rays, &job.settings);
    if (result != CGT_OK)
        return result;
    /* what does not go as streams is traced by smaller chunks */
    job.batch = job.settings.use_bvh && !scene->in_bands && !scene->committed_scene.brute_force ? CGT_STREAM_CHUNK
                                                                                                : CGT_RAYS_CHUNK;
    job.has_masks = cgt_primitives_masked_out(&scene->committed_scene.prims, job.camera.mask);
    job.row_stride = frame->row_stride ? frame->row_stride : frame->width;
    job.vector_stride = frame->vector_stride ? frame->vector_stride : 1;
    const uint32_t tiles = cut_tiles(&job);
    cgt_visits_begin(&visits);
    if (scene->in_bands) {
        job.bands = &bands;
        result = cgt_bands_run(&bands, trace_ambient_tile, &job, tiles);
        cgt_bands_end(&bands);
    } else
        result = cgt_run_scratch_tasks(scene->context, trace_ambient_tile, &job, tiles);
    if (result != CGT_OK)
        return result;
    cgt_trace_store_statistics(options, &job.settings, &counter);
    return cgt_visits_end(scene->context, &visits, "the visitor stopped the frame");
}
