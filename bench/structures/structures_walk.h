/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The nodes of a kd-tree that a ray reads, in order. */
#ifndef STRUCTURES_WALK_H
#define STRUCTURES_WALK_H

#include <stdint.h>

#include "papers/model/paper_structures.h"

typedef void walk_visitor(void *user, uint32_t node);

/* Calls visit for each node from the root to the leaf where the ray ends, at t_end, closer halves first; t_end may be
 * infinite. Computes in double precision, so for rays along a plane or through an edge the nodes may differ by a few
 * from those that the library reads. */
void structures_walk(const cgt_kd_tree *tree, const float org[3], const float dir[3], double t_end, walk_visitor *visit,
                     void *user);

#endif
