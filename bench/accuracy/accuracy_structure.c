/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tells errors of the structure from errors of the kernel: the same rays through a grid, and through a grid of one
 * cell, where the same kernel tests every ray against every primitive. In ROBUST, an error of the grid only is the
 * structure's fault. In tests without bounds their order decides between hits of equal t, so each may be wrong where the
 * other is right. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy/bench_accuracy.h"

#define MOST_TESTS 2e9 /* limit of brute force: beyond it, rays are dropped */

typedef struct pair {
    hard_tally grid, brute;
    uint64_t grid_only, brute_only; /* rays wrong in only one of them */
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

static void write_row(const accuracy_job *job, const accuracy_subject *subject, const char *config, const pair *sum)
{
    bench_table *const table = job->table;
    bench_table_section(table, "structure");
    bench_table_text(table, "case", subject->name);
    bench_table_text(table, "config", config);
    bench_table_count(table, "rays", sum->grid.rays);
    bench_table_count(table, "grid_missed", sum->grid.missed);
    bench_table_count(table, "grid_invented", sum->grid.invented);
    bench_table_count(table, "grid_wrong", sum->grid.wrong);
    bench_table_count(table, "brute_missed", sum->brute.missed);
    bench_table_count(table, "brute_invented", sum->brute.invented);
    bench_table_count(table, "brute_wrong", sum->brute.wrong);
    bench_table_count(table, "grid_only", sum->grid_only);
    bench_table_count(table, "brute_only", sum->brute_only);
    bench_table_end_row(table);
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
        write_row(job, subject, config, &sum);
    }
    free(brute);
    free(grid);
    return code;
}

int accuracy_structure(const accuracy_job *job, const accuracy_subject *subject)
{
    accuracy_subject part = *subject; /* the first rays of it; owns nothing */
    const double primitives = hard_scene_primitives(&subject->scene), most = MOST_TESTS / fmax(primitives, 1);
    if (part.scene.rays > most)
        part.scene.rays = most < 1 ? 1 : (uint32_t)most;
    return accuracy_each_choice(job, &part, compare_choice);
}
