/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The whole numbers that hits are decided and computed from, for exact.h. Each primitive has its own unit of length;
 * the ray's direction has one that all primitives share. */
#ifndef CGT_EXACT_TERMS_H
#define CGT_EXACT_TERMS_H

#include "exact/integer/exact.h"
#include "exact/integer/exact_integer.h"

/* t = number / determinant * 2^exponent, n.(v0 - org) and n.dir; the determinant is 0 where the line is parallel to the
 * plane or the triangle has no area. */
typedef struct cgt_exact_plane {
    cgt_exact_integer number, determinant;
    int exponent;
    cgt_exact_limb limb[2][CGT_EXACT_LIMBS(3)];
} cgt_exact_plane;

/* t = (middle -+ sqrt(discriminant)) / scale * 2^exponent: dir.c, D and dir.dir of a sphere, m.w, D and m.m of a
 * cylinder. product is the other coefficient of scale t^2 - 2 middle t + product = 0. Of degrees 2 and 4, or 4 and
 * 8. */
typedef struct cgt_exact_quadratic {
    cgt_exact_integer middle, scale, product, discriminant;
    int exponent;
    cgt_exact_limb limb[3][CGT_EXACT_LIMBS(4)], discriminant_limb[CGT_EXACT_LIMBS(8)];
} cgt_exact_quadratic;

/* What a line and a capsule are decided from, all of degree 2: products of the direction d, the axis n from one of its
 * ends to the other, and the first end c, seen from the origin. cc_rr: c.c - r^2. */
typedef struct cgt_exact_dots {
    cgt_exact_integer dd, dn, nn, dc, cn, cc_rr;
    int exponent; /* of t */
    cgt_exact_limb limb[6][CGT_EXACT_LIMBS(2)];
} cgt_exact_dots;

/* Three numbers of degree 2 or 3. */
typedef struct cgt_exact_three {
    cgt_exact_integer of[3];
    cgt_exact_limb limb[3][CGT_EXACT_LIMBS(3)];
} cgt_exact_three;

void cgt_exact_plane_terms(const cgt_exact_ray *ray, const cgt_triangle *triangle, cgt_exact_plane *plane);
void cgt_exact_sphere_terms(const cgt_exact_ray *ray, cgt_sphere sphere, cgt_exact_quadratic *quadratic);

/* from_q: the axis is from q to p. */
void cgt_exact_capsule_dots(const cgt_exact_ray *ray, const cgt_capsule *capsule, bool from_q, cgt_exact_dots *dots);

/* Of the cylinder. */
void cgt_exact_cylinder_terms(const cgt_exact_dots *dots, cgt_exact_quadratic *quadratic);

/* X = d.c d.n - d.d c.n: where the middle of the line's chord lies along the axis, times m.m. */
void cgt_exact_capsule_middle(const cgt_exact_dots *dots, cgt_exact_integer *x);

/* Q = |n x (d x c)|^2 - r^2 (d.n)^2 = d.d (c.n)^2 - 2 d.c d.n c.n + (c.c - r^2) (d.n)^2: below 0 where the line passes
 * the plane across the axis at c inside the cylinder. Of degree 6. */
void cgt_exact_capsule_plane(const cgt_exact_dots *dots, cgt_exact_integer *q);

/* edge->of[k] is dir.(v[k+1] - org) x (v[k+2] - org): vertex k's share of the point where the line meets the plane,
 * times the determinant, which is the sum of the three. */
void cgt_exact_edge_terms(const cgt_exact_ray *ray, const cgt_triangle *triangle, cgt_exact_three *edge);

/* dir x (to - from) in some unit */
void cgt_exact_shift_terms(const cgt_exact_ray *ray, const float from[3], const float to[3], cgt_exact_three *shift);

/* (v1 - v0) x (v2 - v0) in some unit */
void cgt_exact_normal_terms(const cgt_triangle *triangle, cgt_exact_three *normal);

#endif
