/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray and one object in each lane of a vector, in single precision with derived bounds. Leaves of trees hold few
 * objects and are met by few rays: here nothing is prepared, and either side may be the same in all lanes. The forms are
 * those of sphere_filter.h and triangle_filter.h; the bounds of triangles are coarser, and those of rays their own.
 *
 * Triangles, with b and e_k the vertices from the origin and the edges, times the world's scale, u = 2^-24, |x| the
 * largest component and [x] the sum of their sizes: P(p, q, r) of triangle_filter.h is at most |p| [q] [r]. So
 *   w_k = d.(b x e_k)   within 9 u |d| [b] [e_k]        n = e_0 x e_1; d.n   within 8 u |d| [e_0] [e_1]
 *   n.b                 within 10 u |b| [e_0] [e_1]
 * each enlarged by 2^-7 for what is of second order. What underflows, in a vertex, a product or a sum, is below
 * 2^-120 (|d| + 1), which is added. */
#ifndef CGT_LEAF_LANES_H
#define CGT_LEAF_LANES_H

#include "filter.h"

/* The rays of the lanes, all alike or each its own. */
typedef struct lane_rays {
    vfloat org[3], dir[3];
    vfloat t_min;
    vfloat rdd;             /* 1 / d.d; only where there are spheres, and so is the next */
    vfloat rlength;         /* 1 / |d|, rounded up */
    vfloat most, underflow; /* of triangles */
    vfloat scale, unscale;  /* of the world */
} lane_rays;

/* What the tests find: intervals of t, which lanes hit for certain and which may. */
typedef struct lane_hits {
    vfloat low, high;
    vmask certain, open;
} lane_hits;

CGT_SPU_INLINE void lane_rays_finish(lane_rays *r, float scale)
{
    r->rlength = spu_mul(spux_sqrt(r->rdd), spux_vfloat(1 + 0x1p-18f));
    r->most = spux_max(spux_abs(r->dir[0]), spux_max(spux_abs(r->dir[1]), spux_abs(r->dir[2])));
    r->underflow = spu_madd(r->most, spux_vfloat(0x1p-120f), spux_vfloat(0x1p-120f));
    r->scale = spux_vfloat(scale);
    r->unscale = spux_vfloat(1 / scale);
}

/* Rays i to i + CGT_LANES - 1 of a packet. */
CGT_SPU_INLINE void lane_rays_of_packet(const packet *p, uint32_t i, float scale, lane_rays *r)
{
    for (int a = 0; a < 3; a++) {
        r->org[a] = spux_load(p->org[a] + i);
        r->dir[a] = spux_load(p->dir[a] + i);
    }
    r->t_min = spux_load(p->t_min + i);
    r->rdd = spux_load(p->rdd + i);
    lane_rays_finish(r, scale);
}

/* Ray i of a packet in every lane. */
CGT_SPU_INLINE void lane_rays_of_one(const packet *p, uint32_t i, float scale, lane_rays *r)
{
    for (int a = 0; a < 3; a++) {
        r->org[a] = spux_vfloat(p->org[a][i]);
        r->dir[a] = spux_vfloat(p->dir[a][i]);
    }
    r->t_min = spux_vfloat(p->t_min[i]);
    r->rdd = spux_vfloat(p->rdd[i]);
    lane_rays_finish(r, scale);
}

CGT_SPU_INLINE vfloat lane_dot(const vfloat p[3], const vfloat q[3])
{
    return spu_madd(p[0], q[0], spu_madd(p[1], q[1], spu_mul(p[2], q[2])));
}

CGT_SPU_INLINE vfloat lane_sum(const vfloat v[3])
{
    return spu_add(spux_abs(v[0]), spu_add(spux_abs(v[1]), spux_abs(v[2])));
}

/* False where all surely miss. */
CGT_SPU_INLINE bool lane_sphere(const lane_rays *r, const vfloat center[3], vfloat radius, lane_hits *q)
{
    vfloat c[3], l[3];
    for (int a = 0; a < 3; a++)
        c[a] = spu_sub(center[a], r->org[a]);
    const vfloat distance = lane_sum(c), reach = spu_add(distance, radius), zero = spux_vfloat(0);
    const vfloat wide = spu_mul(distance, spux_vfloat(26 * FILTER_U));
    const vfloat eps =
        spu_madd(spu_mul(radius, spux_vfloat(9 * FILTER_U)), reach, spu_madd(wide, wide, spux_vfloat(0x1p-120f)));
    const vfloat underflow = spu_madd(spu_mul(r->rlength, r->rlength), spux_vfloat(0x1p-122f), spux_vfloat(0x1p-62f));
    const vfloat before = spu_madd(spu_mul(reach, spux_vfloat(18 * FILTER_U)), r->rlength, underflow);
    const vfloat mid = spu_mul(lane_dot(r->dir, c), r->rdd);
    for (int a = 0; a < 3; a++)
        l[a] = spu_nmsub(mid, r->dir[a], c[a]);
    const vfloat h = spu_sub(spu_madd(radius, radius, eps), lane_dot(l, l));
    const vmask missed = spu_cmpgt(zero, h);
    if (spux_all(missed))
        return false;
    const vfloat half = spux_sqrt(spu_mul(spux_select(h, zero, missed), r->rdd));
    const vfloat gap =
        spu_madd(before, spux_vfloat(2), spu_mul(spux_sqrt(eps), spu_mul(r->rlength, spux_vfloat(0.27f))));
    q->low = spu_sub(spu_sub(mid, half), before);
    q->high = spu_add(q->low, gap);
    /* both roots before the range */
    const vmask behind = spu_cmpgt(r->t_min, spu_add(spu_add(mid, half), before));
    q->certain = spu_and(spu_cmpgt(h, spu_mul(eps, spux_vfloat(17))), spu_cmpgt(q->low, r->t_min));
    q->open = spux_not(spu_or(spu_or(missed, behind), q->certain));
    return true;
}

CGT_SPU_INLINE void lane_cross(const vfloat p[3], const vfloat q[3], vfloat cross[3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        cross[a] = spu_msub(p[b], q[c], spu_mul(p[c], q[b]));
    }
}

/* Which lanes' lines pass inside all edges for certain, and which outside of one. */
CGT_SPU_INLINE void lane_sides(const lane_rays *r, vfloat b[3][3], vfloat e[3][3], const vfloat sum[3], vmask *inside,
                               vmask *outside)
{
    const vfloat farthest = spux_max(lane_sum(b[0]), spux_max(lane_sum(b[1]), lane_sum(b[2])));
    const vfloat size = spu_mul(spu_mul(r->most, farthest), spux_vfloat(9 * FILTER_U * (1 + 0x1p-7f)));
    vmask all_above = spux_mask_all(), all_below = all_above, any_above = spux_mask_none(), any_below = any_above;
    for (int k = 0; k < 3; k++) {
        vfloat cross[3];
        lane_cross(b[(k + 1) % 3], e[k], cross);
        const vfloat w = lane_dot(r->dir, cross), eps = spu_madd(size, sum[k], r->underflow);
        const vmask above = spu_cmpgt(w, eps), below = spu_cmpgt(spu_xor(eps, spux_vfloat(-0.f)), w);
        all_above = spu_and(all_above, above);
        all_below = spu_and(all_below, below);
        any_above = spu_or(any_above, above);
        any_below = spu_or(any_below, below);
    }
    *inside = spu_or(all_above, all_below);
    *outside = spu_and(any_above, any_below);
}

/* False where all surely miss. */
CGT_SPU_INLINE bool lane_triangle(const lane_rays *r, const vfloat vertex[3][3], lane_hits *q)
{
    vfloat b[3][3], e[3][3], sum[3], n[3];
    vmask inside, outside;
    for (int k = 0; k < 3; k++) {
        for (int a = 0; a < 3; a++) {
            b[k][a] = spu_mul(spu_sub(vertex[k][a], r->org[a]), r->scale);
            e[k][a] = spu_mul(spu_sub(vertex[(k + 2) % 3][a], vertex[(k + 1) % 3][a]), r->scale);
        }
        sum[k] = lane_sum(e[k]);
    }
    lane_sides(r, b, e, sum, &inside, &outside);
    if (spux_all(outside))
        return false;
    lane_cross(e[0], e[1], n);
    const vfloat edges = spu_mul(spu_mul(sum[0], sum[1]), spux_vfloat(10 * FILTER_U * (1 + 0x1p-7f)));
    const vfloat delta = spu_madd(edges, r->most, r->underflow);
    const vfloat num_error = spu_madd(edges, lane_sum(b[0]), spux_vfloat(0x1p-120f));
    const vfloat num = lane_dot(n, b[0]), den = lane_dot(r->dir, n), rden = spux_div(r->unscale, den);
    const vfloat t = spu_mul(num, rden), size = spux_abs(t);
    /* num and its error are scaled once more often than den */
    const vfloat error =
        spu_mul(spu_madd(spu_mul(size, r->scale), delta, num_error), spu_mul(spux_abs(rden), spux_vfloat(1.34f)));
    const vfloat width = spu_madd(size, spux_vfloat(0x1p-20f), spu_add(error, spux_vfloat(0x1p-126f)));
    const vmask steep = spu_cmpgt(spux_abs(den), spu_mul(delta, spux_vfloat(4)));
    q->low = spu_sub(t, width);
    q->high = spu_add(t, width);
    const vmask behind = spu_and(steep, spu_cmpgt(r->t_min, q->high));
    q->certain = spu_and(spu_and(inside, steep), spu_cmpgt(q->low, r->t_min));
    q->open = spux_not(spu_or(spu_or(outside, behind), q->certain));
    return true;
}

#endif
