/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays and hits as arrays of structs, and a camera's rays as the library generates them; for tests and for
 * cgt-bench. */
#ifndef RAY_ARRAYS_H
#define RAY_ARRAYS_H

#include <cgt/cgt.h>

#include "query/camera.h"
#include "support/oracle/truth.h"

typedef struct full_hit {
    float t;
    uint32_t primitive, geometry;
    float normal[3];
    float uv[2];
} full_hit;

cgt_rays ray_array(const truth_ray *rays, uint64_t count);
cgt_hits hit_array(full_hit *hits);

/* A hit of cgt_trace_ray as an element of such an array. */
full_hit full_hit_of(const cgt_hit *hit);

/* The same ray for cgt_trace_ray, whose t_max of 0 means another one. */
cgt_single_ray single_ray(const truth_ray *ray);

/* Traces all fields. */
cgt_result trace_array(const cgt_scene *scene, const truth_ray *rays, uint64_t count, full_hit *hits,
                       const cgt_trace_options *options);

/* The canonical ray of a pixel, in the order of operations that camera.h names. */
truth_ray camera_ray(const cgt_camera_rays *camera, uint32_t x, uint32_t y);

#endif
