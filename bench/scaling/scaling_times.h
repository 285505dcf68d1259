/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The times of a call's tasks, and from these how long the call takes where any number of threads shares them by the
 * rule of backends/host_threads.c: each takes the next number as soon as it is free, and a batch ends before the next
 * one begins. What lies between batches is one thread's. Memory's bandwidth, caches and the time to wake a thread are
 * not modelled, so that this is a limit. */
#ifndef SCALING_TIMES_H
#define SCALING_TIMES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Tasks that run at the same time. */
typedef struct scaling_batch {
    const char *phase; /* the library's name for it */
    size_t first, tasks;
} scaling_batch;

typedef struct scaling_times {
    double *ms; /* of each task */
    scaling_batch *batch;
    size_t batches, batch_room, task_room;
    double serial_ms;
    double began_ms, ended_ms; /* when the last task began and ended, or the call began */
    bool failed;               /* memory was refused: what is here is not complete */
} scaling_times;

/* Forgets all, but keeps the memory. */
void scaling_times_reset(scaling_times *times);
void scaling_times_release(scaling_times *times);

/* Around a call; several calls add up. */
void scaling_times_begin(scaling_times *times);
void scaling_times_end(scaling_times *times);

/* A cgt_research_task_watcher; user: scaling_times. */
void scaling_times_watch(void *user, const char *phase, uint32_t tasks, uint32_t task, bool ended);

/* Milliseconds, of all batches of a phase or of a call. */
typedef struct scaling_figures {
    double tasks;     /* how many */
    double longest;   /* task */
    double sum;       /* what one thread takes */
    double simulated; /* what so many threads take */
    double limit;     /* what any number of threads takes: the longest task of each batch, and all that is serial */
} scaling_figures;

extern const char scaling_serial[]; /* what is in no task, as a phase */

/* phase: NULL for the whole call; busy_until: room for a number for each thread. */
scaling_figures scaling_simulate(const scaling_times *times, const char *phase, uint32_t threads, double *busy_until);

#endif
