/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The steps that build a loose grid:
 *   1 sizes and middles of all objects (summarise.c)   2 levels and cells (loose_grid_plan.c)
 *   3 the cell of each object, its key (kernel/loose_grid_keys.c)   4 objects sorted by key (loose_grid_sort.c) */
#ifndef CGT_LOOSE_GRID_BUILD_H
#define CGT_LOOSE_GRID_BUILD_H

#include "context.h"
#include "loose_grid.h"
#include "objects.h"
#include "summary.h"

#define CGT_LOOSE_OBJECTS_PER_CELL 8u /* flat between 4 and 16: what a vector culls at once costs the same */

/* ---- planning ---- */

/* Chooses levels and cells from the sizes of at least one object. wanted: the caller's resolution, zeros where it is to
 * be chosen. */
void cgt_loose_grid_plan(cgt_loose_grid *grid, const cgt_size_classes *classes, const uint32_t wanted[3]);

/* What cells any arrangement of so many objects gets at most; where none are wanted. */
uint64_t cgt_loose_grid_most_cells(uint32_t objects);

/* ---- sorting ---- */

/* One thread counts and moves all objects by their keys, while the cells' counters stay in its cache, and where objects
 * are few that is quicker than any number of threads. Several, or with more cells, sort by two digits, of which the
 * upper one is the bin: chunks of objects count their bins and move to them, each to places of its own, then each bin is
 * sorted by the lower digit, in cache. Every move keeps the order, so that objects ascend in a cell and both ways have
 * one result. */
#define CGT_LOOSE_CHUNK 16384u         /* objects */
#define CGT_LOOSE_DIRECT_CELLS 262144u /* at most, for one thread; a megabyte of counters */
#define CGT_LOOSE_FEW 65536u           /* objects that one thread sorts, however many there are */
#define CGT_LOOSE_BINS 512u            /* at most */
#define CGT_LOOSE_BIN_CELLS 512u       /* at least */

typedef struct cgt_loose_pair {
    uint32_t key, object;
} cgt_loose_pair;

typedef struct cgt_loose_sort {
    uint32_t objects; /* in all, skipped ones included */
    uint32_t valid;
    uint32_t cells;
    unsigned shift;       /* of a key, to its bin */
    bool direct;          /* without bins */
    uint32_t bins;        /* skipped objects have one more */
    uint32_t *key;        /* of each object; may be the memory of `object` where there are bins */
    cgt_loose_pair *pair; /* all objects by bin; not used without bins */
    uint32_t *place;      /* bins + 1 for each chunk: how many, then where the next one goes */
    uint32_t *start;      /* the result, see cgt_loose_grid */
    uint32_t *object;
} cgt_loose_sort;

static inline bool cgt_loose_sort_is_direct(const cgt_context *context, uint32_t objects, uint32_t cells)
{
    return objects <= CGT_LOOSE_CHUNK ||
           ((objects <= CGT_LOOSE_FEW || !context->tasks.run) && cells <= CGT_LOOSE_DIRECT_CELLS);
}

/* Fills in shift and bins from the cells. */
void cgt_loose_sort_plan(cgt_loose_sort *sort);

/* Counts the bins of one chunk's keys. */
void cgt_loose_sort_count(const cgt_loose_sort *sort, uint32_t chunk);

/* Sorts, after all chunks were counted. */
void cgt_loose_sort_run(cgt_loose_sort *sort, const cgt_context *context);

/* Room for middles and then keys, or for pairs, which come when both are read. */
static inline cgt_result cgt_loose_grid_reserve_work(const cgt_memory_hooks *hooks, cgt_buffer *work,
                                                     const cgt_objects *objects)
{
    const uint64_t keys = 4 * (uint64_t)objects->triangles + objects->count, pairs = 2 * (uint64_t)objects->count;
    const uint64_t words = keys > pairs ? keys : pairs;
    if (words > SIZE_MAX / sizeof(uint32_t))
        return CGT_ERROR_TOO_LARGE;
    return cgt_buffer_reserve_scattered(hooks, work, (size_t)words, sizeof(uint32_t));
}

#endif
