/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ray and sphere in double precision on the float input, in one order of operations, unfused, with error bounds.
 *
 * Perpendicular form: with c the centre seen from the origin, s = d.c / d.d, l = c - s d, the discriminant is
 * h = r^2 - l.l, which does not cancel for a far or a huge sphere (Haines, Gunther, Akenine-Moller, "Precision
 * Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019, chapter 7). The root that would cancel comes from
 * the other by their product (c.c - r^2) / d.d.
 *
 * Bounds, with e = 2^-53 and |c| at most its 1-norm; the steps are those of kernel/sphere_filter.h, products of two
 * floats being exact here:
 *   s        13 e |c| / |d|
 *   h        9 e r (|c| + r) + 640 e^2 |c|^2
 *   product  8 e (c.c + r^2) / d.d
 *   half     of the roots' distance: h's error / (|d|^2 half) + 4 e half
 * A root is safe where each of its parts errs by at most 2^-32 of it; squares are compared, to spare a root.
 * No term leaves the range of double: floats and their differences lie between 2^-149 and 2^129. */
#ifndef CGT_SPHERE_DOUBLE_H
#define CGT_SPHERE_DOUBLE_H

#include <math.h>

#include "shape.h"

#define CGT_DOUBLE_U 0x1p-53

/* Values whose relative error is at most this are rounded to float as they are: at most 0.51 ulp off. What cancels more
 * is computed in exact arithmetic. */
#define CGT_DOUBLE_SAFE 0x1p-30

/* The quadratic t^2 - 2 middle t + product = 0 of a line and a sphere, with the square of half the distance of its
 * roots: negative for a miss; and the errors of all. */
typedef struct cgt_sphere_terms {
    double middle, product, half2;
    double middle_error2, product_error, half2_error; /* the first squared */
} cgt_sphere_terms;

/* All steps are written without branches, so that a loop over rays becomes vector code. */
static inline cgt_sphere_terms cgt_sphere_double_terms(const float org[3], const float dir[3], cgt_sphere q)
{
    const double cx = (double)q.x - (double)org[0], cy = (double)q.y - (double)org[1],
                 cz = (double)q.z - (double)org[2];
    const double dx = (double)dir[0], dy = (double)dir[1], dz = (double)dir[2], r = (double)q.r;
    const double rdd = 1 / (dx * dx + dy * dy + dz * dz);
    const double s = (dx * cx + dy * cy + dz * cz) * rdd;
    const double lx = cx - s * dx, ly = cy - s * dy, lz = cz - s * dz;
    const double cc = cx * cx + cy * cy + cz * cz, rr = r * r;
    const double distance = fabs(cx) + fabs(cy) + fabs(cz), wide = 26 * CGT_DOUBLE_U * distance;
    return (cgt_sphere_terms){.middle = s,
                              .product = (cc - rr) * rdd,
                              .half2 = (rr - (lx * lx + ly * ly + lz * lz)) * rdd,
                              .middle_error2 = wide * wide * rdd,
                              .product_error = 8 * CGT_DOUBLE_U * (cc + rr) * rdd,
                              .half2_error = (9 * CGT_DOUBLE_U * r * (distance + r) + wide * wide) * rdd};
}

/* Both roots, near <= far; NaN for a miss. Not safe: one of them has lost more than CGT_DOUBLE_SAFE allows. */
typedef struct cgt_sphere_roots {
    double near, far;
    bool safe;
} cgt_sphere_roots;

static inline cgt_sphere_roots cgt_sphere_double_roots(cgt_sphere_terms e)
{
    const double half = sqrt(e.half2); /* NaN for a miss, and it stays NaN */
    const double large = e.middle + (e.middle > 0 ? half : -half);
    const double small = e.product / (large != 0 ? large : 1); /* both are 0 where large is */
    const double least = 0x1p-32 * fabs(large);
    return (cgt_sphere_roots){.near = e.middle > 0 ? small : large,
                              .far = e.middle > 0 ? large : small,
                              .safe = (e.middle_error2 <= least * least) & (e.half2_error <= least * half) &
                                      (e.product_error <= 0x1p-32 * fabs(e.product))};
}

#endif
