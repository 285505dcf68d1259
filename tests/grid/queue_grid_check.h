/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What every queue grid keeps, whatever its references are of: no cell refers to a primitive twice, queues and overflow
 * list are in order, and the statistics are those of a recount. */
#ifndef QUEUE_GRID_CHECK_H
#define QUEUE_GRID_CHECK_H

#include "papers/model/paper_structures.h"
#include "scene/scene.h"
#include "support/scenes.h"

/* Whether the cell refers to the primitive; fails the test if it does so twice. */
bool cell_holds(const cgt_queue_grid *g, uint32_t cell, uint32_t prim);

/* Checks the order of all references, and the statistics against a recount. A scene without primitives has no grid. */
cgt_research_scene_statistics queue_grid_check(const cgt_scene *scene);

/* A context of each variant in turn, while the block runs. */
#define FOR_EACH_VARIANT_CONTEXT(context, variant, threads)                                                            \
    FOR_EACH_VARIANT(variant)                                                                                          \
    for (cgt_context *context = context_make(threads, variant); context; cgt_context_release(context), context = NULL)

#endif
