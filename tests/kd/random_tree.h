/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Valid kd-trees that no heuristic would build, in the form that builders return: random axes and splits, some on a
 * bound or coordinate of a primitive, some that cut off a thin slab or nothing; pairs of children in random order, with
 * gaps. Each primitive is in every leaf whose closed box its bounds touch. */
#ifndef RANDOM_TREE_H
#define RANDOM_TREE_H

#include "papers/build/kd/kd_build.h"
#include "support/random.h"

typedef struct random_tree {
    cgt_kd_raw raw; /* points into the next two */
    cgt_kd_node *node;
    uint32_t *reference;
} random_tree;

/* Bounds of a valid primitive, rounded outwards. */
void object_bounds(const cgt_primitives *prims, uint32_t prim, double low[3], double high[3]);

/* A tree over the valid primitives of a scene, at least one. max_depth: inner nodes above a leaf, below
 * CGT_KD_MAX_DEPTH. A node of more than leaf_size primitives is usually split, a smaller one seldom. */
random_tree random_tree_make(test_random *r, const cgt_committed_scene *committed_scene, uint32_t max_depth,
                             uint32_t leaf_size);

/* One leaf with all valid primitives. */
random_tree random_tree_leaf(const cgt_committed_scene *committed_scene);

void random_tree_free(random_tree *tree);

#endif
