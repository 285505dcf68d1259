/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays of one subject in one configuration: time, errors, and the number of tests that needed more than single
 * precision. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "accuracy/bench_accuracy.h"
#include "common/bench_timing.h"

/* ---- scenes ---- */

int accuracy_scene_make(accuracy_scene *scene, const accuracy_subject *subject, const accuracy_choice *choice)
{
    cgt_scene_statistics built;
    const uint32_t *cells = choice->resolution;
    char grid[64];
    bench_choice name = {
        .variant = choice->variant, .precision = choice->precision, .precision_named = 1, .test = choice->test};
    *scene = (accuracy_scene){.context = NULL};
    cgt_result result = bench_context_create(1, choice->variant, &scene->context);
    if (result == CGT_OK)
        result = hard_commit(scene->context, &subject->scene, cells, &scene->scene);
    if (result == CGT_OK)
        result = cgt_scene_get_statistics(scene->scene, &built);
    if (result != CGT_OK) {
        bench_scene_failed(scene->context, subject->name, result);
        accuracy_scene_free(scene);
        return PROGRAM_FAILED;
    }
    if (cells) {
        snprintf(grid, sizeof grid, "%ux%ux%u", (unsigned)cells[0], (unsigned)cells[1], (unsigned)cells[2]);
        name.grid = grid;
    }
    bench_choice_name(&name, built.structure, scene->config);
    bench_choice_options(&name, NULL, &scene->options, &scene->research);
    return PROGRAM_OK;
}

void accuracy_scene_free(accuracy_scene *scene)
{
    cgt_scene_release(scene->scene);
    cgt_context_release(scene->context);
    *scene = (accuracy_scene){.context = NULL};
}

int accuracy_trace(const accuracy_scene *scene, const accuracy_subject *subject, full_hit *hits,
                   cgt_trace_statistics *statistics)
{
    cgt_trace_options options = scene->options;
    options.statistics = statistics;
    const cgt_result result = trace_array(scene->scene, subject->scene.ray, subject->scene.rays, hits, &options);
    return result == CGT_OK ? PROGRAM_OK : bench_scene_failed(scene->context, subject->name, result);
}

int accuracy_each_choice(const accuracy_job *job, const accuracy_subject *subject,
                         int (*visit)(const accuracy_job *job, const accuracy_subject *subject,
                                      const accuracy_choice *choice))
{
    static const struct {
        cgt_precision precision;
        cgt_triangle_test test;
    } ways[] = {{CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_AUTO},
                {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_WATERTIGHT},
                {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_MOLLER_TRUMBORE},
                {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_ACCELERATED},
                {CGT_PRECISION_ROBUST, CGT_TRIANGLE_TEST_AUTO},
                {CGT_PRECISION_EXACT, CGT_TRIANGLE_TEST_AUTO}};
    int code = PROGRAM_OK;
    for (size_t v = 0; v < job->variants; v++)
        for (size_t w = 0; w < sizeof ways / sizeof ways[0] && code == PROGRAM_OK; w++) {
            const accuracy_choice choice = {job->variant[v], ways[w].precision, ways[w].test, NULL};
            if (subject->triangles || choice.test <= CGT_TRIANGLE_TEST_WATERTIGHT) /* spheres have one such test */
                code = visit(job, subject, &choice);
        }
    return code;
}

/* ---- errors ---- */

/* Values of one kind, for their quantiles. */
typedef struct sample {
    double *value;
    size_t count;
} sample;

typedef struct errors {
    hard_tally tally;
    sample t, angle;
    double uv_worst; /* NaN: no triangle was hit */
} errors;

static void judge(const accuracy_subject *subject, const full_hit *hits, errors *e)
{
    e->tally = hard_judge_all(&subject->scene, &subject->truth, hits);
    e->uv_worst = NAN;
    for (uint32_t i = 0; i < subject->scene.rays; i++) {
        oracle_hit exact;
        if (hard_judge(&subject->scene, &subject->truth, i, &hits[i], &exact) != ORACLE_RIGHT ||
            exact.index == ORACLE_NONE || hits[i].geometry == CGT_INVALID_ID)
            continue; /* values are compared where the hit is the same */
        e->t.value[e->t.count++] = oracle_ulp(exact.t, hits[i].t);
        e->angle.value[e->angle.count++] = oracle_angle(exact.normal, hits[i].normal);
        if (subject->truth.scene.primitive[exact.index].kind == ORACLE_TRIANGLE)
            for (int k = 0; k < 2; k++)
                e->uv_worst = fmax(e->uv_worst, oracle_ulp(exact.uv[k], hits[i].uv[k]));
    }
}

/* Median, 99th percentile and largest, as columns "NAME_median" and so on. */
static void write_sample(bench_table *table, const char *const columns[3], sample s)
{
    const double median = bench_median(s.value, s.count); /* sorts */
    bench_table_real(table, columns[0], s.count ? median : NAN);
    bench_table_real(table, columns[1], s.count ? s.value[(size_t)(0.99 * (double)(s.count - 1))] : NAN);
    bench_table_real(table, columns[2], s.count ? s.value[s.count - 1] : NAN);
}

/* ---- the table ---- */

static double share(uint64_t part, uint64_t whole) { return whole ? (double)part / (double)whole : 0; }

static void write_row(const accuracy_job *job, const accuracy_subject *subject, const accuracy_scene *scene, double ms,
                      const errors *e, const cgt_trace_statistics *s)
{
    static const char *const of_t[] = {"t_ulp_median", "t_ulp_p99", "t_ulp_worst"};
    static const char *const of_angles[] = {"normal_angle_median", "normal_angle_p99", "normal_angle_worst"};
    bench_table *const table = job->table;
    bench_table_section(table, "cases");
    bench_table_text(table, "case", subject->name);
    bench_table_text(table, "config", scene->config);
    bench_table_count(table, "rays", e->tally.rays);
    bench_table_real(table, "ns_per_ray", ms * 1e6 / (double)e->tally.rays);
    bench_table_real(table, "ns_per_test", s->ray_tests ? ms * 1e6 / (double)s->ray_tests : NAN);
    bench_table_count(table, "missed", e->tally.missed);
    bench_table_count(table, "invented", e->tally.invented);
    bench_table_count(table, "wrong", e->tally.wrong);
    write_sample(table, of_t, e->t);
    bench_table_real(table, "uv_ulp_worst", e->uv_worst);
    write_sample(table, of_angles, e->angle);
    bench_table_real(table, "ambiguous", share(s->double_tests, s->ray_tests));
    bench_table_real(table, "double_share", share(s->double_tests - s->exact_tests, s->ray_tests));
    bench_table_real(table, "exact_share", share(s->exact_tests, s->ray_tests));
    bench_table_count(table, "exact_values", s->exact_values);
    bench_table_end_row(table);
}

/* hits and the values of e have room for all rays, ms for all repetitions. */
static int measure(const accuracy_job *job, const accuracy_subject *subject, const accuracy_scene *scene,
                   full_hit *hits, errors *e, double *ms)
{
    cgt_trace_statistics statistics;
    int code = accuracy_trace(scene, subject, hits, &statistics); /* also warms up */
    if (code != PROGRAM_OK)
        return code;
    judge(subject, hits, e);
    for (uint32_t i = 0; i < job->shared.repeat && code == PROGRAM_OK; i++) {
        const double start = bench_now_ms();
        code = accuracy_trace(scene, subject, hits, NULL);
        ms[i] = bench_now_ms() - start;
    }
    if (code == PROGRAM_OK)
        write_row(job, subject, scene, bench_median(ms, job->shared.repeat), e, &statistics);
    return code;
}

static int measure_choice(const accuracy_job *job, const accuracy_subject *subject, const accuracy_choice *choice)
{
    const size_t rays = (size_t)subject->scene.rays + 1;
    accuracy_scene scene;
    full_hit *hits = calloc(rays, sizeof *hits);
    double *t = calloc(rays, sizeof *t), *angle = calloc(rays, sizeof *angle),
           *ms = calloc(job->shared.repeat, sizeof *ms);
    int code = PROGRAM_FAILED;
    if (hits && t && angle && ms) {
        errors e = {.t = {t, 0}, .angle = {angle, 0}};
        code = accuracy_scene_make(&scene, subject, choice);
        if (code == PROGRAM_OK) {
            code = measure(job, subject, &scene, hits, &e, ms);
            accuracy_scene_free(&scene);
        }
    } else
        program_error("%s: out of memory", subject->name);
    free(ms);
    free(angle);
    free(t);
    free(hits);
    return code;
}

int accuracy_cases(const accuracy_job *job, const accuracy_subject *subject)
{
    return accuracy_each_choice(job, subject, measure_choice);
}
