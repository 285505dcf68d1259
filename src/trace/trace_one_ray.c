/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray a call, without a task, a clock or a copy of the options. In scenes of bands it goes as an array. */
#include <math.h>

#include "core/float_environment.h"
#include "dispatch/kernel.h"
#include "trace/trace_call.h"

static cgt_hits planes_of_hit(cgt_single_hit *hit)
{
    return (cgt_hits){.t = &hit->t,
                      .primitive = &hit->primitive,
                      .geometry = &hit->geometry,
                      .normal = {hit->normal, hit->normal + 1, hit->normal + 2},
                      .u = &hit->u,
                      .v = &hit->v};
}

/* hit or occluded is NULL. */
static void trace_one(const cgt_scene *s, const cgt_single_ray *ray, const cgt_trace_settings *settings,
                      cgt_single_hit *hit, bool *occluded, cgt_counts *counts)
{
    const cgt_kernel *kernel = s->context->kernel;
    const cgt_committed_scene *scene = &s->committed_scene;
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    if (hit) {
        *hit = (cgt_single_hit){.t = INFINITY, .primitive = CGT_INVALID_ID, .geometry = CGT_INVALID_ID};
        kernel->trace_one_ray(scene, ray, settings->use_bvh, settings->precision, hit, counts);
    } else
        *occluded = kernel->occluded_one_ray(scene, ray, settings->use_bvh, counts);
    cgt_float_environment_leave(&callers);
}

/* Scenes in bands serve arrays. */
static cgt_result trace_in_bands(const cgt_scene *s, const cgt_single_ray *ray, cgt_single_hit *hit, bool *occluded,
                                 const cgt_trace_options *options)
{
    const float t_max = cgt_end_of_ray(ray);
    const cgt_rays rays = cgt_array_of_ray(ray, &t_max);
    uint8_t found = 0;
    if (hit) {
        const cgt_hits hits = planes_of_hit(hit);
        return cgt_trace_rays(s, &rays, &hits, options);
    }
    const cgt_result result = cgt_occluded_rays(s, &rays, &found, options);
    if (result == CGT_OK)
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
        result = cgt_ready_structures(s, 1, &settings);
    if (result != CGT_OK)
        return result;
    trace_one(s, ray, &settings, hit, occluded, &counts);
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
    trace_one(s, ray, &settings, hit, occluded, &counts);
    return CGT_OK;
}

cgt_result cgt_trace_ray(const cgt_scene *scene, const cgt_single_ray *ray, cgt_single_hit *hit,
                         const cgt_trace_options *options)
{
    return scene && ray && hit ? trace_one_ray(scene, ray, hit, NULL, options) : cgt_fail_null(scene, __func__);
}

cgt_result cgt_occluded_ray(const cgt_scene *scene, const cgt_single_ray *ray, bool *occluded,
                            const cgt_trace_options *options)
{
    return scene && ray && occluded ? trace_one_ray(scene, ray, NULL, occluded, options)
                                    : cgt_fail_null(scene, __func__);
}
