/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The list of configurations, and their scenes. */
#include "loops/bench_loops.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"

enum { AXIS_LIMIT = 1024, CELL_LIMIT = 16777216 }; /* of cgt_research_scene_options.resolution */

/* The grids of a plan without -g. */
static const struct grid {
    uint32_t edge;
    double scale;
} grids[] = {{0, 1.0}, {0, 0.5}, {0, 2.0}, {8, 1.0}, {12, 1.0}, {16, 1.0}, {24, 1.0}, {32, 1.0}};

enum { GRIDS = sizeof grids / sizeof grids[0], PACKETS = 3, SWITCHES = 6, LOOPS = 2 };
enum { MOST_ROWS_PER_GROUP = PACKETS * SWITCHES * LOOPS };

static const uint32_t packets[PACKETS] = {4, 8, 16};
static const struct {
    cgt_cull cull;
    cgt_mailbox mailbox;
} switches[SWITCHES] = {{CGT_CULL_BLOCKS, CGT_MAILBOX_ON},  {CGT_CULL_BLOCKS, CGT_MAILBOX_OFF},
                        {CGT_CULL_FRUSTUM, CGT_MAILBOX_ON}, {CGT_CULL_FRUSTUM, CGT_MAILBOX_OFF},
                        {CGT_CULL_NONE, CGT_MAILBOX_ON},    {CGT_CULL_NONE, CGT_MAILBOX_OFF}};
static const cgt_loop loops[LOOPS] = {CGT_LOOP_NESTED, CGT_LOOP_FLATTENED};

static void label_group(bench_group *group)
{
    const uint32_t *cells = group->requested;
    if (cells[0])
        snprintf(group->label, sizeof group->label, "%ux%ux%u", (unsigned)cells[0], (unsigned)cells[1],
                 (unsigned)cells[2]);
    else if (group->scale > 1.0 || group->scale < 1.0)
        snprintf(group->label, sizeof group->label, "auto*%g", group->scale);
    else
        snprintf(group->label, sizeof group->label, "auto");
}

/* A pair of rows, one per loop, for each setting: all packets and switches in the first grid; in the others only the
 * library's own packet, culling and mailbox. */
static void add_rows(bench_plan *plan, const bench_settings *settings, int every_switch)
{
    const size_t group = plan->group_count - 1;
    for (int p = 0; p < (every_switch ? PACKETS : 1); p++) {
        if (every_switch && settings->packet && settings->packet != packets[p])
            continue;
        for (int s = 0; s < (every_switch ? SWITCHES : 1); s++)
            for (int l = 0; l < LOOPS; l++) {
                bench_row *row = &plan->rows[plan->row_count++];
                row->group = group;
                row->choice = (bench_choice){.variant = plan->groups[group].variant,
                                             .packet = every_switch ? packets[p] : settings->packet,
                                             .loop = loops[l],
                                             .cull = switches[s].cull,
                                             .mailbox = switches[s].mailbox};
            }
    }
}

static void add_groups(bench_plan *plan, const bench_settings *settings, const char *variant, cgt_context *context)
{
    const int grid_given = settings->resolution[0] != 0;
    for (int g = 0; g < (grid_given ? 1 : GRIDS); g++) {
        bench_group *group = &plan->groups[plan->group_count++];
        group->variant = variant;
        group->context = context;
        group->scale = grid_given ? 1.0 : grids[g].scale;
        for (int axis = 0; axis < 3; axis++)
            group->requested[axis] = grid_given ? settings->resolution[axis] : grids[g].edge;
        label_group(group);
        add_rows(plan, settings, g == 0);
    }
}

/* Contexts of the variants, with their groups and rows. */
static int add_variants(bench_plan *plan, const bench_settings *settings)
{
    const char *variants[BENCH_MOST_VARIANTS];
    const size_t count = bench_variants(settings, variants);
    for (size_t v = 0; v < count; v++) {
        cgt_context **context = &plan->contexts[plan->context_count];
        const cgt_result result = bench_context_create(settings->threads, variants[v], context);
        if (result != CGT_OK)
            return bench_scene_failed(NULL, variants[v], result);
        plan->context_count++;
        add_groups(plan, settings, variants[v], *context);
    }
    return PROGRAM_OK;
}

int bench_plan_create(bench_plan *plan, const bench_settings *settings, const float *moving, size_t values)
{
    memset(plan, 0, sizeof *plan);
    plan->groups = calloc((size_t)BENCH_MOST_VARIANTS * GRIDS, sizeof *plan->groups);
    plan->rows = calloc((size_t)BENCH_MOST_VARIANTS * (MOST_ROWS_PER_GROUP + LOOPS * GRIDS), sizeof *plan->rows);
    if (!plan->groups || !plan->rows) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    const int code = add_variants(plan, settings);
    if (code != PROGRAM_OK)
        return code;

    int complete = 1;
    for (size_t i = 0; complete && i < plan->row_count; i++) {
        plan->rows[i].choice.grid = plan->groups[plan->rows[i].group].label;
        complete = (plan->rows[i].trace_ms = calloc(values, sizeof(double))) != NULL;
    }
    for (size_t i = 0; complete && i < plan->group_count; i++) {
        bench_group *group = &plan->groups[i];
        complete = (group->build_ms = calloc(values, sizeof(double))) != NULL;
        const cgt_result result = bench_scene_create(&group->scene, group->context, moving, group->requested);
        if (result != CGT_OK)
            return bench_scene_failed(group->context, group->label, result);
    }
    if (!complete) {
        program_error("out of memory for %zu measurements of %zu configurations", values, plan->row_count);
        return PROGRAM_FAILED;
    }
    return PROGRAM_OK;
}

void bench_plan_release(bench_plan *plan)
{
    for (size_t i = 0; i < plan->row_count; i++)
        free(plan->rows[i].trace_ms);
    for (size_t i = 0; i < plan->group_count; i++) {
        bench_scene_release(&plan->groups[i].scene);
        free(plan->groups[i].build_ms);
    }
    for (size_t i = 0; i < plan->context_count; i++)
        cgt_context_release(plan->contexts[i]);
    free(plan->rows);
    free(plan->groups);
    memset(plan, 0, sizeof *plan);
}

/* ---- Commit -------------------------------------------------------------------------------------------------- */

/* The library's own choice for this frame times the group's scale, within the library's limits. */
static cgt_result scale_resolution(bench_group *group, uint32_t count)
{
    static const uint32_t automatic[3] = {0, 0, 0};
    static const bench_kd_choice kd = {.break_level = 0};
    const bench_scene *scene = &group->scene;
    cgt_research_scene_statistics chosen;
    uint32_t resolution[3];
    cgt_result result = bench_scene_structure(scene, CGT_STRUCTURE_QUEUE_GRID, CGT_RAY_KIND_COHERENT, &kd, automatic);
    if (result == CGT_OK)
        result = bench_scene_commit(&group->scene, count);
    if (result == CGT_OK)
        result = cgt_research_get_scene_statistics(scene->scene, &chosen);
    if (result != CGT_OK)
        return result;
    for (int axis = 0; axis < 3; axis++) {
        const double cells = floor(group->scale * chosen.resolution[axis] + 0.5);
        resolution[axis] = cells < 1.0 ? 1 : cells > AXIS_LIMIT ? AXIS_LIMIT : (uint32_t)cells;
    }
    while ((uint64_t)resolution[0] * resolution[1] * resolution[2] > CELL_LIMIT)
        for (int axis = 0; axis < 3; axis++)
            resolution[axis] = (resolution[axis] + 1) / 2;
    return bench_scene_structure(scene, CGT_STRUCTURE_QUEUE_GRID, CGT_RAY_KIND_COHERENT, &kd, resolution);
}

cgt_result bench_group_commit(bench_group *group, uint32_t count, double *ms)
{
    cgt_result result = CGT_OK;
    if (!group->requested[0] && (group->scale > 1.0 || group->scale < 1.0))
        result = scale_resolution(group, count);
    if (result != CGT_OK)
        return result;

    const double start = bench_now_ms();
    result = bench_scene_commit(&group->scene, count);
    *ms = bench_now_ms() - start;
    cgt_research_scene_statistics built;
    if (result == CGT_OK)
        result = cgt_research_get_scene_statistics(group->scene.scene, &built);
    if (result == CGT_OK)
        memcpy(group->resolution, built.resolution, sizeof group->resolution);
    return result;
}
