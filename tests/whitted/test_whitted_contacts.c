/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Surfaces in contact: gaps of some units in the last place, none, or overlaps as small, at scales from 1e-6 to 1e6.
 * Each ray of each path is checked in long double: it runs through no opaque body, and it is in those bodies of glass
 * that it carries in its list. Neither does a ray meet the surface that it leaves, nor does it miss one in contact with
 * it. */
#include <math.h>
#include <string.h>

#include "support/suite.h"
#include "whitted/whitted_scenes.h"

static whitted_scene scene;

static const cgt_material materials[] = {
    {.kind = CGT_MATERIAL_MATTE, .color = {1, 1, 1}},
    {.kind = CGT_MATERIAL_MIRROR, .color = {0.9f, 0.9f, 0.9f}},
    {.kind = CGT_MATERIAL_GLASS, .index = 1.5f},
};

typedef struct watcher {
    uint64_t rays, contacts, through, wrong_inside, same;
} watcher;

static long double depth_in_sphere(const float sphere[4], const long double at[3])
{
    long double square = 0;
    for (int a = 0; a < 3; a++)
        square += (at[a] - (long double)sphere[a]) * (at[a] - (long double)sphere[a]);
    return (long double)sphere[3] - sqrtl(square);
}

/* Of a cube with faces along the axes. */
static long double depth_in_cube(uint32_t box, const long double at[3])
{
    long double depth = INFINITY;
    for (int a = 0; a < 3; a++) {
        depth = fminl(depth, at[a] - (long double)scene.corner[8 * box][a]);
        depth = fminl(depth, (long double)scene.corner[8 * box + 7][a] - at[a]);
    }
    return depth;
}

static void check_body(watcher *w, const whitted_ray *ray, whitted_body body, const cgt_material *material,
                       long double depth, long double error)
{
    if (fabsl(depth) <= error)
        return;
    if (material->kind != CGT_MATERIAL_GLASS)
        w->through += depth > 0;
    else
        w->wrong_inside += (depth > 0) != (cgt_whitted_find(ray, body) >= 0);
}

/* Checks places along the way of a ray. Within error of a surface either side will do: that is the gap of three steps
 * of float and the rounding of the ray's start. */
static void watch(void *user, uint32_t bounce, const whitted_ray *ray, const whitted_hit *hit)
{
    watcher *w = user;
    if (bounce == 0)
        return;
    w->rays++;
    const float largest = fmaxf(fabsf(ray->org[0]), fmaxf(fabsf(ray->org[1]), fabsf(ray->org[2])));
    const bool ends = hit->primitive != CGT_INVALID_ID;
    const long double error = 0x1p-20L * (long double)largest;
    const long double end = ends ? (long double)hit->t : 8 * (long double)largest;
    w->contacts += ends && fabsf(hit->t) <= ray->reach;
    w->same +=
        ends && isinf(ray->t_max) && hit->primitive == ray->skip_primitive && hit->geometry == ray->skip_geometry;
    for (int k = 0; k < 5; k++) {
        static const long double share[5] = {1e-4L, 0.1L, 0.5L, 0.9L, 0.9999L};
        long double at[3];
        for (int a = 0; a < 3; a++)
            at[a] = (long double)ray->org[a] + share[k] * end * (long double)ray->dir[a];
        for (uint32_t i = 0; i < scene.spheres; i++)
            check_body(w, ray, (whitted_body){WHITTED_SPHERES, i, i}, &materials[scene.sphere_material[i]],
                       depth_in_sphere(scene.sphere[i], at), error);
        for (uint32_t i = 0; i < scene.boxes; i++)
            check_body(w, ray, (whitted_body){WHITTED_BOXES, i, 12 * i}, &materials[scene.box_material[12 * i]],
                       depth_in_cube(i, at), error);
    }
}

static float steps_from(float x, int steps)
{
    for (; steps > 0; steps--)
        x = nextafterf(x, INFINITY);
    for (; steps < 0; steps++)
        x = nextafterf(x, -INFINITY);
    return x;
}

/* Pairs of balls that touch along x, some steps of float apart, or random directions, rounded. */
static void add_balls(test_random *r, float scale, float at[][3], float middle[][3], uint32_t pairs)
{
    for (uint32_t i = 0; i < pairs; i++) {
        const float radius = scale * random_float(r, 0.15f, 0.3f), other = scale * random_float(r, 0.05f, 0.3f);
        float c[3], d[3], e[3];
        random_direction(r, d);
        if (i % 2)
            d[0] = 1, d[1] = d[2] = 0;
        for (int a = 0; a < 3; a++) {
            c[a] = scale * (2.0f * (float)(i >> (2 * a) & 3) - 3.0f);
            e[a] = c[a] + (radius + other) * d[a];
            at[i][a] = c[a] + radius * d[a];
            middle[i][a] = c[a];
        }
        e[0] = steps_from(e[0], (int)random_below(r, 7) - 3);
        whitted_scene_add_sphere(&scene, c[0], c[1], c[2], radius, i % 8 < 6 ? 2 : (uint8_t)random_below(r, 3));
        whitted_scene_add_sphere(&scene, e[0], e[1], e[2], other, (uint8_t)random_below(r, 3));
        const long double center[3] = {(long double)e[0], (long double)e[1], (long double)e[2]};
        if (depth_in_sphere(scene.sphere[scene.spheres - 2], center) > -(long double)other)
            middle[i][0] = NAN; /* they overlap: a camera in there would be in the second one, too, at times */
    }
}

/* Pairs of cubes whose faces lie on each other, or some steps of float apart. */
static void add_cubes(test_random *r, float scale, float at[][3], float middle[][3], uint32_t pairs)
{
    for (uint32_t i = 0; i < pairs; i++) {
        float low[3], high[3], next[3];
        const int axis = (int)random_below(r, 3), steps = (int)random_below(r, 7) - 3;
        for (int a = 0; a < 3; a++) {
            low[a] = scale * (2.0f * (float)(i >> (2 * a) & 3) - 3.0f + random_float(r, 0, 0.1f));
            high[a] = low[a] + scale * random_float(r, 0.2f, 0.5f);
            at[i][a] = low[a] + random_float(r, 0, 1) * (high[a] - low[a]);
            middle[i][a] = low[a] + 0.5f * (high[a] - low[a]);
        }
        whitted_scene_add_cube(&scene, low, high, false, i % 8 < 6 ? 2 : (uint8_t)random_below(r, 3));
        at[i][axis] = high[axis];
        memcpy(next, high, sizeof next);
        low[axis] = steps_from(high[axis], steps < 0 ? 0 : steps);
        next[axis] = low[axis] + scale * 0.3f;
        whitted_scene_add_cube(&scene, low, next, false, (uint8_t)random_below(r, 3));
    }
}

/* Rays aimed at the contacts, and past them by all orders of magnitude: from outside, and, where that is glass, from
 * inside of the first body of a pair, so that they arrive undeflected. */
static void aim(test_random *r, float scale, float at[][3], float middle[][3], uint32_t pairs, uint32_t count,
                float org[][3], float dir[][3])
{
    for (uint32_t i = 0; i < count; i++) {
        float away[3], beside[3];
        const float *target = at[i % pairs], past = scale * random_log(r, 1e-8f, 0.3f);
        random_direction(r, away);
        random_direction(r, beside);
        for (int a = 0; a < 3; a++) {
            org[i][a] = i / pairs % 2 && i % 8 < 6 && !isnan(middle[i % pairs][0])
                            ? middle[i % pairs][a] + scale * 0.05f * away[a]
                            : target[a] + scale * 0.9f * away[a];
            dir[i][a] = target[a] + past * beside[a] - org[i][a];
        }
    }
}

static void expect_contacts(bool cubes, float scale)
{
    enum { PAIRS = 64, RAYS = 1024 };
    static float org[RAYS][3], dir[RAYS][3], light[RAYS][3], at[PAIRS][3], middle[PAIRS][3];
    test_random r = random_make(cubes ? 5 : 4);
    watcher seen = {0};
    whitted_scene_begin(&scene, materials, TEST_COUNT(materials));
    if (cubes)
        add_cubes(&r, scale, at, middle, PAIRS);
    else
        add_balls(&r, scale, at, middle, PAIRS);
    whitted_scene_commit(&scene, NULL, 1);
    scene.w.watch = watch;
    scene.w.watch_user = &seen;
    scene.w.bounces = 10;
    scene.w.faintest = 1e-3f;
    aim(&r, scale, at, middle, PAIRS, RAYS, org, dir);
    whitted_scene_trace(&scene, test_between(128, RAYS), org, dir, light);
    print_message("%s, scale %g: %llu rays, %llu contacts, %llu through, %llu wrong, %llu the same\n",
                  cubes ? "cubes" : "balls", (double)scale, (unsigned long long)seen.rays,
                  (unsigned long long)seen.contacts, (unsigned long long)seen.through,
                  (unsigned long long)seen.wrong_inside, (unsigned long long)seen.same);
    assert_true(seen.contacts > 50);
    assert_int_equal(seen.through, 0);
    assert_int_equal(seen.wrong_inside, 0);
    assert_int_equal(seen.same, 0);
    whitted_scene_end(&scene);
}

TEST(balls_in_contact)
{
    expect_contacts(false, 1e-6f);
    expect_contacts(false, 1e-3f);
    expect_contacts(false, 1);
    expect_contacts(false, 1e3f);
    expect_contacts(false, 1e6f);
}

TEST(cubes_in_contact)
{
    expect_contacts(true, 1e-6f);
    expect_contacts(true, 1e-3f);
    expect_contacts(true, 1);
    expect_contacts(true, 1e3f);
    expect_contacts(true, 1e6f);
}

/* The edge between a floor and a wall as thin as two steps of float: all of it is lit from this side, none from the
 * other, although the rounded places of the nearest hits lie in the wall or behind it. */
static void expect_edge(float scale)
{
    enum { RAYS = 2000 };
    static float org[RAYS][3], dir[RAYS][3], light[RAYS][3];
    const float x = 1.2345f * scale, beyond = steps_from(x, 2);
    const whitted_light lamps[] = {{{CGT_LIGHT_POINT, {-scale, scale, 0.3f * scale}}, {1, 0, 0}},
                                   {{CGT_LIGHT_POINT, {4 * scale, 0.7f * scale, 0}}, {0, 1, 0}}};
    test_random r = random_make(7);
    whitted_scene_begin(&scene, materials, TEST_COUNT(materials));
    whitted_scene_add_cube(&scene, (const float[3]){-9 * scale, -scale, -9 * scale},
                           (const float[3]){9 * scale, 0, 9 * scale}, false, 0);
    whitted_scene_add_cube(&scene, (const float[3]){x, 0, -9 * scale}, (const float[3]){beyond, scale, 9 * scale},
                           false, 0);
    whitted_scene_commit(&scene, NULL, 1);
    scene.w.light = lamps;
    scene.w.lights = 2;
    for (uint32_t i = 0; i < RAYS; i++) {
        const float target[3] = {x - scale * random_log(&r, 1e-9f, 0.1f), 0, scale * random_float(&r, -1, 1)};
        for (int a = 0; a < 3; a++) {
            org[i][a] = scale * (a == 1 ? random_float(&r, 0.1f, 2) : random_float(&r, -1, 1));
            dir[i][a] = target[a] - org[i][a];
        }
    }
    whitted_scene_trace(&scene, test_between(100, RAYS), org, dir, light);
    for (uint32_t i = 0; i < test_between(100, RAYS); i++) {
        const double t = -(double)org[i][1] / (double)dir[i][1];
        if ((double)org[i][0] + t * (double)dir[i][0] >= (double)x) /* it meets the edge itself, or the wall */
            continue;
        assert_true(light[i][0] > 0.0f);
        assert_true(light[i][1] == 0.0f);
    }
    whitted_scene_end(&scene);
}

TEST(edges_are_lit_from_one_side)
{
    expect_edge(1e-6f);
    expect_edge(1);
    expect_edge(1e6f);
}

/* A thin wall across the axes in a floor: a place before it is rounded along each axis by itself, and so to a float
 * behind the wall at times. Rays to the lights must look behind their start to find it. scale: a power of two, with
 * which all coordinates of the wall's face are exact. */
static void expect_slanted_wall(float scale)
{
    enum { RAYS = 4000 };
    static float org[RAYS][3], dir[RAYS][3], light[RAYS][3];
    static const float end[2][2] = {{-4, 14}, {4, 6}}; /* x, z of the face x + z = 10 */
    const whitted_light lamps[] = {{{CGT_LIGHT_POINT, {-scale, 2 * scale, 7 * scale}}, {1, 0, 0}},
                                   {{CGT_LIGHT_POINT, {3 * scale, 0.5f * scale, 13 * scale}}, {0, 1, 0}}};
    test_random r = random_make(9);
    uint32_t before = 0;
    float corner[8][3];
    for (int k = 0; k < 8; k++) { /* axes: along the wall, up, behind it by a step of x */
        const float x = scale * end[k & 1][0];
        corner[k][0] = k & 4 ? steps_from(x, 1) : x;
        corner[k][1] = k & 2 ? scale : -0.5f * scale; /* into the floor: behind its start a ray is below that */
        corner[k][2] = scale * end[k & 1][1];
    }
    whitted_scene_begin(&scene, materials, TEST_COUNT(materials));
    whitted_scene_add_cube(&scene, (const float[3]){-99 * scale, -scale, -99 * scale},
                           (const float[3]){99 * scale, 0, 99 * scale}, false, 0);
    whitted_scene_add_box(&scene, (const float(*)[3])corner, false, 0);
    whitted_scene_commit(&scene, NULL, 1);
    scene.w.light = lamps;
    scene.w.lights = 2;
    for (uint32_t i = 0; i < RAYS; i++) {
        const float x = random_float(&r, -2, 2), away = random_log(&r, 1e-9f, 1e-6f);
        const float length = random_float(&r, 0.5f, 2); /* with 1 the place would be the target, a float */
        const float target[3] = {scale * x, 0, scale * (10 - x - away)};
        org[i][0] = scale * random_float(&r, -6, -3);
        org[i][1] = scale * random_float(&r, 0.1f, 2);
        org[i][2] = scale * random_float(&r, 10.1f, 12);
        for (int a = 0; a < 3; a++)
            dir[i][a] = length * (target[a] - org[i][a]);
    }
    const uint32_t rays = test_between(200, RAYS);
    whitted_scene_trace(&scene, rays, org, dir, light);
    for (uint32_t i = 0; i < rays; i++) {
        const double t = -(double)org[i][1] / (double)dir[i][1];
        const double x = (double)org[i][0] + t * (double)dir[i][0], z = (double)org[i][2] + t * (double)dir[i][2];
        if (x + z >= 10 * (double)scale * (1 - 1e-14)) /* it meets the wall */
            continue;
        before++;
        assert_true(light[i][0] > 0.0f);
        assert_true(light[i][1] == 0.0f);
    }
    assert_true(before > rays / 4);
    whitted_scene_end(&scene);
}

TEST(walls_across_the_axes)
{
    expect_slanted_wall(0x1p-20f);
    expect_slanted_wall(1);
    expect_slanted_wall(0x1p20f);
}

SEEDED_SUITE("test_whitted_contacts", NULL, NULL)
