/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The binary tree below a BVH, from the leaves to the root: records of its leaves and inner nodes, and for each inner
 * node the best way to collapse its subtree to BVH nodes (Aila, Karras, Laine, "On Quality Metrics of Bounding
 * Volume Hierarchies", 2013, and others for the measure; Wald, Benthin, Boulos 2008 for BVH nodes).
 *
 * A BVH node costs its area, which is proportional to how many rays visit it; leaves are given and cost nothing here.
 * With C(n, k) the least cost of all BVH nodes below n, where n may take up to k of the slots of a BVH node,
 *   S(n, k) = min over 0 < i < k of C(l, i) + C(r, k - i)      for the children l and r: n is parted
 *   C(n, 1) = area(n) + S(n, CGT_LANES)                        n is a BVH node
 *   C(n, k) = min(C(n, 1), S(n, k))
 * and 0 for a leaf. Lane k - 1 of a vector is for k slots. */
#ifndef CGT_BVH_BINARY_H
#define CGT_BVH_BINARY_H

#include "core/memory.h"
#include "dispatch/bvh_builder.h"
#include "kernel/bvh/bvh_node.h"

/* Both kinds of records begin alike: nodes are built from their boxes. */
typedef struct bvh_leaf_record {
    float low[3];
    uint32_t code; /* see bvh.h */
    float high[3];
    uint32_t is_bundle; /* of capsules side by side, see bvh_turn.h; else 0 */
} bvh_leaf_record;

typedef struct bvh_inner_record {
    _Alignas(16) float low[3];
    uint32_t number; /* of its BVH node in its range, where it is one whose parent is over ranges */
    float high[3];
    uint32_t depth;           /* BVH nodes above it, where it is one */
    uint32_t child[2];        /* references */
    uint8_t slots[CGT_LANES]; /* how many of k child 0 takes, in element k - 1; 0: the node is a wide one. Of one that
                                 was chosen as such the first element, which would be 0, tells its children */
} bvh_inner_record;

/* A subtree whose parent is not there yet. */
typedef struct bvh_branch {
    _Alignas(CGT_VECTOR_BYTES) float cost[CGT_LANES];
    float low[3], high[3];
    uint32_t reference, leaves;
} bvh_branch;

/* Adjacent branches, each with the depth at which it parts from the one before. */
typedef struct bvh_branch_stack {
    bvh_branch branch[CGT_BVH_MAX_DEPTH + 2];
    uint32_t parting[CGT_BVH_MAX_DEPTH + 2];
    uint32_t count;
    uint32_t next; /* inner record */
} bvh_branch_stack;

CGT_SPU_INLINE bvh_leaf_record *bvh_leaf_at(const cgt_bvh_build *b, uint32_t reference)
{
    return (bvh_leaf_record *)b->record + (reference & ~CGT_BVH_LEAF_REF);
}

/* Inner records follow those of leaves, aligned. */
CGT_SPU_INLINE bvh_inner_record *bvh_inner_records(const cgt_bvh_build *b)
{
    const size_t bytes = (size_t)b->leaves * sizeof(bvh_leaf_record);
    return (bvh_inner_record *)(void *)((char *)b->record +
                                        (bytes + CGT_ALIGNMENT - 1) / CGT_ALIGNMENT * CGT_ALIGNMENT);
}

/* The list of children of a range's BVH nodes: first the BVH nodes whose parents lie above the ranges, then node by
 * node, in the order of this list, their children. None is listed twice, so that a range lists at most its records. */
CGT_SPU_INLINE uint32_t *bvh_child_list(const cgt_bvh_build *b, const cgt_bvh_range *range)
{
    return (uint32_t *)(void *)(bvh_inner_records(b) + b->leaves) + 2 * (size_t)range->first_leaf;
}

/* ---- joining ---- */

CGT_SPU_INLINE float bvh_half_area(const float low[3], const float high[3])
{
    const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x * y + y * z + z * x;
}

/* Computes S and C of a node of two children. l has no more leaves than r: more slots than leaves would not help it. */
CGT_SPU_INLINE void bvh_choose_slots(const bvh_branch *l, const bvh_branch *r, float area, float cost[CGT_LANES],
                                     uint8_t slots[CGT_LANES])
{
    _Alignas(CGT_VECTOR_BYTES) uint32_t number[CGT_LANES];
    const uint32_t most = l->leaves < CGT_LANES ? l->leaves : CGT_LANES - 1;
    const vfloat right = spux_load(r->cost);
    const vuint lane = spux_lane_index();
    vfloat best = spux_vfloat(INFINITY);
    vuint choice = spux_vuint(1);
    for (uint32_t i = 1; i <= most; i++) {
        const vfloat sum = spu_add(spux_permute(right, spu_sub(lane, spux_vuint(i))), spux_vfloat(l->cost[i - 1]));
        const vmask better = spu_andc(spu_cmpgt(best, sum), spux_mask_first(i));
        best = spux_select(best, sum, better);
        choice = spux_select(choice, spux_vuint(i), better);
    }
    spux_store(cost, best);
    const vfloat node = spux_vfloat(area + cost[CGT_LANES - 1]);
    const vmask is_node = spu_or(spu_cmpgt(best, node), spux_mask_first(1));
    spux_store(cost, spux_select(best, node, is_node));
    spux_store_uint(number, spux_select(choice, spux_vuint(0), is_node));
    for (int k = 0; k < CGT_LANES; k++)
        slots[k] = (uint8_t)number[k];
}

/* Merges the last two branches. */
CGT_SPU_INLINE void bvh_branch_merge(const cgt_bvh_build *b, bvh_branch_stack *s)
{
    bvh_branch *first = &s->branch[s->count - 2], *second = &s->branch[s->count - 1];
    const bool swap = second->leaves < first->leaves;
    const bvh_branch *l = swap ? second : first, *r = swap ? first : second;
    const uint32_t number = s->next++;
    bvh_inner_record *inner = bvh_inner_records(b) + number;
    _Alignas(CGT_VECTOR_BYTES) float cost[CGT_LANES];
    for (int a = 0; a < 3; a++) {
        inner->low[a] = l->low[a] < r->low[a] ? l->low[a] : r->low[a];
        inner->high[a] = l->high[a] > r->high[a] ? l->high[a] : r->high[a];
    }
    inner->child[0] = l->reference;
    inner->child[1] = r->reference;
    bvh_choose_slots(l, r, bvh_half_area(inner->low, inner->high), cost, inner->slots);
    for (int a = 0; a < 3; a++) {
        first->low[a] = inner->low[a];
        first->high[a] = inner->high[a];
    }
    spux_store(first->cost, spux_load(cost));
    first->leaves += second->leaves;
    first->reference = number;
    s->count--;
}

/* Merges the branches that part deeper than the next one, which is about to be pushed. */
CGT_SPU_INLINE void bvh_branch_merge_deeper(const cgt_bvh_build *b, bvh_branch_stack *s, uint32_t parting)
{
    while (s->count > 1 && s->parting[s->count - 1] > parting)
        bvh_branch_merge(b, s);
}

CGT_SPU_INLINE void bvh_branch_merge_all(const cgt_bvh_build *b, bvh_branch_stack *s)
{
    while (s->count > 1)
        bvh_branch_merge(b, s);
}

#endif
