/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The steps that build a loose grid:
 *   1 sizes and middles of all objects, or of clusters (bound_primitives.c)   2 levels and cells (size_levels.c)
 *   3 the cell of each object, its key (kernel/loose_grid_keys.c)   4 objects sorted by key (cell_sort.c) */
#ifndef CGT_LOOSE_GRID_BUILD_H
#define CGT_LOOSE_GRID_BUILD_H

#include "core/context.h"
#include "model/loose_grid.h"
#include "model/primitives.h"
#include "model/primitive_bounds.h"
#include "model/triangle_cluster.h"

#define CGT_LOOSE_PRIMS_PER_CELL 8u /* flat between 4 and 16: what a vector culls at once costs the same */

/* ---- planning ---- */

/* Chooses levels and cells from the sizes of at least one object. wanted: the caller's resolution, zeros where it is to
 * be chosen. */
void cgt_loose_grid_plan(cgt_loose_grid *grid, const cgt_size_classes *classes, const uint32_t requested[3]);

/* What cells any arrangement of so many objects gets at most; where none are wanted. */
uint64_t cgt_loose_grid_max_cells(uint32_t prims);

/* ---- sorting ---- */

/* By two digits of the keys, of which the upper one is the bin. Chunks of objects sort their own by bin, side by side,
 * where they are; then each bin gathers its part of every chunk, and sorts it by the lower digit, in cache. Few objects
 * are sorted by whole keys at once, by one thread: that is quicker while their cells' counters stay in its cache. Every
 * move keeps the order, so that objects ascend in a cell and both ways have one result. */
#define CGT_CELL_SORT_CHUNK_BITS 14u
#define CGT_CELL_SORT_CHUNK (UINT32_C(1) << CGT_CELL_SORT_CHUNK_BITS) /* objects */
#define CGT_CELL_SORT_DIRECT 65536u                                   /* objects that are sorted by whole keys */
#define CGT_CELL_SORT_DIRECT_SERIAL 131072u                           /* where there is but one thread */
#define CGT_CELL_SORT_DIRECT_CELLS 262144u                            /* at most: a megabyte of counters */
#define CGT_CELL_SORT_BINS 512u      /* at most, unless the lower digit would not fit into an entry */
#define CGT_CELL_SORT_BIN_CELLS 512u /* at least */

typedef struct cgt_cell_sort {
    uint32_t prims; /* in all, skipped ones included */
    uint32_t valid;
    uint32_t cells;
    bool direct;       /* by whole keys */
    unsigned shift;    /* of a key, to its bin */
    uint32_t bins;     /* skipped objects have one more */
    uint32_t *key;     /* of each object; the memory of `object` where there are bins, else that of `entry` */
    uint32_t *entry;   /* of each object, by chunks, in each by bin: the lower digit, then the number in the chunk */
    uint32_t *bin_end; /* bins + 1 for each stream of a chunk: where its part of a bin ends; then where bins begin */
    uint32_t *start;   /* the result, see cgt_loose_grid */
    uint32_t *prim;
} cgt_cell_sort;

static inline uint32_t cgt_cell_sort_chunks(uint32_t prims)
{
    return (uint32_t)(((uint64_t)prims + CGT_CELL_SORT_CHUNK - 1) / CGT_CELL_SORT_CHUNK);
}

/* Fills in all but the pointers. Skipped objects have the key that it returns. */
uint32_t cgt_cell_sort_plan(cgt_cell_sort *sort, const cgt_context *context, uint32_t prims, uint32_t valid,
                            uint32_t cells);

/* Room for `place`: the same for any frame of so many objects, but for those with more cells than 2^27. */
cgt_result cgt_cell_sort_reserve(const cgt_memory_hooks *hooks, cgt_buffer *bin_end, const cgt_cell_sort *sort);

/* Sorts a chunk, whose keys are made, by bin. */
void cgt_cell_sort_chunk(const cgt_cell_sort *sort, uint32_t chunk);

/* The rest, after all chunks. */
void cgt_cell_sort_run(cgt_cell_sort *sort, const cgt_context *context);

/* Room for middles, and keys or entries behind them; of clusters for these alone. */
static inline cgt_result cgt_cell_sort_reserve_work(const cgt_memory_hooks *hooks, cgt_buffer *work,
                                                    const cgt_primitives *prims, bool clusters)
{
    const uint64_t words = clusters ? cgt_clusters(prims->count) : 4 * (uint64_t)prims->triangles + prims->count;
    if (words > SIZE_MAX / sizeof(uint32_t))
        return CGT_ERROR_TOO_LARGE;
    return cgt_buffer_reserve_scattered(hooks, work, (size_t)words, sizeof(uint32_t));
}

#endif
