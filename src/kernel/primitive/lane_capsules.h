/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tests one ray against one capsule in each lane, in single precision with derived bounds; see lane_tests.h.
 *
 * A capsule is the union of the spheres around the points p + s n of its axis, n = q - p, 0 <= s <= 1, and the ray
 * enters it at the first of their near roots. Along s these are convex; with l and g what is perpendicular to the ray
 * of c = p - org and n, and R^2 = r^2 - l.l + (l.g)^2 / g.g, the least is at
 *   s = -l.g / g.g - (d.n / |d|) R / (|g| |n|),   brought into 0..1
 * So the ray is tested against that sphere. What it hits and the end of its interval hold for the capsule whatever s
 * is. Two planes across a vector are what has to be proven:
 *
 * Miss. With e the computed vector from the line to the centre, all points of the axis are at least as far from the
 * line as they are along e: e.e - v over |e|, v = max(s e.g, (s - 1) e.g), of which nothing is left where s is right.
 * Errors, u = 2^-24, |x| the 1-norm, A = |c| + |n| + |c + s n|, by which the centre, which is rounded, errs by u A at
 * most, so that the bounds of sphere_filter.h hold with A for its distance:
 *   e        26 u A
 *   e.g      20 u |e| |n|: g is off by 16 u |n| as s there by 13 u
 * The ray misses if (e.e - v) / |e| exceeds R = r + 46 u A. It does if e.e - 2 v > R^2, since 2 |e| R <= e.e + R^2; 8 u
 * of either side are for its rounding.
 *
 * Begin. Let N be the vector from where the ray enters the sphere to its centre, of length r, and y = N.n. The capsule
 * lies behind the plane across N that touches it, which the ray passes earlier than the sphere by at most
 *   v / (N.d),  v = max(s y, (s - 1) y),  N.d = |d| H, H half the chord
 * The near roots have a curvature of g.g / (r |d|) at least, so it is also at most
 *   y^2 r / (2 g.g H) / (|d| H)
 * which is of second order in the error of s. Where h = r^2 + eps - l.l is above 17 eps, N is off by 26 u A, by
 * 1.04 eps / sqrt(h) and 14 u r, and y by
 *   |n| (26 u (A + r) + 1.04 eps / sqrt(h))
 * of which v takes the worst: at an end that is met from outside, where s is 0 and y above its error, nothing is left.
 * H is at least 0.939 sqrt(h), and g.g, as computed, half of itself where it is above (2^8 u |n|)^2. Reciprocals and
 * roots are estimates within 2^-11, on the safe side, where they bound something.
 *
 * End. The exact h lies in [h - 2 eps, h], so the chord's half is shorter than sqrt(h) by at most
 *   2 eps / (sqrt(h) + sqrt(h - 2 eps)) <= 2 eps / (1.939 sqrt(h)) = 1.032 eps / sqrt(h)
 * for which 1.067 is taken, and t_error at both ends: lane_chord_width is what that is at h = 17 eps.
 *
 * Before the sphere around p + s n begins no ray meets it, s n and r long as it is: that is where the interval of
 * undecided lanes begins, and likewise the last one ends. Underflow in products is below 2^-120. Lanes of which e.e
 * is not below 2^126 never miss; other overflow makes comparisons false. Rays from inside, which leave at the far
 * surface, are undecided. */
#ifndef CGT_LANE_CAPSULES_H
#define CGT_LANE_CAPSULES_H

#include "kernel/primitive/lane_tests.h"
#include "kernel/primitive/lane_vectors.h"

/* 0 for NaN, too. */
CGT_SPU_INLINE vfloat lane_clamp_share(vfloat s)
{
    const vfloat zero = spux_vfloat(0), one = spux_vfloat(1), above = spux_select(zero, s, spu_cmpgt(s, zero));
    return spux_select(one, above, spu_cmpgt(one, above));
}

/* The most of max(s y, (s - 1) y) for y off by at most `error`. Not below 0. */
CGT_SPU_INLINE vfloat lane_slope_excess(vfloat s, vfloat y, vfloat error)
{
    return spux_max(spu_mul(s, spu_add(y, error)), spu_mul(spu_sub(spux_vfloat(1), s), spu_sub(error, y)));
}

/* 1 / sqrt(x) to single precision, roughly. */
CGT_SPU_INLINE vfloat lane_near_rsqrt(vfloat x)
{
    const vfloat y = spux_rsqrte(x), half = spux_vfloat(0.5f);
    return spu_madd(spu_mul(y, half), spu_nmsub(spu_mul(x, y), y, spux_vfloat(1)), y);
}

/* What depends on the axis alone. */
typedef struct lane_axes {
    vfloat c[3], n[3], g[3]; /* g: n without its part along the ray */
    vfloat gg, length;       /* length: of n, the 1-norm */
    vfloat start, along;     /* t next to p; from there to next to q */
} lane_axes;

/* Where the sphere is that the ray meets first. Any value is right. */
CGT_SPU_INLINE vfloat lane_first_sphere(const lane_rays *r, const lane_axes *x, vfloat radius)
{
    vfloat l[3];
    for (int a = 0; a < 3; a++)
        l[a] = spu_nmsub(x->start, r->dir[a], x->c[a]);
    const vfloat nn = lane_dot(x->n, x->n), lg = lane_dot(l, x->g), scale = spu_mul(nn, r->rdd);
    const vfloat gg = spux_max(x->gg, spu_mul(nn, spux_vfloat(0x1p-40f))); /* along the ray: at an end */
    const vfloat unit = lane_near_rsqrt(spu_mul(gg, scale));
    const vfloat nearest = spu_mul(spu_mul(spu_mul(lg, scale), unit), unit);               /* negative */
    const vfloat rest = spu_nmsub(nearest, lg, spu_nmsub(radius, radius, lane_dot(l, l))); /* -R^2 */
    const vfloat zero = spux_vfloat(0), square = spux_max(spu_sub(zero, rest), spux_vfloat(0x1p-100f));
    const vfloat lean = spu_mul(spu_mul(x->along, unit), spu_mul(square, lane_near_rsqrt(square)));
    return lane_clamp_share(spu_sub(spu_sub(zero, nearest), lean));
}

CGT_SPU_INLINE void lane_axes_init(const lane_rays *r, const vfloat p[3], const vfloat q[3], lane_axes *x)
{
    for (int a = 0; a < 3; a++) {
        x->c[a] = spu_sub(p[a], r->org[a]);
        x->n[a] = spu_sub(q[a], p[a]);
    }
    x->start = spu_mul(lane_dot(r->dir, x->c), r->rdd);
    x->along = spu_mul(lane_dot(r->dir, x->n), r->rdd);
    for (int a = 0; a < 3; a++)
        x->g[a] = spu_nmsub(x->along, r->dir[a], x->n[a]);
    x->gg = lane_dot(x->g, x->g);
    x->length = lane_sum(x->n);
}

/* How much earlier than at the sphere the ray may enter. reciprocal: 1.04 to 1.07 over the root of h, which is above
 * 17 eps. half: of the chord, as t. */
CGT_SPU_INLINE vfloat lane_capsule_slack(const lane_rays *r, const lane_axes *x, const lane_feet *foot, vfloat radius,
                                         vfloat s, vfloat reciprocal, vfloat half)
{
    vfloat normal[3];
    for (int a = 0; a < 3; a++)
        normal[a] = spu_madd(half, r->dir[a], foot->l[a]);
    const vfloat off =
        spu_madd(radius, spux_vfloat(26 * FILTER_ROUNDOFF), spu_madd(foot->eps, reciprocal, foot->eps_c));
    const vfloat y = lane_dot(normal, x->n), y_error = spu_madd(x->length, off, spux_vfloat(0x1p-120f));
    const vfloat first = lane_slope_excess(s, y, y_error);
    const vfloat wide = spux_max(spu_add(spux_abs(y), y_error), spux_vfloat(0x1p-60f));
    const vfloat share = spu_mul(x->length, spux_vfloat(256 * FILTER_ROUNDOFF));
    const vfloat twice_gg = spux_max(spu_nmsub(share, share, x->gg), spux_vfloat(0x1p-126f)); /* of the half */
    const vfloat unit = spux_rsqrte(twice_gg), more = spux_vfloat(1 + 0x1p-9f);
    const vfloat share_of_y =
        spu_mul(spu_mul(spu_mul(wide, unit), unit), spu_mul(spux_max(radius, spux_vfloat(0x1p-6f)), more));
    const vfloat second = spu_mul(spu_mul(wide, reciprocal), share_of_y); /* in an order that does not overflow */
    return spu_mul(spu_mul(spux_min(second, first), reciprocal), spu_mul(r->rlength, spux_vfloat(1 + 0x1p-18f)));
}

/* Returns false if all certainly miss. */
CGT_SPU_INLINE bool lane_test_capsule_from(const lane_rays *r, const vfloat p[3], const vfloat q[3], vfloat radius,
                                           bool moved, lane_hits *hits)
{
    lane_axes x;
    lane_feet foot;
    vfloat c[3];
    lane_axes_init(r, p, q, &x);
    const vfloat s = lane_first_sphere(r, &x, radius), zero = spux_vfloat(0);
    for (int a = 0; a < 3; a++)
        c[a] = spu_madd(s, x.n[a], x.c[a]);
    const vfloat distance = spu_add(lane_distance(r, c, moved), spu_add(lane_sum(x.c), x.length));
    lane_find_feet(r, c, radius, distance, &foot);
    /* certain misses: of the line, and before the range */
    const vfloat reach = spu_madd(distance, spux_vfloat(46 * FILTER_ROUNDOFF), radius),
                 more = spux_vfloat(1 + 8 * FILTER_ROUNDOFF);
    const vfloat excess = lane_slope_excess(s, lane_dot(foot.l, x.g), zero);
    const vfloat bound =
        spu_mul(spu_madd(reach, reach, spu_madd(excess, spux_vfloat(2), spux_vfloat(0x1p-120f))), more);
    const vmask missed = spu_and(spu_cmpgt(spu_mul(foot.square, spux_vfloat(1 - 8 * FILTER_ROUNDOFF)), bound),
                                 spu_cmpgt(spux_vfloat(0x1p126f), foot.square));
    if (spux_all(missed))
        return false;
    const vfloat aside = spu_madd(radius, r->rlength, foot.t_error);
    const vfloat begin = spu_sub(spu_add(x.start, spux_min(x.along, zero)), aside);
    const vfloat end = spu_add(spu_add(x.start, spux_max(x.along, zero)), aside);
    const vmask behind = spu_cmpgt(r->t_min, end);
    /* certain hits */
    const vfloat h = spu_sub(spu_madd(radius, radius, foot.eps), foot.square);
    const vmask inside = spu_cmpgt(h, spu_mul(foot.eps, spux_vfloat(17)));
    const vfloat half = spux_sqrt(spu_mul(spux_select(zero, h, inside), r->rdd));
    const vfloat low = spu_sub(spu_sub(foot.mid, half), foot.t_error);
    const vfloat reciprocal = spu_mul(spux_rsqrte(spux_select(spux_vfloat(1), h, inside)), spux_vfloat(1.067f));
    const vfloat slack = lane_capsule_slack(r, &x, &foot, radius, s, reciprocal, half);
    const vfloat chord_error = spu_mul(spu_mul(foot.eps, reciprocal), r->rlength);
    hits->high = spu_madd(foot.t_error, spux_vfloat(2), spu_add(low, chord_error));
    hits->low = spux_select(begin, spux_max(spu_sub(low, slack), begin), inside);
    /* where half overflows, low is -infinity */
    hits->certain_hit = spu_and(spu_and(inside, spu_cmpgt(low, r->t_min)), spu_cmpgt(hits->low, r->t_min));
    hits->undecided = spux_not(spu_or(spu_or(missed, behind), hits->certain_hit));
    return true;
}

CGT_SPU_INLINE bool lane_test_capsule(const lane_rays *r, const vfloat p[3], const vfloat q[3], vfloat radius,
                                      lane_hits *hits)
{
    return lane_test_capsule_from(r, p, q, radius, false, hits);
}

/* Where lines leave: what enters is likewise tested against the way back. t_min plays no part. */
CGT_SPU_INLINE bool lane_test_capsule_exit(const lane_rays *r, const vfloat p[3], const vfloat q[3], vfloat radius,
                                           bool moved, lane_hits *hits)
{
    const vfloat zero = spux_vfloat(0);
    lane_rays back = *r;
    lane_hits h;
    back.t_min = spux_vfloat(-INFINITY);
    for (int a = 0; a < 3; a++)
        back.dir[a] = spu_sub(zero, r->dir[a]);
    if (!lane_test_capsule_from(&back, p, q, radius, moved, &h))
        return false;
    *hits = h;
    hits->low = spu_sub(zero, h.high);
    hits->high = spu_sub(zero, h.low);
    return true;
}

/* The lanes whose lines certainly leave their capsules, of those that `within` has them enter for certain, and the
 * interval of where. */
CGT_SPU_INLINE vmask lane_leave_capsule(const lane_rays *r, const vfloat p[3], const vfloat q[3], vfloat radius,
                                        vmask within, vfloat *low, vfloat *high)
{
    lane_hits h;
    if (spux_none(within) || !lane_test_capsule_exit(r, p, q, radius, true, &h))
        return spux_mask_none();
    *low = h.low;
    *high = h.high;
    return spu_and(within, h.certain_hit);
}

/* ---- The line alone, in fewer operations ----
 * With m = d x n and c = p - org a line misses the capsule if |m.c| > r |m|. In normalised space, with |d_a| <= 2, the
 * largest |n_a| from 1 to 2, which a power of 2 brings it to, and A at least |c| and the error of the origin: n is off
 * by u |n_a|, and m by three times that in its factors, 6 u |n| in each component, none of which is above 2 |n|. Then
 * m.c is within
 *   2 |n| A (3 u + u + 3 u)
 * by m, by c and by the sum, and |m| within 3 u sqrt(3) 2 |n| < 11 u |n|. So it misses where
 *   |m.c| > r |m| + 20 u |n| (A + r) + 2^-116,
 * which has more than 4 u of either for its own roundings and for products of m that underflow, however far away the
 * capsule is, and the last term for those of m.c. Both sides are squared: where m.m underflows, r |m| is far below
 * u |n| r, and where r^2 does, it is below 2^-60. */

/* What that takes of a capsule: n, 20 u |n| and r^2, rounded up. */
CGT_SPU_INLINE void lane_strip_init(const vfloat p[3], const vfloat q[3], vfloat radius, vfloat n[3], vfloat *error,
                                    vfloat *square)
{
    for (int a = 0; a < 3; a++)
        n[a] = spu_sub(q[a], p[a]);
    const vfloat most = spux_max(spux_max(spux_abs(n[0]), spux_abs(n[1])), spux_abs(n[2]));
    const vfloat inverse = lane_inverse_power(lane_power(most));
    for (int a = 0; a < 3; a++)
        n[a] = spu_mul(n[a], inverse);
    *error = spu_mul(lane_sum(n), spux_vfloat(20 * FILTER_ROUNDOFF));
    *square = spu_mul(spu_mul(radius, radius), spux_vfloat(1 + 0x1p-20f));
}

/* Returns the lanes whose lines may meet their capsules; size: A + r. */
CGT_SPU_INLINE vmask lane_meets_strip(const vfloat dir[3], const vfloat c[3], const vfloat n[3], vfloat size,
                                      vfloat error, vfloat square)
{
    vfloat m[3];
    lane_cross(dir, n, m);
    const vfloat beyond = spu_sub(spux_abs(lane_dot(m, c)), spu_madd(size, error, spux_vfloat(0x1p-116f)));
    const vfloat within = spu_madd(lane_dot(m, m), square, spux_vfloat(0x1p-118f));
    return spux_not(spu_and(spu_cmpgt(beyond, spux_vfloat(0)), spu_cmpgt(spu_mul(beyond, beyond), within)));
}

#endif
