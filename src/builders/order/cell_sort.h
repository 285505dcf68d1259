/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Primitives, or clusters of triangles, sorted by cell: from their bounds to lists of each cell's primitives.
 *
 * Keys have two digits, of which the upper one is the bin. Chunks of primitives are sorted by bin in place, side by
 * side; then each bin gathers its part of every chunk and sorts it by the lower digit, in cache. Few primitives are
 * sorted by whole keys at once, by one thread: that is faster while the cells' counters stay in its cache. Every move
 * keeps the order, so that primitives ascend within a cell and both ways have one result. */
#ifndef CGT_CELL_SORT_H
#define CGT_CELL_SORT_H

#include <stdatomic.h>

#include "dispatch/kernel.h"
#include "model/triangle_cluster.h"
#include "scene/scene.h"

#define CGT_CELL_SORT_DIRECT_SERIAL 131072u /* by whole keys up to as many, where there is one thread */

#define CGT_CELL_SORT_CROWD 256u /* primitives: more of them crowd a cell */

typedef struct cgt_cell_sort {
    /* what is sorted, and the functions that find its cells: set by the caller */
    const cgt_primitives *prims;
    const cgt_cluster *cluster; /* sorted instead of primitives; NULL: none */
    cgt_prim_keys_fn *prim_keys;
    cgt_cluster_keys_fn *cluster_keys;
    cgt_cell_keys keys;
    /* the plan */
    uint32_t count; /* primitives or clusters, skipped ones included */
    uint32_t valid;
    uint32_t cells;
    bool direct;    /* by whole keys */
    unsigned shift; /* from a key to its bin */
    uint32_t bins;  /* skipped primitives have one more */
    /* memory */
    uint32_t *key;     /* of each primitive; the memory of `prim` where there are bins, else that of `entry` */
    uint32_t *entry;   /* of each primitive, by chunks, in each by bin: the lower digit, then the number in the chunk */
    uint32_t *bin_end; /* bins + 1 for each subchunk: where its part of a bin ends; then where bins begin */
    /* results */
    uint32_t *start;        /* cell c holds prim[start[c]] to prim[start[c + 1] - 1]; cells + 1 of them */
    uint32_t *prim;         /* all valid ones, ascending in each cell */
    atomic_bool is_crowded; /* some cell is */
} cgt_cell_sort;

/* Plans the sort of a scene's primitives, or of its clusters where `cluster` is not NULL, into cells. plan: where those
 * lie. */
void cgt_cell_sort_plan(cgt_cell_sort *sort, const cgt_scene *scene, const cgt_cluster *cluster, const void *plan,
                        uint32_t cells);

/* Reserves memory: `cells` starts, at least those of the plan, in one of the scene's buffers, and the primitives in
 * another. Bins get the same room for any frame of as many primitives, except with more than 2^27 cells. */
cgt_result cgt_cell_sort_reserve(cgt_cell_sort *sort, cgt_scene *scene, cgt_scene_buffer start, uint64_t cells,
                                 cgt_scene_buffer prim);

/* Reserves CGT_BUFFER_CELL_SORT_WORK: middles of boxed primitives, then keys or entries; of clusters these alone. */
cgt_result cgt_cell_sort_reserve_work(cgt_scene *scene, bool clusters);

/* Finds the keys, and sorts. */
void cgt_cell_sort_run(cgt_cell_sort *sort, const cgt_context *context);

#endif
