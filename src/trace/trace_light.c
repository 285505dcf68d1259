/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light: cut into chunks, each a task. */
#include <math.h>
#include <string.h>

#include "core/float_environment.h"
#include "dispatch/kernel.h"
#include "trace/trace_light.h"
#include "builders/bvh/bvh_on_demand.h"
#include "trace/bands/band_trace.h"

#define SAMPLED_TASKS 4u /* that are looked at before tiles or a tree are chosen */

#define SCATTERED_POINTS 4u /* rays that count for a point that tiles gave up in bands */

#define TASKS_PER_THREAD 4u /* at least, where a task takes several chunks */

#define FEW_POINTS 256u /* fewer go through a BVH where there is one */

typedef struct light_job {
    const cgt_scene *scene;
    const cgt_light *light;
    cgt_rays points; /* without directions */
    uint8_t *occluded;
    cgt_trace_settings settings;
    cgt_trace_counter *counter;
    const cgt_band_call *bands; /* NULL: the scene has none */
    uint64_t task_points;
    bool as_given; /* a small call, whose points are dense and live */
    cgt_light_progress progress;
} light_job;

/* The end of the chunk that begins at `first`. */
static uint64_t chunk_end(uint64_t first, uint64_t end)
{
    return first + (end - first < CGT_RAYS_CHUNK ? end - first : CGT_RAYS_CHUNK);
}

static uint64_t task_end(const light_job *job, uint64_t first)
{
    const uint64_t remaining = job->points.count - first;
    return first + (remaining < job->task_points ? remaining : job->task_points);
}

/* Traces points first to end - 1 of an array, at most a chunk. Returns whether tiles did not give them up. */
static bool trace_points(const light_job *job, const cgt_rays *points, uint64_t first, uint64_t end, uint8_t *occluded,
                         cgt_counts *counts)
{
    const cgt_scene *s = job->scene;
    const cgt_trace_settings settings = cgt_light_task_settings(&job->settings, &job->progress);
    return s->context->kernel->trace_light(&s->committed_scene, points, job->light, first, end, &settings, occluded,
                                           counts);
}

/* Traces the points of a task, from `first` on, batch by batch. */
static bool trace_batches(const light_job *job, const cgt_point_order *order, uint64_t first, cgt_counts *counts)
{
    cgt_point_batch *batch = cgt_scratch_take(counts->scratch, sizeof *batch);
    bool done = true;
    for (uint32_t i = 0; i < order->live && done; i += CGT_RAYS_CHUNK) {
        const uint32_t count = (uint32_t)chunk_end(i, order->live) - i;
        cgt_point_batch_fill(batch, &job->points, first, order->number + i, count);
        done = trace_points(job, &batch->rays, 0, count, batch->occluded, counts);
        for (uint32_t k = 0; done && k < count; k++)
            job->occluded[first + order->number[i + k]] = batch->occluded[k];
    }
    cgt_scratch_return(counts->scratch, batch);
    return done;
}

/* Traces points first to end - 1, a task. */
static bool trace_structure_points(const light_job *job, uint64_t first, uint64_t end, cgt_counts *counts)
{
    if (job->as_given)
        return trace_points(job, &job->points, first, end, job->occluded, counts);
    cgt_point_order *order = cgt_scratch_take(counts->scratch, sizeof *order);
    bool done = true;
    cgt_point_order_init(order, &job->points, job->light, first, end, counts->scratch);
    if (order->as_given) {
        for (uint64_t i = first; i < end && done; i += CGT_RAYS_CHUNK)
            done = trace_points(job, &job->points, i, chunk_end(i, end), job->occluded, counts);
    } else {
        memset(job->occluded + first, 0, end - first);
        counts->rays += end - first - order->live;
        counts->invalid_rays += order->invalid;
        done = trace_batches(job, order, first, counts);
    }
    cgt_scratch_return(counts->scratch, order);
    return done;
}

/* Bands sort out what is not live themselves. */
static bool trace_task_points(const light_job *job, uint32_t index, uint64_t first, uint64_t end, cgt_counts *counts)
{
    if (job->bands)
        return cgt_bands_trace(job->bands, index % job->bands->slots, &job->points, job->light, first, end, NULL,
                               job->occluded, counts);
    return trace_structure_points(job, first, end, counts);
}

static void trace_task(void *argument, uint32_t index, cgt_scratch *scratch)
{
    light_job *job = argument;
    const uint64_t first = index * job->task_points, end = task_end(job, first);
    cgt_counts counts = {.scratch = scratch};
    const bool tries = !cgt_light_is_hopeless(&job->progress);
    const bool done = tries && trace_task_points(job, index, first, end, &counts);
    if (tries)
        cgt_light_remember(&job->progress, job->scene, &counts, end - first, done);
    if (!done) { /* the work was done, the points were not */
        counts.rays = counts.hits = counts.invalid_rays = 0;
        counts.given_up = end - first;
        job->occluded[first] = CGT_LIGHT_GIVEN_UP;
        atomic_fetch_add_explicit(&job->progress.given_up, end - first, memory_order_relaxed);
        atomic_fetch_add_explicit(&job->progress.untried, tries ? 0 : end - first, memory_order_relaxed);
    }
    cgt_trace_counter_add(job->counter, &counts);
}

static void trace_given_up_task(void *argument, uint32_t index, cgt_scratch *scratch)
{
    const light_job *job = argument;
    if (job->occluded[index * job->task_points] == CGT_LIGHT_GIVEN_UP)
        trace_task(argument, index, scratch);
}

/* Several chunks where each thread gets some of them; a caller's runner counts as 64 threads. */
static uint64_t choose_task_points(const light_job *job)
{
    const uint32_t threads = job->scene->context->threads ? job->scene->context->threads : 64;
    uint64_t points = CGT_MAX_TASK_POINTS;
    while (points > CGT_RAYS_CHUNK && job->points.count < points * threads * TASKS_PER_THREAD)
        points /= 2;
    return points;
}

cgt_result cgt_light_run_structure(const cgt_light_tasks *t, cgt_trace_settings *settings)
{
    cgt_result result = cgt_run_scratch_tasks(t->scene->context, t->trace, t->argument, t->tasks);
    while (result == CGT_OK && atomic_load_explicit(&t->progress->given_up, memory_order_relaxed)) {
        result = cgt_light_choose_again(t->scene, settings, t->progress);
        if (result == CGT_OK)
            result = cgt_run_scratch_tasks(t->scene->context, t->trace_given_up, t->argument, t->tasks);
    }
    return result;
}

cgt_result cgt_light_run_bands(const cgt_light_tasks *t, cgt_trace_settings *settings, uint64_t points, uint32_t chunk)
{
    cgt_band_call call;
    const bool by_tiles = t->light->kind == CGT_LIGHT_POINT && t->scene->options.structure == CGT_STRUCTURE_AUTO;
    cgt_result result = cgt_bands_begin(t->scene, settings, points, chunk, &call);
    if (result == CGT_OK)
        result = cgt_bands_build_bvh(&call, by_tiles ? 0 : points);
    call.by_tiles = by_tiles;
    *t->bands = &call;
    if (result == CGT_OK)
        result = cgt_bands_run(&call, t->trace, t->argument, t->tasks);
    const uint64_t given_up = atomic_load_explicit(&t->progress->given_up, memory_order_relaxed);
    if (result == CGT_OK && given_up) {
        call.by_tiles = false;
        result = cgt_bands_build_bvh(&call, given_up * SCATTERED_POINTS);
        if (result == CGT_OK)
            result = cgt_bands_run(&call, t->trace_given_up, t->argument, t->tasks);
    }
    cgt_bands_end(&call);
    *t->bands = NULL;
    return result;
}

static cgt_light_tasks tasks_of(light_job *job)
{
    return (cgt_light_tasks){.scene = job->scene,
                             .light = job->light,
                             .trace = trace_task,
                             .trace_given_up = trace_given_up_task,
                             .argument = job,
                             .tasks = (uint32_t)((job->points.count + job->task_points - 1) / job->task_points),
                             .progress = &job->progress,
                             .bands = &job->bands};
}

static cgt_result trace_bands(light_job *job)
{
    job->task_points = CGT_RAYS_CHUNK;
    const cgt_light_tasks tasks = tasks_of(job);
    return cgt_light_run_bands(&tasks, &job->settings, job->points.count, CGT_RAYS_CHUNK);
}

/* Looks at the middle batch of a task's live points. */
static void look_at_task(const light_job *job, uint64_t first, uint64_t end, cgt_light_estimate *estimate,
                         cgt_scratch *scratch)
{
    cgt_point_order *order = cgt_scratch_take(scratch, sizeof *order);
    cgt_point_batch *batch = cgt_scratch_take(scratch, sizeof *batch);
    cgt_point_order_init(order, &job->points, job->light, first, end, scratch);
    cgt_scratch_return(scratch, order); /* nobody takes it before the end */
    if (!order->live)
        return;
    const uint32_t from = order->live / 2 / CGT_RAYS_CHUNK * CGT_RAYS_CHUNK;
    const uint32_t count = (uint32_t)chunk_end(from, order->live) - from;
    if (order->as_given) {
        cgt_light_estimate_add(estimate, job->scene, job->light, &job->points, first + from, count);
        return;
    }
    cgt_point_batch_fill(batch, &job->points, first, order->number + from, count);
    cgt_light_estimate_add(estimate, job->scene, job->light, &batch->rays, 0, count);
}

/* Looks at some tasks. scratch: a block. */
static void look_at_tasks(const light_job *job, cgt_light_estimate *estimate, cgt_scratch *scratch)
{
    const uint64_t tasks = (job->points.count + job->task_points - 1) / job->task_points;
    const uint64_t sampled = tasks < SAMPLED_TASKS ? tasks : SAMPLED_TASKS;
    for (uint64_t k = 0; k < sampled; k++) {
        const uint64_t first = tasks * k / sampled * job->task_points;
        look_at_task(job, first, task_end(job, first), estimate, scratch);
    }
}

static cgt_result look(const light_job *job, cgt_light_estimate *estimate)
{
    cgt_float_environment callers;
    cgt_scratch *scratch = NULL;
    *estimate = (cgt_light_estimate){0};
    if (!job->as_given && !(scratch = cgt_scratch_borrow(job->scene->context, 1)))
        return CGT_ERROR_OUT_OF_MEMORY;
    cgt_float_environment_enter(&callers);
    if (job->as_given)
        cgt_light_estimate_add(estimate, job->scene, job->light, &job->points, 0, job->points.count);
    else
        look_at_tasks(job, estimate, scratch);
    cgt_float_environment_leave(&callers);
    if (scratch)
        cgt_scratch_give_back(job->scene->context, scratch);
    return CGT_OK;
}

static cgt_result trace_structure(light_job *job)
{
    cgt_light_estimate estimate = {0};
    job->task_points = choose_task_points(job);
    job->as_given =
        job->points.count && job->points.count <= CGT_RAYS_CHUNK && cgt_points_are_live(&job->points, job->light);
    cgt_result result = cgt_light_allows_tiles(&job->scene->committed_scene) ? look(job, &estimate) : CGT_OK;
    if (result == CGT_OK)
        result = cgt_light_choose(job->scene, job->light, &estimate, job->points.count, &job->settings, &job->progress);
    if (result != CGT_OK)
        return result;
    if (job->settings.use_bvh && job->points.count < FEW_POINTS) {
        job->settings.light_tiles = false;
        job->progress.budget = job->settings.max_light_work = 0;
    }
    const cgt_light_tasks tasks = tasks_of(job);
    return cgt_light_run_structure(&tasks, &job->settings);
}

cgt_result cgt_check_light(cgt_context *c, const cgt_light *light)
{
    bool zero = true;
    for (int a = 0; a < 3; a++) {
        if (!isfinite(light->position[a]))
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "light: its position is not finite");
        zero = zero && light->position[a] == 0;
    }
    if ((unsigned)light->kind > CGT_LIGHT_DIRECTIONAL)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "light: kind %d is unknown", (int)light->kind);
    if (light->kind == CGT_LIGHT_DIRECTIONAL && zero)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "light: a direction of length zero");
    return CGT_OK;
}

static cgt_result check_points(cgt_context *c, const cgt_points *p)
{
    for (int a = 0; a < 3 && p->count; a++)
        if (!p->position[a])
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "points: position must not be NULL");
    return cgt_check_stride(c, "points", p->stride, p->count);
}

cgt_result cgt_occluded_points(const cgt_scene *scene, const cgt_light *light, const cgt_points *points,
                               uint8_t *occluded, const cgt_trace_options *options)
{
    cgt_trace_counter counter;
    if (!scene || !light || !points || (!occluded && points->count))
        return CGT_ERROR_INVALID_ARGUMENT;
    cgt_context *c = scene->context;
    light_job job = {.scene = scene, .light = light, .occluded = occluded, .counter = &counter};
    cgt_result result = cgt_trace_prepare(scene, options, false, &job.settings, &counter);
    if (result == CGT_OK)
        result = cgt_check_light(c, light);
    if (result == CGT_OK)
        result = check_points(c, points);
    if (result != CGT_OK)
        return result;
    job.points = (cgt_rays){.count = points->count,
                            .stride = points->stride,
                            .org = {points->position[0], points->position[1], points->position[2]},
                            .t_min = points->t_min,
                            .t_max = points->t_max,
                            .mask = points->mask,
                            .skip_primitive = points->skip_primitive,
                            .skip_geometry = points->skip_geometry};
    if (points->count >= FEW_POINTS) /* by tiles, where there is a grid */
        cgt_set_flag(&scene->mutable_scene->had_frames);
    result = scene->in_bands ? trace_bands(&job) : trace_structure(&job);
    if (result != CGT_OK)
        return result;
    cgt_trace_store_statistics(options, &job.settings, &counter);
    return CGT_OK;
}
