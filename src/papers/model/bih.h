/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The bounding interval hierarchy (Waechter, Keller, "Instant Ray Tracing: The Bounding Interval Hierarchy", 2006):
 * each primitive is in one leaf, and an inner node tells along one axis where its lower child ends and where its upper
 * child begins. The two may overlap, or leave a gap. So the number of nodes is known before the build, as for a BVH,
 * but a node is as small as that of a kd-tree: 16 bytes, of which a DMA takes eight in a line of 128. The paper's 12
 * bytes would straddle lines; here the fourth word frees the child's number from sharing its bits with the axis, and
 * lets a leaf hold three primitives without a reference. The two children of a node lie side by side, in 32 aligned
 * bytes.
 *
 *   split   word 0  the axis: 0, 1, 2
 *           word 1  the upper end of the lower child
 *           word 2  the lower end of the upper child
 *           word 3  node of the lower child; the upper one follows it
 *   clip    word 0  4 + the axis
 *           word 1  the lower end of the only child
 *           word 2  its upper end
 *           word 3  node of the child
 *   leaf    word 0  primitives << 3 | 3
 *           words 1 to 3  up to three primitives; more: word 1 is where they begin in `reference`
 *
 * Clip nodes cut off empty space on both sides of a subtree, which splits alone would cut level by level.
 *
 * Planes are moved outwards by CGT_BIH_MARGIN of their size, and CGT_BIH_LEAST_MARGIN, when a node is written, so that
 * a large primitive widens its own interval alone. What a traversal adds is in papers/kernel/bih/bih_rays.h. */
#ifndef CGT_BIH_H
#define CGT_BIH_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* Splits on the longest way from the root: the builder keeps it, and so stacks of traversals have this length. 2^27
 * primitives need 27 where each split halves them; the others are left to splits that do not. */
#define CGT_BIH_MAX_DEPTH 50u
#define CGT_BIH_MAX_PRIMS (1u << 27)
#define CGT_BIH_INLINE_PRIMS 3u
#define CGT_BIH_MARGIN 0x1p-19f
#define CGT_BIH_LEAST_MARGIN 0x1p-100f

typedef struct cgt_bih_node {
    uint32_t word[4];
} cgt_bih_node;

typedef struct cgt_bih {
    const cgt_bih_node *node;  /* the root is node 0; node 1 is not used */
    const uint32_t *reference; /* primitives of leaves with more than three */
    float low[3], high[3];     /* closed box of the root */
    uint32_t node_slots;       /* numbers of nodes are below; between the slices of tasks some are not in use */
    uint32_t nodes;            /* in use: splits, clips and leaves */
    uint32_t leaves, clips;
    uint32_t depth;        /* splits on the longest way from the root to a leaf */
    uint32_t largest_leaf; /* primitives */
    uint64_t references;   /* in use */
} cgt_bih;

static inline bool cgt_bih_is_leaf(const cgt_bih_node *n) { return (n->word[0] & 3) == 3; }
static inline bool cgt_bih_is_clip(const cgt_bih_node *n) { return n->word[0] & 4; }
static inline uint32_t cgt_bih_axis(const cgt_bih_node *n) { return n->word[0] & 3; }
static inline uint32_t cgt_bih_count(const cgt_bih_node *n) { return n->word[0] >> 3; }

/* Plane 0 or 1 of an inner node: words 1 and 2. */
static inline float cgt_bih_plane(const cgt_bih_node *n, uint32_t number)
{
    float plane;
    memcpy(&plane, &n->word[1 + number], sizeof plane);
    return plane;
}

static inline cgt_bih_node cgt_bih_inner(uint32_t axis, bool clip, float first, float second, uint32_t child)
{
    cgt_bih_node n = {{axis | (uint32_t)clip << 2, 0, 0, child}};
    memcpy(&n.word[1], &first, sizeof first);
    memcpy(&n.word[2], &second, sizeof second);
    return n;
}

/* The primitives of a leaf. */
static inline const uint32_t *cgt_bih_references(const cgt_bih *tree, const cgt_bih_node *leaf)
{
    return cgt_bih_count(leaf) <= CGT_BIH_INLINE_PRIMS ? &leaf->word[1] : tree->reference + leaf->word[1];
}

#endif
