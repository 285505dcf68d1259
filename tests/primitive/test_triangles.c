/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles in the public interface: layouts of arrays, several geometries of both kinds, updates, refused and
 * skipped input. test_triangle_hits.c tests what a hit returns. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "primitive/triangle_scenes.h"
#include "support/suite.h"

enum { COUNT = 60, RAYS = 512 };

static triangle given[COUNT];
static truth_ray ray[RAYS];
static full_hit expected[RAYS], hit[RAYS];

static void trace(const cgt_scene *scene, full_hit *to) { trace_all(scene, ray, RAYS, to, NULL); }

static void make_input(uint64_t stream)
{
    test_random r = random_make(stream);
    random_triangles(&r, 0.8f, given, COUNT);
    random_rays(&r, ray, RAYS);
}

/* ---- layouts ---- */

typedef struct vertex {
    uint32_t color;
    float position[3];
    float normal[4];
} vertex;

typedef struct face {
    uint32_t material, corner[3], smooth;
} face;

static void check_layout(cgt_context *context, const cgt_triangles *triangles)
{
    cgt_scene *scene = scene_begin(context);
    uint32_t id;
    assert_int_equal(cgt_scene_add_triangles(scene, triangles, &id), CGT_OK);
    scene_commit(context, scene);
    trace(scene, hit);
    assert_memory_equal(hit, expected, sizeof hit);
    cgt_scene_release(scene);
}

TEST(any_layout)
{
    static vertex packed[3 * COUNT];
    static face faces[COUNT];
    static uint32_t index[COUNT][3];
    make_input(1);
    for (uint32_t i = 0; i < 3 * COUNT; i++) { /* vertices in reverse order */
        const uint32_t from = 3 * COUNT - 1 - i;
        memset(&packed[i], 0xff, sizeof packed[i]);
        memcpy(packed[i].position, given[from / 3][from % 3], sizeof packed[i].position);
    }
    for (uint32_t i = 0; i < COUNT; i++)
        for (uint32_t k = 0; k < 3; k++) {
            index[i][k] = 3 * i + k;
            faces[i].corner[k] = 3 * COUNT - 1 - (3 * i + k);
            faces[i].material = faces[i].smooth = UINT32_MAX;
        }
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_triangles t = triangles_of((const triangle *)given, COUNT);
        cgt_scene *scene = scene_of_triangles(context, NULL, (const triangle *)given, COUNT);
        trace(scene, expected);
        cgt_scene_release(scene);
        assert_true(hits_in(expected, RAYS) > RAYS / 3);
        t.index_stride = 12;
        t.vertex_stride = 12;
        check_layout(context, &t);
        t.indices = index[0];
        check_layout(context, &t);
        t = (cgt_triangles){.count = COUNT,
                            .indices = faces[0].corner,
                            .index_stride = sizeof faces[0],
                            .vertex_count = 3 * COUNT,
                            .vertices = packed[0].position,
                            .vertex_stride = sizeof packed[0]};
        check_layout(context, &t);
        cgt_context_release(context);
    }
}

/* ---- several geometries ---- */

/* A row of primitives, one per unit along x, each a triangle or a sphere; a vertical ray at each finds its ids. */
static void expect_ids(const cgt_scene *scene, const uint32_t (*ids)[2], uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const truth_ray down = {{(float)i, 0.1f, 5}, {0, 0, -1}, 0, INFINITY};
        full_hit one;
        trace_all(scene, &down, 1, &one, NULL);
        assert_int_equal(one.geometry, ids[i][0]);
        assert_int_equal(one.primitive, ids[i][1]);
    }
}

TEST(several_geometries)
{
    static const uint32_t at_first[6][2] = {{0, 0}, {0, 1}, {1, 0}, {2, 0}, {2, 1}, {3, 0}};
    static const uint32_t without[6][2] = {{0, 0}, {0, 1}, {CGT_INVALID_ID, CGT_INVALID_ID}, {2, 0}, {2, 1}, {3, 0}};
    triangle t[6];
    float sphere[6][4];
    for (int i = 0; i < 6; i++) {
        const float x = (float)i;
        memcpy(t[i], (const triangle){{x - 0.3f, -0.3f, 0}, {x + 0.3f, -0.3f, 0}, {x, 0.5f, 0}}, sizeof t[i]);
        memcpy(sphere[i], (const float[4]){x, 0, 0, 0.4f}, sizeof sphere[i]);
    }
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = scene_begin(context);
        cgt_scene_statistics s;
        uint32_t id;
        assert_int_equal(scene_add_triangles(scene, (const triangle *)t, 2), 0);
        assert_int_equal(scene_add_spheres(scene, (const float(*)[4])sphere + 2, 1), 1);
        assert_int_equal(scene_add_triangles(scene, (const triangle *)t + 3, 2), 2);
        assert_int_equal(scene_add_spheres(scene, (const float(*)[4])sphere + 5, 1), 3);
        scene_commit(context, scene);
        expect_ids(scene, at_first, 6);
        assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
        assert_int_equal(s.geometries, 4);
        assert_int_equal(s.spheres, 2);
        assert_int_equal(s.triangles, 4);
        assert_int_equal(s.primitives, 6);
        assert_int_equal(cgt_scene_remove_geometry(scene, 1), CGT_OK);
        assert_int_equal(cgt_scene_remove_geometry(scene, 1), CGT_ERROR_INVALID_ARGUMENT);
        scene_commit(context, scene);
        expect_ids(scene, without, 6);
        assert_int_equal(scene_add_triangles(scene, (const triangle *)t + 2, 1), 1); /* the id became free */
        scene_commit(context, scene);
        expect_ids(scene, at_first, 6);
        /* the third geometry gets one more triangle */
        const cgt_triangles more = triangles_of((const triangle *)t + 3, 3);
        assert_int_equal(cgt_scene_update_triangles(scene, 2, &more), CGT_OK);
        assert_int_equal(cgt_scene_remove_geometry(scene, 3), CGT_OK);
        scene_commit(context, scene);
        expect_ids(scene, (const uint32_t[6][2]){{0, 0}, {0, 1}, {1, 0}, {2, 0}, {2, 1}, {2, 2}}, 6);
        const cgt_triangles none = {0};
        assert_int_equal(cgt_scene_update_triangles(scene, 2, &none), CGT_OK);
        assert_int_equal(cgt_scene_add_triangles(scene, &none, &id), CGT_OK);
        scene_commit(context, scene);
        expect_ids(scene, (const uint32_t[4][2]){{0, 0}, {0, 1}, {1, 0}, {CGT_INVALID_ID, CGT_INVALID_ID}}, 4);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* ---- refused input ---- */

TEST(a_geometry_keeps_its_kind)
{
    static const float sphere[1][4] = {{0, 0, 0, 0.5f}};
    cgt_context *context = context_make(1, NULL);
    make_input(5);
    cgt_scene *scene = scene_of_triangles(context, NULL, (const triangle *)given, COUNT);
    const cgt_spheres spheres = spheres_of(sphere, 1);
    const cgt_triangles triangles = triangles_of((const triangle *)given, COUNT);
    assert_int_equal(scene_add_spheres(scene, sphere, 1), 1);
    scene_commit(context, scene);
    trace(scene, expected);
    assert_int_equal(cgt_scene_update_spheres(scene, 0, &spheres), CGT_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(context_message(context), "geometry 0 is one of triangles"));
    assert_int_equal(cgt_scene_update_triangles(scene, 1, &triangles), CGT_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(context_message(context), "geometry 1 is one of spheres"));
    trace(scene, hit);
    assert_memory_equal(hit, expected, sizeof hit);
    assert_int_equal(cgt_scene_remove_geometry(scene, 1), CGT_OK); /* then the id is free for either kind */
    assert_int_equal(scene_add_triangles(scene, (const triangle *)given, 1), 1);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* ---- indices out of range ---- */

TEST(bad_indices_fail_the_commit)
{
    static uint32_t index[COUNT][3];
    static const uint32_t bad[] = {3 * COUNT, 3 * COUNT + 1, 0x7fffffff, 0x80000000, UINT32_MAX};
    make_input(6);
    for (uint32_t i = 0; i < 3 * COUNT; i++)
        index[i / 3][i % 3] = i;
    cgt_triangles indexed = triangles_of((const triangle *)given, COUNT);
    indexed.indices = index[0];
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(2, variant);
        cgt_scene *scene = scene_begin(context);
        uint32_t id;
        scene_add_triangles(scene, (const triangle *)given, 5); /* so that indices of primitive and triangle differ */
        assert_int_equal(cgt_scene_add_triangles(scene, &indexed, &id), CGT_OK);
        scene_commit(context, scene);
        trace(scene, expected);
        for (uint32_t k = 0; k < TEST_COUNT(bad) * 3; k++) {
            const uint32_t i = k * 4, j = k % 3, was = index[i][j], last = index[COUNT - 1][0];
            char text[160];
            index[i][j] = bad[k / 3];
            index[COUNT - 1][0] = UINT32_MAX; /* the message names the first one */
            snprintf(text, sizeof text, "geometry 1: triangle %u has index %u, but there are %u vertices", i,
                     bad[k / 3], 3 * COUNT);
            assert_int_equal(cgt_scene_commit(scene), CGT_ERROR_INVALID_ARGUMENT);
            if (!strstr(context_message(context), text))
                fail_msg("message \"%s\" lacks \"%s\"", context_message(context), text);
            assert_int_equal(trace_array(scene, ray, 1, hit, NULL), CGT_ERROR_NOT_COMMITTED);
            index[i][j] = was;
            index[COUNT - 1][0] = last;
            scene_commit(context, scene);
            trace(scene, hit);
            assert_memory_equal(hit, expected, sizeof hit);
        }
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* ---- skipped triangles ---- */

/* Triangles that no ray hits, one of each kind; the rest of the scene is hit as if they were absent. */
TEST(skipped_triangles_are_counted)
{
    static const float poison[] = {NAN, INFINITY, -INFINITY};
    static const triangle flat[] = {
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},       /* a point */
        {{-1, -1, -1}, {-1, -1, -1}, {1, 1, 1}}, /* two equal vertices */
        {{-1, -1, 0}, {1, 1, 0}, {1, 1, 0}},
        {{-1, 0, 0}, {0.25f, 0, 0}, {1, 0, 0}},                       /* on a line along an axis */
        {{0.1f, 0.2f, 0.3f}, {0.2f, 0.4f, 0.6f}, {0.4f, 0.8f, 1.2f}}, /* doubling is exact in float */
        {{-3, -5, 7}, {0, 0, 0}, {3, 5, -7}},
        {{0x1p-140f, 0, 0}, {0x1p-141f, 0, 0}, {0x1p-149f, 0, 0}}};
    /* one ulp off a line: has an area */
    static const triangle thin = {{-3, -5, 7}, {0, 0, 0x1p-149f}, {3, 5, -7}};
    enum { MOST = 3 * COUNT };
    static triangle t[MOST];
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene_statistics s;
        uint32_t number[MOST], not_finite = 0, degenerate = 0, count = 0;
        make_input(7);
        cgt_scene *scene = scene_of_triangles(context, NULL, (const triangle *)given, COUNT);
        trace(scene, expected);
        cgt_scene_release(scene);
        for (uint32_t i = 0; i < COUNT; i++) {
            if (i % 3 == 0) {
                memcpy(t[count], given[i], sizeof t[0]);
                t[count++][i / 3 % 3][i / 9 % 3] = poison[i % TEST_COUNT(poison)];
                not_finite++;
            } else if (i % 3 == 1) {
                memcpy(t[count++], flat[i / 3 % TEST_COUNT(flat)], sizeof t[0]);
                degenerate++;
            }
            number[count] = i;
            memcpy(t[count++], given[i], sizeof t[0]);
        }
        scene = scene_of_triangles(context, NULL, (const triangle *)t, count);
        assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
        assert_int_equal(s.triangles, count);
        assert_int_equal(s.skipped_not_finite, not_finite);
        assert_int_equal(s.skipped_degenerate, degenerate);
        assert_int_equal(s.skipped_radius, 0);
        trace(scene, hit);
        for (int i = 0; i < RAYS; i++) {
            if (hit[i].primitive != CGT_INVALID_ID)
                hit[i].primitive = number[hit[i].primitive];
            assert_memory_equal(&hit[i], &expected[i], sizeof hit[i]);
        }
        for (int a = 0; a < 3; a++)
            assert_true(s.bounds_min[a] > -3 && s.bounds_max[a] < 3);
        cgt_scene_release(scene);
        scene = scene_of_triangles(context, NULL, &thin, 1);
        assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
        assert_int_equal(s.skipped_degenerate, 0);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* A vertex that no triangle uses may have any value; a scene of skipped triangles only is empty. */
TEST(unused_vertices_do_no_harm)
{
    static const float vertices[5][3] = {{-1, -1, 0}, {NAN, NAN, NAN}, {1, -1, 0}, {INFINITY, 0, 0}, {0, 1, 0}};
    static const uint32_t index[3] = {0, 2, 4};
    static const triangle nothing[2] = {{{NAN, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 1, 1}, {1, 1, 1}, {2, 2, 2}}};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_begin(context);
    cgt_scene_statistics s;
    const truth_ray down = {{0, 0, 3}, {0, 0, -2}, 0, INFINITY};
    const cgt_triangles t = {.count = 1, .indices = index, .vertex_count = 5, .vertices = vertices[0]};
    uint32_t id;
    assert_int_equal(cgt_scene_add_triangles(scene, &t, &id), CGT_OK);
    scene_commit(context, scene);
    assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
    assert_int_equal(s.skipped_not_finite, 0);
    trace_all(scene, &down, 1, hit, NULL);
    assert_int_equal(hit[0].primitive, 0);
    assert_true(hit[0].t == 1.5f);
    cgt_scene_release(scene);
    scene = scene_of_triangles(context, NULL, nothing, 2);
    trace_all(scene, &down, 1, hit, NULL);
    assert_int_equal(hit[0].geometry, CGT_INVALID_ID);
    assert_int_equal(hit[0].primitive, CGT_INVALID_ID);
    assert_true(hit[0].t == INFINITY && hit[0].uv[0] == 0 && hit[0].uv[1] == 0 && hit[0].normal[2] == 0);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_triangles", NULL, NULL)
