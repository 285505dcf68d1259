/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Hits of a leaf that go into the lists of rays (query/hit_list.h), in place of the best one: what a test finds for
 * certain, in the range, is listed by its interval, and the rest is decided. A list's end is the ray's. */
#ifndef CGT_STREAM_LISTS_H
#define CGT_STREAM_LISTS_H

#include "kernel/stream/stream_leaf.h"
#include "query/hit_list.h"

/* Lists the hits of some lanes; returns where the rays end then. */
__attribute__((noinline, unused)) static vfloat leaf_list_lanes(const stream *s, const uint32_t *offset, unsigned lanes,
                                                                unsigned certain, vfloat at[3], uint32_t prim,
                                                                unsigned sides)
{
    _Alignas(CGT_VECTOR_BYTES) float low[CGT_LANES], high[CGT_LANES], far[CGT_LANES];
    spux_store(low, at[0]);
    spux_store(high, at[1]);
    spux_store(far, at[2]);
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(lanes);
        cgt_hit_list *list = s->list[offset[k] / STREAM_RECORD];
        if (cgt_hit_list_skips(list, prim))
            continue;
        if (certain >> k & 1) {
            cgt_listed_hit h = {.low = low[k], .high = high[k], .prim = prim, .far = sides == CGT_FAR_SIDE};
            cgt_hit_list_insert(list, &h);
        } else
            cgt_hit_list_decide(list, prim, sides);
        far[k] = cgt_hit_list_end(list, far[k]);
    }
    return spux_load(far);
}

/* Lists the possible hits of a primitive, certain ones of those where they are certainly in the range. */
CGT_SPU_INLINE void leaf_list_hits(const stream *s, leaf_rays *r, const leaf_result *f, uint32_t prim, unsigned sides)
{
    const vmask filled_up = spu_cmpeq(spux_load_unaligned_uint(r->offset), spux_vuint(STREAM_DUMMY_RAY));
    const unsigned lanes = spux_mask_bits(spu_andc(spu_and(f->possible, spux_cmpge(r->far, f->low)), filled_up));
    if (!lanes)
        return;
    const vmask in_range = spu_and(spu_cmpgt(f->low, r->near_in), spu_cmpgt(r->far_in, f->high));
    vfloat at[3] = {f->low, f->high, r->far};
    const vfloat far =
        leaf_list_lanes(s, r->offset, lanes, spux_mask_bits(spu_and(f->certain_hit, in_range)), at, prim, sides);
    r->hit = spu_or(r->hit, spu_cmpgt(r->far, far));
    r->far = far;
}

/* Stores the ends of rays that have become shorter. */
CGT_SPU_INLINE void leaf_list_store(stream *s, const leaf_rays *r)
{
    unsigned shorter = spux_mask_bits(r->hit);
    _Alignas(CGT_VECTOR_BYTES) float far[CGT_LANES];
    if (!shorter)
        return;
    spux_store(far, r->far);
    for (; shorter; shorter &= shorter - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(shorter);
        stream_set_end(s, r->offset[k], far[k]);
    }
}

#endif
