/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres of a leaf of the BVH and a list of rays; see stream_leaf.h.
 *
 * Spheres. With A at least the sum of the sizes of the components of c, for each centre of the leaf, and r the largest
 * radius: eps and e0 of sphere_filter.h with A for |c|, and 1 for 1 / |d|. Any hit needs less than the closest: where h
 * is more than 2 eps the line certainly hits, and the first root is between s - sqrt(h) / |d| - e0 and s + e0, whatever
 * the root's error; so it is certainly in the range where both of these are. Where h is more than 17 eps the second
 * root is between s + 0.93 sqrt(h) / |d| - e0, since the exact h is at least 15/17 of it, and s + sqrt(h) / |d| + e0.
 * Where these are in the range either root is the hit. Closest hits take the second root as in sphere_filter.h; what
 * lies before the outer end of the range is out of it.
 *
 * Before that, spheres that a vector of rays cannot meet are culled. With m the middle of the leaf's box, x = o + t d -
 * m for a t near the foot of m, p = c - m, and X = [x] + half >= |x| + |p|, X >= r, the ray's part within the range is
 * nearest to c at s = (p - x).d / d.d, brought into the range less t, and the square of the distance is there
 *   x.x + p.p - 2 p.x + s (s d.d - 2 (p - x).d).
 * d.d has its reciprocal from an estimate, within 2^-11. So t is off, by 2^-11 A at most, which is why x.d is kept, and
 * [x] no less than what is used of it; and so is s, which counts squared: 2^-22 X^2. Where the ray does come as near as
 * r, s |d| is at most 2.1 X, so that roundings of the terms lose 85 u X^2 at most. Those of m - o and of x move the
 * line, by 2.8 u A + u X: 6 u X A + 2 u X^2, and their square. So
 *   E = X (256 u X + 32 u A) + (32 u A)^2 + 2^-118
 * is more than enough. The last term is for products that underflow: each loses 2^-126 at most, and the sum has 11;
 * what s is multiplied with loses less where X is below 2^-40, and what X^2 covers where it is not. All squares of
 * small primitives underflow in a scene that reaches far. Ends of the range are moved outwards by 2^-21 of themselves;
 * of a closed ray that leaves -infinity or nothing that compares. Lengths are below 2^8 but for s at an end of the
 * range: where its square is infinite, the ray passes far off.
 *
 * Any hit: what is nearer than r by more than E' is inside the sphere, at a t that is in the range but for what its
 * ends were moved: w at the near one, so that in the range the distance is at most |d| w more, where |d| < 3.47, and
 *   E' = E + w (8 X + 16 w);
 * 2^-21 of s at an end, less than 36 u X^2, is in E. A line that is inside goes out again. So there is a root in the
 * range where that has no end; else where s is before the range's inner end and the ray is outside of the sphere there.
 * Far from the sphere that distance's error grows only with itself. The first test leaves few lanes undecided.
 *
 * Closest hits among large spheres that overlap: rays begin inside of most, and each would need its second root. A
 * sphere that is nearer than r by more than E at both ends of the range holds all between, since it is convex, and is
 * not hit there. */
#ifndef CGT_STREAM_SPHERES_H
#define CGT_STREAM_SPHERES_H

#include "kernel/primitive/lane_vectors.h"
#include "kernel/stream/stream_lists.h"

#define LEAF_LEAST_HALF 0.93f
#define LEAF_CROWD 5 /* times the largest radius: leaves below this many hold spheres that overlap. Measured. */

/* The bounds that all spheres of a leaf share, for a vector of rays. */
typedef struct leaf_sphere_bounds {
    vfloat scale, rdd, eps, certain_hit;
    vfloat t_error, t_width;            /* of closest hits */
    vfloat behind;                      /* far roots before this are out of the range */
    vfloat first_in, last_in, last_out; /* any: first roots in here are certain; beyond last_out they are out */
} leaf_sphere_bounds;

CGT_SPU_INLINE void leaf_sphere_bounds_init(const leaf_rays *r, float scale, float radius, vfloat rdd, bool any_hit,
                                            leaf_sphere_bounds *b)
{
    const vfloat most = spux_vfloat(radius), reach = spu_add(r->distance, most);
    const vfloat eps_c = spu_mul(r->distance, spux_vfloat(26 * FILTER_ROUNDOFF));
    b->scale = spux_vfloat(scale);
    b->rdd = rdd;
    b->eps = spu_madd(spu_mul(most, spux_vfloat(9 * FILTER_ROUNDOFF)), reach,
                      spu_madd(eps_c, eps_c, spux_vfloat(0x1p-120f)));
    b->t_error = spu_madd(reach, spux_vfloat(18 * FILTER_ROUNDOFF), spux_vfloat(0x1p-61f));
    b->behind = spu_sub(r->near, b->t_error);
    if (any_hit) {
        b->certain_hit = spu_add(b->eps, b->eps);
        b->first_in = spu_add(r->near_in, b->t_error);
        b->last_in = spu_sub(r->far_in, b->t_error);
        b->last_out = spu_add(r->far, b->t_error);
        return;
    }
    b->certain_hit = spu_mul(b->eps, spux_vfloat(17));
    b->t_width = spu_madd(b->t_error, spux_vfloat(2), spu_mul(spux_sqrt(b->eps), spux_vfloat(0.27f)));
}

/* The part of the lines that a sphere holds. */
typedef struct leaf_sphere_chord {
    vfloat mid, half; /* t, less and plus half */
    vfloat depth;     /* h */
    vmask met;        /* not missed, nor passed before the range */
} leaf_sphere_chord;

CGT_SPU_INLINE leaf_sphere_chord leaf_compute_chord(const leaf_rays *r, const leaf_sphere_bounds *b,
                                                    const sphere_block *leaf, uint32_t k, float square)
{
    const vfloat zero = spux_vfloat(0);
    leaf_sphere_chord q;
    vfloat c[3], l[3];
    for (int a = 0; a < 3; a++)
        c[a] = spu_msub(spux_vfloat(leaf->center[a][k]), b->scale, r->org[a]);
    q.mid = spu_mul(lane_dot(r->dir, c), b->rdd);
    for (int a = 0; a < 3; a++)
        l[a] = spu_nmsub(q.mid, r->dir[a], c[a]);
    q.depth = spu_sub(spu_add(spux_vfloat(square), b->eps), lane_dot(l, l));
    q.half = spux_sqrt(spu_mul(spux_max(q.depth, zero), b->rdd));
    q.met = spu_and(spux_cmpge(q.depth, zero), spux_cmpge(spu_add(q.mid, q.half), b->behind));
    return q;
}

/* second: looks at second roots, too. */
CGT_SPU_INLINE void leaf_sphere_roots(const leaf_rays *r, const leaf_sphere_bounds *b, const sphere_block *leaf,
                                      uint32_t k, float square, bool any_hit, bool second, leaf_result *f)
{
    const leaf_sphere_chord q = leaf_compute_chord(r, b, leaf, k, square);
    const vfloat mid = q.mid, half = q.half;
    const vmask above_certain = spu_cmpgt(q.depth, b->certain_hit);
    if (any_hit) {
        const vfloat low = spu_sub(mid, half);
        f->possible = spu_and(q.met, spux_cmpge(b->last_out, low));
        f->certain_hit = spu_and(above_certain, spu_and(spu_cmpgt(low, b->first_in), spu_cmpgt(b->last_in, mid)));
        if (second) {
            const vfloat least = spu_madd(half, spux_vfloat(LEAF_LEAST_HALF), mid), most = spu_add(mid, half);
            const vmask two_roots = spu_cmpgt(q.depth, spu_mul(b->certain_hit, spux_vfloat(8.5f)));
            f->certain_hit =
                spu_or(f->certain_hit,
                       spu_and(two_roots, spu_and(spu_cmpgt(least, b->first_in), spu_cmpgt(b->last_in, most))));
        }
        return;
    }
    f->low = spu_sub(spu_sub(mid, half), b->t_error);
    f->high = spu_add(f->low, b->t_width);
    f->possible = spu_and(q.met, spux_cmpge(r->far, f->low));
    f->certain_hit = spu_and(above_certain, spu_and(spu_cmpgt(f->low, r->near_in), spu_cmpgt(r->far_in, f->high)));
    if (second) {
        const vmask undecided = spu_andc(f->possible, f->certain_hit);
        const vfloat end = spu_add(spu_add(mid, half), b->t_error);
        const vmask later =
            filter_second_root(spu_and(above_certain, undecided), r->near, end, b->t_width, &f->low, &f->high);
        const vmask counts = spu_and(spu_cmpgt(f->low, r->near_in), spu_cmpgt(r->far_in, f->high));
        f->certain_hit = spu_or(f->certain_hit, spu_and(later, counts));
        f->possible = spu_andc(f->possible, spu_and(later, spu_cmpgt(f->low, r->far)));
    }
}

/* Lists both roots, or decides where the line may only touch. */
CGT_SPU_INLINE void leaf_sphere_list(stream *s, leaf_rays *r, const leaf_sphere_bounds *b, const sphere_block *leaf,
                                     uint32_t k, float square)
{
    const leaf_sphere_chord q = leaf_compute_chord(r, b, leaf, k, square);
    const vmask two_roots = spu_and(q.met, spu_cmpgt(q.depth, b->certain_hit));
    const vfloat end = spu_add(spu_add(q.mid, q.half), b->t_error);
    leaf_result f;
    f.low = spu_sub(spu_sub(q.mid, q.half), b->t_error);
    f.high = end;
    f.possible = spu_andc(q.met, two_roots);
    f.certain_hit = spux_mask_none();
    leaf_list_hits(s, r, &f, leaf->prim[k], CGT_BOTH_SIDES);
    f.high = spu_add(f.low, b->t_width);
    f.possible = spu_and(two_roots, spux_cmpge(f.high, r->near));
    f.certain_hit = f.possible;
    leaf_list_hits(s, r, &f, leaf->prim[k], CGT_NEAR_SIDE);
    f.low = spu_sub(end, b->t_width);
    f.high = end;
    f.possible = f.certain_hit = two_roots;
    leaf_list_hits(s, r, &f, leaf->prim[k], CGT_FAR_SIDE);
}

/* Lanes that the first root leaves undecided: by the second one, then exactly. */
__attribute__((noinline, cold)) static void leaf_sphere_again(stream *s, leaf_rays *r, const leaf_sphere_bounds *b,
                                                              const sphere_block *leaf, uint32_t k, float square,
                                                              const vmask *undecided, bool any_hit, bool skips_prims)
{
    leaf_result f;
    leaf_sphere_roots(r, b, leaf, k, square, any_hit, true, &f);
    f.possible = spu_and(f.possible, *undecided);
    f.certain_hit = spu_and(f.certain_hit, *undecided);
    leaf_update_hits(s, r, &f, leaf->prim[k], any_hit, skips_prims);
}

/* Tests sphere k of a leaf and updates the rays. */
CGT_SPU_INLINE void leaf_sphere_test(stream *s, leaf_rays *r, const leaf_sphere_bounds *b, const sphere_block *leaf,
                                     uint32_t k, float square, bool any_hit, bool skips_prims)
{
    leaf_result f;
    leaf_sphere_roots(r, b, leaf, k, square, any_hit, false, &f);
    const vmask undecided = leaf_update_certain(s, r, &f, leaf->prim[k], any_hit, skips_prims);
    if (__builtin_expect(spux_any(undecided), 0)) {
        /* copies, so that the originals may stay in registers */
        leaf_rays rays = *r;
        const leaf_sphere_bounds bounds = *b;
        leaf_sphere_again(s, &rays, &bounds, leaf, k, square, &undecided, any_hit, skips_prims);
        *r = rays;
    }
}

/* Bounds are moved outwards by more than their roundings. */
CGT_SPU_INLINE unsigned leaf_reachable_spheres(const stream *s, const sphere_block *leaf)
{
    const vfloat scale = spux_vfloat(s->call.scale), grow = spux_vfloat(0x1p-20f);
    const vfloat radius = spu_mul(spux_load(leaf->radius), scale);
    vfloat low[3], high[3];
    for (int a = 0; a < 3; a++) {
        const vfloat c = spu_mul(spux_load(leaf->center[a]), scale);
        const vfloat reach = spu_madd(spu_add(spux_abs(c), radius), grow, radius);
        low[a] = spu_sub(c, reach);
        high[a] = spu_add(c, reach);
    }
    return stream_reachable(s, low, high);
}

/* Centres from the middle of the leaf's box, for the first test. */
typedef struct leaf_sphere_terms {
    _Alignas(CGT_VECTOR_BYTES) float twice[3][CGT_LANES]; /* 2 p */
    float within[CGT_LANES];                              /* r^2 - p.p */
    float square[CGT_LANES];                              /* r^2 */
    float most;                                           /* the largest radius */
} leaf_sphere_terms;

CGT_SPU_INLINE void leaf_sphere_terms_init(const sphere_block *leaf, const leaf_box *box, float scale,
                                           leaf_sphere_terms *q)
{
    const vfloat radius = spu_mul(spux_load(leaf->radius), spux_vfloat(scale)), square = spu_mul(radius, radius);
    vfloat p[3];
    for (int a = 0; a < 3; a++) {
        p[a] = spu_msub(spux_load(leaf->center[a]), spux_vfloat(scale), spux_vfloat(box->middle[a]));
        spux_store(q->twice[a], spu_add(p[a], p[a]));
    }
    spux_store(q->within, spu_sub(square, lane_dot(p, p)));
    spux_store(q->square, square);
    q->most = spux_hmax(radius);
}

/* Rays near a leaf: a point of each, near the middle of the leaf's box, and the part of the line that counts. */
typedef struct leaf_foot {
    vfloat back[3];     /* -x */
    vfloat behind;      /* -2 x.d */
    vfloat least, most; /* x.x - E, x.x + E' */
    vfloat dd, half;    /* d.d, 1 / (2 d.d) */
    vfloat foot;        /* t */
    vfloat first, last; /* ends of the range less t */
    vfloat last_in;     /* any hit: the inner end */
} leaf_foot;

CGT_SPU_INLINE void leaf_foot_init(const stream *s, const leaf_rays *r, const leaf_box *box, leaf_foot *n)
{
    const vfloat grow = spux_vfloat(0x1p-21f);
    vfloat v[3];
    n->dd = lane_dot(r->dir, r->dir);
    n->half = spu_mul(spu_re(n->dd), spux_vfloat(0.5f));
    for (int a = 0; a < 3; a++)
        v[a] = spu_sub(spux_vfloat(box->middle[a]), r->org[a]);
    const vfloat along = lane_dot(v, r->dir), t = spu_mul(spu_add(along, along), n->half);
    for (int a = 0; a < 3; a++)
        n->back[a] = spu_nmsub(t, r->dir[a], v[a]);
    const vfloat behind = lane_dot(n->back, r->dir), square = lane_dot(n->back, n->back);
    const vfloat reach = spu_add(lane_sum(n->back), spux_vfloat(box->half));
    const vfloat lost =
        spu_madd(reach, spux_vfloat(256 * FILTER_ROUNDOFF), spu_mul(r->distance, spux_vfloat(32 * FILTER_ROUNDOFF)));
    const vfloat second = spu_mul(r->distance, spux_vfloat(32 * FILTER_ROUNDOFF));
    const vfloat error = spu_madd(reach, lost, spu_madd(second, second, spux_vfloat(0x1p-118f)));
    const vfloat narrow = spu_madd(spux_abs(r->near), spux_vfloat(0x1p-18f), spux_vfloat(s->call.range_error[0]));
    const vfloat widening = spu_madd(narrow, spux_vfloat(16), spu_mul(reach, spux_vfloat(8)));
    n->foot = t;
    n->behind = spu_add(behind, behind);
    n->least = spu_sub(square, error);
    n->most = spu_madd(widening, narrow, spu_add(square, error));
    const vfloat first = spu_sub(r->near, t), last = spu_sub(r->far, t);
    n->first = spu_nmsub(spux_abs(first), grow, first);
    n->last = spu_madd(spux_abs(last), grow, last);
}

CGT_SPU_INLINE void leaf_foot_narrow(const stream *s, leaf_rays *r, leaf_foot *n)
{
    leaf_rays_narrow(s, r, true);
    const vfloat last = spu_sub(r->far_in, n->foot);
    n->last_in = spu_nmsub(spux_abs(last), spux_vfloat(0x1p-21f), last);
}

/* Where a sphere is from the rays. */
typedef struct leaf_sphere_offset {
    vfloat along; /* 2 (p - x).d */
    vfloat from;  /* r^2 - p.p + 2 p.x */
    vfloat t;     /* s */
    vfloat depth; /* x.x + r^2, less the square of the distance */
} leaf_sphere_offset;

CGT_SPU_INLINE leaf_sphere_offset leaf_compute_offset(const leaf_rays *r, const leaf_foot *n,
                                                      const leaf_sphere_terms *q, uint32_t k)
{
    leaf_sphere_offset b;
    vfloat p[3];
    for (int a = 0; a < 3; a++)
        p[a] = spux_vfloat(q->twice[a][k]);
    b.along = spu_madd(p[0], r->dir[0], spu_madd(p[1], r->dir[1], spu_madd(p[2], r->dir[2], n->behind)));
    b.from = spux_vfloat(q->within[k]);
    for (int a = 0; a < 3; a++)
        b.from = spu_nmsub(p[a], n->back[a], b.from);
    b.t = spux_min(spux_max(spu_mul(b.along, n->half), n->first), n->last);
    b.depth = spu_nmsub(b.t, spu_msub(b.t, n->dd, b.along), b.from);
    return b;
}

/* Lists the spheres that any lane's part of the line may meet: branchless, since the branches would be mispredicted. */
CGT_SPU_INLINE uint32_t leaf_spheres_reached(const leaf_rays *r, const leaf_foot *n, const leaf_sphere_terms *q,
                                             const leaf_candidates *m)
{
    uint32_t reached = 0;
    for (uint32_t i = 0; i < m->count; i++) {
        const uint32_t k = m->lane[i];
        const leaf_sphere_offset b = leaf_compute_offset(r, n, q, k);
        reached |= (uint32_t)(spux_mask_bits(spux_cmpge(b.depth, n->least)) != 0) << k;
    }
    return reached;
}

/* Lists the spheres that hold the whole part of the line in every lane that may meet them. */
__attribute__((noinline, cold)) static uint32_t leaf_spheres_around(const leaf_rays *r, const leaf_foot *n,
                                                                    const leaf_sphere_terms *q, uint32_t reached)
{
    uint32_t around = 0;
    for (; reached; reached &= reached - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(reached);
        const leaf_sphere_offset b = leaf_compute_offset(r, n, q, k);
        const vfloat first = spu_nmsub(n->first, spu_msub(n->first, n->dd, b.along), b.from);
        const vfloat last = spu_nmsub(n->last, spu_msub(n->last, n->dd, b.along), b.from);
        const vmask inside = spu_and(spu_cmpgt(first, n->most), spu_cmpgt(last, n->most));
        around |= (uint32_t)spux_none(spu_andc(spux_cmpge(b.depth, n->least), inside)) << k;
    }
    return around;
}

/* Any hit: most lanes are decided here. skips_prims: rays may skip spheres, but masks hide none. Returns the spheres
 * that others have left to decide. */
CGT_SPU_INLINE uint32_t leaf_spheres_any(leaf_rays *r, const leaf_foot *n, const leaf_sphere_terms *q,
                                         const sphere_block *leaf, const leaf_candidates *m, bool unbounded,
                                         bool skips_prims)
{
    vuint undecided = spux_vuint(0);
    for (uint32_t i = 0; i < m->count; i++) {
        const uint32_t k = m->lane[i];
        const leaf_sphere_offset b = leaf_compute_offset(r, n, q, k);
        vmask possible = spux_cmpge(b.depth, n->least), decided = spu_cmpgt(b.depth, n->most);
        if (!unbounded) {
            const vfloat end = spu_nmsub(n->last_in, spu_msub(n->last_in, n->dd, b.along), b.from);
            decided = spu_and(decided, spu_and(spu_cmpgt(n->last_in, b.t), spu_cmpgt(n->least, end)));
        }
        if (skips_prims) {
            const vmask skipped = spu_cmpeq(r->skip_prim, spux_vuint(leaf->prim[k]));
            possible = spu_andc(possible, skipped);
            decided = spu_andc(decided, skipped);
        }
        r->hit = spu_or(r->hit, decided);
        undecided = leaf_undecided_add(undecided, k, spu_andc(possible, decided));
    }
    return leaf_undecided_union(spux_select(undecided, spux_vuint(0), r->hit));
}

CGT_SPU_INLINE void leaf_stream_spheres(stream *s, const sphere_block *leaf, const leaf_candidates *m,
                                        const leaf_box *box, const uint32_t *list, uint32_t rays, bool any_hit,
                                        bool skips_prims, bool lists)
{
    const float scale = s->call.scale;
    const bool unbounded = s->unbounded, masked = skips_prims && s->call.mask;
    leaf_sphere_terms q;
    leaf_sphere_terms_init(leaf, box, scale, &q);
    const bool is_crowd = box->half < LEAF_CROWD * q.most;
    for (uint32_t i = 0; i < rays; i += CGT_LANES) {
        leaf_rays r;
        leaf_foot n;
        uint32_t reached;
        leaf_rays_load(s, list + i, box, any_hit, skips_prims, &r);
        leaf_foot_init(s, &r, box, &n);
        if (!any_hit || masked)
            reached = leaf_spheres_reached(&r, &n, &q, m);
        else if (unbounded)
            reached = leaf_spheres_any(&r, &n, &q, leaf, m, true, skips_prims);
        else {
            leaf_foot_narrow(s, &r, &n);
            reached = leaf_spheres_any(&r, &n, &q, leaf, m, false, skips_prims);
        }
        if (!any_hit && __builtin_expect(reached && is_crowd, 0)) {
            /* copies, so that the originals may stay in registers */
            const leaf_rays rays_here = r;
            const leaf_foot foot = n;
            reached &= ~leaf_spheres_around(&rays_here, &foot, &q, reached);
        }
        if (reached) {
            leaf_sphere_bounds b;
            leaf_rays_narrow(s, &r, any_hit);
            leaf_sphere_bounds_init(&r, scale, q.most, spux_div(spux_vfloat(1), n.dd), any_hit, &b);
            for (; reached; reached &= reached - 1) {
                const uint32_t k = (uint32_t)__builtin_ctz(reached);
                if (lists)
                    leaf_sphere_list(s, &r, &b, leaf, k, q.square[k]);
                else
                    leaf_sphere_test(s, &r, &b, leaf, k, q.square[k], any_hit, skips_prims);
            }
        }
        if (lists)
            leaf_list_store(s, &r);
        else
            leaf_rays_store(s, &r, any_hit);
    }
}

#endif
