/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A leaf of the wide tree and a list of rays: lanes are rays, one primitive after the other. The tests are those of
 * leaf_lanes.h, in the normalised space of wide_ray.h, where coordinates of the scene are at most 2, those of origins at
 * most STREAM_FAR, and |d| is from 1 to 2 sqrt(3). Their bounds grow with the distance from the origin and with the
 * primitive's size; here a leaf's primitives share them, by the leaf's box and by its largest primitive, so that they
 * are worked out once for a vector of rays and not for each primitive.
 *
 * Spheres. With A at least the sum of the sizes of the components of c, for each centre of the leaf, and r the largest
 * radius: eps and e0 of sphere_filter.h with A for |c|, and 1 for 1 / |d|. Any hit wants less than the nearest: where h
 * is more than 2 eps the line hits for certain, and the first root is between s - sqrt(h) / |d| - e0 and s + e0, whatever
 * the root's error; so it is in the range for certain where both of these are.
 *
 * Before that, which spheres a vector of rays may meet at all. With m the middle of the leaf's box, x = o + t d - m for a
 * t near the foot of m, p = c - m, and X = [x] + half >= |x| + |p|, X >= r, the ray's part within the range is nearest
 * to c at s = (p - x).d / d.d, brought into the range less t, and the square of the distance is there
 *   x.x + p.p - 2 p.x + s (s d.d - 2 (p - x).d).
 * x.d is left out: it is what t lost, 1.2 2^-20 A |d|. Where the ray does come as near as r, s |d| is at most 2.1 X, so
 * that roundings of the terms lose 66 u X^2 at most, x.d 2^-18 1.3 X A, the roundings of x and p, which move the line,
 * 4 u X A, and the error of s, which counts squared and times d.d, 2^-38 (X^2 + A^2). So
 *   E = X (256 u X + 128 u A) + (32 u A)^2
 * is enough. Ends of the range are moved outwards by 2^-21 of themselves; of a closed ray that leaves
 * -infinity or nothing that compares, so that it is left out. Beyond 2^63 the square is infinite: such rays pass far off.
 *
 * Triangles. With g the first vertex from the origin, A at least [g], S_1 and S_2 the largest sums of the sizes of the
 * edges' components, |d| < 2, and N = e_2 x e_1 made once a leaf
 *   c = g x d,  U = -e_2.c,  V = e_1.c,  D = d.N,  T = g.N,  W = D - U - V
 * are the terms of leaf_lanes.h, each a triple product: u for g, 2 u for an edge, 2 u for the cross product, 3 u for the
 * dot product, so that they are within 9 u of the sizes of their factors too. So all three sides share one bound,
 *   LANE_THIRD 2 (A (S_1 + S_2) + S_1 S_2) + 2^-112,   D has LANE_PLANE 2 S_1 S_2 + 2^-116,
 * and T has LANE_PLANE S_1 S_2 A + 2^-112, with more than enough for what underflows, since A is below 2^7.
 * Any hit does not divide: with T and D made positive by the sign of D, t > t_min is T - t_min D > 0, within the error of
 * T and |t_min| times that of D; the roundings of the product and the difference vanish in what `near` and `far` were
 * widened by. If both ends hold by more than their errors, |D| is more than its own, so that its sign is right. */
#ifndef CGT_WIDE_STREAM_LEAF_H
#define CGT_WIDE_STREAM_LEAF_H

#include "wide_stream.h"

/* Where a leaf is: its box's middle, and the sum of half its edges, enlarged by the roundings of both. */
typedef struct leaf_place {
    float middle[3], half;
} leaf_place;

CGT_SPU_INLINE leaf_place leaf_place_make(const wide_node *n, uint32_t child, float scale)
{
    leaf_place p;
    p.half = 0;
    for (int a = 0; a < 3; a++) {
        const float low = n->low[a][child] * scale, high = n->high[a][child] * scale;
        p.middle[a] = 0.5f * (low + high);
        p.half += 0.5f * (high - low);
    }
    p.half += 0x1p-18f; /* of coordinates up to 2, and the sums of what comes after */
    return p;
}

/* The rays of a vector. */
typedef struct leaf_rays {
    const uint32_t *at;
    vfloat org[3], dir[3];
    vfloat near, far;       /* outer ends of the range; far: of the best hit */
    vfloat near_in, far_in; /* inner ones; far_in: `low` of the best hit */
    vfloat away;            /* A */
    vuint object;           /* of the best hit */
    vmask hit;              /* any: rays that have one; nearest: rays that have another one */
    vmask closed;           /* any: those of them that had one before, and whatever fills up the list */
} leaf_rays;

CGT_SPU_INLINE void leaf_rays_load(stream *s, const uint32_t *at, const leaf_place *place, bool any_hit, leaf_rays *r)
{
    vfloat d[4];
    r->at = at;
    spux_load_records4_at(stream_record(s, RECORD_ORG), at, d);
    vfloat away = spux_vfloat(place->half);
    for (int a = 0; a < 3; a++) {
        r->org[a] = d[a];
        away = spu_add(away, spux_abs(spu_sub(spux_vfloat(place->middle[a]), d[a])));
    }
    /* 4 roundings of numbers below 64, and those of what the sphere test adds */
    r->away = spu_madd(away, spux_vfloat(0x1p-20f), away);
    r->near = d[3];
    r->near_in = spu_add(spu_madd(spux_abs(d[3]), spux_vfloat(0x1p-18f), d[3]), spux_vfloat(0x1p-84f));
    spux_load_records4_at(stream_record(s, RECORD_DIR), at, d);
    for (int a = 0; a < 3; a++)
        r->dir[a] = d[a];
    r->hit = spux_mask_none();
    if (any_hit) {
        r->far = d[3];
        r->far_in = spu_sub(spu_nmsub(spux_abs(d[3]), spux_vfloat(0x1p-18f), d[3]), spux_vfloat(0x1p-84f));
        r->hit = r->closed = spu_cmpeq(d[3], spux_vfloat(-INFINITY));
        return;
    }
    _Alignas(CGT_VECTOR_BYTES) uint32_t quarter[CGT_LANES];
    spux_store_uint(quarter, spu_sr(spux_load_uint(at), 2));
    spux_load_records4_at(&s->best[0].low, quarter, d);
    r->far_in = d[0];
    r->far = d[1];
    r->object = (vuint)d[2];
}

/* What tests found out about a primitive: low and high only of nearest hits. */
typedef struct leaf_found {
    vfloat low, high;
    vmask certain, may; /* may: certain ones too */
} leaf_found;

/* Lanes that do not see the object. */
CGT_SPU_INLINE vmask leaf_hidden(const stream *s, const leaf_rays *r, uint32_t object)
{
    unsigned hidden = 0;
    for (uint32_t k = 0; k < CGT_LANES; k++)
        if (r->at[k] != STREAM_NOBODY)
            hidden |= (unsigned)wide_hidden(&s->call, r->at[k] / STREAM_RECORD, object) << k;
    return spux_mask_from_bits(hidden);
}

/* Decides any-hit lanes; returns those that hit. */
__attribute__((noinline, cold, unused)) static unsigned leaf_decide_any(stream *s, const uint32_t *at, unsigned open,
                                                                        uint32_t object)
{
    unsigned hit = 0;
    for (; open; open &= open - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(open);
        wide_best best = {0, 0, CGT_NONE, 0};
        hit |= (unsigned)wide_decide(&s->call, at[k] / STREAM_RECORD, object, &best) << k;
    }
    return hit;
}

typedef struct leaf_best {
    _Alignas(CGT_VECTOR_BYTES) float low[CGT_LANES];
    float high[CGT_LANES];
    uint32_t object[CGT_LANES];
} leaf_best;

/* Decides nearest-hit lanes; returns those that have another best hit. */
__attribute__((noinline, cold, unused)) static unsigned
leaf_decide_nearest(stream *s, const uint32_t *at, unsigned open, uint32_t object, leaf_best *b)
{
    unsigned changed = 0;
    for (; open; open &= open - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(open);
        wide_best best = {b->low[k], b->high[k], b->object[k], 0};
        if (!wide_decide(&s->call, at[k] / STREAM_RECORD, object, &best))
            continue;
        b->low[k] = best.low;
        b->high[k] = best.high;
        b->object[k] = best.object;
        changed |= 1u << k;
    }
    return changed;
}

/* Takes what a test found out. */
CGT_SPU_INLINE void leaf_take(stream *s, leaf_rays *r, const leaf_found *f, uint32_t object, bool any_hit, bool hides)
{
    vmask certain = f->certain, may = f->may;
    if (hides) {
        const vmask hidden = leaf_hidden(s, r, object);
        certain = spu_andc(certain, hidden);
        may = spu_andc(may, hidden);
    }
    if (any_hit) {
        const vmask open = spu_andc(may, spu_or(certain, r->hit));
        r->hit = spu_or(r->hit, certain);
        if (__builtin_expect(spux_any(open), 0))
            r->hit = spu_or(r->hit, spux_mask_from_bits(leaf_decide_any(s, r->at, spux_mask_bits(open), object)));
        return;
    }
    const vmask open = spu_andc(may, certain);
    r->hit = spu_or(r->hit, certain);
    r->far_in = spux_select(r->far_in, f->low, certain);
    r->far = spux_select(r->far, f->high, certain);
    r->object = spux_select(r->object, spux_vuint(object), certain);
    if (__builtin_expect(spux_any(open), 0)) {
        leaf_best b;
        spux_store(b.low, r->far_in);
        spux_store(b.high, r->far);
        spux_store_uint(b.object, r->object);
        r->hit = spu_or(r->hit, spux_mask_from_bits(leaf_decide_nearest(s, r->at, spux_mask_bits(open), object, &b)));
        r->far_in = spux_load(b.low);
        r->far = spux_load(b.high);
        r->object = spux_load_uint(b.object);
    }
}

/* Back to the records. */
CGT_SPU_INLINE void leaf_rays_store(stream *s, const leaf_rays *r, bool any_hit)
{
    unsigned hit = spux_mask_bits(r->hit);
    leaf_best b;
    if (any_hit) {
        hit &= ~spux_mask_bits(r->closed);
        for (; hit; hit &= hit - 1)
            stream_close(s, r->at[__builtin_ctz(hit)]);
        return;
    }
    if (!hit)
        return;
    spux_store(b.low, r->far_in);
    spux_store(b.high, r->far);
    spux_store_uint(b.object, r->object);
    for (; hit; hit &= hit - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(hit);
        stream_keep(s, r->at[k], b.low[k], b.high[k], b.object[k]);
    }
}

/* ---- spheres ---- */

/* What all spheres of a leaf share, for a vector of rays. */
typedef struct leaf_sphere_bounds {
    vfloat scale, rdd, eps, certain;
    vfloat before, gap;                 /* of nearest hits */
    vfloat behind;                      /* far roots before this are out of the range */
    vfloat first_in, last_in, last_out; /* any: first roots in here are certain; beyond last_out they are out */
} leaf_sphere_bounds;

CGT_SPU_INLINE void leaf_sphere_bounds_make(const leaf_rays *r, float scale, float radius, vfloat rdd, bool any_hit,
                                            leaf_sphere_bounds *b)
{
    const vfloat most = spux_vfloat(radius), reach = spu_add(r->away, most);
    const vfloat wide = spu_mul(r->away, spux_vfloat(26 * FILTER_U));
    b->scale = spux_vfloat(scale);
    b->rdd = rdd;
    b->eps = spu_madd(spu_mul(most, spux_vfloat(9 * FILTER_U)), reach, spu_madd(wide, wide, spux_vfloat(0x1p-120f)));
    b->before = spu_madd(reach, spux_vfloat(18 * FILTER_U), spux_vfloat(0x1p-61f));
    b->behind = spu_sub(r->near, b->before);
    if (any_hit) {
        b->certain = spu_add(b->eps, b->eps);
        b->first_in = spu_add(r->near_in, b->before);
        b->last_in = spu_sub(r->far_in, b->before);
        b->last_out = spu_add(r->far, b->before);
        return;
    }
    b->certain = spu_mul(b->eps, spux_vfloat(17));
    b->gap = spu_madd(b->before, spux_vfloat(2), spu_mul(spux_sqrt(b->eps), spux_vfloat(0.27f)));
}

CGT_SPU_INLINE void leaf_sphere_test(const leaf_rays *r, const leaf_sphere_bounds *b, const wide_spheres *leaf,
                                     uint32_t k, float square, bool any_hit, leaf_found *f)
{
    vfloat c[3], l[3];
    for (int a = 0; a < 3; a++)
        c[a] = spu_msub(spux_vfloat(leaf->center[a][k]), b->scale, r->org[a]);
    const vfloat mid = spu_mul(lane_dot(r->dir, c), b->rdd), zero = spux_vfloat(0);
    for (int a = 0; a < 3; a++)
        l[a] = spu_nmsub(mid, r->dir[a], c[a]);
    const vfloat h = spu_sub(spu_add(spux_vfloat(square), b->eps), lane_dot(l, l));
    const vfloat half = spux_sqrt(spu_mul(spux_max(h, zero), b->rdd));
    const vmask meets = spu_and(spux_cmpge(h, zero), spux_cmpge(spu_add(mid, half), b->behind));
    const vmask surely = spu_cmpgt(h, b->certain);
    if (any_hit) {
        const vfloat low = spu_sub(mid, half);
        f->may = spu_and(meets, spux_cmpge(b->last_out, low));
        f->certain = spu_and(surely, spu_and(spu_cmpgt(low, b->first_in), spu_cmpgt(b->last_in, mid)));
        return;
    }
    f->low = spu_sub(spu_sub(mid, half), b->before);
    f->high = spu_add(f->low, b->gap);
    f->may = spu_and(meets, spux_cmpge(r->far, f->low));
    f->certain = spu_and(surely, spu_and(spu_cmpgt(f->low, r->near_in), spu_cmpgt(r->far_in, f->high)));
}

/* Centres from the middle of the leaf's box, for the first test. */
typedef struct leaf_balls {
    _Alignas(CGT_VECTOR_BYTES) float twice[3][CGT_LANES]; /* 2 p */
    float within[CGT_LANES];                              /* r^2 - p.p */
    float square[CGT_LANES];                              /* r^2 */
    float most;                                           /* the largest radius */
} leaf_balls;

CGT_SPU_INLINE void leaf_balls_make(const wide_spheres *leaf, const leaf_place *place, float scale, leaf_balls *q)
{
    const vfloat radius = spu_mul(spux_load(leaf->radius), spux_vfloat(scale)), square = spu_mul(radius, radius);
    vfloat p[3];
    for (int a = 0; a < 3; a++) {
        p[a] = spu_msub(spux_load(leaf->center[a]), spux_vfloat(scale), spux_vfloat(place->middle[a]));
        spux_store(q->twice[a], spu_add(p[a], p[a]));
    }
    spux_store(q->within, spu_sub(square, lane_dot(p, p)));
    spux_store(q->square, square);
    q->most = spux_hmax(radius);
}

/* Rays near a leaf: a point of each, near the middle of the leaf's box, and the part of the line that counts. */
typedef struct leaf_near {
    vfloat dir[3];
    vfloat back[3];     /* -x */
    vfloat square;      /* x.x - E */
    vfloat dd, half;    /* d.d, 1 / (2 d.d) */
    vfloat first, last; /* t from there */
} leaf_near;

CGT_SPU_INLINE vfloat leaf_near_make(const leaf_rays *r, const leaf_place *place, leaf_near *n)
{
    const vfloat grow = spux_vfloat(0x1p-21f);
    vfloat v[3];
    n->dd = lane_dot(r->dir, r->dir);
    const vfloat rdd = spux_div(spux_vfloat(1), n->dd);
    for (int a = 0; a < 3; a++)
        v[a] = spu_sub(spux_vfloat(place->middle[a]), r->org[a]);
    const vfloat t = spu_mul(lane_dot(v, r->dir), rdd);
    for (int a = 0; a < 3; a++) {
        n->dir[a] = r->dir[a];
        n->back[a] = spu_nmsub(t, r->dir[a], v[a]);
    }
    const vfloat reach = spu_add(lane_sum(n->back), spux_vfloat(place->half));
    const vfloat error = spu_madd(reach, spux_vfloat(256 * FILTER_U), spu_mul(r->away, spux_vfloat(128 * FILTER_U)));
    const vfloat second = spu_mul(r->away, spux_vfloat(32 * FILTER_U));
    n->square = spu_nmsub(second, second, spu_nmsub(reach, error, lane_dot(n->back, n->back)));
    n->half = spu_mul(rdd, spux_vfloat(0.5f));
    const vfloat first = spu_sub(r->near, t), last = spu_sub(r->far, t);
    n->first = spu_nmsub(spux_abs(first), grow, first);
    n->last = spu_madd(spux_abs(last), grow, last);
    return rdd;
}

/* Lanes whose part of the line may come as near to a centre as the radius. */
CGT_SPU_INLINE unsigned leaf_sphere_reached(const leaf_near *n, const leaf_balls *q, uint32_t k)
{
    vfloat p[3];
    for (int a = 0; a < 3; a++)
        p[a] = spux_vfloat(q->twice[a][k]);
    const vfloat along = lane_dot(p, n->dir);
    const vfloat t = spux_min(spux_max(spu_mul(along, n->half), n->first), n->last);
    const vfloat from = spu_madd(p[0], n->back[0], spu_madd(p[1], n->back[1], spu_madd(p[2], n->back[2], n->square)));
    return spux_mask_bits(spux_cmpge(spux_vfloat(q->within[k]), spu_madd(t, spu_msub(t, n->dd, along), from)));
}

CGT_SPU_INLINE void leaf_stream_spheres(stream *s, const wide_spheres *leaf, uint32_t count, const leaf_place *place,
                                        const uint32_t *list, uint32_t rays, bool any_hit, bool hides)
{
    const float scale = s->call.scale;
    leaf_balls q;
    leaf_balls_make(leaf, place, scale, &q);
    for (uint32_t i = 0; i < rays; i += CGT_LANES) {
        leaf_rays r;
        leaf_near n;
        leaf_rays_load(s, list + i, place, any_hit, &r);
        const vfloat rdd = leaf_near_make(&r, place, &n);
        /* first without branches, since few of them could be foretold */
        uint32_t reached = 0;
        for (uint32_t k = 0; k < count; k++)
            reached |= (uint32_t)(leaf_sphere_reached(&n, &q, k) != 0) << k;
        if (!reached)
            continue;
        leaf_sphere_bounds b;
        leaf_sphere_bounds_make(&r, scale, q.most, rdd, any_hit, &b);
        for (; reached; reached &= reached - 1) {
            const uint32_t k = (uint32_t)__builtin_ctz(reached);
            leaf_found f;
            leaf_sphere_test(&r, &b, leaf, k, q.square[k], any_hit, &f);
            leaf_take(s, &r, &f, leaf->object[k], any_hit, hides);
        }
        leaf_rays_store(s, &r, any_hit);
    }
}

/* ---- triangles ---- */

/* What a leaf's triangles have in common, and of each what the tests take beside the block's. */
typedef struct leaf_planes {
    _Alignas(CGT_VECTOR_BYTES) float normal[3][CGT_LANES]; /* N */
    float back[3][CGT_LANES];                              /* -e_2 */
    float sum[2];                                          /* S_1, S_2 */
} leaf_planes;

typedef struct leaf_triangle_bounds {
    vfloat side, minus_side; /* of U, V, W */
    vfloat den;              /* of D */
    vfloat num;              /* of T */
    vfloat first, last;      /* of T - t_min D and t_max D - T; any hit */
} leaf_triangle_bounds;

CGT_SPU_INLINE void leaf_planes_make(const wide_triangles *leaf, leaf_planes *p)
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

CGT_SPU_INLINE void leaf_triangle_bounds_make(const leaf_rays *r, const leaf_planes *p, bool any_hit,
                                              leaf_triangle_bounds *b)
{
    const float product = p->sum[0] * p->sum[1];
    const vfloat enlarge = spux_vfloat(1 + 0x1p-10f);
    b->side = spu_madd(r->away, spux_vfloat(2 * LANE_THIRD * (p->sum[0] + p->sum[1])),
                       spux_vfloat(2 * LANE_THIRD * product + 0x1p-112f));
    b->minus_side = spu_xor(b->side, spux_vfloat(-0.f));
    b->den = spux_vfloat(2 * LANE_PLANE * product + 0x1p-116f);
    b->num = spu_madd(r->away, spux_vfloat(LANE_PLANE * product), spux_vfloat(0x1p-112f));
    if (!any_hit)
        return;
    b->first = spu_mul(spu_madd(spux_abs(r->near), b->den, b->num), enlarge);
    b->last = spu_mul(spu_madd(spux_abs(r->far_in), b->den, b->num), enlarge);
}

/* Whether any lane's line may pass inside all edges. */
CGT_SPU_INLINE uint32_t leaf_triangle_reached(const leaf_rays *r, const leaf_triangle_bounds *b,
                                              const wide_triangles *leaf, const leaf_planes *p, uint32_t k)
{
    vfloat g[3], c[3], e[3], back[3], n[3];
    for (int a = 0; a < 3; a++) {
        g[a] = spu_sub(spux_vfloat(leaf->vertex[a][k]), r->org[a]);
        e[a] = spux_vfloat(leaf->edge[0][a][k]);
        back[a] = spux_vfloat(p->back[a][k]);
        n[a] = spux_vfloat(p->normal[a][k]);
    }
    lane_cross(g, r->dir, c);
    const vfloat u = lane_dot(back, c), v = lane_dot(e, c), w = spu_sub(spu_sub(lane_dot(n, r->dir), u), v);
    const vfloat least = spux_min(u, spux_min(v, w)), most = spux_max(u, spux_max(v, w));
    return !spux_all(spu_and(spu_cmpgt(most, b->side), spu_cmpgt(b->minus_side, least)));
}

/* The terms of a triangle. */
typedef struct leaf_terms {
    vfloat den, num;
    vmask inside, may;
} leaf_terms;

CGT_SPU_INLINE void leaf_triangle_terms(const leaf_rays *r, const leaf_triangle_bounds *b, const wide_triangles *leaf,
                                        const leaf_planes *p, uint32_t k, leaf_terms *f)
{
    vfloat g[3], c[3], e[3], back[3], n[3];
    for (int a = 0; a < 3; a++) {
        g[a] = spu_sub(spux_vfloat(leaf->vertex[a][k]), r->org[a]);
        e[a] = spux_vfloat(leaf->edge[0][a][k]);
        back[a] = spux_vfloat(p->back[a][k]);
        n[a] = spux_vfloat(p->normal[a][k]);
    }
    lane_cross(g, r->dir, c);
    const vfloat u = lane_dot(back, c), v = lane_dot(e, c);
    f->den = lane_dot(n, r->dir);
    f->num = lane_dot(n, g);
    const vfloat w = spu_sub(spu_sub(f->den, u), v);
    const vfloat least = spux_min(u, spux_min(v, w)), most = spux_max(u, spux_max(v, w));
    const vmask above = spu_cmpgt(most, b->side), below = spu_cmpgt(b->minus_side, least);
    f->may = spux_not(spu_and(above, below));
    f->inside = spu_or(spu_cmpgt(least, b->side), spu_cmpgt(b->minus_side, most));
}

CGT_SPU_INLINE void leaf_triangle_any(const leaf_rays *r, const leaf_triangle_bounds *b, const leaf_terms *q,
                                      leaf_found *f)
{
    const vfloat minus = spux_vfloat(-0.f), sign = spu_and(q->den, minus);
    const vfloat den = spu_xor(q->den, sign), num = spu_xor(q->num, sign);
    const vmask steep = spu_cmpgt(den, b->den);
    const vmask out =
        spu_or(spu_cmpgt(spu_msub(r->near, den, b->first), num), spu_cmpgt(num, spu_madd(r->far, den, b->last)));
    f->may = spu_andc(q->may, spu_and(out, steep));
    f->certain = spu_and(q->inside, spu_and(spu_cmpgt(spu_nmsub(r->near_in, den, num), b->first),
                                            spu_cmpgt(spu_msub(r->far_in, den, num), b->last)));
}

CGT_SPU_INLINE void leaf_triangle_nearest(const leaf_rays *r, const leaf_triangle_bounds *b, const leaf_terms *q,
                                          leaf_found *f)
{
    const vfloat rden = spux_div(spux_vfloat(1), q->den), t = spu_mul(q->num, rden), reach = spux_abs(t);
    const vfloat error = spu_mul(spu_madd(reach, b->den, b->num), spu_mul(spux_abs(rden), spux_vfloat(1.34f)));
    const vfloat width = spu_madd(reach, spux_vfloat(0x1p-20f), spu_add(error, spux_vfloat(0x1p-124f)));
    const vmask steep = spu_cmpgt(spux_abs(q->den), spu_mul(b->den, spux_vfloat(4)));
    f->low = spux_select(spux_vfloat(-INFINITY), spu_sub(t, width), steep);
    f->high = spux_select(spux_vfloat(INFINITY), spu_add(t, width), steep);
    f->may = spu_and(q->may, spu_and(spux_cmpge(f->high, r->near), spux_cmpge(r->far, f->low)));
    f->certain =
        spu_and(spu_and(q->inside, steep), spu_and(spu_cmpgt(f->low, r->near_in), spu_cmpgt(r->far_in, f->high)));
}

CGT_SPU_INLINE void leaf_stream_triangles(stream *s, const wide_triangles *leaf, uint32_t count,
                                          const leaf_place *place, const uint32_t *list, uint32_t rays, bool any_hit,
                                          bool hides)
{
    leaf_planes p;
    leaf_planes_make(leaf, &p);
    for (uint32_t i = 0; i < rays; i += CGT_LANES) {
        leaf_rays r;
        leaf_triangle_bounds b;
        leaf_rays_load(s, list + i, place, any_hit, &r);
        leaf_triangle_bounds_make(&r, &p, any_hit, &b);
        uint32_t reached = 0;
        for (uint32_t k = 0; k < count; k++)
            reached |= leaf_triangle_reached(&r, &b, leaf, &p, k) << k;
        for (; reached; reached &= reached - 1) {
            const uint32_t k = (uint32_t)__builtin_ctz(reached);
            leaf_terms q;
            leaf_found f;
            leaf_triangle_terms(&r, &b, leaf, &p, k, &q);
            if (any_hit)
                leaf_triangle_any(&r, &b, &q, &f);
            else
                leaf_triangle_nearest(&r, &b, &q, &f);
            leaf_take(s, &r, &f, leaf->object[k], any_hit, hides);
        }
        leaf_rays_store(s, &r, any_hit);
    }
}

#endif
