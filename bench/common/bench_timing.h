/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The clocks of cgt-bench, its loop, and medians, because a shared machine has outliers in one direction only. */
#ifndef BENCH_TIMING_H
#define BENCH_TIMING_H

#include <stddef.h>
#include <stdint.h>

/* Milliseconds of a monotonic clock. */
double bench_now_ms(void);

/* Milliseconds that the process has had a CPU, its threads added up: what other programs do hardly counts. */
double bench_cpu_ms(void);

/* Milliseconds that the calling thread has had a CPU. */
double bench_thread_ms(void);

/* The clock of rays: of one thread the CPU's time, of more the monotonic clock. */
double bench_clock_ms(int is_one_thread);

/* One turn of a way. Returns an exit code. */
typedef int bench_turn(void *job, size_t way);

/* The loop of all measurements: ways take turns in each round, so that a slow moment of the machine affects all alike;
 * backwards in odd rounds, so that none always follows the same one. Round 0 is not timed: it warms up. Ends at the
 * first code that is not PROGRAM_OK, and returns it. */
int bench_round(uint32_t round, size_t ways, bench_turn *turn, void *job);

/* Sorts the values in place; the mean of the middle two where count is even; 0 where count is 0. */
double bench_median(double *values, size_t count);

#endif
