/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The steps that build a BVH:
 *   1 sizes and middles of all primitives (bound_primitives.c) 2 parts of like primitives, and their cells (bvh_plan.c)
 *   3 the cell of each primitive, its key (kernel/builders/bvh/bvh_keys.c) 4 primitives sorted by key (cell_sort.c) 5
 *   ranges of cells, each a task's work (bvh_ranges.c) 6 runs of primitives that a leaf holds, and where the binary
 *     tree over them parts (kernel/builders/bvh/bvh_split.c)
 *   7 leaf blocks, and binary nodes with boxes and costs from the leaves to the root (bvh_leaves.c)
 *   8 which of these become nodes of the BVH, then those nodes (bvh_nodes.c)
 * The tree depends on the variant and the primitives, not on threads: ranges follow from the cells alone. */
#ifndef CGT_BVH_BUILD_H
#define CGT_BVH_BUILD_H

#include "dispatch/bvh_builder.h"
#include "scene/scene.h"

#define CGT_BVH_PRIMS_PER_CELL 1u /* at most, if evenly spread: surfaces crowd few cells */

/* Plans the parts from the sizes of at least one primitive. */
void cgt_bvh_plan_parts(cgt_bvh_plan *plan, const cgt_size_classes *classes, const cgt_primitives *prims);

/* Returns the most cells that any arrangement of as many primitives or clusters gets: each part has less than twice as
 * many as those, or one. How many of a level are of which kind is not known: it may be all. */
static inline uint64_t cgt_bvh_max_cells(const cgt_primitives *o, uint32_t count)
{
    const uint64_t most = (uint64_t)CGT_BVH_PARTS << CGT_BVH_KEY_BITS;
    const uint64_t cells = 2 * (uint64_t)cgt_primitives_kinds(o) * count + CGT_BVH_PARTS;
    return cells < most ? cells : most;
}

/* A range has no more primitives than a share of all, or one cell. */
#define CGT_BVH_RANGE_PRIMS 4096u /* the share, at least */
#define CGT_BVH_RANGES 256u       /* about, of evenly spread primitives */

/* Lists the ranges in order. Returns how many. range: NULL to count alone. start: of the sort. prims_each: primitives
 * in each of what was sorted. */
uint32_t cgt_bvh_list_ranges(const cgt_bvh_plan *plan, const uint32_t *start, uint32_t prims, uint32_t prims_each,
                             cgt_bvh_range *range);

/* Builds the tree over the committed scene's primitives, of which one is valid, and sets the statistics bvh_*. Fails
 * with a message. */
cgt_result cgt_bvh_build_tree(cgt_scene *scene);

#endif
