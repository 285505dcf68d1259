/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The kd-tree (thesis, chapter 4): a plane across an axis cuts a box in two, and each half again, down to leaves that
 * list the primitives whose clipped bounds touch them. One array of nodes of 8 bytes, without pointers, suits DMA. The
 * two children of a node lie side by side, so that one number addresses both.
 *
 *   inner   word 0  the split, a float whose two lowest bits hold the axis: 0, 1, 2. The split is rounded to the
 *                   other bits before primitives are sorted to sides: build and traversal use the same plane
 *           word 1  node of the lower child; the upper one follows it
 *   leaf    word 0  primitives << 2 | 3
 *           word 1  primitives 0: nothing; 1: the primitive; more: where they begin in `reference`
 *           with ropes: number of the leaf, in the order of the nodes; its references begin at leaf[number].first
 *
 * Boxes are closed: a primitive that touches a split plane is in the leaves on both sides of it. So the exact point of
 * every hit lies in a leaf that lists the primitive, whichever of the leaves at an edge is searched.
 *
 * Ropes (Popov, Guenther, Seidel, Slusallek, "Stackless KD-Tree Traversal for High Performance GPU Ray Tracing", 2007):
 * each leaf has its box and, for each of its six faces, the node on the other side: rope[2 a] beyond the lower face of
 * axis a, rope[2 a + 1] beyond the upper one; CGT_INVALID_ID where the tree ends. Ropes of packets lead to the sibling
 * of an ancestor, whose face holds the leaf's; those of single rays are pushed down to the smallest node that still
 * holds the whole face. */
#ifndef CGT_KD_TREE_H
#define CGT_KD_TREE_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* 8 + 1.3 log2(2^32) = 49.6; the builders keep below, and so stacks of traversals have this length. */
#define CGT_KD_MAX_DEPTH 50u
#define CGT_KD_MAX_NODES 0x7fffffffu

typedef struct cgt_kd_node {
    uint32_t word[2];
} cgt_kd_node;

typedef struct cgt_kd_leaf {
    float low[3], high[3]; /* closed box */
    uint32_t first;        /* in `reference`, also of one primitive alone */
    uint32_t count;
    uint32_t rope[6];        /* of single rays */
    uint32_t packet_rope[6]; /* of packets */
} cgt_kd_leaf;

typedef struct cgt_kd_tree {
    const cgt_kd_node *node;   /* the root is node 0; node 1 is not used, so that children are aligned to 16 bytes */
    uint32_t nodes;            /* the unused one included */
    const uint32_t *reference; /* primitives of the leaves, ascending in each */
    uint64_t references;
    float low[3], high[3]; /* closed box of the root */
    uint32_t depth;        /* inner nodes on the longest way from the root to a leaf */
    uint32_t leaves, empty_leaves;
    const cgt_kd_leaf *leaf; /* with ropes; else NULL */
} cgt_kd_tree;

static inline bool cgt_kd_is_leaf(cgt_kd_node n) { return (n.word[0] & 3) == 3; }
static inline uint32_t cgt_kd_axis(cgt_kd_node n) { return n.word[0] & 3; }
static inline uint32_t cgt_kd_count(cgt_kd_node n) { return n.word[0] >> 2; }

/* The split of an inner node. */
static inline float cgt_kd_split(cgt_kd_node n)
{
    const uint32_t bits = n.word[0] & ~3u;
    float split;
    memcpy(&split, &bits, sizeof split);
    return split;
}

/* The nearest float not above `split` in magnitude that a node can hold. */
static inline float cgt_kd_round_split(float split)
{
    uint32_t bits;
    memcpy(&bits, &split, sizeof bits);
    bits &= ~3u;
    memcpy(&split, &bits, sizeof split);
    return split;
}

static inline cgt_kd_node cgt_kd_inner(uint32_t axis, float split, uint32_t lower)
{
    cgt_kd_node n = {{0, lower}};
    memcpy(&n.word[0], &split, sizeof split);
    n.word[0] = (n.word[0] & ~3u) | axis;
    return n;
}

static inline cgt_kd_node cgt_kd_leaf_node(uint32_t count, uint32_t index)
{
    return (cgt_kd_node){{count << 2 | 3, index}};
}

/* The primitives of a leaf node. */
static inline const uint32_t *cgt_kd_references(const cgt_kd_tree *tree, const cgt_kd_node *leaf)
{
    if (tree->leaf)
        return tree->reference + tree->leaf[leaf->word[1]].first;
    return cgt_kd_count(*leaf) == 1 ? &leaf->word[1] : tree->reference + leaf->word[1];
}

#endif
