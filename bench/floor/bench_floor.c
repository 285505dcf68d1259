/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench floor: the command line, and the parts in their order. */
#include "floor/bench_floor.h"

#include <stdio.h>

#include "common/bench_input.h"
#include "make/bench_procedural.h"

enum { OPTION_MEGABYTES = 0x600, OPTION_SPHERES, OPTION_TRIANGLES };
enum { DEFAULT_FRAMES = 3, DEFAULT_ROUNDS = 9, MOST_PRIMITIVES = 100000000 };

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "What is measured:", 4},
    {"megabytes", OPTION_MEGABYTES, "COUNT", 0, "memory to read and write, 1 to 65536 (default 256)", 4},
    {"spheres", OPTION_SPHERES, "COUNT", 0, "of the cloud made in memory; 0: none (default 20000)", 4},
    {"triangles", OPTION_TRIANGLES, "COUNT", 0, "of the balls made in memory; 0: none (default 20000)", 4},
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    floor_settings *settings = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &settings->shared;
        state->child_inputs[1] = &settings->structure;
        state->child_inputs[2] = &settings->precision;
        return 0;
    case OPTION_MEGABYTES: bench_parse_u32(state, "--megabytes", argument, 1, 65536, &settings->megabytes); return 0;
    case OPTION_SPHERES:
        bench_parse_u32(state, "--spheres", argument, 0, MOST_PRIMITIVES, &settings->spheres);
        return 0;
    case OPTION_TRIANGLES:
        bench_parse_u32(state, "--triangles", argument, 0, MOST_PRIMITIVES, &settings->triangles);
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- Table --------------------------------------------------------------------------------------------------- */

void floor_row(floor_job *job, const char *part, const char *scene, const char *item, uint32_t threads, double value,
               const char *unit)
{
    bench_table_text(job->table, "config", job->config);
    bench_table_text(job->table, "part", part);
    bench_table_text(job->table, "scene", scene);
    bench_table_text(job->table, "item", item);
    bench_table_count(job->table, "threads", threads);
    bench_table_real(job->table, "value", value);
    bench_table_text(job->table, "unit", unit);
    bench_table_end_row(job->table);
}

/* ---- Parts --------------------------------------------------------------------------------------------------- */

cgt_result floor_open_scene(floor_job *job, bench_scene *scene, cgt_context *context, const float *moving,
                            const uint32_t *index, uint32_t triangles)
{
    const floor_settings *settings = job->settings;
    cgt_result result = bench_scene_create(scene, context, moving, settings->shared.resolution);
    if (result == CGT_OK)
        result = bench_scene_structure(scene, settings->structure.requested[0], CGT_RAY_KIND_COHERENT, &job->choice.kd,
                                       settings->shared.resolution);
    bench_scene_set_triangles(scene, index, triangles);
    return result;
}

static int prepare(floor_job *job)
{
    const floor_settings *settings = job->settings;
    const bench_settings *shared = &settings->shared;
    if (bench_input_check_files(shared))
        return PROGRAM_FAILED;
    job->choice = bench_choice_of(shared, &settings->structure, &settings->precision);
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
    for (size_t i = 0; code == PROGRAM_OK && i < settings->shared.files; i++)
        code = floor_measure_file(job, settings->shared.paths[i]);
    if (code == PROGRAM_OK && !settings->shared.files && settings->spheres)
        code = floor_measure_cloud(job);
    if (code == PROGRAM_OK && !settings->shared.files && settings->triangles)
        code = floor_measure_mesh(job);
    return code;
}

static int run(const floor_settings *settings)
{
    floor_job job = {.settings = settings, .config = "-", .table = bench_table_open(settings->shared.json_path)};
    if (!job.table)
        return PROGRAM_FAILED;
    bench_table_section(job.table, "floor");
    int code = prepare(&job);
    if (code == PROGRAM_OK)
        code = measure(&job);
    bench_planes_release(&job.planes);
    bench_threads_release(job.threads);
    cgt_context_release(job.context);
    if (bench_table_close(job.table))
        code = PROGRAM_FAILED;
    return code;
}

int bench_floor(int argc, char **argv)
{
    static const struct argp_child children[] = {{&bench_settings_argp, 0, NULL, 0},
                                                 {&bench_structure_argp, 0, NULL, 0},
                                                 {&bench_precision_argp, 0, NULL, 0},
                                                 {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "[FILE...]",
        .children = children,
        .doc =
            "Measures what a frame cannot do without on this machine: bandwidth of memory, the empty frame by what it "
            "is requested, tests whose data lie in the first cache; and for each FILE, or for scenes made in memory, "
            "how far its frame is from the sum of these, term by term. -r is the number of rounds (default 9); the "
            "shortest times are printed, and medians."};
    floor_settings settings = {.megabytes = 256, .spheres = 20000, .triangles = 20000};
    bench_settings_init(&settings.shared);
    bench_settings_use_procedural_camera(&settings.shared);
    settings.shared.least_files = 0;
    settings.shared.most_files = BENCH_MOST_FILES;
    settings.shared.frames = DEFAULT_FRAMES;
    settings.shared.repeat = DEFAULT_ROUNDS;
    settings.structure.most = 1;
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    return run(&settings);
}
