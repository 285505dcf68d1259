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

cgt_result cgt_research_watch_tasks(cgt_context *context, cgt_research_task_watcher *watcher, void *user)
{
    if (!context)
        return CGT_ERROR_INVALID_ARGUMENT;
    context->watcher = watcher;
    context->watcher_user = user;
    return CGT_OK;
}

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

void cgt_run_phase(const cgt_context *context, const char *phase, cgt_task *task, void *argument, uint32_t count)
{
    task_batch batch = {task, argument};
    cgt_float_environment callers;
    if (count > 1 && context->tasks.run && !context->watcher) {
        context->tasks.run(context->tasks.user, run_task, &batch, count);
        return;
    }
    cgt_float_environment_enter(&callers);
    for (uint32_t i = 0; i < count; i++) {
        cgt_watch_task(context, phase, count, i, false);
        task(argument, i);
        cgt_watch_task(context, phase, count, i, true);
    }
    cgt_float_environment_leave(&callers);
}
