/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench bounces: a row for each scene, material, bounce, order and structure, of the first frame of each file; then
 * a table of whole frames: build, orders and all bounces. */
#include "bounces/bench_bounces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_table.h"
#include "common/bench_timing.h"

enum { OPTION_MATERIAL = 0xa00, OPTION_ORDER, OPTION_STRUCTURE, OPTION_NO_EMBREE, DEFAULT_ROUNDS = 3 };

typedef struct bounces_settings {
    bench_settings shared;
    int material[BOUNCES_MATERIALS], order[BOUNCES_ORDERS], structure[BOUNCES_STRUCTURES]; /* none: all */
    int no_embree;
} bounces_settings;

/* Sums over the bounces of a scene of one material: ms. */
typedef struct bounces_whole {
    char scene[BENCH_NAME_SIZE];
    int material, structure, order;
    uint64_t rays;
    double order_ms, build_ms, ms;
    double embree_ms[BOUNCES_MOST_WAYS], embree_build_ms[BOUNCES_MOST_WAYS];
    int ways;
} bounces_whole;

enum { MOST_WHOLES = BENCH_MOST_FILES * BOUNCES_MATERIALS * BOUNCES_STRUCTURES * BOUNCES_ORDERS };

typedef struct bounces_job {
    const bounces_settings *settings;
    bench_table *table;
    cgt_context *context;
    bench_threads *threads;
    bench_input input;
    uint32_t count; /* spheres or vertices */
    bounces_structure structure[BOUNCES_STRUCTURES];
    embree_scenes *embree; /* NULL: it is not measured */
    char name[BENCH_NAME_SIZE];
    bounces_whole *whole;
    int wholes;
    double *ms[BOUNCES_STRUCTURES + BOUNCES_MOST_WAYS]; /* of each round */
} bounces_job;

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Rows:", 4},
    {"material", OPTION_MATERIAL, "NAMES", 0, "mirror or glass; a list with commas", 4},
    {"order", OPTION_ORDER, "NAMES", 0, "waves, made, octant, wave-morton, origin or octant-morton; a list with commas",
     4},
    {"structure", OPTION_STRUCTURE, "NAMES", 0, "bvh, loose-grid, kd or bih; a list with commas", 4},
    {"no-embree", OPTION_NO_EMBREE, NULL, 0, "measure the library alone", 4},
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    bounces_settings *s = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &s->shared; return 0;
    case OPTION_MATERIAL:
        bench_choose(state, "--material", argument, bounces_material_names, BOUNCES_MATERIALS, s->material);
        return 0;
    case OPTION_ORDER:
        bench_choose(state, "--order", argument, bounces_order_names, BOUNCES_ORDERS, s->order);
        return 0;
    case OPTION_STRUCTURE:
        bench_choose(state, "--structure", argument, bounces_structure_names, BOUNCES_STRUCTURES, s->structure);
        return 0;
    case OPTION_NO_EMBREE: s->no_embree = 1; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- scenes ---- */

static int open_scene(bounces_job *job, const char *path)
{
    const bench_settings *shared = &job->settings->shared;
    int failed = 0;
    bench_file_name(path, job->name);
    if (bench_input_load_file(&job->input, shared, path))
        return PROGRAM_FAILED;
    job->count = bench_input_move(&job->input, 0);
    for (int which = 0; which < BOUNCES_STRUCTURES; which++) {
        if (!bench_is_chosen(job->settings->structure, BOUNCES_STRUCTURES, which))
            continue;
        const cgt_result result = bounces_structure_build(&job->structure[which], which, job->context, &job->input,
                                                          job->count, shared->repeat);
        if (result != CGT_OK)
            return bench_scene_failed(job->context, path, result);
    }
    if (!job->settings->no_embree)
        job->embree = embree_scenes_create(&job->input, job->threads, shared->repeat, &failed);
    if (failed)
        program_error("Embree: no device or no memory");
    return failed ? PROGRAM_FAILED : PROGRAM_OK;
}

static void close_scene(bounces_job *job)
{
    embree_scenes_release(job->embree);
    job->embree = NULL;
    for (int which = 0; which < BOUNCES_STRUCTURES; which++) {
        bench_scene_release(&job->structure[which].scene);
        job->structure[which].is_built = 0;
    }
    bench_input_release(&job->input);
}

/* ---- measuring ---- */

/* All structures and ways by turns; job->ms gets the times of each round, the first of which warms up. hits: of the
 * library, which are the same through each structure. */
static cgt_result measure(bounces_job *job, bounces_order order, bounces_rays *rays, uint64_t *hits)
{
    const uint64_t call = order == BOUNCES_WAVES || order == BOUNCES_OCTANT || order == BOUNCES_WAVE_MORTON
                              ? BOUNCES_CALL
                              : rays->count + 1;
    const int ways = job->embree ? bounces_embree_ways(job->embree) : 0;
    cgt_result result = CGT_OK;
    *hits = 0;
    for (uint32_t round = 0; round <= job->settings->shared.repeat; round++) {
        for (int which = 0; which < BOUNCES_STRUCTURES && result == CGT_OK; which++)
            if (job->structure[which].is_built)
                result = bounces_structure_trace(&job->structure[which], rays, call, &job->ms[which][round]);
        for (int way = 0; way < ways && result == CGT_OK; way++)
            job->ms[BOUNCES_STRUCTURES + way][round] = bounces_embree_trace(job->embree, way, rays);
    }
    for (uint64_t i = 0; i < rays->count; i++)
        *hits += rays->primitive[i] != CGT_INVALID_ID;
    return result;
}

static double median_of(const bounces_job *job, int which)
{
    return bench_median(job->ms[which] + 1, job->settings->shared.repeat);
}

static bounces_whole *whole_of(bounces_job *job, int material, int structure, int order)
{
    for (int i = job->wholes - 1; i >= 0; i--) {
        bounces_whole *w = &job->whole[i];
        if (w->material == material && w->structure == structure && w->order == order && !strcmp(w->scene, job->name))
            return w;
    }
    bounces_whole *w = &job->whole[job->wholes++];
    memset(w, 0, sizeof *w);
    memcpy(w->scene, job->name, sizeof w->scene);
    w->material = material;
    w->structure = structure;
    w->order = order;
    return w;
}

/* ---- rows ---- */

static void add_row(bounces_job *job, int material, int bounce, const bounces_wave *wave, bounces_order order,
                    const bounces_rays *rays, uint64_t hits, int structure, const double *embree, int best)
{
    bench_table *t = job->table;
    const double ms = median_of(job, structure), per_ray = rays->count ? 1e6 / (double)rays->count : NAN;
    bench_table_text(t, "scene", job->name);
    bench_table_text(t, "material", bounces_material_names[material]);
    bench_table_count(t, "bounce", (uint64_t)bounce);
    bench_table_text(t, "order", bounces_order_names[order]);
    bench_table_text(t, "structure", bounces_structure_names[structure]);
    bench_table_count(t, "rays", rays->count);
    bench_table_count(t, "left_out", wave->left_out);
    bench_table_count(t, "hits", hits);
    bench_table_real(t, "ns", ms * per_ray);
    bench_table_real(t, "order_ns", rays->ms * per_ray);
    bench_table_real(t, "embree_ns", best >= 0 ? embree[best] * per_ray : NAN);
    bench_table_text(t, "embree_way", best >= 0 ? bounces_embree_way(job->embree, best) : "-");
    bench_table_real(t, "ratio", best >= 0 ? embree[best] / ms : NAN);
    bench_table_end_row(t);

    bounces_whole *w = whole_of(job, material, structure, (int)order);
    w->rays += rays->count;
    w->order_ms += rays->ms;
    w->build_ms = job->structure[structure].build_ms;
    w->ms += ms;
    w->ways = job->embree ? bounces_embree_ways(job->embree) : 0;
    for (int way = 0; way < w->ways; way++) {
        w->embree_ms[way] += embree[way];
        w->embree_build_ms[way] = bounces_embree_build_ms(job->embree, way);
    }
}

static int run_order(bounces_job *job, int material, int bounce, const bounces_wave *wave, bounces_order order)
{
    double embree[BOUNCES_MOST_WAYS] = {0};
    bounces_rays rays;
    uint64_t hits;
    if (bounces_rays_make(wave, order, &rays)) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    const cgt_result result = measure(job, order, &rays, &hits);
    const int ways = job->embree ? bounces_embree_ways(job->embree) : 0;
    int best = -1;
    for (int way = 0; way < ways && result == CGT_OK; way++) {
        embree[way] = median_of(job, BOUNCES_STRUCTURES + way);
        if (best < 0 || embree[way] < embree[best])
            best = way;
    }
    for (int which = 0; which < BOUNCES_STRUCTURES && result == CGT_OK; which++)
        if (job->structure[which].is_built)
            add_row(job, material, bounce, wave, order, &rays, hits, which, embree, best);
    bounces_rays_release(&rays);
    return result == CGT_OK ? PROGRAM_OK : bench_scene_failed(job->context, job->name, result);
}

static int run_scene(bounces_job *job)
{
    int code = PROGRAM_OK;
    for (int material = 0; material < BOUNCES_MATERIALS && code == PROGRAM_OK; material++) {
        bounces_waves waves;
        if (!bench_is_chosen(job->settings->material, BOUNCES_MATERIALS, material))
            continue;
        const cgt_result result = bounces_waves_make(&waves, &job->input, job->count, material, &job->settings->shared);
        if (result != CGT_OK)
            code = bench_scene_failed(NULL, job->name, result);
        for (int bounce = 1; bounce <= BOUNCES && code == PROGRAM_OK; bounce++)
            for (int order = 0; order < BOUNCES_ORDERS && code == PROGRAM_OK; order++)
                if (bench_is_chosen(job->settings->order, BOUNCES_ORDERS, order))
                    code = run_order(job, material, bounce, &waves.bounce[bounce], (bounces_order)order);
        bounces_waves_release(&waves);
    }
    return code;
}

/* Embree's fastest way, its build in. */
static int fastest_of(const bounces_whole *w)
{
    int best = w->ways > 0 ? 0 : -1;
    for (int way = 1; way < w->ways; way++)
        if (w->embree_ms[way] + w->embree_build_ms[way] < w->embree_ms[best] + w->embree_build_ms[best])
            best = way;
    return best;
}

static void add_whole(bench_table *t, const bounces_whole *w)
{
    const int best = fastest_of(w);
    const double ms = w->build_ms + w->order_ms + w->ms;
    const double embree = best >= 0 ? w->embree_build_ms[best] + w->order_ms + w->embree_ms[best] : NAN;
    bench_table_text(t, "scene", w->scene);
    bench_table_text(t, "material", bounces_material_names[w->material]);
    bench_table_text(t, "order", bounces_order_names[w->order]);
    bench_table_text(t, "structure", bounces_structure_names[w->structure]);
    bench_table_count(t, "rays", w->rays);
    bench_table_real(t, "build_ms", w->build_ms);
    bench_table_real(t, "order_ms", w->order_ms);
    bench_table_real(t, "trace_ms", w->ms);
    bench_table_real(t, "whole_ms", ms);
    bench_table_real(t, "embree_build_ms", best >= 0 ? w->embree_build_ms[best] : NAN);
    bench_table_real(t, "embree_trace_ms", best >= 0 ? w->embree_ms[best] : NAN);
    bench_table_real(t, "ratio", embree / ms);
    bench_table_end_row(t);
}

/* ---- command ---- */

static int allocate(bounces_job *job)
{
    const size_t rounds = (size_t)job->settings->shared.repeat + 1;
    job->whole = malloc(MOST_WHOLES * sizeof *job->whole);
    double *ms = calloc(rounds * (BOUNCES_STRUCTURES + BOUNCES_MOST_WAYS), sizeof *ms);
    for (size_t i = 0; i < BOUNCES_STRUCTURES + BOUNCES_MOST_WAYS && ms; i++)
        job->ms[i] = ms + i * rounds;
    job->threads = bench_threads_create(cgt_context_get_threads(job->context));
    if (job->whole && ms && job->threads)
        return PROGRAM_OK;
    program_error("out of memory or threads");
    return PROGRAM_FAILED;
}

static int run_files(bounces_job *job)
{
    const bench_settings *shared = &job->settings->shared;
    const cgt_result result = bench_context_create(shared->threads, shared->variant, &job->context);
    if (result != CGT_OK)
        return bench_scene_failed(NULL, shared->variant ? shared->variant : "context", result);
    int code = allocate(job);
    if (code == PROGRAM_OK)
        bench_table_section(job->table, "bounces");
    for (size_t i = 0; i < shared->files && code == PROGRAM_OK; i++) {
        code = open_scene(job, shared->paths[i]);
        if (code == PROGRAM_OK)
            code = run_scene(job);
        close_scene(job);
    }
    if (code == PROGRAM_OK)
        bench_table_section(job->table, "whole");
    for (int i = 0; i < job->wholes && code == PROGRAM_OK; i++)
        add_whole(job->table, &job->whole[i]);
    return code;
}

int bench_bounces(int argc, char **argv)
{
    static const struct argp_child children[] = {{&bench_settings_argp, 0, NULL, 0}, {NULL, 0, NULL, 0}};
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "FILE...",
        .children = children,
        .doc =
            "Measures the rays of bounces 1 to 4 of Whitted's tracing, all primitives of the first frame of each FILE "
            "being mirrors, then glass: each wave is recorded, and traced as arrays through each structure and in "
            "several orders, beside Embree's fastest way to trace the same rays. Times are CPU time, of all threads "
            "together. The second table adds builds and "
            "sorting. The camera is that of the scenes of cgt-bench make."};
    bounces_settings settings;
    bounces_job job;
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
    free(job.ms[0]);
    free(job.whole);
    bench_threads_release(job.threads);
    cgt_context_release(job.context);
    return code;
}
