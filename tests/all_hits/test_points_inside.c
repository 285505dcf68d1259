/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points inside more geometries than a ray sums up, and points that are none. No profile of tests/driver: its scenes
 * have a few geometries, and its points are finite. */
#include <cgt/all_hits.h>

#include <stdlib.h>
#include <string.h>

#include "support/scenes.h"
#include "support/suite.h"

static cgt_points points_of(float (*point)[3], uint32_t count)
{
    return (cgt_points){
        .count = count, .stride = sizeof *point, .position = {&point[0][0], &point[0][1], &point[0][2]}};
}

/* One more geometry than a ray sums up: tetrahedra side by side, oriented outwards. */
TEST(many_geometries)
{
    enum { MANY = (1 << 16) + 1, POINTS = 64 /* enough for a stream, whose scratch comes on top */ };
    static const float corner[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const uint32_t face[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    const cgt_inside_options how = {.rule = CGT_INSIDE_WINDING};
    float(*many)[4][3] = malloc(MANY * sizeof *many), point[POINTS][3];
    uint8_t inside[POINTS];
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene;
    assert_non_null(many);
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    for (uint32_t i = 0; i < MANY; i++) {
        const float at[3] = {(float)(i % 256), (float)(i / 256), 0};
        for (uint32_t k = 0; k < 12; k++)
            many[i][k / 3][k % 3] = corner[k / 3][k % 3] + at[k % 3];
        const cgt_triangles t = {
            .count = 4, .indices = cgt_uint32s(face, 0), .vertices = cgt_floats(many[i][0], 0), .vertex_count = 4};
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &t), CGT_OK);
    }
    for (uint32_t k = 0; k < POINTS; k++) /* in the first one and the last one, and beside them */
        for (int a = 0; a < 3; a++)
            point[k][a] = many[k & 1 ? MANY - 1 : 0][0][a] + 0.25f + (k & 2 && a == 0 ? 0.5f : 0);
    const cgt_points points = points_of(point, POINTS);
    for (int rays = CGT_RAY_KIND_COHERENT; rays <= CGT_RAY_KIND_INCOHERENT; rays++) { /* without a BVH, and with one */
        cgt_trace_statistics statistics;
        const cgt_trace_options options = {.statistics = &statistics};
        memset(inside, 9, sizeof inside);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_int_equal(cgt_scene_prepare(scene, (cgt_ray_kind)rays), CGT_OK);
        assert_int_equal(cgt_points_inside(scene, &points, &how, inside, &options), CGT_OK);
        for (uint32_t k = 0; k < POINTS; k++)
            assert_int_equal(inside[k], !(k & 2));
        assert_int_equal(statistics.bvh_rays, rays == CGT_RAY_KIND_INCOHERENT ? POINTS : 0);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
    free(many);
}

TEST(points_that_are_none)
{
    static const float ball[1][4] = {{0, 0, 0, 1}};
    float point[4][3] = {{0, 0, 0}, {NAN, 0, 0}, {0, INFINITY, 0}, {0, 0, 3}};
    uint8_t inside[4];
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, ball, 1);
    cgt_trace_statistics statistics;
    const cgt_trace_options options = {.statistics = &statistics};
    const cgt_points points = points_of(point, 4);
    assert_int_equal(cgt_points_inside(scene, &points, NULL, inside, &options), CGT_OK);
    assert_int_equal(inside[0], 1);
    for (int i = 1; i < 4; i++)
        assert_int_equal(inside[i], 0);
    assert_int_equal(statistics.rays, 4);
    assert_int_equal(statistics.invalid_rays, 2);
    assert_int_equal(statistics.hits, 1);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_points_inside", NULL, NULL)
