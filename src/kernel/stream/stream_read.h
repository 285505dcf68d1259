/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Records of a stream from the caller's arrays, a vector of rays at a time, and their order: by the octant of the
 * direction, after a counting sort. */
#ifndef CGT_STREAM_READ_H
#define CGT_STREAM_READ_H

#include "kernel/stream/stream.h"

/* 1 / d with components made large enough, see bvh_ray.h: estimates have 11 bits at least, and a Newton step
 * makes that 2^-21. */
CGT_SPU_INLINE vfloat stream_reciprocal(vfloat d)
{
    const vfloat flat = spux_vfloat(BVH_MIN_DIR), sign = spu_and(d, spux_vfloat(-0.f));
    const vfloat e = spux_select(d, spu_or(sign, flat), spu_cmpgt(flat, spux_abs(d)));
    const vfloat r = spu_re(e);
    return spu_madd(spu_nmsub(e, r, spux_vfloat(1)), r, r);
}

CGT_SPU_INLINE stream_bounds stream_no_bounds(void)
{
    const vfloat least = spux_vfloat(-INFINITY), most = spux_vfloat(INFINITY);
    return (stream_bounds){.org_low = {most, most, most},
                           .org_high = {least, least, least},
                           .start_low = {most, most, most},
                           .start_high = {least, least, least},
                           .end_low = {most, most, most},
                           .end_high = {least, least, least}};
}

/* Adds a place on each ray, at t: moved outwards by more than its roundings. */
CGT_SPU_INLINE void stream_bounds_add_place(vfloat *low, vfloat *high, vfloat org, vfloat dir, vfloat t, vmask lanes)
{
    const vfloat way = spu_mul(dir, t), place = spu_add(org, way);
    const vfloat margin = spu_mul(spu_add(spux_abs(way), spux_abs(org)), spux_vfloat(0x1p-20f));
    *low = spux_select(*low, spux_min(*low, spu_sub(place, margin)), lanes);
    *high = spux_select(*high, spux_max(*high, spu_add(place, margin)), lanes);
}

/* Adds rays. starts: they begin elsewhere than at their origins. Those that begin or end beyond all that can be reached
 * reach nothing, but infinity times a direction of 0 would be no number. */
CGT_SPU_INLINE void stream_bounds_add(stream_bounds *b, const vfloat org[3], const vfloat dir[3], vfloat first,
                                      vfloat last, vmask lanes, bool starts)
{
    const vfloat begin = spux_min(first, spux_vfloat(BVH_MAX_T)), end = spux_max(last, spux_vfloat(-BVH_MAX_T));
    for (int a = 0; a < 3; a++) {
        b->org_low[a] = spux_select(b->org_low[a], spux_min(b->org_low[a], org[a]), lanes);
        b->org_high[a] = spux_select(b->org_high[a], spux_max(b->org_high[a], org[a]), lanes);
        stream_bounds_add_place(&b->end_low[a], &b->end_high[a], org[a], dir[a], end, lanes);
        if (starts)
            stream_bounds_add_place(&b->start_low[a], &b->start_high[a], org[a], dir[a], begin, lanes);
    }
}

/* Stores the records of rays i to i + count - 1, and adds these to the bounds. */
CGT_SPU_INLINE void stream_store_records(stream *s, uint32_t i, uint32_t count, bool any_hit, uint32_t *key,
                                         stream_bounds *bounds, uint32_t *invalid_rays, vmask *unusual, vmask *still)
{
    const bvh_call *c = &s->call;
    const vfloat scale = spux_vfloat(c->scale), margin = spux_vfloat(0x1p-20f);
    ray_lanes q;
    ray_lanes_load(c->source, c->first + i, count, &q);
    const vfloat longest = ray_largest(q.dir);
    const vfloat power = lane_power(longest), inverse = lane_inverse_power(power);
    const vfloat speed = spu_mul(power, scale); /* s */
    vfloat org[3], dir[3], rdir[3], shift[3];
    vuint octant = spux_vuint(0);
    for (int a = 0; a < 3; a++) {
        org[a] = spu_mul(q.org[a], scale);
        dir[a] = spu_mul(q.dir[a], inverse);
        rdir[a] = stream_reciprocal(dir[a]);
        shift[a] = spu_xor(spu_mul(org[a], rdir[a]), spux_vfloat(-0.f));
        octant = spu_or(octant, spu_sl(spu_sr((vuint)rdir[a], 31), (unsigned)a));
        *still = spu_or(*still, spu_cmpeq(dir[a], spux_vfloat(0)));
    }
    const ray_lane_states state = ray_classify_lanes(&q, &s->limits);
    vuint keys = spux_select(octant, spux_vuint(STREAM_UNUSUAL), state.unusual);
    keys = spux_select(keys, spux_vuint(STREAM_SKIPPED), state.off);
    const vmask streams = spux_not(state.unusual);
    spux_store_uint(key + i, keys);
    *unusual = spu_or(*unusual, spu_andc(state.unusual, state.off));
    *invalid_rays += spux_count_bits(spux_mask_bits(state.invalid) & CGT_ALL_LANES >> (CGT_LANES - count));

    const vfloat outside = spux_vfloat(0x1p-86f), end = spux_vfloat(BVH_MAX_T);
    const vfloat near = spu_msub(spu_nmsub(spux_abs(q.t_min), margin, q.t_min), speed, outside);
    const vfloat far = spu_madd(spu_madd(spux_abs(q.t_max), margin, q.t_max), speed, outside);
    const vfloat first = spux_max(near, spux_vfloat(-BVH_MAX_T));
    /* rays that are not traced must not look as if they had hit */
    const vfloat last = spux_select(spux_min(far, end), end, state.unusual);
    stream_bounds_add(bounds, org, dir, first, last, streams, c->source->rays->t_min);
    vfloat row[STREAM_RECORD] = {rdir[0], rdir[1], rdir[2], first, shift[0], shift[1], shift[2], last,
                                 org[0],  org[1],  org[2],  first, dir[0],   dir[1],   dir[2],   last};
    for (uint32_t k = 0; k < STREAM_RECORD; k += CGT_LANES) {
        spux_transpose(row + k);
        for (uint32_t j = 0; j < CGT_LANES; j++)
            spux_store(s->record[i + j] + k, row[k + j]);
    }
    if (any_hit)
        return;
    const vfloat inside = spu_sub(spu_nmsub(spux_abs(last), spux_vfloat(0x1p-18f), last), spux_vfloat(0x1p-84f));
    const vfloat dummy = (vfloat)spux_vuint(CGT_INVALID_ID);
    spux_store_records4(&s->best[i].low, 4, (const vfloat[4]){inside, last, dummy, dummy});
}

/* Computes E of all streams, the bounds of where their rays begin and end, and the spread of the origins. starts: rays
 * begin elsewhere than at their origins. Those that begin there hit what lies behind it where t rounds to 0: by up to
 * 2^-150, at 2^60 at most. */
CGT_SPU_INLINE void stream_compute_bounds(stream *s, const stream_bounds *b, bool starts)
{
    const cgt_bvh *tree = s->call.tree;
    float org[3], origin_spread = 0, size = 0;
    for (int a = 0; a < 3; a++) {
        const float low = spux_hmin(b->org_low[a]), high = spux_hmax(b->org_high[a]);
        const float extent = high - low, tree_extent = (tree->high[a] - tree->low[a]) * s->call.scale;
        org[a] = !(low <= high) ? 0 : -low > high ? -low : high;
        origin_spread = extent > origin_spread ? extent : origin_spread;
        size = tree_extent > size ? tree_extent : size;
        s->start_low[a] = starts ? spux_hmin(b->start_low[a]) : low - 0x1p-85f;
        s->start_high[a] = starts ? spux_hmax(b->start_high[a]) : high + 0x1p-85f;
        s->end_low[a] = spux_hmin(b->end_low[a]);
        s->end_high[a] = spux_hmax(b->end_high[a]);
    }
    bvh_slab_error(&s->call, org, s->slab_error);
    s->call.org_error = s->start_error * 0x1p24f; /* u or more times it */
    s->origin_spread = origin_spread > 0 ? origin_spread / size : 0;
}

#define STREAM_STILL_SHARE 8u /* of the rays: fewer do not pay for asking all */

/* Sets s->still. Where a small component has become 0, a 0 tells nothing. */
__attribute__((noinline, cold, unused)) static void stream_find_still(stream *s, uint32_t count)
{
    uint32_t rays[3] = {0};
    bool vanished[3] = {false};
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t a = 0; a < 3 && s->key[i] < STREAM_UNUSUAL; a++)
            if (s->record[i][RECORD_DIR + a] == 0) {
                rays[a]++;
                vanished[a] |= bvh_input_ray(&s->call, i).line.dir[a] != 0;
            }
    for (uint32_t a = 0; a < 3; a++)
        s->still |= (uint32_t)(!vanished[a] && rays[a] * STREAM_STILL_SHARE > count) << a;
}

/* A chunk is sorted in this many runs side by side, each with counters of its own: consecutive rays share an octant,
 * and a single counter would serialise them. */
#define STREAM_SORT_RUNS 4u

/* Sorts the rays to s->ray_list by key, stable: number[k] with key k from start[k], which is aligned; each list is
 * padded. */
CGT_SPU_INLINE void stream_sort(stream *s, uint32_t count, uint32_t start[STREAM_KEYS], uint32_t number[STREAM_KEYS])
{
    const uint32_t run = count / STREAM_SORT_RUNS, last = STREAM_SORT_RUNS - 1; /* the last one takes the remainder */
    uint32_t to[STREAM_SORT_RUNS][STREAM_KEYS], next = 0;
    memset(to, 0, sizeof to);
    for (uint32_t i = 0; i < run; i++)
        for (uint32_t r = 0; r < STREAM_SORT_RUNS; r++)
            to[r][s->key[r * run + i]]++;
    for (uint32_t i = run * STREAM_SORT_RUNS; i < count; i++)
        to[last][s->key[i]]++;
    for (uint32_t k = 0; k < STREAM_KEYS; k++) {
        start[k] = next;
        for (uint32_t r = 0; r < STREAM_SORT_RUNS; r++) {
            const uint32_t rays = to[r][k];
            to[r][k] = next;
            next += rays;
        }
        number[k] = next - start[k];
        while (next % CGT_LANES)
            s->ray_list[next++] = STREAM_DUMMY_RAY;
    }
    for (uint32_t i = 0; i < run; i++)
        for (uint32_t r = 0; r < STREAM_SORT_RUNS; r++)
            s->ray_list[to[r][s->key[r * run + i]]++] = (r * run + i) * STREAM_RECORD;
    for (uint32_t i = run * STREAM_SORT_RUNS; i < count; i++)
        s->ray_list[to[last][s->key[i]]++] = i * STREAM_RECORD;
}

/* Stores the records of all `count` rays and sorts the rays. */
CGT_SPU_INLINE void stream_read_rays(stream *s, uint32_t count, bool any_hit, uint32_t start[STREAM_KEYS],
                                     uint32_t number[STREAM_KEYS])
{
    const bool starts = s->call.source->rays->t_min, has_ends = any_hit && s->call.source->rays->t_max;
    uint32_t invalid = 0;
    vmask unusual = spux_mask_none(), still = spux_mask_none();
    stream_bounds bounds = stream_no_bounds();
    for (uint32_t i = 0; i < count; i += CGT_LANES)
        stream_store_records(s, i, count - i < CGT_LANES ? count - i : CGT_LANES, any_hit, s->key, &bounds, &invalid,
                             &unusual, &still);
    s->call.counts->invalid_rays += invalid;
    s->start_error = 0;
    s->unbounded = !s->call.source->rays->t_max;
    if (s->call.moved && (has_ends || spux_any(unusual))) {
        stream_bounds moved = bounds; /* a copy: the loop's stay in registers */
        CGT_KERNEL(cgt_stream_move_rays)(s, count, spux_any(unusual), &moved);
        stream_compute_bounds(s, &moved, starts || s->start_error > 0);
    } else
        stream_compute_bounds(s, &bounds, starts);
    s->still = 0;
    if (__builtin_expect(spux_any(still), 0))
        stream_find_still(s, count);
    stream_sort(s, count, start, number);
    float *dummy = stream_record(s, STREAM_DUMMY_RAY);
    for (uint32_t k = 0; k < STREAM_RECORD; k++)
        dummy[k] = 1;
    stream_set_best(s, STREAM_DUMMY_RAY, -INFINITY, -INFINITY, CGT_INVALID_ID);
    s->updates = s->alone = s->together = 0;
}

#endif
