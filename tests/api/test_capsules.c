/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What structures and calls refuse of capsules, what commits skip, copy and keep. Their hits are those of tests/driver,
 * profile `capsules`. */
#include <cgt/all_hits.h>

#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <string.h>

#define CAPSULES 900u

static const double far_origin[3] = {1e9, -3e8 + 0.1, 7e6};

static cgt_scene *scene_of_capsules(cgt_context *context, const cgt_scene_options *options, const cgt_capsules *q)
{
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_capsules(scene, NULL, q), CGT_OK);
    if (cgt_scene_commit(scene) != CGT_OK)
        fail_msg("%s", context_message(context));
    return scene;
}

static cgt_scene_statistics statistics_of(const cgt_scene *scene)
{
    cgt_scene_statistics s;
    assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
    return s;
}

/* ---- what is refused and skipped ---- */

TEST(crossings_are_refused)
{
    static const float end[2][3] = {{0, 0, 0}, {1, 0, 0}};
    const cgt_capsules q = {.count = 1, .vertex_count = 2, .vertices = cgt_floats(end[0], 0), .radius = 1};
    const cgt_single_ray ray = {.org = {0, 0, 5}, .dir = {0, 0, -1}};
    const cgt_points points = {.count = 1, .position = {&end[0][0], &end[0][1], &end[0][2]}};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of_capsules(context, NULL, &q);
    cgt_hit hit[2];
    uint32_t count = 9;
    uint8_t inside = 9;
    const cgt_all_hits_options crossings = {.crossings = true};
    assert_int_equal(cgt_trace_all_ray(scene, &ray, &crossings, hit, 2, &count, NULL, NULL), CGT_ERROR_UNSUPPORTED);
    assert_non_null(strstr(context_message(context), "capsules"));
    assert_int_equal(cgt_points_inside(scene, &points, NULL, &inside, NULL), CGT_ERROR_UNSUPPORTED);
    assert_true(count == 9 && inside == 9);
    assert_int_equal(cgt_trace_all_ray(scene, &ray, NULL, hit, 2, &count, NULL, NULL), CGT_OK);
    assert_true(count == 2 && hit[0].t == 4 && hit[1].t == 6 && hit[0].surface == CGT_SURFACE_NEAR &&
                hit[1].surface == CGT_SURFACE_FAR && hit[0].normal[2] == 1 && hit[1].normal[2] == -1);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

static void expect_refusal(cgt_scene *scene, cgt_context *context, cgt_result result, const char *word)
{
    assert_int_equal(cgt_scene_commit(scene), result);
    if (!strstr(context_message(context), word))
        fail_msg("\"%s\" does not mention %s", context_message(context), word);
}

TEST(structures_without_capsules)
{
    static const float end[2][3] = {{0, 0, 0}, {1, 0, 0}};
    const cgt_capsules q = {.count = 1, .vertex_count = 2, .vertices = cgt_floats(end[0], 0), .radius = 1};
    cgt_context *context = context_make(1, NULL);
    for (uint32_t k = 0; k < TEST_STRUCTURES; k++) {
        const cgt_scene_options options = structure_in_turn(k);
        const bool holds =
            options.structure == CGT_STRUCTURE_BVH || options.structure == CGT_STRUCTURE_LOOSE_GRID ||
            (options.structure == CGT_STRUCTURE_AUTO && (!options.research || !options.research->resolution[0]));
        cgt_scene *scene;
        assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
        assert_int_equal(cgt_scene_set_capsules(scene, NULL, &q), CGT_OK);
        if (holds)
            assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        else
            expect_refusal(scene, context, CGT_ERROR_UNSUPPORTED, "1 capsules");
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

TEST(triangle_tests_are_refused)
{
    static const float end[2][3] = {{0, 0, 0}, {1, 0, 0}};
    const cgt_capsules q = {.count = 1, .vertex_count = 2, .vertices = cgt_floats(end[0], 0), .radius = 1};
    static float t[16], normal[3][16];
    const cgt_frame frame = {.width = 4, .height = 4, .t = t, .normal = {normal[0], normal[1], normal[2]}};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of_capsules(context, NULL, &q);
    cgt_research_trace_options research = {.triangle_test = CGT_TRIANGLE_TEST_ACCELERATED};
    const cgt_trace_options options = {.precision = CGT_PRECISION_FAST, .research = &research};
    assert_int_equal(cgt_trace_camera(scene, &(cgt_camera){0}, &frame, &options), CGT_ERROR_UNSUPPORTED);
    assert_non_null(strstr(context_message(context), "capsules"));
    research.triangle_test = CGT_TRIANGLE_TEST_AUTO;
    assert_int_equal(cgt_trace_camera(scene, &(cgt_camera){0}, &frame, &options), CGT_OK);
    assert_true(t[10] > 3.9f && t[10] < 4.2f);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

TEST(skipped_capsules_are_counted)
{
    static const float end[8][3] = {{0, 0, 0}, {1, 0, 0},        {NAN, 0, 0}, {0, 0, 0},
                                    {0, 0, 0}, {0, INFINITY, 0}, {5, 0, 0},   {6, 0, 0}};
    static const float radius[4] = {1, 1, 1, -1};
    const cgt_capsules q = {
        .count = 4, .vertex_count = 8, .vertices = cgt_floats(end[0], 0), .radii = cgt_floats(radius, 0)};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of_capsules(context, NULL, &q);
    const cgt_scene_statistics s = statistics_of(scene);
    assert_true(s.skipped_not_finite == 2 && s.skipped_radius == 1 && s.skipped_degenerate == 0);
    for (int a = 0; a < 3; a++) {
        assert_true(s.bounds_min[a] <= -1 && s.bounds_min[a] > -1.001f);
        assert_true(s.bounds_max[a] >= (a ? 1 : 2) && s.bounds_max[a] < (a ? 1 : 2) + 0.001f);
    }
    const ray_hit hit = ray_trace(scene, (truth_ray){{0.5f, 0, 5}, {0, 0, -1}, 0, INFINITY});
    assert_true(hit.t == 4 && hit.primitive == 0);
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){0}, &(cgt_spheres){0}), CGT_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(context_message(context), "geometry 0 is one of capsules"));
    assert_int_equal(cgt_scene_set_capsules(scene, &(uint32_t){0}, &(cgt_capsules){0}), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK); /* nothing is left */
    assert_int_equal(ray_trace(scene, (truth_ray){{0.5f, 0, 5}, {0, 0, -1}, 0, INFINITY}).primitive, CGT_INVALID_ID);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* ---- what is copied and kept ---- */

/* Ends side by side, or by indices, are read in place; two arrays of ends, types and doubles are copied. */
TEST(arrays_are_read_in_place)
{
    static const float end[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, radii[2] = {0.5f, 0.25f};
    static const uint32_t index[2][2] = {{3, 1}, {0, 2}}, type[2] = {1, 0};
    const cgt_capsules side_by_side = {
        .count = 2, .vertex_count = 4, .vertices = cgt_floats(end[0], 0), .radii = cgt_floats(radii, 0)};
    cgt_capsules form[4] = {side_by_side, side_by_side, side_by_side, side_by_side};
    cgt_context *context = context_make(1, NULL);
    form[1].indices = cgt_uint32s(index[0], 0);
    form[2].ends = cgt_floats(end[2], 0), form[2].vertex_count = 2;
    form[3].types = cgt_uint32s(type, 0), form[3].type_count = 2;
    for (uint32_t k = 0; k < 4; k++) {
        cgt_scene *scene = scene_of_capsules(context, NULL, &form[k]);
        const cgt_scene_statistics s = statistics_of(scene);
        assert_true(s.capsules == 2 && s.primitives == 2 && !s.spheres && !s.triangles);
        assert_int_equal(s.copied_bytes, k < 2 ? 0 : 2 * 32);
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

/* Frame after frame nothing is allocated, and AUTO keeps the grid. */
TEST(capsules_move)
{
    static double end[2][CAPSULES][3], radius[CAPSULES];
    unsigned allocations = 0;
    test_random r = random_make(11);
    cgt_context *context = context_counting(&allocations);
    const float sphere[1][4] = {{0, 0, 0, 1}};
    const cgt_spheres spheres = spheres_of(sphere, 1);
    cgt_capsules q = {.count = CAPSULES,
                      .vertex_count = CAPSULES,
                      .vertices = cgt_doubles(end[0][0], 0),
                      .ends = cgt_doubles(end[1][0], 0),
                      .radii = cgt_doubles(radius, 0)};
    memcpy(q.origin, far_origin, sizeof q.origin);
    for (uint32_t i = 0; i < CAPSULES; i++) {
        radius[i] = (double)random_float(&r, 0.02f, 0.2f);
        for (int k = 0; k < 2; k++)
            for (int a = 0; a < 3; a++)
                end[k][i][a] = far_origin[a] + (double)random_float(&r, -3, 3);
    }
    cgt_scene *scene = scene_of_capsules(context, NULL, &q);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    for (int frame = 0; frame < 4; frame++) {
        const unsigned before = allocations;
        for (uint32_t i = 0; i < CAPSULES; i++)
            end[frame % 2][i][frame % 3] += 0.01;
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_true(frame < 2 || allocations == before);
        assert_int_equal(statistics_of(scene).structure, CGT_STRUCTURE_LOOSE_GRID);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* Capsules whose axis is nothing beside the camera's distance: what says where that is on the screen underflows. */
TEST(axes_of_denormal_length)
{
    enum { WIDTH = 64, HEIGHT = 4 };
    static const float end[2][3] = {{0, 0x1p-128f, 0}, {0x1p-127f, 0, 0x1p-130f}};
    static float t[WIDTH * HEIGHT];
    cgt_camera camera;
    cgt_frame frame;
    cgt_camera_init(&camera);
    camera.eye[2] = 500;
    camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    camera.height = 16;
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame.t = t;
    FOR_EACH_VARIANT(variant)
    for (int outside = 0; outside < 2; outside++) {
        cgt_context *context = context_make(1, variant);
        const cgt_capsules q = {.count = 1,
                                .vertex_count = 1,
                                .vertices = cgt_floats(end[0], 0),
                                .ends = cgt_floats(end[1], 0),
                                .radius = outside ? 400.0f : 0x1p24f};
        cgt_scene *scene = scene_of_capsules(context, NULL, &q);
        assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_OK);
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
            cgt_single_ray ray = {.t_max = INFINITY};
            cgt_hit hit;
            float *const org[3] = {&ray.org[0], &ray.org[1], &ray.org[2]};
            float *const dir[3] = {&ray.dir[0], &ray.dir[1], &ray.dir[2]};
            assert_int_equal(cgt_camera_get_rays(&camera, WIDTH, HEIGHT, i % WIDTH, i / WIDTH, 1, 1, 0, org, dir),
                             CGT_OK);
            assert_int_equal(cgt_trace_ray(scene, &ray, &hit, NULL), CGT_OK);
            assert_true(hit.t < INFINITY && same_bits(hit.t, t[i]));
        }
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* Far longer radii than axes, whose squares underflow beside them: a light in such a capsule is hidden outside. */
TEST(lights_in_thick_capsules)
{
    enum { POINTS = 100 };
    static const float end[2][2][3] = {{{0, 0, 0}, {0, 0, 0}}, {{64, 0x1p-19f, 0}, {1, 0, 0}}};
    static const float radius[2] = {0x1.4p110f, 0.5f};
    static float place[3][POINTS];
    const cgt_capsules q = {.count = 2,
                            .vertex_count = 2,
                            .vertices = cgt_floats(end[0][0], 0),
                            .ends = cgt_floats(end[1][0], 0),
                            .radii = cgt_floats(radius, 0)};
    const cgt_light light = {.kind = CGT_LIGHT_POINT, .position = {0x1.8p109f, 0x1.2p109f, 0x1p109f}};
    const cgt_points points = {.count = POINTS, .position = {place[0], place[1], place[2]}};
    const cgt_scene_options options = {.structure = CGT_STRUCTURE_LOOSE_GRID};
    for (uint32_t i = 0; i < POINTS; i++) {
        place[0][i] = 0x1.3p111f * (1 + 1e-5f * (float)i);
        place[1][i] = -0x1p112f;
        place[2][i] = 0x1.6p109f;
    }
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = scene_of_capsules(context, &options, &q);
        uint8_t occluded[POINTS] = {0};
        assert_int_equal(cgt_occluded_points(scene, &light, &points, occluded, NULL), CGT_OK);
        for (uint32_t i = 0; i < POINTS; i++)
            assert_int_equal(occluded[i], 1);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

SEEDED_SUITE("test_capsules", NULL, NULL)
