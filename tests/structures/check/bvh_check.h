/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The invariants of a BVH, checked for the variant that this is compiled for. */
#ifndef BVH_CHECK_H
#define BVH_CHECK_H

#include "model/committed_scene.h"

/* Checks a scene's BVH against its primitives. Returns NULL, or the first fault, valid until the thread's next call:
 *   nodes      each reached once; children packed, at least two except in the root; lanes without a child empty
 *   boxes      a primitive's within its leaf's, a child's within its parent's, all within the BVH's, exactly; finite
 *   slabs      turned ones hold all capsules below their child
 *   orders     every lane once; children first, along the octant's diagonal
 *   leaves     counts in range, one kind; unused lanes repeat the last primitive; data are the primitives', of
 *              triangles those that a commit computes (leaf_triangle.h)
 *   primitives each valid one in exactly one block, no others
 *   counts     nodes, blocks, depth; the depth within CGT_BVH_MAX_DEPTH */
const char *bvh_check(const cgt_committed_scene *committed_scene);

/* Whether two BVHs have the same bits. */
bool bvh_equal(const cgt_bvh *a, const cgt_bvh *b);

#endif
