/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * FAST precision through trees and grids, with every triangle test. By default it finds the primitives of EXACT. With
 * the tests of single precision it does unless that cannot decide. t, u, v and the normal are close to those of EXACT;
 * any hit exists where a closest hit does; no result is NaN; and closed meshes do not leak at shared edges. */
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

/* ---- rays that single precision cannot decide ---- */

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Whether a line passes a triangle at an edge, or in its plane. */
static bool passes_edge(const oracle_primitive *q, const double org[3], const double dir[3])
{
    double e[2][3], s[3], n[3], dir_x_e1[3], s_x_e0[3];
    for (int a = 0; a < 3; a++) {
        s[a] = org[a] - q->data[a];
        for (int k = 0; k < 2; k++)
            e[k][a] = (double)q->data[3 * k + 3 + a] - q->data[a];
    }
    cross(e[0], e[1], n);
    cross(dir, e[1], dir_x_e1);
    cross(s, e[0], s_x_e0);
    const double den = dot(e[0], dir_x_e1), u = dot(s, dir_x_e1) / den, v = dot(dir, s_x_e0) / den;
    const double least = fmin(fmin(u, v), 1 - u - v);
    return !(fabs(den) > 1e-3 * sqrt(dot(dir, dir) * dot(n, n))) || fabs(least) < 1e-3;
}

static bool passes_silhouette(const oracle_primitive *q, const double org[3], const double dir[3])
{
    double c[3], side[3];
    for (int a = 0; a < 3; a++)
        c[a] = q->data[a] - org[a];
    cross(dir, c, side);
    const double distance = sqrt(dot(side, side) / dot(dir, dir)), r = q->data[3];
    return fabs(distance - r) < 1e-3 * r || fabs(sqrt(dot(c, c)) - r) < 1e-3 * r;
}

/* Whether deciding a hit of the reported primitive takes more than single precision. If none is reported, the other
 * result names the doubtful primitive. */
static bool in_doubt(const oracle_scene *scene, const full_hit *hit, const truth_ray *ray)
{
    double org[3], dir[3];
    if (hit->geometry == CGT_INVALID_ID)
        return false;
    for (int a = 0; a < 3; a++) {
        org[a] = ray->org[a];
        dir[a] = ray->dir[a];
    }
    const uint32_t first = hit->geometry ? TRIANGLES : 0; /* in the order of ids */
    assert_true(hit->primitive < scene->count - first);
    const oracle_primitive *q = &scene->primitive[first + hit->primitive];
    assert_true(q->geometry == hit->geometry && q->primitive == hit->primitive);
    return q->kind == ORACLE_TRIANGLE ? passes_edge(q, org, dir) : passes_silhouette(q, org, dir);
}

/* ---- ordinary scenes ---- */

typedef struct tally {
    uint64_t rays, hits, other;
    double t, uv, normal; /* the largest errors */
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

static void judge(const oracle_scene *truth, const truth_ray *ray, const full_hit *robust, const full_hit *fast,
                  bool decided, tally *sum)
{
    const double size = length_of(ray->dir), distance = fabs((double)fast->t - (double)robust->t) * size;
    const bool same = fast->geometry == robust->geometry && fast->primitive == robust->primitive;
    sum->rays++;
    sum->hits += fast->geometry != CGT_INVALID_ID;
    sum->other += !same;
    assert_true(is_number(fast));
    if (!same && (decided || (!(distance < 1e-4) && !in_doubt(truth, fast, ray) && !in_doubt(truth, robust, ray))))
        fail_msg("geometry %d, primitive %d at %a, but %d, %d at %a; org %a %a %a dir %a %a %a", (int)fast->geometry,
                 (int)fast->primitive, (double)fast->t, (int)robust->geometry, (int)robust->primitive,
                 (double)robust->t, (double)ray->org[0], (double)ray->org[1], (double)ray->org[2], (double)ray->dir[0],
                 (double)ray->dir[1], (double)ray->dir[2]);
    if (!same || robust->geometry == CGT_INVALID_ID || in_doubt(truth, robust, ray))
        return; /* in a triangle's plane t, u and v may be anything */
    sum->t = fmax(sum->t, distance);
    for (int k = 0; k < 2; k++)
        sum->uv = fmax(sum->uv, fabs((double)fast->uv[k] - (double)robust->uv[k]));
    for (int a = 0; a < 3; a++)
        sum->normal = fmax(sum->normal, fabs((double)fast->normal[a] - (double)robust->normal[a]));
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

static void check_scene(cgt_scene *scene, const hard_truth *truth, const truth_ray *ray, const full_hit *robust,
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
        judge(&truth->scene, &ray[i], &robust[i], &hit[i], options->triangle_test == CGT_TRIANGLE_TEST_AUTO, sum);
        assert_int_equal(occluded[i], hit[i].geometry != CGT_INVALID_ID);
    }
}

TEST(fast_is_close_to_robust)
{
    static truth_ray ray[RAYS];
    static full_hit robust[RAYS];
    /* In a sample two rounds share the ways. The number of rays stays, since the test bounds the share of differing
     * hits. */
    const uint32_t step = test_samples() ? 2 : 1;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        tally sum = {0};
        for (uint32_t round = 0; round < 1 + test_scaled(variant_is_outer(variant) ? 9 : 3); round++) {
            test_random r = random_make(600 + round);
            hard_truth truth;
            hard_scene s = make_scene(&r);
            random_rays(&r, ray, RAYS);
            assert_true(hard_truth_make(&s, &truth));
            for (uint32_t k = test_sample_start(round, step); k < way_count(WAY_TRAVERSAL); k += step) {
                const test_way *w = way_in_turn(WAY_TRAVERSAL, k);
                cgt_scene *scene = commit(context, &s, w);
                trace_all(scene, ray, RAYS, robust, NULL);
                for (int test = 0; test <= CGT_TRIANGLE_TEST_ACCELERATED; test++) {
                    const test_trace_options fast = fast_way(w, test, (round + k / step) % 2);
                    check_scene(scene, &truth, ray, robust, &fast, &sum);
                }
                cgt_scene_release(scene);
            }
            hard_truth_free(&truth);
            hard_scene_free(&s);
        }
        print_message("%s: %llu of %llu rays differ, %llu hits; t within %.2g units, u and v %.2g, normal %.2g\n",
                      variant, (unsigned long long)sum.other, (unsigned long long)sum.rays,
                      (unsigned long long)sum.hits, sum.t, sum.uv, sum.normal);
        assert_true(sum.hits > sum.rays / 4);
        assert_true(sum.other * 1000 <= sum.rays);
        assert_true(sum.t < 1e-4 && sum.uv < 1e-3 && sum.normal < 1e-4);
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
