/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Measures sets. Round 0 counts what rays visit, and its first way gives the results that all others of the library
 * must find. */
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"
#include "sets/bench_sets.h"

enum { MOST_MESSAGES = 10 }; /* about differing results; the last line has the total */

int sets_out_of_memory(void)
{
    program_error("out of memory");
    return PROGRAM_FAILED;
}

/* ---- one run ---- */

static void add_counts(bench_counts *total, const bench_counts *call)
{
    total->trace.rays += call->trace.rays;
    total->trace.ray_tests += call->trace.ray_tests;
    total->trace.bvh_rays += call->trace.bvh_rays;
    total->research.references += call->research.references;
    total->research.nodes += call->research.nodes;
    total->research.leaves += call->research.leaves;
    total->research.rope_steps += call->research.rope_steps;
    total->research.exact_steps += call->research.exact_steps;
    total->research.rope_loops += call->research.rope_loops;
}

/* All calls against one light; ms grows. total: NULL: nothing is counted. */
static int trace_calls(sets_job *job, bench_tracer *t, const bench_set *set, uint64_t batch, uint32_t light,
                       bench_counts *total, double *ms)
{
    const uint64_t count = set->query == BENCH_PICTURE ? 1 : set->rays.count;
    const int by_calls = set->calls && !t->way->embree; /* Embree gets the points as one array */
    bench_counts counts;
    int code = t->engine->aim(t, set, light);
    const double begin = bench_session_ms(&job->session);
    for (uint64_t first = 0, call = 0; first < count && code == PROGRAM_OK; call++) {
        const uint64_t all = set->calls || !batch || count - first < batch ? count : first + batch;
        const uint64_t end = by_calls ? set->end[call] : all;
        if (total)
            memset(&counts, 0, sizeof counts);
        code = t->engine->trace(t, set, first, end - first, light, &job->found, total ? &counts : NULL);
        if (total)
            add_counts(total, &counts);
        first = end;
    }
    *ms += bench_session_ms(&job->session) - begin;
    return code;
}

static int trace_set(sets_job *job, bench_tracer *t, const bench_set *set, uint64_t batch, bench_counts *total,
                     double *ms)
{
    const int is_one =
        set->lights == 0 || (set->query == BENCH_LIT_PICTURE && !t->way->embree); /* all lights in a call */
    int code = PROGRAM_OK;
    *ms = 0;
    if (sets_found_reset(&job->found, set->query, sets_results(job, set, t)))
        return sets_out_of_memory();
    for (uint32_t light = 0; light < (is_one ? 1 : set->lights) && code == PROGRAM_OK; light++)
        code = trace_calls(job, t, set, batch, light, total, ms);
    return code;
}

/* A commit that is timed, and the camera's frame. */
static int begin_afresh(sets_job *job, bench_tracer *t, double *build_ms)
{
    if (t->way->embree)
        return PROGRAM_OK;
    const double begin = bench_session_ms(&job->session);
    const int code = t->engine->commit(t);
    *build_ms = bench_session_ms(&job->session) - begin;
    return code == PROGRAM_OK ? t->engine->picture(t, &job->found.planes, NULL) : code;
}

/* ---- results ---- */

uint64_t sets_results(const sets_job *job, const bench_set *set, const bench_tracer *t)
{
    const uint64_t pixels = (uint64_t)job->planes.width * job->planes.height, lights = set->lights ? set->lights : 1;
    const int is_picture = set->query == BENCH_PICTURE || (set->query == BENCH_LIT_PICTURE && !t->way->embree);
    return lights * (is_picture ? pixels : set->rays.count) * (set->query == BENCH_FOUR ? BENCH_FOUR_HITS : 1);
}

/* Compares a way's results with the first one's. */
static void compare(sets_job *job, bench_tracer *t, sets_row *row, const bench_set *set)
{
    const size_t first = (size_t)(bench_session_first(&job->session) - job->session.tracer);
    const uint64_t count = sets_results(job, set, t);
    char text[400];
    if (t->way->embree && set->query == BENCH_PICTURE)
        t->engine->planes(t, &job->found.planes);
    row->hits = sets_found_hits(&job->found, set->query, t->way->embree, count);
    if (t->way->embree) {
        const uint64_t hits = job->row[first].hits;
        row->different = row->hits > hits ? row->hits - hits : hits - row->hits;
        return;
    }
    if (!job->expecting) {
        const bench_found found = job->expected;
        job->expected = job->found;
        job->found = found;
        job->expecting = 1;
        return;
    }
    const uint64_t different = sets_found_differ(&job->expected, &job->found, set->query, count, text, sizeof text);
    if (different && job->messages++ < MOST_MESSAGES)
        program_error("%s: %s: %s", job->session.path, t->config, text);
    row->different += different;
    job->different += different;
    job->compared += count;
}

/* ---- a set ---- */

static int takes(const bench_tracer *t, const bench_set *set)
{
    return !t->left_out && !(t->way->embree && !bench_embree_takes(t->way, set->query));
}

typedef struct set_turn {
    sets_job *job;
    const bench_set *set;
    uint32_t round;
    size_t batch;
    int is_fresh;
} set_turn;

/* The BVH that AUTO has built beside its grid, for this set or one before it, belongs to the build from then on. */
static int add_bvh(const sets_job *job, bench_tracer *t, sets_row *row)
{
    cgt_scene_statistics now;
    if (t->way->embree || t->built_by != t || row->has_bvh || t->built.structure != CGT_STRUCTURE_LOOSE_GRID)
        return PROGRAM_OK;
    if (cgt_scene_get_statistics(t->scene, &now) != CGT_OK)
        return PROGRAM_FAILED;
    row->has_bvh = now.bvh_build_ms > 0;
    for (uint32_t round = 0; row->has_bvh && round < job->settings->repeat; round++)
        row->build_ms[round] += now.bvh_build_ms;
    return PROGRAM_OK;
}

static int run(void *of, size_t i)
{
    const set_turn *turn = of;
    sets_job *job = turn->job;
    bench_tracer *t = &job->session.tracer[i];
    sets_row *row = &job->row[i];
    double build_ms = 0, ms = 0;
    const int counts = turn->round == 0; /* which is not timed */
    if (!takes(t, turn->set))
        return PROGRAM_OK;
    int code = turn->is_fresh ? begin_afresh(job, t, &build_ms) : PROGRAM_OK;
    if (counts)
        memset(&row->count, 0, sizeof row->count);
    if (code == PROGRAM_OK)
        code = trace_set(job, t, turn->set, job->batch[turn->batch], counts ? &row->count : NULL, &ms);
    if (code != PROGRAM_OK)
        return code;
    compare(job, t, row, turn->set);
    if (turn->round == 0 && !turn->is_fresh && code == PROGRAM_OK)
        code = add_bvh(job, t, row);
    if (code == PROGRAM_OK && turn->round > 0) {
        row->ms[turn->batch][turn->round - 1] = ms;
        if (turn->is_fresh && !t->way->embree)
            row->build_ms[turn->round - 1] = build_ms;
    }
    return code;
}

/* New scenes, so that nothing is remembered of the set before. */
static int reopen(sets_job *job)
{
    int code = PROGRAM_OK;
    for (size_t i = 0; i < job->session.tracers && code == PROGRAM_OK; i++) {
        bench_tracer *t = &job->session.tracer[i];
        if (t->way->embree || t->left_out)
            continue;
        t->engine->close(t);
        code = t->engine->open(t);
    }
    return code;
}

/* The batches that are smaller than the set, then the whole set if that or more is asked for. */
static void set_batches(sets_job *job, const bench_set *set, const uint64_t *batch, size_t batches)
{
    const uint64_t count = set->query == BENCH_PICTURE ? 0 : set->rays.count;
    job->batches = 0;
    for (size_t i = 0; i < batches; i++)
        if (batch[i] < count)
            job->batch[job->batches++] = batch[i];
    if (job->batches < batches)
        job->batch[job->batches++] = count;
}

int sets_measure(sets_job *job, const bench_set *set, const uint64_t *batch, size_t batches, int is_fresh)
{
    set_turn turn = {.job = job, .set = set, .is_fresh = is_fresh};
    int code = is_fresh ? reopen(job) : PROGRAM_OK;
    job->expecting = 0;
    set_batches(job, set, batch, batches);
    for (size_t i = 0; i < job->session.tracers; i++)
        job->row[i].different = 0;
    for (; turn.round <= job->settings->repeat; turn.round++)
        for (turn.batch = turn.round ? 0 : job->batches - 1; turn.batch < job->batches && code == PROGRAM_OK;
             turn.batch++)
            code = bench_round(turn.round, job->session.tracers, run, &turn);
    if (code == PROGRAM_OK)
        sets_write_rows(job, set);
    return code;
}

/* ---- a file ---- */

/* Rows are called by the variant, too: tables of several are compared. */
static void name_ways(sets_job *job)
{
    for (size_t i = 0; i < job->session.tracers; i++) {
        bench_tracer *t = &job->session.tracer[i];
        job->session.way[i].choice.variant = cgt_context_get_variant(job->session.context);
        bench_way_name(t->way, t->way->structure, t->config);
    }
}

static int build_way(void *of, size_t i)
{
    const set_turn *turn = of;
    const bench_session *session = &turn->job->session;
    bench_tracer *t = &turn->job->session.tracer[i];
    if (t->left_out || t->built_by != t)
        return PROGRAM_OK;
    t->engine->move(t);
    const double begin = bench_session_ms(session);
    const int code = t->engine->commit(t);
    if (turn->round > 0)
        turn->job->row[i].build_ms[turn->round - 1] = bench_session_ms(session) - begin;
    return code;
}

static int build(sets_job *job)
{
    set_turn turn = {.job = job};
    int code = PROGRAM_OK;
    for (; turn.round <= job->settings->repeat && code == PROGRAM_OK; turn.round++)
        code = bench_round(turn.round, job->session.tracers, build_way, &turn);
    for (size_t i = 0; i < job->session.tracers && code == PROGRAM_OK; i++)
        code = bench_library_inspect(&job->session.tracer[i]);
    for (size_t i = 0; i < job->session.tracers; i++)
        job->session.tracer[i].left_out |= job->session.tracer[i].built_by->left_out;
    return code;
}

/* Room for the times of all rounds. */
static int reserve_times(sets_job *job)
{
    const size_t rounds = job->settings->repeat, of_row = 1 + job->settings->batches;
    job->times = calloc(job->session.tracers * of_row, rounds * sizeof *job->times);
    for (size_t i = 0; i < job->session.tracers && job->times; i++) {
        job->row[i].build_ms = job->times + i * of_row * rounds;
        for (size_t b = 0; b < job->settings->batches; b++)
            job->row[i].ms[b] = job->row[i].build_ms + (1 + b) * rounds;
    }
    return job->times ? PROGRAM_OK : sets_out_of_memory();
}

/* Opens a file, builds, and traces the camera's frame by the first way. */
static int prepare(sets_job *job, const char *path)
{
    const bench_settings *s = job->settings;
    if (bench_session_open(&job->session, s, path))
        return PROGRAM_FAILED;
    job->geometry = calloc((size_t)s->width * s->height + 1, sizeof *job->geometry);
    if (!job->geometry || bench_planes_create(&job->planes, s->width, s->height) ||
        sets_found_create(&job->expected, s->width, s->height) || sets_found_create(&job->found, s->width, s->height))
        return sets_out_of_memory();
    job->planes.geometry = job->expected.planes.geometry = job->found.planes.geometry = job->geometry;
    int code = reserve_times(job);
    name_ways(job);
    if (code == PROGRAM_OK)
        code = build(job);
    bench_tracer *first = bench_session_first(&job->session);
    if (code != PROGRAM_OK || !first) {
        program_error("%s: no way is left to measure", path);
        return PROGRAM_FAILED;
    }
    code = first->engine->picture(first, &job->planes, NULL);
    first->engine->planes(first, &job->planes);
    for (size_t i = 0; i < job->session.tracers && s->verbose && code == PROGRAM_OK; i++)
        if (!job->session.way[i].embree && !job->session.tracer[i].left_out)
            code = bench_library_describe(&job->session.tracer[i], &job->found.planes);
    return code;
}

/* Differing results are a failure, but the table is completed: *different is set. */
static int run_file(const bench_settings *settings, bench_table *table, const char *path, int (*run_sets)(sets_job *),
                    int *different)
{
    sets_job *job = calloc(1, sizeof *job);
    if (!job)
        return sets_out_of_memory();
    job->settings = settings;
    job->table = table;
    int code = prepare(job, path);
    if (code == PROGRAM_OK)
        code = run_sets(job);
    if (job->different)
        program_error("%s: %llu of %llu rays found other hits than by the first way", path,
                      (unsigned long long)job->different, (unsigned long long)job->compared);
    *different |= job->different > 0;
    sets_found_release(&job->expected);
    sets_found_release(&job->found);
    bench_planes_release(&job->planes);
    bench_session_close(&job->session);
    free(job->geometry);
    free(job->times);
    free(job);
    return code;
}

int sets_run(const bench_settings *settings, int (*run_sets)(sets_job *))
{
    int different = 0;
    bench_table *table = bench_table_open(settings->json_path);
    int code = table ? bench_input_check_files(settings) : PROGRAM_FAILED;
    if (code == PROGRAM_OK)
        bench_table_section(table, "rays");
    for (size_t i = 0; code == PROGRAM_OK && i < settings->files; i++)
        code = run_file(settings, table, settings->paths[i], run_sets, &different);
    return bench_table_close(table) || different ? PROGRAM_FAILED : code;
}
