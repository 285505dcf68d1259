/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tests the rays of a packet against one triangle, in single precision with derived bounds; undecided rays are decided
 * exactly. The formula is that of triangle_double.h, in the Pluecker coordinates of rays and edges:
 *   w_k = d.(b x e) + m.e,  b the vertex before edge k, e the edge, m = from x d for a ray whose origin is `from`
 *   t = (n.a - n.from) / d.n,  n = e0 x e1 for two edges
 * Vertices and `from` are seen from the filter's origin: the rays' common one, in which case from and m are 0 and left
 * out, or the middle of the origins. An edge is the difference of its two vertices as given, not of vertices seen from
 * the origin. So the error of w_k is proportional to the edge, and the undecided band along an edge is as wide as the
 * rounding of a vertex.
 *
 * Error bounds, u = 2^-24, of first order. They hold for fused and unfused arithmetic. A determinant is a sum of
 * products of three components. Its error is a number of u times the sum of their sizes, P(p, q, r) = the sum over the
 * axes of |p_x| (|q_y| |r_z| + |q_z| |r_y|). `far` is the largest |b| plus the largest |from|, component by component,
 * and d the packet's largest direction: this is tighter than lengths in scenes that are long in one direction.
 *   b, e, from   u each;  e and a factor of 1/eps 2 u
 *   d.(b x e)    u (b) + 2 u (e) + u + u (cross) + 3 u (dot) = 8 u;  9 u with the last sum
 *   m.e          u (from) + 2 u (m) + 2 u (e) + 3 u = 8 u, likewise
 *   eps_k        9 u P(d, far, e_k)
 *   n            2 u + 2 u, and u for a factor;  d.n  8 u: delta = 8 u P(d, e0, e1)
 *   n.a, n.from  u + 5 u + 3 u + 1 u: 10 u P(far, e0, e1)
 * Each is enlarged by 2^-7 for second order terms, and is at least 2^-20 of the same bound by lengths, so that it does
 * not vanish for axis-parallel edges. d is taken relative to its length (that of the longest one, with a common
 * origin). Edge vectors are divided by eps_k and n by delta, so the bound of all is that length.
 * With D = that length and |d.n| > 4 D: t = num / den errs by at most (num's error + |t| D) / (|den| - D), which
 * is 4/3 of the same over |den|, plus 2^-20 of t for division and rounding, and 2^-126 for underflow.
 * Underflow: what is below 2^-126 is flushed. A component of n loses 3 * 2^-126 before it is divided by delta: next to
 * nothing of the bounds, as delta and eps_k are at least 2^-100; but num's error has no such least value, and gets
 * 16 * 2^-126 of the reach before that division, and 8 * 2^-126 after it.
 * Coordinates are scaled by a power of two that brings the scene near 1. If a length, also of the scaled directions,
 * still leaves [2^-100, 2^100], the triangle is "wild": its numbers are set to zero, and every ray is undecided.
 * A test checks the bounds against exact arithmetic, and tightens them until it sees them break. */
#ifndef CGT_TRIANGLE_FILTER_H
#define CGT_TRIANGLE_FILTER_H

#include "papers/kernel/packet/packet_filter.h"

/* A vector of triangles, with the bounds of each for this packet. */
typedef struct filter_triangles {
    _Alignas(64) float vertex[3][3][CGT_LANES]; /* [k][a]: coordinate a of vertex k, as given */
    _Alignas(64) float center[3][CGT_LANES];    /* of a sphere around it, as given */
    _Alignas(64) float radius[CGT_LANES];
    _Alignas(64) float min_t[CGT_LANES];            /* no ray hits it before this t */
    _Alignas(64) float edge[3][3][CGT_LANES];       /* [k][a]: edge k, opposite vertex k, over eps_k */
    _Alignas(64) float edge_cross[3][3][CGT_LANES]; /* b x edge k, over eps_k */
    _Alignas(64) float normal[3][CGT_LANES];        /* n over delta */
    _Alignas(64) float num[CGT_LANES];              /* n.a over delta */
    _Alignas(64) float num_error[CGT_LANES];        /* of num */
    uint32_t prim[CGT_LANES];
} filter_triangles;

/* Reads `count` triangles into the first `lanes` lanes; lanes beyond count repeat the first one. */
CGT_SPU_INLINE void filter_gather_triangles(const cgt_primitives *prims, const uint32_t *reference, uint32_t count,
                                            uint32_t lanes, filter_triangles *s)
{
    for (uint32_t k = 0; k < lanes; k++) {
        const uint32_t prim = reference[k < count ? k : 0];
        const cgt_triangle q = cgt_primitives_triangle(prims, prim);
        for (int i = 0; i < 3; i++)
            for (int a = 0; a < 3; a++)
                s->vertex[i][a][k] = q.v[i][a];
        s->prim[k] = prim;
    }
}

/* ---- bounds ---- */

/* A sphere around the vertices: the middle of their box, and a radius rounded up. */
CGT_SPU_INLINE void filter_triangles_enclose(filter_triangles *s)
{
    vfloat square = spux_vfloat(0), magnitude = square;
    for (int a = 0; a < 3; a++) {
        const vfloat p = spux_load(s->vertex[0][a]), q = spux_load(s->vertex[1][a]), r = spux_load(s->vertex[2][a]);
        const vfloat low = spux_min(p, spux_min(q, r)), high = spux_max(p, spux_max(q, r)), k = spux_vfloat(0.5f);
        const vfloat reach = spu_mul(spu_sub(high, low), k);
        spux_store(s->center[a], spu_madd(low, k, spu_mul(high, k)));
        square = spu_madd(reach, reach, square);
        magnitude = spux_max(magnitude, spux_max(spux_abs(low), spux_abs(high)));
    }
    const vfloat rounding = spu_madd(magnitude, spux_vfloat(0x1p-22f), spux_vfloat(0x1p-62f));
    spux_store(s->radius, spu_madd(spux_sqrt(square), spux_vfloat(1 + 0x1p-18f), rounding));
}

CGT_SPU_INLINE vfloat filter_length(const vfloat v[3]) { return spux_sqrt(lane_dot(v, v)); }

/* 1 over a length; the lane becomes wild if it is out of range. */
CGT_SPU_INLINE vfloat filter_reciprocal(vfloat length, vmask *wild)
{
    const vmask good = spu_and(spu_cmpgt(length, spux_vfloat(0x1p-100f)), spu_cmpgt(spux_vfloat(0x1p100f), length));
    *wild = spu_or(*wild, spux_not(good));
    return spux_div(spux_vfloat(1), spux_select(spux_vfloat(1), length, good));
}

/* Stores v * k, or 0 for wild triangles, also in place of infinities. */
CGT_SPU_INLINE void filter_store_scaled(float to[3][CGT_LANES], const vfloat v[3], vfloat k, vmask wild)
{
    for (int a = 0; a < 3; a++)
        spux_store(to[a], spux_select(spu_mul(v[a], k), spux_vfloat(0), wild));
}

/* P(p, q, r), see above. */
CGT_SPU_INLINE vfloat filter_permanent(const vfloat p[3], const vfloat q[3], const vfloat r[3])
{
    vfloat sum = spux_vfloat(0);
    for (int a = 0; a < 3; a++) {
        const vfloat qb = spux_abs(q[(a + 1) % 3]), qc = spux_abs(q[(a + 2) % 3]);
        const vfloat rb = spux_abs(r[(a + 1) % 3]), rc = spux_abs(r[(a + 2) % 3]);
        sum = spu_madd(spux_abs(p[a]), spu_madd(qb, rc, spu_mul(qc, rb)), sum);
    }
    return sum;
}

/* `roundings` u times the sum of sizes, at least 2^-20 of the same by lengths. */
CGT_SPU_INLINE vfloat filter_triangles_error(float roundings, vfloat sizes, vfloat lengths)
{
    const float u = roundings * FILTER_ROUNDOFF * (1 + 0x1p-7f);
    return spu_mul(spux_max(sizes, spu_mul(lengths, spux_vfloat(0x1p-20f))), spux_vfloat(u));
}

/* Computes the bounds of a vector of triangles. */
CGT_SPU_INLINE void filter_triangles_bound(const filter_packet *f, filter_triangles *s)
{
    const vfloat scale = spux_vfloat(f->scale), from = spux_vfloat(f->org_reach * f->scale);
    vfloat v[3][3], e[3][3], length[3], farthest = spux_vfloat(0), cross[3];
    /* the rays' Pluecker coordinates are scaled, too */
    vmask wild = spu_cmpgt(spux_vfloat(f->longest * f->scale), spux_vfloat(0x1p100f));
    filter_triangles_enclose(s);
    filter_min_t(f, (const float(*)[CGT_LANES])s->center, s->radius, s->min_t);
    for (int k = 0; k < 3; k++) {
        for (int a = 0; a < 3; a++) {
            const vfloat before = spux_load(s->vertex[(k + 1) % 3][a]), after = spux_load(s->vertex[(k + 2) % 3][a]);
            v[k][a] = spu_mul(spu_sub(spux_load(s->vertex[k][a]), spux_vfloat(f->org[a])), scale);
            e[k][a] = spu_mul(spu_sub(after, before), scale);
        }
        farthest = spux_max(farthest, filter_length(v[k]));
        length[k] = filter_length(e[k]);
    }
    const vfloat reach = spu_mul(spu_add(farthest, from), spux_vfloat(1 + 0x1p-18f));
    const vfloat d[3] = {spux_vfloat(f->share[0]), spux_vfloat(f->share[1]), spux_vfloat(f->share[2])};
    vfloat far[3], reps[3];
    for (int a = 0; a < 3; a++) {
        const vfloat most = spux_max(spux_abs(v[0][a]), spux_max(spux_abs(v[1][a]), spux_abs(v[2][a])));
        far[a] = spu_add(most, spux_vfloat(f->reach[a] * f->scale));
    }
    const vfloat delta = filter_triangles_error(8, filter_permanent(d, e[0], e[1]), spu_mul(length[0], length[1]));
    const vfloat rdelta = filter_reciprocal(delta, &wild);
    for (int k = 0; k < 3; k++) {
        const vfloat eps = filter_triangles_error(9, filter_permanent(d, far, e[k]), spu_mul(length[k], reach));
        reps[k] = filter_reciprocal(eps, &wild);
    }
    const vfloat num_error = spu_madd(
        reach, spux_vfloat(0x1p-122f),
        filter_triangles_error(10, filter_permanent(far, e[0], e[1]), spu_mul(spu_mul(length[0], length[1]), reach)));
    for (int k = 0; k < 3; k++) {
        lane_cross(v[(k + 1) % 3], e[k], cross);
        filter_store_scaled(s->edge_cross[k], cross, reps[k], wild);
        filter_store_scaled(s->edge[k], e[k], reps[k], wild);
    }
    lane_cross(e[0], e[1], cross);
    filter_store_scaled(s->normal, cross, rdelta, wild);
    const vfloat unscale = spux_vfloat(1 / f->scale);
    const vfloat n[3] = {spux_load(s->normal[0]), spux_load(s->normal[1]), spux_load(s->normal[2])};
    const vfloat num = lane_dot(n, v[0]);
    spux_store(s->num, spux_select(spu_mul(num, unscale), spux_vfloat(0), wild));
    const vfloat error = spu_madd(num_error, rdelta, spux_vfloat(0x1p-123f));
    spux_store(s->num_error, spu_madd(error, unscale, spux_vfloat(0x1p-126f)));
}

/* Whether p comes after q in lexicographic order.
 *
 * A fast packet has no bounds and no scales, but two triangles that share an edge must find the same side of it for
 * every ray. So an edge is computed from its lower end to its higher one, in this order, whichever way the triangle
 * runs along it, and its sign is applied at the end. Then both compute the same numbers, with or without fused
 * operations. */
CGT_SPU_INLINE vmask filter_above(const vfloat p[3], const vfloat q[3])
{
    const vmask x = spu_cmpgt(p[0], q[0]), y = spu_cmpgt(p[1], q[1]), z = spu_cmpgt(p[2], q[2]);
    const vmask same_x = spu_cmpeq(p[0], q[0]), same_y = spu_cmpeq(p[1], q[1]);
    return spu_or(x, spu_and(same_x, spu_or(y, spu_and(same_y, z))));
}

CGT_SPU_INLINE void filter_triangles_prepare_fast(const filter_packet *f, filter_triangles *s)
{
    const vfloat scale = spux_vfloat(f->scale), minus = spux_vfloat(-0.f), plus = spux_vfloat(0);
    vfloat v[3][3], e[3][3], cross[3];
    filter_triangles_enclose(s);
    filter_min_t(f, (const float(*)[CGT_LANES])s->center, s->radius, s->min_t);
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            v[k][a] = spu_mul(spu_sub(spux_load(s->vertex[k][a]), spux_vfloat(f->org[a])), scale);
    for (int k = 0; k < 3; k++) {
        const vfloat *p = v[(k + 1) % 3], *q = v[(k + 2) % 3];
        const vmask swap = filter_above(p, q);
        const vfloat sign = spux_select(plus, minus, swap);
        vfloat low[3], edge[3];
        for (int a = 0; a < 3; a++) {
            low[a] = spux_select(p[a], q[a], swap);
            edge[a] = spu_sub(spux_select(q[a], p[a], swap), low[a]);
            e[k][a] = spu_xor(edge[a], sign);
            spux_store(s->edge[k][a], e[k][a]);
        }
        lane_cross(low, edge, cross);
        for (int a = 0; a < 3; a++)
            spux_store(s->edge_cross[k][a], spu_xor(cross[a], sign));
    }
    lane_cross(e[0], e[1], cross);
    for (int a = 0; a < 3; a++)
        spux_store(s->normal[a], cross[a]);
    spux_store(s->num, spu_mul(lane_dot(cross, v[0]), spux_vfloat(1 / f->scale)));
    spux_store(s->num_error, plus);
}

/* ---- the test ---- */

/* One triangle, broadcast for a test. */
typedef struct filter_triangle {
    vfloat edge[3][3], edge_cross[3][3], normal[3];
    vfloat num, num_error, min_t, longest;
    vuint prim;
} filter_triangle;

CGT_SPU_INLINE filter_triangle filter_triangle_get(const filter_packet *f, const filter_triangles *s, int k,
                                                   bool common_origin)
{
    filter_triangle q = {.num = spux_vfloat(s->num[k]),
                         .num_error = spux_vfloat(s->num_error[k]),
                         .min_t = spux_vfloat(s->min_t[k]),
                         .longest = spux_vfloat(f->longest),
                         .prim = spux_vuint(s->prim[k])};
    for (int a = 0; a < 3; a++) {
        q.normal[a] = spux_vfloat(s->normal[a][k]);
        for (int i = 0; i < 3; i++) {
            q.edge_cross[i][a] = spux_vfloat(s->edge_cross[i][a][k]);
            if (!common_origin)
                q.edge[i][a] = spux_vfloat(s->edge[i][a][k]);
        }
    }
    return q;
}

CGT_SPU_INLINE void filter_triangle_sides(const packet *p, const filter_triangle *q, uint32_t i, bool common_origin,
                                          vfloat w[3])
{
    const vfloat d[3] = {spux_load(p->dir[0] + i), spux_load(p->dir[1] + i), spux_load(p->dir[2] + i)};
    for (int k = 0; k < 3; k++)
        w[k] = lane_dot(d, q->edge_cross[k]);
    if (common_origin)
        return;
    const vfloat m[3] = {spux_load(p->moment[0] + i), spux_load(p->moment[1] + i), spux_load(p->moment[2] + i)};
    for (int k = 0; k < 3; k++)
        w[k] = spu_add(w[k], lane_dot(m, q->edge[k]));
}

CGT_SPU_INLINE void filter_triangle_plane(const packet *p, const filter_triangle *q, uint32_t i, bool common_origin,
                                          vfloat *num, vfloat *den)
{
    const vfloat d[3] = {spux_load(p->dir[0] + i), spux_load(p->dir[1] + i), spux_load(p->dir[2] + i)};
    *num = q->num;
    *den = lane_dot(d, q->normal);
    if (common_origin)
        return;
    const vfloat from[3] = {spux_load(p->from[0] + i), spux_load(p->from[1] + i), spux_load(p->from[2] + i)};
    *num = spu_sub(*num, lane_dot(from, q->normal));
}

/* Returns false if all rays of the vector certainly miss. Comparisons are written so that NaN is undecided. */
CGT_SPU_INLINE bool filter_triangle_rays(const packet *p, const void *primitive, uint32_t i, bool common_origin,
                                         filter_result *f)
{
    const filter_triangle *q = primitive;
    const vfloat bound = common_origin ? q->longest : spux_load(p->length + i);
    const vfloat minus = spu_xor(bound, spux_vfloat(-0.f));
    vfloat w[3], num, den;
    filter_triangle_sides(p, q, i, common_origin, w);
    const vfloat least = spux_min(w[0], spux_min(w[1], w[2])), most = spux_max(w[0], spux_max(w[1], w[2]));
    /* outside of an edge on each side, or the nearest point is occluded */
    const vmask missed =
        spu_or(spu_and(spu_cmpgt(minus, least), spu_cmpgt(most, bound)), spu_cmpgt(q->min_t, spux_load(p->high + i)));
    if (spux_all(missed))
        return false;
    filter_triangle_plane(p, q, i, common_origin, &num, &den);
    const vfloat r = spux_div(spux_vfloat(1), den), t = spu_mul(num, r), size = spux_abs(t);
    const vfloat error = spu_mul(spu_madd(size, bound, q->num_error), spu_mul(spux_abs(r), spux_vfloat(1.34f)));
    const vfloat width = spu_madd(size, spux_vfloat(0x1p-20f), spu_add(error, spux_vfloat(0x1p-126f)));
    const vfloat low = spu_sub(t, width), high = spu_add(t, width), t_min = spux_load(p->t_min + i);
    const vmask steep = spu_cmpgt(spux_abs(den), spu_mul(bound, spux_vfloat(4)));
    const vmask beyond = spu_cmpgt(low, spux_load(p->high + i)), behind = spu_cmpgt(t_min, high);
    const vmask already_hit = spu_cmpeq(spux_load_uint(p->prim + i), q->prim);
    const vmask inside = spu_or(spu_cmpgt(least, bound), spu_cmpgt(minus, most));
    const vmask nearer = spu_and(spu_cmpgt(spux_load(p->low + i), high), spu_cmpgt(low, t_min));
    f->low = low;
    f->high = high;
    f->certain_hit = spu_and(spu_and(inside, steep), nearer);
    f->undecided =
        spux_not(spu_or(spu_or(missed, already_hit), spu_or(spu_and(steep, spu_or(beyond, behind)), f->certain_hit)));
    return true;
}

/* The same for fast packets, without bounds: the signs decide. */
CGT_SPU_INLINE bool filter_triangle_rays_fast(const packet *p, const void *primitive, uint32_t i, bool common_origin,
                                              filter_result *f)
{
    const filter_triangle *q = primitive;
    const vfloat zero = spux_vfloat(0);
    vfloat w[3], num, den;
    filter_triangle_sides(p, q, i, common_origin, w);
    const vfloat least = spux_min(w[0], spux_min(w[1], w[2])), most = spux_max(w[0], spux_max(w[1], w[2]));
    const vmask hit = spu_or(spux_cmpge(least, zero), spux_cmpge(zero, most));
    if (!spux_any(hit))
        return false;
    filter_triangle_plane(p, q, i, common_origin, &num, &den);
    const vfloat t = spu_mul(num, spux_div(spux_vfloat(1), den));
    const vfloat sum = spu_add(w[0], spu_add(w[1], w[2]));
    /* all three may be 0 if the exact ones are small: then any finite shares will do */
    const vfloat divisor = spux_select(sum, spux_vfloat(1), spu_cmpeq(sum, zero));
    f->low = f->high = t;
    f->u = spux_div(w[1], divisor);
    f->v = spux_div(w[2], divisor);
    f->certain_hit = spu_and(hit, filter_fast_closer(p, i, t, q->prim));
    f->undecided = spux_mask_none();
    return true;
}

#endif
