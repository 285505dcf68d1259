/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whole frames of the files, in every variant, precision and triangle test: time against error. First the hits of
 * every way to trace are compared with those of EXACT, in runs that are not timed and warm up. Then the ways take turns
 * frame by frame, forwards and backwards in alternation, so that a slow moment of the machine affects all alike. */
#include "accuracy/bench_accuracy.h"

#include <stdlib.h>
#include <string.h>

#include "accuracy/accuracy_error.h"
#include "common/bench_input.h"
#include "rays/bench_planes.h"
#include "common/bench_timing.h"

enum { MOST_WAYS = 6, SPHERE_WAYS = 3, FAST_WAY = 1 };

/* What EXACT, the first way, finds in the first variant is the truth for all. Costs are relative to the second way.
 * Spheres have one test: their ways end before the first other test. */
static const struct {
    cgt_precision precision;
    cgt_triangle_test test;
} ways[MOST_WAYS] = {
    {CGT_PRECISION_EXACT, CGT_TRIANGLE_TEST_AUTO},           {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_AUTO},
    {CGT_PRECISION_ROBUST, CGT_TRIANGLE_TEST_AUTO},          {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_WATERTIGHT},
    {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_MOLLER_TRUMBORE}, {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_ACCELERATED}};

/* One variant's scene, and the times of each frame. */
typedef struct runner {
    const char *variant;
    cgt_context *context;
    bench_scene scene;
    double *times; /* memory of the next two */
    double *build_ms;
    double *trace_ms[MOST_WAYS];
    accuracy_error *error; /* one for each way */
} runner;

typedef struct frames_job {
    const bench_settings *settings;
    const char *path;
    bench_input input;
    size_t way_count;
    runner runners[BENCH_MOST_VARIANTS];
    size_t runner_count;
    bench_planes truth, planes;
    double *scratch;
    size_t measured; /* frames */
} frames_job;

/* ---- Runs ---------------------------------------------------------------------------------------------------- */

static bench_choice choice_of(const frames_job *job, const runner *r, size_t way)
{
    return (bench_choice){.variant = r->variant,
                          .packet = job->settings->packet,
                          .precision = ways[way].precision,
                          .precision_named = 1,
                          .test = ways[way].test};
}

static cgt_result trace_way(frames_job *job, const runner *r, size_t way, const bench_planes *planes, double *ms)
{
    const bench_choice choice = choice_of(job, r, way);
    cgt_trace_options options;
    cgt_research_trace_options research;
    cgt_frame frame;
    bench_planes_frame(planes, &frame);
    bench_choice_options(&choice, NULL, &options, &research);
    /* Hits left from the previous run must not count for this one: no primitive has this number. */
    memset(planes->primitive, 0xfe, (size_t)planes->width * planes->height * sizeof *planes->primitive);
    const double start = bench_now_ms();
    const cgt_result result = cgt_trace_camera(r->scene.scene, &job->settings->camera, &frame, &options);
    *ms = bench_now_ms() - start;
    return result;
}

/* Compares all ways of all variants with the first variant's EXACT, in one frame. */
static int compare_frame(frames_job *job, size_t frame)
{
    const uint32_t count = bench_input_move(&job->input, frame);
    double ms;
    for (size_t k = 0; k < job->runner_count; k++) {
        runner *r = &job->runners[k];
        cgt_result result = bench_scene_commit(&r->scene, count);
        for (size_t way = 0; result == CGT_OK && way < job->way_count; way++) {
            const bench_planes *into = k == 0 && way == 0 ? &job->truth : &job->planes;
            result = trace_way(job, r, way, into, &ms);
            if (result == CGT_OK)
                accuracy_error_add(&r->error[way], &job->truth, into);
        }
        if (result != CGT_OK)
            return bench_scene_failed(r->context, job->path, result);
    }
    return PROGRAM_OK;
}

/* Times one variant in one frame. */
static int time_runner(frames_job *job, runner *r, uint32_t count, int backwards)
{
    const double start = bench_now_ms();
    cgt_result result = bench_scene_commit(&r->scene, count);
    r->build_ms[job->measured] = bench_now_ms() - start;
    for (size_t step = 0; result == CGT_OK && step < job->way_count; step++) {
        const size_t way = backwards ? job->way_count - 1 - step : step;
        result = trace_way(job, r, way, &job->planes, &r->trace_ms[way][job->measured]);
    }
    return result == CGT_OK ? PROGRAM_OK : bench_scene_failed(r->context, job->path, result);
}

static int measure(frames_job *job)
{
    int code = PROGRAM_OK;
    for (size_t i = 0; i < job->input.frames && code == PROGRAM_OK; i++)
        code = compare_frame(job, i);
    for (uint32_t round = 0; round < job->settings->repeat; round++)
        for (size_t i = 0; i < job->input.frames && code == PROGRAM_OK; i++) {
            const uint32_t count = bench_input_move(&job->input, i);
            const int backwards = (int)((round + i) & 1);
            for (size_t step = 0; step < job->runner_count && code == PROGRAM_OK; step++)
                code =
                    time_runner(job, &job->runners[backwards ? job->runner_count - 1 - step : step], count, backwards);
            job->measured++;
        }
    return code;
}

/* ---- Rows ---------------------------------------------------------------------------------------------------- */

static double median_of(frames_job *job, const double *a, const double *b)
{
    for (size_t i = 0; i < job->measured; i++)
        job->scratch[i] = a[i] + (b ? b[i] : 0.0);
    return bench_median(job->scratch, job->measured);
}

/* Median over the frames of the percentage by which (a + base) exceeds (b + base). */
static double median_cost(frames_job *job, const double *a, const double *b, const double *base)
{
    for (size_t i = 0; i < job->measured; i++) {
        const double fast = b[i] + (base ? base[i] : 0.0), slow = a[i] + (base ? base[i] : 0.0);
        job->scratch[i] = fast > 0.0 ? 100.0 * (slow / fast - 1.0) : 0.0;
    }
    return bench_median(job->scratch, job->measured);
}

static void write_row(frames_job *job, const runner *r, size_t way, cgt_structure structure, bench_table *table)
{
    const bench_choice choice = choice_of(job, r, way);
    const double *fast = r->trace_ms[FAST_WAY], *trace = r->trace_ms[way];
    char scene[BENCH_NAME_SIZE], config[BENCH_NAME_SIZE];
    bench_file_name(job->path, scene);
    bench_choice_name(&choice, structure, config);
    bench_table_text(table, "scene", scene);
    bench_table_text(table, "config", config);
    bench_table_text(table, "variant", r->variant);
    bench_table_text(table, "precision", bench_precision_name(choice.precision));
    bench_table_text(table, "test", job->input.index ? bench_triangle_test_name(choice.test) : "-");
    bench_table_count(table, "threads", cgt_context_get_threads(r->context));
    bench_table_real(table, "build_ms", median_of(job, r->build_ms, NULL));
    bench_table_real(table, "trace_ms", median_of(job, trace, NULL));
    bench_table_real(table, "ms", median_of(job, trace, r->build_ms));
    accuracy_error_cells(&r->error[way], table);
    bench_table_real(table, "cost_percent", median_cost(job, trace, fast, r->build_ms));
    bench_table_real(table, "trace_cost_percent", median_cost(job, trace, fast, NULL));
    bench_table_end_row(table);
}

static int write_rows(frames_job *job, bench_table *table)
{
    bench_table_section(table, "frames");
    for (size_t k = 0; k < job->runner_count; k++) {
        const runner *r = &job->runners[k];
        cgt_scene_statistics built;
        const cgt_result result = cgt_scene_get_statistics(r->scene.scene, &built);
        if (result != CGT_OK)
            return bench_scene_failed(r->context, job->path, result);
        for (size_t way = 0; way < job->way_count; way++)
            write_row(job, r, way, built.structure, table);
    }
    return PROGRAM_OK;
}

/* ---- One file ------------------------------------------------------------------------------------------------ */

static int add_runner(frames_job *job, const char *variant, size_t values)
{
    const bench_settings *settings = job->settings;
    runner *r = &job->runners[job->runner_count++];
    cgt_result result = bench_context_create(settings->threads, variant, &r->context);
    if (result != CGT_OK)
        return bench_scene_failed(NULL, variant, result);
    r->variant = variant;
    result = bench_scene_create(&r->scene, r->context, job->input.moving, settings->resolution);
    if (result != CGT_OK)
        return bench_scene_failed(r->context, job->path, result);
    bench_scene_set_triangles(&r->scene, job->input.index, job->input.triangles);
    r->times = values <= SIZE_MAX / sizeof(double) ? calloc(job->way_count + 1, values * sizeof(double)) : NULL;
    r->error = calloc(job->way_count, sizeof *r->error);
    if (!r->times || !r->error) {
        program_error("out of memory for %zu measurements", values);
        return PROGRAM_FAILED;
    }
    r->build_ms = r->times;
    for (size_t way = 0; way < job->way_count; way++)
        r->trace_ms[way] = r->times + (way + 1) * values;
    return PROGRAM_OK;
}

static int prepare(frames_job *job, const accuracy_job *accuracy)
{
    const bench_settings *settings = job->settings;
    if (bench_input_load_file(&job->input, settings, job->path))
        return PROGRAM_FAILED;
    job->way_count = job->input.index ? MOST_WAYS : SPHERE_WAYS;
    const size_t values = settings->repeat <= SIZE_MAX / job->input.frames ? settings->repeat * job->input.frames : 0;
    if (!values || bench_planes_create(&job->truth, settings->width, settings->height) ||
        bench_planes_create(&job->planes, settings->width, settings->height) ||
        !(job->scratch = calloc(values, sizeof(double)))) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    int code = PROGRAM_OK;
    for (size_t v = 0; v < accuracy->variants && code == PROGRAM_OK; v++)
        code = add_runner(job, accuracy->variant[v], values);
    return code;
}

static void release(frames_job *job)
{
    for (size_t k = 0; k < job->runner_count; k++) {
        runner *r = &job->runners[k];
        bench_scene_release(&r->scene);
        cgt_context_release(r->context);
        free(r->times);
        free(r->error);
    }
    free(job->scratch);
    bench_planes_release(&job->planes);
    bench_planes_release(&job->truth);
    bench_input_release(&job->input);
}

int accuracy_frames(const accuracy_job *accuracy, const char *path)
{
    frames_job job = {.settings = &accuracy->shared, .path = path};
    int code = prepare(&job, accuracy);
    if (code == PROGRAM_OK)
        code = measure(&job);
    if (code == PROGRAM_OK)
        code = write_rows(&job, accuracy->table);
    release(&job);
    return code;
}
