/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The surface that a ray has hit, computed in double from the floats of ray and primitive, not from t: the rounding of
 * t is not inherited. And where a ray begins that leaves the surface. */
#ifndef CGT_SURFACE_H
#define CGT_SURFACE_H

#include "model/primitive.h"

/* A ray in double. */
typedef struct cgt_double_ray {
    double org[3], dir[3];
    double length; /* of dir, above 0 */
} cgt_double_ray;

typedef struct bounce_surface {
    double position[3];
    double normal[3]; /* outward, of unit length */
    double length;    /* of the way from the ray's origin, 0 or more */
    bool front;       /* the ray comes from outside */
    double u;         /* of a capsule, along its axis; else 0 */
} bounce_surface;

/* Returns false where a number is not finite, or the direction is zero. */
bool cgt_double_ray_init(const float org[3], const float dir[3], cgt_double_ray *ray);

/* Finds the surface of a hit at t; +infinity: at the far root of a sphere or a capsule. Returns false where the
 * primitive has none: its numbers are not finite, or it has no area. */
bool cgt_find_surface(const cgt_primitive *q, const cgt_double_ray *ray, float t, bounce_surface *surface);

/* The t of a hit in double: of a sphere or a capsule the root that t belongs to, of a triangle that of its plane. Sets
 * the surface's normal, of any length, its u and front: of the former, whether it is the near root. */
double cgt_surface_t(const cgt_primitive *q, const cgt_double_ray *ray, float t, bounce_surface *surface);

/* Where a ray that begins inside the surface of a sphere or a capsule, but for rounding, meets it again; at least 0. */
double cgt_far_root(const cgt_primitive *q, const cgt_double_ray *ray);

/* A float next to a place, on the side that the ray comes from along each axis: so that a surface in contact, which the
 * ray has not crossed, is less often crossed by rounding. */
void cgt_round_place(const double place[3], const double from[3], float out[3]);

#endif
