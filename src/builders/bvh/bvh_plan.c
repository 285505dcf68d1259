/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which parts the primitives of a BVH are sorted into, and where the parts' cells lie. */
#include "builders/bvh/bvh_build.h"
#include "builders/order/size_levels.h"

/* Bits of keys that leave at most CGT_BVH_PRIMS_PER_CELL primitives to a cell. */
static uint32_t bits_for(uint32_t prims)
{
    uint32_t bits = 0;
    while (bits < CGT_BVH_KEY_BITS && ((uint64_t)CGT_BVH_PRIMS_PER_CELL << bits) < prims)
        bits++;
    return bits;
}

/* Adds a part of the last kind. max_prims: primitives of that kind. */
static void add_part(cgt_bvh_plan *plan, uint32_t *parts, const cgt_loose_level *level, uint32_t max_prims)
{
    cgt_bvh_part *part = &plan->part[(*parts)++];
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
    const uint32_t count[CGT_KINDS] = {prims->spheres, prims->triangles, prims->capsules};
    cgt_loose_grid grid;
    cgt_loose_grid_plan(&grid, classes, no_resolution);
    plan->cells = 0;
    plan->first[0] = 0;
    for (uint32_t kind = 0; kind < CGT_KINDS; kind++) {
        plan->first[kind + 1] = plan->first[kind];
        for (uint32_t k = 0; count[kind] && k < grid.levels; k++)
            add_part(plan, &plan->first[kind + 1], &grid.level[k], count[kind]);
    }
}
