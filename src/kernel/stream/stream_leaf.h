/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A leaf of the wide tree and a list of rays: lanes are rays, one primitive after the other. The tests are those of
 * lane_tests.h, in the normalised space of bvh_ray.h, where coordinates of the scene are at most 2, those of origins at
 * most STREAM_FAR, and |d| is from 1 to 2 sqrt(3). Their bounds grow with the distance from the origin and with the
 * primitive's size; here a leaf's primitives share them, by the leaf's box and by its largest primitive, so that they
 * are worked out once for a vector of rays and not for each primitive. */
#ifndef CGT_WIDE_STREAM_LEAF_H
#define CGT_WIDE_STREAM_LEAF_H

#include "kernel/stream/stream.h"

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

/* Primitives of a leaf that the octant's rays may reach. */
typedef struct leaf_members {
    uint8_t lane[16]; /* as many as a node's code may tell of */
    uint32_t count;
} leaf_members;

/* Of the leaf's first `count` those that are in reach; without a branch: what is left out is written over. */
CGT_SPU_INLINE void leaf_members_make(unsigned in_reach, uint32_t count, leaf_members *m)
{
    m->count = 0;
    for (uint32_t k = 0; k < count; k++) {
        m->lane[m->count] = (uint8_t)k;
        m->count += in_reach >> k & 1;
    }
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
    vfloat d[8];
    r->at = at;
    spux_load_records8_at(stream_record(s, RECORD_ORG), at, d);
    vfloat away = spux_vfloat(place->half);
    for (int a = 0; a < 3; a++) {
        r->org[a] = d[a];
        away = spu_add(away, spux_abs(spu_sub(spux_vfloat(place->middle[a]), d[a])));
    }
    /* 4 roundings of numbers below 64, and those of what the sphere test adds */
    r->away = spu_madd(away, spux_vfloat(0x1p-20f), away);
    r->near = d[3];
    for (int a = 0; a < 3; a++)
        r->dir[a] = d[4 + a];
    r->hit = spux_mask_none();
    if (any_hit) {
        r->far = d[7];
        r->hit = r->closed = spu_cmpeq(d[7], spux_vfloat(-INFINITY));
        return;
    }
    _Alignas(CGT_VECTOR_BYTES) uint32_t quarter[CGT_LANES];
    spux_store_uint(quarter, spu_sr(spux_load_uint(at), 2));
    spux_load_records4_at(&s->best[0].low, quarter, d);
    r->far_in = d[0];
    r->far = d[1];
    r->object = (vuint)d[2];
}

/* The inner ends of the range. */
CGT_SPU_INLINE void leaf_rays_narrow(leaf_rays *r, bool any_hit)
{
    const vfloat margin = spux_vfloat(0x1p-18f), least = spux_vfloat(0x1p-84f);
    r->near_in = spu_add(spu_madd(spux_abs(r->near), margin, r->near), least);
    if (any_hit)
        r->far_in = spu_sub(spu_nmsub(spux_abs(r->far), margin, r->far), least);
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
        wide_best best = {0, 0, CGT_INVALID_ID, 0};
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

/* Any hit: which primitives are open in each lane, a bit of each. */
CGT_SPU_INLINE vuint leaf_open_add(vuint open, uint32_t k, vmask lanes)
{
    static const uint32_t bit[16] = {1u << 0, 1u << 1, 1u << 2,  1u << 3,  1u << 4,  1u << 5,  1u << 6,  1u << 7,
                                     1u << 8, 1u << 9, 1u << 10, 1u << 11, 1u << 12, 1u << 13, 1u << 14, 1u << 15};
    return spux_select(open, spu_or(open, spux_vuint(bit[k])), lanes);
}

/* Those of any lane. */
CGT_SPU_INLINE uint32_t leaf_open_left(vuint open)
{
    _Alignas(CGT_VECTOR_BYTES) uint32_t left[CGT_LANES];
    uint32_t primitives = 0;
    if (__builtin_expect(spux_all(spu_cmpeq(open, spux_vuint(0))), 1))
        return 0;
    spux_store_uint(left, open);
    for (uint32_t k = 0; k < CGT_LANES; k++)
        primitives |= left[k];
    return primitives;
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

#endif
