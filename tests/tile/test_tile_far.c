/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Things on a floor that is far larger than they are: single precision decides as much of a frame by tiles as on a
 * small floor, since the depth error of a tile follows usual distances. No profile of tests/driver, whose `tiles`
 * judges what such frames show: this bounds what they take. */
#include "support/scenes.h"
#include "support/suite.h"

#include <string.h>

enum { THINGS = 3000, WIDTH = 96, HEIGHT = 72 };

/* What lies on the floor: spheres, sticks or triangles. */
static float sphere[THINGS][4], stick[THINGS][7], vertex[3 * THINGS][3];

static int place_things(void **state)
{
    test_random r = random_make(960);
    (void)state;
    for (uint32_t i = 0; i < THINGS; i++) {
        float place[3];
        for (int a = 0; a < 3; a++)
            place[a] = random_float(&r, -1, 1);
        memcpy(sphere[i], place, sizeof place);
        sphere[i][3] = 0.04f;
        for (int a = 0; a < 3; a++) {
            stick[i][a] = place[a];
            stick[i][3 + a] = place[a] + random_float(&r, -0.1f, 0.1f);
            for (int k = 0; k < 3; k++)
                vertex[3 * i + (uint32_t)k][a] = place[a] + random_float(&r, -0.08f, 0.08f);
        }
        stick[i][6] = 0.02f;
    }
    return 0;
}

/* kind: 0 spheres, 1 sticks, 2 triangles, 3 spheres and sticks. */
static void add_things(cgt_scene *scene, int kind)
{
    const uint32_t count = THINGS;
    const cgt_spheres spheres = spheres_of((const float(*)[4])sphere, count);
    const cgt_capsules sticks = {.count = count,
                                 .vertex_count = count,
                                 .vertices = cgt_floats(stick[0], sizeof stick[0]),
                                 .ends = cgt_floats(stick[0] + 3, sizeof stick[0]),
                                 .radii = cgt_floats(stick[0] + 6, sizeof stick[0])};
    const cgt_triangles triangles = {.count = count, .vertex_count = 3 * count, .vertices = cgt_floats(vertex[0], 0)};
    cgt_result result = CGT_OK;
    if (kind == 0 || kind == 3)
        result = cgt_scene_set_spheres(scene, NULL, &spheres);
    if (result == CGT_OK && (kind == 1 || kind == 3))
        result = cgt_scene_set_capsules(scene, NULL, &sticks);
    if (result == CGT_OK && kind == 2)
        result = cgt_scene_set_triangles(scene, NULL, &triangles);
    assert_int_equal(result, CGT_OK);
}

/* Two triangles, one sphere or one capsule. */
static void add_floor(cgt_scene *scene, int kind, float size)
{
    static float corner[4][3], ball[4], roll[7];
    static const uint32_t corners[6] = {0, 1, 2, 1, 3, 2};
    const cgt_triangles square = {
        .count = 2, .indices = cgt_uint32s(corners, 0), .vertex_count = 4, .vertices = cgt_floats(corner[0], 0)};
    const cgt_spheres below = spheres_of((const float(*)[4])(const void *)ball, 1);
    const cgt_capsules lying = {.count = 1, .vertex_count = 2, .vertices = cgt_floats(roll, 0), .radius = size};
    for (uint32_t k = 0; k < 4; k++) {
        corner[k][0] = k % 2 ? size : -size;
        corner[k][1] = -1.1f;
        corner[k][2] = k / 2 ? size : -size;
    }
    ball[1] = -1.1f - size;
    ball[3] = size;
    roll[0] = -size;
    roll[3] = size;
    roll[1] = roll[4] = -1.1f - size;
    assert_int_equal(kind == 0   ? cgt_scene_set_triangles(scene, NULL, &square)
                     : kind == 1 ? cgt_scene_set_spheres(scene, NULL, &below)
                                 : cgt_scene_set_capsules(scene, NULL, &lying),
                     CGT_OK);
}

/* Returns the tests of a pixel in double precision. */
static double trace(cgt_context *context, int things, int floor, float size, bool parallel)
{
    const cgt_scene_options by_tiles = {.structure = CGT_STRUCTURE_LOOSE_GRID};
    cgt_trace_statistics counts;
    const cgt_trace_options options = {.statistics = &counts};
    cgt_camera camera;
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, &by_tiles, &scene), CGT_OK);
    add_things(scene, things);
    add_floor(scene, floor, size);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    cgt_camera_init(&camera);
    camera.eye[0] = 0.3f;
    camera.eye[1] = 0.5f;
    camera.eye[2] = -2.6f;
    if (parallel) {
        camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
        camera.height = 2.5f;
    }
    planes p = planes_make(WIDTH, HEIGHT);
    frame_trace(scene, &camera, &p, &options);
    planes_free(&p);
    cgt_scene_release(scene);
    return (double)counts.double_tests / (WIDTH * HEIGHT);
}

/* A far floor takes a test in double for each of its pixels, or two where two triangles meet its window. */
TEST(floors_of_any_size_leave_the_rest_alone)
{
    const uint32_t step = test_scaled(10) < 10 ? 10 / test_scaled(10) : 1;
    uint32_t number = 0;
    FOR_EACH_VARIANT(variant)
    {
        if (!variant_is_outer(variant))
            continue;
        cgt_context *context = context_make(1, variant);
        for (int things = 0; things < 4; things++)
            for (int floor = 0; floor < 3; floor++)
                for (int parallel = 0; parallel < 2; parallel++) {
                    if (number++ % step)
                        continue;
                    const double small = trace(context, things, floor, 3, parallel != 0);
                    for (float size = 100; size < 1e13f; size *= 1000) {
                        const double large = trace(context, things, floor, size, parallel != 0);
                        if (large > small + 3)
                            fail_msg("%s, things %d, floor %d of size %g, parallel %d: %.2f tests in double, %.2f on a "
                                     "small one",
                                     variant, things, floor, (double)size, parallel, large, small);
                    }
                }
        cgt_context_release(context);
    }
}

SEEDED_SUITE("test_tile_far", place_things, NULL)
