/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench pareto: what is measured, and what becomes of it.
 *   rows   one scene measured in all ways         bench_pareto_rows.c
 *   error  hits beside those of EXACT             bench_pareto_error.h
 *   tests  the tests of FAST alone                bench_pareto_tests.c
 *   plot   both tables as points of pictures      bench_pareto_plot.c
 *   draw   pictures, by gnuplot                   bench_pareto_draw.h */
#ifndef BENCH_PARETO_H
#define BENCH_PARETO_H

#include <stddef.h>

#include "common/bench.h"
#include "pareto/bench_pareto_error.h"
#include "pareto/bench_pareto_kernel.h"
#include "common/bench_scene.h"

/* One way to trace a scene, and its result: a point of the picture. */
typedef struct pareto_row {
    size_t scene; /* which file, counted from 0 */
    const char *variant;
    cgt_structure structure;
    cgt_precision precision;
    cgt_triangle_test test; /* of files of triangles */
    int triangles;          /* 1: a file of triangles */
    uint32_t threads;
    double build_ms, trace_ms, ms; /* medians over the frames; ms: both together */
    double cost, trace_cost;       /* of ms and of trace_ms over FAST's, triangles with WATERTIGHT, in the same variant:
                                      per cent on top, median over the frames */
    pareto_error error;            /* beside EXACT */
} pareto_row;

typedef struct pareto_table {
    pareto_row *rows;
    size_t count;
} pareto_table;

/* Measures one file in every variant, precision and triangle test, and adds its rows. Variants that the CPU lacks are
 * left out. Returns an exit code; prints what failed. */
int pareto_measure(pareto_table *table, const bench_settings *settings, size_t scene, const char *path);

/* One test of FAST precision in one variant. */
typedef struct pareto_test_row {
    pareto_test test;
    const char *variant;
    const char *name; /* the variant's, or that of the SPU's arithmetic */
    int spu;          /* 1: in that arithmetic */
    pareto_kernel *run;
    double ns;          /* a ray against a primitive, with what is worked out once for 256 rays */
    pareto_error error; /* beside exact arithmetic */
} pareto_test_row;

typedef struct pareto_tests {
    pareto_test_row *rows;
    size_t count;
    float *t; /* what a kernel finds */
} pareto_tests;

const char *pareto_test_name(pareto_test test);

/* Measures the tests in all variants that are asked for and that the CPU runs. Returns an exit code; prints what
 * failed. release: also after a failure. */
int pareto_measure_tests(pareto_tests *tests, const bench_settings *settings);
void pareto_tests_release(pareto_tests *tests);

/* Draw the tables; see draw_picture_files. names: of the scenes. */
int pareto_plot(const pareto_table *table, const char *const *names, size_t scenes, const char *prefix);
int pareto_plot_tests(const pareto_tests *tests, const char *prefix);

#endif
