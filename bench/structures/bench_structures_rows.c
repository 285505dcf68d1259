/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The list of what cgt-bench structures compares, and how one row builds and traces. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "structures/bench_structures.h"
#include "common/bench_timing.h"

#define LARGEST_PACKET 16u

/* ---- The list ------------------------------------------------------------------------------------------------ */

static structures_row *add_row(structures_job *job)
{
    structures_row *row = &job->rows[job->row_count++];
    row->group = job->group_count - 1;
    row->packet = job->settings->shared.packet;
    return row;
}

/* By both loops: the library takes the nested one. */
static void add_queue_grid(structures_job *job)
{
    add_row(job);
    add_row(job)->loop = CGT_LOOP_FLATTENED;
}

/* A camera's frame by whole tiles, and by packets; there are none but packets where their size is asked for. */
static void add_loose_grid(structures_job *job)
{
    add_row(job);
    if (!job->settings->shared.packet)
        add_row(job)->packet = LARGEST_PACKET;
}

static void add_tree(structures_job *job)
{
    static const cgt_kd_traversal traversals[] = {CGT_KD_TRAVERSAL_SINGLE, CGT_KD_TRAVERSAL_PACKET};
    const cgt_kd_traversal asked = job->settings->structure.kd.traversal;
    if (asked != CGT_KD_TRAVERSAL_AUTO)
        add_row(job)->traversal = asked;
    else
        for (size_t i = 0; i < sizeof traversals / sizeof traversals[0]; i++)
            add_row(job)->traversal = traversals[i];
}

static void add_group(structures_job *job, cgt_structure structure, cgt_ray_kind rays, const bench_kd_choice *kd)
{
    structures_group *group = &job->groups[job->group_count++];
    group->structure = structure;
    group->rays = rays;
    group->kd = *kd;
    if (structure == CGT_STRUCTURE_QUEUE_GRID)
        add_queue_grid(job);
    else if (structure == CGT_STRUCTURE_LOOSE_GRID)
        add_loose_grid(job);
    else if (structure == CGT_STRUCTURE_KD || structure == CGT_STRUCTURE_KD_ROPES)
        add_tree(job);
    else
        add_row(job);
}

/* A kd-tree in all layouts by both builders. */
static void add_all(structures_job *job, cgt_structure structure)
{
    static const cgt_kd_builder builders[] = {CGT_KD_BUILDER_BINNED, CGT_KD_BUILDER_SWEEP};
    static const cgt_kd_layout layouts[] = {CGT_KD_LAYOUT_DEPTH_FIRST, CGT_KD_LAYOUT_BREADTH_FIRST,
                                            CGT_KD_LAYOUT_MIXED};
    for (size_t b = 0; b < sizeof builders / sizeof builders[0]; b++)
        for (size_t l = 0; l < sizeof layouts / sizeof layouts[0]; l++)
            add_group(job, structure, CGT_RAY_KIND_COHERENT,
                      &(bench_kd_choice){.builder = builders[b], .layout = layouts[l]});
}

static void add_structure(structures_job *job, cgt_structure structure)
{
    bench_kd_choice kd = {.builder = CGT_KD_BUILDER_AUTO};
    if (structure == CGT_STRUCTURE_KD || structure == CGT_STRUCTURE_KD_ROPES) {
        if (job->settings->all) {
            add_all(job, structure);
            return;
        }
        kd = job->settings->structure.kd;
        if (kd.builder == CGT_KD_BUILDER_AUTO)
            kd.builder = CGT_KD_BUILDER_BINNED;
    }
    add_group(job, structure, CGT_RAY_KIND_COHERENT, &kd);
    if (structure == CGT_STRUCTURE_AUTO)
        add_group(job, structure, CGT_RAY_KIND_INCOHERENT, &kd);
}

int structures_plan(structures_job *job)
{
    static const cgt_structure everything[] = {CGT_STRUCTURE_QUEUE_GRID, CGT_STRUCTURE_LOOSE_GRID, CGT_STRUCTURE_KD,
                                               CGT_STRUCTURE_KD_ROPES,   CGT_STRUCTURE_BVH,        CGT_STRUCTURE_AUTO};
    const bench_structure_settings *asked = &job->settings->structure;
    const size_t values = job->input.frames * job->settings->shared.repeat;
    for (size_t i = 0; i < (asked->count ? asked->count : sizeof everything / sizeof everything[0]); i++)
        add_structure(job, asked->count ? asked->asked[i] : everything[i]);
    int complete = 1;
    for (size_t r = 0; r < job->row_count; r++)
        for (int column = 0; column < STRUCTURES_COLUMNS; column++)
            complete &= (job->rows[r].ms[column] = calloc(values, sizeof(double))) != NULL;
    if (!complete)
        program_error("%s: out of memory for %zu measurements of %zu rows", job->path, values, job->row_count);
    return complete ? PROGRAM_OK : PROGRAM_FAILED;
}

void structures_plan_release(structures_job *job)
{
    for (size_t r = 0; r < job->row_count; r++)
        for (int column = 0; column < STRUCTURES_COLUMNS; column++)
            free(job->rows[r].ms[column]);
    job->group_count = job->row_count = 0;
}

/* ---- Names --------------------------------------------------------------------------------------------------- */

static bench_choice choice_of(const structures_job *job, const structures_row *row)
{
    const structures_group *group = &job->groups[row->group];
    bench_choice choice = {.variant = job->variant, .packet = row->packet, .loop = row->loop, .kd = group->kd};
    choice.kd.traversal = row->traversal;
    return choice;
}

void structures_row_name(const structures_job *job, const structures_row *row, char name[BENCH_NAME_SIZE])
{
    const structures_group *group = &job->groups[row->group];
    bench_choice choice = choice_of(job, row);
    if (choice.kd.layout == CGT_KD_LAYOUT_AUTO)
        choice.kd.layout = group->research.kd_layout; /* what the library took */
    if (group->structure != CGT_STRUCTURE_AUTO) {
        bench_choice_name(&choice, group->structure, name);
        return;
    }
    char without[BENCH_NAME_SIZE]; /* the name of no structure: all behind it is what was set */
    bench_choice_name(&choice, CGT_STRUCTURE_AUTO, without);
    snprintf(name, BENCH_NAME_SIZE, "auto%s%s", group->rays == CGT_RAY_KIND_INCOHERENT ? ",rays=incoherent" : "",
             without + strcspn(without, ","));
}

/* ---- Building ------------------------------------------------------------------------------------------------ */

cgt_result structures_commit(structures_job *job, structures_group *group, uint32_t count, double *ms)
{
    return bench_scene_build(&job->scene, group, count, job->settings->shared.resolution, job->path, ms);
}

/* ---- Tracing ------------------------------------------------------------------------------------------------- */

/* Adds a run's counts; what is not a count is of the last run. */
static void add_counts(bench_counts *total, const bench_counts *run)
{
    const bench_counts before = *total;
    *total = *run;
    total->trace.rays += before.trace.rays;
    total->research.nodes += before.research.nodes;
    total->research.leaves += before.research.leaves;
    total->trace.ray_tests += before.trace.ray_tests;
    total->research.rope_steps += before.research.rope_steps;
    total->research.exact_steps += before.research.exact_steps;
    total->research.rope_loops += before.research.rope_loops;
}

/* The options of a trace; run: where its counts go, NULL where nothing is counted. Arrays of rays have no packets of
 * pixels to choose. */
static void make_options(const structures_job *job, const structures_row *row, int pixels, bench_counts *run,
                         cgt_trace_options *trace, cgt_research_trace_options *research)
{
    bench_choice choice = choice_of(job, row);
    if (!pixels)
        choice.packet = 0;
    if (run)
        memset(run, 0, sizeof *run);
    bench_choice_options(&choice, run, trace, research);
}

cgt_result structures_trace_primary(structures_job *job, const structures_row *row, structures_results *results,
                                    bench_counts *counts, double ms[STRUCTURES_COLUMNS])
{
    cgt_trace_options trace;
    cgt_research_trace_options research;
    bench_counts run;
    cgt_frame frame;
    make_options(job, row, 1, counts ? &run : NULL, &trace, &research);
    structures_planes_reset(results);
    bench_planes_frame(&results->planes, &frame);
    frame.geometry = results->geometry;
    const double begin = bench_now_ms();
    const cgt_result result = cgt_trace_camera(job->scene.scene, &job->settings->shared.camera, &frame, &trace);
    ms[STRUCTURES_PRIMARY] = bench_now_ms() - begin;
    if (result == CGT_OK && counts)
        add_counts(&counts[STRUCTURES_PRIMARY], &run);
    return result;
}

static cgt_result trace_occluded(structures_job *job, const structures_row *row, const structures_rays *rays,
                                 structures_occluded *occluded, bench_counts *total, double *ms)
{
    cgt_trace_options trace;
    cgt_research_trace_options research;
    bench_counts run;
    const cgt_rays array = structures_rays_array(rays);
    make_options(job, row, 0, total ? &run : NULL, &trace, &research);
    if (structures_occluded_reset(occluded, array.count))
        return CGT_ERROR_OUT_OF_MEMORY;
    if (!array.count)
        return CGT_OK;
    const double begin = bench_now_ms();
    const cgt_result result = cgt_occluded_rays(job->scene.scene, &array, occluded->occluded, &trace);
    *ms = bench_now_ms() - begin;
    if (result == CGT_OK && total)
        add_counts(total, &run);
    return result;
}

static cgt_result trace_random(structures_job *job, const structures_row *row, structures_hits *hits,
                               bench_counts *total, double *ms)
{
    cgt_trace_options trace;
    cgt_research_trace_options research;
    bench_counts run;
    const cgt_rays array = structures_rays_array(&job->random);
    make_options(job, row, 0, total ? &run : NULL, &trace, &research);
    if (structures_hits_reset(hits, array.count))
        return CGT_ERROR_OUT_OF_MEMORY;
    if (!array.count)
        return CGT_OK;
    const cgt_hits into = {.t = hits->t, .primitive = hits->primitive, .geometry = hits->geometry};
    const double begin = bench_now_ms();
    const cgt_result result = cgt_trace_rays(job->scene.scene, &array, &into, &trace);
    *ms = bench_now_ms() - begin;
    if (result == CGT_OK && total)
        add_counts(total, &run);
    return result;
}

cgt_result structures_trace_others(structures_job *job, const structures_row *row, structures_results *results,
                                   bench_counts *counts, double ms[STRUCTURES_COLUMNS])
{
    cgt_result result = trace_occluded(job, row, &job->shadow, &results->shadow,
                                       counts ? &counts[STRUCTURES_SHADOW] : NULL, &ms[STRUCTURES_SHADOW]);
    if (result == CGT_OK)
        result = trace_occluded(job, row, &job->ao, &results->ao, counts ? &counts[STRUCTURES_AO] : NULL,
                                &ms[STRUCTURES_AO]);
    if (result == CGT_OK)
        result = trace_random(job, row, &results->random, counts ? &counts[STRUCTURES_RANDOM] : NULL,
                              &ms[STRUCTURES_RANDOM]);
    return result;
}

cgt_result structures_make_rays(structures_job *job, const structures_group *group)
{
    const structures_settings *settings = job->settings;
    cgt_result result = CGT_OK;
    if (settings->lit)
        result = structures_rays_shadow(&job->shadow, job->maker, settings->light);
    if (result == CGT_OK && settings->ao)
        result = structures_rays_ao(&job->ao, job->maker, settings->ao);
    if (result == CGT_OK)
        result =
            structures_rays_random(&job->random, settings->random, group->built.bounds_min, group->built.bounds_max);
    return result;
}
