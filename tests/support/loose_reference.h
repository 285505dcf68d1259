/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Loose grids built the plain way: one object after the other, in double, the reach of each level measured. */
#ifndef LOOSE_REFERENCE_H
#define LOOSE_REFERENCE_H

#include "model/committed_scene.h"

typedef struct loose_reference {
    cgt_loose_grid grid;
    uint32_t *start, *prim;
} loose_reference;

/* Of the valid objects. per_cell: how many of a level's objects share a cell on average. False where memory is refused.
 * Release with loose_reference_free. */
bool loose_reference_make(const cgt_primitives *prims, double per_cell, loose_reference *r);
void loose_reference_free(loose_reference *r);

#endif
