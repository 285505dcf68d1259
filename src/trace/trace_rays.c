/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays, nearest hit and any hit: cut into chunks, each a task. */
#include <stdatomic.h>

#include "builders/bvh/bvh_on_demand.h"
#include "core/scratch_tasks.h"
#include "scene/scene.h"
#include "trace/trace_call.h"
#include "trace/bands/band_trace.h"

#define PASSES 8u       /* of an array, at most */
#define PASS_CHUNK 512u /* rays of a task of all but the last */

typedef struct rays_job {
    const cgt_scene *scene;
    const cgt_rays *rays;
    const cgt_hits *hits; /* NULL: any hit */
    uint8_t *occluded;
    cgt_trace_settings settings;
    const cgt_band_call *bands; /* NULL: the scene has none */
    uint64_t first, end;        /* of a pass */
    uint32_t chunk;             /* rays of a task */
    _Atomic uint64_t work;      /* references that a pass has read */
    cgt_trace_counter *counter;
} rays_job;

static void trace_chunk(void *argument, uint32_t index, cgt_scratch *scratch)
{
    rays_job *job = argument;
    const cgt_scene *s = job->scene;
    const uint64_t first = job->first + (uint64_t)index * job->chunk, remaining = job->end - first,
                   end = first + (remaining < job->chunk ? remaining : job->chunk);
    cgt_counts counts = {.scratch = scratch};
    if (job->bands)
        cgt_bands_trace(job->bands, index % job->bands->slots, job->rays, NULL, first, end, job->hits, job->occluded,
                        &counts);
    else
        s->context->kernel->trace_rays(&s->committed_scene, job->rays, first, end, &job->settings, job->hits,
                                       job->occluded, &counts);
    atomic_fetch_add_explicit(&job->work, counts.references, memory_order_relaxed);
    cgt_trace_counter_add(job->counter, &counts);
}

/* Large chunks where each thread gets two of them; a caller's runner counts as 64 threads. */
static uint32_t choose_chunk(const rays_job *job)
{
    const cgt_scene *s = job->scene;
    const uint64_t threads = s->context->threads ? s->context->threads : 64;
    const bool streams = job->settings.use_bvh && !job->bands && !s->committed_scene.brute_force;
    return streams && job->rays->count >= threads * 2 * CGT_STREAM_CHUNK ? CGT_STREAM_CHUNK : CGT_RAYS_CHUNK;
}

/* Rays of the next pass. How long rays take through a grid is not known before: they go in passes, as long as a BVH may
 * be worth building. */
static uint64_t choose_pass(const rays_job *job)
{
    const cgt_scene *s = job->scene;
    const uint64_t threads = s->context->threads ? s->context->threads : 64, left = job->rays->count - job->first;
    const uint64_t share = job->rays->count / PASSES, least = threads * PASS_CHUNK;
    const bool may_build = !job->bands && !job->settings.use_bvh && cgt_bvh_rays_left(s) < UINT32_MAX;
    const uint64_t pass = share > least ? share : least;
    return may_build && pass < left ? pass : left;
}

/* Checks the hits and finds the fields that they want. */
static cgt_result prepare_hits(rays_job *job)
{
    const cgt_hits *h = job->hits;
    if (!h)
        return CGT_OK;
    cgt_context *c = job->scene->context;
    void *const plane[CGT_PLANES] = CGT_PLANES_OF(h);
    const cgt_result result = cgt_check_planes(c, "hits", plane);
    job->settings.fields = cgt_planes_fields(plane);
    return result == CGT_OK ? cgt_check_strides(c, "hits", h->stride, h->vector_stride, job->rays->count) : result;
}

/* Makes ready what the rays go through. call: of scenes in bands, to be ended in any case. */
static cgt_result ready_rays(rays_job *job, cgt_band_call *call)
{
    const uint64_t count = job->rays->count;
    if (!job->scene->in_bands)
        return cgt_ready_structures(job->scene, count, &job->settings);
    job->bands = call;
    const cgt_result result = cgt_bands_begin(job->scene, &job->settings, count, CGT_RAYS_CHUNK, call);
    return result == CGT_OK ? cgt_bands_build_bvh(call, count) : result;
}

static cgt_result trace_pass(rays_job *job)
{
    const uint64_t count = choose_pass(job);
    job->end = job->first + count;
    job->chunk = job->end < job->rays->count ? PASS_CHUNK : choose_chunk(job);
    atomic_store_explicit(&job->work, 0, memory_order_relaxed);
    const uint32_t tasks = (uint32_t)((count + job->chunk - 1) / job->chunk);
    return job->bands ? cgt_bands_run(job->bands, trace_chunk, job, tasks)
                      : cgt_run_scratch_tasks(job->scene->context, trace_chunk, job, tasks);
}

/* Rays that take more through a grid than most count as several, so that a BVH is built in time. */
static cgt_result trace_passes(rays_job *job)
{
    cgt_result result = CGT_OK;
    while (result == CGT_OK && job->first < job->rays->count) {
        result = trace_pass(job);
        const uint64_t rays = job->end - job->first,
                       worth = atomic_load_explicit(&job->work, memory_order_relaxed) / CGT_RAY_WORK;
        job->first = job->end;
        if (result == CGT_OK && !job->bands && !job->settings.use_bvh && worth > rays)
            result = cgt_ready_structures(job->scene, worth - rays, &job->settings);
    }
    return result;
}

static cgt_result trace_array(rays_job *job, const cgt_trace_options *options)
{
    cgt_context *c = job->scene->context;
    cgt_trace_counter counter;
    cgt_band_call bands = {.memory = NULL};
    job->counter = &counter;
    cgt_result result = cgt_trace_prepare(job->scene, options, false, &job->settings, &counter);
    if (result == CGT_OK)
        result = cgt_check_rays(c, job->rays);
    if (result == CGT_OK)
        result = prepare_hits(job);
    if (result == CGT_OK)
        result = ready_rays(job, &bands);
    if (result == CGT_OK)
        result = trace_passes(job);
    cgt_bands_end(&bands);
    job->bands = NULL;
    job->counter = NULL;
    if (result != CGT_OK)
        return result;
    cgt_trace_store_statistics(options, &job->settings, &counter);
    return CGT_OK;
}

cgt_result cgt_trace_rays(const cgt_scene *scene, const cgt_rays *rays, const cgt_hits *hits,
                          const cgt_trace_options *options)
{
    if (!scene || !rays || !hits)
        return cgt_fail_null(scene, __func__);
    rays_job job = {.scene = scene, .rays = rays, .hits = hits};
    return trace_array(&job, options);
}

cgt_result cgt_occluded_rays(const cgt_scene *scene, const cgt_rays *rays, uint8_t *occluded,
                             const cgt_trace_options *options)
{
    if (!scene || !rays || (!occluded && rays->count))
        return cgt_fail_null(scene, __func__);
    rays_job job = {.scene = scene, .rays = rays, .occluded = occluded};
    return trace_array(&job, options);
}
