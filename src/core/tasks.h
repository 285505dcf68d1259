/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What runs a context's tasks: a backend (backends/), or the caller's own runner. */
#ifndef CGT_TASKS_H
#define CGT_TASKS_H

#include <cgt/cgt.h>

/* A backend: workers that are created once per context and run batches of tasks. Any number of threads may call run at
 * once; each call returns when its own tasks have returned. */
typedef struct cgt_backend {
    const char *name;
    cgt_result (*create)(const cgt_memory_hooks *memory, uint32_t threads, void **state);
    void (*run)(void *state, cgt_task *task, void *argument, uint32_t count);
    void (*destroy)(const cgt_memory_hooks *memory, void *state); /* no call of run is under way */
} cgt_backend;

/* Threads of the host: backends/host_threads.c. */
extern const cgt_backend cgt_backend_host;

/* CPUs that this process may use, at least 1. */
uint32_t cgt_host_cpus(void);

#endif
