/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rows by several threads: the caller's runner's, or some that are made for each call. That takes some tens of
 * microseconds, and a call lasts milliseconds. */
#include <pthread.h>

#include "draw/draw.h"

enum { MAX_THREADS = 64 };

typedef struct rows_call {
    cgt_task *task;
    void *argument;
    uint32_t count;
    atomic_uint_fast64_t next; /* wider than count: it goes beyond */
} rows_call;

static void *work(void *argument)
{
    rows_call *call = argument;
    for (;;) {
        const uint64_t index = atomic_fetch_add_explicit(&call->next, 1, memory_order_relaxed);
        if (index >= call->count)
            return NULL;
        call->task(call->argument, (uint32_t)index);
    }
}

/* Where the system refuses a thread the others do its share. */
void cgt_draw_rows(const drawing *d, cgt_task *task, void *argument, uint32_t count)
{
    const cgt_task_runner *const runner = &d->options->tasks;
    pthread_t started[MAX_THREADS];
    uint32_t running = 0, threads = d->threads < MAX_THREADS ? d->threads : MAX_THREADS;
    rows_call call = {task, argument, count, 0};
    if (runner->run) {
        runner->run(runner->user, task, argument, count);
        return;
    }
    threads = threads < count ? threads : count;
    while (running + 1 < threads && pthread_create(&started[running], NULL, work, &call) == 0)
        running++;
    work(&call);
    for (uint32_t i = 0; i < running; i++)
        pthread_join(started[i], NULL);
}
