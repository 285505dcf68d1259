/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The structures of the papers: what a commit for one of them builds, and what rays are traced against then. */
#ifndef CGT_PAPER_STRUCTURES_H
#define CGT_PAPER_STRUCTURES_H

#include "model/committed_scene.h"
#include "papers/model/bih.h"
#include "papers/model/kd_tree.h"
#include "papers/model/leaf_triangle.h"
#include "papers/model/queue_grid.h"

typedef struct cgt_paper_structures {
    cgt_queue_grid grid;
    cgt_kd_tree kd;
    cgt_bih bih;
    const cgt_leaf_triangle *triangle; /* with a tree: all triangles, by cgt_array_boxed_number */
} cgt_paper_structures;

#endif
