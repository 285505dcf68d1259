/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes: checks of arguments, ids of geometries, what uncommits a scene, arrays of every layout, skipped spheres, and
 * the statistics. */
#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static cgt_context *context;

static const float one[1][4] = {{0, 0, 0, 1}};
static const truth_ray ahead = {{0, 0, 5}, {0, 0, -1}, 0, INFINITY};

static int open_context(void **state)
{
    (void)state;
    context = context_make(2, NULL);
    return 0;
}

static int close_context(void **state)
{
    (void)state;
    cgt_context_release(context);
    return 0;
}

static cgt_scene *empty_scene(void)
{
    cgt_scene *scene = NULL;
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    return scene;
}

static uint32_t add(cgt_scene *scene, cgt_spheres spheres)
{
    uint32_t geometry = CGT_INVALID_ID;
    assert_int_equal(cgt_scene_set_spheres(scene, &geometry, &spheres), CGT_OK);
    return geometry;
}

/* ---- arguments ---- */

TEST(huge_counts_do_not_wrap)
{
    cgt_scene *scene = empty_scene();
    cgt_spheres huge = spheres_of(one, 1u << 31);
    uint32_t geometry = CGT_INVALID_ID;
    assert_int_equal(add(scene, huge), 0); /* not read before the commit */
    assert_int_equal(cgt_scene_set_spheres(scene, &geometry, &huge), CGT_ERROR_TOO_LARGE);
    huge.count = (1u << 31) - 1; /* 2^32 - 1 in all */
    assert_int_equal(cgt_scene_set_spheres(scene, &geometry, &huge), CGT_ERROR_TOO_LARGE);
    huge.count--;
    assert_int_equal(add(scene, huge), 1);
    /* what is updated or removed makes room, once */
    huge.count -= 5;
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){1}, &huge), CGT_OK);
    assert_int_equal(add(scene, spheres_of(one, 5)), 2);
    huge.count = 1;
    assert_int_equal(cgt_scene_set_spheres(scene, &geometry, &huge), CGT_ERROR_TOO_LARGE);
    assert_int_equal(cgt_scene_remove_geometry(scene, 0), CGT_OK);
    assert_int_equal(cgt_scene_remove_geometry(scene, 0), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(add(scene, spheres_of(one, 1u << 31)), 0);
    assert_int_equal(cgt_scene_set_spheres(scene, &geometry, &huge), CGT_ERROR_TOO_LARGE);
    cgt_scene_release(scene);
}

/* ---- ids and commits ---- */

TEST(the_lowest_free_id_is_assigned)
{
    cgt_scene *scene = empty_scene();
    float spheres[6][1][4];
    for (int i = 0; i < 6; i++) {
        spheres[i][0][0] = spheres[i][0][1] = 0;
        spheres[i][0][2] = -10.f * (float)i;
        spheres[i][0][3] = 1;
        assert_int_equal(add(scene, spheres_of((const float(*)[4])spheres[i], 1)), i);
    }
    assert_int_equal(cgt_scene_remove_geometry(scene, 3), CGT_OK);
    assert_int_equal(cgt_scene_remove_geometry(scene, 1), CGT_OK);
    assert_int_equal(cgt_scene_remove_geometry(scene, 0), CGT_OK);
    assert_int_equal(cgt_scene_remove_geometry(scene, 0), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_scene_remove_geometry(scene, 6), CGT_ERROR_INVALID_ARGUMENT);
    const cgt_spheres first = spheres_of((const float(*)[4])spheres[0], 1);
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){1}, &first), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    ray_hit hit = ray_trace(scene, ahead);
    assert_true(hit.geometry == 2 && hit.primitive == 0 && hit.t == 24);
    assert_int_equal(add(scene, spheres_of((const float(*)[4])spheres[1], 1)), 0);
    assert_int_equal(add(scene, spheres_of((const float(*)[4])spheres[0], 1)), 1);
    assert_int_equal(add(scene, spheres_of(NULL, 0)), 3);
    assert_int_equal(add(scene, spheres_of(NULL, 0)), 6);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    hit = ray_trace(scene, ahead);
    assert_true(hit.geometry == 1 && hit.t == 4);
    cgt_scene_statistics statistics;
    assert_int_equal(cgt_scene_get_statistics(scene, &statistics), CGT_OK);
    assert_int_equal(statistics.geometries, 7);
    assert_int_equal(statistics.primitives, 5);
    cgt_scene_release(scene);
}

/* Each kind has its numbers; a vertex that no triangle uses may have any value. */
TEST(a_geometry_keeps_its_kind)
{
    static const float vertex[5][3] = {{-1, -1, 0}, {NAN, NAN, NAN}, {1, -1, 0}, {INFINITY, 0, 0}, {0, 1, 0}};
    static const uint32_t index[3] = {0, 2, 4};
    const cgt_triangles triangles = {
        .count = 1, .indices = cgt_uint32s(index, 0), .vertex_count = 5, .vertices = cgt_floats(vertex[0], 0)};
    const cgt_spheres spheres = spheres_of(one, 1);
    cgt_scene *scene = empty_scene();
    cgt_scene_statistics s;
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    assert_int_equal(add(scene, spheres), 1);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
    assert_true(s.spheres == 1 && s.triangles == 1 && s.primitives == 2 && s.skipped_not_finite == 0);
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){0}, &spheres), CGT_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(context_message(context), "geometry 0 is one of triangles"));
    assert_int_equal(cgt_scene_set_triangles(scene, &(uint32_t){1}, &triangles), CGT_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(context_message(context), "geometry 1 is one of spheres"));
    assert_true(ray_trace(scene, ahead).t == 4); /* it is still committed */
    assert_int_equal(cgt_scene_remove_geometry(scene, 1), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK); /* the id is free for either kind */
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    const ray_hit hit = ray_trace(scene, ahead);
    assert_true(hit.geometry == 0 && hit.primitive == 0 && hit.t == 5);
    cgt_scene_release(scene);
}

static void expect_not_committed(const cgt_scene *scene)
{
    ray_hit hit;
    uint8_t occluded = 9;
    float t = 9;
    cgt_camera camera;
    cgt_frame frame;
    const cgt_rays rays = ray_array(&ahead, 1);
    const cgt_hits hits = hits_of(&hit);
    cgt_camera_init(&camera);
    cgt_frame_init(&frame, 1, 1);
    frame.t = &t;
    hit.t = 9;
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_ERROR_NOT_COMMITTED);
    assert_int_equal(cgt_occluded_rays(scene, &rays, &occluded, NULL), CGT_ERROR_NOT_COMMITTED);
    assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_ERROR_NOT_COMMITTED);
    assert_true(hit.t == 9 && occluded == 9 && t == 9);
    assert_non_null(strstr(context_message(context), "committed"));
}

TEST(changes_require_a_commit)
{
    float moving[1][4] = {{0, 0, 0, 1}};
    cgt_scene *scene = empty_scene();
    expect_not_committed(scene);
    const cgt_spheres spheres = spheres_of((const float(*)[4])moving, 1);
    add(scene, spheres);
    expect_not_committed(scene);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_true(ray_trace(scene, ahead).t == 4);
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){0}, &spheres), CGT_OK);
    expect_not_committed(scene);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    moving[0][2] = -2; /* only data changes: a commit suffices */
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_true(ray_trace(scene, ahead).t == 6);
    assert_int_equal(cgt_scene_remove_geometry(scene, 0), CGT_OK);
    expect_not_committed(scene);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_true(ray_trace(scene, ahead).t == INFINITY);
    cgt_scene_release(scene);
}

TEST(options_take_effect_at_the_next_commit)
{
    cgt_scene *scene = scene_of(context, NULL, one, 1);
    test_scene_options options = {0};
    options.resolution[0] = 3;
    options.resolution[1] = 5;
    options.resolution[2] = 7;
    assert_int_equal(cgt_scene_set_options(scene, SCENE_OPTIONS(&options)), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    const cgt_research_scene_statistics research = research_of(scene);
    assert_memory_equal(research.resolution, options.resolution, sizeof options.resolution);
    assert_int_equal(research.cells, 105);
    assert_true(ray_trace(scene, ahead).t == 4);
    cgt_scene_release(scene);
}

TEST(empty_scenes_are_valid)
{
    const float skipped[2][4] = {{NAN, 0, 0, 1}, {0, 0, 0, -1}};
    cgt_scene_statistics s;
    cgt_scene *scene = empty_scene();
    assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
    assert_int_equal(s.structure, CGT_STRUCTURE_AUTO);
    for (int round = 0; round < 3; round++) {
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
        assert_true(research_of(scene).references == 0 && research_of(scene).overflow_references == 0 &&
                    s.primitives == (round == 2 ? 2 : 0));
        for (int a = 0; a < 3; a++)
            assert_true(s.bounds_min[a] == 0 && s.bounds_max[a] == 0);
        const ray_hit hit = ray_trace(scene, ahead);
        assert_true(hit.t == INFINITY && hit.primitive == CGT_INVALID_ID && hit.geometry == CGT_INVALID_ID);
        assert_true(hit.normal[0] == 0 && hit.normal[1] == 0 && hit.normal[2] == 0);
        planes p = planes_make(70, 5);
        cgt_camera camera;
        cgt_camera_init(&camera);
        frame_trace(scene, &camera, &p, NULL);
        for (size_t i = 0; i < p.elements; i++)
            assert_true(p.t[i] == INFINITY && p.primitive[i] == CGT_INVALID_ID);
        planes_free(&p);
        add(scene, round == 0 ? spheres_of(NULL, 0) : spheres_of(skipped, 2));
    }
    cgt_scene_release(scene);
}

/* ---- arrays and numbers ---- */

TEST(arrays_of_any_shape_are_read)
{
    enum { N = 300 };
    test_random r = random_make(1);
    struct atom {
        char name[4];
        float velocity[3], r, p[3];
    } atom[N];
    float packed[N][3], radii[N], alike[N][4];
    for (int i = 0; i < N; i++) {
        for (int a = 0; a < 3; a++)
            alike[i][a] = atom[i].p[a] = packed[i][a] = random_float(&r, -5, 5);
        alike[i][3] = atom[i].r = radii[i] = random_float(&r, 0.1f, 0.5f);
    }
    const cgt_spheres shape[] = {
        spheres_of((const float(*)[4])alike, N),
        {.count = N, .centers = cgt_floats(packed[0], 0), .radii = cgt_floats(radii, 0)},
        {.count = N, .centers = cgt_floats(atom[0].p, sizeof atom[0]), .radii = cgt_floats(&atom[0].r, sizeof atom[0])},
        {.count = N, .centers = cgt_floats(atom[0].p, sizeof atom[0]), .radii = cgt_floats(radii, 4)}};
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.eye[2] = 20;
    planes expected = planes_make(64, 64), p = planes_make(64, 64);
    for (size_t i = 0; i < TEST_COUNT(shape); i++) {
        cgt_scene *scene = empty_scene();
        add(scene, shape[i]);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        frame_trace(scene, &camera, i ? &p : &expected, NULL);
        assert_true(i == 0 || planes_equal(&p, &expected));
        cgt_scene_release(scene);
    }
    for (int i = 0; i < N; i++)
        alike[i][3] = 0.25f;
    cgt_scene *scene = empty_scene();
    add(scene, shape[0]);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    frame_trace(scene, &camera, &expected, NULL);
    const cgt_spheres shared = {.count = N, .centers = cgt_floats(packed[0], 0), .radius = 0.25f};
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){0}, &shared), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    frame_trace(scene, &camera, &p, NULL);
    assert_true(planes_equal(&p, &expected));
    cgt_scene_release(scene);
    planes_free(&p);
    planes_free(&expected);
}

TEST(bad_spheres_are_skipped_and_counted)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    test_random r = random_make(2);
    enum { N = 200 };
    float sphere[N][4];
    uint32_t not_finite = 0, negative = 0;
    for (int i = 0; i < N; i++) {
        for (int a = 0; a < 3; a++)
            sphere[i][a] = random_float(&r, -5, 5);
        sphere[i][3] = i % 50 == 0 ? -0.f : random_float(&r, 0.2f, 0.9f);
        if (i % 4 == 1)
            sphere[i][random_below(&r, 4)] = bad[random_below(&r, 3)], not_finite++;
        if (i % 4 == 3)
            sphere[i][3] = i % 8 == 3 ? -sphere[i][3] : -0x1p-149f, negative++;
        if (i % 16 == 5)
            sphere[i][3] = -1, sphere[i][0] = NAN; /* counted as not finite */
    }
    cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])sphere, N);
    cgt_scene_statistics s;
    assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
    assert_int_equal(s.primitives, N);
    assert_int_equal(s.skipped_not_finite, not_finite);
    assert_int_equal(s.skipped_radius, negative);
    for (int a = 0; a < 3; a++)
        assert_true(s.bounds_min[a] > -6 && s.bounds_max[a] < 6);
    for (int i = 0; i < N; i += 2)
        for (int a = 0; a < 3; a++) {
            assert_true((double)sphere[i][a] - sphere[i][3] >= s.bounds_min[a]);
            assert_true((double)sphere[i][a] + sphere[i][3] <= s.bounds_max[a]);
        }
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.eye[2] = 15;
    planes p = planes_make(80, 60);
    truth_ray *rays = frame_rays(&camera, 80, 60);
    frame_trace(scene, &camera, &p, NULL);
    frame_judge(&p, rays, (const float(*)[4])sphere, N); /* ids include skipped spheres */
    free(rays);
    planes_free(&p);
    cgt_scene_release(scene);
}

SEEDED_SUITE("test_scene", open_context, close_context)
