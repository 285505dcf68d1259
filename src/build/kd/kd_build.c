/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The build of a kd-tree: memory, the items of the root, the top, the tasks below it. Memory is taken here alone,
 * before anything is built: about 230 bytes an object, 500 for the sweep. */
#include "build/kd/kd_build.h"

#include "core/float_environment.h"
#include "build/kd/split/kd_builder.h"

const cgt_kd_costs cgt_kd_default_costs = {.inner = 3, .test = {1, 0.5}, .empty_cut_off = 0.1};

#define OBJECTS_PER_CHUNK 8192u
#define MOST_OBJECTS (1u << 27) /* slices of nodes and references are numbered by 32 bits */

typedef struct job {
    const cgt_kd_rules *rules;
    cgt_kd_room room;
    uint32_t objects;
    bool all; /* objects are valid */
    bool sweep;
} job;

/* ---- memory ---- */

/* Takes bytes off a block; adds them up where there is none. */
static void *carve(char *block, size_t *used, size_t bytes)
{
    void *part = block ? block + *used : NULL;
    *used += (bytes + CGT_ALIGNMENT - 1) / CGT_ALIGNMENT * CGT_ALIGNMENT;
    return part;
}

/* With block NULL it finds out how many bytes are needed. */
static size_t carve_room(cgt_kd_room *r, char *block, bool sweep, uint32_t object_chunks)
{
    const size_t slots = r->slots;
    size_t used = 0;
    for (int k = 0; k < 2; k++)
        r->item[k] = carve(block, &used, slots * sizeof(cgt_kd_item));
    r->node = carve(block, &used, (CGT_KD_TOP_NODES + slots * CGT_KD_NODES_PER_SLOT) * sizeof(cgt_kd_node));
    r->reference = carve(block, &used, slots * CGT_KD_REFERENCES_PER_SLOT * sizeof(uint32_t));
    r->sweep = carve(block, &used, sweep ? slots * CGT_KD_SWEEP_BYTES : 0);
    r->task = carve(block, &used, CGT_KD_MOST_TASKS * sizeof(cgt_kd_subtree));
    r->axis_plane = carve(block, &used, 3 * CGT_KD_MOST_TASKS * sizeof(cgt_kd_plane));
    for (int k = 0; k < 2; k++)
        r->active[k] = carve(block, &used, cgt_kd_level_bytes());
    r->chunk = carve(block, &used, cgt_kd_chunk_bytes(r->slots));
    r->valid = carve(block, &used, object_chunks * sizeof(uint32_t));
    return used;
}

static cgt_result take_memory(cgt_context *context, cgt_buffer *work, const cgt_world *world, bool sweep,
                              uint32_t object_chunks, cgt_kd_room *room)
{
    const uint64_t per_slot = 2 * sizeof(cgt_kd_item) + CGT_KD_SWEEP_BYTES +
                              CGT_KD_NODES_PER_SLOT * sizeof(cgt_kd_node) + CGT_KD_REFERENCES_PER_SLOT * 4 + 64;
    if (world->valid > MOST_OBJECTS || 2 * (uint64_t)world->valid * per_slot > SIZE_MAX / 2)
        return cgt_fail(context, CGT_ERROR_TOO_LARGE, "commit: %u primitives are too many for a kd-tree", world->valid);
    room->slots = 2 * world->valid + 64;
    const size_t bytes = carve_room(room, NULL, sweep, object_chunks);
    const cgt_result result = cgt_buffer_reserve(&context->memory, work, bytes, 1);
    if (result != CGT_OK)
        return cgt_fail(context, result, "commit: out of memory for a kd-tree over %u primitives", world->valid);
    carve_room(room, work->data, sweep, object_chunks);
    return CGT_OK;
}

/* ---- tasks ---- */

static void count_objects(void *argument, uint32_t index)
{
    const job *j = argument;
    const uint32_t first = index * OBJECTS_PER_CHUNK, left = j->objects - first;
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    j->room.valid[index] =
        cgt_kd_count_valid(j->rules->objects, first, left < OBJECTS_PER_CHUNK ? j->objects : first + OBJECTS_PER_CHUNK);
    cgt_float_environment_leave(&callers);
}

static void collect_objects(void *argument, uint32_t index)
{
    const job *j = argument;
    const uint32_t first = index * OBJECTS_PER_CHUNK, left = j->objects - first;
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    cgt_kd_collect(j->rules, first, left < OBJECTS_PER_CHUNK ? j->objects : first + OBJECTS_PER_CHUNK, j->all,
                   j->room.item[0] + (j->all ? first : j->room.valid[index]));
    cgt_float_environment_leave(&callers);
}

static void collect(cgt_context *context, job *j, uint32_t chunks)
{
    if (!j->all) {
        uint32_t sum = 0;
        cgt_run_tasks(context, count_objects, j, chunks);
        for (uint32_t i = 0; i < chunks; i++) {
            const uint32_t count = j->room.valid[i];
            j->room.valid[i] = sum;
            sum += count;
        }
    }
    cgt_run_tasks(context, collect_objects, j, chunks);
}

static void build_subtree(void *argument, uint32_t index)
{
    const job *j = argument;
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    (j->sweep ? cgt_kd_build_sweep : cgt_kd_build_binned)(j->rules, &j->room.task[index]);
    cgt_float_environment_leave(&callers);
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

static void finish(const cgt_world *world, const cgt_kd_room *room, const cgt_kd_output *top, cgt_kd_raw *raw)
{
    *raw = (cgt_kd_raw){.node = room->node, .reference = room->reference, .nodes = top->next_node, .cost = top->cost};
    memcpy(raw->low, world->low, sizeof raw->low);
    memcpy(raw->high, world->high, sizeof raw->high);
    for (uint32_t i = 0; i < room->tasks; i++) {
        const cgt_kd_output *out = &room->task[i].out;
        raw->cost += out->cost;
        raw->limited += out->limited;
        raw->nodes = out->next_node > raw->nodes ? out->next_node : raw->nodes;
    }
}

cgt_result cgt_kd_build(cgt_context *context, cgt_buffer *work, const cgt_world *world, cgt_kd_builder builder,
                        const cgt_kd_costs *costs, cgt_kd_raw *raw)
{
    const uint32_t chunks = (uint32_t)(((uint64_t)world->objects.count + OBJECTS_PER_CHUNK - 1) / OBJECTS_PER_CHUNK);
    cgt_kd_rules rules = {.objects = &world->objects, .costs = *costs};
    job j = {.rules = &rules, .objects = world->objects.count, .sweep = builder == CGT_KD_BUILDER_SWEEP};
    cgt_kd_box box;
    const cgt_result result = take_memory(context, work, world, j.sweep, chunks, &j.room);
    if (result != CGT_OK)
        return result;
    j.all = world->valid == world->objects.count;
    memcpy(box.low, world->low, sizeof box.low);
    memcpy(box.high, world->high, sizeof box.high);
    rules.most_depth = (uint32_t)(8 + 1.3 * log2(world->valid));
    rules.root_area = cgt_kd_half_area(&box);
    cgt_kd_output top = {
        .node = j.room.node, .reference = j.room.reference, .next_node = 2, .end_node = CGT_KD_TOP_NODES};
    collect(context, &j, chunks);
    cgt_kd_build_top(context, &rules, &j.room, j.sweep, &box, world->valid, &top);
    order_tasks(j.room.task, j.room.tasks);
    cgt_run_tasks(context, build_subtree, &j, j.room.tasks);
    finish(world, &j.room, &top, raw);
    return CGT_OK;
}
