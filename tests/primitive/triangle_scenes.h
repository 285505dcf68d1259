/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles, scenes of triangles, and rays towards them, for the tests of triangles. A failure here fails the test. */
#ifndef TRIANGLE_SCENES_H
#define TRIANGLE_SCENES_H

#include "support/ray_arrays.h"
#include "support/scenes.h"

typedef float triangle[3][3];

/* Describes triangles without indices. */
cgt_triangles triangles_of(const triangle *t, uint32_t count);

/* A committed scene of one geometry. options may be NULL. */
cgt_scene *scene_of_triangles(cgt_context *context, const cgt_scene_options *options, const triangle *t,
                              uint32_t count);

/* Make an empty scene, add geometries, and commit it. */
cgt_scene *scene_begin(cgt_context *context);
uint32_t scene_add_triangles(cgt_scene *scene, const triangle *t, uint32_t count);
uint32_t scene_add_spheres(cgt_scene *scene, const float (*sphere)[4], uint32_t count);
void scene_commit(cgt_context *context, cgt_scene *scene);

/* Random triangles of about the given size in a box of edge 2 about the origin. */
void random_triangles(test_random *r, float size, triangle *t, uint32_t count);

/* Rays from around that box into it, with directions of any length; half of them in fans of 64 from one origin. */
void random_rays(test_random *r, truth_ray *ray, uint32_t count);

/* Traces all fields; fails the test if the call fails. */
void trace_all(const cgt_scene *scene, const truth_ray *ray, uint32_t count, full_hit *hit,
               const cgt_trace_options *options);

/* The defaults except for the precision. */
cgt_trace_options with_precision(cgt_precision precision);

/* Returns the number of hits. */
uint32_t hits_in(const full_hit *of, uint32_t count);

#endif
