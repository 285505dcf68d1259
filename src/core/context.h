/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The context: hooks, threads, variant, and the message of the last failure. */
#ifndef CGT_CONTEXT_H
#define CGT_CONTEXT_H

#include <pthread.h>
#include <stdatomic.h>

#include <cgt/cgt.h>

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
    cgt_result failure;              /* of its creation: such a context has its message, and nothing else */
    uint32_t threads;
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
 * of the threads; on the calling thread alone where there is one task or one thread. */
void cgt_run_tasks(const cgt_context *context, cgt_task *task, void *argument, uint32_t count);

/* Milliseconds of a clock that never goes back. */
double cgt_now_ms(void);

#endif
