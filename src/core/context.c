/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Contexts: reference count, queries, running of tasks. dispatch/context_create.c creates them. */
#define _POSIX_C_SOURCE 200809L
#include "core/context.h"

#include <time.h>

#include "core/float_environment.h"
#include "core/scratch.h"

const char *cgt_get_version(void) { return CGT_VERSION_STRING; }

double cgt_now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

void cgt_context_retain(cgt_context *context) { atomic_fetch_add(&context->references, 1); }

void cgt_context_release(cgt_context *context)
{
    if (!context || atomic_fetch_sub(&context->references, 1) != 1)
        return;
    if (context->backend)
        context->backend->destroy(&context->memory, context->backend_state);
    pthread_mutex_destroy(&context->scratch_lock);
    pthread_mutex_destroy(&context->message_lock);
    const cgt_memory_hooks memory = context->memory;
    for (cgt_scratch *s = context->scratch, *next; s; s = next) {
        next = s->next;
        cgt_free(&memory, s, CGT_SCRATCH_BYTES);
    }
    cgt_buffer_release(&memory, &context->spare);
    cgt_free(&memory, context, sizeof *context);
}

uint32_t cgt_context_get_threads(const cgt_context *context) { return context->threads; }

/* A batch as a runner gets it. */
typedef struct task_batch {
    cgt_task *task;
    void *argument;
} task_batch;

static void run_task(void *argument, uint32_t index)
{
    const task_batch *batch = argument;
    cgt_float_environment runners;
    cgt_float_environment_enter(&runners);
    batch->task(batch->argument, index);
    cgt_float_environment_leave(&runners);
}

cgt_result cgt_context_run_tasks(cgt_context *context, cgt_task *task, void *argument, uint32_t count)
{
    if (!context)
        return CGT_ERROR_INVALID_ARGUMENT;
    if (context->failure != CGT_OK)
        return context->failure;
    if (!task)
        return cgt_fail(context, CGT_ERROR_INVALID_ARGUMENT, "task is NULL");
    cgt_run_tasks(context, task, argument, count);
    return CGT_OK;
}

void cgt_run_tasks(const cgt_context *context, cgt_task *task, void *argument, uint32_t count)
{
    task_batch batch = {task, argument};
    cgt_float_environment callers;
    if (count > 1 && context->tasks.run) {
        context->tasks.run(context->tasks.user, run_task, &batch, count);
        return;
    }
    cgt_float_environment_enter(&callers);
    for (uint32_t i = 0; i < count; i++)
        task(argument, i);
    cgt_float_environment_leave(&callers);
}
