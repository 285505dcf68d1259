/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light: cut into chunks, each a task. */
#include <math.h>
#include <string.h>

#include "core/float_environment.h"
#include "dispatch/kernel.h"
#include "trace/order/call_order.h"
#include "trace/trace_light.h"
#include "builders/bvh/bvh_on_demand.h"
#include "trace/bands/band_trace.h"

#define SAMPLED_TASKS 4u /* that are looked at before tiles or a tree are chosen */

#define SCATTERED_POINTS 4u /* rays that count for a point that tiles gave up in bands */

#define FEW_POINTS 256u /* fewer go through a BVH where there is one */

typedef struct light_job {
    const cgt_scene *scene;
    const cgt_light *light;
    cgt_rays points; /* without directions */
    uint8_t *occluded;
    cgt_trace_settings settings;
    cgt_trace_counter *counter;
    const cgt_band_call *bands; /* NULL: the scene has none */
    cgt_call_order order;       /* of the points, but for those in bands */
    uint32_t tasks, step;       /* the tasks, and the way from one to the next */
    cgt_light_progress progress;
} light_job;

/* The end of the chunk that begins at `first`. */
static uint64_t chunk_end(uint64_t first, uint64_t end)
{
    return first + (end - first < CGT_RAYS_CHUNK ? end - first : CGT_RAYS_CHUNK);
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

/* Traces points first to end - 1 of the order, a task. */
static bool trace_structure_points(const light_job *job, uint64_t first, uint64_t end, cgt_counts *counts)
{
    if (job->order.as_given)
        return trace_points(job, &job->points, first, end, job->occluded, counts);
    cgt_point_batch *batch = cgt_scratch_take(counts->scratch, sizeof *batch);
    const uint32_t count = (uint32_t)(end - first);
    cgt_point_batch_fill(batch, &job->points, job->order.number + first, count);
    const bool done = trace_points(job, &batch->rays, 0, count, batch->occluded, counts);
    for (uint32_t k = 0; done && k < count; k++)
        job->occluded[job->order.number[first + k]] = batch->occluded[k];
    cgt_scratch_return(counts->scratch, batch);
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

/* The points of a task: those that are live, or all in bands. */
static uint64_t traced_points(const light_job *job)
{
    return job->bands || job->order.as_given ? job->points.count : job->order.live;
}

/* The task that comes as number `index`. Tasks are neighbours in the light's order, and the first ones are to tell what
 * the others take: so they come in steps of about the golden section, which shares no divisor with their number. */
static uint32_t task_at(const light_job *job, uint32_t index)
{
    return (uint32_t)((uint64_t)index * job->step % job->tasks);
}

static bool share_divisor(uint32_t a, uint32_t b)
{
    while (b) {
        const uint32_t rest = a % b;
        a = b;
        b = rest;
    }
    return a != 1;
}

static void choose_step(light_job *job, uint32_t tasks)
{
    job->tasks = tasks ? tasks : 1;
    job->step = 1;
    if (!job->order.is_sorted)
        return;
    job->step = (uint32_t)(0.618 * tasks);
    while (share_divisor(job->step, job->tasks))
        job->step++;
}

/* The result of a task's first point. */
static uint8_t *first_result(const light_job *job, uint32_t index)
{
    const uint64_t first = (uint64_t)index * CGT_RAYS_CHUNK;
    return job->occluded + (job->bands || job->order.as_given ? first : job->order.number[first]);
}

static void trace_task(void *argument, uint32_t number, cgt_scratch *scratch)
{
    light_job *job = argument;
    const uint32_t index = task_at(job, number);
    const uint64_t first = (uint64_t)index * CGT_RAYS_CHUNK, end = chunk_end(first, traced_points(job));
    cgt_counts counts = {.scratch = scratch};
    const bool tries = !cgt_light_is_hopeless(&job->progress);
    const bool done = tries && trace_task_points(job, index, first, end, &counts);
    if (tries)
        cgt_light_remember(&job->progress, job->scene, &counts, end - first, done);
    if (!done) { /* the work was done, the points were not */
        counts.rays = counts.hits = counts.invalid_rays = 0;
        counts.given_up = end - first;
        *first_result(job, index) = CGT_LIGHT_GIVEN_UP;
        atomic_fetch_add_explicit(&job->progress.given_up, end - first, memory_order_relaxed);
        atomic_fetch_add_explicit(&job->progress.untried, tries ? 0 : end - first, memory_order_relaxed);
    }
    cgt_trace_counter_add(job->counter, &counts);
}

static void trace_given_up_task(void *argument, uint32_t number, cgt_scratch *scratch)
{
    const light_job *job = argument;
    if (*first_result(job, task_at(job, number)) == CGT_LIGHT_GIVEN_UP)
        trace_task(argument, number, scratch);
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

/* points: that are traced. */
static cgt_light_tasks tasks_of(light_job *job, uint64_t points)
{
    const uint32_t tasks = (uint32_t)((points + CGT_RAYS_CHUNK - 1) / CGT_RAYS_CHUNK);
    choose_step(job, tasks);
    return (cgt_light_tasks){.scene = job->scene,
                             .light = job->light,
                             .trace = trace_task,
                             .trace_given_up = trace_given_up_task,
                             .argument = job,
                             .tasks = tasks,
                             .progress = &job->progress,
                             .bands = &job->bands};
}

static cgt_result trace_bands(light_job *job)
{
    const cgt_light_tasks tasks = tasks_of(job, job->points.count);
    return cgt_light_run_bands(&tasks, &job->settings, job->points.count, CGT_RAYS_CHUNK);
}

/* Looks at some tasks. scratch: NULL where points are as given. */
static void look_at_tasks(const light_job *job, cgt_light_estimate *estimate, cgt_scratch *scratch)
{
    const uint64_t points = traced_points(job), tasks = (points + CGT_RAYS_CHUNK - 1) / CGT_RAYS_CHUNK;
    const uint64_t sampled = tasks < SAMPLED_TASKS ? tasks : SAMPLED_TASKS;
    for (uint64_t k = 0; k < sampled; k++) {
        const uint64_t first = tasks * k / sampled * CGT_RAYS_CHUNK, count = chunk_end(first, points) - first;
        if (!scratch) {
            cgt_light_estimate_add(estimate, job->scene, job->light, &job->points, first, count);
            continue;
        }
        cgt_point_batch *batch = cgt_scratch_take(scratch, sizeof *batch);
        cgt_point_batch_fill(batch, &job->points, job->order.number + first, (uint32_t)count);
        cgt_light_estimate_add(estimate, job->scene, job->light, &batch->rays, 0, count);
        cgt_scratch_return(scratch, batch);
    }
}

static cgt_result look(const light_job *job, cgt_light_estimate *estimate)
{
    cgt_float_environment callers;
    cgt_scratch *scratch = NULL;
    *estimate = (cgt_light_estimate){.ordered = job->order.is_sorted};
    if (!job->order.as_given && !(scratch = cgt_scratch_borrow(job->scene->context, 1)))
        return CGT_ERROR_OUT_OF_MEMORY;
    cgt_float_environment_enter(&callers);
    look_at_tasks(job, estimate, scratch);
    cgt_float_environment_leave(&callers);
    if (scratch)
        cgt_scratch_give_back(job->scene->context, scratch);
    return CGT_OK;
}

/* Traces the points, which are in order. */
static cgt_result trace_ordered(light_job *job)
{
    cgt_light_estimate estimate = {0};
    const uint64_t points = traced_points(job);
    cgt_result result = cgt_light_allows_tiles(&job->scene->committed_scene) ? look(job, &estimate) : CGT_OK;
    if (result == CGT_OK)
        result = cgt_light_choose(job->scene, job->light, &estimate, points, &job->settings, &job->progress);
    if (result != CGT_OK)
        return result;
    if (job->settings.use_bvh && points < FEW_POINTS) {
        job->settings.light_tiles = false;
        job->progress.budget = job->settings.max_light_work = 0;
    }
    const cgt_light_tasks tasks = tasks_of(job, points);
    return cgt_light_run_structure(&tasks, &job->settings);
}

/* Counts the points that need no ray, and clears all results. */
static void leave_out(light_job *job)
{
    const cgt_counts counts = {.rays = job->points.count - job->order.live, .invalid_rays = job->order.invalid};
    memset(job->occluded, 0, job->points.count);
    cgt_trace_counter_add(job->counter, &counts);
}

static cgt_result trace_piece(light_job *job)
{
    if (job->points.count <= CGT_RAYS_CHUNK && cgt_points_are_live(&job->points, job->light)) {
        job->order = (cgt_call_order){.as_given = true};
        return trace_ordered(job);
    }
    cgt_result result = cgt_call_order_init(&job->order, job->scene, &job->points, job->light);
    if (result != CGT_OK)
        return result;
    if (!job->order.as_given)
        leave_out(job);
    result = trace_ordered(job);
    cgt_call_order_release(&job->order, job->scene);
    return result;
}

/* Elements of an array from `first` on; NULL stays NULL. */
static const void *array_from(const void *array, const cgt_rays *points, uint64_t first)
{
    const size_t stride = points->stride ? points->stride : sizeof(float);
    return array ? (const char *)array + (size_t)first * stride : NULL;
}

/* Piece by piece, each in an order of its own. */
static cgt_result trace_structure(light_job *job)
{
    const cgt_rays all = job->points;
    uint8_t *occluded = job->occluded;
    cgt_result result = CGT_OK;
    uint64_t first = 0;
    do {
        const uint64_t left = all.count - first;
        job->points = (cgt_rays){.count = left < CGT_ORDERED_POINTS ? left : CGT_ORDERED_POINTS,
                                 .stride = all.stride,
                                 .t_min = array_from(all.t_min, &all, first),
                                 .t_max = array_from(all.t_max, &all, first),
                                 .mask = array_from(all.mask, &all, first),
                                 .skip_primitive = array_from(all.skip_primitive, &all, first),
                                 .skip_geometry = array_from(all.skip_geometry, &all, first)};
        for (int a = 0; a < 3; a++)
            job->points.org[a] = array_from(all.org[a], &all, first);
        job->occluded = first ? occluded + first : occluded; /* NULL where there are no points */
        result = trace_piece(job);
        first += job->points.count;
    } while (result == CGT_OK && first < all.count);
    return result;
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
