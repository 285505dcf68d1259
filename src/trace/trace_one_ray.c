/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray a call: through the BVH where there is one, without a task, a clock or a copy of the options. Through other
 * structures it goes as an array of one ray. */
#include <math.h>

#include "builders/bvh/bvh_on_demand.h"
#include "core/float_environment.h"
#include "core/scratch_tasks.h"
#include "dispatch/kernel.h"
#include "trace/trace_call.h"

static cgt_rays array_of_ray(const cgt_single_ray *ray, const float *t_max)
{
    return (cgt_rays){.count = 1,
                      .org = {ray->org, ray->org + 1, ray->org + 2},
                      .dir = {ray->dir, ray->dir + 1, ray->dir + 2},
                      .t_min = &ray->t_min,
                      .t_max = t_max,
                      .mask = &ray->mask,
                      .skip_primitive = ray->skips ? &ray->skip_primitive : NULL,
                      .skip_geometry = &ray->skip_geometry};
}

static cgt_hits planes_of_hit(cgt_single_hit *hit)
{
    if (!hit)
        return (cgt_hits){0};
    return (cgt_hits){.t = &hit->t,
                      .primitive = &hit->primitive,
                      .geometry = &hit->geometry,
                      .normal = {hit->normal, hit->normal + 1, hit->normal + 2},
                      .u = &hit->u,
                      .v = &hit->v};
}

static float end_of_ray(const cgt_single_ray *ray) { return ray->t_max == 0 ? INFINITY : ray->t_max; }

/* An array of one ray. Not inlined: its stack is taken only where it is needed. */
__attribute__((noinline)) static void trace_as_array(const cgt_scene *s, const cgt_single_ray *ray,
                                                     cgt_trace_settings *settings, cgt_single_hit *hit,
                                                     uint8_t *occluded, cgt_counts *counts)
{
    const float t_max = end_of_ray(ray);
    const cgt_rays rays = array_of_ray(ray, &t_max);
    const cgt_hits hits = planes_of_hit(hit);
    settings->fields = CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY | CGT_FIELD_NORMAL | CGT_FIELD_UV;
    s->context->kernel->trace_rays(&s->committed_scene, &rays, 0, 1, settings, hit ? &hits : NULL, occluded, counts);
}

/* Through the BVH, or as an array. hit or occluded is NULL. */
static void trace_any_way(const cgt_scene *s, const cgt_single_ray *ray, cgt_trace_settings *settings,
                          cgt_single_hit *hit, bool *occluded, cgt_counts *counts)
{
    const cgt_kernel *kernel = s->context->kernel;
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    if (hit)
        *hit = (cgt_single_hit){.t = INFINITY, .primitive = CGT_INVALID_ID, .geometry = CGT_INVALID_ID};
    if (!settings->use_bvh) {
        uint8_t found = 0;
        trace_as_array(s, ray, settings, hit, hit ? NULL : &found, counts);
        if (occluded)
            *occluded = found;
    } else if (hit)
        kernel->trace_one_ray(&s->committed_scene, ray, settings->precision, hit, counts);
    else
        *occluded = kernel->occluded_one_ray(&s->committed_scene, ray, counts);
    cgt_float_environment_leave(&callers);
}

/* Scenes in bands serve arrays. */
static cgt_result trace_in_bands(const cgt_scene *s, const cgt_single_ray *ray, cgt_single_hit *hit, bool *occluded,
                                 const cgt_trace_options *options)
{
    const float t_max = end_of_ray(ray);
    const cgt_rays rays = array_of_ray(ray, &t_max);
    const cgt_hits hits = planes_of_hit(hit);
    uint8_t found = 0;
    const cgt_result result =
        hit ? cgt_trace_rays(s, &rays, &hits, options) : cgt_occluded_rays(s, &rays, &found, options);
    if (occluded && result == CGT_OK)
        *occluded = found;
    return result;
}

static cgt_result trace_with_options(const cgt_scene *s, const cgt_single_ray *ray, cgt_single_hit *hit, bool *occluded,
                                     const cgt_trace_options *options)
{
    cgt_trace_counter counter;
    cgt_trace_settings settings;
    cgt_counts counts = {0};
    if (s->in_bands)
        return trace_in_bands(s, ray, hit, occluded, options);
    cgt_result result = cgt_trace_prepare(s, options, false, &settings, &counter);
    if (result == CGT_OK)
        result = cgt_bvh_build_on_demand(s, 1, &settings.use_bvh);
    if (result != CGT_OK)
        return result;
    if (!settings.use_bvh && !(counts.scratch = cgt_scratch_borrow(s->context, 1))) /* packets need it */
        return CGT_ERROR_OUT_OF_MEMORY;
    trace_any_way(s, ray, &settings, hit, occluded, &counts);
    cgt_scratch_give_back(s->context, counts.scratch);
    cgt_trace_counter_add(&counter, &counts);
    cgt_trace_store_statistics(options, &settings, &counter);
    return CGT_OK;
}

/* Without options and with a BVH that is there already there is nothing to prepare. */
static cgt_result trace_one_ray(const cgt_scene *s, const cgt_single_ray *ray, cgt_single_hit *hit, bool *occluded,
                                const cgt_trace_options *options)
{
    cgt_trace_settings settings;
    cgt_counts counts = {0}; /* nobody reads them */
    if (options || !s->is_committed || s->committed_scene.structure != CGT_STRUCTURE_BVH ||
        !s->committed_scene.bvh.node)
        return trace_with_options(s, ray, hit, occluded, options);
    settings.use_bvh = true;
    settings.precision = CGT_PRECISION_EXACT;
    trace_any_way(s, ray, &settings, hit, occluded, &counts);
    return CGT_OK;
}

cgt_result cgt_trace_ray(const cgt_scene *scene, const cgt_single_ray *ray, cgt_single_hit *hit,
                         const cgt_trace_options *options)
{
    return scene && ray && hit ? trace_one_ray(scene, ray, hit, NULL, options) : CGT_ERROR_INVALID_ARGUMENT;
}

cgt_result cgt_occluded_ray(const cgt_scene *scene, const cgt_single_ray *ray, bool *occluded,
                            const cgt_trace_options *options)
{
    return scene && ray && occluded ? trace_one_ray(scene, ray, NULL, occluded, options) : CGT_ERROR_INVALID_ARGUMENT;
}
