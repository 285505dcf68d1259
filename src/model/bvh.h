/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The BVH: nodes with as many children as the variant has lanes, their boxes as structure of arrays, and leaf blocks of
 * as many primitives of one kind, copied and transposed. A single ray tests a whole node or leaf at once; a stream of
 * rays tests one child or primitive after the other. Nodes and blocks depend on the variant: kernel/bvh/bvh_node.h.
 *
 * Memory as measured, nodes included: 34 bytes a sphere and 80 a triangle at 16 lanes, 39 and 82 at 8, 48 and 85 at 4.
 * A commit works in another 46 bytes a sphere and 61 a triangle, which the scene keeps for the next; small scenes take
 * some kilobytes more. For triangles in clusters (triangle_cluster.h) it is 61, 55 and 63 bytes, and another 20 to 35.
 *
 * Built from scratch in linear time: the levels of a loose grid, each numbered along a Morton curve, are sorted by
 * cell, and binary trees by highest differing bit are collapsed to BVH nodes (Lauterbach et al. 2009, "Fast BVH
 * Construction on GPUs"; Wald et al. 2008, "Getting Rid of Packets"). */
#ifndef CGT_BVH_H
#define CGT_BVH_H

#include "model/primitive.h"

/* A child has a code: the number of a node, or a leaf's block with its count and kind. */
#define CGT_BVH_LEAF 0x80000000u
#define CGT_BVH_BOXED_LEAF 0x40000000u /* of a leaf: triangles or capsules; else spheres */
#define CGT_BVH_COUNT_SHIFT 26u        /* four bits: primitives of a leaf less one */
#define CGT_BVH_INDEX_MASK 0x03ffffffu /* of a leaf's block, capsules' after triangles'; of a node all bits but LEAF */
#define CGT_BVH_NO_CHILD UINT32_MAX    /* no child; its box is empty */

#define CGT_BVH_MAX_DEPTH 64u /* nodes from the root to a leaf, at most */

typedef struct cgt_bvh {
    const void *node;     /* bvh_node, the root first; there is one wherever a primitive is valid */
    const void *sphere;   /* sphere_block */
    const void *triangle; /* triangle_block */
    const void *capsule;  /* capsule_block */
    const void *turned;   /* bvh_turned, of each node that has one at its number; NULL: none has */
    uint32_t nodes, sphere_blocks, triangle_blocks, capsule_blocks;
    uint32_t depth;        /* nodes on the longest way from the root to a leaf, at most CGT_BVH_MAX_DEPTH */
    float low[3], high[3]; /* bounds of all primitives, rounded outwards */
} cgt_bvh;

/* Where a leaf's primitives are: a block among those of its kind. */
typedef struct cgt_bvh_leaf {
    cgt_kind kind;
    uint32_t block;
} cgt_bvh_leaf;

static inline cgt_bvh_leaf cgt_bvh_find_leaf(const cgt_bvh *tree, uint32_t code)
{
    const uint32_t block = code & CGT_BVH_INDEX_MASK;
    if (!(code & CGT_BVH_BOXED_LEAF))
        return (cgt_bvh_leaf){CGT_KIND_SPHERES, block};
    if (block < tree->triangle_blocks)
        return (cgt_bvh_leaf){CGT_KIND_TRIANGLES, block};
    return (cgt_bvh_leaf){CGT_KIND_CAPSULES, block - tree->triangle_blocks};
}

#endif
