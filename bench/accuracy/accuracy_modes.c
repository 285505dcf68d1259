/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The same picture in every mode of execution: variants, packet sizes, tile shapes, threads, a camera's packets, arrays
 * of rays, single rays. How far directions and hits of the modes differ from each other and from the truth.
 *
 * Directions are measured by a probe: two planes across an axis, one unit before and behind the eye, give
 * t = 1 / |component|, rounded once. The true direction is the formula of cgt.h in long double; where a component is
 * the small difference of large numbers, a few ulp of those are many of its own. The table follows Fig. 7.6 of the
 * thesis, which compares the directions of two modes by their differences. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy/bench_accuracy.h"

#define EDGE 128u /* pixels of the picture, each way */
#define PIXELS (EDGE * EDGE)
#define SMALL_EDGE 48u /* for few rays: more than one task, but quick */
#define FEW_RAYS 1000u
#define FAR_AWAY 4096.0f /* half the edge of a probe's planes */

typedef enum mode_kind { MODE_CAMERA, MODE_ARRAY, MODE_SINGLE } mode_kind;

typedef struct mode {
    const char *name;
    mode_kind kind;
    uint32_t packet;
    cgt_tile_shape tile;
    uint32_t threads;
} mode;

/* The first one, in the first variant and ROBUST, is the reference for the others. */
static const mode modes[] = {{"camera,packet=16", MODE_CAMERA, 16, CGT_TILE_SHAPE_SQUARE, 1},
                             {"camera,packet=8", MODE_CAMERA, 8, CGT_TILE_SHAPE_SQUARE, 1},
                             {"camera,packet=4", MODE_CAMERA, 4, CGT_TILE_SHAPE_SQUARE, 1},
                             {"camera,strips", MODE_CAMERA, 0, CGT_TILE_SHAPE_STRIP, 1},
                             {"camera,packet=16,threads=3", MODE_CAMERA, 16, CGT_TILE_SHAPE_SQUARE, 3},
                             {"array of rays", MODE_ARRAY, 0, CGT_TILE_SHAPE_AUTO, 1},
                             {"array of rays,threads=3", MODE_ARRAY, 0, CGT_TILE_SHAPE_AUTO, 3},
                             {"single rays", MODE_SINGLE, 0, CGT_TILE_SHAPE_AUTO, 1}};
#define MODES (sizeof modes / sizeof modes[0])

/* The results of a mode: the scene's hits, and t of the probes of three axes. */
typedef struct finding {
    full_hit hit[PIXELS];
    float probe[3][PIXELS];
} finding;

typedef struct modes_job {
    const accuracy_job *accuracy;
    uint32_t edge, pixels; /* at most EDGE and PIXELS */
    cgt_camera camera;
    accuracy_subject subject;
    hard_scene probe[3];
    long double direction[PIXELS][3]; /* the truth */
    finding first, found;
} modes_job;

/* ---- the picture and the probes ---- */

/* Directions by the formula of cgt.h, without rounding to float on the way. */
static void find_directions(modes_job *job)
{
    const cgt_camera *c = &job->camera;
    long double fwd[3], right[3], up[3], length = 0;
    const long double half = tanl((long double)c->fov * acosl(-1.0L) / 360);
    for (int a = 0; a < 3; a++) {
        fwd[a] = (long double)c->target[a] - c->eye[a];
        length += fwd[a] * fwd[a];
    }
    for (int a = 0; a < 3; a++)
        fwd[a] /= sqrtl(length);
    length = 0;
    for (int a = 0; a < 3; a++) {
        right[a] = fwd[(a + 1) % 3] * c->up[(a + 2) % 3] - fwd[(a + 2) % 3] * c->up[(a + 1) % 3];
        length += right[a] * right[a];
    }
    for (int a = 0; a < 3; a++)
        right[a] /= sqrtl(length);
    for (int a = 0; a < 3; a++)
        up[a] = right[(a + 1) % 3] * fwd[(a + 2) % 3] - right[(a + 2) % 3] * fwd[(a + 1) % 3];
    for (uint32_t i = 0; i < job->pixels; i++) {
        const uint32_t column = i % job->edge, row = i / job->edge;
        const long double x = 2 * (column + 0.5L) / job->edge - 1, y = 1 - 2 * (row + 0.5L) / job->edge;
        for (int a = 0; a < 3; a++)
            job->direction[i][a] = fwd[a] + x * half * right[a] + y * half * up[a];
    }
}

static void make_probe(modes_job *job, int axis)
{
    hard_scene *s = &job->probe[axis];
    for (int k = 0; k < 4; k++) {
        float v[3][3];
        for (int corner = 0; corner < 3; corner++) {
            const int which = k % 2 ? 3 - corner : corner; /* of a square's corners, in order of bits */
            v[corner][axis] = job->camera.eye[axis] + (k < 2 ? 1 : -1);
            v[corner][(axis + 1) % 3] = which & 1 ? FAR_AWAY : -FAR_AWAY;
            v[corner][(axis + 2) % 3] = which & 2 ? FAR_AWAY : -FAR_AWAY;
        }
        hard_raw_triangle(s, (const float(*)[3])v);
    }
}

/* The scene of a hard case, without that case's rays: those of a picture. */
static int make_picture(modes_job *job)
{
    const hard_case *hard = NULL;
    cgt_camera_rays rays;
    char message[160];
    for (size_t i = 0; i < hard_case_count() && !hard; i++)
        if (!strcmp(hard_case_at(i)->row, "scalar = SIMD"))
            hard = hard_case_at(i);
    cgt_camera_init(&job->camera);
    job->camera.eye[0] = 0.75f; /* short fractions: planes at one unit from the eye are exact */
    job->camera.eye[1] = 0.5f;
    job->camera.eye[2] = 3.0f;
    if (!hard || cgt_camera_prepare(&job->camera, job->edge, job->edge, &rays, message) != CGT_OK) {
        program_error("modes: there is no picture to trace");
        return PROGRAM_FAILED;
    }
    if (!hard_case_make(hard, 0, &job->subject.scene))
        return PROGRAM_FAILED;
    job->subject.scene.wanted = job->pixels;
    for (uint32_t i = 0; i < job->pixels; i++) {
        const truth_ray ray = camera_ray(&rays, i % job->edge, i / job->edge);
        hard_raw_ray(&job->subject.scene, &ray);
    }
    for (int axis = 0; axis < 3; axis++)
        make_probe(job, axis);
    find_directions(job);
    const bool failed =
        job->subject.scene.failed || job->probe[0].failed || job->probe[1].failed || job->probe[2].failed;
    if (failed || !hard_truth_make(&job->subject.scene, &job->subject.truth)) {
        program_error("modes: out of memory");
        return PROGRAM_FAILED;
    }
    return PROGRAM_OK;
}

/* ---- tracing ---- */

static cgt_result trace_camera(const modes_job *job, const cgt_scene *scene, const cgt_trace_options *options,
                               full_hit *hits)
{
    float *plane = calloc((size_t)6 * PIXELS, sizeof *plane); /* as many as there may be */
    uint32_t *ids = calloc((size_t)2 * PIXELS, sizeof *ids);
    cgt_frame frame;
    cgt_frame_init(&frame, job->edge, job->edge);
    cgt_result result = CGT_ERROR_OUT_OF_MEMORY;
    if (plane && ids) {
        frame.t = plane;
        for (int a = 0; a < 3; a++)
            frame.normal[a] = plane + (size_t)(1 + a) * job->pixels;
        frame.u = plane + (size_t)4 * job->pixels;
        frame.v = plane + (size_t)5 * job->pixels;
        frame.primitive = ids;
        frame.geometry = ids + job->pixels;
        result = cgt_trace_camera(scene, &job->camera, &frame, options);
        for (uint32_t i = 0; i < job->pixels; i++)
            hits[i] = (full_hit){frame.t[i],
                                 frame.primitive[i],
                                 frame.geometry[i],
                                 {frame.normal[0][i], frame.normal[1][i], frame.normal[2][i]},
                                 {frame.u[i], frame.v[i]}};
    }
    free(ids);
    free(plane);
    return result;
}

static cgt_result trace_mode(const modes_job *job, const mode *m, const cgt_scene *scene, cgt_precision precision,
                             full_hit *hits)
{
    const bench_choice choice = {.precision = precision, .packet = m->packet, .tile = m->tile};
    cgt_trace_options options;
    cgt_research_trace_options research;
    const truth_ray *rays = job->subject.scene.ray;
    cgt_result result = CGT_OK;
    bench_choice_options(&choice, NULL, &options, &research);
    switch (m->kind) {
    case MODE_CAMERA: return trace_camera(job, scene, &options, hits);
    case MODE_ARRAY: return trace_array(scene, rays, job->pixels, hits, &options);
    case MODE_SINGLE:
        for (uint32_t i = 0; i < job->pixels && result == CGT_OK; i++)
            result = trace_array(scene, &rays[i], 1, &hits[i], &options);
    }
    return result;
}

static cgt_result find(const modes_job *job, const mode *m, cgt_context *context, cgt_precision precision,
                       finding *found)
{
    cgt_scene *scene;
    cgt_result result = CGT_OK;
    for (int axis = 0; axis < 3 && result == CGT_OK; axis++) {
        result = hard_commit(context, &job->probe[axis], NULL, &scene);
        if (result != CGT_OK)
            break;
        result = trace_mode(job, m, scene, CGT_PRECISION_ROBUST, found->hit);
        cgt_scene_release(scene);
        for (uint32_t i = 0; i < job->pixels; i++)
            found->probe[axis][i] = found->hit[i].t;
    }
    if (result == CGT_OK)
        result = hard_commit(context, &job->subject.scene, NULL, &scene);
    if (result == CGT_OK) {
        result = trace_mode(job, m, scene, precision, found->hit);
        cgt_scene_release(scene);
    }
    return result;
}

/* ---- the table ---- */

typedef struct differences {
    double direction_ulp;       /* to the first mode, largest */
    double direction_truth_ulp; /* to the truth */
    double direction_truth;     /* the same as a difference, as the thesis gives it */
    uint64_t hits, values;      /* pixels with another primitive; with other bits */
    double t_ulp, t_truth_ulp;  /* largest, where the primitive is the same */
    hard_tally tally;
} differences;

static void compare_directions(const modes_job *job, differences *d)
{
    for (int axis = 0; axis < 3; axis++)
        for (uint32_t i = 0; i < job->pixels; i++) {
            const float t = job->found.probe[axis][i];
            if (!isfinite(t)) /* the probe is not that large */
                continue;
            const long double exact = fabsl(job->direction[i][axis]);
            d->direction_ulp = fmax(d->direction_ulp, ulp_distance(t, job->first.probe[axis][i]));
            d->direction_truth = fmax(d->direction_truth, fabs((double)(1 / (long double)t - exact)));
            d->direction_truth_ulp = fmax(d->direction_truth_ulp, oracle_ulp((truth_real)(1 / exact), t));
        }
}

static differences compare(const modes_job *job)
{
    differences d = {.tally = hard_judge_all(&job->subject.scene, &job->subject.truth, job->found.hit)};
    compare_directions(job, &d);
    for (uint32_t i = 0; i < job->pixels; i++) {
        const full_hit *a = &job->first.hit[i], *b = &job->found.hit[i];
        oracle_hit exact;
        const bool same = a->geometry == b->geometry && a->primitive == b->primitive;
        d.hits += !same;
        d.values += memcmp(a, b, sizeof *a) != 0;
        if (same && a->geometry != CGT_INVALID_ID)
            d.t_ulp = fmax(d.t_ulp, ulp_distance(a->t, b->t));
        if (hard_judge(&job->subject.scene, &job->subject.truth, i, b, &exact) == ORACLE_RIGHT &&
            exact.index != ORACLE_NONE)
            d.t_truth_ulp = fmax(d.t_truth_ulp, oracle_ulp(exact.t, b->t));
    }
    return d;
}

static void write_row(const modes_job *job, const char *variant, const mode *m, cgt_precision precision)
{
    const differences d = compare(job);
    bench_table *const table = job->accuracy->table;
    char config[BENCH_NAME_SIZE];
    snprintf(config, sizeof config, "%s,variant=%s,precision=%s", m->name, variant, bench_precision_name(precision));
    bench_table_text(table, "config", config);
    bench_table_count(table, "rays", job->pixels);
    bench_table_real(table, "direction_ulp_worst", d.direction_ulp);
    bench_table_real(table, "direction_truth_ulp_worst", d.direction_truth_ulp);
    bench_table_real(table, "direction_truth_worst", d.direction_truth);
    bench_table_count(table, "other_hits", d.hits);
    bench_table_count(table, "other_bits", d.values);
    bench_table_real(table, "t_ulp_worst", d.t_ulp);
    bench_table_real(table, "t_truth_ulp_worst", d.t_truth_ulp);
    bench_table_count(table, "missed", d.tally.missed);
    bench_table_count(table, "invented", d.tally.invented);
    bench_table_count(table, "wrong", d.tally.wrong);
    bench_table_end_row(table);
}

static int run_mode(modes_job *job, const char *variant, const mode *m, cgt_precision precision, bool first)
{
    cgt_context *context = NULL;
    cgt_result result = bench_context_create(m->threads, variant, &context);
    if (result == CGT_OK)
        result = find(job, m, context, precision, &job->found);
    if (result != CGT_OK)
        bench_scene_failed(context, "modes", result);
    cgt_context_release(context);
    if (result != CGT_OK)
        return PROGRAM_FAILED;
    if (first)
        job->first = job->found;
    write_row(job, variant, m, precision);
    return PROGRAM_OK;
}

int accuracy_modes(const accuracy_job *accuracy)
{
    static const cgt_precision precisions[] = {CGT_PRECISION_ROBUST, CGT_PRECISION_FAST};
    modes_job *job = calloc(1, sizeof *job);
    if (!job) {
        program_error("modes: out of memory");
        return PROGRAM_FAILED;
    }
    job->accuracy = accuracy;
    job->edge = accuracy->rays < FEW_RAYS ? SMALL_EDGE : EDGE;
    job->pixels = job->edge * job->edge;
    for (int axis = 0; axis < 3; axis++)
        job->probe[axis].place.scale = 1;
    bench_table_section(accuracy->table, "modes");
    int code = make_picture(job);
    for (size_t p = 0; p < 2 && code == PROGRAM_OK; p++)
        for (size_t v = 0; v < accuracy->variants && code == PROGRAM_OK; v++)
            for (size_t m = 0; m < MODES && code == PROGRAM_OK; m++)
                code = run_mode(job, accuracy->variant[v], &modes[m], precisions[p], p + v + m == 0);
    for (int axis = 0; axis < 3; axis++)
        hard_scene_free(&job->probe[axis]);
    accuracy_subject_free(&job->subject);
    free(job);
    return code;
}
