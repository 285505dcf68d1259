/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles of a leaf of the BVH and a list of rays; see stream_leaf.h.
 *
 * Triangles. With g the first vertex from the origin, A at least [g], S_1 and S_2 the largest sums of the sizes of the
 * edges' components, |d| < 2, and N = e_2 x e_1 computed once per leaf
 *   c = g x d,  U = -e_2.c,  V = e_1.c,  D = d.N,  T = g.N,  W = D - U - V
 * are the terms of lane_tests.h, each a triple product: u for g, 2 u for an edge, 2 u for the cross product, 3 u for
 * the dot product, so that they are within 9 u of the sizes of their factors too. So all three sides share one bound,
 *   LANE_EPS_W 2 (A (S_1 + S_2) + S_1 S_2) + 2^-112,   D has LANE_EPS_PLANE 2 S_1 S_2 + 2^-116,
 * and T has LANE_EPS_PLANE S_1 S_2 A + 2^-112, with more than enough for what underflows, since A is below 2^7.
 * Any hit does not divide: with U, V, T and D made positive by the sign of D, t > t_min is T - t_min D > 0, within the
 * error of T and |t_min| times that of D; the roundings of the product and the difference vanish in what `near` and
 * `far` were widened by. If both ends hold by more than their errors, |D| is more than its own, so that its sign is
 * right. One product serves both ends of the near one's widening: |D| is at most 2 S_1 S_2.
 *   The sign of D is right too where the least of U, V and W is above their bound, since D is their sum. Where it is
 *   wrong,
 * D is within its error of 0, and of a line that passes inside U, V and W are no larger: so lines are out below the
 * bound of the sides and twice that of D. */
#ifndef CGT_STREAM_TRIANGLES_H
#define CGT_STREAM_TRIANGLES_H

#include "kernel/primitive/lane_vectors.h"
#include "kernel/stream/stream_lists.h"

/* The bounds that a leaf's triangles share, and the terms of each that are not in its block. */
typedef struct leaf_normals {
    _Alignas(CGT_VECTOR_BYTES) float normal[3][CGT_LANES]; /* N */
    float back[3][CGT_LANES];                              /* -e_2 */
    float sum[2];                                          /* S_1, S_2 */
} leaf_normals;

typedef struct leaf_triangle_bounds {
    vfloat side, minus_side; /* of U, V, W */
    vfloat den;              /* of D */
    vfloat num;              /* of T */
    vfloat first, last;      /* of T - t_min D and t_max D - T; any hit, and so are the next */
    vfloat outside;          /* of the least of U, V and W */
    vfloat before, inside;   /* T - near D of rays before their range, and of those inside */
} leaf_triangle_bounds;

CGT_SPU_INLINE void leaf_normals_init(const triangle_block *leaf, leaf_normals *p)
{
    vfloat e[2][3], n[3];
    for (int a = 0; a < 3; a++) {
        e[0][a] = spux_load(leaf->edge[0][a]);
        e[1][a] = spux_load(leaf->edge[1][a]);
        spux_store(p->back[a], spu_xor(e[1][a], spux_vfloat(-0.f)));
    }
    lane_cross(e[1], e[0], n);
    for (int a = 0; a < 3; a++)
        spux_store(p->normal[a], n[a]);
    p->sum[0] = spux_hmax(spux_load(leaf->sum[0]));
    p->sum[1] = spux_hmax(spux_load(leaf->sum[1]));
}

/* Bounds are moved outwards by more than their roundings, which are of the vertex and of the edges. */
CGT_SPU_INLINE unsigned leaf_reachable_triangles(const stream *s, const triangle_block *leaf)
{
    const vfloat zeros = spux_vfloat(0), grow = spux_vfloat(0x1p-20f);
    vfloat low[3], high[3];
    for (int a = 0; a < 3; a++) {
        const vfloat v = spux_load(leaf->vertex[a]), e = spux_load(leaf->edge[0][a]), f = spux_load(leaf->edge[1][a]);
        const vfloat below = spux_min(zeros, spux_min(e, f)), above = spux_max(zeros, spux_max(e, f));
        const vfloat margin = spu_mul(spu_add(spux_abs(v), spu_sub(above, below)), grow);
        low[a] = spu_add(spu_sub(v, margin), below);
        high[a] = spu_add(spu_add(v, margin), above);
    }
    return stream_reachable(s, low, high);
}

CGT_SPU_INLINE void leaf_triangle_bounds_init(const leaf_rays *r, const leaf_normals *p, bool any_hit,
                                              leaf_triangle_bounds *b)
{
    const float product = p->sum[0] * p->sum[1];
    const vfloat enlarge = spux_vfloat(1 + 0x1p-10f);
    b->side = spu_madd(r->distance, spux_vfloat(2 * LANE_EPS_W * (p->sum[0] + p->sum[1])),
                       spux_vfloat(2 * LANE_EPS_W * product + 0x1p-112f));
    b->minus_side = spu_xor(b->side, spux_vfloat(-0.f));
    b->den = spux_vfloat(2 * LANE_EPS_PLANE * product + 0x1p-116f);
    b->num = spu_madd(r->distance, spux_vfloat(LANE_EPS_PLANE * product), spux_vfloat(0x1p-112f));
    if (!any_hit)
        return;
    b->first = spu_mul(spu_madd(spux_abs(r->near), b->den, b->num), enlarge);
    b->last = spu_mul(spu_madd(spux_abs(r->far_in), b->den, b->num), enlarge);
    b->outside = spu_nmsub(b->den, spux_vfloat(2), b->minus_side);
    b->before = spu_xor(b->first, spux_vfloat(-0.f));
    b->inside = spu_madd(spu_sub(r->near_in, r->near), spux_vfloat(2.1f * product), b->first);
}

/* The terms of a triangle. */
typedef struct leaf_determinants {
    vfloat u, v, den, num; /* U, V, D, T */
} leaf_determinants;

CGT_SPU_INLINE leaf_determinants leaf_compute_determinants(const leaf_rays *r, const triangle_block *leaf,
                                                           const leaf_normals *p, uint32_t k)
{
    vfloat g[3], c[3], e[3], back[3], n[3];
    for (int a = 0; a < 3; a++) {
        g[a] = spu_sub(spux_vfloat(leaf->vertex[a][k]), r->org[a]);
        e[a] = spux_vfloat(leaf->edge[0][a][k]);
        back[a] = spux_vfloat(p->back[a][k]);
        n[a] = spux_vfloat(p->normal[a][k]);
    }
    lane_cross(g, r->dir, c);
    return (leaf_determinants){lane_dot(back, c), lane_dot(e, c), lane_dot(n, r->dir), lane_dot(n, g)};
}

/* Which side of its edges the lines pass. */
typedef struct leaf_sides {
    vmask inside, possible;
} leaf_sides;

CGT_SPU_INLINE leaf_sides leaf_compute_sides(const leaf_determinants *q, const leaf_triangle_bounds *b)
{
    const vfloat w = spu_sub(spu_sub(q->den, q->u), q->v);
    const vfloat least = spux_min(q->u, spux_min(q->v, w)), most = spux_max(q->u, spux_max(q->v, w));
    const vmask above = spu_cmpgt(most, b->side), below = spu_cmpgt(b->minus_side, least);
    return (leaf_sides){spu_or(spu_cmpgt(least, b->side), spu_cmpgt(b->minus_side, most)),
                        spux_not(spu_and(above, below))};
}

/* The triangles that any lane's line may pass inside of. */
CGT_SPU_INLINE uint32_t leaf_triangles_reached(const leaf_rays *r, const leaf_triangle_bounds *b,
                                               const triangle_block *leaf, const leaf_normals *p,
                                               const leaf_candidates *m)
{
    uint32_t reached = 0;
    for (uint32_t i = 0; i < m->count; i++) {
        const uint32_t k = m->lane[i];
        const leaf_determinants q = leaf_compute_determinants(r, leaf, p, k);
        reached |= (uint32_t)spux_any(leaf_compute_sides(&q, b).possible) << k;
    }
    return reached;
}

/* Any hit: most lanes are decided here. skips_prims: rays may skip triangles, but masks hide none. Returns the
 * triangles that others have left to decide. */
CGT_SPU_INLINE uint32_t leaf_triangles_any(leaf_rays *r, const leaf_triangle_bounds *b, const triangle_block *leaf,
                                           const leaf_normals *p, const leaf_candidates *m, bool unbounded,
                                           bool skips_prims)
{
    const vfloat minus = spux_vfloat(-0.f);
    vuint undecided = spux_vuint(0);
    for (uint32_t i = 0; i < m->count; i++) {
        const uint32_t k = m->lane[i];
        const leaf_determinants q = leaf_compute_determinants(r, leaf, p, k);
        const vfloat sign = spu_and(q.den, minus), den = spux_abs(q.den), num = spu_xor(q.num, sign);
        const vfloat u = spu_xor(q.u, sign), v = spu_xor(q.v, sign);
        const vfloat least = spux_min(spux_min(u, v), spu_sub(spu_sub(den, u), v));
        const vfloat after = spu_nmsub(r->near, den, num);
        vmask out = spu_cmpgt(b->before, after);
        vmask decided = spu_and(spu_cmpgt(least, b->side), spu_cmpgt(after, b->inside));
        if (!unbounded) {
            out = spu_or(out, spu_cmpgt(num, spu_madd(r->far, den, b->last)));
            decided = spu_and(decided, spu_cmpgt(spu_msub(r->far_in, den, num), b->last));
        }
        vmask missed = spu_or(spu_cmpgt(b->outside, least), spu_and(out, spu_cmpgt(den, b->den)));
        if (skips_prims) {
            const vmask skipped = spu_cmpeq(r->skip_prim, spux_vuint(leaf->prim[k]));
            missed = spu_or(missed, skipped);
            decided = spu_andc(decided, skipped);
        }
        r->hit = spu_or(r->hit, decided);
        undecided = leaf_undecided_add(undecided, k, spux_not(spu_or(missed, decided)));
    }
    return leaf_undecided_union(spux_select(undecided, spux_vuint(0), r->hit));
}

CGT_SPU_INLINE void leaf_triangle_any(const leaf_rays *r, const leaf_triangle_bounds *b, const leaf_determinants *q,
                                      const leaf_sides *sides, leaf_result *f)
{
    const vfloat minus = spux_vfloat(-0.f), sign = spu_and(q->den, minus);
    const vfloat den = spu_xor(q->den, sign), num = spu_xor(q->num, sign);
    const vmask steep = spu_cmpgt(den, b->den);
    const vmask out =
        spu_or(spu_cmpgt(spu_msub(r->near, den, b->first), num), spu_cmpgt(num, spu_madd(r->far, den, b->last)));
    f->possible = spu_andc(sides->possible, spu_and(out, steep));
    f->certain_hit = spu_and(sides->inside, spu_and(spu_cmpgt(spu_nmsub(r->near_in, den, num), b->first),
                                                    spu_cmpgt(spu_msub(r->far_in, den, num), b->last)));
}

CGT_SPU_INLINE void leaf_triangle_closest(const leaf_rays *r, const leaf_triangle_bounds *b, const leaf_determinants *q,
                                          const leaf_sides *sides, leaf_result *f)
{
    const vfloat rden = spux_div(spux_vfloat(1), q->den), t = spu_mul(q->num, rden), reach = spux_abs(t);
    const vfloat error = spu_mul(spu_madd(reach, b->den, b->num), spu_mul(spux_abs(rden), spux_vfloat(1.34f)));
    const vfloat width = spu_madd(reach, spux_vfloat(0x1p-20f), spu_add(error, spux_vfloat(0x1p-124f)));
    const vmask steep = spu_cmpgt(spux_abs(q->den), spu_mul(b->den, spux_vfloat(4)));
    f->low = spux_select(spux_vfloat(-INFINITY), spu_sub(t, width), steep);
    f->high = spux_select(spux_vfloat(INFINITY), spu_add(t, width), steep);
    f->possible = spu_and(sides->possible, spu_and(spux_cmpge(f->high, r->near), spux_cmpge(r->far, f->low)));
    f->certain_hit =
        spu_and(spu_and(sides->inside, steep), spu_and(spu_cmpgt(f->low, r->near_in), spu_cmpgt(r->far_in, f->high)));
}

/* ---- rays in the planes of triangles ---- */

/* Axes across which some triangle of a leaf may have no extent. */
typedef struct leaf_flat_axes {
    bool axis[3], any;
} leaf_flat_axes;

CGT_SPU_INLINE leaf_flat_axes leaf_find_flat_axes(const triangle_block *leaf)
{
    leaf_flat_axes f = {.any = false};
    for (int a = 0; a < 3; a++) {
        const vfloat size = spu_or(spux_load(leaf->edge[0][a]), spux_load(leaf->edge[1][a]));
        f.axis[a] = spux_any(spu_cmpeq(size, spux_vfloat(0)));
        f.any |= f.axis[a];
    }
    return f;
}

/* The rays of a vector that do not move along an axis, and those that are done. */
CGT_SPU_INLINE bool leaf_rays_are_still(const leaf_rays *r, int a)
{
    return spux_all(spu_or(spu_cmpeq(r->dir[a], spux_vfloat(0)), spu_cmpeq(r->far, spux_vfloat(-INFINITY))));
}

CGT_SPU_INLINE bool leaf_may_be_parallel(const leaf_rays *r, const leaf_flat_axes *flat)
{
    bool parallel = false;
    for (int a = 0; a < 3; a++)
        parallel = parallel || (flat->axis[a] && leaf_rays_are_still(r, a));
    return parallel;
}

/* Drops the triangles that all rays of a vector are parallel to (cgt_triangle_is_parallel): those of a floor, for rays
 * that run along it. What is 0 in normalised coordinates may have underflowed: the numbers of the caller decide. */
__attribute__((noinline, cold, unused)) static void leaf_drop_parallel(const stream *s, const leaf_rays *r,
                                                                       const leaf_candidates *from, leaf_candidates *to)
{
    leaf_given *g = r->given;
    const unsigned open = spux_mask_bits(spu_cmpgt(r->far, spux_vfloat(-INFINITY)));
    unsigned still[3];
    *to = *from;
    if (!open)
        return;
    if (!g->has_triangles)
        decide_gather_triangles(&s->call.committed_scene->prims, g->prim, &g->triangles);
    leaf_read_rays(s, r->offset, g->ray_lanes = open, &g->tests);
    g->has_triangles = true;
    for (int a = 0; a < 3; a++)
        still[a] = open & ~spux_mask_bits(spu_cmpeq(spux_load(g->tests.dir[a]), spux_vfloat(0))) ? 0 : CGT_ALL_LANES;
    const unsigned dropped = decide_find_parallel(&g->triangles, still);
    to->count = 0;
    for (uint32_t i = 0; i < from->count; i++) {
        to->lane[to->count] = from->lane[i];
        to->count += !(dropped >> from->lane[i] & 1);
    }
}

CGT_SPU_INLINE void leaf_stream_triangles(stream *s, const triangle_block *leaf, const leaf_candidates *candidates,
                                          const leaf_box *box, const uint32_t *list, uint32_t rays, bool any_hit,
                                          bool skips_prims, bool lists)
{
    const bool unbounded = s->unbounded, masked = skips_prims && s->call.mask;
    const leaf_flat_axes flat = leaf_find_flat_axes(leaf);
    const leaf_candidates *m;
    leaf_normals p;
    leaf_given given;
    given.prim = leaf->prim;
    given.has_triangles = false;
    leaf_normals_init(leaf, &p);
    for (uint32_t i = 0; i < rays; i += CGT_LANES) {
        leaf_candidates others;
        leaf_rays r;
        leaf_triangle_bounds b;
        uint32_t reached;
        leaf_rays_load(s, list + i, box, any_hit, skips_prims, &r);
        leaf_rays_narrow(s, &r, any_hit);
        given.ray_lanes = 0;
        r.given = &given;
        if (__builtin_expect(flat.any && leaf_may_be_parallel(&r, &flat), 0)) {
            leaf_drop_parallel(s, &r, candidates, &others);
            m = &others;
        } else
            m = candidates;
        leaf_triangle_bounds_init(&r, &p, any_hit, &b);
        if (!any_hit || masked)
            reached = leaf_triangles_reached(&r, &b, leaf, &p, m);
        else if (unbounded)
            reached = leaf_triangles_any(&r, &b, leaf, &p, m, true, skips_prims);
        else
            reached = leaf_triangles_any(&r, &b, leaf, &p, m, false, skips_prims);
        for (; reached; reached &= reached - 1) {
            const uint32_t k = (uint32_t)__builtin_ctz(reached);
            const leaf_determinants q = leaf_compute_determinants(&r, leaf, &p, k);
            const leaf_sides sides = leaf_compute_sides(&q, &b);
            leaf_result f;
            if (any_hit)
                leaf_triangle_any(&r, &b, &q, &sides, &f);
            else
                leaf_triangle_closest(&r, &b, &q, &sides, &f);
            if (lists)
                leaf_list_hits(s, &r, &f, leaf->prim[k], CGT_NEAR_SIDE);
            else
                leaf_update_hits(s, &r, &f, leaf->prim[k], any_hit, skips_prims);
        }
        if (lists)
            leaf_list_store(s, &r);
        else
            leaf_rays_store(s, &r, any_hit);
    }
}

#endif
