/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ray and sphere in double precision on the float input, in one order of operations, unfused, with error bounds.
 *
 * With c the centre seen from the origin, the roots of d.d t^2 - 2 d.c t + (c.c - r^2) = 0, by its discriminant as
 * D = r^2 d.d - |c x d|^2 (Lagrange's identity), which does not cancel for a far or a huge sphere: near the silhouette
 * |c x d| is about r |d|, however far the sphere is. The root that would cancel comes from the other by their product
 * (c.c - r^2) / d.d, and no division is needed for it.
 *
 * Bounds, with e = 2^-53; products of two floats are exact:
 *   d.c      4 e |c| |d|: c 1 e, a product 1 e, two sums
 *   c x d    each of its products 2 e, their difference 1 e: as a vector 2 sqrt(2) e |c| |d| + e |c x d|
 *   D        of |c x d|^2 = r^2 d.d at the silhouette: (6 r |c| + 5 r^2 + 9 e |c|^2) e d.d; of r^2 d.d 3 e, of their
 *            difference 1 e: at most 9 e (r (|c| + r) + 16 e |c|^2) d.d, which decides hit or miss; beyond the
 *            silhouette the error grows with |c x d| and D falls faster. On any line 14 e (c.c + r^2) d.d
 *   c.c - r^2   6 e (c.c + r^2)
 * A root is safe where it errs by at most 2^-31 of itself. The root that is a sum, (d.c + h) / d.d with h^2 = D, takes
 * D's error over 2 h: that is at most 2^-32 of it where (c.c + r^2) d.d 14 e 2^32 <= (d.c + h) h, and then d.c is right
 * to far less, since d.c + h >= h. The other one has the error of the product in addition. An origin on a surface
 * leaves nothing of c.c - r^2 but its error: there the squares are split into halves of their bits (Dekker, 1971), and
 * what each sum loses is kept (Knuth), so that the product has far more bits than it needs, or is exactly 0.
 *
 * Most hits take the short way of cgt_sphere_double_near, with D as (d.c)^2 - d.d (c.c - r^2). That errs by at most
 * 18 e (c.c + r^2) d.d. Where the origin is so far outside that c.c - r^2 >= c.c / 8, a line that meets the sphere
 * has (d.c)^2 >= d.d (c.c + r^2) / 16, and D errs by at most 2^-44 (d.c)^2. Where D is also above 2^-24 (d.c)^2, h errs
 * by at most 2^-33 d.c, and the root by at most 2^-32 of itself. The point that is hit moves by the error of h, 2^-25 r
 * at most: for a small sphere h is above 2^-12 |c| |d|, below r |d|, and errs by 9 e (|c| |d|)^2 / h; for one that is
 * not small by less. Silhouettes, spheres around the origin or right before it, and far roots take the long way. No
 * term leaves the range of double: floats and their differences lie between 2^-149 and 2^129. */
#ifndef CGT_SPHERE_DOUBLE_H
#define CGT_SPHERE_DOUBLE_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "model/primitive.h"

#define CGT_DOUBLE_U 0x1p-53

/* Values whose relative error is at most this, and quotients of two of them, are rounded to float as they are: 2^-31 is
 * 2^-7 ulp at most, so that they are 0.51 ulp off. Values with more cancellation are computed in exact arithmetic. */
#define CGT_DOUBLE_SAFE 0x1p-32

/* The quadratic square t^2 - 2 middle t + product = 0 of a line and a sphere, with its discriminant, negative for a
 * miss; distance2 is c.c, size c.c + r^2. */
typedef struct cgt_sphere_terms {
    double square, middle, product, disc, distance2, size;
} cgt_sphere_terms;

/* All steps are written without branches, so that a loop over rays becomes vector code. */
static inline cgt_sphere_terms cgt_sphere_double_terms(const float org[3], const float dir[3], cgt_sphere q)
{
    const double cx = (double)q.x - (double)org[0], cy = (double)q.y - (double)org[1],
                 cz = (double)q.z - (double)org[2];
    const double dx = (double)dir[0], dy = (double)dir[1], dz = (double)dir[2], r = (double)q.r;
    const double dd = dx * dx + dy * dy + dz * dz, cc = cx * cx + cy * cy + cz * cz, rr = r * r;
    const double x = cy * dz - cz * dy, y = cz * dx - cx * dz, z = cx * dy - cy * dx;
    return (cgt_sphere_terms){.square = dd,
                              .middle = dx * cx + dy * cy + dz * cz,
                              .product = cc - rr,
                              .disc = rr * dd - (x * x + y * y + z * z),
                              .distance2 = cc,
                              .size = cc + rr};
}

/* Conditions of the short way: c.c - r^2 is at least this share of c.c, and D above this share of (d.c)^2. */
#define CGT_SPHERE_OUTSIDE 0x1p-3
#define CGT_SPHERE_INSIDE 0x1p-24

/* The near root by the short way, its discriminant by differences; false where it has to be the long one. */
static inline bool cgt_sphere_double_near(cgt_sphere_terms e, double *near)
{
    const double square = e.middle * e.middle, disc = square - e.square * e.product;
    *near = e.product / (e.middle + sqrt(disc));
    return e.product >= e.distance2 * CGT_SPHERE_OUTSIDE && e.middle > 0 && disc > square * CGT_SPHERE_INSIDE;
}

/* The bound of the error of the discriminant, tight. */
static inline double cgt_sphere_double_disc_error(const float org[3], const float dir[3], cgt_sphere q)
{
    double distance = 0, dd = 0;
    const float center[3] = {q.x, q.y, q.z};
    for (int a = 0; a < 3; a++) {
        distance += fabs((double)center[a] - (double)org[a]);
        dd += (double)dir[a] * (double)dir[a];
    }
    const double eps_c = 4 * CGT_DOUBLE_U * distance, r = q.r;
    return 9 * (CGT_DOUBLE_U * r * (distance + r) + eps_c * eps_c) * dd;
}

/* The discriminant, and what bounds its error where distances far exceed the radius. c is split into the upper half of
 * its bits, the lower half and what its rounding left. Products of halves and floats are exact, so that c x d errs by
 * 2 e of itself and, from the lower halves, by 2^-76 of the sums below; the discriminant by 10 e of its two terms and
 * by twice the latter times c x d. */
static inline double cgt_sphere_double_refine_disc(const float org[3], const float dir[3], cgt_sphere q, double *error)
{
    const float centre[3] = {q.x, q.y, q.z};
    double high[3], low[3], d[3], dd = 0, far = 0, length = 0, xx = 0, x_sum = 0;
    for (int a = 0; a < 3; a++) {
        const double to = (double)centre[a], from = (double)org[a], c = to - from, back = to - c;
        const double scaled = c * 0x1.0000002p27;
        high[a] = scaled - (scaled - c);
        low[a] = (c - high[a]) + ((to - (c + back)) + (back - from));
        d[a] = (double)dir[a];
        dd += d[a] * d[a];
        far += fabs(c);
        length += fabs(d[a]);
    }
    for (int a = 0; a < 3; a++) {
        const int i = (a + 1) % 3, k = (a + 2) % 3;
        const double x = (high[i] * d[k] - high[k] * d[i]) + (low[i] * d[k] - low[k] * d[i]);
        xx += x * x;
        x_sum += fabs(x);
    }
    const double edge = (double)q.r * (double)q.r * dd, lost = 0x1p-75 * far * length;
    *error = 10 * CGT_DOUBLE_U * (edge + xx) + lost * (2 * x_sum + lost);
    return edge - xx;
}

/* Both roots; NaN for a miss. */
typedef struct cgt_sphere_roots {
    double near, far;
} cgt_sphere_roots;

/* half: the root of the discriminant, NaN for a miss, and it stays NaN. */
static inline cgt_sphere_roots cgt_sphere_double_roots(cgt_sphere_terms e, double half)
{
    const double large = fabs(e.middle) + half;   /* of the sign of middle, which is put back below */
    const double divisor = large > 0 ? large : 1; /* both roots are 0 where large is */
    const double sum = large / e.square, other = e.product / divisor;
    return (cgt_sphere_roots){e.middle > 0 ? other : -sum, e.middle > 0 ? sum : -other};
}

/* The next three: 1 where the root that is a sum, c.c - r^2, or any root has lost more than it may, or is none, else 0;
 * as wide as a double, for vector code. */
static inline uint64_t cgt_sphere_double_unsafe_sum(cgt_sphere_terms e, double half)
{
    return e.size * e.square * (14 * CGT_DOUBLE_U * 0x1p32) <= (fabs(e.middle) + half) * half ? 0 : 1;
}

static inline uint64_t cgt_sphere_double_unsafe_product(cgt_sphere_terms e)
{
    return e.size * (8 * CGT_DOUBLE_U * 0x1p32) <= fabs(e.product) ? 0 : 1;
}

static inline uint64_t cgt_sphere_double_unsafe(cgt_sphere_terms e, double half)
{
    return cgt_sphere_double_unsafe_sum(e, half) | cgt_sphere_double_unsafe_product(e);
}

/* Computes c.c - r^2 to 2^-34 of itself or better. Returns whether it has: not where it is far too near to 0. Twelve
 * numbers, each right to 2^-53 of itself, are added up as they are, which loses 2^-49 of their sizes at most. */
static inline bool cgt_sphere_double_refine(const float org[3], cgt_sphere q, double *product)
{
    const float centre[3] = {q.x, q.y, q.z};
    double sum = -((double)q.r * (double)q.r), rest = 0, size = 0; /* the square of a float is exact */
    for (int a = 0; a < 3; a++) {
        /* the centre is at c + behind, exactly */
        const double to = (double)centre[a], from = (double)org[a], c = to - from, back = to - c;
        const double behind = (to - (c + back)) + (back - from), turn = (2 * c + behind) * behind;
        /* c^2 is square + lower, exactly; so is sum + square as next + missing */
        const double scaled = c * 0x1.0000002p27, high = scaled - (scaled - c), low = c - high, square = c * c;
        const double lower = ((high * high - square) + 2 * high * low) + low * low;
        const double next = sum + square, added = next - sum, missing = (sum - (next - added)) + (square - added);
        sum = next;
        rest += turn + lower + missing;
        size += fabs(turn) + fabs(lower) + fabs(missing);
    }
    *product = sum + rest;
    return size * 0x1p-49 <= fabs(*product) * 0x1p-34;
}

#endif
