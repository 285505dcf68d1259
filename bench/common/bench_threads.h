/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Threads of cgt-bench's own for work that is timed together with the library's: making secondary rays.
 * They sleep while the library's threads trace. */
#ifndef BENCH_THREADS_H
#define BENCH_THREADS_H

#include <stdint.h>

#define BENCH_MOST_THREADS 65536u

typedef struct bench_threads bench_threads;

typedef void bench_task(void *argument, uint32_t index);

/* Starts count - 1 threads, the caller being the last; count is 1 to BENCH_MOST_THREADS. NULL where memory or threads
 * are refused. */
bench_threads *bench_threads_create(uint32_t count);

/* NULL: does nothing. */
void bench_threads_release(bench_threads *threads);

/* The caller counts too. */
uint32_t bench_threads_count(const bench_threads *threads);

/* Calls task(argument, index) for each index below count; returns when all have returned. */
void bench_threads_run(bench_threads *threads, bench_task *task, void *argument, uint32_t count);

#endif
