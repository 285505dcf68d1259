/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The sweep builder, from a node down: the events of each axis are sorted once, and stay sorted on the way down. A
 * split leaves those of items on one side in their order; items on both sides are clipped, and their new events are
 * sorted and merged in. As in the binned builder the larger child takes the place of its parent, the smaller goes on a
 * stack. */

#include "papers/build/kd/split/kd_events.h"

cgt_kd_plane cgt_kd_sweep_once(const cgt_kd_rules *rules, const cgt_kd_box *box, uint32_t axis, const cgt_kd_item *item,
                               uint32_t count, void *memory)
{
    cgt_kd_event *event = memory;
    double weight = 0;
    for (uint32_t i = 0; i < count; i++) {
        cgt_kd_add_events(event + 2 * (size_t)i, &item[i], axis, i);
        weight += item[i].weight;
    }
    cgt_kd_plane best = {.axis = 3, .cost = (float)weight};
    if (cgt_kd_may_split(rules, (float)weight)) {
        cgt_kd_sort_events(event, 2 * (size_t)count, event + 2 * (size_t)count);
        cgt_kd_sweep_events(rules, box, axis, item, count, event, weight, &best);
    }
    return best;
}

/* ---- subtrees ---- */

#define NOT_IN_CHILD UINT32_MAX
#define SPLIT_FLAG 0x80000000u /* the item has new bounds there */

/* The state of a task. */
typedef struct task {
    const cgt_kd_rules *rules;
    cgt_kd_output *out;
    cgt_kd_item *stack;
    cgt_kd_event *event_stack[3];
    size_t room;                   /* left on the stacks, in items */
    uint32_t *item_map[2];         /* of a node's items: where they are in each child; NOT_IN_CHILD: not there */
    cgt_kd_event *added, *scratch; /* for the events of divided items */
} task;

typedef struct node {
    uint32_t number, depth, count;
    cgt_kd_item *item;
    cgt_kd_event *event[3]; /* along each axis */
    cgt_kd_box box;
} node;

static cgt_kd_plane choose_plane(const task *t, const node *n)
{
    double weight = 0;
    for (uint32_t i = 0; i < n->count; i++)
        weight += n->item[i].weight;
    cgt_kd_plane best = {.axis = 3, .cost = (float)weight};
    if (!cgt_kd_may_split(t->rules, (float)weight))
        return best;
    for (uint32_t axis = 0; axis < 3; axis++)
        cgt_kd_sweep_events(t->rules, &n->box, axis, n->item, n->count, n->event[axis], weight, &best);
    return best;
}

/* Items to children; to[larger] is where they are. */
static void distribute_items(const task *t, const node *n, const cgt_kd_plane *plane, node child[2])
{
    const uint32_t axis = plane->axis;
    child[0].count = child[1].count = 0;
    for (uint32_t i = 0; i < n->count; i++) {
        const cgt_kd_item item = n->item[i];
        const bool on_side[2] = {item.low[axis] <= plane->split, item.high[axis] >= plane->split};
        cgt_kd_item half[2] = {item, item};
        unsigned sides = (unsigned)on_side[0] | (unsigned)on_side[1] << 1;
        const uint32_t split_flag = sides == 3 ? SPLIT_FLAG : 0;
        if (split_flag)
            sides = cgt_kd_split_item(t->rules, &item, &n->box, axis, plane->split, true, half);
        for (unsigned s = 0; s < 2; s++) {
            t->item_map[s][i] = sides >> s & 1 ? child[s].count | split_flag : NOT_IN_CHILD;
            if (sides >> s & 1)
                child[s].item[child[s].count++] = half[s];
        }
    }
}

/* The events of a child along an axis; they may take the place of the node's. */
static void distribute_events(const task *t, const node *n, unsigned side, uint32_t axis, const node *child)
{
    const uint32_t *item_map = t->item_map[side];
    cgt_kd_event *to = child->event[axis];
    size_t unsplit = 0, added = 0;
    for (size_t i = 0; i < 2 * (size_t)n->count; i++) {
        const cgt_kd_event e = n->event[axis][i];
        const uint32_t item = item_map[cgt_kd_event_item(e)];
        if (!(item & SPLIT_FLAG))
            to[unsplit++] = (e & ~(cgt_kd_event)UINT32_MAX) | item;
    }
    for (uint32_t i = 0; i < n->count; i++) {
        if (item_map[i] == NOT_IN_CHILD || !(item_map[i] & SPLIT_FLAG))
            continue;
        const uint32_t item = item_map[i] & ~SPLIT_FLAG;
        cgt_kd_add_events(t->added + added, &child->item[item], axis, item);
        added += 2;
    }
    cgt_kd_sort_events(t->added, added, t->scratch);
    cgt_kd_merge_events(to, unsplit, t->added, added);
}

static void build(task *t, node n);

/* Builds the smaller child, with its share of the room that is left. */
static void build_smaller(task *t, const node *child, uint32_t larger)
{
    const cgt_kd_ends ends = cgt_kd_share_room(t->out, child->count, larger);
    t->stack += child->count;
    t->room -= child->count;
    for (int a = 0; a < 3; a++)
        t->event_stack[a] += 2 * (size_t)child->count;
    build(t, *child);
    for (int a = 0; a < 3; a++)
        t->event_stack[a] -= 2 * (size_t)child->count;
    t->stack -= child->count;
    t->room += child->count;
    cgt_kd_restore_room(t->out, ends);
}

/* Splits where items are on both sides; *n becomes the larger child. Returns false where both children have all of
 * them. */
static bool descend(task *t, node *n, const cgt_kd_plane *plane)
{
    const uint32_t larger = plane->upper_larger, smaller = !larger;
    node child[2];
    for (uint32_t s = 0; s < 2; s++) {
        child[s] = *n;
        child[s].box = cgt_kd_child_box(&n->box, plane->axis, plane->split, s);
        child[s].depth++;
    }
    child[smaller].item = t->stack;
    memcpy(child[smaller].event, t->event_stack, sizeof child[smaller].event);
    distribute_items(t, n, plane, child);
    if (child[0].count == n->count && child[1].count == n->count)
        return false;
    for (uint32_t axis = 0; axis < 3; axis++) {
        distribute_events(t, n, smaller, axis, &child[smaller]);
        distribute_events(t, n, larger, axis, &child[larger]);
    }
    const uint32_t lower = cgt_kd_add_inner(t->rules, t->out, n->number, &n->box, plane);
    child[0].number = lower;
    child[1].number = lower + 1;
    *n = child[larger];
    build_smaller(t, &child[smaller], n->count);
    return true;
}

static void build(task *t, node n)
{
    while (n.count) {
        const cgt_kd_plane plane = choose_plane(t, &n);
        const cgt_kd_step step =
            cgt_kd_next_step(t->rules, t->out, &plane, n.count, t->room, &n.number, &n.depth, &n.box);
        if (step == CGT_KD_STOP || (step == CGT_KD_DIVIDE && !descend(t, &n, &plane)))
            break;
    }
    cgt_kd_add_leaf(t->rules, t->out, n.number, &n.box, n.item, n.count);
}

void cgt_kd_build_sweep(const cgt_kd_rules *rules, cgt_kd_subtree *s)
{
    task t = {.rules = rules, .out = &s->out, .stack = s->stack, .room = s->room};
    node n = {.number = s->number, .depth = s->depth, .count = s->count, .item = s->item, .box = s->box};
    cgt_kd_event *event = (cgt_kd_event *)(void *)s->sweep;
    for (int a = 0; a < 3; a++) {
        n.event[a] = event + 2 * (size_t)a * s->room;
        t.event_stack[a] = event + 2 * ((size_t)a + 3) * s->room;
    }
    t.added = event + 12 * s->room;
    t.scratch = event + 14 * s->room;
    t.item_map[0] = (uint32_t *)(void *)(event + 16 * s->room);
    t.item_map[1] = t.item_map[0] + s->room;
    for (uint32_t axis = 0; axis < 3; axis++) {
        for (uint32_t i = 0; i < n.count; i++)
            cgt_kd_add_events(n.event[axis] + 2 * (size_t)i, &n.item[i], axis, i);
        cgt_kd_sort_events(n.event[axis], 2 * (size_t)n.count, t.added);
    }
    build(&t, n);
}
