/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which levels a loose grid has, where each lies and how fine it is: all from the size classes, without reading the
 * primitives again. */
#include "builders/order/size_levels.h"

#include <math.h>
#include <string.h>

#include "model/loose_grid.h"

#define LEVEL_MAX_CELLS 0x1p22 /* with what rounding adds, below 2^24 */
#define MIN_CELL 0x1p-100      /* its reciprocal is far from the end of float */

/* ---- levels ---- */

/* Primitives of consecutive classes. */
typedef struct size_range {
    cgt_size_class all;
    uint32_t least; /* class */
} size_range;

static void add_class(size_range *range, const cgt_size_classes *classes, uint32_t k)
{
    if (!cgt_size_class_is_used(classes, k))
        return;
    range->least = k;
    cgt_size_class_add(&range->all, &classes->of[k]);
}

/* The largest class at `from` or below that has primitives, or -1. */
static int next_class(const cgt_size_classes *classes, int from)
{
    while (from >= 0 && !cgt_size_class_is_used(classes, (uint32_t)from))
        from--;
    return from;
}

/* The primitives of a class and of the one below it: sizes within a factor of 4. */
static uint32_t count_pair(const cgt_size_classes *classes, int k)
{
    uint32_t count = classes->of[k].count;
    if (k > 0 && cgt_size_class_is_used(classes, (uint32_t)k - 1))
        count += classes->of[k - 1].count;
    return count;
}

static void add_pair(size_range *range, const cgt_size_classes *classes, int k)
{
    add_class(range, classes, (uint32_t)k);
    if (k > 0)
        add_class(range, classes, (uint32_t)k - 1);
}

/* Collects the primitives of the next level, from class k on, which has some. Smaller ones join while they are no more
 * than an eighth, plus one cell's worth. Returns the first remaining class, or -1. */
static int collect_level(const cgt_size_classes *classes, int k, bool last, size_range *range)
{
    uint32_t joined_count = 0;
    *range = (size_range){.least = 0};
    add_pair(range, classes, k);
    const uint32_t most = range->all.count / 8 + CGT_LOOSE_PRIMS_PER_CELL;
    while ((k = next_class(classes, k - 2)) >= 0) {
        const uint32_t pair_count = count_pair(classes, k);
        if (!last && (pair_count > most || joined_count > most - pair_count))
            break;
        joined_count += pair_count;
        add_pair(range, classes, k);
    }
    return k;
}

/* ---- cells ---- */

/* Cells along the axes, of which there are about `cells`, as near to cubes as they can be. An axis that is shorter than
 * a cube gets one cell, and one that would exceed its maximum gets that; the others share the remaining cells. */
static void divide_axes(const double extent[3], const double most[3], double cells, uint32_t size[3])
{
    bool fixed[3] = {false, false, false};
    double edge = 0;
    for (int axes = 3; axes > 0; axes--) {
        double volume = 1, shortest = 0, excess = 0;
        int thin_axis = -1, full_axis = -1;
        for (int a = 0; a < 3; a++)
            volume *= fixed[a] ? 1 : extent[a];
        edge = axes == 3 ? cbrt(volume / cells) : axes == 2 ? sqrt(volume / cells) : volume / cells;
        for (int a = 0; a < 3; a++) {
            if (fixed[a])
                continue;
            if (extent[a] <= edge && (thin_axis < 0 || extent[a] < shortest)) {
                thin_axis = a;
                shortest = extent[a];
            }
            if (extent[a] > most[a] * edge && (full_axis < 0 || extent[a] / most[a] > excess)) {
                full_axis = a;
                excess = extent[a] / most[a];
            }
        }
        const int next = thin_axis >= 0 ? thin_axis : full_axis;
        if (next < 0)
            break;
        fixed[next] = true;
        size[next] = thin_axis >= 0 ? 1 : (uint32_t)most[next];
        cells = fmax(cells / size[next], 1);
    }
    for (int a = 0; a < 3; a++)
        if (!fixed[a]) {
            const double n = extent[a] / edge;
            size[a] = (uint32_t)fmin(fmax(n < 8 ? n + 0.5 : n, 1), most[a]);
        }
}

/* The least edge of a cell along each axis: a sixteenth of the primitives, and what floats can tell apart. */
static void min_cell_edges(const cgt_size_class *c, double least[3])
{
    double extent = 0, magnitude = 0;
    for (int a = 0; a < 3; a++) {
        extent = fmax(extent, (double)c->high[a] - c->low[a]);
        magnitude = fmax(magnitude, fmax(fabs((double)c->low[a]), fabs((double)c->high[a])));
    }
    for (int a = 0; a < 3; a++)
        least[a] = fmax(fmax(extent * 0x1p-10, magnitude * 0x1p-20), fmax(c->half[a] * 0x1p-4, MIN_CELL));
}

/* Returns how many cells an axis may have: cells are not much smaller than their primitives, since a query reads
 * `reach` on either side, too. */
static double max_cells_along(double extent, double half, double least)
{
    return floor(fmin(fmax(extent / fmax(least, half / 2), 1), CGT_GRID_MAX_RESOLUTION));
}

/* Edges from sizes: n cells reach from the least middle to the largest, in exact arithmetic. The difference of two
 * floats is rounded to 53 bits, the product of a float and n is not. */
static float cell_edge(double extent, uint32_t n, double least)
{
    const double all = extent * (1 + 0x1p-50);
    float cell = (float)fmax(all / n, least);
    while ((double)cell * n < all || cell < least)
        cell = nextafterf(cell, INFINITY);
    return cell;
}

void cgt_loose_level_init(const cgt_size_class *c, const uint32_t requested[3], cgt_loose_level *level)
{
    double extent[3], least[3], most[3];
    min_cell_edges(c, least);
    for (int a = 0; a < 3; a++) {
        extent[a] = (double)c->high[a] - c->low[a];
        most[a] = max_cells_along(extent[a], c->half[a], least[a]);
        level->size[a] = requested[a];
    }
    if (!requested[0])
        divide_axes(extent, most, fmin(fmax((double)c->count / CGT_LOOSE_PRIMS_PER_CELL, 1), LEVEL_MAX_CELLS),
                    level->size);
    for (int a = 0; a < 3; a++) {
        const double n = level->size[a];
        level->low[a] = c->low[a] + 0.f; /* +0, whichever zero came first */
        level->cell[a] = cell_edge(extent[a], level->size[a], least[a]);
        level->rcell[a] = 1 / level->cell[a];
        /* 4 u n cells for the rounding of keys (kernel/builders/loose_grid_keys.c); what the sum and its float lose is
         * less than 2^-22 of them */
        level->reach[a] = (float)(((double)c->half[a] + 0x1p-22 * n * level->cell[a]) * (1 + 0x1p-22));
    }
    level->prims = c->count;
}

/* The smallest size of a class. */
static float class_size(uint32_t k)
{
    const uint32_t bits = k << 23;
    float size;
    memcpy(&size, &bits, sizeof size);
    return size;
}

void cgt_loose_grid_plan(cgt_loose_grid *grid, const cgt_size_classes *classes, const uint32_t requested[3])
{
    int k = next_class(classes, CGT_SIZE_CLASSES - 1);
    *grid = (cgt_loose_grid){0};
    while (k >= 0) {
        cgt_loose_level *level = &grid->level[grid->levels++];
        size_range range;
        k = collect_level(classes, k, requested[0] || grid->levels == CGT_LOOSE_SIZE_LEVELS, &range);
        cgt_loose_level_init(&range.all, requested, level);
        level->least = k < 0 ? 0 : class_size(range.least);
        level->first = grid->cells;
        grid->cells += level->size[0] * level->size[1] * level->size[2];
    }
}

/* An axis has at most half as many again as its share, so a level 3.375 times its primitives over 8, or that of one
 * cell. */
uint64_t cgt_loose_grid_max_cells(uint32_t prims) { return (uint64_t)prims / 2 + 4 * CGT_LOOSE_LEVELS; }

void cgt_size_classes_merge(cgt_size_classes *classes, uint32_t chunks)
{
    for (uint32_t i = 1; i < chunks; i++)
        for (uint32_t word = 0; word < CGT_SIZE_CLASSES / 32; word++)
            for (uint32_t remaining = classes[i].used_classes[word]; remaining; remaining &= remaining - 1) {
                const uint32_t k = 32 * word + (uint32_t)__builtin_ctz(remaining);
                cgt_size_classes_add(classes, k, &classes[i].of[k]);
            }
}
