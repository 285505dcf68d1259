/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The table of ways. A new structure gets one row that serves WAY_EACH, and more rows if it has several builders,
 * layouts or traversals: all tests that run through sets of ways take them up. */
#include "support/ways.h"

#define GRID(name, of, x, y, z, serves, papers)                                                                        \
    {                                                                                                                  \
        name, {.structure = CGT_STRUCTURE_##of, .resolution = {x, y, z}}, CGT_KD_TRAVERSAL_AUTO, serves, papers        \
    }
#define TREE(name, of, traversal, serves, papers)                                                                      \
    {                                                                                                                  \
        name, {.structure = CGT_STRUCTURE_##of}, CGT_KD_TRAVERSAL_##traversal, serves, papers                          \
    }
#define LAYOUT(name, of, layout, level, traversal, serves)                                                             \
    {                                                                                                                  \
        name, {.structure = CGT_STRUCTURE_##of, .kd_layout = CGT_KD_LAYOUT_##layout, .kd_break_level = level},         \
            CGT_KD_TRAVERSAL_##traversal, WAY_LAYOUT | (serves), true                                                  \
    }

enum { DEFAULTS = WAY_EACH | WAY_CELLS, BUILT = WAY_BUILDER | WAY_TRAVERSAL, TILED = WAY_TILES | WAY_CLUSTERS };

static const test_way ways[] = {
    {"AUTO", {.structure = CGT_STRUCTURE_AUTO}, CGT_KD_TRAVERSAL_AUTO, WAY_CHOSEN | TILED, false},
    {"AUTO, incoherent", {.rays = CGT_RAY_KIND_INCOHERENT}, CGT_KD_TRAVERSAL_AUTO, WAY_CHOSEN | WAY_CLUSTERS, false},
    GRID("queue grid", QUEUE_GRID, 0, 0, 0, DEFAULTS | BUILT, true),
    TREE("kd", KD, AUTO, DEFAULTS, true),
    TREE("ropes", KD_ROPES, AUTO, DEFAULTS, true),
    GRID("loose grid", LOOSE_GRID, 0, 0, 0, DEFAULTS | BUILT | TILED, false),
    TREE("BVH", BVH, AUTO, DEFAULTS | BUILT | WAY_CLUSTERS, false),
    TREE("BIH", BIH, AUTO, DEFAULTS, true),
    TREE("BIH, packets", BIH, PACKET, BUILT, true),
    TREE("BIH, single rays", BIH, SINGLE, WAY_TRAVERSAL, true),
    GRID("queue grid, 5x9x7", QUEUE_GRID, 5, 9, 7, WAY_CELLS, true),
    GRID("queue grid, 40x40x40", QUEUE_GRID, 40, 40, 40, WAY_CELLS, true),
    GRID("queue grid, 100x1x1", QUEUE_GRID, 100, 1, 1, WAY_CELLS, true),
    GRID("loose grid, 1x200x3", LOOSE_GRID, 1, 200, 3, WAY_CELLS | TILED, false),
    GRID("loose grid, 5x9x7", LOOSE_GRID, 5, 9, 7, WAY_CELLS | TILED, false),
    GRID("loose grid, one cell", LOOSE_GRID, 1, 1, 1, WAY_CELLS | TILED, false),
    LAYOUT("kd, packets", KD, DEPTH_FIRST, 0, PACKET, BUILT),
    LAYOUT("kd, single rays", KD, BREADTH_FIRST, 0, SINGLE, BUILT),
    LAYOUT("ropes, packets", KD_ROPES, DEPTH_FIRST, 0, PACKET, BUILT),
    LAYOUT("ropes, single rays", KD_ROPES, MIXED, 3, SINGLE, BUILT),
    LAYOUT("kd, mixed from 1", KD, MIXED, 1, AUTO, 0),
    LAYOUT("kd, mixed from 50", KD, MIXED, 50, AUTO, 0),
    LAYOUT("kd, mixed from 3", KD, MIXED, 3, AUTO, 0),
    LAYOUT("ropes, breadth first", KD_ROPES, BREADTH_FIRST, 0, AUTO, 0),
    LAYOUT("ropes, mixed from 1", KD_ROPES, MIXED, 1, AUTO, 0),
    LAYOUT("ropes, mixed from 50", KD_ROPES, MIXED, 50, AUTO, 0),
};
#define WAYS (sizeof ways / sizeof ways[0])

const test_way one_cell = GRID("one cell", QUEUE_GRID, 1, 1, 1, WAY_CELLS, true);

const test_way *way_next(const test_way *after, unsigned set)
{
    for (const test_way *w = after ? after + 1 : ways; w < ways + WAYS; w++)
        if ((w->serves & set) == set)
            return w;
    return NULL;
}

uint32_t way_count(unsigned set)
{
    uint32_t count = 0;
    FOR_EACH_WAY(w, set)
    count++;
    return count;
}

const test_way *way_in_turn(unsigned set, uint32_t turn)
{
    const test_way *w = way_next(NULL, set);
    const uint32_t count = way_count(set);
    for (turn = count ? turn % count : 0; turn > 0; turn--)
        w = way_next(w, set);
    return w;
}

cgt_scene_options structure_in_turn(uint32_t turn)
{
    return (cgt_scene_options){.structure = way_in_turn(WAY_EACH, turn)->scene.structure};
}

test_scene_options structure_random(test_random *r)
{
    test_scene_options o = {0};
    o.structure = (cgt_structure)random_below(r, CGT_STRUCTURE_BIH + 1);
    o.rays = (cgt_ray_kind)random_below(r, 2);
    (void)random_below(r, 3); /* so that what follows stays */
    o.kd_layout = (cgt_kd_layout)random_below(r, 4);
    o.kd_break_level = random_below(r, 51);
    return o;
}

void run_backwards(void *user, cgt_task *task, void *argument, uint32_t count)
{
    if (user)
        ++*(unsigned *)user;
    while (count-- > 0)
        task(argument, count);
}
