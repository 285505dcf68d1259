/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whole frames of a file, in every variant, precision and triangle test: time against error. First the hits of every
 * way are compared with those of EXACT in the first variant, the truth for all, in runs that are not timed and warm
 * up. Then the variants take turns frame by frame, and their ways. */
#include "accuracy/bench_accuracy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"

/* Bins of distances in ulp: one each below SINGLE, then PER_OCTAVE to each power of two. */
enum { SINGLE = 1024, PER_OCTAVE = 64, BINS = SINGLE + (32 - 10) * PER_OCTAVE };

/* Errors of a way, sums over frames: rays with another primitive than the truth, and distances of t elsewhere. */
typedef struct errors {
    uint64_t rays, hits, missed, invented, wrong, same; /* hits: of the truth; same: whose t are compared */
    uint32_t t_worst;
    uint64_t t_bins[BINS];
} errors;

/* One variant's scene, and the times of each frame. */
typedef struct runner {
    bench_session session;
    bench_tracer tracer[ACCURACY_WAYS]; /* of one scene, the first one's */
    bench_way way[ACCURACY_WAYS];
    double *build_ms, *trace_ms[ACCURACY_WAYS];
    errors error[ACCURACY_WAYS];
} runner;

typedef struct frames_job {
    const accuracy_job *accuracy;
    runner *runner; /* of each variant */
    size_t ways, measured;
    int compares; /* 1: the hits, not the times */
    size_t frame; /* of the file */
    uint32_t round;
    runner *current;
    bench_planes truth, planes;
    double *times, *scratch; /* times: memory of all runners' */
} frames_job;

/* ---- errors ---- */

/* Maps floats to integers in the same order. */
static int64_t order_of(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    const int64_t size = (int64_t)(bits & 0x7fffffffu);
    return bits >> 31 ? -size : size;
}

/* Above SINGLE a distance falls to its power of two and the six bits after the leading one. */
static uint32_t bin_of(uint32_t distance)
{
    uint32_t octave = 10;
    if (distance < SINGLE)
        return distance;
    while (distance >> octave > 1)
        octave++;
    return SINGLE + (octave - 10) * PER_OCTAVE + ((distance >> (octave - 6)) & (PER_OCTAVE - 1));
}

/* The largest distance that falls into a bin. */
static uint32_t end_of(uint32_t bin)
{
    if (bin < SINGLE)
        return bin;
    const uint32_t octave = 10 + (bin - SINGLE) / PER_OCTAVE;
    const uint64_t step = (bin - SINGLE) % PER_OCTAVE + PER_OCTAVE + 1;
    return (uint32_t)((step << (octave - 6)) - 1);
}

static void add_errors(errors *e, const bench_planes *truth, const bench_planes *frame)
{
    const size_t pixels = (size_t)truth->width * truth->height;
    e->rays += pixels;
    for (size_t i = 0; i < pixels; i++) {
        const int hit = truth->primitive[i] != CGT_INVALID_ID, found = frame->primitive[i] != CGT_INVALID_ID;
        const int same = truth->primitive[i] == frame->primitive[i];
        e->hits += (uint64_t)hit;
        e->missed += (uint64_t)(hit && !found);
        e->invented += (uint64_t)(!hit && found);
        e->wrong += (uint64_t)(hit && found && !same);
        if (!hit || !found || !same)
            continue;
        const int64_t steps = order_of(truth->t[i]) - order_of(frame->t[i]);
        const uint32_t distance = (uint32_t)(steps < 0 ? -steps : steps);
        e->same++;
        e->t_bins[bin_of(distance)]++;
        e->t_worst = distance > e->t_worst ? distance : e->t_worst;
    }
}

/* The distance that `share` of the t compared do not exceed, at most 1/64 too large; 0 where none was compared. */
static uint32_t distance_at(const errors *e, double share)
{
    uint64_t below = 0;
    for (uint32_t bin = 0; bin < BINS; bin++) {
        below += e->t_bins[bin];
        if (below && (double)below >= share * (double)e->same)
            return end_of(bin) < e->t_worst ? end_of(bin) : e->t_worst;
    }
    return 0;
}

/* ---- measuring ---- */

static int trace_way(void *of, size_t way)
{
    frames_job *job = of;
    runner *r = job->current;
    bench_tracer *t = &r->tracer[way];
    const int is_truth = job->compares && r == job->runner && way == ACCURACY_EXACT;
    const bench_planes *planes = is_truth ? &job->truth : &job->planes;
    /* Hits left from the previous run must not count for this one: no primitive has this number. */
    memset(planes->primitive, 0xfe, (size_t)planes->width * planes->height * sizeof *planes->primitive);
    const double start = bench_session_ms(&r->session);
    const int code = t->engine->picture(t, planes, NULL);
    if (!job->compares)
        r->trace_ms[way][job->measured] = bench_session_ms(&r->session) - start;
    else if (code == PROGRAM_OK)
        add_errors(&r->error[way], &job->truth, planes);
    return code;
}

static int run_variant(void *of, size_t variant)
{
    frames_job *job = of;
    runner *r = job->current = &job->runner[variant];
    r->session.count = bench_input_move(&r->session.input, job->frame);
    const double start = bench_session_ms(&r->session);
    const int code = r->tracer[0].engine->commit(&r->tracer[0]);
    if (!job->compares)
        r->build_ms[job->measured] = bench_session_ms(&r->session) - start;
    return code == PROGRAM_OK ? bench_round(job->round, job->ways, trace_way, job) : code;
}

static int measure(frames_job *job)
{
    const size_t frames = job->runner->session.input.frames;
    int code = PROGRAM_OK;
    for (uint32_t pass = 0; pass <= job->accuracy->settings->repeat; pass++)
        for (job->frame = 0; job->frame < frames && code == PROGRAM_OK; job->frame++) {
            job->compares = pass == 0;
            job->round = job->compares ? 0 : (uint32_t)(pass + job->frame); /* 0: the truth comes first */
            code = bench_round(job->round, job->accuracy->variants, run_variant, job);
            job->measured += !job->compares;
        }
    return code;
}

/* ---- rows ---- */

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

static void write_row(frames_job *job, const runner *r, size_t way)
{
    const bench_choice *c = &r->way[way].choice;
    const double *fast = r->trace_ms[ACCURACY_FAST], *trace = r->trace_ms[way];
    const errors *e = &r->error[way];
    const double bad = (double)(e->missed + e->invented + e->wrong);
    char config[BENCH_NAME_SIZE];
    bench_way_name(&r->way[way], r->tracer[0].built.structure, config);
    BENCH_ROW(job->accuracy->table, CELL("scene", r->session.scene), CELL("config", config),
              CELL("variant", c->variant), CELL("precision", bench_precisions[c->precision]),
              CELL("test", r->session.input.index ? bench_triangle_tests[c->test] : "-"),
              CELL("threads", cgt_context_get_threads(r->session.context)),
              CELL("build_ms", median_of(job, r->build_ms, NULL)), CELL("trace_ms", median_of(job, trace, NULL)),
              CELL("ms", median_of(job, trace, r->build_ms)), CELL("rays", e->rays), CELL("hits", e->hits),
              CELL("missed", e->missed), CELL("invented", e->invented), CELL("wrong", e->wrong),
              CELL("wrong_share", e->rays ? bad / (double)e->rays : 0.0), CELL("t_ulp_median", distance_at(e, 0.5)),
              CELL("t_ulp_p99", distance_at(e, 0.99)), CELL("t_ulp_worst", e->t_worst),
              CELL("cost_percent", median_cost(job, trace, fast, r->build_ms)),
              CELL("trace_cost_percent", median_cost(job, trace, fast, NULL)));
}

/* ---- one file ---- */

/* The ways of a variant share a scene. */
static int open_runner(const frames_job *job, runner *r, const char *variant, const char *path)
{
    bench_settings settings = *job->accuracy->settings;
    settings.choice.variant = variant;
    int code = bench_session_open(&r->session, &settings, path);
    r->session.settings = job->accuracy->settings;
    r->session.camera = &job->accuracy->settings->camera;
    for (size_t w = 0; w < ACCURACY_WAYS && code == PROGRAM_OK; w++) {
        r->way[w] = accuracy_way_of(job->accuracy->settings, variant, w);
        r->tracer[w] = (bench_tracer){
            .engine = &bench_library_engine, .way = &r->way[w], .session = &r->session, .built_by = &r->tracer[0]};
        code = r->tracer[w].engine->open(&r->tracer[w]);
    }
    return code;
}

/* Room for the times of all frames. */
static int reserve_times(frames_job *job)
{
    const accuracy_job *accuracy = job->accuracy;
    const size_t frames = job->runner->session.input.frames, repeat = accuracy->settings->repeat;
    const size_t values = repeat <= SIZE_MAX / sizeof(double) / frames ? repeat * frames : 0,
                 of_runner = 1 + ACCURACY_WAYS;
    job->times = values ? calloc(accuracy->variants * of_runner, values * sizeof(double)) : NULL;
    job->scratch = values ? calloc(values, sizeof(double)) : NULL;
    for (size_t v = 0; v < accuracy->variants && job->times; v++) {
        runner *r = &job->runner[v];
        r->build_ms = job->times + v * of_runner * values;
        for (size_t w = 0; w < ACCURACY_WAYS; w++)
            r->trace_ms[w] = r->build_ms + (1 + w) * values;
    }
    if (job->times && job->scratch)
        return PROGRAM_OK;
    program_error("out of memory");
    return PROGRAM_FAILED;
}

static int run_file(frames_job *job, const char *path)
{
    const accuracy_job *accuracy = job->accuracy;
    const bench_settings *s = accuracy->settings;
    int code = PROGRAM_OK;
    for (size_t v = 0; v < accuracy->variants && code == PROGRAM_OK; v++)
        code = open_runner(job, &job->runner[v], accuracy->variant[v], path);
    if (code == PROGRAM_OK && (bench_planes_create(&job->truth, s->width, s->height) ||
                               bench_planes_create(&job->planes, s->width, s->height)))
        code = PROGRAM_FAILED;
    if (code == PROGRAM_OK)
        code = reserve_times(job);
    if (code != PROGRAM_OK)
        return code;
    job->ways = job->runner->session.input.index ? ACCURACY_WAYS : ACCURACY_SPHERE_WAYS;
    code = measure(job);
    bench_table_section(accuracy->table, "frames");
    for (size_t v = 0; v < accuracy->variants && code == PROGRAM_OK; v++) {
        code = bench_library_inspect(&job->runner[v].tracer[0]);
        for (size_t w = 0; w < job->ways && code == PROGRAM_OK; w++)
            write_row(job, &job->runner[v], w);
    }
    return code;
}

int accuracy_frames(const accuracy_job *accuracy, const char *path)
{
    frames_job job = {.accuracy = accuracy, .runner = calloc(accuracy->variants, sizeof(runner))};
    int code = job.runner ? run_file(&job, path) : PROGRAM_FAILED;
    for (size_t v = 0; v < accuracy->variants && job.runner; v++) {
        bench_library_engine.close(&job.runner[v].tracer[0]);
        bench_session_close(&job.runner[v].session);
    }
    free(job.runner);
    free(job.times);
    free(job.scratch);
    bench_planes_release(&job.planes);
    bench_planes_release(&job.truth);
    return code;
}
