/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench loops: the ways to traverse a grid against each other, interleaved frame by frame in one process, so that a
 * slow moment of the machine affects all of them alike. Every run's hits are compared bit by bit with the first one's.
 *
 * First every configuration counts its steps in runs that are not timed; then the timed runs, which count nothing. */
#include "loops/bench_loops.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_input.h"
#include "rays/bench_planes.h"
#include "common/bench_scene.h"
#include "common/bench_timing.h"

enum { MOST_MESSAGES = 10 }; /* about differing hits; the last line has the total */

typedef struct loops_job {
    const bench_settings *settings;
    bench_input input;
    bench_plan plan;
    bench_planes planes;
    uint64_t *hash;     /* of each frame's hits, as the first run of the first configuration found them */
    uint64_t compared;  /* runs whose hits were compared with that */
    uint64_t different; /* of those, runs with different bits */
} loops_job;

/* ---- Runs ---------------------------------------------------------------------------------------------------- */

/* Adds a run's counts. Fields that are not counts keep the last run's values. */
static void add_counts(bench_counts *total, const bench_counts *run)
{
    const bench_counts before = *total;
    *total = *run;
    total->trace.rays += before.trace.rays;
    total->trace.packet_tests += before.trace.packet_tests;
    total->trace.ray_tests += before.trace.ray_tests;
    total->research.slices += before.research.slices;
    total->research.cells += before.research.cells;
    total->research.references += before.research.references;
    total->research.mailbox_skipped += before.research.mailbox_skipped;
}

/* Compares the hits of the run just made with those of the frame's first run. */
static void compare_hits(loops_job *job, const bench_row *row, size_t frame)
{
    const uint64_t hash = bench_planes_hash(&job->planes);
    job->compared++;
    if (hash == job->hash[frame])
        return;
    if (++job->different > MOST_MESSAGES)
        return;
    char name[BENCH_NAME_SIZE];
    bench_choice_name(&row->choice, CGT_STRUCTURE_QUEUE_GRID, name);
    program_error("frame %zu: %s finds other hits than the first configuration: hash %016llx, not %016llx", frame, name,
                  (unsigned long long)hash, (unsigned long long)job->hash[frame]);
}

/* Traces a row. counts: NULL in timed runs. */
static cgt_result trace_row(loops_job *job, bench_row *row, bench_counts *counts, double *ms)
{
    cgt_trace_options options;
    cgt_research_trace_options research;
    cgt_frame frame;
    bench_choice_options(&row->choice, counts, &options, &research);
    bench_planes_frame(&job->planes, &frame);
    /* Hits left from the previous run must not count for this one: no primitive has this number. */
    memset(job->planes.primitive, 0xfe, (size_t)job->planes.width * job->planes.height * sizeof *job->planes.primitive);
    const double start = bench_now_ms();
    const cgt_result result =
        cgt_trace_camera(job->plan.groups[row->group].scene.scene, &job->settings->camera, &frame, &options);
    *ms = bench_now_ms() - start;
    return result;
}

/* Counts the steps of all rows in one frame; the first row's hits become the frame's. */
static cgt_result count_frame(loops_job *job, size_t frame, size_t *row_failed)
{
    bench_plan *plan = &job->plan;
    const uint32_t count = bench_input_move(&job->input, frame);
    double ms;
    for (size_t i = 0; i < plan->row_count; i++) {
        bench_row *row = &plan->rows[i];
        bench_counts counts;
        cgt_result result = CGT_OK;
        memset(&counts, 0, sizeof counts);
        *row_failed = i;
        if (i == 0 || row->group != plan->rows[i - 1].group)
            result = bench_group_commit(&plan->groups[row->group], count, &ms);
        if (result == CGT_OK)
            result = trace_row(job, row, &counts, &ms);
        if (result != CGT_OK)
            return result;
        add_counts(&row->total, &counts);
        if (i == 0)
            job->hash[frame] = bench_planes_hash(&job->planes);
        else
            compare_hits(job, row, frame);
    }
    return CGT_OK;
}

/* Times all rows in one frame; backwards in every other frame, so that no row always follows the same one. */
static cgt_result time_frame(loops_job *job, size_t frame, int backwards, int keep, size_t *row_failed)
{
    bench_plan *plan = &job->plan;
    const uint32_t count = bench_input_move(&job->input, frame);
    size_t committed = SIZE_MAX;
    for (size_t step = 0; step < plan->row_count; step++) {
        const size_t i = backwards ? plan->row_count - 1 - step : step;
        bench_row *row = &plan->rows[i];
        bench_group *group = &plan->groups[row->group];
        cgt_result result = CGT_OK;
        double build = 0.0, trace = 0.0;
        *row_failed = i;
        if (row->group != committed) {
            result = bench_group_commit(group, count, &build);
            committed = row->group;
            if (keep)
                group->build_ms[plan->measured] = build;
        }
        if (result == CGT_OK)
            result = trace_row(job, row, NULL, &trace);
        if (result != CGT_OK)
            return result;
        if (keep)
            row->trace_ms[plan->measured] = trace;
        compare_hits(job, row, frame);
    }
    plan->measured += keep != 0;
    return CGT_OK;
}

static int run_all(loops_job *job)
{
    const size_t frames = job->input.frames;
    const uint32_t repeat = job->settings->repeat;
    cgt_result result = CGT_OK;
    size_t row = 0;

    for (size_t i = 0; i < frames && result == CGT_OK; i++)
        result = count_frame(job, i, &row);
    for (uint32_t round = 0; round < repeat && result == CGT_OK; round++)
        for (size_t i = 0; i < frames && result == CGT_OK; i++) {
            const int warms_up = round == 0 && i == 0 && (frames > 1 || repeat > 1);
            result = time_frame(job, i, (int)((round + i) & 1), !warms_up, &row);
        }
    if (result == CGT_OK)
        return PROGRAM_OK;
    char name[BENCH_NAME_SIZE];
    bench_choice_name(&job->plan.rows[row].choice, CGT_STRUCTURE_QUEUE_GRID, name);
    return bench_scene_failed(job->plan.groups[job->plan.rows[row].group].context, name, result);
}

/* ---- Command ------------------------------------------------------------------------------------------------- */

static int prepare(loops_job *job)
{
    const bench_settings *settings = job->settings;
    if (bench_input_load_file(&job->input, settings, settings->paths[0]))
        return PROGRAM_FAILED;
    const size_t frames = job->input.frames;
    if (settings->repeat > SIZE_MAX / frames || bench_planes_create(&job->planes, settings->width, settings->height) ||
        !(job->hash = calloc(frames, sizeof *job->hash))) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    const int code = bench_plan_create(&job->plan, settings, job->input.moving, frames * settings->repeat);
    for (size_t i = 0; code == PROGRAM_OK && i < job->plan.group_count; i++)
        bench_scene_set_triangles(&job->plan.groups[i].scene, job->input.index, job->input.triangles);
    return code;
}

static int report(const loops_job *job)
{
    bench_table *table = bench_table_open(job->settings->json_path);
    uint64_t hash = 0;
    if (!table)
        return PROGRAM_FAILED;
    const int failed =
        bench_report_table(&job->plan, job->input.frames, table) || bench_report_ratios(&job->plan, table);
    if (failed)
        program_error("out of memory");
    if (bench_table_close(table) || failed)
        return PROGRAM_FAILED;
    for (size_t i = 0; i < job->input.frames; i++)
        hash = (hash ^ job->hash[i]) * 0x9e3779b97f4a7c15u;
    printf("#\n# hits\t%zu frames\t%zu configurations\t%llu traces compared\t%llu different\thash %016llx\n",
           job->input.frames, job->plan.row_count, (unsigned long long)job->compared,
           (unsigned long long)job->different, (unsigned long long)hash);
    return job->different ? PROGRAM_FAILED : PROGRAM_OK;
}

int bench_loops(int argc, char **argv)
{
    static const struct argp_child children[] = {{&bench_settings_argp, 0, NULL, 0}, {NULL, 0, NULL, 0}};
    /* Without a parser of its own, argp hands the input to the first child. */
    static const struct argp parser = {
        .args_doc = "FILE",
        .children = children,
        .doc = "Compares the ways to traverse: nested and flattened loops, culling, mailboxing, packet sizes, grid "
               "resolutions, in every variant that the CPU runs. FILE is a trajectory: .frames, .lammpstrj, .xyz, or a "
               "mesh. "
               "The configurations take turns frame by frame. -k, -g and --variant narrow the list. Fails where "
               "any of them finds other hits than the first."};
    bench_settings settings;
    loops_job job;

    bench_settings_init(&settings);
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    memset(&job, 0, sizeof job);
    job.settings = &settings;
    int code = prepare(&job);
    if (code == PROGRAM_OK)
        code = run_all(&job);
    if (code == PROGRAM_OK)
        code = report(&job);

    bench_plan_release(&job.plan);
    bench_planes_release(&job.planes);
    free(job.hash);
    bench_input_release(&job.input);
    return code;
}
