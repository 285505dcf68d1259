/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Structures built and rows traced in turns, so that a slow moment of the machine affects all alike; backwards in every
 * other round, so that none always follows the same one. The first round of each is not timed: it warms up, counts what
 * rays visit, and its first row gives the hits that all others must find. */
#include <string.h>

#include "common/bench_timing.h"
#include "structures/bench_structures.h"

enum { MOST_MESSAGES = 10 }; /* about differing hits; the last line has the total */

const structures_group *structures_first(const structures_job *job)
{
    for (size_t g = 0; g < job->group_count; g++)
        if (!job->groups[g].build.left_out)
            return &job->groups[g];
    return NULL;
}

cgt_result structures_build(structures_job *job)
{
    const bench_settings *shared = &job->settings->shared;
    for (uint32_t round = 0; round <= shared->repeat; round++)
        for (size_t step = 0; step < job->group_count; step++) {
            structures_group *group = &job->groups[round & 1 ? job->group_count - 1 - step : step];
            double ms;
            if (group->build.left_out)
                continue;
            const cgt_result result =
                bench_scene_build(&group->scene, &group->build, job->count, shared->resolution, job->path, &ms);
            if (result != CGT_OK)
                return result;
            if (round > 0)
                group->build_ms[round - 1] = ms;
        }
    for (size_t r = 0; r < job->row_count; r++)
        structures_name_row(&job->rows[r]);
    return CGT_OK;
}

/* ---- Tracing ------------------------------------------------------------------------------------------------- */

static found_form form_of(const structures_set *set)
{
    return set->kind == STRUCTURES_FRAME ? FOUND_FRAME : set->query == STRUCTURES_ANY ? FOUND_OCCLUDED : FOUND_HITS;
}

static cgt_result trace_frame(const structures_job *job, const cgt_scene *scene, const cgt_trace_options *options)
{
    cgt_frame frame;
    bench_planes_frame(&job->found.planes, &frame);
    return cgt_trace_camera(scene, &job->settings->shared.camera, &frame, options);
}

/* A call of one ray, for programs that have no more at a time. */
static cgt_result trace_single(const structures_job *job, const cgt_scene *scene, const cgt_rays *call, uint64_t i,
                               const cgt_trace_options *options)
{
    const structures_found *found = &job->found;
    const cgt_single_ray ray = {.org = {call->org[0][0], call->org[1][0], call->org[2][0]},
                                .dir = {call->dir[0][0], call->dir[1][0], call->dir[2][0]},
                                .t_max = call->t_max ? call->t_max[0] : 0};
    cgt_single_hit hit;
    bool occluded = false;
    if (job->set.query == STRUCTURES_ANY) {
        const cgt_result result = cgt_occluded_ray(scene, &ray, &occluded, options);
        found->occluded[i] = occluded;
        return result;
    }
    const cgt_result result = cgt_trace_ray(scene, &ray, &hit, options);
    if (result == CGT_OK) {
        found->t[i] = hit.t;
        found->primitive[i] = hit.primitive;
    }
    return result;
}

/* One call for `count` rays of the set from `first` on. */
static cgt_result trace_call(const structures_job *job, const cgt_scene *scene, uint64_t first, uint64_t count,
                             const cgt_trace_options *options)
{
    const structures_found *found = &job->found;
    cgt_rays call = bench_ray_array_view(&job->set.ordered);
    call.count = count;
    for (int a = 0; a < 3; a++) {
        call.org[a] += first;
        call.dir[a] += first;
    }
    call.t_max = call.t_max ? call.t_max + first : NULL;
    if (count == 1)
        return trace_single(job, scene, &call, first, options);
    if (job->set.query == STRUCTURES_ANY)
        return cgt_occluded_rays(scene, &call, found->occluded + first, options);
    const cgt_hits hits = {.t = found->t + first, .primitive = found->primitive + first};
    return cgt_trace_rays(scene, &call, &hits, options);
}

static void add_counts(bench_counts *total, const bench_counts *call)
{
    total->trace.rays += call->trace.rays;
    total->trace.ray_tests += call->trace.ray_tests;
    total->research.nodes += call->research.nodes;
    total->research.leaves += call->research.leaves;
    total->research.rope_steps += call->research.rope_steps;
    total->research.exact_steps += call->research.exact_steps;
    total->research.rope_loops += call->research.rope_loops;
}

/* All rays of the set, call by call. total: gets the counts; NULL: nothing is counted. */
static cgt_result trace_all(structures_job *job, const structures_row *row, uint64_t batch, bench_counts *total,
                            double *ms)
{
    const structures_set *set = &job->set;
    const cgt_scene *scene = row->group->scene.scene;
    bench_counts counts;
    cgt_trace_options options;
    cgt_research_trace_options research;
    bench_choice choice = row->choice;
    cgt_result result = CGT_OK;
    if (set->kind != STRUCTURES_FRAME)
        choice.packet = 0; /* of pixels */
    bench_choice_options(&choice, total ? &counts : NULL, &options, &research);
    if (structures_found_reset(&job->found, form_of(set), set->count))
        return CGT_ERROR_OUT_OF_MEMORY;
    const double begin = bench_now_ms();
    for (uint64_t first = 0; first < set->count && result == CGT_OK; first += batch) {
        if (total)
            memset(&counts, 0, sizeof counts);
        result = set->kind == STRUCTURES_FRAME
                     ? trace_frame(job, scene, &options)
                     : trace_call(job, scene, first, set->count - first < batch ? set->count - first : batch, &options);
        if (total)
            add_counts(total, &counts);
    }
    *ms = bench_now_ms() - begin;
    return result;
}

/* Compares a row's hits with the first row's. */
static void compare(structures_job *job, structures_row *row)
{
    const found_form form = form_of(&job->set);
    char text[400];
    if (!job->expecting) {
        const structures_found found = job->expected;
        job->expected = job->found;
        job->found = found;
        job->expecting = 1;
        job->hits = structures_found_hits(&job->expected, form, job->set.count);
        return;
    }
    const uint64_t different =
        structures_found_differ(&job->expected, &job->found, form, job->set.count, text, sizeof text);
    if (different && job->messages++ < MOST_MESSAGES)
        program_error("%s: %s: %s", job->path, row->config, text);
    row->different += different;
    job->different += different;
    job->compared += job->set.count;
}

static cgt_result trace_row(structures_job *job, structures_row *row, uint32_t round, size_t b)
{
    double ms;
    const cgt_result result = trace_all(job, row, job->batch[b], round ? NULL : &row->count, &ms);
    if (result != CGT_OK)
        return result;
    compare(job, row);
    if (round > 0)
        row->trace_ms[b][round - 1] = ms;
    return CGT_OK;
}

cgt_result structures_trace_set(structures_job *job, structures_query query)
{
    const uint32_t repeat = job->settings->shared.repeat;
    job->set.query = query;
    job->expecting = 0;
    for (size_t r = 0; r < job->row_count; r++) {
        job->rows[r].different = 0;
        memset(&job->rows[r].count, 0, sizeof job->rows[r].count);
    }
    for (uint32_t round = 0; round <= repeat; round++)
        for (size_t b = round ? 0 : job->batches - 1; b < job->batches; b++)
            for (size_t step = 0; step < job->row_count; step++) {
                structures_row *row = &job->rows[round & 1 ? job->row_count - 1 - step : step];
                const cgt_result result = row->group->build.left_out ? CGT_OK : trace_row(job, row, round, b);
                if (result != CGT_OK)
                    return result;
            }
    return CGT_OK;
}
