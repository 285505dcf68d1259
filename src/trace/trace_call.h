/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the tracing calls share: checks, options to settings, and counting over threads. */
#ifndef CGT_TRACE_CALL_H
#define CGT_TRACE_CALL_H

#include <math.h>

#include "core/float_environment.h"
#include "dispatch/kernel.h"
#include "query/region.h"
#include "scene/scene.h"

typedef struct cgt_trace_counter {
    bool enabled; /* somebody asked for statistics */
    double start_ms;
    _Atomic uint64_t sum[CGT_COUNTS]; /* cgt_counts */
} cgt_trace_counter;

/* Checks that the scene may be traced, makes the choices that the options leave open and starts the counter. */
cgt_result cgt_trace_prepare(const cgt_scene *scene, const cgt_trace_options *options, bool camera,
                             cgt_trace_settings *settings, cgt_trace_counter *counter);

/* Makes ready what the rays of a call go through, before any is traced: builds the BVH if so many rays pay for it, and
 * sets settings->use_bvh. Fails with a message. */
cgt_result cgt_ready_structures(const cgt_scene *scene, uint64_t rays, cgt_trace_settings *settings);

/* Whether the options set anything about packets, so that a frame must not go by whole tiles. */
bool cgt_requires_packets(const cgt_trace_options *options);

/* Checks that all elements of a caller's array, called `what`, have addresses, and that task numbers reach them. */
cgt_result cgt_check_strides(cgt_context *c, const char *what, size_t stride, size_t vector_stride, uint64_t count);

/* Checks the arrays of rays. */
cgt_result cgt_check_rays(cgt_context *c, const cgt_rays *rays);

/* Checks the arrays of points. */
cgt_result cgt_check_points(cgt_context *c, const cgt_points *points);

/* A single ray as an array of one, t_max where it ends. */
static inline float cgt_end_of_ray(const cgt_single_ray *ray)
{
    return cgt_is_zero(ray->t_max) ? INFINITY : ray->t_max;
}

static inline cgt_rays cgt_array_of_ray(const cgt_single_ray *ray, const float *t_max)
{
    return (cgt_rays){.count = 1,
                      .org = {ray->org, ray->org + 1, ray->org + 2},
                      .dir = {ray->dir, ray->dir + 1, ray->dir + 2},
                      .t_min = &ray->t_min,
                      .t_max = t_max,
                      .mask = &ray->mask,
                      .skip_primitive = ray->skip ? &ray->skip->primitive : NULL,
                      .skip_geometry = ray->skip ? &ray->skip->geometry : NULL};
}

/* Checks that planes of one field, called `what`, come together. */
cgt_result cgt_check_planes(cgt_context *c, const char *what, void *const plane[CGT_PLANES]);

/* Checks a frame's size, stride and planes. */
cgt_result cgt_check_frame(cgt_context *c, const cgt_frame *f);

/* The frame up to the last of its rows that a call works on, with their number. Cameras are prepared with the whole. */
cgt_frame cgt_cut_frame(const cgt_frame *f);

/* A visitor's part of a call: tasks run in the library's floating-point environment, it in that of the call. */
typedef struct cgt_visits {
    cgt_float_environment callers;
    atomic_bool stopped;
} cgt_visits;

void cgt_visits_begin(cgt_visits *visits);

/* Before and after a visitor runs; visit: what it returned. */
void cgt_visits_enter(const cgt_visits *visits);
void cgt_visits_leave(cgt_visits *visits, cgt_visit visit);

static inline bool cgt_visits_stopped(const cgt_visits *visits)
{
    return atomic_load_explicit(&visits->stopped, memory_order_relaxed);
}

/* OK, or STOPPED with the message. */
cgt_result cgt_visits_end(cgt_context *c, const cgt_visits *visits, const char *message);

/* Checks a camera and makes its rays. */
cgt_result cgt_prepare_camera(cgt_context *c, const cgt_camera *camera, const cgt_frame *frame, cgt_camera_rays *rays);

/* Adds the counts of one task. */
void cgt_trace_counter_add(cgt_trace_counter *counter, const cgt_counts *counts);

/* Fills in the statistics that the caller wants. */
void cgt_trace_store_statistics(const cgt_trace_options *options, const cgt_trace_settings *settings,
                                const cgt_trace_counter *counter);

#endif
