/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decisions that single precision leaves open: by double precision with error bounds, then by exact arithmetic
 * (exact.h). Which ray hits which primitive, and which of two hits is nearer, is what exact arithmetic gives. A hit's t
 * is canonical: computed in double in one order of operations where that is safe, else from exact arithmetic, at most
 * 0.51 ulp of float off; the resolve of whole packets gives the same bits. */
#ifndef CGT_DECIDE_H
#define CGT_DECIDE_H

#include "exact/integer/exact.h"

typedef struct cgt_ray {
    cgt_exact_ray line;
    float t_min, t_max;
} cgt_ray;

typedef struct cgt_decided_hit {
    cgt_primitive primitive;
    double t;              /* canonical */
    bool far;              /* a sphere's second root; where the ray leaves a capsule */
    cgt_capsule_part part; /* of a capsule, that is hit */
} cgt_decided_hit;

/* Whether the ray hits hit->primitive within its closed range, t rounded to float, and where. A t that rounds to
 * infinity is no hit. *exact counts decisions that took exact arithmetic. */
bool cgt_decide_hit(const cgt_ray *ray, cgt_decided_hit *hit, uint64_t *exact);

/* Computes the canonical t of a primitive that the ray is known to hit. */
void cgt_decide_t(const cgt_ray *ray, cgt_decided_hit *hit);

/* In how many places the ray's line meets a primitive: up to 1 of a triangle, up to 2 of a sphere or a
 * capsule. */
int cgt_decide_roots(const cgt_ray *ray, const cgt_primitive *primitive, uint64_t *exact);
int cgt_decide_sphere_roots(const cgt_ray *ray, cgt_sphere sphere, uint64_t *exact);

/* Computes the canonical t of root hit->far, which is there. Returns whether the ray hits there, as cgt_decide_hit has
 * it. */
bool cgt_decide_root(const cgt_ray *ray, cgt_decided_hit *hit);

/* Of the sum of two canonical values: where they differ by more, that is the order of the exact ones. More than the
 * errors of both together. */
#define CGT_ORDER_ERROR 0x1p-27

/* Sign of the exact t(a) - t(b). */
int cgt_decide_order(const cgt_ray *ray, const cgt_decided_hit *a, const cgt_decided_hit *b, uint64_t *exact);

/* Whether a hit, whose t is computed, is closer than that of `best`, which the ray hits, too: by the exact t, then by
 * the lower number. Computes best->t. */
bool cgt_decide_is_closer(const cgt_ray *ray, uint32_t prim, const cgt_decided_hit *hit, uint32_t best_prim,
                          cgt_decided_hit *best, uint64_t *exact);

/* The first root of a sphere at or after t_min, and within the range of float, and whether that is the second one:
 * exact where double is not safe. */
double cgt_canonical_sphere_t(const cgt_ray *ray, cgt_sphere sphere, bool *far);
double cgt_canonical_sphere_far(const cgt_ray *ray, cgt_sphere sphere); /* the second root */
double cgt_canonical_triangle_t(const cgt_ray *ray, const cgt_triangle *triangle);

/* The outward unit normal where the ray hits the sphere at t. A point has none: it gets the direction towards the ray's
 * origin. The operations are those of kernel/resolve/resolve_spheres.h, so that zeros have the same signs. */
void cgt_canonical_sphere_normal(const cgt_ray *ray, cgt_sphere sphere, double t, float normal[3]);

#endif
