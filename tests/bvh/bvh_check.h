/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The invariants of a BVH, checked for the variant that this is compiled for. */
#ifndef BVH_CHECK_H
#define BVH_CHECK_H

#include "model/committed_scene.h"

/* Checks a scene's BVH against its primitives. NULL, or the first fault, valid until the next call of the thread:
 *   nodes      each reached once; children packed, two of them at least but in the root; lanes without a child empty
 *   boxes      exactly: an object's within its leaf's, a child's within its parent's, all within the tree's; finite
 *   orders     all lanes once; children first, along the octant's diagonal
 *   leaves     counts in range, one kind; lanes beyond repeat the last object; numbers are those of the objects, of
 *              triangles those that a commit works out (leaf_triangle.h)
 *   objects    each valid one in one block, no other
 *   counts     nodes, blocks, depth; the depth within CGT_BVH_MAX_DEPTH */
const char *bvh_check(const cgt_committed_scene *committed_scene);

/* Whether two trees have the same bits. */
bool bvh_equal(const cgt_bvh *a, const cgt_bvh *b);

#endif
