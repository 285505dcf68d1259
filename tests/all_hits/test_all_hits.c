/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What calls for all hits promise beside the hits, which tests/driver judges: a far surface has the bits of a nearest
 * hit, a visitor stops the trace, and a hit that a ray goes on after must be one. */
#include <cgt/all_hits.h>

#include <math.h>
#include <string.h>

#include "support/scenes.h"
#include "support/suite.h"

/* ---- values of far surfaces ---- */

/* A far surface has the bits that cgt_trace_rays gives a ray that begins behind the near one. */
TEST(far_surfaces_as_nearest_hits)
{
    test_random r = random_make(4900);
    cgt_context *context = context_make(1, NULL);
    uint32_t compared = 0;
    for (uint32_t round = 0; round < test_scaled(400); round++) {
        float sphere[1][4];
        for (int a = 0; a < 3; a++)
            sphere[0][a] = random_float(&r, -1, 1);
        sphere[0][3] = random_log(&r, 1e-3f, 3);
        cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])sphere, 1);
        for (int i = 0; i < 20; i++) {
            cgt_single_ray ray = {.t_min = -INFINITY, .t_max = INFINITY};
            float to[3];
            random_direction(&r, to);
            for (int a = 0; a < 3; a++) {
                ray.org[a] = random_float(&r, -3, 3);
                ray.dir[a] = sphere[0][a] + to[a] * sphere[0][3] * random_float(&r, 0, 1) - ray.org[a];
            }
            for (int precision = 0; precision < 2; precision++) {
                const cgt_trace_options options = {.precision = (cgt_precision)precision};
                cgt_hit hit[2];
                cgt_hit nearest;
                cgt_single_ray behind = ray;
                uint32_t count;
                assert_int_equal(cgt_trace_all_ray(scene, &ray, NULL, hit, 2, &count, NULL, &options), CGT_OK);
                if (count < 2)
                    continue;
                behind.t_min = nextafterf(hit[0].t, INFINITY);
                assert_int_equal(cgt_trace_ray(scene, &behind, &nearest, &options), CGT_OK);
                if (precision && nearest.t == hit[0].t)
                    continue; /* the near one, whose t is less exact */
                if (hit[1].t < behind.t_min)
                    continue;
                compared++;
                const cgt_hit far = {.t = hit[1].t,
                                     .primitive = hit[1].primitive,
                                     .geometry = hit[1].geometry,
                                     .surface = CGT_SURFACE_FAR,
                                     .normal = {hit[1].normal[0], hit[1].normal[1], hit[1].normal[2]}};
                if (!precision)
                    assert_memory_equal(&far, &nearest, sizeof far);
                else if (nearest.t > hit[0].t * (1 + 1e-3f))
                    assert_memory_equal(&far, &nearest, sizeof far);
            }
        }
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
    print_message("%u far surfaces\n", compared);
    assert_true(compared > test_scaled(400) * 10);
}

/* ---- calls ---- */

static cgt_visit stop_at_once(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
{
    (void)ray, (void)hits, (void)count;
    ++*(unsigned *)user;
    return CGT_VISIT_STOP;
}

TEST(a_visitor_stops_the_trace)
{
    static const float sphere[1][4] = {{0, 0, 0, 1}}, zero[8] = {0}, one[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    const cgt_rays rays = {.count = 8, .org = {zero, zero, zero}, .dir = {one, one, zero}};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, sphere, 1);
    unsigned visits = 0;
    assert_int_equal(cgt_visit_all_rays(scene, &rays, NULL, 0, stop_at_once, &visits, NULL), CGT_ERROR_STOPPED);
    assert_int_equal(visits, 1);
    assert_non_null(strstr(context_message(context), "stopped"));
    cgt_scene_release(scene);
    cgt_context_release(context);
}

static cgt_visit count_hits(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
{
    (void)ray, (void)hits;
    *(unsigned *)user += count;
    return CGT_VISIT_CONTINUE;
}

/* However often its list is filled. */
TEST(a_ray_counts_once)
{
    enum { SPHERES = 200 };
    static float sphere[SPHERES][4];
    static const float zero[1] = {0}, one[1] = {1};
    const cgt_rays rays = {.count = 1, .org = {zero, zero, zero}, .dir = {one, zero, zero}};
    const cgt_scene_options incoherent = {.rays = CGT_RAY_KIND_INCOHERENT};
    cgt_trace_statistics statistics;
    const cgt_trace_options options = {.statistics = &statistics};
    unsigned hits = 0;
    for (uint32_t i = 0; i < SPHERES; i++) {
        sphere[i][0] = (float)(1 + i);
        sphere[i][3] = 0.25f;
    }
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, &incoherent, (const float(*)[4])sphere, SPHERES);
    assert_int_equal(cgt_visit_all_rays(scene, &rays, NULL, 0, count_hits, &hits, &options), CGT_OK);
    assert_int_equal(hits, 2 * SPHERES);
    assert_true(statistics.rays == 1 && statistics.bvh_rays == 1);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* A hit to go on after that is none: the ray is invalid, and no other one is. */
TEST(after_no_hit)
{
    const float sphere[4][4] = {{0, 0, 0, 1}, {0, 0, 5, 1}, {9, 9, 9, 1}, {0, 0, NAN, 1}};
    const float beside[9] = {5, 5, 3, 6, 5, 3, 5, 6, 3}; /* a triangle whose plane the ray meets */
    const cgt_triangles triangles = {.count = 1, .vertex_count = 3, .vertices = cgt_floats(beside, 0)};
    const uint32_t cases[][3] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 1},         {CGT_INVALID_ID, 7, 7},
                                 {2, 0, 0}, {3, 0, 0}, {4, 0, 0},         {0, 1, 0},
                                 {0, 2, 0}, {0, 0, 2}, {1, 0, UINT32_MAX}};
    const uint32_t hits[] = {3, 2, 0, 4};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, sphere, 4);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    const cgt_single_ray ray = {.org = {0, 0, -9}, .dir = {0, 0, 1}};
    for (size_t k = 0; k < TEST_COUNT(cases); k++) {
        const cgt_all_hits_options all = {
            .after_primitive = &cases[k][0], .after_geometry = &cases[k][1], .after_surface = &cases[k][2]};
        cgt_trace_statistics statistics;
        const cgt_trace_options options = {.statistics = &statistics};
        cgt_hit hit[8];
        uint32_t count = 77;
        bool more = true;
        assert_int_equal(cgt_trace_all_ray(scene, &ray, &all, hit, 8, &count, &more, &options), CGT_OK);
        const bool valid = k < TEST_COUNT(hits);
        assert_int_equal(count, valid ? hits[k] : 0);
        assert_int_equal(more, false);
        assert_true(statistics.rays == 1 && statistics.invalid_rays == !valid && statistics.hits == count);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_all_hits", NULL, NULL)
