/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench rays: the command line, one set of rays after another, and the rows. */
#include "rays/bench_rays.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "make/bench_procedural.h"
#include "common/bench_timing.h"

enum { DEFAULT_RAYS = 131072, DEFAULT_ROUNDS = 3, MOST_RAYS = 100000000 };

static const char *const kinds[SWEEP_KINDS] = {"camera", "shadow", "ao", "bounce", "random"};
static const char *const orders[SWEEP_ORDERS] = {"camera", "tile", "shuffled"};
static const char *const queries[SWEEP_QUERIES] = {"nearest", "any"};

/* What a kind is traced for where no query is asked for. */
static const int usual[SWEEP_KINDS][SWEEP_QUERIES] = {[SWEEP_CAMERA] = {[SWEEP_NEAREST] = 1},
                                                      [SWEEP_SHADOW] = {[SWEEP_ANY] = 1},
                                                      [SWEEP_AO] = {[SWEEP_ANY] = 1},
                                                      [SWEEP_BOUNCE] = {[SWEEP_NEAREST] = 1},
                                                      [SWEEP_RANDOM] = {[SWEEP_NEAREST] = 1, [SWEEP_ANY] = 1}};

/* ---- Command line -------------------------------------------------------------------------------------------- */

enum { OPTION_JSON = 'j', OPTION_RAYS = 'n' };

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Rays, all of these lists with commas between, or given several times:", 4},
    {"kinds", 'K', "NAMES", 0, "camera, shadow, ao, bounce, random (default: all)", 4},
    {"orders", 'O', "NAMES", 0, "camera, tile, shuffled (default: all)", 4},
    {"queries", 'Q', "NAMES", 0,
     "nearest, any (default: nearest of camera and bounce, any of shadow and ao, both of random)", 4},
    {"batches", 'B', "COUNTS", 0, "rays in a call; all: the whole set (default: 1,16,64,...,65536,all)", 4},
    {NULL, 0, NULL, 0, "How many, and where:", 5},
    {"rays", OPTION_RAYS, "COUNT", 0, "rays of a set at most, those of the picture's middle (default 131072)", 5},
    {"ao", 'a', "RAYS", 0, "ambient-occlusion rays from every hit, at most 1024 (default 1)", 5},
    {"light", 'l', "X,Y,Z", 0, "where shadow rays go (default 3,4,-5)", 5},
    {"json", OPTION_JSON, "FILE", 0, "write the rows as JSON, too", 5},
    {NULL, 0, NULL, 0, NULL, 0}};

static void add_batch(sweep_settings *settings, struct argp_state *state, uint64_t batch)
{
    size_t at = 0;
    while (at < settings->batches && settings->batch[at] < batch)
        at++;
    if (at < settings->batches && settings->batch[at] == batch)
        return;
    if (settings->batches == SWEEP_MOST_BATCHES)
        argp_error(state, "-B: more than %d counts", SWEEP_MOST_BATCHES);
    memmove(&settings->batch[at + 1], &settings->batch[at], (settings->batches++ - at) * sizeof settings->batch[0]);
    settings->batch[at] = batch;
}

static void add_batches(sweep_settings *settings, struct argp_state *state, const char *list)
{
    char name[BENCH_LISTED_SIZE], error[PROGRAM_ERROR_SIZE] = "";
    while (bench_next_name(&list, name)) {
        uint64_t batch = UINT64_MAX;
        if (strcmp(name, "all") != 0 && program_parse_u64(name, 1, MOST_RAYS, &batch, error, sizeof error))
            argp_error(state, "-B: %s", error);
        add_batch(settings, state, batch);
    }
}

/* What was not given. */
static void set_defaults(sweep_settings *settings, struct argp_state *state)
{
    static const cgt_structure everything[] = {CGT_STRUCTURE_QUEUE_GRID, CGT_STRUCTURE_LOOSE_GRID, CGT_STRUCTURE_KD,
                                               CGT_STRUCTURE_KD_ROPES, CGT_STRUCTURE_BVH};
    bench_structure_settings *structure = &settings->structure;
    if (!settings->batches)
        add_batches(settings, state, "1,16,64,256,1024,4096,16384,65536,all");
    if (!structure->count) {
        memcpy(structure->asked, everything, sizeof everything);
        structure->count = sizeof everything / sizeof everything[0];
    }
    if (settings->shared.packet)
        argp_error(state, "-k: arrays of rays have no packets of pixels");
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    sweep_settings *settings = state->input;
    char error[PROGRAM_ERROR_SIZE] = "";
    int failed = 0;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &settings->shared;
        state->child_inputs[1] = &settings->structure;
        return 0;
    case 'K': bench_choose(state, "-K", argument, kinds, SWEEP_KINDS, settings->kind); return 0;
    case 'O': bench_choose(state, "-O", argument, orders, SWEEP_ORDERS, settings->order); return 0;
    case 'Q': bench_choose(state, "-Q", argument, queries, SWEEP_QUERIES, settings->query); return 0;
    case 'B': add_batches(settings, state, argument); return 0;
    case OPTION_RAYS: failed = program_parse_u64(argument, 1, MOST_RAYS, &settings->rays, error, sizeof error); break;
    case 'a': failed = program_parse_u32(argument, 1, BENCH_MOST_AO_RAYS, &settings->ao, error, sizeof error); break;
    case 'l': failed = program_parse_floats(argument, 3, settings->light, error, sizeof error); break;
    case OPTION_JSON: settings->json_path = argument; return 0;
    case ARGP_KEY_END: set_defaults(settings, state); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
    if (failed)
        argp_error(state, "-%c: %s", key, error);
    return 0;
}

/* ---- Rows ---------------------------------------------------------------------------------------------------- */

static void begin_table(accuracy_report *report)
{
    /* batch: rays in a call. Times are medians over the rounds, _min the shortest. mrays_with_build: millions of rays a
     * second, one build and all rays, of the shortest */
    static const char *const columns[] = {"config",         "scene",
                                          "primitives",     "threads",
                                          "kind",           "order",
                                          "query",          "rays",
                                          "batch",          "ns_per_ray",
                                          "ns_per_ray_min", "build_ms",
                                          "build_min_ms",   "mrays_with_build",
                                          "hits",           "different",
                                          "bytes",          NULL};
    accuracy_report_table(report, "rays", columns);
}

static void report_row(const sweep_job *job, const sweep_subject *subject, size_t b, const char *const names[3],
                       accuracy_report *report)
{
    const size_t rounds = job->settings->shared.repeat;
    const double rays = (double)job->rays.count;
    double *trace = subject->trace_ms[b];
    const double ms = bench_median(trace, rounds), build = bench_median(subject->build_ms, rounds);
    accuracy_report_text(report, subject->config);
    accuracy_report_text(report, job->scene_name);
    accuracy_report_count(report, subject->build.built.primitives);
    accuracy_report_count(report, cgt_context_get_threads(job->context));
    for (int i = 0; i < 3; i++)
        accuracy_report_text(report, names[i]);
    accuracy_report_count(report, job->rays.count);
    accuracy_report_count(report, job->batch[b]);
    accuracy_report_real(report, 1e6 * ms / rays);
    accuracy_report_real(report, 1e6 * trace[0] / rays); /* sorted now */
    accuracy_report_real(report, build);
    accuracy_report_real(report, subject->build_ms[0]);
    accuracy_report_real(report, 1e-3 * rays / (subject->build_ms[0] + trace[0]));
    accuracy_report_count(report, job->hits);
    accuracy_report_count(report, subject->different);
    accuracy_report_count(report, subject->build.built.structure_bytes);
}

/* ---- Sets ---------------------------------------------------------------------------------------------------- */

/* The calls that are smaller than the set, then the whole set. */
static void set_batches(sweep_job *job)
{
    const sweep_settings *settings = job->settings;
    job->batches = 0;
    for (size_t i = 0; i < settings->batches; i++)
        if (settings->batch[i] < job->rays.count)
            job->batch[job->batches++] = settings->batch[i];
    if (job->batches < settings->batches) /* all, or as many as there are */
        job->batch[job->batches++] = job->rays.count;
}

static cgt_result run_set(sweep_job *job, sweep_kind kind, sweep_order order, sweep_query query,
                          accuracy_report *report)
{
    const char *const names[] = {kinds[kind], orders[order], queries[query]};
    const cgt_result result = sweep_trace(job, query);
    for (size_t i = 0; result == CGT_OK && i < job->subject_count; i++)
        for (size_t b = 0; !job->subjects[i].build.left_out && b < job->batches; b++)
            report_row(job, &job->subjects[i], b, names, report);
    return result;
}

static cgt_result run_kind(sweep_job *job, sweep_kind kind, accuracy_report *report)
{
    const sweep_settings *settings = job->settings;
    cgt_result result = sweep_rays_make(job, kind);
    set_batches(job);
    for (int order = kind == SWEEP_RANDOM ? SWEEP_SHUFFLED : 0; order < SWEEP_ORDERS && result == CGT_OK; order++) {
        if (!job->rays.count || !bench_is_chosen(settings->order, SWEEP_ORDERS, order))
            continue;
        result = sweep_rays_order(job, (sweep_order)order);
        for (int query = 0; query < SWEEP_QUERIES && result == CGT_OK; query++)
            if (settings->query[query] ||
                (bench_is_chosen(settings->query, SWEEP_QUERIES, query) && usual[kind][query]))
                result = run_set(job, kind, (sweep_order)order, (sweep_query)query, report);
    }
    return result;
}

/* ---- One frame ----------------------------------------------------------------------------------------------- */

/* AUTO is "auto", whatever it takes. */
static void name_subject(sweep_subject *subject, const bench_choice *choice)
{
    char name[BENCH_NAME_SIZE];
    const cgt_structure structure = subject->build.structure;
    bench_choice_name(choice, structure, name);
    snprintf(subject->config, sizeof subject->config, "%s%s",
             structure == CGT_STRUCTURE_AUTO ? "auto" : bench_structure_name(structure), name + strcspn(name, ","));
}

static cgt_result create_subject(sweep_job *job, sweep_subject *subject, cgt_structure structure)
{
    const bench_settings *shared = &job->settings->shared;
    const bench_choice choice = {.variant = cgt_context_get_variant(job->context), .kd = job->settings->structure.kd};
    int complete = (subject->build_ms = calloc(shared->repeat, sizeof(double))) != NULL;
    for (size_t b = 0; b < SWEEP_MOST_BATCHES; b++)
        complete &= (subject->trace_ms[b] = calloc(shared->repeat, sizeof(double))) != NULL;
    if (!complete)
        return CGT_ERROR_OUT_OF_MEMORY;
    subject->build.structure = structure;
    subject->build.rays = CGT_RAY_KIND_INCOHERENT;
    subject->build.kd = choice.kd;
    name_subject(subject, &choice);
    const cgt_result result = bench_scene_create(&subject->scene, job->context, job->input.moving, shared->resolution);
    bench_scene_set_triangles(&subject->scene, job->input.index, job->input.triangles);
    return result;
}

/* On standard error: what the library built. */
static void describe(const sweep_job *job)
{
    for (size_t i = 0; i < job->subject_count; i++) {
        const bench_build *build = &job->subjects[i].build;
        if (!build->left_out)
            fprintf(stderr, "%s: %s: %s (%s)\n", job->scene_name, job->subjects[i].config,
                    bench_structure_name(build->built.structure), build->built.reason);
    }
}

/* The hits that rays start from. */
static cgt_result trace_picture(sweep_job *job)
{
    cgt_frame frame;
    bench_planes_frame(&job->planes, &frame);
    return cgt_trace_camera(sweep_first(job)->scene.scene, &job->settings->shared.camera, &frame, NULL);
}

static cgt_result prepare(sweep_job *job)
{
    const sweep_settings *settings = job->settings;
    const bench_settings *shared = &settings->shared;
    cgt_result result = bench_context_create(shared->threads, shared->variant, &job->context);
    if (result != CGT_OK)
        return result;
    bench_camera_axes_init(&job->axes, &shared->camera, shared->width, shared->height);
    job->threads = bench_threads_create(cgt_context_get_threads(job->context));
    if (!job->threads)
        return CGT_ERROR_THREADS;
    if (bench_planes_create(&job->planes, shared->width, shared->height) ||
        !(job->maker = bench_rays_create(job->threads, &job->axes, &job->planes, settings->ao)))
        return CGT_ERROR_OUT_OF_MEMORY;
    for (size_t i = 0; i < settings->structure.count && result == CGT_OK; i++)
        result = create_subject(job, &job->subjects[job->subject_count++], settings->structure.asked[i]);
    return result;
}

static cgt_result measure(sweep_job *job, accuracy_report *report)
{
    cgt_result result = prepare(job);
    if (result == CGT_OK)
        result = sweep_build(job);
    if (result != CGT_OK || !sweep_first(job))
        return result;
    if (job->settings->shared.verbose)
        describe(job);
    result = trace_picture(job);
    for (int kind = 0; kind < SWEEP_KINDS && result == CGT_OK; kind++)
        if (bench_is_chosen(job->settings->kind, SWEEP_KINDS, kind))
            result = run_kind(job, (sweep_kind)kind, report);
    return result;
}

static void close_job(sweep_job *job)
{
    sweep_rays_release(&job->rays);
    sweep_found_release(&job->expected);
    sweep_found_release(&job->found);
    for (size_t i = 0; i < job->subject_count; i++) {
        sweep_subject *subject = &job->subjects[i];
        bench_scene_release(&subject->scene);
        free(subject->build_ms);
        for (size_t b = 0; b < SWEEP_MOST_BATCHES; b++)
            free(subject->trace_ms[b]);
    }
    bench_rays_release(job->maker);
    if (job->planes.t)
        bench_planes_release(&job->planes);
    bench_threads_release(job->threads);
    cgt_context_release(job->context);
    bench_input_release(&job->input);
}

static int run_file(sweep_job *job, accuracy_report *report)
{
    const bench_settings *shared = &job->settings->shared;
    char error[PROGRAM_ERROR_SIZE] = "";
    bench_file_name(shared->path, job->scene_name);
    if (bench_input_load(&job->input, shared->path, shared->frames, shared->radius, shared->wrapped, error,
                         sizeof error)) {
        program_error("%s", error);
        return PROGRAM_FAILED;
    }
    job->count = bench_input_move(&job->input, job->input.frames - 1);
    begin_table(report);
    const cgt_result result = measure(job, report);
    if (result != CGT_OK)
        return bench_scene_failed(job->context, shared->path, result);
    if (!sweep_first(job))
        program_error("%s: no structure is left to measure", shared->path);
    if (job->different)
        program_error("%s: %llu of %llu rays found other hits than in the first structure", shared->path,
                      (unsigned long long)job->different, (unsigned long long)job->compared);
    return job->different || !sweep_first(job) ? PROGRAM_FAILED : PROGRAM_OK;
}

static int run(const sweep_settings *settings)
{
    sweep_job *job = calloc(1, sizeof *job);
    accuracy_report *report = job ? accuracy_report_open(settings->json_path) : NULL;
    int code = PROGRAM_FAILED;
    if (!job)
        program_error("out of memory");
    if (report) {
        job->settings = settings;
        code = run_file(job, report);
        close_job(job);
        if (accuracy_report_close(report))
            code = PROGRAM_FAILED;
    }
    free(job);
    return code;
}

int bench_ray_sweep(int argc, char **argv)
{
    static const struct argp_child children[] = {
        {&bench_settings_argp, 0, NULL, 0}, {&bench_structure_argp, 0, NULL, 0}, {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "FILE",
        .children = children,
        .doc = "Which structure for which rays: traces rays of several kinds through one frame of a file, the last of "
               "those that --frames reads (default 1), in orders from the camera's to a shuffled one, and in calls of "
               "one ray to all. Prints a row for each structure and size of calls: nanoseconds a ray, the build apart "
               "and together. Structures take turns in each of -r rounds (default 3). Fails where any finds another "
               "hit than the first, in any bit. Unless -c and -s are given, the camera is that of the procedural "
               "scenes, the picture 640x360."
               "\vOrders: camera by tiles of 64x64 pixels and in them blocks of 4x4, tile shuffled within such tiles, "
               "shuffled as a whole, in which alone random rays come. Of ambient-occlusion rays and bounces the order "
               "is that of the pixels that they start from."};
    char error[PROGRAM_ERROR_SIZE] = "";
    sweep_settings settings = {.rays = DEFAULT_RAYS, .ao = 1, .light = {3.0f, 4.0f, -5.0f}};
    bench_settings_init(&settings.shared);
    settings.shared.width = 640;
    settings.shared.height = 360;
    settings.shared.frames = 1;
    settings.shared.repeat = DEFAULT_ROUNDS;
    settings.structure.most = SWEEP_MOST_SUBJECTS;
    if (program_parse_camera(BENCH_PROCEDURAL_CAMERA, &settings.shared.camera, error, sizeof error)) {
        program_error("%s", error);
        return PROGRAM_FAILED;
    }
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    return run(&settings);
}
