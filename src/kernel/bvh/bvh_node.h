/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Nodes and leaf blocks of the BVH, as wide as the variant. */
#ifndef CGT_BVH_NODE_H
#define CGT_BVH_NODE_H

#include "kernel/primitive/primitive_block.h"
#include "model/bvh.h"
#include "dispatch/kernel.h"
#include "vector.h"

/* Children are packed: present ones first. */
typedef struct bvh_node {
    _Alignas(CGT_VECTOR_BYTES) float low[3][CGT_LANES]; /* of children, rounded outwards; +infinity without a child */
    float high[3][CGT_LANES];                           /* -infinity without a child */
    uint32_t child[CGT_LANES];                          /* see bvh.h */
    /* All lanes, in the order in which rays of octant k = 0..3 meet children: bit a of k is set where the direction's
     * component a is negative; octant 7 - k has the reverse. Lanes without a child come last: to read a row backwards,
     * start at the number of children. */
    uint8_t order[4][CGT_LANES];
    uint32_t children; /* 2 to CGT_LANES; 1 in a root only */
    uint32_t unused[3];
} bvh_node;

CGT_SPU_INLINE uint32_t bvh_leaf_count(uint32_t code) { return (code >> CGT_BVH_COUNT_SHIFT & 15) + 1; }

#endif
