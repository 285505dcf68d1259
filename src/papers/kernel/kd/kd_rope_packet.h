/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A vector of rays at a time along the ropes of packets, directions of any signs mixed. Each ray has its current node
 * and its last plane; rays at the current node are active. At an inner node each active ray moves to its own child, and
 * the packet to one of them; after a leaf, the node with the highest number among those of the rays is next. Children
 * come after their parents, and in depth-first order a whole subtree comes before the rest of its parent: so rays that
 * diverged gather again, as far as they can.
 *
 * Times are computed in single precision. The t of a plane is (plane - org) * (1 / dir): a difference errs by 2^-24 of
 * itself, a reciprocal by 2^-21, a product by 2^-24, together by less than 1.26 * 2^-21, and by 2^-149 where it
 * underflows. So two of them are in order where they are further apart than 2^-20 of their sum and 2^-126, which leaves
 * enough for the rounding of that test. On an SPU, whose unit is 2^-23, they err by less than 1.51 * 2^-21 together and
 * by 2^-126 where they underflow; its programs see to it that planes and origins have no differences that underflow
 * (cell/ppe/kd/kd_scene.h). Components of the direction below 2^-70 have no reciprocal: all that such a ray, an
 * imprecise one, compares is undecided. With coordinates up to 2^55 times then are at most 2^126; an axis without a
 * component has planes at 2^127, which no ray comes to. Times that are not certainly in order are compared exactly, ray
 * by ray. */
#ifndef CGT_KD_ROPE_PACKET_H
#define CGT_KD_ROPE_PACKET_H

#include "papers/kernel/kd/kd_leaf.h"
#include "papers/kernel/kd/kd_rope.h"

#define ROPE_REL_ERROR 0x1p-20f
#define ROPE_ABS_ERROR (SPUX_ROUNDOFF > 0x1p-24f ? 0x1p-124f : 0x1p-126f)
#define ROPE_MIN_DIR 0x1p-70f
#define ROPE_NEVER 0x1p127f

typedef struct rope_packet {
    const packet *p;
    uint32_t first; /* ray of lane 0 */
    vfloat org[3], rdir[3];
    vmask ahead[3];                            /* lanes whose direction has that sign, as a mask */
    unsigned forward[3], backward[3], zero[3]; /* the same as bits; and those without such a component */
    unsigned zero_axes, imprecise;       /* axes with any of those; lanes with a component too small to divide by */
    _Alignas(64) float plane[CGT_LANES]; /* the last that each ray crossed */
    _Alignas(64) uint32_t axis[CGT_LANES];
    _Alignas(64) float time[CGT_LANES];    /* of that, rounded */
    _Alignas(64) uint32_t node[CGT_LANES]; /* current; CGT_INVALID_ID: done */
    uint64_t exact_steps;
} rope_packet;

static void rope_packet_init(const packet *p, uint32_t i, rope_packet *r)
{
    const vfloat zero = spux_vfloat(0), one = spux_vfloat(1);
    r->p = p;
    r->first = i;
    r->zero_axes = r->imprecise = 0;
    r->exact_steps = 0;
    for (int a = 0; a < 3; a++) {
        const vfloat d = spux_load(p->dir[a] + i);
        const vmask flat = spu_cmpgt(spux_vfloat(ROPE_MIN_DIR), spux_abs(d));
        r->org[a] = spux_load(p->org[a] + i);
        r->ahead[a] = spu_cmpgt(d, zero);
        r->forward[a] = spux_mask_bits(r->ahead[a]);
        r->backward[a] = spux_mask_bits(spu_cmpgt(zero, d));
        r->zero[a] = ~(r->forward[a] | r->backward[a]) & CGT_ALL_LANES;
        r->rdir[a] = spux_select(spux_div(one, spux_select(d, one, flat)), zero, flat);
        r->zero_axes |= (unsigned)(r->zero[a] != 0) << a;
        r->imprecise |= spux_mask_bits(flat) & ~r->zero[a];
    }
}

/* When the rays cross planes of an axis. */
CGT_SPU_INLINE vfloat rope_packet_time(const rope_packet *r, uint32_t axis, vfloat plane)
{
    return spu_mul(spu_sub(plane, r->org[axis]), r->rdir[axis]);
}

/* The same, but `never` where there is no such component. */
CGT_SPU_INLINE vfloat rope_packet_time_or(const rope_packet *r, uint32_t axis, vfloat plane, float never)
{
    const vfloat t = rope_packet_time(r, axis, plane);
    if (!(r->zero_axes >> axis & 1))
        return t;
    return spux_select(t, spux_vfloat(never), spux_mask_from_bits(r->zero[axis]));
}

/* By how much times have to differ to be in order. */
CGT_SPU_INLINE vfloat rope_packet_error(vfloat a, vfloat b)
{
    return spu_madd(spu_add(spux_abs(a), spux_abs(b)), spux_vfloat(ROPE_REL_ERROR), spux_vfloat(ROPE_ABS_ERROR));
}

CGT_SPU_INLINE void rope_packet_set(rope_packet *r, uint32_t lane, rope_time last)
{
    _Alignas(64) float rdir[CGT_LANES];
    r->plane[lane] = last.plane;
    r->axis[lane] = last.axis;
    r->time[lane] = last.plane;
    if (last.axis == ROPE_START)
        return;
    spux_store(rdir, r->rdir[last.axis]);
    r->time[lane] = (last.plane - r->p->org[last.axis][r->first + lane]) * rdir[lane];
}

/* ---- start ---- */

/* The lanes that certainly enter the root, with their last planes; *open: those that may or may not, or not certainly
 * by that plane. */
static unsigned rope_packet_enter_fast(rope_packet *r, const cgt_kd_tree *tree, unsigned *undecided)
{
    const packet *p = r->p;
    const vfloat t_min = spux_load(p->t_min + r->first), never = spux_vfloat(-ROPE_NEVER);
    const vfloat start = spu_sub(t_min, spu_madd(spux_abs(t_min), spux_vfloat(0x1p-22f), spux_vfloat(ROPE_ABS_ERROR)));
    const vmask endless = spu_cmpgt(spux_vfloat(-FLT_MAX), start);
    vfloat near = spux_select(start, never, endless), plane = start, leave[3];
    vuint axis = spux_vuint(ROPE_START);
    unsigned missed = 0, unordered = r->imprecise;
    for (uint32_t a = 0; a < 3; a++) {
        const vfloat low = spux_vfloat(tree->low[a]), high = spux_vfloat(tree->high[a]);
        const vfloat side = spux_select(high, low, r->ahead[a]);
        const vfloat t = rope_packet_time_or(r, a, side, -ROPE_NEVER), difference = spu_sub(t, near);
        const vmask later = spu_cmpgt(t, near);
        unordered |= ~spux_mask_bits(spu_cmpgt(spux_abs(difference), rope_packet_error(t, near))) & ~r->zero[a];
        near = spux_select(near, t, later);
        plane = spux_select(plane, side, later);
        axis = spux_select(axis, spux_vuint(a), later);
        missed |= r->zero[a] & spux_mask_bits(spu_or(spu_cmpgt(low, r->org[a]), spu_cmpgt(r->org[a], high)));
        leave[a] = rope_packet_time_or(r, a, spux_select(low, high, r->ahead[a]), ROPE_NEVER);
    }
    const vfloat far = spux_min(spux_min(leave[0], leave[1]), leave[2]), margin = rope_packet_error(near, far);
    const unsigned hit = spux_mask_bits(spu_cmpgt(spu_sub(far, near), margin));
    missed |= spux_mask_bits(spu_cmpgt(spu_sub(near, far), margin)) & ~r->imprecise;
    spux_store(r->plane, plane);
    spux_store_uint(r->axis, axis);
    spux_store(r->time, near);
    *undecided = (unordered | ~hit) & ~missed & CGT_ALL_LANES;
    return hit & ~missed & ~unordered;
}

/* Puts all lanes that meet the root there. */
static void rope_packet_enter(rope_packet *r, const cgt_kd_tree *tree)
{
    const packet *p = r->p;
    unsigned undecided, inside = rope_packet_enter_fast(r, tree, &undecided);
    const vmask closed = spu_cmpeq(spux_load(p->high + r->first), spux_vfloat(-INFINITY));
    const unsigned part = ~spux_mask_bits(closed);
    for (undecided &= part; undecided; undecided &= undecided - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(undecided);
        rope_time last;
        r->exact_steps++;
        if (!rope_enter(p, r->first + lane, tree->low, tree->high, &last))
            continue;
        rope_packet_set(r, lane, last);
        inside |= 1u << lane;
    }
    const vmask in = spux_mask_from_bits(inside & part);
    spux_store_uint(r->node, spux_select(spux_vuint(CGT_INVALID_ID), spux_vuint(0), in));
}

/* ---- down ---- */

/* The active lanes that are above a split a moment after their last planes, as bits. */
CGT_SPU_INLINE unsigned rope_packet_above(rope_packet *r, uint32_t axis, float split, unsigned active)
{
    const vfloat s = spux_vfloat(split), t = rope_packet_time(r, axis, s), time = spux_load(r->time);
    const vfloat plane = spux_load(r->plane), margin = rope_packet_error(t, time);
    const unsigned forward = r->forward[axis], zero = r->zero[axis];
    const unsigned before = spux_mask_bits(spu_cmpgt(spu_sub(t, time), margin)) & ~r->imprecise;
    const unsigned after = spux_mask_bits(spu_cmpgt(spu_sub(time, t), margin)) & ~r->imprecise;
    const unsigned same = spux_mask_bits(spu_cmpeq(spux_load_uint(r->axis), spux_vuint(axis)));
    unsigned above = (after & forward) | (before & ~forward);
    if (same & active) { /* planes of one axis: in the order of their coordinates */
        const unsigned reached = spux_mask_bits(spux_cmpge(plane, s)), beyond = spux_mask_bits(spu_cmpgt(plane, s));
        above = (above & ~same) | (same & ((reached & forward) | (beyond & ~forward)));
    }
    if (zero)
        above = (above & ~zero) | (zero & spux_mask_bits(spu_cmpgt(r->org[axis], s)));
    for (unsigned undecided = active & ~(before | after | same | zero); undecided; undecided &= undecided - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(undecided);
        const rope_time last = {r->plane[lane], r->axis[lane]};
        r->exact_steps++;
        above &= ~(1u << lane);
        above |= (unsigned)rope_is_above(r->p, r->first + lane, axis, split, last) << lane;
    }
    return above & active;
}

/* Returns the child that the packet moves to: 0 or 1. Where all active rays are on one side, that one; where all on one
 * side head for the other, the first, so that they meet again; else the one with more rays. */
CGT_SPU_INLINE uint32_t rope_packet_choose(const rope_packet *r, uint32_t axis, unsigned below, unsigned above)
{
    if (!below || !above)
        return above != 0;
    if (!(below & ~r->forward[axis]))
        return 0;
    if (!(above & ~r->backward[axis]))
        return 1;
    return spux_count_bits(above) > spux_count_bits(below);
}

/* Descends from a node to a leaf; rays that take other children wait there. */
CGT_SPU_INLINE cgt_kd_node rope_packet_down(rope_packet *r, const cgt_kd_tree *tree, uint32_t node_index,
                                            unsigned *active, cgt_counts *counts)
{
    uint32_t depth = 0;
    cgt_kd_node n = *KD_NODES(tree, node_index);
    for (; !cgt_kd_is_leaf(n); n = *KD_NODES(tree, node_index)) {
        const uint32_t axis = cgt_kd_axis(n);
        const unsigned above = rope_packet_above(r, axis, cgt_kd_split(n), *active), below = *active & ~above;
        const uint32_t upper = rope_packet_choose(r, axis, below, above);
        const unsigned diverted = upper ? below : above;
        node_index = n.word[1] + upper;
        counts->nodes++;
        if (KD_IS_TOO_DEEP(depth))
            return cgt_kd_leaf_node(0, 0);
        depth++;
        if (diverted) {
            const vuint node = spux_load_uint(r->node), sibling = spux_vuint(n.word[1] + !upper);
            spux_store_uint(r->node, spux_select(node, sibling, spux_mask_from_bits(diverted)));
            *active &= ~diverted;
        }
    }
    return n;
}

/* ---- leave ---- */

CGT_SPU_INLINE void rope_packet_leave_exactly(rope_packet *r, const cgt_kd_leaf *leaf, unsigned undecided)
{
    for (; undecided; undecided &= undecided - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(undecided);
        const rope_time last = rope_leave(r->p, r->first + lane, leaf->low, leaf->high);
        const bool forward = r->forward[last.axis] >> lane & 1;
        r->exact_steps++;
        rope_packet_set(r, lane, last);
        r->node[lane] = leaf->packet_rope[2 * last.axis + forward];
    }
}

/* Leads the active lanes out of a leaf. */
CGT_SPU_INLINE void rope_packet_leave(rope_packet *r, const cgt_kd_leaf *leaf, unsigned active)
{
    vfloat plane[3], t[3];
    vuint rope[3];
    for (uint32_t a = 0; a < 3; a++) {
        plane[a] = spux_select(spux_vfloat(leaf->low[a]), spux_vfloat(leaf->high[a]), r->ahead[a]);
        rope[a] =
            spux_select(spux_vuint(leaf->packet_rope[2 * a]), spux_vuint(leaf->packet_rope[2 * a + 1]), r->ahead[a]);
        t[a] = rope_packet_time_or(r, a, plane[a], ROPE_NEVER);
    }
    const vmask is1 = spu_cmpgt(t[0], t[1]);
    const vfloat first01 = spux_select(t[0], t[1], is1), second01 = spux_select(t[1], t[0], is1);
    const vmask is2 = spu_cmpgt(first01, t[2]), changed = spux_mask_from_bits(active);
    const vfloat first = spux_select(first01, t[2], is2);
    const vfloat second = spux_min(second01, spux_select(t[2], first01, is2));
    const vfloat last = spux_select(spux_select(plane[0], plane[1], is1), plane[2], is2);
    const vuint axis = spux_select(spux_select(spux_vuint(0), spux_vuint(1), is1), spux_vuint(2), is2);
    const vuint node = spux_select(spux_select(rope[0], rope[1], is1), rope[2], is2);
    const unsigned in_order = spux_mask_bits(spu_cmpgt(spu_sub(second, first), rope_packet_error(second, first)));
    spux_store(r->plane, spux_select(spux_load(r->plane), last, changed));
    spux_store(r->time, spux_select(spux_load(r->time), first, changed));
    spux_store_uint(r->axis, spux_select(spux_load_uint(r->axis), axis, changed));
    spux_store_uint(r->node, spux_select(spux_load_uint(r->node), node, changed));
    if (active & (r->imprecise | ~in_order))
        rope_packet_leave_exactly(r, leaf, active & (r->imprecise | ~in_order));
}

/* ---- all ---- */

/* Returns the next node, the highest of those of rays that are not done; CGT_INVALID_ID where all are. A ray is done
 * where it has left the root, or can meet nothing more that counts; t rounds to the ends of the range. */
CGT_SPU_INLINE uint32_t rope_packet_next(rope_packet *r, unsigned *active)
{
    const vfloat high = spux_load(r->p->high + r->first), time = spux_load(r->time);
    vmask beyond = spu_cmpgt(spu_sub(time, rope_packet_error(time, high)), high);
    if (r->imprecise)
        beyond = spu_andc(beyond, spux_mask_from_bits(r->imprecise));
    const vmask done = spu_or(beyond, spu_cmpeq(high, spux_vfloat(-INFINITY)));
    const vuint node = spux_select(spux_load_uint(r->node), spux_vuint(CGT_INVALID_ID), done);
    spux_store_uint(r->node, node);
    /* one more, so that CGT_INVALID_ID is below all */
    const uint32_t next = spux_hmax(spu_add(node, spux_vuint(1))) - 1;
    *active = spux_mask_bits(spu_cmpeq(node, spux_vuint(next)));
    return next;
}

static void rope_trace_vector(const cgt_kd_tree *tree, leaf_tests *l, uint32_t i)
{
    const uint64_t most = (uint64_t)tree->leaves * CGT_LANES; /* each ray visits each leaf once */
    uint64_t steps = 0;
    uint32_t leaves = 0;
    unsigned active;
    rope_packet r;
    lane_rays test_rays;
    rope_packet_init(l->p, i, &r);
    rope_packet_enter(&r, tree);
    uint32_t node_index = rope_packet_next(&r, &active);
    if (node_index == CGT_INVALID_ID)
        return;
    lane_rays_of_packet(l->p, i, l->scale, &test_rays);
    leaf_mailbox_clear(l);
    l->counts->packets++;
    for (; node_index != CGT_INVALID_ID; node_index = rope_packet_next(&r, &active)) {
        const cgt_kd_node n = rope_packet_down(&r, tree, node_index, &active, l->counts);
        const cgt_kd_leaf *leaf = KD_LEAF(tree, n.word[1]);
        steps += spux_count_bits(active);
        if (steps > most) { /* only a broken tree has loops */
            l->counts->rope_loops++;
            break;
        }
        leaves++;
        ROPE_VISIT(i, active, n.word[1]);
        if (leaf->count)
            KD_TEST_LEAF(tree, l, &test_rays, leaf, i);
        rope_packet_leave(&r, leaf, active);
    }
    l->counts->leaves += leaves;
    l->counts->rope_steps += leaves - (leaves > 0);
    l->counts->exact_steps += r.exact_steps;
}

#endif
