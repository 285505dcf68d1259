/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small memories through which a kd-tree's nodes might be read, as on a processor that reaches the main memory by
 * block transfers only. Each counts the transfers that a sequence of nodes causes.
 *   DIRECT   direct-mapped blocks of equal size
 *   LRU      blocks of equal size, fully associative; replaces the least recently used
 *   WINDOW   one run of nodes, beginning at the pair of the node that was missing: the thesis' node cache
 *   TOP      half of the memory permanently holds the tree's first nodes, the other half is a window
 *   RAY      blocks of equal size, unlimited, but empty at the beginning of each ray */
#ifndef STRUCTURES_CACHE_H
#define STRUCTURES_CACHE_H

#include <stdint.h>

typedef enum cache_kind { CACHE_DIRECT, CACHE_LRU, CACHE_WINDOW, CACHE_TOP, CACHE_RAY } cache_kind;

enum { CACHE_NODE_BYTES = 8 };

/* One memory and its transfers. */
typedef struct cache_count {
    cache_kind kind;
    uint32_t block_bytes;    /* of a transfer */
    uint32_t bytes;          /* of the memory; 0: unlimited */
    uint64_t misses;         /* transfers */
    uint64_t bytes_transfer; /* that they moved; the end of the tree cuts the last one short */
} cache_count;

typedef struct cache_set cache_set;

/* All memories over a tree of `nodes` nodes. NULL where memory is refused. */
cache_set *cache_set_create(uint32_t nodes);

/* NULL: does nothing. */
void cache_set_release(cache_set *set);

/* A ray begins; a node is read. */
void cache_set_ray(cache_set *set);
void cache_set_read(cache_set *set, uint32_t node);

uint64_t cache_set_reads(const cache_set *set);

/* The memories, from 0; NULL past the last. */
const cache_count *cache_set_count(const cache_set *set, uint32_t index);

const char *cache_kind_name(cache_kind kind);

#endif
