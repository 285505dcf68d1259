/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Loose grids built by the direct method: one primitive after the other, in double, with the reach of each level
 * measured. */
#ifndef LOOSE_REFERENCE_H
#define LOOSE_REFERENCE_H

#include "model/committed_scene.h"

typedef struct loose_reference {
    cgt_loose_grid grid;
    uint32_t *start, *prim;
} loose_reference;

/* A grid of the valid primitives. per_cell: average number of a level's primitives per cell. False where memory is
 * refused. Release with loose_reference_free. */
bool loose_reference_make(const cgt_primitives *prims, double per_cell, loose_reference *r);
void loose_reference_free(loose_reference *r);

#endif
