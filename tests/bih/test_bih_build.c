/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The build of a bounding interval hierarchy: every primitive is in one leaf, within all planes on the way there and
 * away from them by the margin; numbers of nodes, depth and memory keep their bounds in scenes of all kinds; and the
 * tree is the same for any number of threads. */
#include <math.h>
#include <stdlib.h>

#include "papers/build/bih/bih_build.h"
#include "support/suite.h"
#include "exact/valid_primitive.h"
#include "kd/kd_build_cases.h"
#include "kd/kd_trees.h"
#include "primitive/triangle_scenes.h"
#include "support/test.h"

#define CONTEXTS 3u /* of 1, 2 and 3 threads */

/* ---- a checker ---- */

typedef struct box64 {
    double low[3], high[3];
} box64;

typedef struct checker {
    const cgt_bih *tree;
    const cgt_primitives *prims;
    const char *what;
    uint8_t *seen_node, *seen_prim;
    uint32_t nodes, clips, leaves, depth, largest_leaf;
    uint64_t references;
} checker;

static box64 box_of(const cgt_primitive *primitive)
{
    box64 b;
    for (int a = 0; a < 3; a++) {
        if (primitive->kind == CGT_KIND_SPHERES) {
            const float c[3] = {primitive->sphere.x, primitive->sphere.y, primitive->sphere.z};
            b.low[a] = (double)c[a] - (double)primitive->sphere.r;
            b.high[a] = (double)c[a] + (double)primitive->sphere.r;
            continue;
        }
        const float(*v)[3] = primitive->triangle.v;
        b.low[a] = fmin((double)v[0][a], fmin((double)v[1][a], (double)v[2][a]));
        b.high[a] = fmax((double)v[0][a], fmax((double)v[1][a], (double)v[2][a]));
    }
    return b;
}

/* The planes on the way to a leaf bound its primitives, with half the margin to spare. */
static void check_leaf(checker *c, const cgt_bih_node *n, const box64 *way)
{
    const uint32_t count = cgt_bih_count(n), *prim = cgt_bih_references(c->tree, n);
    box64 first = {0};
    bool equal = true;
    for (uint32_t k = 0; k < count; k++) {
        assert_true(prim[k] < c->prims->count);
        if (c->seen_prim[prim[k]]++)
            fail_msg("%s: primitive %u is in two leaves", c->what, prim[k]);
        const cgt_primitive primitive = cgt_primitives_get(c->prims, prim[k]);
        const box64 b = box_of(&primitive);
        first = k ? first : b;
        for (int a = 0; a < 3; a++) {
            equal &= (float)b.low[a] == (float)first.low[a] && (float)b.high[a] == (float)first.high[a];
            if (way->low[a] > b.low[a] - fabs(way->low[a]) * 0x1p-20 ||
                way->high[a] < b.high[a] + fabs(way->high[a]) * 0x1p-20)
                fail_msg("%s: primitive %u from %a to %a along axis %d, planes %a and %a", c->what, prim[k], b.low[a],
                         b.high[a], a, way->low[a], way->high[a]);
        }
    }
    assert_true(count > 0 && (count <= CGT_BIH_LEAF_ITEMS || equal));
    c->leaves++;
    c->largest_leaf = c->largest_leaf > count ? c->largest_leaf : count;
    c->references += count > CGT_BIH_INLINE_PRIMS ? count : 0;
}

static void check_node(checker *c, uint32_t node, uint32_t depth, box64 way)
{
    assert_true(node < c->tree->node_slots && node != 1);
    if (c->seen_node[node]++)
        fail_msg("%s: node %u has two parents", c->what, node);
    const cgt_bih_node *n = &c->tree->node[node];
    c->nodes++;
    c->depth = c->depth > depth ? c->depth : depth;
    if (cgt_bih_is_leaf(n)) {
        check_leaf(c, n, &way);
        return;
    }
    const uint32_t axis = cgt_bih_axis(n), child = n->word[3];
    const double first = (double)cgt_bih_plane(n, 0), second = (double)cgt_bih_plane(n, 1);
    assert_int_equal(child % 2, 0);
    box64 part = way;
    if (cgt_bih_is_clip(n)) {
        assert_true(first <= second);
        part.low[axis] = fmax(part.low[axis], first);
        part.high[axis] = fmin(part.high[axis], second);
        c->clips++;
        check_node(c, child, depth, part);
        return;
    }
    part.high[axis] = fmin(part.high[axis], first);
    check_node(c, child, depth + 1, part);
    part = way;
    part.low[axis] = fmax(part.low[axis], second);
    check_node(c, child + 1, depth + 1, part);
}

static void check_tree(const cgt_bih *tree, const cgt_committed_scene *committed_scene, const char *what)
{
    checker c = {.tree = tree, .prims = &committed_scene->prims, .what = what};
    const box64 all = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    const uint32_t valid = committed_scene->valid;
    uint32_t listed = 0;
    c.seen_node = calloc(tree->node_slots, 1);
    c.seen_prim = calloc(c.prims->count, 1);
    assert_true(c.seen_node && c.seen_prim);
    check_node(&c, 0, 0, all);
    for (uint32_t prim = 0; prim < c.prims->count; prim++) {
        const cgt_primitive primitive = cgt_primitives_get(c.prims, prim);
        listed += c.seen_prim[prim];
        if (c.seen_prim[prim] != (cgt_primitive_check(&primitive) == CGT_PRIMITIVE_VALID))
            fail_msg("%s: primitive %u is listed %u times", what, prim, c.seen_prim[prim]);
    }
    assert_int_equal(listed, valid);
    assert_int_equal(c.nodes, tree->nodes);
    assert_int_equal(c.leaves, tree->leaves);
    assert_int_equal(c.clips, tree->clips);
    assert_int_equal(c.depth, tree->depth);
    assert_int_equal(c.largest_leaf, tree->largest_leaf);
    assert_int_equal(c.references, tree->references);
    assert_int_equal(tree->nodes, 2 * tree->leaves - 1 + tree->clips);
    assert_true(tree->depth <= CGT_BIH_MAX_DEPTH && tree->leaves <= valid);
    free(c.seen_node);
    free(c.seen_prim);
}

/* ---- building ---- */

typedef struct workshop {
    cgt_context *context[CONTEXTS];
    cgt_buffer nodes[CONTEXTS], references[CONTEXTS], work[CONTEXTS];
    uint64_t built, clips;
    uint32_t deepest, largest_leaf;
} workshop;

static workshop workshop_make(void)
{
    workshop w = {0};
    for (uint32_t i = 0; i < CONTEXTS; i++)
        w.context[i] = context_make(i + 1, NULL);
    return w;
}

static void workshop_free(workshop *w)
{
    for (uint32_t i = 0; i < CONTEXTS; i++) {
        const cgt_memory_hooks *hooks = &w->context[i]->memory;
        cgt_buffer_release(hooks, &w->nodes[i]);
        cgt_buffer_release(hooks, &w->references[i]);
        cgt_buffer_release(hooks, &w->work[i]);
        cgt_context_release(w->context[i]);
    }
}

/* Trees over the same primitives with the same nodes, at the same places; between slices anything may lie. */
static void check_same(const cgt_bih *a, const cgt_bih *b, uint32_t node)
{
    const cgt_bih_node *n = &a->node[node], *m = &b->node[node];
    const uint32_t count = cgt_bih_count(n);
    assert_memory_equal(n, m, sizeof *n);
    if (!cgt_bih_is_leaf(n)) {
        check_same(a, b, n->word[3]);
        if (!cgt_bih_is_clip(n))
            check_same(a, b, n->word[3] + 1);
    } else if (count > CGT_BIH_INLINE_PRIMS) {
        assert_memory_equal(cgt_bih_references(a, n), cgt_bih_references(b, m), count * sizeof(uint32_t));
    }
}

/* Builds with each number of threads; memory is reused from scene to scene. */
static void check_scene(workshop *w, const cgt_committed_scene *committed_scene, const char *what)
{
    cgt_bih tree[CONTEXTS];
    for (uint32_t i = 0; i < CONTEXTS; i++) {
        const cgt_bih_memory memory = {&w->nodes[i], &w->references[i], &w->work[i]};
        if (cgt_bih_build(w->context[i], &memory, committed_scene, &tree[i]) != CGT_OK)
            fail_msg("%s: %s", what, context_message(w->context[i]));
    }
    check_tree(&tree[0], committed_scene, what);
    for (uint32_t i = 1; i < CONTEXTS; i++) {
        assert_int_equal(tree[i].nodes, tree[0].nodes);
        assert_int_equal(tree[i].node_slots, tree[0].node_slots);
        assert_int_equal(tree[i].depth, tree[0].depth);
        check_same(&tree[0], &tree[i], 0);
    }
    w->built++;
    w->clips += tree[0].clips;
    w->deepest = w->deepest > tree[0].depth ? w->deepest : tree[0].depth;
    w->largest_leaf = w->largest_leaf > tree[0].largest_leaf ? w->largest_leaf : tree[0].largest_leaf;
}

static void print_workshop(const char *what, const workshop *w)
{
    print_message("%s: %llu scenes, %llu clips, depth up to %u, leaves of up to %u\n", what,
                  (unsigned long long)w->built, (unsigned long long)w->clips, w->deepest, w->largest_leaf);
}

/* ---- scenes ---- */

TEST(degenerate_scenes)
{
    static const char *const names[] = {DEGENERATE_NAMES};
    static const uint32_t counts[] = {1, 2, 3, 4, 9, 300, 9000};
    workshop w = workshop_make();
    for (int kind = 0; kind < DEGENERATE_KINDS; kind++)
        for (size_t k = 0; k < TEST_COUNT(counts); k++) {
            degenerate_scene d;
            degenerate_make(&d, (degenerate_kind)kind, counts[k]);
            cgt_scene *scene = degenerate_commit(w.context[0], &d);
            if (committed_of(scene)->valid)
                check_scene(&w, committed_of(scene), names[kind]);
            cgt_scene_release(scene);
            degenerate_free(&d);
        }
    print_workshop("degenerate", &w);
    assert_true(w.largest_leaf == 9000); /* that of the same spheres */
    workshop_free(&w);
}

TEST(clouds_of_both_kinds)
{
    workshop w = workshop_make();
    for (uint32_t kind = 0; kind < CLOUD_KINDS; kind++)
        for (uint32_t round = 0; round < 1 + test_scaled(2); round++) {
            /* the second one is large enough for a top that threads share */
            cgt_scene *scene = mixed_scene(w.context[0], (cloud_kind)kind, round, round == 1 ? 30000 : 700);
            check_scene(&w, committed_of(scene), cloud_name((cloud_kind)kind));
            mixed_scene_free(scene);
        }
    print_workshop("clouds", &w);
    assert_true(w.clips > 0);
    workshop_free(&w);
}

static cgt_scene *spheres_scene(cgt_context *context, const float (*sphere)[4], uint32_t count)
{
    cgt_scene *scene = scene_begin(context);
    scene_add_spheres(scene, sphere, count);
    scene->is_band = true; /* the tree is built over it, whatever its scale */
    scene_commit(context, scene);
    return scene;
}

/* Spheres whose distances from the origin halve again and again: each split in the middle takes a few off. The median
 * ends that in time. */
TEST(halving_distances)
{
    enum { COUNT = 20000 };
    float(*sphere)[4] = calloc(COUNT, sizeof *sphere);
    workshop w = workshop_make();
    assert_non_null(sphere);
    for (uint32_t axes = 1; axes <= 3; axes++) {
        test_random r = random_make(axes);
        for (uint32_t i = 0; i < COUNT; i++)
            for (uint32_t a = 0; a < 3; a++)
                sphere[i][a] = a < axes ? ldexpf(random_float(&r, 0.5f, 1), 40 - (int)(i * axes + a) % 120) : 0;
        cgt_scene *scene = spheres_scene(w.context[0], (const float(*)[4])sphere, COUNT);
        check_scene(&w, committed_of(scene), "halving distances");
        cgt_scene_release(scene);
    }
    print_workshop("halving distances", &w);
    assert_true(w.deepest > CGT_BIH_MAX_DEPTH - 4); /* nearly all depth was used */
    free(sphere);
    workshop_free(&w);
}

/* Concentric spheres are halved by size: a ray past the small ones does not test them all. */
TEST(concentric_spheres)
{
    enum { COUNT = 12000 };
    float(*sphere)[4] = calloc(COUNT, sizeof *sphere);
    workshop w = workshop_make();
    assert_non_null(sphere);
    for (uint32_t i = 0; i < COUNT; i++)
        sphere[i][3] = 1 + (float)i / COUNT;
    cgt_scene *scene = spheres_scene(w.context[0], (const float(*)[4])sphere, COUNT);
    check_scene(&w, committed_of(scene), "concentric spheres");
    print_workshop("concentric", &w);
    assert_true(w.largest_leaf <= CGT_BIH_LEAF_ITEMS && w.deepest <= 14);
    cgt_scene_release(scene);
    free(sphere);
    workshop_free(&w);
}

/* ---- too many ---- */

TEST(too_many_primitives)
{
    workshop w = workshop_make();
    const cgt_bih_memory memory = {&w.nodes[0], &w.references[0], &w.work[0]};
    const cgt_committed_scene huge = {.valid = CGT_BIH_MAX_PRIMS + 1};
    cgt_bih tree;
    assert_int_equal(cgt_bih_build(w.context[0], &memory, &huge, &tree), CGT_ERROR_TOO_LARGE);
    assert_non_null(strstr(context_message(w.context[0]), "bounding interval hierarchy"));
    workshop_free(&w);
}

SEEDED_SUITE("test_bih_build", NULL, NULL)
