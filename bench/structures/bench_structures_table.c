/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The rows of cgt-bench structures, printed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "structures/bench_structures.h"
#include "common/bench_timing.h"

void structures_table_begin(accuracy_report *report)
{
    static const char *const columns[] = {"config",
                                          "scene",
                                          "primitives",
                                          "threads",
                                          "build_ms",
                                          "primary_ms",
                                          "shadow_ms",
                                          "ao_ms",
                                          "random_ms",
                                          "frame_ms",
                                          "primary_rays", /* of a frame, the mean */
                                          "shadow_rays",
                                          "ao_rays",
                                          "random_rays",
                                          "nodes_per_ray", /* of primary rays */
                                          "leaves_per_ray",
                                          "tests_per_ray",
                                          "shadow_nodes_per_ray",
                                          "shadow_leaves_per_ray",
                                          "shadow_tests_per_ray",
                                          "ao_nodes_per_ray",
                                          "ao_leaves_per_ray",
                                          "ao_tests_per_ray",
                                          "random_nodes_per_ray",
                                          "random_leaves_per_ray",
                                          "random_tests_per_ray",
                                          "bytes",
                                          "kd_nodes",
                                          "kd_leaves",
                                          "kd_depth",
                                          "kd_cost",
                                          "rope_steps", /* of all frames and kinds of rays, as the next two */
                                          "exact_steps",
                                          "rope_loops",
                                          "chosen",
                                          "reason",
                                          NULL};
    accuracy_report_table(report, "structures", columns);
}

/* Nodes, leaves and tests of a ray; grids have no nodes. */
static void report_visits(accuracy_report *report, const bench_counts *s, int tree)
{
    const double rays = (double)s->trace.rays;
    accuracy_report_real(report, tree && s->trace.rays ? (double)s->research.nodes / rays : NAN);
    accuracy_report_real(report, tree && s->trace.rays ? (double)s->research.leaves / rays : NAN);
    accuracy_report_real(report, s->trace.rays ? (double)s->trace.ray_tests / rays : NAN);
}

static void report_row(const structures_job *job, const structures_row *row, accuracy_report *report, double *scratch)
{
    static const int kinds[] = {STRUCTURES_PRIMARY, STRUCTURES_SHADOW, STRUCTURES_AO, STRUCTURES_RANDOM};
    enum { KINDS = sizeof kinds / sizeof kinds[0] };
    const cgt_scene_statistics *built = &job->groups[row->group].built;
    const cgt_research_scene_statistics *research = &job->groups[row->group].research;
    const int tree = built->structure == CGT_STRUCTURE_KD || built->structure == CGT_STRUCTURE_KD_ROPES;
    uint64_t rope_steps = 0, exact_steps = 0, rope_loops = 0;
    char name[BENCH_NAME_SIZE];
    structures_row_name(job, row, name);
    accuracy_report_text(report, name);
    accuracy_report_text(report, job->scene_name);
    accuracy_report_count(report, built->primitives);
    accuracy_report_count(report, cgt_context_get_threads(job->context));
    for (int column = 0; column < STRUCTURES_COLUMNS; column++) {
        memcpy(scratch, row->ms[column], job->measured * sizeof *scratch);
        accuracy_report_real(report, bench_median(scratch, job->measured));
    }
    for (int k = 0; k < KINDS; k++)
        accuracy_report_real(report, (double)row->count[kinds[k]].trace.rays / (double)job->input.frames);
    for (int k = 0; k < KINDS; k++) {
        const bench_counts *s = &row->count[kinds[k]];
        report_visits(report, s, tree);
        rope_steps += s->research.rope_steps;
        exact_steps += s->research.exact_steps;
        rope_loops += s->research.rope_loops;
    }
    accuracy_report_count(report, built->structure_bytes);
    accuracy_report_count(report, research->kd_nodes);
    accuracy_report_count(report, research->kd_leaves);
    accuracy_report_count(report, research->kd_depth);
    accuracy_report_real(report, tree ? research->kd_cost : NAN);
    accuracy_report_count(report, rope_steps);
    accuracy_report_count(report, exact_steps);
    accuracy_report_count(report, rope_loops);
    accuracy_report_text(report, bench_structure_name(built->structure));
    accuracy_report_text(report, built->reason);
    if (job->settings->shared.verbose)
        fprintf(stderr, "%s: %s: %s (%s)\n", job->scene_name, name, bench_structure_name(built->structure),
                built->reason);
}

int structures_table_rows(const structures_job *job, accuracy_report *report)
{
    double *scratch = calloc(job->measured + 1, sizeof *scratch);
    if (!scratch) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    for (size_t i = 0; i < job->row_count; i++)
        if (!job->groups[job->rows[i].group].left_out)
            report_row(job, &job->rows[i], report, scratch);
    free(scratch);
    return PROGRAM_OK;
}
