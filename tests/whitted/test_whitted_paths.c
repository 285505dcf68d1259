/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Paths whose course is known: between two mirrors, through a slab, a prism and a ball of glass; and the error of paths
 * by bounce, against the same path in long double. */
#include <math.h>
#include <string.h>

#include "support/reference/path_error.h"
#include "support/suite.h"
#include "whitted/whitted_scenes.h"

static whitted_scene scene;

enum { MIRROR = 0, GLASS = 1, THIN = 2, BOUNCES = 12 };

static const whitted_material materials[] = {
    {.kind = WHITTED_MIRROR, .color = {1, 1, 1}},
    {.kind = WHITTED_GLASS, .index = 1.5f},
    {.kind = WHITTED_GLASS, .index = 1.2f},
};

/* The path of one ray, and of the brighter one where it divides. */
typedef struct path {
    uint32_t length;
    whitted_ray ray[BOUNCES + 1];
    whitted_hit hit[BOUNCES + 1];
} path;

static void watch(void *user, uint32_t bounce, const whitted_ray *ray, const whitted_hit *hit)
{
    path *p = user;
    if (bounce > BOUNCES || (bounce < p->length && ray->weight[0] <= p->ray[bounce].weight[0]))
        return;
    p->ray[bounce] = *ray;
    p->hit[bounce] = *hit;
    p->length = bounce + 1;
}

static void follow(const float org[3], const float dir[3], float faintest, path *p)
{
    float from[1][3], along[1][3], light[1][3];
    memset(p, 0, sizeof *p);
    memcpy(from[0], org, sizeof from[0]);
    memcpy(along[0], dir, sizeof along[0]);
    scene.w.watch = watch;
    scene.w.watch_user = p;
    scene.w.bounces = BOUNCES;
    scene.w.faintest = faintest;
    whitted_scene_trace(&scene, 1, (const float(*)[3])from, (const float(*)[3])along, light);
}

static void begin(void) { whitted_scene_begin(&scene, materials, TEST_COUNT(materials)); }

static void expect_near(double value, double wanted, double bound)
{
    if (!(fabs(value - wanted) <= bound))
        fail_msg("%.12g is not within %g of %.12g", value, bound, wanted);
}

/* Up and down between mirrors 2 apart, a step of 0.3 to the side at each: exact but for rounding, however often. */
TEST(between_two_mirrors)
{
    path p;
    begin();
    whitted_scene_add_cube(&scene, (const float[3]){-50, 1, -50}, (const float[3]){50, 2, 50}, false, MIRROR);
    whitted_scene_add_cube(&scene, (const float[3]){-50, -2, -50}, (const float[3]){50, -1, 50}, false, MIRROR);
    whitted_scene_commit(&scene, NULL, 1);
    follow((const float[3]){0, -1 + 1e-3f, 0.25f}, (const float[3]){0.3f, 2, 0}, 0, &p);
    assert_int_equal(p.length, BOUNCES + 1);
    const double first = (2 - 1e-3) * 0.15;
    for (uint32_t i = 1; i <= BOUNCES; i++) {
        expect_near((double)p.ray[i].org[0], first + 0.3 * (i - 1), 0x1p-22 * i);
        assert_true(p.ray[i].org[1] == (i % 2 ? 1.0f : -1.0f));
        assert_true(p.ray[i].org[2] == 0.25f);
        expect_near((double)(p.ray[i].dir[0] / p.ray[i].dir[1]), i % 2 ? -0.15 : 0.15, 0x1p-24);
    }
    whitted_scene_end(&scene);
}

/* A slab 1 thick: the ray leaves it as it came, moved aside by sin(i - r) / cos(r). */
TEST(through_a_slab)
{
    path p;
    begin();
    whitted_scene_add_cube(&scene, (const float[3]){-50, -1, -50}, (const float[3]){50, 0, 50}, false, GLASS);
    whitted_scene_commit(&scene, NULL, 1);
    for (double angle = 0.05; angle < 1.2; angle += 0.1) {
        const float dir[3] = {(float)sin(angle), (float)-cos(angle), 0};
        const double inside = asin(sin(angle) / 1.5);
        follow((const float[3]){0, 0.5f, 0}, dir, 0.3f, &p);
        const whitted_ray *out = &p.ray[2];
        assert_int_equal(out->nested, 0);
        assert_int_equal(p.ray[1].nested, 1);
        for (int a = 0; a < 3; a++)
            expect_near((double)out->dir[a], (double)dir[a], 0x1p-22); /* by two roundings, at both surfaces */
        expect_near((double)out->org[0], 0.5 * tan(angle) + tan(inside), 0x1p-21);
        expect_near((double)out->org[1], -1.0, 0x1p-23);
    }
    whitted_scene_end(&scene);
}

/* A slab in another one, both bodies of one mesh: each refracts by its own index, and the ray leaves as it came. */
TEST(through_two_slabs)
{
    path p;
    begin();
    whitted_scene_add_cube(&scene, (const float[3]){-50, -1, -50}, (const float[3]){50, 0, 50}, false, GLASS);
    whitted_scene_add_cube(&scene, (const float[3]){-49, -0.75f, -49}, (const float[3]){49, -0.25f, 49}, false, THIN);
    whitted_scene_commit(&scene, NULL, 1);
    for (double angle = 0.05; angle < 0.9; angle += 0.1) {
        const float dir[3] = {(float)sin(angle), (float)-cos(angle), 0};
        follow((const float[3]){0, 0.5f, 0}, dir, 0.3f, &p);
        const double sine[4] = {sin(angle) / 1.5, sin(angle) / (double)1.2f, sin(angle) / 1.5, sin(angle)};
        const uint8_t nested[4] = {1, 2, 1, 0};
        for (int k = 0; k < 4; k++) {
            assert_int_equal(p.ray[k + 1].nested, nested[k]);
            expect_near((double)p.ray[k + 1].dir[0], sine[k], 0x1p-22 * (k + 1)); /* a rounding at each surface */
        }
    }
    whitted_scene_end(&scene);
}

/* A prism of 60 degrees: the deviation is the angle in plus the angle out less 60. */
TEST(through_a_prism)
{
    path p;
    const double apex = 3.14159265358979 / 3;
    const float x = (float)tan(apex / 2);
    const float corner[8][3] = {{-x, -1, -5}, {x, -1, -5}, {-1e-3f * x, 1 - 2e-3f, -5}, {1e-3f * x, 1 - 2e-3f, -5},
                                {-x, -1, 5},  {x, -1, 5},  {-1e-3f * x, 1 - 2e-3f, 5},  {1e-3f * x, 1 - 2e-3f, 5}};
    begin();
    /* faces from (-x, -1) and (x, -1) up to near (0, 1): half of their angle has tangent x / 2 */
    whitted_scene_add_box(&scene, corner, false, GLASS);
    whitted_scene_commit(&scene, NULL, 1);
    const double half = atan((double)(x - 1e-3f * x) / (double)(2 - 2e-3f)), whole = 2 * half;
    for (double in = 0.5; in < 1.2; in += 0.1) {
        /* the left face's normal is (-cos(half), sin(half)) */
        const double angle = in - half; /* of the ray below the horizontal, seen from the left */
        const float dir[3] = {(float)cos(angle), (float)sin(angle), 0};
        const float org[3] = {-0.5f * x - 2 * dir[0], -2 * dir[1], 0};
        const double first = asin(sin(in) / 1.5), second = whole - first;
        if (1.5 * sin(second) > 0.99)
            continue;
        follow(org, dir, 0.3f, &p);
        assert_int_equal(p.ray[1].nested, 1);
        assert_int_equal(p.ray[2].nested, 0);
        const double deviation = in + asin(1.5 * sin(second)) - whole;
        const double cosine = (double)p.ray[2].dir[0] * (double)dir[0] + (double)p.ray[2].dir[1] * (double)dir[1];
        expect_near(acos(cosine), deviation, 2e-6); /* corners are floats: the faces are off by 2^-24 each */
    }
    whitted_scene_end(&scene);
}

/* A ball: two refractions at the same angles turn the ray by 2 (in - inside). */
TEST(through_a_ball)
{
    path p;
    begin();
    whitted_scene_add_sphere(&scene, 3, -2, 1, 1, GLASS);
    whitted_scene_commit(&scene, NULL, 1);
    for (int i = 1; i < 20; i++) {
        const float beside = 0.0456f * (float)i;
        follow((const float[3]){-1, -2 + beside, 1}, (const float[3]){1, 0, 0}, 0.3f, &p);
        const double in = asin((double)(-2 + beside) + 2.0), inside = asin(sin(in) / 1.5);
        assert_int_equal(p.ray[1].nested, 1);
        assert_int_equal(p.ray[2].nested, 0);
        const double turn = 2 * (in - inside);
        /* places and directions are rounded to 2^-23 of their largest component, here 4 and 1, at two surfaces */
        expect_near((double)p.ray[2].dir[0], cos(turn), 4e-6);
        expect_near((double)p.ray[2].dir[1], -sin(turn), 4e-6);
    }
    whitted_scene_end(&scene);
}

/* ---- Error by bounce ---------------------------------------------------------------------------------------- */

/* Plane mirrors add a rounding at each bounce; balls of radius r at a distance l multiply the error by 2 l / r. */
TEST(error_grows_as_it_must)
{
    path_errors planes, balls;
    const uint32_t rays = (uint32_t)test_between(50, 500);
    assert_int_equal(path_errors_measure(false, rays, 6, NULL, &planes), CGT_OK);
    assert_int_equal(path_errors_measure(true, rays, 6, NULL, &balls), CGT_OK);
    for (int k = 0; k < PATH_BOUNCES; k++)
        print_message("bounce %2d: planes %8.3g, balls %8.3g units of 2^-23\n", k + 1, planes.worst[k], balls.worst[k]);
    assert_true(planes.rays > 20 && balls.rays > 20);
    for (int k = 0; k < PATH_BOUNCES; k++)
        assert_true(planes.worst[k] <= 1.0 + 1.0 * (k + 1));
    assert_true(balls.worst[0] <= 1.0 && balls.worst[1] <= 20.0);
    assert_true(planes.worst[PATH_BOUNCES - 1] > 0.01); /* it is measured at all */
}

SEEDED_SUITE("test_whitted_paths", NULL, NULL)
