/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench frame: for each frame of a trajectory, moves the spheres or vertices, then measures commit, primary rays,
 * and on request shadow and ambient-occlusion rays. One row of medians per configuration. The first frame warms up. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench.h"
#include "common/bench_input.h"
#include "common/bench_planes.h"
#include "frame/bench_frame_rays.h"
#include "common/bench_scene.h"
#include "common/bench_timing.h"

enum { OPTION_ALL = 0x200, OPTION_LOOP, OPTION_TILE, OPTION_CULL, OPTION_NO_MAILBOX, OPTION_TEST, OPTION_NEAREST };
enum { BUILD, PRIMARY, SHADOW, AO, FRAME, COLUMNS };

typedef struct frame_settings {
    bench_settings shared;
    bench_structure_settings structure;
    int orthographic;
    int lit;
    float light[3];
    uint32_t ao;
    int nearest;
    const char *output;
    int all;
    cgt_loop loop;
    cgt_tile_shape tile;
    cgt_cull cull;
    cgt_mailbox mailbox;
    cgt_precision precision;
    int precision_given;
    cgt_triangle_test test;
} frame_settings;

typedef struct frame_job {
    const frame_settings *settings;
    bench_input input;
    cgt_context *context;
    bench_threads *threads;
    bench_camera_axes axes;
    bench_planes planes;
    bench_rays *rays;
    double *ms[COLUMNS]; /* one value per measured frame */
    FILE *output;
} frame_job;

/* ---- Command line -------------------------------------------------------------------------------------------- */

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Rays and rows:", 4},
    {"light", 'l', "X,Y,Z", 0, "trace a shadow ray from every hit to this point", 4},
    {"ao", 'a', "RAYS", 0, "trace RAYS ambient-occlusion rays from every hit, at most 1024", 4},
    {"nearest", OPTION_NEAREST, NULL, 0, "ambient-occlusion rays ask for their nearest hits, not for any", 4},
    {"orthographic", 'O', NULL, 0, "parallel rays, as high a picture as the camera sees at its target", 4},
    {"output", 'o', "HITS", 0, "write the hits of the last frame: per pixel float32 t and uint32 primitive", 4},
    {"all", OPTION_ALL, NULL, 0, "one row for each packet size and tile shape", 4},
    {"loop", OPTION_LOOP, "NAME", 0, "nested or flattened", 4},
    {"tile", OPTION_TILE, "NAME", 0, "square or strip", 4},
    {"cull", OPTION_CULL, "NAME", 0, "off, frustum or blocks", 4},
    {"no-mailbox", OPTION_NO_MAILBOX, NULL, 0, "do not remember what a packet has met", 4},
    {"precision", 'p', "NAME", 0, "robust (the library's default), fast or exact; of all rays", 4},
    {"test", OPTION_TEST, "NAME", 0, "of triangles with -p fast: watertight, moller-trumbore or accelerated", 4},
    {NULL, 0, NULL, 0, NULL, 0}};

/* Index of a name in a list, counted from 1; ends the program where there is none. */
static int name_index(struct argp_state *state, const char *option, const char *name, const char *first,
                      const char *second)
{
    if (!strcmp(name, first))
        return 1;
    if (strcmp(name, second) != 0)
        argp_error(state, "%s: %s or %s, not %s", option, first, second, name);
    return 2;
}

static cgt_cull cull_by_name(struct argp_state *state, const char *name)
{
    for (int cull = CGT_CULL_NONE; cull <= CGT_CULL_BLOCKS; cull++)
        if (!strcmp(name, bench_cull_name((cgt_cull)cull)))
            return (cgt_cull)cull;
    argp_error(state, "--cull: off, frustum or blocks, not %s", name);
    return CGT_CULL_BLOCKS;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    frame_settings *settings = state->input;
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
    case OPTION_NEAREST: settings->nearest = 1; return 0;
    case 'O': settings->orthographic = 1; return 0;
    case 'o': settings->output = argument; return 0;
    case OPTION_ALL: settings->all = 1; return 0;
    case OPTION_LOOP:
        settings->loop =
            name_index(state, "--loop", argument, "nested", "flattened") == 1 ? CGT_LOOP_NESTED : CGT_LOOP_FLATTENED;
        return 0;
    case OPTION_TILE:
        settings->tile = name_index(state, "--tile", argument, "square", "strip") == 1 ? CGT_TILE_SHAPE_SQUARE
                                                                                       : CGT_TILE_SHAPE_STRIP;
        return 0;
    case OPTION_CULL: settings->cull = cull_by_name(state, argument); return 0;
    case OPTION_NO_MAILBOX: settings->mailbox = CGT_MAILBOX_OFF; return 0;
    case 'p':
        if (bench_precision_find(argument, &settings->precision))
            argp_error(state, "-p: robust, fast or exact, not %s", argument);
        settings->precision_given = 1;
        return 0;
    case OPTION_TEST:
        if (bench_triangle_test_find(argument, &settings->test))
            argp_error(state, "--test: watertight, moller-trumbore or accelerated, not %s", argument);
        return 0;
    case ARGP_KEY_END:
        if (settings->orthographic && (settings->lit || settings->ao))
            argp_error(state, "-O: of primary rays alone: leave out -l and -a");
        if (settings->test != CGT_TRIANGLE_TEST_WATERTIGHT && settings->precision != CGT_PRECISION_FAST)
            argp_error(state, "--test %s: only with -p fast", bench_triangle_test_name(settings->test));
        if (settings->all && (settings->shared.packet || settings->tile != CGT_TILE_SHAPE_AUTO))
            argp_error(state, "--all goes through packets and tiles itself: leave out -k and --tile");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static void make_orthographic(cgt_camera *c)
{
    double square = 0.0;
    for (int a = 0; a < 3; a++)
        square += ((double)c->target[a] - c->eye[a]) * ((double)c->target[a] - c->eye[a]);
    c->projection = CGT_PROJECTION_ORTHOGRAPHIC;
    c->height = (float)(2.0 * sqrt(square) * tan(c->fov * 3.14159265358979323846 / 360.0));
}

/* ---- One row ------------------------------------------------------------------------------------------------- */

/* One frame: ms gets the row's columns. */
static cgt_result measure_frame(frame_job *job, bench_scene *scene, uint32_t count, const cgt_trace_options *trace,
                                double ms[COLUMNS], uint64_t *open)
{
    const frame_settings *settings = job->settings;
    cgt_frame frame;
    const cgt_research_trace_options research = {.kd_traversal = trace->research->kd_traversal,
                                                 .triangle_test = trace->research->triangle_test};
    cgt_trace_options secondary;
    uint64_t hidden = 0;
    cgt_trace_options_init(&secondary); /* arrays of rays have no packets to choose; the rest is the library's choice */
    secondary.precision = trace->precision;
    secondary.research = &research;
    bench_planes_frame(&job->planes, &frame);
    ms[SHADOW] = ms[AO] = 0.0;

    double start = bench_now_ms();
    cgt_result result = bench_scene_commit(scene, count);
    ms[BUILD] = bench_now_ms() - start;
    if (result == CGT_OK) {
        start = bench_now_ms();
        result = cgt_trace_camera(scene->scene, &settings->shared.camera, &frame, trace);
        ms[PRIMARY] = bench_now_ms() - start;
    }
    if (result == CGT_OK && settings->lit) {
        start = bench_now_ms();
        result = bench_rays_shadow(job->rays, scene->scene, &secondary, settings->light, &hidden);
        ms[SHADOW] = bench_now_ms() - start;
    }
    bench_rays_nearest(job->rays, settings->nearest);
    if (result == CGT_OK && settings->ao) {
        start = bench_now_ms();
        result = bench_rays_ao(job->rays, scene->scene, &secondary, settings->ao, open);
        ms[AO] = bench_now_ms() - start;
    }
    ms[FRAME] = ms[BUILD] + ms[PRIMARY] + ms[SHADOW] + ms[AO];
    return result;
}

/* All frames, `repeat` times. measured gets the number of values in job->ms. */
static cgt_result measure_frames(frame_job *job, bench_scene *scene, const cgt_trace_options *trace, size_t *measured,
                                 uint64_t *open)
{
    const size_t frames = job->input.frames;
    const uint32_t repeat = job->settings->shared.repeat;
    *measured = 0;
    for (uint32_t round = 0; round < repeat; round++)
        for (size_t i = 0; i < frames; i++) {
            double ms[COLUMNS] = {0.0};
            const uint32_t count = bench_input_move(&job->input, i);
            const cgt_result result = measure_frame(job, scene, count, trace, ms, open);
            if (result != CGT_OK)
                return result;
            if (round == 0 && i == 0 && (frames > 1 || repeat > 1))
                continue;
            for (int column = 0; column < COLUMNS; column++)
                job->ms[column][*measured] = ms[column];
            ++*measured;
        }
    return CGT_OK;
}

/* On standard error: what the library chose in the last frame, from a run of its own. */
static cgt_result describe(frame_job *job, const bench_scene *scene, const bench_choice *choice)
{
    cgt_scene_statistics built;
    cgt_research_scene_statistics research;
    bench_counts traced;
    cgt_trace_options trace;
    cgt_research_trace_options research_trace;
    cgt_frame frame;
    memset(&traced, 0, sizeof traced);
    bench_planes_frame(&job->planes, &frame);
    bench_choice_options(choice, &traced, &trace, &research_trace);
    cgt_result result = cgt_scene_get_statistics(scene->scene, &built);
    if (result == CGT_OK)
        result = cgt_research_get_scene_statistics(scene->scene, &research);
    if (result == CGT_OK)
        result = cgt_trace_camera(scene->scene, &job->settings->shared.camera, &frame, &trace);
    if (result != CGT_OK)
        return result;
    fprintf(stderr,
            "variant %s, structure %s (%s), grid %ux%ux%u, kd-tree of %u nodes in %u levels, packet %u, tile %s, "
            "loop %s, %u primitives, %u skipped, %zu bytes, %.2f ray tests per ray\n",
            cgt_context_get_variant(job->context), bench_structure_name(built.structure), built.reason,
            (unsigned)research.resolution[0], (unsigned)research.resolution[1], (unsigned)research.resolution[2],
            (unsigned)research.kd_nodes, (unsigned)research.kd_depth, (unsigned)traced.research.packet_size,
            bench_tile_name(traced.research.tile), bench_loop_name(traced.research.loop), (unsigned)built.primitives,
            (unsigned)(built.skipped_not_finite + built.skipped_radius + built.skipped_degenerate), built.bytes,
            (double)traced.trace.ray_tests / (double)(traced.trace.rays ? traced.trace.rays : 1));
    return CGT_OK;
}

static void print_row(frame_job *job, const bench_choice *choice, cgt_structure structure, size_t measured,
                      uint64_t open)
{
    char name[BENCH_NAME_SIZE];
    bench_choice_name(choice, structure, name);
    printf("%s\t%u", name, (unsigned)cgt_context_get_threads(job->context));
    for (int column = 0; column < COLUMNS; column++)
        printf("\t%.3f", bench_median(job->ms[column], measured));
    printf("\t%llu\t%llu\n", (unsigned long long)bench_planes_hits(&job->planes), (unsigned long long)open);
    fflush(stdout);
}

static int run_row(frame_job *job, const bench_choice *choice)
{
    const bench_settings *shared = &job->settings->shared;
    bench_scene scene;
    cgt_scene_statistics built;
    cgt_trace_options trace;
    cgt_research_trace_options research;
    size_t measured = 0;
    uint64_t open = 0;

    cgt_result result = bench_scene_create(&scene, job->context, job->input.moving, shared->resolution);
    if (result == CGT_OK)
        result = bench_scene_structure(&scene, job->settings->structure.asked[0], CGT_RAY_KIND_COHERENT, &choice->kd,
                                       shared->resolution);
    if (result == CGT_OK) {
        bench_scene_set_triangles(&scene, job->input.index, job->input.triangles);
        bench_choice_options(choice, NULL, &trace, &research);
        result = measure_frames(job, &scene, &trace, &measured, &open);
    }
    if (result == CGT_OK)
        result = cgt_scene_get_statistics(scene.scene, &built);
    if (result == CGT_OK) {
        print_row(job, choice, built.structure, measured, open);
        if (shared->verbose)
            result = describe(job, &scene, choice);
    }
    const int code = result == CGT_OK ? PROGRAM_OK : bench_scene_failed(job->context, shared->path, result);
    bench_scene_release(&scene);
    return code;
}

/* ---- The whole table ----------------------------------------------------------------------------------------- */

static int run_rows(frame_job *job)
{
    static const struct {
        uint32_t packet;
        cgt_tile_shape tile;
    } shapes[] = {
        {4, CGT_TILE_SHAPE_SQUARE}, {8, CGT_TILE_SHAPE_SQUARE}, {16, CGT_TILE_SHAPE_SQUARE}, {4, CGT_TILE_SHAPE_STRIP}};
    const frame_settings *settings = job->settings;
    const uint32_t *cells = settings->shared.resolution;
    char grid[48] = "";
    bench_choice choice = {.variant = settings->shared.variant,
                           .packet = settings->shared.packet,
                           .tile = settings->tile,
                           .loop = settings->loop,
                           .cull = settings->cull,
                           .mailbox = settings->mailbox,
                           .precision = settings->precision,
                           .precision_named = settings->precision_given,
                           .test = settings->test,
                           .kd = settings->structure.kd};
    if (cells[0]) {
        snprintf(grid, sizeof grid, "%ux%ux%u", (unsigned)cells[0], (unsigned)cells[1], (unsigned)cells[2]);
        choice.grid = grid;
    }

    printf("config\tthreads\tbuild_ms\tprimary_ms\tshadow_ms\tao_ms\tframe_ms\thit_pixels\tao_open\n");
    int code = run_row(job, &choice);
    for (size_t i = 0; settings->all && code == PROGRAM_OK && i < sizeof shapes / sizeof shapes[0]; i++) {
        choice.packet = shapes[i].packet;
        choice.tile = shapes[i].tile;
        code = run_row(job, &choice);
    }
    return code;
}

static int write_output(frame_job *job)
{
    FILE *file = job->output;
    job->output = NULL;
    const int failed = bench_planes_write(&job->planes, file);
    const int reason = errno;
    if (fclose(file) || failed) {
        program_error("%s: %s", job->settings->output, strerror(failed ? reason : errno));
        return PROGRAM_FAILED;
    }
    return PROGRAM_OK;
}

/* Everything that may fail before the first measurement. */
static int prepare(frame_job *job)
{
    const frame_settings *settings = job->settings;
    const bench_settings *shared = &settings->shared;
    char error[PROGRAM_ERROR_SIZE] = "";

    const cgt_result result = bench_context_create(shared->threads, shared->variant, &job->context);
    if (result != CGT_OK)
        return bench_scene_failed(NULL, shared->variant ? shared->variant : "context", result);
    if (bench_input_load(&job->input, shared->path, shared->frames, shared->radius, shared->wrapped, error,
                         sizeof error)) {
        program_error("%s", error);
        return PROGRAM_FAILED;
    }
    if (settings->output && !(job->output = fopen(settings->output, "wb"))) {
        program_error("%s: %s", settings->output, strerror(errno));
        return PROGRAM_FAILED;
    }
    bench_camera_axes_init(&job->axes, &shared->camera, shared->width, shared->height);
    job->threads = bench_threads_create(cgt_context_get_threads(job->context));
    int complete = job->threads && !bench_planes_create(&job->planes, shared->width, shared->height);
    complete = complete && (job->rays = bench_rays_create(job->threads, &job->axes, &job->planes, settings->ao));
    if (shared->repeat > SIZE_MAX / job->input.frames)
        complete = 0;
    for (int column = 0; complete && column < COLUMNS; column++)
        complete = (job->ms[column] = calloc(job->input.frames * shared->repeat, sizeof(double))) != NULL;
    if (!complete) {
        program_error("out of memory or threads");
        return PROGRAM_FAILED;
    }
    return PROGRAM_OK;
}

int bench_frame(int argc, char **argv)
{
    static const struct argp_child children[] = {
        {&bench_settings_argp, 0, NULL, 0}, {&bench_structure_argp, 0, NULL, 0}, {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "FILE",
        .children = children,
        .doc = "Measures a frame as a renderer would spend it. FILE is a trajectory of spheres or triangles: .frames, "
               ".lammpstrj, .xyz, or a mesh. Every frame they move, the scene is committed and traced. Prints a row of "
               "medians over the "
               "frames in milliseconds; the first frame warms up and does not count."};
    frame_settings settings;
    frame_job job;

    memset(&settings, 0, sizeof settings);
    bench_settings_init(&settings.shared);
    settings.structure.most = 1;
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;

    if (settings.orthographic)
        make_orthographic(&settings.shared.camera);
    memset(&job, 0, sizeof job);
    job.settings = &settings;
    int code = prepare(&job);
    if (code == PROGRAM_OK)
        code = run_rows(&job);
    if (code == PROGRAM_OK && job.output)
        code = write_output(&job);

    if (job.output)
        fclose(job.output);
    for (int column = 0; column < COLUMNS; column++)
        free(job.ms[column]);
    bench_rays_release(job.rays);
    bench_planes_release(&job.planes);
    bench_threads_release(job.threads);
    bench_input_release(&job.input);
    cgt_context_release(job.context);
    return code;
}
