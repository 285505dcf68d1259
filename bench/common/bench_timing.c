/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Clock, medians and quartiles. */
#define _POSIX_C_SOURCE 200809L

#include "common/bench_timing.h"

#include <stdlib.h>
#include <time.h>

double bench_now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

double bench_cpu_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

double bench_clock_ms(int is_one_thread) { return is_one_thread ? bench_cpu_ms() : bench_now_ms(); }

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The value at a fraction of sorted values, linear between neighbours. */
static double quantile(const double *sorted, size_t count, double fraction)
{
    const double position = fraction * (double)(count - 1);
    const size_t below = (size_t)position;
    const size_t above = below + 1 < count ? below + 1 : below;
    return sorted[below] + (position - (double)below) * (sorted[above] - sorted[below]);
}

bench_spread bench_spread_of(double *values, size_t count)
{
    bench_spread spread = {0.0, 0.0, 0.0};
    if (count == 0)
        return spread;
    qsort(values, count, sizeof *values, compare_doubles);
    spread.low = quantile(values, count, 0.25);
    spread.median = quantile(values, count, 0.5);
    spread.high = quantile(values, count, 0.75);
    return spread;
}

double bench_median(double *values, size_t count) { return bench_spread_of(values, count).median; }
