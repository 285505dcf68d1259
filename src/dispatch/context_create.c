/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Creates contexts: checks the options, chooses the variant and starts the backend's threads. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "core/context.h"
#include "dispatch/variant.h"

#define MAX_THREADS 1024u

static const cgt_backend *const backend = &cgt_backend_host;

void cgt_context_options_init(cgt_context_options *options) { *options = (cgt_context_options){0}; }

/* There is no context to keep a message: it goes to the log and to the caller's text. */
CGT_PRINTF(3, 4) static cgt_result fail_create(const cgt_context_options *o, cgt_result result, const char *format, ...)
{
    char text[CGT_MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (o->message && o->message_size)
        snprintf(o->message, o->message_size, "%s", text);
    if (o->log.write)
        o->log.write(o->log.user, CGT_LOG_LEVEL_ERROR, text);
    return result;
}

static cgt_result find_variant(const cgt_context_options *o, const cgt_kernel **kernel)
{
    cgt_variant_state state;
    char unknown[CGT_VARIANT_NAME_BYTES];
    const char *name = o->variant ? o->variant : "any";
    *kernel = cgt_variant_find(o->variant, &state, unknown);
    switch (state) {
    case CGT_VARIANT_RUNS: return CGT_OK;
    case CGT_VARIANT_BAD_LIST:
        return fail_create(o, CGT_ERROR_INVALID_ARGUMENT, "CGT_DISABLE_CPU: there is no variant \"%s\"", unknown);
    case CGT_VARIANT_DISABLED:
        return fail_create(o, CGT_ERROR_UNSUPPORTED, "variant %s: disabled by CGT_DISABLE_CPU", name);
    case CGT_VARIANT_UNSUPPORTED:
        return fail_create(o, CGT_ERROR_UNSUPPORTED, "variant %s: this CPU lacks instructions that it needs", name);
    default: return fail_create(o, CGT_ERROR_INVALID_ARGUMENT, "variant %s: not in this build", name);
    }
}

static cgt_result check_options(const cgt_context_options *o, const cgt_kernel **kernel)
{
    if (!o->memory.allocate != !o->memory.release)
        return fail_create(o, CGT_ERROR_INVALID_ARGUMENT, "memory hooks: both functions are needed, or neither");
    if (o->threads > MAX_THREADS)
        return fail_create(o, CGT_ERROR_INVALID_ARGUMENT, "threads: %u, at most %u", o->threads, MAX_THREADS);
    return find_variant(o, kernel);
}

static cgt_result start_threads(cgt_context *c)
{
    if (c->tasks.run) {
        c->threads = 0;
        return CGT_OK;
    }
    if (!c->threads)
        c->threads = cgt_host_cpus();
    if (c->threads > MAX_THREADS)
        c->threads = MAX_THREADS;
    if (c->threads == 1)
        return CGT_OK;
    const cgt_result result = backend->create(&c->memory, c->threads, &c->backend_state);
    if (result == CGT_OK) {
        c->backend = backend;
        c->tasks = (cgt_task_runner){c->backend_state, backend->run};
    }
    return result;
}

static bool init_locks(cgt_context *c)
{
    if (pthread_mutex_init(&c->message_lock, NULL))
        return false;
    if (!pthread_mutex_init(&c->scratch_lock, NULL))
        return true;
    pthread_mutex_destroy(&c->message_lock);
    return false;
}

cgt_result cgt_context_create(const cgt_context_options *options, cgt_context **context)
{
    static const cgt_context_options defaults = {0};
    const cgt_context_options *o = options ? options : &defaults;
    const cgt_kernel *kernel = NULL;
    if (o->message && o->message_size)
        o->message[0] = 0;
    if (!context)
        return fail_create(o, CGT_ERROR_INVALID_ARGUMENT, "context must not be NULL");
    *context = NULL;
    cgt_result result = check_options(o, &kernel);
    if (result != CGT_OK)
        return result;
    const cgt_memory_hooks memory = o->memory.allocate ? o->memory : cgt_memory_default();
    cgt_context *c = cgt_allocate(&memory, sizeof *c);
    if (!c)
        return fail_create(o, CGT_ERROR_OUT_OF_MEMORY, "out of memory for a context");
    memset(c, 0, sizeof *c);
    c->memory = memory;
    c->log = o->log;
    c->tasks = o->tasks;
    c->kernel = kernel;
    c->threads = o->threads;
    atomic_init(&c->references, 1);
    atomic_init(&c->runner_lanes, CGT_FIRST_RUNNER_LANES);
    if (!init_locks(c)) {
        cgt_free(&memory, c, sizeof *c);
        return fail_create(o, CGT_ERROR_THREADS, "the system refused a lock");
    }
    result = start_threads(c);
    if (result != CGT_OK) {
        pthread_mutex_destroy(&c->scratch_lock);
        pthread_mutex_destroy(&c->message_lock);
        cgt_free(&memory, c, sizeof *c);
        return fail_create(o, result, "the threads could not be started");
    }
    *context = c;
    return CGT_OK;
}

const char *cgt_context_get_variant(const cgt_context *context) { return context->kernel->name; }
