/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Every hard case by name. The oracle judges the default precision: no hit is missed, invented or wrong, and values
 * are within the bounds of cgt.h. Every variant gives the same bits, in any order, for single rays and arrays, with
 * any number of threads. Each case shows the difficulty that it claims. */
#include "support/test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hard_cases/hard_run.h"
#include "support/scenes.h"

/* Rays of a case at first, fewer where it is slow; then more until the case shows its traits. */
#define FIRST_RAYS 800u
#define FEW_RAYS 100u
#define SOME_RAYS 400u
#define RAYS 2000u
#define ALONE 50u

/* ---- a case under test ---- */

typedef struct subject {
    const hard_case *hard;
    hard_scene scene;
    hard_truth truth;
    uint32_t *order; /* of the shuffled rays */
    truth_ray *shuffled;
    full_hit *hit; /* of the first variant: the others give the same bits */
    full_hit *answer;
    hard_tally fast; /* errors of FAST, summed over variants and triangle tests */
    bool is_easy;    /* too few rays to show a trait */
    const char *variant;
} subject;

static void *array(size_t count, size_t size)
{
    void *memory = calloc(count + 1, size);
    assert_non_null(memory);
    return memory;
}

static void shuffle(subject *s)
{
    test_random r = random_make(91);
    for (uint32_t i = 0; i < s->scene.rays; i++)
        s->order[i] = i;
    for (uint32_t i = s->scene.rays; i > 1; i--) {
        const uint32_t k = random_below(&r, i), swapped = s->order[k];
        s->order[k] = s->order[i - 1];
        s->order[i - 1] = swapped;
    }
    for (uint32_t i = 0; i < s->scene.rays; i++)
        s->shuffled[i] = s->scene.ray[s->order[i]];
}

static subject subject_make(const hard_case *hard, uint32_t rays)
{
    subject s = {.hard = hard};
    assert_true(hard_case_make(hard, rays, &s.scene));
    assert_int_equal(s.scene.rays, rays);
    cgt_context *context = context_make(1, NULL);
    assert_int_equal(hard_follow(context, hard, &s.scene), CGT_OK);
    cgt_context_release(context);
    assert_true(hard_truth_make(&s.scene, &s.truth));
    s.order = array(rays, sizeof *s.order);
    s.shuffled = array(rays, sizeof *s.shuffled);
    s.hit = array(rays, sizeof *s.hit);
    s.answer = array(rays, sizeof *s.answer);
    shuffle(&s);
    return s;
}

static void subject_free(subject *s)
{
    free(s->order);
    free(s->shuffled);
    free(s->hit);
    free(s->answer);
    hard_truth_free(&s->truth);
    hard_scene_free(&s->scene);
}

static void fail_ray(const subject *s, uint32_t i, const full_hit *hit, const char *what)
{
    const truth_ray *ray = &s->scene.ray[i];
    const oracle_hit *exact = &s->truth.hit[i];
    const oracle_primitive *p = exact->index == ORACLE_NONE ? NULL : &s->truth.scene.primitive[exact->index];
    fail_msg(
        "%s, ray %u: %s: geometry %d, primitive %d, t %a, u %a, v %a; exact: geometry %d, primitive %d, t %a, u %a, "
        "v %a; org %a %a %a dir %a %a %a t %a to %a",
        s->variant, i, what, (int)hit->geometry, (int)hit->primitive, (double)hit->t, (double)hit->uv[0],
        (double)hit->uv[1], p ? (int)p->geometry : -1, p ? (int)p->primitive : -1, (double)exact->t,
        (double)exact->uv[0], (double)exact->uv[1], (double)ray->org[0], (double)ray->org[1], (double)ray->org[2],
        (double)ray->dir[0], (double)ray->dir[1], (double)ray->dir[2], (double)ray->t_min, (double)ray->t_max);
}

/* ---- decisions and bits ---- */

static void trace(const subject *s, const cgt_scene *scene, const truth_ray *rays, uint32_t count, full_hit *hits,
                  const test_trace_options *options)
{
    memset(hits, 0x77, count * sizeof *hits);
    const cgt_result result = trace_array(scene, rays, count, hits, options ? TRACE_OPTIONS(options) : NULL);
    if (result != CGT_OK)
        fail_msg("%s: %s", s->variant, cgt_get_result_string(result));
}

static void judge(const subject *s, const full_hit *answers)
{
    static const char *const name[] = {"right", "missed", "invented", "wrong"};
    for (uint32_t i = 0; i < s->scene.rays; i++) {
        oracle_hit exact;
        const oracle_verdict verdict = hard_judge(&s->scene, &s->truth, i, &answers[i], &exact);
        if (verdict != ORACLE_RIGHT)
            fail_ray(s, i, &answers[i], name[verdict]);
        const bool is_miss = answers[i].geometry == CGT_INVALID_ID;
        if (is_miss && !(answers[i].primitive == CGT_INVALID_ID && answers[i].t == INFINITY))
            fail_ray(s, i, &answers[i], "a miss with a primitive or a t");
    }
}

static void check_same_bits(const subject *s, uint32_t i, const full_hit *got, const full_hit *expected,
                            const char *what)
{
    if (memcmp(got, expected, sizeof *got) != 0)
        fail_ray(s, i, got, what);
}

/* The same rays in another order, one at a time, and as any-hit queries. */
static void check_orders(subject *s, const cgt_scene *scene)
{
    const uint32_t rays = s->scene.rays;
    trace(s, scene, s->shuffled, rays, s->answer, NULL);
    for (uint32_t i = 0; i < rays; i++)
        check_same_bits(s, s->order[i], &s->answer[i], &s->hit[s->order[i]], "different bits in another order");
    for (uint32_t k = 0; k < test_between(10, ALONE) && k < rays; k++) {
        const uint32_t i = s->order[k];
        trace(s, scene, &s->scene.ray[i], 1, s->answer, NULL);
        check_same_bits(s, i, s->answer, &s->hit[i], "different bits for a single ray");
    }
    uint8_t *occluded = array(rays, 1);
    const cgt_rays arrays = ray_array(s->scene.ray, rays);
    assert_int_equal(cgt_occluded_rays(scene, &arrays, occluded, NULL), CGT_OK);
    for (uint32_t i = 0; i < rays; i++)
        if (occluded[i] != (s->hit[i].geometry != CGT_INVALID_ID))
            fail_ray(s, i, &s->hit[i], occluded[i] ? "occluded, but no hit" : "a hit, but not occluded");
    free(occluded);
}

/* ---- values ---- */

static void check_sphere_normal(const subject *s, uint32_t i, const full_hit *hit, const oracle_primitive *p)
{
    const truth_ray *ray = &s->scene.ray[i];
    double distance = 0;
    for (int a = 0; a < 3; a++)
        distance += ((double)p->data[a] - ray->org[a]) * ((double)p->data[a] - ray->org[a]);
    const double bound = 0x1p-23 + (p->data[3] > 0 ? 0x1p-48 * sqrt(distance) / p->data[3] : 0);
    for (int a = 0; a < 3; a++)
        if (!(fabs((double)(s->truth.hit[i].normal[a] - hit->normal[a])) <= bound))
            fail_msg(
                "%s, ray %u: the normal of sphere %u is beyond its bound, %g: %.9g %.9g %.9g, exactly %.9g %.9g %.9g",
                s->variant, i, p->primitive, bound, (double)hit->normal[0], (double)hit->normal[1],
                (double)hit->normal[2], (double)s->truth.hit[i].normal[0], (double)s->truth.hit[i].normal[1],
                (double)s->truth.hit[i].normal[2]);
}

static void check_triangle_values(const subject *s, uint32_t i, const full_hit *hit)
{
    const oracle_hit *truth = &s->truth.hit[i];
    for (int k = 0; k < 2; k++)
        if (!(oracle_ulp(truth->uv[k], hit->uv[k]) <= 1))
            fail_ray(s, i, hit, "u or v are more than 1 ulp off");
    for (int a = 0; a < 3; a++)
        if (!(oracle_ulp(truth->normal[a], hit->normal[a]) <= 1))
            fail_ray(s, i, hit, "the normal is more than 1 ulp off");
}

static void check_values(const subject *s)
{
    for (uint32_t i = 0; i < s->scene.rays; i++) {
        const full_hit *hit = &s->hit[i];
        const uint32_t index = s->truth.hit[i].index;
        if (index == ORACLE_NONE || hit->geometry == CGT_INVALID_ID)
            continue;
        const oracle_primitive *p = &s->truth.scene.primitive[index];
        if (p->geometry != hit->geometry || p->primitive != hit->primitive)
            continue; /* both right, at the end of the range */
        if (!(oracle_ulp(s->truth.hit[i].t, hit->t) <= 0.51))
            fail_ray(s, i, hit, "t is more than 0.51 ulp off");
        if (p->kind == ORACLE_TRIANGLE)
            check_triangle_values(s, i, hit);
        else
            check_sphere_normal(s, i, hit, p);
    }
}

/* ---- traits: the case is as hard as it claims ---- */

/* trait: 0 for counts that every case must have. */
static void expect(subject *s, hard_trait trait, bool there, const char *what)
{
    if (there || (trait && !(s->hard->traits & trait)))
        return;
    if (s->scene.rays < RAYS)
        s->is_easy = true;
    else
        fail_msg("%s: the case shows no %s: it is not hard", s->variant, what);
}

static void check_traits(subject *s, const cgt_scene *scene, const cgt_trace_statistics *traced,
                         const cgt_research_trace_statistics *packets)
{
    const cgt_research_scene_statistics cells = research_of(scene);
    cgt_scene_statistics built;
    assert_int_equal(cgt_scene_get_statistics(scene, &built), CGT_OK);
    expect(s, HARD_DOUBLE, traced->double_tests > 0, "test that single precision leaves open");
    expect(s, HARD_EXACT, traced->exact_tests > 0, "test that double precision leaves open");
    expect(s, HARD_SPLITS, packets->split_packets > 0, "packet that splits");
    expect(s, HARD_INVALID, traced->invalid_rays > 0, "invalid ray");
    expect(s, HARD_MISSES, traced->hits < traced->rays, "ray that misses");
    expect(s, HARD_OVERFLOW, cells.overflow_references > 0, "overflow");
    expect(s, HARD_SPREAD, cells.references > built.primitives, "primitive in more than one cell");
    expect(s, HARD_SKIPPED, built.skipped_not_finite > 0 && built.skipped_radius > 0, "skipped primitive");
    expect(s, HARD_FLAT, built.skipped_degenerate > 0, "triangle without an area");
    expect(s, (hard_trait)0, traced->hits > 0, "ray that hits");
}

static void count_fast_errors(subject *s, const cgt_scene *scene)
{
    test_trace_options options = {0};
    options.precision = CGT_PRECISION_FAST;
    for (int test = CGT_TRIANGLE_TEST_WATERTIGHT; test <= CGT_TRIANGLE_TEST_ACCELERATED; test++) {
        options.triangle_test = (cgt_triangle_test)test;
        trace(s, scene, s->scene.ray, s->scene.rays, s->answer, &options);
        const hard_tally tally = hard_judge_all(&s->scene, &s->truth, s->answer);
        s->fast.missed += tally.missed;
        s->fast.invented += tally.invented;
        s->fast.wrong += tally.wrong;
    }
}

/* ---- other structures ---- */

static void check_structure(subject *s, cgt_context *context, const test_way *other)
{
    const uint32_t rays = s->scene.rays;
    const char *variant = s->variant;
    char name[80];
    cgt_scene *scene;
    cgt_research_trace_statistics statistics;
    const test_trace_options options = {.kd_traversal = other->traversal, .research_statistics = &statistics};
    snprintf(name, sizeof name, "%s, %s", variant, other->name);
    s->variant = name;
    if (hard_commit_with(context, &s->scene, SCENE_OPTIONS(&other->scene), &scene) != CGT_OK)
        fail_msg("%s: %s", name, context_message(context));
    trace(s, scene, s->scene.ray, rays, s->answer, &options);
    for (uint32_t i = 0; i < rays; i++)
        check_same_bits(s, i, &s->answer[i], &s->hit[i], "different bits than through the grid");
    assert_int_equal(statistics.rope_loops, 0);
    uint8_t *occluded = array(rays, 1);
    const cgt_rays arrays = ray_array(s->scene.ray, rays);
    assert_int_equal(cgt_occluded_rays(scene, &arrays, occluded, TRACE_OPTIONS(&options)), CGT_OK);
    for (uint32_t i = 0; i < rays; i++)
        if (occluded[i] != (s->hit[i].geometry != CGT_INVALID_ID))
            fail_ray(s, i, &s->hit[i], occluded[i] ? "occluded, but no hit" : "a hit, but not occluded");
    free(occluded);
    cgt_scene_release(scene);
    s->variant = variant;
}

/* All structures; where it is slow a sample that differs from case to case. */
static void check_structures(subject *s, cgt_context *context)
{
    uint32_t number = 0;
    while (hard_case_at(number) != s->hard)
        number++;
    const uint32_t step = test_samples() ? 3 : 1;
    const unsigned set = WAY_TRAVERSAL | (clusters_always() ? WAY_CLUSTERS : 0);
    for (uint32_t k = test_sample_start(number, step); k < way_count(set); k += step)
        check_structure(s, context, way_in_turn(set, k));
}

/* ---- threads ---- */

static void check_threads(subject *s)
{
    cgt_context *threaded = context_make(3, s->variant);
    cgt_scene *scene;
    if (hard_commit(threaded, &s->scene, NULL, &scene) != CGT_OK)
        fail_msg("%s: %s", s->variant, context_message(threaded));
    trace(s, scene, s->scene.ray, s->scene.rays, s->answer, NULL);
    for (uint32_t i = 0; i < s->scene.rays; i++)
        check_same_bits(s, i, &s->answer[i], &s->hit[i], "different bits with three threads");
    cgt_scene_release(scene);
    cgt_context_release(threaded);
}

/* ---- one variant, one case ---- */

static void check_variant(subject *s, bool first)
{
    const uint32_t rays = s->scene.rays;
    test_trace_options options;
    cgt_trace_statistics statistics;
    cgt_research_trace_statistics research;
    cgt_scene *scene;
    cgt_context *context = context_make(1, s->variant);
    options = (test_trace_options){0};
    if (hard_commit(context, &s->scene, NULL, &scene) != CGT_OK)
        fail_msg("%s: %s", s->variant, context_message(context));

    options.statistics = &statistics;
    options.research_statistics = &research;
    trace(s, scene, s->scene.ray, rays, first ? s->hit : s->answer, &options);
    check_traits(s, scene, &statistics, &research);
    for (uint32_t i = 0; !first && i < rays; i++)
        check_same_bits(s, i, &s->answer[i], &s->hit[i], "different bits than the first variant's");
    if (first) {
        judge(s, s->hit);
        check_values(s);
    }

    if (variant_is_outer(s->variant)) {
        check_orders(s, scene);
        count_fast_errors(s, scene);
        if (first || test_scaled(100) == 100)
            check_structures(s, context);
        check_threads(s);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* Returns whether the case shows the traits that it claims. */
static bool check_case(const hard_case *hard, uint32_t rays)
{
    subject s = subject_make(hard, rays);
    bool first = true;
    FOR_EACH_VARIANT(variant)
    {
        s.variant = variant;
        check_variant(&s, first);
        first = false;
    }
    assert_false(first);
    expect(&s, HARD_FAST_FAILS, hard_errors(&s.fast) > 0, "error of single precision");
    print_message("%u rays; FAST, all tests and variants: %llu missed, %llu invented, %llu wrong\n",
                  (unsigned)s.scene.rays, (unsigned long long)s.fast.missed, (unsigned long long)s.fast.invented,
                  (unsigned long long)s.fast.wrong);
    const bool is_hard = !s.is_easy;
    subject_free(&s);
    return is_hard;
}

static bool has_spheres(const hard_case *hard)
{
    hard_scene s;
    uint32_t spheres = 0;
    assert_true(hard_case_make(hard, 1, &s));
    for (uint32_t g = 0; g < s.geometries; g++)
        spheres += s.geometry[g].spheres;
    hard_scene_free(&s);
    return spheres > 0;
}

static void test_case(void **state)
{
    if (clusters_always() && has_spheres(*state))
        skip();
    uint32_t rays = test_between(FEW_RAYS, FIRST_RAYS);
    while (!check_case(*state, rays)) {
        assert_true(rays < RAYS);
        rays = rays < SOME_RAYS ? SOME_RAYS : RAYS;
    }
}

/* ---- ends of the range, ray by ray: the returned t decides where the oracle accepts both ---- */

static void test_range_ends_at_found_t(void **state)
{
    (void)state;
    hard_scene s;
    const hard_case *hard = NULL;
    for (size_t i = 0; !hard; i++)
        if (strcmp(hard_case_at(i)->row, "hit at tmin / tmax") == 0)
            hard = hard_case_at(i);
    assert_true(hard_case_make(hard, test_between(FEW_RAYS, SOME_RAYS), &s));
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene;
        uint32_t hits = 0;
        assert_int_equal(hard_commit(context, &s, NULL, &scene), CGT_OK);
        for (uint32_t i = 0; i < s.rays; i++) {
            truth_ray ray = s.ray[i];
            full_hit found, again;
            assert_int_equal(trace_array(scene, &ray, 1, &found, NULL), CGT_OK);
            if (found.geometry == CGT_INVALID_ID)
                continue;
            hits++;
            ray.t_max = found.t;
            assert_int_equal(trace_array(scene, &ray, 1, &again, NULL), CGT_OK);
            assert_memory_equal(&again, &found, sizeof found);
            ray.t_max = nextafterf(found.t, -INFINITY);
            assert_int_equal(trace_array(scene, &ray, 1, &again, NULL), CGT_OK);
            assert_int_equal(again.geometry, CGT_INVALID_ID);
            ray = s.ray[i];
            ray.t_min = found.t;
            assert_int_equal(trace_array(scene, &ray, 1, &again, NULL), CGT_OK);
            assert_memory_equal(&again, &found, sizeof found);
        }
        assert_true(hits > s.rays / 8);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
    hard_scene_free(&s);
}

#define OTHER_TESTS 1

int main(void)
{
    const size_t cases = hard_case_count();
    struct CMUnitTest *tests = calloc(cases + OTHER_TESTS, sizeof *tests);
    char(*name)[160] = calloc(cases, sizeof *name);
    test_begin("test_hard_cases");
    if (!tests || !name) {
        free(tests);
        free(name);
        return 1;
    }
    tests[0] = (struct CMUnitTest)cmocka_unit_test(test_range_ends_at_found_t);
    for (size_t i = 0; i < cases; i++) {
        const hard_case *hard = hard_case_at(i);
        snprintf(name[i], sizeof name[i], "%s: %s", hard->row, hard->name);
        tests[OTHER_TESTS + i] =
            (struct CMUnitTest){.name = name[i], .test_func = test_case, .initial_state = (void *)(uintptr_t)hard};
    }
    const int failed = _cmocka_run_group_tests("hard cases", tests, cases + OTHER_TESTS, NULL, NULL);
    free(name);
    free(tests);
    return failed;
}
