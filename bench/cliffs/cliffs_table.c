/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The rows of cgt-bench cliffs. Two measurements are compared at the largest step that both have reached. */
#include "cliffs/bench_cliffs.h"

#include <math.h>
#include <stdlib.h>

/* Few points cost no less than this many: what a call costs in any case is not a cliff. */
#define LEAST_POINTS 256.0

static double ms_of_ray(const cliffs_times *times, cliff_call call, uint32_t step)
{
    const double rays = (double)times->rays[step];
    if (call == CLIFF_COMMIT)
        return times->ms[step];
    return times->ms[step] / (call == CLIFF_LIGHT && rays < LEAST_POINTS ? LEAST_POINTS : rays);
}

/* The time of a over that of b, for as many rays; NaN where one is missing. */
static double ratio_of(const cliffs_times *a, const cliffs_times *b, cliff_call call)
{
    const uint32_t steps = !b || a->steps < b->steps ? a->steps : b->steps;
    return b && steps ? ms_of_ray(a, call, steps - 1) / ms_of_ray(b, call, steps - 1) : NAN;
}

/* Whether Embree, of whose answers nothing is asked, finds at least half the hits. */
static bool finds_most(const cliffs_times *library, const cliffs_times *embree)
{
    const uint32_t steps = library->steps < embree->steps ? library->steps : embree->steps;
    return steps && 2 * embree->hits[steps - 1] >= library->hits[steps - 1];
}

static void print_row(bench_table *table, const char *section, const cliffs_row *row)
{
    bench_table_section(table, section);
    BENCH_ROW(table, CELL("scene", row->scene), CELL("primitives", row->primitives), CELL("structure", row->config),
              CELL("call", cliff_call_name(row->call)), CELL("rays", row->rays), CELL("hits", row->hits),
              CELL("ms", row->ms), CELL("twin_ratio", row->twin_ratio), CELL("embree_ms", row->embree_ms),
              CELL("embree_ratio", row->embree_ratio));
}

static int make_room(cliffs_rows *rows)
{
    if (rows->count < rows->room)
        return 0;
    const size_t room = rows->room ? 2 * rows->room : 1024;
    cliffs_row *row = realloc(rows->row, room * sizeof *row);
    if (!row) {
        program_error("out of memory for %zu rows", room);
        return -1;
    }
    rows->row = row;
    rows->room = room;
    return 0;
}

int cliffs_add_rows(cliffs_rows *rows, bench_table *table, const cliffs_row *name, const cliffs_result *of,
                    const cliffs_result *twin, const cliffs_result *embree)
{
    for (int c = 0; c < CLIFF_CALLS; c++) {
        const cliff_call call = (cliff_call)c;
        const cliffs_times *times = &of->call[c];
        if (!times->steps)
            continue;
        if (make_room(rows))
            return -1;
        cliffs_row *row = &rows->row[rows->count++];
        *row = *name;
        row->call = call;
        row->rays = times->rays[times->steps - 1];
        row->hits = times->hits[times->steps - 1];
        row->ms = times->ms[times->steps - 1];
        row->twin_ratio = ratio_of(times, twin ? &twin->call[c] : NULL, call);
        row->embree_ratio = finds_most(times, &embree->call[c]) ? ratio_of(times, &embree->call[c], call) : NAN;
        row->embree_ms = row->ms / row->embree_ratio;
        print_row(table, "cliffs", row);
    }
    return 0;
}

/* ---- the worst ---- */

/* Descending, without a ratio last. */
static int compare(double a, double b)
{
    const double x = isnan(a) ? -1 : a, y = isnan(b) ? -1 : b;
    return (x < y) - (x > y);
}

static int by_twin(const void *a, const void *b)
{
    return compare(((const cliffs_row *)a)->twin_ratio, ((const cliffs_row *)b)->twin_ratio);
}

static int by_embree(const void *a, const void *b)
{
    return compare(((const cliffs_row *)a)->embree_ratio, ((const cliffs_row *)b)->embree_ratio);
}

void cliffs_print_worst(cliffs_rows *rows, bench_table *table, uint32_t worst)
{
    if (!rows->count)
        return;
    qsort(rows->row, rows->count, sizeof *rows->row, by_twin);
    for (size_t i = 0; i < worst && i < rows->count && rows->row[i].twin_ratio > 0; i++)
        print_row(table, "worst against the twin", &rows->row[i]);
    qsort(rows->row, rows->count, sizeof *rows->row, by_embree);
    for (size_t i = 0; i < worst && i < rows->count && rows->row[i].embree_ratio > 0; i++)
        print_row(table, "worst against Embree", &rows->row[i]);
}
