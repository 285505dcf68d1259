/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The top of the tree, level by level: nodes with many items are worked on by all threads, chunk by chunk. Chunks,
 * levels and tasks depend on counts alone, and the results of chunks are merged in order. */
#include "papers/build/kd/split/kd_binned.h"

struct cgt_kd_top_node {
    uint32_t number, depth, count;
    uint32_t base, room;  /* slots */
    uint32_t item_buffer; /* of the two that the slots have */
    cgt_kd_box box;
    uint32_t first_chunk, chunks;
    cgt_kd_plane plane;
    uint32_t side[2]; /* items of each */
    uint32_t side_base[2], side_room[2];
};

struct cgt_kd_chunk {
    uint32_t node, first, count;
    uint32_t side[2], to[2];
    float weight;
    cgt_float4 low, high;
    cgt_kd_bins bins;
};

typedef struct top {
    const cgt_context *context;
    const cgt_kd_rules *rules;
    cgt_kd_workspace *room;
    cgt_kd_output *out;
    cgt_kd_top_node *node; /* of this level */
    uint32_t nodes, chunks;
    uint32_t task_size; /* a node of as many items is a task */
} top;

size_t cgt_kd_chunk_bytes(uint32_t slots)
{
    return ((size_t)slots / CGT_KD_CHUNK + CGT_KD_MAX_TASKS) * sizeof(cgt_kd_chunk);
}

size_t cgt_kd_level_bytes(void) { return CGT_KD_MAX_TASKS * sizeof(cgt_kd_top_node); }

static cgt_kd_item *items_of(const top *t, const cgt_kd_top_node *n) { return t->room->item[n->item_buffer] + n->base; }

/* ---- passes over chunks ---- */

static void bound_chunk(void *argument, uint32_t index)
{
    const top *t = argument;
    cgt_kd_chunk *c = &t->room->chunk[index];
    c->low = cgt_all4(INFINITY);
    c->high = cgt_all4(-INFINITY);
    c->weight = cgt_kd_bound_items(items_of(t, &t->node[c->node]) + c->first, c->count, &c->low, &c->high);
}

static void bin_chunk(void *argument, uint32_t index)
{
    const top *t = argument;
    cgt_kd_chunk *c = &t->room->chunk[index];
    cgt_kd_fill_bins(&c->bins, items_of(t, &t->node[c->node]) + c->first, c->count);
}

static void count_chunk(void *argument, uint32_t index)
{
    const top *t = argument;
    cgt_kd_chunk *c = &t->room->chunk[index];
    const cgt_kd_top_node *n = &t->node[c->node];
    const cgt_kd_item *item = items_of(t, n) + c->first;
    const float split = n->plane.split;
    c->side[0] = c->side[1] = 0;
    for (uint32_t i = 0; i < c->count; i++) {
        c->side[0] += item[i].low[n->plane.axis] <= split;
        c->side[1] += item[i].high[n->plane.axis] >= split;
    }
}

static void divide_chunk(void *argument, uint32_t index)
{
    const top *t = argument;
    const cgt_kd_chunk *c = &t->room->chunk[index];
    const cgt_kd_top_node *n = &t->node[c->node];
    cgt_kd_item *to[2];
    uint32_t counts[2];
    for (int s = 0; s < 2; s++)
        to[s] = t->room->item[!n->item_buffer] + n->side_base[s] + c->to[s];
    cgt_kd_partition(t->rules, &n->box, &n->plane, items_of(t, n) + c->first, c->count, true, to, counts);
}

static void plan_chunks(top *t)
{
    t->chunks = 0;
    for (uint32_t i = 0; i < t->nodes; i++) {
        cgt_kd_top_node *n = &t->node[i];
        n->first_chunk = t->chunks;
        for (uint32_t first = 0; first < n->count; first += CGT_KD_CHUNK) {
            cgt_kd_chunk *c = &t->room->chunk[t->chunks++];
            c->node = i;
            c->first = first;
            c->count = n->count - first < CGT_KD_CHUNK ? n->count - first : CGT_KD_CHUNK;
        }
        n->chunks = t->chunks - n->first_chunk;
    }
}

/* ---- the choice ---- */

/* Merges the bounds of each node's chunks into the first chunk. */
static void merge_bounds(top *t)
{
    for (uint32_t i = 0; i < t->nodes; i++) {
        cgt_kd_chunk *c = &t->room->chunk[t->node[i].first_chunk];
        for (uint32_t k = 1; k < t->node[i].chunks; k++) {
            c->low = cgt_select4(c[k].low < c->low, c[k].low, c->low);
            c->high = cgt_select4(c[k].high > c->high, c[k].high, c->high);
            c->weight += c[k].weight;
        }
        for (uint32_t k = 0; k < t->node[i].chunks; k++)
            cgt_kd_plan_bins(&c[k].bins, c->low, c->high, t->node[i].count);
    }
}

static void merge_bins(const cgt_kd_top_node *n, cgt_kd_chunk *c)
{
    for (uint32_t k = 1; k < n->chunks; k++)
        for (uint32_t i = 0; i < CGT_KD_BINS; i++) {
            c->bins.start[i] += c[k].bins.start[i];
            c->bins.end[i] += c[k].bins.end[i];
        }
}

static bool is_cut(const cgt_kd_plane *p) { return p->axis < 3 && (p->lower_empty || p->upper_empty); }

static bool may_descend(const top *t, const cgt_kd_top_node *n)
{
    return n->depth < t->rules->max_leaf_depth && t->out->end_node - t->out->next_node >= 2;
}

static void cut_off(top *t, cgt_kd_top_node *n)
{
    n->number = cgt_kd_cut_off(t->rules, t->out, n->number, &n->box, &n->plane);
    n->depth++;
}

static void choose_planes(top *t)
{
    cgt_run_tasks(t->context, bound_chunk, t, t->chunks);
    merge_bounds(t);
    cgt_run_tasks(t->context, bin_chunk, t, t->chunks);
    for (uint32_t i = 0; i < t->nodes; i++) {
        cgt_kd_top_node *n = &t->node[i];
        cgt_kd_chunk *c = &t->room->chunk[n->first_chunk];
        merge_bins(n, c);
        n->plane = cgt_kd_choose_binned(t->rules, &c->bins, &n->box, c->weight);
        while (is_cut(&n->plane) && may_descend(t, n)) {
            cut_off(t, n);
            n->plane = cgt_kd_choose_binned(t->rules, &c->bins, &n->box, c->weight);
        }
    }
}

/* ---- levels ---- */

static void add_task(top *t, const cgt_kd_top_node *n)
{
    const cgt_kd_workspace *r = t->room;
    const uint32_t node = CGT_KD_TOP_NODES + n->base * CGT_KD_NODES_PER_SLOT;
    const uint32_t reference = n->base * CGT_KD_REFERENCES_PER_SLOT;
    t->room->task[t->room->tasks++] = (cgt_kd_subtree){
        .number = n->number,
        .depth = n->depth,
        .count = n->count,
        .box = n->box,
        .item = r->item[n->item_buffer] + n->base,
        .stack = r->item[!n->item_buffer] + n->base,
        .room = n->room,
        .out = {.node = r->node,
                .reference = r->reference,
                .next_node = node,
                .end_node = node + n->room * CGT_KD_NODES_PER_SLOT,
                .next_reference = reference,
                .end_reference = reference + n->room * CGT_KD_REFERENCES_PER_SLOT},
    };
}

/* Adds up the items on each side, and gives each side its share of the slots. Returns false where there is no room,
 * where both sides would have all items, or none has any. */
static bool plan_sides(const top *t, cgt_kd_top_node *n)
{
    cgt_kd_chunk *c = &t->room->chunk[n->first_chunk];
    uint64_t sum[2] = {0, 0};
    for (uint32_t k = 0; k < n->chunks; k++)
        for (int s = 0; s < 2; s++) {
            c[k].to[s] = (uint32_t)sum[s];
            sum[s] += c[k].side[s];
        }
    const uint64_t side_sum = sum[0] + sum[1];
    if (!side_sum || side_sum > n->room || (sum[0] == n->count && sum[1] == n->count))
        return false;
    for (int s = 0; s < 2; s++)
        n->side[s] = (uint32_t)sum[s];
    n->side_room[0] = n->side[0] + (uint32_t)((n->room - side_sum) * sum[0] / side_sum);
    n->side_base[0] = n->base;
    n->side_base[1] = n->base + n->side_room[0];
    n->side_room[1] = n->room - n->side_room[0];
    return true;
}

/* Keeps the nodes that are divided; the others become tasks, or, if cut, move to `next`. */
static uint32_t compact_split_nodes(top *t, cgt_kd_top_node *next)
{
    uint32_t split_nodes = 0, cut = 0;
    for (uint32_t i = 0; i < t->nodes; i++) {
        cgt_kd_top_node *n = &t->node[i];
        /* what is left of this level, twice, is the most that it can become */
        const uint64_t nodes = t->room->tasks + cut + 2 * (uint64_t)split_nodes + 2 * (uint64_t)(t->nodes - i);
        if (n->plane.axis == 3 || !may_descend(t, n) || nodes > CGT_KD_MAX_TASKS) {
            add_task(t, n);
        } else if (is_cut(&n->plane)) {
            cut_off(t, n);
            next[cut++] = *n;
        } else {
            t->node[split_nodes++] = *n;
        }
    }
    t->nodes = split_nodes;
    return cut;
}

static void add_child(top *t, const cgt_kd_top_node *n, uint32_t lower, uint32_t side, cgt_kd_top_node *next,
                      uint32_t *next_count)
{
    const cgt_kd_top_node child = {
        .number = lower + side,
        .depth = n->depth + 1,
        .count = n->side[side],
        .base = n->side_base[side],
        .room = n->side_room[side],
        .item_buffer = !n->item_buffer,
        .box = cgt_kd_child_box(&n->box, n->plane.axis, n->plane.split, side),
    };
    if (child.count > t->task_size)
        next[(*next_count)++] = child;
    else
        add_task(t, &child);
}

/* Creates the nodes of the next level from those of this one. */
static uint32_t descend(top *t, cgt_kd_top_node *next)
{
    uint32_t next_count = compact_split_nodes(t, next), divided = 0;
    plan_chunks(t);
    cgt_run_tasks(t->context, count_chunk, t, t->chunks);
    for (uint32_t i = 0; i < t->nodes; i++) {
        if (may_descend(t, &t->node[i]) && plan_sides(t, &t->node[i])) {
            const uint32_t lower =
                cgt_kd_add_inner(t->rules, t->out, t->node[i].number, &t->node[i].box, &t->node[i].plane);
            for (uint32_t side = 0; side < 2; side++)
                add_child(t, &t->node[i], lower, side, next, &next_count);
            divided++;
        } else {
            add_task(t, &t->node[i]);
            for (uint32_t k = 0; k < t->node[i].chunks; k++)
                t->room->chunk[t->node[i].first_chunk + k].count = 0;
        }
    }
    if (divided)
        cgt_run_tasks(t->context, divide_chunk, t, t->chunks);
    return next_count;
}

void cgt_kd_build_top(const cgt_context *context, const cgt_kd_rules *rules, cgt_kd_workspace *room,
                      const cgt_kd_box *box, uint32_t count, cgt_kd_output *out)
{
    top t = {.context = context, .rules = rules, .room = room, .out = out};
    cgt_kd_top_node *next = room->active[1];
    t.task_size = count / CGT_KD_TASKS_OF_ALL < CGT_KD_MIN_TASK ? CGT_KD_MIN_TASK : count / CGT_KD_TASKS_OF_ALL;
    t.node = room->active[0];
    t.node[0] = (cgt_kd_top_node){.count = count, .room = room->slots, .box = *box};
    t.nodes = 1;
    if (count <= t.task_size) {
        add_task(&t, &t.node[0]);
        return;
    }
    while (t.nodes) {
        plan_chunks(&t);
        choose_planes(&t);
        const uint32_t next_count = descend(&t, next);
        cgt_kd_top_node *level = t.node;
        t.node = next;
        t.nodes = next_count;
        next = level;
    }
}
