/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench light: lights anywhere, points in any order, beside Embree's best way to trace the same rays.
 *   command line, loops                  bench_light.c
 *   where lights stand                   light_places.c
 *   which points they may reach          light_points.c
 *   the library                          light_library.c
 *   Embree, where it is installed        light_embree.c */
#ifndef BENCH_LIGHT_H
#define BENCH_LIGHT_H

#include "common/bench.h"
#include "common/bench_input.h"
#include "common/bench_embree.h"
#include "common/bench_threads.h"
#include "rays/bench_planes.h"
#include "rays/bench_tiles.h"

#define LIGHT_SCATTERED_POINTS 100000u
#define LIGHT_MOST 8u /* lights of a place */

/* What both programs measure: one frame of a file, as the camera sees it. */
typedef struct light_scene {
    bench_input input;
    uint32_t count; /* spheres or vertices, in input.moving */
    float low[3], high[3];
    cgt_camera camera;
    bench_camera_axes axes;
    bench_planes planes; /* of the camera's hits */
    uint32_t *geometry;  /* the same */
} light_scene;

/* A scene of the library, AUTO, over the frame; and the planes of its hits. */
cgt_result light_scene_library(const light_scene *scene, cgt_context *context, bench_scene *library);
void light_scene_frame(const light_scene *scene, cgt_frame *frame);

/* ---- lights ---- */

typedef struct light_place {
    const char *name;
    uint32_t count; /* of lights, which are traced one after the other */
    cgt_light light[LIGHT_MOST];
} light_place;

enum { LIGHT_PLACES = 14 };
extern const char *const light_place_names[LIGHT_PLACES];

/* Places the lights of `which` in the scene, whose hits are known. */
void light_place_make(const light_scene *scene, int which, light_place *place);

/* ---- points ---- */

typedef enum light_order {
    LIGHT_TILES,     /* what the camera sees: a call for each tile of 64x64 pixels */
    LIGHT_SKIPPING,  /* the same on the very hits, each skipping its primitive, as those of a frame do */
    LIGHT_FRAME,     /* these by cgt_occluded_frame */
    LIGHT_SHUFFLED,  /* the first ones in no order, in one call */
    LIGHT_SCATTERED, /* random points of the scene's box, in one call */
    LIGHT_SORTED,    /* the same along a Morton curve */
    LIGHT_ORDERS
} light_order;
extern const char *const light_order_names[LIGHT_ORDERS];

typedef struct light_points {
    light_order order;
    uint64_t count;
    float *position[3];
    uint32_t *primitive, *geometry; /* SKIPPING alone: that they skip */
    uint64_t *end;                  /* of each call */
    uint32_t calls;
    void *memory;
} light_points;

/* 0, or -1 where memory is refused. */
int light_points_make(const light_scene *scene, light_order order, light_points *points);
void light_points_release(light_points *points);

/* ---- results ---- */

typedef struct light_result {
    double ms, build_ms; /* the library's build is its commit; what it builds for a light is in ms */
    uint64_t occluded;
    const char *way;
    double references, tests,
        tree_share; /* of the library: for each point; the part of points that went through a tree */
} light_result;

/* By the library, after a commit and the camera's frame each time: medians. The first round warms up. */
cgt_result light_measure_library(cgt_context *context, const light_scene *scene, const light_place *place,
                                 const light_points *points, uint32_t rounds, light_result *result);

/* The fastest way of all. 0, or -1 where memory is refused. */
int light_measure_embree(embree_scenes *embree, const light_place *place, const light_points *points, uint32_t rounds,
                         light_result *result);

#endif
