/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Table and ratios of cgt-bench loops. */
#include "loops/bench_report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"

/* ---- Table --------------------------------------------------------------------------------------------------- */

static const char *resolution_text(const bench_group *group, char text[80])
{
    const unsigned x = group->resolution[0], y = group->resolution[1], z = group->resolution[2];
    if (group->asked[0])
        snprintf(text, 80, "%s", group->label);
    else
        snprintf(text, 80, "%s=%ux%ux%u", group->label, x, y, z);
    return text;
}

static double per(uint64_t total, uint64_t count) { return (double)total / (double)(count ? count : 1); }

static void print_row(const bench_plan *plan, const bench_row *row, size_t frames, double *scratch)
{
    const bench_group *group = &plan->groups[row->group];
    const bench_counts *total = &row->total;
    const size_t values = plan->measured;
    char name[BENCH_NAME_SIZE], grid[80];
    cgt_scene_statistics built;
    built.structure = CGT_STRUCTURE_AUTO;
    cgt_scene_get_statistics(group->scene.scene, &built);
    bench_choice_name(&row->choice, built.structure, name);

    memcpy(scratch, group->build_ms, values * sizeof *scratch);
    const double build = bench_median(scratch, values);
    memcpy(scratch, row->trace_ms, values * sizeof *scratch);
    const double trace = bench_median(scratch, values);
    for (size_t i = 0; i < values; i++)
        scratch[i] = group->build_ms[i] + row->trace_ms[i];
    const double both = bench_median(scratch, values);

    printf("%s\t%s\t%s\t%s\t%s\t%u\t%s\t%.3f\t%.3f", name, group->variant, bench_loop_name(total->research.loop),
           bench_cull_name(row->choice.cull), row->choice.mailbox == CGT_MAILBOX_OFF ? "off" : "on",
           (unsigned)total->research.packet_size, resolution_text(group, grid), build, trace);
    printf("\t%.3f\t%.0f\t%.0f\t%.0f\t%.0f\t%.3f\n", per(total->trace.ray_tests, total->trace.rays),
           per(total->trace.packet_tests, frames), per(total->research.slices, frames),
           per(total->research.cells, frames), per(total->research.references, frames), both);
}

int bench_report_table(const bench_plan *plan, size_t frames)
{
    double *scratch = calloc(plan->measured + 1, sizeof *scratch);
    if (!scratch)
        return -1;
    printf("config\tvariant\tloop\tcull\tmailbox\tpacket\tresolution\tbuild_ms\ttrace_ms\ttests_per_ray\tpacket_tests"
           "\tslices\tcells\treferences\tms\n");
    for (size_t i = 0; i < plan->row_count; i++)
        print_row(plan, &plan->rows[i], frames, scratch);
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
    memcpy(scratch, a->trace_ms, plan->measured * sizeof *scratch);
    const double of_a = bench_median(scratch, plan->measured);
    memcpy(scratch, b->trace_ms, plan->measured * sizeof *scratch);
    const double of_b = bench_median(scratch, plan->measured);
    return of_b > 0.0 ? of_a / of_b : 0.0;
}

static void print_pair(const bench_plan *plan, const char *what, const bench_row *row, double ratio)
{
    const bench_group *group = &plan->groups[row->group];
    printf("# %s\t%s\t%s\t%s\t%s\t%u\t%s\t%.3f", what, group->variant, bench_loop_name(row->choice.loop),
           bench_cull_name(row->choice.cull), row->choice.mailbox == CGT_MAILBOX_OFF ? "off" : "on",
           (unsigned)row->total.research.packet_size, group->label, ratio);
}

/* The pairs of a section in one line. */
static void print_spread(const char *what, double *ratios, size_t pairs)
{
    const bench_spread all = bench_spread_of(ratios, pairs);
    if (pairs)
        printf("# %s over %zu pairs: median %.3f, quartiles %.3f to %.3f, range %.3f to %.3f\n", what, pairs,
               all.median, all.low, all.high, ratios[0], ratios[pairs - 1]);
}

/* One line per pair that differs in the loop, then the spread of the pairs. */
static void report_loops(const bench_plan *plan, double *scratch, double *ratios)
{
    size_t pairs = 0;
    printf("#\n# Time of the nested loop over time of the flattened loop, trace_ms; above 1: flattened is faster\n");
    printf("# what\tvariant\tloop\tcull\tmailbox\tpacket\tresolution\tratio_of_medians\tlow_quartile\tmedian\t"
           "high_quartile\n");
    for (size_t i = 0; i < plan->row_count; i++) {
        const bench_row *nested = &plan->rows[i];
        if (nested->choice.loop != CGT_LOOP_NESTED)
            continue;
        const bench_row *flattened =
            partner(plan, nested, CGT_LOOP_FLATTENED, nested->choice.cull, nested->choice.mailbox);
        if (!flattened)
            continue;
        const double ratio = ratio_of_medians(plan, nested, flattened, scratch);
        const bench_spread spread = time_ratio(plan, nested, flattened, scratch);
        print_pair(plan, "nested/flattened", nested, ratio);
        printf("\t%.3f\t%.3f\t%.3f\n", spread.low, spread.median, spread.high);
        ratios[pairs++] = ratio;
    }
    print_spread("nested/flattened", ratios, pairs);
}

/* How many times fewer rays are tested against spheres with one way of culling than with another. */
static void report_culling(const bench_plan *plan, cgt_cull with, cgt_cull without, double *scratch, double *ratios)
{
    size_t pairs = 0;
    const char *what = with == CGT_CULL_FRUSTUM ? "frustum" : "blocks";
    printf("#\n# what\tvariant\tloop\tcull\tmailbox\tpacket\tresolution\ttests_off/tests_on\ttests_per_ray_off\t"
           "tests_per_ray_on\ttime_off/time_on\n");
    for (size_t i = 0; i < plan->row_count; i++) {
        const bench_row *on = &plan->rows[i];
        if (on->choice.cull != with)
            continue;
        const bench_row *off = partner(plan, on, on->choice.loop, without, on->choice.mailbox);
        if (!off)
            continue;
        const uint64_t tests_on = on->total.trace.ray_tests, tests_off = off->total.trace.ray_tests;
        const double cut = tests_on ? (double)tests_off / (double)tests_on : 0.0;
        ratios[pairs++] = cut;
        print_pair(plan, what, on, cut);
        printf("\t%.3f\t%.3f\t%.3f\n", per(tests_off, off->total.trace.rays), per(tests_on, on->total.trace.rays),
               time_ratio(plan, off, on, scratch).median);
    }
    print_spread(what, ratios, pairs);
}

/* What remembering spheres costs, and how many tests it saves. */
static void report_mailbox(const bench_plan *plan, double *scratch, double *ratios)
{
    size_t pairs = 0;
    printf("#\n# Time with the mailbox over time without; above 1: the mailbox costs more than it saves\n");
    printf("# what\tvariant\tloop\tcull\tmailbox\tpacket\tresolution\ttime_on/time_off\tskipped/references_off\n");
    for (size_t i = 0; i < plan->row_count; i++) {
        const bench_row *on = &plan->rows[i];
        if (on->choice.mailbox != CGT_MAILBOX_ON)
            continue;
        const bench_row *off = partner(plan, on, on->choice.loop, on->choice.cull, CGT_MAILBOX_OFF);
        if (!off)
            continue;
        const double time = time_ratio(plan, on, off, scratch).median;
        ratios[pairs++] = time;
        print_pair(plan, "mailbox", on, time);
        printf("\t%.3f\n", per(on->total.research.mailbox_skipped, off->total.research.references));
    }
    print_spread("mailbox", ratios, pairs);
}

int bench_report_ratios(const bench_plan *plan)
{
    double *scratch = calloc(plan->measured + 1, sizeof *scratch);
    double *ratios = calloc(plan->row_count + 1, sizeof *ratios);
    if (scratch && ratios) {
        report_loops(plan, scratch, ratios);
        printf("#\n# Ray-sphere tests without the packet's frustum over those with it; Chapman quotes 4 to 8 from Wald "
               "et al.\n");
        report_culling(plan, CGT_CULL_FRUSTUM, CGT_CULL_NONE, scratch, ratios);
        printf("#\n# Ray-sphere tests with the frustum alone over those with the cones of 16 rays too\n");
        report_culling(plan, CGT_CULL_BLOCKS, CGT_CULL_FRUSTUM, scratch, ratios);
        report_mailbox(plan, scratch, ratios);
    }
    const int failed = !scratch || !ratios;
    free(ratios);
    free(scratch);
    return failed ? -1 : 0;
}
