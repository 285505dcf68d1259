/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where the queue grid lies and how fine it is.
 *
 * Cells are as near to cubes as whole numbers allow. Their edge is the smallest that keeps both the cells and the
 * references within a multiple of the primitives: small spheres are limited by the first, large or mixed ones by the
 * second. A primitive of diameter d touches about (1 + d / edge)^3 cells; summed over all primitives that is a cubic in
 * 1 / edge whose coefficients are the sums of the powers of the diameters, so no second pass is needed. */
#include "papers/model/queue_grid.h"

#include <math.h>
#include <stdio.h>

/* Measured (docs/reports/coherent_grid_traversal.md): flat between half and twice these. Chapman and Wald et al. take 5
 * cells a primitive; culling by whole vectors favours larger cells. */
#define CELLS_PER_PRIM 2.0
#define REFERENCES_PER_PRIM 6.0

static double cells_at(const double extent[3], double edge)
{
    double cells = 1;
    for (int a = 0; a < 3; a++) {
        const double n = ceil(extent[a] / edge);
        cells *= n < 1 ? 1 : n > CGT_GRID_MAX_RESOLUTION ? CGT_GRID_MAX_RESOLUTION : n;
    }
    return cells;
}

static double references_at(const double power[4], double edge)
{
    const double k = 1 / edge;
    return power[0] + k * (3 * power[1] + k * (3 * power[2] + k * power[3]));
}

static double max_cells(uint32_t prims) { return fmin(fmax(CELLS_PER_PRIM * prims, 1), CGT_GRID_MAX_CELLS); }

/* The smallest edge for which both limits hold, to 1 part in 2^20. */
static double choose_edge(const cgt_primitive_bounds *bounds, const double extent[3])
{
    const double cells = max_cells(bounds->valid);
    const double references = REFERENCES_PER_PRIM * bounds->valid + 1024;
    double high = fmax(extent[0], fmax(extent[1], extent[2])), low = high * 0x1p-20;
    for (int i = 0; i < 48; i++) {
        const double edge = sqrt(low * high);
        if (cells_at(extent, edge) <= cells && references_at(bounds->diameter, edge) <= references)
            high = edge;
        else
            low = edge;
    }
    return high;
}

/* Places the grid at the bounds, but nowhere thinner than float can divide into cells. */
static void place_grid(cgt_queue_grid *grid, const cgt_primitive_bounds *bounds, double extent[3])
{
    double largest = 0;
    for (int a = 0; a < 3; a++) {
        extent[a] = (double)bounds->max[a] - bounds->min[a];
        largest = fmax(largest, extent[a]);
    }
    const double least = fmax(fmax(largest * 0x1p-10, bounds->magnitude * 0x1p-18), 0x1p-50);
    for (int a = 0; a < 3; a++) {
        const double padding = extent[a] < least ? least - extent[a] : 0;
        grid->org[a] = (float)(bounds->min[a] - padding / 2);
        /* the upper corner once more from the rounded lower one */
        extent[a] = fmax((double)bounds->max[a] - grid->org[a], least);
    }
}

static cgt_result check_resolution(const uint32_t requested[3])
{
    uint64_t cells = 1;
    for (int a = 0; a < 3; a++) {
        if (requested[a] > CGT_GRID_MAX_RESOLUTION)
            return CGT_ERROR_TOO_LARGE;
        cells *= requested[a];
    }
    return cells > CGT_GRID_MAX_CELLS ? CGT_ERROR_TOO_LARGE : CGT_OK;
}

cgt_result cgt_queue_grid_plan(cgt_queue_grid *grid, const cgt_primitive_bounds *bounds, const uint32_t requested[3],
                               char reason[128])
{
    double extent[3];
    const cgt_result result = check_resolution(requested);
    if (result != CGT_OK)
        return result;
    grid->refs_are_32_bits = grid->prims->count > CGT_QUEUE_MAX_REFS16;
    place_grid(grid, bounds, extent);
    const double edge = requested[0] ? 0 : choose_edge(bounds, extent);
    uint32_t stride = 1;
    for (int a = 0; a < 3; a++) {
        const double n = requested[0] ? requested[a] : fmin(fmax(ceil(extent[a] / edge), 1), CGT_GRID_MAX_RESOLUTION);
        grid->resolution[a] = (uint32_t)n;
        grid->rcell[a] = (float)(n / extent[a]);
        /* 16 roundings of 2^-24 each, of the cell and of the scene coordinate behind it */
        grid->cell_error[a] = 0x1p-20f * ((float)n + bounds->magnitude * grid->rcell[a]);
        grid->stride[a] = stride;
        stride *= grid->resolution[a];
    }
    grid->cells = stride;
    grid->max_cells = requested[0] ? stride : (uint32_t)fmax(stride, max_cells(grid->prims->count));
    if (requested[0])
        snprintf(reason, 128, "resolution asked for");
    else
        snprintf(reason, 128,
                 "queue grid: cell edge %.4g, %.2g cells and about %.2g references an object, mean diameter %.3g", edge,
                 (double)stride / bounds->valid, references_at(bounds->diameter, edge) / bounds->valid,
                 bounds->diameter[1] / bounds->valid);
    return CGT_OK;
}
