/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The limit of a scene's last frame, term by term, and how far the measured frame is from it; see bench_floor.h. The
 * unavoidable tests and primitives are counted: the visible primitives make a scene of their own, and the library's
 * statistics give the work of its frame. That frame is timed as well: it is the time of a frame that knows in advance
 * which primitives are visible. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "floor/bench_floor.h"
#include "common/bench_input.h"
#include "make/bench_procedural.h"
#include "common/bench_timing.h"

/* A scene in memory, as it is in one frame. */
typedef struct limit_scene {
    const char *name;
    const float *moving; /* where the elements are now; moved by `move` */
    const uint32_t *index;
    uint32_t triangles; /* 0: spheres */
    uint32_t frames;
    uint32_t (*move)(void *user, uint32_t frame); /* returns the number of elements */
    void *user;
} limit_scene;

typedef struct limit_counts {
    uint64_t primitives, seen, hits, lanes, drawn;
    double bytes;
} limit_counts;

static uint32_t width_of(const limit_scene *s) { return s->index ? 3 : 4; }

/* ---- The whole scene ----------------------------------------------------------------------------------------- */

/* Commits and traces all frames, `repeat` times; the shortest times. count: of the last frame. */
static cgt_result time_frames(floor_job *job, bench_scene *scene, const limit_scene *s, double low[3], uint32_t *count)
{
    const bench_settings *shared = &job->settings->shared;
    cgt_trace_options trace;
    cgt_research_trace_options research;
    cgt_frame frame;
    bench_choice_options(&job->choice, NULL, &trace, &research);
    bench_planes_frame(&job->planes, &frame);
    for (uint32_t round = 0; round < shared->repeat + 1; round++) /* the first one warms up */
        for (uint32_t i = 0; i < s->frames; i++) {
            *count = s->move(s->user, i);
            const double begin = bench_now_ms();
            cgt_result result = bench_scene_commit(scene, *count);
            const double built = bench_now_ms();
            if (result == CGT_OK)
                result = cgt_trace_camera(scene->scene, &shared->camera, &frame, &trace);
            const double end = bench_now_ms();
            if (result != CGT_OK)
                return result;
            const double ms[3] = {built - begin, end - built, end - begin};
            for (int k = 0; round && k < 3; k++)
                low[k] = (round == 1 && i == 0) || ms[k] < low[k] ? ms[k] : low[k];
        }
    return CGT_OK;
}

/* ---- What is seen -------------------------------------------------------------------------------------------- */

typedef struct seen_part {
    float *moving;   /* spheres, or NULL: the vertices stay as they are */
    uint32_t *index; /* triangles */
    uint32_t count;
} seen_part;

/* Marks the primitives that are visible in the frame; returns their number. */
static uint32_t mark_seen(const bench_planes *planes, uint8_t *seen, uint32_t primitives)
{
    const size_t pixels = (size_t)planes->width * planes->height;
    uint32_t count = 0;
    for (size_t i = 0; i < pixels; i++)
        if (planes->primitive[i] < primitives && !seen[planes->primitive[i]]) {
            seen[planes->primitive[i]] = 1;
            count++;
        }
    return count;
}

/* Copies the visible primitives. Returns 0, or -1 where memory is refused. */
static int take_seen(const limit_scene *s, const bench_planes *planes, uint32_t primitives, seen_part *part)
{
    uint8_t *seen = calloc((size_t)primitives + 1, 1);
    if (!seen)
        return -1;
    part->count = mark_seen(planes, seen, primitives);
    if (s->index)
        part->index = calloc((size_t)part->count + 1, 3 * sizeof *part->index);
    else
        part->moving = calloc((size_t)part->count + 1, 4 * sizeof *part->moving);
    uint32_t at = 0;
    for (uint32_t i = 0; (part->index || part->moving) && i < primitives; i++) {
        if (!seen[i])
            continue;
        if (s->index)
            memcpy(part->index + 3 * (size_t)at++, s->index + 3 * (size_t)i, 3 * sizeof *part->index);
        else
            memcpy(part->moving + 4 * (size_t)at++, s->moving + 4 * (size_t)i, 4 * sizeof *part->moving);
    }
    free(seen);
    return part->index || part->moving ? 0 : -1;
}

/* Traces the scene of the visible primitives: counts, and the shortest time. */
static cgt_result trace_seen(floor_job *job, const limit_scene *s, const seen_part *part, uint32_t elements,
                             limit_counts *counts, double *low)
{
    const bench_settings *shared = &job->settings->shared;
    bench_counts counted;
    cgt_trace_options trace;
    cgt_research_trace_options research;
    bench_scene scene;
    cgt_frame frame;
    memset(&counted, 0, sizeof counted);
    bench_choice_options(&job->choice, &counted, &trace, &research);
    bench_planes_frame(&job->planes, &frame);
    cgt_result result = floor_open_scene(job, &scene, job->context, part->moving ? part->moving : s->moving,
                                         part->index, part->index ? part->count : 0);
    if (result == CGT_OK)
        result = bench_scene_commit(&scene, s->index ? elements : part->count);
    if (result == CGT_OK)
        result = cgt_trace_camera(scene.scene, &shared->camera, &frame, &trace);
    counts->lanes = counted.trace.ray_tests;
    counts->drawn = counted.trace.packet_tests;
    counts->hits = counted.trace.hits;
    trace.statistics = NULL;
    research.statistics = NULL;
    for (uint32_t round = 0; round < shared->repeat && result == CGT_OK; round++) {
        const double begin = bench_now_ms();
        result = cgt_trace_camera(scene.scene, &shared->camera, &frame, &trace);
        const double ms = bench_now_ms() - begin;
        *low = round == 0 || ms < *low ? ms : *low;
    }
    bench_scene_release(&scene);
    return result;
}

/* ---- Terms --------------------------------------------------------------------------------------------------- */

/* A measured cost may be negative where noise exceeds it. */
static double positive(double value) { return value > 0.0 ? value : 0.0; }

static void print_terms(floor_job *job, const limit_scene *s, const limit_counts *counts, double scatter_ns,
                        const double low[3], double seen_ms)
{
    const floor_tests *tests = &job->tests[s->index ? 1 : 0];
    const uint32_t threads = cgt_context_get_threads(job->context);
    const struct {
        const char *name;
        double ms;
    } terms[] = {{"limit:empty", job->empty_ms[FLOOR_T_ID_NORMAL]},
                 {"limit:read", 1e-6 * counts->bytes / job->read},
                 {"limit:scatter", 1e-6 * scatter_ns * (double)counts->primitives},
                 {"limit:tests", 1e-6 * positive(tests->lane) * (double)counts->lanes / threads},
                 {"limit:objects", 1e-6 * positive(tests->primitive) * (double)counts->drawn / threads}};
    const double resolve = 1e-6 * positive(tests->resolve) * (double)counts->hits / threads;
    const struct {
        const char *name;
        uint64_t count;
    } rows[] = {{"objects", counts->primitives},
                {"objects seen", counts->seen},
                {"pixels hit", counts->hits},
                {"ray tests of what is seen", counts->lanes},
                {"drawn of what is seen", counts->drawn}};
    double sum = 0.0;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        floor_row(job, "limit", s->name, rows[i].name, threads, (double)rows[i].count, "count");
    for (size_t i = 0; i < sizeof terms / sizeof terms[0]; i++) {
        floor_row(job, "limit", s->name, terms[i].name, threads, terms[i].ms, "ms");
        sum += terms[i].ms;
    }
    floor_row(job, "limit", s->name, "limit", threads, sum, "ms");
    floor_row(job, "limit", s->name, "resolve", threads, resolve, "ms");
    floor_row(job, "limit", s->name, "measured:build", threads, low[0], "ms");
    floor_row(job, "limit", s->name, "measured:primary", threads, low[1], "ms");
    floor_row(job, "limit", s->name, "measured:frame", threads, low[2], "ms");
    floor_row(job, "limit", s->name, "measured:primary of what is seen", threads, seen_ms, "ms");
    floor_row(job, "limit", s->name, "measured over limit", threads, low[2] / sum, "ratio");
    floor_row(job, "limit", s->name, "measured over limit and resolve", threads, low[2] / (sum + resolve), "ratio");
}

/* The planes hold the last frame. */
static int measure_limit(floor_job *job, const limit_scene *s, uint32_t elements, const double low[3])
{
    limit_counts counts = {.primitives = s->index ? s->triangles : elements};
    seen_part part = {.count = 0};
    double seen_ms = 0.0;
    int code = PROGRAM_OK;
    counts.bytes = (double)elements * width_of(s) * sizeof(float) + (double)s->triangles * 3 * sizeof *s->index;
    const double scatter =
        floor_measure_scatter(job, s->moving, width_of(s), s->index ? elements : (uint32_t)counts.primitives);
    if (scatter < 0.0 || take_seen(s, &job->planes, (uint32_t)counts.primitives, &part)) {
        program_error("%s: out of memory", s->name);
        code = PROGRAM_FAILED;
    } else {
        counts.seen = part.count;
        const cgt_result result = trace_seen(job, s, &part, elements, &counts, &seen_ms);
        if (result == CGT_OK)
            print_terms(job, s, &counts, scatter, low, seen_ms);
        else
            code = bench_scene_failed(job->context, s->name, result);
    }
    free(part.moving);
    free(part.index);
    return code;
}

static int measure_scene(floor_job *job, const limit_scene *s)
{
    bench_scene scene;
    cgt_scene_statistics built;
    double low[3] = {0.0};
    uint32_t elements = 0;
    int code = PROGRAM_FAILED;
    cgt_result result = floor_open_scene(job, &scene, job->context, s->moving, s->index, s->triangles);
    if (result == CGT_OK)
        result = time_frames(job, &scene, s, low, &elements);
    if (result == CGT_OK)
        result = cgt_scene_get_statistics(scene.scene, &built);
    if (result == CGT_OK) {
        bench_choice_name(&job->choice, built.structure, job->config);
        code = measure_limit(job, s, elements, low);
        if (code == PROGRAM_OK)
            code = floor_measure_fields(job, &scene, "fields", s->name, NULL);
    } else {
        bench_scene_failed(job->context, s->name, result);
    }
    bench_scene_release(&scene);
    return code;
}

/* ---- Scenes -------------------------------------------------------------------------------------------------- */

static uint32_t move_input(void *user, uint32_t frame) { return bench_input_move(user, frame); }

static uint32_t move_procedural(void *user, uint32_t frame)
{
    bench_procedural *moving = user;
    bench_procedural_move(moving, frame);
    return moving->count;
}

int floor_measure_file(floor_job *job, const char *path)
{
    const bench_settings *shared = &job->settings->shared;
    char error[PROGRAM_ERROR_SIZE] = "";
    bench_input input;
    if (bench_input_load(&input, path, shared->frames, shared->radius, shared->wrapped, error, sizeof error)) {
        program_error("%s", error);
        return PROGRAM_FAILED;
    }
    char name[BENCH_NAME_SIZE];
    bench_file_name(path, name);
    const limit_scene scene = {.name = name,
                               .moving = input.moving,
                               .index = input.index,
                               .triangles = input.triangles,
                               .frames = (uint32_t)(input.frames < UINT32_MAX ? input.frames : UINT32_MAX),
                               .move = move_input,
                               .user = &input};
    const int code = measure_scene(job, &scene);
    bench_input_release(&input);
    return code;
}

static int measure_procedural(floor_job *job, bench_procedural *moving, const char *name)
{
    const uint64_t frames = job->settings->shared.frames;
    const limit_scene scene = {.name = name,
                               .moving = moving->now,
                               .index = moving->index,
                               .triangles = moving->triangles,
                               .frames = (uint32_t)(frames < UINT32_MAX ? frames : UINT32_MAX),
                               .move = move_procedural,
                               .user = moving};
    return measure_scene(job, &scene);
}

int floor_measure_cloud(floor_job *job)
{
    bench_procedural moving;
    int code = PROGRAM_FAILED;
    if (bench_procedural_cloud(&moving, job->settings->spheres, 0))
        program_error("out of memory for %u spheres", (unsigned)job->settings->spheres);
    else
        code = measure_procedural(job, &moving, "spheres");
    bench_procedural_release(&moving);
    return code;
}

int floor_measure_mesh(floor_job *job)
{
    bench_procedural moving;
    int code = PROGRAM_FAILED;
    if (bench_procedural_mesh(&moving, job->settings->triangles))
        program_error("out of memory for %u triangles", (unsigned)job->settings->triangles);
    else
        code = measure_procedural(job, &moving, "triangles");
    bench_procedural_release(&moving);
    return code;
}
