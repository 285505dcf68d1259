/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Parts of a legacy VTK file that are passed over. All return 1 or -1. */
#ifndef VTK_PASSED_H
#define VTK_PASSED_H

#include "trajectory/vtk/vtk_words.h"

/* The type that an array's values have, which must be the next word. */
int vtk_read_type(vtk_words *w, vtk_type *type);

/* After CELLS, LINES and the like, "cells numbers": so many whole numbers; since version 5 OFFSETS and CONNECTIVITY,
 * each with its type. */
int vtk_skip_cells(vtk_words *w);

/* After CELL_TYPES. */
int vtk_skip_cell_types(vtk_words *w);

/* After COLOR_SCALARS and LOOKUP_TABLE: bytes in binary files, floats in text; TEXTURE_COORDINATES tell their number
 * and type. fixed_parts: columns, where the file tells the rows; 0: it tells the columns, and there are `tuples`
 * rows. */
int vtk_skip_colors(vtk_words *w, int are_coordinates, uint64_t tuples, uint64_t fixed_parts);

#endif
