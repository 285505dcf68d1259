/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures of time against error, drawn by gnuplot from a script that has the figures in it and stays, so that a
 * picture can be drawn again in another form. For each scene a column of panels: wrong answers over time, t error over
 * time, and on request bars of what exactness costs. */
#ifndef BENCH_PARETO_DRAW_H
#define BENCH_PARETO_DRAW_H

#include <stddef.h>
#include <stdint.h>

typedef struct draw_point {
    size_t scene;   /* column */
    size_t variant; /* colour */
    size_t kind;    /* shape */
    double time;
    double share; /* wrong answers of all */
    uint64_t of;  /* how many all are: what one wrong answer is */
    double ulp;   /* worst error of t */
    double cost;  /* per cent; where there are bars */
    int bar;      /* -1: none; else its place among the bars of its variant */
} draw_point;

typedef struct draw_picture {
    const draw_point *points;
    size_t count;
    const char *const *scenes, *const *variants, *const *kinds;
    size_t scene_count, variant_count, kind_count;
    const char *time_label; /* of the axes */
    int time_logarithmic;   /* 1: times lie orders of magnitude apart */
    const char *share_label;
    const char *cost_label;       /* NULL: no bars */
    const char *const *bar_names; /* two */
} draw_picture;

enum { DRAW_MOST_KINDS = 5, DRAW_BARS = 2 };

/* Writes PREFIX.gnuplot and has gnuplot draw PREFIX.svg and PREFIX.png. Returns an exit code; prints what failed. */
int draw_picture_files(const draw_picture *picture, const char *prefix);

#endif
