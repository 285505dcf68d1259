/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Clocks, the loop, medians. */
#define _POSIX_C_SOURCE 200809L

#include "common/bench_timing.h"

#include <stdlib.h>
#include <time.h>

#include "common/program.h"

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

double bench_thread_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

double bench_clock_ms(int is_one_thread) { return is_one_thread ? bench_cpu_ms() : bench_now_ms(); }

int bench_round(uint32_t round, size_t ways, bench_turn *turn, void *job)
{
    int code = PROGRAM_OK;
    for (size_t step = 0; step < ways && code == PROGRAM_OK; step++)
        code = turn(job, round % 2 ? ways - 1 - step : step);
    return code;
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double bench_median(double *values, size_t count)
{
    if (count == 0)
        return 0.0;
    qsort(values, count, sizeof *values, compare_doubles);
    return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
}
