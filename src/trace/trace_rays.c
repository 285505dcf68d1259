/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays, nearest hit and any hit: cut into chunks, each a task. */
#include "scene/scene.h"
#include "trace/trace_call.h"
#include "builders/bvh/bvh_on_demand.h"

typedef struct rays_job {
    const cgt_scene *scene;
    const cgt_rays *rays;
    const cgt_hits *hits; /* NULL: any hit */
    uint8_t *occluded;
    cgt_trace_settings settings;
    uint32_t chunk; /* rays of a task */
    cgt_trace_counter *counter;
} rays_job;

static void trace_chunk(void *argument, uint32_t index)
{
    const rays_job *job = argument;
    const cgt_scene *s = job->scene;
    const uint64_t first = (uint64_t)index * job->chunk, remaining = job->rays->count - first,
                   end = first + (remaining < job->chunk ? remaining : job->chunk);
    cgt_counts counts = {0};
    s->context->kernel->trace_rays(&s->committed_scene, job->rays, first, end, &job->settings, job->hits, job->occluded,
                                   &counts);
    cgt_trace_counter_add(job->counter, &counts);
}

static cgt_result check_rays(cgt_context *c, const cgt_rays *r)
{
    for (int a = 0; a < 3 && r->count; a++)
        if (!r->org[a] || !r->dir[a])
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "rays: org and dir must not be NULL");
    return cgt_check_stride(c, "rays", r->stride, r->count);
}

static cgt_result check_hits(cgt_context *c, const cgt_hits *h, uint64_t count)
{
    if (!h->normal[0] != !h->normal[1] || !h->normal[0] != !h->normal[2])
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "hits: normal: all three arrays or none");
    if (!h->u != !h->v)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "hits: u and v: both arrays or none");
    return cgt_check_stride(c, "hits", h->stride, count);
}

static uint32_t hit_fields(const cgt_hits *h)
{
    return (h->t ? CGT_FIELD_T : 0u) | (h->primitive ? CGT_FIELD_PRIMITIVE : 0u) |
           (h->geometry ? CGT_FIELD_GEOMETRY : 0u) | (h->normal[0] ? CGT_FIELD_NORMAL : 0u) |
           (h->u ? CGT_FIELD_UV : 0u);
}

/* Large chunks where each thread gets two of them; how many threads a caller's runner has, nobody knows. */
static uint32_t choose_chunk(const rays_job *job)
{
    const cgt_scene *s = job->scene;
    const uint64_t threads = s->context->threads ? s->context->threads : 64;
    const bool streams = job->settings.use_bvh && !s->committed_scene.brute_force;
    return streams && job->rays->count >= threads * 2 * CGT_STREAM_CHUNK ? CGT_STREAM_CHUNK : CGT_RAYS_CHUNK;
}

static cgt_result trace_array(rays_job *job, const cgt_trace_options *options)
{
    cgt_context *c = job->scene->context;
    cgt_trace_counter counter;
    cgt_result result = cgt_trace_prepare(job->scene, options, false, &job->settings, &counter);
    if (result == CGT_OK)
        result = check_rays(c, job->rays);
    if (result == CGT_OK && job->hits)
        result = check_hits(c, job->hits, job->rays->count);
    if (result == CGT_OK)
        result = cgt_bvh_build_on_demand(job->scene, job->rays->count, &job->settings.use_bvh);
    if (result != CGT_OK)
        return result;
    job->settings.fields = job->hits ? hit_fields(job->hits) : 0;
    job->counter = options && options->statistics ? &counter : NULL;
    job->chunk = choose_chunk(job);
    cgt_run_tasks(c, trace_chunk, job, (uint32_t)((job->rays->count + job->chunk - 1) / job->chunk));
    cgt_trace_store_statistics(options, &job->settings, &counter);
    return CGT_OK;
}

cgt_result cgt_trace_rays(const cgt_scene *scene, const cgt_rays *rays, const cgt_hits *hits,
                          const cgt_trace_options *options)
{
    if (!scene || !rays || !hits)
        return CGT_ERROR_INVALID_ARGUMENT;
    rays_job job = {.scene = scene, .rays = rays, .hits = hits};
    return trace_array(&job, options);
}

cgt_result cgt_occluded_rays(const cgt_scene *scene, const cgt_rays *rays, uint8_t *occluded,
                             const cgt_trace_options *options)
{
    if (!scene || !rays || (!occluded && rays->count))
        return CGT_ERROR_INVALID_ARGUMENT;
    rays_job job = {.scene = scene, .rays = rays, .occluded = occluded};
    return trace_array(&job, options);
}
