/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The queue grid (Chapman, section 3.4): a uniform grid whose voxels are queues of 16 references of 16 bits; of 32 bits
 * where there are more than 65,535 primitives.
 *
 *   byte   0     2     4                     28    30
 *        +-----+-----+-----+--- . . . ---+-----+-----+
 *        | new |     |     |             |     | old |      0xffff: no reference
 *        +-----+-----+-----+--- . . . ---+-----+-----+
 *
 * A push shifts the bytes by one reference and writes the new one in front: references fill from the front. Where
 * Chapman would lose the oldest of 17 references, it is moved to the overflow list, sorted by cell.
 *
 * Grid space: g = (p - org) * rcell in real arithmetic on these floats; point p lies in cell floor(g), clamped to the
 * grid. Code that computes g in floats widens the result by `cell_error` cells, and so finds the cell of every
 * point. */
#ifndef CGT_QUEUE_GRID_H
#define CGT_QUEUE_GRID_H

#include <stdbool.h>

#include "core/memory.h"
#include "model/loose_grid.h"
#include "model/primitives.h"
#include "model/primitive_bounds.h"

#define CGT_QUEUE_LENGTH 16
#define CGT_QUEUE_NONE 0xffffu
#define CGT_QUEUE_MAX_REFS16 65535u /* primitives for references of 16 bits: 0 to 65,534 */

typedef struct cgt_voxel {
    uint16_t reference[CGT_QUEUE_LENGTH];
} cgt_voxel;

typedef struct cgt_voxel32 {
    uint32_t reference[CGT_QUEUE_LENGTH]; /* CGT_INVALID_ID: none */
} cgt_voxel32;

typedef struct cgt_overflow {
    uint32_t cell;
    uint32_t reference;
} cgt_overflow;

typedef struct cgt_queue_grid {
    const cgt_primitives *prims;
    float org[3];        /* lower corner, world */
    float rcell[3];      /* cells per world unit */
    float cell_error[3]; /* cells: bound of the rounding of g for any point of any primitive */
    uint32_t resolution[3];
    uint32_t stride[3]; /* voxels from one cell to the next along each axis; x fastest */
    uint32_t cells;
    uint32_t max_cells;           /* that any arrangement of as many primitives is given: room for them is reserved */
    bool refs_are_32_bits;        /* wide voxels */
    cgt_voxel *voxel;             /* cells of them; NULL where there is no primitive */
    cgt_voxel32 *voxel32;         /* the same memory */
    const cgt_overflow *overflow; /* sorted by cell */
    uint32_t overflows;
} cgt_queue_grid;

static inline size_t cgt_queue_grid_voxel_bytes(const cgt_queue_grid *grid)
{
    return grid->refs_are_32_bits ? sizeof(cgt_voxel32) : sizeof(cgt_voxel);
}

/* Chooses origin, resolution and cell_error. requested: the caller's resolution, or zeros. reason: gets the reason in
 * words. Fails with TOO_LARGE where the requested resolution is beyond the limits. */
cgt_result cgt_queue_grid_plan(cgt_queue_grid *grid, const cgt_primitive_bounds *bounds, const uint32_t requested[3],
                               char reason[128]);

/* The first overflow entry of a cell; entries of that cell follow. Returns grid->overflows where it has none. */
static inline uint32_t cgt_queue_grid_overflow(const cgt_queue_grid *grid, uint32_t cell)
{
    uint32_t low = 0, high = grid->overflows;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (grid->overflow[middle].cell < cell)
            low = middle + 1;
        else
            high = middle;
    }
    return low < grid->overflows && grid->overflow[low].cell == cell ? low : grid->overflows;
}

#endif
