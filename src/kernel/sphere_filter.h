/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays of a packet against one sphere, in single precision with derived bounds; what they leave open is decided in
 * double. The form is the perpendicular one of sphere_exact.h:
 *   s = d.c / d.d,  l = c - s d,  h = r^2 - l.l,  t = s - sqrt(h / d.d)
 *
 * Bounds, with u = 2^-24, |c| the distance from origin to centre, first order unless said; they hold for fused and
 * unfused arithmetic and for reciprocals and roots within 2^-21:
 *   c        u |c| per component, as a vector
 *   d.c      4 u |d||c|;  1/d.d  8 u relative;  so s within 13 u |c|/|d|
 *   l        along d: 13 u |c|, which changes l.l in second order only, since l is perpendicular to d;
 *            otherwise u |c| (c) + u |c| (s d) + u |c| (difference) = 3 u |c|
 *   l.l      within 2 |l| 3 u |c| + 3 u |l|^2 + (16^2 + 96 + 9) u^2 |c|^2
 *   h        at the silhouette |l| = r: 6 u r |c| + 6 u r^2 + 361 u^2 |c|^2
 *   eps      9 u r (|c| + r) + 640 u^2 |c|^2 + 2^-120, the last for what underflows
 * A hit's exact h is at least 0, and computed r^2 + eps - l.l then is at least 0 too: less is a certain miss. Where it
 * is more than 17 eps the hit is certain, its exact h at least that minus 2 eps, and the two roots differ by at most
 * 2 eps / (sqrt(17 eps) + sqrt(15 eps)) < 0.26 sqrt(eps), over |d|. The rest of the interval is
 *   e0       13 u |c| (s) + 13 u sqrt(h) (root) + u |t|: 18 u (|c| + r), over |d|
 * and, for what underflows (flushed denormals included), 2^-62 where h / d.d does and 2^-122 / d.d where d.c does.
 * A test in the suite checks these against double, and shrinks them until they fail. */
#ifndef CGT_SPHERE_FILTER_H
#define CGT_SPHERE_FILTER_H

#include "../sphere_exact.h"
#include "block_cones.h"

#ifndef FILTER_U /* a test gives it other values, to find where the bounds break */
#define FILTER_U 0x1p-24f
#endif

/* Spheres of one vector, with what the bounds of each come to for this packet. */
typedef struct filter_spheres {
    _Alignas(64) float center[3][CGT_LANES];
    _Alignas(64) float radius[CGT_LANES];
    _Alignas(64) float r2[CGT_LANES];      /* r^2 + eps */
    _Alignas(64) float certain[CGT_LANES]; /* 17 eps */
    _Alignas(64) float before[CGT_LANES];  /* e0: from the computed t down to the interval's start */
    _Alignas(64) float gap[CGT_LANES];     /* the interval's length */
    _Alignas(64) float nearest[CGT_LANES]; /* no ray meets the sphere before this t */
    uint32_t object[CGT_LANES];
} filter_spheres;

/* What the bounds need to know of the rays. */
typedef struct filter_packet {
    float org[3];      /* the common origin, or the middle of the box of the origins */
    float org_reach;   /* from there to any origin, as a sum over the axes */
    float rlength;     /* at least 1 / |d| of the shortest direction */
    float rlength_low; /* at most 1 / |d| of the longest direction; -infinity where hits behind an origin count */
} filter_packet;

CGT_SPU_INLINE void filter_packet_make(const packet *p, filter_packet *f)
{
    vfloat most = spux_vfloat(0), least = spux_vfloat(INFINITY), t_min = least;
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        most = spux_max(most, spux_load(p->rdd + i));
        least = spux_min(least, spux_load(p->rdd + i));
        t_min = spux_min(t_min, spux_load(p->t_min + i));
    }
    f->rlength = __builtin_sqrtf(spux_hmax(most)) * (1 + 0x1p-18f);
    f->rlength_low = spux_hmin(t_min) < 0 ? -INFINITY : __builtin_sqrtf(spux_hmin(least)) * (1 - 0x1p-18f);
    f->org_reach = 0;
    for (int a = 0; a < 3; a++) {
        f->org[a] = p->org[a][0];
        if (p->common_origin)
            continue;
        vfloat low = spux_load(p->org[a]), high = low;
        for (uint32_t i = CGT_LANES; i < p->lanes; i += CGT_LANES) {
            low = spux_min(low, spux_load(p->org[a] + i));
            high = spux_max(high, spux_load(p->org[a] + i));
        }
        const float l = spux_hmin(low), h = spux_hmax(high);
        f->org[a] = 0.5f * l + 0.5f * h;
        f->org_reach += (h - l) * 0.5f * (1 + 0x1p-18f) + (h > -l ? h : -l) * 0x1p-22f;
    }
}

/* The bounds of a vector of spheres. */
CGT_SPU_INLINE void filter_spheres_bound(const filter_packet *f, filter_spheres *s)
{
    const vfloat r = spux_load(s->radius);
    vfloat distance = spux_vfloat(f->org_reach), square = spux_vfloat(0);
    for (int a = 0; a < 3; a++) {
        const vfloat c = spu_sub(spux_load(s->center[a]), spux_vfloat(f->org[a]));
        distance = spu_add(distance, spux_abs(c));
        square = spu_madd(c, c, square);
    }
    const vfloat wide = spu_mul(distance, spux_vfloat(26 * FILTER_U)); /* 26^2 > 640 */
    const vfloat eps = spu_madd(spu_mul(r, spux_vfloat(9 * FILTER_U)), spu_add(distance, r),
                                spu_madd(wide, wide, spux_vfloat(0x1p-120f)));
    const vfloat underflow = spux_vfloat(0x1p-62f + 0x1p-122f * f->rlength * f->rlength);
    const vfloat e0 = spu_madd(spu_add(distance, r), spux_vfloat(18 * FILTER_U * f->rlength), underflow);
    const vfloat root = spu_mul(spux_sqrt(eps), spux_vfloat(0.27f * f->rlength));
    /* 8 roundings each, and 2^-74 where squares underflow; the distance between surfaces is at least what is left, where
     * anything is */
    const vfloat near = spu_sub(
        spu_mul(spux_sqrt(square), spux_vfloat(1 - 0x1p-20f)),
        spu_madd(spu_add(distance, r), spux_vfloat(0x1p-20f), spu_add(r, spux_vfloat(f->org_reach + 0x1p-74f))));
    const vmask outside = spu_cmpgt(near, spux_vfloat(0));
    spux_store(s->nearest, spux_select(spux_vfloat(-INFINITY), spu_mul(near, spux_vfloat(f->rlength_low)), outside));
    spux_store(s->r2, spu_madd(r, r, eps));
    spux_store(s->certain, spu_mul(eps, spux_vfloat(17)));
    spux_store(s->before, e0);
    spux_store(s->gap, spu_madd(e0, spux_vfloat(2), root));
}

/* Decides in double whether sphere `object` beats the best hit of ray i. */
__attribute__((noinline, unused)) static void filter_decide(const cgt_queue_grid *grid, packet *p, uint32_t i,
                                                            uint32_t object, cgt_counts *counts)
{
    const float org[3] = {p->org[0][i], p->org[1][i], p->org[2][i]};
    const float dir[3] = {p->dir[0][i], p->dir[1][i], p->dir[2][i]};
    const uint32_t winner = p->object[i];
    double t, best;
    if (winner == object || p->high[i] == -INFINITY)
        return; /* met before; or the ray takes no part */
    counts->double_tests++;
    if (!cgt_sphere_exact_hit(org, dir, p->t_min[i], p->t_max[i], cgt_objects_sphere(&grid->objects, object), &t))
        return;
    if (p->any_hit) {
        p->low[i] = p->high[i] = -INFINITY;
        p->object[i] = object;
        return;
    }
    if (winner != CGT_NONE) {
        best = cgt_sphere_exact_t(org, dir, p->t_min[i], cgt_objects_sphere(&grid->objects, winner));
        if (t > best || (t == best && object > winner))
            return;
    }
    const float rounded = (float)t, width = fabsf(rounded) * 0x1p-22f + 0x1p-140f;
    p->low[i] = rounded - width;
    p->high[i] = rounded + width;
    p->object[i] = object;
}

/* One sphere as the vectors of a test. */
typedef struct filter_sphere {
    vfloat center[3]; /* seen from the common origin, where there is one */
    vfloat r2, certain, before, gap, nearest;
    vuint object;
} filter_sphere;

CGT_SPU_INLINE filter_sphere filter_sphere_get(const packet *p, const filter_spheres *s, int k, bool common_origin)
{
    filter_sphere q = {.r2 = spux_vfloat(s->r2[k]),
                       .certain = spux_vfloat(s->certain[k]),
                       .before = spux_vfloat(s->before[k]),
                       .gap = spux_vfloat(s->gap[k]),
                       .nearest = spux_vfloat(s->nearest[k]),
                       .object = spux_vuint(s->object[k])};
    for (int a = 0; a < 3; a++)
        q.center[a] = spux_vfloat(common_origin ? s->center[a][k] - p->org[a][0] : s->center[a][k]);
    return q;
}

/* What a test finds out about the rays of a vector. */
typedef struct filter_result {
    vfloat low, high; /* the interval of t */
    vmask certain;    /* a hit, certainly in the range and nearer than the best */
    vmask open;       /* to be decided in double: neither certain nor certainly not */
} filter_result;

/* Returns false where all rays of the vector surely miss. Comparisons are written so that what is not a number stays
 * open. */
CGT_SPU_INLINE bool filter_rays(const packet *p, const filter_sphere *q, uint32_t i, bool common_origin,
                                filter_result *f)
{
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
    /* a miss; or the sphere's nearest point lies beyond the best, which spares the root of a hidden one */
    const vmask missed = spu_or(spu_cmpgt(zero, h), spu_cmpgt(q->nearest, spux_load(p->high + i)));
    if (spux_all(missed))
        return false;
    const vfloat half = spux_sqrt(spu_mul(h, rdd)), t_min = spux_load(p->t_min + i);
    const vfloat low = spu_sub(spu_sub(mid, half), q->before), high = spu_add(low, q->gap);
    /* beyond the best; or both roots before the range; or met before */
    const vmask beyond = spu_cmpgt(low, spux_load(p->high + i));
    const vmask behind = spu_cmpgt(t_min, spu_add(spu_add(mid, half), q->before));
    const vmask met = spu_cmpeq(spux_load_uint(p->object + i), q->object);
    /* greater, not equal: where h / d.d leaves the range of float, low is -infinity and so may t_min be */
    const vmask nearer = spu_and(spu_cmpgt(spux_load(p->low + i), high), spu_cmpgt(low, t_min));
    f->low = low;
    f->high = high;
    f->certain = spu_and(spu_cmpgt(h, q->certain), nearer);
    f->open = spux_not(spu_or(spu_or(spu_or(missed, beyond), spu_or(behind, met)), f->certain));
    return true;
}

/* Decides the rays of a block that the filter leaves open. They are rare: they are found a second time here. */
CGT_SPU_INLINE void filter_decide_block(const cgt_queue_grid *grid, packet *p, const filter_sphere *q, uint32_t object,
                                        uint32_t first, uint32_t end, bool common_origin, cgt_counts *counts)
{
    filter_result f;
    for (uint32_t i = first; i < end; i += CGT_LANES) {
        if (!filter_rays(p, q, i, common_origin, &f))
            continue;
        for (unsigned left = spux_mask_bits(f.open); left; left &= left - 1)
            filter_decide(grid, p, i + (uint32_t)__builtin_ctz(left), object, counts);
    }
}

/* Tests the rays of the packet's blocks that sphere k of a vector may reach. */
CGT_SPU_INLINE void filter_test(const cgt_queue_grid *grid, packet *p, const filter_spheres *s, int k,
                                block_cones *blocks, bool common_origin, bool any_hit, cgt_counts *counts)
{
    const filter_sphere q = filter_sphere_get(p, s, k, common_origin);
    const vfloat closed = spux_vfloat(-INFINITY);
    const float center[3] = {q.center[0][0], q.center[1][0], q.center[2][0]};
    uint32_t reached = block_cones_reached(blocks, center, s->radius[k], s->nearest[k]);
    for (; reached; reached &= reached - 1) {
        const uint32_t block = (uint32_t)__builtin_ctz(reached), first = block * BLOCK_RAYS, end = block_end(p, block);
        vmask open = spux_mask_none(), changed = open;
        filter_result f;
        counts->ray_tests += end - first;
        for (uint32_t i = first; i < end; i += CGT_LANES) {
            if (!filter_rays(p, &q, i, common_origin, &f))
                continue;
            spux_store(p->low + i, spux_select(spux_load(p->low + i), any_hit ? closed : f.low, f.certain));
            spux_store(p->high + i, spux_select(spux_load(p->high + i), any_hit ? closed : f.high, f.certain));
            spux_store_uint(p->object + i, spux_select(spux_load_uint(p->object + i), q.object, f.certain));
            open = spu_or(open, f.open);
            changed = spu_or(changed, f.certain);
        }
        if (spux_any(open))
            filter_decide_block(grid, p, &q, s->object[k], first, end, common_origin, counts);
        if (spux_any(changed))
            block_far_update(p, blocks, block);
    }
}

#endif
