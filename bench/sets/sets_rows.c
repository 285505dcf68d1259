/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rows of sets. */
#include <math.h>

#include "common/bench_timing.h"
#include "sets/bench_sets.h"

typedef struct row_times {
    double ms, least_ms, build_ms, least_build_ms;
} row_times;

static int is_measured(const sets_job *job, size_t i, const bench_set *set)
{
    const bench_tracer *t = &job->session.tracer[i];
    return !t->left_out && !(t->way->embree && !bench_embree_takes(t->way, set->query));
}

static row_times times_of(const sets_job *job, size_t i, size_t b)
{
    const size_t rounds = job->settings->repeat, built_by = job->session.way[i].built_by;
    double *build = job->row[built_by].build_ms, *ms = job->row[i].ms[b];
    row_times times = {.ms = bench_median(ms, rounds), .build_ms = bench_median(build, rounds)}; /* sorts */
    times.least_ms = ms[0];
    times.least_build_ms = build[0];
    return times;
}

/* The fastest of Embree's ways; candidates: of those of which only the fastest has a row. -1: none. */
static int fastest(const sets_job *job, const bench_set *set, size_t b, int candidates)
{
    int best = -1;
    for (size_t i = 0; i < job->session.tracers; i++) {
        const bench_way *way = &job->session.way[i];
        if (way->embree && (way->is_candidate || !candidates) && is_measured(job, i, set) &&
            (best < 0 || times_of(job, i, b).ms < times_of(job, (size_t)best, b).ms))
            best = (int)i;
    }
    return best;
}

/* Only trees have inner nodes and leaves. */
static void write_visits(const bench_tracer *t, const sets_row *row, bench_table *table)
{
    const cgt_trace_statistics *traced = &row->count.trace;
    const cgt_research_trace_statistics *visited = &row->count.research;
    const cgt_structure s = t->built_by->built.structure;
    const double rays = traced->rays ? (double)traced->rays : NAN;
    const double of_tree = s == CGT_STRUCTURE_KD || s == CGT_STRUCTURE_KD_ROPES || s == CGT_STRUCTURE_BIH ? rays : NAN;
    BENCH_CELLS(table, CELL("nodes_per_ray", (double)visited->nodes / of_tree),
                CELL("leaves_per_ray", (double)visited->leaves / of_tree),
                CELL("tests_per_ray", (double)traced->ray_tests / rays),
                CELL("references_per_ray", (double)visited->references / rays),
                CELL("tree_share", (double)traced->bvh_rays / rays), CELL("rope_steps", visited->rope_steps),
                CELL("exact_steps", visited->exact_steps), CELL("rope_loops", visited->rope_loops));
}

static void write_row(const sets_job *job, size_t i, const bench_set *set, size_t b)
{
    const bench_session *s = &job->session;
    const bench_tracer *t = &s->tracer[i];
    const sets_row *row = &job->row[i];
    const row_times times = times_of(job, i, b);
    const int best = fastest(job, set, b, 0);
    const row_times embree = best >= 0 ? times_of(job, (size_t)best, b) : (row_times){NAN, NAN, NAN, NAN};
    const uint64_t rays =
        set->query == BENCH_PICTURE ? sets_results(job, set, t) : set->rays.count * (set->lights ? set->lights : 1);
    const int query = set->query == BENCH_FOUR ? 2 : set->query != BENCH_NEAREST && set->query != BENCH_PICTURE;
    BENCH_CELLS(job->table, CELL("config", t->config), CELL("scene", s->scene),
                CELL("primitives", s->input.index ? s->input.triangles : s->count),
                CELL("threads", cgt_context_get_threads(s->context)), CELL("kind", set->kind),
                CELL("order", set->order), CELL("query", bench_queries[query]), CELL("rays", rays),
                CELL("batch", job->batch[b] ? job->batch[b] : rays), CELL("ms", times.ms),
                CELL("ns_per_ray", 1e6 * times.ms / (double)rays),
                CELL("ns_per_ray_min", 1e6 * times.least_ms / (double)rays), CELL("build_ms", times.build_ms),
                CELL("build_min_ms", times.least_build_ms),
                CELL("mrays_with_build", 1e-3 * (double)rays / (times.least_build_ms + times.least_ms)),
                CELL("ratio", embree.ms / times.ms),
                CELL("ratio_builds", (embree.ms + embree.build_ms) / (times.ms + times.build_ms)),
                CELL("order_ms", set->order_ms), CELL("hits", row->hits), CELL("different", row->different));
    write_visits(t, row, job->table);
    bench_library_cells(t, job->table);
}

void sets_write_rows(sets_job *job, const bench_set *set)
{
    for (size_t i = 0; i < job->session.tracers; i++)
        for (size_t b = 0; b < job->batches; b++)
            if (is_measured(job, i, set) && (!job->session.way[i].is_candidate || fastest(job, set, b, 1) == (int)i))
                write_row(job, i, set, b);
}
