/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The loose grid: every object lies in exactly one cell, the one that holds the middle of its bounds. Whoever wants all
 * that may touch a cell's box asks for the cells whose boxes, enlarged by `reach`, meet it. So there are no duplicates
 * and no mailbox, an object is written once, and a row of cells is one run of objects.
 *
 * Objects of like size share a level, a grid of its own: one large object enlarges the cells of its level alone. Levels
 * go from large to small; each takes sizes (the largest of the three half extents) within a factor of 4, and smaller
 * ones too where those are few, since a grid for them would cost more than it spares; the sixteenth takes all that are
 * smaller. A level without objects is left out.
 *
 * Memory for an object: 4 bytes of `object` and at most 2 of `start`, 4 for each cell where cells are asked for. What a
 * commit needs is kept for the next: 4 bytes (20 for a triangle) of keys and middles, 1.8 of sizes and bins. Few
 * objects take 13 KB besides.
 *
 * Triangles in the order of neighbours go by clusters (triangle_cluster.h): these are the objects then, of which each
 * takes 32 bytes for its box besides, and no middles. */
#ifndef CGT_LOOSE_GRID_H
#define CGT_LOOSE_GRID_H

#include <stdint.h>

#define CGT_LOOSE_LEVELS 16u

typedef struct cgt_loose_level {
    float low[3];     /* corner of the first cell */
    float cell[3];    /* edges of a cell, above 0 */
    float rcell[3];   /* 1 / cell, rounded */
    uint32_t size[3]; /* cells along x, y, z, 1 to 1024 each, 2^24 in all */
    uint32_t first;   /* cell (0, 0, 0) in `start`; x runs fastest, then y, then z */
    uint32_t prims;
    float least;    /* sizes from here on belong to this level or one before it */
    float reach[3]; /* The bounds of an object in cell i lie within low + i cell - reach and low + (i + 1) cell + reach
                       along each axis, in exact arithmetic of these numbers: what rounding of keys adds is in it */
} cgt_loose_level;

typedef struct cgt_loose_grid {
    cgt_loose_level level[CGT_LOOSE_LEVELS];
    uint32_t levels;
    const uint32_t *start; /* cell c holds object[start[c]] to object[start[c + 1] - 1]; cells + 1 of them */
    const uint32_t *prim;  /* all valid objects, or with world.cluster all clusters that have some, ascending in each
                               cell */
    uint32_t cells;        /* of all levels */
} cgt_loose_grid;

#endif
