/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays against an axis-aligned box by slabs (Kay, Kajiya, "Ray Tracing Complex Scenes", 1986), conservative: a
 * ray that misses by this test misses in exact arithmetic.
 *
 * No step produces a NaN from finite input. A component of the direction that is zero, of either sign, has no
 * reciprocal: there the origin is inside the slab, which then bounds nothing, or outside, and the ray misses.
 * Components below 2^-100 bound nothing, either. The interval of a slab is widened by 2^-20 of its ends, more than a
 * difference, a reciprocal within 2^-21 and a product lose together (Ize, "Robust BVH Ray Traversal", JCGT 2013, widens
 * by 2 ulp of an exact division), and by 2^-126 where products underflow. */
#ifndef CGT_RAY_BOX_H
#define CGT_RAY_BOX_H

#include "kernel/packet/packet.h"

#define RAY_BOX_REL_ERROR 0x1p-20f

/* Narrows [near, far] to the slab of axis a; outside: rays that run parallel to the slab, outside it. */
CGT_SPU_INLINE void ray_box_slab(const packet *p, uint32_t i, int a, float low, float high, vfloat *near, vfloat *far,
                                 vmask *outside)
{
    const vfloat o = spux_load(p->org[a] + i), d = spux_load(p->dir[a] + i), zero = spux_vfloat(0);
    const vfloat to_low = spu_sub(spux_vfloat(low), o), to_high = spu_sub(spux_vfloat(high), o);
    const vmask flat = spu_cmpgt(spux_vfloat(0x1p-100f), spux_abs(d));
    const vfloat r = spux_div(spux_vfloat(1), spux_select(d, spux_vfloat(1), flat));
    const vfloat t0 = spu_mul(to_low, r), t1 = spu_mul(to_high, r), rel_error = spux_vfloat(RAY_BOX_REL_ERROR);
    const vfloat first = spux_min(t0, t1), last = spux_max(t0, t1), tiny = spux_vfloat(0x1p-126f);
    const vfloat enter = spu_sub(first, spu_madd(spux_abs(first), rel_error, tiny));
    const vfloat leave = spu_add(last, spu_madd(spux_abs(last), rel_error, tiny));
    *near = spux_max(*near, spux_select(enter, spux_vfloat(-INFINITY), flat));
    *far = spux_min(*far, spux_select(leave, spux_vfloat(INFINITY), flat));
    *outside = spu_or(*outside, spu_and(spu_cmpeq(d, zero), spu_or(spu_cmpgt(to_low, zero), spu_cmpgt(zero, to_high))));
}

/* Rays i to i + CGT_LANES - 1 that surely miss the closed box within their range. Coordinates are at most 2^55. */
CGT_SPU_INLINE vmask ray_box_missed(const packet *p, uint32_t i, const float low[3], const float high[3])
{
    vfloat near = spux_load(p->t_min + i), far = spux_load(p->t_max + i);
    vmask outside = spux_mask_none();
    for (int a = 0; a < 3; a++)
        ray_box_slab(p, i, a, low[a], high[a], &near, &far, &outside);
    /* what overflowed to infinity and was widened is not a number, and does not miss */
    return spu_or(outside, spu_cmpgt(near, far));
}

/* The rays' intervals in the box of a tree's root, for a traversal whose t is rounded by up to t_error of itself before
 * it is compared with the range. Rays that take no part get an empty one. */
CGT_SPU_INLINE void ray_box_enter(const packet *p, uint32_t i, const float low[3], const float high[3], float t_error,
                                  vfloat *near, vfloat *far)
{
    vmask outside = spux_mask_none();
    const vfloat t_min = spux_load(p->t_min + i), t_max = spux_load(p->t_max + i), error = spux_vfloat(t_error);
    *near = spu_sub(t_min, spu_mul(spux_abs(t_min), error));
    *far = spu_add(t_max, spu_mul(spux_abs(t_max), error));
    for (int a = 0; a < 3; a++)
        ray_box_slab(p, i, a, low[a], high[a], near, far, &outside);
    outside = spu_or(outside, spu_cmpeq(spux_load(p->high + i), spux_vfloat(-INFINITY)));
    *far = spux_select(*far, spux_vfloat(-INFINITY), outside);
    *near = spux_select(*near, spux_vfloat(INFINITY), outside);
}

#endif
