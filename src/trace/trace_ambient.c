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
#define SQUARES 2u /* side by side, they make a tile: with four rays a pixel it fills a batch */
#define LINE 16u   /* pixels of a cache line */
#define BLOCK 4u   /* pixels of a square come in blocks of so many across and down */
#define BLOCK_PIXELS (BLOCK * BLOCK)
#define WHOLE_BLOCK 0xffffu
#define TILE_PIXELS (SQUARES * SQUARE_EDGE * SQUARE_EDGE)
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
    size_t element[TILE_PIXELS]; /* of the planes, of each pixel */
    cgt_ambient_points points;
    cgt_counts counts;
} ray_batch;

_Static_assert(TILE_PIXELS <= CGT_AMBIENT_PIXELS, "a tile's pixels fit into a batch");
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
    if ((b->pixels.count + pixels) * job->ambient.samples > job->batch)
        trace_batch(job, tile, b);
}

/* Appends the pixels of a block with a hit; the others see the whole sky. */
static void append_block(const ambient_job *job, uint32_t tile, uint32_t x0, uint32_t y0, ray_batch *b)
{
    const cgt_frame *f = job->frame;
    const uint32_t width = f->width - x0 < BLOCK ? f->width - x0 : BLOCK;
    const uint32_t height = f->height - y0 < BLOCK ? f->height - y0 : BLOCK;
    const size_t first = (size_t)y0 * job->row_stride + x0;
    uint32_t hits = 0;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            hits |= (uint32_t)(f->primitive[first + y * job->row_stride + x] != CGT_INVALID_ID) << (y * BLOCK + x);
    if (hits == WHOLE_BLOCK && BLOCK_PIXELS * job->ambient.samples <= job->batch) {
        make_room(job, tile, BLOCK_PIXELS, b);
        for (uint32_t y = 0; y < BLOCK; y++)
            append_pixels(job, x0, y0 + y, first + y * job->row_stride, BLOCK, b);
        return;
    }
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const size_t element = first + y * job->row_stride + x;
            if (hits >> (y * BLOCK + x) & 1) {
                make_room(job, tile, 1, b);
                append_pixels(job, x0 + x, y0 + y, element, 1, b);
            } else
                job->visibility[element] = 1;
        }
}

/* Bits 0, 2 and 4 of i: x of a block's Morton code in its square; of i >> 1: y. */
static uint32_t even_bits(uint32_t i) { return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4); }

/* Prefetches what a square reads of the planes: along a Morton curve no machine foresees it. */
static void prefetch_square(const ambient_job *job, uint32_t x0, uint32_t y0)
{
    const cgt_frame *f = job->frame;
    const size_t apart = job->vector_stride;
    const struct {
        const void *elements;
        size_t stride; /* from one pixel to the next */
    } plane[] = {{f->t, 1},
                 {f->primitive, 1},
                 {f->geometry, 1},
                 {f->normal[0], apart},
                 {f->normal[1], apart},
                 {f->normal[2], apart},
                 {job->visibility, 1}};
    const uint32_t width = f->width - x0 < SQUARE_EDGE ? f->width - x0 : SQUARE_EDGE;
    for (uint32_t y = y0; y < y0 + SQUARE_EDGE && y < f->height; y++)
        for (uint32_t k = 0; k < sizeof plane / sizeof *plane; k++) {
            const size_t bytes = plane[k].stride * sizeof(float), first = (size_t)y * job->row_stride + x0;
            const char *row = (const char *)plane[k].elements + first * bytes;
            const size_t step = bytes > LINE * sizeof(float) ? bytes : LINE * sizeof(float);
            for (size_t i = 0; i < width * bytes; i += step)
                __builtin_prefetch(row + i);
            __builtin_prefetch(row + (width - 1) * bytes); /* rows begin anywhere in a line */
        }
}

static void visit_tile(const ambient_job *job, uint32_t x, uint32_t y)
{
    const cgt_frame *f = job->frame;
    const uint32_t width = f->width - x < SQUARES * SQUARE_EDGE ? f->width - x : SQUARES * SQUARE_EDGE;
    const uint32_t height = f->height - y < SQUARE_EDGE ? f->height - y : SQUARE_EDGE;
    cgt_visits_enter(job->visits);
    cgt_visits_leave(job->visits, job->ambient.visitor(job->ambient.visitor_user, x, y, width, height));
}

/* Blocks of pixels along a Morton curve in each square, so that those of a batch are neighbours. */
static void trace_ambient_tile(void *argument, uint32_t index, cgt_scratch *scratch)
{
    const ambient_job *job = argument;
    const cgt_frame *f = job->frame;
    const uint32_t x0 = index % job->tiles_across * SQUARES * SQUARE_EDGE;
    const uint32_t y0 = f->first_row + index / job->tiles_across * SQUARE_EDGE;
    if (cgt_visits_stopped(job->visits))
        return;
    ray_batch *b = cgt_scratch_take(scratch, sizeof *b);
    b->counts = (cgt_counts){.scratch = scratch};
    b->pixels.count = 0;
    memset(b->occluded, 0, sizeof b->occluded);
    cgt_ambient_points_init(job->ambient.first, job->ambient.samples, &b->points);
    const uint32_t all = TILE_PIXELS * job->ambient.samples, most = all < job->batch ? all : job->batch;
    for (uint32_t i = 0; i < most && !isinf(job->ambient.radius); i++)
        b->t_max[i] = job->ambient.radius;
    for (uint32_t i = 0; i < most && job->has_masks; i++)
        b->mask[i] = job->camera.mask;
    for (uint32_t i = 0; i < TILE_PIXELS / BLOCK_PIXELS; i++) {
        const uint32_t square = i / SQUARE_BLOCKS;
        if (i % SQUARE_BLOCKS == 0 && x0 + square * SQUARE_EDGE < f->width)
            prefetch_square(job, x0 + square * SQUARE_EDGE, y0);
        const uint32_t x = x0 + square * SQUARE_EDGE + even_bits(i) * BLOCK, y = y0 + even_bits(i >> 1) * BLOCK;
        if (x < f->width && y < f->height)
            append_block(job, index, x, y, b);
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
    a.radius = a.radius == 0 ? defaults.radius : a.radius;
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
    if (!(a->radius > 0))
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
    job.tiles_across = (frame->width + SQUARES * SQUARE_EDGE - 1) / (SQUARES * SQUARE_EDGE);
    const uint32_t tiles = job.tiles_across * ((cut.row_count + SQUARE_EDGE - 1) / SQUARE_EDGE);
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
