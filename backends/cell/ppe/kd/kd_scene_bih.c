/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bounding interval hierarchies for SPEs: the builder's array has gaps between the slices of its tasks, and DMA brings
 * whole blocks. So the tree is walked twice, as cgt_kd_flatten does: the first walk counts the pairs of each level,
 * from which follows where each begins; the second one writes. Levels are stored one after the other down to the break
 * level, and what is below comes after them, depth first: depth first alone breaks below the root. */
#include <string.h>

#include "cell/ppe/kd/kd_scene.h"

#define DEFAULT_BREAK_LEVEL 8u
#define MOST_RUNS 64u /* levels beyond, in trees of many clip nodes, are stored together */

typedef struct walk {
    const cgt_bih *tree;
    cgt_bih_node *node; /* NULL: count */
    uint32_t *reference;
    uint32_t runs, next[MOST_RUNS]; /* nodes of each run; then, its next place */
    uint32_t references, nodes;
    uint32_t first_prim;
} walk;

/* A node on its way: where it was, and where it goes. */
typedef struct step {
    uint32_t raw, final, level;
} step;

static cgt_bih_node leaf_of(walk *w, const cgt_bih_node *n)
{
    const uint32_t count = cgt_bih_count(n), *const from = cgt_bih_references(w->tree, n);
    cgt_bih_node leaf = {{n->word[0], 0, 0, 0}};
    const bool in_node = count <= CGT_BIH_INLINE_PRIMS;
    uint32_t *const to = in_node ? &leaf.word[1] : w->reference ? w->reference + w->references : NULL;
    if (!in_node)
        leaf.word[1] = w->references;
    for (uint32_t k = 0; k < count && to; k++)
        to[k] = from[k] + w->first_prim;
    w->references += in_node ? 0 : count;
    return leaf;
}

/* An inner node whose children begin at `pair`; planes are normal numbers or 0, which margins cover. */
static cgt_bih_node inner_of(const cgt_bih_node *n, uint32_t pair)
{
    return cgt_bih_inner(cgt_bih_axis(n), cgt_bih_is_clip(n), cgt_spe_normal(cgt_bih_plane(n, 0)),
                         cgt_spe_normal(cgt_bih_plane(n, 1)), pair);
}

static void run_walk(walk *w)
{
    const cgt_bih_node empty = {{3, 0, 0, 0}};
    step stack[CGT_BIH_MAX_DEPTH + 1], s = {0};
    uint32_t top = 0;
    for (;;) {
        const cgt_bih_node *const n = &w->tree->node[s.raw];
        if (cgt_bih_is_leaf(n)) {
            const cgt_bih_node leaf = leaf_of(w, n);
            if (w->node)
                w->node[s.final] = leaf;
            if (!top)
                return;
            s = stack[--top];
            continue;
        }
        uint32_t *const next = &w->next[s.level < w->runs ? s.level : w->runs - 1];
        const uint32_t pair = *next;
        *next += 2;
        if (w->node) {
            w->node[s.final] = inner_of(n, pair);
            w->node[pair + 1] = empty;
        }
        if (!cgt_bih_is_clip(n))
            stack[top++] = (step){n->word[3] + 1, pair + 1, s.level + 1};
        s = (step){n->word[3], pair, s.level + 1};
    }
}

static uint32_t count_runs(cgt_kd_layout layout, uint32_t break_level)
{
    if (layout == CGT_KD_LAYOUT_BREADTH_FIRST)
        return MOST_RUNS;
    if (layout != CGT_KD_LAYOUT_MIXED)
        return 1;
    break_level = break_level ? break_level : DEFAULT_BREAK_LEVEL;
    return break_level < MOST_RUNS ? break_level : MOST_RUNS;
}

/* From how much each run holds to where it begins, behind the root and the node that is not used. */
static void assign_runs(walk *w)
{
    w->nodes = 2;
    for (uint32_t k = 0; k < w->runs; k++) {
        const uint32_t count = w->next[k];
        w->next[k] = w->nodes;
        w->nodes += count;
    }
}

static void *allocate_lines(const cgt_memory_hooks *memory, size_t bytes, size_t *allocated)
{
    *allocated = (bytes + 127) / 128 * 128;
    void *const made = bytes ? cgt_allocate(memory, *allocated) : NULL;
    if (made)
        memset(made, 0, *allocated);
    return made;
}

cgt_result cgt_kd_scene_add_bih(const cgt_memory_hooks *memory, const cgt_bih *tree, cgt_kd_layout layout,
                                uint32_t break_level, cgt_kd_scene_part *part)
{
    walk w = {.tree = tree, .runs = count_runs(layout, break_level), .first_prim = part->first};
    run_walk(&w);
    assign_runs(&w);
    part->node = allocate_lines(memory, w.nodes * sizeof *w.node, &part->node_bytes);
    part->reference = allocate_lines(memory, w.references * sizeof *w.reference, &part->reference_bytes);
    if (!part->node || (!part->reference && w.references))
        return CGT_ERROR_OUT_OF_MEMORY;
    part->image.nodes = w.nodes;
    part->image.references = w.references;
    part->image.leaves = tree->leaves;
    w.node = part->node;
    w.reference = part->reference;
    w.references = 0;
    w.node[1] = (cgt_bih_node){{3, 0, 0, 0}};
    run_walk(&w);
    return CGT_OK;
}
