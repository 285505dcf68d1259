/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Builder, layouts and ropes together, over scenes of all kinds, degenerate ones included: the builder's tree in each
 * layout, with and without ropes, passes the checker (kd/kd_check.h) and is the same for any number of
 * threads. */
#include "grid/loose_scenes.h"
#include "support/suite.h"
#include "kd/kd_trees.h"

#include <stdlib.h>

#include "hard_cases/hard_run.h"
#include "primitive/triangle_scenes.h"
#include "scene/scene.h"
#include "structures/scenes/random_soup.h"
#include "support/closed_meshes.h"

/* ---- trees ---- */

static const struct {
    cgt_kd_layout layout;
    uint32_t break_level;
} layouts[] = {
    {CGT_KD_LAYOUT_DEPTH_FIRST, 0},
    {CGT_KD_LAYOUT_BREADTH_FIRST, 0},
    {CGT_KD_LAYOUT_MIXED, 3},
};

/* Both trees have the same bytes. */
static void check_same(const cgt_kd_tree *a, const cgt_kd_tree *b)
{
    assert_int_equal(a->nodes, b->nodes);
    assert_int_equal(a->references, b->references);
    assert_int_equal(a->leaves, b->leaves);
    assert_memory_equal(a->node, b->node, a->nodes * sizeof *a->node);
    if (a->references)
        assert_memory_equal(a->reference, b->reference, a->references * sizeof *a->reference);
    if (a->leaf)
        assert_memory_equal(a->leaf, b->leaf, a->leaves * sizeof *a->leaf);
}

/* Memory reused from scene to scene, as a scene reuses it from commit to commit. */
typedef struct workshop {
    cgt_context *context[3]; /* of 1, 2 and 3 threads */
    cgt_buffer work[3];
    flat_tree flat[3];
    uint64_t nodes, references, leaves, limited_leaves;
} workshop;

static void build(workshop *w, size_t i, const cgt_committed_scene *committed_scene, cgt_kd_raw *raw)
{
    if (cgt_kd_build(w->context[i], &w->work[i], committed_scene, &cgt_kd_default_costs, raw) != CGT_OK)
        fail_msg("%s", context_message(w->context[i]));
}

static void check_scene(workshop *w, const cgt_committed_scene *committed_scene, const char *scene)
{
    cgt_kd_raw raw, other;
    build(w, 0, committed_scene, &raw);
    for (size_t i = 0; i < 2 * TEST_COUNT(layouts); i++) {
        const size_t l = i / 2;
        const bool ropes = i % 2;
        const cgt_kd_tree *tree = &w->flat[0].tree;
        assert_int_equal(flatten(&w->flat[0], w->context[0], &raw, layouts[l].layout, layouts[l].break_level, ropes),
                         CGT_OK);
        const char *fault = kd_check(tree, committed_scene);
        if (fault)
            fail_msg("%s, %s, ropes %d: %s", scene, layout_name(layouts[l].layout), ropes, fault);
        w->nodes += tree->nodes;
        w->references += tree->references;
        w->leaves += tree->leaves;
    }
    w->limited_leaves += raw.limited_leaves;
    for (size_t i = 1; i < TEST_COUNT(w->context); i++) { /* of the last layout, with ropes */
        build(w, i, committed_scene, &other);
        assert_int_equal(flatten(&w->flat[i], w->context[i], &other, layouts[2].layout, layouts[2].break_level, true),
                         CGT_OK);
        check_same(&w->flat[0].tree, &w->flat[i].tree);
        assert_true(other.cost == raw.cost && other.limited_leaves == raw.limited_leaves);
    }
}

static workshop workshop_make(void)
{
    workshop w = {0};
    for (uint32_t i = 0; i < TEST_COUNT(w.context); i++)
        w.context[i] = context_make(i + 1, NULL);
    return w;
}

static void workshop_free(workshop *w)
{
    for (size_t i = 0; i < TEST_COUNT(w->context); i++) {
        cgt_buffer_release(&w->context[i]->memory, &w->work[i]);
        flat_tree_free(&w->flat[i]);
        cgt_context_release(w->context[i]);
    }
}

static void print_workshop(const char *what, const workshop *w)
{
    print_message("%s: %llu nodes, %llu references, %llu leaves, %llu of them limited\n", what,
                  (unsigned long long)w->nodes, (unsigned long long)w->references, (unsigned long long)w->leaves,
                  (unsigned long long)w->limited_leaves);
}

/* ---- tests ---- */

/* Few primitives, and some hundred; huge, tiny, coincident, flat and spoilt ones among them. */
TEST(scenes_of_all_kinds)
{
    const uint32_t counts[] = {1, 8, 40 + test_scaled(200)};
    workshop w = workshop_make();
    test_random r = random_make(100);
    uint32_t checked = 0;
    for (int kind = 0; kind < LOOSE_KINDS; kind++)
        for (int what = LOOSE_SPHERES; what <= LOOSE_BOTH; what++)
            for (size_t i = 0; i < TEST_COUNT(counts); i++) {
                loose_scene s = loose_make(&r, (loose_kind)kind, (loose_what)what, counts[i]);
                cgt_scene *scene = loose_add(&s, w.context[0], NULL);
                scene->is_band = true; /* trees are built over it, whatever its scale */
                scene_commit(w.context[0], scene);
                if (committed_of(scene)->valid && !committed_of(scene)->brute_force) {
                    check_scene(&w, committed_of(scene), loose_name((loose_kind)kind));
                    checked++;
                }
                cgt_scene_release(scene);
                loose_free(&s);
            }
    print_workshop("kinds", &w);
    assert_true(checked > 8 * LOOSE_KINDS && w.leaves > 6 * checked);
    workshop_free(&w);
}

/* Needles, lattices, clusters and meshes of triangles. */
TEST(soups_and_meshes)
{
    workshop w = workshop_make();
    for (int kind = 0; kind < SOUP_KINDS; kind++) {
        hard_scene s = soup_make((soup_kind)kind, 50 + (uint64_t)kind, 40 + test_scaled(200));
        cgt_scene *scene = NULL;
        assert_int_equal(hard_commit(w.context[0], &s, (const uint32_t[3]){0, 0, 0}, &scene), CGT_OK);
        check_scene(&w, committed_of(scene), soup_name((soup_kind)kind));
        cgt_scene_release(scene);
        hard_scene_free(&s);
    }
    for (int kind = 0; kind < CLOSED_KINDS; kind++) {
        closed_mesh m;
        assert_true(closed_mesh_make(&m, (closed_kind)kind, 3));
        triangle *t = calloc(m.triangles, sizeof *t);
        assert_non_null(t);
        for (uint32_t i = 0; i < 9 * m.triangles; i++)
            t[i / 9][i / 3 % 3][i % 3] = (float)m.vertex[m.index[i / 9][i / 3 % 3]][i % 3];
        cgt_scene *scene = scene_of_triangles(w.context[0], NULL, (const triangle *)t, m.triangles);
        check_scene(&w, committed_of(scene), closed_mesh_name((closed_kind)kind));
        cgt_scene_release(scene);
        free(t);
        closed_mesh_free(&m);
    }
    print_workshop("soups and meshes", &w);
    workshop_free(&w);
}

TEST(clouds_of_both_kinds)
{
    workshop w = workshop_make();
    for (uint32_t kind = 0; kind < CLOUD_KINDS; kind++)
        for (uint32_t round = 0; round < test_scaled(2); round++) {
            cgt_scene *scene = mixed_scene(w.context[0], (cloud_kind)kind, round, 60 + test_scaled(600));
            check_scene(&w, committed_of(scene), cloud_name((cloud_kind)kind));
            mixed_scene_free(scene);
        }
    print_workshop("clouds", &w);
    assert_true(w.leaves > 6 * 6 * CLOUD_KINDS); /* they are split */
    workshop_free(&w);
}

/* Enough primitives for builders and flattening to use tasks. */
TEST(many_primitives)
{
    workshop w = workshop_make();
    for (uint32_t kind = 0; kind < 2; kind++) {
        cgt_scene *scene = mixed_scene(w.context[0], kind ? CLOUD_CLUSTERED : CLOUD_UNIFORM, kind, 12000);
        check_scene(&w, committed_of(scene), kind ? "many clustered" : "many");
        mixed_scene_free(scene);
    }
    print_workshop("many", &w);
    workshop_free(&w);
}

SEEDED_SUITE("test_kd_structures", NULL, NULL)
