/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a hit on a triangle returns: t, u, v, the normal and ids, each only if requested; ties; any hit. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/oracle/oracle.h"
#include "support/suite.h"
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

/* ---- values ---- */

/* The errors of the values of hits, in ulp. */
typedef struct value_errors {
    double t, uv, normal;
    uint32_t hits, back; /* back: of those, from the side that the normal points away from */
} value_errors;

static void measure(cgt_context *context, value_errors *e)
{
    cgt_scene *scene = scene_of_triangles(context, NULL, (const triangle *)given, COUNT);
    oracle_scene truth = {0};
    oracle_scene_add_triangles(&truth, 0, (const float(*)[3])given[0], 3 * COUNT, NULL, COUNT);
    trace_all(scene, ray, RAYS, hit, NULL);
    for (int i = 0; i < RAYS; i++) {
        oracle_hit of;
        assert_int_equal(oracle_judge(&truth, &ray[i], hit[i].geometry, hit[i].primitive, &of), ORACLE_RIGHT);
        if (of.index == ORACLE_NONE)
            continue;
        const float *n = hit[i].normal, *d = ray[i].dir;
        e->hits++;
        e->back += n[0] * d[0] + n[1] * d[1] + n[2] * d[2] > 0;
        e->t = fmax(e->t, oracle_ulp(of.t, hit[i].t));
        for (int k = 0; k < 2; k++)
            e->uv = fmax(e->uv, oracle_ulp(of.uv[k], hit[i].uv[k]));
        for (int a = 0; a < 3; a++)
            e->normal = fmax(e->normal, oracle_ulp(of.normal[a], hit[i].normal[a]));
    }
    oracle_scene_free(&truth);
    cgt_scene_release(scene);
}

/* Seen from above, both edges run in nearly the same direction, and the first vertex has more digits than the others:
 * the normal's z is 2^-46 of the products whose difference it is, which double rounds at 2^-53. Every fourth triangle
 * has a z of that vertex alone, which edges in double lose; others have exact edges with rounded products. */
static void make_cancelling(uint64_t stream)
{
    test_random r = random_make(stream);
    random_rays(&r, ray, RAYS);
    for (int i = 0; i < COUNT; i++) {
        const bool lost = i % 4 == 0;
        const float digits = lost ? 0x1p-60f : i % 4 == 1 ? 0x1p-20f : 0x1p-36f, end = lost ? 2 : 1;
        const float slope = lost ? 1 : 1 + 0x1p-23f * (float)(1 + random_below(&r, 9)), twice = 1 + 2 * (slope - 1);
        const float size = ldexpf(1, (int)random_below(&r, 3) - 2), height = random_float(&r, 0.25f, 1);
        const triangle t = {{random_float(&r, 0, digits), random_float(&r, 0, digits), -height},
                            {size, size * slope, 0},
                            {size * slope * end, size * twice * end, lost ? 0 : height}};
        memcpy(given[i], t, sizeof t);
        for (int k = i; k < RAYS; k += COUNT)
            for (int a = 0; a < 3; a++)
                ray[k].dir[a] = 0.5f * t[0][a] + 0.25f * t[1][a] + 0.25f * t[2][a] - ray[k].org[a];
    }
}

TEST(values_are_within_an_ulp)
{
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        value_errors e = {0};
        for (uint32_t round = 0; round < 2 + test_scaled(variant_is_outer(variant) ? 15 : 3); round++) {
            cgt_scene_release(make_scene(context, 100 + round));
            measure(context, &e);
            make_cancelling(150 + round);
            measure(context, &e);
        }
        print_message("%s: %u hits, %u from behind: t within %.4f ulp, u and v %.4f, components of the normal %.4f\n",
                      variant, e.hits, e.back, e.t, e.uv, e.normal);
        assert_true(e.t <= 0.51 && e.uv <= 1 && e.normal <= 1);
        assert_true(e.back > e.hits / 8 && e.back < e.hits - e.hits / 8);
        cgt_context_release(context);
    }
}

/* ---- requested fields ---- */

TEST(any_set_of_fields)
{
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = make_scene(context, 200);
        trace_all(scene, ray, RAYS, expected, NULL);
        for (unsigned fields = 0; fields < 32; fields++) {
            const cgt_rays rays = ray_array(ray, RAYS);
            cgt_hits hits = hit_array(hit);
            memset(hit, 0x77, sizeof hit);
            hits.t = fields & CGT_FIELD_T ? hits.t : NULL;
            hits.primitive = fields & CGT_FIELD_PRIMITIVE ? hits.primitive : NULL;
            hits.geometry = fields & CGT_FIELD_GEOMETRY ? hits.geometry : NULL;
            for (int a = 0; a < 3; a++)
                hits.normal[a] = fields & CGT_FIELD_NORMAL ? hits.normal[a] : NULL;
            hits.u = fields & CGT_FIELD_UV ? hits.u : NULL;
            hits.v = fields & CGT_FIELD_UV ? hits.v : NULL;
            assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
            for (int i = 0; i < RAYS; i++) {
                full_hit want;
                memset(&want, 0x77, sizeof want);
                want.t = fields & CGT_FIELD_T ? expected[i].t : want.t;
                want.primitive = fields & CGT_FIELD_PRIMITIVE ? expected[i].primitive : want.primitive;
                want.geometry = fields & CGT_FIELD_GEOMETRY ? expected[i].geometry : want.geometry;
                if (fields & CGT_FIELD_NORMAL)
                    memcpy(want.normal, expected[i].normal, sizeof want.normal);
                if (fields & CGT_FIELD_UV)
                    memcpy(want.uv, expected[i].uv, sizeof want.uv);
                assert_memory_equal(&hit[i], &want, sizeof want);
            }
        }
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

TEST(spheres_among_triangles_have_no_uv)
{
    static const float sphere[1][4] = {{0, 0, 0, 1}};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = make_scene(context, 202);
    assert_int_equal(scene_add_spheres(scene, sphere, 1), 1);
    scene_commit(context, scene);
    trace_all(scene, ray, RAYS, hit, NULL);
    uint32_t of_kind[2] = {0, 0};
    for (int i = 0; i < RAYS; i++) {
        if (hit[i].geometry == CGT_INVALID_ID)
            continue;
        of_kind[hit[i].geometry]++;
        if (hit[i].geometry == 1)
            assert_true(hit[i].uv[0] == 0 && hit[i].uv[1] == 0);
    }
    assert_true(of_kind[0] > 50 && of_kind[1] > 50);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* ---- ties, and rays that share a plane ---- */

/* Every triangle three times, in two geometries, each with another corner first: with equal t the lowest ids win. */
TEST(the_lowest_ids_win)
{
    static triangle rotated[2 * COUNT];
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = make_scene(context, 300);
        uint64_t order = 0;
        for (int i = 0; i < RAYS; i++) /* also at edges and vertices, where neighbours tie */
            for (int a = 0; a < 3 && i % 2; a++)
                ray[i].dir[a] = given[i % COUNT][i % 3][a] - ray[i].org[a];
        trace_all(scene, ray, RAYS, expected, NULL);
        cgt_scene_release(scene);
        for (uint32_t i = 0; i < 2 * COUNT; i++)
            for (uint32_t k = 0; k < 3; k++)
                memcpy(rotated[i][k], given[i % COUNT][(k + i) % 3], sizeof rotated[i][k]);
        for (int first = 0; first < 2; first++) {
            scene = scene_begin(context);
            if (first)
                scene_add_triangles(scene, (const triangle *)given, COUNT);
            scene_add_triangles(scene, (const triangle *)rotated, 2 * COUNT);
            if (!first)
                scene_add_triangles(scene, (const triangle *)given, COUNT);
            scene_commit(context, scene);
            trace_all(scene, ray, RAYS, hit, NULL);
            for (int i = 0; i < RAYS; i++) {
                assert_int_equal(hit[i].geometry, expected[i].geometry == CGT_INVALID_ID ? CGT_INVALID_ID : 0);
                assert_int_equal(hit[i].primitive, expected[i].primitive);
                assert_true(same_bits(hit[i].t, expected[i].t));
                order += hit[i].geometry == 0;
            }
            cgt_scene_release(scene);
        }
        assert_true(order > 200);
        cgt_context_release(context);
    }
}

TEST(rays_in_a_triangles_plane_miss)
{
    static const triangle t = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    static const truth_ray in_plane[] = {
        {{-1, 1, 0}, {1, 0, 0}, 0, INFINITY},        {{-1, 0, 0}, {1, 0, 0}, 0, INFINITY}, /* along an edge */
        {{1, 1, 0}, {-1, -1, 0}, 0, INFINITY},       {{-1, 1, 0}, {1, 0, -0.f}, -INFINITY, INFINITY},
        {{-1, 1, 1}, {1, 0, 0}, 0, INFINITY}, /* next to the triangle */
        {{-1, 1, 0x1p-149f}, {1, 0, 0}, 0, INFINITY}};
    static const truth_ray through[] = {{{1, 1, 1}, {0, 0, -1}, 0, INFINITY},
                                        {{0, 0, 1}, {0, 0, -1}, 0, INFINITY}, /* a vertex */
                                        {{2, 0, -1}, {0, 0, 3}, 0, INFINITY}, /* an edge */
                                        {{2, 2, 1}, {0, 0, -1}, 0, INFINITY},
                                        {{1, 1, 0}, {0, 0, -1}, 0, INFINITY}, /* from the edge */
                                        {{-1, 1, 0x1p-149f}, {1, 0, -0x1p-149f}, 0, INFINITY},
                                        {{1, 1, -1}, {0, 0, -1}, -INFINITY, INFINITY}};
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = scene_of_triangles(context, NULL, &t, 1);
        trace_all(scene, in_plane, TEST_COUNT(in_plane), hit, NULL);
        assert_int_equal(hits_in(hit, TEST_COUNT(in_plane)), 0);
        trace_all(scene, through, TEST_COUNT(through), hit, NULL);
        assert_int_equal(hits_in(hit, TEST_COUNT(through)), TEST_COUNT(through));
        assert_true(hit[4].t == 0 && hit[5].t == 1 && hit[6].t == -1);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* ---- any hit ---- */

TEST(occluded_if_a_closest_hit_exists)
{
    static uint8_t occluded[RAYS];
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        for (uint32_t round = 0; round < 1 + test_scaled(8); round++) {
            cgt_scene *scene = make_scene(context, 400 + round);
            cgt_trace_statistics s;
            cgt_trace_options options = with_precision(round % 2 ? CGT_PRECISION_EXACT : CGT_PRECISION_FAST);
            options.statistics = &s;
            trace_all(scene, ray, RAYS, hit, &options);
            for (int i = 0; i < RAYS; i++) /* ranges that end at the hit, or just before */
                if (hit[i].geometry != CGT_INVALID_ID && i % 3)
                    ray[i].t_max = i % 3 == 1 ? hit[i].t : nextafterf(hit[i].t, -INFINITY);
            trace_all(scene, ray, RAYS, hit, &options);
            const cgt_rays rays = ray_array(ray, RAYS);
            assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, &options), CGT_OK);
            for (int i = 0; i < RAYS; i++)
                assert_int_equal(occluded[i], hit[i].geometry != CGT_INVALID_ID);
            assert_int_equal(s.hits, hits_in(hit, RAYS));
            assert_int_equal(s.rays, RAYS);
            cgt_scene_release(scene);
        }
        cgt_context_release(context);
    }
}

/* ---- counts ---- */

/* Double precision cannot decide rays at edges, but decides those far from edges. */
TEST(decisions_are_counted)
{
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

SEEDED_SUITE("test_triangle_hits", NULL, NULL)
