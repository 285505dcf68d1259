/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The rows of cgt-bench scaling, and how fast times grow. Exponents are those of the shortest times: disturbances on a
 * shared machine only add time. */
#include <math.h>

#include "scaling/bench_scaling.h"

static const char *sweep_name(scaling_sweep sweep)
{
    return sweep == SCALING_PRIMITIVES ? "primitives" : sweep == SCALING_PIXELS ? "pixels" : "threads";
}

static const char *kind_name(scaling_kind kind) { return kind == SCALING_SPHERES ? "spheres" : "triangles"; }

double scaling_size(const scaling_point *point)
{
    if (point->sweep == SCALING_PIXELS)
        return (double)point->width * point->height;
    return point->sweep == SCALING_THREADS ? (double)point->threads : (double)point->built.primitives;
}

/* Of y ~ x^exponent; NaN if two points do not determine it. */
static double exponent_of(double x0, double y0, double x1, double y1)
{
    return x0 > 0.0 && x1 > 0.0 && x0 != x1 && y0 > 0.0 && y1 > 0.0 ? log(y1 / y0) / log(x1 / x0) : NAN;
}

void scaling_table_row(bench_table *table, const scaling_point *point, const scaling_point *before)
{
    static const char *const medians[] = {"bounds_ms", "build_ms", "primary_ms", "frame_ms"};
    static const char *const shortest[] = {"bounds_min_ms", "build_min_ms", "primary_min_ms", "frame_min_ms"};
    static const char *const exponents[] = {"bounds_exponent", "build_exponent", "primary_exponent", "frame_exponent"};
    const double primitives = point->built.primitives ? (double)point->built.primitives : NAN;
    const double size = scaling_size(point);
    bench_table_section(table, "scaling");
    bench_table_text(table, "config", point->config);
    bench_table_text(table, "sweep", sweep_name(point->sweep));
    bench_table_text(table, "kind", kind_name(point->kind));
    bench_table_count(table, "primitives", point->built.primitives);
    bench_table_count(table, "width", point->width);
    bench_table_count(table, "height", point->height);
    bench_table_count(table, "pixels", (uint64_t)point->width * point->height);
    bench_table_count(table, "threads", point->threads);
    for (int c = 0; c < SCALING_COLUMNS; c++)
        bench_table_real(table, medians[c], point->median[c]);
    for (int c = 0; c < SCALING_COLUMNS; c++)
        bench_table_real(table, shortest[c], point->low[c]);
    for (int c = 0; c < SCALING_COLUMNS; c++)
        bench_table_real(table, exponents[c],
                         before ? exponent_of(scaling_size(before), before->low[c], size, point->low[c]) : NAN);
    bench_table_count(table, "hit_pixels", point->hits);
    bench_table_count(table, "bytes", point->built.bytes); /* of the scene; of its structure */
    bench_table_real(table, "bytes_per_primitive", (double)point->built.bytes / primitives);
    bench_table_count(table, "structure_bytes", point->built.structure_bytes);
    bench_table_real(table, "structure_bytes_per_primitive", (double)point->built.structure_bytes / primitives);
    bench_table_count(table, "allocations", point->allocations);
    bench_table_count(table, "steady_allocations", point->steady_allocations);
    bench_table_end_row(table);
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

void scaling_table_exponents(bench_table *table, const scaling_point *points, size_t count)
{
    static const char *const columns[] = {"bounds", "build", "primary", "frame"};
    bench_table_section(table, "exponents");
    for (size_t first = 0, end; first < count; first = end) {
        const scaling_point *p = &points[first];
        for (end = first + 1; end < count && points[end].sweep == p->sweep && points[end].kind == p->kind; end++)
            continue;
        bench_table_text(table, "config", p->config);
        bench_table_text(table, "sweep", sweep_name(p->sweep));
        bench_table_text(table, "kind", kind_name(p->kind));
        bench_table_real(table, "from", scaling_size(p));
        bench_table_real(table, "to", scaling_size(&points[end - 1]));
        for (int c = 0; c < SCALING_COLUMNS; c++)
            bench_table_real(table, columns[c], fit(p, end - first, c));
        bench_table_end_row(table);
    }
}
