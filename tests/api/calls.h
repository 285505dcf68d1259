/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Every call that builds or traces, in one table, with arguments that are good: for tests of what all calls promise
 * (stacks, memory, threads, forks, floating-point environments, the same bits). None of it asserts but what makes a
 * world, so that other threads and forked children may use it. */
#ifndef CALLS_H
#define CALLS_H

#include <cgt/all_hits.h>
#include <cgt/bounces.h>

#include "support/scenes.h"

/* A scene and what is asked about it. */
typedef struct api_world {
    const float (*sphere)[4], (*vertex)[3]; /* x, y, z, r; three vertices of each triangle */
    uint32_t spheres, triangles;
    float far_sphere[4]; /* a geometry of its own; radius 0: none */
    const float *org[3], *dir[3];
    uint32_t rays, width, height, samples;
    cgt_camera camera;
    cgt_light light[2]; /* each kind */
    void *memory;
} api_world;

/* Spheres in the unit cube, and an icosphere about them; at least 9 rays. */
api_world api_world_make(uint64_t stream, uint32_t spheres, uint32_t rays, uint32_t width, uint32_t height);
void api_world_free(api_world *w);

/* The world's geometries in a new scene, not committed; NULL where a call fails. */
cgt_scene *api_scene_make(const api_world *w, cgt_context *context, const cgt_scene_options *options);

#define API_ALL_HITS 3u

/* The place of all that calls write about a scene, at first 0; NULL without memory. */
typedef struct api_results {
    const api_world *world;
    cgt_scene *scene;
    cgt_frame frame;
    cgt_hits hits, bounced_hits;
    cgt_bounced_rays bounced; /* mirrored at hits */
    cgt_hit *single;
    cgt_hit *all_hits;   /* API_ALL_HITS a ray, then those of the first ray */
    uint32_t *all_count; /* of each ray in rows, of the first ray, and of each ray's visits */
    float *visibility;
    uint8_t *occluded_ray, *occluded_point[2], *shadows[2], *inside;
    size_t bytes;
    unsigned char *memory;
} api_results;

api_results *api_results_make(const api_world *w, cgt_scene *scene);
void api_results_free(api_results *r);
bool api_results_equal(const api_results *a, const api_results *b);

typedef struct api_call {
    const char *name;
    cgt_result (*make)(api_results *r);
    bool builds; /* a commit, or a structure before it is needed */
} api_call;

/* In this order: a BVH is built by the first call that pays for it, or prepared. */
extern const api_call api_calls[];
extern const size_t api_call_count;

/* Makes all calls that trace. Returns the first error. */
cgt_result api_trace_all(api_results *r);

#endif
