/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small stacks: every call on 64 KB of its caller's, tasks included where they run there, and tasks on 128 KB of the
 * threads of a caller's runner. Stacks are painted, and what was written is counted. */
#define _POSIX_C_SOURCE 200809L
#include "api/calls.h"
#include "support/suite.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define CALL_BYTES (64u * 1024)
#define TASK_BYTES (128u * 1024)
#define STACK_BYTES (2u * 1024 * 1024) /* painted, so that a call that takes too much is measured */
#define PAINT 0xa7

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define SANITIZED 1
#endif
#endif
#ifndef SANITIZED
#define SANITIZED 0
#endif

/* ---- stacks ---- */

typedef struct stack_job {
    cgt_result (*call)(api_results *);
    api_results *work;
    cgt_result result;
} stack_job;

static void *run_job(void *argument)
{
    stack_job *j = argument;
    j->result = j->call(j->work);
    return NULL;
}

/* Returns the bytes of a painted stack that a call wrote. */
static size_t stack_used(cgt_result (*call)(api_results *), api_results *w)
{
    stack_job job = {call, w, CGT_OK};
    unsigned char *stack = aligned_alloc(65536, STACK_BYTES);
    pthread_attr_t attributes;
    pthread_t thread;
    size_t unused = 0;
    assert_non_null(stack);
    memset(stack, PAINT, STACK_BYTES);
    assert_int_equal(pthread_attr_init(&attributes), 0);
    assert_int_equal(pthread_attr_setstack(&attributes, stack, STACK_BYTES), 0);
    assert_int_equal(pthread_create(&thread, &attributes, run_job, &job), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
    pthread_attr_destroy(&attributes);
    while (unused < STACK_BYTES && stack[unused] == PAINT)
        unused++;
    free(stack);
    assert_int_equal(job.result, CGT_OK);
    return STACK_BYTES - unused;
}

/* ---- scenes ---- */

typedef enum contents { BOTH, SPHERES, TRIANGLES, BANDS, CONTENTS } contents;

/* Every structure with spheres and triangles; the structures that AUTO chooses also with one of them, and, with a
 * sphere far out, beyond 2^40, in bands. */
static unsigned ways_of(contents c) { return c == BOTH ? WAY_EACH : WAY_CHOSEN; }

static api_results *work_make(const api_world *world, contents c, const test_way *w, cgt_context *context)
{
    api_world *part = malloc(sizeof *part);
    assert_non_null(part);
    *part = *world;
    part->spheres = c == TRIANGLES ? 0 : part->spheres;
    part->triangles = c == SPHERES ? 0 : part->triangles;
    part->far_sphere[0] = c == BANDS ? 0x1p62f : 0;
    part->far_sphere[3] = c == BANDS ? 0x1p60f : 0;
    cgt_scene *scene = api_scene_make(part, context, SCENE_OPTIONS(&w->scene));
    api_results *q = scene ? api_results_make(part, scene) : NULL;
    if (!q) {
        free(part);
        print_error("no scene to measure\n");
        abort();
    }
    q->world = part; /* work_free frees it */
    return q;
}

static void work_free(api_results *q)
{
    cgt_scene_release(q->scene);
    free((void *)(uintptr_t)q->world);
    api_results_free(q);
}

static cgt_result make_no_call(api_results *q)
{
    (void)q;
    return CGT_OK;
}

/* Calls one after the other; one thread does all the work. Returns the most that one took. */
static size_t measure_calls(api_results *q, const char *variant, const char *name, contents c)
{
    size_t most = 0;
    const size_t without = stack_used(make_no_call, q);
    for (size_t i = 0; i < api_call_count; i++) {
        const size_t used = stack_used(api_calls[i].make, q) - without;
        if (used > CALL_BYTES)
            print_message("%s: %s, contents %d: %s: %zu bytes of stack\n", variant, name, (int)c, api_calls[i].name,
                          used);
        most = used > most ? used : most;
    }
    return most;
}

static api_world make_world(uint64_t stream) { return api_world_make(stream, 3000, 20000, 200, 130); }

TEST(calls_take_little_stack)
{
    if (SANITIZED)
        skip(); /* larger frames there */
    api_world world = make_world(771);
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        size_t most = 0;
        for (contents c = BOTH; c < CONTENTS; c++)
            FOR_EACH_WAY(w, ways_of(c))
            {
                api_results *q = work_make(&world, c, w, context);
                const size_t used = measure_calls(q, variant, w->name, c);
                most = used > most ? used : most;
                work_free(q);
            }
        print_message("%s: at most %zu bytes of stack\n", variant, most);
        assert_true(most <= CALL_BYTES);
        cgt_context_release(context);
    }
    api_world_free(&world);
}

/* ---- a runner with small stacks ---- */

enum { RUNNER_THREADS = 3 };

typedef struct batch {
    cgt_task *task;
    void *argument;
    uint32_t count;
    atomic_uint next;
} batch;

static void *runner_thread(void *argument)
{
    batch *b = argument;
    for (uint32_t i; (i = atomic_fetch_add(&b->next, 1)) < b->count;)
        b->task(b->argument, i);
    return NULL;
}

/* Threads with guards, whose stacks are half as large again as what tasks are promised to do with: the C library takes
 * its part. */
static void run_on_small_stacks(void *user, cgt_task *task, void *argument, uint32_t count)
{
    batch b = {.task = task, .argument = argument, .count = count};
    pthread_attr_t attributes;
    pthread_t thread[RUNNER_THREADS];
    int started = 0;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, SANITIZED ? 4 * STACK_BYTES : TASK_BYTES + 16384);
    atomic_init(&b.next, 0);
    while (started < RUNNER_THREADS && !pthread_create(&thread[started], &attributes, runner_thread, &b))
        started++;
    atomic_fetch_add((atomic_uint *)user, (unsigned)started);
    runner_thread(&b);
    for (int i = 0; i < started; i++)
        pthread_join(thread[i], NULL);
    pthread_attr_destroy(&attributes);
}

TEST(runners_may_have_small_stacks)
{
    api_world world = make_world(772);
    atomic_uint started = 0;
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.tasks = (cgt_task_runner){&started, run_on_small_stacks};
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = NULL;
        options.variant = variant;
        assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
        for (contents c = BOTH; c < CONTENTS; c++)
            FOR_EACH_WAY(w, ways_of(c))
            {
                api_results *q = work_make(&world, c, w, context);
                for (size_t i = 0; i < api_call_count; i++)
                    assert_int_equal(api_calls[i].make(q), CGT_OK);
                work_free(q);
            }
        cgt_context_release(context);
    }
    assert_true(started > 0);
    api_world_free(&world);
}

SEEDED_SUITE("test_stacks", NULL, NULL)
