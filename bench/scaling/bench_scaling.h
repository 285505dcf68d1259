/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench scaling: time and memory of a frame as one quantity grows and the others stay.
 *   measure  one point: some frames of a scene made in memory   bench_scaling_measure.c
 *   table    rows, and exponents of growth                      bench_scaling_table.c */
#ifndef BENCH_SCALING_H
#define BENCH_SCALING_H

#include <stddef.h>
#include <stdint.h>

#include "common/bench.h"
#include "common/bench_table.h"

/* The quantity that grows. */
typedef enum scaling_sweep { SCALING_PRIMITIVES, SCALING_PIXELS, SCALING_THREADS, SCALING_SWEEPS } scaling_sweep;
typedef enum scaling_kind { SCALING_SPHERES, SCALING_TRIANGLES, SCALING_KINDS } scaling_kind;

enum { SCALING_BOUNDS, SCALING_BUILD, SCALING_PRIMARY, SCALING_FRAME, SCALING_COLUMNS };

typedef struct scaling_settings {
    bench_settings shared;
    bench_structure_settings structure;
    bench_precision_settings precision;
    int sweep[SCALING_SWEEPS], kind[SCALING_KINDS]; /* 1: requested; none of them: all */
    uint64_t range[SCALING_SWEEPS][2];              /* smallest and largest; 0 threads: one per CPU */
    uint32_t at;                                    /* primitives where they do not grow */
    uint32_t steps;                                 /* points for each factor of ten; threads: each number */
} scaling_settings;

/* One point: first what to measure, then the results. */
typedef struct scaling_point {
    scaling_sweep sweep;
    scaling_kind kind;
    uint32_t primitives, width, height, threads;
    char config[BENCH_NAME_SIZE];
    cgt_scene_statistics built;
    double low[SCALING_COLUMNS], median[SCALING_COLUMNS]; /* ms */
    uint64_t hits;                                        /* pixels, of the last frame */
    uint64_t allocations;                                 /* from the context's creation to the last frame */
    uint64_t steady_allocations;                          /* of those, in the frames that are measured */
} scaling_point;

/* Returns an exit code; prints what failed. */
int scaling_measure(const scaling_settings *settings, scaling_point *point);

/* The quantity that grows in the point's sweep. */
double scaling_size(const scaling_point *point);

/* before: the smaller point of the same sweep and kind; NULL: this is the first. */
void scaling_table_row(bench_table *table, const scaling_point *point, const scaling_point *before);

/* A second table: time ~ size^exponent over all points of a sweep and kind, by least squares of logarithms. The points
 * of a sweep and kind lie together. */
void scaling_table_exponents(bench_table *table, const scaling_point *points, size_t count);

#endif
