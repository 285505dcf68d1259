/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray a call, without a task, a clock or a copy of the options. */
#include <math.h>
#include <string.h>

#include "core/float_environment.h"
#include "dispatch/kernel.h"
#include "trace/hit_lists.h"
#include "trace/trace_call.h"

/* By the C library: what compilers put in place for a size that they know takes 10 ns, a fifth of a ray that meets
 * nothing. */
static void clear_counts(cgt_counts *counts)
{
    volatile size_t size = sizeof *counts;
    memset(counts, 0, size);
}

/* Through what the scene has, or builds for one ray more. hit or occluded is NULL. */
static cgt_result trace_one(const cgt_scene *s, const cgt_single_ray *ray, cgt_trace_settings *settings, cgt_hit *hit,
                            bool *occluded, cgt_counts *counts)
{
    const cgt_kernel *kernel = s->context->kernel;
    const cgt_committed_scene *scene = &s->committed_scene;
    cgt_float_environment callers;
    cgt_band_call bands;
    const cgt_result result = cgt_ready_lists(s, 1, settings, &bands);
    if (result != CGT_OK)
        return result;
    cgt_float_environment_enter(&callers);
    const uint32_t prim = s->in_bands ? cgt_bands_trace_one(s, ray, bands.use_bvh, !hit, counts)
                                      : kernel->trace_one_ray(scene, ray, settings->use_bvh, !hit, counts);
    if (!hit)
        *occluded = prim != CGT_INVALID_ID;
    else if (prim == CGT_INVALID_ID)
        *hit = (cgt_hit){.t = INFINITY, .primitive = CGT_INVALID_ID, .geometry = CGT_INVALID_ID};
    else
        kernel->resolve_one_ray(scene, ray, prim, settings->precision, hit, counts);
    cgt_float_environment_leave(&callers);
    return CGT_OK;
}

static cgt_result trace_counted(const cgt_scene *s, const cgt_single_ray *ray, cgt_hit *hit, bool *occluded,
                                const cgt_trace_options *options)
{
    cgt_trace_counter counter;
    cgt_trace_settings settings;
    cgt_counts counts;
    clear_counts(&counts);
    cgt_result result = cgt_trace_prepare(s, options, false, &settings, &counter);
    if (result == CGT_OK)
        result = trace_one(s, ray, &settings, hit, occluded, &counts);
    if (result != CGT_OK)
        return result;
    cgt_trace_counter_add(&counter, &counts);
    cgt_trace_store_statistics(options, &settings, &counter);
    return CGT_OK;
}

/* Whether options say no more than a precision, which is all that one ray needs to know. */
static bool is_plain(const cgt_trace_options *o)
{
    return !o || (!o->statistics && !o->research && (unsigned)o->precision <= CGT_PRECISION_FAST);
}

static cgt_result trace_one_ray(const cgt_scene *s, const cgt_single_ray *ray, cgt_hit *hit, bool *occluded,
                                const cgt_trace_options *options)
{
    cgt_trace_settings settings = {.precision = options ? options->precision : CGT_PRECISION_EXACT};
    cgt_counts counts; /* nobody reads them */
    if (!s->is_committed || !is_plain(options))
        return trace_counted(s, ray, hit, occluded, options);
    clear_counts(&counts);
    return trace_one(s, ray, &settings, hit, occluded, &counts);
}

cgt_result cgt_trace_ray(const cgt_scene *scene, const cgt_single_ray *ray, cgt_hit *hit,
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
