/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench structures: the command line, one file and one set of rays after another, and the rows. */
#include "structures/bench_structures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"

enum { DEFAULT_RAYS = 131072, DEFAULT_ROUNDS = 3, MOST_RAYS = 100000000 };
enum { OPTION_TRAVERSALS = 0x400, OPTION_LAYOUTS, OPTION_FETCH, OPTION_RANDOM, OPTION_RAYS };

static const char *const kinds[STRUCTURES_KINDS] = {"frame", "camera", "shadow", "ao", "bounce", "random"};
static const char *const orders[STRUCTURES_ORDERS] = {"camera", "tile", "shuffled"};
static const char *const queries[STRUCTURES_QUERIES] = {"nearest", "any"};

/* The queries of a kind that are measured by default. A frame has no other. */
static const int usual[STRUCTURES_KINDS][STRUCTURES_QUERIES] = {
    [STRUCTURES_FRAME] = {[STRUCTURES_NEAREST] = 1},
    [STRUCTURES_CAMERA] = {[STRUCTURES_NEAREST] = 1},
    [STRUCTURES_SHADOW] = {[STRUCTURES_ANY] = 1},
    [STRUCTURES_AO] = {[STRUCTURES_ANY] = 1},
    [STRUCTURES_BOUNCE] = {[STRUCTURES_NEAREST] = 1},
    [STRUCTURES_RANDOM] = {[STRUCTURES_NEAREST] = 1, [STRUCTURES_ANY] = 1}};

/* ---- Command line -------------------------------------------------------------------------------------------- */

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Rays; all lists have commas, or the option is given several times:", 4},
    {"kinds", 'K', "NAMES", 0, "frame, camera, shadow, ao, bounce, random (default: all)", 4},
    {"orders", 'O', "NAMES", 0, "camera (default), tile, shuffled", 4},
    {"queries", 'Q', "NAMES", 0,
     "nearest, any (default: nearest for camera and bounce, any for shadow and ao, both for random)", 4},
    {"batches", 'B', "COUNTS", 0, "rays in a call; all (default): the whole set", 4},
    {"rays", OPTION_RAYS, "COUNT", 0, "rays of a set at most, from the picture's middle (default 131072)", 4},
    {"random", OPTION_RANDOM, "COUNT", 0, "random rays (default: as --rays)", 4},
    {NULL, 0, NULL, 0, "Rows:", 6},
    {"traversals", OPTION_TRAVERSALS, NULL, 0, "a row for each way to traverse a structure", 6},
    {"layouts", OPTION_LAYOUTS, NULL, 0, "rows for all layouts of kd-trees", 6},
    {"fetch", OPTION_FETCH, NULL, 0,
     "time nothing; count the transfers of a kd-tree's nodes into small memories, by layout", 6},
    {NULL, 0, NULL, 0, NULL, 0}};

static void add_batch(structures_settings *settings, struct argp_state *state, uint64_t batch)
{
    size_t at = 0;
    while (at < settings->batches && settings->batch[at] < batch)
        at++;
    if (at < settings->batches && settings->batch[at] == batch)
        return;
    if (settings->batches == STRUCTURES_MOST_BATCHES)
        argp_error(state, "-B: more than %d counts", STRUCTURES_MOST_BATCHES);
    memmove(&settings->batch[at + 1], &settings->batch[at], (settings->batches++ - at) * sizeof settings->batch[0]);
    settings->batch[at] = batch;
}

static void add_batches(structures_settings *settings, struct argp_state *state, const char *list)
{
    char name[BENCH_LISTED_SIZE];
    while (bench_next_name(&list, name)) {
        uint32_t batch = 0;
        if (strcmp(name, "all") != 0)
            bench_parse_u32(state, "-B", name, 1, MOST_RAYS, &batch);
        add_batch(settings, state, batch ? batch : UINT64_MAX);
    }
}

/* Contradictions, and defaults that depend on other options. */
static void finish_settings(structures_settings *settings, struct argp_state *state)
{
    static const cgt_structure everything[] = {CGT_STRUCTURE_QUEUE_GRID, CGT_STRUCTURE_LOOSE_GRID, CGT_STRUCTURE_KD,
                                               CGT_STRUCTURE_KD_ROPES,   CGT_STRUCTURE_BIH,        CGT_STRUCTURE_BVH,
                                               CGT_STRUCTURE_AUTO};
    bench_structure_settings *structure = &settings->structure;
    const bench_kd_choice *kd = &structure->kd;
    if (settings->layouts && kd->layout != CGT_KD_LAYOUT_AUTO)
        argp_error(state, "--layouts covers all layouts: leave out --kd-layout");
    if (settings->fetch && structure->count)
        argp_error(state, "--fetch is about kd-trees: leave out --structure");
    if (settings->fetch && (kd->layout != CGT_KD_LAYOUT_AUTO || kd->traversal != CGT_KD_TRAVERSAL_AUTO))
        argp_error(state, "--fetch covers all layouts, one ray at a time: leave out --kd-layout and --kd-traversal");
    if (!settings->secondary.ao)
        argp_error(state, "-a: 1 or more");
    if (!settings->batches)
        add_batch(settings, state, UINT64_MAX);
    if (!settings->random)
        settings->random = settings->rays;
    if (settings->fetch)
        structure->requested[structure->count++] = CGT_STRUCTURE_KD;
    if (!structure->count) {
        memcpy(structure->requested, everything, sizeof everything);
        structure->count = sizeof everything / sizeof everything[0];
    }
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    structures_settings *settings = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &settings->shared;
        state->child_inputs[1] = &settings->structure;
        state->child_inputs[2] = &settings->secondary;
        return 0;
    case 'K': bench_choose(state, "-K", argument, kinds, STRUCTURES_KINDS, settings->kind); return 0;
    case 'O': bench_choose(state, "-O", argument, orders, STRUCTURES_ORDERS, settings->order); return 0;
    case 'Q': bench_choose(state, "-Q", argument, queries, STRUCTURES_QUERIES, settings->query); return 0;
    case 'B': add_batches(settings, state, argument); return 0;
    case OPTION_RAYS: bench_parse_u32(state, "--rays", argument, 1, MOST_RAYS, &settings->rays); return 0;
    case OPTION_RANDOM: bench_parse_u32(state, "--random", argument, 1, MOST_RAYS, &settings->random); return 0;
    case OPTION_TRAVERSALS: settings->traversals = 1; return 0;
    case OPTION_LAYOUTS: settings->layouts = 1; return 0;
    case OPTION_FETCH: settings->fetch = 1; return 0;
    case ARGP_KEY_END: finish_settings(settings, state); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- Rows ---------------------------------------------------------------------------------------------------- */

/* Only trees have inner nodes and leaves. */
static void write_visits(const structures_row *row, bench_table *table)
{
    const cgt_trace_statistics *traced = &row->count.trace;
    const cgt_research_trace_statistics *visited = &row->count.research;
    const cgt_structure structure = row->group->build.built.structure;
    const int tree =
        structure == CGT_STRUCTURE_KD || structure == CGT_STRUCTURE_KD_ROPES || structure == CGT_STRUCTURE_BIH;
    const double rays = traced->rays ? (double)traced->rays : NAN;
    bench_table_real(table, "nodes_per_ray", tree ? (double)visited->nodes / rays : NAN);
    bench_table_real(table, "leaves_per_ray", tree ? (double)visited->leaves / rays : NAN);
    bench_table_real(table, "tests_per_ray", (double)traced->ray_tests / rays);
    bench_table_count(table, "rope_steps", visited->rope_steps);
    bench_table_count(table, "exact_steps", visited->exact_steps);
    bench_table_count(table, "rope_loops", visited->rope_loops);
}

static void write_structure(const structures_row *row, bench_table *table)
{
    const cgt_scene_statistics *built = &row->group->build.built;
    const cgt_research_scene_statistics *research = &row->group->build.research;
    bench_table_count(table, "bytes", built->structure_bytes);
    bench_table_count(table, "kd_nodes", research->kd_nodes);
    bench_table_count(table, "kd_leaves", research->kd_leaves);
    bench_table_count(table, "kd_depth", research->kd_depth);
    bench_table_real(table, "kd_cost", research->kd_nodes ? research->kd_cost : NAN);
    bench_table_count(table, "bih_nodes", research->bih_nodes);
    bench_table_count(table, "bih_leaves", research->bih_leaves);
    bench_table_count(table, "bih_depth", research->bih_depth);
    bench_table_text(table, "chosen", bench_structure_name(built->structure));
    bench_table_text(table, "reason", built->reason);
}

static void write_row(const structures_job *job, const structures_row *row, size_t b, bench_table *table)
{
    const structures_set *set = &job->set;
    const size_t rounds = job->settings->shared.repeat;
    const double rays = (double)set->count;
    double *trace = row->trace_ms[b], *build_ms = row->group->build_ms;
    const double ms = bench_median(trace, rounds), build = bench_median(build_ms, rounds); /* sorts */
    bench_table_text(table, "config", row->config);
    bench_table_text(table, "scene", job->scene_name);
    bench_table_count(table, "primitives", row->group->build.built.primitives);
    bench_table_count(table, "threads", cgt_context_get_threads(job->context));
    bench_table_text(table, "kind", kinds[set->kind]);
    bench_table_text(table, "order", orders[set->order]);
    bench_table_text(table, "query", queries[set->query]);
    bench_table_count(table, "rays", set->count);
    bench_table_count(table, "batch", job->batch[b]);
    bench_table_real(table, "ns_per_ray", 1e6 * ms / rays);
    bench_table_real(table, "ns_per_ray_min", 1e6 * trace[0] / rays);
    bench_table_real(table, "build_ms", build);
    bench_table_real(table, "build_min_ms", build_ms[0]);
    bench_table_real(table, "mrays_with_build", 1e-3 * rays / (build_ms[0] + trace[0]));
    bench_table_count(table, "hits", job->hits);
    bench_table_count(table, "different", row->different);
    write_visits(row, table);
    write_structure(row, table);
    bench_table_end_row(table);
}

/* ---- Sets ---------------------------------------------------------------------------------------------------- */

/* The batches that are smaller than the set, then the whole set if that or more is requested. */
static void set_batches(structures_job *job)
{
    const structures_settings *settings = job->settings;
    job->batches = 0;
    for (size_t i = 0; i < settings->batches && job->set.kind != STRUCTURES_FRAME; i++)
        if (settings->batch[i] < job->set.count)
            job->batch[job->batches++] = settings->batch[i];
    if (job->batches < settings->batches)
        job->batch[job->batches++] = job->set.count;
}

static cgt_result run_set(structures_job *job, structures_query query, bench_table *table)
{
    const cgt_result result = structures_trace_set(job, query);
    for (size_t r = 0; result == CGT_OK && r < job->row_count; r++)
        for (size_t b = 0; !job->rows[r].group->build.left_out && b < job->batches; b++)
            write_row(job, &job->rows[r], b, table);
    return result;
}

/* A frame only comes in the camera's order, random rays only shuffled. */
static int has_order(const structures_settings *settings, structures_kind kind, int order)
{
    if (kind == STRUCTURES_FRAME)
        return order == STRUCTURES_BLOCKS;
    if (kind == STRUCTURES_RANDOM)
        return order == STRUCTURES_SHUFFLED;
    const int any =
        settings->order[STRUCTURES_BLOCKS] || settings->order[STRUCTURES_TILES] || settings->order[STRUCTURES_SHUFFLED];
    return any ? settings->order[order] : order == STRUCTURES_BLOCKS;
}

static int has_query(const structures_settings *settings, structures_kind kind, int query)
{
    if (kind == STRUCTURES_FRAME || (!settings->query[STRUCTURES_NEAREST] && !settings->query[STRUCTURES_ANY]))
        return usual[kind][query];
    return settings->query[query];
}

static cgt_result run_kind(structures_job *job, structures_kind kind, bench_table *table)
{
    const structures_settings *settings = job->settings;
    cgt_result result = structures_make_set(job, kind);
    set_batches(job);
    for (int order = 0; order < STRUCTURES_ORDERS && result == CGT_OK; order++) {
        if (!job->set.count || !has_order(settings, kind, order))
            continue;
        result = structures_order_set(job, (structures_order)order);
        for (int query = 0; query < STRUCTURES_QUERIES && result == CGT_OK; query++)
            if (has_query(settings, kind, query))
                result = run_set(job, (structures_query)query, table);
    }
    return result;
}

/* ---- One file ------------------------------------------------------------------------------------------------ */

/* On standard error: what the library built. */
static void describe(const structures_job *job)
{
    for (size_t r = 0; r < job->row_count; r++) {
        const bench_build *build = &job->rows[r].group->build;
        if (!build->left_out)
            fprintf(stderr, "%s: %s: %s (%s)\n", job->scene_name, job->rows[r].config,
                    bench_structure_name(build->built.structure), build->built.reason);
    }
}

/* The hits that rays start from. */
static cgt_result trace_picture(structures_job *job)
{
    cgt_frame frame;
    bench_planes_frame(&job->planes, &frame);
    return cgt_trace_camera(structures_first(job)->scene.scene, &job->settings->shared.camera, &frame, NULL);
}

static cgt_result prepare(structures_job *job)
{
    const structures_settings *settings = job->settings;
    const bench_settings *shared = &settings->shared;
    const cgt_result result = bench_context_create(shared->threads, shared->variant, &job->context);
    if (result != CGT_OK)
        return result;
    bench_camera_axes_init(&job->axes, &shared->camera, shared->width, shared->height);
    job->threads = bench_threads_create(cgt_context_get_threads(job->context));
    if (!job->threads)
        return CGT_ERROR_THREADS;
    if (bench_planes_create(&job->planes, shared->width, shared->height) ||
        structures_found_create(&job->expected, shared->width, shared->height) ||
        structures_found_create(&job->found, shared->width, shared->height) ||
        !(job->maker = bench_rays_create(job->threads, &job->axes, &job->planes, settings->secondary.ao)))
        return CGT_ERROR_OUT_OF_MEMORY;
    return structures_plan(job);
}

static cgt_result measure(structures_job *job, bench_table *table)
{
    cgt_result result = structures_build(job);
    if (result != CGT_OK || !structures_first(job))
        return result;
    if (job->settings->shared.verbose)
        describe(job);
    bench_table_section(table, "structures");
    result = trace_picture(job);
    for (int kind = 0; kind < STRUCTURES_KINDS && result == CGT_OK; kind++)
        if (bench_is_chosen(job->settings->kind, STRUCTURES_KINDS, kind))
            result = run_kind(job, (structures_kind)kind, table);
    return result;
}

static void close_job(structures_job *job)
{
    structures_release_set(&job->set);
    structures_found_release(&job->expected);
    structures_found_release(&job->found);
    structures_plan_release(job);
    bench_rays_release(job->maker);
    bench_planes_release(&job->planes);
    bench_threads_release(job->threads);
    cgt_context_release(job->context);
    bench_input_release(&job->input);
}

static int compare_structures(structures_job *job, bench_table *table)
{
    const cgt_result result = measure(job, table);
    if (result != CGT_OK)
        return bench_scene_failed(job->context, job->path, result);
    if (!structures_first(job))
        program_error("%s: no structure is left to measure", job->path);
    if (job->different)
        program_error("%s: %llu of %llu rays found other hits than in the first structure", job->path,
                      (unsigned long long)job->different, (unsigned long long)job->compared);
    return structures_first(job) ? PROGRAM_OK : PROGRAM_FAILED;
}

/* Differing hits are a failure, but the table is completed: *different is set. */
static int run_file(const structures_settings *settings, const char *path, bench_table *table, int *different)
{
    structures_job *job = calloc(1, sizeof *job);
    if (!job) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    job->settings = settings;
    job->path = path;
    bench_file_name(path, job->scene_name);
    int code = bench_input_load_file(&job->input, &settings->shared, path);
    if (code == PROGRAM_OK) {
        job->count = bench_input_move(&job->input, job->input.frames - 1);
        const cgt_result result = prepare(job);
        if (result != CGT_OK)
            code = bench_scene_failed(job->context, path, result);
    }
    if (code == PROGRAM_OK)
        code = settings->fetch ? structures_fetch(job, table) : compare_structures(job, table);
    *different |= job->different > 0;
    close_job(job);
    free(job);
    return code;
}

int bench_structures(int argc, char **argv)
{
    static const struct argp_child children[] = {{&bench_settings_argp, 0, NULL, 0},
                                                 {&bench_structure_argp, 0, NULL, 0},
                                                 {&bench_secondary_argp, 0, NULL, 0},
                                                 {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "FILE...",
        .children = children,
        .doc =
            "Compares structures by kind of rays, by their order and by their number in a call. FILE is a trajectory "
            "of spheres or triangles: .frames, .lammpstrj, .xyz, or a mesh; its last frame that -n reads is taken "
            "(default 1). Prints a row for each structure and size of calls; structures take turns in -r rounds "
            "(default 3). Fails where any structure finds another hit than the first, in any bit."
            "\vColumns ending in _per_ray count what a ray visits: inner nodes, leaves, tests of primitives. In "
            "packets a node counts once for all rays of the packet."};
    structures_settings settings = {.rays = DEFAULT_RAYS, .secondary = {.ao = 1, .light = {3, 4, -5}}};
    int different = 0;
    bench_settings_init(&settings.shared);
    bench_settings_use_procedural_camera(&settings.shared);
    settings.shared.most_files = BENCH_MOST_FILES;
    settings.shared.width = 640;
    settings.shared.height = 360;
    settings.shared.frames = 1;
    settings.shared.repeat = DEFAULT_ROUNDS;
    settings.structure.most = sizeof settings.structure.requested / sizeof settings.structure.requested[0];
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    bench_table *table = bench_table_open(settings.shared.json_path);
    int code = table ? PROGRAM_OK : PROGRAM_FAILED;
    for (size_t i = 0; code == PROGRAM_OK && i < settings.shared.files; i++)
        code = run_file(&settings, settings.shared.paths[i], table, &different);
    if (bench_table_close(table) || different)
        code = PROGRAM_FAILED;
    return code;
}
