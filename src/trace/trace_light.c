/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against one light: cut into chunks, each a task. */
#include <string.h>

#include "dispatch/frame_points.h"
#include "query/ray_intake.h"
#include "trace/light_tasks.h"
#include "trace/order/call_order.h"

typedef struct light_job {
    const cgt_scene *scene;
    const cgt_light *light;
    cgt_rays points; /* without directions */
    uint8_t *occluded;
    cgt_trace_settings settings;
    cgt_trace_counter *counter;
    cgt_call_order order; /* of the points, but for those in bands */
} light_job;

/* How many points are traced: the live ones; in bands all, since bands skip the others. */
static uint64_t traced_points(const light_job *job)
{
    return job->order.as_given ? job->points.count : job->order.live;
}

static uint8_t *first_result(const void *owner, uint32_t index)
{
    const light_job *job = owner;
    const uint64_t first = (uint64_t)index * CGT_RAYS_CHUNK;
    return job->occluded + (job->order.as_given ? first : job->order.number[first]);
}

/* ---- batches: the live points side by side, so that others cost nothing ---- */

static void copy_numbers(const ray_source *s, const uint32_t *array, const uint32_t *number, uint32_t count,
                         uint32_t *to)
{
    for (uint32_t k = 0; array && k < count; k++)
        to[k] = ray_number(s, array, number[k]);
}

static void copy_floats(const float *array, size_t stride, const uint32_t *number, uint32_t count, float *to)
{
    for (uint32_t k = 0; array && k < count; k++)
        to[k] = ray_element(array, stride, number[k]);
}

/* Packs `count` points, at most CGT_RAYS_CHUNK, by their numbers. */
static void fill_batch(cgt_point_batch *b, const cgt_rays *points, const uint32_t *number, uint32_t count)
{
    const ray_source source = ray_source_init(points, NULL);
    for (int a = 0; a < 3; a++)
        copy_floats(points->org[a], source.vector_stride, number, count, b->position[a]);
    copy_floats(points->t_min, source.stride, number, count, b->t_min);
    copy_floats(points->t_max, source.stride, number, count, b->t_max);
    copy_numbers(&source, points->mask, number, count, b->mask);
    copy_numbers(&source, points->skip_primitive, number, count, b->primitive);
    copy_numbers(&source, points->skip_geometry, number, count, b->geometry);
    b->rays = (cgt_rays){.count = count,
                         .org = {b->position[0], b->position[1], b->position[2]},
                         .t_min = points->t_min ? b->t_min : NULL,
                         .t_max = points->t_max ? b->t_max : NULL,
                         .mask = points->mask ? b->mask : NULL,
                         .skip_primitive = points->skip_primitive ? b->primitive : NULL,
                         .skip_geometry = points->skip_geometry ? b->geometry : NULL};
}

/* ---- chunks ---- */

static bool trace_chunk(void *owner, cgt_light_tasks *tasks, uint32_t index, cgt_counts *counts)
{
    const light_job *job = owner;
    const uint64_t first = (uint64_t)index * CGT_RAYS_CHUNK, left = traced_points(job) - first;
    const uint32_t count = left < CGT_RAYS_CHUNK ? (uint32_t)left : CGT_RAYS_CHUNK;
    if (job->order.as_given)
        return cgt_light_trace_points(tasks, index, &job->points, first, first + count, job->occluded, counts);
    cgt_point_batch *batch = cgt_scratch_take(counts->scratch, sizeof *batch);
    fill_batch(batch, &job->points, job->order.number + first, count);
    const bool done = cgt_light_trace_points(tasks, index, &batch->rays, 0, count, batch->occluded, counts);
    for (uint32_t k = 0; done && k < count; k++)
        job->occluded[job->order.number[first + k]] = batch->occluded[k];
    cgt_scratch_return(counts->scratch, batch);
    return done;
}

/* Traces the points, which are in order. */
static cgt_result trace_ordered(light_job *job)
{
    const uint64_t points = traced_points(job);
    cgt_light_tasks tasks = {.scene = job->scene,
                             .light = job->light,
                             .settings = &job->settings,
                             .counter = job->counter,
                             .count = (uint32_t)((points + CGT_RAYS_CHUNK - 1) / CGT_RAYS_CHUNK),
                             .points = points,
                             .most = CGT_RAYS_CHUNK,
                             .owner = job,
                             .trace = trace_chunk,
                             .first_result = first_result};
    return cgt_light_run(&tasks);
}

/* Counts the points that need no ray, and clears all results. */
static void leave_out(light_job *job)
{
    const cgt_counts counts = {.rays = job->points.count - job->order.live, .invalid_rays = job->order.invalid};
    memset(job->occluded, 0, job->points.count);
    cgt_trace_counter_add(job->counter, &counts);
}

/* Whether the points are so few that they may be traced as they are, and all take part. */
static bool are_few_and_live(const light_job *job)
{
    cgt_float_environment callers;
    if (job->points.count > CGT_RAYS_CHUNK)
        return false;
    cgt_float_environment_enter(&callers);
    const bool live = job->scene->context->kernel->light_all_live(&job->points, job->light);
    cgt_float_environment_leave(&callers);
    return live;
}

static cgt_result trace_piece(light_job *job)
{
    if (job->scene->in_bands || are_few_and_live(job)) {
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
static const void *array_from(const void *array, size_t stride, uint64_t first)
{
    return array ? (const char *)array + (size_t)first * stride : NULL;
}

/* Piece by piece, each in an order of its own. */
static cgt_result trace_pieces(light_job *job)
{
    const cgt_rays all = job->points;
    const ray_source source = ray_source_init(&all, NULL);
    const size_t stride = source.stride;
    uint8_t *occluded = job->occluded;
    cgt_result result = CGT_OK;
    uint64_t first = 0;
    do {
        const uint64_t left = all.count - first;
        job->points = (cgt_rays){.count = left < CGT_ORDERED_POINTS ? left : CGT_ORDERED_POINTS,
                                 .stride = all.stride,
                                 .vector_stride = all.vector_stride,
                                 .t_min = array_from(all.t_min, stride, first),
                                 .t_max = array_from(all.t_max, stride, first),
                                 .mask = array_from(all.mask, stride, first),
                                 .skip_primitive = array_from(all.skip_primitive, stride, first),
                                 .skip_geometry = array_from(all.skip_geometry, stride, first)};
        for (int a = 0; a < 3; a++)
            job->points.org[a] = array_from(all.org[a], source.vector_stride, first);
        job->occluded = first ? occluded + first : occluded; /* NULL if there are no points */
        result = trace_piece(job);
        first += job->points.count;
    } while (result == CGT_OK && first < all.count);
    return result;
}

cgt_result cgt_occluded_points(const cgt_scene *scene, const cgt_light *light, const cgt_points *points,
                               uint8_t *occluded, const cgt_trace_options *options)
{
    cgt_trace_counter counter;
    if (!scene || !light || !points || (!occluded && points->count))
        return cgt_fail_null(scene, __func__);
    cgt_context *c = scene->context;
    light_job job = {.scene = scene, .light = light, .occluded = occluded, .counter = &counter};
    cgt_result result = cgt_trace_prepare(scene, options, false, &job.settings, &counter);
    if (result == CGT_OK)
        result = cgt_check_light(c, light);
    if (result == CGT_OK)
        result = cgt_check_points(c, points);
    if (result != CGT_OK)
        return result;
    job.points = (cgt_rays){.count = points->count,
                            .stride = points->stride,
                            .vector_stride = points->vector_stride,
                            .org = {points->position[0], points->position[1], points->position[2]},
                            .t_min = points->t_min,
                            .t_max = points->t_max,
                            .mask = points->mask,
                            .skip_primitive = points->skip_primitive,
                            .skip_geometry = points->skip_geometry};
    result = trace_pieces(&job);
    if (result != CGT_OK)
        return result;
    cgt_trace_store_statistics(options, &job.settings, &counter);
    return CGT_OK;
}
