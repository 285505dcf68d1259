/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench structures: the command line, and one file after another. */
#include "structures/bench_structures.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEFAULT_RANDOM 200000u

enum { OPTION_ALL = 0x400, OPTION_FETCH, OPTION_RANDOM };

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Rays and rows:", 4},
    {"light", 'l', "X,Y,Z", 0, "trace a shadow ray from every hit to this point", 4},
    {"ao", 'a', "RAYS", 0, "trace RAYS ambient-occlusion rays from every hit, at most 1024", 4},
    {"random", OPTION_RANDOM, "RAYS", 0, "trace RAYS random rays through the scene's bounds (default 200000)", 4},
    {"all", OPTION_ALL, NULL, 0, "one row for each builder and layout of kd-trees", 4},
    {"fetch", OPTION_FETCH, NULL, 0,
     "time nothing; count the transfers of a kd-tree's nodes into small memories, by layout", 4},
    {"json", 'j', "FILE", 0, "write the rows as JSON, too", 4},
    {NULL, 0, NULL, 0, NULL, 0}};

/* What the options contradict. */
static void check(const structures_settings *settings, struct argp_state *state)
{
    const bench_kd_choice *kd = &settings->structure.kd;
    if (settings->all && (kd->builder != CGT_KD_BUILDER_AUTO || kd->layout != CGT_KD_LAYOUT_AUTO))
        argp_error(state, "--all goes through builders and layouts itself: leave out --kd-builder and --kd-layout");
    if (settings->fetch && settings->structure.count)
        argp_error(state, "--fetch is about kd-trees: leave out --structure");
    if (settings->fetch && (kd->layout != CGT_KD_LAYOUT_AUTO || kd->traversal != CGT_KD_TRAVERSAL_AUTO))
        argp_error(state, "--fetch goes through the layouts itself, one ray at a time: leave out --kd-layout and "
                          "--kd-traversal");
}

static error_t add_file(structures_settings *settings, struct argp_state *state, const char *path)
{
    if (settings->files == STRUCTURES_MOST_FILES)
        argp_error(state, "more than %d files: %s", STRUCTURES_MOST_FILES, path);
    else
        settings->paths[settings->files++] = path;
    settings->shared.path = NULL;
    return ARGP_ERR_UNKNOWN; /* the shared options want their one FILE: each in turn */
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    structures_settings *settings = state->input;
    char error[PROGRAM_ERROR_SIZE] = "";
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &settings->shared;
        state->child_inputs[1] = &settings->structure;
        return 0;
    case 'l':
        if (program_parse_floats(argument, 3, settings->light, error, sizeof error))
            argp_error(state, "-l: %s", error);
        settings->lit = 1;
        return 0;
    case 'a':
        if (program_parse_u32(argument, 0, BENCH_MOST_AO_RAYS, &settings->ao, error, sizeof error))
            argp_error(state, "-a: %s", error);
        return 0;
    case OPTION_RANDOM:
        if (program_parse_u32(argument, 0, STRUCTURES_MOST_RAYS, &settings->random, error, sizeof error))
            argp_error(state, "--random: %s", error);
        return 0;
    case OPTION_ALL: settings->all = 1; return 0;
    case OPTION_FETCH: settings->fetch = 1; return 0;
    case 'j': settings->json_path = argument; return 0;
    case ARGP_KEY_ARG: return add_file(settings, state, argument);
    case ARGP_KEY_END: check(settings, state); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- One file ------------------------------------------------------------------------------------------------ */

int structures_open(structures_job *job, const structures_settings *settings, const char *path)
{
    const bench_settings *shared = &settings->shared;
    char error[PROGRAM_ERROR_SIZE] = "";
    memset(job, 0, sizeof *job);
    job->settings = settings;
    job->path = path;
    bench_file_name(path, job->scene_name);
    if (bench_input_load(&job->input, path, shared->frames, shared->radius, shared->wrapped, error, sizeof error)) {
        program_error("%s", error);
        return PROGRAM_FAILED;
    }
    cgt_result result = bench_context_create(shared->threads, shared->variant, &job->context);
    if (result == CGT_OK)
        result = bench_scene_create(&job->scene, job->context, job->input.moving, shared->resolution);
    if (result != CGT_OK)
        return bench_scene_failed(job->context, path, result);
    bench_scene_set_triangles(&job->scene, job->input.index, job->input.triangles);
    job->variant = cgt_context_get_variant(job->context);
    bench_camera_axes_init(&job->axes, &shared->camera, shared->width, shared->height);
    job->threads = bench_threads_create(cgt_context_get_threads(job->context));
    int complete = job->threads && !structures_results_create(&job->expected, shared->width, shared->height) &&
                   !structures_results_create(&job->found, shared->width, shared->height);
    complete =
        complete && (job->maker = bench_rays_create(job->threads, &job->axes, &job->expected.planes, settings->ao));
    if (!complete || shared->repeat > SIZE_MAX / sizeof(double) / job->input.frames) {
        program_error("%s: out of memory or threads", path);
        return PROGRAM_FAILED;
    }
    return PROGRAM_OK;
}

void structures_close(structures_job *job)
{
    structures_plan_release(job);
    bench_rays_release(job->maker);
    structures_rays_release(&job->shadow);
    structures_rays_release(&job->ao);
    structures_rays_release(&job->random);
    structures_results_release(&job->expected);
    structures_results_release(&job->found);
    bench_threads_release(job->threads);
    bench_scene_release(&job->scene);
    cgt_context_release(job->context);
    bench_input_release(&job->input);
}

/* Other hits are a failure, but leave the table whole: *different is set. */
static int compare_structures(structures_job *job, accuracy_report *report, int *different)
{
    int code = structures_plan(job);
    if (code == PROGRAM_OK)
        code = structures_measure(job);
    if (code == PROGRAM_OK)
        code = structures_table_rows(job, report);
    if (!job->different)
        return code;
    *different = 1;
    program_error("%s: %llu of %llu traces found other hits than the first of their frame", job->path,
                  (unsigned long long)job->different, (unsigned long long)job->compared);
    return code;
}

static int run(const structures_settings *settings)
{
    structures_job *job = malloc(sizeof *job);
    accuracy_report *report = job ? accuracy_report_open(settings->json_path) : NULL;
    int code = report ? PROGRAM_OK : PROGRAM_FAILED, different = 0;
    if (!job)
        program_error("out of memory");
    for (size_t i = 0; code == PROGRAM_OK && i < settings->files; i++) {
        code = structures_open(job, settings, settings->paths[i]);
        if (code == PROGRAM_OK && i == 0)
            settings->fetch ? structures_fetch_begin(report) : structures_table_begin(report);
        if (code == PROGRAM_OK)
            code = settings->fetch ? structures_fetch_rows(job, report) : compare_structures(job, report, &different);
        structures_close(job);
    }
    if (report && accuracy_report_close(report))
        code = PROGRAM_FAILED;
    free(job);
    return different ? PROGRAM_FAILED : code;
}

int bench_structures(int argc, char **argv)
{
    static const struct argp_child children[] = {
        {&bench_settings_argp, 0, NULL, 0}, {&bench_structure_argp, 0, NULL, 0}, {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "FILE...",
        .children = children,
        .doc = "Compares grids and kd-trees, and the ways to traverse them, on the same frames and rays. FILE is a "
               "trajectory of spheres or triangles: .frames, .lammpstrj, .xyz, or a mesh. One row of medians over the "
               "frames for each; the rows take turns frame by frame. -S names the structures, and may be given "
               "several times. Fails where any row finds another hit than the first, in any bit."
               "\vColumns ending in _per_ray count what a ray meets in traversal: inner nodes, leaves, tests of "
               "primitives. In packets a node counts once for all rays of the packet."};
    structures_settings settings;
    memset(&settings, 0, sizeof settings);
    bench_settings_init(&settings.shared);
    settings.structure.most = sizeof settings.structure.asked / sizeof settings.structure.asked[0];
    settings.random = DEFAULT_RANDOM;
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    return run(&settings);
}
