/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The tables of cgt-bench pareto as points of pictures. */
#include "pareto/bench_pareto.h"

#include <stdlib.h>
#include <string.h>

#include "pareto/bench_pareto_draw.h"

enum { MOST_NAMES = 32 };

/* What tells the points of whole frames apart. */
enum { EXACT, ROBUST, FAST, FAST_MOLLER_TRUMBORE, FAST_ACCELERATED, WAYS };
static const char *const way_names[WAYS] = {"EXACT", "ROBUST", "FAST, watertight", "FAST, Möller-Trumbore",
                                            "FAST, accelerated"};
static const char *const bar_names[DRAW_BARS] = {"ROBUST", "EXACT"};

static size_t way_of(const pareto_row *row)
{
    if (row->precision != CGT_PRECISION_FAST)
        return row->precision == CGT_PRECISION_EXACT ? EXACT : ROBUST;
    return row->test == CGT_TRIANGLE_TEST_MOLLER_TRUMBORE ? FAST_MOLLER_TRUMBORE
           : row->test == CGT_TRIANGLE_TEST_ACCELERATED   ? FAST_ACCELERATED
                                                          : FAST;
}

/* Index of a name in a list, which it joins where it is new and there is room. */
static size_t index_of(const char *names[MOST_NAMES], size_t *count, const char *name)
{
    for (size_t i = 0; i < *count; i++)
        if (!strcmp(names[i], name))
            return i;
    if (*count < MOST_NAMES)
        names[(*count)++] = name;
    return *count - 1;
}

static draw_point *make_points(size_t count)
{
    draw_point *points = calloc(count + 1, sizeof *points);
    if (!points)
        program_error("out of memory");
    return points;
}

int pareto_plot(const pareto_table *table, const char *const *names, size_t scenes, const char *prefix)
{
    const char *variants[MOST_NAMES];
    draw_picture picture = {.count = table->count,
                            .scenes = names,
                            .variants = variants,
                            .kinds = way_names,
                            .scene_count = scenes,
                            .kind_count = WAYS,
                            .time_label = "ms a frame, build included",
                            .share_label = "wrong pixels per million",
                            .cost_label = "cost over FAST, % of the frame",
                            .bar_names = bar_names};
    draw_point *points = make_points(table->count);
    if (!points)
        return PROGRAM_FAILED;
    for (size_t i = 0; i < table->count; i++) {
        const pareto_row *row = &table->rows[i];
        const size_t way = way_of(row);
        points[i] = (draw_point){.scene = row->scene,
                                 .variant = index_of(variants, &picture.variant_count, row->variant),
                                 .kind = way,
                                 .time = row->ms,
                                 .share = pareto_error_share(&row->error),
                                 .of = row->error.rays,
                                 .ulp = (double)row->error.t_worst,
                                 .cost = row->cost,
                                 .bar = way == ROBUST  ? 0
                                        : way == EXACT ? 1
                                                       : -1};
    }
    picture.points = points;
    const int code = draw_picture_files(&picture, prefix);
    free(points);
    return code;
}

int pareto_plot_tests(const pareto_tests *tests, const char *prefix)
{
    static const char *const titles[] = {"tests alone"};
    const char *variants[MOST_NAMES], *kinds[PARETO_TESTS];
    draw_picture picture = {.count = tests->count,
                            .scenes = titles,
                            .variants = variants,
                            .kinds = kinds,
                            .scene_count = 1,
                            .kind_count = PARETO_TESTS,
                            .time_label = "ns a test",
                            .time_logarithmic = 1,
                            .share_label = "wrong answers per million"};
    draw_point *points = make_points(tests->count);
    if (!points)
        return PROGRAM_FAILED;
    for (int i = 0; i < PARETO_TESTS; i++)
        kinds[i] = pareto_test_name((pareto_test)i);
    for (size_t i = 0; i < tests->count; i++) {
        const pareto_test_row *row = &tests->rows[i];
        points[i] = (draw_point){.variant = index_of(variants, &picture.variant_count, row->name),
                                 .kind = (size_t)row->test,
                                 .time = row->ns,
                                 .share = pareto_error_share(&row->error),
                                 .of = row->error.rays,
                                 .ulp = (double)row->error.t_worst,
                                 .bar = -1};
    }
    picture.points = points;
    const int code = draw_picture_files(&picture, prefix);
    free(points);
    return code;
}
