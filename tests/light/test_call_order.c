/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The order of a call's points against a light: every live point once, the others counted, neighbours close together as
 * the light sees them, the same for any number of threads; calls of several pieces, and memory that is refused. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/scratch.h"
#include "support/suite.h"
#include "support/scenes.h"
#include "trace/order/call_order.h"

#define POINTS 30000u
#define STRIDE 5u /* floats: x, y, z, t_min, t_max */
#define SPHERES 300u

static const cgt_light lights[] = {{CGT_LIGHT_POINT, {2, 3, -2.5f}},
                                   {CGT_LIGHT_POINT, {0, 0, 0}},
                                   {CGT_LIGHT_POINT, {0.3f, -0.9f, 0.9f}},
                                   {CGT_LIGHT_DIRECTIONAL, {1, 2, -1.5f}},
                                   {CGT_LIGHT_DIRECTIONAL, {0, 0, -1}}};

static cgt_scene *scene_make(cgt_context *context, test_random *r, cgt_structure structure)
{
    static float sphere[SPHERES][4];
    for (uint32_t i = 0; i < SPHERES; i++)
        for (int a = 0; a < 4; a++)
            sphere[i][a] = a == 3 ? 0.05f : random_float(r, -1, 1);
    const cgt_spheres spheres = spheres_of((const float(*)[4])sphere, SPHERES);
    cgt_scene_options options;
    cgt_scene *scene;
    cgt_scene_options_init(&options);
    options.structure = structure;
    assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* ---- the order ---- */

typedef enum point_kind { LIVE, OFF, INVALID } point_kind;

/* Random points of a cube. */
static void scatter(test_random *r, const cgt_light *light, float point[POINTS][STRIDE], uint8_t kind[POINTS])
{
    for (uint32_t i = 0; i < POINTS; i++) {
        const uint32_t odd = random_below(r, 40);
        for (int a = 0; a < 3; a++)
            point[i][a] = random_float(r, -1, 1);
        point[i][3] = 0;
        point[i][4] = 1;
        kind[i] = odd == 0 || odd == 1 ? OFF : odd < 6 ? INVALID : LIVE;
        if (odd == 0)
            point[i][3] = 2;
        if (odd == 1)
            point[i][4] = -INFINITY;
        if (odd == 2)
            point[i][random_below(r, 3)] = INFINITY;
        if (odd == 3)
            point[i][random_below(r, 5)] = NAN;
        if (odd == 4)
            point[i][4] = NAN;
        if (odd == 5 && light->kind == CGT_LIGHT_POINT)
            memcpy(point[i], light->position, sizeof light->position);
        else if (odd == 5)
            point[i][0] = -INFINITY;
    }
}

static cgt_rays rays_of(const float point[POINTS][STRIDE], uint32_t count)
{
    return (cgt_rays){.count = count,
                      .stride = sizeof point[0],
                      .org = {&point[0][0], &point[0][1], &point[0][2]},
                      .t_min = &point[0][3],
                      .t_max = &point[0][4]};
}

/* How far apart the light sees two points. */
static double distance_seen(const cgt_light *light, const float *a, const float *b)
{
    double u[3], v[3], uu = 0, vv = 0, along = 0, ll = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        const double l = (double)light->position[k];
        u[k] = (double)a[k] - (light->kind == CGT_LIGHT_POINT ? l : 0);
        v[k] = (double)b[k] - (light->kind == CGT_LIGHT_POINT ? l : 0);
        uu += u[k] * u[k];
        vv += v[k] * v[k];
        along += (u[k] - v[k]) * l;
        ll += l * l;
    }
    for (int k = 0; k < 3; k++) {
        const double d = light->kind == CGT_LIGHT_POINT ? u[k] / sqrt(uu) - v[k] / sqrt(vv)
                                                        : u[k] - v[k] - along / ll * (double)light->position[k];
        square += d * d;
    }
    return sqrt(square);
}

/* Every live point once, and those of a chunk closer together than in the arrays: neighbours by far, and ends of 64. */
static void check_order(const cgt_call_order *o, const cgt_light *light, const float point[POINTS][STRIDE],
                        const uint8_t *kind, uint32_t count)
{
    static uint8_t seen[POINTS];
    uint32_t number[3] = {0};
    double given = 0, near = 0, far = 0;
    memset(seen, 0, sizeof seen);
    for (uint32_t i = 0; i < count; i++)
        number[kind[i]]++;
    assert_int_equal(o->live, number[LIVE]);
    assert_int_equal(o->invalid, number[INVALID]);
    if (o->as_given) {
        assert_int_equal(o->live, count);
        return;
    }
    for (uint32_t i = 0; i < o->live; i++) {
        const uint32_t at = o->number[i];
        assert_true(at < count && kind[at] == LIVE && !seen[at]);
        seen[at] = 1;
        near += i ? distance_seen(light, point[at], point[o->number[i - 1]]) : 0;
        far += i >= 64 ? distance_seen(light, point[at], point[o->number[i - 64]]) : 0;
        given += distance_seen(light, point[at], point[o->number[(i * 7919ull + 13) % o->live]]);
    }
    if (count == POINTS) {
        assert_true(near * 12 < given);
        assert_true(far * 5 < given);
    }
}

TEST(live_points_come_once_and_close_together)
{
    static float point[POINTS][STRIDE];
    static uint8_t kind[POINTS];
    static const uint32_t counts[] = {1, 63, 4096, 4097, POINTS};
    test_random r = random_make(1);
    cgt_context *context[2] = {context_make(1, NULL), context_make(4, NULL)};
    cgt_scene *scene[2] = {scene_make(context[0], &r, CGT_STRUCTURE_AUTO),
                           scene_make(context[1], &r, CGT_STRUCTURE_AUTO)};
    for (uint32_t k = 0; k < TEST_COUNT(lights) * TEST_COUNT(counts); k++) {
        const cgt_light *light = &lights[k % TEST_COUNT(lights)];
        const uint32_t count = counts[k / TEST_COUNT(lights)];
        cgt_call_order o[2];
        scatter(&r, light, point, kind);
        const cgt_rays rays = rays_of((const float(*)[STRIDE])point, count);
        for (int c = 0; c < 2; c++) {
            assert_int_equal(cgt_call_order_init(&o[c], scene[c], &rays, light), CGT_OK);
            check_order(&o[c], light, (const float(*)[STRIDE])point, kind, count);
        }
        assert_int_equal(o[0].as_given, o[1].as_given);
        if (!o[0].as_given)
            assert_memory_equal(o[0].number, o[1].number, o[0].live * sizeof(uint32_t));
        for (int c = 0; c < 2; c++)
            cgt_call_order_release(&o[c], scene[c]);
    }
    for (int c = 0; c < 2; c++) {
        cgt_scene_release(scene[c]);
        cgt_context_release(context[c]);
    }
}

/* ---- calls ---- */

/* Chunks that lie close together, all live, stay where they are. */
TEST(tiles_stay_as_they_are)
{
    static float point[POINTS][STRIDE];
    test_random r = random_make(2);
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_make(context, &r, CGT_STRUCTURE_AUTO);
    for (uint32_t i = 0; i < 4 * CGT_RAYS_CHUNK; i++) {
        const uint32_t tile = i / CGT_RAYS_CHUNK;
        point[i][0] = (float)(tile % 2) + (float)(i % 64) / 64 - 1;
        point[i][1] = (float)(tile / 2) + (float)(i / 64 % 64) / 64 - 1;
        point[i][2] = -1;
        point[i][3] = 0;
        point[i][4] = 1;
    }
    for (uint32_t k = 0; k < TEST_COUNT(lights); k++) {
        cgt_call_order o;
        const cgt_rays rays = rays_of((const float(*)[STRIDE])point, 4 * CGT_RAYS_CHUNK);
        assert_int_equal(cgt_call_order_init(&o, scene, &rays, &lights[k]), CGT_OK);
        assert_true(o.as_given || k == 2); /* the third light sees them at grazing angles */
        cgt_call_order_release(&o, scene);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
}

TEST(pieces_are_traced_one_after_the_other)
{
    const uint32_t count = CGT_ORDERED_POINTS + 5000;
    float *at[3];
    uint8_t *got = malloc(count), *expected = malloc(count);
    test_random r = random_make(3), again = r;
    cgt_trace_statistics statistics;
    cgt_trace_options trace;
    cgt_context *context = context_make(3, NULL);
    cgt_scene *scene = scene_make(context, &r, CGT_STRUCTURE_AUTO),
              *tree = scene_make(context, &again, CGT_STRUCTURE_BVH);
    for (int a = 0; a < 3; a++) {
        assert_non_null(at[a] = malloc(count * sizeof(float)));
        for (uint32_t i = 0; i < count; i++)
            at[a][i] = random_float(&r, -1, 1);
    }
    assert_true(got && expected);
    cgt_trace_options_init(&trace);
    trace.statistics = &statistics;
    const cgt_points points = {.count = count, .position = {at[0], at[1], at[2]}};
    memset(got, 7, count);
    assert_int_equal(cgt_occluded_points(scene, &lights[0], &points, got, &trace), CGT_OK);
    assert_int_equal(statistics.rays, count);
    for (uint32_t i = 0; i < count; i += CGT_RAYS_CHUNK) {
        const cgt_points few = {.count = count - i < CGT_RAYS_CHUNK ? count - i : CGT_RAYS_CHUNK,
                                .position = {at[0] + i, at[1] + i, at[2] + i}};
        assert_int_equal(cgt_occluded_points(tree, &lights[0], &few, expected + i, NULL), CGT_OK);
    }
    assert_memory_equal(got, expected, count);
    for (int a = 0; a < 3; a++)
        free(at[a]);
    free(got);
    free(expected);
    cgt_scene_release(scene);
    cgt_scene_release(tree);
    cgt_context_release(context);
}

/* ---- memory ---- */

static void *refusing_allocate(void *user, size_t bytes, size_t alignment)
{
    const bool refuses = *(const bool *)user && bytes != CGT_SCRATCH_BYTES;
    return refuses ? NULL : aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

static void refusing_release(void *user, void *memory, size_t bytes)
{
    (void)user;
    (void)bytes;
    free(memory);
}

TEST(refused_memory_is_an_error)
{
    static float point[POINTS][STRIDE];
    static uint8_t kind[POINTS], got[POINTS];
    bool refuses = false;
    test_random r = random_make(4);
    cgt_context_options options;
    cgt_context *context;
    cgt_context_options_init(&options);
    options.threads = 1;
    options.memory = (cgt_memory_hooks){&refuses, refusing_allocate, refusing_release};
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    cgt_scene *scene = scene_make(context, &r, CGT_STRUCTURE_LOOSE_GRID);
    scatter(&r, &lights[0], point, kind);
    const cgt_points points = {.count = POINTS,
                               .stride = sizeof point[0],
                               .position = {&point[0][0], &point[0][1], &point[0][2]},
                               .t_min = &point[0][3],
                               .t_max = &point[0][4]};
    refuses = true;
    assert_int_equal(cgt_occluded_points(scene, &lights[0], &points, got, NULL), CGT_ERROR_OUT_OF_MEMORY);
    assert_non_null(strstr(context_message(context), "order of 30000 points"));
    refuses = false;
    assert_int_equal(cgt_occluded_points(scene, &lights[0], &points, got, NULL), CGT_OK);
    refuses = true; /* the context has kept it */
    assert_int_equal(cgt_occluded_points(scene, &lights[0], &points, got, NULL), CGT_OK);
    for (uint32_t i = 0; i < POINTS; i++)
        assert_true(got[i] <= (kind[i] == LIVE));
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_call_order", NULL, NULL)
