/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tests the rays of a packet against one sphere, in single precision with derived bounds; undecided rays are decided in
 * double. The formula is the perpendicular one of sphere_double.h:
 *   s = d.c / d.d,  l = c - s d,  h = r^2 - l.l,  t = s - sqrt(h / d.d)
 *
 * Error bounds, u = 2^-24, |c| the distance from origin to centre, of first order unless stated. They hold for fused
 * and unfused arithmetic, and for reciprocals and roots within 2^-21:
 *   c        u |c| per component, as a vector
 *   d.c      4 u |d||c|;  1/d.d  8 u relative;  so s within 13 u |c|/|d|
 *   l        along d: 13 u |c|, which changes l.l in second order only, since l is perpendicular to d;
 *            otherwise u |c| (c) + u |c| (s d) + u |c| (difference) = 3 u |c|
 *   l.l      within 2 |l| 3 u |c| + 3 u |l|^2 + (16^2 + 96 + 9) u^2 |c|^2
 *   h        at the silhouette |l| = r: 6 u r |c| + 6 u r^2 + 361 u^2 |c|^2
 *   eps      9 u r (|c| + r) + 640 u^2 |c|^2 + 2^-120; the last term covers underflow
 * If the exact h is at least 0, so is the computed r^2 + eps - l.l: a negative one is a certain miss. Above 17 eps the
 * hit is certain, its exact h is at least the computed one minus 2 eps, and the two roots differ by at most
 * 2 eps / (sqrt(17 eps) + sqrt(15 eps)) < 0.26 sqrt(eps), over |d|. The rest of the interval is
 *   e0       13 u |c| (s) + 13 u sqrt(h) (root) + u |t|: 18 u (|c| + r), over |d|
 * and, for underflow (also of flushed denormals), 2^-62 for h / d.d and 2^-122 / d.d for d.c.
 *
 * Rays that start inside a sphere, or behind it in their range, hit it at the second root, s + sqrt(h / d.d). It has
 * the same errors, turned around: the computed h is too large, if anything, so the interval ends at s + sqrt(h / d.d) +
 * e0 and is as long. It is the one that counts where the first root's interval ends before the range begins, which h
 * must be above 17 eps for. Where h / d.d overflows nothing is known of either root.
 * A test checks the bounds against double, and tightens them until it sees them break. */
#ifndef CGT_SPHERE_FILTER_H
#define CGT_SPHERE_FILTER_H

#include "papers/kernel/packet/packet_filter.h"

/* A vector of spheres, with the bounds of each for this packet. */
typedef struct filter_spheres {
    _Alignas(64) float center[3][CGT_LANES];
    _Alignas(64) float radius[CGT_LANES];
    _Alignas(64) float r2[CGT_LANES];          /* r^2 + eps */
    _Alignas(64) float certain_hit[CGT_LANES]; /* 17 eps */
    _Alignas(64) float t_error[CGT_LANES];     /* e0: from the computed t down to the start of the interval */
    _Alignas(64) float t_width[CGT_LANES];     /* the interval's length */
    _Alignas(64) float min_t[CGT_LANES];       /* no ray meets the sphere before this t */
    uint32_t prim[CGT_LANES];
} filter_spheres;

/* Reads `count` spheres into the first `lanes` lanes; lanes beyond count repeat the first one. */
CGT_SPU_INLINE void filter_gather_spheres(const cgt_primitives *prims, const uint32_t *reference, uint32_t count,
                                          uint32_t lanes, filter_spheres *s)
{
    for (uint32_t k = 0; k < lanes; k++) {
        const uint32_t prim = reference[k < count ? k : 0];
        const cgt_sphere q = cgt_primitives_sphere(prims, prim);
        s->center[0][k] = q.x;
        s->center[1][k] = q.y;
        s->center[2][k] = q.z;
        s->radius[k] = q.r;
        s->prim[k] = prim;
    }
}

/* The bounds of a vector of spheres. */
CGT_SPU_INLINE void filter_spheres_bound(const filter_packet *f, filter_spheres *s)
{
    const vfloat r = spux_load(s->radius);
    vfloat distance = spux_vfloat(f->org_reach);
    for (int a = 0; a < 3; a++)
        distance = spu_add(distance, spux_abs(spu_sub(spux_load(s->center[a]), spux_vfloat(f->org[a]))));
    filter_min_t(f, (const float(*)[CGT_LANES])s->center, s->radius, s->min_t);
    const vfloat eps_c = spu_mul(distance, spux_vfloat(26 * FILTER_ROUNDOFF)); /* 26^2 > 640 */
    const vfloat eps = spu_madd(spu_mul(r, spux_vfloat(9 * FILTER_ROUNDOFF)), spu_add(distance, r),
                                spu_madd(eps_c, eps_c, spux_vfloat(0x1p-120f)));
    const vfloat underflow = spux_vfloat(0x1p-62f + 0x1p-122f * f->rlength * f->rlength);
    const vfloat e0 = spu_madd(spu_add(distance, r), spux_vfloat(18 * FILTER_ROUNDOFF * f->rlength), underflow);
    const vfloat root = spu_mul(spux_sqrt(eps), spux_vfloat(0x1.148p-2f * f->rlength));
    spux_store(s->r2, spu_madd(r, r, eps));
    spux_store(s->certain_hit, spu_mul(eps, spux_vfloat(17)));
    spux_store(s->t_error, e0);
    spux_store(s->t_width, spu_madd(e0, spux_vfloat(2), root));
}

/* One sphere, broadcast for a test. */
typedef struct filter_sphere {
    vfloat center[3]; /* seen from the common origin, if there is one */
    vfloat r2, certain_hit, t_error, t_width, min_t;
    vuint prim;
} filter_sphere;

CGT_SPU_INLINE filter_sphere filter_sphere_get(const packet *p, const filter_spheres *s, int k, bool common_origin)
{
    filter_sphere q = {.r2 = spux_vfloat(s->r2[k]),
                       .certain_hit = spux_vfloat(s->certain_hit[k]),
                       .t_error = spux_vfloat(s->t_error[k]),
                       .t_width = spux_vfloat(s->t_width[k]),
                       .min_t = spux_vfloat(s->min_t[k]),
                       .prim = spux_vuint(s->prim[k])};
    for (int a = 0; a < 3; a++)
        q.center[a] = spux_vfloat(common_origin ? s->center[a][k] - p->org[a][0] : s->center[a][k]);
    return q;
}

/* Returns false if all rays of the vector certainly miss. Comparisons are written so that NaN is undecided.
 * second: looks at second roots, too. */
CGT_SPU_INLINE bool filter_sphere_roots(const packet *p, const void *primitive, uint32_t i, bool common_origin,
                                        bool second, filter_result *f)
{
    const filter_sphere *q = primitive;
    const vfloat zero = spux_vfloat(0), rdd = spux_load(p->rdd + i);
    const vfloat dx = spux_load(p->dir[0] + i), dy = spux_load(p->dir[1] + i), dz = spux_load(p->dir[2] + i);
    vfloat cx = q->center[0], cy = q->center[1], cz = q->center[2];
    if (!common_origin) {
        cx = spu_sub(cx, spux_load(p->org[0] + i));
        cy = spu_sub(cy, spux_load(p->org[1] + i));
        cz = spu_sub(cz, spux_load(p->org[2] + i));
    }
    const vfloat mid = spu_mul(spu_madd(dx, cx, spu_madd(dy, cy, spu_mul(dz, cz))), rdd);
    const vfloat lx = spu_nmsub(mid, dx, cx), ly = spu_nmsub(mid, dy, cy), lz = spu_nmsub(mid, dz, cz);
    const vfloat h = spu_sub(q->r2, spu_madd(lx, lx, spu_madd(ly, ly, spu_mul(lz, lz))));
    /* a miss, or the sphere's nearest point is occluded: this saves the root */
    const vmask missed = spu_or(spu_cmpgt(zero, h), spu_cmpgt(q->min_t, spux_load(p->high + i)));
    if (spux_all(missed))
        return false;
    const vfloat half = spux_sqrt(spu_mul(h, rdd)), t_min = spux_load(p->t_min + i);
    const vfloat low = spu_sub(spu_sub(mid, half), q->t_error), high = spu_add(low, q->t_width);
    const vfloat end = spu_add(spu_add(mid, half), q->t_error);
    /* beyond the closest hit; both roots before the range; or the closest hit already */
    const vmask beyond = spu_cmpgt(low, spux_load(p->high + i));
    const vmask behind = spu_cmpgt(t_min, end), inside = spu_cmpgt(h, q->certain_hit);
    const vmask already_hit = spu_cmpeq(spux_load_uint(p->prim + i), q->prim);
    /* greater, not equal: if h / d.d overflows, low is -infinity, and so may t_min be */
    const vmask nearer = spu_and(spu_cmpgt(spux_load(p->low + i), high), spu_cmpgt(low, t_min));
    f->low = low;
    f->high = high;
    f->certain_hit = spu_and(inside, nearer);
    f->undecided = spux_not(spu_or(spu_or(spu_or(missed, beyond), spu_or(behind, already_hit)), f->certain_hit));
    if (second) {
        const vmask later =
            filter_second_root(spu_and(inside, f->undecided), t_min, end, q->t_width, &f->low, &f->high);
        const vmask counts = spu_and(spu_cmpgt(spux_load(p->low + i), f->high), spu_cmpgt(f->low, t_min));
        const vmask out = spu_cmpgt(f->low, spux_load(p->high + i));
        f->certain_hit = spu_or(f->certain_hit, spu_and(later, counts));
        f->undecided = spu_andc(f->undecided, spu_and(later, spu_or(counts, out)));
    }
    return true;
}

CGT_SPU_INLINE bool filter_sphere_rays(const packet *p, const void *primitive, uint32_t i, bool common_origin,
                                       filter_result *f)
{
    return filter_sphere_roots(p, primitive, i, common_origin, false, f);
}

/* The test of rays that the first one leaves undecided. */
__attribute__((noinline, unused)) static bool filter_sphere_rays_again(const packet *p, const void *primitive,
                                                                       uint32_t i, bool common_origin, filter_result *f)
{
    return filter_sphere_roots(p, primitive, i, common_origin, true, f);
}

/* The same for fast packets, without bounds: hits of single precision are certain. */
CGT_SPU_INLINE bool filter_sphere_rays_fast(const packet *p, const void *primitive, uint32_t i, bool common_origin,
                                            filter_result *f)
{
    const filter_sphere *q = primitive;
    const vfloat rdd = spux_load(p->rdd + i), zero = spux_vfloat(0);
    const vfloat dx = spux_load(p->dir[0] + i), dy = spux_load(p->dir[1] + i), dz = spux_load(p->dir[2] + i);
    vfloat cx = q->center[0], cy = q->center[1], cz = q->center[2];
    if (!common_origin) {
        cx = spu_sub(cx, spux_load(p->org[0] + i));
        cy = spu_sub(cy, spux_load(p->org[1] + i));
        cz = spu_sub(cz, spux_load(p->org[2] + i));
    }
    const vfloat mid = spu_mul(spu_madd(dx, cx, spu_madd(dy, cy, spu_mul(dz, cz))), rdd);
    const vfloat lx = spu_nmsub(mid, dx, cx), ly = spu_nmsub(mid, dy, cy), lz = spu_nmsub(mid, dz, cz);
    const vfloat h = spu_sub(q->r2, spu_madd(lx, lx, spu_madd(ly, ly, spu_mul(lz, lz))));
    const vmask hit = spux_cmpge(h, zero);
    if (!spux_any(hit))
        return false;
    const vfloat half = spux_sqrt(spu_mul(h, rdd)), near = spu_sub(mid, half);
    const vfloat t = spux_select(near, spu_add(mid, half), spu_cmpgt(spux_load(p->t_min + i), near));
    f->low = f->high = t;
    f->certain_hit = spu_and(hit, filter_fast_closer(p, i, t, q->prim));
    f->undecided = spux_mask_none();
    return true;
}

/* Tests sphere k of a vector against the packet's blocks that it may reach. */
CGT_SPU_INLINE void filter_test_sphere(const cgt_primitives *prims, packet *p, const filter_spheres *s, int k,
                                       block_cones *blocks, filter_mode mode, cgt_counts *counts)
{
    filter_sphere q = filter_sphere_get(p, s, k, mode.common_origin);
    const float center[3] = {s->center[0][k], s->center[1][k], s->center[2][k]};
    const uint32_t reached = block_cones_test_sphere(blocks, center, s->radius[k], s->min_t[k]);
    if (mode.decides) {
        filter_blocks(prims, p, filter_sphere_rays, filter_sphere_rays_again, &q, s->prim[k], reached, blocks, mode,
                      counts);
        return;
    }
    q.r2 = spux_vfloat(s->radius[k] * s->radius[k]);
    filter_blocks(prims, p, filter_sphere_rays_fast, filter_sphere_rays_fast, &q, s->prim[k], reached, blocks, mode,
                  counts);
}

#endif
