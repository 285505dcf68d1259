/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays of hard cases, and of files' first frames: time, errors, and the number of tests that needed more than single
 * precision. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy/bench_accuracy.h"
#include "common/bench_timing.h"
#include "hard_cases/hard_run.h"

enum { NAME_SIZE = 256, BLOCK = 8 /* pixels along the edge of the squares that a file's rays come from */ };

/* Rays over primitives, with the exact hit of each ray. */
typedef struct subject {
    char name[NAME_SIZE];
    hard_scene scene;
    hard_truth truth;
    uint32_t triangles; /* in the scene */
} subject;

/* One way through a committed scene. */
typedef struct run {
    const accuracy_job *job;
    const subject *subject;
    cgt_context *context;
    cgt_scene *scene;
    char config[BENCH_NAME_SIZE];
    full_hit *hits;
    double *t_ulp, *angle, *ms; /* of right hits; of the rounds */
} run;

static int out_of_memory(const subject *s)
{
    program_error("%s: out of memory", s->name);
    return PROGRAM_FAILED;
}

/* ---- subjects ---- */

static void free_subject(subject *s)
{
    hard_truth_free(&s->truth);
    hard_scene_free(&s->scene);
}

static int make_case(subject *s, const hard_case *hard, uint32_t rays)
{
    cgt_context *context;
    if (!hard_case_make(hard, rays, &s->scene))
        return out_of_memory(s);
    if (bench_context_create(1, NULL, &context))
        return PROGRAM_FAILED;
    const cgt_result result = hard_follow(context, hard, &s->scene);
    const int code = result == CGT_OK ? PROGRAM_OK : bench_failed(context, s->name, result);
    cgt_context_release(context);
    return code;
}

/* A copy of `bytes` bytes plus one, so that an empty copy is not NULL; NULL if memory is refused. */
static void *copy_of(const void *from, size_t bytes)
{
    void *copy = malloc(bytes + 1);
    if (copy && bytes)
        memcpy(copy, from, bytes);
    return copy;
}

/* The first frame of a file becomes the subject's geometry. */
static int read_frame(subject *s, const bench_settings *settings, const char *path)
{
    hard_geometry *g = &s->scene.geometry[0];
    bench_settings first = *settings;
    bench_input input;
    first.frames = 1;
    if (bench_input_load_file(&input, &first, path))
        return PROGRAM_FAILED;
    const size_t count = input.count[0];
    s->scene.geometries = 1;
    if (input.index) {
        g->vertices = input.count[0];
        g->triangles = input.triangles;
        g->vertex = copy_of(input.data[0], count * sizeof *g->vertex);
        g->index = copy_of(input.index, (size_t)input.triangles * sizeof *g->index);
    } else {
        g->spheres = input.count[0];
        g->sphere = copy_of(input.data[0], count * sizeof *g->sphere);
    }
    const int complete = input.index ? g->vertex && g->index : g->sphere != NULL;
    bench_input_release(&input);
    return complete ? PROGRAM_OK : out_of_memory(s);
}

/* Squares of pixels at random places of the camera's picture. */
static int make_file(subject *s, const bench_settings *settings, const char *path)
{
    cgt_camera_rays camera;
    char message[160];
    if (cgt_camera_prepare(&settings->camera, settings->width, settings->height, &camera, message) != CGT_OK) {
        program_error("-c: %s", message);
        return PROGRAM_FAILED;
    }
    if (read_frame(s, settings, path))
        return PROGRAM_FAILED;
    s->scene.wanted = settings->rays;
    s->scene.random = random_make(0);
    while (hard_wants_ray(&s->scene)) {
        const uint32_t column = random_below(&s->scene.random, (camera.width + BLOCK - 1) / BLOCK);
        const uint32_t row = random_below(&s->scene.random, (camera.height + BLOCK - 1) / BLOCK);
        for (uint32_t i = 0; i < BLOCK * BLOCK; i++) {
            const uint32_t x = column * BLOCK + i % BLOCK, y = row * BLOCK + i / BLOCK;
            const truth_ray ray = camera_ray(&camera, x, y);
            if (x < camera.width && y < camera.height)
                hard_raw_ray(&s->scene, &ray);
        }
    }
    return s->scene.failed ? out_of_memory(s) : PROGRAM_OK;
}

/* ---- errors ---- */

/* Median, 99th percentile and largest, as columns "NAME_median" and so on. */
static void write_sample(bench_table *table, const char *const columns[3], double *value, size_t count)
{
    const double median = bench_median(value, count); /* sorts */
    BENCH_CELLS(table, CELL(columns[0], count ? median : NAN),
                CELL(columns[1], count ? value[(size_t)(0.99 * (double)(count - 1))] : NAN),
                CELL(columns[2], count ? value[count - 1] : NAN));
}

static double share(uint64_t part, uint64_t whole) { return whole ? (double)part / (double)whole : 0; }

static void write_row(const run *r, double ms, const cgt_trace_statistics *c)
{
    static const char *const of_t[] = {"t_ulp_median", "t_ulp_p99", "t_ulp_worst"};
    static const char *const of_angles[] = {"normal_angle_median", "normal_angle_p99", "normal_angle_worst"};
    const subject *s = r->subject;
    const hard_tally tally = hard_judge_all(&s->scene, &s->truth, r->hits);
    double uv_worst = NAN; /* no triangle was hit */
    size_t right = 0;
    for (uint32_t i = 0; i < s->scene.rays; i++) {
        const full_hit *hit = &r->hits[i];
        oracle_hit exact;
        if (hard_judge(&s->scene, &s->truth, i, hit, &exact) != ORACLE_RIGHT || exact.index == ORACLE_NONE ||
            hit->geometry == CGT_INVALID_ID)
            continue; /* values are compared where the hit is the same */
        r->t_ulp[right] = oracle_ulp(exact.t, hit->t);
        r->angle[right++] = oracle_angle(exact.normal, hit->normal);
        for (int k = 0; k < 2 && s->truth.scene.primitive[exact.index].kind == ORACLE_TRIANGLE; k++)
            uv_worst = fmax(uv_worst, oracle_ulp(exact.uv[k], hit->uv[k]));
    }
    bench_table_section(r->job->table, "cases");
    BENCH_CELLS(r->job->table, CELL("case", s->name), CELL("config", r->config), CELL("rays", tally.rays),
                CELL("ns_per_ray", ms * 1e6 / (double)tally.rays),
                CELL("ns_per_test", c->ray_tests ? ms * 1e6 / (double)c->ray_tests : NAN), CELL("missed", tally.missed),
                CELL("invented", tally.invented), CELL("wrong", tally.wrong));
    write_sample(r->job->table, of_t, r->t_ulp, right);
    BENCH_CELLS(r->job->table, CELL("uv_ulp_worst", uv_worst));
    write_sample(r->job->table, of_angles, r->angle, right);
    BENCH_ROW(r->job->table, CELL("ambiguous", share(c->double_tests, c->ray_tests)),
              CELL("double_share", share(c->double_tests - c->exact_tests, c->ray_tests)),
              CELL("exact_share", share(c->exact_tests, c->ray_tests)), CELL("exact_values", c->exact_values));
}

/* ---- measuring ---- */

static int measure_way(run *r, const bench_way *way)
{
    const subject *s = r->subject;
    const uint32_t rounds = r->job->settings->repeat;
    const cgt_research_trace_options research = {.triangle_test = way->choice.test};
    cgt_trace_statistics statistics;
    cgt_trace_options options = {.precision = way->choice.precision, .research = &research, .statistics = &statistics};
    cgt_result result = trace_array(r->scene, s->scene.ray, s->scene.rays, r->hits, &options); /* warms up */
    options.statistics = NULL;
    for (uint32_t i = 0; i < rounds && result == CGT_OK; i++) {
        const double start = bench_cpu_ms();
        result = trace_array(r->scene, s->scene.ray, s->scene.rays, r->hits, &options);
        r->ms[i] = bench_cpu_ms() - start;
    }
    if (result != CGT_OK)
        return bench_failed(r->context, s->name, result);
    write_row(r, bench_median(r->ms, rounds), &statistics);
    return PROGRAM_OK;
}

/* All ways of a variant. */
static int measure_variant(run *r, const char *variant)
{
    cgt_scene_statistics built = {0};
    if (bench_context_create(1, variant, &r->context))
        return PROGRAM_FAILED;
    cgt_result result = hard_commit(r->context, &r->subject->scene, NULL, &r->scene);
    if (result == CGT_OK)
        result = cgt_scene_get_statistics(r->scene, &built);
    int code = result == CGT_OK ? PROGRAM_OK : bench_failed(r->context, r->subject->name, result);
    for (size_t w = 0; w < ACCURACY_WAYS && code == PROGRAM_OK; w++) {
        const bench_way way = accuracy_way_of(r->job->settings, variant, w);
        bench_way_name(&way, built.structure, r->config);
        if (r->subject->triangles || w <= ACCURACY_SPHERE_WAYS)
            code = measure_way(r, &way);
    }
    cgt_scene_release(r->scene);
    cgt_context_release(r->context);
    r->scene = NULL;
    r->context = NULL;
    return code;
}

static int measure_subject(const accuracy_job *job, subject *s)
{
    const size_t rays = (size_t)s->scene.rays + 1;
    run r = {.job = job,
             .subject = s,
             .hits = calloc(rays, sizeof *r.hits),
             .t_ulp = calloc(rays, sizeof *r.t_ulp),
             .angle = calloc(rays, sizeof *r.angle),
             .ms = calloc(job->settings->repeat, sizeof *r.ms)};
    int code = PROGRAM_OK;
    for (uint32_t g = 0; g < s->scene.geometries; g++)
        s->triangles += s->scene.geometry[g].triangles;
    if (!r.hits || !r.t_ulp || !r.angle || !r.ms || !hard_truth_make(&s->scene, &s->truth))
        code = out_of_memory(s);
    for (size_t v = 0; v < job->variants && code == PROGRAM_OK; v++)
        code = measure_variant(&r, job->variant[v]);
    free(r.hits);
    free(r.t_ulp);
    free(r.angle);
    free(r.ms);
    return code;
}

int accuracy_cases(const accuracy_job *job)
{
    const bench_settings *settings = job->settings;
    const size_t cases = hard_case_count();
    int code = PROGRAM_OK;
    for (size_t i = 0; i < cases + settings->files && code == PROGRAM_OK; i++) {
        const hard_case *hard = i < cases ? hard_case_at(i) : NULL;
        const char *path = hard ? NULL : settings->paths[i - cases];
        subject s;
        memset(&s, 0, sizeof s);
        snprintf(s.name, sizeof s.name, "%s%s%s", hard ? hard->row : path, hard ? ": " : "", hard ? hard->name : "");
        if (settings->text && !strstr(s.name, settings->text))
            continue;
        code = hard ? make_case(&s, hard, settings->rays) : make_file(&s, settings, path);
        if (code == PROGRAM_OK)
            code = measure_subject(job, &s);
        free_subject(&s);
    }
    return code;
}
