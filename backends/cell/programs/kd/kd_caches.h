/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The caches of nodes (kd_nodes.h), references and leaves (thesis, sections 7.6.2 to 7.6.4): direct mapped, in blocks
 * of consecutive elements, each with its own share of the arena. A miss waits for its block. The thesis looks whether a
 * node is there before each step and fetches index lists and boxes with the nodes; here each cache is asked for what is
 * read from it alone. Blocks depend on nothing but the number of an element, so no entry of a stack needs more than a
 * node. */
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
