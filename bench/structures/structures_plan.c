/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The list of configurations that cgt-bench structures compares. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "structures/bench_structures.h"

#define LARGEST_PACKET 16u

static int is_kd(cgt_structure structure)
{
    return structure == CGT_STRUCTURE_KD || structure == CGT_STRUCTURE_KD_ROPES;
}

/* ---- The list ------------------------------------------------------------------------------------------------ */

/* A row of the last group. */
static structures_row *add_row(structures_job *job)
{
    structures_row *row = &job->rows[job->row_count++];
    row->group = &job->groups[job->group_count - 1];
    row->choice = bench_choice_of(&job->settings->shared, &job->settings->structure, NULL);
    row->choice.variant = cgt_context_get_variant(job->context);
    row->choice.kd = row->group->build.kd;
    return row;
}

/* A row for each way to traverse the last group: both loops of a queue grid; in a loose grid a camera's frame by whole
 * tiles and by packets; single rays and packets of trees. */
static void add_traversals(structures_job *job, cgt_structure structure)
{
    const bench_kd_choice *kd = &job->settings->structure.kd;
    structures_row *row = add_row(job);
    if (structure == CGT_STRUCTURE_QUEUE_GRID)
        add_row(job)->choice.loop = CGT_LOOP_FLATTENED;
    else if (structure == CGT_STRUCTURE_LOOSE_GRID && !job->settings->shared.packet)
        add_row(job)->choice.packet = LARGEST_PACKET;
    else if ((is_kd(structure) || structure == CGT_STRUCTURE_BIH) && kd->traversal == CGT_KD_TRAVERSAL_AUTO) {
        row->choice.kd.traversal = CGT_KD_TRAVERSAL_SINGLE;
        add_row(job)->choice.kd.traversal = CGT_KD_TRAVERSAL_PACKET;
    }
}

static void add_group(structures_job *job, cgt_structure structure, cgt_ray_kind rays, const bench_kd_choice *kd)
{
    structures_group *group = &job->groups[job->group_count++];
    group->build.structure = structure;
    group->build.rays = rays;
    group->build.kd = *kd;
    if (job->settings->traversals)
        add_traversals(job, structure);
    else
        add_row(job);
}

/* A kd-tree in all layouts. */
static void add_layouts(structures_job *job, cgt_structure structure)
{
    static const cgt_kd_layout layouts[] = {CGT_KD_LAYOUT_DEPTH_FIRST, CGT_KD_LAYOUT_BREADTH_FIRST,
                                            CGT_KD_LAYOUT_MIXED};
    for (size_t l = 0; l < sizeof layouts / sizeof layouts[0]; l++) {
        bench_kd_choice kd = job->settings->structure.kd;
        kd.layout = layouts[l];
        add_group(job, structure, CGT_RAY_KIND_COHERENT, &kd);
    }
}

static void add_structure(structures_job *job, cgt_structure structure)
{
    const bench_kd_choice *kd = &job->settings->structure.kd;
    if (is_kd(structure) && job->settings->layouts) {
        add_layouts(job, structure);
        return;
    }
    add_group(job, structure, CGT_RAY_KIND_COHERENT, kd);
    if (structure == CGT_STRUCTURE_AUTO)
        add_group(job, structure, CGT_RAY_KIND_INCOHERENT, kd);
}

/* ---- Scenes and room ----------------------------------------------------------------------------------------- */

static cgt_result prepare_group(structures_job *job, structures_group *group)
{
    const bench_settings *shared = &job->settings->shared;
    group->build_ms = calloc(shared->repeat, sizeof *group->build_ms);
    const cgt_result result = bench_scene_create(&group->scene, job->context, job->input.moving, shared->resolution);
    bench_scene_set_triangles(&group->scene, job->input.index, job->input.triangles);
    return result == CGT_OK && !group->build_ms ? CGT_ERROR_OUT_OF_MEMORY : result;
}

static cgt_result prepare_row(const structures_job *job, structures_row *row)
{
    for (size_t b = 0; b < job->settings->batches; b++)
        if (!(row->trace_ms[b] = calloc(job->settings->shared.repeat, sizeof(double))))
            return CGT_ERROR_OUT_OF_MEMORY;
    return CGT_OK;
}

cgt_result structures_plan(structures_job *job)
{
    const bench_structure_settings *named = &job->settings->structure;
    cgt_result result = CGT_OK;
    for (size_t i = 0; i < named->count; i++)
        add_structure(job, named->requested[i]);
    for (size_t g = 0; g < job->group_count && result == CGT_OK; g++)
        result = prepare_group(job, &job->groups[g]);
    for (size_t r = 0; r < job->row_count && result == CGT_OK; r++)
        result = prepare_row(job, &job->rows[r]);
    return result;
}

void structures_plan_release(structures_job *job)
{
    for (size_t r = 0; r < job->row_count; r++)
        for (size_t b = 0; b < STRUCTURES_MOST_BATCHES; b++)
            free(job->rows[r].trace_ms[b]);
    for (size_t g = 0; g < job->group_count; g++) {
        bench_scene_release(&job->groups[g].scene);
        free(job->groups[g].build_ms);
    }
    job->group_count = job->row_count = 0;
}

/* ---- Names --------------------------------------------------------------------------------------------------- */

/* AUTO is "auto" for any choice of the library, with the kind of rays that it was given. */
void structures_name_row(structures_row *row)
{
    const bench_build *build = &row->group->build;
    char name[BENCH_NAME_SIZE];
    bench_choice_name(&row->choice, build->structure, name);
    if (build->structure != CGT_STRUCTURE_AUTO)
        memcpy(row->config, name, sizeof row->config);
    else
        snprintf(row->config, sizeof row->config, "auto%s%s",
                 build->rays == CGT_RAY_KIND_INCOHERENT ? ",rays=incoherent" : "", name + strcspn(name, ","));
}
