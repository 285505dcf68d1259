/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against a light: pictures whose shadows are known. That the results are those of rays to the light, for every
 * structure, tests/driver compares. */
#include <math.h>

#include "support/scenes.h"
#include "support/suite.h"

/* ---- a ball on a table ---- */

#define SIDE 128u

/* In a frame's order, large enough for many packets of many blocks; FAST too, since this picture has no borderline
 * rays. Then every second packet has a range that ends before the ball. */
TEST(a_ball_casts_a_shadow)
{
    static float at[3][SIDE * SIDE], end[SIDE * SIDE];
    static uint8_t occluded[SIDE * SIDE];
    const float sphere[2][4] = {{0, 1, 0, 0.5f}, {40, 0, 0, 1}};
    FOR_EACH_VARIANT(variant)
    for (uint32_t k = 0; k < TEST_STRUCTURES; k++)
        for (int fast = 0; fast < 2; fast++) {
            cgt_context *context = context_make(2, variant);
            const cgt_scene_options made = structure_in_turn(k);
            cgt_scene *scene = scene_of(context, &made, sphere, 2);
            test_trace_options options = {0};
            options.precision = fast ? CGT_PRECISION_FAST : CGT_PRECISION_EXACT;
            for (uint32_t i = 0; i < SIDE * SIDE; i++) {
                at[0][i] = (float)(i % SIDE) * (4.f / SIDE) - 2;
                at[1][i] = 0;
                at[2][i] = (float)(i / SIDE) * (4.f / SIDE) - 2;
            }
            cgt_points points = {.count = SIDE * SIDE, .position = {at[0], at[1], at[2]}};
            for (int number = 0; number < 4; number++) {
                const bool w = number % 2, ranged = number / 2;
                const cgt_light light = {.position = {0, 2, 0}, .kind = w ? CGT_LIGHT_POINT : CGT_LIGHT_DIRECTIONAL};
                points.t_max = ranged ? end : NULL;
                for (uint32_t i = 0; i < SIDE * SIDE; i++)
                    end[i] = i / 256 % 2 ? 0.1f : w ? 1 : INFINITY;
                /* a cone of sine 1/2 around the light, or a cylinder */
                const float radius2 = w ? 4.f / 3 : 0.25f;
                assert_int_equal(cgt_occluded_points(scene, &light, &points, occluded, TRACE_OPTIONS(&options)),
                                 CGT_OK);
                for (uint32_t i = 0; i < SIDE * SIDE; i++) {
                    const float d2 = at[0][i] * at[0][i] + at[2][i] * at[2][i];
                    if (fabsf(d2 - radius2) > 1e-4f)
                        assert_int_equal(occluded[i], d2 < radius2 && !(ranged && i / 256 % 2));
                }
            }
            cgt_scene_release(scene);
            cgt_context_release(context);
        }
}

/* A point on a surface is occluded by that surface at t = 0, but not with a small t_min. */
TEST(t_min_excludes_the_surface)
{
    const float sphere[1][4] = {{0, 0, 0, 1}}, point[3] = {0, 1, 0}, little = 1e-5f;
    const cgt_light light = {.position = {0.5f, 3, 0}, .kind = CGT_LIGHT_POINT};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, sphere, 1);
    cgt_points points = {.count = 1, .position = {&point[0], &point[1], &point[2]}};
    uint8_t occluded = 7;
    assert_int_equal(cgt_occluded_points(scene, &light, &points, &occluded, NULL), CGT_OK);
    assert_int_equal(occluded, 1);
    points.t_min = &little;
    assert_int_equal(cgt_occluded_points(scene, &light, &points, &occluded, NULL), CGT_OK);
    assert_int_equal(occluded, 0);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_occluded_points", NULL, NULL)
