/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The host backend: a pool of POSIX threads. Tasks are numbers that the next free thread takes, so that tiles of uneven
 * cost balance by themselves (the thesis' dynamic assignment of envelopes to SPEs). The calling thread works, too. Idle
 * threads sleep on a condition variable: a spin would burn a core that a simulation needs. Before that they spin for
 * some microseconds, about the time that it takes to wake a thread: a commit comes as several calls, one after the
 * other. */
#define _GNU_SOURCE /* sched_getaffinity */
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <time.h>
#include <unistd.h>

#include "core/memory.h"
#include "core/sanitized.h"
#include "core/tasks.h"

/* A task takes less than 128 KB (cgt.h). Sanitizers give each variable of each inlined copy a place of its own between
 * red zones: there a task takes several MB. The guard is wider than a frame, so that none steps over it. */
#define WORKER_STACK ((size_t)(CGT_SANITIZED ? 64 : 4) << 20)
#define WORKER_GUARD (WORKER_STACK / 8)
#define SPIN_NS 50000

/* One call of run: it lives on the caller's stack while it is in the pool's list. */
typedef struct job {
    cgt_task *task;
    void *argument;
    uint32_t count;
    atomic_uint next;           /* the first index not taken; may run past count by one per worker */
    atomic_uint active_workers; /* workers inside; changed under the pool's lock */
    struct job *link;           /* the next job; under the pool's lock */
} job;

typedef struct pool {
    pthread_mutex_t lock;
    pthread_cond_t job_posted;  /* a job has come, or stop */
    pthread_cond_t worker_left; /* a worker has left a job */
    job *jobs;
    atomic_uint posted_jobs; /* jobs so far; changed under the lock */
    bool stop;
    uint32_t workers;  /* started, the caller not counted */
    uint32_t capacity; /* length of thread */
    pid_t process;     /* that has the workers: a forked child has a copy of the pool without them */
    pthread_t thread[];
} pool;

static size_t pool_bytes(uint32_t capacity) { return sizeof(pool) + capacity * sizeof(pthread_t); }

static void run_tasks(job *j)
{
    /* check before taking: many visits to a finished job must not overflow the counter */
    while (atomic_load_explicit(&j->next, memory_order_relaxed) < j->count) {
        const uint32_t index = atomic_fetch_add_explicit(&j->next, 1, memory_order_relaxed);
        if (index >= j->count)
            return;
        j->task(j->argument, index);
    }
}

static job *find_job(const pool *p)
{
    job *j = p->jobs;
    while (j && atomic_load_explicit(&j->next, memory_order_relaxed) >= j->count)
        j = j->link;
    return j;
}

static int64_t now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

static void spin_pause(void)
{
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
}

/* Spins for up to 50 us until (*number == value) == equal. Returns false on timeout. */
static bool spin_until(atomic_uint *number, unsigned value, bool equal)
{
    const int64_t end = now_ns() + SPIN_NS;
    do
        for (int k = 0; k < 32; k++) {
            if ((atomic_load_explicit(number, memory_order_acquire) == value) == equal)
                return true;
            spin_pause();
        }
    while (now_ns() < end);
    return false;
}

static void *worker(void *state)
{
    pool *p = state;
    bool idle = true;
    pthread_mutex_lock(&p->lock);
    while (!p->stop) {
        job *j = find_job(p);
        if (!j && idle) {
            pthread_cond_wait(&p->job_posted, &p->lock);
            continue;
        }
        if (!j) {
            const unsigned posted_jobs = atomic_load_explicit(&p->posted_jobs, memory_order_relaxed);
            pthread_mutex_unlock(&p->lock);
            (void)spin_until(&p->posted_jobs, posted_jobs, false);
            pthread_mutex_lock(&p->lock);
            idle = true;
            continue;
        }
        atomic_fetch_add_explicit(&j->active_workers, 1, memory_order_relaxed);
        pthread_mutex_unlock(&p->lock);
        run_tasks(j);
        pthread_mutex_lock(&p->lock);
        idle = false;
        /* after the last decrement the caller may return at once: the job is gone */
        if (atomic_fetch_sub_explicit(&j->active_workers, 1, memory_order_release) == 1)
            pthread_cond_broadcast(&p->worker_left);
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

/* Whether this process has the workers. After fork the child has the caller's thread alone, and a lock or a condition
 * variable may be as a worker left it at that moment: the child must touch none of them. */
static bool has_workers(const pool *p) { return getpid() == p->process; }

static void remove_job(pool *p, const job *j)
{
    job **link_at = &p->jobs;
    while (*link_at != j)
        link_at = &(*link_at)->link;
    *link_at = j->link;
}

static void host_run(void *state, cgt_task *task, void *argument, uint32_t count)
{
    pool *p = state;
    job j = {.task = task, .argument = argument, .count = count};
    atomic_init(&j.next, 0);
    atomic_init(&j.active_workers, 0);
    if (!has_workers(p)) {
        run_tasks(&j);
        return;
    }
    pthread_mutex_lock(&p->lock);
    j.link = p->jobs;
    p->jobs = &j;
    atomic_fetch_add_explicit(&p->posted_jobs, 1, memory_order_release);
    pthread_cond_broadcast(&p->job_posted);
    pthread_mutex_unlock(&p->lock);

    run_tasks(&j);

    /* no worker can enter once the job is out of the list; wait for those inside */
    pthread_mutex_lock(&p->lock);
    remove_job(p, &j);
    pthread_mutex_unlock(&p->lock);
    if (spin_until(&j.active_workers, 0, true))
        return;
    pthread_mutex_lock(&p->lock);
    while (atomic_load_explicit(&j.active_workers, memory_order_acquire))
        pthread_cond_wait(&p->worker_left, &p->lock);
    pthread_mutex_unlock(&p->lock);
}

static void stop_workers(pool *p)
{
    pthread_mutex_lock(&p->lock);
    p->stop = true;
    pthread_cond_broadcast(&p->job_posted);
    pthread_mutex_unlock(&p->lock);
    for (uint32_t i = 0; i < p->workers; i++)
        pthread_join(p->thread[i], NULL);
    pthread_cond_destroy(&p->worker_left);
    pthread_cond_destroy(&p->job_posted);
    pthread_mutex_destroy(&p->lock);
}

static void host_destroy(const cgt_memory_hooks *memory, void *state)
{
    pool *p = state;
    if (!p)
        return;
    if (has_workers(p))
        stop_workers(p);
    cgt_free(memory, p, pool_bytes(p->capacity));
}

static bool init_locks(pool *p)
{
    if (pthread_mutex_init(&p->lock, NULL))
        return false;
    if (pthread_cond_init(&p->job_posted, NULL)) {
        pthread_mutex_destroy(&p->lock);
        return false;
    }
    if (!pthread_cond_init(&p->worker_left, NULL))
        return true;
    pthread_cond_destroy(&p->job_posted);
    pthread_mutex_destroy(&p->lock);
    return false;
}

/* Starts workers up to the capacity; false where one could not be started. */
static bool start_workers(pool *p)
{
    pthread_attr_t attributes;
    bool started = true;
    if (pthread_attr_init(&attributes))
        return false;
    /* some C libraries give threads less than a task takes; where this fails the default has to do */
    (void)pthread_attr_setstacksize(&attributes, WORKER_STACK);
#ifndef _WIN32 /* where every stack has a guard */
    (void)pthread_attr_setguardsize(&attributes, WORKER_GUARD);
#endif
    while (started && p->workers < p->capacity) {
        started = !pthread_create(&p->thread[p->workers], &attributes, worker, p);
        p->workers += started;
    }
    pthread_attr_destroy(&attributes);
    return started;
}

static cgt_result host_create(const cgt_memory_hooks *memory, uint32_t threads, void **state)
{
    const uint32_t capacity = threads - 1;
    pool *p = cgt_allocate(memory, pool_bytes(capacity));
    *state = NULL;
    if (!p)
        return CGT_ERROR_OUT_OF_MEMORY;
    p->jobs = NULL;
    atomic_init(&p->posted_jobs, 0);
    p->stop = false;
    p->workers = 0;
    p->capacity = capacity;
    p->process = getpid();
    if (!init_locks(p)) {
        cgt_free(memory, p, pool_bytes(capacity));
        return CGT_ERROR_THREADS;
    }
    if (!start_workers(p)) {
        host_destroy(memory, p);
        return CGT_ERROR_THREADS;
    }
    *state = p;
    return CGT_OK;
}

uint32_t cgt_host_cpus(void)
{
#ifdef __linux__
    cpu_set_t set;
    if (!sched_getaffinity(0, sizeof set, &set) && CPU_COUNT(&set) > 0)
        return (uint32_t)CPU_COUNT(&set);
#endif
#ifdef _WIN32
    const long cpus = pthread_num_processors_np();
#else
    const long cpus = sysconf(_SC_NPROCESSORS_ONLN);
#endif
    return cpus > 0 ? (uint32_t)cpus : 1;
}

const cgt_backend cgt_backend_host = {"host", host_create, host_run, host_destroy};
