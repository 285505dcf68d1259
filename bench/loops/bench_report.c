/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Table and ratios of cgt-bench loops. */
#include "loops/bench_loops.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"

/* ---- Table --------------------------------------------------------------------------------------------------- */

static const char *resolution_text(const bench_group *group, char text[80])
{
    const unsigned x = group->resolution[0], y = group->resolution[1], z = group->resolution[2];
    if (group->requested[0])
        snprintf(text, 80, "%s", group->label);
    else
        snprintf(text, 80, "%s=%ux%ux%u", group->label, x, y, z);
    return text;
}

static double per(uint64_t total, uint64_t count) { return (double)total / (double)(count ? count : 1); }

/* The columns that the table and the ratios share: the row's configuration. */
static void write_choice(bench_table *table, const bench_group *group, const bench_row *row, const char *resolution)
{
    bench_table_text(table, "variant", group->variant);
    bench_table_text(table, "loop", bench_loop_name(row->choice.loop));
    bench_table_text(table, "cull", bench_cull_name(row->choice.cull));
    bench_table_text(table, "mailbox", row->choice.mailbox == CGT_MAILBOX_OFF ? "off" : "on");
    bench_table_count(table, "packet", row->total.research.packet_size);
    bench_table_text(table, "resolution", resolution);
}

static double median_of(const double *values, size_t count, double *scratch)
{
    memcpy(scratch, values, count * sizeof *scratch);
    return bench_median(scratch, count);
}

static void write_row(bench_table *table, const bench_plan *plan, const bench_row *row, size_t frames, double *scratch)
{
    const bench_group *group = &plan->groups[row->group];
    const bench_counts *total = &row->total;
    const size_t values = plan->measured;
    char name[BENCH_NAME_SIZE], grid[80];
    bench_choice_name(&row->choice, CGT_STRUCTURE_QUEUE_GRID, name);
    bench_table_text(table, "config", name);
    write_choice(table, group, row, resolution_text(group, grid));
    bench_table_real(table, "build_ms", median_of(group->build_ms, values, scratch));
    bench_table_real(table, "trace_ms", median_of(row->trace_ms, values, scratch));
    for (size_t i = 0; i < values; i++)
        scratch[i] = group->build_ms[i] + row->trace_ms[i];
    bench_table_real(table, "ms", bench_median(scratch, values));
    bench_table_real(table, "tests_per_ray", per(total->trace.ray_tests, total->trace.rays));
    bench_table_real(table, "packet_tests", per(total->trace.packet_tests, frames));
    bench_table_real(table, "slices", per(total->research.slices, frames));
    bench_table_real(table, "cells", per(total->research.cells, frames));
    bench_table_real(table, "references", per(total->research.references, frames));
    bench_table_end_row(table);
}

int bench_report_table(const bench_plan *plan, size_t frames, bench_table *table)
{
    double *scratch = calloc(plan->measured + 1, sizeof *scratch);
    if (!scratch)
        return -1;
    bench_table_section(table, "loops");
    for (size_t i = 0; i < plan->row_count; i++)
        write_row(table, plan, &plan->rows[i], frames, scratch);
    free(scratch);
    return 0;
}

/* ---- Ratios -------------------------------------------------------------------------------------------------- */

/* The row that differs from this one in loop, culling or mailbox only; NULL where the plan has none. */
static const bench_row *partner(const bench_plan *plan, const bench_row *row, cgt_loop loop, cgt_cull cull,
                                cgt_mailbox mailbox)
{
    for (size_t i = 0; i < plan->row_count; i++) {
        const bench_row *other = &plan->rows[i];
        const bench_choice *choice = &other->choice;
        if (other->group == row->group && choice->packet == row->choice.packet && choice->loop == loop &&
            choice->cull == cull && choice->mailbox == mailbox)
            return other;
    }
    return NULL;
}

/* Time of a over time of b, frame by frame. */
static bench_spread time_ratio(const bench_plan *plan, const bench_row *a, const bench_row *b, double *scratch)
{
    for (size_t i = 0; i < plan->measured; i++)
        scratch[i] = b->trace_ms[i] > 0.0 ? a->trace_ms[i] / b->trace_ms[i] : 0.0;
    return bench_spread_of(scratch, plan->measured);
}

static double ratio_of_medians(const bench_plan *plan, const bench_row *a, const bench_row *b, double *scratch)
{
    const double of_a = median_of(a->trace_ms, plan->measured, scratch);
    const double of_b = median_of(b->trace_ms, plan->measured, scratch);
    return of_b > 0.0 ? of_a / of_b : 0.0;
}

/* The first cells of a pair's row. */
static void begin_pair(bench_table *table, const bench_plan *plan, const char *what, const bench_row *row)
{
    const bench_group *group = &plan->groups[row->group];
    bench_table_section(table, what);
    bench_table_text(table, "what", what);
    write_choice(table, group, row, group->label);
}

/* A section's pairs in one line. */
static void print_spread(const char *what, double *ratios, size_t pairs)
{
    const bench_spread all = bench_spread_of(ratios, pairs);
    if (pairs)
        printf("# %s over %zu pairs: median %.3f, quartiles %.3f to %.3f, range %.3f to %.3f\n", what, pairs,
               all.median, all.low, all.high, ratios[0], ratios[pairs - 1]);
}

/* One row per pair that differs in the loop, then the quartiles over the pairs. */
static void report_loops(const bench_plan *plan, bench_table *table, double *scratch, double *ratios)
{
    size_t pairs = 0;
    for (size_t i = 0; i < plan->row_count; i++) {
        const bench_row *nested = &plan->rows[i];
        if (nested->choice.loop != CGT_LOOP_NESTED)
            continue;
        const bench_row *flattened =
            partner(plan, nested, CGT_LOOP_FLATTENED, nested->choice.cull, nested->choice.mailbox);
        if (!flattened)
            continue;
        const bench_spread spread = time_ratio(plan, nested, flattened, scratch);
        ratios[pairs] = ratio_of_medians(plan, nested, flattened, scratch);
        begin_pair(table, plan, "nested/flattened", nested);
        bench_table_real(table, "ratio_of_medians", ratios[pairs++]);
        bench_table_real(table, "low_quartile", spread.low);
        bench_table_real(table, "median", spread.median);
        bench_table_real(table, "high_quartile", spread.high);
        bench_table_end_row(table);
    }
    print_spread("nested/flattened", ratios, pairs);
}

/* The factor by which one way of culling saves ray-primitive tests compared with another. */
static void report_culling(const bench_plan *plan, bench_table *table, cgt_cull with, cgt_cull without, double *scratch,
                           double *ratios)
{
    const char *what = with == CGT_CULL_FRUSTUM ? "frustum" : "blocks";
    size_t pairs = 0;
    for (size_t i = 0; i < plan->row_count; i++) {
        const bench_row *on = &plan->rows[i];
        if (on->choice.cull != with)
            continue;
        const bench_row *off = partner(plan, on, on->choice.loop, without, on->choice.mailbox);
        if (!off)
            continue;
        const uint64_t tests_on = on->total.trace.ray_tests, tests_off = off->total.trace.ray_tests;
        ratios[pairs] = tests_on ? (double)tests_off / (double)tests_on : 0.0;
        begin_pair(table, plan, what, on);
        bench_table_real(table, "tests_off/tests_on", ratios[pairs++]);
        bench_table_real(table, "tests_per_ray_off", per(tests_off, off->total.trace.rays));
        bench_table_real(table, "tests_per_ray_on", per(tests_on, on->total.trace.rays));
        bench_table_real(table, "time_off/time_on", time_ratio(plan, off, on, scratch).median);
        bench_table_end_row(table);
    }
    print_spread(what, ratios, pairs);
}

/* The cost of the mailbox, and the number of tests that it saves. */
static void report_mailbox(const bench_plan *plan, bench_table *table, double *scratch, double *ratios)
{
    size_t pairs = 0;
    for (size_t i = 0; i < plan->row_count; i++) {
        const bench_row *on = &plan->rows[i];
        if (on->choice.mailbox != CGT_MAILBOX_ON)
            continue;
        const bench_row *off = partner(plan, on, on->choice.loop, on->choice.cull, CGT_MAILBOX_OFF);
        if (!off)
            continue;
        ratios[pairs] = time_ratio(plan, on, off, scratch).median;
        begin_pair(table, plan, "mailbox", on);
        bench_table_real(table, "time_on/time_off", ratios[pairs++]);
        bench_table_real(table, "skipped/references_off",
                         per(on->total.research.mailbox_skipped, off->total.research.references));
        bench_table_end_row(table);
    }
    print_spread("mailbox", ratios, pairs);
}

int bench_report_ratios(const bench_plan *plan, bench_table *table)
{
    double *scratch = calloc(plan->measured + 1, sizeof *scratch);
    double *ratios = calloc(plan->row_count + 1, sizeof *ratios);
    const int complete = scratch && ratios;
    if (complete) {
        report_loops(plan, table, scratch, ratios);
        report_culling(plan, table, CGT_CULL_FRUSTUM, CGT_CULL_NONE, scratch, ratios);
        report_culling(plan, table, CGT_CULL_BLOCKS, CGT_CULL_FRUSTUM, scratch, ratios);
        report_mailbox(plan, table, scratch, ratios);
    }
    free(ratios);
    free(scratch);
    return complete ? 0 : -1;
}
