/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Backends: they run a context's tasks where the caller has no runner of its own. Their source is in backends/; this
 * is the one header that src/ knows of them. */
#ifndef CGT_TASKS_H
#define CGT_TASKS_H

#include <cgt/cgt.h>

/* A backend: workers that are created once per context and run batches of tasks. Any number of threads may call run at
 * once; each call returns when its own tasks have returned. */
typedef struct cgt_backend {
    const char *name;
    /* Starts threads - 1 workers, threads at least 2: the caller of run works, too. OUT_OF_MEMORY, THREADS. */
    cgt_result (*create)(const cgt_memory_hooks *memory, uint32_t threads, void **state);
    /* Calls task(argument, index) for each index below count; returns when all have returned. Any number of threads may
     * call it at once. */
    void (*run)(void *state, cgt_task *task, void *argument, uint32_t count);
    /* Stops the workers; no call of run is under way. */
    void (*destroy)(const cgt_memory_hooks *memory, void *state);
} cgt_backend;

/* POSIX threads: backends/host_threads.c. */
extern const cgt_backend cgt_backend_host;

/* Number of CPUs that this process may use, at least 1. */
uint32_t cgt_host_cpus(void);

#endif
