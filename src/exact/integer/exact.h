/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The last stage of every decision: exact arithmetic on the float input, for all finite floats, denormals included.
 * Floats are whole numbers times powers of two; all predicates are signs of homogeneous polynomials of them, so a
 * common power of two is taken out and integers are left. Called where double precision cannot tell: rarely on
 * ordinary scenes, for every tenth test on degenerate ones.
 *
 * A hit's parameter t of the line org + t dir:
 *   triangle  t = n.(v0 - org) / n.dir,  n = (v1 - v0) x (v2 - v0)
 *   sphere    t = (dir.c -+ sqrt(D)) / dir.dir,  c = centre - org,  D = (dir.c)^2 - dir.dir (c.c - r^2)
 *   cylinder  t = (m.w -+ sqrt(D)) / m.m,  n = q - p,  c = p - org,  m = dir x n,  w = c x n,
 *             D = (m.w)^2 - m.m (w.w - r^2 n.n)
 * None of the functions keeps state or allocates. */
#ifndef CGT_EXACT_H
#define CGT_EXACT_H

#include "model/primitive.h"

typedef struct cgt_exact_ray {
    float org[3], dir[3]; /* finite; dir is not zero */
} cgt_exact_ray;

/* Where a line enters or leaves a capsule: at its side, or at the sphere of radius r around p or q. */
typedef enum cgt_capsule_part { CGT_CAPSULE_SIDE = 0, CGT_CAPSULE_P, CGT_CAPSULE_Q } cgt_capsule_part;

static inline cgt_sphere cgt_capsule_end(const cgt_capsule *capsule, cgt_capsule_part part)
{
    const float *c = part == CGT_CAPSULE_Q ? capsule->q : capsule->p;
    return (cgt_sphere){c[0], c[1], c[2], capsule->r};
}

/* One root of a primitive: far chooses a sphere's second; false for triangles. Of a capsule it is a root of the
 * unbounded cylinder around p and q: those of its ends are the spheres'. */
typedef struct cgt_exact_root {
    const cgt_primitive *primitive; /* finite; the line of the ray meets it */
    bool far;
} cgt_exact_root;

/* True where the line through the ray meets the closed triangle and is not parallel to its plane. */
bool cgt_exact_line_hits_triangle(const cgt_exact_ray *ray, const cgt_triangle *triangle);

/* The sign of dir.n: 1 where the ray leaves the side that the triangle's normal points away from, 0 along its plane. */
int cgt_exact_triangle_side(const cgt_exact_ray *ray, const cgt_triangle *triangle);

/* In how many places the line through the ray meets the sphere: 0 where D < 0, 1 where D = 0, or 2. */
int cgt_exact_sphere_roots(const cgt_exact_ray *ray, cgt_sphere sphere);

/* On which side of all edges of a triangle the moved line (exact/crossing.h) passes: 1 or -1, the sign of dir.n, where
 * it crosses the triangle, else 0. */
int cgt_exact_crossing(const cgt_exact_ray *ray, const cgt_triangle *triangle);

/* The sign of the moved ray's t at the plane of a triangle that it crosses. */
int cgt_exact_crossing_t_sign(const cgt_exact_ray *ray, const cgt_triangle *triangle);

/* The signs of dir.c and of c.c - r^2. */
void cgt_exact_sphere_signs(const cgt_exact_ray *ray, cgt_sphere sphere, int *middle, int *product);

/* Likewise of a capsule. part: where the line enters, and where it leaves, if it meets the capsule. */
int cgt_exact_capsule_roots(const cgt_exact_ray *ray, const cgt_capsule *capsule, cgt_capsule_part part[2]);

/* Sign of t(a) - t(b): -1, 0 or 1. */
int cgt_exact_compare(const cgt_exact_ray *ray, const cgt_exact_root *a, const cgt_exact_root *b);

/* t within 2^-50 of its size; exactly 0 where it is 0. Infinite beyond the range of double. */
double cgt_exact_t(const cgt_exact_ray *ray, const cgt_exact_root *root);

/* u and v of the point where the line meets the triangle's plane, v1's and v2's shares, within 2^-50 of their sizes. */
void cgt_exact_uv(const cgt_exact_ray *ray, const cgt_triangle *triangle, double uv[2]);

/* Where along the axis, 0 at p and 1 at q, the line enters or leaves the cylinder, within 2^-50 of its size. */
double cgt_exact_capsule_u(const cgt_exact_ray *ray, const cgt_capsule *capsule, bool far);

/* The exact (v1 - v0) x (v2 - v0), each component within 2^-52 of its size, times one power of two that keeps the
 * largest between 1/2 and 4; all 0 where the triangle has no area. */
void cgt_exact_normal(const cgt_triangle *triangle, double normal[3]);

#endif
