/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes traced by Embree, ray by ray, with answers in the library's form. Input that Embree does not accept must be
 * removed first: its manual drops primitives with a NaN, an infinity or a value beyond 1.844e18 (rtcCommitScene) and
 * allows no range that begins before 0 (rtcIntersect1); its assertions apply the same limit to origins and
 * directions. */
#ifndef EMBREE_SCENE_H
#define EMBREE_SCENE_H

#include <stdbool.h>

#include <embree3/rtcore.h>

#include "hard_cases/hard_scene.h"
#include "support/ray_arrays.h"

/* Opens the Embree device that all scenes share; false with a message on failure. Errors of later calls are printed
 * too. */
bool embree_begin(void);
void embree_end(void);

/* A committed scene. Spheres and triangles are in separate scenes: where a sphere's t becomes a NaN, an assertion at
 * the start of the triangle test would abort the process. */
typedef struct embree_scene {
    RTCScene spheres, triangles; /* NULL: none */
} embree_scene;

/* Copies the arrays and keeps the geometries' ids. False where Embree refuses. */
bool embree_scene_make(const hard_scene *s, enum RTCSceneFlags flags, embree_scene *scene);
void embree_scene_free(embree_scene *scene);

/* A ray for Embree, from t_min to t_max, which sees everything and has hit nothing. */
struct RTCRayHit embree_query(const truth_ray *ray, float t_min, float t_max);

/* The closest hit as Embree finds it; the normal stays 0. */
full_hit embree_trace(const embree_scene *scene, const truth_ray *ray);

/* A copy of a scene without the input that Embree does not accept. */
typedef struct embree_part {
    hard_scene scene;
    uint32_t primitives, rays; /* removed from the copy */
} embree_part;

/* False where memory is refused. */
bool embree_part_make(const hard_scene *s, embree_part *part);

#endif
