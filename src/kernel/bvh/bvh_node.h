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
    uint32_t flat[3];  /* children, as bits, that are triangles in a plane across an axis; of flat[0] also BVH_TURNED */
} bvh_node;

#define BVH_TURNED 0x80000000u /* the node has turned slabs */

/* Slabs of a node's children along two directions across what they hold: capsules side by side (bvh_turned.h). Planes
 * are times the scene's scale, rounded outwards. */
typedef struct bvh_turned {
    _Alignas(CGT_VECTOR_BYTES) float low[2][CGT_LANES], high[2][CGT_LANES];
    float across[2][3]; /* of length 1, or a little less */
} bvh_turned;

/* The children that a ray hits nowhere since it moves along no axis of `still`, as bits: it is parallel to them. */
CGT_SPU_INLINE unsigned bvh_parallel_children(const bvh_node *n, uint32_t still)
{
    unsigned parallel = 0;
    for (int a = 0; a < 3; a++)
        parallel |= still >> a & 1 ? n->flat[a] : 0;
    return parallel & CGT_ALL_LANES;
}

CGT_SPU_INLINE uint32_t bvh_leaf_count(uint32_t code) { return (code >> CGT_BVH_COUNT_SHIFT & 15) + 1; }

#endif
