/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A scene of spheres and triangles with rays that are hard on it, built piece by piece. Points are given in double,
 * around the origin and about 1 in size; the scene's place moves them to where float is coarser or finer, and rounds. A
 * failed allocation sets `failed`; nothing is added from then on. */
#ifndef HARD_SCENE_H
#define HARD_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "support/closed_meshes.h"
#include "support/random.h"
#include "support/oracle/truth.h"

#define HARD_MOST_GEOMETRIES 8u

/* Spheres or triangles: the other counts are 0. */
typedef struct hard_geometry {
    uint32_t spheres;
    float (*sphere)[4]; /* x, y, z, r */
    uint32_t vertices, triangles;
    float (*vertex)[3];
    uint32_t (*index)[3];
    size_t room[3]; /* capacity of the three arrays, in elements */
} hard_geometry;

typedef struct hard_place {
    double scale;
    double offset[3];
} hard_place;

typedef struct hard_scene {
    hard_geometry geometry[HARD_MOST_GEOMETRIES];
    uint32_t geometries;
    uint32_t resolution[3]; /* of the grid; 0, 0, 0: the library's choice */
    truth_ray *ray;
    uint32_t rays, wanted; /* present; requested */
    size_t room;           /* for rays */
    hard_place place;
    test_random random;
    bool failed;
} hard_scene;

void hard_scene_free(hard_scene *s);
uint32_t hard_scene_primitives(const hard_scene *s);

/* A point after the scene's place is applied. */
void hard_put(const hard_scene *s, const double point[3], float placed[3]);

/* ---- primitives: of the kind of the last geometry, or in a new one ---- */

void hard_new_geometry(hard_scene *s);
void hard_sphere(hard_scene *s, const double center[3], double r);
void hard_triangle(hard_scene *s, const double vertex[3][3]);

/* A mesh as a geometry of its own; scale and shift come before the scene's place. */
void hard_mesh(hard_scene *s, const closed_mesh *mesh, double scale, const double shift[3]);
void hard_closed_mesh(hard_scene *s, closed_kind kind, uint32_t detail);

/* A primitive without the place applied. */
void hard_raw_sphere(hard_scene *s, const float sphere[4]);
void hard_raw_triangle(hard_scene *s, const float vertex[3][3]);

/* ---- rays ---- */

/* Whether fewer rays than requested were added. */
bool hard_wants_ray(const hard_scene *s);

/* From a point in a direction that is used unchanged. */
void hard_ray(hard_scene *s, const double org[3], const float dir[3]);

/* From one float point to another; along x where the two are equal. length: factor for the direction. */
void hard_aim(hard_scene *s, const float org[3], const float target[3], float length);

/* A ray without the place applied. */
void hard_raw_ray(hard_scene *s, const truth_ray *ray);

/* ---- random parts: at most one call per expression: C leaves their order open ---- */

double hard_real(hard_scene *s, double low, double high);
void hard_point(hard_scene *s, double low, double high, double p[3]);
void hard_direction(hard_scene *s, double d[3]);

/* A whole multiple of `unit` from low to high, in each coordinate. */
void hard_lattice_point(hard_scene *s, int low, int high, double unit, double p[3]);

/* 1 in three cases of four, else a factor between 2^-20 and 2^20: directions of any length. */
float hard_length(hard_scene *s);

/* A random triangle of the scene, its vertices as the library sees them; false if there is none. */
bool hard_any_triangle(hard_scene *s, float vertex[3][3]);

#endif
