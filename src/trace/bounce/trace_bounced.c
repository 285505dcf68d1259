/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays that leave surfaces to their nearest hits: as other rays, and then those inside spheres and capsules that found
 * nothing nearer than their own. */
#include <cgt/bounces.h>

#include <math.h>

#include "dispatch/kernel.h"
#include "model/primitives.h"
#include "query/ray_intake.h"
#include "scene/scene.h"
#include "trace/bounce/surface.h"
#include "trace/trace_call.h"

typedef struct bounced_job {
    const cgt_scene *scene;
    const cgt_rays *rays;
    const cgt_hits *hits;
    ray_source source;
    size_t hit_stride, normal_stride;
} bounced_job;

static float *hit_float(const bounced_job *job, float *array, uint64_t i)
{
    return (float *)(void *)((char *)array + i * job->hit_stride);
}

static uint32_t *hit_number(const bounced_job *job, uint32_t *array, uint64_t i)
{
    return (uint32_t *)(void *)((char *)array + i * job->hit_stride);
}

/* Whether ray i is inside the sphere or capsule that it skips, which t_max then tells. */
static bool is_inside(const bounced_job *job, uint64_t i, cgt_primitive *own, cgt_double_ray *ray)
{
    const cgt_primitives *prims = &job->scene->committed_scene.prims;
    const cgt_rays *r = job->rays;
    const float t_max = ray_element(r->t_max, job->source.stride, i);
    float org[3], dir[3];
    if (!(t_max >= 0.0f && t_max < INFINITY)) /* most rays end here */
        return false;
    const uint32_t number = ray_read_skip(prims, &job->source, i);
    if (number == CGT_INVALID_ID || !(ray_read_mask(&job->source, i) & cgt_primitives_array(prims, number)->mask))
        return false;
    *own = cgt_primitives_get(prims, number);
    for (int a = 0; a < 3; a++) {
        org[a] = ray_component(&job->source, r->org[a], i);
        dir[a] = ray_component(&job->source, r->dir[a], i);
    }
    return own->kind != CGT_KIND_TRIANGLES && cgt_double_ray_init(org, dir, ray) &&
           (float)cgt_far_root(own, ray) == t_max;
}

/* Whether what the ray found lies before its own primitive: where floats are equal, the roots in double tell. */
static bool is_nearer(const bounced_job *job, uint64_t i, const cgt_primitive *own, const cgt_double_ray *ray)
{
    const cgt_primitives *prims = &job->scene->committed_scene.prims;
    const uint32_t primitive = *hit_number(job, job->hits->primitive, i);
    const float t = *hit_float(job, job->hits->t, i);
    bounce_surface surface;
    if (primitive == CGT_INVALID_ID)
        return false;
    if (t < ray_element(job->rays->t_max, job->source.stride, i))
        return true;
    const uint32_t geometry = *hit_number(job, job->hits->geometry, i);
    const cgt_primitive other = cgt_primitives_get(prims, cgt_primitives_number(prims, geometry, primitive));
    return cgt_surface_t(&other, ray, t, &surface) <= cgt_far_root(own, ray);
}

static void store_own(const bounced_job *job, uint64_t i, const cgt_primitive *own, const cgt_double_ray *ray)
{
    const cgt_rays *r = job->rays;
    const cgt_hits *h = job->hits;
    const float t_max = ray_element(r->t_max, job->source.stride, i);
    bounce_surface surface = {.front = false};
    *hit_float(job, h->t, i) = t_max;
    *hit_number(job, h->primitive, i) = ray_number(&job->source, r->skip_primitive, i);
    *hit_number(job, h->geometry, i) = r->skip_geometry ? ray_number(&job->source, r->skip_geometry, i) : 0;
    if (!h->u && !h->normal[0])
        return;
    (void)cgt_find_surface(own, ray, INFINITY, &surface);
    if (h->u) {
        *hit_float(job, h->u, i) = (float)surface.u;
        *hit_float(job, h->v, i) = 0;
    }
    for (int a = 0; a < 3 && h->normal[0]; a++)
        *(float *)(void *)((char *)h->normal[a] + i * job->normal_stride) = (float)surface.normal[a];
}

static void find_own(void *argument, uint32_t index)
{
    const bounced_job *job = argument;
    const uint64_t first = (uint64_t)index * CGT_RAYS_CHUNK, remaining = job->rays->count - first;
    const uint64_t end = first + (remaining < CGT_RAYS_CHUNK ? remaining : CGT_RAYS_CHUNK);
    for (uint64_t i = first; i < end; i++) {
        cgt_primitive own;
        cgt_double_ray ray;
        if (is_inside(job, i, &own, &ray) && !is_nearer(job, i, &own, &ray))
            store_own(job, i, &own, &ray);
    }
}

cgt_result cgt_trace_bounced_rays(const cgt_scene *scene, const cgt_rays *rays, const cgt_hits *hits,
                                  const cgt_trace_options *options)
{
    if (!scene || !rays || !hits)
        return cgt_fail_null(scene, __func__);
    if (rays->count && (!rays->t_max || !hits->t || !hits->primitive || !hits->geometry))
        return cgt_fail(scene->context, CGT_ERROR_INVALID_ARGUMENT,
                        "bounced rays: t_max, and the t, primitive and geometry of hits must not be NULL");
    const cgt_result result = cgt_trace_rays(scene, rays, hits, options);
    if (result != CGT_OK || !rays->skip_primitive)
        return result;
    bounced_job job = {.scene = scene,
                       .rays = rays,
                       .hits = hits,
                       .source = ray_source_init(rays, NULL),
                       .hit_stride = ray_stride(hits->stride),
                       .normal_stride = ray_vector_stride(hits->vector_stride, hits->stride)};
    cgt_run_tasks(scene->context, find_own, &job, (uint32_t)((rays->count + CGT_RAYS_CHUNK - 1) / CGT_RAYS_CHUNK));
    return CGT_OK;
}
