/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench scaling: how a frame's calls would share any number of threads. The library's tasks are watched
 * (cgt_research_watch_tasks), cut as for that number; their times are taken on one thread, and threads simulated. Where
 * the machine has so many CPUs, the same calls are measured on as many threads, to compare. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"
#include "scaling/scaling_times.h"
#include "system/system.h"
#include "ways/bench_tracer.h"

enum { COMMIT, CAMERA, SHADOW, AMBIENT, RAYS, CALLS, FRAME = CALLS };
enum { MOST_ROWS = 256 }; /* the library has some forty phases */
static const char *const call_names[] = {"commit", "camera", "shadow", "ambient", "rays", "frame"};

enum { TASKS, LONGEST, SUM, SIMULATED, LIMIT, MEASURED, FIGURES };

/* A phase of a call, or the whole of it. */
typedef struct scaling_row {
    int call;
    const char *phase; /* NULL: the whole */
    double *value;     /* FIGURES of each frame */
} scaling_row;

typedef struct scaling_job {
    const bench_settings *settings;
    bench_table *table;
    bench_session session;
    bench_found found;
    float *visibility;
    bench_rays *rays;
    scaling_times times;
    int watched;
    double busy_until[BENCH_MOST_SCALING]; /* of the simulated threads */
    double began_ms, measured_ms;
    scaling_row row[MOST_ROWS]; /* the first ones: of each call, and of the frame */
    size_t rows, frames, frame; /* frames: that count */
} scaling_job;

/* ---- a frame's calls ---- */

static void begin(scaling_job *job)
{
    if (job->watched)
        scaling_times_begin(&job->times);
    else
        job->began_ms = bench_session_ms(&job->session);
}

static void end(scaling_job *job)
{
    if (job->watched)
        scaling_times_end(&job->times);
    else
        job->measured_ms += bench_session_ms(&job->session) - job->began_ms;
}

/* Making the rays is the benchmark's, not the library's. */
static cgt_result trace_batch(void *user, const cgt_rays *batch, const cgt_hits *scratch, uint8_t *occluded)
{
    scaling_job *const job = user;
    bench_tracer *const t = job->session.tracer;
    const bench_rays_sink sink = t->engine->sink(t, 0, 0, 0);
    begin(job);
    const cgt_result result = sink.batch(sink.user, batch, scratch, occluded);
    end(job);
    return result;
}

static int run_rays(scaling_job *job)
{
    const bench_rays_sink sink = {.batch = trace_batch, .user = job};
    uint64_t open;
    const cgt_result result = bench_rays_ao(job->rays, &sink, job->settings->ao, &open);
    return result == CGT_OK ? PROGRAM_OK : bench_failed(job->session.context, job->session.path, result);
}

static int run_ambient(const scaling_job *job)
{
    const bench_session *s = &job->session;
    const cgt_ambient_options ambient = {.samples = job->settings->ao};
    cgt_frame frame;
    bench_planes_frame(&job->found.planes, &frame);
    const cgt_result result =
        cgt_ambient_occlusion(s->tracer->scene, s->camera, &frame, &ambient, job->visibility, NULL);
    return result == CGT_OK ? PROGRAM_OK : bench_failed(s->context, s->path, result);
}

static int run_call(scaling_job *job, int call)
{
    bench_tracer *const t = job->session.tracer;
    const float *const at = job->settings->light;
    const cgt_light light = {.position = {at[0], at[1], at[2]}, .kind = CGT_LIGHT_POINT};
    const bench_set shadows = {.query = BENCH_LIT_PICTURE, .light = &light, .lights = 1};
    if (call == RAYS)
        return run_rays(job);
    begin(job);
    const int code = call == COMMIT    ? t->engine->commit(t)
                     : call == CAMERA  ? t->engine->picture(t, &job->found.planes, NULL)
                     : call == AMBIENT ? run_ambient(job)
                                       : t->engine->trace(t, &shadows, 0, 0, 0, &job->found, NULL);
    end(job);
    return code;
}

/* ---- figures ---- */

/* The row of a phase; NULL, after a message, where there is no memory for it. */
static scaling_row *find_row(scaling_job *job, int call, const char *phase)
{
    size_t i = 0;
    while (i < job->rows && (job->row[i].call != call || (job->row[i].phase == NULL) != (phase == NULL) ||
                             (phase && strcmp(job->row[i].phase, phase) != 0)))
        i++;
    if (i < job->rows)
        return &job->row[i];
    double *value = i < MOST_ROWS ? calloc(job->frames * FIGURES, sizeof *value) : NULL;
    if (!value) {
        program_error("out of memory");
        return NULL;
    }
    job->row[job->rows++] = (scaling_row){call, phase, value};
    return &job->row[i];
}

static int keep_phase(scaling_job *job, int call, const char *phase)
{
    scaling_row *const row = find_row(job, call, phase);
    if (!row)
        return PROGRAM_FAILED;
    const uint32_t threads = cgt_context_get_threads(job->session.context);
    const scaling_figures f = scaling_simulate(&job->times, phase, threads, job->busy_until);
    double *const value = row->value + job->frame * FIGURES;
    memcpy(value, (const double[]){f.tasks, f.longest, f.sum, f.simulated, f.limit}, sizeof(double[MEASURED]));
    return PROGRAM_OK;
}

/* A call of a watched frame: as a whole, what is serial, and each phase in the order in which they come. */
static int keep_call(scaling_job *job, int call)
{
    int code = keep_phase(job, call, NULL);
    if (code == PROGRAM_OK)
        code = keep_phase(job, call, scaling_serial);
    for (size_t i = 0; i < job->times.batches && code == PROGRAM_OK; i++)
        code = keep_phase(job, call, job->times.batch[i].phase);
    return code;
}

/* The frame: the sums of its calls. */
static void add_calls(scaling_job *job)
{
    double *const sum = job->row[FRAME].value + job->frame * FIGURES;
    for (int call = 0; call < CALLS; call++)
        for (int f = 0; f < FIGURES; f++) {
            const double value = job->row[call].value[job->frame * FIGURES + (size_t)f];
            sum[f] = f == LONGEST ? fmax(sum[f], value) : sum[f] + value;
        }
}

/* ---- measuring ---- */

static int measure_call(scaling_job *job, int call, int counts)
{
    scaling_times_reset(&job->times);
    job->measured_ms = 0;
    int code = run_call(job, call);
    if (code == PROGRAM_OK && job->times.failed) {
        program_error("out of memory");
        code = PROGRAM_FAILED;
    }
    if (code != PROGRAM_OK || !counts)
        return code;
    if (job->watched)
        return keep_call(job, call);
    job->row[call].value[job->frame * FIGURES + MEASURED] = job->measured_ms;
    return PROGRAM_OK;
}

/* A frame, watched and then measured. */
static int measure_frame(scaling_job *job, int measures, int counts)
{
    int code = PROGRAM_OK;
    for (job->watched = 1; job->watched >= !measures && code == PROGRAM_OK; job->watched--) {
        (void)cgt_research_watch_tasks(job->session.context, job->watched ? scaling_times_watch : NULL, &job->times);
        for (int call = 0; call < CALLS && code == PROGRAM_OK; call++)
            code = measure_call(job, call, counts);
    }
    return code;
}

/* The first frame warms up, unless it is the only one. */
static int measure(scaling_job *job, int measures)
{
    bench_session *const s = &job->session;
    const size_t total = s->input.frames * job->settings->repeat;
    int code = PROGRAM_OK;
    job->frames = total > 1 ? total - 1 : 1;
    for (int call = 0; call <= FRAME && code == PROGRAM_OK; call++)
        code = find_row(job, call, NULL) ? PROGRAM_OK : PROGRAM_FAILED;
    for (size_t i = 0; i < total && code == PROGRAM_OK; i++) {
        const int counts = i > 0 || total == 1;
        s->count = bench_input_move(&s->input, i % s->input.frames);
        code = measure_frame(job, measures, counts);
        if (code == PROGRAM_OK && counts) {
            add_calls(job);
            job->frame++;
        }
    }
    return code;
}

/* ---- rows ---- */

static void write_row(const scaling_job *job, const scaling_row *row, int measures, double *sorted)
{
    const uint32_t threads = cgt_context_get_threads(job->session.context);
    double m[FIGURES];
    for (size_t f = 0; f < FIGURES; f++) {
        for (size_t i = 0; i < job->frames; i++)
            sorted[i] = row->value[i * FIGURES + f];
        m[f] = bench_median(sorted, job->frames);
    }
    BENCH_ROW(job->table, CELL("config", job->session.tracer->config), CELL("scene", job->session.scene),
              CELL("threads", threads), CELL("call", call_names[row->call]),
              CELL("phase", row->phase ? row->phase : "all"), CELL("tasks", m[TASKS]), CELL("longest_ms", m[LONGEST]),
              CELL("sum_ms", m[SUM]), CELL("simulated_ms", m[SIMULATED]),
              CELL("efficiency", m[SIMULATED] > 0 ? m[SUM] / (threads * m[SIMULATED]) : NAN),
              CELL("limit_ms", m[LIMIT]), CELL("measured_ms", measures && !row->phase ? m[MEASURED] : NAN));
}

/* Each call with its phases, and the frame. */
static int write_rows(const scaling_job *job, int measures)
{
    double *const sorted = calloc(job->frames, sizeof *sorted);
    if (!sorted) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    for (int call = 0; call <= FRAME; call++)
        for (size_t i = 0; i < job->rows; i++)
            if (job->row[i].call == call)
                write_row(job, &job->row[i], measures, sorted);
    free(sorted);
    return PROGRAM_OK;
}

/* ---- the whole ---- */

static int prepare(scaling_job *job, const char *path, const bench_input *input)
{
    const bench_settings *s = job->settings;
    bench_session *const session = &job->session;
    if (bench_session_open_input(session, s, path, input) || session->tracer->left_out)
        return PROGRAM_FAILED;
    const size_t pixels = (size_t)s->width * s->height;
    const int refused = bench_planes_create(&job->found.planes, s->width, s->height);
    job->found.planes.geometry = calloc(pixels, sizeof *job->found.planes.geometry);
    job->found.occluded = malloc(pixels);
    job->visibility = malloc(pixels * sizeof *job->visibility);
    job->rays = bench_rays_create(session->threads, &session->axes, &job->found.planes, s->ao);
    if (!refused && job->found.planes.geometry && job->found.occluded && job->visibility && job->rays)
        return PROGRAM_OK;
    program_error("out of memory");
    return PROGRAM_FAILED;
}

static void release(scaling_job *job)
{
    for (size_t i = 0; i < job->rows; i++)
        free(job->row[i].value);
    scaling_times_release(&job->times);
    bench_rays_release(job->rays);
    free(job->visibility);
    free(job->found.occluded);
    free(job->found.planes.geometry);
    bench_planes_release(&job->found.planes);
    memset(&job->session.input, 0, sizeof job->session.input); /* the caller's */
    bench_session_close(&job->session);
}

/* One file as so many threads share it. */
static int run(const bench_settings *settings, bench_table *table, const char *path, const bench_input *input)
{
    const int measures = settings->threads <= system_cpus();
    scaling_job *job = calloc(1, sizeof *job);
    if (!job) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    job->settings = settings;
    job->table = table;
    int code = prepare(job, path, input);
    if (code == PROGRAM_OK)
        code = measure(job, measures);
    if (code == PROGRAM_OK)
        code = write_rows(job, measures);
    release(job);
    free(job);
    return code;
}

static int run_file(const bench_settings *settings, bench_table *table, const char *path)
{
    bench_settings one = *settings;
    bench_input input;
    if (bench_input_load_file(&input, settings, path))
        return PROGRAM_FAILED;
    int code = PROGRAM_OK;
    for (uint32_t i = 0; i < settings->counts && code == PROGRAM_OK; i++) {
        one.threads = settings->count[i];
        code = run(&one, table, path, &input);
    }
    bench_input_release(&input);
    return code;
}

int bench_scaling(const bench_settings *settings)
{
    bench_table *table = bench_table_open(settings->json_path);
    int code = table ? bench_input_check_files(settings) : PROGRAM_FAILED;
    if (table)
        bench_table_section(table, "scaling");
    for (size_t i = 0; i < settings->files && code == PROGRAM_OK; i++)
        code = run_file(settings, table, settings->paths[i]);
    return bench_table_close(table) ? PROGRAM_FAILED : code;
}
