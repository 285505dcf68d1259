/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The wide tree of a commit, or of the first rays that want one: its memory, its tasks, its statistics. */
#include <stdio.h>

#include "builders/commit.h"
#include "core/float_environment.h"
#include "dispatch/kernel.h"
#include "builders/grid/loose_grid_build.h"
#include "builders/bvh/bvh_build.h"
#include "builders/bvh/bvh_on_demand.h"

/* Leaves are numbered by 26 bits, of which the last number is not used. */
#define MAX_LEAVES CGT_BVH_INDEX_MASK

#define NONTEMPORAL_BYTES ((size_t)8 << 20) /* of blocks: more will not stay in caches until it is read */
#define WORK_WORDS 5u                       /* for an object, see cgt_bvh_build */

/* Rays that ask for a tree before it is built. It takes as long as some 1/60 as many rays as objects take through the grid
 * where they share nothing, by estimate; but whether they do share nothing is not known. */
static uint64_t min_rays_for_build(uint32_t valid) { return valid / 32; }

typedef struct bvh_job {
    const cgt_kernel *kernel;
    cgt_bvh_plan plan;
    cgt_bvh_keys_job keys;
    cgt_cell_sort sort;
    cgt_bvh_build build;
} bvh_job;

/* ---- tasks ---- */

static void compute_prim_keys(const bvh_job *job, uint32_t first, uint32_t end)
{
    const cgt_primitive_array *a = cgt_primitives_array(job->build.prims, first);
    for (uint32_t prim = first; prim < end; a++) {
        const uint32_t stop = end - a->first < a->count ? end : a->first + a->count;
        job->kernel->bvh_builder->keys(&job->keys, a, prim, stop, job->sort.key + prim);
        prim = stop;
    }
}

/* Of a chunk of what is sorted: objects or clusters. */
static void compute_chunk_keys(void *argument, uint32_t chunk)
{
    const bvh_job *job = argument;
    const cgt_cluster *cluster = job->build.cluster;
    const uint32_t first = chunk * CGT_CELL_SORT_CHUNK, remaining = job->sort.prims - first;
    const uint32_t count = remaining < CGT_CELL_SORT_CHUNK ? remaining : CGT_CELL_SORT_CHUNK;
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    if (cluster)
        job->kernel->bvh_builder->cluster_keys(&job->keys, cluster + first, count, job->sort.key + first);
    else
        compute_prim_keys(job, first, first + count);
    cgt_float_environment_leave(&callers);
    cgt_cell_sort_chunk(&job->sort, chunk);
}

static void split_range(void *argument, uint32_t range)
{
    const bvh_job *job = argument;
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    job->kernel->bvh_builder->split(&job->build, &job->build.range[range]);
    cgt_float_environment_leave(&callers);
}

static void build_leaves(void *argument, uint32_t range)
{
    const bvh_job *job = argument;
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    job->kernel->bvh_builder->leaves(&job->build, range);
    cgt_float_environment_leave(&callers);
}

static void choose_nodes(void *argument, uint32_t range)
{
    const bvh_job *job = argument;
    job->kernel->bvh_builder->choose(&job->build, &job->build.range[range]);
}

/* Of the ranges, then of the top. */
static void build_nodes(void *argument, uint32_t range)
{
    const bvh_job *job = argument;
    const cgt_bvh_build *b = &job->build;
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    job->kernel->bvh_builder->nodes(b, range < b->ranges ? &b->range[range] : &b->top);
    cgt_float_environment_leave(&callers);
}

/* ---- memory ---- */

/* Room for what differs a little from frame to frame. */
static cgt_result reserve_more(const cgt_scene *scene, cgt_buffer *buffer, size_t count, size_t size)
{
    const size_t more = count * size <= buffer->bytes ? 0 : count / 16 + 16;
    return cgt_buffer_reserve(&scene->context->memory, buffer, count + more, size);
}

static cgt_result out_of_memory(const cgt_scene *scene, cgt_result result)
{
    return cgt_fail(scene->context, result, "out of memory for a wide tree of %u primitives",
                    scene->committed_scene.prims.count);
}

/* What follows from the number of objects. */
static cgt_result reserve_prims(cgt_scene *scene, const cgt_cell_sort *sort, uint32_t leaves_each)
{
    const cgt_memory_hooks *hooks = &scene->context->memory;
    const size_t count = sort->prims, cells = (size_t)cgt_bvh_max_cells(&scene->committed_scene.prims, sort->prims);
    cgt_buffer *buffer = scene->buffer;
    cgt_result result = cgt_buffer_reserve_scattered(hooks, &buffer[CGT_BUFFER_BVH_START], cells + 1, sizeof(uint32_t));
    if (result == CGT_OK)
        result = cgt_buffer_reserve_scattered(hooks, &buffer[CGT_BUFFER_BVH_PRIM], count, sizeof(uint32_t));
    if (result == CGT_OK)
        result = cgt_cell_sort_reserve(hooks, &buffer[CGT_BUFFER_CELL_SORT_BINS], sort);
    if (result == CGT_OK)
        result = cgt_buffer_reserve(hooks, &buffer[CGT_BUFFER_BVH_LEAVES], count * leaves_each, sizeof(uint16_t));
    if (result == CGT_OK)
        result =
            cgt_buffer_reserve_scattered(hooks, &buffer[CGT_BUFFER_BVH_WORK], count, WORK_WORDS * sizeof(uint32_t));
    return result == CGT_OK ? CGT_OK : out_of_memory(scene, result);
}

static cgt_result reserve_ranges(cgt_scene *scene, const bvh_job *job, uint32_t ranges)
{
    const cgt_result result = reserve_more(scene, &scene->buffer[CGT_BUFFER_BVH_RANGES], ranges,
                                           sizeof(cgt_bvh_range) + job->kernel->bvh_builder->branch_bytes);
    return result == CGT_OK ? CGT_OK : out_of_memory(scene, result);
}

/* What follows from the number of leaves: blocks of both kinds, and records. */
static cgt_result reserve_leaves(cgt_scene *scene, const bvh_job *job, const uint32_t blocks[2])
{
    const cgt_bvh_builder *w = job->kernel->bvh_builder;
    const size_t leaves = (size_t)blocks[0] + blocks[1];
    cgt_buffer *buffer = scene->buffer;
    if (leaves > MAX_LEAVES)
        return cgt_fail(scene->context, CGT_ERROR_TOO_LARGE, "wide tree: %zu leaves: at most %u", leaves, MAX_LEAVES);
    /* a reference to each record, and those to children of nodes over ranges: fewer than ranges */
    cgt_result result = reserve_more(scene, &buffer[CGT_BUFFER_BVH_WORK],
                                     leaves * (w->leaf_bytes + w->inner_bytes + 2 * sizeof(uint32_t)) + CGT_ALIGNMENT +
                                         (size_t)job->build.ranges * w->lanes * sizeof(uint32_t),
                                     1);
    if (result == CGT_OK)
        result = reserve_more(scene, &buffer[CGT_BUFFER_BVH_SPHERES], blocks[0], w->block_bytes[0]);
    if (result == CGT_OK)
        result = reserve_more(scene, &buffer[CGT_BUFFER_BVH_TRIANGLES], blocks[1], w->block_bytes[1]);
    return result == CGT_OK ? CGT_OK : out_of_memory(scene, result);
}

/* ---- steps ---- */

/* Objects by cell. */
static cgt_result sort_prims(cgt_scene *scene, bvh_job *job)
{
    const cgt_committed_scene *committed_scene = &scene->committed_scene;
    const cgt_primitives *o = &committed_scene->prims;
    const cgt_context *context = scene->context;
    cgt_cell_sort *sort = &job->sort;
    const bool clusters = job->build.cluster != NULL;
    const cgt_result summarised = committed_scene->cluster && !clusters ? cgt_compute_size_classes(scene) : CGT_OK;
    if (summarised != CGT_OK)
        return summarised;
    const cgt_size_classes *classes = scene->buffer[CGT_BUFFER_SIZE_CLASSES].data;
    const uint32_t count = clusters ? cgt_clusters(o->count) : o->count;
    cgt_bvh_plan_parts(&job->plan, classes, o);
    const uint32_t skipped = cgt_cell_sort_plan(sort, context, count, cgt_size_classes_count(classes), job->plan.cells);
    const cgt_result result = reserve_prims(scene, sort, job->build.leaves_each);
    if (result != CGT_OK)
        return result;
    float *work = scene->buffer[CGT_BUFFER_CELL_SORT_WORK].data;
    job->keys = (cgt_bvh_keys_job){.plan = &job->plan, .middle = work, .triangles = o->triangles, .skipped = skipped};
    sort->entry = (uint32_t *)work + (clusters ? 0 : (size_t)4 * o->triangles);
    sort->bin_end = scene->buffer[CGT_BUFFER_CELL_SORT_BINS].data;
    sort->start = scene->buffer[CGT_BUFFER_BVH_START].data;
    sort->prim = scene->buffer[CGT_BUFFER_BVH_PRIM].data;
    sort->key = sort->direct ? sort->entry : sort->prim;
    cgt_run_tasks(context, compute_chunk_keys, job, cgt_cell_sort_chunks(count));
    cgt_cell_sort_run(sort, context);
    return CGT_OK;
}

/* Leaves, found and counted. */
static cgt_result split_cells(cgt_scene *scene, bvh_job *job)
{
    cgt_bvh_build *b = &job->build;
    const size_t prims = job->sort.prims;
    const uint32_t prims_each = b->cluster ? CGT_CLUSTER : 1;
    uint32_t *work = scene->buffer[CGT_BUFFER_BVH_WORK].data;
    b->start = job->sort.start;
    b->prim = job->sort.prim;
    b->key = work;
    b->sorted = job->sort.valid;
    b->scratch = work + prims;
    for (size_t a = 0; a < 3; a++)
        b->middle[a] = (float *)work + (2 + a) * prims;
    b->leaf = scene->buffer[CGT_BUFFER_BVH_LEAVES].data;
    b->ranges = cgt_bvh_list_ranges(&job->plan, b->start, job->sort.valid, prims_each, NULL);
    const cgt_result result = reserve_ranges(scene, job, b->ranges);
    if (result != CGT_OK)
        return result;
    b->branch = scene->buffer[CGT_BUFFER_BVH_RANGES].data;
    b->range =
        (cgt_bvh_range *)(void *)((char *)b->branch + (size_t)b->ranges * job->kernel->bvh_builder->branch_bytes);
    cgt_bvh_list_ranges(&job->plan, b->start, job->sort.valid, prims_each, b->range);
    cgt_run_tasks(scene->context, split_range, job, b->ranges);
    return CGT_OK;
}

/* Leaves, blocks and binary nodes, one range after the other. */
static void place_leaves(cgt_bvh_build *b, uint32_t blocks[2])
{
    uint32_t inner = 0;
    b->leaves = 0;
    blocks[0] = blocks[1] = 0;
    for (uint32_t i = 0; i < b->ranges; i++) {
        cgt_bvh_range *r = &b->range[i];
        r->first_leaf = b->leaves;
        r->first_block = blocks[r->kind];
        r->first_inner = inner;
        b->leaves += r->leaves;
        blocks[r->kind] += r->leaves;
        inner += r->leaves - 1;
    }
    b->top = (cgt_bvh_range){.first_leaf = b->leaves, .first_inner = inner};
}

static cgt_result join_leaves(cgt_scene *scene, bvh_job *job, uint32_t blocks[2])
{
    cgt_bvh_build *b = &job->build;
    place_leaves(b, blocks);
    const cgt_result result = reserve_leaves(scene, job, blocks);
    if (result != CGT_OK)
        return result;
    b->nontemporal = (size_t)blocks[0] * job->kernel->bvh_builder->block_bytes[0] +
                         (size_t)blocks[1] * job->kernel->bvh_builder->block_bytes[1] >
                     NONTEMPORAL_BYTES;
    b->record = scene->buffer[CGT_BUFFER_BVH_WORK].data;
    b->block[CGT_KIND_SPHERES] = scene->buffer[CGT_BUFFER_BVH_SPHERES].data;
    b->block[CGT_KIND_TRIANGLES] = scene->buffer[CGT_BUFFER_BVH_TRIANGLES].data;
    cgt_run_tasks(scene->context, build_leaves, job, b->ranges);
    job->kernel->bvh_builder->join(b);
    return CGT_OK;
}

/* The root has number 0: it is in the top, or there is but one range. */
static void place_nodes(cgt_bvh_build *b, cgt_bvh *tree)
{
    cgt_bvh_range *top = &b->top;
    if (b->root & CGT_BVH_LEAF_REF)
        top->nodes = top->deepest = 1;
    tree->nodes = top->nodes;
    tree->depth = top->deepest;
    for (uint32_t i = 0; i < b->ranges; i++) {
        cgt_bvh_range *r = &b->range[i];
        r->first_node = tree->nodes;
        tree->nodes += r->nodes;
        tree->depth = r->deepest > tree->depth ? r->deepest : tree->depth;
    }
}

static cgt_result collapse(cgt_scene *scene, bvh_job *job, cgt_bvh *tree)
{
    cgt_bvh_build *b = &job->build;
    cgt_run_tasks(scene->context, choose_nodes, job, b->ranges);
    place_nodes(b, tree);
    const cgt_result result =
        reserve_more(scene, &scene->buffer[CGT_BUFFER_BVH_NODES], tree->nodes, job->kernel->bvh_builder->node_bytes);
    if (result != CGT_OK)
        return out_of_memory(scene, result);
    b->node = scene->buffer[CGT_BUFFER_BVH_NODES].data;
    cgt_run_tasks(scene->context, build_nodes, job, b->ranges + 1);
    return CGT_OK;
}

static cgt_result build(cgt_scene *scene, cgt_bvh *tree)
{
    const uint32_t lanes = scene->context->kernel->bvh_builder->lanes;
    const cgt_cluster *cluster = scene->committed_scene.bvh_of_clusters ? scene->committed_scene.cluster : NULL;
    bvh_job job = {.kernel = scene->context->kernel,
                   .build = {.prims = &scene->committed_scene.prims,
                             .cluster = cluster,
                             .leaves_each = cluster && lanes < CGT_CLUSTER ? CGT_CLUSTER / lanes : 1,
                             .scale = scene->committed_scene.scale}};
    uint32_t blocks[2];
    cgt_result result = sort_prims(scene, &job);
    if (result == CGT_OK)
        result = split_cells(scene, &job);
    if (result == CGT_OK)
        result = join_leaves(scene, &job, blocks);
    if (result == CGT_OK)
        result = collapse(scene, &job, tree);
    if (result != CGT_OK)
        return result;
    tree->node = job.build.node;
    tree->sphere = job.build.block[CGT_KIND_SPHERES];
    tree->triangle = job.build.block[CGT_KIND_TRIANGLES];
    tree->sphere_blocks = blocks[CGT_KIND_SPHERES];
    tree->triangle_blocks = blocks[CGT_KIND_TRIANGLES];
    for (int a = 0; a < 3; a++) {
        tree->low[a] = job.build.low[a];
        tree->high[a] = job.build.high[a];
    }
    return CGT_OK;
}

/* ---- the whole ---- */

static void report(cgt_scene *scene, const cgt_bvh *tree, double ms)
{
    const cgt_bvh_builder *w = scene->context->kernel->bvh_builder;
    cgt_scene_statistics *st = &scene->statistics;
    cgt_research_scene_statistics *research = &scene->research_statistics;
    research->bvh_nodes = tree->nodes;
    research->bvh_leaves = tree->sphere_blocks + tree->triangle_blocks;
    research->bvh_depth = tree->depth;
    st->bvh_bytes = (size_t)tree->nodes * w->node_bytes + (size_t)tree->sphere_blocks * w->block_bytes[0] +
                    (size_t)tree->triangle_blocks * w->block_bytes[1];
    st->bvh_build_ms = ms;
    st->bytes = cgt_scene_bytes(scene);
}

static cgt_result build_tree(cgt_scene *scene)
{
    const double start = cgt_now_ms();
    cgt_bvh tree = {0};
    const cgt_result result = build(scene, &tree);
    if (result != CGT_OK)
        return result;
    scene->committed_scene.bvh = tree;
    report(scene, &tree, cgt_now_ms() - start);
    return CGT_OK;
}

cgt_result cgt_bvh_commit(cgt_scene *scene)
{
    const cgt_result result = build_tree(scene);
    cgt_scene_statistics *st = &scene->statistics;
    cgt_research_scene_statistics *research = &scene->research_statistics;
    if (result != CGT_OK)
        return result;
    research->references = scene->committed_scene.valid;
    research->reference_bits = 32;
    st->structure_bytes = st->bvh_bytes;
    research->local_store_bytes = st->bvh_bytes;
    research->fits_local_store = research->local_store_bytes + (64u << 10) <= 256u << 10;
    return CGT_OK;
}

/* Several threads may want it: one builds it, and the others trace as they did before. */
static cgt_result build_for_rays(cgt_scene *scene, bool *is_built)
{
    cgt_result result = CGT_OK;
    cgt_float_environment callers;
    if (pthread_mutex_trylock(&scene->bvh_lock))
        return CGT_OK;
    if (!atomic_load_explicit(&scene->bvh_is_built, memory_order_relaxed)) {
        cgt_float_environment_enter(&callers);
        result = build_tree(scene);
        cgt_float_environment_leave(&callers);
        atomic_store_explicit(&scene->bvh_is_built, result == CGT_OK, memory_order_release);
    }
    pthread_mutex_unlock(&scene->bvh_lock);
    *is_built = result == CGT_OK;
    return result;
}

cgt_result cgt_bvh_build_on_demand(const cgt_scene *scene, uint64_t rays, bool *is_built)
{
    const cgt_committed_scene *committed_scene = &scene->committed_scene;
    cgt_scene *mutable_scene = scene->mutable_scene;
    *is_built = false;
    if (scene->options.structure != CGT_STRUCTURE_AUTO || committed_scene->structure != CGT_STRUCTURE_LOOSE_GRID ||
        !committed_scene->valid || committed_scene->brute_force) {
        *is_built = committed_scene->structure == CGT_STRUCTURE_BVH && committed_scene->bvh.node;
        return CGT_OK;
    }
    if (atomic_load_explicit(&mutable_scene->bvh_is_built, memory_order_acquire)) {
        *is_built = true;
        return CGT_OK;
    }
    const uint64_t earlier_rays = atomic_fetch_add_explicit(&mutable_scene->bvh_rays, rays, memory_order_relaxed);
    if (!rays || earlier_rays + rays < min_rays_for_build(committed_scene->valid))
        return CGT_OK;
    return build_for_rays(mutable_scene, is_built);
}
