/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Threads that wait on a condition variable, and take pieces of a job from one atomic counter. */
#define _POSIX_C_SOURCE 200809L

#include "common/bench_threads.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

struct bench_threads {
    pthread_mutex_t lock;
    pthread_cond_t start, done;
    uint64_t job;     /* number of the current job; guarded by lock, as are the next two */
    uint32_t working; /* threads that have not finished the job */
    int quit;
    bench_task *task;
    void *argument;
    uint32_t count;
    atomic_uint_least64_t next; /* 64 bits: every thread counts once past the end */
    uint32_t started;
    pthread_t ids[];
};

static void take_pieces(bench_threads *threads)
{
    for (;;) {
        const uint64_t index = atomic_fetch_add_explicit(&threads->next, 1, memory_order_relaxed);
        if (index >= threads->count)
            return;
        threads->task(threads->argument, (uint32_t)index);
    }
}

static void *thread_main(void *argument)
{
    bench_threads *threads = argument;
    uint64_t seen = 0;

    pthread_mutex_lock(&threads->lock);
    for (;;) {
        while (threads->job == seen && !threads->quit)
            pthread_cond_wait(&threads->start, &threads->lock);
        if (threads->quit)
            break;
        seen = threads->job;
        pthread_mutex_unlock(&threads->lock);

        take_pieces(threads);

        pthread_mutex_lock(&threads->lock);
        if (--threads->working == 0)
            pthread_cond_signal(&threads->done);
    }
    pthread_mutex_unlock(&threads->lock);
    return NULL;
}

bench_threads *bench_threads_create(uint32_t count)
{
    if (count == 0 || count > BENCH_MOST_THREADS)
        return NULL;
    bench_threads *threads = calloc(1, sizeof *threads + (size_t)(count - 1) * sizeof(pthread_t));
    if (!threads)
        return NULL;
    pthread_mutex_init(&threads->lock, NULL);
    pthread_cond_init(&threads->start, NULL);
    pthread_cond_init(&threads->done, NULL);
    for (uint32_t i = 0; i + 1 < count; i++) {
        if (pthread_create(&threads->ids[i], NULL, thread_main, threads) != 0) {
            bench_threads_release(threads);
            return NULL;
        }
        threads->started++;
    }
    return threads;
}

void bench_threads_release(bench_threads *threads)
{
    if (!threads)
        return;
    pthread_mutex_lock(&threads->lock);
    threads->quit = 1;
    pthread_cond_broadcast(&threads->start);
    pthread_mutex_unlock(&threads->lock);
    for (uint32_t i = 0; i < threads->started; i++)
        pthread_join(threads->ids[i], NULL);
    pthread_cond_destroy(&threads->done);
    pthread_cond_destroy(&threads->start);
    pthread_mutex_destroy(&threads->lock);
    free(threads);
}

uint32_t bench_threads_count(const bench_threads *threads) { return threads->started + 1; }

void bench_threads_run(bench_threads *threads, bench_task *task, void *argument, uint32_t count)
{
    threads->task = task;
    threads->argument = argument;
    threads->count = count;
    atomic_store_explicit(&threads->next, 0, memory_order_relaxed);

    /* One piece is not worth waking anyone for. */
    if (threads->started == 0 || count <= 1) {
        take_pieces(threads);
        return;
    }
    pthread_mutex_lock(&threads->lock);
    threads->working = threads->started;
    threads->job++;
    pthread_cond_broadcast(&threads->start);
    pthread_mutex_unlock(&threads->lock);

    take_pieces(threads);

    pthread_mutex_lock(&threads->lock);
    while (threads->working != 0)
        pthread_cond_wait(&threads->done, &threads->lock);
    pthread_mutex_unlock(&threads->lock);
}
