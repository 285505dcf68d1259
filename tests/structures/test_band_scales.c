/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A scene times a power of two has the same hits, times that power, and takes the same work; so do other sizes, and
 * strays. Statistics tell of bands. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "scene/bands.h"
#include "support/suite.h"
#include "structures/scenes/band_scenes.h"

#define CLOUD 3000u

/* Spheres or triangles in a cube, and what a camera and rays see of them; everything times 2^exponent, or as it is. */
typedef struct scaled_scene {
    float (*sphere)[4], (*vertex)[3];
    cgt_scene *scene;
    planes frame;
    full_hit hit[BAND_RAYS];
    uint8_t occluded[BAND_RAYS], lit[BAND_RAYS];
    uint64_t tests, double_tests, ray_tests; /* of the frame; of the rays */
} scaled_scene;

static uint64_t tests_of(const cgt_trace_statistics *s) { return s->ray_tests + 100 * s->exact_tests; }

static void trace_scaled(scaled_scene *s, float unit)
{
    static band_rays q;
    cgt_trace_statistics statistics;
    const cgt_trace_options options = {.statistics = &statistics};
    const cgt_camera camera = {.eye = {0.1f * unit, 0.2f * unit, 3 * unit}, .up = {0, 1, 0}};
    const cgt_light light = {.position = {2 * unit, 3 * unit, 2 * unit}};
    const cgt_hits hits = hit_array(s->hit);
    test_random r = random_make(77);
    for (uint32_t i = 0; i < BAND_RAYS; i++)
        for (int a = 0; a < 3; a++) {
            q.org[a][i] = unit * random_float(&r, -1, 1);
            q.dir[a][i] = random_float(&r, -1, 1);
        }
    frame_trace(s->scene, &camera, &s->frame, &options);
    s->tests = tests_of(&statistics);
    s->double_tests = statistics.double_tests;
    const cgt_rays rays = {
        .count = BAND_RAYS, .org = {q.org[0], q.org[1], q.org[2]}, .dir = {q.dir[0], q.dir[1], q.dir[2]}};
    const cgt_points points = {.count = BAND_RAYS, .position = {q.org[0], q.org[1], q.org[2]}};
    assert_int_equal(cgt_trace_rays(s->scene, &rays, &hits, &options), CGT_OK);
    s->ray_tests = tests_of(&statistics);
    assert_int_equal(cgt_occluded_rays(s->scene, &rays, s->occluded, &options), CGT_OK);
    s->ray_tests += tests_of(&statistics);
    assert_int_equal(cgt_occluded_points(s->scene, &light, &points, s->lit, &options), CGT_OK);
    s->ray_tests += tests_of(&statistics);
}

/* The last primitives become strays of that size, where there is one. */
static void scaled_make(cgt_context *context, bool triangles, float unit, float stray, scaled_scene *s)
{
    test_random r = random_make(78);
    memset(s, 0, sizeof *s);
    s->sphere = calloc(CLOUD, sizeof *s->sphere);
    s->vertex = calloc(3 * CLOUD, sizeof *s->vertex);
    assert_true(s->sphere && s->vertex);
    for (uint32_t i = 0; i < CLOUD; i++) {
        const float size = stray > 0 && i >= CLOUD - 5 ? stray : unit;
        for (int a = 0; a < 3; a++) {
            s->sphere[i][a] = size * random_float(&r, -1, 1);
            for (int k = 0; k < 3; k++)
                s->vertex[3 * i + k][a] = s->sphere[i][a] + 0.05f * size * random_float(&r, -1, 1);
        }
        s->sphere[i][3] = 0.04f * unit;
    }
    const test_scene_options options = {.structure = CGT_STRUCTURE_AUTO};
    const band_scene scene = {
        .spheres = triangles ? 0 : CLOUD, .triangles = triangles ? CLOUD : 0, .sphere = s->sphere, .vertex = s->vertex};
    s->scene = band_scene_commit(context, &options, &scene);
    s->frame = planes_make(64, 64);
    trace_scaled(s, unit);
}

static void scaled_free(scaled_scene *s)
{
    planes_free(&s->frame);
    cgt_scene_release(s->scene);
    free(s->sphere);
    free(s->vertex);
}

/* The same hits, t times the power. */
static void compare_scaled(const scaled_scene *one, const scaled_scene *s, int exponent)
{
    uint32_t hits = 0;
    for (size_t i = 0; i < one->frame.elements; i++) {
        assert_int_equal(one->frame.primitive[i], s->frame.primitive[i]);
        assert_int_equal(one->frame.geometry[i], s->frame.geometry[i]);
        assert_true(same_bits(ldexpf(one->frame.t[i], exponent), s->frame.t[i]));
        for (int a = 0; a < 3; a++)
            assert_true(same_bits(one->frame.normal[a][i], s->frame.normal[a][i]));
        hits += one->frame.primitive[i] != CGT_INVALID_ID;
    }
    assert_true(hits > one->frame.elements / 4);
    for (uint32_t i = 0; i < BAND_RAYS; i++) {
        assert_int_equal(one->hit[i].primitive, s->hit[i].primitive);
        assert_true(same_bits(ldexpf(one->hit[i].t, exponent), s->hit[i].t));
    }
    assert_memory_equal(one->occluded, s->occluded, sizeof one->occluded);
    assert_memory_equal(one->lit, s->lit, sizeof one->lit);
}

static void work_is_bounded(const scaled_scene *one, const scaled_scene *s, const char *what)
{
    print_message("%s: %llu tests of pixels, %llu at scale 1; %llu in double, %llu; %llu of rays, %llu\n", what,
                  (unsigned long long)s->tests, (unsigned long long)one->tests, (unsigned long long)s->double_tests,
                  (unsigned long long)one->double_tests, (unsigned long long)s->ray_tests,
                  (unsigned long long)one->ray_tests);
    assert_true(s->tests <= 2 * one->tests + 10000);
    assert_true(s->double_tests <= 2 * one->double_tests + 2000);
    assert_true(s->ray_tests <= 3 * one->ray_tests + 10000);
}

TEST(powers_of_two_scale_hits_alone)
{
    static const int exponents[] = {-100, -60, -50, -37, 41, 53, 60, 100, 124};
    cgt_context *context = context_make(1, NULL);
    for (int triangles = 0; triangles < 2; triangles++) {
        scaled_scene one, s;
        scaled_make(context, triangles, 1, 0, &one);
        assert_false(one.scene->in_bands);
        for (size_t i = 0; i < TEST_COUNT(exponents); i++) {
            char what[32];
            snprintf(what, sizeof what, "2^%d", exponents[i]);
            scaled_make(context, triangles, ldexpf(1, exponents[i]), 0, &s);
            assert_true(s.scene->in_bands);
            compare_scaled(&one, &s, exponents[i]);
            work_is_bounded(&one, &s, what);
            scaled_free(&s);
        }
        scaled_free(&one);
    }
    cgt_context_release(context);
}

/* Sizes that are no powers, denormal ones, and strays. */
TEST(any_size_keeps_its_structure)
{
    static const float units[] = {1e-12f, 1e-15f, 1e-16f, 1e-30f, 1e-40f, 1e-42f, 1e13f, 1e17f, 1e37f};
    static const float strays[] = {1e16f, 1e17f, 1e25f, 3e38f};
    cgt_context *context = context_make(1, NULL);
    for (int triangles = 0; triangles < 2; triangles++) {
        scaled_scene one, s;
        scaled_make(context, triangles, 1, 0, &one);
        for (size_t i = 0; i < TEST_COUNT(units) + TEST_COUNT(strays); i++) {
            const bool stray = i >= TEST_COUNT(units);
            const float size = stray ? strays[i - TEST_COUNT(units)] : units[i];
            char what[40];
            snprintf(what, sizeof what, "%s %g", stray ? "strays at" : "size", (double)size);
            scaled_make(context, triangles, stray ? 1 : size, stray ? size : 0, &s);
            assert_true(s.scene->in_bands);
            work_is_bounded(&one, &s, what);
            scaled_free(&s);
        }
        scaled_free(&one);
    }
    cgt_context_release(context);
}

TEST(statistics_cover_bands)
{
    cgt_context *context = context_make(1, NULL);
    scaled_scene s;
    cgt_scene_statistics st;
    scaled_make(context, false, 1, 1e20f, &s); /* enough rays for a BVH beside the grid */
    assert_int_equal(cgt_scene_get_statistics(s.scene, &st), CGT_OK);
    assert_int_equal(st.structure, CGT_STRUCTURE_LOOSE_GRID);
    assert_int_equal(st.spheres, CLOUD);
    assert_non_null(strstr(st.reason, "2 bands"));
    assert_true(st.structure_bytes > 0 && st.bvh_bytes > 0 && st.bvh_build_ms > 0);
    assert_true(st.bytes == cgt_scene_bytes(s.scene));
    assert_true(st.bytes > s.scene->bands->band[0].scene->statistics.bytes + CLOUD * 16);
    assert_true(st.bounds_max[0] > 1e19f || st.bounds_min[0] < -1e19f);
    s.sphere[0][0] = NAN; /* back to an ordinary scene, and into bands again */
    for (uint32_t i = CLOUD - 5; i < CLOUD; i++)
        memcpy(s.sphere[i], s.sphere[1], sizeof s.sphere[i]);
    assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
    assert_false(s.scene->in_bands);
    assert_int_equal(cgt_scene_get_statistics(s.scene, &st), CGT_OK);
    assert_int_equal(st.skipped_not_finite, 1);
    assert_null(strstr(st.reason, "bands"));
    s.sphere[7][1] = 3e38f;
    assert_int_equal(cgt_scene_commit(s.scene), CGT_OK);
    assert_true(s.scene->in_bands);
    trace_scaled(&s, 1);
    scaled_free(&s);
    cgt_context_release(context);
}

SEEDED_SUITE("test_band_scales", NULL, NULL)
