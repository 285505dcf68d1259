/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The steps of the BVH build that run in kernels, and what they work on (builders/bvh/bvh_build.h lists all steps). */
#ifndef CGT_BVH_BUILDER_H
#define CGT_BVH_BUILDER_H

#include "dispatch/kernel.h"
#include "model/morton_curve.h"
#include "model/triangle_cluster.h"

/* ---- parts ---- */

#define CGT_BVH_PARTS (CGT_KINDS * CGT_LOOSE_SIZE_LEVELS) /* of each level the primitives of each kind */
#define CGT_BVH_PART_DEPTH 6u                             /* binary nodes over the parts' roots, at most */
#define CGT_BVH_KEY_BITS CGT_MORTON_BITS                  /* of a part's cells */

/* Primitives of one kind and one size level (builders/order/size_levels.h). */
typedef struct cgt_bvh_part {
    float least;    /* sizes from here on belong to this part or one of its kind before it */
    uint32_t first; /* cell */
    cgt_morton_curve curve;
} cgt_bvh_part;

typedef struct cgt_bvh_plan {
    cgt_bvh_part part[CGT_BVH_PARTS]; /* by kind */
    uint32_t first[CGT_KINDS + 1];    /* part of each kind; then how many there are */
    uint32_t cells;
} cgt_bvh_plan;

/* ---- ranges ---- */

#define CGT_BVH_LEAF_REF 0x80000000u /* of a reference to a binary node: a leaf's record; else an inner one */

/* Consecutive cells, and the subtree of the binary tree over them. */
typedef struct cgt_bvh_range {
    cgt_kind kind;
    uint32_t cell, bits;  /* first cell, and how many: 2^bits */
    uint32_t begin, end;  /* primitives or clusters, at least one, in sorted order */
    uint32_t depth;       /* of its binary root; the root of all has depth 0 */
    uint32_t parting;     /* depth of the binary node that separates it from the range before it; none for the first */
    uint32_t leaves;      /* at least one */
    uint32_t first_leaf;  /* record; the others follow in order */
    uint32_t first_block; /* of its kind */
    uint32_t first_inner; /* record of leaves - 1 */
    uint32_t roots;       /* nodes whose parents lie above the ranges */
    uint32_t list_length; /* of the list of children: the roots, then the children of all its nodes */
    uint32_t nodes;       /* of the BVH */
    uint32_t first_node;
    uint32_t deepest; /* levels of nodes down to its deepest one, 0 where it has none */
    bool has_bundles; /* leaves of capsules side by side, whose nodes may have turned slabs */
} cgt_bvh_range;

/* ---- the tree ---- */

/* What the kernels' steps work on. With clusters, these are sorted and split instead of primitives; leaves hold their
 * triangles. */
typedef struct cgt_bvh_build {
    const cgt_primitives *prims;
    const cgt_cluster *cluster; /* NULL: none */
    float scale;                /* of the committed scene */
    const uint32_t *start;      /* of each cell in `prim` */
    uint32_t *prim;             /* sorted by cell; splitting a range sorts on within its cells */
    uint32_t sorted;            /* length of `prim` */
    uint32_t *key;              /* room for a key of each primitive */
    uint32_t *scratch;          /* for a primitive */
    float *middle[3];           /* and for its middle */
    uint16_t *leaf;       /* a range's leaves, from its first primitive on: count - 1, parting << 8; of clusters from
                       `leaves_each` times its first one on */
    uint32_t leaves_each; /* leaves that a cluster takes at most; 1 for primitives */
    cgt_bvh_range *range;
    uint32_t ranges;
    uint32_t leaves;
    void *record;          /* of leaves, then inner ones: those of ranges and those above; then lists of children */
    bool nontemporal;      /* blocks exceed the caches */
    void *branch;          /* of each range's root, see kernel/builders/bvh/bvh_binary.h */
    uint32_t root;         /* reference */
    float low[3], high[3]; /* of all */
    cgt_bvh_range top;     /* the nodes over ranges */
    void *node, *block[CGT_KINDS]; /* results, blocks by kind */
    void *turned;                  /* slabs; NULL: no range has bundles */
    uint32_t triangle_blocks;
} cgt_bvh_build;

/* Finds a range's leaves. */
typedef void cgt_bvh_split_fn(const cgt_bvh_build *build, cgt_bvh_range *range);

/* Writes a range's leaf blocks and records, once their places are known. */
typedef void cgt_bvh_leaves_fn(const cgt_bvh_build *build, uint32_t range);

/* Writes the records over the ranges, then chooses the nodes over them. */
typedef void cgt_bvh_join_fn(cgt_bvh_build *build);

/* Chooses a range's nodes. */
typedef void cgt_bvh_choose_fn(const cgt_bvh_build *build, cgt_bvh_range *range);

/* Writes the nodes of a range, or of the top, once their places are known. */
typedef void cgt_bvh_nodes_fn(const cgt_bvh_build *build, const cgt_bvh_range *range);

/* A variant's steps, in the order in which they run. */
typedef struct cgt_bvh_builder {
    uint32_t node_bytes, turned_bytes, block_bytes[CGT_KINDS], leaf_bytes, inner_bytes, branch_bytes;
    uint32_t lanes;

    cgt_prim_keys_fn *keys;
    cgt_cluster_keys_fn *cluster_keys;
    cgt_bvh_split_fn *split;
    cgt_bvh_leaves_fn *leaves;
    cgt_bvh_join_fn *join;
    cgt_bvh_choose_fn *choose;
    cgt_bvh_nodes_fn *nodes;
} cgt_bvh_builder;

#endif
