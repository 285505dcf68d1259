/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The caches of nodes, references and leaves (thesis, sections 7.6.2 to 7.6.4): direct mapped, in blocks of consecutive
 * elements, each with its own share of the arena. A miss waits for its block. The thesis looks whether a node is there
 * before each step and fetches index lists and boxes with the nodes; here each cache is asked for what is read from it
 * alone. Blocks depend on nothing but the number of an element, so no entry of a stack needs more than a node. */
#ifndef KD_CACHES_H
#define KD_CACHES_H

#include "cell/programs/kd/kd_store.h"

/* Lays the cache out from `first` in the arena on. Returns where it ends. */
static uint32_t kd_cache_lay_out(kd_cache *c, const cgt_kd_cache_size *size, uint32_t element, uint32_t first)
{
    c->first.is = first;
    c->log2.is = size->log2;
    c->mask.is = size->blocks - 1;
    return first + ((size->blocks * element << size->log2) + 127) / 128 * 128;
}

/* Empties it, for another array. */
static void kd_cache_start(kd_cache *c, const uint32_t ea[2], uint32_t total)
{
    c->ea[0] = ea[0];
    c->ea[1] = ea[1];
    c->total = total;
    for (uint32_t k = 0; k <= c->mask.is; k++)
        c->tag[k].is = UINT32_MAX;
}

static __attribute__((noinline)) void kd_cache_fetch(kd_cache *c, uint32_t block, uint32_t element)
{
    const uint32_t log2 = c->log2.is, slot = block & c->mask.is, first = block << log2, left = c->total - first;
    const uint32_t count = left < 1u << log2 ? left : 1u << log2;
    mfc_get(s()->arena + c->first.is + (slot * element << log2), kd_ea(c->ea) + first * element,
            (count * element + 15) / 16 * 16, TAG_BLOCK, 0, 0);
    c->tag[slot].is = block;
    c->fetches++;
    kd_wait(1u << TAG_BLOCK);
}

/* Element i; what follows it in its block is there, too. */
static inline const void *kd_cache_get(kd_cache *c, uint32_t i, uint32_t element)
{
    const uint32_t log2 = c->log2.is, block = i >> log2, slot = block & c->mask.is;
    if (__builtin_expect(c->tag[slot].is != block, 0))
        kd_cache_fetch(c, block, element);
    return s()->arena + c->first.is + element * ((slot << log2) + (i & ((1u << log2) - 1)));
}

/* The scene is broken; an inner node whose children do not come after it becomes an empty leaf. */
static __attribute__((noinline)) void kd_mend_nodes(cgt_kd_node *node, uint32_t first, uint32_t count)
{
    kd_break();
    for (uint32_t k = 0; k < count; k++)
        if (!cgt_kd_is_leaf(node[k]) && node[k].word[1] <= first + k)
            node[k] = cgt_kd_leaf_node(0, 0);
}

/* Of two nodes, the ones whose children do not come after them: words 1 and 3. number: of the nodes, there. */
static inline vmask kd_wrong_children(const cgt_kd_node *node, vuint number)
{
    const vuint q = spux_load_uint(node->word), three = spux_vuint(3);
#if defined(__SPU__)
    const vec_uchar16 below = CGT_SPUX_LANES(0, 0, 2, 2);
    const vuint kind = spu_shuffle(q, q, below);
#else
    const vuint kind = {q[0], q[0], q[2], q[2]};
#endif
    const vmask leaf = spu_cmpeq(spu_and(kind, three), three);
    return spux_not(spu_or(leaf, spu_cmpgt(q, number)));
}

/* A block of nodes, an even number. Children come after their parents in all layouts: looked at here, once a block, that
 * ends each way down, whatever the nodes are, and the traversal has nothing to count. Node 1 is not used. */
static __attribute__((noinline)) void kd_fetch_nodes(uint32_t block)
{
    kd_cache *const c = &s()->nodes;
    const uint32_t count = 1u << c->log2.is, first = block * count;
    kd_cache_fetch(c, block, sizeof(cgt_kd_node));
    cgt_kd_node *const node =
        (cgt_kd_node *)(void *)(s()->arena + c->first.is + ((block & c->mask.is) * count) * sizeof(cgt_kd_node));
    if (!block)
        node[1] = cgt_kd_leaf_node(0, 0);
    for (uint32_t k = c->total - first; k < count; k++) /* behind the last node */
        node[k] = cgt_kd_leaf_node(0, 0);
    vuint number = {0, first, 0, first + 1};
    vmask wrong = kd_wrong_children(node, number), others = wrong;
    if (count >= 8) /* four independent chains at a time */
        for (uint32_t k = 0; k < count; k += 8, number = spu_add(number, spux_vuint(8))) {
            const vmask pair0 = kd_wrong_children(node + k, number);
            const vmask pair1 = kd_wrong_children(node + k + 2, spu_add(number, spux_vuint(2)));
            const vmask pair2 = kd_wrong_children(node + k + 4, spu_add(number, spux_vuint(4)));
            const vmask pair3 = kd_wrong_children(node + k + 6, spu_add(number, spux_vuint(6)));
            wrong = spu_or(wrong, spu_or(pair0, pair1));
            others = spu_or(others, spu_or(pair2, pair3));
        }
    else if (count == 4)
        others = kd_wrong_children(node + 2, spu_add(number, spux_vuint(2)));
    if (__builtin_expect((spux_mask_bits(spu_or(wrong, others)) & 10) != 0, 0))
        kd_mend_nodes(node, first, count);
}

static inline const cgt_kd_node *kd_get_nodes(uint32_t i)
{
    kd_cache *const c = &s()->nodes;
    const uint32_t log2 = c->log2.is, block = i >> log2, slot = block & c->mask.is;
    if (__builtin_expect(c->tag[slot].is != block, 0))
        kd_fetch_nodes(block);
    return (const cgt_kd_node *)(const void *)(s()->arena + c->first.is) + ((slot << log2) + (i & ((1u << log2) - 1)));
}

static inline const cgt_kd_leaf *kd_get_leaf(uint32_t i) { return kd_cache_get(&s()->leaves, i, sizeof(cgt_kd_leaf)); }

/* References from i on; *count: as many as lie there. */
static inline const uint32_t *kd_get_references(uint32_t i, uint32_t *count)
{
    const uint32_t *const r = kd_cache_get(&s()->references, i, sizeof(uint32_t));
    const uint32_t block = 1u << s()->references.log2.is;
    *count = block - (i & (block - 1));
    return r;
}

#endif
