/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Zero is the right default of every field: {0}, the init function and NULL give the same bits and do the same work. */
#include <cgt/all_hits.h>

#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WIDTH 130
#define HEIGHT 70
#define PIXELS (WIDTH * HEIGHT)

static cgt_context *context;
static cgt_scene *scene;
static cloud spheres;

static int set_up(void **state)
{
    (void)state;
    test_random r = random_make(1);
    context = context_make(1, NULL);
    spheres = cloud_make(&r, CLOUD_UNIFORM, 3000);
    for (uint32_t i = 0; i < spheres.count; i++) { /* in the default view */
        for (int a = 0; a < 3; a++)
            spheres.sphere[i][a] = random_float(&r, -1, 1);
        spheres.sphere[i][3] = 0.03f;
    }
    scene = scene_of(context, NULL, (const float(*)[4])spheres.sphere, spheres.count);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    cgt_scene_release(scene);
    cgt_context_release(context);
    cloud_free(&spheres);
    return 0;
}

/* The work of a call: all of its counters except the time. */
typedef struct work {
    cgt_trace_statistics trace;
    cgt_research_trace_statistics research;
} work;

static void forget_time(work *w) { w->trace.trace_ms = 0; }

static planes trace(const cgt_camera *camera, const cgt_trace_options *options)
{
    planes p = planes_make(WIDTH, HEIGHT);
    frame_trace(scene, camera, &p, options);
    return p;
}

/* ---- options ---- */

TEST(contexts)
{
    cgt_context_options initialised;
    cgt_context *made[3];
    memset(&initialised, 0x55, sizeof initialised);
    cgt_context_options_init(&initialised);
    assert_int_equal(cgt_context_create(NULL, &made[0]), CGT_OK);
    assert_int_equal(cgt_context_create(&(cgt_context_options){0}, &made[1]), CGT_OK);
    assert_int_equal(cgt_context_create(&initialised, &made[2]), CGT_OK);
    for (int k = 0; k < 3; k++) {
        assert_string_equal(cgt_context_get_variant(made[k]), cgt_context_get_variant(made[0]));
        assert_int_equal(cgt_context_get_threads(made[k]), cgt_context_get_threads(made[0]));
    }
    for (int k = 0; k < 3; k++)
        cgt_context_release(made[k]);
}

TEST(scene_options)
{
    const cgt_research_scene_options zero = {0};
    cgt_research_scene_options research;
    cgt_scene_options initialised;
    memset(&research, 0x55, sizeof research);
    memset(&initialised, 0x55, sizeof initialised);
    cgt_research_scene_options_init(&research);
    cgt_scene_options_init(&initialised);
    const cgt_scene_options with_zero = {.research = &zero}, with_init = {.research = &research}, none = {0};
    const cgt_scene_options *const options[] = {NULL, &none, &initialised, &with_zero, &with_init};
    for (size_t k = 0; k < TEST_COUNT(options); k++) {
        cgt_scene *made = scene_of(context, options[k], (const float(*)[4])spheres.sphere, spheres.count);
        cgt_scene_statistics st;
        const cgt_research_scene_statistics got = research_of(made), expected = research_of(scene);
        assert_int_equal(cgt_scene_get_statistics(made, &st), CGT_OK);
        assert_int_equal(st.structure, CGT_STRUCTURE_LOOSE_GRID);
        assert_int_equal(got.cells, expected.cells);
        assert_memory_equal(got.resolution, expected.resolution, sizeof got.resolution);
        cgt_scene_release(made);
    }
}

TEST(trace_options)
{
    const cgt_research_trace_options zero = {0};
    cgt_research_trace_options research;
    cgt_trace_options initialised;
    cgt_camera camera;
    work expected, got;
    memset(&research, 0x55, sizeof research);
    memset(&initialised, 0x55, sizeof initialised);
    cgt_research_trace_options_init(&research);
    cgt_trace_options_init(&initialised);
    cgt_camera_init(&camera);
    assert_memory_equal(&research, &zero, sizeof zero);
    assert_true(!initialised.statistics && !initialised.research && initialised.precision == CGT_PRECISION_EXACT);
    research.statistics = &expected.research;
    initialised.statistics = &expected.trace;
    initialised.research = &research;
    planes plain = trace(&camera, NULL), counted = trace(&camera, &initialised);
    forget_time(&expected);
    assert_true(planes_equal(&plain, &counted));
    assert_int_equal(expected.trace.tiles, 3 * 2);
    assert_int_equal(expected.trace.packets, 0);
    for (int k = 0; k < 2; k++) { /* each statistics struct without the other */
        const cgt_research_trace_options r = {.statistics = k ? &got.research : NULL};
        const cgt_trace_options o = {.statistics = k ? NULL : &got.trace, .research = k ? &r : NULL};
        planes p = trace(&camera, &o);
        if (!k)
            forget_time(&got);
        assert_true(planes_equal(&plain, &p));
        planes_free(&p);
    }
    assert_memory_equal(&got.trace, &expected.trace, sizeof got.trace);
    assert_memory_equal(&got.research, &expected.research,
                        offsetof(cgt_research_trace_statistics, loop) + sizeof(cgt_loop));
    planes_free(&plain);
    planes_free(&counted);
}

TEST(all_hits_options)
{
    static const float org[3] = {0, 0, 5}, dir[3] = {0.1f, 0, -1};
    const cgt_rays rays = {.count = 1, .org = {&org[0], &org[1], &org[2]}, .dir = {&dir[0], &dir[1], &dir[2]}};
    cgt_all_hits_options initialised;
    memset(&initialised, 0x55, sizeof initialised);
    cgt_all_hits_options_init(&initialised);
    const cgt_all_hits_options *const options[] = {NULL, &(cgt_all_hits_options){0}, &initialised};
    uint32_t primitive[3][4] = {{0}}, count;
    for (int k = 0; k < 3; k++) {
        const cgt_hit_rows rows = {.capacity = 4, .hits = {.primitive = primitive[k]}, .count = &count};
        assert_int_equal(cgt_trace_all_rays(scene, &rays, options[k], &rows, NULL), CGT_OK);
        assert_int_equal(count, 2);
        assert_memory_equal(primitive[k], primitive[0], sizeof primitive[0]);
        assert_int_equal(primitive[k][0], primitive[k][1]); /* a sphere, in and out */
    }
}

TEST(inside_options)
{
    cgt_inside_options initialised;
    memset(&initialised, 0x55, sizeof initialised);
    cgt_inside_options_init(&initialised);
    assert_int_equal(initialised.rule, (cgt_inside_options){0}.rule);
}

/* ---- cameras ---- */

TEST(cameras)
{
    for (int k = 0; k < 2; k++) {
        const cgt_projection projection = k ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
        cgt_camera initialised, zero = {.projection = projection};
        memset(&initialised, 0x55, sizeof initialised);
        cgt_camera_init(&initialised);
        initialised.projection = projection;
        planes expected = trace(&initialised, NULL), got = trace(&zero, NULL);
        uint32_t hits = 0;
        for (uint32_t i = 0; i < PIXELS; i++)
            hits += expected.primitive[i] != CGT_INVALID_ID;
        assert_true(hits > PIXELS / 10 && hits < PIXELS);
        assert_true(planes_equal(&expected, &got));
        planes_free(&got);
        /* one field at a time */
        for (int field = 0; field < 5; field++) {
            cgt_camera c = initialised;
            if (field == 0)
                c.fov = field;
            if (field == 1)
                c.height = -0.f;
            if (field == 2)
                c.t_max = 0;
            if (field == 3)
                c.up[1] = 0;
            if (field == 4)
                c.mask = 0;
            got = trace(&c, NULL);
            assert_true(planes_equal(&expected, &got));
            planes_free(&got);
        }
        planes_free(&expected);
    }
}

/* A camera with any field set is not the default view: its eye is the origin. */
TEST(cameras_at_the_origin)
{
    cgt_camera looks_ahead = {.target = {0, 0, -1}}, explicit_up = {.target = {0, 0, -1}, .up = {0, 1, 0}};
    planes expected = trace(&explicit_up, NULL), got = trace(&looks_ahead, NULL);
    assert_true(planes_equal(&expected, &got));
    planes_free(&expected);
    planes_free(&got);
    float t;
    const cgt_camera looks_nowhere[] = {{.up = {0, 1, 0}}, {.eye = {1, 1, 1}, .target = {1, 1, 1}}};
    const cgt_frame frame = {.width = 1, .height = 1, .t = &t};
    for (size_t k = 0; k < TEST_COUNT(looks_nowhere); k++)
        assert_int_equal(cgt_trace_camera(scene, &looks_nowhere[k], &frame, NULL), CGT_ERROR_INVALID_ARGUMENT);
}

TEST(frames)
{
    cgt_frame initialised;
    const cgt_frame expected = {.width = 3, .height = 5};
    memset(&initialised, 0, sizeof initialised); /* padding */
    float t[15];
    cgt_frame_init(&initialised, 3, 5);
    assert_memory_equal(&initialised, &expected, sizeof expected);
    initialised.t = t;
    assert_int_equal(cgt_trace_camera(scene, &(cgt_camera){0}, &initialised, NULL), CGT_OK);
}

TEST(ambient_options)
{
    static float visibility[4][PIXELS];
    cgt_ambient_options initialised;
    const cgt_ambient_options zero = {0}, explicit_defaults = {.samples = 16, .radius = INFINITY};
    const cgt_ambient_options *const options[] = {&explicit_defaults, NULL, &zero, &initialised};
    const cgt_camera camera = {0};
    planes p = trace(&camera, NULL);
    const cgt_frame frame = frame_of(&p);
    cgt_ambient_options_init(&initialised);
    for (size_t k = 0; k < TEST_COUNT(options); k++)
        assert_int_equal(cgt_ambient_occlusion(scene, &camera, &frame, options[k], visibility[k], NULL), CGT_OK);
    for (size_t k = 1; k < TEST_COUNT(options); k++)
        assert_memory_equal(visibility[k], visibility[0], sizeof visibility[0]);
    planes_free(&p);
}

/* ---- arrays ---- */

/* A mask of 0 stands for all bits, for rays and points, with any geometry mask. To disable a ray, give it an empty
 * range. */
TEST(masks)
{
    static const uint32_t geometry_mask[] = {0, 1, 0x80000000u};
    const float at[3] = {0, 0, 5}, dir[3] = {0, 0, -1}, off = -1;
    for (uint32_t number = 0; number < TEST_STRUCTURES * TEST_COUNT(geometry_mask); number++) {
        const float sphere[1][4] = {{0, 0, 0, 1}};
        const cgt_scene_options made = structure_in_turn(number);
        cgt_scene *ball = scene_of(context, &made, sphere, 1);
        cgt_spheres masked = spheres_of(sphere, 1);
        masked.mask = geometry_mask[number / TEST_STRUCTURES];
        assert_int_equal(cgt_scene_set_spheres(ball, &(uint32_t){0}, &masked), CGT_OK);
        assert_int_equal(cgt_scene_commit(ball), CGT_OK);
        const uint32_t zero = 0, other = 2;
        cgt_rays rays = {.count = 1, .org = {&at[0], &at[1], &at[2]}, .dir = {&dir[0], &dir[1], &dir[2]}};
        cgt_points points = {.count = 1, .position = {&at[0], &at[1], &at[2]}};
        const cgt_light light = {.position = {0, 0, -5}};
        const cgt_camera camera = {.mask = 0};
        for (int k = 0; k < 4; k++) {
            float t = 7;
            uint8_t by_ray = 7, by_point = 7;
            rays.mask = points.mask = k == 0 ? NULL : k == 2 ? &other : &zero;
            rays.t_max = points.t_max = k == 3 ? &off : NULL;
            const bool hit = k < 2 || (k == 2 && !masked.mask);
            const cgt_hits hits = {.t = &t};
            assert_int_equal(cgt_trace_rays(ball, &rays, &hits, NULL), CGT_OK);
            assert_int_equal(cgt_occluded_rays(ball, &rays, &by_ray, NULL), CGT_OK);
            assert_int_equal(cgt_occluded_points(ball, &light, &points, &by_point, NULL), CGT_OK);
            assert_true(t == (hit ? 4 : INFINITY));
            assert_int_equal(by_ray, hit);
            assert_int_equal(by_point, hit);
        }
        float t = 7;
        const cgt_frame frame = {.width = 1, .height = 1, .t = &t};
        assert_int_equal(cgt_trace_camera(ball, &camera, &frame, NULL), CGT_OK);
        assert_true(t == 4);
        cgt_scene_release(ball);
    }
}

/* {0} is a point light at the origin. */
TEST(lights)
{
    static const float sphere[1][4] = {{0, 0, 2, 1}}, z[2] = {4, -4}, zero[2] = {0, 0};
    cgt_scene *ball = scene_of(context, NULL, sphere, 1);
    const cgt_points points = {.count = 2, .position = {zero, zero, z}};
    uint8_t occluded[2] = {7, 7};
    assert_int_equal(cgt_occluded_points(ball, &(cgt_light){0}, &points, occluded, NULL), CGT_OK);
    assert_true(occluded[0] == 1 && occluded[1] == 0);
    cgt_scene_release(ball);
}

/* A geometry of {0} is empty, and the pointer to its id may be NULL. */
TEST(geometries)
{
    cgt_scene *made = NULL;
    uint32_t id = CGT_INVALID_ID;
    const float center[3] = {0, 0, 0}, corner[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const cgt_spheres ball = {.count = 1, .centers = cgt_floats(center, 0), .radius = 1};
    const cgt_triangles triangle = {.count = 1, .vertex_count = 3, .vertices = cgt_floats(corner, 0)};
    assert_int_equal(cgt_scene_create(context, NULL, &made), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(made, NULL, &(cgt_spheres){0}), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(made, NULL, &(cgt_triangles){0}), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(made, NULL, &triangle), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(made, &id, &ball), CGT_OK);
    assert_int_equal(id, 3);
    assert_int_equal(cgt_scene_commit(made), CGT_OK);
    const ray_hit hit = ray_trace(made, (truth_ray){{0.1f, 0.1f, 5}, {0, 0, -1}, 0, INFINITY});
    assert_true(hit.geometry == 3 && hit.primitive == 0);
    cgt_scene_release(made);
}

SEEDED_SUITE("test_defaults", set_up, tear_down)
