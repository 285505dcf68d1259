/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The loose grid (a hierarchical one; Ulrich 2000): every primitive lies in exactly one cell, which holds the middle of
 * its bounds. To find all primitives that may overlap a box, visit the cells whose boxes, enlarged by `reach`, overlap
 * it. So there are no duplicates and no mailbox, a primitive is written once, and a row of cells is one run of
 * primitives.
 *
 * Primitives of similar size share a level, which is a grid: a large primitive enlarges the cells of its level alone.
 * Levels go from large to small; each takes sizes (the largest of the three half extents) within a factor of 4, and
 * also smaller ones where those are few, since a grid for them would cost more than it saves; the sixteenth takes all
 * smaller ones. A level without primitives is omitted.
 *
 * A level may be confined to a region: a box that holds the middles of its primitives. Where a grid over everything
 * would crowd its primitives into few cells, since a few of them lie far away or all lie in clusters, each crowded
 * region gets a level of its own, with cells of a size that suits it (loose_grid_regions.c). So cells follow where the
 * primitives are, not the bounds of all.
 *
 * Memory per primitive: 4 bytes of `prim` and at most 2 of `start`; 4 per cell where a resolution is requested. The
 * scene keeps what a commit works in: 4 bytes (20 for a triangle) of keys and middles, 1.8 of sizes and bins. Small
 * scenes take 13 KB more.
 *
 * Triangles whose order is that of neighbours are grouped into clusters (triangle_cluster.h), which take the place of
 * primitives; a cluster takes 32 bytes for its box, and no middles. */
#ifndef CGT_LOOSE_GRID_H
#define CGT_LOOSE_GRID_H

#include <stdbool.h>
#include <stdint.h>

/* Cells of any grid, along an axis and in all. A packet through a queue grid keeps the bounds of that many slices on
 * its stack, 24 KB: programs for a small local store, whose grids are coarser, define less. */
#ifndef CGT_GRID_MAX_RESOLUTION
#define CGT_GRID_MAX_RESOLUTION 1024u
#endif
#define CGT_GRID_MAX_CELLS (1u << 24) /* 512 MB of voxels, or 1 GB of BVH nodes */

#define CGT_LOOSE_SIZE_LEVELS 16u /* by size alone */
#ifndef CGT_LOOSE_LEVELS          /* programs for a small local store, which have none, define 1 */
#define CGT_LOOSE_LEVELS 32u      /* with regions */
#endif

typedef struct cgt_loose_level {
    float low[3];     /* corner of the first cell */
    float cell[3];    /* edges of a cell, above 0 */
    float rcell[3];   /* 1 / cell, rounded */
    uint32_t size[3]; /* cells along x, y, z, 1 to 1024 each, 2^24 in all */
    uint32_t first;   /* cell (0, 0, 0) in `start`; x runs fastest, then y, then z */
    uint32_t prims;
    float least; /* sizes from here on belong to this level or one before it, but for those outside its region */
    bool has_region;
    /* Where has_region is set: a box that holds the level's middles, of cells of the level that it was cut from. */
    float region_low[3], region_high[3];
    /* Along each axis, a primitive's bounds in cell i lie within low + i cell - reach and low + (i + 1) cell + reach,
     * in exact arithmetic of these numbers: the rounding of keys is included. */
    float reach[3];
} cgt_loose_level;

typedef struct cgt_loose_grid {
    cgt_loose_level level[CGT_LOOSE_LEVELS];
    uint32_t levels;
    uint32_t regions;      /* levels with a region */
    const uint32_t *start; /* cell c holds primitive[start[c]] to primitive[start[c + 1] - 1]; cells + 1 of them */
    const uint32_t
        *prim; /* all valid primitives, or with committed_scene.cluster all clusters that have some, ascending in each
                               cell */
    uint32_t cells; /* of all levels */
    float crowding; /* mean, over the primitives or clusters, of how many share their cell; 0: no cell is crowded */
} cgt_loose_grid;

#endif
