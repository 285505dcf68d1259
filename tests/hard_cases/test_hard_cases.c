/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Every hard case by name shows the difficulty that it claims, in every variant. The profile `cases` of tests/driver
 * judges the hits. */
#include "support/test.h"

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

/* ---- a case under test ---- */

typedef struct subject {
    const hard_case *hard;
    hard_scene scene;
    hard_truth truth;
    full_hit *answer;
    hard_tally fast; /* errors of FAST, summed over variants and triangle tests */
    bool is_easy;    /* too few rays to show a trait */
    const char *variant;
} subject;

static subject subject_make(const hard_case *hard, uint32_t rays)
{
    subject s = {.hard = hard};
    assert_true(hard_case_make(hard, rays, &s.scene));
    assert_int_equal(s.scene.rays, rays);
    cgt_context *context = context_make(1, NULL);
    assert_int_equal(hard_follow(context, hard, &s.scene), CGT_OK);
    cgt_context_release(context);
    assert_true(hard_truth_make(&s.scene, &s.truth));
    assert_non_null(s.answer = calloc(rays, sizeof *s.answer));
    return s;
}

static void subject_free(subject *s)
{
    free(s->answer);
    hard_truth_free(&s->truth);
    hard_scene_free(&s->scene);
}

static void trace(const subject *s, const cgt_scene *scene, const test_trace_options *options)
{
    const cgt_result result = trace_array(scene, s->scene.ray, s->scene.rays, s->answer, TRACE_OPTIONS(options));
    if (result != CGT_OK)
        fail_msg("%s: %s", s->variant, cgt_get_result_string(result));
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
        trace(s, scene, &options);
        const hard_tally tally = hard_judge_all(&s->scene, &s->truth, s->answer);
        s->fast.missed += tally.missed;
        s->fast.invented += tally.invented;
        s->fast.wrong += tally.wrong;
    }
}

/* ---- one variant, one case ---- */

static void check_variant(subject *s)
{
    cgt_trace_statistics statistics;
    cgt_research_trace_statistics research;
    test_trace_options options = {.statistics = &statistics, .research_statistics = &research};
    cgt_context *context = context_make(1, s->variant);
    cgt_scene *scene;
    if (hard_commit(context, &s->scene, NULL, &scene) != CGT_OK)
        fail_msg("%s: %s", s->variant, context_message(context));
    trace(s, scene, &options);
    check_traits(s, scene, &statistics, &research);
    if (variant_is_outer(s->variant))
        count_fast_errors(s, scene);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* Returns whether the case shows the traits that it claims. */
static bool check_case(const hard_case *hard, uint32_t rays)
{
    subject s = subject_make(hard, rays);
    FOR_EACH_VARIANT(variant)
    {
        s.variant = variant;
        check_variant(&s);
    }
    expect(&s, HARD_FAST_FAILS, hard_errors(&s.fast) > 0, "error of single precision");
    print_message("%u rays; FAST, all tests and variants: %llu missed, %llu invented, %llu wrong\n",
                  (unsigned)s.scene.rays, (unsigned long long)s.fast.missed, (unsigned long long)s.fast.invented,
                  (unsigned long long)s.fast.wrong);
    const bool is_hard = !s.is_easy;
    subject_free(&s);
    return is_hard;
}

static void test_case(void **state)
{
    uint32_t rays = test_between(FEW_RAYS, FIRST_RAYS);
    while (!check_case(*state, rays)) {
        assert_true(rays < RAYS);
        rays = rays < SOME_RAYS ? SOME_RAYS : RAYS;
    }
}

int main(void)
{
    const size_t cases = hard_case_count();
    struct CMUnitTest *tests = calloc(cases, sizeof *tests);
    char(*name)[160] = calloc(cases, sizeof *name);
    test_begin("test_hard_cases");
    if (!tests || !name) {
        free(tests);
        free(name);
        return 1;
    }
    for (size_t i = 0; i < cases; i++) {
        const hard_case *hard = hard_case_at(i);
        snprintf(name[i], sizeof name[i], "%s: %s", hard->row, hard->name);
        tests[i] =
            (struct CMUnitTest){.name = name[i], .test_func = test_case, .initial_state = (void *)(uintptr_t)hard};
    }
    const int failed = _cmocka_run_group_tests("hard cases", tests, cases, NULL, NULL);
    free(name);
    free(tests);
    return failed;
}
