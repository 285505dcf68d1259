/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench floor: the command line, and the parts in their order. */
#include "floor/bench_floor.h"

#include <stdio.h>

#include "make/bench_procedural.h"

enum { OPTION_MEGABYTES = 0x600, OPTION_SPHERES, OPTION_TRIANGLES };
enum { DEFAULT_FRAMES = 3, DEFAULT_ROUNDS = 9, MOST_PRIMITIVES = 100000000 };

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "What is measured:", 4},
    {"megabytes", OPTION_MEGABYTES, "COUNT", 0, "memory to read and write, 1 to 65536 (default 256)", 4},
    {"spheres", OPTION_SPHERES, "COUNT", 0, "of the cloud made in memory; 0: none (default 20000)", 4},
    {"triangles", OPTION_TRIANGLES, "COUNT", 0, "of the balls made in memory; 0: none (default 20000)", 4},
    {"precision", 'p', "NAME", 0, "robust (the library's default), fast or exact", 4},
    {"json", 'j', "FILE", 0, "write the rows as JSON, too", 4},
    {NULL, 0, NULL, 0, NULL, 0}};

static void parse_count(struct argp_state *state, const char *option, const char *text, uint32_t least, uint32_t most,
                        uint32_t *count)
{
    char error[PROGRAM_ERROR_SIZE] = "";
    if (program_parse_u32(text, least, most, count, error, sizeof error))
        argp_error(state, "%s: %s", option, error);
}

static error_t add_file(floor_settings *settings, struct argp_state *state, const char *path)
{
    if (settings->files == FLOOR_MOST_FILES)
        argp_error(state, "more than %d files: %s", FLOOR_MOST_FILES, path);
    else
        settings->paths[settings->files++] = path;
    return 0;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    floor_settings *settings = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &settings->shared;
        state->child_inputs[1] = &settings->structure;
        return 0;
    case OPTION_MEGABYTES: parse_count(state, "--megabytes", argument, 1, 65536, &settings->megabytes); return 0;
    case OPTION_SPHERES: parse_count(state, "--spheres", argument, 0, MOST_PRIMITIVES, &settings->spheres); return 0;
    case OPTION_TRIANGLES:
        parse_count(state, "--triangles", argument, 0, MOST_PRIMITIVES, &settings->triangles);
        return 0;
    case 'p':
        if (bench_precision_find(argument, &settings->precision))
            argp_error(state, "-p: robust, fast or exact, not %s", argument);
        settings->precision_given = 1;
        return 0;
    case 'j': settings->json_path = argument; return 0;
    case ARGP_KEY_ARG: return add_file(settings, state, argument);
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- Table --------------------------------------------------------------------------------------------------- */

static void begin_table(accuracy_report *report)
{
    static const char *const columns[] = {"config", "part", "scene", "item", "threads", "value", "unit", NULL};
    accuracy_report_table(report, "floor", columns);
}

void floor_row(floor_job *job, const char *part, const char *scene, const char *item, uint32_t threads, double value,
               const char *unit)
{
    accuracy_report_text(job->report, job->config);
    accuracy_report_text(job->report, part);
    accuracy_report_text(job->report, scene);
    accuracy_report_text(job->report, item);
    accuracy_report_count(job->report, threads);
    accuracy_report_real(job->report, value);
    accuracy_report_text(job->report, unit);
}

/* ---- Parts --------------------------------------------------------------------------------------------------- */

cgt_result floor_open_scene(floor_job *job, bench_scene *scene, cgt_context *context, const float *moving,
                            const uint32_t *index, uint32_t triangles)
{
    const floor_settings *settings = job->settings;
    cgt_result result = bench_scene_create(scene, context, moving, settings->shared.resolution);
    if (result == CGT_OK)
        result = bench_scene_structure(scene, settings->structure.asked[0], CGT_RAY_KIND_COHERENT, &job->choice.kd,
                                       settings->shared.resolution);
    bench_scene_set_triangles(scene, index, triangles);
    return result;
}

static int prepare(floor_job *job)
{
    const floor_settings *settings = job->settings;
    const bench_settings *shared = &settings->shared;
    job->choice = (bench_choice){.variant = shared->variant,
                                 .packet = shared->packet,
                                 .precision = settings->precision,
                                 .precision_named = settings->precision_given,
                                 .kd = settings->structure.kd};
    const cgt_result result = bench_context_create(shared->threads, shared->variant, &job->context);
    if (result != CGT_OK)
        return bench_scene_failed(NULL, shared->variant ? shared->variant : "context", result);
    job->threads = bench_threads_create(cgt_context_get_threads(job->context));
    if (job->threads && !bench_planes_create_with_uv(&job->planes, shared->width, shared->height))
        return PROGRAM_OK;
    program_error("out of memory or threads");
    return PROGRAM_FAILED;
}

static int measure(floor_job *job)
{
    const floor_settings *settings = job->settings;
    int code = floor_measure_memory(job);
    if (code == PROGRAM_OK)
        code = floor_measure_empty(job);
    if (code == PROGRAM_OK)
        code = floor_measure_tests(job);
    for (size_t i = 0; code == PROGRAM_OK && i < settings->files; i++)
        code = floor_measure_file(job, settings->paths[i]);
    if (code == PROGRAM_OK && !settings->files && settings->spheres)
        code = floor_measure_cloud(job);
    if (code == PROGRAM_OK && !settings->files && settings->triangles)
        code = floor_measure_mesh(job);
    return code;
}

static int run(const floor_settings *settings)
{
    floor_job job = {.settings = settings, .config = "-", .report = accuracy_report_open(settings->json_path)};
    if (!job.report)
        return PROGRAM_FAILED;
    begin_table(job.report);
    int code = prepare(&job);
    if (code == PROGRAM_OK)
        code = measure(&job);
    bench_planes_release(&job.planes);
    bench_threads_release(job.threads);
    cgt_context_release(job.context);
    if (accuracy_report_close(job.report))
        code = PROGRAM_FAILED;
    return code;
}

int bench_floor(int argc, char **argv)
{
    static const struct argp_child children[] = {
        {&bench_settings_argp, 0, NULL, 0}, {&bench_structure_argp, 0, NULL, 0}, {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "[FILE...]",
        .children = children,
        .doc =
            "Measures what a frame cannot do without on this machine: bandwidth of memory, the empty frame by what it "
            "is asked for, tests whose data lie in the first cache; and for each FILE, or for scenes made in memory, "
            "how far its frame is from the sum of these, term by term. -r is the number of rounds (default 9); the "
            "shortest times are printed, medians beside them."};
    char error[PROGRAM_ERROR_SIZE] = "";
    floor_settings settings = {.megabytes = 256, .spheres = 20000, .triangles = 20000};
    bench_settings_init(&settings.shared);
    settings.shared.file_optional = 1;
    settings.shared.frames = DEFAULT_FRAMES;
    settings.shared.repeat = DEFAULT_ROUNDS;
    settings.structure.most = 1;
    if (program_parse_camera(BENCH_PROCEDURAL_CAMERA, &settings.shared.camera, error, sizeof error)) {
        program_error("%s", error);
        return PROGRAM_FAILED;
    }
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    return run(&settings);
}
