/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ambient occlusion of a frame: cut into tiles, each a task. The rays of a tile's pixels go through the structure in
 * batches of neighbours, as those of cgt_occluded_rays do. */
#include <math.h>

#include "query/ambient_directions.h"
#include "core/scratch_tasks.h"
#include "dispatch/kernel.h"
#include "trace/trace_call.h"
#include "builders/bvh/bvh_on_demand.h"
#include "trace/bands/band_trace.h"

#define TILE_BITS 5u
#define TILE_EDGE (1u << TILE_BITS)
#define BATCH CGT_STREAM_CHUNK /* rays, at most */

typedef struct ambient_job {
    const cgt_scene *scene;
    const cgt_frame *frame;
    cgt_ambient_options ambient;
    float *visibility;
    cgt_camera_rays camera;
    bool has_masks; /* the camera's mask leaves something out */
    cgt_trace_settings settings;
    size_t row_stride;
    uint32_t tiles_across;
    uint32_t batch; /* rays that are traced together */
    cgt_trace_counter *counter;
    const cgt_band_call *bands; /* NULL: the scene has none */
} ambient_job;

/* A task's state, in its scratch. */
typedef struct ray_batch {
    float org[3][BATCH], dir[3][BATCH], t_max[BATCH];
    uint32_t primitive[BATCH], geometry[BATCH], mask[BATCH];
    uint8_t occluded[BATCH];
    uint32_t rays, pixels;
    size_t element[TILE_EDGE * TILE_EDGE]; /* of the planes, of each pixel */
    cgt_ambient_points points;
    cgt_counts counts;
} ray_batch;

/* ---- batches ---- */

static void trace_batch(const ambient_job *job, uint32_t tile, ray_batch *b)
{
    const cgt_scene *s = job->scene;
    const uint32_t samples = job->ambient.samples;
    const cgt_rays rays = {.count = b->rays,
                           .org = {b->org[0], b->org[1], b->org[2]},
                           .dir = {b->dir[0], b->dir[1], b->dir[2]},
                           .t_max = isinf(job->ambient.radius) ? NULL : b->t_max,
                           .mask = job->has_masks ? b->mask : NULL,
                           .skip_primitive = b->primitive,
                           .skip_geometry = b->geometry};
    if (!b->rays)
        return;
    if (job->bands)
        cgt_bands_trace(job->bands, tile % job->bands->slots, &rays, NULL, 0, b->rays, NULL, b->occluded, &b->counts);
    else
        s->context->kernel->trace_rays(&s->committed_scene, &rays, 0, b->rays, &job->settings, NULL, b->occluded,
                                       &b->counts);
    for (uint32_t i = 0; i < b->pixels; i++) {
        uint32_t unoccluded = samples;
        for (uint32_t k = 0; k < samples; k++)
            unoccluded -= b->occluded[i * samples + k];
        job->visibility[b->element[i]] = (float)unoccluded / (float)samples;
    }
    b->rays = b->pixels = 0;
}

/* Appends the rays of a pixel with a hit to the batch. */
static void append_pixel(const ambient_job *job, uint32_t x, uint32_t y, size_t element, ray_batch *b)
{
    const cgt_frame *f = job->frame;
    const uint32_t first = b->rays, end = first + job->ambient.samples;
    float org[3], dir[3], n[3], facing = 0;
    cgt_camera_pixel(&job->camera, x, y, org, dir);
    for (int a = 0; a < 3; a++) {
        n[a] = f->normal[a][element];
        facing += n[a] * dir[a];
    }
    for (int a = 0; a < 3; a++) {
        const float start = org[a] + f->t[element] * dir[a];
        n[a] = facing > 0 ? -n[a] : n[a];
        for (uint32_t i = first; i < end; i++)
            b->org[a][i] = start;
    }
    for (uint32_t i = first; i < end; i++) {
        b->primitive[i] = f->primitive[element];
        b->geometry[i] = f->geometry[element];
    }
    float *const dir_out[3] = {b->dir[0] + first, b->dir[1] + first, b->dir[2] + first};
    cgt_ambient_directions(&b->points, &job->ambient, x, y, n, dir_out);
    b->element[b->pixels++] = element;
    b->rays = end;
}

/* The even bits of i, packed: x of a Morton code; of i >> 1: y. */
static uint32_t even_bits(uint32_t i)
{
    uint32_t bits = 0;
    for (uint32_t k = 0; k < TILE_BITS; k++)
        bits |= (i >> 2 * k & 1) << k;
    return bits;
}

/* Pixels along a Morton curve, so that those of a batch are neighbours. */
static void trace_ambient_tile(void *argument, uint32_t index, cgt_scratch *scratch)
{
    const ambient_job *job = argument;
    const cgt_frame *f = job->frame;
    const uint32_t x0 = index % job->tiles_across * TILE_EDGE, y0 = index / job->tiles_across * TILE_EDGE;
    ray_batch *b = cgt_scratch_take(scratch, sizeof *b);
    b->counts = (cgt_counts){.scratch = scratch};
    b->rays = b->pixels = 0;
    cgt_ambient_points_init(job->ambient.samples, &b->points);
    for (uint32_t i = 0; i < job->batch && !isinf(job->ambient.radius); i++)
        b->t_max[i] = job->ambient.radius;
    for (uint32_t i = 0; i < job->batch && job->has_masks; i++)
        b->mask[i] = job->camera.mask;
    for (uint32_t i = 0; i < TILE_EDGE * TILE_EDGE; i++) {
        const uint32_t x = x0 + even_bits(i), y = y0 + even_bits(i >> 1);
        const size_t element = (size_t)y * job->row_stride + x;
        if (x >= f->width || y >= f->height)
            continue;
        if (f->primitive[element] == CGT_INVALID_ID) {
            job->visibility[element] = 1;
            continue;
        }
        if (b->rays + job->ambient.samples > job->batch)
            trace_batch(job, index, b);
        append_pixel(job, x, y, element, b);
    }
    trace_batch(job, index, b);
    cgt_trace_counter_add(job->counter, &b->counts);
    cgt_scratch_return(scratch, b);
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
    if (!(a->radius > 0))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "ambient: radius %g: 0 or more", (double)a->radius);
    if (!f->t || !f->primitive || !f->geometry || !f->normal[0])
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT,
                        "ambient: the frame needs its planes t, primitive, geometry and normal");
    return CGT_OK;
}

/* Checks all arguments and makes the camera's rays. */
static cgt_result prepare_job(ambient_job *job, const cgt_camera *camera, const cgt_trace_options *options,
                              cgt_trace_counter *counter)
{
    const cgt_frame *f = job->frame;
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
    if (!scene || !camera || !frame || !visibility)
        return CGT_ERROR_INVALID_ARGUMENT;
    ambient_job job = {.scene = scene,
                       .frame = frame,
                       .ambient = with_defaults(ambient),
                       .visibility = visibility,
                       .counter = &counter};
    cgt_result result = prepare_job(&job, camera, options, &counter);
    if (result != CGT_OK)
        return result;
    const uint64_t rays = (uint64_t)frame->width * frame->height * job.ambient.samples;
    cgt_band_call bands;
    if (scene->in_bands) {
        result = cgt_bands_begin(scene, &job.settings, rays, CGT_RAYS_CHUNK, &bands);
        if (result == CGT_OK && (result = cgt_bands_build_bvh(&bands, rays)) != CGT_OK)
            cgt_bands_end(&bands);
    } else
        result = cgt_bvh_build_on_demand(scene, rays, &job.settings.use_bvh);
    if (result != CGT_OK)
        return result;
    /* what does not go as streams is traced by smaller chunks */
    job.batch = job.settings.use_bvh && !scene->in_bands && !scene->committed_scene.brute_force ? CGT_STREAM_CHUNK
                                                                                                : CGT_RAYS_CHUNK;
    job.has_masks = cgt_primitives_masked_out(&scene->committed_scene.prims, job.camera.mask);
    job.row_stride = frame->row_stride ? frame->row_stride : frame->width;
    job.tiles_across = (frame->width + TILE_EDGE - 1) / TILE_EDGE;
    const uint32_t tiles = job.tiles_across * ((frame->height + TILE_EDGE - 1) / TILE_EDGE);
    if (scene->in_bands) {
        job.bands = &bands;
        result = cgt_bands_run(&bands, trace_ambient_tile, &job, tiles);
        cgt_bands_end(&bands);
    } else
        result = cgt_run_scratch_tasks(scene->context, trace_ambient_tile, &job, tiles);
    if (result != CGT_OK)
        return result;
    cgt_trace_store_statistics(options, &job.settings, &counter);
    return CGT_OK;
}
