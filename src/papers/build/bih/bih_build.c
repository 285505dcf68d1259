/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The build of a bounding interval hierarchy: memory, items, the top, the tasks below it. All memory is reserved before
 * anything is built. */
#include "papers/build/bih/bih_build.h"
#include "papers/build/tree_items.h"

/* ---- memory ---- */

/* With block NULL it finds out how many bytes are needed. */
static size_t carve_room(cgt_bih_workspace *w, char *block, uint32_t items, uint32_t tasks, uint32_t prim_chunks)
{
    size_t used_bytes = 0;
    w->item = cgt_tree_carve(block, &used_bytes, items * sizeof(cgt_bih_item));
    w->chunk = cgt_tree_carve(block, &used_bytes, cgt_bih_chunk_bytes(items));
    w->task = cgt_tree_carve(block, &used_bytes, tasks * sizeof(cgt_bih_task));
    w->valid = cgt_tree_carve(block, &used_bytes, prim_chunks * sizeof(uint32_t));
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

/* ---- the tree ---- */

static void build_subtree(void *argument, uint32_t index)
{
    const cgt_bih_workspace *w = argument;
    cgt_bih_build_subtree(w->item, &w->task[index]);
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
    const cgt_primitives *prims = &committed_scene->prims;
    cgt_bih_workspace w = {0};
    cgt_result result = reserve_memory(context, memory, committed_scene->valid, cgt_tree_chunks(prims), &w);
    if (result != CGT_OK)
        return result;
    cgt_bih_part root = {.count = committed_scene->valid};
    memcpy(root.box.low, committed_scene->low, sizeof root.box.low);
    memcpy(root.box.high, committed_scene->high, sizeof root.box.high);
    cgt_bih_output top = {.node = w.node,
                          .reference = w.reference,
                          .next_pair = 1,
                          .spare_pairs = w.top_pairs > 1 ? CGT_BIH_TOP_CLIPS : 0};
    result = cgt_tree_collect(context, committed_scene, w.valid, cgt_bih_store_item, w.item);
    if (result != CGT_OK)
        return result;
    cgt_bih_build_top(context, &w, &root, &top);
    cgt_run_tasks(context, build_subtree, &w, w.tasks);
    store_tree(committed_scene, &w, &top, tree);
    return CGT_OK;
}
