/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The build of a kd-tree: memory, the items of the root, the top, the tasks below it. All memory is reserved here,
 * before anything is built: about 230 bytes a primitive. */
#include "papers/build/kd/kd_build.h"

#include "papers/build/kd/split/kd_builder.h"
#include "papers/build/tree_items.h"

const cgt_kd_costs cgt_kd_default_costs = {.inner = 3, .test = {1, 0.5}, .empty_cut_off = 0.1};

#define MAX_PRIMS (1u << 27) /* slices of nodes and references are numbered by 32 bits */

typedef struct job {
    const cgt_kd_rules *rules;
    cgt_kd_workspace workspace;
} job;

/* ---- memory ---- */

/* With block NULL it finds out how many bytes are needed. */
static size_t carve_room(cgt_kd_workspace *r, char *block, uint32_t prim_chunks)
{
    const size_t slots = r->slots;
    size_t used_bytes = 0;
    for (int k = 0; k < 2; k++)
        r->item[k] = cgt_tree_carve(block, &used_bytes, slots * sizeof(cgt_kd_item));
    r->node =
        cgt_tree_carve(block, &used_bytes, (CGT_KD_TOP_NODES + slots * CGT_KD_NODES_PER_SLOT) * sizeof(cgt_kd_node));
    r->reference = cgt_tree_carve(block, &used_bytes, slots * CGT_KD_REFERENCES_PER_SLOT * sizeof(uint32_t));
    r->task = cgt_tree_carve(block, &used_bytes, CGT_KD_MAX_TASKS * sizeof(cgt_kd_subtree));
    for (int k = 0; k < 2; k++)
        r->active[k] = cgt_tree_carve(block, &used_bytes, cgt_kd_level_bytes());
    r->chunk = cgt_tree_carve(block, &used_bytes, cgt_kd_chunk_bytes(r->slots));
    r->valid = cgt_tree_carve(block, &used_bytes, prim_chunks * sizeof(uint32_t));
    return used_bytes;
}

static cgt_result reserve_memory(cgt_context *context, cgt_buffer *work, const cgt_committed_scene *committed_scene,
                                 uint32_t prim_chunks, cgt_kd_workspace *workspace)
{
    const uint64_t per_slot =
        2 * sizeof(cgt_kd_item) + CGT_KD_NODES_PER_SLOT * sizeof(cgt_kd_node) + CGT_KD_REFERENCES_PER_SLOT * 4 + 64;
    if (committed_scene->valid > MAX_PRIMS || 2 * (uint64_t)committed_scene->valid * per_slot > SIZE_MAX / 2)
        return cgt_fail(context, CGT_ERROR_TOO_LARGE, "commit: %u primitives are too many for a kd-tree",
                        committed_scene->valid);
    workspace->slots = 2 * committed_scene->valid + 64;
    const size_t bytes = carve_room(workspace, NULL, prim_chunks);
    const cgt_result result = cgt_buffer_reserve(&context->memory, work, bytes, 1);
    if (result != CGT_OK)
        return cgt_fail(context, result, "commit: out of memory for a kd-tree over %u primitives",
                        committed_scene->valid);
    carve_room(workspace, work->data, prim_chunks);
    return CGT_OK;
}

/* ---- tasks ---- */

static void build_subtree(void *argument, uint32_t index)
{
    const job *j = argument;
    cgt_kd_build_binned(j->rules, &j->workspace.task[index]);
}

/* The longest ones first, so that threads end at about the same time. */
static void order_tasks(cgt_kd_subtree *task, uint32_t tasks)
{
    for (uint32_t i = 1; i < tasks; i++) {
        const cgt_kd_subtree s = task[i];
        uint32_t k = i;
        for (; k > 0 && task[k - 1].count < s.count; k--)
            task[k] = task[k - 1];
        task[k] = s;
    }
}

static void store_raw(const cgt_committed_scene *committed_scene, const cgt_kd_workspace *workspace,
                      const cgt_kd_output *top, cgt_kd_raw *raw)
{
    *raw = (cgt_kd_raw){
        .node = workspace->node, .reference = workspace->reference, .nodes = top->next_node, .cost = top->cost};
    memcpy(raw->low, committed_scene->low, sizeof raw->low);
    memcpy(raw->high, committed_scene->high, sizeof raw->high);
    for (uint32_t i = 0; i < workspace->tasks; i++) {
        const cgt_kd_output *out = &workspace->task[i].out;
        raw->cost += out->cost;
        raw->limited_leaves += out->limited_leaves;
        raw->nodes = out->next_node > raw->nodes ? out->next_node : raw->nodes;
    }
}

cgt_result cgt_kd_build(cgt_context *context, cgt_buffer *work, const cgt_committed_scene *committed_scene,
                        const cgt_kd_costs *costs, cgt_kd_raw *raw)
{
    cgt_kd_rules rules = {.prims = &committed_scene->prims, .costs = *costs};
    job j = {.rules = &rules};
    cgt_kd_box box;
    cgt_result result = reserve_memory(context, work, committed_scene, cgt_tree_chunks(rules.prims), &j.workspace);
    if (result != CGT_OK)
        return result;
    memcpy(box.low, committed_scene->low, sizeof box.low);
    memcpy(box.high, committed_scene->high, sizeof box.high);
    rules.max_leaf_depth = (uint32_t)(8 + 1.3 * log2(committed_scene->valid));
    rules.root_area = cgt_kd_half_area(&box);
    cgt_kd_output top = {
        .node = j.workspace.node, .reference = j.workspace.reference, .next_node = 2, .end_node = CGT_KD_TOP_NODES};
    cgt_kd_items items = {&rules, j.workspace.item[0]};
    result = cgt_tree_collect(context, committed_scene, j.workspace.valid, cgt_kd_store_item, &items);
    if (result != CGT_OK)
        return result;
    cgt_kd_build_top(context, &rules, &j.workspace, &box, committed_scene->valid, &top);
    order_tasks(j.workspace.task, j.workspace.tasks);
    cgt_run_tasks(context, build_subtree, &j, j.workspace.tasks);
    store_raw(committed_scene, &j.workspace, &top, raw);
    return CGT_OK;
}
