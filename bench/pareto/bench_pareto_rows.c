/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Measures one scene for cgt-bench pareto. First every way to trace is compared with EXACT in runs that are not timed;
 * then the ways take turns frame by frame, forwards and backwards in alternation, so that a slow moment of the machine
 * meets all of them alike. */
#include "pareto/bench_pareto.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_input.h"
#include "common/bench_timing.h"

enum { MOST_VARIANTS = 16, MOST_WAYS = 5 };

typedef struct way {
    cgt_precision precision;
    cgt_triangle_test test;
} way;

/* EXACT is the first: what it finds is the truth for all. The second is what costs are over. Spheres have no tests to
 * choose: their ways end before the first other test. */
static const way ways[MOST_WAYS] = {{CGT_PRECISION_EXACT, CGT_TRIANGLE_TEST_WATERTIGHT},
                                    {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_WATERTIGHT},
                                    {CGT_PRECISION_ROBUST, CGT_TRIANGLE_TEST_WATERTIGHT},
                                    {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_MOLLER_TRUMBORE},
                                    {CGT_PRECISION_FAST, CGT_TRIANGLE_TEST_ACCELERATED}};
enum { SPHERE_WAYS = 3, FAST_WAY = 1 };

/* One variant's scene, and its times: of each frame. */
typedef struct lane {
    const char *name;
    cgt_context *context;
    bench_scene scene;
    double *times; /* what the next two point into */
    double *build_ms;
    double *trace_ms[MOST_WAYS];
    pareto_error *error; /* one for each way */
} lane;

typedef struct scene_job {
    const bench_settings *settings;
    const char *path;
    bench_input input;
    size_t way_count;
    lane lanes[MOST_VARIANTS];
    size_t lane_count;
    bench_planes truth, planes;
    double *scratch;
    size_t measured;
} scene_job;

/* ---- Runs ---------------------------------------------------------------------------------------------------- */

static cgt_result trace_way(scene_job *job, const lane *at, size_t w, const bench_planes *planes, double *ms)
{
    const cgt_research_trace_options research = {.packet = job->settings->packet, .triangle_test = ways[w].test};
    cgt_trace_options options;
    cgt_frame frame;
    bench_planes_frame(planes, &frame);
    cgt_trace_options_init(&options);
    options.precision = ways[w].precision;
    options.research = &research;
    /* The planes of the run before must not pass for this one's: no primitive has this number. */
    memset(planes->primitive, 0xfe, (size_t)planes->width * planes->height * sizeof *planes->primitive);
    const double start = bench_now_ms();
    const cgt_result result = cgt_trace_camera(at->scene.scene, &job->settings->camera, &frame, &options);
    *ms = bench_now_ms() - start;
    return result;
}

/* Compares all ways of all variants with the first variant's EXACT, in one frame. */
static int compare_frame(scene_job *job, size_t frame)
{
    const uint32_t count = bench_input_move(&job->input, frame);
    double ms;
    for (size_t l = 0; l < job->lane_count; l++) {
        lane *at = &job->lanes[l];
        cgt_result result = bench_scene_commit(&at->scene, count);
        for (size_t w = 0; result == CGT_OK && w < job->way_count; w++) {
            const bench_planes *into = l == 0 && w == 0 ? &job->truth : &job->planes;
            result = trace_way(job, at, w, into, &ms);
            if (result == CGT_OK)
                pareto_error_add(&at->error[w], &job->truth, into);
        }
        if (result != CGT_OK)
            return bench_scene_failed(at->context, job->path, result);
    }
    return PROGRAM_OK;
}

/* Times one variant in one frame. */
static int time_lane(scene_job *job, lane *at, uint32_t count, int backwards)
{
    const double start = bench_now_ms();
    cgt_result result = bench_scene_commit(&at->scene, count);
    at->build_ms[job->measured] = bench_now_ms() - start;
    for (size_t step = 0; result == CGT_OK && step < job->way_count; step++) {
        const size_t w = backwards ? job->way_count - 1 - step : step;
        result = trace_way(job, at, w, &job->planes, &at->trace_ms[w][job->measured]);
    }
    return result == CGT_OK ? PROGRAM_OK : bench_scene_failed(at->context, job->path, result);
}

static int run_all(scene_job *job)
{
    int code = PROGRAM_OK;
    for (size_t i = 0; i < job->input.frames && code == PROGRAM_OK; i++)
        code = compare_frame(job, i); /* warms up, too */
    for (uint32_t round = 0; round < job->settings->repeat; round++)
        for (size_t i = 0; i < job->input.frames && code == PROGRAM_OK; i++) {
            const uint32_t count = bench_input_move(&job->input, i);
            const int backwards = (int)((round + i) & 1);
            for (size_t step = 0; step < job->lane_count && code == PROGRAM_OK; step++)
                code = time_lane(job, &job->lanes[backwards ? job->lane_count - 1 - step : step], count, backwards);
            job->measured++;
        }
    return code;
}

/* ---- Rows ---------------------------------------------------------------------------------------------------- */

static double median_of(scene_job *job, const double *a, const double *b)
{
    for (size_t i = 0; i < job->measured; i++)
        job->scratch[i] = a[i] + (b ? b[i] : 0.0);
    return bench_median(job->scratch, job->measured);
}

/* Median over the frames of how many per cent (a + base) is above (b + base). */
static double median_cost(scene_job *job, const double *a, const double *b, const double *base)
{
    for (size_t i = 0; i < job->measured; i++) {
        const double under = b[i] + (base ? base[i] : 0.0), over = a[i] + (base ? base[i] : 0.0);
        job->scratch[i] = under > 0.0 ? 100.0 * (over / under - 1.0) : 0.0;
    }
    return bench_median(job->scratch, job->measured);
}

static int add_rows(scene_job *job, pareto_table *table, size_t scene)
{
    const size_t more = job->lane_count * job->way_count;
    pareto_row *grown = realloc(table->rows, (table->count + more) * sizeof *grown);
    if (!grown) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    table->rows = grown;
    for (size_t l = 0; l < job->lane_count; l++) {
        lane *at = &job->lanes[l];
        cgt_scene_statistics built;
        const cgt_result result = cgt_scene_get_statistics(at->scene.scene, &built);
        if (result != CGT_OK)
            return bench_scene_failed(at->context, job->path, result);
        for (size_t w = 0; w < job->way_count; w++)
            table->rows[table->count++] =
                (pareto_row){.scene = scene,
                             .variant = at->name,
                             .structure = built.structure,
                             .precision = ways[w].precision,
                             .test = ways[w].test,
                             .triangles = job->input.index != NULL,
                             .threads = cgt_context_get_threads(at->context),
                             .build_ms = median_of(job, at->build_ms, NULL),
                             .trace_ms = median_of(job, at->trace_ms[w], NULL),
                             .ms = median_of(job, at->trace_ms[w], at->build_ms),
                             .cost = median_cost(job, at->trace_ms[w], at->trace_ms[FAST_WAY], at->build_ms),
                             .trace_cost = median_cost(job, at->trace_ms[w], at->trace_ms[FAST_WAY], NULL),
                             .error = at->error[w]};
    }
    return PROGRAM_OK;
}

/* ---- Preparing ----------------------------------------------------------------------------------------------- */

/* What is there is given back with the lane. */
static int make_room(lane *at, size_t count, size_t values)
{
    at->times = values <= SIZE_MAX / sizeof(double) ? calloc(count + 1, values * sizeof(double)) : NULL;
    at->error = calloc(count, sizeof *at->error);
    if (!at->times || !at->error) {
        program_error("out of memory for %zu measurements", values);
        return PROGRAM_FAILED;
    }
    at->build_ms = at->times;
    for (size_t w = 0; w < count; w++)
        at->trace_ms[w] = at->times + (w + 1) * values;
    return PROGRAM_OK;
}

static int add_lane(scene_job *job, const char *name, size_t values)
{
    const bench_settings *settings = job->settings;
    lane *at = &job->lanes[job->lane_count];
    cgt_result result = bench_context_create(settings->threads, name, &at->context);
    if (result == CGT_ERROR_UNSUPPORTED && !settings->variant) {
        fprintf(stderr, "variant %s left out: this CPU lacks it\n", name);
        return PROGRAM_OK;
    }
    if (result != CGT_OK)
        return bench_scene_failed(NULL, name, result);
    job->lane_count++;
    at->name = name;
    result = bench_scene_create(&at->scene, at->context, job->input.moving, settings->resolution);
    if (result != CGT_OK)
        return bench_scene_failed(at->context, job->path, result);
    bench_scene_set_triangles(&at->scene, job->input.index, job->input.triangles);
    return make_room(at, job->way_count, values);
}

static int prepare(scene_job *job)
{
    const bench_settings *settings = job->settings;
    char error[PROGRAM_ERROR_SIZE] = "";
    if (bench_input_load(&job->input, job->path, settings->frames, settings->radius, settings->wrapped, error,
                         sizeof error)) {
        program_error("%s", error);
        return PROGRAM_FAILED;
    }
    job->way_count = job->input.index ? MOST_WAYS : SPHERE_WAYS;
    const size_t values = settings->repeat <= SIZE_MAX / job->input.frames ? settings->repeat * job->input.frames : 0;
    if (!values || bench_planes_create(&job->truth, settings->width, settings->height) ||
        bench_planes_create(&job->planes, settings->width, settings->height) ||
        !(job->scratch = calloc(values, sizeof(double)))) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    int code = PROGRAM_OK;
    for (const char *const *name = cgt_get_variant_names(); *name && code == PROGRAM_OK; name++)
        if (job->lane_count < MOST_VARIANTS && (!settings->variant || !strcmp(settings->variant, *name)))
            code = add_lane(job, *name, values);
    return code;
}

static void release(scene_job *job)
{
    for (size_t l = 0; l < job->lane_count; l++) {
        lane *at = &job->lanes[l];
        bench_scene_release(&at->scene);
        cgt_context_release(at->context);
        free(at->times);
        free(at->error);
    }
    free(job->scratch);
    bench_planes_release(&job->planes);
    bench_planes_release(&job->truth);
    bench_input_release(&job->input);
}

int pareto_measure(pareto_table *table, const bench_settings *settings, size_t scene, const char *path)
{
    scene_job job;
    memset(&job, 0, sizeof job);
    job.settings = settings;
    job.path = path;
    int code = prepare(&job);
    if (code == PROGRAM_OK)
        code = run_all(&job);
    if (code == PROGRAM_OK)
        code = add_rows(&job, table, scene);
    release(&job);
    return code;
}
