/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * How much light arrives: none is lost or made between bodies that absorb none, Beer's law, shadows, limits; the same
 * bits for threads and variants; sentences for bad input. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/suite.h"
#include "whitted/whitted_scenes.h"

enum { RAYS = 2000 };

static whitted_scene scene;
static float org[RAYS][3], dir[RAYS][3], light[RAYS][3];

static const cgt_material materials[] = {
    {.kind = CGT_MATERIAL_MATTE, .color = {1, 1, 1}},
    {.kind = CGT_MATERIAL_MIRROR, .color = {1, 1, 1}},
    {.kind = CGT_MATERIAL_GLASS, .index = 1.5f},
    {.kind = CGT_MATERIAL_GLASS, .index = 1.2f},
};

static void aim_rays(test_random *r, float from)
{
    for (uint32_t i = 0; i < RAYS; i++) {
        random_direction(r, dir[i]);
        for (int a = 0; a < 3; a++)
            org[i][a] = -from * dir[i][a] + random_float(r, -1, 1);
    }
}

/* Mirrors and glass of all kinds, overlapping or not, under a sky of brightness 1 everywhere, or in a closed box whose
 * walls are as bright: every pixel is as bright. */
static void add_bodies(test_random *r, bool overlap)
{
    for (uint32_t i = 0; i < 60; i++) {
        const float size = random_float(r, 0.02f, overlap ? 0.4f : 0.07f);
        const float x = random_float(r, -1, 1), y = random_float(r, -1, 1), z = random_float(r, -1, 1);
        if (!overlap) { /* on a lattice, touching nothing */
            const float grid[3] = {(float)(i % 4) * 0.5f - 0.75f, (float)(i / 4 % 4) * 0.5f - 0.75f,
                                   (float)(i / 16) * 0.5f - 0.75f};
            whitted_scene_add_sphere(&scene, grid[0], grid[1], grid[2], 0.2f, (uint8_t)(1 + i % 3));
        } else {
            whitted_scene_add_sphere(&scene, x, y, z, size, (uint8_t)(1 + random_below(r, 3)));
        }
        if (i % 6 == 0) {
            const float low[3] = {x - 0.1f, y - 0.2f, z - 0.15f}, high[3] = {x + 0.1f, y + 0.1f, z + 0.15f};
            if (overlap)
                whitted_scene_add_cube(&scene, low, high, false, (uint8_t)(1 + random_below(r, 3)));
        }
    }
}

static void expect_furnace(bool overlap, bool box)
{
    test_random r = random_make(overlap ? 2 : 3);
    whitted_counts counts;
    memset(&counts, 0, sizeof counts);
    whitted_scene_begin(&scene, materials, TEST_COUNT(materials));
    add_bodies(&r, overlap);
    if (box)
        whitted_scene_add_cube(&scene, (const float[3]){-3, -3, -3}, (const float[3]){3, 3, 3}, true, 0);
    whitted_scene_commit(&scene, NULL, 1);
    scene.w.counts = &counts;
    scene.w.bounces = 20;
    scene.w.faintest = 1e-2f;
    for (int c = 0; c < 3; c++) {
        scene.w.rest[c] = scene.w.ambient[c] = 1.0f;
        scene.w.sky[0][c] = scene.w.sky[1][c] = box ? 100.0f : 1.0f; /* a leak through the box would be bright */
    }
    aim_rays(&r, box ? 0.5f : 2.0f);
    whitted_scene_trace(&scene, RAYS, org, dir, light);
    float worst = 0.0f;
    for (uint32_t i = 0; i < RAYS; i++)
        for (int c = 0; c < 3; c++)
            worst = fmaxf(worst, fabsf(light[i][c] - 1.0f));
    print_message("worst %g, %llu rays of bounce 3, %llu ghosts, %llu too deep\n", (double)worst,
                  (unsigned long long)counts.rays[3], (unsigned long long)counts.ghosts,
                  (unsigned long long)counts.too_deep);
    assert_true(counts.rays[3] > 100);
    assert_int_equal(counts.too_deep, 0);
    assert_true(worst < 2e-5f);
    whitted_scene_end(&scene);
}

TEST(no_light_is_lost)
{
    expect_furnace(false, false);
    expect_furnace(true, false);
    expect_furnace(false, true);
    expect_furnace(true, true);
}

/* Straight through the middle of a ball of glass without a boundary: exp(-absorption times its diameter). */
TEST(glass_absorbs)
{
    static const cgt_material glass[] = {{.kind = CGT_MATERIAL_GLASS, .index = 1, .absorption = {0, 0.5f, 2}}};
    whitted_scene_begin(&scene, glass, 1);
    whitted_scene_add_sphere(&scene, 0, 0, 0, 0.75f, 0);
    whitted_scene_commit(&scene, NULL, 1);
    for (int c = 0; c < 3; c++)
        scene.w.sky[0][c] = scene.w.sky[1][c] = 1.0f;
    const float from[1][3] = {{0, 0, -4}}, along[1][3] = {{0, 0, 2}};
    whitted_scene_trace(&scene, 1, from, along, light);
    for (int c = 0; c < 3; c++)
        assert_true(fabs((double)light[0][c] - exp(-1.5 * (double)glass[0].absorption[c])) < 1e-6);
    whitted_scene_end(&scene);
}

/* A camera inside a ball of glass sees the sky through one surface. */
TEST(camera_may_be_in_glass)
{
    static const cgt_material glass[] = {{.kind = CGT_MATERIAL_GLASS, .index = 1.5f, .absorption = {1, 0, 0}}};
    whitted_scene_begin(&scene, glass, 1);
    whitted_scene_add_sphere(&scene, 0, 0, 0, 1, 0);
    whitted_scene_commit(&scene, NULL, 1);
    scene.w.bounces = 1;
    for (int c = 0; c < 3; c++)
        scene.w.sky[0][c] = scene.w.sky[1][c] = 1.0f;
    const float from[1][3] = {{0, 0, 0}}, along[1][3] = {{0, 1, 0}};
    whitted_scene_trace(&scene, 1, from, along, light);
    assert_true(fabs((double)light[0][1] - 0.96) < 1e-6); /* the 0.04 reflected end at the limit of bounces */
    assert_true(fabs((double)light[0][0] - 0.96 * exp(-1.0)) < 1e-6);
    whitted_scene_end(&scene);
}

/* Lights: Lambert's cosine where nothing hides them, 0 where a ball does, the glass's share where glass does. */
TEST(lights_cast_shadows)
{
    static const whitted_light lamp[] = {{{CGT_LIGHT_POINT, {0, 10, 0}}, {1, 1, 1}},
                                         {{CGT_LIGHT_DIRECTIONAL, {0, 0, 5}}, {0, 1, 0}}};
    whitted_scene_begin(&scene, materials, TEST_COUNT(materials));
    whitted_scene_add_cube(&scene, (const float[3]){-9, -1, -9}, (const float[3]){9, 0, 9}, false, 0);
    whitted_scene_add_sphere(&scene, 0, 2, 0, 1, 1);
    whitted_scene_commit(&scene, NULL, 1);
    scene.w.light = lamp;
    scene.w.lights = 2;
    const float from[3][3] = {{6, 5, 0}, {0.25f, 1, 5}, {-2, 1, -2}},
                along[3][3] = {{0, -1, 0}, {0, -0.2f, -1}, {0, -1, 0}};
    whitted_scene_trace(&scene, 3, from, along, light);
    assert_true(fabs((double)light[0][0] - 10 / sqrt(136.0)) < 1e-6);
    assert_true(light[1][0] == 0.0f); /* under the ball */
    assert_true(fabs((double)light[2][0] - 10 / sqrt(108.0)) < 1e-6);
    assert_true(light[0][1] == light[0][0]); /* the other one grazes the floor */
    whitted_scene_end(&scene);
}

TEST(limits_are_counted)
{
    whitted_counts counts;
    memset(&counts, 0, sizeof counts);
    whitted_scene_begin(&scene, materials, TEST_COUNT(materials));
    whitted_scene_add_cube(&scene, (const float[3]){-1, -1, -1}, (const float[3]){1, 1, 1}, true, 1);
    for (int i = 0; i <= WHITTED_NESTED; i++) /* one more than a ray can be in */
        whitted_scene_add_sphere(&scene, 0, 0, 0, 0.5f - 0.05f * (float)i, 3);
    whitted_scene_commit(&scene, NULL, 1);
    scene.w.counts = &counts;
    scene.w.faintest = 0.5f;
    for (int c = 0; c < 3; c++)
        scene.w.rest[c] = 1;
    const float from[2][3] = {{0.9f, 0.9f, 0.9f}, {0, 0, -0.9f}}, along[2][3] = {{1, 2, 3}, {0, 0, 1}};
    whitted_scene_trace(&scene, 2, from, along, light);
    assert_true(light[0][0] == 1.0f); /* nothing but mirrors: it ends at the limit */
    assert_int_equal(counts.cut, 1);
    assert_int_equal(counts.too_deep, 1);
    assert_int_equal(counts.faint, 1); /* the only boundary of media: that of air */
    assert_int_equal(counts.rays[8], 1);
    whitted_scene_end(&scene);
}

/* Frames: any number of threads and any variant. */
TEST(bits_are_the_same)
{
    enum { WIDTH = 150, HEIGHT = 90 };
    static float first[WIDTH * HEIGHT][3], other[WIDTH * HEIGHT][3];
    const char *const *names = cgt_get_variant_names();
    bool has_first = false;
    for (uint32_t threads = 1; threads <= 3; threads += 2)
        for (int i = 0; names[i]; i++) {
            test_random r = random_make(2);
            cgt_context *probe;
            if (cgt_context_create(&(cgt_context_options){.threads = 1, .variant = names[i]}, &probe))
                continue;
            cgt_context_release(probe);
            whitted_scene_begin(&scene, materials, TEST_COUNT(materials));
            add_bodies(&r, true);
            whitted_scene_add_cube(&scene, (const float[3]){-3, -3, -3}, (const float[3]){3, -2, 3}, false, 0);
            whitted_scene_commit(&scene, names[i], threads);
            const whitted_light lamp = {{CGT_LIGHT_POINT, {2, 5, -4}}, {1, 0.8f, 0.6f}};
            scene.w.light = &lamp;
            scene.w.lights = 1;
            scene.w.bounces = 4;
            scene.w.sky[0][2] = scene.w.sky[1][1] = 1.0f;
            cgt_camera camera;
            cgt_camera_init(&camera);
            assert_int_equal(cgt_whitted_frame(&scene.w, &camera, WIDTH, HEIGHT, NULL, has_first ? other : first),
                             CGT_OK);
            if (has_first)
                assert_memory_equal(first, other, sizeof first);
            has_first = true;
            whitted_scene_end(&scene);
        }
    assert_true(has_first);
}

TEST(bad_input_is_refused)
{
    cgt_material bad[1] = {{.kind = CGT_MATERIAL_GLASS, .index = 1.5f}};
    const uint8_t missing = 1;
    const float center[3] = {0};
    const cgt_spheres spheres = {.count = 1, .centers = cgt_floats(center, 0)};
    whitted_geometry g = {.spheres = &spheres};
    cgt_context *context;
    cgt_scene *one;
    assert_int_equal(cgt_context_create(NULL, &context), CGT_OK);
    assert_int_equal(cgt_scene_create(context, NULL, &one), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(one, NULL, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(one), CGT_OK);
    whitted w = {.scene = one, .material = bad, .materials = 1, .geometry = &g, .geometries = 1};
    assert_null(cgt_whitted_check(&w));
    w.geometries = 0;
    assert_non_null(strstr(cgt_whitted_check(&w), "more geometries"));
    w.geometries = 1;
    const float indices[] = {0.0f, 0.99f, NAN, INFINITY, -1.5f};
    for (uint32_t i = 0; i < TEST_COUNT(indices); i++) {
        bad[0].index = indices[i];
        assert_non_null(strstr(cgt_whitted_check(&w), "index of refraction"));
    }
    bad[0].index = 1.5f;
    bad[0].absorption[1] = NAN;
    assert_non_null(strstr(cgt_whitted_check(&w), "absorption"));
    bad[0].absorption[1] = 0;
    bad[0].color[2] = 1.5f;
    assert_non_null(strstr(cgt_whitted_check(&w), "colour"));
    bad[0].color[2] = 0;
    g.material = &missing;
    assert_non_null(strstr(cgt_whitted_check(&w), "does not exist"));
    g.material = NULL;
    g.material_of_all = 1;
    assert_non_null(strstr(cgt_whitted_check(&w), "does not exist"));
    g.material_of_all = 0;
    w.bounces = WHITTED_MAX_BOUNCES + 1;
    assert_non_null(strstr(cgt_whitted_check(&w), "bounces"));
    w.bounces = 0;
    const whitted_light dark = {{CGT_LIGHT_POINT, {NAN, 0, 0}}, {1, 1, 1}};
    w.light = &dark;
    w.lights = 1;
    assert_non_null(strstr(cgt_whitted_check(&w), "light"));
    cgt_scene_release(one);
    cgt_context_release(context);
}

SEEDED_SUITE("test_whitted_light", NULL, NULL)
