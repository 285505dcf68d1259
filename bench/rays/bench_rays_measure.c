/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Structures built and traced in turns, so that a slow moment of the machine meets all of them alike; backwards in every
 * other round, so that none always follows the same one. A first round of each is not timed: it warms up. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rays/bench_rays.h"
#include "common/bench_timing.h"

/* The one whose turn it is; NULL where the library does not have it. */
static sweep_subject *turn_of(sweep_job *job, uint32_t round, size_t step)
{
    sweep_subject *subject = &job->subjects[round & 1 ? job->subject_count - 1 - step : step];
    return subject->build.left_out ? NULL : subject;
}

const sweep_subject *sweep_first(const sweep_job *job)
{
    for (size_t i = 0; i < job->subject_count; i++)
        if (!job->subjects[i].build.left_out)
            return &job->subjects[i];
    return NULL;
}

/* ---- Building ------------------------------------------------------------------------------------------------ */

cgt_result sweep_build(sweep_job *job)
{
    const bench_settings *shared = &job->settings->shared;
    const uint32_t repeat = shared->repeat;
    for (uint32_t round = 0; round <= repeat; round++)
        for (size_t step = 0; step < job->subject_count; step++) {
            sweep_subject *subject = turn_of(job, round, step);
            double ms;
            const cgt_result result = subject ? bench_scene_build(&subject->scene, &subject->build, job->count,
                                                                  shared->resolution, shared->path, &ms)
                                              : CGT_OK;
            if (result != CGT_OK)
                return result;
            if (subject && round > 0)
                subject->build_ms[round - 1] = ms;
        }
    return CGT_OK;
}

/* ---- Tracing ------------------------------------------------------------------------------------------------- */

static cgt_result trace_call(const sweep_job *job, const cgt_scene *scene, sweep_query query, uint64_t first,
                             uint64_t count, const cgt_trace_options *options)
{
    const sweep_found *found = &job->found;
    cgt_rays call = structures_rays_array(&job->rays.ordered);
    call.count = count;
    for (int a = 0; a < 3; a++) {
        call.org[a] += first;
        call.dir[a] += first;
    }
    call.t_max = call.t_max ? call.t_max + first : NULL;
    if (query == SWEEP_ANY)
        return cgt_occluded_rays(scene, &call, found->occluded.occluded + first, options);
    const cgt_hits hits = {.t = found->hits.t + first, .primitive = found->hits.primitive + first};
    return cgt_trace_rays(scene, &call, &hits, options);
}

/* All rays of the set, call by call. */
static cgt_result trace_set(sweep_job *job, const sweep_subject *subject, sweep_query query, uint64_t batch, double *ms)
{
    const bench_choice choice = {.kd = subject->build.kd};
    const uint64_t count = job->rays.count;
    cgt_trace_options options;
    cgt_research_trace_options research;
    cgt_result result = CGT_OK;
    bench_choice_options(&choice, NULL, &options, &research);
    if (query == SWEEP_ANY ? structures_occluded_reset(&job->found.occluded, count)
                           : structures_hits_reset(&job->found.hits, count))
        return CGT_ERROR_OUT_OF_MEMORY;
    const double begin = bench_now_ms();
    for (uint64_t first = 0; first < count && result == CGT_OK; first += batch)
        result = trace_call(job, subject->scene.scene, query, first, count - first < batch ? count - first : batch,
                            &options);
    *ms = bench_now_ms() - begin;
    return result;
}

static uint64_t hits_of(const sweep_job *job, sweep_query query)
{
    uint64_t hits = 0;
    for (uint64_t i = 0; i < job->rays.count; i++)
        hits += query == SWEEP_ANY ? job->expected.occluded.occluded[i] : job->expected.hits.t[i] < INFINITY;
    return hits;
}

/* Rays that found something else than the first subject's, in any bit. */
static uint64_t differences(const sweep_job *job, sweep_query query)
{
    const sweep_found *a = &job->expected, *b = &job->found;
    uint64_t different = 0;
    for (uint64_t i = 0; i < job->rays.count; i++)
        different += query == SWEEP_ANY ? a->occluded.occluded[i] != b->occluded.occluded[i]
                                        : memcmp(&a->hits.t[i], &b->hits.t[i], sizeof(float)) != 0 ||
                                              a->hits.primitive[i] != b->hits.primitive[i];
    return different;
}

/* A subject's turn: the very first gives what all others are to find. */
static cgt_result take_turn(sweep_job *job, sweep_subject *subject, sweep_query query, uint64_t batch, double *ms)
{
    const cgt_result result = trace_set(job, subject, query, batch, ms);
    if (result != CGT_OK)
        return result;
    if (!job->expecting) {
        const sweep_found found = job->expected;
        job->expected = job->found;
        job->found = found;
        job->expecting = 1;
        job->hits = hits_of(job, query);
        return CGT_OK;
    }
    const uint64_t different = differences(job, query);
    subject->different += different;
    job->different += different;
    job->compared += job->rays.count;
    return CGT_OK;
}

cgt_result sweep_trace(sweep_job *job, sweep_query query)
{
    const uint32_t repeat = job->settings->shared.repeat;
    double ms;
    job->expecting = 0;
    for (size_t i = 0; i < job->subject_count; i++)
        job->subjects[i].different = 0;
    for (uint32_t round = 0; round <= repeat; round++)
        for (size_t b = round ? 0 : job->batches - 1; b < job->batches; b++)
            for (size_t step = 0; step < job->subject_count; step++) {
                sweep_subject *subject = turn_of(job, round, step);
                const cgt_result result = subject ? take_turn(job, subject, query, job->batch[b], &ms) : CGT_OK;
                if (result != CGT_OK)
                    return result;
                if (subject && round > 0)
                    subject->trace_ms[b][round - 1] = ms;
            }
    return CGT_OK;
}

void sweep_found_release(sweep_found *found)
{
    structures_hits_release(&found->hits);
    free(found->occluded.occluded);
}
