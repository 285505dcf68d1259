/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shared by the filters of spheres and triangles: bounds of a packet's rays, the result of a test of a vector of rays,
 * the decision of the rays that a filter leaves undecided, and the loop over the packet's blocks. */
#ifndef CGT_PACKET_FILTER_H
#define CGT_PACKET_FILTER_H

#include "kernel/primitive/lane_tests.h"
#include "papers/kernel/packet/block_cones.h"

/* Bounds of the packet's rays. */
typedef struct filter_packet {
    float org[3];      /* the common origin, or the middle of the origins' box */
    float org_reach;   /* the largest 1-norm of an origin, seen from there */
    float reach[3];    /* the same along each axis */
    float rlength;     /* at least 1 / |d| of the shortest direction */
    float rlength_low; /* at most 1 / |d| of the longest direction; -infinity if hits behind an origin count */
    float longest;     /* at least the length of the longest direction */
    float share[3];    /* along each axis: the largest component of a direction over its length bound, rounded up */
    float scale;       /* a power of two that brings the scene's coordinates near 1 */
} filter_packet;

/* scale: the scene's. */
CGT_SPU_INLINE void filter_packet_init(const packet *p, float scale, filter_packet *f)
{
    vfloat most = spux_vfloat(0), least = spux_vfloat(INFINITY), t_min = least;
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        most = spux_max(most, spux_load(p->rdd + i));
        least = spux_min(least, spux_load(p->rdd + i));
        t_min = spux_min(t_min, spux_load(p->t_min + i));
    }
    f->rlength = SCALAR_SQRT(spux_hmax(most)) * (1 + 0x1p-18f);
    f->rlength_low =
        spux_hmin(t_min) < 0 ? -INFINITY : SCALAR_SQRT(spux_hmin(least)) * (1 - MIN_T_ERROR_SCALE * 0x1p-18f);
    f->scale = scale;
    f->longest = SCALAR_DIVIDE(1 + 0x1p-18f, SCALAR_SQRT(spux_hmin(least)));
    f->org_reach = 0;
    for (int a = 0; a < 3; a++) {
        vfloat largest = spux_vfloat(0);
        for (uint32_t i = 0; i < p->lanes; i += CGT_LANES)
            largest = spux_max(largest, spux_abs(spux_load(p->dir[a] + i)));
        f->share[a] = SCALAR_DIVIDE(spux_hmax(largest), f->longest) * (1 + 0x1p-18f);
        f->reach[a] = 0;
    }
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
        f->reach[a] = (h - l) * 0.5f * (1 + 0x1p-18f) + (h > -l ? h : -l) * 0x1p-22f;
        f->org_reach += f->reach[a];
    }
}

/* For each sphere of a vector, a t before which no ray hits it. The distance from the filter's origin to the surface is
 * at least `near`, if that is above 0: the sums are rounded 8 times each, and lose 2^-74 where squares underflow.
 * Where results are truncated, by 2^-23, 2^-20 still covers them: the square loses 5 (a difference 2, product, sums 2),
 * its root half of that and 4 of its own, the product with 1 - 2^-20 one more. Flushed squares make it less. */
CGT_SPU_INLINE void filter_min_t(const filter_packet *f, const float center[3][CGT_LANES],
                                 const float radius[CGT_LANES], float min_t[CGT_LANES])
{
    const vfloat r = spux_load(radius);
    vfloat distance = spux_vfloat(f->org_reach), square = spux_vfloat(0);
    for (int a = 0; a < 3; a++) {
        const vfloat c = spu_sub(spux_load(center[a]), spux_vfloat(f->org[a]));
        distance = spu_add(distance, spux_abs(c));
        square = spu_madd(c, c, square);
    }
    const vfloat near = spu_sub(spu_mul(spux_sqrt(square), spux_vfloat(1 - MIN_T_ERROR_SCALE * 0x1p-20f)),
                                spu_madd(spu_add(distance, r), spux_vfloat(MIN_T_ERROR_SCALE * 0x1p-20f),
                                         spu_add(r, spux_vfloat(f->org_reach + 0x1p-74f))));
    const vmask outside = spu_cmpgt(near, spux_vfloat(0));
    spux_store(min_t, spux_select(spux_vfloat(-INFINITY), spu_mul(near, spux_vfloat(f->rlength_low)), outside));
}

/* For triangles and rays without a common origin: the rays' Pluecker coordinates, seen from the filter's origin, and
 * each ray's own length in place of the longest one, since lengths may differ widely. */
CGT_SPU_INLINE void filter_moments_init(packet *p, filter_packet *f)
{
    vfloat share[3] = {spux_vfloat(0), spux_vfloat(0), spux_vfloat(0)};
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        vfloat from[3], d[3];
        const vfloat rlength = spu_mul(spux_sqrt(spux_load(p->rdd + i)), spux_vfloat(1 + 0x1p-18f));
        spux_store(p->length + i, spux_div(spux_vfloat(1 + 0x1p-17f), rlength));
        for (int a = 0; a < 3; a++) {
            from[a] = spu_sub(spux_load(p->org[a] + i), spux_vfloat(f->org[a]));
            d[a] = spu_mul(spux_load(p->dir[a] + i), spux_vfloat(f->scale));
            share[a] = spux_max(share[a], spu_mul(spux_abs(spux_load(p->dir[a] + i)), rlength));
            spux_store(p->from[a] + i, from[a]);
        }
        for (int a = 0; a < 3; a++) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            spux_store(p->moment[a] + i, spu_msub(from[b], d[c], spu_mul(from[c], d[b])));
        }
    }
    for (int a = 0; a < 3; a++)
        f->share[a] = spux_hmax(share[a]);
}

/* The result of a test of a vector of rays. */
typedef struct filter_result {
    vfloat low, high;  /* the interval of t; both are t where fast */
    vfloat u, v;       /* of triangles, where fast */
    vmask certain_hit; /* a hit, certainly in the range and nearer than the best */
    vmask undecided;   /* neither a certain hit nor a certain miss */
} filter_result;

/* As filter_decide; a program may leave the decision to the PPE. */
CGT_SPU_INLINE void packet_decide(const cgt_primitives *prims, packet *p, uint32_t i, uint32_t prim, cgt_counts *counts)
{
    if (!FILTER_DEFERS || (filter_may_hit(prims, p, i, prim) && !FILTER_DEFER(p, i, prim)))
        filter_decide(prims, p, i, prim, counts);
}

/* Tests rays i to i + CGT_LANES - 1 against one primitive. Returns false if all certainly miss. */
typedef bool filter_test(const packet *p, const void *primitive, uint32_t i, bool common_origin, filter_result *f);

/* How a packet is tested: constants where the loop below is instantiated. */
typedef struct filter_mode {
    bool common_origin;
    bool any_hit;
    bool decides;  /* not fast */
    bool store_uv; /* fast, triangles */
} filter_mode;

/* Calls `call` with a constant mode, so that each mode gets a loop of its own. uv: fast packets store u and v. A
 * program that has one mode alone defines it. */
#ifndef FILTER_FOR_MODE
#define FILTER_FOR_MODE(p, uv, call)                                                                                   \
    switch ((p)->fast << 2 | (p)->common_origin << 1 | (p)->any_hit) {                                                 \
    case 0: call(((filter_mode){false, false, true, false})); break;                                                   \
    case 1: call(((filter_mode){false, true, true, false})); break;                                                    \
    case 2: call(((filter_mode){true, false, true, false})); break;                                                    \
    case 3: call(((filter_mode){true, true, true, false})); break;                                                     \
    case 4: call(((filter_mode){false, false, false, uv})); break;                                                     \
    case 5: call(((filter_mode){false, true, false, false})); break;                                                   \
    case 6: call(((filter_mode){true, false, false, uv})); break;                                                      \
    default: call(((filter_mode){true, true, false, false})); break;                                                   \
    }
#endif

/* Stores the certain hits of a vector of rays. */
CGT_SPU_INLINE void filter_store(packet *p, uint32_t i, const filter_result *f, vuint prim, filter_mode mode)
{
    const vfloat no_hit = spux_vfloat(-INFINITY);
    spux_store(p->low + i, spux_select(spux_load(p->low + i), mode.any_hit ? no_hit : f->low, f->certain_hit));
    spux_store(p->high + i, spux_select(spux_load(p->high + i), mode.any_hit ? no_hit : f->high, f->certain_hit));
    spux_store_uint(p->prim + i, spux_select(spux_load_uint(p->prim + i), prim, f->certain_hit));
    if (mode.store_uv) {
        spux_store(p->u + i, spux_select(spux_load(p->u + i), f->u, f->certain_hit));
        spux_store(p->v + i, spux_select(spux_load(p->v + i), f->v, f->certain_hit));
    }
}

/* Decides the undecided rays of a block. They are rare: the test is repeated to find them, by one that looks closer, so
 * that the first test stays short. Returns whether any has become a certain hit. */
__attribute__((noinline, unused)) static bool filter_decide_block(const cgt_primitives *prims, packet *p,
                                                                  filter_test *again, const void *primitive,
                                                                  uint32_t prim, uint32_t first, uint32_t end,
                                                                  filter_mode mode, cgt_counts *counts)
{
    const filter_mode decides = {mode.common_origin, mode.any_hit, true, false};
    bool updated = false;
    filter_result f;
    for (uint32_t i = first; i < end; i += CGT_LANES) {
        if (!again(p, primitive, i, mode.common_origin, &f))
            continue;
        if (p->skips_prims)
            f.certain_hit = spu_andc(f.certain_hit, rays_skipping_one(prims, p, i, prim));
        filter_store(p, i, &f, spux_vuint(prim), decides);
        updated |= spux_any(f.certain_hit);
        for (unsigned remaining = spux_mask_bits(f.undecided); remaining; remaining &= remaining - 1)
            packet_decide(prims, p, i + (uint32_t)__builtin_ctz(remaining), prim, counts);
    }
    return updated;
}

/* Tests a vector of rays against a primitive; i is the first. again: the test of those that are undecided. */
CGT_SPU_INLINE void filter_vector(const cgt_primitives *prims, packet *p, filter_test *test, filter_test *again,
                                  const void *primitive, uint32_t prim, uint32_t i, filter_mode mode,
                                  cgt_counts *counts)
{
    filter_result f;
    counts->ray_tests += CGT_LANES;
    if (!test(p, primitive, i, mode.common_origin, &f))
        return;
    if (p->skips_prims)
        f.certain_hit = spu_andc(f.certain_hit, rays_skipping_one(prims, p, i, prim));
    filter_store(p, i, &f, spux_vuint(prim), mode);
    if (mode.decides && spux_any(f.undecided))
        filter_decide_block(prims, p, again, primitive, prim, i, i + CGT_LANES, mode, counts);
}

/* Tests the rays of the reached blocks (as bits) against a primitive. */
CGT_SPU_INLINE void filter_blocks(const cgt_primitives *prims, packet *p, filter_test *test, filter_test *again,
                                  const void *primitive, uint32_t prim, uint32_t reached, block_cones *blocks,
                                  filter_mode mode, cgt_counts *counts)
{
    const vuint number = spux_vuint(prim);
    const bool skips_prims = p->skips_prims;
    const vuint mask = spux_vuint(skips_prims ? skip_mask_of(prims, p, prim) : UINT32_MAX);
    for (; reached; reached &= reached - 1) {
        const uint32_t block = (uint32_t)__builtin_ctz(reached), first = block * BLOCK_RAYS, end = block_end(p, block);
        vmask undecided = spux_mask_none(), updated = undecided;
        filter_result f;
        counts->ray_tests += end - first;
        for (uint32_t i = first; i < end; i += CGT_LANES) {
            if (!test(p, primitive, i, mode.common_origin, &f))
                continue;
            if (skips_prims)
                f.certain_hit = spu_andc(f.certain_hit, rays_skipping(p, i, number, mask));
            filter_store(p, i, &f, number, mode);
            undecided = spu_or(undecided, f.undecided);
            updated = spu_or(updated, f.certain_hit);
        }
        bool nearer = spux_any(updated);
        if (mode.decides && spux_any(undecided))
            nearer |= filter_decide_block(prims, p, again, primitive, prim, first, end, mode, counts);
        if (nearer)
            block_update_far_t(p, blocks, block);
    }
}

/* In a fast packet: nearer than the best so far, or as near and of a lower id. t is in the ray's range, and finite. */
CGT_SPU_INLINE vmask filter_fast_closer(const packet *p, uint32_t i, vfloat t, vuint prim)
{
    const vfloat best = spux_load(p->high + i);
    const vmask lower = spu_cmpgt(spux_load_uint(p->prim + i), prim);
    const vmask inside = spu_and(spux_cmpge(t, spux_load(p->t_min + i)), spu_cmpgt(spux_vfloat(INFINITY), spux_abs(t)));
    return spu_and(inside, spu_or(spu_cmpgt(best, t), spu_and(spu_cmpeq(best, t), lower)));
}

/* Updates the closest hit of ray i with the primitives of the first `count` lanes. Lanes whose interval lies beyond the
 * closest hit are dropped, those before it replace it, the others are decided exactly. */
__attribute__((unused)) static void leaf_update_ray(const cgt_primitives *prims, packet *p, uint32_t i,
                                                    const lane_hits *q, const uint32_t *reference, uint32_t count,
                                                    cgt_counts *counts)
{
    const unsigned certain_hit = spux_mask_bits(q->certain_hit), used_lanes = CGT_ALL_LANES >> (CGT_LANES - count);
    const vmask possible = spu_andc(spu_or(q->certain_hit, q->undecided), spu_cmpgt(q->low, spux_vfloat(p->high[i])));
    _Alignas(64) float low[CGT_LANES], high[CGT_LANES];
    unsigned remaining = spux_mask_bits(possible) & used_lanes;
    if (!remaining)
        return;
    spux_store(low, q->low);
    spux_store(high, q->high);
    for (; remaining; remaining &= remaining - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(remaining);
        if (p->skips_prims && ray_skips(p, i, reference[k], skip_mask_of(prims, p, reference[k])))
            continue;
        if (!(certain_hit >> k & 1) || (high[k] >= p->low[i] && low[k] <= p->high[i])) {
            packet_decide(prims, p, i, reference[k], counts);
        } else if (high[k] < p->low[i]) {
            p->low[i] = p->any_hit ? -INFINITY : low[k];
            p->high[i] = p->any_hit ? -INFINITY : high[k];
            p->prim[i] = reference[k];
        }
    }
}

#endif
