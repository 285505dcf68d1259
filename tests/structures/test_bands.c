/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Coordinates of any magnitude: the hits are those of exact decisions for every ray and every primitive, bit by bit.
 * Plans of bands, and what statistics say of them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "builders/bands/bands_commit.h"
#include "support/suite.h"
#include "scene/bands.h"
#include "structures/scenes/band_scenes.h"

static const test_scene_options every_structure[] = {
    {.structure = CGT_STRUCTURE_AUTO},       {.rays = CGT_RAY_KIND_INCOHERENT}, {.structure = CGT_STRUCTURE_LOOSE_GRID},
    {.structure = CGT_STRUCTURE_QUEUE_GRID}, {.structure = CGT_STRUCTURE_KD},   {.structure = CGT_STRUCTURE_KD_ROPES},
    {.structure = CGT_STRUCTURE_BIH}};

/* ---- against exact decisions ---- */

static void same_hits(const full_hit *want, const full_hit *got, const band_rays *q, const char *where)
{
    for (uint32_t i = 0; i < BAND_RAYS; i++)
        if (memcmp(&want[i], &got[i], sizeof want[i]) != 0)
            fail_msg("%s: ray %u: org %a %a %a dir %a %a %a range %a %a: want %u of %u at %a, got %u of %u at %a",
                     where, i, (double)q->org[0][i], (double)q->org[1][i], (double)q->org[2][i], (double)q->dir[0][i],
                     (double)q->dir[1][i], (double)q->dir[2][i], (double)q->t_min[i], (double)q->t_max[i],
                     want[i].primitive, want[i].geometry, (double)want[i].t, got[i].primitive, got[i].geometry,
                     (double)got[i].t);
}

/* The same rays one by one; but for ranges that end at 0, which such a ray cannot have. */
static void compare_single_rays(const cgt_scene *got_of, const band_rays *q, const cgt_rays *rays, const full_hit *want,
                                const cgt_trace_options *options)
{
    static full_hit got[BAND_RAYS];
    for (uint32_t i = 0; i < BAND_RAYS; i++) {
        const cgt_hit skip = {.primitive = rays->skip_primitive ? rays->skip_primitive[i] : CGT_INVALID_ID,
                              .geometry = rays->skip_geometry ? rays->skip_geometry[i] : 0};
        const cgt_single_ray ray = {.org = {rays->org[0][i], rays->org[1][i], rays->org[2][i]},
                                    .dir = {rays->dir[0][i], rays->dir[1][i], rays->dir[2][i]},
                                    .t_min = rays->t_min[i],
                                    .t_max = rays->t_max[i],
                                    .mask = rays->mask ? rays->mask[i] : 0,
                                    .skip = &skip};
        cgt_hit hit;
        bool occluded;
        got[i] = want[i];
        if (ray.t_max == 0)
            continue;
        assert_int_equal(cgt_trace_ray(got_of, &ray, &hit, options), CGT_OK);
        assert_int_equal(cgt_occluded_ray(got_of, &ray, &occluded, options), CGT_OK);
        assert_int_equal(occluded, want[i].primitive != CGT_INVALID_ID);
        got[i] = full_hit_of(&hit);
    }
    same_hits(want, got, q, "one by one");
}

static uint32_t compare_rays(const cgt_scene *want_of, const cgt_scene *got_of, const band_rays *q,
                             cgt_precision precision)
{
    static full_hit want[BAND_RAYS], got[BAND_RAYS];
    uint8_t occluded[BAND_RAYS];
    uint32_t hits = 0;
    cgt_rays rays = band_rays_all(q);
    const cgt_trace_options options = {.precision = precision};
    for (int selected = 0; selected < 2; selected++) {
        if (!selected)
            rays.mask = rays.skip_primitive = rays.skip_geometry = NULL;
        else
            rays = band_rays_all(q);
        const cgt_hits to_want = hit_array(want), to_got = hit_array(got);
        assert_int_equal(cgt_trace_rays(want_of, &rays, &to_want, &options), CGT_OK);
        assert_int_equal(cgt_trace_rays(got_of, &rays, &to_got, &options), CGT_OK);
        same_hits(want, got, q, selected ? "selected" : "all");
        compare_single_rays(got_of, q, &rays, want, &options);
        assert_int_equal(cgt_occluded_rays(got_of, &rays, occluded, &options), CGT_OK);
        for (uint32_t i = 0; i < BAND_RAYS; i++) {
            const bool hit = want[i].primitive != CGT_INVALID_ID;
            hits += hit;
            if (occluded[i] != hit)
                fail_msg("occluded: ray %u: want %d: org %a %a %a dir %a %a %a range %a %a, at %a", i, hit,
                         (double)q->org[0][i], (double)q->org[1][i], (double)q->org[2][i], (double)q->dir[0][i],
                         (double)q->dir[1][i], (double)q->dir[2][i], (double)q->t_min[i], (double)q->t_max[i],
                         (double)want[i].t);
        }
    }
    /* ranges that end at the hits, and beside them */
    band_rays ends = *q;
    for (uint32_t i = 0; i < BAND_RAYS; i++) {
        const float t = want[i].t;
        float *end = i & 1 ? &ends.t_min[i] : &ends.t_max[i];
        if (fabsf(t) < INFINITY)
            *end = i & 4 ? t : nextafterf(t, i & 2 ? INFINITY : -INFINITY);
    }
    const cgt_rays at_ends = band_rays_all(&ends);
    const cgt_hits to_want = hit_array(want), to_got = hit_array(got);
    assert_int_equal(cgt_trace_rays(want_of, &at_ends, &to_want, &options), CGT_OK);
    assert_int_equal(cgt_trace_rays(got_of, &at_ends, &to_got, &options), CGT_OK);
    same_hits(want, got, &ends, "ends");
    compare_single_rays(got_of, &ends, &at_ends, want, &options);
    assert_int_equal(cgt_occluded_rays(got_of, &at_ends, occluded, &options), CGT_OK);
    for (uint32_t i = 0; i < BAND_RAYS; i++)
        assert_int_equal(occluded[i], want[i].primitive != CGT_INVALID_ID);
    return hits;
}

static void compare_lights(const cgt_scene *want_of, const cgt_scene *got_of, const band_rays *q, test_random *r)
{
    uint8_t want[BAND_RAYS], got[BAND_RAYS];
    const uint32_t at = random_below(r, BAND_RAYS);
    const bool selected = random_below(r, 2), ranges = random_below(r, 2);
    const cgt_points points = {.count = BAND_RAYS,
                               .position = {q->org[0], q->org[1], q->org[2]},
                               .t_min = ranges ? q->t_min : NULL,
                               .t_max = ranges ? q->t_max : NULL,
                               .mask = selected ? q->mask : NULL,
                               .skip_primitive = selected ? q->skip_primitive : NULL,
                               .skip_geometry = selected ? q->skip_geometry : NULL};
    for (int kind = 0; kind < 2; kind++) {
        const cgt_light light = {.kind = (cgt_light_kind)kind,
                                 .position = {kind ? q->dir[0][at] : q->org[0][at],
                                              kind ? q->dir[1][at] : q->org[1][at],
                                              kind ? q->dir[2][at] : q->org[2][at]}};
        assert_int_equal(cgt_occluded_points(want_of, &light, &points, want, NULL), CGT_OK);
        assert_int_equal(cgt_occluded_points(got_of, &light, &points, got, NULL), CGT_OK);
        assert_memory_equal(want, got, sizeof want);
    }
}

#define WIDTH 70u
#define HEIGHT 21u

static uint32_t compare_frames(const cgt_scene *want_of, const cgt_scene *got_of, const cgt_camera *camera,
                               const test_trace_options *options)
{
    planes want = planes_make(WIDTH, HEIGHT), got = planes_make(WIDTH, HEIGHT);
    float visible[2][WIDTH * HEIGHT];
    uint32_t hits = 0;
    const cgt_trace_options wanted = {.precision = options->precision};
    frame_trace(want_of, camera, &want, &wanted);
    frame_trace(got_of, camera, &got, TRACE_OPTIONS(options));
    for (size_t i = 0; i < want.elements; i++) {
        hits += want.primitive[i] != CGT_INVALID_ID;
        if (want.primitive[i] != got.primitive[i] || want.geometry[i] != got.geometry[i] ||
            !same_bits(want.t[i], got.t[i]))
            fail_msg("pixel %zu: want %u of %u at %a, got %u of %u at %a; eye %a %a %a", i, want.primitive[i],
                     want.geometry[i], (double)want.t[i], got.primitive[i], got.geometry[i], (double)got.t[i],
                     (double)camera->eye[0], (double)camera->eye[1], (double)camera->eye[2]);
    }
    for (size_t i = 0; i < want.elements; i++)
        for (int a = 0; a < 3; a++)
            if (!same_bits(want.normal[a][i], got.normal[a][i]))
                fail_msg("pixel %zu, precision %d: want %u of %u with a normal's component %a, got %a", i,
                         (int)options->precision, want.primitive[i], want.geometry[i], (double)want.normal[a][i],
                         (double)got.normal[a][i]);
    assert_true(planes_equal(&want, &got));
    /* ranges that end at hits, and beside them */
    cgt_camera ends = *camera;
    for (size_t i = 0; i < want.elements; i++)
        if (want.primitive[i] != CGT_INVALID_ID && want.t[i] > 0) {
            ends.t_min = i & 1 ? want.t[i] : nextafterf(want.t[i], INFINITY);
            break;
        }
    frame_trace(want_of, &ends, &want, &wanted);
    frame_trace(got_of, &ends, &got, TRACE_OPTIONS(options));
    assert_true(planes_equal(&want, &got));
    frame_trace(want_of, camera, &want, NULL);
    const cgt_frame frame = frame_of(&want);
    const cgt_ambient_options ambient = {.samples = 2};
    assert_int_equal(cgt_ambient_occlusion(want_of, camera, &frame, &ambient, visible[0], NULL), CGT_OK);
    assert_int_equal(cgt_ambient_occlusion(got_of, camera, &frame, &ambient, visible[1], NULL), CGT_OK);
    assert_memory_equal(visible[0], visible[1], sizeof visible[0]);
    planes_free(&want);
    planes_free(&got);
    return hits;
}

TEST(hits_are_exact_at_any_magnitude)
{
    const uint32_t rounds = 1 + test_scaled(24);
    uint32_t rays = 0, pixels = 0, banded = 0, apart = 0, turn = 0;
    cgt_context *reference_context = context_make(1, NULL);
    FOR_EACH_VARIANT(variant)
    {
        if (!variant_is_outer(variant))
            continue;
        cgt_context *context = context_make(2, variant);
        for (uint32_t round = 0; round < rounds * BAND_KINDS; round++, turn++) {
            test_random r = random_make(7000 + turn);
            const band_kind kind = (band_kind)(round % BAND_KINDS);
            band_scene s = band_scene_make(&r, kind, random_below(&r, 40), 1 + random_below(&r, 40));
            const test_scene_options *options = &every_structure[random_below(&r, TEST_COUNT(every_structure))];
            test_trace_options trace = {.packet = random_below(&r, 3) ? 0 : 8};
            static band_rays q;
            band_rays_make(&r, &s, &q);
            const cgt_camera camera = band_camera(&r, &s);
            cgt_scene *want = band_reference_commit(reference_context, &s),
                      *got = band_scene_commit(context, options, &s);
            print_message("turn %u of %s: kind %d, %u spheres, %u triangles, size %a, structure %d, bands %u\n", turn,
                          variant, (int)kind, s.spheres, s.triangles, (double)s.size[0], (int)options->structure,
                          got->in_bands ? got->bands->count : 0);
            banded += got->in_bands;
            apart += got->in_bands && got->bands->rest;
            rays += compare_rays(want, got, &q, (cgt_precision)random_below(&r, 2));
            compare_lights(want, got, &q, &r);
            pixels += compare_frames(want, got, &camera, &trace);
            trace.precision = CGT_PRECISION_FAST;
            pixels += compare_frames(want, got, &camera, &trace);
            cgt_scene_release(want);
            cgt_scene_release(got);
            band_scene_free(&s);
        }
        cgt_context_release(context);
    }
    cgt_context_release(reference_context);
    print_message("%u hits of rays, %u of pixels, %u of %u scenes in bands, %u with primitives apart\n", rays, pixels,
                  banded, turn, apart);
    assert_true(rays > turn * BAND_RAYS / 10);
    assert_true(pixels > turn * WIDTH * HEIGHT / 20);
    assert_true(banded > turn / 2 && apart > turn / 100);
}

/* An eye that is inside a sphere by a fifth of the least float: t of the near root is negative, rounds to -0, and
 * counts. The band, which has room for it, must not take it for a miss. */
TEST(an_eye_near_a_surface_sees_it)
{
    float sphere[1][4] = {{300 * 0x1p-149f, 401 * 0x1p-149f, 0, 501 * 0x1p-149f}};
    float vertex[3][3] = {{0x1p-140f, 0, 0}, {0x1p-140f, 0x1p-141f, 0}, {0x1p-140f, 0, 0x1p-141f}};
    const band_scene s = {.spheres = 1, .triangles = 1, .sphere = sphere, .vertex = vertex};
    const test_scene_options automatic = {.structure = CGT_STRUCTURE_AUTO};
    const cgt_camera camera = {.target = {300 * 0x1p-100f, 401 * 0x1p-100f, 0}, .up = {0, 0, 1}, .fov = 20};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *want = band_reference_commit(context, &s), *got = band_scene_commit(context, &automatic, &s);
    planes p = planes_make(WIDTH, HEIGHT);
    frame_trace(want, &camera, &p, NULL);
    assert_true(same_bits(p.t[0], -0.f));
    compare_frames(want, got, &camera, &(test_trace_options){0});
    planes_free(&p);
    cgt_scene_release(want);
    cgt_scene_release(got);
    cgt_context_release(context);
}

/* ---- plans ---- */

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

SEEDED_SUITE("test_bands", NULL, NULL)
