/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From the valid primitives of a commit to a kd-tree, in two steps: the builder splits boxes (kd_binned.c),
 * which leaves nodes and references with gaps, in the order of its tasks; flattening (kd_flatten.c) brings them into
 * the requested layout, without gaps, and links the leaves (kd_ropes.c). */
#ifndef CGT_KD_BUILD_H
#define CGT_KD_BUILD_H

#include <cgt/research.h>

#include "core/context.h"
#include "papers/model/paper_structures.h"

/* The costs of the surface-area heuristic, in units of one sphere test; measured (docs/reports/grids_and_trees.md). */
typedef struct cgt_kd_costs {
    double inner;         /* a step through an inner node */
    double test[2];       /* a test, by cgt_kind */
    double empty_cut_off; /* a split that leaves one side empty costs this share less */
} cgt_kd_costs;

extern const cgt_kd_costs cgt_kd_default_costs;

/* The tree that a builder produces. Children are side by side, as in cgt_kd_tree; the root is node 0. Word 1 of a leaf
 * is where its primitives begin in `reference`, also of a single one. */
typedef struct cgt_kd_raw {
    const cgt_kd_node *node;
    uint32_t nodes; /* numbers in use are below; some are not in use */
    const uint32_t *reference;
    float low[3], high[3];   /* closed box of the root */
    double cost;             /* by the heuristic, of the whole tree */
    uint32_t limited_leaves; /* leaves that would have been split but for the limits of depth or room */
} cgt_kd_raw;

/* Builds over the valid primitives of the scene, of which there is at least one; coordinates are within
 * CGT_MAX_COORDINATE. The tree depends on the primitives and the costs alone, not on the threads. work:
 * memory that the scene keeps from commit to commit; raw points into it. Fails with OUT_OF_MEMORY or TOO_LARGE, with a
 * message. */
cgt_result cgt_kd_build(cgt_context *context, cgt_buffer *work, const cgt_committed_scene *committed_scene,
                        const cgt_kd_costs *costs, cgt_kd_raw *raw);

/* Where a flattened tree lies. */
typedef struct cgt_kd_memory {
    cgt_buffer *nodes, *references, *leaves;
} cgt_kd_memory;

/* Brings raw into a layout; links the leaves where ropes is set. break_level: of MIXED. */
cgt_result cgt_kd_flatten(cgt_context *context, const cgt_kd_memory *memory, const cgt_kd_raw *raw,
                          cgt_kd_layout layout, uint32_t break_level, bool ropes, cgt_kd_tree *tree);

/* Fills in box and ropes of every leaf of a flattened tree; leaf[i].first and .count are there. */
void cgt_kd_link_leaves(cgt_context *context, const cgt_kd_tree *tree, cgt_kd_leaf *leaf);

#endif
