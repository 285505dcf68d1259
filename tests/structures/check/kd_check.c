/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The checker of kd-trees: one walk over all nodes with their boxes and the primitives whose bounds touch those. */
#include "exact/valid_primitive.h"
#include "structures/check/kd_check.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "structures/check/kd_walk.h"
#include "kd/random_tree.h"

static _Thread_local char message[256];

void kd_fault(kd_walk *w, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (!w->faulty)
        vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    w->faulty = true;
}

/* ---- leaves ---- */

/* The references of a leaf; NULL where they are out of range. */
static const uint32_t *references(kd_walk *w, uint32_t node)
{
    const cgt_kd_tree *tree = w->tree;
    const cgt_kd_node *n = &tree->node[node];
    const uint32_t count = cgt_kd_count(*n);
    uint64_t first = n->word[1];
    if (tree->leaf) {
        if (n->word[1] >= tree->leaves) {
            kd_fault(w, "leaf %u has number %u of %u", node, n->word[1], tree->leaves);
            return NULL;
        }
        if (tree->leaf[n->word[1]].count != count)
            kd_fault(w, "leaf %u has %u primitives, its entry says %u", node, count, tree->leaf[n->word[1]].count);
        first = tree->leaf[n->word[1]].first;
    } else if (count < 2) {
        if (count == 0 && n->word[1])
            kd_fault(w, "leaf %u is empty, and word 1 is %u", node, n->word[1]);
        return &n->word[1];
    }
    if (first + count > tree->references) {
        kd_fault(w, "leaf %u: references %llu and %u more are out of range", node, (unsigned long long)first, count);
        return NULL;
    }
    for (uint32_t i = 0; i < count; i++)
        if (w->used[first + i]++)
            kd_fault(w, "leaf %u: reference %llu belongs to another leaf", node, (unsigned long long)first + i);
    if (cgt_kd_references(tree, n) != tree->reference + first)
        kd_fault(w, "leaf %u: cgt_kd_references leads elsewhere", node);
    return tree->reference + first;
}

/* candidate: primitives whose bounds touch the leaf, ascending. */
static void check_leaf(kd_walk *w, uint32_t node, const uint32_t *candidate, size_t candidates)
{
    const uint32_t count = cgt_kd_count(w->tree->node[node]), *prim = references(w, node);
    w->leaves++;
    w->empty_leaves += count == 0;
    for (uint32_t i = 0; prim && i < count; i++) {
        if (prim[i] >= w->committed_scene->prims.count || !w->valid[prim[i]])
            kd_fault(w, "leaf %u lists primitive %u, which is invalid", node, prim[i]);
        if (i && prim[i] <= prim[i - 1])
            kd_fault(w, "leaf %u: primitive %u after %u", node, prim[i], prim[i - 1]);
    }
    for (size_t i = 0, at = 0; prim && i < candidates && !w->faulty; i++) {
        while (at < count && prim[at] < candidate[i])
            at++;
        if (at < count && prim[at] == candidate[i])
            continue;
        const cgt_primitive primitive = cgt_primitives_get(&w->committed_scene->prims, candidate[i]);
        if (kd_touches(&primitive, &w->box[node]))
            kd_fault(w, "leaf %u does not list primitive %u, which touches it", node, candidate[i]);
    }
}

/* ---- nodes ---- */

static bool bounds_touch(const kd_walk *w, uint32_t prim, const kd_box *box)
{
    for (int a = 0; a < 3; a++)
        if (w->high[prim][a] < box->low[a] || w->low[prim][a] > box->high[a])
            return false;
    return true;
}

static bool check_inner(kd_walk *w, uint32_t node, uint32_t depth)
{
    const cgt_kd_node n = w->tree->node[node];
    const uint32_t axis = cgt_kd_axis(n), lower = n.word[1];
    const float split = cgt_kd_split(n);
    if (depth >= CGT_KD_MAX_DEPTH)
        kd_fault(w, "node %u is too deep", node);
    else if (lower < 2 || lower % 2 || lower >= w->tree->nodes - 1)
        kd_fault(w, "node %u has children %u of %u", node, lower, w->tree->nodes);
    else if (w->reached[lower] || w->reached[lower + 1])
        kd_fault(w, "node %u is reached twice", lower);
    else if (!isfinite(split) || split < w->box[node].low[axis] || split > w->box[node].high[axis])
        kd_fault(w, "node %u: the split %a is not in its box, %a to %a", node, (double)split,
                 (double)w->box[node].low[axis], (double)w->box[node].high[axis]);
    return !w->faulty;
}

static void visit(kd_walk *w, uint32_t node, uint32_t depth, uint32_t *list, size_t listed)
{
    const cgt_kd_node n = w->tree->node[node];
    if (cgt_kd_is_leaf(n)) {
        check_leaf(w, node, list, listed);
        return;
    }
    if (!check_inner(w, node, depth))
        return;
    w->depth = depth + 1 > w->depth ? depth + 1 : w->depth;
    for (uint32_t i = 0; i < 2 && !w->faulty; i++) {
        const uint32_t child = n.word[1] + i;
        kd_box *box = &w->box[child];
        uint32_t *next = list + listed;
        size_t kept = 0;
        *box = w->box[node];
        *(i ? &box->low[cgt_kd_axis(n)] : &box->high[cgt_kd_axis(n)]) = cgt_kd_split(n);
        w->reached[child] = true;
        w->parent[child] = node;
        for (size_t k = 0; k < listed; k++)
            if (bounds_touch(w, list[k], box))
                next[kept++] = list[k];
        visit(w, child, depth + 1, next, kept);
    }
}

/* ---- the whole tree ---- */

static size_t list_objects(kd_walk *w)
{
    const cgt_kd_tree *tree = w->tree;
    size_t listed = 0;
    for (uint32_t i = 0; i < w->committed_scene->prims.count; i++) {
        const cgt_primitive s = cgt_primitives_get(&w->committed_scene->prims, i);
        w->valid[i] = cgt_primitive_check(&s) == CGT_PRIMITIVE_VALID;
        if (!w->valid[i])
            continue;
        object_bounds(&w->committed_scene->prims, i, w->low[i], w->high[i]);
        w->list[listed++] = i;
        for (int a = 0; a < 3; a++) /* bounds of spheres lie one step of double outside */
            if (nextafter(w->low[i][a], INFINITY) < tree->low[a] || nextafter(w->high[i][a], -INFINITY) > tree->high[a])
                kd_fault(w, "primitive %u reaches beyond the root", i);
    }
    return listed;
}

static void check_counts(kd_walk *w)
{
    const cgt_kd_tree *tree = w->tree;
    for (uint32_t i = 0; i < tree->nodes; i++)
        if (!w->reached[i] && i != 1)
            kd_fault(w, "node %u is not reached", i);
    for (uint64_t i = 0; i < tree->references; i++)
        if (!w->used[i])
            kd_fault(w, "reference %llu is in no leaf", (unsigned long long)i);
    if (tree->node[1].word[0] || tree->node[1].word[1])
        kd_fault(w, "node 1 is not zero");
    if (tree->leaves != w->leaves || tree->empty_leaves != w->empty_leaves || tree->depth != w->depth)
        kd_fault(w, "%u leaves, %u of them empty, depth %u; the tree says %u, %u, %u", w->leaves, w->empty_leaves,
                 w->depth, tree->leaves, tree->empty_leaves, tree->depth);
}

static void run(kd_walk *w)
{
    const cgt_kd_tree *tree = w->tree;
    for (int a = 0; a < 3; a++) {
        w->box[0].low[a] = tree->low[a];
        w->box[0].high[a] = tree->high[a];
        if (!(tree->low[a] <= tree->high[a]) || !isfinite(tree->low[a]) || !isfinite(tree->high[a]))
            kd_fault(w, "the box of the root is none");
    }
    for (uint32_t i = 0; i < tree->nodes; i++)
        w->parent[i] = CGT_INVALID_ID;
    w->reached[0] = true;
    const size_t listed = list_objects(w);
    if (!w->faulty)
        visit(w, 0, 0, w->list, listed);
    if (!w->faulty)
        check_counts(w);
    if (!w->faulty && tree->leaf)
        kd_check_leaves(w);
}

const char *kd_check(const cgt_kd_tree *tree, const cgt_committed_scene *committed_scene)
{
    kd_walk w = {.tree = tree, .committed_scene = committed_scene};
    const size_t prims = committed_scene->prims.count, nodes = tree->nodes;
    if (nodes < 2 || (uintptr_t)tree->node % 16)
        return "there is no root, or pairs are not aligned";
    w.box = calloc(nodes, sizeof *w.box);
    w.parent = calloc(nodes, sizeof *w.parent);
    w.reached = calloc(nodes, sizeof *w.reached);
    w.low = calloc(prims + 1, sizeof *w.low);
    w.high = calloc(prims + 1, sizeof *w.high);
    w.valid = calloc(prims + 1, sizeof *w.valid);
    w.used = calloc((size_t)tree->references + 1, sizeof *w.used);
    w.list = calloc((prims + 1) * (CGT_KD_MAX_DEPTH + 2), sizeof *w.list);
    if (w.box && w.parent && w.reached && w.low && w.high && w.valid && w.used && w.list)
        run(&w);
    else
        kd_fault(&w, "out of memory");
    free(w.box);
    free(w.parent);
    free(w.reached);
    free(w.low);
    free(w.high);
    free(w.valid);
    free(w.used);
    free(w.list);
    return w.faulty ? message : NULL;
}
