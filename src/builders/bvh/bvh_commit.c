/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The BVH of a commit, or of the first rays that need one: its memory, its tasks, its statistics. */
#include <stdio.h>
#include <string.h>

#include "builders/bvh/bvh_build.h"
#include "builders/commit.h"
#include "builders/report.h"
#include "builders/order/cell_sort.h"

/* Leaves are numbered by 26 bits, of which the last number is not used. */
#define MAX_LEAVES CGT_BVH_INDEX_MASK

#define NONTEMPORAL_BYTES ((size_t)8 << 20) /* of blocks: more will not stay in caches until it is read */
#define WORK_WORDS 5u                       /* for a primitive, see cgt_bvh_build */

typedef struct bvh_job {
    const cgt_bvh_builder *builder;
    cgt_bvh_plan plan;
    cgt_cell_sort sort;
    cgt_bvh_build build;
} bvh_job;

/* ---- tasks ---- */

static void split_range(void *argument, uint32_t range)
{
    const bvh_job *job = argument;
    job->builder->split(&job->build, &job->build.range[range]);
}

static void build_leaves(void *argument, uint32_t range)
{
    const bvh_job *job = argument;
    job->builder->leaves(&job->build, range);
}

static void choose_nodes(void *argument, uint32_t range)
{
    const bvh_job *job = argument;
    job->builder->choose(&job->build, &job->build.range[range]);
}

/* Ranges, then the top. */
static void build_nodes(void *argument, uint32_t range)
{
    const bvh_job *job = argument;
    const cgt_bvh_build *b = &job->build;
    job->builder->nodes(b, range < b->ranges ? &b->range[range] : &b->top);
}

/* ---- memory ---- */

/* Reserves some more than needed, for what differs a little from frame to frame. */
static cgt_result reserve_more(const cgt_scene *scene, cgt_buffer *buffer, size_t count, size_t size)
{
    const size_t more = count * size <= buffer->bytes ? 0 : count / 16 + 16;
    return cgt_buffer_reserve(&scene->context->memory, buffer, count + more, size);
}

static cgt_result out_of_memory(const cgt_scene *scene, cgt_result result)
{
    return cgt_fail(scene->context, result, "out of memory for a BVH of %u primitives",
                    scene->committed_scene.prims.count);
}

/* Reserves what depends on the number of primitives. */
static cgt_result reserve_prims(cgt_scene *scene, bvh_job *job)
{
    const cgt_memory_hooks *hooks = &scene->context->memory;
    cgt_cell_sort *sort = &job->sort;
    const size_t count = sort->count;
    cgt_buffer *buffer = scene->buffer;
    cgt_result result = cgt_cell_sort_reserve(sort, scene, CGT_BUFFER_BVH_START,
                                              cgt_bvh_max_cells(sort->prims, sort->count), CGT_BUFFER_BVH_PRIM);
    if (result == CGT_OK)
        result =
            cgt_buffer_reserve(hooks, &buffer[CGT_BUFFER_BVH_LEAVES], count * job->build.leaves_each, sizeof(uint16_t));
    if (result == CGT_OK)
        result =
            cgt_buffer_reserve_scattered(hooks, &buffer[CGT_BUFFER_BVH_WORK], count, WORK_WORDS * sizeof(uint32_t));
    return result == CGT_OK ? CGT_OK : out_of_memory(scene, result);
}

static cgt_result reserve_ranges(cgt_scene *scene, const bvh_job *job, uint32_t ranges)
{
    const cgt_result result = reserve_more(scene, &scene->buffer[CGT_BUFFER_BVH_RANGES], ranges,
                                           sizeof(cgt_bvh_range) + job->builder->branch_bytes);
    return result == CGT_OK ? CGT_OK : out_of_memory(scene, result);
}

/* Reserves what depends on the number of leaves: blocks of all kinds, and records. */
static cgt_result reserve_leaves(cgt_scene *scene, const bvh_job *job, const uint32_t blocks[CGT_KINDS])
{
    const cgt_bvh_builder *w = job->builder;
    const size_t leaves = job->build.leaves;
    cgt_buffer *buffer = scene->buffer;
    if (leaves > MAX_LEAVES)
        return cgt_fail(scene->context, CGT_ERROR_TOO_LARGE, "BVH: %zu leaves: at most %u", leaves, MAX_LEAVES);
    /* a reference to each record, and those to children of nodes over ranges: fewer than ranges */
    cgt_result result = reserve_more(scene, &buffer[CGT_BUFFER_BVH_WORK],
                                     leaves * (w->leaf_bytes + w->inner_bytes + 2 * sizeof(uint32_t)) + CGT_ALIGNMENT +
                                         (size_t)job->build.ranges * w->lanes * sizeof(uint32_t),
                                     1);
    for (uint32_t k = 0; k < CGT_KINDS && result == CGT_OK; k++)
        result = reserve_more(scene, &buffer[CGT_BUFFER_BVH_SPHERES + k], blocks[k], w->block_bytes[k]);
    return result == CGT_OK ? CGT_OK : out_of_memory(scene, result);
}

/* ---- steps ---- */

/* Sorts primitives or clusters by cell. A scene whose clusters serve its grid alone has no size classes of primitives
 * yet. */
static cgt_result sort_prims(cgt_scene *scene, bvh_job *job)
{
    const cgt_committed_scene *committed_scene = &scene->committed_scene;
    cgt_cell_sort *sort = &job->sort;
    cgt_result result = CGT_OK;
    if (committed_scene->cluster && !job->build.cluster)
        result = cgt_compute_size_classes(scene);
    if (result != CGT_OK)
        return result;
    sort->prim_keys = job->builder->keys;
    sort->cluster_keys = job->builder->cluster_keys;
    cgt_bvh_plan_parts(&job->plan, scene->buffer[CGT_BUFFER_SIZE_CLASSES].data, &committed_scene->prims);
    cgt_cell_sort_plan(sort, scene, job->build.cluster, &job->plan, job->plan.cells);
    result = reserve_prims(scene, job);
    if (result == CGT_OK)
        cgt_cell_sort_run(sort, scene->context);
    return result;
}

/* Finds and counts the leaves of all ranges. */
static cgt_result split_cells(cgt_scene *scene, bvh_job *job)
{
    cgt_bvh_build *b = &job->build;
    const size_t prims = job->sort.count;
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
    b->range = (cgt_bvh_range *)(void *)((char *)b->branch + (size_t)b->ranges * job->builder->branch_bytes);
    cgt_bvh_list_ranges(&job->plan, b->start, job->sort.valid, prims_each, b->range);
    cgt_run_tasks(scene->context, split_range, job, b->ranges);
    return CGT_OK;
}

/* Places leaves, blocks and binary nodes of the ranges one after the other. */
static void place_leaves(cgt_bvh_build *b, uint32_t blocks[CGT_KINDS])
{
    uint32_t inner = 0;
    b->leaves = 0;
    memset(blocks, 0, CGT_KINDS * sizeof *blocks);
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

static size_t block_bytes(const cgt_bvh_builder *w, const uint32_t blocks[CGT_KINDS])
{
    size_t bytes = 0;
    for (uint32_t k = 0; k < CGT_KINDS; k++)
        bytes += (size_t)blocks[k] * w->block_bytes[k];
    return bytes;
}

static cgt_result join_leaves(cgt_scene *scene, bvh_job *job, uint32_t blocks[CGT_KINDS])
{
    cgt_bvh_build *b = &job->build;
    place_leaves(b, blocks);
    if (!b->leaves) /* the commit counted some: their floats have changed since */
        return cgt_fail(scene->context, CGT_ERROR_INVALID_ARGUMENT, "BVH: no primitive is left of the commit's arrays");
    const cgt_result result = reserve_leaves(scene, job, blocks);
    if (result != CGT_OK)
        return result;
    b->nontemporal = block_bytes(job->builder, blocks) > NONTEMPORAL_BYTES;
    b->record = scene->buffer[CGT_BUFFER_BVH_WORK].data;
    b->triangle_blocks = blocks[CGT_KIND_TRIANGLES];
    for (uint32_t k = 0; k < CGT_KINDS; k++)
        b->block[k] = scene->buffer[CGT_BUFFER_BVH_SPHERES + k].data;
    cgt_run_tasks(scene->context, build_leaves, job, b->ranges);
    job->builder->join(b);
    return CGT_OK;
}

/* Places the nodes of the ranges after those of the top. The root has number 0: it is in the top, or there is one
 * range. */
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

/* Reserves the nodes' turned slabs where some may have them. */
static cgt_result reserve_turned(cgt_scene *scene, bvh_job *job, const cgt_bvh *tree)
{
    cgt_bvh_build *b = &job->build;
    cgt_buffer *buffer = &scene->buffer[CGT_BUFFER_BVH_TURNED];
    bool has_bundles = false;
    for (uint32_t i = 0; i < b->ranges; i++)
        has_bundles |= b->range[i].has_bundles;
    if (!has_bundles)
        return CGT_OK;
    const cgt_result result = reserve_more(scene, buffer, tree->nodes, job->builder->turned_bytes);
    b->turned = buffer->data;
    return result == CGT_OK ? CGT_OK : out_of_memory(scene, result);
}

static cgt_result collapse(cgt_scene *scene, bvh_job *job, cgt_bvh *tree)
{
    cgt_bvh_build *b = &job->build;
    cgt_run_tasks(scene->context, choose_nodes, job, b->ranges);
    place_nodes(b, tree);
    const cgt_result result =
        reserve_more(scene, &scene->buffer[CGT_BUFFER_BVH_NODES], tree->nodes, job->builder->node_bytes);
    if (result != CGT_OK)
        return out_of_memory(scene, result);
    b->node = scene->buffer[CGT_BUFFER_BVH_NODES].data;
    const cgt_result turned_result = reserve_turned(scene, job, tree);
    if (turned_result != CGT_OK)
        return turned_result;
    cgt_run_tasks(scene->context, build_nodes, job, b->ranges + 1);
    return CGT_OK;
}

static cgt_result build(cgt_scene *scene, cgt_bvh *tree)
{
    const cgt_bvh_builder *builder = scene->context->kernel->bvh_builder;
    const cgt_cluster *cluster = scene->committed_scene.bvh_of_clusters ? scene->committed_scene.cluster : NULL;
    bvh_job job = {.builder = builder,
                   .build = {.prims = &scene->committed_scene.prims,
                             .cluster = cluster,
                             .leaves_each = cluster && builder->lanes < CGT_CLUSTER ? CGT_CLUSTER / builder->lanes : 1,
                             .scale = scene->committed_scene.scale}};
    uint32_t blocks[CGT_KINDS];
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
    tree->turned = job.build.turned;
    tree->sphere = job.build.block[CGT_KIND_SPHERES];
    tree->triangle = job.build.block[CGT_KIND_TRIANGLES];
    tree->capsule = job.build.block[CGT_KIND_CAPSULES];
    tree->sphere_blocks = blocks[CGT_KIND_SPHERES];
    tree->triangle_blocks = blocks[CGT_KIND_TRIANGLES];
    tree->capsule_blocks = blocks[CGT_KIND_CAPSULES];
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
    const uint32_t blocks[CGT_KINDS] = {tree->sphere_blocks, tree->triangle_blocks, tree->capsule_blocks};
    research->bvh_leaves = blocks[0] + blocks[1] + blocks[2];
    research->bvh_depth = tree->depth;
    const size_t node_bytes = (size_t)w->node_bytes + (tree->turned ? w->turned_bytes : 0);
    st->bvh_bytes = tree->nodes * node_bytes + block_bytes(w, blocks);
    st->bvh_build_ms = ms;
    st->bytes = cgt_scene_bytes(scene);
}

cgt_result cgt_bvh_build_tree(cgt_scene *scene)
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
    const cgt_result result = cgt_bvh_build_tree(scene);
    cgt_scene_statistics *st = &scene->statistics;
    cgt_research_scene_statistics *research = &scene->research_statistics;
    if (result != CGT_OK)
        return result;
    research->references = scene->committed_scene.valid;
    research->reference_bits = 32;
    st->structure_bytes = st->bvh_bytes;
    cgt_report_local_store(scene, 0, 0); /* leaves hold copies */
    return CGT_OK;
}
