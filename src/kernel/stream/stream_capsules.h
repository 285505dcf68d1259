/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Capsules of a leaf of the BVH and a list of rays; see stream_leaf.h. The test is that of lane_capsules.h, which takes
 * as many operations as ten of others, and before it the short one of the line.
 *
 * Closest hits: lanes are rays, one capsule after the other that is left by any of them. Any hit: pairs of a ray and a
 * capsule that are left are listed, and lanes are pairs: of 16 rays mostly few come near to one capsule. A ray may then
 * be in several lanes; the first of them that hits ends it.
 */
#ifndef CGT_STREAM_CAPSULES_H
#define CGT_STREAM_CAPSULES_H

#include "kernel/primitive/lane_capsules.h"
#include "kernel/stream/stream_lists.h"

/* Those that the octant's rays may reach. Bounds are moved outwards by more than their roundings. */
CGT_SPU_INLINE unsigned leaf_reachable_capsules(const stream *s, const capsule_block *leaf)
{
    const vfloat grow = spux_vfloat(0x1p-20f), radius = spux_load(leaf->radius);
    vfloat low[3], high[3];
    for (int a = 0; a < 3; a++) {
        const vfloat p = spux_load(leaf->end[0][a]), q = spux_load(leaf->end[1][a]);
        const vfloat size = spu_add(spux_max(spux_abs(p), spux_abs(q)), radius);
        const vfloat reach = spu_madd(size, grow, spu_add(radius, spux_vfloat(0x1p-100f)));
        low[a] = spu_sub(spux_min(p, q), reach);
        high[a] = spu_add(spux_max(p, q), reach);
    }
    return stream_reachable(s, low, high);
}

/* What the short test takes of each capsule of a leaf. */
typedef struct leaf_strips {
    _Alignas(CGT_VECTOR_BYTES) float axis[3][CGT_LANES];
    float error[CGT_LANES];
    float square[CGT_LANES];
} leaf_strips;

CGT_SPU_INLINE void leaf_strips_init(const capsule_block *leaf, leaf_strips *x)
{
    vfloat p[3], q[3], n[3], error, square;
    for (int a = 0; a < 3; a++) {
        p[a] = spux_load(leaf->end[0][a]);
        q[a] = spux_load(leaf->end[1][a]);
    }
    lane_strip_init(p, q, spux_load(leaf->radius), n, &error, &square);
    for (int a = 0; a < 3; a++)
        spux_store(x->axis[a], n[a]);
    spux_store(x->error, error);
    spux_store(x->square, square);
}

/* The rays whose lines may meet capsule k. The leaf's box holds the ends of its capsules: A is that of the rays. */
CGT_SPU_INLINE vmask leaf_meets_strip(const leaf_rays *r, const capsule_block *leaf, const leaf_strips *x, uint32_t k)
{
    vfloat c[3], n[3];
    for (int a = 0; a < 3; a++) {
        c[a] = spu_sub(spux_vfloat(leaf->end[0][a][k]), r->org[a]);
        n[a] = spux_vfloat(x->axis[a][k]);
    }
    return lane_meets_strip(r->dir, c, n, spu_add(r->distance, spux_vfloat(leaf->radius[k])), spux_vfloat(x->error[k]),
                            spux_vfloat(x->square[k]));
}

CGT_SPU_INLINE lane_rays leaf_lane_rays(const stream *s, const leaf_rays *r)
{
    lane_rays ray;
    for (int a = 0; a < 3; a++) {
        ray.org[a] = r->org[a];
        ray.dir[a] = r->dir[a];
    }
    ray.t_min = r->near;
    ray.rdd = spux_div(spux_vfloat(1), lane_dot(r->dir, r->dir));
    ray.rlength = spux_vfloat(1); /* |d| is 1 or more */
    ray.org_error = spux_vfloat(s->call.org_error);
    return ray;
}

/* Certain hits are in the range. Returns false if all lanes certainly miss. */
CGT_SPU_INLINE bool leaf_capsule_test(const leaf_rays *r, const lane_rays *ray, const vfloat end[2][3], vfloat radius,
                                      leaf_result *f)
{
    lane_hits h;
    if (!lane_test_capsule_from(ray, end[0], end[1], radius, true, &h))
        return false;
    f->low = h.low;
    f->high = h.high;
    f->possible = spu_andc(spu_or(h.certain_hit, h.undecided), spu_cmpgt(h.low, r->far));
    f->certain_hit = spu_and(h.certain_hit, spu_and(spu_cmpgt(h.low, r->near_in), spu_cmpgt(r->far_in, h.high)));
    return true;
}

/* Lists both roots: what is not certain of both is decided once. f: of the test. */
CGT_SPU_INLINE void leaf_capsule_list(const stream *s, leaf_rays *r, const lane_rays *ray, const vfloat end[2][3],
                                      vfloat radius, const leaf_result *f, uint32_t prim)
{
    leaf_result left = {.low = spux_vfloat(0), .high = spux_vfloat(0)}, entered = *f, touched = *f;
    left.possible = left.certain_hit =
        lane_leave_capsule(ray, end[0], end[1], radius, f->certain_hit, &left.low, &left.high);
    entered.possible = entered.certain_hit = left.certain_hit;
    touched.possible = spu_andc(f->possible, left.certain_hit);
    touched.certain_hit = spux_mask_none();
    leaf_list_hits(s, r, &touched, prim, CGT_BOTH_SIDES);
    leaf_list_hits(s, r, &entered, prim, CGT_NEAR_SIDE);
    leaf_list_hits(s, r, &left, prim, CGT_FAR_SIDE);
}

/* ---- Closest hits ---- */

CGT_SPU_INLINE void leaf_capsules_closest(stream *s, const capsule_block *leaf, const leaf_strips *x,
                                          const leaf_candidates *m, const leaf_box *box, const uint32_t *list,
                                          uint32_t rays, bool skips_prims, bool lists)
{
    for (uint32_t i = 0; i < rays; i += CGT_LANES) {
        leaf_rays r;
        leaf_rays_load(s, list + i, box, false, skips_prims, &r);
        leaf_rays_narrow(s, &r, false);
        const lane_rays ray = leaf_lane_rays(s, &r);
        for (uint32_t j = 0; j < m->count; j++) {
            const uint32_t k = m->lane[j];
            vfloat end[2][3];
            leaf_result f;
            if (spux_none(leaf_meets_strip(&r, leaf, x, k)))
                continue;
            for (int e = 0; e < 2; e++)
                for (int a = 0; a < 3; a++)
                    end[e][a] = spux_vfloat(leaf->end[e][a][k]);
            const vfloat radius = spux_vfloat(leaf->radius[k]);
            if (!leaf_capsule_test(&r, &ray, (const vfloat(*)[3])end, radius, &f))
                continue;
            if (lists)
                leaf_capsule_list(s, &r, &ray, (const vfloat(*)[3])end, radius, &f, leaf->prim[k]);
            else
                leaf_update_hits(s, &r, &f, leaf->prim[k], false, skips_prims);
        }
        if (lists)
            leaf_list_store(s, &r);
        else
            leaf_rays_store(s, &r, false);
    }
}

/* ---- Any hit ---- */

/* Pairs of a ray, by its record's offset, and a capsule of the leaf. */
typedef struct leaf_pairs {
    uint32_t count;
    _Alignas(CGT_VECTOR_BYTES) uint32_t offset[2 * CGT_LANES], capsule[2 * CGT_LANES];
    uint32_t mask[CGT_LANES]; /* of each capsule's array, where rays have masks */
} leaf_pairs;

/* The pairs that skip their capsule. */
CGT_SPU_INLINE vmask leaf_skipping_pairs(const stream *s, const leaf_rays *r, const leaf_pairs *q, vint number,
                                         vuint prim)
{
    const vmask hidden = spu_cmpeq(r->skip_prim, prim);
    return s->call.mask ? spu_or(hidden, spu_cmpeq(spu_and(r->mask, spux_gather_uint(q->mask, number)), spux_vuint(0)))
                        : hidden;
}

/* Tests the first pairs, a vector of them. */
CGT_SPU_INLINE void leaf_test_pairs(stream *s, const capsule_block *leaf, const leaf_box *box, const leaf_pairs *q,
                                    bool skips_prims)
{
    const vint number = (vint)spux_load_uint(q->capsule);
    vfloat end[2][3];
    leaf_rays r;
    leaf_result f;
    leaf_rays_load(s, q->offset, box, true, skips_prims, &r);
    leaf_rays_narrow(s, &r, true);
    for (int e = 0; e < 2; e++)
        for (int a = 0; a < 3; a++)
            end[e][a] = spux_gather(leaf->end[e][a], number);
    const lane_rays ray = leaf_lane_rays(s, &r);
    if (!leaf_capsule_test(&r, &ray, (const vfloat(*)[3])end, spux_gather(leaf->radius, number), &f))
        return;
    if (skips_prims) {
        const vmask hidden = leaf_skipping_pairs(s, &r, q, number, spux_gather_uint(leaf->prim, number));
        f.certain_hit = spu_andc(f.certain_hit, hidden);
        f.possible = spu_andc(f.possible, hidden);
    }
    r.hit = spu_or(r.hit, f.certain_hit);
    const vmask is_ray = spux_not(spu_cmpeq(spux_load_uint(q->offset), spux_vuint(STREAM_DUMMY_RAY)));
    unsigned undecided = spux_mask_bits(spu_and(spu_andc(f.possible, r.hit), is_ray));
    unsigned hit = spux_mask_bits(spu_andc(r.hit, r.closed));
    for (; undecided; undecided &= undecided - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(undecided);
        hit |= leaf_decide_any(s, NULL, q->offset, 1u << k, leaf->prim[q->capsule[k]]);
    }
    for (; hit; hit &= hit - 1) {
        const uint32_t offset = q->offset[__builtin_ctz(hit)];
        if (stream_record(s, offset)[RECORD_FAR] != -INFINITY) /* another lane of the ray was first */
            stream_set_occluded(s, offset);
    }
}

CGT_SPU_INLINE void leaf_capsules_any(stream *s, const capsule_block *leaf, const leaf_strips *x,
                                      const leaf_candidates *m, const leaf_box *box, const uint32_t *list,
                                      uint32_t rays, bool skips_prims)
{
    const cgt_primitives *const prims = &s->call.committed_scene->prims;
    leaf_pairs q;
    q.count = 0;
    for (uint32_t j = 0; skips_prims && s->call.mask && j < m->count; j++)
        q.mask[m->lane[j]] = cgt_primitives_array(prims, leaf->prim[m->lane[j]])->mask;
    for (uint32_t i = 0; i < rays; i += CGT_LANES) {
        leaf_rays r;
        leaf_rays_load(s, list + i, box, true, skips_prims, &r);
        const vuint offset = spux_load_unaligned_uint(list + i);
        for (uint32_t j = 0; j < m->count; j++) {
            const uint32_t k = m->lane[j];
            const vmask near = spu_andc(leaf_meets_strip(&r, leaf, x, k), r.closed);
            spux_compress_store_uint(q.capsule + q.count, spux_vuint(k), near);
            q.count += spux_compress_store_uint(q.offset + q.count, offset, near);
            if (q.count < CGT_LANES)
                continue;
            leaf_test_pairs(s, leaf, box, &q, skips_prims);
            q.count -= CGT_LANES;
            spux_store_uint(q.offset, spux_load_uint(q.offset + CGT_LANES));
            spux_store_uint(q.capsule, spux_vuint(k));
        }
    }
    if (!q.count)
        return;
    for (; q.count < CGT_LANES; q.count++) {
        q.offset[q.count] = STREAM_DUMMY_RAY;
        q.capsule[q.count] = 0;
    }
    leaf_test_pairs(s, leaf, box, &q, skips_prims);
}

/* Not inlined: streams of spheres and triangles keep their registers. */
__attribute__((noinline, unused)) static void leaf_stream_capsules(stream *s, const capsule_block *leaf,
                                                                   const leaf_candidates *m, const leaf_box *box,
                                                                   const uint32_t *list, uint32_t rays, bool any_hit,
                                                                   bool skips_prims, bool lists)
{
    leaf_strips x;
    leaf_strips_init(leaf, &x);
    /* with constants, so that nothing is kept that is not used */
    if (any_hit && skips_prims)
        leaf_capsules_any(s, leaf, &x, m, box, list, rays, true);
    else if (any_hit)
        leaf_capsules_any(s, leaf, &x, m, box, list, rays, false);
    else if (lists)
        leaf_capsules_closest(s, leaf, &x, m, box, list, rays, false, true);
    else if (skips_prims)
        leaf_capsules_closest(s, leaf, &x, m, box, list, rays, true, false);
    else
        leaf_capsules_closest(s, leaf, &x, m, box, list, rays, false, false);
}

#endif
