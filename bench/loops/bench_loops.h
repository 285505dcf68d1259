/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The configurations that cgt-bench loops compares (bench_plan.c), and what it prints (bench_report.c).
 *   group   a variant of the library and a grid resolution: one scene, committed once per frame
 *   row     a way to trace that scene: loop, culling, mailbox, packet size */
#ifndef BENCH_LOOPS_H
#define BENCH_LOOPS_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/cgt.h>

#include "common/bench.h"
#include "common/bench_scene.h"
#include "common/bench_table.h"

typedef struct bench_group {
    const char *variant;
    cgt_context *context; /* not owned; shared by the groups of a variant */
    bench_scene scene;
    uint32_t requested[3]; /* cells; 0, 0, 0: the library's choice, times scale */
    double scale;
    char label[32];         /* "16x16x16", "auto", "auto*2" */
    uint32_t resolution[3]; /* of the last commit */
    double *build_ms;       /* one value per measured frame */
} bench_group;

typedef struct bench_row {
    size_t group;
    bench_choice choice;
    double *trace_ms;   /* one value per measured frame */
    bench_counts total; /* summed over the frames of the file, from runs that are not timed */
} bench_row;

typedef struct bench_plan {
    cgt_context *contexts[BENCH_MOST_VARIANTS];
    size_t context_count;
    bench_group *groups;
    size_t group_count;
    bench_row *rows; /* rows of a group lie together; the nested and the flattened row of a pair are neighbours */
    size_t row_count;
    size_t measured; /* values in each row's trace_ms and each group's build_ms */
} bench_plan;

/* Makes contexts, scenes over `moving`, and room for `values` measurements a row. Returns an exit code; prints what
 * failed. */
int bench_plan_create(bench_plan *plan, const bench_settings *settings, const float *moving, size_t values);

void bench_plan_release(bench_plan *plan);

/* Commits a group's scene; ms gets the milliseconds of the commit. */
cgt_result bench_group_commit(bench_group *group, uint32_t count, double *ms);

/* Prints the table, a row per configuration. frames: number of frames that the statistics sum over. table: of this one
 * and the ratios: nested over flattened loop, ray tests saved by culling, mailbox on over off. Ratios of times are
 * taken within a frame, then median and quartiles over the frames. Both return 0, or -1 where memory is refused. */
int bench_report_table(const bench_plan *plan, size_t frames, bench_table *table);
int bench_report_ratios(const bench_plan *plan, bench_table *table);

#endif
