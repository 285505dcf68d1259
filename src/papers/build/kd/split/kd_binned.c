/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The binned builder, from a node down. The candidates are the edges of equal bins along each axis of the items'
 * bounds, and the planes just outside of those bounds, which cut empty space off.
 *
 * A subtree needs little memory besides its items: of two children the larger takes the place of its parent's items,
 * the smaller goes on a stack and is built first. */
#include "papers/build/kd/split/kd_binned.h"

#include "papers/build/kd/split/kd_clip.h"

/* ---- bins ---- */

/* Grows bounds by items; returns what testing all of them costs. */
float cgt_kd_bound_items(const cgt_kd_item *item, uint32_t count, cgt_float4 *low, cgt_float4 *high)
{
    float weight = 0;
    cgt_float4 l = *low, h = *high;
    for (uint32_t i = 0; i < count; i++) {
        const cgt_float4 a = cgt_load4(item[i].low), b = cgt_load4(item[i].high);
        l = cgt_select4(a < l, a, l);
        h = cgt_select4(b > h, b, h);
        weight += item[i].weight;
    }
    *low = l;
    *high = h;
    return weight;
}

/* A bin at most: the scale is rounded down by more than products and differences are rounded. Where the bounds are so
 * narrow that the scale leaves the range of float, all is in bin 0. */
void cgt_kd_plan_bins(cgt_kd_bins *b, const cgt_float4 low, const cgt_float4 high, uint32_t count)
{
    const cgt_int4 first_three = {-1, -1, -1, 0};
    b->count = count < 12 ? 8 : 16;
    b->low = low;
    b->high = high;
    const cgt_float4 extent = high - low;
    const cgt_float4 scale = (float)b->count * (1 - 0x1p-20f) / extent;
    b->base = cgt_select4(first_three, low, cgt_all4(0));
    b->scale = cgt_select4(first_three & (extent > 0x1p-100f), scale, cgt_all4(0));
    memset(b->start, 0, b->count * sizeof b->start[0]);
    memset(b->end, 0, b->count * sizeof b->end[0]);
}

void cgt_kd_fill_bins(cgt_kd_bins *b, const cgt_kd_item *item, uint32_t count)
{
    const cgt_float4 base = b->base, scale = b->scale;
    const cgt_int4 first_three = {-1, -1, -1, 0};
    for (uint32_t i = 0; i < count; i++) {
        const float w = item[i].weight;
        const cgt_float4 h = (cgt_float4)((cgt_int4)cgt_load4(item[i].high) & first_three);
        const cgt_int4 from = __builtin_convertvector((cgt_load4(item[i].low) - base) * scale, cgt_int4);
        const cgt_int4 to = __builtin_convertvector((h - base) * scale, cgt_int4);
        b->start[from[0]][0] += w;
        b->start[from[1]][1] += w;
        b->start[from[2]][2] += w;
        b->end[to[0]][0] += w;
        b->end[to[1]][1] += w;
        b->end[to[2]][2] += w;
    }
}

/* ---- the choice ---- */

static void try_empty_cuts(const cgt_kd_rules *rules, const cgt_kd_bins *b, const cgt_kd_box *box,
                           const cgt_kd_shares *s, float weight, cgt_kd_plane *best)
{
    const float inner = (float)rules->costs.inner, cost_factor = 1 - (float)rules->costs.empty_cut_off;
    const cgt_float4 box_low = {box->low[0], box->low[1], box->low[2], 0};
    const cgt_float4 box_high = {box->high[0], box->high[1], box->high[2], 0};
    const cgt_float4 kept_extent[2] = {box_high - b->low, b->high - box_low};
    for (int upper = 0; upper < 2; upper++) {
        const cgt_float4 cost = (inner + (s->side + s->around * kept_extent[upper]) * weight) * cost_factor;
        for (uint32_t axis = 0; axis < 3; axis++) {
            if (!(cost[axis] < best->cost))
                continue;
            const float split =
                cgt_kd_plane_at(upper ? cgt_kd_plane_above(b->high[axis]) : cgt_kd_plane_below(b->low[axis]));
            if (cgt_kd_is_inside(box, axis, split))
                *best = (cgt_kd_plane){axis, split, cost[axis], !upper, upper, !upper};
        }
    }
}

/* All three axes at once, bin after bin: what starts before the edge is below, what ends after it above. */
static void try_bin_edges(const cgt_kd_rules *rules, const cgt_kd_bins *b, const cgt_kd_box *box,
                          const cgt_kd_shares *s, float weight, cgt_kd_plane *best)
{
    const cgt_float4 box_low = {box->low[0], box->low[1], box->low[2], 0};
    const cgt_float4 box_high = {box->high[0], box->high[1], box->high[2], 0};
    const cgt_float4 width = (b->high - b->low) * (1 / (float)b->count);
    cgt_float4 lower = b->low - box_low, upper = box_high - b->low;
    cgt_float4 below = cgt_all4(0), above = cgt_all4(weight), least = cgt_all4(INFINITY), most = below, chosen = below;
    for (uint32_t i = 1; i < b->count; i++) {
        below += b->start[i - 1];
        above -= b->end[i - 1];
        lower += width;
        upper -= width;
        const cgt_float4 cost = s->side * (below + above) + s->around * (lower * below + upper * above);
        const cgt_int4 better = cost < least;
        least = cgt_select4(better, cost, least);
        chosen = cgt_select4(better, cgt_all4((float)i), chosen);
        most = cgt_select4(better, above - below, most);
    }
    for (uint32_t axis = 0; axis < 3; axis++) {
        const float cost = (float)rules->costs.inner + least[axis];
        if (!(cost < best->cost) || b->scale[axis] == 0)
            continue;
        const double share = (double)chosen[axis] / b->count;
        const float split =
            cgt_kd_round_split((float)((double)b->low[axis] * (1 - share) + (double)b->high[axis] * share));
        if (cgt_kd_is_inside(box, axis, split))
            *best = (cgt_kd_plane){axis, split, cost, false, false, most[axis] > 0};
    }
}

cgt_kd_plane cgt_kd_choose_binned(const cgt_kd_rules *rules, const cgt_kd_bins *b, const cgt_kd_box *box, float weight)
{
    const cgt_kd_shares s = cgt_kd_area_shares(box);
    cgt_kd_plane best = {.axis = 3, .cost = weight};
    try_empty_cuts(rules, b, box, &s, weight, &best);
    try_bin_edges(rules, b, box, &s, weight, &best);
    return best;
}

/* ---- subtrees ---- */

/* The state of a task. */
typedef struct task {
    const cgt_kd_rules *rules;
    cgt_kd_output *out;
    cgt_kd_item *stack;
    size_t room; /* left on the stack */
    cgt_kd_bins bins;
} task;

typedef struct node {
    uint32_t number, depth, count;
    cgt_kd_item *item;
    cgt_kd_box box;
} node;

/* Sorts items to sides: those of the larger one to where they were, the others to the stack. Each side keeps the
 * order. */
static void partition(task *t, const node *n, const cgt_kd_plane *plane, uint32_t counts[2])
{
    cgt_kd_item *to[2] = {t->stack, t->stack};
    to[plane->upper_larger] = n->item;
    cgt_kd_partition(t->rules, &n->box, plane, n->item, n->count, false, to, counts);
}

#define UNBINNED_ITEMS 6 /* items that are worth a look before they are binned */

static void build(task *t, node n);

/* Builds the smaller child, with its share of the room that is left. */
static void build_smaller(task *t, const node *child, uint32_t larger)
{
    const cgt_kd_ends ends = cgt_kd_share_room(t->out, child->count, larger);
    t->stack += child->count;
    t->room -= child->count;
    build(t, *child);
    t->stack -= child->count;
    t->room += child->count;
    cgt_kd_restore_room(t->out, ends);
}

/* Splits where items are on both sides; *n becomes the larger child. Returns false where both children have all of
 * them. */
static bool descend(task *t, node *n, const cgt_kd_plane *plane)
{
    const uint32_t larger = plane->upper_larger, smaller = !larger;
    uint32_t counts[2];
    partition(t, n, plane, counts);
    if (counts[0] == n->count && counts[1] == n->count)
        return false;
    const uint32_t lower = cgt_kd_add_inner(t->rules, t->out, n->number, &n->box, plane);
    const node child = {lower + smaller, n->depth + 1, counts[smaller], t->stack,
                        cgt_kd_child_box(&n->box, plane->axis, plane->split, smaller)};
    n->number = lower + larger;
    n->depth++;
    n->count = counts[larger];
    n->box = cgt_kd_child_box(&n->box, plane->axis, plane->split, larger);
    build_smaller(t, &child, n->count);
    return true;
}

/* Whether no plane can help, found without bins: any box that has an item is at least as large as the item's bounds.
 * The margin is for rounding. */
static bool must_be_leaf(const cgt_kd_rules *rules, const node *n, float weight)
{
    double areas = 0;
    for (uint32_t i = 0; i < n->count; i++) {
        const cgt_kd_item *a = &n->item[i];
        const double x = (double)a->high[0] - (double)a->low[0], y = (double)a->high[1] - (double)a->low[1],
                     z = (double)a->high[2] - (double)a->low[2];
        areas += (x * y + y * z + z * x) * a->weight;
    }
    const double area = cgt_kd_half_area(&n->box);
    return (1 - rules->costs.empty_cut_off) * (rules->costs.inner * area + areas) > weight * area * (1 + 1e-6);
}

static void build(task *t, node n)
{
    bool binned = false;
    float weight = 0;
    while (n.count) {
        if (!binned) {
            cgt_float4 low = cgt_all4(INFINITY), high = cgt_all4(-INFINITY);
            weight = cgt_kd_bound_items(n.item, n.count, &low, &high);
            if (!cgt_kd_may_split(t->rules, weight) ||
                (n.count <= UNBINNED_ITEMS && must_be_leaf(t->rules, &n, weight)))
                break;
            cgt_kd_plan_bins(&t->bins, low, high, n.count);
            cgt_kd_fill_bins(&t->bins, n.item, n.count);
        }
        const cgt_kd_plane plane = cgt_kd_choose_binned(t->rules, &t->bins, &n.box, weight);
        const cgt_kd_step step =
            cgt_kd_next_step(t->rules, t->out, &plane, n.count, t->room, &n.number, &n.depth, &n.box);
        if (step == CGT_KD_STOP || (step == CGT_KD_DIVIDE && !descend(t, &n, &plane)))
            break;
        binned = step == CGT_KD_CUT; /* the items are the same */
    }
    cgt_kd_add_leaf(t->rules, t->out, n.number, &n.box, n.item, n.count);
}

void cgt_kd_build_binned(const cgt_kd_rules *rules, cgt_kd_subtree *s)
{
    task t = {.rules = rules, .out = &s->out, .stack = s->stack, .room = s->room};
    build(&t, (node){s->number, s->depth, s->count, s->item, s->box});
}
