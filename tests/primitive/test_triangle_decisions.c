/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What statistics count of one triangle: double precision cannot decide rays at edges, but decides those far from
 * edges. No profile of tests/driver, which cannot know how a test was decided. */
#include <math.h>

#include "support/suite.h"
#include "primitive/triangle_scenes.h"

enum { RAYS = 1024 };

TEST(decisions_are_counted)
{
    static truth_ray ray[RAYS];
    static full_hit hit[RAYS];
    static const triangle t = {{-8, -8, 0}, {8, -8, 0}, {0, 8, 0}};
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = scene_of_triangles(context, NULL, &t, 1);
        test_random r = random_make(500);
        cgt_trace_statistics inside, edges;
        cgt_trace_options options = with_precision(CGT_PRECISION_EXACT);
        for (int i = 0; i < RAYS; i++) {
            ray[i] = (truth_ray){.dir = {0, 0, -1}, .t_max = INFINITY};
            ray[i].org[0] = random_float(&r, -1, 1);
            ray[i].org[1] = random_float(&r, -1, 1);
            ray[i].org[2] = 4;
        }
        options.statistics = &inside;
        trace_all(scene, ray, RAYS, hit, &options);
        assert_int_equal(inside.hits, RAYS);
        assert_int_equal(inside.double_tests + inside.exact_tests, 0);
        assert_true(inside.packet_tests > 0 && inside.ray_tests >= RAYS);
        for (int i = 0; i < RAYS; i++) {
            ray[i].org[0] = rintf(random_float(&r, -8, 8));
            ray[i].org[1] = -8;
        }
        options.statistics = &edges;
        trace_all(scene, ray, RAYS, hit, &options);
        assert_int_equal(edges.hits, RAYS);
        assert_int_equal(edges.double_tests, RAYS);
        assert_int_equal(edges.exact_tests, RAYS);
        options.precision = CGT_PRECISION_FAST; /* decides, too, unless another test is asked for */
        trace_all(scene, ray, RAYS, hit, &options);
        assert_true(edges.hits == RAYS && edges.exact_tests == RAYS);
        const cgt_research_trace_options research = {.triangle_test = CGT_TRIANGLE_TEST_WATERTIGHT};
        options.research = &research;
        cgt_scene_release(scene);
        scene = scene_of_triangles(context, &(cgt_scene_options){.structure = CGT_STRUCTURE_KD}, &t, 1);
        trace_all(scene, ray, RAYS, hit, &options);
        assert_int_equal(edges.double_tests + edges.exact_tests + edges.exact_values, 0);
        cgt_scene_release(scene);
        scene = scene_of_triangles(context, &(cgt_scene_options){.structure = CGT_STRUCTURE_LOOSE_GRID}, &t, 1);
        trace_all(scene, ray, RAYS, hit, &options); /* ray by ray, decided */
        assert_int_equal(edges.exact_tests, RAYS);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

SEEDED_SUITE("test_triangle_decisions", NULL, NULL)
