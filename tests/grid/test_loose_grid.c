/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The shape of loose grids: cells that follow the axes, levels by size and of crowded regions, requested resolutions;
 * and points on the planes between cells. */
#include "structures/check/structure_check.h"
#include "structures/scenes/loose_scenes.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const test_scene_options loose_options = {.structure = CGT_STRUCTURE_LOOSE_GRID};

static cgt_scene *commit(const loose_scene *s, cgt_context *context)
{
    cgt_scene *scene = loose_add(s, context, SCENE_OPTIONS(&loose_options));
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* Points on the planes between cells and a few ulps off them: rounding puts some of them into the wrong cell, and the
 * reach, which is nothing but rounding error here, must cover that. */
TEST(points_between_cells_are_in_reach)
{
    enum { CELLS = 1024, COUNT = 3 * CELLS };
    static float point[COUNT][4];
    const test_scene_options options = {.structure = CGT_STRUCTURE_LOOSE_GRID, .resolution = {CELLS, 1, 1}};
    test_random r = random_make(9);
    cgt_context *context = context_make(1, NULL);
    uint32_t wrong = 0;
    for (uint32_t round = 0; round < test_scaled(12); round++) {
        const float first = round % 2 ? random_float(&r, -1, 1) : 0, last = first + random_float(&r, 0.01f, 100);
        memset(point, 0, sizeof point);
        for (int i = 0; i < COUNT; i++)
            point[i][0] = i ? last : first;
        cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&options), (const float(*)[4])point, COUNT);
        const cgt_loose_level level = scene->committed_scene.loose.level[0];
        for (int i = 1; i < COUNT - 1; i++) {
            float x = (float)(level.low[0] + (double)(i / 3) * level.cell[0]);
            for (uint32_t steps = random_below(&r, 4); steps; steps--)
                x = nextafterf(x, i % 3 ? INFINITY : -INFINITY);
            point[i][0] = fminf(fmaxf(x, first), last);
        }
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_memory_equal(&scene->committed_scene.loose.level[0], &level, sizeof level);
        assert_int_equal(loose_level_check(&scene->committed_scene, &level), COUNT);
        for (uint32_t c = 0; c < CELLS; c++)
            for (uint32_t i = scene->committed_scene.loose.start[c]; i < scene->committed_scene.loose.start[c + 1];
                 i++) {
                const double g =
                    ((double)point[scene->committed_scene.loose.prim[i]][0] - level.low[0]) / level.cell[0];
                wrong += g < c || g > c + 1.0;
            }
        cgt_scene_release(scene);
    }
    assert_true(wrong > 0);
    cgt_context_release(context);
}

/* ---- shapes of grids ---- */

/* Clusters that stand apart have levels of their own: see below. */
TEST(cells_follow_the_axes)
{
    test_random r = random_make(4);
    cgt_context *context = context_make(1, NULL);
    const uint32_t count = 4000;
    for (int kind = 0; kind <= LOOSE_LINE; kind++) {
        loose_scene s = loose_make(&r, (loose_kind)kind, LOOSE_SPHERES, count);
        cgt_scene *scene = commit(&s, context);
        const cgt_loose_grid *g = &scene->committed_scene.loose;
        const cgt_loose_level *level = &g->level[0];
        assert_int_equal(g->regions > 0, kind == LOOSE_CLUSTERED);
        if (kind == LOOSE_UNIFORM)
            assert_in_range(g->cells, count / 16, count / 4);
        if (kind != LOOSE_CLUSTERED) {
            assert_int_equal(g->levels, 1);
            assert_int_equal(level->size[0] > 1, kind != LOOSE_LINE);
            assert_true(level->size[1] > 1);
            assert_int_equal(level->size[2] > 1, kind == LOOSE_UNIFORM);
        }
        cgt_scene_release(scene);
        loose_free(&s);
    }
    cgt_context_release(context);
}

/* Points along a line, more than one axis has cells for: the other axes get the rest. */
TEST(a_full_axis_leaves_cells_to_the_others)
{
    enum { COUNT = 20000 };
    test_random r = random_make(5);
    float(*sphere)[4] = malloc(COUNT * sizeof *sphere);
    assert_non_null(sphere);
    for (int i = 0; i < COUNT; i++) {
        sphere[i][0] = random_float(&r, 0, 1e6f);
        sphere[i][1] = random_float(&r, 0, 2e3f);
        sphere[i][2] = 0;
        sphere[i][3] = 0;
    }
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&loose_options), (const float(*)[4])sphere, COUNT);
    const cgt_loose_level *level = &scene->committed_scene.loose.level[0];
    assert_int_equal(level->size[0], 1024);
    assert_true(level->size[1] > 1 && scene->committed_scene.loose.cells >= COUNT / 16);
    cgt_scene_release(scene);
    cgt_context_release(context);
    free(sphere);
}

TEST(sizes_share_levels)
{
    enum { COUNT = 900 };
    static float sphere[COUNT][4];
    test_random r = random_make(6);
    cgt_context *context = context_make(1, NULL);
    for (int i = 0; i < COUNT; i++) {
        for (int a = 0; a < 3; a++)
            sphere[i][a] = random_float(&r, -1, 1);
        sphere[i][3] = i < 300 ? 0.3f : i < 600 ? 1e-3f : 1e-30f; /* three sizes, far apart */
    }
    cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&loose_options), (const float(*)[4])sphere, COUNT);
    assert_int_equal(scene->committed_scene.loose.levels, 3);
    cgt_scene_release(scene);
    for (int i = 0; i < COUNT; i++)
        sphere[i][3] = i < 850 ? random_float(&r, 0.3f, 0.59f) : 1e-3f; /* few small spheres: guests */
    scene = scene_of(context, SCENE_OPTIONS(&loose_options), (const float(*)[4])sphere, COUNT);
    assert_int_equal(scene->committed_scene.loose.levels, 1);
    loose_grid_check(scene);
    cgt_scene_release(scene);
    for (int i = 0; i < COUNT; i++)
        sphere[i][3] = ldexpf(1, -4 * (i % 30)); /* more sizes than levels */
    scene = scene_of(context, SCENE_OPTIONS(&loose_options), (const float(*)[4])sphere, COUNT);
    assert_int_equal(scene->committed_scene.loose.levels, CGT_LOOSE_SIZE_LEVELS);
    loose_grid_check(scene);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* How many primitives share a cell, as the mean over all of them. */
static double mean_crowd(const cgt_loose_grid *g, uint32_t valid)
{
    double squares = 0;
    for (uint32_t c = 0; c < g->cells; c++)
        squares += pow((double)g->start[c + 1] - g->start[c], 2);
    return squares / valid;
}

/* Moves spheres of an even cloud far away. */
typedef struct crowded_case {
    const char *name;
    uint32_t clusters; /* which stand apart */
    uint32_t strays;
    float distance;
} crowded_case;

static void move_spheres(const crowded_case *c, test_random *r, float (*sphere)[4], uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++) {
            sphere[i][a] = random_float(r, -1, 1);
            sphere[i][a] += c->clusters && i % c->clusters >> a & 1 ? c->distance : 0;
            sphere[i][a] *= i < c->strays ? c->distance : 1;
        }
    for (uint32_t i = 0; i < count; i++)
        sphere[i][3] = 0.02f;
}

/* A scene whose cells would be crowded, had its grid one size of cells: each crowd gets a level of its own. */
TEST(crowded_regions_get_levels)
{
    enum { COUNT = 3000 };
    static const crowded_case cases[] = {
        {"one stray", 0, 1, 1e3f},
        {"one stray, farther", 0, 1, 1e9f},
        {"one stray, farthest", 0, 1, 1e16f},
        {"many strays", 0, COUNT / 50, 1e5f},
        {"two clusters", 2, 0, 1e4f},
        {"eight clusters", 8, 0, 1e6f},
        {"clusters and strays", 4, 9, 1e5f},
    };
    static float sphere[COUNT][4];
    cgt_context *context = context_make(2, NULL);
    test_random r = random_make(7);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        move_spheres(&cases[i], &r, sphere, COUNT);
        cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&loose_options), (const float(*)[4])sphere, COUNT);
        const cgt_loose_grid *g = &scene->committed_scene.loose;
        scene->is_band = true; /* the farthest would be put apart */
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        loose_grid_check(scene);
        if (!g->regions || mean_crowd(g, COUNT) > 100)
            fail_msg("%s: %u regions, %g primitives share a cell", cases[i].name, g->regions, mean_crowd(g, COUNT));
        cgt_scene_release(scene);
    }
    memset(sphere, 0, sizeof sphere); /* cells cannot tell these apart */
    cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&loose_options), (const float(*)[4])sphere, COUNT);
    scene->is_band = true; /* as small as it is */
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_int_equal(scene->committed_scene.loose.levels, 1);
    loose_grid_check(scene);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

TEST(a_requested_resolution_is_used)
{
    test_random r = random_make(7);
    cgt_context *context = context_make(2, NULL);
    for (int kind = 0; kind < LOOSE_KINDS; kind++) {
        const test_scene_options options = {
            .structure = CGT_STRUCTURE_LOOSE_GRID,
            .resolution = {1 + random_below(&r, 40), 1 + random_below(&r, 40), kind ? 1 + random_below(&r, 9) : 1024}};
        loose_scene s = loose_make(&r, (loose_kind)kind, LOOSE_BOTH, 200);
        cgt_scene *scene = loose_add(&s, context, SCENE_OPTIONS(&options));
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        const cgt_loose_grid *g = &scene->committed_scene.loose;
        assert_int_equal(g->levels, 1);
        assert_memory_equal(g->level[0].size, options.resolution, sizeof options.resolution);
        assert_int_equal(loose_level_check(&scene->committed_scene, &g->level[0]), scene->committed_scene.valid);
        cgt_scene_release(scene);
        loose_free(&s);
    }
    cgt_context_release(context);
}

/* ---- through the interface ---- */

TEST(it_is_used_when_requested)
{
    const float far_off[2][4] = {{0x1p60f, 0, 0, 1}, {0, 0, 0, 1}};
    cgt_context *context = context_make(1, NULL);
    test_scene_options options = {.structure = (cgt_structure)(CGT_STRUCTURE_BIH + 1)};
    cgt_scene *scene = NULL;
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(&options), &scene), CGT_ERROR_INVALID_ARGUMENT);
    scene = scene_of(context, SCENE_OPTIONS(&loose_options), far_off, 2); /* too far for a structure */
    assert_true(scene->committed_scene.brute_force && !scene->committed_scene.loose.levels);
    cgt_scene_release(scene);
    scene = scene_of(context, SCENE_OPTIONS(&loose_options), far_off, 0);
    assert_false(scene->committed_scene.valid || scene->committed_scene.loose.levels);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_loose_grid", NULL, NULL)
