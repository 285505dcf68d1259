/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * How triangles are decided: counters, the error of FAST, and that neither the scale of a scene nor the caller's
 * floating-point environment changes a hit. */
#include <fenv.h>
#include <math.h>
#include <string.h>

#include "support/oracle/oracle.h"
#include "primitive/triangle_scenes.h"

enum { COUNT = 80, RAYS = 1024 };

static triangle given[COUNT];
static truth_ray ray[RAYS];
static full_hit expected[RAYS], hit[RAYS];

static cgt_scene *make_scene(cgt_context *context, uint64_t stream)
{
    test_random r = random_make(stream);
    random_triangles(&r, 0.8f, given, COUNT);
    random_rays(&r, ray, RAYS);
    return scene_of_triangles(context, NULL, (const triangle *)given, COUNT);
}

/* ---- counts ---- */

/* Double precision cannot decide rays at edges, but decides those far from edges. */
static void decisions_are_counted(void **state)
{
    (void)state;
    static const triangle t = {{-8, -8, 0}, {8, -8, 0}, {0, 8, 0}};
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = scene_of_triangles(context, NULL, &t, 1);
        test_random r = random_make(500);
        cgt_trace_statistics inside, edges;
        cgt_trace_options options = with_precision(CGT_PRECISION_ROBUST);
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
        trace_all(scene, ray, RAYS, hit, &options);
        assert_int_equal(edges.double_tests + edges.exact_tests + edges.exact_values, 0);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* ---- FAST ---- */

static double length_of(const float d[3])
{
    return sqrt((double)d[0] * d[0] + (double)d[1] * d[1] + (double)d[2] * d[2]);
}

static void fast_is_close_on_ordinary_scenes(void **state)
{
    (void)state;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        for (int test = 0; test <= CGT_TRIANGLE_TEST_ACCELERATED; test++) {
            uint64_t rays = 0, same = 0;
            double t = 0, uv = 0, normal = 0;
            cgt_trace_options fast = with_precision(CGT_PRECISION_FAST);
            const cgt_research_trace_options research = {.triangle_test = (cgt_triangle_test)test};
            fast.research = &research;
            for (uint32_t round = 0; round < 4 + test_scaled(variant_is_outer(variant) ? 16 : 4); round++) {
                cgt_scene *scene = make_scene(context, 600 + round);
                trace_all(scene, ray, RAYS, expected, NULL);
                trace_all(scene, ray, RAYS, hit, &fast);
                for (int i = 0; i < RAYS; i++) {
                    const bool equal =
                        hit[i].geometry == expected[i].geometry && hit[i].primitive == expected[i].primitive;
                    rays++;
                    same += equal;
                    if (!equal || hit[i].geometry == CGT_INVALID_ID)
                        continue;
                    t = fmax(t, fabs((double)hit[i].t - expected[i].t) * length_of(ray[i].dir));
                    for (int k = 0; k < 2; k++)
                        uv = fmax(uv, fabs((double)hit[i].uv[k] - expected[i].uv[k]));
                    for (int a = 0; a < 3; a++)
                        normal = fmax(normal, fabs((double)hit[i].normal[a] - expected[i].normal[a]));
                }
                cgt_scene_release(scene);
            }
            print_message("%s, test %d: %llu of %llu rays differ, t within %.2g units, u and v %.2g, normal %.2g\n",
                          variant, test, (unsigned long long)(rays - same), (unsigned long long)rays, t, uv, normal);
            assert_true(test == CGT_TRIANGLE_TEST_AUTO ? same == rays : same * 1000 >= rays * 999);
            assert_true(t < 1e-4 && uv < 1e-3 && normal < 1e-5);
        }
        cgt_context_release(context);
    }
}

/* ---- extreme numbers ---- */

/* Scenes and rays of any scale. The oracle judges ids, and t to 0.51 ulp. */
static void judge_scaled(cgt_context *context, test_random *r, int size, int away, int length)
{
    enum { FEW = 192 };
    oracle_scene truth = {0};
    random_triangles(r, 0.8f, given, COUNT);
    random_rays(r, ray, FEW);
    for (int i = 0; i < COUNT * 9; i++)
        given[i / 9][i / 3 % 3][i % 3] = ldexpf(given[i / 9][i / 3 % 3][i % 3], size);
    for (int i = 0; i < FEW; i++)
        for (int a = 0; a < 3; a++) {
            const float to = given[i % COUNT][i / COUNT][a];
            ray[i].org[a] = ldexpf(ray[i].org[a], size + away);
            ray[i].dir[a] = (float)ldexp((double)to * (i % 2 ? 1 : 0.99) - ray[i].org[a], length - size - away);
        }
    oracle_scene_add_triangles(&truth, 0, (const float(*)[3])given[0], 3 * COUNT, NULL, COUNT);
    cgt_scene *scene = scene_of_triangles(context, NULL, (const triangle *)given, COUNT);
    trace_all(scene, ray, FEW, hit, NULL);
    for (int i = 0; i < FEW; i++) {
        oracle_hit of;
        const oracle_verdict verdict = oracle_judge(&truth, &ray[i], hit[i].geometry, hit[i].primitive, &of);
        if (verdict != ORACLE_RIGHT || (of.index != ORACLE_NONE && !(oracle_ulp(of.t, hit[i].t) <= 0.51)))
            fail_msg("scale 2^%d, %d away, directions of 2^%d, ray %d: verdict %d", size, away, length, i, verdict);
    }
    oracle_scene_free(&truth);
    cgt_scene_release(scene);
}

static void any_scale_is_exact(void **state)
{
    (void)state;
    static const int sizes[] = {-148, -140, -126, -100, -50, 0, 50, 54, 55, 56, 70, 100, 120};
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        test_random r = random_make(700);
        for (uint32_t round = 0; round < TEST_COUNT(sizes) * (1 + test_scaled(5)); round++) {
            const int size = sizes[round % TEST_COUNT(sizes)], away = size > 100 ? 0 : (int)random_below(&r, 20);
            const int length = round < TEST_COUNT(sizes) ? 0 : (int)random_below(&r, 140) - 70;
            /* t is about 2^(size + away - length): within float's range, or there is no hit */
            judge_scaled(context, &r, size, away, length);
        }
        cgt_context_release(context);
    }
}

/* Rays towards a scene of ordinary size, among them rays from beyond 2^55 and with directions below 2^-55. */
static void extreme_rays_at_ordinary_scenes(void **state)
{
    (void)state;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        oracle_scene truth = {0};
        cgt_scene *scene = make_scene(context, 800);
        uint32_t hits = 0;
        for (int i = 0; i < 256; i++)
            for (int a = 0; a < 3; a++) {
                if (i % 8 == 3) /* straight along x from far away */
                    ray[i].org[a] = a ? given[i % COUNT][0][a] * 0.9f : -0x1p60f;
                if (i % 8 == 3)
                    ray[i].dir[a] = a ? 0 : 0x1p10f;
                if (i % 8 == 5)
                    ray[i].dir[a] = ldexpf(ray[i].dir[a], -100);
            }
        oracle_scene_add_triangles(&truth, 0, (const float(*)[3])given[0], 3 * COUNT, NULL, COUNT);
        trace_all(scene, ray, 256, hit, NULL);
        for (int i = 0; i < 256; i++) {
            oracle_hit of;
            assert_int_equal(oracle_judge(&truth, &ray[i], hit[i].geometry, hit[i].primitive, &of), ORACLE_RIGHT);
            hits += i % 8 == 3 && hit[i].geometry != CGT_INVALID_ID;
        }
        assert_true(hits > 3);
        oracle_scene_free(&truth);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* ---- the caller's floating-point environment ---- */

/* Switches the flushing of denormals; returns whether this machine can. */
#if defined(__x86_64__)
#define FLUSH 0x8040u /* denormal operands and results */
static bool set_flush(bool on)
{
    const unsigned control = __builtin_ia32_stmxcsr();
    __builtin_ia32_ldmxcsr(on ? control | FLUSH : control & ~FLUSH);
    return true;
}
static bool flushes(void) { return (__builtin_ia32_stmxcsr() & FLUSH) == FLUSH; }
#else
static bool set_flush(bool on)
{
    (void)on;
    return false;
}
static bool flushes(void) { return true; }
#endif

enum { WIDTH = 72, HEIGHT = 72 };

typedef struct results {
    full_hit hit[RAYS];
    uint8_t occluded[RAYS];
    float t[HEIGHT][WIDTH], uv[2][HEIGHT][WIDTH];
    float bounds[6];
} results;

/* Runs everything from the commit on. */
static void run_all(cgt_scene *scene, float scale, results *to)
{
    const cgt_rays rays = ray_array(ray, RAYS);
    const cgt_hits hits = hit_array(to->hit);
    cgt_scene_statistics s;
    cgt_camera camera;
    cgt_frame frame;
    memset(to, 0x77, sizeof *to);
    cgt_camera_init(&camera);
    camera.eye[2] = 5 * scale;
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame.t = to->t[0];
    frame.u = to->uv[0][0];
    frame.v = to->uv[1][0];
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
    assert_int_equal(cgt_occluded_rays(scene, &rays, to->occluded, NULL), CGT_OK);
    if (camera.eye[2] > 0x1p-100f) /* the camera's arithmetic is meant for scenes of visible size */
        assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_OK);
    assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
    memcpy(to->bounds, s.bounds_min, sizeof s.bounds_min);
    memcpy(to->bounds + 3, s.bounds_max, sizeof s.bounds_max);
}

static cgt_scene *scaled_scene(cgt_context *context, uint64_t stream, int scale)
{
    cgt_scene *scene = make_scene(context, stream);
    for (int i = 0; i < COUNT * 9; i++)
        given[i / 9][i / 3 % 3][i % 3] = ldexpf(given[i / 9][i / 3 % 3][i % 3], scale);
    for (int i = 0; i < RAYS; i++)
        for (int a = 0; a < 3; a++)
            ray[i].org[a] = ldexpf(ray[i].org[a], scale);
    return scene;
}

static void rounding_modes_change_nothing(void **state)
{
    (void)state;
    static const int modes[] = {
#ifdef FE_UPWARD
        FE_UPWARD,
#endif
#ifdef FE_DOWNWARD
        FE_DOWNWARD,
#endif
#ifdef FE_TOWARDZERO
        FE_TOWARDZERO,
#endif
        FE_TONEAREST};
    static results plain, other;
    FOR_EACH_VARIANT(variant)
    {
        for (uint32_t threads = 1; threads < 3; threads++) {
            cgt_context *context = context_make(threads, variant);
            cgt_scene *scene = scaled_scene(context, 900, 0);
            run_all(scene, 1, &plain);
            assert_true(hits_in(plain.hit, RAYS) > RAYS / 4);
            for (size_t m = 0; m < TEST_COUNT(modes); m++) {
                assert_int_equal(fesetround(modes[m]), 0);
                run_all(scene, 1, &other);
                const int after = fegetround();
                fesetround(FE_TONEAREST);
                assert_int_equal(after, modes[m]);
                assert_memory_equal(&plain, &other, sizeof plain);
            }
            cgt_scene_release(scene);
            cgt_context_release(context);
        }
    }
}

/* Vertices that are denormal or nearly so. */
static void flushed_denormals_change_nothing(void **state)
{
    (void)state;
    static const int scales[] = {0, -120, -127, -140};
    static results plain, other;
    if (!set_flush(false)) {
        print_message("this test does not know how to flush denormals on this machine\n");
        skip();
    }
    FOR_EACH_VARIANT(variant)
    {
        for (uint32_t threads = 1; threads < 3; threads++)
            for (size_t k = 0; k < TEST_COUNT(scales); k++) {
                cgt_context *context = context_make(threads, variant);
                cgt_scene *scene = scaled_scene(context, 950, scales[k]);
                const float scale = ldexpf(1, scales[k]);
                run_all(scene, scale, &plain);
                assert_true(hits_in(plain.hit, RAYS) > RAYS / 8);
                set_flush(true);
                run_all(scene, scale, &other);
                const bool unchanged = flushes();
                set_flush(false);
                assert_true(unchanged);
                assert_memory_equal(&plain, &other, sizeof plain);
                cgt_scene_release(scene);
                cgt_context_release(context);
            }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decisions_are_counted),
        cmocka_unit_test(fast_is_close_on_ordinary_scenes),
        cmocka_unit_test(any_scale_is_exact),
        cmocka_unit_test(extreme_rays_at_ordinary_scenes),
        cmocka_unit_test(rounding_modes_change_nothing),
        cmocka_unit_test(flushed_denormals_change_nothing),
    };
    test_begin("test_triangle_modes");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
