/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench frame: for each frame of a trajectory, moves the spheres or vertices, then measures commit, primary rays,
 * and on request shadow and ambient-occlusion rays, by all ways in turns. One row of medians for each way; then, of
 * several ways, how they compare. The first frame warms up. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"
#include "common/out_file.h"
#include "ways/bench_tracer.h"

/* Milliseconds of a frame; FRAME is the sum of the others. */
enum { BUILD, PRIMARY, SHADOW, AO, FRAME, TIMES };

/* What was measured of one way. */
typedef struct frame_row {
    double *ms[TIMES]; /* one value per measured frame; medians after the last */
    double median[TIMES];
    uint64_t hits, open, others; /* of the last frame; others: pixels with another primitive than in the first row */
} frame_row;

/* The file of hits that -o names: whole, or not there. */
typedef struct hits_file {
    const char *path;
    const char *temporary; /* NULL: there is no file, or it is finished */
    out_file file;
} hits_file;

typedef struct frame_job {
    const bench_settings *settings;
    bench_session session;
    cgt_camera camera;
    bench_planes planes, first; /* first: of the first row's last frame */
    bench_picture picture;      /* with --shade */
    bench_rays *rays;
    hits_file output;
    frame_row row[BENCH_MOST_WAYS];
    size_t measured; /* frames */
} frame_job;

static void make_orthographic(cgt_camera *c)
{
    double square = 0.0;
    for (int a = 0; a < 3; a++)
        square += ((double)c->target[a] - c->eye[a]) * ((double)c->target[a] - c->eye[a]);
    c->projection = CGT_PROJECTION_ORTHOGRAPHIC;
    c->height = (float)(2.0 * sqrt(square) * tan(c->fov * 3.14159265358979323846 / 360.0));
}

/* ---- measuring ---- */

/* Shadow and ambient-occlusion rays of the frame in the planes. */
static int measure_secondary(frame_job *job, bench_tracer *t, frame_row *row, double ms[TIMES])
{
    const bench_settings *s = job->settings;
    cgt_result result = CGT_OK;
    uint64_t hidden;
    if (s->lit) {
        const bench_rays_sink sink = t->engine->sink(t, 1, 0, 0);
        const double begin = bench_session_ms(&job->session);
        result = bench_rays_shadow(job->rays, &sink, s->light, &hidden);
        ms[SHADOW] = bench_session_ms(&job->session) - begin;
    }
    for (int form = 0; form < t->engine->forms && s->ao && result == CGT_OK; form++) {
        const bench_rays_sink sink = t->engine->sink(t, 0, s->nearest, form);
        const double begin = bench_session_ms(&job->session);
        result = bench_rays_ao(job->rays, &sink, s->ao, &row->open);
        const double taken = bench_session_ms(&job->session) - begin;
        ms[AO] = form && ms[AO] < taken ? ms[AO] : taken;
    }
    return result == CGT_OK ? PROGRAM_OK : bench_failed(job->session.context, job->session.path, result);
}

/* One frame by one way. */
static int measure_frame(frame_job *job, bench_tracer *t, frame_row *row, double ms[TIMES])
{
    bench_picture *const picture = job->settings->shade ? &job->picture : NULL;
    t->engine->move(t);
    const double begin = bench_session_ms(&job->session);
    int code = t->engine->commit(t);
    const double built = bench_session_ms(&job->session);
    if (code == PROGRAM_OK)
        code = t->engine->picture(t, &job->planes, picture);
    ms[BUILD] = built - begin;
    ms[PRIMARY] = bench_session_ms(&job->session) - built;
    if (code == PROGRAM_OK && (job->settings->lit || job->settings->ao)) {
        t->engine->planes(t, &job->planes);
        code = measure_secondary(job, t, row, ms);
    }
    ms[FRAME] = ms[BUILD] + ms[PRIMARY] + ms[SHADOW] + ms[AO];
    return code;
}

/* What a way has found in the last frame: not timed. */
static int inspect(frame_job *job, bench_tracer *t, frame_row *row)
{
    const size_t pixels = (size_t)job->planes.width * job->planes.height;
    int code = t->engine->picture(t, &job->planes, NULL);
    t->engine->planes(t, &job->planes);
    if (row == job->row) {
        memcpy(job->first.t, job->planes.t, pixels * sizeof *job->planes.t);
        memcpy(job->first.primitive, job->planes.primitive, pixels * sizeof *job->planes.primitive);
    }
    row->hits = bench_planes_hits(&job->planes);
    for (size_t i = 0; i < pixels; i++)
        row->others += job->planes.primitive[i] != job->first.primitive[i];
    if (code == PROGRAM_OK)
        code = bench_library_inspect(t);
    if (!t->way->embree) /* what AUTO became */
        bench_way_name(t->way, t->built.structure, t->config);
    if (!t->way->embree && t->built.structure == CGT_STRUCTURE_AUTO)
        memcpy(t->config, "none", 4);
    if (job->settings->shade)
        strncat(t->config, ",shade", sizeof t->config - strlen(t->config) - 1);
    return code == PROGRAM_OK && job->settings->verbose && !t->way->embree ? bench_library_describe(t, &job->planes)
                                                                           : code;
}

static int measure_way(void *of, size_t i)
{
    frame_job *job = of;
    double ms[TIMES] = {0.0};
    if (job->session.tracer[i].left_out)
        return PROGRAM_OK;
    const int code = measure_frame(job, &job->session.tracer[i], &job->row[i], ms);
    for (int c = 0; c < TIMES; c++)
        job->row[i].ms[c][job->measured] = ms[c];
    return code;
}

static int measure(frame_job *job)
{
    bench_session *s = &job->session;
    const size_t total = s->input.frames * job->settings->repeat;
    int code = PROGRAM_OK;
    for (size_t i = 0; i < total && code == PROGRAM_OK; i++) {
        s->count = bench_input_move(&s->input, i % s->input.frames);
        code = bench_round((uint32_t)i, s->tracers, measure_way, job);
        job->measured += i > 0 || total == 1;
    }
    for (size_t i = 0; i < s->tracers && code == PROGRAM_OK; i++) {
        for (int c = 0; c < TIMES; c++)
            job->row[i].median[c] = bench_median(job->row[i].ms[c], job->measured);
        if (!s->tracer[i].left_out)
            code = inspect(job, &s->tracer[i], &job->row[i]);
    }
    return code;
}

/* ---- rows ---- */

static int is_shown(const frame_job *job, size_t i)
{
    const bench_session *s = &job->session;
    size_t best = i;
    for (size_t k = 0; k < s->tracers && s->way[i].is_candidate; k++)
        if (s->way[k].is_candidate && job->row[k].median[FRAME] < job->row[best].median[FRAME])
            best = k;
    return best == i && !s->tracer[i].left_out;
}

/* The least of a column, or of the sum of two, among the library's rows. */
static double least(const frame_job *job, int a, int b)
{
    double value = INFINITY;
    for (size_t i = 0; i < job->session.tracers; i++)
        if (!job->session.way[i].embree && !job->session.tracer[i].left_out)
            value = fmin(value, job->row[i].median[a] + (b == a ? 0 : job->row[i].median[b]));
    return value;
}

/* By what factors the library's best row is faster than each: frame; build and shadow rays, or ambient-occlusion rays,
 * for what it builds for such rays while it traces them is in their time. */
static void write_comparison(const frame_job *job, bench_table *table)
{
    const double frame = least(job, FRAME, FRAME), shadow = least(job, BUILD, SHADOW), ao = least(job, BUILD, AO);
    bench_table_section(table, "compare");
    for (size_t i = 0; i < job->session.tracers; i++) {
        const double *m = job->row[i].median;
        if (is_shown(job, i))
            BENCH_ROW(table, CELL("config", job->session.tracer[i].config), CELL("faster", m[FRAME] / frame),
                      CELL("shadow_faster", m[SHADOW] > 0 ? (m[BUILD] + m[SHADOW]) / shadow : NAN),
                      CELL("ao_faster", m[AO] > 0 ? (m[BUILD] + m[AO]) / ao : NAN),
                      CELL("other_pixels", job->row[i].others));
    }
}

static void write_rows(const frame_job *job, bench_table *table)
{
    const bench_session *s = &job->session;
    size_t shown = 0;
    bench_table_section(table, "frame");
    for (size_t i = 0; i < s->tracers; i++) {
        const double *m = job->row[i].median;
        if (!is_shown(job, i))
            continue;
        shown++;
        BENCH_ROW(table, CELL("config", s->tracer[i].config), CELL("threads", cgt_context_get_threads(s->context)),
                  CELL("build_ms", m[BUILD]), CELL("primary_ms", m[PRIMARY]), CELL("shadow_ms", m[SHADOW]),
                  CELL("ao_ms", m[AO]), CELL("frame_ms", m[FRAME]), CELL("hit_pixels", job->row[i].hits),
                  CELL("ao_open", job->row[i].open));
    }
    if (shown > 1)
        write_comparison(job, table);
}

/* ---- the hits ---- */

static int begin_output(hits_file *output, const char *path)
{
    char error[PROGRAM_ERROR_SIZE];
    *output = (hits_file){.path = path};
    if (!path || (output->temporary = out_file_begin(&output->file, path, error, sizeof error)) != NULL)
        return PROGRAM_OK;
    program_error("%s", error);
    return PROGRAM_FAILED;
}

static int write_hits(const hits_file *output, const bench_planes *planes)
{
    FILE *file = fopen(output->temporary, "wb");
    int failed = !file || bench_planes_write(planes, file);
    int reason = errno;
    if (file && fclose(file) && !failed) {
        failed = 1;
        reason = errno;
    }
    if (failed)
        program_error("%s: %s", output->path, strerror(reason));
    return failed;
}

/* Writes the hits, and ends the file; planes: NULL where there are none: no file stays. */
static int end_output(hits_file *output, const bench_planes *planes)
{
    char error[PROGRAM_ERROR_SIZE];
    if (!output->temporary)
        return PROGRAM_OK;
    const int is_whole = planes && !write_hits(output, planes);
    output->temporary = NULL;
    if (out_file_end(&output->file, is_whole, error, sizeof error)) {
        program_error("%s", error);
        return PROGRAM_FAILED;
    }
    return is_whole || !planes ? PROGRAM_OK : PROGRAM_FAILED;
}

/* ---- the whole ---- */

/* Everything that may fail before the first measurement. */
static int prepare(frame_job *job)
{
    const bench_settings *s = job->settings;
    bench_session *session = &job->session;
    if (bench_session_open(session, s, s->paths[0]) || begin_output(&job->output, s->output))
        return PROGRAM_FAILED;
    job->camera = s->camera;
    if (s->orthographic)
        make_orthographic(&job->camera);
    session->camera = &job->camera;
    int complete = !bench_planes_create(&job->planes, s->width, s->height) &&
                   !bench_planes_create(&job->first, s->width, s->height) &&
                   (job->rays = bench_rays_create(session->context, &session->axes, &job->planes, s->ao)) != NULL &&
                   (!s->shade || !bench_picture_create(&job->picture, s->width, s->height));
    if (s->repeat > SIZE_MAX / sizeof(double) / session->input.frames)
        complete = 0;
    for (size_t i = 0; i < session->tracers; i++)
        for (int c = 0; complete && c < TIMES; c++)
            complete = (job->row[i].ms[c] = calloc(session->input.frames * s->repeat, sizeof(double))) != NULL;
    if (!complete)
        program_error("out of memory");
    return complete ? PROGRAM_OK : PROGRAM_FAILED;
}

int bench_frame(const bench_settings *settings)
{
    frame_job *job = calloc(1, sizeof *job);
    bench_table *table = job ? bench_table_open(settings->json_path) : NULL;
    if (!table) {
        free(job);
        return PROGRAM_FAILED;
    }
    job->settings = settings;
    int code = prepare(job);
    if (code == PROGRAM_OK)
        code = measure(job);
    if (code == PROGRAM_OK)
        write_rows(job, table);
    if (end_output(&job->output, code == PROGRAM_OK ? &job->first : NULL))
        code = PROGRAM_FAILED;
    if (bench_table_close(table))
        code = PROGRAM_FAILED;
    for (size_t i = 0; i < BENCH_MOST_WAYS; i++)
        for (int c = 0; c < TIMES; c++)
            free(job->row[i].ms[c]);
    bench_rays_release(job->rays);
    bench_planes_release(&job->planes);
    bench_planes_release(&job->first);
    bench_picture_release(&job->picture);
    bench_session_close(&job->session);
    free(job);
    return code;
}
