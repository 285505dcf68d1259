/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a variant offers to the builders of the papers. */
#ifndef CGT_PAPER_KERNELS_H
#define CGT_PAPER_KERNELS_H

#include "dispatch/kernel.h"
#include "papers/model/queue_grid.h"

/* Where a fill puts references that found a full queue. */
typedef struct cgt_overflow_list {
    cgt_overflow *entry;
    uint32_t count, capacity;
    uint32_t needed_entries; /* for the next primitive, where the fill stopped for lack of room */
} cgt_overflow_list;

typedef struct cgt_fill_counts {
    uint64_t references;
    uint32_t large_primitives;
} cgt_fill_counts;

/* Pushes the valid primitives from first to end - 1 to the voxels, in ascending order. Returns end, or the primitive
 * before which it stopped because the overflow list might not hold what that one spills. */
typedef uint32_t cgt_queue_grid_fill_fn(const cgt_queue_grid *grid, uint32_t first, uint32_t end,
                                        cgt_overflow_list *overflow, cgt_fill_counts *counts);

typedef struct cgt_paper_kernels {
    cgt_queue_grid_fill_fn *queue_grid_fill;
} cgt_paper_kernels;

#endif
