/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The plan of a loose grid: levels by size, and the cells of each. */
#ifndef CGT_SIZE_LEVELS_H
#define CGT_SIZE_LEVELS_H

#include "model/loose_grid.h"
#include "model/primitive_bounds.h"

#define CGT_LOOSE_PRIMS_PER_CELL 8u /* flat between 4 and 16: a vector culls as many at the same cost */

/* Chooses levels and cells from the sizes of at least one primitive. requested: the caller's resolution, or zeros. */
void cgt_loose_grid_plan(cgt_loose_grid *grid, const cgt_size_classes *classes, const uint32_t requested[3]);

/* Sets a level's cells, for the primitives of c, of which there is at least one. requested: as above. */
void cgt_loose_level_init(const cgt_size_class *c, const uint32_t requested[3], cgt_loose_level *level);

/* Adds the classes of all chunks to those of the first. */
void cgt_size_classes_merge(cgt_size_classes *classes, uint32_t chunks);

/* Returns the most cells that any arrangement of as many primitives gets, without a requested resolution. */
uint64_t cgt_loose_grid_max_cells(uint32_t prims);

#endif
