/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cameras that fit spheres, by the pictures that they show. */
#include "support/suite.h"

#include <math.h>
#include <string.h>

#include <cgt/picture.h>

enum { WIDTH = 160, HEIGHT = 90, BALLS = 3 };

/* Counts the rows and columns of the picture that have a hit: they must leave a margin, and fill one way. */
typedef struct seen {
    uint32_t left, right, top, bottom; /* pixels */
} seen;

static seen find(const cgt_camera *camera, const cgt_spheres *spheres)
{
    static uint32_t primitive[WIDTH * HEIGHT];
    uint32_t left = WIDTH, right = 0, top = HEIGHT, bottom = 0;
    cgt_context *context;
    cgt_scene *scene;
    cgt_frame frame;
    assert_int_equal(cgt_context_create(NULL, &context), CGT_OK);
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame.primitive = primitive;
    assert_int_equal(cgt_trace_camera(scene, camera, &frame, NULL), CGT_OK);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++)
            if (primitive[y * WIDTH + x] != CGT_INVALID_ID) {
                left = x < left ? x : left;
                right = x > right ? x : right;
                top = y < top ? y : top;
                bottom = y > bottom ? y : bottom;
            }
    cgt_scene_release(scene);
    cgt_context_release(context);
    assert_true(left <= right && left >= 1 && right <= WIDTH - 2 && top >= 1 && bottom <= HEIGHT - 2);
    return (seen){left, right, top, bottom};
}

static void see(const cgt_camera *camera, const cgt_spheres *spheres)
{
    const seen all = find(camera, spheres);
    const uint32_t left = all.left, right = all.right, top = all.top, bottom = all.bottom;
    const float wide = (float)(right - left + 1) / WIDTH, high = (float)(bottom - top + 1) / HEIGHT;
    assert_true(fmaxf(wide, high) > 0.92f);
    assert_true(fabsf((float)(left + right) - (WIDTH - 1)) <= 4.0f);
    assert_true(fabsf((float)(top + bottom) - (HEIGHT - 1)) <= 4.0f);
}

TEST(a_fitted_camera_shows_all_of_the_spheres)
{
    static const float balls[BALLS][4] = {{5, 1, 2, 1}, {9, 2, 2, 0.5f}, {6, 4, 3, 2}};
    double centers[BALLS][3], radii[BALLS];
    for (int i = 0; i < BALLS; i++) {
        radii[i] = (double)balls[i][3];
        for (int c = 0; c < 3; c++)
            centers[i][c] = (double)balls[i][c] + 1000.0;
    }
    const cgt_spheres floats = {
        .count = BALLS, .centers = cgt_floats(balls[0], 16), .radii = cgt_floats(&balls[0][3], 16)};
    const cgt_spheres doubles = {.count = BALLS,
                                 .centers = cgt_doubles(centers[0], 0),
                                 .radii = cgt_doubles(radii, 0),
                                 .origin = {1000.0, 1000.0, 1000.0}};
    const cgt_spheres one = {.count = 1, .centers = cgt_floats(balls[2], 0), .radius = 3.0f};
    const cgt_spheres *const all[] = {&floats, &doubles, &one};
    for (int i = 0; i < 6; i++) {
        cgt_camera camera = {.eye = {1, -3, 1}, .up = {0, 0, 1}, .fov = i % 2 ? 20.0f : 0.0f};
        camera.projection = i / 3 ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
        assert_int_equal(cgt_camera_fit_spheres(&camera, WIDTH, HEIGHT, all[i % 3]), CGT_OK);
        assert_near((camera.eye[0] - camera.target[0]) / (camera.eye[2] - camera.target[2]), 1.0, 1e-4);
        see(&camera, all[i % 3]);
    }
}

TEST(a_camera_that_cannot_fit_is_refused)
{
    static const float ball[4] = {0, 0, 0, 1}, bad[4] = {NAN, 0, 0, 1}, far[4] = {3e38f, 0, 0, 1};
    static const uint8_t types[1] = {1}; /* of one */
    const cgt_camera camera = {.eye = {0, 0, 5}}, nowhere = {.up = {0, 1, 0}}, along = {.eye = {0, 5, 0}};
    const cgt_spheres good = {.count = 1, .centers = cgt_floats(ball, 0), .radius = 1.0f};
    const cgt_spheres none[] = {{0},
                                {.count = 1},
                                {.count = 1, .centers = cgt_floats(bad, 0), .radius = 1.0f},
                                {.count = 1, .centers = cgt_floats(far, 0), .radius = 1.0f},
                                {.count = 1, .centers = cgt_floats(ball, 0), .radius = -1.0f},
                                {.count = 1,
                                 .centers = cgt_floats(ball, 0),
                                 .radii = cgt_floats(ball, 0),
                                 .types = cgt_uint8s(types, 0),
                                 .type_count = 1}};
    cgt_camera c = camera;
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_int_equal(cgt_camera_fit_spheres(&c, WIDTH, HEIGHT, &none[i]), CGT_ERROR_INVALID_ARGUMENT);
    assert_memory_equal(&c, &camera, sizeof c);
    assert_int_equal(cgt_camera_fit_spheres(&c, 0, HEIGHT, &good), CGT_ERROR_INVALID_ARGUMENT);
    c = nowhere;
    assert_int_equal(cgt_camera_fit_spheres(&c, WIDTH, HEIGHT, &good), CGT_ERROR_INVALID_ARGUMENT);
    c = along;
    assert_int_equal(cgt_camera_fit_spheres(&c, WIDTH, HEIGHT, &good), CGT_ERROR_INVALID_ARGUMENT);
}

/* Balls one by one are what an array of spheres is; a box is its corners. */
TEST(a_fit_in_parts_is_a_fit)
{
    static const float ball[2][4] = {{1, 2, 3, 1}, {-4, 0, 1, 0.5f}}, low[3] = {-1, -2, -3}, high[3] = {4, 3, 2};
    float corner[8][3];
    const cgt_spheres spheres = {.count = 2, .centers = cgt_floats(ball[0], 16), .radii = cgt_floats(ball[0] + 3, 16)};
    const cgt_spheres corners = {.count = 8, .centers = cgt_floats(corner[0], 0)};
    for (int i = 0; i < 8; i++)
        for (int c = 0; c < 3; c++)
            corner[i][c] = i >> c & 1 ? high[c] : low[c];
    for (int projection = CGT_PROJECTION_PERSPECTIVE; projection <= CGT_PROJECTION_ORTHOGRAPHIC; projection++) {
        const cgt_camera start = {.eye = {1, 3, 9}, .projection = (cgt_projection)projection, .fov = 30};
        cgt_camera wanted = start, got = start;
        cgt_camera_fit *fit;
        assert_int_equal(cgt_camera_fit_spheres(&wanted, WIDTH, HEIGHT, &spheres), CGT_OK);
        assert_int_equal(cgt_camera_fit_create(&start, WIDTH, HEIGHT, 0.0, &fit), CGT_OK);
        assert_int_equal(cgt_camera_fit_apply(fit, &got), CGT_ERROR_INVALID_ARGUMENT);
        assert_memory_equal(&got, &start, sizeof got);
        for (int i = 0; i < 2; i++)
            cgt_camera_fit_add(fit, (double[]){(double)ball[i][0], (double)ball[i][1], (double)ball[i][2]},
                               (double)ball[i][3]);
        cgt_camera_fit_add(fit, (double[]){0, NAN, 0}, 1.0);
        cgt_camera_fit_add(fit, (double[]){50, 0, 0}, -1.0);
        assert_int_equal(cgt_camera_fit_apply(fit, &got), CGT_OK);
        assert_memory_equal(&got, &wanted, sizeof got);
        cgt_camera_fit_release(fit);
        wanted = got = start;
        assert_int_equal(cgt_camera_fit_spheres(&wanted, WIDTH, HEIGHT, &corners), CGT_OK);
        assert_int_equal(cgt_camera_fit_create(&start, WIDTH, HEIGHT, 0.0, &fit), CGT_OK);
        cgt_camera_fit_add_box(fit, low, high);
        assert_int_equal(cgt_camera_fit_apply(fit, &got), CGT_OK);
        assert_memory_equal(&got, &wanted, sizeof got);
        cgt_camera_fit_release(fit);
    }
}

TEST(heights_are_those_of_balls_of_any_size)
{
    static const float ball[3] = {0, 0, 0}, radii[3] = {1e-25f, 1.0f, 1e25f};
    for (int i = 0; i < 3; i++) {
        const cgt_spheres spheres = {.count = 1, .centers = cgt_floats(ball, 0), .radius = radii[i]};
        cgt_camera camera = {.projection = CGT_PROJECTION_ORTHOGRAPHIC};
        assert_int_equal(cgt_camera_fit_spheres(&camera, WIDTH, HEIGHT, &spheres), CGT_OK);
        assert_near(camera.height / radii[i], 2.08, 1e-4);
    }
}

/* A row along the view: the eye is in front of it, however small the angle, and the height is that of a ball. */
TEST(depth_does_not_add_to_heights)
{
    static const float ball[3][3] = {{0, 0, -50}, {0, 0, 0}, {0, 0, 50}}, fovs[3] = {1.0f, 40.0f, 200.0f};
    const cgt_spheres spheres = {.count = 3, .centers = cgt_floats(ball[0], 0), .radius = 0.5f};
    for (int i = 0; i < 3; i++) {
        cgt_camera camera = {.eye = {0, 0, 5}, .projection = CGT_PROJECTION_ORTHOGRAPHIC, .fov = fovs[i]};
        assert_int_equal(cgt_camera_fit_spheres(&camera, WIDTH, HEIGHT, &spheres), CGT_OK);
        assert_near(camera.height, 1.04, 1e-4);
        assert_true(camera.eye[2] >= 50.5f);
    }
}

TEST(a_fit_lasts_all_around)
{
    static const float ball[4] = {6, 0, 0, 1};
    const cgt_spheres spheres = {.count = 1, .centers = cgt_floats(ball, 16), .radius = 1.0f};
    cgt_camera camera = {.eye = {0, 2, 9}, .fov = 30};
    cgt_camera_fit *fit;
    assert_int_equal(cgt_camera_fit_create(&camera, WIDTH, HEIGHT, 360.0, &fit), CGT_OK);
    cgt_camera_fit_add(fit, (double[]){6, 0, 0}, 1.0);
    cgt_camera_fit_add(fit, (double[]){-6, 0, 0}, 1.0);
    assert_int_equal(cgt_camera_fit_apply(fit, &camera), CGT_OK);
    cgt_camera_fit_release(fit);
    for (int i = 0; i < 12; i++) {
        const float before = camera.eye[0];
        find(&camera, &spheres);
        cgt_camera_orbit(&camera, 30.0);
        assert_true(camera.eye[0] != before);
    }
    assert_int_equal(cgt_camera_fit_create(&camera, WIDTH, HEIGHT, INFINITY, &fit), CGT_ERROR_INVALID_ARGUMENT);
    assert_null(fit);
    assert_int_equal(cgt_camera_fit_create(NULL, WIDTH, HEIGHT, 0.0, &fit), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_camera_fit_create(&camera, WIDTH, HEIGHT, 0.0, NULL), CGT_ERROR_INVALID_ARGUMENT);
    cgt_camera_fit_release(NULL);
}

TEST(an_orbit_goes_around_the_target)
{
    cgt_camera camera = {.eye = {3, 1, 0}, .target = {1, 1, 0}, .up = {0, 0, 2}};
    cgt_camera_orbit(&camera, 90.0);
    assert_near(camera.eye[0], 1.0, 1e-6);
    assert_near(camera.eye[1], 3.0, 1e-6);
    assert_near(camera.eye[2], 0.0, 1e-6);
    float right[3], up[3], forward[3];
    cgt_camera_get_axes(&camera, right, up, forward);
    assert_near(forward[1], -1.0, 1e-6);
    assert_near(right[0], -1.0, 1e-6);
    assert_near(up[2], 1.0, 1e-6);
}

/* Zeros are the library's view; lengths whose squares no float holds are lengths. */
TEST(defaults_and_far_eyes_look_along_the_axis)
{
    static const cgt_camera cameras[] = {{.fov = 0},
                                         {.eye = {0, 0, 1e-30f}},
                                         {.eye = {0, 0, 1e20f}, .up = {0, 1e30f, 0}},
                                         {.eye = {0, 0, 5}, .up = {0, 1e-30f, 0}}};
    static const float ball[3] = {1, 2, 3};
    const cgt_spheres spheres = {.count = 1, .centers = cgt_floats(ball, 0), .radius = 1.0f};
    for (size_t i = 0; i < sizeof cameras / sizeof *cameras; i++) {
        static const float wanted[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
        float axis[3][3], light[3];
        cgt_camera camera = cameras[i];
        cgt_camera_get_axes(&camera, axis[0], axis[1], axis[2]);
        for (int k = 0; k < 9; k++)
            assert_near(axis[k / 3][k % 3], wanted[k / 3][k % 3], 1e-6);
        cgt_camera_get_key_light(&camera, WIDTH, HEIGHT, light);
        assert_near(light[1], 0.7, 1e-6);
        assert_int_equal(cgt_camera_fit_spheres(&camera, WIDTH, HEIGHT, &spheres), CGT_OK);
        see(&camera, &spheres);
        camera = cameras[i];
        cgt_camera_orbit(&camera, 90.0);
        assert_true(camera.eye[0] > 0.9e-30f && fabsf(camera.eye[2]) < 1e-6f * camera.eye[0]);
    }
}

SUITE(NULL, NULL)
