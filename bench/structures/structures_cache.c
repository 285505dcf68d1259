/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All memories see the same sequence of nodes in one pass. Of LRU memories with blocks of one size the larger always
 * holds what the smaller does (Mattson et al. 1970), so that one list of blocks, the latest first, gives the misses of
 * all: a block past position n misses in the memories of at most n blocks. */
#include "structures/structures_cache.h"

#include <stdlib.h>
#include <string.h>

enum {
    LEAST_BLOCK = 128, /* bytes, of a transfer */
    LEAST_LINE = 64,   /* of RAY */
    BLOCK_SIZES = 6,   /* 128 to 4,096 bytes */
    LEAST_MEMORY = 4096,
    MEMORIES = 4, /* 4 to 32 KB */
    MOST_BLOCKS = LEAST_MEMORY << (MEMORIES - 1) >> 7,
    WINDOWS = 9, /* 128 bytes to 32 KB */
    TOPS = WINDOWS - 1,
    LINES = BLOCK_SIZES + 1,
    COUNTS = 2 * BLOCK_SIZES * MEMORIES + WINDOWS + TOPS + LINES
};

#define NOTHING UINT32_MAX

typedef struct block_size {
    uint32_t shift;             /* nodes of a block: 1 << shift */
    uint32_t list[MOST_BLOCKS]; /* the latest first */
    uint32_t listed;
    uint32_t place[MEMORIES][MOST_BLOCKS]; /* of the direct-mapped memories */
    cache_count *lru[MEMORIES], *direct[MEMORIES];
} block_size;

typedef struct window {
    uint32_t first; /* node; NOTHING: empty */
    uint32_t nodes;
    uint32_t top; /* nodes held permanently */
    cache_count *count;
} window;

typedef struct line_size {
    uint32_t shift;
    uint64_t *ray; /* of each block: the last ray that read it */
    cache_count *count;
} line_size;

struct cache_set {
    uint32_t nodes;
    uint64_t reads, rays;
    uint32_t counts;
    cache_count count[COUNTS];
    block_size block[BLOCK_SIZES];
    window window[WINDOWS + TOPS];
    line_size line[LINES];
};

static cache_count *add_count(cache_set *set, cache_kind kind, uint32_t block_bytes, uint32_t bytes)
{
    cache_count *count = &set->count[set->counts++];
    *count = (cache_count){.kind = kind, .block_bytes = block_bytes, .bytes = bytes};
    return count;
}

static uint32_t log2_nodes(uint32_t bytes)
{
    uint32_t shift = 0;
    while ((uint32_t)CACHE_NODE_BYTES << shift < bytes)
        shift++;
    return shift;
}

static void make_blocks(cache_set *set)
{
    for (uint32_t b = 0; b < BLOCK_SIZES; b++) {
        block_size *size = &set->block[b];
        const uint32_t bytes = (uint32_t)LEAST_BLOCK << b;
        size->shift = log2_nodes(bytes);
        memset(size->place, 0xff, sizeof size->place); /* NOTHING */
        for (uint32_t m = 0; m < MEMORIES; m++) {
            size->direct[m] = add_count(set, CACHE_DIRECT, bytes, (uint32_t)LEAST_MEMORY << m);
            size->lru[m] = add_count(set, CACHE_LRU, bytes, (uint32_t)LEAST_MEMORY << m);
        }
    }
}

static void make_windows(cache_set *set)
{
    for (uint32_t w = 0; w < WINDOWS + TOPS; w++) {
        window *one = &set->window[w];
        const int top = w >= WINDOWS;
        const uint32_t bytes = (uint32_t)LEAST_BLOCK << (top ? w - WINDOWS : w);
        one->first = NOTHING;
        one->nodes = bytes / CACHE_NODE_BYTES;
        one->top = top ? one->nodes : 0;
        one->count = add_count(set, top ? CACHE_TOP : CACHE_WINDOW, bytes, top ? 2 * bytes : bytes);
    }
}

/* 0, or -1 where memory is refused. */
static int make_lines(cache_set *set)
{
    for (uint32_t l = 0; l < LINES; l++) {
        line_size *line = &set->line[l];
        line->shift = log2_nodes((uint32_t)LEAST_LINE << l);
        line->count = add_count(set, CACHE_RAY, (uint32_t)LEAST_LINE << l, 0);
        line->ray = calloc(((size_t)set->nodes >> line->shift) + 1, sizeof *line->ray);
        if (!line->ray)
            return -1;
    }
    return 0;
}

cache_set *cache_set_create(uint32_t nodes)
{
    cache_set *set = calloc(1, sizeof *set);
    if (!set)
        return NULL;
    set->nodes = nodes;
    make_blocks(set);
    make_windows(set);
    if (make_lines(set)) {
        cache_set_release(set);
        return NULL;
    }
    return set;
}

void cache_set_release(cache_set *set)
{
    if (!set)
        return;
    for (uint32_t l = 0; l < LINES; l++)
        free(set->line[l].ray);
    free(set);
}

/* ---- Reading ------------------------------------------------------------------------------------------------- */

static void miss(const cache_set *set, cache_count *count, uint32_t first, uint32_t nodes)
{
    const uint32_t remaining = set->nodes - first;
    count->misses++;
    count->bytes_transfer += (uint64_t)CACHE_NODE_BYTES * (remaining < nodes ? remaining : nodes);
}

/* Moves a block to the head of the list and returns its former position; MOST_BLOCKS if it was not in the list. */
static uint32_t use_block(block_size *size, uint32_t block)
{
    uint32_t at = 0;
    while (at < size->listed && size->list[at] != block)
        at++;
    const int known = at < size->listed;
    if (!known && size->listed < MOST_BLOCKS)
        size->listed++;
    const uint32_t end = known ? at : size->listed - 1;
    memmove(size->list + 1, size->list, end * sizeof *size->list);
    size->list[0] = block;
    return known ? at : MOST_BLOCKS;
}

static void read_block(cache_set *set, block_size *size, uint32_t node)
{
    const uint32_t block = node >> size->shift, first = block << size->shift;
    if (size->listed && size->list[0] == block) /* the last one once more: no memory misses it */
        return;
    const uint32_t at = use_block(size, block);
    for (uint32_t m = 0; m < MEMORIES; m++) {
        const uint32_t places = ((uint32_t)LEAST_MEMORY << m) / CACHE_NODE_BYTES >> size->shift;
        uint32_t *place = &size->place[m][block % places];
        if (at >= places)
            miss(set, size->lru[m], first, 1u << size->shift);
        if (*place != block)
            miss(set, size->direct[m], first, 1u << size->shift);
        *place = block;
    }
}

static void read_window(cache_set *set, window *w, uint32_t node)
{
    if (node < w->top || (w->first != NOTHING && node >= w->first && node - w->first < w->nodes))
        return;
    w->first = node & ~1u; /* children lie in pairs */
    miss(set, w->count, w->first, w->nodes);
}

void cache_set_ray(cache_set *set) { set->rays++; }

void cache_set_read(cache_set *set, uint32_t node)
{
    set->reads++;
    for (uint32_t b = 0; b < BLOCK_SIZES; b++)
        read_block(set, &set->block[b], node);
    for (uint32_t w = 0; w < WINDOWS + TOPS; w++)
        read_window(set, &set->window[w], node);
    for (uint32_t l = 0; l < LINES; l++) {
        line_size *line = &set->line[l];
        const uint32_t block = node >> line->shift;
        if (line->ray[block] == set->rays)
            continue;
        line->ray[block] = set->rays;
        miss(set, line->count, block << line->shift, 1u << line->shift);
    }
}

uint64_t cache_set_reads(const cache_set *set) { return set->reads; }

const cache_count *cache_set_count(const cache_set *set, uint32_t index)
{
    return index < set->counts ? &set->count[index] : NULL;
}

const char *cache_kind_name(cache_kind kind)
{
    static const char *const names[] = {[CACHE_DIRECT] = "direct",
                                        [CACHE_LRU] = "lru",
                                        [CACHE_WINDOW] = "window",
                                        [CACHE_TOP] = "top",
                                        [CACHE_RAY] = "ray"};
    return names[kind];
}
