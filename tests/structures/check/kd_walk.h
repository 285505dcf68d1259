/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shared by the parts of the checker of kd-trees. */
#ifndef KD_WALK_H
#define KD_WALK_H

#include "structures/check/kd_touch.h"
#include "papers/model/paper_structures.h"

typedef struct kd_walk {
    const cgt_kd_tree *tree;
    const cgt_committed_scene *committed_scene;
    kd_box *box;      /* by node */
    uint32_t *parent; /* by node; CGT_INVALID_ID for the root and for nodes that are not reached */
    bool *reached;    /* by node */
    double (*low)[3]; /* bounds of valid primitives, by primitive */
    double (*high)[3];
    bool *valid;    /* by primitive */
    uint8_t *used;  /* by reference */
    uint32_t *list; /* primitives that may touch the nodes on the path from the root, one list after the other */
    uint32_t depth, leaves, empty_leaves;
    bool faulty;
} kd_walk;

/* Keeps the first message. */
void kd_fault(kd_walk *w, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* After the walk: leaves in the order of the nodes, and their ropes. */
void kd_check_leaves(kd_walk *w);

#endif
