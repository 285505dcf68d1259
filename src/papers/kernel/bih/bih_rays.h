/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays against the planes of a bounding interval hierarchy, conservative: a child is culled for a ray only where the
 * ray certainly does not pass it at a t that still counts.
 *
 * With r = 1 / dir, within 2^-21, the t of a plane p is p r - org r, whose products and sums lose at most four times w
 * of (|p| + |org|) |r|, w = 2^-24, or 2^-23 on an SPU, and 2^-120 by underflow of products. So it is off by less than
 *   (2^-21 + 4 w) (|p| + |org|) |r| <= 2^-20 (|p| + |org|) |r|
 * Planes lie outside of what they bound by CGT_BIH_MARGIN = 2^-19 of their size (model/bih.h), of which the rounding of
 * boxes and planes takes 2^-23: that covers |p|; and by CGT_BIH_LEAST_MARGIN = 2^-100, more than any p or org that
 * underflows, as below 2^-126 on an SPU. The rest, 16 w of |org| |r|, is one number for a ray and an axis:
 * added to -org r for planes by which a ray leaves, taken off for those by which it enters. 16 w is 2^-20 with 4 w =
 * 2^-22, and 2^-19 with 4 w = 2^-21, so it is more than this part's share in either case. A test takes both
 * margins away until hits are lost.
 *
 * A component of the direction that is 0 leaves a ray where its origin is: it passes those children that hold it. Below
 * 2^-70, where reciprocals leave the range, it counts as in all. */
#ifndef CGT_BIH_RAYS_H
#define CGT_BIH_RAYS_H

#include "papers/kernel/kd/tree_rays.h"

#define BIH_ORG_ERROR (16 * SPUX_ROUNDOFF * BIH_ERROR_SCALE)

/* ---- a vector of rays ---- */

CGT_SPU_INLINE void bih_rays_init(const packet *p, uint32_t i, tree_rays *r)
{
    tree_rays_init(p, i, r);
    for (int a = 0; a < 3; a++) {
        const vfloat t = spu_mul(r->org[a], r->rdir[a]);
        tree_rays_widen(r, a, t, spu_madd(spux_abs(t), spux_vfloat(BIH_ORG_ERROR), spux_vfloat(0x1p-120f)));
    }
}

#define BIH_RANGE_ERROR 0x1p-19f /* of t before it is compared with a ray's range */

/* An interval [near, far] of each ray. */
typedef struct bih_part {
    vfloat near, far;
} bih_part;

/* Where the rays of a mixed axis are below a plane (side 0), or above it (side 1). */
CGT_SPU_INLINE bih_part bih_narrow_mixed(const tree_rays *r, uint32_t axis, float plane, uint32_t side, bih_part whole)
{
    const vfloat p = spux_vfloat(plane), zero = spux_vfloat(0), delta = spu_sub(p, r->org[axis]);
    const vfloat enter = spux_max(spu_madd(p, r->rdir[axis], r->first[axis]), whole.near);
    const vfloat leave = spux_min(spu_madd(p, r->rdir[axis], r->last[axis]), whole.far);
    /* most rays reach the lower side first, or the upper one where the axis is reversed: they leave the first side by
     * the plane, and enter the second one */
    const bool most_leave = side == (r->reverse >> axis & 1);
    const vmask leaves = most_leave ? spux_not(r->opposite[axis]) : r->opposite[axis];
    const vmask beyond = spu_and(r->zero[axis], side ? spu_cmpgt(delta, zero) : spu_cmpgt(zero, delta));
    bih_part q;
    q.near = spux_select(spux_select(enter, whole.near, leaves), whole.near, r->flat[axis]);
    q.far = spux_select(spux_select(whole.far, leave, leaves), whole.far, r->flat[axis]);
    q.far = spux_select(q.far, spux_vfloat(-INFINITY), beyond);
    return q;
}

/* The parts of the child that most rays reach first, and of the other one. */
CGT_SPU_INLINE void bih_split(const tree_rays *r, const cgt_bih_node *n, bih_part whole, bih_part part[2])
{
    const uint32_t axis = cgt_bih_axis(n), first = r->reverse >> axis & 1;
    const float leave = cgt_bih_plane(n, first), enter = cgt_bih_plane(n, !first);
    if (r->mixed >> axis & 1) {
        part[0] = bih_narrow_mixed(r, axis, leave, first, whole);
        part[1] = bih_narrow_mixed(r, axis, enter, !first, whole);
        return;
    }
    part[0].near = whole.near;
    part[0].far = spux_min(spu_madd(spux_vfloat(leave), r->rdir[axis], r->last[axis]), whole.far);
    part[1].near = spux_max(spu_madd(spux_vfloat(enter), r->rdir[axis], r->first[axis]), whole.near);
    part[1].far = whole.far;
}

/* The part of a clip node's child. */
CGT_SPU_INLINE bih_part bih_clip(const tree_rays *r, const cgt_bih_node *n, bih_part whole)
{
    const uint32_t axis = cgt_bih_axis(n), first = r->reverse >> axis & 1;
    if (r->mixed >> axis & 1) {
        whole = bih_narrow_mixed(r, axis, cgt_bih_plane(n, 0), 1, whole);
        return bih_narrow_mixed(r, axis, cgt_bih_plane(n, 1), 0, whole);
    }
    const vfloat enter = spux_vfloat(cgt_bih_plane(n, first)), leave = spux_vfloat(cgt_bih_plane(n, !first));
    whole.near = spux_max(spu_madd(enter, r->rdir[axis], r->first[axis]), whole.near);
    whole.far = spux_min(spu_madd(leave, r->rdir[axis], r->last[axis]), whole.far);
    return whole;
}

/* ---- one ray ---- */

typedef struct bih_ray {
    tree_ray ray;
    float first[3], last[3]; /* as of tree_rays */
} bih_ray;

CGT_SPU_INLINE void bih_ray_init(const packet *p, uint32_t i, bih_ray *r)
{
    tree_ray_init(p, i, &r->ray);
    for (int a = 0; a < 3; a++) {
        const float t = r->ray.org[a] * r->ray.rdir[a], t_error = fabsf(t) * BIH_ORG_ERROR + 0x1p-120f;
        r->first[a] = -t_error - t;
        r->last[a] = t_error - t;
    }
}

/* Whether a ray without a component along the axis, or with hardly any, may pass [low, high]. */
CGT_SPU_INLINE bool bih_flat_passes(const tree_ray *r, uint32_t axis, float low, float high)
{
    return !(r->zero >> axis & 1) || (r->org[axis] >= low && r->org[axis] <= high);
}

#endif
