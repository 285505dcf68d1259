/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Plans of bands of magnitudes, and what statistics say of them. The profile `bands` of tests/driver judges the
 * hits. */
#include <string.h>

#include "builders/bands/bands_commit.h"
#include "dispatch/kernel.h"
#include "scene/bands.h"
#include "support/suite.h"
#include "structures/scenes/band_scenes.h"

TEST(plans_hold_every_class)
{
    test_random r = random_make(5);
    for (uint32_t round = 0; round < 2000; round++) {
        uint32_t count[CGT_MAGNITUDES] = {0};
        cgt_bands_plan plan;
        for (uint32_t k = 0; k < CGT_MAGNITUDES; k++)
            count[k] = random_below(&r, 1 + round % 9) ? 0 : 1 + random_below(&r, 1000);
        cgt_plan_bands(count, &plan);
        assert_true(plan.bands <= CGT_MAX_BANDS);
        for (uint32_t k = 0; k < CGT_MAGNITUDES; k++) {
            assert_int_equal(count[k] != 0, plan.band_of[k] != CGT_NO_BAND);
            if (!count[k])
                continue;
            assert_true(plan.band_of[k] < plan.bands);
            const int top = (int)k - CGT_MAGNITUDE_ZERO + plan.exponent[plan.band_of[k]];
            assert_true(top <= CGT_BAND_MAX_PEAK + CGT_BAND_ABOVE && top >= CGT_BAND_MIN_PEAK - CGT_BAND_BELOW);
        }
    }
}

/* A cloud with strays, and again without. */
TEST(statistics_cover_bands)
{
    enum { CLOUD = 3000, STRAYS = 5 };
    static float sphere[CLOUD][4];
    static band_rays q;
    uint8_t occluded[BAND_RAYS];
    test_random r = random_make(78);
    cgt_context *context = context_make(1, NULL);
    cgt_scene_statistics st;
    for (uint32_t i = 0; i < CLOUD; i++) {
        for (int a = 0; a < 3; a++)
            sphere[i][a] = random_float(&r, -1, 1) * (i < STRAYS ? 1e20f : 1);
        sphere[i][3] = 0.04f;
    }
    for (uint32_t i = 0; i < BAND_RAYS; i++)
        for (int a = 0; a < 3; a++) {
            q.org[a][i] = random_float(&r, -1, 1);
            q.dir[a][i] = random_float(&r, -1, 1);
        }
    const cgt_rays rays = {/* enough for a BVH beside the grid */
                           .count = BAND_RAYS,
                           .org = {q.org[0], q.org[1], q.org[2]},
                           .dir = {q.dir[0], q.dir[1], q.dir[2]}};
    cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])sphere, CLOUD);
    assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, NULL), CGT_OK);
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    assert_int_equal(st.structure, CGT_STRUCTURE_LOOSE_GRID);
    assert_int_equal(st.spheres, CLOUD);
    assert_non_null(strstr(st.reason, "2 bands"));
    assert_true(st.structure_bytes > 0 && st.bvh_bytes > 0 && st.bvh_build_ms > 0);
    assert_true(st.bytes == cgt_scene_bytes(scene));
    assert_true(st.bytes > scene->bands->band[0].scene->statistics.bytes + CLOUD * 16);
    assert_true(st.bounds_max[0] > 1e19f || st.bounds_min[0] < -1e19f);
    for (uint32_t i = 0; i < STRAYS; i++)
        memcpy(sphere[i], sphere[CLOUD - 1], sizeof sphere[i]);
    sphere[0][0] = NAN;
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_false(scene->in_bands);
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    assert_int_equal(st.skipped_not_finite, 1);
    assert_null(strstr(st.reason, "bands"));
    sphere[7][1] = 3e38f;
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_true(scene->in_bands);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* Tasks that run at once have scratch memory of their own, in whatever order they come, as the thread sanitizer
 * sees. */
TEST(lights_through_bands_from_threads)
{
    enum { CLOUD = 500, STRAYS = 5, POINTS = 10 * CGT_RAYS_CHUNK };
    static float sphere[CLOUD][4], place[3][POINTS];
    static uint8_t occluded[2][POINTS];
    test_random r = random_make(79);
    for (uint32_t i = 0; i < CLOUD; i++) {
        for (int a = 0; a < 3; a++)
            sphere[i][a] = random_float(&r, -1, 1) * (i < STRAYS ? 0x1p62f : 1);
        sphere[i][3] = 0.1f;
    }
    for (uint32_t i = 0; i < POINTS; i++)
        for (int a = 0; a < 3; a++)
            place[a][i] = random_float(&r, -1, 1);
    const cgt_points points = {.count = POINTS, .position = {place[0], place[1], place[2]}};
    const cgt_light lights[] = {{.position = {0.5f, 0, 0}}, {.kind = CGT_LIGHT_DIRECTIONAL, .position = {1, 2, 3}}};
    for (size_t k = 0; k < TEST_COUNT(lights); k++) {
        for (uint32_t threads = 0; threads < 2; threads++) {
            cgt_context *context = context_make(threads ? 4 : 1, NULL);
            cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])sphere, CLOUD);
            assert_true(scene->in_bands);
            assert_int_equal(cgt_occluded_points(scene, &lights[k], &points, occluded[threads], NULL), CGT_OK);
            cgt_scene_release(scene);
            cgt_context_release(context);
        }
        assert_memory_equal(occluded[0], occluded[1], POINTS);
    }
}

SEEDED_SUITE("test_bands", NULL, NULL)
