/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The loose grid of a commit: its levels, then its primitives sorted by cell. */
#include <stdio.h>

#include "builders/commit.h"
#include "builders/report.h"
#include "builders/grid/loose_grid_regions.h"
#include "builders/order/cell_sort.h"
#include "builders/order/size_levels.h"

/* Of finding regions. Each sorts everything again: with three a halo whose distances cover four decades, as many
 * primitives in each, is built in a BVH's time; the fourth took half as long again, and frames gained nothing. */
#define MAX_ROUNDS 3

static void report(cgt_scene *scene, uint32_t valid_prims)
{
    cgt_scene_statistics *st = &scene->statistics;
    cgt_research_scene_statistics *research = &scene->research_statistics;
    const cgt_loose_grid *g = &scene->committed_scene.loose;
    const cgt_loose_level *finest = &g->level[g->levels - 1];
    const size_t clusters = scene->committed_scene.cluster ? cgt_clusters(scene->committed_scene.prims.count) : 0;
    for (int a = 0; a < 3; a++)
        research->resolution[a] = finest->size[a];
    research->cells = g->cells;
    research->levels = g->levels;
    research->references = valid_prims;
    research->reference_bits = 32;
    st->structure_bytes = ((size_t)g->cells + 1 + valid_prims) * sizeof(uint32_t) + clusters * sizeof(cgt_cluster);
    cgt_report_local_store(scene, sizeof(cgt_sphere), sizeof(cgt_triangle));
    if (scene->options.research->resolution[0])
        snprintf(st->reason, sizeof st->reason, "loose grid: resolution asked for");
    else if (g->regions)
        snprintf(st->reason, sizeof st->reason, "loose grid: %u levels, %u of crowded regions, %.3g %s a cell",
                 g->levels, g->regions, (double)valid_prims / g->cells,
                 clusters ? "runs of 8 neighbouring triangles" : "primitives");
    else
        snprintf(st->reason, sizeof st->reason, "loose grid: %u levels, %.3g %s a cell, reach %.3g to %.3g", g->levels,
                 (double)valid_prims / g->cells, clusters ? "runs of 8 neighbouring triangles" : "primitives",
                 (double)g->level[0].reach[0], (double)finest->reach[0]);
}

/* Sorts the primitives by cell, again as long as crowded regions get levels of their own. */
static cgt_result sort_prims(cgt_scene *scene, cgt_cell_sort *sort)
{
    const cgt_committed_scene *committed_scene = &scene->committed_scene;
    cgt_loose_grid *g = &scene->committed_scene.loose;
    cgt_result result = CGT_OK;
    bool again = true;
    for (uint32_t round = 0; again && result == CGT_OK; round++) {
        cgt_cell_sort_plan(sort, scene, committed_scene->cluster, g, g->cells);
        /* room for any arrangement of as many primitives or clusters, or for more cells where they are requested */
        const uint64_t max_cells = cgt_loose_grid_max_cells(sort->count);
        result = cgt_cell_sort_reserve(sort, scene, CGT_BUFFER_LOOSE_START, max_cells > g->cells ? max_cells : g->cells,
                                       CGT_BUFFER_LOOSE_PRIM);
        if (result != CGT_OK)
            break;
        cgt_cell_sort_run(sort, scene->context);
        g->crowding = 0;
        g->start = sort->start;
        g->prim = sort->prim;
        again = sort->is_crowded && !scene->options.research->resolution[0] && round < MAX_ROUNDS;
        if (again)
            result = cgt_loose_grid_add_regions(scene, sort, g, &again);
    }
    return result;
}

cgt_result cgt_loose_grid_commit(cgt_scene *scene)
{
    cgt_committed_scene *committed_scene = &scene->committed_scene;
    cgt_loose_grid *g = &committed_scene->loose;
    const cgt_kernel *kernel = scene->context->kernel;
    cgt_cell_sort sort = {.prim_keys = kernel->loose_grid_keys, .cluster_keys = kernel->loose_grid_cluster_keys};
    cgt_loose_grid_plan(g, scene->buffer[CGT_BUFFER_SIZE_CLASSES].data, scene->options.research->resolution);
    const cgt_result result = sort_prims(scene, &sort);
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory for a loose grid of %u primitives",
                        committed_scene->prims.count);
    report(scene, sort.valid);
    return CGT_OK;
}
