/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * FAST precision through trees and grids, with every triangle test. By default it finds the primitives of EXACT; with
 * the tests of single precision nearly always. t, u, v and the normal are close to those of EXACT; any hit exists where
 * a closest hit does; no result is NaN; and closed meshes do not leak at shared edges. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hard_cases/hard_run.h"
#include "support/suite.h"
#include "primitive/triangle_scenes.h"

enum { RAYS = 1024, TRIANGLES = 150, SPHERES = 50 };

/* ---- ways through structures ---- */

static cgt_scene *commit(cgt_context *context, const hard_scene *s, const test_way *w)
{
    cgt_scene *scene;
    if (hard_commit_with(context, s, SCENE_OPTIONS(&w->scene), &scene) != CGT_OK)
        fail_msg("%s", context_message(context));
    return scene;
}

static test_trace_options fast_way(const test_way *w, int test, bool mailbox)
{
    test_trace_options options = {.precision = CGT_PRECISION_FAST};
    options.kd_traversal = w->traversal;
    options.triangle_test = (cgt_triangle_test)test;
    options.mailbox = mailbox_of(mailbox);
    return options;
}

/* ---- ordinary scenes ---- */

/* other: hits of other primitives; off: values beyond 1e-4 units of length, 1e-3 of u and v, 1e-4 of the normal. In a
 * triangle's plane t, u and v may be anything. */
typedef struct tally {
    uint64_t rays, hits, other, off;
} tally;

static double length_of(const float d[3])
{
    return sqrt((double)d[0] * d[0] + (double)d[1] * d[1] + (double)d[2] * d[2]);
}

static bool is_number(const full_hit *h)
{
    const float sum = h->uv[0] + h->uv[1] + h->normal[0] + h->normal[1] + h->normal[2];
    return h->geometry == CGT_INVALID_ID ? !isnan(h->t) && !isnan(sum) : isfinite(h->t) && isfinite(sum);
}

static void judge(const truth_ray *ray, const full_hit *exact, const full_hit *fast, bool decided, tally *sum)
{
    const bool same = fast->geometry == exact->geometry && fast->primitive == exact->primitive;
    double uv = 0, normal = 0;
    sum->rays++;
    sum->hits += fast->geometry != CGT_INVALID_ID;
    sum->other += !same;
    assert_true(is_number(fast));
    if (!same && decided)
        fail_msg("geometry %d, primitive %d at %a, but %d, %d at %a; org %a %a %a dir %a %a %a", (int)fast->geometry,
                 (int)fast->primitive, (double)fast->t, (int)exact->geometry, (int)exact->primitive, (double)exact->t,
                 (double)ray->org[0], (double)ray->org[1], (double)ray->org[2], (double)ray->dir[0],
                 (double)ray->dir[1], (double)ray->dir[2]);
    if (!same || exact->geometry == CGT_INVALID_ID)
        return;
    for (int k = 0; k < 2; k++)
        uv = fmax(uv, fabs((double)fast->uv[k] - (double)exact->uv[k]));
    for (int a = 0; a < 3; a++)
        normal = fmax(normal, fabs((double)fast->normal[a] - (double)exact->normal[a]));
    sum->off += fabs((double)fast->t - (double)exact->t) * length_of(ray->dir) > 1e-4 || uv > 1e-3 || normal > 1e-4;
}

/* Triangles and spheres about the origin. */
static hard_scene make_scene(test_random *r)
{
    hard_scene s = {.place = {.scale = 1}};
    triangle given[TRIANGLES];
    random_triangles(r, 0.3f, given, TRIANGLES);
    hard_new_geometry(&s);
    for (int i = 0; i < TRIANGLES; i++)
        hard_raw_triangle(&s, (const float(*)[3])given[i]);
    hard_new_geometry(&s);
    for (int i = 0; i < SPHERES; i++) {
        float sphere[4] = {0, 0, 0, random_log(r, 0.01f, 0.15f)};
        for (int a = 0; a < 3; a++)
            sphere[a] = random_float(r, -1, 1);
        hard_raw_sphere(&s, sphere);
    }
    assert_false(s.failed);
    return s;
}

static void check_scene(cgt_scene *scene, const truth_ray *ray, const full_hit *exact,
                        const test_trace_options *options, tally *sum)
{
    static full_hit hit[RAYS];
    static uint8_t occluded[RAYS];
    const cgt_rays rays = ray_array(ray, RAYS);
    memset(hit, 0x77, sizeof hit);
    memset(occluded, 0x77, sizeof occluded);
    trace_all(scene, ray, RAYS, hit, TRACE_OPTIONS(options));
    assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, TRACE_OPTIONS(options)), CGT_OK);
    for (int i = 0; i < RAYS; i++) {
        judge(&ray[i], &exact[i], &hit[i], options->triangle_test == CGT_TRIANGLE_TEST_AUTO, sum);
        assert_int_equal(occluded[i], hit[i].geometry != CGT_INVALID_ID);
    }
}

TEST(fast_is_close_to_exact)
{
    static truth_ray ray[RAYS];
    static full_hit exact[RAYS];
    /* In a sample two rounds share the ways. The number of rays stays, since the test bounds the share of differing
     * hits. */
    const uint32_t step = test_samples() ? 2 : 1;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        tally sum = {0};
        for (uint32_t round = 0; round < 1 + test_scaled(variant_is_outer(variant) ? 9 : 3); round++) {
            test_random r = random_make(600 + round);
            hard_scene s = make_scene(&r);
            random_rays(&r, ray, RAYS);
            for (uint32_t k = test_sample_start(round, step); k < way_count(WAY_TRAVERSAL); k += step) {
                const test_way *w = way_in_turn(WAY_TRAVERSAL, k);
                cgt_scene *scene = commit(context, &s, w);
                trace_all(scene, ray, RAYS, exact, NULL);
                for (int test = 0; test <= CGT_TRIANGLE_TEST_ACCELERATED; test++) {
                    const test_trace_options fast = fast_way(w, test, (round + k / step) % 2);
                    check_scene(scene, ray, exact, &fast, &sum);
                }
                cgt_scene_release(scene);
            }
            hard_scene_free(&s);
        }
        print_message("%s: %llu rays, %llu hits, %llu of other primitives, %llu off\n", variant,
                      (unsigned long long)sum.rays, (unsigned long long)sum.hits, (unsigned long long)sum.other,
                      (unsigned long long)sum.off);
        assert_true(sum.hits > sum.rays / 4);
        assert_true(sum.other * 10000 <= sum.rays && sum.off * 10000 <= sum.rays);
        cgt_context_release(context);
    }
}

/* ---- closed meshes ---- */

/* Whether ray i is aimed at a vertex, where more than two triangles meet and each may round to a miss. */
static bool at_vertex(uint32_t i) { return i % 8 == 0; }

/* Rays from inside at vertices and at points of edges. */
static hard_scene make_closed(closed_kind kind, uint64_t stream)
{
    hard_scene s = {.wanted = test_samples() ? 320 : RAYS, .place = {.scale = 1}, .random = random_make(stream)};
    float org[3] = {0}, v[3][3], point[3];
    hard_closed_mesh(&s, kind, kind == CLOSED_CUBE || kind == CLOSED_OCTAHEDRON ? 4 : 12);
    for (uint32_t n = 0; hard_wants_ray(&s); n++) {
        if (n % 32 == 0) {
            double inside[3];
            closed_mesh_inside(&(closed_mesh){.kind = kind}, &s.random, inside);
            hard_put(&s, inside, org);
        }
        assert_true(hard_any_triangle(&s, v));
        const uint32_t k = random_below(&s.random, 3);
        const double share = at_vertex(n) ? 0 : n % 4 ? hard_real(&s, 0.01, 0.99) : 0.5;
        for (int a = 0; a < 3; a++)
            point[a] = (float)(v[k][a] + share * ((double)v[(k + 1) % 3][a] - v[k][a]));
        hard_aim(&s, org, point, 1);
    }
    assert_false(s.failed);
    return s;
}

typedef struct leaks {
    uint64_t rays, edges, vertices; /* rays that leak at an edge, at a vertex */
} leaks;

static void count_leaks(const cgt_scene *scene, const hard_scene *s, const test_trace_options *options, leaks *sum)
{
    static full_hit hit[RAYS];
    trace_all(scene, s->ray, s->rays, hit, TRACE_OPTIONS(options));
    for (uint32_t i = 0; i < s->rays; i++) {
        assert_true(is_number(&hit[i]));
        sum->rays++;
        if (hit[i].geometry == CGT_INVALID_ID)
            ++*(at_vertex(i) ? &sum->vertices : &sum->edges);
    }
}

TEST(closed_meshes_do_not_leak)
{
    leaks sum = {0}, others = {0};
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        for (uint32_t round = 0; round < CLOSED_KINDS * test_scaled(4); round++) {
            hard_scene s = make_closed((closed_kind)(round % CLOSED_KINDS), 700 + round);
            FOR_EACH_WAY(w, WAY_TRAVERSAL)
            {
                cgt_scene *scene = commit(context, &s, w);
                test_trace_options fast = fast_way(w, CGT_TRIANGLE_TEST_WATERTIGHT, round % 2);
                count_leaks(scene, &s, &fast, &sum);
                fast.triangle_test = CGT_TRIANGLE_TEST_MOLLER_TRUMBORE;
                count_leaks(scene, &s, &fast, &others);
                cgt_scene_release(scene);
            }
            hard_scene_free(&s);
        }
        cgt_context_release(context);
    }
    print_message("%llu rays: %llu leak at edges, %llu at vertices; with Moeller-Trumbore %llu and %llu\n",
                  (unsigned long long)sum.rays, (unsigned long long)sum.edges, (unsigned long long)sum.vertices,
                  (unsigned long long)others.edges, (unsigned long long)others.vertices);
    assert_true(others.edges > 0); /* the rays pass where single precision leaks */
    assert_int_equal(sum.edges, 0);
    assert_true(sum.vertices * 200 < sum.rays);
}

SEEDED_SUITE("test_fast_structures", NULL, NULL)
