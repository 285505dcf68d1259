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
 * A test in the suite checks these against double, and shrinks them until they fail. */
#ifndef CGT_SPHERE_FILTER_H
#define CGT_SPHERE_FILTER_H

#include "../sphere_exact.h"
#include "packet.h"

#define FILTER_U 0x1p-24f

/* Spheres of one vector, with what the bounds of each come to for this packet. */
typedef struct filter_spheres {
    _Alignas(64) float center[3][CGT_LANES];
    _Alignas(64) float radius[CGT_LANES];
    _Alignas(64) float r2[CGT_LANES];      /* r^2 + eps */
    _Alignas(64) float certain[CGT_LANES]; /* 17 eps */
    _Alignas(64) float before[CGT_LANES];  /* e0: from the computed t down to the interval's start */
    _Alignas(64) float gap[CGT_LANES];     /* the interval's length */
    uint32_t object[CGT_LANES];
} filter_spheres;

/* What the bounds need to know of the rays. */
typedef struct filter_packet {
    float org[3];      /* the common origin, or the middle of the box of the origins */
    float org_reach;   /* from there to any origin, as a sum over the axes */
    float rlength;     /* at least 1 / |d| of the shortest direction */
} filter_packet;

CGT_SPU_INLINE void filter_packet_make(const packet *p, filter_packet *f)
{
    vfloat most = spux_vfloat(0);
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) most = spux_max(most, spux_load(p->rdd + i));
    f->rlength = __builtin_sqrtf(spux_hmax(most)) * (1 + 0x1p-18f);
    f->org_reach = 0;
    for (int a = 0; a < 3; a++) {
        f->org[a] = p->org[a][0];
        if (p->common_origin) continue;
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
    vfloat distance = spux_vfloat(f->org_reach);
    for (int a = 0; a < 3; a++)
        distance = spu_add(distance, spux_abs(spu_sub(spux_load(s->center[a]), spux_vfloat(f->org[a]))));
    const vfloat wide = spu_mul(distance, spux_vfloat(26 * FILTER_U)); /* 26^2 > 640 */
    const vfloat eps = spu_madd(spu_mul(r, spux_vfloat(9 * FILTER_U)), spu_add(distance, r), spu_madd(wide, wide, spux_vfloat(0x1p-120f)));
    const vfloat e0 = spu_mul(spu_add(distance, r), spux_vfloat(18 * FILTER_U * f->rlength));
    const vfloat root = spu_mul(spux_sqrt(eps), spux_vfloat(0.27f * f->rlength));
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
    if (winner == object || p->high[i] == -INFINITY) return; /* met before; or the ray takes no part */
    counts->double_tests++;
    if (!cgt_sphere_exact_hit(org, dir, p->t_min[i], p->t_max[i], cgt_objects_sphere(&grid->objects, object), &t)) return;
    if (p->any_hit) {
        p->low[i] = p->high[i] = -INFINITY;
        p->object[i] = object;
        return;
    }
    if (winner != CGT_NONE) {
        best = cgt_sphere_exact_t(org, dir, p->t_min[i], cgt_objects_sphere(&grid->objects, winner));
        if (t > best || (t == best && object > winner)) return;
    }
    const float rounded = (float)t, width = fabsf(rounded) * 0x1p-22f + 0x1p-140f;
    p->low[i] = rounded - width;
    p->high[i] = rounded + width;
    p->object[i] = object;
}

/* Tests all rays of a packet against sphere k of a vector. Comparisons are written so that what is not a number counts
 * as possible: it is then decided in double. */
CGT_SPU_INLINE void filter_test(const cgt_queue_grid *grid, packet *p, const filter_spheres *s, int k, bool common_origin,
                                bool any_hit, cgt_counts *counts)
{
    const vfloat zero = spux_vfloat(0), r2 = spux_vfloat(s->r2[k]), sure = spux_vfloat(s->certain[k]);
    const vfloat before = spux_vfloat(s->before[k]), gap = spux_vfloat(s->gap[k]);
    const vfloat x = spux_vfloat(s->center[0][k]), y = spux_vfloat(s->center[1][k]), z = spux_vfloat(s->center[2][k]);
    const vuint object = spux_vuint(s->object[k]);
    vfloat cx = x, cy = y, cz = z;
    if (common_origin) {
        cx = spu_sub(x, spux_vfloat(p->org[0][0]));
        cy = spu_sub(y, spux_vfloat(p->org[1][0]));
        cz = spu_sub(z, spux_vfloat(p->org[2][0]));
    }
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const vfloat dx = spux_load(p->dir[0] + i), dy = spux_load(p->dir[1] + i), dz = spux_load(p->dir[2] + i);
        if (!common_origin) {
            cx = spu_sub(x, spux_load(p->org[0] + i));
            cy = spu_sub(y, spux_load(p->org[1] + i));
            cz = spu_sub(z, spux_load(p->org[2] + i));
        }
        const vfloat rdd = spux_load(p->rdd + i);
        const vfloat mid = spu_mul(spu_madd(dx, cx, spu_madd(dy, cy, spu_mul(dz, cz))), rdd);
        const vfloat lx = spu_nmsub(mid, dx, cx), ly = spu_nmsub(mid, dy, cy), lz = spu_nmsub(mid, dz, cz);
        const vfloat h = spu_sub(r2, spu_madd(lx, lx, spu_madd(ly, ly, spu_mul(lz, lz))));
        const unsigned missed = spux_mask_bits(spu_cmpgt(zero, h));
        if (missed == CGT_ALL_LANES) continue;
        const vfloat half = spux_sqrt(spu_mul(h, rdd)), t = spu_sub(spu_sub(mid, half), before);
        const vfloat high = spux_load(p->high + i), low = spux_load(p->low + i), end = spu_add(t, gap);
        unsigned possible = ~(missed | spux_mask_bits(spu_cmpgt(t, high))) & CGT_ALL_LANES;
        if (!possible) continue;
        const vmask inside = spux_cmpge(t, spux_load(p->t_min + i));
        const vmask certain = spu_and(spu_and(spu_cmpgt(h, sure), spu_cmpgt(low, end)), inside);
        if (any_hit) {
            spux_store(p->low + i, spux_select(low, spux_vfloat(-INFINITY), certain));
            spux_store(p->high + i, spux_select(high, spux_vfloat(-INFINITY), certain));
        } else {
            spux_store(p->low + i, spux_select(low, t, certain));
            spux_store(p->high + i, spux_select(high, end, certain));
        }
        const vuint winner = spux_load_uint(p->object + i);
        spux_store_uint(p->object + i, spux_select(winner, object, certain));
        possible &= ~(spux_mask_bits(certain) | spux_mask_bits(spu_cmpeq(winner, object)));
        if (!possible) continue;
        /* not behind the start of the range with both its roots */
        const vfloat far = spu_add(spu_add(mid, half), before);
        possible &= ~spux_mask_bits(spu_cmpgt(spux_load(p->t_min + i), far));
        while (possible) {
            filter_decide(grid, p, i + (uint32_t)__builtin_ctz(possible), s->object[k], counts);
            possible &= possible - 1;
        }
    }
}

#endif
