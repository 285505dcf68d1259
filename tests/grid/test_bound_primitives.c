/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The pass that bounds all primitives against a plain loop: every number has the same bits, for each variant and any
 * number of threads; and the first index out of range is found wherever it is. */
#include "exact/valid_primitive.h"
#include "support/suite.h"
#include "structures/scenes/loose_scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "builders/commit.h"

#define CHUNK 8192u /* primitives whose diameters are summed together */

/* ---- the reference pass ---- */

static double bounds_of(const cgt_primitive *q, float low[3], float high[3])
{
    double extent = 0;
    if (q->kind == CGT_KIND_SPHERES) {
        const float center[3] = {q->sphere.x, q->sphere.y, q->sphere.z};
        for (int a = 0; a < 3; a++) {
            low[a] = center[a] - q->sphere.r;
            high[a] = center[a] + q->sphere.r;
        }
        return 2.0 * q->sphere.r;
    }
    for (int a = 0; a < 3; a++) {
        const float p = q->triangle.v[0][a], s = q->triangle.v[1][a], t = q->triangle.v[2][a];
        low[a] = fminf(p, fminf(s, t));
        high[a] = fmaxf(p, fmaxf(s, t));
        extent += (double)high[a] - (double)low[a];
    }
    return extent / 3;
}

static void add_plainly(cgt_primitive_bounds *s, const cgt_primitive *q, double sum[3])
{
    float low[3], high[3];
    const cgt_primitive_state state = cgt_primitive_check(q);
    s->skipped_not_finite += state == CGT_PRIMITIVE_NOT_FINITE;
    s->skipped_radius += state == CGT_PRIMITIVE_NEGATIVE_RADIUS;
    s->skipped_degenerate += state == CGT_PRIMITIVE_DEGENERATE;
    if (state != CGT_PRIMITIVE_VALID)
        return;
    const double d = bounds_of(q, low, high);
    for (int a = 0; a < 3; a++) {
        s->min[a] = fminf(s->min[a], low[a]);
        s->max[a] = fmaxf(s->max[a], high[a]);
    }
    s->valid++;
    sum[0] += d;
    sum[1] += d * d;
    sum[2] += d * d * d;
}

static cgt_primitive_bounds summarise_plainly(const cgt_primitives *o)
{
    cgt_primitive_bounds s = {.bad_index = CGT_INVALID_ID};
    for (int a = 0; a < 3; a++) {
        s.min[a] = INFINITY;
        s.max[a] = -INFINITY;
    }
    for (uint32_t first = 0; first < o->count; first += CHUNK) {
        double sum[3] = {0, 0, 0};
        for (uint32_t i = first; i < o->count && i - first < CHUNK; i++) {
            const cgt_primitive q = cgt_primitives_get(o, i);
            add_plainly(&s, &q, sum);
        }
        for (int k = 0; k < 3; k++)
            s.diameter[k + 1] += sum[k];
    }
    s.diameter[0] = s.valid;
    for (int a = 0; a < 3; a++) {
        s.min[a] = s.valid ? nextafterf(s.min[a], -INFINITY) : 0;
        s.max[a] = s.valid ? nextafterf(s.max[a], INFINITY) : 0;
        s.magnitude = fmaxf(s.magnitude, fmaxf(fabsf(s.min[a]), fabsf(s.max[a])));
    }
    return s;
}

static void compare(const cgt_primitive_bounds *a, const cgt_primitive_bounds *b, bool diameters)
{
    assert_int_equal(a->valid, b->valid);
    assert_int_equal(a->skipped_not_finite, b->skipped_not_finite);
    assert_int_equal(a->skipped_radius, b->skipped_radius);
    assert_int_equal(a->skipped_degenerate, b->skipped_degenerate);
    assert_int_equal(a->bad_index, b->bad_index);
    assert_memory_equal(a->min, b->min, sizeof a->min);
    assert_memory_equal(a->max, b->max, sizeof a->max);
    assert_memory_equal(&a->magnitude, &b->magnitude, sizeof a->magnitude);
    if (diameters)
        assert_memory_equal(a->diameter, b->diameter, sizeof a->diameter);
}

/* ---- tests ---- */

static void check_scene(const loose_scene *s, uint32_t threads, const char *variant)
{
    static const cgt_structure structure[] = {CGT_STRUCTURE_QUEUE_GRID, CGT_STRUCTURE_LOOSE_GRID};
    for (size_t k = 0; k < TEST_COUNT(structure); k++) {
        const cgt_scene_options options = {.structure = structure[k]};
        cgt_context *context = context_make(threads, variant);
        cgt_scene *scene = loose_add(s, context, &options);
        cgt_primitive_bounds got = {0};
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_int_equal(cgt_compute_bounds(scene, &got), CGT_OK);
        const cgt_primitive_bounds want = summarise_plainly(&scene->committed_scene.prims);
        compare(&got, &want, structure[k] != CGT_STRUCTURE_LOOSE_GRID);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

TEST(bounds_match_the_plain_loop)
{
    test_random r = random_make(1);
    for (int kind = 0; kind < LOOSE_KINDS; kind++)
        for (int what = LOOSE_SPHERES; what <= LOOSE_BOTH; what++) {
            loose_scene s = loose_make(&r, (loose_kind)kind, (loose_what)what, 1 + random_below(&r, test_scaled(300)));
            FOR_EACH_VARIANT(variant)
            check_scene(&s, 1, variant);
            loose_free(&s);
        }
}

/* Triangles without an area by hand, and one whose vertices are an ulp off a line. */
TEST(flat_triangles_are_skipped)
{
    static const float flat[][3][3] = {
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, /* a point */
        {{-1, -1, -1}, {-1, -1, -1}, {1, 1, 1}},
        {{-1, -1, 0}, {1, 1, 0}, {1, 1, 0}},
        {{-1, 0, 0}, {0.25f, 0, 0}, {1, 0, 0}},                       /* on a line along an axis */
        {{0.1f, 0.2f, 0.3f}, {0.2f, 0.4f, 0.6f}, {0.4f, 0.8f, 1.2f}}, /* doubling is exact in float */
        {{-3, -5, 7}, {0, 0, 0}, {3, 5, -7}},
        {{0x1p-140f, 0, 0}, {0x1p-141f, 0, 0}, {0x1p-149f, 0, 0}},
        {{-3, -5, 7}, {0, 0, 0x1p-149f}, {3, 5, -7}}}; /* it has one */
    const cgt_triangles t = {
        .count = TEST_COUNT(flat), .vertex_count = 3 * TEST_COUNT(flat), .vertices = cgt_floats(flat[0][0], 0)};
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = NULL;
        cgt_scene_statistics s;
        assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &t), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_int_equal(cgt_scene_get_statistics(scene, &s), CGT_OK);
        assert_int_equal(s.skipped_degenerate, TEST_COUNT(flat) - 1);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

TEST(chunks_and_threads_change_nothing)
{
    test_random r = random_make(2);
    for (int what = LOOSE_SPHERES; what <= LOOSE_BOTH; what++) {
        loose_scene s = loose_make(&r, LOOSE_SPOILED, (loose_what)what, test_scaled(20000));
        for (uint32_t threads = 1; threads <= 5; threads += 2)
            check_scene(&s, threads, NULL);
        loose_free(&s);
    }
}

/* Whether a flat triangle has an area depends on the last bit of a vertex, or underflows. */
TEST(areas_are_decided_exactly)
{
    enum { COUNT = 3000 };
    test_random r = random_make(3);
    uint32_t flat = 0;
    float(*v)[3][3] = malloc(COUNT * sizeof *v);
    assert_non_null(v);
    for (int scale = -149; scale <= 40; scale += 21) {
        for (int i = 0; i < COUNT; i++)
            for (int a = 0; a < 3; a++) {
                const int way = (int)random_below(&r, 9) - 4, from = (int)random_below(&r, 1 << 12);
                v[i][0][a] = ldexpf((float)from, scale);
                v[i][1][a] = ldexpf((float)(from + (i + 1) * (i % 4 ? i + a : way)), scale);
                v[i][2][a] = ldexpf((float)(from + (i + 3) * (i % 4 ? i + a : way)), scale);
                if (i % 3 == 0 && a == 2)
                    v[i][2][a] = nextafterf(v[i][2][a], INFINITY);
            }
        loose_scene s = {
            .geometries = 1,
            .triangles = {{.count = COUNT, .vertex_count = 3 * COUNT, .vertices = cgt_floats(v[0][0], 0)}}};
        FOR_EACH_VARIANT(variant)
        check_scene(&s, 1, variant);
        for (int i = 0; i < COUNT; i++) {
            cgt_triangle q;
            memcpy(q.v, v[i], sizeof q.v);
            flat += !cgt_triangle_has_area(&q);
        }
    }
    assert_true(flat > COUNT);
    free(v);
}

TEST(the_first_bad_index_is_reported)
{
    enum { COUNT = 70 };
    static const float vertex[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    test_random r = random_make(4);
    for (uint32_t round = 0; round < test_scaled(200); round++) {
        const uint32_t count = 1 + random_below(&r, COUNT), vertices = random_below(&r, 5);
        uint32_t *index = malloc(count * 3 * sizeof *index), bad = CGT_INVALID_ID;
        assert_non_null(index);
        for (uint32_t i = 0; i < count; i++)
            for (uint32_t k = 0; k < 3; k++) {
                const bool wrong = random_below(&r, 60) == 0 || !vertices;
                index[3 * i + k] = wrong ? (random_below(&r, 2) ? vertices : UINT32_MAX) : random_below(&r, vertices);
                if (wrong && bad == CGT_INVALID_ID)
                    bad = i;
            }
        const cgt_triangles t = {.count = count,
                                 .indices = cgt_uint32s(index, 0),
                                 .vertex_count = vertices,
                                 .vertices = cgt_floats(vertices ? vertex[0] : NULL, 0)};
        FOR_EACH_VARIANT(variant)
        {
            cgt_context *context = context_make(1, variant);
            const cgt_scene_options options = {.structure = CGT_STRUCTURE_LOOSE_GRID};
            cgt_scene *scene = NULL;
            char text[64];
            assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
            assert_int_equal(cgt_scene_set_triangles(scene, NULL, &t), CGT_OK);
            assert_int_equal(cgt_scene_commit(scene), bad == CGT_INVALID_ID ? CGT_OK : CGT_ERROR_INVALID_ARGUMENT);
            snprintf(text, sizeof text, "triangle %u has index", bad);
            if (bad != CGT_INVALID_ID)
                assert_non_null(strstr(context_message(context), text));
            cgt_scene_release(scene);
            cgt_context_release(context);
        }
        free(index);
    }
}

SEEDED_SUITE("test_bound_primitives", NULL, NULL)
