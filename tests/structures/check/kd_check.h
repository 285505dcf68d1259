/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The invariants of every kd-tree, from any builder. */
#ifndef KD_CHECK_H
#define KD_CHECK_H

#include "papers/model/paper_structures.h"

/* Checks a flattened kd-tree against its primitives, and its leaves and ropes if it has them. Returns NULL, or the
 * first fault, valid until the thread's next call:
 *   nodes       pairs aligned, each node but number 1 reached once, splits finite and within the node's closed box
 *   leaves      references in range, ascending, to valid primitives, each in one leaf; a valid primitive is in
 *               every leaf whose closed box it touches, exactly (kd_touch.h); none reaches beyond the root
 *   counts      equal to the tree's statistics
 *   ropes       numbers, boxes and references of leaves; wide ropes lead to the sibling of the lowest ancestor that is
 *               split across the face; the others to the smallest node below that whose closed box holds the face */
const char *kd_check(const cgt_kd_tree *tree, const cgt_committed_scene *committed_scene);

#endif
