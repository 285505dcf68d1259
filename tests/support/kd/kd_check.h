/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The invariants of every kd-tree, whoever built it. */
#ifndef KD_CHECK_H
#define KD_CHECK_H

#include "model/committed_scene.h"

/* Checks a flattened tree against the objects that it is over, and its leaves and ropes where it has them. NULL, or the
 * first fault, valid until the next call of the thread:
 *   nodes       pairs aligned, each node but number 1 reached once, splits finite and within the node's closed box
 *   leaves      references in range, ascending, of valid objects, each of them part of one leaf; a valid object is in
 *               every leaf whose closed box it touches, exactly (kd_touch.h); none reaches beyond the box of the root
 *   counts      those of the tree
 *   ropes       numbers, boxes and references of leaves; wide ropes lead to the sibling of the lowest ancestor that is
 *               split across the face; the others to the smallest node below that whose closed box holds the face */
const char *kd_check(const cgt_kd_tree *tree, const cgt_committed_scene *committed_scene);

#endif
