/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The rays of cameras: by the formula, and those of rectangles. What pictures show, tests/driver judges. */
#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef long double vec3[3];

static void cross(const vec3 a, const vec3 b, vec3 c)
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void normalise(vec3 a)
{
    const long double length = sqrtl(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (int i = 0; i < 3; i++)
        a[i] /= length;
}

/* The public formula, in long double. */
static void formula_ray(const cgt_camera *c, uint32_t width, uint32_t height, uint32_t x, uint32_t y, vec3 org,
                        vec3 dir)
{
    vec3 fwd, right, up = {c->up[0], c->up[1], c->up[2]};
    for (int i = 0; i < 3; i++)
        fwd[i] = (long double)c->target[i] - c->eye[i];
    normalise(fwd);
    cross(fwd, up, right);
    normalise(right);
    cross(right, fwd, up);
    const bool flat = c->projection == CGT_PROJECTION_ORTHOGRAPHIC;
    const long double h =
        flat ? (long double)c->height / 2 : tanl((long double)c->fov * 3.14159265358979323846264338L / 360);
    const long double px = (2 * (x + 0.5L) / width - 1) * h * width / height, py = (1 - 2 * (y + 0.5L) / height) * h;
    for (int i = 0; i < 3; i++) {
        const long double sum = px * right[i] + py * up[i];
        org[i] = c->eye[i] + (flat ? sum : 0);
        dir[i] = fwd[i] + (flat ? 0 : sum);
    }
}

TEST(rays_match_the_formula)
{
    for (uint32_t round = 0; round < test_scaled(400); round++) {
        test_random r = random_make(round);
        const cloud c = {.reach = random_log(&r, 0.01f, 1000)};
        const cgt_camera camera = camera_random(&r, &c);
        const uint32_t width = 1 + random_below(&r, 40), height = 1 + random_below(&r, 40);
        truth_ray *rays = frame_rays(&camera, width, height);
        for (uint32_t i = 0; i < width * height; i++) {
            vec3 org, dir;
            formula_ray(&camera, width, height, i % width, i / width, org, dir);
            /* the field of view limits the lengths of right and up */
            const double half = camera.projection == CGT_PROJECTION_ORTHOGRAPHIC
                                    ? 0.5 * (double)camera.height
                                    : tan((double)camera.fov * 3.14159265358979 / 360);
            const double longest = 1 + half * (1 + (double)width / height);
            double eye = 0;
            for (int a = 0; a < 3; a++)
                eye = fmax(eye, fabs((double)camera.eye[a]));
            for (int a = 0; a < 3; a++) {
                assert_true(fabs((double)(rays[i].dir[a] - dir[a])) <= 4 * 0x1p-24 * longest);
                assert_true(fabs((double)(rays[i].org[a] - org[a])) <= 4 * 0x1p-24 * (longest + eye));
            }
        }
        free(rays);
    }
}

/* cgt_camera_get_rays: the rays of cgt_camera_get_ray. */
TEST(rectangles_have_their_rays)
{
    enum { WIDTH = 37, HEIGHT = 23, STRIDE = 28 };
    static char memory[WIDTH * HEIGHT * STRIDE];
    float *const org[3] = {(float *)(void *)memory, (float *)(void *)(memory + 4), (float *)(void *)(memory + 8)};
    float *const dir[3] = {(float *)(void *)(memory + 12), (float *)(void *)(memory + 16),
                           (float *)(void *)(memory + 20)};
    const uint32_t rectangle[][4] = {
        {0, 0, WIDTH, HEIGHT}, {5, 7, 1, 1}, {36, 22, 1, 1}, {3, 0, 11, 23}, {37, 23, 0, 0}};
    cgt_camera camera;
    cgt_camera_init(&camera);
    for (size_t k = 0; k < 2 * TEST_COUNT(rectangle); k++) {
        const uint32_t *at = rectangle[k / 2], x = at[0], y = at[1], columns = at[2], rows = at[3];
        camera.projection = k % 2 ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
        assert_int_equal(cgt_camera_get_rays(&camera, WIDTH, HEIGHT, x, y, columns, rows, STRIDE, org, dir), CGT_OK);
        for (uint32_t i = 0; i < columns * rows; i++) {
            float ray[2][3];
            assert_int_equal(
                cgt_camera_get_ray(&camera, WIDTH, HEIGHT, x + i % columns, y + i / columns, ray[0], ray[1]), CGT_OK);
            assert_memory_equal(memory + (size_t)i * STRIDE, ray, sizeof ray);
        }
    }
}

SEEDED_SUITE("test_camera", NULL, NULL)
