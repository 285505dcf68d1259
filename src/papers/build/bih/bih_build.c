/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The build of a bounding interval hierarchy: memory, items, the top, the tasks below it. All memory is reserved before
 * anything is built. */
#include "papers/build/bih/bih_build.h"

#define PRIMS_PER_CHUNK 8192u

typedef struct job {
    const cgt_primitives *prims;
    cgt_bih_workspace workspace;
    bool all; /* primitives are valid */
} job;

/* ---- memory ---- */

/* Takes bytes off a block; without a block, only adds them up. */
static void *carve(char *block, size_t *used_bytes, size_t bytes)
{
    void *part = block ? block + *used_bytes : NULL;
    *used_bytes += (bytes + CGT_ALIGNMENT - 1) / CGT_ALIGNMENT * CGT_ALIGNMENT;
    return part;
}

/* With block NULL it finds out how many bytes are needed. */
static size_t carve_room(cgt_bih_workspace *w, char *block, uint32_t items, uint32_t tasks, uint32_t prim_chunks)
{
    size_t used_bytes = 0;
    w->item = carve(block, &used_bytes, items * sizeof(cgt_bih_item));
    w->chunk = carve(block, &used_bytes, cgt_bih_chunk_bytes(items));
    w->task = carve(block, &used_bytes, tasks * sizeof(cgt_bih_task));
    w->valid = carve(block, &used_bytes, prim_chunks * sizeof(uint32_t));
    return used_bytes;
}

/* Numbers of the top: it is empty where one task does it all. */
static void plan_top(cgt_bih_workspace *w, uint32_t items)
{
    const uint32_t share = items / CGT_BIH_TASKS_OF_ALL;
    w->task_items = share < CGT_BIH_MIN_TASK ? CGT_BIH_MIN_TASK : share;
    w->top_pairs = 1 + (items > w->task_items ? CGT_BIH_TOP_SPLITS + CGT_BIH_TOP_CLIPS : 0);
}

static cgt_result reserve_memory(cgt_context *context, const cgt_bih_memory *memory, uint32_t items,
                                 uint32_t prim_chunks, cgt_bih_workspace *w)
{
    const cgt_memory_hooks *hooks = &context->memory;
    if (items > CGT_BIH_MAX_PRIMS || (uint64_t)items * (sizeof(cgt_bih_item) + 3 * sizeof(cgt_bih_node)) > SIZE_MAX / 2)
        return cgt_fail(context, CGT_ERROR_TOO_LARGE,
                        "commit: %u primitives are too many for a bounding interval hierarchy", items);
    plan_top(w, items);
    const uint32_t tasks = w->top_pairs > 1 ? CGT_BIH_TOP_SPLITS + 1 : 1;
    const size_t nodes = 2 * ((size_t)w->top_pairs + cgt_bih_task_pairs(items));
    const size_t bytes = carve_room(w, NULL, items, tasks, prim_chunks);
    cgt_result result = cgt_buffer_reserve_scattered(hooks, memory->nodes, nodes, sizeof(cgt_bih_node));
    if (result == CGT_OK)
        result = cgt_buffer_reserve_scattered(hooks, memory->references, items, sizeof(uint32_t));
    if (result == CGT_OK)
        result = cgt_buffer_reserve(hooks, memory->work, bytes, 1);
    if (result != CGT_OK)
        return cgt_fail(context, result, "commit: out of memory for a bounding interval hierarchy over %u primitives",
                        items);
    carve_room(w, memory->work->data, items, tasks, prim_chunks);
    w->node = memory->nodes->data;
    w->reference = memory->references->data;
    return CGT_OK;
}

/* ---- items ---- */

static uint32_t chunk_end(const job *j, uint32_t first)
{
    return j->prims->count - first < PRIMS_PER_CHUNK ? j->prims->count : first + PRIMS_PER_CHUNK;
}

static void count_prims_chunk(void *argument, uint32_t index)
{
    const job *j = argument;
    const uint32_t first = index * PRIMS_PER_CHUNK;
    j->workspace.valid[index] = cgt_bih_count_valid(j->prims, first, chunk_end(j, first));
}

static void collect_prims_chunk(void *argument, uint32_t index)
{
    const job *j = argument;
    const uint32_t first = index * PRIMS_PER_CHUNK;
    cgt_bih_collect(j->prims, first, chunk_end(j, first), j->all,
                    j->workspace.item + (j->all ? first : j->workspace.valid[index]));
}

static void collect(const cgt_context *context, job *j, uint32_t chunks)
{
    uint32_t sum = 0;
    if (!j->all)
        cgt_run_tasks(context, count_prims_chunk, j, chunks);
    for (uint32_t i = 0; !j->all && i < chunks; i++) {
        const uint32_t count = j->workspace.valid[i];
        j->workspace.valid[i] = sum;
        sum += count;
    }
    cgt_run_tasks(context, collect_prims_chunk, j, chunks);
}

/* ---- the tree ---- */

static void build_subtree(void *argument, uint32_t index)
{
    const job *j = argument;
    cgt_bih_build_subtree(j->workspace.item, &j->workspace.task[index]);
}

static void add_output(cgt_bih *tree, const cgt_bih_output *out)
{
    tree->nodes += out->splits + out->clips + out->leaves;
    tree->leaves += out->leaves;
    tree->clips += out->clips;
    tree->references += out->references;
    tree->depth = tree->depth > out->depth ? tree->depth : out->depth;
    tree->largest_leaf = tree->largest_leaf > out->largest_leaf ? tree->largest_leaf : out->largest_leaf;
    tree->node_slots = tree->node_slots > 2 * out->next_pair ? tree->node_slots : 2 * out->next_pair;
}

static void store_tree(const cgt_committed_scene *committed_scene, const cgt_bih_workspace *w,
                       const cgt_bih_output *top, cgt_bih *tree)
{
    *tree = (cgt_bih){.node = w->node, .reference = w->reference};
    memcpy(tree->low, committed_scene->low, sizeof tree->low);
    memcpy(tree->high, committed_scene->high, sizeof tree->high);
    add_output(tree, top);
    for (uint32_t i = 0; i < w->tasks; i++)
        add_output(tree, &w->task[i].out);
}

cgt_result cgt_bih_build(cgt_context *context, const cgt_bih_memory *memory, const cgt_committed_scene *committed_scene,
                         cgt_bih *tree)
{
    const uint32_t chunks =
        (uint32_t)(((uint64_t)committed_scene->prims.count + PRIMS_PER_CHUNK - 1) / PRIMS_PER_CHUNK);
    job j = {.prims = &committed_scene->prims, .all = committed_scene->valid == committed_scene->prims.count};
    const cgt_result result = reserve_memory(context, memory, committed_scene->valid, chunks, &j.workspace);
    if (result != CGT_OK)
        return result;
    cgt_bih_part root = {.count = committed_scene->valid};
    memcpy(root.box.low, committed_scene->low, sizeof root.box.low);
    memcpy(root.box.high, committed_scene->high, sizeof root.box.high);
    cgt_bih_output top = {.node = j.workspace.node,
                          .reference = j.workspace.reference,
                          .next_pair = 1,
                          .spare_pairs = j.workspace.top_pairs > 1 ? CGT_BIH_TOP_CLIPS : 0};
    collect(context, &j, chunks);
    cgt_bih_build_top(context, &j.workspace, &root, &top);
    cgt_run_tasks(context, build_subtree, &j, j.workspace.tasks);
    store_tree(committed_scene, &j.workspace, &top, tree);
    return CGT_OK;
}
