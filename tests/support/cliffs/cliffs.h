/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cliffs: scenes and rays in which one trouble, such as a single primitive far away, may cost far more than it should.
 * Each has a twin, the same scene and rays without the trouble, that tells what they should cost. Tests count the work
 * of both, cgt-bench measures their time.
 *   the catalogue                    cliffs.c
 *   undisturbed scenes               cliff_scene.c
 *   troubles of places and sizes     cliff_places.c
 *   troubles of shapes               cliff_shapes.c
 *   troubles of planes               cliff_planes.c
 *   rays, and their troubles         cliff_rays.c
 *   calls, and the work they count   cliff_work.c */
#ifndef CLIFFS_H
#define CLIFFS_H

#include <stdbool.h>
#include <stdint.h>

#include <cgt/research.h>

#include "support/oracle/truth.h"
#include "support/random.h"

/* What a scene is before it is disturbed. All lie within about 1 of the origin and are opaque to most rays. */
typedef enum cliff_base {
    CLIFF_CLOUD,  /* spheres of like size, evenly spread */
    CLIFF_SOUP,   /* triangles of like size, evenly spread, in random order */
    CLIFF_MESH,   /* a bumpy ball, its triangles in the order of neighbours */
    CLIFF_STICKS, /* capsules of like size, evenly spread */
    CLIFF_BASES
} cliff_base;

typedef struct cliff_scene {
    cliff_base base;
    uint32_t count; /* primitives */
    float *data;    /* of each sphere x, y, z and radius; of each triangle x, y, z of its three vertices; of each
                             * capsule x, y, z and radius at both ends */
    float size;     /* about the radius of an undisturbed sphere, or half the extent of the others */
    float middle[3], reach; /* the ball that camera and rays look at */
    cgt_camera camera;
    float light[3];
} cliff_scene;

/* Changes an undisturbed scene. amount: the catalogue's number, such as a distance. */
typedef void cliff_disturb(cliff_scene *scene, test_random *r, float amount);

/* Changes the ray of number i, which goes through the scene. */
typedef void cliff_bend(const cliff_scene *scene, test_random *r, float amount, uint32_t i, truth_ray *ray);

typedef struct cliff {
    const char *name; /* unique */
    cliff_base base;
    cliff_disturb *disturb; /* NULL: the scene is its twin's */
    float amount;
    cliff_bend *bend; /* NULL: the rays are its twin's. Otherwise arrays and single rays alone are of interest */
    float bend_amount;
} cliff;

/* ---- The catalogue ---- */

uint32_t cliff_count(void);
const cliff *cliff_at(uint32_t number);

/* Makes the scene of a cliff, or its twin's. count: primitives, 64 or more. The same with every seed. False where
 * memory is refused. Release with cliff_free. */
bool cliff_make(cliff_scene *scene, const cliff *c, bool disturbed, uint32_t count);
void cliff_free(cliff_scene *scene);

/* Rays for a scene that cliff_make has made with the same arguments: half of them from anywhere inside to anywhere,
 * half from outside to a primitive. */
void cliff_make_rays(const cliff_scene *scene, const cliff *c, bool disturbed, truth_ray *rays, uint32_t count);

/* Adds the scene as one geometry; the library reads scene->data. */
cgt_result cliff_add(const cliff_scene *scene, cgt_scene *to);

/* ---- Calls ---- */

typedef enum cliff_call {
    CLIFF_COMMIT,
    CLIFF_CAMERA,   /* cgt_trace_camera */
    CLIFF_LIGHT,    /* cgt_occluded_points, of the points that the camera sees */
    CLIFF_SINGLE,   /* cgt_trace_ray, right after the commit */
    CLIFF_RAYS,     /* cgt_trace_rays */
    CLIFF_OCCLUDED, /* cgt_occluded_rays */
    CLIFF_CALLS
} cliff_call;
const char *cliff_call_name(cliff_call call);

/* Whether the cliff's trouble concerns the call. */
bool cliff_concerns(const cliff *c, cliff_call call);

/* The structures that AUTO may choose, and AUTO itself; and a tree to compare with. */
typedef enum cliff_structure { CLIFF_AUTO, CLIFF_GRID, CLIFF_BVH, CLIFF_BIH, CLIFF_STRUCTURES } cliff_structure;
const char *cliff_structure_name(cliff_structure structure);
cgt_scene_options cliff_structure_options(cliff_structure structure);
bool cliff_has_structure(cliff_base base, cliff_structure structure); /* the BIH has no capsules */

/* What tracing calls counted, as the statistics have it, in steps that cost about the same: a test of a vector of
 * rays in single precision is one. */
double cliff_work(const cgt_trace_statistics *trace, const cgt_research_trace_statistics *research);

/* A point that a camera sees, and the primitive that it lies on. */
typedef struct cliff_point {
    float position[3];
    uint32_t primitive;
} cliff_point;

typedef struct cliff_points {
    uint32_t count;
    cliff_point *point;
} cliff_points;

/* The points that a camera sees of a committed scene, in the order of its pixels. False where memory is refused or a
 * call fails. Release with cliff_points_free. */
bool cliff_make_points(const cliff_scene *scene, const cgt_scene *committed, uint32_t width, uint32_t height,
                       cliff_points *points);
void cliff_points_free(cliff_points *points);

/* They as the library takes them. */
cgt_points cliff_points_array(const cliff_points *points);

/* ---- Shared by the files of this folder ---- */

/* Streams of random numbers: those of bases are their numbers, as far as there are such below. */
enum { CLIFF_STREAM_TROUBLE = 3, CLIFF_STREAM_RAYS, CLIFF_STREAM_BENT, CLIFF_STREAM_STICKS };
test_random cliff_random(uint32_t stream);
uint32_t cliff_floats(const cliff_scene *scene); /* of a primitive: 4, 8 or 9 */

/* The centre of a sphere, the mean of a triangle's vertices, of a capsule's ends. */
void cliff_middle(const cliff_scene *scene, uint32_t i, float middle[3]);

/* Moves a primitive's middle, and makes it `factor` times as large. */
void cliff_place(cliff_scene *scene, uint32_t i, const float middle[3], float factor);

/* Lets camera and light look at a ball as they look at the undisturbed scene. */
void cliff_look(cliff_scene *scene, const float middle[3], float reach);

cliff_disturb cliff_one_stray, cliff_strays, cliff_giant, cliff_far_clusters, cliff_dense_near, cliff_dense_whole,
    cliff_octaves, cliff_nested_octaves, cliff_levels, cliff_log_sizes, cliff_self_similar, cliff_stadium, cliff_copies,
    cliff_nearly_point, cliff_concentric, cliff_line, cliff_axis_line, cliff_plane, cliff_tilted_plane, cliff_big,
    cliff_scale, cliff_translate, cliff_eye_inside, cliff_log_normal, cliff_eye_far, cliff_eye_far_parallel,
    cliff_eye_on_surface, cliff_room, cliff_tilted_room, cliff_far_light, cliff_light_inside;
cliff_disturb cliff_fan, cliff_slivers, cliff_lying_sample, cliff_no_area, cliff_invalid, cliff_shuffled;
cliff_disturb cliff_one_long, cliff_needles, cliff_parallel, cliff_coaxial, cliff_coaxial_inside, cliff_listed_twice;
cliff_disturb cliff_floor, cliff_wall, cliff_decals, cliff_double_faces, cliff_halo, cliff_plummer;
cliff_bend cliff_bend_length, cliff_bend_far, cliff_bend_inside, cliff_bend_axis, cliff_bend_dead, cliff_bend_moment,
    cliff_bend_short, cliff_bend_same, cliff_bend_behind, cliff_bend_into_plane;

#endif
