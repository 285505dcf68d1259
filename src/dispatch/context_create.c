/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Creates contexts: checks the options, chooses the variant and starts the backend's threads. */
#include <string.h>

#include "core/context.h"
#include "dispatch/variant.h"

#define MAX_THREADS 1024u

static const cgt_backend *const backend = &cgt_backend_host;

void cgt_context_options_init(cgt_context_options *options) { *options = (cgt_context_options){0}; }

static cgt_result find_variant(cgt_context *c, const cgt_context_options *o)
{
    cgt_variant_state state;
    char unknown[CGT_VARIANT_NAME_BYTES];
    const char *name = o->variant ? o->variant : "any";
    c->kernel = cgt_variant_find(o->variant, &state, unknown);
    switch (state) {
    case CGT_VARIANT_RUNS: return CGT_OK;
    case CGT_VARIANT_BAD_LIST:
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "CGT_DISABLE_CPU: there is no variant \"%s\"", unknown);
    case CGT_VARIANT_DISABLED:
        return cgt_fail(c, CGT_ERROR_UNSUPPORTED, "variant %s: disabled by CGT_DISABLE_CPU", name);
    case CGT_VARIANT_UNSUPPORTED:
        return cgt_fail(c, CGT_ERROR_UNSUPPORTED, "variant %s: this CPU lacks instructions that it needs", name);
    default: return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "variant %s: not in this build", name);
    }
}

static cgt_result check_options(cgt_context *c, const cgt_context_options *o)
{
    if (!o->memory.allocate != !o->memory.release)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "memory hooks: both functions are needed, or neither");
    if (!o->tasks.run && o->threads > MAX_THREADS)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "threads: %u, at most %u", o->threads, MAX_THREADS);
    return find_variant(c, o);
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

/* Returns a context without variant and threads, or NULL. */
static cgt_context *make_context(const cgt_context_options *o)
{
    const cgt_memory_hooks memory = o->memory.allocate && o->memory.release ? o->memory : cgt_memory_default();
    cgt_context *c = cgt_allocate(&memory, sizeof *c);
    if (!c)
        return NULL;
    memset(c, 0, sizeof *c);
    c->memory = memory;
    c->log = o->log;
    atomic_init(&c->references, 1);
    atomic_init(&c->runner_lanes, CGT_FIRST_RUNNER_LANES);
    if (init_locks(c))
        return c;
    cgt_free(&memory, c, sizeof *c);
    return NULL;
}

static void log_refusal(const cgt_context_options *o, const char *reason)
{
    if (o->log.write)
        o->log.write(o->log.user, CGT_LOG_LEVEL_ERROR, reason);
}

cgt_result cgt_context_create(const cgt_context_options *options, cgt_context **context)
{
    static const cgt_context_options defaults = {0};
    const cgt_context_options *o = options ? options : &defaults;
    if (!context) {
        log_refusal(o, "context must not be NULL");
        return CGT_ERROR_INVALID_ARGUMENT;
    }
    cgt_context *c = *context = make_context(o);
    if (!c) {
        log_refusal(o, "out of memory for a context");
        return CGT_ERROR_OUT_OF_MEMORY;
    }
    c->failure = check_options(c, o);
    if (c->failure == CGT_OK) {
        c->tasks = o->tasks;
        c->threads = o->threads;
        c->failure = start_threads(c);
        if (c->failure != CGT_OK)
            cgt_fail(c, c->failure, "the threads could not be started");
    }
    if (c->failure != CGT_OK)
        c->threads = 0;
    return c->failure;
}

const char *cgt_context_get_variant(const cgt_context *context)
{
    return context->failure == CGT_OK ? context->kernel->name : "";
}
