/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which parts a wide tree's objects are sorted into, and where their cells lie. */
#include "builders/bvh/bvh_build.h"

#include <string.h>

#include "builders/grid/loose_grid_build.h"

/* The axis of the longest edge, or -1 where there is none above 0. */
static int longest_edge(const float edge[3])
{
    int longest = -1;
    for (int a = 0; a < 3; a++)
        if (edge[a] > (longest < 0 ? 0 : edge[longest]))
            longest = a;
    return longest;
}

/* Bit `bit` of an axis to bit `key`. Neighbours that move as far go together. */
static void add_bit(cgt_morton_curve *c, int axis, uint32_t bit, uint32_t key)
{
    cgt_morton_bits *last = c->runs ? &c->run[c->runs - 1] : NULL;
    if (last && last->axis == (uint32_t)axis && last->shift == key - bit)
        last->mask |= UINT32_C(1) << bit;
    else
        c->run[c->runs++] = (cgt_morton_bits){(uint32_t)axis, UINT32_C(1) << bit, key - bit};
}

void cgt_morton_curve_init(const float low[3], const float high[3], uint32_t bits, cgt_morton_curve *curve)
{
    int axis[CGT_BVH_KEY_BITS];
    uint32_t along[3] = {0, 0, 0};
    float edge[3];
    for (int a = 0; a < 3; a++)
        edge[a] = high[a] - low[a];
    curve->bits = 0;
    curve->runs = 0;
    for (int a = longest_edge(edge); curve->bits < bits && a >= 0; a = longest_edge(edge)) {
        axis[curve->bits++] = a;
        along[a]++;
        edge[a] *= 0.5f;
    }
    for (int a = 0; a < 3; a++) {
        const float cells = (float)(UINT32_C(1) << along[a]), extent = high[a] - low[a];
        curve->low[a] = low[a];
        curve->rcell[a] = along[a] ? cells / extent : 0;
        curve->last[a] = cells - 1;
    }
    for (uint32_t k = 0; k < curve->bits; k++)
        add_bit(curve, axis[k], --along[axis[k]], curve->bits - 1 - k);
}

/* So that there are no more than CGT_BVH_PRIMS_PER_CELL of so many to a cell. */
static uint32_t bits_for(uint32_t prims)
{
    uint32_t bits = 0;
    while (bits < CGT_BVH_KEY_BITS && ((uint64_t)CGT_BVH_PRIMS_PER_CELL << bits) < prims)
        bits++;
    return bits;
}

/* Of the kind whose parts are being counted. most: objects of that kind. */
static void add_part(cgt_bvh_plan *plan, const cgt_loose_level *level, uint32_t max_prims)
{
    cgt_bvh_part *part = &plan->part[plan->parts[0] + plan->parts[1]++];
    float high[3];
    for (int a = 0; a < 3; a++)
        high[a] = level->low[a] + level->cell[a] * (float)level->size[a];
    part->least = level->least;
    part->first = plan->cells;
    cgt_morton_curve_init(level->low, high, bits_for(level->prims < max_prims ? level->prims : max_prims),
                          &part->curve);
    plan->cells += UINT32_C(1) << part->curve.bits;
}

void cgt_bvh_plan_parts(cgt_bvh_plan *plan, const cgt_size_classes *classes, const cgt_primitives *prims)
{
    static const uint32_t no_resolution[3] = {0, 0, 0};
    cgt_loose_grid grid;
    cgt_loose_grid_plan(&grid, classes, no_resolution);
    plan->parts[0] = plan->parts[1] = 0;
    plan->cells = 0;
    for (uint32_t k = 0; prims->spheres && k < grid.levels; k++)
        add_part(plan, &grid.level[k], prims->spheres);
    plan->parts[0] = plan->parts[1];
    plan->parts[1] = 0;
    for (uint32_t k = 0; prims->triangles && k < grid.levels; k++)
        add_part(plan, &grid.level[k], prims->triangles);
}
