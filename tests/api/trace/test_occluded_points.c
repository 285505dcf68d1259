/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against a light: the result is that of cgt_occluded_rays for the rays that cgt.h specifies, for every
 * structure, variant and number of threads, for points on surfaces and anywhere, ranges, gaps in the arrays and NaNs;
 * and nothing is allocated. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "structures/scenes/structure_scenes.h"
#include "hard_cases/hard_run.h"

#define POINTS 1500u

/* ---- queries ---- */

typedef struct query {
    structure_scene s;
    cgt_light light;
    bool ranges;
    float *memory;   /* x, y, z, t_min, t_max of each point */
    uint32_t stride; /* floats from one point to the next */
} query;

static float *point_at(const query *q, uint32_t i) { return q->memory + (size_t)i * q->stride; }

/* A point where a ray hits the scene, or anywhere: in groups, so that some are neighbours. */
static void place_points(query *q, cgt_scene *scene)
{
    static full_hit hit[POINTS];
    test_random *r = &q->s.scene.random;
    const truth_ray *ray = q->s.scene.ray;
    assert_int_equal(trace_array(scene, ray, POINTS, hit, NULL), CGT_OK);
    for (uint32_t i = 0; i < POINTS; i++) {
        float *p = point_at(q, i);
        const uint32_t near = i % 64 && random_below(r, 2) ? i - 1 : i;
        for (int a = 0; a < 3; a++) {
            p[a] = ray[near].org[a];
            if (hit[near].primitive != CGT_INVALID_ID)
                p[a] += hit[near].t * ray[near].dir[a];
            if (near != i)
                p[a] += random_float(r, -1e-3f, 1e-3f) * q->s.where.reach;
        }
        p[3] = (float[]){0, 1e-4f, -0.5f, 0.25f}[random_below(r, 4)];
        p[4] = (float[]){1, 1, 0.9f, 3, -1, INFINITY}[random_below(r, 6)];
    }
}

static void spoil_points(query *q)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY, 0x1p60f, -0x1p100f, 0x1p-140f};
    test_random *r = &q->s.scene.random;
    for (uint32_t k = 0; k < POINTS / 100; k++)
        point_at(q, random_below(r, POINTS))[random_below(r, 5)] = bad[random_below(r, TEST_COUNT(bad))];
    if (q->light.kind == CGT_LIGHT_POINT)
        memcpy(point_at(q, random_below(r, POINTS)), q->light.position, sizeof q->light.position);
}

static void place_light(query *q, uint32_t number)
{
    test_random *r = &q->s.scene.random;
    const float far = (float[]){0.5f, 2, 30, 1e4f}[number % 4] * q->s.where.reach;
    q->light.kind = number % 3 ? CGT_LIGHT_POINT : CGT_LIGHT_DIRECTIONAL;
    for (int a = 0; a < 3; a++)
        q->light.position[a] =
            (q->light.kind == CGT_LIGHT_POINT ? q->s.where.middle[a] : 0) + random_float(r, -1, 1) * far;
    if (number % 5 == 0) /* along an axis, or above the scene */
        for (int a = 1; a < 3; a++)
            q->light.position[a] = q->light.kind == CGT_LIGHT_POINT ? q->s.where.middle[a] : 0;
    if (q->light.kind == CGT_LIGHT_DIRECTIONAL && q->light.position[0] == 0)
        q->light.position[0] = 1;
}

static query query_make(cgt_context *context, structure_kind kind, uint64_t stream, uint32_t number)
{
    query q = {.s = structure_scene_make(kind, stream), .ranges = number % 2, .stride = number % 4 == 3 ? 7 : 5};
    cgt_scene *scene;
    q.memory = malloc(POINTS * sizeof(float) * q.stride);
    assert_non_null(q.memory);
    structure_rays(&q.s, POINTS);
    assert_int_equal(hard_commit_with(context, &q.s.scene, NULL, &scene), CGT_OK);
    place_points(&q, scene);
    place_light(&q, number);
    if (number % 3 == 1)
        spoil_points(&q);
    cgt_scene_release(scene);
    return q;
}

static void query_free(query *q)
{
    free(q->memory);
    structure_scene_free(&q->s);
}

/* ---- the same with rays ---- */

static cgt_points points_of(const query *q, uint32_t count)
{
    const float *p = q->memory;
    return (cgt_points){.count = count,
                        .stride = q->stride * sizeof(float),
                        .position = {p, p + 1, p + 2},
                        .t_min = q->ranges ? p + 3 : NULL,
                        .t_max = q->ranges ? p + 4 : NULL};
}

/* Exactly as cgt.h specifies it. */
static truth_ray ray_to_light(const query *q, uint32_t i)
{
    const float *p = point_at(q, i);
    truth_ray ray = {.t_min = q->ranges ? p[3] : 0,
                     .t_max = q->ranges                          ? p[4]
                              : q->light.kind == CGT_LIGHT_POINT ? 1
                                                                 : INFINITY};
    for (int a = 0; a < 3; a++) {
        ray.org[a] = p[a];
        ray.dir[a] = q->light.kind == CGT_LIGHT_POINT ? q->light.position[a] - p[a] : q->light.position[a];
    }
    return ray;
}

static void check_results(const query *q, const cgt_scene *scene, test_trace_options options, uint32_t count,
                          uint64_t *occluded_points)
{
    static truth_ray ray[POINTS];
    static uint8_t expected[POINTS], got[POINTS + 1];
    cgt_trace_statistics by_rays, by_points;
    for (uint32_t i = 0; i < count; i++)
        ray[i] = ray_to_light(q, i);
    const cgt_rays rays = ray_array(ray, count);
    const cgt_points points = points_of(q, count);
    memset(got, 0x77, sizeof got);
    options.statistics = &by_rays;
    assert_int_equal(cgt_occluded_rays(scene, &rays, expected, TRACE_OPTIONS(&options)), CGT_OK);
    options.statistics = &by_points;
    assert_int_equal(cgt_occluded_points(scene, &q->light, &points, got, TRACE_OPTIONS(&options)), CGT_OK);
    for (uint32_t i = 0; i < count; i++)
        if (got[i] != expected[i])
            fail_msg("%s, light %a %a %a, kind %d: point %u, %a %a %a, is %s", q->s.name, (double)q->light.position[0],
                     (double)q->light.position[1], (double)q->light.position[2], (int)q->light.kind, i,
                     (double)ray[i].org[0], (double)ray[i].org[1], (double)ray[i].org[2],
                     expected[i] ? "in the light" : "in shadow");
    assert_int_equal(got[count], 0x77);
    assert_int_equal(by_points.rays, count);
    assert_int_equal(by_points.invalid_rays, by_rays.invalid_rays);
    assert_int_equal(by_points.hits, by_rays.hits);
    assert_true(by_points.exact_tests <= by_points.double_tests && by_points.double_tests <= by_points.ray_tests);
    *occluded_points += by_points.hits;
}

/* Cycles through every structure, culling and precision with a bound. */
static void results_match_rays(void **state)
{
    (void)state;
    const uint32_t step = test_scaled(10) < 2 ? 3 : 1; /* every third structure on slow machines */
    uint64_t occluded_points = 0, total = 0;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context[2] = {context_make(1, variant), context_make(3, variant)};
        for (uint32_t number = 0; number < (uint32_t)STRUCTURE_KINDS * test_scaled(2); number++) {
            const structure_kind kind = (structure_kind)(number % STRUCTURE_KINDS);
            query q = query_make(context[0], kind, 700 + number, number + number / STRUCTURE_KINDS);
            for (uint32_t k = test_sample_start(number, step); k < TEST_STRUCTURES; k += step) {
                const cgt_scene_options made = structure_in_turn(k);
                test_trace_options options = {0};
                cgt_scene *scene;
                options.cull = (cgt_cull)((number + k) % 3);
                options.loop = (cgt_loop)((number + k) % 2 + 1);
                options.precision = (number + k) % 4 ? CGT_PRECISION_ROBUST : CGT_PRECISION_EXACT;
                assert_int_equal(hard_commit_with(context[(number + k) % 2], &q.s.scene, &made, &scene), CGT_OK);
                const uint32_t count = number % 7 ? POINTS : 1 + (number + k) % 70;
                check_results(&q, scene, options, count, &occluded_points);
                total += count;
                cgt_scene_release(scene);
            }
            query_free(&q);
        }
        for (int i = 0; i < 2; i++)
            cgt_context_release(context[i]);
    }
    print_message("%llu of %llu points in shadow\n", (unsigned long long)occluded_points, (unsigned long long)total);
    assert_true(occluded_points > total / 20 && occluded_points < total - total / 20);
}

/* ---- a ball on a table ---- */

#define SIDE 128u

/* In a frame's order, large enough for many packets of many blocks; FAST too, since this picture has no borderline
 * rays. */
static void a_ball_casts_a_shadow(void **state)
{
    (void)state;
    static float at[3][SIDE * SIDE];
    static uint8_t occluded[SIDE * SIDE];
    const float sphere[2][4] = {{0, 1, 0, 0.5f}, {40, 0, 0, 1}};
    FOR_EACH_VARIANT(variant)
    for (uint32_t k = 0; k < TEST_STRUCTURES; k++)
        for (int fast = 0; fast < 2; fast++) {
            cgt_context *context = context_make(2, variant);
            const cgt_scene_options made = structure_in_turn(k);
            cgt_scene *scene = scene_of(context, &made, sphere, 2);
            test_trace_options options = {0};
            options.precision = fast ? CGT_PRECISION_FAST : CGT_PRECISION_ROBUST;
            for (uint32_t i = 0; i < SIDE * SIDE; i++) {
                at[0][i] = (float)(i % SIDE) * (4.f / SIDE) - 2;
                at[1][i] = 0;
                at[2][i] = (float)(i / SIDE) * (4.f / SIDE) - 2;
            }
            const cgt_points points = {.count = SIDE * SIDE, .position = {at[0], at[1], at[2]}};
            for (int w = 0; w < 2; w++) {
                const cgt_light light = {.position = {0, 2, 0}, .kind = w ? CGT_LIGHT_POINT : CGT_LIGHT_DIRECTIONAL};
                /* a cone of sine 1/2 around the light, or a cylinder */
                const float radius2 = w ? 4.f / 3 : 0.25f;
                assert_int_equal(cgt_occluded_points(scene, &light, &points, occluded, TRACE_OPTIONS(&options)),
                                 CGT_OK);
                for (uint32_t i = 0; i < SIDE * SIDE; i++) {
                    const float d2 = at[0][i] * at[0][i] + at[2][i] * at[2][i];
                    if (fabsf(d2 - radius2) > 1e-4f)
                        assert_int_equal(occluded[i], d2 < radius2);
                }
            }
            cgt_scene_release(scene);
            cgt_context_release(context);
        }
}

/* A point on a surface is occluded by that surface at t = 0, but not with a small t_min. */
static void t_min_excludes_the_surface(void **state)
{
    (void)state;
    const float sphere[1][4] = {{0, 0, 0, 1}}, point[3] = {0, 1, 0}, little = 1e-5f;
    const cgt_light light = {.position = {0.5f, 3, 0}, .kind = CGT_LIGHT_POINT};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, sphere, 1);
    cgt_points points = {.count = 1, .position = {&point[0], &point[1], &point[2]}};
    uint8_t occluded = 7;
    assert_int_equal(cgt_occluded_points(scene, &light, &points, &occluded, NULL), CGT_OK);
    assert_int_equal(occluded, 1);
    points.t_min = &little;
    assert_int_equal(cgt_occluded_points(scene, &light, &points, &occluded, NULL), CGT_OK);
    assert_int_equal(occluded, 0);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* ---- memory ---- */

static void nothing_is_allocated(void **state)
{
    (void)state;
    static float at[POINTS];
    static uint8_t occluded[POINTS];
    const float sphere[1][4] = {{0, 0, 0, 1}};
    const cgt_light light = {.position = {0, 0, 5}, .kind = CGT_LIGHT_POINT};
    const cgt_points points = {.count = POINTS, .position = {at, at, at}};
    unsigned allocations = 0;
    cgt_context *context = context_counting(&allocations);
    cgt_scene *scene = scene_of(context, NULL, sphere, 1);
    assert_true(allocations > 0);
    /* the first points of a scene may build a tree, whose memory the next ones reuse */
    assert_int_equal(cgt_occluded_points(scene, &light, &points, occluded, NULL), CGT_OK);
    const unsigned before = allocations;
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_int_equal(cgt_occluded_points(scene, &light, &points, occluded, NULL), CGT_OK);
    assert_int_equal(allocations, before);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(results_match_rays), cmocka_unit_test(a_ball_casts_a_shadow),
                                       cmocka_unit_test(t_min_excludes_the_surface),
                                       cmocka_unit_test(nothing_is_allocated)};
    test_begin("test_occluded_points");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
