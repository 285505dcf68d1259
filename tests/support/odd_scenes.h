/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small scenes of primitives at odds with single precision: long, thin, huge, far apart, equal; and cameras, lights and
 * points next to them. */
#ifndef ODD_SCENES_H
#define ODD_SCENES_H

#include "support/oracle/oracle.h"
#include "support/scenes.h"

enum { ODD_MOST = 2048 }; /* primitives of a kind */

typedef struct odd_scene {
    float sphere[ODD_MOST][4], capsule[ODD_MOST][7], vertex[3 * ODD_MOST][3];
    uint32_t spheres, capsules, triangles;
    float unit; /* the size of most of it */
} odd_scene;

typedef enum odd_family {
    ODD_RODS,    /* capsules of lengths from 1 to 1e15 radii, some parallel, some equal */
    ODD_SLIVERS, /* triangles of an aspect of up to 1e15 */
    ODD_GIANTS,  /* some are 10 to 1e15 times as large as the others */
    ODD_STRAYS,  /* some are 1e2 to 1e32 away from the others, or reach so far */
    ODD_SIZES,   /* of any size each, around one point */
    ODD_EQUALS,  /* parallel, coaxial, touching and equal ones, on a lattice */
    ODD_USUAL,   /* for eyes and lights that are not */
    ODD_CROWDS,  /* enough for cells to be culled, and levels of crowded regions */
    ODD_SPECKS,  /* so small, next to others, that squares underflow */
    ODD_FAMILIES
} odd_family;

/* A number, often a power of ten. */
float odd_power(test_random *r, float low, float high);

/* A point so far away from another in any direction, now and then along an axis. */
void odd_beside(test_random *r, const float from[3], float way, float p[3]);

const char *odd_name(odd_family family);

/* Makes a scene at any scale, maybe far from the origin. */
void odd_scene_make(test_random *r, odd_family family, odd_scene *s);

cgt_scene *odd_scene_commit(cgt_context *context, const odd_scene *s);

/* The same for the oracle. */
oracle_scene odd_scene_truth(const odd_scene *s);

/* A point on, in or near any primitive; returns a length that is one of its own. */
float odd_place(test_random *r, const odd_scene *s, float p[3]);

/* From outside, from where something is, from far away, along a surface. zoomed: it sees little. */
cgt_camera odd_camera(test_random *r, const odd_scene *s, bool zoomed);

cgt_light odd_light(test_random *r, const odd_scene *s);

/* Clumps of points near primitives, and others anywhere. */
void odd_points(test_random *r, const odd_scene *s, uint32_t count, float *const position[3]);

#endif
