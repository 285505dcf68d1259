/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Builders, layouts and ropes together, over scenes of all kinds, degenerate ones included: each builder's tree in
 * each layout, with and without ropes, passes the checker (kd/kd_check.h) and is the same for any number of
 * threads. */
#include "kd/kd_trees.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/closed_meshes.h"
#include "primitive/triangle_scenes.h"
#include "scene/scene.h"

/* The primitives of a scene; a primitive with a NAN is skipped. */
typedef struct primitive_set {
    uint32_t spheres, triangles;
    float (*sphere)[4];
    triangle *triangle;
} primitive_set;

static primitive_set primitive_set_make(uint32_t spheres, uint32_t triangles)
{
    primitive_set t = {spheres, triangles, calloc(spheres + 1, sizeof *t.sphere),
                       calloc(triangles + 1, sizeof *t.triangle)};
    assert_true(t.sphere && t.triangle);
    return t;
}

static void primitive_set_free(primitive_set *t)
{
    free(t->sphere);
    free(t->triangle);
}

/* In a box around a centre, each of about the given size. */
static primitive_set random_set(test_random *r, uint32_t count, float middle, float reach, float size)
{
    primitive_set t = primitive_set_make(count, count);
    for (uint32_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++) {
            const float at = middle + random_float(r, -reach, reach);
            t.sphere[i][a] = middle + random_float(r, -reach, reach);
            t.sphere[i][3] = random_float(r, 0, size);
            for (int k = 0; k < 3; k++)
                t.triangle[i][k][a] = at + random_float(r, -size, size);
        }
    return t;
}

/* ---- kinds of scenes ---- */

static primitive_set coincident(test_random *r, uint32_t count)
{
    primitive_set t = random_set(r, count, 1, 2, 1);
    for (uint32_t i = 1; i < count; i++) {
        memcpy(t.sphere[i], t.sphere[0], sizeof t.sphere[0]);
        memcpy(t.triangle[i], t.triangle[0], sizeof t.triangle[0]);
    }
    return t;
}

/* All in a plane perpendicular to an axis: the root has no thickness. */
static primitive_set planar(test_random *r, uint32_t count)
{
    primitive_set t = random_set(r, count, 0, 3, 0.5f);
    const uint32_t axis = random_below(r, 3);
    const float at = random_float(r, -3, 3);
    for (uint32_t i = 0; i < count; i++) {
        t.sphere[i][axis] = at;
        t.sphere[i][3] = 0;
        for (int k = 0; k < 3; k++)
            t.triangle[i][k][axis] = at;
    }
    return t;
}

/* Points along an axis, and triangles in a plane through it. */
static primitive_set line(test_random *r, uint32_t count)
{
    primitive_set t = random_set(r, count, 0, 3, 0.25f);
    for (uint32_t i = 0; i < count; i++) {
        t.sphere[i][1] = t.sphere[i][2] = t.sphere[i][3] = 0;
        for (int k = 0; k < 3; k++)
            t.triangle[i][k][2] = k ? t.triangle[i][k][1] : 0;
    }
    return t;
}

static primitive_set one_sphere(test_random *r, uint32_t count)
{
    primitive_set t = random_set(r, 1, 0, 9, 3);
    (void)count;
    t.triangles = 0;
    return t;
}

static primitive_set one_point(test_random *r, uint32_t count)
{
    primitive_set t = one_sphere(r, count);
    t.sphere[0][3] = 0;
    return t;
}

static primitive_set one_triangle(test_random *r, uint32_t count)
{
    primitive_set t = random_set(r, 1, 0, 9, 3);
    (void)count;
    t.spheres = 0;
    return t;
}

static primitive_set one_valid(test_random *r, uint32_t count)
{
    primitive_set t = random_set(r, count, 0, 9, 3);
    const uint32_t valid = random_below(r, 2 * count);
    for (uint32_t i = 0; i < count; i++) {
        if (i != valid)
            t.sphere[i][random_below(r, 4)] = i % 2 ? NAN : INFINITY;
        if (i + count != valid)
            t.triangle[i][random_below(r, 3)][random_below(r, 3)] = i % 2 ? NAN : -INFINITY;
    }
    return t;
}

static primitive_set huge(test_random *r, uint32_t count) { return random_set(r, count, 0, 0x1p53f, 0x1p50f); }

static primitive_set denormal(test_random *r, uint32_t count) { return random_set(r, count, 0, 0x1p-136f, 0x1p-139f); }

/* Few floats between the ends. */
static primitive_set far_away(test_random *r, uint32_t count) { return random_set(r, count, 0x1p20f, 4, 0.5f); }

/* One of the largest primitives among the smallest. */
static primitive_set all_sizes(test_random *r, uint32_t count)
{
    primitive_set t = random_set(r, count, 0, 1, 0.01f);
    for (uint32_t i = 0; i < count; i++) {
        const float factor = random_log(r, 1e-9f, 1e9f);
        for (int a = 0; a < 3; a++)
            for (int k = 0; k < 3; k++)
                t.triangle[i][k][a] *= factor;
        t.sphere[i][3] *= i % 7 ? 1 : factor;
    }
    return t;
}

/* Integers: neighbouring primitives touch. */
static primitive_set lattice(test_random *r, uint32_t count)
{
    primitive_set t = primitive_set_make(count, count);
    for (uint32_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++) {
            t.sphere[i][a] = (float)random_below(r, 8) - 4;
            t.sphere[i][3] = (float)random_below(r, 3);
            for (int k = 0; k < 3; k++)
                t.triangle[i][k][a] = (float)random_below(r, 8) - 4;
        }
    return t;
}

/* Long thin triangles across everything. */
static primitive_set needles(test_random *r, uint32_t count)
{
    primitive_set t = primitive_set_make(0, count);
    for (uint32_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++) {
            t.triangle[i][0][a] = random_float(r, -5, 5);
            t.triangle[i][1][a] = random_float(r, -5, 5);
            t.triangle[i][2][a] = t.triangle[i][1][a] + random_float(r, -1e-3f, 1e-3f);
        }
    return t;
}

static primitive_set mesh(test_random *r, uint32_t count)
{
    closed_mesh m;
    assert_true(closed_mesh_make(&m, (closed_kind)random_below(r, CLOSED_KINDS), count < 100 ? 3 : 4));
    primitive_set t = primitive_set_make(0, m.triangles);
    for (uint32_t i = 0; i < m.triangles; i++)
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                t.triangle[i][k][a] = (float)m.vertex[m.index[i][k]][a];
    closed_mesh_free(&m);
    return t;
}

static const struct {
    const char *name;
    primitive_set (*make)(test_random *r, uint32_t count);
} kinds[] = {
    {"coincident", coincident}, {"planar", planar},       {"line", line},
    {"one sphere", one_sphere}, {"one point", one_point}, {"one triangle", one_triangle},
    {"one valid", one_valid},   {"huge", huge},           {"denormal", denormal},
    {"far away", far_away},     {"all sizes", all_sizes}, {"lattice", lattice},
    {"needles", needles},       {"mesh", mesh},
};

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

static void scenes_of_all_kinds(void **state)
{
    workshop w = workshop_make();
    (void)state;
    for (size_t kind = 0; kind < TEST_COUNT(kinds); kind++)
        for (uint32_t round = 0; round < 1 + test_scaled(3); round++) {
            test_random r = random_make(100 * kind + round);
            primitive_set t = kinds[kind].make(&r, round == 0 ? 8 : 40 + test_scaled(200));
            cgt_scene *scene = scene_begin(w.context[0]);
            if (t.spheres)
                scene_add_spheres(scene, (const float(*)[4])t.sphere, t.spheres);
            if (t.triangles)
                scene_add_triangles(scene, (const triangle *)t.triangle, t.triangles);
            scene->is_band = true; /* trees are built over it, whatever its scale */
            scene_commit(w.context[0], scene);
            assert_true(committed_of(scene)->valid > 0 && !committed_of(scene)->brute_force);
            check_scene(&w, committed_of(scene), kinds[kind].name);
            cgt_scene_release(scene);
            primitive_set_free(&t);
        }
    print_workshop("kinds", &w);
    assert_true(w.leaves > 6 * TEST_COUNT(kinds));
    workshop_free(&w);
}

static void clouds_of_both_kinds(void **state)
{
    workshop w = workshop_make();
    (void)state;
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
static void many_primitives(void **state)
{
    workshop w = workshop_make();
    (void)state;
    for (uint32_t kind = 0; kind < 2; kind++) {
        cgt_scene *scene = mixed_scene(w.context[0], kind ? CLOUD_CLUSTERED : CLOUD_UNIFORM, kind, 12000);
        check_scene(&w, committed_of(scene), kind ? "many clustered" : "many");
        mixed_scene_free(scene);
    }
    print_workshop("many", &w);
    workshop_free(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_of_all_kinds),
        cmocka_unit_test(clouds_of_both_kinds),
        cmocka_unit_test(many_primitives),
    };
    test_begin("test_kd_structures");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
