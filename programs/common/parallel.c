/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pieces of work by several threads; see parallel.h. Threads are made for each call: that takes some tens of
 * microseconds, and a call lasts milliseconds. */
#include "common/parallel.h"

#include <pthread.h>
#include <stdatomic.h>

#include "system/system.h"

enum { MAX_THREADS = 64 };

typedef struct parallel_call {
    parallel_piece *piece;
    void *argument;
    uint32_t count;
    atomic_uint_fast64_t next; /* wider than count: it goes beyond */
} parallel_call;

static void *work(void *argument)
{
    parallel_call *call = argument;
    for (;;) {
        const uint64_t index = atomic_fetch_add_explicit(&call->next, 1, memory_order_relaxed);
        if (index >= call->count)
            return NULL;
        call->piece(call->argument, (uint32_t)index);
    }
}

void parallel_run(uint32_t threads, parallel_piece *piece, void *argument, uint32_t count)
{
    pthread_t started[MAX_THREADS];
    uint32_t running = 0;
    parallel_call call = {piece, argument, count, 0};
    threads = threads < MAX_THREADS ? threads : MAX_THREADS;
    threads = threads < count ? threads : count;
    while (running + 1 < threads && pthread_create(&started[running], NULL, work, &call) == 0)
        running++;
    work(&call);
    for (uint32_t i = 0; i < running; i++)
        pthread_join(started[i], NULL);
}

uint32_t parallel_threads(uint32_t threads)
{
    threads = threads ? threads : system_cpus();
    threads = threads ? threads : 1;
    return threads < MAX_THREADS ? threads : MAX_THREADS;
}

uint32_t parallel_memory(void)
{
    const uint64_t bytes = system_memory(), mib = bytes > 0 ? bytes >> 22 : 1024;
    return mib < UINT32_MAX ? (uint32_t)mib : UINT32_MAX;
}
