/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Items of trees: a tree's builder has one for each valid primitive, in order. */
#ifndef CGT_TREE_ITEMS_H
#define CGT_TREE_ITEMS_H

#include "core/context.h"
#include "model/committed_scene.h"

/* Chunks of primitives, for each of which cgt_tree_collect takes a number. */
uint32_t cgt_tree_chunks(const cgt_primitives *prims);

/* Stores the item of a primitive at a place, counted from the first item. */
typedef void cgt_tree_store_fn(void *of, uint32_t place, uint32_t prim, const cgt_primitive *primitive);

/* Stores an item for each valid primitive; of: for store. number: one for each chunk.
 * Errors: INVALID_ARGUMENT if floats have changed since the scene was bounded: no tree holds what lies outside */
cgt_result cgt_tree_collect(cgt_context *context, const cgt_committed_scene *scene, uint32_t *number,
                            cgt_tree_store_fn *store, void *of);

/* Takes bytes off a block; without a block, only adds them up. */
void *cgt_tree_carve(char *block, size_t *used_bytes, size_t bytes);

#endif
