/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Threads of the page; see web_tasks.h. Tasks are numbers that the next free thread takes. */
#include "web/web_tasks.h"

#include <pthread.h>
#include <stdatomic.h>

static struct {
    pthread_mutex_t lock;
    pthread_cond_t posted, left;
    cgt_task *task;
    void *argument;
    uint32_t count;
    uint32_t jobs; /* so far */
    uint32_t busy; /* workers that are still in the last one */
    uint32_t workers;
    atomic_uint_fast64_t next; /* wider than count: it goes beyond */
} pool = {.lock = PTHREAD_MUTEX_INITIALIZER, .posted = PTHREAD_COND_INITIALIZER, .left = PTHREAD_COND_INITIALIZER};

static void work_off(void)
{
    for (;;) {
        const uint64_t index = atomic_fetch_add_explicit(&pool.next, 1, memory_order_relaxed);
        if (index >= pool.count)
            return;
        pool.task(pool.argument, (uint32_t)index);
    }
}

static void *work(void *unused)
{
    uint32_t seen = 0;
    (void)unused;
    pthread_mutex_lock(&pool.lock);
    for (;;) { /* until the page goes */
        while (seen == pool.jobs)
            pthread_cond_wait(&pool.posted, &pool.lock);
        seen = pool.jobs;
        pthread_mutex_unlock(&pool.lock);
        work_off();
        pthread_mutex_lock(&pool.lock);
        if (--pool.busy == 0)
            pthread_cond_signal(&pool.left);
    }
    return NULL;
}

uint32_t web_tasks_start(uint32_t threads)
{
    pthread_t thread;
    while (pool.workers + 1 < threads && pool.workers < 63 && pthread_create(&thread, NULL, work, NULL) == 0)
        pool.workers++;
    return pool.workers + 1;
}

void web_tasks_run(void *user, cgt_task *task, void *argument, uint32_t count)
{
    (void)user;
    if (!pool.workers || count < 2) {
        for (uint32_t i = 0; i < count; i++)
            task(argument, i);
        return;
    }
    pthread_mutex_lock(&pool.lock);
    pool.task = task;
    pool.argument = argument;
    pool.count = count;
    atomic_store_explicit(&pool.next, 0, memory_order_relaxed);
    pool.busy = pool.workers;
    pool.jobs++;
    pthread_cond_broadcast(&pool.posted);
    pthread_mutex_unlock(&pool.lock);
    work_off();
    pthread_mutex_lock(&pool.lock);
    while (pool.busy)
        pthread_cond_wait(&pool.left, &pool.lock);
    pthread_mutex_unlock(&pool.lock);
}
