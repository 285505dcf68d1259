/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench light: a row for each scene, light and order of points, of the first frame of each file. */
#include "light/bench_light.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_table.h"

enum { OPTION_LIGHT = 0x900, OPTION_POINTS, OPTION_NO_EMBREE, DEFAULT_ROUNDS = 3 };

typedef struct light_settings {
    bench_settings shared;
    int place[LIGHT_PLACES], order[LIGHT_ORDERS]; /* 1: requested; none: all */
    int no_embree;
} light_settings;

typedef struct light_job {
    const light_settings *settings;
    bench_table *table;
    cgt_context *context;
    bench_threads *threads;
    light_scene scene;
    embree_scenes *embree; /* NULL: it is not measured */
    char name[BENCH_NAME_SIZE];
} light_job;

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Rows:", 4},
    {"light", OPTION_LIGHT, "NAMES", 0,
     "outside, near, inside, edge, hole, surface, +x, -x, +y, -y, +z, -z, slanted or row; a list with commas", 4},
    {"points", OPTION_POINTS, "NAMES", 0, "tiles, skipping, frame, shuffled, scattered or sorted; a list with commas",
     4},
    {"no-embree", OPTION_NO_EMBREE, NULL, 0, "measure the library alone", 4},
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    light_settings *settings = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &settings->shared; return 0;
    case OPTION_LIGHT:
        bench_choose(state, "--light", argument, light_place_names, LIGHT_PLACES, settings->place);
        return 0;
    case OPTION_POINTS:
        bench_choose(state, "--points", argument, light_order_names, LIGHT_ORDERS, settings->order);
        return 0;
    case OPTION_NO_EMBREE: settings->no_embree = 1; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- scenes ---- */

static void find_bounds(light_scene *s)
{
    const uint32_t width = s->input.index ? 3 : 4;
    for (int a = 0; a < 3; a++) {
        s->low[a] = INFINITY;
        s->high[a] = -INFINITY;
        for (uint32_t i = 0; i < s->count; i++) {
            const float x = s->input.moving[(size_t)i * width + (size_t)a];
            s->low[a] = x < s->low[a] ? x : s->low[a];
            s->high[a] = x > s->high[a] ? x : s->high[a];
        }
    }
}

/* Traces the camera's frame, whose hits are the points. */
static cgt_result look(light_job *job)
{
    const light_scene *s = &job->scene;
    bench_scene library = {0};
    cgt_frame frame;
    light_scene_frame(s, &frame);
    cgt_result result = light_scene_library(s, job->context, &library);
    if (result == CGT_OK)
        result = bench_scene_commit(&library, s->count);
    if (result == CGT_OK)
        result = cgt_trace_camera(library.scene, &s->camera, &frame, NULL);
    bench_scene_release(&library);
    return result;
}

static int open_scene(light_job *job, const char *path)
{
    const bench_settings *shared = &job->settings->shared;
    light_scene *s = &job->scene;
    int failed = 0;
    memset(s, 0, sizeof *s);
    bench_file_name(path, job->name);
    if (bench_input_load_file(&s->input, shared, path))
        return PROGRAM_FAILED;
    s->count = bench_input_move(&s->input, 0);
    s->camera = shared->camera;
    find_bounds(s);
    bench_camera_axes_init(&s->axes, &s->camera, shared->width, shared->height);
    s->geometry = calloc((size_t)shared->width * shared->height, sizeof *s->geometry);
    if (!s->geometry || bench_planes_create(&s->planes, shared->width, shared->height)) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    const cgt_result result = look(job);
    if (result != CGT_OK)
        return bench_scene_failed(job->context, path, result);
    if (!job->settings->no_embree)
        job->embree = embree_scenes_create(&s->input, job->threads, shared->repeat, &failed);
    if (failed)
        program_error("Embree: no device or no memory");
    return failed ? PROGRAM_FAILED : PROGRAM_OK;
}

static void close_scene(light_job *job)
{
    embree_scenes_release(job->embree);
    job->embree = NULL;
    bench_planes_release(&job->scene.planes);
    free(job->scene.geometry);
    bench_input_release(&job->scene.input);
}

/* ---- rows ---- */

static void add_row(const light_job *job, const light_place *place, const light_points *points,
                    const light_result *library, const light_result *embree)
{
    bench_table *t = job->table;
    const int is_here = job->embree != NULL;
    bench_table_text(t, "scene", job->name);
    bench_table_text(t, "light", place->name);
    bench_table_text(t, "points", light_order_names[points->order]);
    bench_table_count(t, "rays", points->count * place->count);
    bench_table_count(t, "occluded", library->occluded);
    bench_table_real(t, "ms", library->ms);
    bench_table_real(t, "references", library->references);
    bench_table_real(t, "tests", library->tests);
    bench_table_real(t, "tree", library->tree_share);
    bench_table_real(t, "embree_ms", is_here ? embree->ms : NAN);
    bench_table_real(t, "embree_build_ms", is_here ? embree->build_ms : NAN);
    bench_table_text(t, "embree_way", is_here ? embree->way : "-");
    bench_table_count(t, "embree_occluded", embree->occluded);
    bench_table_real(t, "ratio", is_here ? embree->ms / library->ms : NAN);
    bench_table_real(t, "commit_ms", library->build_ms);
    bench_table_real(t, "ratio_builds",
                     is_here ? (embree->ms + embree->build_ms) / (library->ms + library->build_ms) : NAN);
    bench_table_end_row(t);
}

static int run_row(light_job *job, const light_place *place, const light_points *points)
{
    const uint32_t rounds = job->settings->shared.repeat;
    light_result library, embree = {.way = ""};
    const cgt_result result = light_measure_library(job->context, &job->scene, place, points, rounds, &library);
    if (result != CGT_OK)
        return bench_scene_failed(job->context, job->name, result);
    if (job->embree && light_measure_embree(job->embree, place, points, rounds, &embree)) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    add_row(job, place, points, &library, &embree);
    return PROGRAM_OK;
}

static int run_scene(light_job *job)
{
    int code = PROGRAM_OK;
    for (int order = 0; order < LIGHT_ORDERS && code == PROGRAM_OK; order++) {
        light_points points;
        if (!bench_is_chosen(job->settings->order, LIGHT_ORDERS, order))
            continue;
        if (light_points_make(&job->scene, (light_order)order, &points)) {
            program_error("out of memory");
            return PROGRAM_FAILED;
        }
        for (int which = 0; which < LIGHT_PLACES && code == PROGRAM_OK; which++) {
            light_place place;
            if (!bench_is_chosen(job->settings->place, LIGHT_PLACES, which))
                continue;
            light_place_make(&job->scene, which, &place);
            code = run_row(job, &place, &points);
        }
        light_points_release(&points);
    }
    return code;
}

static int run_files(light_job *job)
{
    const bench_settings *shared = &job->settings->shared;
    const cgt_result result = bench_context_create(shared->threads, shared->variant, &job->context);
    int code = PROGRAM_OK;
    if (result != CGT_OK)
        return bench_scene_failed(NULL, shared->variant ? shared->variant : "context", result);
    job->threads = bench_threads_create(cgt_context_get_threads(job->context));
    if (!job->threads) {
        program_error("out of memory or threads");
        return PROGRAM_FAILED;
    }
    bench_table_section(job->table, "light");
    for (size_t i = 0; i < shared->files && code == PROGRAM_OK; i++) {
        code = open_scene(job, shared->paths[i]);
        if (code == PROGRAM_OK)
            code = run_scene(job);
        close_scene(job);
    }
    return code;
}

int bench_light(int argc, char **argv)
{
    static const struct argp_child children[] = {{&bench_settings_argp, 0, NULL, 0}, {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "FILE...",
        .children = children,
        .doc = "Measures shadow rays of the first frame of each FILE to lights outside, near and inside of the scene, "
               "and from all sides, for points in several orders, beside Embree's fastest way to trace the same rays. "
               "Each time the scene is committed before: what the library builds for a light is in its time. Embree's "
               "build is shown apart. The camera is that of the scenes of cgt-bench make."};
    light_settings settings;
    light_job job;
    memset(&settings, 0, sizeof settings);
    bench_settings_init(&settings.shared);
    bench_settings_use_procedural_camera(&settings.shared);
    settings.shared.most_files = BENCH_MOST_FILES;
    settings.shared.repeat = DEFAULT_ROUNDS;
    settings.shared.frames = 1;
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    memset(&job, 0, sizeof job);
    job.settings = &settings;
    job.table = bench_table_open(settings.shared.json_path);
    int code = job.table ? run_files(&job) : PROGRAM_FAILED;
    if (bench_table_close(job.table))
        code = PROGRAM_FAILED;
    bench_threads_release(job.threads);
    cgt_context_release(job.context);
    return code;
}
