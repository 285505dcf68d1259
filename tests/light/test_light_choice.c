/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which way points against a light go, by work that is counted: scattered points take no more than a tree needs and a
 * trial, tiles that took little are remembered until the next commit, the statistics tell why; and whichever way is
 * taken, on any number of threads, the answers are those of the BVH. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dispatch/kernel.h"
#include "scene/scene.h"
#include "support/scenes.h"

static bool is_slow(void) { return test_scaled(10) < 2; }

#define POINTS (is_slow() ? 24000u : 60000u)
#define PRIMS (is_slow() ? 60000u : 150000u)
#define EDGE 64u /* points along each axis of a piece of a surface */

typedef struct lit_scene {
    float (*sphere)[4];
    uint32_t prims;
    float *at[3];
    uint32_t points;
    uint8_t *got, *expected;
    cgt_trace_statistics statistics;
    cgt_research_trace_statistics research;
} lit_scene;

static void lit_scene_make(test_random *r, lit_scene *s)
{
    *s = (lit_scene){.prims = PRIMS, .points = POINTS};
    s->sphere = malloc(s->prims * sizeof *s->sphere);
    s->got = malloc(s->points);
    s->expected = malloc(s->points);
    assert_true(s->sphere && s->got && s->expected);
    const float radius = 0.4f * cbrtf(8 / (float)s->prims);
    for (uint32_t i = 0; i < s->prims; i++)
        for (int a = 0; a < 4; a++)
            s->sphere[i][a] = a == 3 ? radius : random_float(r, -1, 1);
    for (int a = 0; a < 3; a++)
        assert_non_null(s->at[a] = malloc(s->points * sizeof(float)));
}

static void lit_scene_free(lit_scene *s)
{
    for (int a = 0; a < 3; a++)
        free(s->at[a]);
    free(s->sphere);
    free(s->got);
    free(s->expected);
}

static void scatter(test_random *r, lit_scene *s)
{
    for (int a = 0; a < 3; a++)
        for (uint32_t i = 0; i < s->points; i++)
            s->at[a][i] = random_float(r, -1, 1);
}

/* Square pieces of a plane, one after the other, as tiles of a picture show them. */
static void lay_in_tiles(lit_scene *s)
{
    for (uint32_t i = 0; i < s->points; i++) {
        const uint32_t tile = i / (EDGE * EDGE), x = i % EDGE, y = i / EDGE % EDGE;
        s->at[0][i] = -0.9f + 0.4f * (float)(tile % 4) + 0.4f * (float)x / EDGE;
        s->at[1][i] = -0.9f + 0.4f * (float)(tile / 4) + 0.4f * (float)y / EDGE;
        s->at[2][i] = -0.8f;
    }
}

static cgt_scene *commit(cgt_context *context, const lit_scene *s, cgt_structure structure)
{
    const cgt_spheres spheres = spheres_of((const float(*)[4])s->sphere, s->prims);
    cgt_scene_options options;
    cgt_scene *scene;
    cgt_scene_options_init(&options);
    options.structure = structure;
    assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_add_spheres(scene, &spheres, NULL), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* Traces points first to first + count - 1. Returns the work of each: as with 16 lanes, a reference takes one of them. */
static double trace(const cgt_scene *scene, const cgt_light *light, lit_scene *s, uint32_t first, uint32_t count,
                    uint8_t *occluded)
{
    const cgt_points points = {.count = count, .position = {s->at[0] + first, s->at[1] + first, s->at[2] + first}};
    cgt_research_trace_options research;
    cgt_trace_options options;
    cgt_trace_options_init(&options);
    cgt_research_trace_options_init(&research);
    options.statistics = &s->statistics;
    options.research = &research;
    research.statistics = &s->research;
    memset(occluded + first, 7, count);
    assert_int_equal(cgt_occluded_points(scene, light, &points, occluded + first, &options), CGT_OK);
    assert_int_equal(s->statistics.rays, count);
    const double lanes = scene->context->kernel->lanes;
    return ((double)s->research.references * lanes / 16 + (double)s->statistics.ray_tests / 16 +
            (double)s->research.nodes + (double)s->research.leaves) /
           count;
}

static const cgt_light lights[] = {{CGT_LIGHT_POINT, {2, 3, -2.5f}},       {CGT_LIGHT_POINT, {0, 0, 0}},
                                   {CGT_LIGHT_POINT, {0.1f, 0.9f, 0.2f}},  {CGT_LIGHT_POINT, {0.6f, 0.4f, -1.2f}},
                                   {CGT_LIGHT_DIRECTIONAL, {1, 2, -1.5f}}, {CGT_LIGHT_DIRECTIONAL, {0, 0, 1}}};

static void scattered_points_take_no_more_than_a_tree(void **state)
{
    static lit_scene s;
    test_random r = random_make(1);
    (void)state;
    cgt_context *context = context_make(1, NULL);
    lit_scene_make(&r, &s);
    scatter(&r, &s);
    cgt_scene *truth = commit(context, &s, CGT_STRUCTURE_BVH), *tiles = commit(context, &s, CGT_STRUCTURE_LOOSE_GRID);
    for (uint32_t k = 0; k < TEST_COUNT(lights); k++) {
        cgt_scene *scene = commit(context, &s, CGT_STRUCTURE_AUTO);
        const double by_tree = trace(truth, &lights[k], &s, 0, s.points, s.expected);
        const double by_tiles = trace(tiles, &lights[k], &s, 0, s.points, s.got);
        assert_memory_equal(s.got, s.expected, s.points);
        const double first = trace(scene, &lights[k], &s, 0, s.points, s.got);
        const double given_up = (double)s.research.given_up;
        assert_memory_equal(s.got, s.expected, s.points);
        const double second = trace(scene, &lights[k], &s, 0, s.points, s.got);
        assert_memory_equal(s.got, s.expected, s.points);
        print_message("light %u: %.1f by the tree, %.1f by tiles, %.1f, then %.1f; %.0f given up; then \"%s\"\n", k,
                      by_tree, by_tiles, first, second, given_up, s.research.light_way);
        /* a trial; at worst what a tree would have cost, three for each primitive; and some slack for what is undone */
        assert_true(first <= 2 * by_tree + 64 + 3.0 * s.prims / s.points);
        assert_true(first <= fmax(by_tree, 0.7 * by_tiles) + 2); /* an eighth of the points tells */
        assert_true(second <= by_tree + 3);                      /* references of tiles take less than nodes */
        assert_true(given_up <= 0.5 * s.points || s.research.given_up == 0); /* most were: nothing tries again */
        cgt_scene_release(scene);
    }
    cgt_scene_release(tiles);
    cgt_scene_release(truth);
    lit_scene_free(&s);
    cgt_context_release(context);
}

static void tiles_that_served_are_remembered(void **state)
{
    static lit_scene s;
    test_random r = random_make(2);
    (void)state;
    cgt_context *context = context_make(1, NULL);
    lit_scene_make(&r, &s);
    lay_in_tiles(&s);
    cgt_scene *scene = commit(context, &s, CGT_STRUCTURE_AUTO);
    for (uint32_t k = 0; k < TEST_COUNT(lights); k++)
        for (uint32_t commits = 0; commits < 2; commits++) {
            const double first = trace(scene, &lights[k], &s, 0, EDGE * EDGE, s.got);
            const bool was_before = strstr(s.research.light_way, "before") != NULL;
            const double next = trace(scene, &lights[k], &s, EDGE * EDGE, EDGE * EDGE, s.got);
            print_message("light %u: work %.1f, %.1f; \"%s\"\n", k, first, next, s.research.light_way);
            assert_false(was_before);
            assert_non_null(strstr(s.research.light_way, "took little before"));
            assert_int_equal(s.statistics.bvh_rays, 0);
            assert_int_equal(cgt_scene_commit(scene), CGT_OK); /* forgets */
        }
    const cgt_light far = {CGT_LIGHT_POINT, {1e10f, 0, 0}};
    trace(scene, &far, &s, 0, s.points, s.got);
    assert_non_null(strstr(s.research.light_way, "do not serve"));
    cgt_scene_release(scene);
    lit_scene_free(&s);
    cgt_context_release(context);
}

/* Points that needed a tree, and paid for it, have it at once after the next commit; few points do not ask for it. */
static void trees_that_paid_are_built_again(void **state)
{
    static lit_scene s; /* around lights 1 and 2, tiles take much with any number of lanes */
    test_random r = random_make(6);
    (void)state;
    cgt_context *context = context_make(1, NULL);
    lit_scene_make(&r, &s);
    scatter(&r, &s);
    cgt_scene *scene = commit(context, &s, CGT_STRUCTURE_AUTO), *truth = commit(context, &s, CGT_STRUCTURE_BVH);
    trace(truth, &lights[1], &s, 0, s.points, s.expected);
    trace(scene, &lights[1], &s, 0, s.points, s.got);
    assert_true(s.research.given_up > 0 && s.statistics.bvh_rays > s.points / 3);
    for (uint32_t commits = 0; commits < 3; commits++) {
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        trace(scene, &lights[1], &s, 0, s.points, s.got);
        assert_int_equal(s.research.given_up, 0);
        assert_int_equal(s.statistics.bvh_rays, s.points);
        assert_memory_equal(s.got, s.expected, s.points);
    }
    /* another light tries; few points leave no wish */
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    trace(scene, &lights[2], &s, 0, s.points, s.got);
    assert_true(s.research.given_up > 0);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    trace(scene, &lights[1], &s, 0, 300, s.got);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    trace(scene, &lights[1], &s, 0, s.points, s.got);
    assert_true(s.research.given_up > 0);
    assert_memory_equal(s.got, s.expected, s.points);
    cgt_scene_release(scene);
    cgt_scene_release(truth);
    lit_scene_free(&s);
    cgt_context_release(context);
}

/* Nine of ten spheres lie in clumps: tiles make tables of open groups there (kernel/light/light_table.h), and skip cells
 * by them. */
static void gather_in_clumps(test_random *r, lit_scene *s)
{
    float middle[16][3];
    for (int k = 0; k < 16; k++)
        for (int a = 0; a < 3; a++)
            middle[k][a] = random_float(r, -0.8f, 0.8f);
    for (uint32_t i = 0; i < s->prims; i++)
        for (int a = 0; a < 3 && i % 10; a++)
            s->sphere[i][a] = middle[i % 16][a] + 0.12f * (random_float(r, -1, 1) + random_float(r, -1, 1));
}

static void tables_of_open_groups_change_no_answer(void **state)
{
    static lit_scene s;
    test_random r = random_make(4);
    (void)state;
    lit_scene_make(&r, &s);
    gather_in_clumps(&r, &s);
    lay_in_tiles(&s);
    FOR_EACH_VARIANT(variant)
    {
        uint64_t cells = 0;
        cgt_context *context = context_make(1, variant);
        cgt_scene *truth = commit(context, &s, CGT_STRUCTURE_BVH),
                  *tiles = commit(context, &s, CGT_STRUCTURE_LOOSE_GRID);
        for (uint32_t k = 0; k < TEST_COUNT(lights); k++) {
            trace(truth, &lights[k], &s, 0, s.points, s.expected);
            const double work = trace(tiles, &lights[k], &s, 0, s.points, s.got);
            print_message("%s, light %u: work %.1f, %llu cells\n", variant, k, work,
                          (unsigned long long)s.research.cells);
            assert_memory_equal(s.got, s.expected, s.points);
            cells += s.statistics.tiles ? s.research.cells : 0;
        }
        assert_true(cells > 0); /* tables were in use */
        cgt_scene_release(tiles);
        cgt_scene_release(truth);
        cgt_context_release(context);
    }
    lit_scene_free(&s);
}

/* Where tables have spared much, calls after that make them at once. */
static void tables_that_spared_are_remembered(void **state)
{
    static lit_scene s;
    test_random r = random_make(5);
    uint32_t fewer = 0;
    (void)state;
    cgt_context *context = context_make(1, NULL);
    lit_scene_make(&r, &s);
    gather_in_clumps(&r, &s);
    lay_in_tiles(&s);
    cgt_scene *scene = commit(context, &s, CGT_STRUCTURE_LOOSE_GRID);
    for (uint32_t k = 0; k < TEST_COUNT(lights); k++) {
        uint64_t references[2] = {0, 0};
        for (int round = 0; round < 2; round++)
            for (uint32_t first = 0; first + EDGE * EDGE <= s.points; first += EDGE * EDGE) {
                trace(scene, &lights[k], &s, first, EDGE * EDGE, s.got);
                references[round] += s.research.references;
            }
        print_message("light %u: %llu references, then %llu\n", k, (unsigned long long)references[0],
                      (unsigned long long)references[1]);
        fewer += (double)references[1] < 0.99 * (double)references[0];
    }
    assert_true(fewer > 0 || is_slow()); /* small scenes may have too few references for a table */
    cgt_scene_release(scene);
    lit_scene_free(&s);
    cgt_context_release(context);
}

/* Calls of any sizes, lights and orders, one after the other on one scene: the history decides, never the answers. */
static void the_history_changes_no_answer(void **state)
{
    static lit_scene s;
    test_random r = random_make(3);
    (void)state;
    for (uint32_t threads = 1; threads <= 3; threads += 2) {
        cgt_context *context = context_make(threads, NULL);
        lit_scene_make(&r, &s);
        cgt_scene *truth = commit(context, &s, CGT_STRUCTURE_BVH), *scene = commit(context, &s, CGT_STRUCTURE_AUTO);
        for (uint32_t call = 0; call < (is_slow() ? 6u : 24u); call++) {
            cgt_light light = lights[random_below(&r, TEST_COUNT(lights))];
            if (random_below(&r, 4) == 0)
                for (int a = 0; a < 3; a++)
                    light.position[a] = random_float(&r, -1, 1);
            if (random_below(&r, 2))
                scatter(&r, &s);
            else
                lay_in_tiles(&s);
            const uint32_t count = 1 + random_below(&r, random_below(&r, 2) ? s.points : 5000);
            trace(truth, &light, &s, 0, count, s.expected);
            trace(scene, &light, &s, 0, count, s.got);
            assert_memory_equal(s.got, s.expected, count);
            if (random_below(&r, 8) == 0)
                assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        }
        cgt_scene_release(scene);
        cgt_scene_release(truth);
        lit_scene_free(&s);
        cgt_context_release(context);
    }
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(scattered_points_take_no_more_than_a_tree),
        cmocka_unit_test(tiles_that_served_are_remembered),
        cmocka_unit_test(trees_that_paid_are_built_again),
        cmocka_unit_test(tables_of_open_groups_change_no_answer),
        cmocka_unit_test(tables_that_spared_are_remembered),
        cmocka_unit_test(the_history_changes_no_answer),
    };
    test_begin("test_light_choice");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
