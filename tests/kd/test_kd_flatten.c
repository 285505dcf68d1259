/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Flattening: every layout of a random tree holds the same splits and leaves, in the order that its name promises;
 * trees that are too large. */
#include "kd/random_tree.h"
#include "scene/scene.h"
#include "structures/check/kd_check.h"
#include "structures/scenes/loose_scenes.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- scenes, and trees with their memory ---- */

typedef struct subject {
    cgt_context *context;
    loose_scene from;
    cgt_scene *scene;
    const cgt_committed_scene *committed; /* of the scene */
    cgt_buffer nodes, references, leaves;
    cgt_kd_tree tree;
} subject;

static subject subject_make(test_random *r, loose_kind kind, uint32_t primitives)
{
    subject s = {.context = context_make(2, NULL), .from = loose_make(r, kind, LOOSE_BOTH, primitives)};
    s.scene = loose_add(&s.from, s.context, NULL);
    assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
    s.committed = &s.scene->committed_scene;
    return s;
}

static void subject_free(subject *s)
{
    const cgt_memory_hooks *hooks = &s->context->memory;
    cgt_buffer_release(hooks, &s->nodes);
    cgt_buffer_release(hooks, &s->references);
    cgt_buffer_release(hooks, &s->leaves);
    cgt_scene_release(s->scene);
    cgt_context_release(s->context);
    loose_free(&s->from);
}

/* ---- layouts ---- */

static const struct {
    cgt_kd_layout layout;
    uint32_t break_level;
    uint32_t levels; /* that are laid out breadth first */
} layouts[] = {
    {CGT_KD_LAYOUT_AUTO, 0, 1},    {CGT_KD_LAYOUT_DEPTH_FIRST, 0, 1}, {CGT_KD_LAYOUT_BREADTH_FIRST, 0, 50},
    {CGT_KD_LAYOUT_MIXED, 1, 1},   {CGT_KD_LAYOUT_MIXED, 2, 2},       {CGT_KD_LAYOUT_MIXED, 7, 7},
    {CGT_KD_LAYOUT_MIXED, 50, 50},
};

static cgt_result flatten(subject *s, const cgt_kd_raw *raw, size_t layout, bool ropes)
{
    const cgt_kd_memory memory = {&s->nodes, &s->references, &s->leaves};
    return cgt_kd_flatten(s->context, &memory, raw, layouts[layout].layout, layouts[layout].break_level, ropes,
                          &s->tree);
}

/* ---- the order of nodes, from the definitions ---- */

/* The raw node at each final index. */
typedef struct expected_order {
    uint32_t *raw;
    uint32_t nodes;
} expected_order;

static void append_pair(expected_order *o, const cgt_kd_raw *raw, uint32_t parent)
{
    o->raw[o->nodes++] = raw->node[parent].word[1];
    o->raw[o->nodes++] = raw->node[parent].word[1] + 1;
}

/* All nodes below a node, depth first. */
static void append_below(expected_order *o, const cgt_kd_raw *raw, uint32_t node)
{
    if (cgt_kd_is_leaf(raw->node[node]))
        return;
    append_pair(o, raw, node);
    append_below(o, raw, raw->node[node].word[1]);
    append_below(o, raw, raw->node[node].word[1] + 1);
}

static expected_order expect_order(const cgt_kd_raw *raw, uint32_t levels)
{
    expected_order o = {malloc((raw->nodes + (size_t)2) * sizeof(uint32_t)), 2};
    assert_non_null(o.raw);
    o.raw[0] = 0;
    uint32_t begin = 0, end = 1; /* nodes of a level */
    for (uint32_t level = 1; level < levels && begin < end; level++) {
        const uint32_t next = o.nodes;
        for (uint32_t i = begin; i < end; i++)
            if (!cgt_kd_is_leaf(raw->node[o.raw[i]]))
                append_pair(&o, raw, o.raw[i]);
        begin = next;
        end = o.nodes;
    }
    for (uint32_t i = begin; i < end; i++)
        append_below(&o, raw, o.raw[i]);
    return o;
}

static void check_leaf(const cgt_kd_raw *raw, const cgt_kd_tree *tree, cgt_kd_node was, uint32_t node, uint32_t number,
                       uint64_t *next)
{
    const cgt_kd_node n = tree->node[node];
    const uint32_t count = cgt_kd_count(was), *prim = cgt_kd_references(tree, &tree->node[node]);
    assert_true(cgt_kd_is_leaf(n) && cgt_kd_count(n) == count);
    if (count)
        assert_memory_equal(prim, raw->reference + was.word[1], count * sizeof *prim);
    if (tree->leaf) {
        assert_int_equal(n.word[1], number);
        assert_int_equal(tree->leaf[number].count, count);
    }
    if (count > 1 || tree->leaf) { /* references follow the order of the nodes */
        assert_true((tree->leaf ? tree->leaf[number].first : n.word[1]) == *next);
        *next += count;
    }
}

/* Checks that tree holds raw's nodes in the order of a layout. */
static void check_order(const cgt_kd_raw *raw, const cgt_kd_tree *tree, uint32_t levels)
{
    const expected_order o = expect_order(raw, levels);
    uint32_t *final = calloc(raw->nodes, sizeof *final), leaves = 0;
    uint64_t next = 0;
    assert_non_null(final);
    assert_int_equal(tree->nodes, o.nodes);
    for (uint32_t i = 0; i < o.nodes; i++)
        if (i != 1)
            final[o.raw[i]] = i;
    for (uint32_t i = 0; i < o.nodes; i++) {
        if (i == 1)
            continue;
        const cgt_kd_node was = raw->node[o.raw[i]];
        if (cgt_kd_is_leaf(was)) {
            check_leaf(raw, tree, was, i, leaves++, &next);
        } else {
            assert_int_equal(tree->node[i].word[0], was.word[0]);
            assert_int_equal(tree->node[i].word[1], final[was.word[1]]);
        }
    }
    assert_true(tree->references == next);
    assert_int_equal(tree->leaves, leaves);
    assert_memory_equal(tree->low, raw->low, sizeof raw->low);
    assert_memory_equal(tree->high, raw->high, sizeof raw->high);
    free(final);
    free(o.raw);
}

static void check_layouts(subject *s, const cgt_kd_raw *raw)
{
    for (size_t i = 0; i < TEST_COUNT(layouts); i++)
        for (int ropes = 0; ropes < 2; ropes++) {
            assert_int_equal(flatten(s, raw, i, ropes), CGT_OK);
            assert_true(!s->tree.leaf == !ropes);
            check_order(raw, &s->tree, layouts[i].levels);
            const char *fault = kd_check(&s->tree, s->committed);
            if (fault)
                fail_msg("layout %zu, ropes %d: %s", i, ropes, fault);
        }
}

TEST(layouts_keep_splits_and_leaves)
{
    static const loose_kind kinds[] = {LOOSE_UNIFORM, LOOSE_CLUSTERED, LOOSE_FLAT,    LOOSE_LINE,
                                       LOOSE_LATTICE, LOOSE_FAR,       LOOSE_SPOILED, LOOSE_STADIUM};
    uint32_t deepest = 0, largest = 0, empty = 0;
    for (uint32_t round = 0; round < TEST_COUNT(kinds) * (1 + test_scaled(9)); round++) {
        test_random r = random_make(round);
        subject s = subject_make(&r, kinds[round % TEST_COUNT(kinds)], 8 + random_below(&r, 120));
        random_tree tree =
            random_tree_make(&r, s.committed, random_below(&r, CGT_KD_MAX_DEPTH), 1 + random_below(&r, 8));
        check_layouts(&s, &tree.raw);
        deepest = s.tree.depth > deepest ? s.tree.depth : deepest;
        largest = s.tree.nodes > largest ? s.tree.nodes : largest;
        empty += s.tree.empty_leaves;
        random_tree_free(&tree);
        subject_free(&s);
    }
    print_message("depth up to %u, up to %u nodes, %u empty leaves\n", deepest, largest, empty);
    assert_true(deepest > 4 && largest > 20);
}

TEST(one_leaf)
{
    test_random r = random_make(1);
    for (uint32_t primitives = 1; primitives < 12; primitives += 5) {
        subject s = subject_make(&r, LOOSE_UNIFORM, primitives);
        random_tree tree = random_tree_leaf(s.committed);
        check_layouts(&s, &tree.raw);
        assert_int_equal(s.tree.nodes, 2);
        assert_int_equal(s.tree.depth, 0);
        random_tree_free(&tree);
        subject_free(&s);
    }
}

/* ---- trees that are too large ---- */

/* A chain of `depth` splits at the lower end of the root; every leaf has all primitives. */
static random_tree chain(const cgt_committed_scene *committed_scene, uint32_t depth)
{
    random_tree tree = random_tree_leaf(committed_scene);
    const cgt_kd_node leaf = tree.node[0];
    free(tree.node);
    tree.node = calloc(2 * depth + 1, sizeof *tree.node);
    assert_non_null(tree.node);
    for (uint32_t i = 0; i < depth; i++) {
        tree.node[i ? 2 * i : 0] =
            cgt_kd_inner(0, cgt_kd_round_split(0.5f * (committed_scene->low[0] + committed_scene->high[0])), 2 * i + 1);
        tree.node[2 * i + 1] = tree.node[2 * i + 2] = leaf;
    }
    tree.raw.node = tree.node;
    tree.raw.nodes = 2 * depth + 1;
    return tree;
}

TEST(too_large)
{
    test_random r = random_make(3);
    subject s = subject_make(&r, LOOSE_UNIFORM, 20);
    random_tree deep = chain(s.committed, CGT_KD_MAX_DEPTH);
    check_layouts(&s, &deep.raw);
    assert_int_equal(s.tree.depth, CGT_KD_MAX_DEPTH);
    random_tree_free(&deep);

    deep = chain(s.committed, CGT_KD_MAX_DEPTH + 1);
    for (size_t i = 0; i < TEST_COUNT(layouts); i++)
        assert_int_equal(flatten(&s, &deep.raw, i, false), CGT_ERROR_TOO_LARGE);
    deep.raw.nodes = CGT_KD_MAX_NODES;
    assert_int_equal(flatten(&s, &deep.raw, 0, false), CGT_ERROR_TOO_LARGE);
    random_tree_free(&deep);

    deep = chain(s.committed, 4); /* five leaves of 2^30 - 1 references */
    for (uint32_t i = 1; i < deep.raw.nodes; i++)
        if (cgt_kd_is_leaf(deep.node[i]))
            deep.node[i] = cgt_kd_leaf_node((1u << 30) - 1, 0);
    for (int ropes = 0; ropes < 2; ropes++)
        assert_int_equal(flatten(&s, &deep.raw, 0, ropes), CGT_ERROR_TOO_LARGE);
    assert_non_null(strstr(context_message(s.context), "5368709115 references"));
    random_tree_free(&deep);
    subject_free(&s);
}

SEEDED_SUITE("test_kd_flatten", NULL, NULL)
