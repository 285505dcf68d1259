/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shadow rays in scenes with one primitive far away, or one that is huge: the others are culled as without it. Work is
 * compared with that of the same scene without such a primitive, and results with those of cgt_occluded_rays. No
 * profile of tests/driver: it bounds work, not hits. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "light/lit_scene.h"
#include "support/suite.h"

#define PRIMS 20000u
#define SIDE 64u
#define POINTS (SIDE * SIDE)

typedef struct intruder {
    const char *name;
    float sphere[4]; /* radius 0: none */
} intruder;

static const intruder intruders[] = {
    {"nothing", {0, 0, 0, 0}},
    {"a particle at 1e3", {1e3f, 0, 0, 0.02f}},
    {"a particle at 1e6", {0, 1e6f, 0, 0.02f}},
    {"a particle at -1e9", {0, 0, -1e9f, 0.02f}},
    {"a ground of radius 1e4", {0, -1e4f - 1, 0, 1e4f}},
    {"a ground of radius 1e7", {0, -1e7f - 2, 0, 1e7f}},
};

static const cgt_light lights[] = {
    {CGT_LIGHT_POINT, {2, 3, -2.5f}},          {CGT_LIGHT_POINT, {0.2f, 0.1f, 0.3f}},
    {CGT_LIGHT_POINT, {20, 30, -25}},          {CGT_LIGHT_POINT, {0.5f, -0.2f, 0.6f}},
    {CGT_LIGHT_DIRECTIONAL, {0.3f, 1, -0.2f}}, {CGT_LIGHT_DIRECTIONAL, {-1, 0.1f, 0.2f}},
};

typedef struct wide_scene {
    float (*sphere)[4];
    float at[3][POINTS];
    uint8_t got[POINTS], expected[POINTS];
} wide_scene;

/* Spheres in the unit cube, the first of which may be replaced. */
static void make_spheres(const intruder *i, wide_scene *w)
{
    test_random r = random_make(77);
    for (uint32_t k = 0; k < PRIMS; k++) {
        for (int a = 0; a < 3; a++)
            w->sphere[k][a] = random_float(&r, -1, 1);
        w->sphere[k][3] = 0.006f;
    }
    if (i->sphere[3] > 0)
        memcpy(w->sphere[0], i->sphere, sizeof i->sphere);
}

/* A sheet of points through the cube, neighbours side by side. */
static void make_points(wide_scene *w)
{
    for (uint32_t i = 0; i < POINTS; i++) {
        const float x = (float)(i % SIDE) / SIDE, y = (float)(i / SIDE) / SIDE;
        w->at[0][i] = 1.6f * x - 0.8f;
        w->at[1][i] = -0.7f + 0.1f * sinf(5 * x);
        w->at[2][i] = 1.6f * y - 0.8f;
    }
}

static cgt_scene *commit(cgt_context *context, const wide_scene *w, cgt_structure structure)
{
    const cgt_spheres spheres = spheres_of((const float(*)[4])w->sphere, PRIMS);
    cgt_scene_options options;
    cgt_scene *scene;
    cgt_scene_options_init(&options);
    options.structure = structure;
    assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

static void find_expected(const cgt_scene *scene, const cgt_light *light, wide_scene *w)
{
    static float dir[3][POINTS], t_max[POINTS];
    const bool is_point = light->kind == CGT_LIGHT_POINT;
    for (uint32_t i = 0; i < POINTS; i++) {
        for (int a = 0; a < 3; a++)
            dir[a][i] = is_point ? light->position[a] - w->at[a][i] : light->position[a];
        t_max[i] = is_point ? 1 : INFINITY;
    }
    const cgt_rays rays = {
        .count = POINTS, .org = {w->at[0], w->at[1], w->at[2]}, .dir = {dir[0], dir[1], dir[2]}, .t_max = t_max};
    assert_int_equal(cgt_occluded_rays(scene, &rays, w->expected, NULL), CGT_OK);
}

static uint64_t trace(const cgt_scene *scene, const cgt_light *light, wide_scene *w, uint32_t *given_up)
{
    const cgt_points points = {.count = POINTS, .position = {w->at[0], w->at[1], w->at[2]}};
    cgt_trace_statistics statistics;
    cgt_trace_options options;
    cgt_trace_options_init(&options);
    options.statistics = &statistics;
    memset(w->got, 7, sizeof w->got);
    assert_int_equal(cgt_occluded_points(scene, light, &points, w->got, &options), CGT_OK);
    assert_memory_equal(w->got, w->expected, POINTS);
    assert_int_equal(statistics.rays, POINTS);
    *given_up += statistics.tiles && statistics.bvh_rays;
    return statistics.ray_tests;
}

/* Tiles give up in some calls. The second call has the BVH that the first may have built. */
static void work_is_that_without(cgt_structure structure, uint64_t factor)
{
    static wide_scene w;
    uint64_t plain[TEST_COUNT(lights)];
    uint32_t given_up = 0;
    cgt_context *context = context_make(2, NULL);
    w.sphere = malloc(PRIMS * sizeof *w.sphere);
    assert_non_null(w.sphere);
    make_points(&w);
    for (uint32_t i = 0; i < TEST_COUNT(intruders); i++) {
        make_spheres(&intruders[i], &w);
        cgt_scene *scene = commit(context, &w, structure), *truth = commit(context, &w, CGT_STRUCTURE_BVH);
        for (uint32_t k = 0; k < TEST_COUNT(lights); k++) {
            find_expected(truth, &lights[k], &w);
            trace(scene, &lights[k], &w, &given_up);
            const uint64_t tests = trace(scene, &lights[k], &w, &given_up);
            plain[k] = i ? plain[k] : tests;
            print_message("structure %d, light %u, %s: %.2f tests a point\n", (int)structure, k, intruders[i].name,
                          (double)tests / POINTS);
            assert_in_range(tests, 0, factor * plain[k] + 96 * POINTS);
        }
        cgt_scene_release(truth);
        cgt_scene_release(scene);
    }
    assert_true(structure != CGT_STRUCTURE_AUTO || given_up || !lit_has_16_lanes(context));
    free(w.sphere);
    cgt_context_release(context);
}

TEST(the_bvh_culls_what_is_near) { work_is_that_without(CGT_STRUCTURE_BVH, 2); }

TEST(the_choice_does_not_follow_the_world) { work_is_that_without(CGT_STRUCTURE_AUTO, 3); }

SEEDED_SUITE("test_light_wide", NULL, NULL)
