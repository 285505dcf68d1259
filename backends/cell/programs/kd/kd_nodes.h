/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The cache of nodes (kd_caches.h), of a kd-tree or of a bounding interval hierarchy, and the guard of trees that are
 * none. */
#ifndef KD_NODES_H
#define KD_NODES_H

#include "cell/programs/kd/kd_caches.h"

/* ---- words of nodes ---- */

#if KD_IS_BIH
static inline bool kd_node_is_leaf(kd_node n) { return cgt_bih_is_leaf(&n); }
static inline uint32_t kd_node_count(kd_node n) { return cgt_bih_count(&n); }
static inline uint32_t kd_node_child(kd_node n) { return n.word[3]; }
static inline kd_node kd_empty_leaf(void) { return (kd_node){{3, 0, 0, 0}}; }
#else
static inline bool kd_node_is_leaf(kd_node n) { return cgt_kd_is_leaf(n); }
static inline uint32_t kd_node_count(kd_node n) { return cgt_kd_count(n); }
static inline uint32_t kd_node_child(kd_node n) { return n.word[1]; }
static inline kd_node kd_empty_leaf(void) { return cgt_kd_leaf_node(0, 0); }
#endif

/* ---- the guard ---- */

/* Children begin at even numbers, so that a block holds both, and come after their parent. */
static inline bool kd_is_child(uint32_t child, uint32_t parent) { return child % 2 == 0 && child > parent; }
static inline vmask kd_is_even(vuint q) { return spu_cmpeq(spu_and(q, spux_vuint(1)), spux_vuint(0)); }

/* The scene is broken; an inner node whose children are none becomes an empty leaf. */
static __attribute__((noinline)) void kd_mend_nodes(kd_node *node, uint32_t first, uint32_t count)
{
    kd_break();
    for (uint32_t k = 0; k < count; k++)
        if (!kd_node_is_leaf(node[k]) && !kd_is_child(kd_node_child(node[k]), first + k))
            node[k] = kd_empty_leaf();
}

#if KD_IS_BIH

#define KD_QUADWORD_NODES 1u
#define KD_FIRST_NUMBERS(first) spux_vuint(first)
#define KD_CHILD_WORDS 8u

/* Whether the children of a node are none: word 3. */
static inline vmask kd_wrong_children(const kd_node *node, vuint number)
{
    const vuint q = spux_load_uint(node->word), three = spux_vuint(3);
#if defined(__SPU__)
    const vec_uchar16 kinds = CGT_SPUX_LANES(0, 0, 0, 0);
    const vuint kind = spu_shuffle(q, q, kinds);
#else
    const vuint kind = spux_vuint(q[0]);
#endif
    const vmask leaf = spu_cmpeq(spu_and(kind, three), three);
    return spux_not(spu_or(leaf, spu_and(spu_cmpgt(q, number), kd_is_even(q))));
}

#else

#define KD_QUADWORD_NODES 2u
#define KD_FIRST_NUMBERS(first) ((vuint){0, (first), 0, (first) + 1})
#define KD_CHILD_WORDS 10u

/* Of two nodes, the ones whose children are none: words 1 and 3. number: of the nodes, there. */
static inline vmask kd_wrong_children(const kd_node *node, vuint number)
{
    const vuint q = spux_load_uint(node->word), three = spux_vuint(3);
#if defined(__SPU__)
    const vec_uchar16 below = CGT_SPUX_LANES(0, 0, 2, 2);
    const vuint kind = spu_shuffle(q, q, below);
#else
    const vuint kind = {q[0], q[0], q[2], q[2]};
#endif
    const vmask leaf = spu_cmpeq(spu_and(kind, three), three);
    return spux_not(spu_or(leaf, spu_and(spu_cmpgt(q, number), kd_is_even(q))));
}

#endif

/* Whether some node of a block has no children where it says that they are. */
static inline bool kd_has_wrong_children(const kd_node *node, uint32_t first, uint32_t count)
{
    const uint32_t some = KD_QUADWORD_NODES;
    vuint number = KD_FIRST_NUMBERS(first);
    vmask wrong = kd_wrong_children(node, number), others = wrong;
    if (count >= 4 * some) /* four independent chains at a time */
        for (uint32_t k = 0; k < count; k += 4 * some, number = spu_add(number, spux_vuint(4 * some))) {
            const vmask q0 = kd_wrong_children(node + k, number);
            const vmask q1 = kd_wrong_children(node + k + some, spu_add(number, spux_vuint(some)));
            const vmask q2 = kd_wrong_children(node + k + 2 * some, spu_add(number, spux_vuint(2 * some)));
            const vmask q3 = kd_wrong_children(node + k + 3 * some, spu_add(number, spux_vuint(3 * some)));
            wrong = spu_or(wrong, spu_or(q0, q1));
            others = spu_or(others, spu_or(q2, q3));
        }
    else if (count == 2 * some)
        others = kd_wrong_children(node + some, spu_add(number, spux_vuint(some)));
    return (spux_mask_bits(spu_or(wrong, others)) & KD_CHILD_WORDS) != 0;
}

/* ---- the cache ---- */

/* A block of nodes, an even number. Children come after their parents in all layouts: looked at here, once a block,
 * that ends each way down, whatever the nodes are, and the traversal has nothing to count. Node 1 is not used. */
static __attribute__((noinline)) void kd_fetch_nodes(uint32_t block)
{
    kd_cache *const c = &s()->nodes;
    const uint32_t count = 1u << c->log2.is, first = block * count, slot = block & c->mask.is;
    const uint32_t there = first < c->total ? c->total - first : 0;
    kd_node *const node = (kd_node *)(void *)(s()->arena + c->first.is + slot * count * sizeof(kd_node));
    if (there)
        kd_cache_fetch(c, block, sizeof(kd_node));
    else
        kd_break();
    c->tag[slot].is = block;
    if (!block)
        node[1] = kd_empty_leaf();
    for (uint32_t k = there; k < count; k++) /* behind the last node */
        node[k] = kd_empty_leaf();
    if (__builtin_expect(kd_has_wrong_children(node, first, count), 0))
        kd_mend_nodes(node, first, count);
}

static inline const kd_node *kd_get_nodes(uint32_t i)
{
    kd_cache *const c = &s()->nodes;
    const uint32_t log2 = c->log2.is, block = i >> log2, slot = block & c->mask.is;
    if (__builtin_expect(c->tag[slot].is != block, 0))
        kd_fetch_nodes(block);
    return (const kd_node *)(const void *)(s()->arena + c->first.is) + ((slot << log2) + (i & ((1u << log2) - 1)));
}

#endif
