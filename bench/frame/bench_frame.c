/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench frame: for each frame of a trajectory, moves the spheres or vertices, then measures commit, primary rays,
 * and on request shadow and ambient-occlusion rays. One row of medians per configuration. The first frame warms up. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench.h"
#include "common/bench_frame_row.h"
#include "common/bench_input.h"
#include "rays/bench_output.h"
#include "rays/bench_planes.h"
#include "rays/bench_rays.h"
#include "rays/bench_shade.h"
#include "common/bench_scene.h"
#include "common/bench_timing.h"

enum { OPTION_ALL = 0x200, OPTION_LOOP, OPTION_TILE, OPTION_CULL, OPTION_NO_MAILBOX, OPTION_NEAREST, OPTION_SHADE };

typedef struct frame_settings {
    bench_settings shared;
    bench_structure_settings structure;
    bench_precision_settings precision;
    bench_secondary_settings secondary;
    int nearest;
    int shade;
    int orthographic;
    const char *output;
    int all;
    bench_choice choice; /* loop, tile, cull and mailbox */
} frame_settings;

typedef struct frame_job {
    const frame_settings *settings;
    bench_input input;
    cgt_context *context;
    bench_threads *threads;
    bench_camera_axes axes;
    bench_planes planes;
    bench_picture picture; /* with --shade */
    bench_rays *rays;
    double *ms[BENCH_FRAME_TIMES]; /* one value per measured frame */
    bench_output output;
    bench_table *table;
} frame_job;

/* ---- Command line -------------------------------------------------------------------------------------------- */

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Rays and rows:", 4},
    {"nearest", OPTION_NEAREST, NULL, 0, "ambient-occlusion rays search for the nearest hit instead of any hit", 4},
    {"orthographic", 'O', NULL, 0, "parallel rays; the picture is as high as the camera's view at its target", 4},
    {"output", 'o', "HITS", 0, "write the hits of the last frame: per pixel float32 t and uint32 primitive", 4},
    {"shade", OPTION_SHADE, NULL, 0, "a visitor shades a picture of 8 bits a channel; no planes are stored", 4},
    {"all", OPTION_ALL, NULL, 0, "one row for each packet size and tile shape", 4},
    {"loop", OPTION_LOOP, "NAME", 0, "nested or flattened", 4},
    {"tile", OPTION_TILE, "NAME", 0, "square or strip", 4},
    {"cull", OPTION_CULL, "NAME", 0, "off, frustum or blocks", 4},
    {"no-mailbox", OPTION_NO_MAILBOX, NULL, 0, "do not remember which primitives a packet was tested against", 4},
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    frame_settings *settings = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &settings->shared;
        state->child_inputs[1] = &settings->structure;
        state->child_inputs[2] = &settings->precision;
        state->child_inputs[3] = &settings->secondary;
        return 0;
    case OPTION_NEAREST: settings->nearest = 1; return 0;
    case OPTION_SHADE: settings->shade = 1; return 0;
    case 'O': settings->orthographic = 1; return 0;
    case 'o': settings->output = argument; return 0;
    case OPTION_ALL: settings->all = 1; return 0;
    case OPTION_LOOP:
        if (bench_loop_find(argument, &settings->choice.loop))
            argp_error(state, "--loop: nested or flattened, not %s", argument);
        return 0;
    case OPTION_TILE:
        if (bench_tile_find(argument, &settings->choice.tile))
            argp_error(state, "--tile: square or strip, not %s", argument);
        return 0;
    case OPTION_CULL:
        if (bench_cull_find(argument, &settings->choice.cull))
            argp_error(state, "--cull: off, frustum or blocks, not %s", argument);
        return 0;
    case OPTION_NO_MAILBOX: settings->choice.mailbox = CGT_MAILBOX_OFF; return 0;
    case ARGP_KEY_END:
        if (settings->orthographic && (settings->secondary.lit || settings->secondary.ao))
            argp_error(state, "-O: only primary rays can be parallel: leave out -l and -a");
        if (settings->shade && (settings->secondary.lit || settings->secondary.ao))
            argp_error(state, "--shade stores no planes, from which secondary rays would start: leave out -l and -a");
        if (settings->all && (settings->shared.packet || settings->choice.tile != CGT_TILE_SHAPE_AUTO))
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

/* The options of a row's traces. Arrays of rays have no packets to choose: apart from precision and kd-traversal
 * theirs are the library's choice. */
typedef struct row_options {
    cgt_trace_options primary, secondary;
    cgt_research_trace_options research[2]; /* number of values */
} row_options;

static void make_options(const bench_choice *choice, row_options *made)
{
    const bench_choice array = {.precision = choice->precision, .test = choice->test, .kd = choice->kd};
    bench_choice_options(choice, NULL, &made->primary, &made->research[0]);
    bench_choice_options(&array, NULL, &made->secondary, &made->research[1]);
}

/* What is measured: planes, or a shaded picture. */
static void make_frame(frame_job *job, cgt_frame *frame)
{
    if (!job->picture.rgba) {
        bench_planes_frame(&job->planes, frame);
        return;
    }
    cgt_frame_init(frame, job->picture.width, job->picture.height);
    frame->visitor = bench_shade_tile;
    frame->visitor_user = &job->picture;
    frame->visitor_fields = CGT_FIELD_PRIMITIVE | CGT_FIELD_NORMAL;
}

/* One frame: ms gets the row's times. */
static cgt_result measure_frame(frame_job *job, bench_scene *scene, uint32_t count, const row_options *trace,
                                double ms[BENCH_FRAME_TIMES], uint64_t *open)
{
    const frame_settings *settings = job->settings;
    cgt_frame frame;
    uint64_t hidden = 0;
    make_frame(job, &frame);
    ms[BENCH_SHADOW] = ms[BENCH_AO] = 0.0;

    double start = bench_now_ms();
    cgt_result result = bench_scene_commit(scene, count);
    ms[BENCH_BUILD] = bench_now_ms() - start;
    if (result == CGT_OK) {
        start = bench_now_ms();
        result = cgt_trace_camera(scene->scene, &settings->shared.camera, &frame, &trace->primary);
        ms[BENCH_PRIMARY] = bench_now_ms() - start;
    }
    if (result == CGT_OK && settings->secondary.lit) {
        start = bench_now_ms();
        result = bench_rays_shadow(job->rays, scene->scene, &trace->secondary, settings->secondary.light, &hidden);
        ms[BENCH_SHADOW] = bench_now_ms() - start;
    }
    bench_rays_nearest(job->rays, settings->nearest);
    if (result == CGT_OK && settings->secondary.ao) {
        start = bench_now_ms();
        result = bench_rays_ao(job->rays, scene->scene, &trace->secondary, settings->secondary.ao, open);
        ms[BENCH_AO] = bench_now_ms() - start;
    }
    ms[BENCH_FRAME] = ms[BENCH_BUILD] + ms[BENCH_PRIMARY] + ms[BENCH_SHADOW] + ms[BENCH_AO];
    return result;
}

/* All frames, `repeat` times. measured gets the number of values in job->ms. */
static cgt_result measure_frames(frame_job *job, bench_scene *scene, const row_options *trace, size_t *measured,
                                 uint64_t *open)
{
    const size_t frames = job->input.frames;
    const uint32_t repeat = job->settings->shared.repeat;
    *measured = 0;
    for (uint32_t round = 0; round < repeat; round++)
        for (size_t i = 0; i < frames; i++) {
            double ms[BENCH_FRAME_TIMES] = {0.0};
            const uint32_t count = bench_input_move(&job->input, i);
            const cgt_result result = measure_frame(job, scene, count, trace, ms, open);
            if (result != CGT_OK)
                return result;
            if (round == 0 && i == 0 && (frames > 1 || repeat > 1))
                continue;
            for (int column = 0; column < BENCH_FRAME_TIMES; column++)
                job->ms[column][*measured] = ms[column];
            ++*measured;
        }
    return CGT_OK;
}

/* Reports on standard error what the library chose in the last frame, from a separate run. */
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

static int run_row(frame_job *job, const bench_choice *choice)
{
    const bench_settings *shared = &job->settings->shared;
    bench_scene scene;
    cgt_scene_statistics built;
    row_options trace;
    char name[BENCH_NAME_SIZE];
    size_t measured = 0;
    uint64_t open = 0;

    cgt_result result = bench_scene_create(&scene, job->context, job->input.moving, shared->resolution);
    if (result == CGT_OK)
        result = bench_scene_structure(&scene, job->settings->structure.requested[0], CGT_RAY_KIND_COHERENT,
                                       &choice->kd, shared->resolution);
    if (result == CGT_OK) {
        bench_scene_set_triangles(&scene, job->input.index, job->input.triangles);
        make_options(choice, &trace);
        result = measure_frames(job, &scene, &trace, &measured, &open);
    }
    if (result == CGT_OK && job->picture.rgba) { /* the hits of the last frame, not timed */
        cgt_frame frame;
        bench_planes_frame(&job->planes, &frame);
        result = cgt_trace_camera(scene.scene, &shared->camera, &frame, &trace.primary);
    }
    if (result == CGT_OK)
        result = cgt_scene_get_statistics(scene.scene, &built);
    if (result == CGT_OK) {
        bench_choice_name(choice, built.structure, name);
        if (job->picture.rgba)
            strncat(name, ",shade", sizeof name - strlen(name) - 1);
        bench_frame_row(job->table, name, cgt_context_get_threads(job->context), job->ms, measured, &job->planes, open);
        if (shared->verbose)
            result = describe(job, &scene, choice);
    }
    const int code = result == CGT_OK ? PROGRAM_OK : bench_scene_failed(job->context, shared->paths[0], result);
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
    bench_choice choice = bench_choice_of(&settings->shared, &settings->structure, &settings->precision);
    choice.loop = settings->choice.loop;
    choice.tile = settings->choice.tile;
    choice.cull = settings->choice.cull;
    choice.mailbox = settings->choice.mailbox;
    if (cells[0]) {
        snprintf(grid, sizeof grid, "%ux%ux%u", (unsigned)cells[0], (unsigned)cells[1], (unsigned)cells[2]);
        choice.grid = grid;
    }

    bench_table_section(job->table, "frame");
    int code = run_row(job, &choice);
    for (size_t i = 0; settings->all && code == PROGRAM_OK && i < sizeof shapes / sizeof shapes[0]; i++) {
        choice.packet = shapes[i].packet;
        choice.tile = shapes[i].tile;
        code = run_row(job, &choice);
    }
    return code;
}

/* Everything that may fail before the first measurement. */
static int prepare(frame_job *job)
{
    const frame_settings *settings = job->settings;
    const bench_settings *shared = &settings->shared;
    const cgt_result result = bench_context_create(shared->threads, shared->variant, &job->context);
    if (result != CGT_OK)
        return bench_scene_failed(NULL, shared->variant ? shared->variant : "context", result);
    if (bench_input_load_file(&job->input, shared, shared->paths[0]))
        return PROGRAM_FAILED;
    if (bench_output_begin(&job->output, settings->output))
        return PROGRAM_FAILED;
    bench_camera_axes_init(&job->axes, &shared->camera, shared->width, shared->height);
    job->threads = bench_threads_create(cgt_context_get_threads(job->context));
    int complete = job->threads && !bench_planes_create(&job->planes, shared->width, shared->height);
    complete =
        complete && (job->rays = bench_rays_create(job->threads, &job->axes, &job->planes, settings->secondary.ao));
    complete = complete && (!settings->shade || !bench_picture_create(&job->picture, shared->width, shared->height));
    if (shared->repeat > SIZE_MAX / job->input.frames)
        complete = 0;
    for (int column = 0; complete && column < BENCH_FRAME_TIMES; column++)
        complete = (job->ms[column] = calloc(job->input.frames * shared->repeat, sizeof(double))) != NULL;
    if (!complete) {
        program_error("out of memory or threads");
        return PROGRAM_FAILED;
    }
    return PROGRAM_OK;
}

int bench_frame(int argc, char **argv)
{
    static const struct argp_child children[] = {{&bench_settings_argp, 0, NULL, 0},
                                                 {&bench_structure_argp, 0, NULL, 0},
                                                 {&bench_precision_argp, 0, NULL, 0},
                                                 {&bench_secondary_argp, 0, NULL, 0},
                                                 {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "FILE",
        .children = children,
        .doc = "Measures frames as a renderer spends them. FILE is a trajectory of spheres or triangles: .frames, "
               ".lammpstrj, .xyz, or a mesh. In every frame they move, and the scene is committed and traced. Prints a "
               "row of medians over the frames in milliseconds. The first frame warms up and does not count."};
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
    job.table = bench_table_open(settings.shared.json_path);
    int code = job.table ? prepare(&job) : PROGRAM_FAILED;
    if (code == PROGRAM_OK)
        code = run_rows(&job);
    if (bench_output_end(&job.output, code == PROGRAM_OK ? &job.planes : NULL))
        code = PROGRAM_FAILED;
    if (bench_table_close(job.table))
        code = PROGRAM_FAILED;
    for (int column = 0; column < BENCH_FRAME_TIMES; column++)
        free(job.ms[column]);
    bench_rays_release(job.rays);
    bench_planes_release(&job.planes);
    bench_picture_release(&job.picture);
    bench_threads_release(job.threads);
    bench_input_release(&job.input);
    cgt_context_release(job.context);
    return code;
}
