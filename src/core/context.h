/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The context: hooks, threads, variant, and the message of the last failure. */
#ifndef CGT_CONTEXT_H
#define CGT_CONTEXT_H

#include <pthread.h>
#include <stdatomic.h>

#include <cgt/research.h>

#include "core/error.h"
#include "core/memory.h"
#include "core/tasks.h"

struct cgt_context {
    cgt_memory_hooks memory;
    cgt_log_hook log;
    cgt_task_runner tasks;           /* run: the caller's, the backend's, or NULL where one thread does it all */
    const cgt_backend *backend;      /* NULL where none is used */
    void *backend_state;             /* of the backend */
    const struct cgt_kernel *kernel; /* dispatch/kernel.h */
    uint32_t threads;
    cgt_research_task_watcher *watcher; /* NULL: none */
    void *watcher_user;
    atomic_uint references; /* the caller's and one per scene */
    pthread_mutex_t message_lock;
    char message[CGT_MESSAGE_BYTES];
    pthread_mutex_t scratch_lock; /* never held over the caller's hooks */
    struct cgt_scratch *scratch;  /* blocks that no call has (core/scratch_tasks.h) */
    cgt_buffer spare;             /* likewise, of any size */
    atomic_uint runner_lanes;     /* tasks with scratch that a caller's runner gets at once */
};

void cgt_context_retain(cgt_context *context);

#define CGT_FIRST_RUNNER_LANES 8u

/* Runs task(argument, index) once for each index below count, in the default floating-point environment whatever that
 * of the threads; on the calling thread alone where there is one task or one thread, or a watcher, which gets the
 * function's name as the phase. */
#define cgt_run_tasks(context, task, argument, count) cgt_run_phase(context, #task, task, argument, count)
void cgt_run_phase(const cgt_context *context, const char *phase, cgt_task *task, void *argument, uint32_t count);

static inline void cgt_watch_task(const cgt_context *context, const char *phase, uint32_t count, uint32_t index,
                                  bool ended)
{
    if (context->watcher)
        context->watcher(context->watcher_user, phase, count, index, ended);
}

/* Milliseconds of a clock that never goes back. */
double cgt_now_ms(void);

#endif
