/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Errors of the structure apart from errors of the kernel: the grid beside a grid of one cell, in which every ray meets
 * every primitive by the same kernel. In ROBUST what only the grid gets wrong is the structure's; in FAST which of two
 * hits of equal t wins depends on the order of the tests, so that either may be wrong alone. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy/bench_accuracy.h"

#define MOST_TESTS 2e9 /* of brute force; beyond, rays are left out */

void accuracy_structure_begin(const accuracy_job *job)
{
    static const char *const columns[] = {"case",          "config",     "rays",         "grid_missed",
                                          "grid_invented", "grid_wrong", "brute_missed", "brute_invented",
                                          "brute_wrong",   "grid_only",  "brute_only",   NULL};
    accuracy_report_table(job->report, "structure", columns);
}

typedef struct pair {
    hard_tally grid, brute;
    uint64_t grid_only, brute_only; /* rays that only the one gets wrong */
} pair;

static void add_verdict(hard_tally *tally, oracle_verdict verdict)
{
    tally->rays++;
    tally->missed += verdict == ORACLE_MISSED;
    tally->invented += verdict == ORACLE_INVENTED;
    tally->wrong += verdict == ORACLE_WRONG;
}

static void compare(const accuracy_subject *subject, const full_hit *grid, const full_hit *brute, pair *sum)
{
    for (uint32_t i = 0; i < subject->scene.rays; i++) {
        oracle_hit exact;
        const oracle_verdict of_grid = hard_judge(&subject->scene, &subject->truth, i, &grid[i], &exact);
        const oracle_verdict of_brute = hard_judge(&subject->scene, &subject->truth, i, &brute[i], &exact);
        add_verdict(&sum->grid, of_grid);
        add_verdict(&sum->brute, of_brute);
        sum->grid_only += of_brute == ORACLE_RIGHT && of_grid != ORACLE_RIGHT;
        sum->brute_only += of_brute != ORACLE_RIGHT && of_grid == ORACLE_RIGHT;
    }
}

static void report_pair(const accuracy_job *job, const accuracy_subject *subject, const char *config, const pair *sum)
{
    const uint64_t counts[] = {sum->grid.rays,   sum->grid.missed,  sum->grid.invented,
                               sum->grid.wrong,  sum->brute.missed, sum->brute.invented,
                               sum->brute.wrong, sum->grid_only,    sum->brute_only};
    accuracy_report_text(job->report, subject->name);
    accuracy_report_text(job->report, config);
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        accuracy_report_count(job->report, counts[i]);
}

static int trace_choice(const accuracy_subject *subject, const accuracy_choice *choice, full_hit *hits,
                        char config[BENCH_NAME_SIZE])
{
    accuracy_scene scene;
    int code = accuracy_scene_make(&scene, subject, choice);
    if (code != PROGRAM_OK)
        return code;
    code = accuracy_trace(&scene, subject, hits, NULL);
    if (config)
        memcpy(config, scene.config, BENCH_NAME_SIZE);
    accuracy_scene_free(&scene);
    return code;
}

static int compare_choice(const accuracy_job *job, const accuracy_subject *subject, const accuracy_choice *choice)
{
    static const uint32_t one_cell[3] = {1, 1, 1};
    const size_t rays = (size_t)subject->scene.rays + 1;
    const accuracy_choice all = {choice->variant, choice->precision, choice->test, one_cell};
    char config[BENCH_NAME_SIZE];
    if (choice->precision == CGT_PRECISION_EXACT)
        return PROGRAM_OK; /* it decides as ROBUST does */
    full_hit *grid = calloc(rays, sizeof *grid), *brute = calloc(rays, sizeof *brute);
    int code = PROGRAM_FAILED;
    if (grid && brute) {
        code = trace_choice(subject, choice, grid, config);
        if (code == PROGRAM_OK)
            code = trace_choice(subject, &all, brute, NULL);
    } else
        program_error("%s: out of memory", subject->name);
    if (code == PROGRAM_OK) {
        pair sum = {.grid_only = 0};
        compare(subject, grid, brute, &sum);
        report_pair(job, subject, config, &sum);
    }
    free(brute);
    free(grid);
    return code;
}

int accuracy_structure_rows(const accuracy_job *job, const accuracy_subject *subject)
{
    accuracy_subject part = *subject; /* the first rays of it; owns nothing */
    const double primitives = hard_scene_primitives(&subject->scene), most = MOST_TESTS / fmax(primitives, 1);
    if (part.scene.rays > most)
        part.scene.rays = most < 1 ? 1 : (uint32_t)most;
    return accuracy_each_choice(job, &part, compare_choice);
}
