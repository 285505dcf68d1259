/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The way of one ray through a kd-tree: which nodes it reads, in which order. */
#ifndef BENCH_STRUCTURES_WALK_H
#define BENCH_STRUCTURES_WALK_H

#include <stdint.h>

#include "model/kd_tree.h"

typedef void walk_visitor(void *user, uint32_t node);

/* Calls visit for each node from the root to the leaf in which the ray ends, at t_end, nearer halves first; to the last
 * leaf that it passes where t_end is infinite. In double precision: which nodes a ray along a plane or through an edge
 * reads may differ from the library's way, by a few. */
void structures_walk(const cgt_kd_tree *tree, const float org[3], const float dir[3], double t_end, walk_visitor *visit,
                     void *user);

#endif
