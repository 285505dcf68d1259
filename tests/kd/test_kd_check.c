/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The checker of kd-trees finds each kind of fault planted in a good tree. Its geometry is checked, too: borderline
 * cases by hand, points of triangles, and the library's own conservative test. */
#include "exact/valid_primitive.h"
#include "support/suite.h"
#include "kd/kd_trees.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kd/kd_touch.h"
#include "kernel/builders/triangle_box.h"

/* ---- primitives and boxes ---- */

static bool ball_touches(float x, float y, float z, float r, kd_box box)
{
    const cgt_primitive primitive = {.kind = CGT_KIND_SPHERES, .sphere = {x, y, z, r}};
    return kd_touches(&primitive, &box);
}

TEST(spheres_at_the_limit)
{
    const kd_box right = {{1, -1, -1}, {2, 1, 1}}, corner = {{3, 4, 0}, {9, 9, 9}}, around = {{-3, -4, 0}, {3, 4, 0}};
    assert_true(ball_touches(0, 0, 0, 1, right));
    assert_false(ball_touches(0, 0, 0, nextafterf(1, 0), right));
    assert_true(ball_touches(0, 0, 0, 5, corner));
    assert_false(ball_touches(0, 0, 0, nextafterf(5, 0), corner));
    assert_true(ball_touches(0, 0, 0, 5, around)); /* touches the corners of the box */
    assert_false(ball_touches(0, 0, 0, nextafterf(5, 6), around));
    assert_true(ball_touches(0, 0, 0, nextafterf(5, 0), around));
    assert_true(ball_touches(1, 0, 0, 0, right)); /* a point */
    assert_false(ball_touches(nextafterf(1, 0), 0, 0, 0, right));
    /* scaled to denormals and to huge numbers */
    for (int e = -148; e <= 50; e += 33) {
        const float s = ldexpf(1, e);
        const kd_box box = {{3 * s, 4 * s, 0}, {9 * s, 9 * s, 9 * s}};
        assert_true(ball_touches(0, 0, 0, 5 * s, box));
        assert_false(ball_touches(0, 0, 0, nextafterf(5 * s, 0), box));
    }
}

static bool triangle_touches(const float v[3][3], kd_box box)
{
    cgt_primitive primitive = {.kind = CGT_KIND_TRIANGLES};
    memcpy(primitive.triangle.v, v, sizeof primitive.triangle.v);
    return kd_touches(&primitive, &box);
}

TEST(triangles_at_the_limit)
{
    const kd_box unit = {{0, 0, 0}, {1, 1, 1}};
    const float plane[3][3] = {{3, 0, 0}, {0, 3, 0}, {0, 0, 3}}; /* x + y + z = 3 */
    const float off[3][3] = {{nextafterf(3, 4), 0, 0}, {0, nextafterf(3, 4), 0}, {0, 0, nextafterf(3, 4)}};
    const float edge[3][3] = {{2, 0, 0.5f}, {0, 2, 0.5f}, {2, 2, 0.5f}}; /* an edge that crosses x = y = 1 */
    const float past[3][3] = {{2, nextafterf(0, 1), 0.5f}, {0, nextafterf(2, 3), 0.5f}, {2, 2, 0.5f}};
    const float vertex[3][3] = {{1, 0.5f, 0.5f}, {2, 0, 0}, {2, 1, 0}};
    const float adjacent[3][3] = {{nextafterf(1, 2), 0.5f, 0.5f}, {2, 0, 0}, {2, 1, 0}};
    const float inside[3][3] = {{0.4f, 0.5f, 0.5f}, {0.5f, 0.6f, 0.5f}, {0.5f, 0.5f, 0.7f}};
    const float wide[3][3] = {{-9, -9, 0.5f}, {9, -9, 0.5f}, {0, 20, 0.25f}};
    assert_true(triangle_touches(plane, unit));
    assert_false(triangle_touches(off, unit));
    assert_true(triangle_touches(edge, unit));
    assert_false(triangle_touches(past, unit));
    assert_true(triangle_touches(vertex, unit));
    assert_false(triangle_touches(adjacent, unit));
    assert_true(triangle_touches(inside, unit));
    assert_true(triangle_touches(wide, unit));
}

/* Small integers, so that many triangles and boxes just touch. */
static float lattice(test_random *r) { return (float)random_below(r, 9) - 4; }

static bool library_touches(const cgt_triangle *q, const kd_box *box)
{
    double v[3][3], half[3], center[3];
    cgt_triangle_box t;
    for (int a = 0; a < 3; a++) {
        half[a] = ((double)box->high[a] - box->low[a]) / 2;
        center[a] = ((double)box->high[a] + box->low[a]) / 2;
        for (int k = 0; k < 3; k++)
            v[k][a] = q->v[k][a];
    }
    for (int a = 0; a < 3; a++)
        if (fmax(fmax(v[0][a], v[1][a]), v[2][a]) < box->low[a] || fmin(fmin(v[0][a], v[1][a]), v[2][a]) > box->high[a])
            return false;
    cgt_triangle_box_init((const double(*)[3])v, half, &t);
    return cgt_triangle_box_touches(&t, center);
}

/* On small integers the margin of the library's test is nearly zero, so that both tests must agree. A triangle with a
 * point in the box touches it. */
TEST(triangles_by_both_tests)
{
    test_random r = random_make(0);
    uint32_t touches = 0, points = 0;
    const uint32_t rounds = 3000 + test_scaled(18000);
    for (uint32_t round = 0; round < rounds; round++) {
        cgt_primitive s = {.kind = CGT_KIND_TRIANGLES};
        kd_box box;
        for (int a = 0; a < 3; a++) {
            for (int k = 0; k < 3; k++)
                s.triangle.v[k][a] = lattice(&r);
            box.low[a] = lattice(&r);
            box.high[a] = box.low[a] + (float)random_below(&r, 3);
        }
        if (cgt_primitive_check(&s) != CGT_PRIMITIVE_VALID)
            continue;
        const bool touch = kd_touches(&s, &box);
        assert_int_equal(touch, library_touches(&s.triangle, &box));
        touches += touch;
        bool point = true; /* whether a point of the triangle, in eighths, lies in the box */
        const uint32_t u = random_below(&r, 9), v = random_below(&r, 9 - u);
        for (int a = 0; a < 3; a++) {
            const float p = ((float)(8 - u - v) * s.triangle.v[0][a] + (float)u * s.triangle.v[1][a] +
                             (float)v * s.triangle.v[2][a]) /
                            8;
            point = point && p >= box.low[a] && p <= box.high[a];
        }
        assert_true(touch || !point);
        points += point;
    }
    print_message("%u of %u touch, %u by the point\n", touches, rounds, points);
    assert_true(touches > rounds / 25 && touches < rounds / 2 && points > 0);
}

/* ---- planted faults ---- */

/* A copy of a tree, to be spoilt. */
typedef struct spoilt {
    const cgt_committed_scene *committed_scene;
    cgt_kd_tree tree;
    cgt_kd_node *node;
    uint32_t *reference;
    cgt_kd_leaf *leaf;
    test_random random;
} spoilt;

static void *copy(const void *from, size_t bytes)
{
    void *to = NULL; /* aligned like the library's memory */
    const cgt_memory_hooks hooks = cgt_memory_default();
    to = cgt_allocate(&hooks, bytes);
    assert_non_null(to);
    if (bytes)
        memcpy(to, from, bytes);
    return to;
}

static spoilt spoilt_make(const cgt_kd_tree *tree, const cgt_committed_scene *committed_scene, uint64_t stream)
{
    spoilt s = {.committed_scene = committed_scene, .tree = *tree, .random = random_make(stream)};
    s.tree.node = s.node = copy(tree->node, tree->nodes * sizeof *tree->node);
    s.tree.reference = s.reference = copy(tree->reference, tree->references * sizeof *tree->reference);
    if (tree->leaf)
        s.tree.leaf = s.leaf = copy(tree->leaf, tree->leaves * sizeof *tree->leaf);
    return s;
}

static void spoilt_free(spoilt *s)
{
    free(s->node);
    free(s->reference);
    free(s->leaf);
}

/* A random leaf of at least this many primitives, or an inner node. */
static uint32_t any_node(spoilt *s, bool leaf, uint32_t prims)
{
    for (;;) {
        const uint32_t i = random_below(&s->random, s->tree.nodes);
        const cgt_kd_node n = s->node[i];
        if (i != 1 && cgt_kd_is_leaf(n) == leaf && (!leaf || cgt_kd_count(n) >= prims))
            return i;
    }
}

static uint32_t *references_of(spoilt *s, uint32_t leaf)
{
    const uint32_t first = s->leaf ? s->leaf[s->node[leaf].word[1]].first : s->node[leaf].word[1];
    return s->reference + first;
}

static void swap_references(spoilt *s)
{
    uint32_t *prim = references_of(s, any_node(s, true, 2)), first = prim[0];
    prim[0] = prim[1];
    prim[1] = first;
}

static void repeat_reference(spoilt *s)
{
    uint32_t *prim = references_of(s, any_node(s, true, 2));
    prim[1] = prim[0];
}

static void list_skipped_primitive(spoilt *s)
{
    const cgt_primitives *prims = &s->committed_scene->prims;
    for (;;) {
        const uint32_t leaf = any_node(s, true, 2), last = references_of(s, leaf)[cgt_kd_count(s->node[leaf]) - 1];
        const uint32_t i = random_below(&s->random, prims->count);
        const cgt_primitive primitive = cgt_primitives_get(prims, i);
        if (i < last && cgt_primitive_check(&primitive) != CGT_PRIMITIVE_VALID) {
            references_of(s, leaf)[0] = i;
            return;
        }
    }
}

static void list_missing_primitive(spoilt *s)
{
    const uint32_t leaf = any_node(s, true, 2);
    references_of(s, leaf)[cgt_kd_count(s->node[leaf]) - 1] = s->committed_scene->prims.count;
}

static void refer_beyond(spoilt *s)
{
    const uint32_t leaf = any_node(s, true, 2), end = (uint32_t)s->tree.references - 1;
    *(s->leaf ? &s->leaf[s->node[leaf].word[1]].first : &s->node[leaf].word[1]) = end;
}

static void share_references(spoilt *s)
{
    const uint32_t a = any_node(s, true, 2);
    uint32_t b;
    do
        b = any_node(s, true, 2);
    while (a == b);
    if (s->leaf)
        s->leaf[s->node[a].word[1]].first = s->leaf[s->node[b].word[1]].first;
    else
        s->node[a].word[1] = s->node[b].word[1];
    s->node[a].word[0] = s->node[b].word[0];
    if (s->leaf)
        s->leaf[s->node[a].word[1]].count = s->leaf[s->node[b].word[1]].count;
}

static void odd_children(spoilt *s) { s->node[any_node(s, false, 0)].word[1]++; }

static void children_beyond(spoilt *s) { s->node[any_node(s, false, 0)].word[1] = (s->tree.nodes + 1) & ~1u; }

static void two_parents(spoilt *s)
{
    const uint32_t a = any_node(s, false, 0);
    uint32_t b;
    do
        b = any_node(s, false, 0);
    while (a == b);
    s->node[a].word[1] = s->node[b].word[1];
}

static void endless(spoilt *s)
{
    uint32_t node;
    do
        node = any_node(s, false, 0);
    while (node == 0);
    s->node[node].word[1] = s->node[0].word[1];
}

static void split_outside(spoilt *s)
{
    const uint32_t i = any_node(s, false, 0), axis = cgt_kd_axis(s->node[i]);
    s->node[i] = cgt_kd_inner(axis, s->tree.high[axis] + 1, s->node[i].word[1]);
}

static void split_infinite(spoilt *s)
{
    const uint32_t i = any_node(s, false, 0);
    s->node[i] =
        cgt_kd_inner(cgt_kd_axis(s->node[i]), random_below(&s->random, 2) ? INFINITY : NAN, s->node[i].word[1]);
}

static void smaller_root(spoilt *s)
{
    const uint32_t axis = random_below(&s->random, 3);
    s->tree.high[axis] -= (s->tree.high[axis] - s->tree.low[axis]) / 4;
}

static void no_root(spoilt *s) { s->tree.low[1] = INFINITY; }

static void wrong_leaves(spoilt *s) { s->tree.empty_leaves++; }

static void wrong_depth(spoilt *s) { s->tree.depth++; }

static void used_node_1(spoilt *s) { s->node[1] = cgt_kd_leaf_node(0, 0); }

static void lost_subtree(spoilt *s) { s->node[any_node(s, false, 0)] = cgt_kd_leaf_node(0, 0); }

static void wrong_number(spoilt *s)
{
    const uint32_t a = any_node(s, true, 0);
    uint32_t b;
    do
        b = any_node(s, true, 0);
    while (a == b);
    const uint32_t number = s->node[a].word[1];
    s->node[a] = cgt_kd_leaf_node(s->leaf[s->node[b].word[1]].count, s->node[b].word[1]);
    s->node[b] = cgt_kd_leaf_node(s->leaf[number].count, number);
}

static void number_beyond(spoilt *s) { s->node[any_node(s, true, 0)].word[1] = s->tree.leaves; }

static cgt_kd_leaf *any_leaf(spoilt *s) { return &s->leaf[random_below(&s->random, s->tree.leaves)]; }

static void wrong_count(spoilt *s) { any_leaf(s)->count++; }

static void wrong_box(spoilt *s)
{
    float *high = &any_leaf(s)->high[random_below(&s->random, 3)];
    *high = nextafterf(*high, INFINITY);
}

static void wrong_wide_rope(spoilt *s)
{
    uint32_t *rope = &any_leaf(s)->packet_rope[random_below(&s->random, 6)];
    *rope = *rope == CGT_INVALID_ID ? 0 : CGT_INVALID_ID;
}

static void lost_rope(spoilt *s)
{
    uint32_t *rope = &any_leaf(s)->rope[random_below(&s->random, 6)];
    *rope = *rope == CGT_INVALID_ID ? 0 : CGT_INVALID_ID;
}

/* A node other than the rope's target; node 1 is unused. */
static void rope_to_wrong_node(spoilt *s)
{
    for (;;) {
        uint32_t *rope = &any_leaf(s)->rope[random_below(&s->random, 6)];
        if (*rope == CGT_INVALID_ID)
            continue;
        *rope = *rope == 0 ? 1 : s->tree.nodes + random_below(&s->random, 2) - 1;
        if (*rope == s->tree.nodes - 1)
            *rope = 1;
        return;
    }
}

static void rope_not_pushed_down(spoilt *s)
{
    for (uint32_t i = 0; i < s->tree.leaves; i++)
        for (uint32_t side = 0; side < 6; side++)
            if (s->leaf[i].rope[side] != s->leaf[i].packet_rope[side]) {
                s->leaf[i].rope[side] = s->leaf[i].packet_rope[side];
                return;
            }
    fail_msg("no rope is pushed down");
}

/* Pushed on to a child that holds only part of the face. */
static void rope_too_far(spoilt *s)
{
    for (uint32_t i = 0; i < s->tree.leaves; i++)
        for (uint32_t side = 0; side < 6; side++) {
            const uint32_t rope = s->leaf[i].rope[side];
            if (rope != CGT_INVALID_ID && !cgt_kd_is_leaf(s->node[rope])) {
                s->leaf[i].rope[side] = s->node[rope].word[1] + random_below(&s->random, 2);
                return;
            }
        }
    fail_msg("all ropes lead to leaves");
}

/* Removes a primitive from a leaf that it touches; the references after it move up. */
static void omit_primitive(spoilt *s)
{
    for (;;) {
        const uint32_t leaf = any_node(s, true, 2), count = cgt_kd_count(s->node[leaf]);
        uint32_t *prim = references_of(s, leaf), i = random_below(&s->random, count);
        kd_box box;
        memcpy(box.low, s->leaf[s->node[leaf].word[1]].low, sizeof box.low);
        memcpy(box.high, s->leaf[s->node[leaf].word[1]].high, sizeof box.high);
        const cgt_primitive primitive = cgt_primitives_get(&s->committed_scene->prims, prim[i]);
        if (!kd_touches(&primitive, &box))
            continue;
        memmove(prim + i, prim + i + 1, (count - 1 - i) * sizeof *prim);
        s->node[leaf] = cgt_kd_leaf_node(count - 1, s->node[leaf].word[1]);
        s->leaf[s->node[leaf].word[1]].count--;
        return;
    }
}

static const struct {
    void (*plant)(spoilt *s);
    const char *found; /* part of the message; NULL: any message */
    bool ropes;        /* only in trees with ropes */
} faults[] = {
    {swap_references, " after ", false},
    {repeat_reference, " after ", false},
    {list_skipped_primitive, "invalid", false},
    {list_missing_primitive, "invalid", false},
    {refer_beyond, "out of range", false},
    {share_references, NULL, false},
    {odd_children, "children", false},
    {children_beyond, "children", false},
    {two_parents, NULL, false},
    {endless, NULL, false},
    {split_outside, "split", false},
    {split_infinite, "split", false},
    {smaller_root, "root", false},
    {no_root, "root", false},
    {wrong_leaves, "the tree says", false},
    {wrong_depth, "the tree says", false},
    {used_node_1, "node 1", false},
    {lost_subtree, NULL, false},
    {wrong_number, NULL, true},
    {number_beyond, "number", true},
    {wrong_count, "entry", true},
    {wrong_box, "box", true},
    {wrong_wide_rope, "wide rope", true},
    {lost_rope, "rope leads", true},
    {rope_to_wrong_node, "does not hold", true},
    {rope_not_pushed_down, "its child", true},
    {rope_too_far, "does not hold", true},
    {omit_primitive, "does not list", true},
};

TEST(planted_faults_are_found)
{
    cgt_context *context = context_make(1, NULL);
    flat_tree flat = {0};
    for (uint32_t round = 0; round < 4 + test_scaled(16); round++) {
        cgt_scene *scene = mixed_scene(context, CLOUD_UNIFORM, round, 100);
        test_random r = random_make(round);
        const bool ropes = round % 2;
        random_tree tree;
        do { /* until there is room for every kind of fault */
            tree = random_tree_make(&r, committed_of(scene), 20, 4);
            assert_int_equal(flatten(&flat, context, &tree.raw, CGT_KD_LAYOUT_AUTO, 0, ropes), CGT_OK);
            random_tree_free(&tree);
        } while (flat.tree.nodes < 200 || flat.tree.references < 300);
        assert_null(kd_check(&flat.tree, committed_of(scene)));
        for (size_t i = 0; i < TEST_COUNT(faults); i++) {
            if (faults[i].ropes && !ropes)
                continue;
            spoilt s = spoilt_make(&flat.tree, committed_of(scene), round);
            faults[i].plant(&s);
            const char *found = kd_check(&s.tree, committed_of(scene));
            if (!found || (faults[i].found && !strstr(found, faults[i].found)))
                fail_msg("round %u, fault %zu: found %s, not %s", round, i, found ? found : "nothing",
                         faults[i].found ? faults[i].found : "any");
            spoilt_free(&s);
        }
        mixed_scene_free(scene);
    }
    flat_tree_free(&flat);
    cgt_context_release(context);
}

SEEDED_SUITE("test_kd_check", NULL, NULL)
