/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Levels of a loose grid for the regions where its cells are crowded. */
#ifndef CGT_LOOSE_GRID_REGIONS_H
#define CGT_LOOSE_GRID_REGIONS_H

#include "builders/order/cell_sort.h"

/* Looks at a sorted grid with a crowded cell, and gives crowded regions levels of their own. *added: whether it did;
 * then the primitives must be sorted once more. The sort's `entry` and keys are used as memory. OUT_OF_MEMORY. */
cgt_result cgt_loose_grid_add_regions(cgt_scene *scene, const cgt_cell_sort *sort, cgt_loose_grid *grid, bool *added);

#endif
