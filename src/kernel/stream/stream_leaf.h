/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A leaf of the BVH and a list of rays: lanes are rays, one primitive after the other. The tests are those of
 * lane_tests.h, in the normalised space of bvh_ray.h, where coordinates of the scene are at most 2, those of origins at
 * most STREAM_MAX_ORG, and |d| is from 1 to 2 sqrt(3). Their bounds grow with the distance from the origin and with the
 * primitive's size; here a leaf's primitives share them, by the leaf's box and by its largest primitive, so that they
 * are computed once for a vector of rays, not for each primitive. */
#ifndef CGT_STREAM_LEAF_H
#define CGT_STREAM_LEAF_H

#include "kernel/primitive/decide_lanes.h"
#include "kernel/stream/stream.h"

/* Where a leaf is: its box's middle, and the sum of half its edges, enlarged by the roundings of both. */
typedef struct leaf_box {
    float middle[3], half;
} leaf_box;

CGT_SPU_INLINE leaf_box leaf_box_init(const bvh_node *n, uint32_t child, float scale)
{
    leaf_box p;
    float magnitude = 0x1p-100f; /* denormal products */
    p.half = 0;
    for (int a = 0; a < 3; a++) {
        const float low = n->low[a][child] * scale, high = n->high[a][child] * scale;
        p.middle[a] = 0.5f * (low + high);
        p.half += 0.5f * (high - low);
        magnitude += fabsf(low) + fabsf(high);
    }
    p.half += magnitude * 0x1p-20f; /* five roundings of it at most, by 2^-24 */
    return p;
}

/* Primitives of a leaf that the octant's rays may reach. */
typedef struct leaf_candidates {
    uint8_t lane[16]; /* as many as a code can count */
    uint32_t count;
} leaf_candidates;

/* Lists those of the leaf's first `count` that are in reach; branchless: those that are not are overwritten. */
CGT_SPU_INLINE void leaf_candidates_init(unsigned in_reach, uint32_t count, leaf_candidates *m)
{
    m->count = 0;
    for (uint32_t k = 0; k < count; k++) {
        m->lane[m->count] = (uint8_t)k;
        m->count += in_reach >> k & 1;
    }
}

/* A leaf's triangles and a vector of rays as the caller described them, read when a test is first left undecided. */
typedef struct leaf_given {
    const uint32_t *prim; /* of the leaf */
    bool has_triangles;
    unsigned ray_lanes; /* whose rays were read */
    decide_triangles triangles;
    decide_tests tests;
} leaf_given;

/* The rays of a vector. */
typedef struct leaf_rays {
    const uint32_t *offset;
    leaf_given *given; /* NULL: spheres */
    vfloat org[3], dir[3];
    vfloat near, far;       /* outer ends of the range; far: of the best hit */
    vfloat near_in, far_in; /* inner ones; far_in: `low` of the best hit */
    vfloat distance;        /* A */
    vuint prim;             /* of the best hit */
    vuint skip_prim, mask;  /* as of bvh_call, where rays skip primitives */
    vmask hit;              /* any: rays that have one; nearest: rays that have another one */
    vmask closed;           /* any: those of them that had one before, and whatever fills up the list */
} leaf_rays;

CGT_SPU_INLINE void leaf_rays_load(stream *s, const uint32_t *offset, const leaf_box *box, bool any_hit,
                                   bool skips_prims, leaf_rays *r)
{
    vfloat d[8];
    r->offset = offset;
    r->given = NULL;
    spux_load_records8_at(stream_record(s, RECORD_ORG), offset, d);
    vfloat distance = spux_vfloat(box->half + s->call.org_error);
    for (int a = 0; a < 3; a++) {
        r->org[a] = d[a];
        distance = spu_add(distance, spux_abs(spu_sub(spux_vfloat(box->middle[a]), d[a])));
    }
    /* 4 roundings of numbers below 64, and those of what the sphere test adds */
    r->distance = spu_madd(distance, spux_vfloat(0x1p-20f), distance);
    r->near = d[3];
    for (int a = 0; a < 3; a++)
        r->dir[a] = d[4 + a];
    r->hit = spux_mask_none();
    if (skips_prims) {
        const vint number = (vint)spu_sr(spux_load_uint(offset), STREAM_RECORD_BITS);
        r->skip_prim = spux_gather_uint(s->skip_prim, number);
        r->mask = s->call.mask ? spux_gather_uint(s->mask, number) : spux_vuint(UINT32_MAX);
    }
    if (any_hit) {
        r->far = d[7];
        r->hit = r->closed = spu_cmpeq(d[7], spux_vfloat(-INFINITY));
        return;
    }
    _Alignas(CGT_VECTOR_BYTES) uint32_t quarter[CGT_LANES];
    spux_store_uint(quarter, spu_sr(spux_load_uint(offset), 2));
    spux_load_records4_at(&s->best[0].low, quarter, d);
    r->far_in = d[0];
    r->far = d[1];
    r->prim = (vuint)d[2];
}

/* The inner ends of the range. */
CGT_SPU_INLINE void leaf_rays_narrow(const stream *s, leaf_rays *r, bool any_hit)
{
    const vfloat margin = spux_vfloat(0x1p-18f);
    const float *least = s->call.range_error;
    r->near_in = spu_add(spu_madd(spux_abs(r->near), margin, r->near), spux_vfloat(least[0]));
    if (any_hit)
        r->far_in = spu_sub(spu_nmsub(spux_abs(r->far), margin, r->far), spux_vfloat(least[1]));
}

/* Result of a test of one primitive; low and high only for closest hits. */
typedef struct leaf_result {
    vfloat low, high;
    vmask certain_hit, possible; /* possible: certain ones included */
} leaf_result;

/* Returns the lanes whose rays skip the primitive. */
CGT_SPU_INLINE vmask leaf_skipping_rays(const stream *s, const leaf_rays *r, uint32_t prim)
{
    const bvh_call *c = &s->call;
    vmask hidden = spu_cmpeq(r->skip_prim, spux_vuint(prim));
    if (c->mask) {
        const vuint mask = spux_vuint(cgt_primitives_array(&c->committed_scene->prims, prim)->mask);
        hidden = spu_or(hidden, spu_cmpeq(spu_and(r->mask, mask), spux_vuint(0)));
    }
    return hidden;
}

/* Sets the rays of `lanes` as the caller described them. The other lanes, which may have none, repeat one of those. */
CGT_SPU_INLINE void leaf_read_rays(const stream *s, const uint32_t *offset, unsigned lanes, decide_tests *q)
{
    const bvh_call *c = &s->call;
    const ray_source *source = c->source;
    const cgt_rays *rays = source->rays;
    const uint32_t first = offset[__builtin_ctz(lanes)] / STREAM_RECORD;
    const vuint all = spu_sr(spux_load_unaligned_uint(offset), STREAM_RECORD_BITS);
    const vuint number = spux_select(spux_vuint(first), all, spux_mask_from_bits(lanes));
    if (!ray_source_is_dense(source) || source->light) {
        _Alignas(CGT_VECTOR_BYTES) uint32_t of[CGT_LANES];
        spux_store_uint(of, number);
        for (uint32_t k = 0; k < CGT_LANES; k++) {
            const cgt_ray ray = bvh_input_ray(c, of[k]);
            decide_set_ray(q, k, &ray);
        }
        return;
    }
    for (int a = 0; a < 3; a++) {
        spux_store(q->org[a], spux_gather(rays->org[a] + c->first, (vint)number));
        spux_store(q->dir[a], spux_gather(rays->dir[a] + c->first, (vint)number));
    }
    const vfloat t_min = rays->t_min ? spux_gather(rays->t_min + c->first, (vint)number) : spux_vfloat(0);
    spux_store(q->t_min, spux_max(t_min, spux_vfloat(-FLT_MAX)));
    spux_store(q->t_max, rays->t_max ? spux_gather(rays->t_max + c->first, (vint)number) : spux_vfloat(source->t_max));
}

/* Sets the rays of `lanes` and the triangle, from what the leaf has read so far. */
CGT_SPU_INLINE void leaf_set_tests(const stream *s, leaf_given *g, const uint32_t *offset, unsigned lanes,
                                   uint32_t prim)
{
    decide_tests *q = &g->tests;
    if (!g->has_triangles)
        decide_gather_triangles(&s->call.committed_scene->prims, g->prim, &g->triangles);
    if (lanes & ~g->ray_lanes)
        leaf_read_rays(s, offset, g->ray_lanes |= lanes, q);
    g->has_triangles = true;
    const uint32_t k = (uint32_t)__builtin_ctz(spux_mask_bits(spu_cmpeq(spux_load_uint(g->prim), spux_vuint(prim))));
    for (int i = 0; i < 3; i++)
        for (int a = 0; a < 3; a++)
            spux_store(q->triangle.v[i][a], spux_vfloat(g->triangles.v[i][a][k]));
    q->lanes = lanes;
    q->any_hit = s->call.any_hit;
    q->is_free = CGT_ALL_LANES;
    q->has_rival = 0;
}

/* Decides several any-hit lanes at once. Returns those that are left to decide, and adds to *hit. */
__attribute__((noinline, cold, unused)) static unsigned leaf_decide_any_lanes(const stream *s, leaf_given *g,
                                                                              const uint32_t *offset, unsigned lanes,
                                                                              uint32_t prim, unsigned *hit)
{
    decide_results r;
    leaf_set_tests(s, g, offset, lanes, prim);
    CGT_KERNEL(cgt_decide_lanes)(&g->tests, &r);
    *hit |= r.hit & lanes;
    s->call.counts->double_tests += spux_count_bits(lanes & (r.hit | r.missed) & r.in_double);
    return lanes & ~(r.hit | r.missed);
}

/* Decides any-hit lanes; returns those that hit. */
__attribute__((noinline, cold, unused)) static unsigned
leaf_decide_any(stream *s, leaf_given *g, const uint32_t *offset, unsigned undecided, uint32_t prim)
{
    unsigned hit = 0;
    if (g && spux_count_bits(undecided) >= DECIDE_MIN_LANES)
        undecided = leaf_decide_any_lanes(s, g, offset, undecided, prim, &hit);
    for (; undecided; undecided &= undecided - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(undecided);
        best_hit best = {0, 0, CGT_INVALID_ID, 0};
        hit |= (unsigned)bvh_decide(&s->call, offset[k] / STREAM_RECORD, prim, &best) << k;
    }
    return hit;
}

typedef struct leaf_best {
    _Alignas(CGT_VECTOR_BYTES) float low[CGT_LANES];
    float high[CGT_LANES];
    uint32_t prim[CGT_LANES];
} leaf_best;

/* Decides several closest-hit lanes at once. Returns those that are left to decide, and adds to *updates. */
__attribute__((noinline, cold, unused)) static unsigned leaf_decide_closest_lanes(const stream *s, leaf_given *g,
                                                                                  const uint32_t *offset,
                                                                                  unsigned lanes, uint32_t prim,
                                                                                  leaf_best *b, unsigned *updates)
{
    const cgt_primitives *prims = &s->call.committed_scene->prims;
    const vuint best = spux_load_uint(b->prim), none = spux_vuint(CGT_INVALID_ID);
    const vmask is_free = spu_cmpeq(best, none);
    _Alignas(CGT_VECTOR_BYTES) uint32_t rival[CGT_LANES];
    decide_tests *q = &g->tests;
    decide_results r;
    lanes &= ~spux_mask_bits(spu_cmpeq(best, spux_vuint(prim)));
    if (!lanes || prims->triangles != prims->count)
        return lanes;
    leaf_set_tests(s, g, offset, lanes, prim);
    q->is_free = spux_mask_bits(is_free);
    q->has_rival = ~q->is_free & lanes;
    q->is_first = spux_mask_bits(spu_cmpgt(best, spux_vuint(prim)));
    if (q->has_rival) {
        spux_store_uint(rival, spux_select(best, spux_vuint(prim), is_free));
        decide_gather_triangles(prims, rival, &q->best);
    }
    CGT_KERNEL(cgt_decide_lanes)(q, &r);
    s->call.counts->double_tests += spux_count_bits(lanes & (r.hit | r.missed) & r.in_double);
    *updates |= r.hit & lanes;
    for (unsigned hit = r.hit & lanes; hit; hit &= hit - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(hit);
        best_hit closer = {.prim = prim};
        const cgt_ray ray = {.line = {.org = {q->org[0][k], q->org[1][k], q->org[2][k]},
                                      .dir = {q->dir[0][k], q->dir[1][k], q->dir[2][k]}},
                             .t_min = q->t_min[k],
                             .t_max = q->t_max[k]};
        bvh_set_best(&s->call, &ray, r.t[k], &closer);
        b->low[k] = closer.low;
        b->high[k] = closer.high;
        b->prim[k] = prim;
    }
    return lanes & ~(r.hit | r.missed);
}

/* Decides closest-hit lanes; returns those that have another best hit. */
__attribute__((noinline, cold, unused)) static unsigned
leaf_decide_closest(stream *s, leaf_given *g, const uint32_t *offset, unsigned undecided, uint32_t prim, leaf_best *b)
{
    const cgt_primitives *prims = &s->call.committed_scene->prims;
    unsigned updates = 0;
    if (spux_count_bits(undecided) >= DECIDE_MIN_LANES) {
        if (g)
            undecided = leaf_decide_closest_lanes(s, g, offset, undecided, prim, b, &updates);
        else if (prims->spheres == prims->count)
            undecided = CGT_KERNEL(cgt_decide_copies)(prims, spux_load_uint(b->prim), spux_vuint(prim), undecided);
    }
    for (; undecided; undecided &= undecided - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(undecided);
        best_hit best = {b->low[k], b->high[k], b->prim[k], 0};
        if (!bvh_decide(&s->call, offset[k] / STREAM_RECORD, prim, &best))
            continue;
        b->low[k] = best.low;
        b->high[k] = best.high;
        b->prim[k] = best.prim;
        updates |= 1u << k;
    }
    return updates;
}

/* Updates the rays by the certain hits of a test. Returns the lanes that are undecided. */
CGT_SPU_INLINE vmask leaf_update_certain(const stream *s, leaf_rays *r, const leaf_result *f, uint32_t prim,
                                         bool any_hit, bool skips_prims)
{
    vmask certain_hit = f->certain_hit, possible = f->possible;
    if (skips_prims) {
        const vmask hidden = leaf_skipping_rays(s, r, prim);
        certain_hit = spu_andc(certain_hit, hidden);
        possible = spu_andc(possible, hidden);
    }
    if (any_hit) {
        const vmask undecided = spu_andc(possible, spu_or(certain_hit, r->hit));
        r->hit = spu_or(r->hit, certain_hit);
        return undecided;
    }
    r->hit = spu_or(r->hit, certain_hit);
    r->far_in = spux_select(r->far_in, f->low, certain_hit);
    r->far = spux_select(r->far, f->high, certain_hit);
    r->prim = spux_select(r->prim, spux_vuint(prim), certain_hit);
    return spu_andc(possible, certain_hit);
}

/* Decides the undecided lanes and updates their rays. The record that fills up lists hits nothing, but a test of an
 * endless interval leaves even that undecided, and the caller has no such ray. */
CGT_SPU_INLINE void leaf_decide_lanes(stream *s, leaf_rays *r, vmask undecided, uint32_t prim, bool any_hit)
{
    leaf_best b;
    undecided = spu_andc(undecided, spu_cmpeq(spux_load_unaligned_uint(r->offset), spux_vuint(STREAM_DUMMY_RAY)));
    if (spux_none(undecided))
        return;
    if (any_hit) {
        r->hit = spu_or(r->hit,
                        spux_mask_from_bits(leaf_decide_any(s, r->given, r->offset, spux_mask_bits(undecided), prim)));
        return;
    }
    spux_store(b.low, r->far_in);
    spux_store(b.high, r->far);
    spux_store_uint(b.prim, r->prim);
    r->hit = spu_or(
        r->hit, spux_mask_from_bits(leaf_decide_closest(s, r->given, r->offset, spux_mask_bits(undecided), prim, &b)));
    r->far_in = spux_load(b.low);
    r->far = spux_load(b.high);
    r->prim = spux_load_uint(b.prim);
}

/* Updates the rays by the result of a test. */
CGT_SPU_INLINE void leaf_update_hits(stream *s, leaf_rays *r, const leaf_result *f, uint32_t prim, bool any_hit,
                                     bool skips_prims)
{
    const vmask undecided = leaf_update_certain(s, r, f, prim, any_hit, skips_prims);
    if (__builtin_expect(spux_any(undecided), 0))
        leaf_decide_lanes(s, r, undecided, prim, any_hit);
}

/* Any hit: adds a primitive's bit in the lanes that leave it undecided. */
CGT_SPU_INLINE vuint leaf_undecided_add(vuint undecided, uint32_t k, vmask lanes)
{
    static const uint32_t bit[16] = {1u << 0, 1u << 1, 1u << 2,  1u << 3,  1u << 4,  1u << 5,  1u << 6,  1u << 7,
                                     1u << 8, 1u << 9, 1u << 10, 1u << 11, 1u << 12, 1u << 13, 1u << 14, 1u << 15};
    return spux_select(undecided, spu_or(undecided, spux_vuint(bit[k])), lanes);
}

/* Returns the primitives that are undecided in any lane. */
CGT_SPU_INLINE uint32_t leaf_undecided_union(vuint undecided)
{
    _Alignas(CGT_VECTOR_BYTES) uint32_t remaining[CGT_LANES];
    uint32_t primitives = 0;
    if (__builtin_expect(spux_all(spu_cmpeq(undecided, spux_vuint(0))), 1))
        return 0;
    spux_store_uint(remaining, undecided);
    for (uint32_t k = 0; k < CGT_LANES; k++)
        primitives |= remaining[k];
    return primitives;
}

/* Stores the rays back to the records. */
CGT_SPU_INLINE void leaf_rays_store(stream *s, const leaf_rays *r, bool any_hit)
{
    unsigned hit = spux_mask_bits(r->hit);
    leaf_best b;
    if (any_hit) {
        hit &= ~spux_mask_bits(r->closed);
        for (; hit; hit &= hit - 1)
            stream_set_occluded(s, r->offset[__builtin_ctz(hit)]);
        return;
    }
    if (!hit)
        return;
    spux_store(b.low, r->far_in);
    spux_store(b.high, r->far);
    spux_store_uint(b.prim, r->prim);
    for (; hit; hit &= hit - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(hit);
        stream_set_best(s, r->offset[k], b.low[k], b.high[k], b.prim[k]);
    }
}

#endif
