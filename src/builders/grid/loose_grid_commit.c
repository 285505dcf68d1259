/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The loose grid of a commit: planned, every object given its cell, and sorted by cell. */
#include <stdio.h>

#include "builders/commit.h"
#include "core/float_environment.h"
#include "dispatch/kernel.h"
#include "builders/grid/loose_grid_build.h"

typedef struct keys_job {
    const cgt_primitives *prims;
    const cgt_cluster *cluster;
    const cgt_kernel *kernel;
    cgt_loose_keys_job keys;
    cgt_cell_sort sort;
} keys_job;

/* ---- keys ---- */

static void compute_prim_keys(const keys_job *job, uint32_t first, uint32_t end)
{
    const cgt_primitive_array *a = cgt_primitives_array(job->prims, first);
    for (uint32_t prim = first; prim < end; a++) {
        const uint32_t stop = end - a->first < a->count ? end : a->first + a->count;
        job->kernel->loose_grid_keys(&job->keys, a, prim, stop, job->sort.key + prim);
        prim = stop;
    }
}

/* Of a chunk of what is sorted: objects or clusters. */
static void compute_chunk_keys(void *argument, uint32_t chunk)
{
    const keys_job *job = argument;
    const cgt_cluster *cluster = job->cluster;
    const uint32_t first = chunk * CGT_CELL_SORT_CHUNK, remaining = job->sort.prims - first;
    const uint32_t count = remaining < CGT_CELL_SORT_CHUNK ? remaining : CGT_CELL_SORT_CHUNK;
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    if (cluster)
        job->kernel->loose_grid_cluster_keys(&job->keys, cluster + first, count, job->sort.key + first);
    else
        compute_prim_keys(job, first, first + count);
    cgt_float_environment_leave(&callers);
    cgt_cell_sort_chunk(&job->sort, chunk);
}

/* ---- memory ---- */

/* Room for any arrangement of as many objects or clusters, or for more cells where they were asked for. cgt_compute_bounds has reserved
 * the memory to work in. */
static cgt_result reserve(cgt_scene *scene, const cgt_cell_sort *sort)
{
    const cgt_memory_hooks *hooks = &scene->context->memory;
    const uint32_t count = sort->prims;
    const uint64_t max_cells = cgt_loose_grid_max_cells(count), cells = scene->committed_scene.loose.cells;
    cgt_result result =
        cgt_buffer_reserve_scattered(hooks, &scene->buffer[CGT_BUFFER_LOOSE_START],
                                     (size_t)(max_cells > cells ? max_cells : cells) + 1, sizeof(uint32_t));
    if (result == CGT_OK)
        result = cgt_buffer_reserve_scattered(hooks, &scene->buffer[CGT_BUFFER_LOOSE_PRIM], count, sizeof(uint32_t));
    if (result == CGT_OK)
        result = cgt_cell_sort_reserve(hooks, &scene->buffer[CGT_BUFFER_CELL_SORT_BINS], sort);
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory for a loose grid of %u primitives",
                        scene->committed_scene.prims.count);
    return CGT_OK;
}

/* ---- the whole ---- */

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
    research->local_store_bytes = st->structure_bytes +
                                  (size_t)scene->committed_scene.prims.spheres * sizeof(cgt_sphere) +
                                  (size_t)scene->committed_scene.prims.triangles * sizeof(cgt_triangle);
    research->fits_local_store = research->local_store_bytes + (64u << 10) <= 256u << 10;
    if (scene->options.research->resolution[0])
        snprintf(st->reason, sizeof st->reason, "loose grid: resolution asked for");
    else
        snprintf(st->reason, sizeof st->reason, "loose grid: %u levels, %.3g %s a cell, reach %.3g to %.3g", g->levels,
                 (double)valid_prims / g->cells, clusters ? "runs of 8 neighbouring triangles" : "objects",
                 (double)g->level[0].reach[0], (double)finest->reach[0]);
}

cgt_result cgt_loose_grid_commit(cgt_scene *scene)
{
    cgt_committed_scene *committed_scene = &scene->committed_scene;
    cgt_loose_grid *g = &committed_scene->loose;
    const cgt_primitives *o = &committed_scene->prims;
    keys_job job = {.prims = o, .cluster = committed_scene->cluster, .kernel = scene->context->kernel};
    cgt_cell_sort *sort = &job.sort;
    const cgt_size_classes *classes = scene->buffer[CGT_BUFFER_SIZE_CLASSES].data;
    cgt_loose_grid_plan(g, classes, scene->options.research->resolution);
    const uint32_t count = committed_scene->cluster ? cgt_clusters(o->count) : o->count;
    const uint32_t skipped = cgt_cell_sort_plan(sort, scene->context, count, cgt_size_classes_count(classes), g->cells);
    const cgt_result result = reserve(scene, sort);
    if (result != CGT_OK)
        return result;
    float *work = scene->buffer[CGT_BUFFER_CELL_SORT_WORK].data;
    job.keys = (cgt_loose_keys_job){.grid = g, .middle = work, .triangles = o->triangles, .skipped = skipped};
    sort->entry = (uint32_t *)work + (committed_scene->cluster ? 0 : (size_t)4 * o->triangles);
    sort->bin_end = scene->buffer[CGT_BUFFER_CELL_SORT_BINS].data;
    sort->start = scene->buffer[CGT_BUFFER_LOOSE_START].data;
    sort->prim = scene->buffer[CGT_BUFFER_LOOSE_PRIM].data;
    sort->key = sort->direct ? sort->entry : sort->prim;
    cgt_run_tasks(scene->context, compute_chunk_keys, &job, cgt_cell_sort_chunks(count));
    cgt_cell_sort_run(sort, scene->context);
    g->start = job.sort.start;
    g->prim = job.sort.prim;
    report(scene, sort->valid);
    return CGT_OK;
}
