/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The loose grid of a commit: planned, every object given its cell, and sorted by cell. */
#include <stdio.h>

#include "build/commit.h"
#include "core/float_environment.h"
#include "build/grid/loose_grid_build.h"

typedef struct keys_job {
    const cgt_objects *objects;
    const cgt_cluster *cluster;
    const cgt_kernel *kernel;
    cgt_loose_keys keys;
    cgt_loose_sort sort;
} keys_job;

/* ---- keys ---- */

static void make_object_keys(const keys_job *job, uint32_t first, uint32_t end)
{
    const cgt_object_array *a = cgt_objects_array(job->objects, first);
    for (uint32_t object = first; object < end; a++) {
        const uint32_t stop = end - a->first < a->count ? end : a->first + a->count;
        job->kernel->loose_grid_keys(&job->keys, a, object, stop, job->sort.key + object);
        object = stop;
    }
}

/* Of a chunk of what is sorted: objects or clusters. */
static void make_keys(void *argument, uint32_t chunk)
{
    const keys_job *job = argument;
    const cgt_cluster *cluster = job->cluster;
    const uint32_t first = chunk * CGT_LOOSE_CHUNK, left = job->sort.objects - first;
    const uint32_t count = left < CGT_LOOSE_CHUNK ? left : CGT_LOOSE_CHUNK;
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    if (cluster)
        job->kernel->loose_grid_cluster_keys(&job->keys, cluster + first, count, job->sort.key + first);
    else
        make_object_keys(job, first, first + count);
    cgt_float_environment_leave(&callers);
    cgt_loose_sort_chunk(&job->sort, chunk);
}

/* ---- memory ---- */

/* Room for any arrangement of as many objects or clusters, or for more cells where they were asked for. cgt_summarise has reserved
 * the memory to work in. */
static cgt_result reserve(cgt_scene *scene, const cgt_loose_sort *sort)
{
    const cgt_memory_hooks *hooks = &scene->context->memory;
    const uint32_t count = sort->objects;
    const uint64_t most = cgt_loose_grid_most_cells(count), cells = scene->world.loose.cells;
    cgt_result result = cgt_buffer_reserve_scattered(hooks, &scene->buffer[CGT_BUFFER_LOOSE_START],
                                                     (size_t)(most > cells ? most : cells) + 1, sizeof(uint32_t));
    if (result == CGT_OK)
        result = cgt_buffer_reserve_scattered(hooks, &scene->buffer[CGT_BUFFER_LOOSE_OBJECT], count, sizeof(uint32_t));
    if (result == CGT_OK)
        result = cgt_loose_sort_reserve(hooks, &scene->buffer[CGT_BUFFER_LOOSE_BINS], sort);
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory for a loose grid of %u primitives",
                        scene->world.objects.count);
    return CGT_OK;
}

/* ---- the whole ---- */

static void report(cgt_scene *scene, uint32_t held)
{
    cgt_scene_statistics *st = &scene->statistics;
    const cgt_loose_grid *g = &scene->world.loose;
    const cgt_loose_level *finest = &g->level[g->levels - 1];
    const size_t clusters = scene->world.cluster ? cgt_clusters(scene->world.objects.count) : 0;
    for (int a = 0; a < 3; a++)
        st->resolution[a] = finest->size[a];
    st->cells = g->cells;
    st->levels = g->levels;
    st->references = held;
    st->reference_bits = 32;
    st->structure_bytes = ((size_t)g->cells + 1 + held) * sizeof(uint32_t) + clusters * sizeof(cgt_cluster);
    st->local_store_bytes = st->structure_bytes + (size_t)scene->world.objects.spheres * sizeof(cgt_sphere) +
                            (size_t)scene->world.objects.triangles * sizeof(cgt_triangle);
    st->fits_local_store = st->local_store_bytes + (64u << 10) <= 256u << 10;
    if (scene->options.resolution[0])
        snprintf(st->reason, sizeof st->reason, "loose grid: resolution asked for");
    else
        snprintf(st->reason, sizeof st->reason, "loose grid: %u levels, %.3g %s a cell, reach %.3g to %.3g", g->levels,
                 (double)held / g->cells, clusters ? "runs of 8 neighbouring triangles" : "objects",
                 (double)g->level[0].reach[0], (double)finest->reach[0]);
}

cgt_result cgt_loose_grid_commit(cgt_scene *scene)
{
    cgt_world *world = &scene->world;
    cgt_loose_grid *g = &world->loose;
    const cgt_objects *o = &world->objects;
    keys_job job = {.objects = o, .cluster = world->cluster, .kernel = scene->context->kernel};
    cgt_loose_sort *sort = &job.sort;
    const cgt_size_classes *classes = scene->buffer[CGT_BUFFER_SIZE_CLASSES].data;
    cgt_loose_grid_plan(g, classes, scene->options.resolution);
    const uint32_t count = world->cluster ? cgt_clusters(o->count) : o->count;
    const uint32_t skipped =
        cgt_loose_sort_plan(sort, scene->context, count, cgt_size_classes_count(classes), g->cells);
    const cgt_result result = reserve(scene, sort);
    if (result != CGT_OK)
        return result;
    float *work = scene->buffer[CGT_BUFFER_LOOSE_WORK].data;
    job.keys = (cgt_loose_keys){.grid = g, .middle = work, .triangles = o->triangles, .skipped = skipped};
    sort->entry = (uint32_t *)work + (world->cluster ? 0 : (size_t)4 * o->triangles);
    sort->place = scene->buffer[CGT_BUFFER_LOOSE_BINS].data;
    sort->start = scene->buffer[CGT_BUFFER_LOOSE_START].data;
    sort->object = scene->buffer[CGT_BUFFER_LOOSE_OBJECT].data;
    sort->key = sort->direct ? sort->entry : sort->object;
    cgt_run_tasks(scene->context, make_keys, &job, cgt_loose_chunks(count));
    cgt_loose_sort_run(sort, scene->context);
    g->start = job.sort.start;
    g->object = job.sort.object;
    report(scene, sort->valid);
    return CGT_OK;
}
