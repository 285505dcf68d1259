/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All rows over all frames. First a pass that counts and is not timed, which warms up, too; then the timed passes. In
 * each frame the rows take turns, so that a slow moment of the machine meets all of them alike; in timed passes
 * backwards in every other frame, so that no row always follows the same one. The frame's first row makes the rays; the
 * hits of all others are compared with its own. */
#include <stdio.h>
#include <string.h>

#include "structures/bench_structures.h"

enum { MOST_MESSAGES = 10 }; /* about other hits; the last line has the count of all */

typedef struct turn {
    size_t frame;
    uint32_t count; /* spheres or vertices */
    int timed;
    size_t committed;            /* group, or SIZE_MAX */
    const structures_row *first; /* whose results are expected; NULL: none yet */
    double build;                /* ms of the committed group */
} turn;

static void compare(structures_job *job, const structures_row *row, const turn *now)
{
    char text[2048], name[BENCH_NAME_SIZE], first[BENCH_NAME_SIZE];
    job->compared++;
    if (!structures_results_differ(&job->expected, &job->found, text, sizeof text))
        return;
    if (++job->different > MOST_MESSAGES)
        return;
    structures_row_name(job, row, name);
    structures_row_name(job, now->first, first);
    program_error("%s: frame %zu: %s finds other hits than %s: %s", job->path, now->frame, name, first, text);
}

static void keep_times(structures_job *job, structures_row *row, const double ms[STRUCTURES_COLUMNS])
{
    for (int column = 0; column < STRUCTURES_COLUMNS; column++)
        row->ms[column][job->measured] = ms[column];
}

/* A row's turn in a frame. */
static cgt_result measure_row(structures_job *job, structures_row *row, turn *now)
{
    structures_group *group = &job->groups[row->group];
    bench_counts *counts = now->timed ? NULL : row->count;
    double ms[STRUCTURES_COLUMNS] = {0.0};
    cgt_result result = CGT_OK;
    if (group->left_out)
        return CGT_OK;
    if (now->committed != row->group) {
        result = structures_commit(job, group, now->count, &now->build);
        now->committed = row->group;
        if (result != CGT_OK || group->left_out)
            return result;
    }
    structures_results *results = now->first ? &job->found : &job->expected;
    result = structures_trace_primary(job, row, results, counts, ms);
    if (result == CGT_OK && !now->first)
        result = structures_make_rays(job, group);
    if (result == CGT_OK)
        result = structures_trace_others(job, row, results, counts, ms);
    if (result != CGT_OK)
        return result;
    if (now->first)
        compare(job, row, now);
    else
        now->first = row;
    ms[STRUCTURES_BUILD] = now->build;
    for (int column = STRUCTURES_BUILD; column <= STRUCTURES_AO; column++)
        ms[STRUCTURES_FRAME] += ms[column];
    if (now->timed)
        keep_times(job, row, ms);
    return CGT_OK;
}

static cgt_result measure_frame(structures_job *job, size_t frame, int timed, int backwards, size_t *failed)
{
    turn now = {.frame = frame, .count = bench_input_move(&job->input, frame), .timed = timed, .committed = SIZE_MAX};
    cgt_result result = CGT_OK;
    for (size_t step = 0; step < job->row_count && result == CGT_OK; step++) {
        *failed = backwards ? job->row_count - 1 - step : step;
        result = measure_row(job, &job->rows[*failed], &now);
    }
    job->measured += result == CGT_OK && timed;
    return result;
}

int structures_measure(structures_job *job)
{
    const size_t frames = job->input.frames;
    cgt_result result = CGT_OK;
    size_t failed = 0, left = 0;
    for (size_t i = 0; i < frames && result == CGT_OK; i++)
        result = measure_frame(job, i, 0, 0, &failed);
    for (uint32_t round = 0; round < job->settings->shared.repeat; round++)
        for (size_t i = 0; i < frames && result == CGT_OK; i++)
            result = measure_frame(job, i, 1, (int)((round + i) & 1), &failed);
    if (result != CGT_OK) {
        char name[BENCH_NAME_SIZE], what[2 * BENCH_NAME_SIZE + 8];
        structures_row_name(job, &job->rows[failed], name);
        snprintf(what, sizeof what, "%s: %s", job->scene_name, name);
        return bench_scene_failed(job->context, what, result);
    }
    for (size_t g = 0; g < job->group_count; g++)
        left += !job->groups[g].left_out;
    if (!left)
        program_error("%s: no structure is left to measure", job->path);
    return left ? PROGRAM_OK : PROGRAM_FAILED;
}
