/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Precision FAST: t and normals of the spheres that rays hit, in single precision, a vector at a time. Which sphere a ray
 * hits was decided exactly before. Every operation is IEEE's, unfused, in one order, and depends on nothing but the ray
 * and the sphere: any variant, structure and number of threads gives the same bits. Lanes that the bounds below do not
 * cover are left to resolve_spheres.h, by conditions that are the same bits everywhere, too.
 *
 * With c the centre seen from the origin, x = c x d, D = r^2 d.d - x.x and h = sqrt(D), the near root is
 * t = (c.c - r^2) / (d.c + h). Let u = 2^-24, and first |d| = 1, so that h is half the chord; h <= r < |c| <= 2^12 r.
 * The errors of
 *
 *   c        as a vector, u |c|
 *   d.c      by c u |c|, by three products and two sums 3 u |c|: 4 u |c|
 *   c.c-r^2  5 u c.c and u r^2, by their difference u c.c at most: 7 u c.c
 *   x        by c and by products 2 u of the sum of both products, by their difference u: as a vector 2.4 u |c| + u r
 *   D        of x.x 2 r times that and 3 u r^2, of r^2 d.d 5 u r^2, by their difference u r^2: 4.8 u r |c| + 11 u r^2,
 *            at most 16 u r |c|
 *   h        min(16 u r |c| / h, 4 sqrt(u r |c|)) + u r: a discriminant that rounding made negative counts as 0
 *
 * t errs by (7 u c.c + t (4 u |c| + the error of h)) / (d.c + h), and by 2 u t for sum and quotient. t <= d.c + h; and
 * c.c / (d.c + h) <= |c| r / h, since (d.c)^2 = c.c - r^2 + h^2. That is at most 32 u |c| r / h. At the silhouette h is
 * 0; but d.c >= 2^-5 |c| everywhere, since c.c - r^2 >= 2^-10 (c.c + r^2) is required. So t never errs by more than
 * 32 * 7 u |c| + 7 u |c| + 4 sqrt(u r |c|), and u |c| <= 2^-6 sqrt(u r |c|): by 8 sqrt(u r |c|). In all,
 *
 *   |d| t    is within min(2^-19 |c| r / h, 2^-9 sqrt(r |c|))
 *   normal   (t d - c) / r: takes the error of t over r, 3 u |c| / r by c, product and difference, 2 u by 1 / r and its
 *            product: within min(2^-18 |c| / h, 2^-8 sqrt(|c| / r)), as a vector
 *
 * d.c is so large that its sign is certain: the near root is ahead, where c.c - r^2 has the sign that is required. In
 * relation to t the error is at most 7 * 2^10 u + 2^5 (4 u + 4 sqrt(u)) + 2 u, less than 1/16: where 7/8 t is not below
 * t_min, the near root is in range, and it is the one that was hit. */
#ifndef CGT_FAST_SPHERES_H
#define CGT_FAST_SPHERES_H

#include "kernel/primitive/lane_vectors.h"

/* Where the bounds hold, apart from hits at or before t_min. The last four keep terms far from the ends of float. */
#define FAST_SPHERE_OUTSIDE 0x1p-10f /* c.c - r^2 over c.c + r^2, at least */
#define FAST_SPHERE_FAR 0x1p24f      /* c.c over r^2, at most */
#define FAST_SPHERE_AHEAD 0.875f
#define FAST_SPHERE_MIN_RADIUS 0x1p-30f
#define FAST_SPHERE_MAX_RADIUS 0x1p25f
#define FAST_SPHERE_MIN_DD 0x1p-40f
#define FAST_SPHERE_MAX_DD 0x1p40f

/* The terms that rays from one origin to a sphere share. */
typedef struct fast_sphere {
    vfloat c[3], rr, product, reciprocal;
    vmask covered;
} fast_sphere;

CGT_SPU_INLINE fast_sphere fast_sphere_prepare(const vfloat org[3], const vfloat sphere[4])
{
    const vfloat r = sphere[3];
    fast_sphere s = {.rr = spu_mul(r, r), .reciprocal = spux_div(spux_vfloat(1), r)};
    for (int a = 0; a < 3; a++)
        s.c[a] = spu_sub(sphere[a], org[a]);
    const vfloat cc = lane_dot_unfused(s.c, s.c);
    s.product = spu_sub(cc, s.rr);
    const vmask outside = spu_cmpgt(s.product, spu_mul(spu_add(cc, s.rr), spux_vfloat(FAST_SPHERE_OUTSIDE)));
    const vmask near = spu_cmpgt(spu_mul(s.rr, spux_vfloat(FAST_SPHERE_FAR)), cc);
    const vmask in_range = spu_and(spu_cmpgt(r, spux_vfloat(FAST_SPHERE_MIN_RADIUS)),
                                   spu_cmpgt(spux_vfloat(FAST_SPHERE_MAX_RADIUS), r));
    s.covered = spu_and(spu_and(outside, near), in_range);
    return s;
}

/* The near roots of rays that hit the spheres, no larger than t_max, and normals if they are asked for. Returns the
 * lanes that the bounds cover. */
CGT_SPU_INLINE vmask fast_sphere_resolve(const fast_sphere *s, const vfloat dir[3], vfloat t_min, vfloat t_max,
                                         bool normal, vfloat *t, vfloat n[3])
{
    vfloat x[3];
    lane_cross_unfused(s->c, dir, x);
    const vfloat dd = lane_dot_unfused(dir, dir), middle = lane_dot_unfused(s->c, dir);
    const vfloat disc = spu_sub(spu_mul(s->rr, dd), lane_dot_unfused(x, x));
    const vfloat half = spux_sqrt(spux_max(disc, spux_vfloat(0)));
    const vfloat near = spux_div(s->product, spu_add(middle, half));
    const vmask ahead = spu_and(spu_cmpgt(middle, spux_vfloat(0)),
                                spux_cmpge(spu_mul(near, spux_vfloat(FAST_SPHERE_AHEAD)), t_min));
    const vmask in_range =
        spu_and(spu_cmpgt(dd, spux_vfloat(FAST_SPHERE_MIN_DD)), spu_cmpgt(spux_vfloat(FAST_SPHERE_MAX_DD), dd));
    *t = spux_select(near, t_max, spu_cmpgt(near, t_max));
    for (int a = 0; normal && a < 3; a++)
        n[a] = spu_mul(spu_sub(spu_mul(*t, dir[a]), s->c[a]), s->reciprocal);
    return spu_and(spu_and(s->covered, ahead), in_range);
}

#endif
