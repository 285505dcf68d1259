/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Contexts: which variant and which workers a new one gets. */
#include <string.h>

#include "core/context.h"
#include "dispatch/variant.h"

#define MAX_THREADS 1024u

void cgt_context_options_init(cgt_context_options *options) { memset(options, 0, sizeof *options); }

static cgt_result fail_create(const cgt_context_options *o, cgt_result result, const char *message)
{
    if (o->log.write)
        o->log.write(o->log.user, CGT_LOG_LEVEL_ERROR, message);
    return result;
}

static cgt_result find_variant(const cgt_context_options *o, const cgt_kernel **kernel)
{
    cgt_variant_state state;
    *kernel = cgt_variant_find(o->variant, &state);
    switch (state) {
    case CGT_VARIANT_RUNS: return CGT_OK;
    case CGT_VARIANT_DISABLED:
        return fail_create(o, CGT_ERROR_UNSUPPORTED,
                           o->variant ? "variant: CGT_DISABLE_CPU disables it"
                                      : "variant: CGT_DISABLE_CPU leaves none");
    case CGT_VARIANT_UNSUPPORTED:
        return fail_create(o, CGT_ERROR_UNSUPPORTED, "variant: this CPU lacks instructions that it needs");
    default: return fail_create(o, CGT_ERROR_INVALID_ARGUMENT, "variant: not in this build");
    }
}

static cgt_result check_options(const cgt_context_options *o, const cgt_kernel **kernel)
{
    if (!o->memory.allocate != !o->memory.release)
        return fail_create(o, CGT_ERROR_INVALID_ARGUMENT, "memory hooks: both functions are needed, or neither");
    if (o->threads > MAX_THREADS)
        return fail_create(o, CGT_ERROR_INVALID_ARGUMENT, "threads: at most 1024");
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
    const cgt_result result = cgt_backend_host.create(&c->memory, c->threads, &c->pool);
    if (result == CGT_OK)
        c->tasks = (cgt_task_runner){c->pool, cgt_backend_host.run};
    return result;
}

cgt_result cgt_context_create(const cgt_context_options *options, cgt_context **context)
{
    cgt_context_options defaults;
    const cgt_kernel *kernel = NULL;
    if (!context)
        return CGT_ERROR_INVALID_ARGUMENT;
    *context = NULL;
    if (!options) {
        cgt_context_options_init(&defaults);
        options = &defaults;
    }
    cgt_result result = check_options(options, &kernel);
    if (result != CGT_OK)
        return result;
    const cgt_memory_hooks memory = options->memory.allocate ? options->memory : cgt_memory_default();
    cgt_context *c = cgt_allocate(&memory, sizeof *c);
    if (!c)
        return fail_create(options, CGT_ERROR_OUT_OF_MEMORY, "out of memory for a context");
    memset(c, 0, sizeof *c);
    c->memory = memory;
    c->log = options->log;
    c->tasks = options->tasks;
    c->kernel = kernel;
    c->threads = options->threads;
    atomic_init(&c->references, 1);
    if (pthread_mutex_init(&c->message_lock, NULL)) {
        cgt_free(&memory, c, sizeof *c);
        return fail_create(options, CGT_ERROR_THREADS, "the system refused a lock");
    }
    result = start_threads(c);
    if (result != CGT_OK) {
        pthread_mutex_destroy(&c->message_lock);
        cgt_free(&memory, c, sizeof *c);
        return fail_create(options, result, "the threads could not be started");
    }
    *context = c;
    return CGT_OK;
}

const char *cgt_context_get_variant(const cgt_context *context) { return context->kernel->name; }
