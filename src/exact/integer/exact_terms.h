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

/* t = (middle -+ sqrt(discriminant)) / scale * 2^exponent: dir.c, D and dir.dir. product is c.c - r^2, the other
 * coefficient of scale t^2 - 2 middle t + product = 0. */
typedef struct cgt_exact_quadratic {
    cgt_exact_integer middle, scale, product, discriminant;
    int exponent;
    cgt_exact_limb limb[3][CGT_EXACT_LIMBS(2)], discriminant_limb[CGT_EXACT_LIMBS(4)];
} cgt_exact_quadratic;

/* Three numbers of degree 2 or 3. */
typedef struct cgt_exact_three {
    cgt_exact_integer of[3];
    cgt_exact_limb limb[3][CGT_EXACT_LIMBS(3)];
} cgt_exact_three;

void cgt_exact_plane_terms(const cgt_exact_ray *ray, const cgt_triangle *triangle, cgt_exact_plane *plane);
void cgt_exact_sphere_terms(const cgt_exact_ray *ray, cgt_sphere sphere, cgt_exact_quadratic *quadratic);

/* edge->of[k] is dir.(v[k+1] - org) x (v[k+2] - org): vertex k's share of the point where the line meets the plane,
 * times the determinant, which is the sum of the three. */
void cgt_exact_edge_terms(const cgt_exact_ray *ray, const cgt_triangle *triangle, cgt_exact_three *edge);

/* dir x (to - from) in some unit */
void cgt_exact_shift_terms(const cgt_exact_ray *ray, const float from[3], const float to[3], cgt_exact_three *shift);

/* (v1 - v0) x (v2 - v0) in some unit */
void cgt_exact_normal_terms(const cgt_triangle *triangle, cgt_exact_three *normal);

#endif
