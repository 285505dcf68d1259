/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Precision FAST: t and normals of the spheres that rays hit, in single precision, a vector at a time. Which sphere a
 * ray hits was decided exactly before. Every operation is IEEE's, unfused, in one order, and depends on nothing but the
 * ray and the sphere: any variant, structure and number of threads gives the same bits. Lanes that the bounds below do
 * not cover are left to resolve_spheres.h, by conditions that give the same bits everywhere.
 *
 * The point of the line that is nearest to the centre comes first, after Haines, Guenther and Akenine-Moeller
 * ("Precision Improvements for Ray/Sphere Intersection", 2019): with c the centre seen from the origin, s = c.d / d.d,
 * l = c - s d and h = sqrt((r^2 - l.l) / d.d), the near root is t = s - h, and the normal -(l + h d) / r.
 *
 * Let u = 2^-24, and |d| = 1, so that h is half the chord; h <= r < |c| <= 2^12 r. The errors of
 *
 *   c        as a vector, u |c|
 *   c.d      by c u |c|, by three products and two sums 3 u |c|: 4 u |c|
 *   1/d.d    4 u
 *   s        4 u |c| + 5 u |s|: 9 u |c|
 *   l        by c u |c|, by the products u |s|, by the differences u |l|; and 9 u |c| by s, along d alone
 *   l.l      l is perpendicular to d: what errs along d counts by its square, less than u r |c|. So 2 |l| (2 u |c| + u
 *   |l|)
 *            + u r |c|, and 3 u r^2 by products and sums: 5 u r |c| + 5 u r^2
 *   h^2      that, 1 u r^2 each by r^2 and the difference, 5 u r^2 by 1/d.d: 5 u r |c| + 12 u r^2 <= 17 u r |c|
 *   h        min(17 u r |c| / h, 4.2 sqrt(u r |c|)) + u r: what rounding made negative counts as 0
 *
 * t errs by 9 u |c| + that of h + u |c|, and u |c| <= 2^-6 sqrt(u r |c|); the normal by 13 u |c| + that of h + 2 u r,
 * over r, and 2 u. So
 *
 *   |d| t    is within min(2^-19 |c| r / h, 2^-9 sqrt(r |c|))
 *   normal   is within min(2^-18 |c| / h, 2^-9 sqrt(|c| / r)), as a vector
 *
 * Since c.c - r^2 >= 2^-6 (c.c + r^2) is required, the roots have one sign, and t is not below 2^-7 |c|, nor below
 * 2^-4 |c| where h is below |c| / 16: its relative error is less than 1/16 either way. Where 7/8 t is not below t_min,
 * nor below 0, the near root is in range, and is the one that was hit. */
#ifndef CGT_FAST_SPHERES_H
#define CGT_FAST_SPHERES_H

#include <math.h>

#include "kernel/primitive/lane_vectors.h"

/* Where the bounds hold. The last four keep all terms far from the ends of float. */
#define FAST_SPHERE_OUTSIDE 0x1p-6f /* c.c - r^2 over c.c + r^2, at least */
#define FAST_SPHERE_FAR 0x1p24f     /* c.c over r^2, at most */
#define FAST_SPHERE_AHEAD 0.875f
#define FAST_SPHERE_MIN_RADIUS 0x1p-30f
#define FAST_SPHERE_MAX_RADIUS 0x1p25f
#define FAST_MIN_DD 0x1p-40f
#define FAST_MAX_DD 0x1p40f

/* The terms that rays from one origin to a sphere share. */
typedef struct fast_sphere {
    vfloat c[3], rr, scale; /* scale: -1 / r. rr: r^2, or NaN if the bounds do not hold; then so is t */
} fast_sphere;

/* The same sphere in every lane. */
typedef struct fast_same_sphere {
    float c[3], rr, scale;
} fast_same_sphere;

CGT_SPU_INLINE fast_sphere fast_sphere_prepare(const vfloat org[3], const vfloat sphere[4])
{
    const vfloat r = sphere[3], rr = spu_mul(r, r);
    fast_sphere s;
    for (int a = 0; a < 3; a++)
        s.c[a] = spu_sub(sphere[a], org[a]);
    s.scale = spux_div(spux_vfloat(-1), r);
    const vfloat cc = lane_dot_unfused(s.c, s.c);
    const vmask outside = spu_cmpgt(spu_sub(cc, rr), spu_mul(spu_add(cc, rr), spux_vfloat(FAST_SPHERE_OUTSIDE)));
    const vmask near = spu_cmpgt(spu_mul(rr, spux_vfloat(FAST_SPHERE_FAR)), cc);
    const vmask in_range =
        spu_and(spu_cmpgt(r, spux_vfloat(FAST_SPHERE_MIN_RADIUS)), spu_cmpgt(spux_vfloat(FAST_SPHERE_MAX_RADIUS), r));
    s.rr = spux_select(spux_vfloat(NAN), rr, spu_and(spu_and(outside, near), in_range));
    return s;
}

CGT_SPU_INLINE fast_same_sphere fast_sphere_first(const fast_sphere *s)
{
    return (fast_same_sphere){{s->c[0][0], s->c[1][0], s->c[2][0]}, s->rr[0], s->scale[0]};
}

CGT_SPU_INLINE fast_sphere fast_sphere_of_same(const fast_same_sphere *s)
{
    fast_sphere q;
    for (int a = 0; a < 3; a++)
        q.c[a] = spux_vfloat(s->c[a]);
    q.rr = spux_vfloat(s->rr);
    q.scale = spux_vfloat(s->scale);
    return q;
}

/* 1 / d.d; NaN if the bounds do not hold. */
CGT_SPU_INLINE vfloat fast_inverse_square(const vfloat dir[3])
{
    const vfloat dd = lane_dot_unfused(dir, dir);
    const vmask in_range = spu_and(spu_cmpgt(dd, spux_vfloat(FAST_MIN_DD)), spu_cmpgt(spux_vfloat(FAST_MAX_DD), dd));
    return spux_select(spux_vfloat(NAN), spux_div(spux_vfloat(1), dd), in_range);
}

/* The near roots of rays that hit the spheres, no larger than t_max, and normals if they are asked for. inverse: of
 * fast_inverse_square. Returns the lanes that the bounds cover. */
CGT_SPU_INLINE vmask fast_sphere_resolve(const fast_sphere *q, const vfloat dir[3], vfloat inverse, vfloat t_min,
                                         vfloat t_max, bool normal, vfloat *t, vfloat n[3])
{
    const vfloat zero = spux_vfloat(0);
    const vfloat s = spu_mul(lane_dot_unfused(q->c, dir), inverse);
    vfloat l[3];
    for (int a = 0; a < 3; a++)
        l[a] = spu_sub(q->c[a], spu_mul(s, dir[a]));
    const vfloat square = spu_mul(spu_sub(q->rr, lane_dot_unfused(l, l)), inverse);
    const vfloat h = spux_sqrt(spux_select(square, zero, spu_cmpgt(zero, square)));
    const vfloat near = spu_sub(s, h);
    for (int a = 0; normal && a < 3; a++)
        n[a] = spu_mul(spu_add(l[a], spu_mul(h, dir[a])), q->scale);
    *t = spux_select(near, t_max, spu_cmpgt(near, t_max));
    return spux_cmpge(spu_mul(near, spux_vfloat(FAST_SPHERE_AHEAD)), spux_max(t_min, zero));
}

#endif
