/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shadows of a frame, light by light: cut into tiles, each a task. The hits of a tile are packed and go to the light
 * together, as those of cgt_occluded_points do. */
#include <math.h>

#include "core/float_environment.h"
#include "trace/bands/band_trace.h"
#include "trace/frame_points.h"
#include "trace/trace_light.h"

#define SAMPLED_TILES 8u /* that are looked at before tiles of the grid or a tree are chosen */

typedef struct shadow_job {
    const cgt_scene *scene;
    cgt_frame_source source; /* with the light */
    uint8_t *occluded;       /* the light's plane */
    cgt_camera_rays camera;
    cgt_trace_settings settings;
    uint32_t tiles_across, tiles;
    cgt_trace_counter *counter;
    const cgt_band_call *bands; /* NULL: the scene has none */
    cgt_light_progress progress;
} shadow_job;

/* The first pixel of a tile. */
static uint32_t tile_x(const shadow_job *job, uint32_t index) { return index % job->tiles_across * CGT_SHADOW_TILE; }
static uint32_t tile_y(const shadow_job *job, uint32_t index) { return index / job->tiles_across * CGT_SHADOW_TILE; }

/* ---- a light ---- */

static uint8_t *tile_results(const shadow_job *job, uint32_t index)
{
    return job->occluded + tile_y(job, index) * job->source.row_stride + tile_x(job, index);
}

/* Returns whether the loose grid's tiles did not give the points up. */
static bool trace_batch(const shadow_job *job, uint32_t index, cgt_frame_points *p, cgt_counts *counts)
{
    const cgt_scene *s = job->scene;
    if (job->bands)
        return cgt_bands_trace(job->bands, index % job->bands->slots, &p->batch.rays, job->source.light, 0, p->live,
                               NULL, p->batch.occluded, counts);
    const cgt_trace_settings settings = cgt_light_task_settings(&job->settings, &job->progress);
    return s->context->kernel->trace_light(&s->committed_scene, &p->batch.rays, job->source.light, 0, p->live,
                                           &settings, p->batch.occluded, counts);
}

static void trace_shadow_tile(void *argument, uint32_t index, cgt_scratch *scratch)
{
    shadow_job *job = argument;
    cgt_counts counts = {.scratch = scratch};
    cgt_frame_points *p = cgt_scratch_take(scratch, sizeof *p);
    job->scene->context->kernel->list_frame_points(&job->source, tile_x(job, index), tile_y(job, index), p);
    const bool tries = p->live && !cgt_light_is_hopeless(&job->progress);
    const bool done = !p->live || (tries && trace_batch(job, index, p, &counts));
    if (tries)
        cgt_light_remember(&job->progress, job->scene, &counts, p->live, done);
    if (!done) {
        counts.given_up = p->live;
        *tile_results(job, index) = CGT_LIGHT_GIVEN_UP;
        atomic_fetch_add_explicit(&job->progress.given_up, p->live, memory_order_relaxed);
        atomic_fetch_add_explicit(&job->progress.untried, tries ? 0 : p->live, memory_order_relaxed);
    } else {
        counts.rays += p->invalid;
        counts.invalid_rays += p->invalid;
        cgt_frame_points_store(&job->source, tile_x(job, index), tile_y(job, index), p, job->occluded);
    }
    cgt_scratch_return(scratch, p);
    cgt_trace_counter_add(job->counter, &counts);
}

static void trace_given_up_tile(void *argument, uint32_t index, cgt_scratch *scratch)
{
    if (*tile_results(argument, index) == CGT_LIGHT_GIVEN_UP)
        trace_shadow_tile(argument, index, scratch);
}

/* Looks at some tiles. Returns about how many points the frame has. */
static uint64_t look(const shadow_job *job, cgt_light_estimate *estimate, cgt_scratch *scratch)
{
    const uint32_t sampled = job->tiles < SAMPLED_TILES ? job->tiles : SAMPLED_TILES;
    uint64_t live = 0;
    cgt_frame_points *p = cgt_scratch_take(scratch, sizeof *p);
    cgt_float_environment callers;
    *estimate = (cgt_light_estimate){0};
    cgt_float_environment_enter(&callers);
    for (uint32_t k = 0; k < sampled; k++) {
        const uint32_t index = (uint32_t)(((uint64_t)job->tiles * (2 * k + 1)) / (2 * sampled));
        job->scene->context->kernel->list_frame_points(&job->source, tile_x(job, index), tile_y(job, index), p);
        live += p->live;
        cgt_light_estimate_add(estimate, job->scene, job->source.light, &p->batch.rays, 0, p->live);
    }
    cgt_float_environment_leave(&callers);
    cgt_scratch_return(scratch, p);
    return sampled ? live * job->tiles / sampled : 0;
}

static cgt_light_tasks tasks_of(shadow_job *job)
{
    return (cgt_light_tasks){.scene = job->scene,
                             .light = job->source.light,
                             .trace = trace_shadow_tile,
                             .trace_given_up = trace_given_up_tile,
                             .argument = job,
                             .tasks = job->tiles,
                             .progress = &job->progress,
                             .bands = &job->bands};
}

static cgt_result trace_light_in_bands(shadow_job *job)
{
    atomic_store_explicit(&job->progress.given_up, 0, memory_order_relaxed);
    job->progress.budget = 0;
    const cgt_light_tasks tasks = tasks_of(job);
    const uint64_t points = (uint64_t)job->tiles * (CGT_SHADOW_TILE * CGT_SHADOW_TILE);
    return cgt_light_run_bands(&tasks, &job->settings, points, CGT_SHADOW_TILE * CGT_SHADOW_TILE);
}

/* Traces all tiles to the light. */
static cgt_result trace_light(shadow_job *job)
{
    const cgt_scene *s = job->scene;
    cgt_trace_settings *settings = &job->settings;
    cgt_light_estimate estimate;
    cgt_scratch *scratch = cgt_scratch_borrow(s->context, 1);
    if (!scratch)
        return CGT_ERROR_OUT_OF_MEMORY;
    const uint64_t points = look(job, &estimate, scratch);
    cgt_scratch_give_back(s->context, scratch);
    const cgt_result result = cgt_light_choose(s, job->source.light, &estimate, points, settings, &job->progress);
    if (result != CGT_OK)
        return result;
    const cgt_light_tasks tasks = tasks_of(job);
    return cgt_light_run_structure(&tasks, settings);
}

/* ---- the call ---- */

void cgt_shadow_options_init(cgt_shadow_options *shadows) { *shadows = (cgt_shadow_options){0}; }

static cgt_result check_shadows(cgt_context *c, const shadow_job *job, const cgt_light *lights, uint32_t count)
{
    const cgt_frame *f = job->source.frame;
    if (!f->t)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "shadows: the frame needs its plane t");
    if (!(job->source.t_min >= 0))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "shadows: t_min %g: 0 or more", (double)job->source.t_min);
    if (count && job->source.row_stride > SIZE_MAX / f->height / count)
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "shadows: the planes of %u lights leave the address space", count);
    cgt_result result = CGT_OK;
    for (uint32_t k = 0; k < count && result == CGT_OK; k++)
        result = cgt_check_light(c, &lights[k]);
    return result;
}

/* Checks all arguments and makes the camera's rays. */
static cgt_result prepare_job(shadow_job *job, const cgt_camera *camera, const cgt_light *lights, uint32_t count,
                              const cgt_trace_options *options)
{
    const cgt_frame *f = job->source.frame;
    cgt_context *c = job->scene->context;
    cgt_result result = cgt_trace_prepare(job->scene, options, false, &job->settings, job->counter);
    if (result == CGT_OK)
        result = cgt_check_frame(c, f);
    if (result != CGT_OK)
        return result;
    job->source.row_stride = f->row_stride ? f->row_stride : f->width;
    job->tiles_across = (f->width + CGT_SHADOW_TILE - 1) / CGT_SHADOW_TILE;
    job->tiles = job->tiles_across * ((f->height + CGT_SHADOW_TILE - 1) / CGT_SHADOW_TILE);
    result = check_shadows(c, job, lights, count);
    return result == CGT_OK ? cgt_prepare_camera(c, camera, f, &job->camera) : result;
}

cgt_result cgt_occluded_frame(const cgt_scene *scene, const cgt_camera *camera, const cgt_frame *frame,
                              const cgt_light *lights, uint32_t count, const cgt_shadow_options *shadows,
                              uint8_t *occluded, const cgt_trace_options *options)
{
    cgt_trace_counter counter;
    if (!scene || !camera || !frame || (count && (!lights || !occluded)))
        return CGT_ERROR_INVALID_ARGUMENT;
    shadow_job job = {.scene = scene, .source = {.frame = frame}, .counter = &counter};
    job.source.camera = &job.camera;
    job.source.t_min = shadows ? shadows->t_min : 0;
    cgt_result result = prepare_job(&job, camera, lights, count, options);
    if (result != CGT_OK)
        return result;
    job.source.has_masks = cgt_primitives_masked_out(&scene->committed_scene.prims, job.camera.mask);
    for (uint32_t k = 0; k < count && result == CGT_OK; k++) {
        job.source.light = &lights[k];
        job.occluded = occluded + k * job.source.row_stride * frame->height;
        result = scene->in_bands ? trace_light_in_bands(&job) : trace_light(&job);
    }
    if (result == CGT_OK)
        cgt_trace_store_statistics(options, &job.settings, &counter);
    return result;
}
