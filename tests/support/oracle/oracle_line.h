/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One line and one primitive, exactly. They meet at a root t = (p + sigma sqrt(disc)) / q of dyadic p, q, disc: spheres
 * need the square root, triangles and the ends of a range do not. Roots are compared without computing them. */
#ifndef ORACLE_LINE_H
#define ORACLE_LINE_H

#include "support/oracle/dyadic.h"
#include "support/oracle/oracle.h"

typedef struct oracle_line {
    dyadic org[3], dir[3];
    dyadic dd; /* dir . dir */
} oracle_line;

typedef struct oracle_root {
    dyadic p, q, disc; /* q > 0, disc >= 0; spheres on one line have the same q */
    int sigma;         /* -1, 1; 0 and disc = 0 for a rational root */
    truth_real t;      /* relative error of a few units in the last place */
    uint32_t surface;  /* of a capsule: 0 the side, 1 the sphere around p, 2 that around q */
} oracle_root;

/* The ends of a range, as values of t or as the interval of t that rounds to the floats. */
typedef struct oracle_range {
    oracle_root low, high;
    bool low_inside, high_inside; /* whether the end itself belongs to it */
} oracle_range;

/* False if the ray is not finite, has no direction, or has a NaN in its range: it hits nothing. */
bool oracle_line_make(const truth_ray *ray, oracle_line *line);

/* The exact t that round to a finite float from t_min to t_max. Moves the ends inwards by `inwards` times 2^-6 ulp, -31
 * to 31. The floats must not be NaN. */
oracle_range oracle_range_make(float t_min, float t_max, int inwards);

/* Where the line meets a valid primitive: 0, 1 or 2 roots, ascending. */
int oracle_roots(const oracle_line *line, const oracle_primitive *primitive, oracle_root roots[2]);

/* Of a triangle: 1 where the line goes along its normal, -1 where it goes against it, 0 in its plane. */
int oracle_triangle_side(const oracle_line *line, const float vertex[9]);

bool oracle_is_in(const oracle_root *root, const oracle_range *range);

/* The order of two roots on the same line: -1, 0, 1. */
int oracle_compare(const oracle_root *a, const oracle_root *b);

/* The first root in the range: its index, or -1. */
int oracle_first_root(const oracle_line *line, const oracle_primitive *primitive, const oracle_range *range,
                      oracle_root *first);

/* ---- Shared with oracle_capsule.c ---- */

/* Sign of x + sigma sqrt(d). */
int oracle_sign_of_surd(const dyadic *x, int sigma, const dyadic *d);

/* point - org */
void oracle_from_origin(const oracle_line *line, const float point[3], dyadic result[3]);

/* The roots (p -+ sqrt(p^2 - q product)) / q of q t^2 - 2 p t + product = 0: 0, 1 or 2. */
int oracle_quadratic_roots(const dyadic *p, const dyadic *q, const dyadic *product, oracle_root roots[2]);

int oracle_sphere_roots(const oracle_line *line, const float sphere[4], oracle_root roots[2]);
int oracle_capsule_roots(const oracle_line *line, const float capsule[7], oracle_root roots[2]);

/* Divides by the length, and by the largest component first: squares of the input could leave the range. */
void oracle_make_unit(truth_real v[3]);

void oracle_describe_sphere(const oracle_line *line, const float sphere[4], const oracle_root *root, oracle_hit *hit);
void oracle_describe_capsule(const oracle_line *line, const float capsule[7], const oracle_root *root, oracle_hit *hit);

/* ---- What a hit carries ---- */

/* u, v and the normal where the line meets the primitive at the root. */
void oracle_describe(const oracle_line *line, const oracle_primitive *primitive, const oracle_root *root,
                     oracle_hit *hit);

#endif
