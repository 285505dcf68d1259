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
 * Bounds, with e = 2^-53 and all relative to d.d; the steps are those of kernel/sphere_filter.h, products of two floats
 * being exact here:
 *   s        13 e |c| |d|
 *   h        9 e r (|c| + r) + 640 e^2 |c|^2, which decides hit or miss; at most 14 e (c.c + r^2). It holds up to
 *            the silhouette; beyond, where h is negative, the error grows with |l| and h faster
 *   product  8 e (c.c + r^2)
 * A root is safe where it errs by at most 2^-31 of itself. The root that is a sum, s + half, takes h's error over
 * 2 half: that is at most 2^-32 of it where (c.c + r^2) 14 e 2^32 <= (s + half) half, and then s is right to far less,
 * since s + half >= half. The other one takes the product's besides.
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
 * roots: negative for a miss; size is (c.c + r^2) / d.d. */
typedef struct cgt_sphere_terms {
    double middle, product, half2, size;
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
    return (cgt_sphere_terms){.middle = s,
                              .product = (cc - rr) * rdd,
                              .half2 = (rr - (lx * lx + ly * ly + lz * lz)) * rdd,
                              .size = (cc + rr) * rdd};
}

/* The bound of the error of half2, tight. */
static inline double cgt_sphere_double_half2_error(const float org[3], const float dir[3], cgt_sphere q)
{
    double distance = 0, dd = 0;
    const float center[3] = {q.x, q.y, q.z};
    for (int a = 0; a < 3; a++) {
        distance += fabs((double)center[a] - (double)org[a]);
        dd += (double)dir[a] * (double)dir[a];
    }
    const double wide = 26 * CGT_DOUBLE_U * distance, r = q.r;
    return (9 * CGT_DOUBLE_U * r * (distance + r) + wide * wide) / dd;
}

/* Both roots; NaN for a miss. */
typedef struct cgt_sphere_roots {
    double near, far;
} cgt_sphere_roots;

static inline cgt_sphere_roots cgt_sphere_double_roots(double middle, double product, double half2)
{
    const double half = sqrt(half2);              /* NaN for a miss, and it stays NaN */
    const double large = fabs(middle) + half;     /* of the sign of middle, which is put back below */
    const double divisor = large > 0 ? large : 1; /* both roots are 0 where large is */
    const double near_root = middle > 0 ? product / divisor : -large;
    const double far_root = middle > 0 ? large : -(product / divisor);
    return (cgt_sphere_roots){near_root, far_root};
}

/* 1 where a root has lost more than it may, else 0; as wide as a double, for vector code. The larger of |s| half and
 * half^2 stands for their sum, and is squared to spare a root. */
static inline uint64_t cgt_sphere_double_unsafe(cgt_sphere_terms e)
{
    const double least = e.size * (14 * CGT_DOUBLE_U * 0x1p32);
    const uint64_t alone = least <= e.half2 ? 0 : 1;
    const uint64_t beside = least * least <= e.middle * e.middle * e.half2 ? 0 : 1;
    const uint64_t other = e.size * (8 * CGT_DOUBLE_U * 0x1p32) <= fabs(e.product) ? 0 : 1;
    return (alone & beside) | other;
}

#endif
