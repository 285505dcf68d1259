/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The top of a bounding interval hierarchy: nodes with many items, one after the other, each divided by all threads, in
 * place. Each chunk of a node is divided on its own, which tells how many items are below in all. Of the node's first
 * part, which is to hold these, some chunks have items that are above; as many in the second part are below. Both
 * kinds lie in runs, one for each chunk and kind at most; the k-th of one kind is exchanged with the k-th of the other.
 * Chunks and exchanges follow from counts, so the order of items does, too. */
#include <math.h>

#include "papers/build/bih/bih_build.h"

/* Items that lie on the wrong side: a run of one chunk. */
typedef struct wrong_run {
    uint32_t first, rank; /* the first one, and how many of its kind come before it */
} wrong_run;

struct cgt_bih_chunk {
    cgt_bih_bounds bounds;
    uint32_t first, count; /* of the node's items */
    cgt_bih_sides sides;
    wrong_run wrong[2]; /* above in the first part, below in the second one */
};

typedef struct top {
    const cgt_context *context;
    cgt_bih_workspace *workspace;
    cgt_bih_output *out;
    cgt_bih_item *item; /* of the current node */
    uint32_t chunks;
    cgt_bih_split split;
    uint32_t wrong; /* items on the wrong side, of each kind */
} top;

size_t cgt_bih_chunk_bytes(uint32_t items) { return ((size_t)items / CGT_BIH_CHUNK + 1) * sizeof(cgt_bih_chunk); }

/* ---- passes over chunks ---- */

static void plan_chunks(top *t, uint32_t count)
{
    t->chunks = 0;
    for (uint32_t first = 0; first < count; first += CGT_BIH_CHUNK) {
        cgt_bih_chunk *c = &t->workspace->chunk[t->chunks++];
        c->first = first;
        c->count = count - first < CGT_BIH_CHUNK ? count - first : CGT_BIH_CHUNK;
    }
}

static void bound_chunk(void *argument, uint32_t index)
{
    const top *t = argument;
    cgt_bih_chunk *c = &t->workspace->chunk[index];
    c->bounds = cgt_bih_bound(t->item + c->first, c->count);
}

static cgt_bih_bounds bound_node(top *t)
{
    cgt_run_tasks(t->context, bound_chunk, t, t->chunks);
    cgt_bih_bounds bounds = t->workspace->chunk[0].bounds;
    for (uint32_t i = 1; i < t->chunks; i++)
        bounds = cgt_bih_merge(&bounds, &t->workspace->chunk[i].bounds);
    return bounds;
}

static void divide_chunk(void *argument, uint32_t index)
{
    const top *t = argument;
    cgt_bih_chunk *c = &t->workspace->chunk[index];
    c->sides = cgt_bih_divide(t->item + c->first, c->count, &t->split);
}

/* ---- exchanging ---- */

static inline uint32_t min_of(uint32_t a, uint32_t b) { return a < b ? a : b; }
static inline uint32_t max_of(uint32_t a, uint32_t b) { return a > b ? a : b; }

/* Lists the runs of wrong items, where `below` are below in all. */
static void plan_exchange(top *t, uint32_t below)
{
    uint32_t rank[2] = {0, 0};
    for (uint32_t i = 0; i < t->chunks; i++) {
        cgt_bih_chunk *c = &t->workspace->chunk[i];
        const uint32_t border = c->first + c->sides.below, end = c->first + c->count;
        c->wrong[0] = (wrong_run){border, rank[0]};
        c->wrong[1] = (wrong_run){max_of(c->first, below), rank[1]};
        rank[0] += border < below ? min_of(end, below) - border : 0;
        rank[1] += border > c->wrong[1].first ? border - c->wrong[1].first : 0;
    }
    t->wrong = rank[0];
}

/* The chunk whose run has the item of this rank: the last one with ranks up to it. */
static uint32_t find_run(const top *t, uint32_t kind, uint32_t rank)
{
    uint32_t low = 0, high = t->chunks;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (t->workspace->chunk[middle].wrong[kind].rank <= rank)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The item of a rank; index: of the run that it is in, or of one before. */
static inline cgt_bih_item *wrong_item(const top *t, uint32_t kind, uint32_t rank, uint32_t *index)
{
    const cgt_bih_chunk *chunk = t->workspace->chunk;
    while (*index + 1 < t->chunks && chunk[*index + 1].wrong[kind].rank <= rank)
        ++*index;
    return &t->item[chunk[*index].wrong[kind].first + (rank - chunk[*index].wrong[kind].rank)];
}

static void exchange_chunk(void *argument, uint32_t index)
{
    const top *t = argument;
    const uint32_t first = index * CGT_BIH_CHUNK;
    const uint32_t end = t->wrong - first < CGT_BIH_CHUNK ? t->wrong : first + CGT_BIH_CHUNK;
    uint32_t run[2] = {find_run(t, 0, first), find_run(t, 1, first)};
    for (uint32_t rank = first; rank < end; rank++) {
        cgt_bih_item *above = wrong_item(t, 0, rank, &run[0]), *below = wrong_item(t, 1, rank, &run[1]);
        const cgt_bih_item q = *above;
        *above = *below;
        *below = q;
    }
}

/* Divides the current node. */
static cgt_bih_sides divide_node(top *t)
{
    cgt_bih_sides sides = {0, -INFINITY, INFINITY};
    cgt_run_tasks(t->context, divide_chunk, t, t->chunks);
    for (uint32_t i = 0; i < t->chunks; i++) {
        const cgt_bih_sides *s = &t->workspace->chunk[i].sides;
        sides.below += s->below;
        sides.end_of_lower = fmaxf(sides.end_of_lower, s->end_of_lower);
        sides.begin_of_upper = fminf(sides.begin_of_upper, s->begin_of_upper);
    }
    plan_exchange(t, sides.below);
    cgt_run_tasks(t->context, exchange_chunk, t, (t->wrong + CGT_BIH_CHUNK - 1) / CGT_BIH_CHUNK);
    return sides;
}

/* ---- nodes ---- */

/* Tasks come in the order of their items, and so do their slices of pairs. */
static void add_task(top *t, const cgt_bih_part *part)
{
    cgt_bih_workspace *w = t->workspace;
    const uint32_t first_pair = t->workspace->top_pairs + cgt_bih_task_pairs(part->first);
    w->task[w->tasks++] = (cgt_bih_task){.part = *part,
                                         .out = {.node = t->out->node,
                                                 .reference = t->out->reference,
                                                 .next_pair = first_pair,
                                                 .spare_pairs = cgt_bih_task_pairs(part->count) - (part->count - 1)}};
}

/* Divides a part; false where it became a task: for its size, or because it is no common one, which one thread divides
 * as well. */
static bool divide_part(top *t, cgt_bih_part *part, cgt_bih_part child[2])
{
    t->item = t->workspace->item + part->first;
    if (part->count > t->workspace->task_items) {
        plan_chunks(t, part->count);
        const cgt_bih_bounds bounds = bound_node(t);
        if (cgt_bih_sums_differ(&bounds))
            t->split = cgt_bih_choose(NULL, part->count, part->depth, &bounds);
        if (cgt_bih_sums_differ(&bounds) && !t->split.median) {
            cgt_bih_clip(t->out, part, &bounds);
            const cgt_bih_sides sides = divide_node(t);
            cgt_bih_add_split(t->out, part, t->split.axis, &sides, child);
            return true;
        }
    }
    add_task(t, part);
    return false;
}

void cgt_bih_build_top(const cgt_context *context, cgt_bih_workspace *workspace, const cgt_bih_part *root,
                       cgt_bih_output *out)
{
    top t = {.context = context, .workspace = workspace, .out = out};
    cgt_bih_part stack[CGT_BIH_MAX_DEPTH], part = *root, child[2];
    uint32_t entries = 0;
    workspace->tasks = 0;
    for (;;) {
        if (divide_part(&t, &part, child)) {
            stack[entries++] = child[1];
            part = child[0];
        } else if (entries) {
            part = stack[--entries];
        } else {
            return;
        }
    }
}
