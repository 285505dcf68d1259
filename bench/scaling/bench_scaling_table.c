/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The rows of cgt-bench scaling, and how fast times grow. Exponents are of the shortest times: what disturbs a shared
 * machine only adds. */
#include <math.h>

#include "scaling/bench_scaling.h"

static const char *sweep_name(scaling_sweep sweep)
{
    return sweep == SCALING_PRIMITIVES ? "primitives" : sweep == SCALING_PIXELS ? "pixels" : "threads";
}

static const char *kind_name(scaling_kind kind) { return kind == SCALING_SPHERES ? "spheres" : "triangles"; }

void scaling_table_begin(accuracy_report *report)
{
    static const char *const columns[] = {"config",
                                          "sweep",
                                          "kind",
                                          "primitives",
                                          "width",
                                          "height",
                                          "pixels",
                                          "threads",
                                          "bounds_ms", /* medians, and below the shortest */
                                          "build_ms",
                                          "primary_ms",
                                          "frame_ms",
                                          "bounds_min_ms",
                                          "build_min_ms",
                                          "primary_min_ms",
                                          "frame_min_ms",
                                          "bounds_exponent", /* from the point before to this one */
                                          "build_exponent",
                                          "primary_exponent",
                                          "frame_exponent",
                                          "hit_pixels",
                                          "bytes", /* that the scene holds, and its structure alone */
                                          "bytes_per_primitive",
                                          "structure_bytes",
                                          "structure_bytes_per_primitive",
                                          "allocations",
                                          "steady_allocations",
                                          NULL};
    accuracy_report_table(report, "scaling", columns);
}

double scaling_size(const scaling_point *point)
{
    if (point->sweep == SCALING_PIXELS)
        return (double)point->width * point->height;
    return point->sweep == SCALING_THREADS ? (double)point->threads : (double)point->built.primitives;
}

/* Of y ~ x^exponent; NaN where two points do not tell. */
static double exponent_of(double x0, double y0, double x1, double y1)
{
    return x0 > 0.0 && x1 > 0.0 && x0 != x1 && y0 > 0.0 && y1 > 0.0 ? log(y1 / y0) / log(x1 / x0) : NAN;
}

void scaling_table_row(accuracy_report *report, const scaling_point *point, const scaling_point *before)
{
    const double primitives = point->built.primitives ? (double)point->built.primitives : NAN;
    accuracy_report_text(report, point->config);
    accuracy_report_text(report, sweep_name(point->sweep));
    accuracy_report_text(report, kind_name(point->kind));
    accuracy_report_count(report, point->built.primitives);
    accuracy_report_count(report, point->width);
    accuracy_report_count(report, point->height);
    accuracy_report_count(report, (uint64_t)point->width * point->height);
    accuracy_report_count(report, point->threads);
    for (int c = 0; c < SCALING_COLUMNS; c++)
        accuracy_report_real(report, point->median[c]);
    for (int c = 0; c < SCALING_COLUMNS; c++)
        accuracy_report_real(report, point->low[c]);
    for (int c = 0; c < SCALING_COLUMNS; c++)
        accuracy_report_real(
            report,
            before ? exponent_of(scaling_size(before), before->low[c], scaling_size(point), point->low[c]) : NAN);
    accuracy_report_count(report, point->hits);
    accuracy_report_count(report, point->built.bytes);
    accuracy_report_real(report, (double)point->built.bytes / primitives);
    accuracy_report_count(report, point->built.structure_bytes);
    accuracy_report_real(report, (double)point->built.structure_bytes / primitives);
    accuracy_report_count(report, point->allocations);
    accuracy_report_count(report, point->steady_allocations);
}

/* The slope of log(time) over log(size); NaN where there is none. */
static double fit(const scaling_point *points, size_t count, int column)
{
    double n = 0.0, x_sum = 0.0, y_sum = 0.0, xx = 0.0, xy = 0.0;
    for (size_t i = 0; i < count; i++) {
        if (!(points[i].low[column] > 0.0))
            continue;
        const double x = log(scaling_size(&points[i])), y = log(points[i].low[column]);
        n += 1.0;
        x_sum += x;
        y_sum += y;
        xx += x * x;
        xy += x * y;
    }
    const double below = n * xx - x_sum * x_sum;
    return n >= 2.0 && below > 0.0 ? (n * xy - x_sum * y_sum) / below : NAN;
}

void scaling_table_exponents(accuracy_report *report, const scaling_point *points, size_t count)
{
    static const char *const columns[] = {"config", "sweep", "kind",    "from",  "to",
                                          "bounds", "build", "primary", "frame", NULL};
    accuracy_report_table(report, "exponents", columns);
    for (size_t first = 0, end; first < count; first = end) {
        const scaling_point *p = &points[first];
        for (end = first + 1; end < count && points[end].sweep == p->sweep && points[end].kind == p->kind; end++)
            continue;
        accuracy_report_text(report, p->config);
        accuracy_report_text(report, sweep_name(p->sweep));
        accuracy_report_text(report, kind_name(p->kind));
        accuracy_report_real(report, scaling_size(p));
        accuracy_report_real(report, scaling_size(&points[end - 1]));
        for (int c = 0; c < SCALING_COLUMNS; c++)
            accuracy_report_real(report, fit(p, end - first, c));
    }
}
