/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The ray-sphere test that decides: double precision on the float input, in one order of operations, unfused.
 *
 * Perpendicular form: with c the centre seen from the origin, s = d.c / d.d, l = c - s d, the discriminant is
 * r^2 - l.l, which does not cancel for a far or a huge sphere (Haines, Gunther, Akenine-Moller, "Precision
 * Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019, chapter 7). The root that would cancel comes from
 * the other by their product (c.c - r^2) / d.d.
 *
 * Products of two floats are exact in double; what rounds is bounded by about 2^-50 of |c|, so t is within 1 ulp of
 * float unless it is smaller than 2^-26 of the distance to the centre. */
#ifndef CGT_SPHERE_EXACT_H
#define CGT_SPHERE_EXACT_H

#include <math.h>
#include <stdbool.h>

#include "objects.h"

/* The quadratic t^2 - 2 middle t + product = 0 of a line and a sphere, with the square of half the distance of its
 * roots: negative for a miss. */
typedef struct cgt_sphere_terms {
    double middle, product, half2;
} cgt_sphere_terms;

/* Both steps are written without branches, so that a loop over rays becomes vector code. */
static inline cgt_sphere_terms cgt_sphere_exact_terms(const float org[3], const float dir[3], cgt_sphere q)
{
    const double cx = (double)q.x - (double)org[0], cy = (double)q.y - (double)org[1],
                 cz = (double)q.z - (double)org[2];
    const double dx = (double)dir[0], dy = (double)dir[1], dz = (double)dir[2], r = (double)q.r;
    const double rdd = 1 / (dx * dx + dy * dy + dz * dz);
    const double s = (dx * cx + dy * cy + dz * cz) * rdd;
    const double lx = cx - s * dx, ly = cy - s * dy, lz = cz - s * dz;
    return (cgt_sphere_terms){.middle = s,
                              .product = (cx * cx + cy * cy + cz * cz - r * r) * rdd,
                              .half2 = (r * r - (lx * lx + ly * ly + lz * lz)) * rdd};
}

/* The first root at or after t_min, as float sees it; NaN for a miss. */
static inline double cgt_sphere_exact_root(double middle, double product, double half2, float t_min)
{
    const double half = sqrt(half2); /* NaN for a miss, and it stays NaN */
    const double large = middle + (middle > 0 ? half : -half);
    const double small = product / (large != 0 ? large : 1); /* both are 0 where large is */
    const double near = middle > 0 ? small : large, far = middle > 0 ? large : small;
    return (float)near >= t_min ? near : far;
}

static inline double cgt_sphere_exact_t(const float org[3], const float dir[3], float t_min, cgt_sphere q)
{
    const cgt_sphere_terms e = cgt_sphere_exact_terms(org, dir, q);
    return cgt_sphere_exact_root(e.middle, e.product, e.half2, t_min);
}

/* True where that hit exists and lies in the closed range [t_min, t_max], t rounded to float; a t that rounds to
 * infinity is none. */
static inline bool cgt_sphere_exact_hit(const float org[3], const float dir[3], float t_min, float t_max, cgt_sphere q,
                                        double *t)
{
    *t = cgt_sphere_exact_t(org, dir, t_min, q);
    const float rounded = (float)*t;
    return rounded >= t_min && rounded <= t_max && rounded < INFINITY; /* false for NaN */
}

#endif
