/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cells of a legacy VTK file: faces become triangles, others are counted. */
#ifndef VTK_CELLS_H
#define VTK_CELLS_H

#include "trajectory/vtk/vtk_words.h"

/* Kinds of cells, as far as they matter. */
typedef enum vtk_kind { VTK_POINTS, VTK_LINES, VTK_POLYGONS, VTK_STRIPS, VTK_PIXELS, VTK_OTHERS, VTK_KINDS } vtk_kind;

typedef struct vtk_cells {
    uint32_t *index; /* 3 points of each triangle */
    size_t triangles, triangle_capacity;
    uint32_t *number; /* points of the cells that were read last */
    uint64_t *end;    /* of each cell in them */
    size_t numbers, number_capacity, cells, end_capacity;
    uint64_t count[VTK_KINDS]; /* cells of each kind */
    uint32_t needed;           /* all points are below it */
} vtk_cells;

/* Forgets the cells, but not the memory. */
void vtk_cells_clear(vtk_cells *c);
void vtk_cells_free(vtk_cells *c);

/* Reads the cells after VERTICES, LINES, POLYGONS or TRIANGLE_STRIPS, all of one kind: "cells numbers", then the number
 * of points and the points of each; since version 5 OFFSETS and CONNECTIVITY, each with its type. Returns 1 or -1. */
int vtk_cells_read(vtk_words *w, vtk_cells *c, vtk_kind kind);

/* The same after CELLS; their kinds come after CELL_TYPES. Return 1 or -1. */
int vtk_cells_read_list(vtk_words *w, vtk_cells *c);
int vtk_cells_read_types(vtk_words *w, vtk_cells *c);

#endif
