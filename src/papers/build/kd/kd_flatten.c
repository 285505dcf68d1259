/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From a builder's tree to its final arrays, without gaps, in the requested layout.
 *
 * All layouts are one: levels are stored one after the other down to the break level, and what is below comes after
 * them, depth first. Breadth first breaks below all levels, depth first below the root. Each level, and what is below
 * the break, is a `run` of nodes; a walk that visits each node before its lower subtree, and that before its upper
 * one, meets the nodes of every run in their order. So the walk needs no queue, only the next free place of each run.
 *
 * It is done twice: the first walk counts, from which follows where each run begins; the second one writes. Subtrees
 * below a cut, whose level depends on tree and layout alone, are walked by tasks: between the walks each gets its
 * places. So the bytes do not depend on the threads. */
#include <string.h>

#include "papers/build/kd/kd_build.h"

#define SERIAL_NODES 8192u /* with fewer, tasks cost more than they save */
#define CUT_LEVEL 8u
#define MAX_PARTS (1u << CUT_LEVEL)
#define MAX_CURSORS 2048u /* of all parts: the cut is higher where there are many runs */

/* How much a run holds; then, the places of its next pair, leaf and reference. */
typedef struct run_cursor {
    uint64_t reference;
    uint32_t node, leaf;
} run_cursor;

/* A node on its way. */
typedef struct step {
    uint32_t raw, final, depth;
} step;

/* Other results of a walk. */
typedef struct walk_result {
    uint32_t depth, empty_leaves;
    bool too_deep;
} walk_result;

typedef struct part {
    step root;
    walk_result walk_result;
} part;

typedef struct flattening {
    const cgt_kd_raw *raw;
    bool ropes;
    cgt_kd_node *node;
    uint32_t *reference;
    cgt_kd_leaf *leaf; /* with ropes */
    uint32_t runs, cut;
    run_cursor top[CGT_KD_MAX_DEPTH]; /* of nodes above the cut */
    walk_result walk_result;          /* of those */
    uint32_t parts;
    part part[MAX_PARTS];
    run_cursor run_cursor[MAX_CURSORS]; /* of part i, from i * runs on */
} flattening;

/* ---- a walk ---- */

/* References that the tree keeps of a leaf: without ropes a single primitive is in the node itself. */
static inline uint32_t stored_references(const flattening *f, uint32_t count)
{
    return count > 1 || f->ropes ? count : 0;
}

static inline void count_leaf(const flattening *f, cgt_kd_node leaf, run_cursor *cursor, walk_result *result)
{
    const uint32_t count = cgt_kd_count(leaf);
    result->empty_leaves += count == 0;
    cursor->leaf++;
    cursor->reference += stored_references(f, count);
}

static inline void write_leaf(flattening *f, cgt_kd_node leaf, uint32_t final, run_cursor *cursor)
{
    const uint32_t count = cgt_kd_count(leaf), stored = stored_references(f, count);
    const uint32_t first = (uint32_t)cursor->reference, *from = f->raw->reference + leaf.word[1];
    if (stored)
        memcpy(f->reference + first, from, stored * sizeof *from);
    if (f->ropes) {
        f->leaf[cursor->leaf].first = first;
        f->leaf[cursor->leaf].count = count;
    }
    f->node[final] = cgt_kd_leaf_node(count, f->ropes ? cursor->leaf : count > 1 ? first : count == 1 ? from[0] : 0);
    cursor->leaf++;
    cursor->reference += stored;
}

/* A part begins: the first walk lists it; the second leaves it the places that the first one counted. */
static inline void start_part(flattening *f, const step *s, uint32_t *parts, bool write)
{
    const uint32_t i = (*parts)++;
    run_cursor *part_cursor = f->run_cursor + (size_t)i * f->runs;
    f->part[i].root = *s;
    for (uint32_t run = 0; write && run < f->runs; run++) {
        const run_cursor count = part_cursor[run];
        part_cursor[run] = f->top[run];
        f->top[run].node += count.node;
        f->top[run].leaf += count.leaf;
        f->top[run].reference += count.reference;
    }
}

/* From an inner node through its subtree, down to `stop`, where parts begin. at: by run. */
static inline void walk(flattening *f, step root, uint32_t stop, run_cursor *cursor, walk_result *result, bool write)
{
    step stack[CGT_KD_MAX_DEPTH + 1];
    uint32_t stack_size = 0, parts = 0;
    for (stack[stack_size++] = root; stack_size;) {
        const step s = stack[--stack_size];
        if (s.depth == stop) {
            start_part(f, &s, &parts, write);
            continue;
        }
        if (s.depth >= CGT_KD_MAX_DEPTH) {
            result->too_deep = true;
            continue;
        }
        run_cursor *next = &cursor[s.depth < f->runs ? s.depth : f->runs - 1];
        const cgt_kd_node n = f->raw->node[s.raw], *child = f->raw->node + n.word[1];
        const uint32_t pair = next->node;
        next->node += 2;
        result->depth = result->depth > s.depth ? result->depth : s.depth + 1;
        if (write)
            f->node[s.final] = (cgt_kd_node){{n.word[0], pair}};
        for (uint32_t side = 0; side < 2; side++) {
            if (!cgt_kd_is_leaf(child[side]))
                continue;
            if (write)
                write_leaf(f, child[side], pair + side, next);
            else
                count_leaf(f, child[side], next, result);
        }
        for (uint32_t side = 2; side-- > 0;) { /* the lower one is taken first */
            if (!cgt_kd_is_leaf(child[side]))
                stack[stack_size++] = (step){n.word[1] + side, pair + side, s.depth + 1};
        }
    }
    if (stop != CGT_INVALID_ID)
        f->parts = parts;
}

static inline void walk_top(flattening *f, bool write)
{
    const cgt_kd_node root = f->raw->node[0];
    if (!cgt_kd_is_leaf(root))
        walk(f, (step){0}, f->cut, f->top, &f->walk_result, write);
    else if (write)
        write_leaf(f, root, 0, &f->top[0]);
    else
        count_leaf(f, root, &f->top[0], &f->walk_result);
}

/* Counts in variables of its own, so that threads do not write to the same cache lines. */
static inline void walk_part(flattening *f, uint32_t i, bool write)
{
    run_cursor cursor[CGT_KD_MAX_DEPTH] = {{0}}, *saved_cursor = f->run_cursor + (size_t)i * f->runs;
    walk_result result = {0};
    for (uint32_t run = 0; write && run < f->runs; run++)
        cursor[run] = saved_cursor[run];
    walk(f, f->part[i].root, CGT_INVALID_ID, cursor, &result, write);
    if (write)
        return;
    for (uint32_t run = 0; run < f->runs; run++)
        saved_cursor[run] = cursor[run];
    f->part[i].walk_result = result;
}

static void count_part(void *argument, uint32_t i) { walk_part(argument, i, false); }

static void write_part(void *argument, uint32_t i) { walk_part(argument, i, true); }

/* ---- between the walks ---- */

/* Fills in what the tree holds. */
static void sum_results(const flattening *f, cgt_kd_tree *tree)
{
    walk_result total = f->walk_result;
    for (uint32_t i = 0; i < f->parts; i++) {
        const walk_result *result = &f->part[i].walk_result;
        total.depth = total.depth > result->depth ? total.depth : result->depth;
        total.empty_leaves += result->empty_leaves;
    }
    tree->depth = total.depth;
    tree->empty_leaves = total.empty_leaves;
    for (int a = 0; a < 3; a++) {
        tree->low[a] = f->raw->low[a];
        tree->high[a] = f->raw->high[a];
    }
}

static bool too_deep(const flattening *f)
{
    bool any = f->walk_result.too_deep;
    for (uint32_t i = 0; i < f->parts; i++)
        any |= f->part[i].walk_result.too_deep;
    return any;
}

/* Replaces how much each run of top and parts holds by where it begins. Returns the totals. */
static run_cursor assign_runs(flattening *f)
{
    run_cursor next = {.node = 2};
    for (uint32_t run = 0; run < f->runs; run++) {
        run_cursor count = f->top[run];
        for (uint32_t i = 0; i < f->parts; i++) {
            const run_cursor *p = &f->run_cursor[(size_t)i * f->runs + run];
            count.node += p->node;
            count.leaf += p->leaf;
            count.reference += p->reference;
        }
        f->top[run] = next;
        next.node += count.node;
        next.leaf += count.leaf;
        next.reference += count.reference;
    }
    return next;
}

static cgt_result too_large(cgt_context *context, uint32_t nodes, uint64_t references)
{
    return cgt_fail(context, CGT_ERROR_TOO_LARGE,
                    "kd-tree: %u nodes and %llu references are too many, or more than %u levels", nodes,
                    (unsigned long long)references, CGT_KD_MAX_DEPTH);
}

static cgt_result reserve(cgt_context *context, const cgt_kd_memory *memory, flattening *f, run_cursor total)
{
    const cgt_memory_hooks *hooks = &context->memory;
    if (too_deep(f) || total.reference > UINT32_MAX)
        return too_large(context, total.node, total.reference);
    cgt_result result = cgt_buffer_reserve_scattered(hooks, memory->nodes, total.node, sizeof *f->node);
    if (result == CGT_OK)
        result = cgt_buffer_reserve_scattered(hooks, memory->references, (size_t)total.reference, sizeof *f->reference);
    if (result == CGT_OK && f->ropes)
        result = cgt_buffer_reserve_scattered(hooks, memory->leaves, total.leaf, sizeof *f->leaf);
    if (result != CGT_OK)
        return cgt_fail(context, result, "kd-tree: out of memory for %u nodes, %llu references, %u leaves", total.node,
                        (unsigned long long)total.reference, total.leaf);
    f->node = memory->nodes->data;
    f->reference = memory->references->data;
    f->leaf = f->ropes ? memory->leaves->data : NULL;
    return CGT_OK;
}

/* ---- the call ---- */

/* Runs of the layout: levels that are stored one after the other, from that of the root's children on. */
static uint32_t count_runs(cgt_kd_layout layout, uint32_t break_level)
{
    if (layout == CGT_KD_LAYOUT_BREADTH_FIRST)
        return CGT_KD_MAX_DEPTH;
    if (layout != CGT_KD_LAYOUT_MIXED)
        return 1;
    return break_level < 1 ? 1 : break_level < CGT_KD_MAX_DEPTH ? break_level : CGT_KD_MAX_DEPTH;
}

static uint32_t choose_cut_level(uint32_t nodes, uint32_t runs)
{
    uint32_t cut = nodes < SERIAL_NODES ? 0 : CUT_LEVEL;
    while ((runs << cut) > MAX_CURSORS)
        cut--;
    return cut;
}

cgt_result cgt_kd_flatten(cgt_context *context, const cgt_kd_memory *memory, const cgt_kd_raw *raw,
                          cgt_kd_layout layout, uint32_t break_level, bool ropes, cgt_kd_tree *tree)
{
    if (raw->nodes >= CGT_KD_MAX_NODES) /* without gaps there are not more, but for the unused one */
        return too_large(context, raw->nodes, 0);
    flattening f = {.raw = raw, .ropes = ropes, .runs = count_runs(layout, break_level)};
    f.cut = choose_cut_level(raw->nodes, f.runs);
    walk_top(&f, false);
    cgt_run_tasks(context, count_part, &f, f.parts);
    *tree = (cgt_kd_tree){0};
    sum_results(&f, tree);
    const run_cursor total = assign_runs(&f);
    const cgt_result result = reserve(context, memory, &f, total);
    if (result != CGT_OK)
        return result;
    f.node[1] = (cgt_kd_node){{0, 0}};
    walk_top(&f, true);
    cgt_run_tasks(context, write_part, &f, f.parts);
    tree->node = f.node;
    tree->nodes = total.node;
    tree->reference = f.reference;
    tree->references = total.reference;
    tree->leaves = total.leaf;
    tree->leaf = f.leaf;
    if (ropes)
        cgt_kd_link_leaves(context, tree, f.leaf);
    return CGT_OK;
}
