/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a process may do in the midst of calls: it gets signals by the hundred, and it forks in a memory hook, a runner
 * and a visitor, on any thread. The results keep their bits; a forked child may leave at once, or trace by itself. */
#define _GNU_SOURCE
#include "api/calls.h"
#include "support/suite.h"

#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#define PATIENCE 120u

/* Commits a new scene and makes every call; the results, or NULL. */
static api_results *make_all(const api_world *world, cgt_context *context)
{
    cgt_scene *const scene = api_scene_make(world, context, NULL);
    api_results *const r = scene ? api_results_make(world, scene) : NULL;
    if (r && cgt_scene_commit(scene) == CGT_OK && api_trace_all(r) == CGT_OK)
        return r;
    return NULL;
}

static void free_all(api_results *r)
{
    cgt_scene_release(r->scene);
    api_results_free(r);
}

/* ---- signals ---- */

static atomic_uint signals;

static void on_signal(int number)
{
    (void)number;
    atomic_fetch_add(&signals, 1);
}

TEST(signals_change_nothing)
{
    const struct itimerval storm = {{0, 100}, {0, 100}}, calm = {{0, 0}, {0, 0}};
    const uint32_t wanted = test_scaled(300);
    struct sigaction action = {.sa_handler = on_signal}, before; /* without SA_RESTART */
    api_world world = api_world_make(31, 2000, 1000, 100, 60);
    cgt_context *const context = context_make(3, NULL);
    api_results *const expected = make_all(&world, context);
    uint32_t rounds = 0, equal = 0;
    assert_non_null(expected);
    sigemptyset(&action.sa_mask);
    assert_int_equal(sigaction(SIGALRM, &action, &before), 0);
    assert_int_equal(setitimer(ITIMER_REAL, &storm, NULL), 0);
    while (atomic_load(&signals) < wanted && rounds == equal) {
        cgt_context *const own = context_make(1 + rounds % 3, NULL); /* threads start and end, too */
        api_results *const r = make_all(&world, own);
        rounds++;
        equal += r && api_results_equal(r, expected);
        if (r)
            free_all(r);
        cgt_context_release(own);
    }
    setitimer(ITIMER_REAL, &calm, NULL);
    sigaction(SIGALRM, &before, NULL);
    print_message("%u signals in %u rounds\n", atomic_load(&signals), rounds);
    assert_true(rounds > 0 && rounds == equal);
    free_all(expected);
    cgt_context_release(context);
    api_world_free(&world);
}

/* ---- forks ---- */

#ifndef WITHOUT_FORKS
typedef struct forks {
    const api_world *world;
    const api_results *expected;
    atomic_uint allowed, made, failed; /* children still to come, that were there, that failed */
    bool children_trace;
} forks;

/* A child that traces has a context of its own: the parent's is in the midst of a call. */
static int live(const forks *f)
{
    cgt_context *context = NULL;
    alarm(PATIENCE);
    if (!f->children_trace)
        return 0;
    if (cgt_context_create(&(cgt_context_options){.threads = 2}, &context) != CGT_OK)
        return 1;
    api_results *const r = make_all(f->world, context);
    const bool equal = r && api_results_equal(r, f->expected);
    if (r)
        free_all(r);
    cgt_context_release(context);
    return equal ? 0 : 2;
}

static void fork_here(forks *f)
{
    unsigned left = atomic_load(&f->allowed);
    while (left && !atomic_compare_exchange_weak(&f->allowed, &left, left - 1))
        ;
    if (!left)
        return;
    int status = -1;
    const pid_t child = fork();
    if (child == 0)
        _exit(live(f));
    const bool good = child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && !WEXITSTATUS(status);
    atomic_fetch_add(good ? &f->made : &f->failed, 1);
}

static void *allocate_and_fork(void *user, size_t bytes, size_t alignment)
{
    void *memory = NULL;
    fork_here(user);
    return posix_memalign(&memory, alignment < sizeof memory ? sizeof memory : alignment, bytes) ? NULL : memory;
}

static void release(void *user, void *memory, size_t bytes)
{
    (void)user, (void)bytes;
    free(memory);
}

static void run_and_fork(void *user, cgt_task *task, void *argument, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        task(argument, i);
        if (i == count / 2)
            fork_here(user);
    }
}

static cgt_visit visit_and_fork(void *user, const cgt_tile *tile)
{
    (void)tile;
    fork_here(user);
    return CGT_VISIT_CONTINUE;
}

/* All calls with a context that forks, `count` times from each place. */
static void trace_and_fork(forks *f, const cgt_context_options *options, bool in_visitor, uint32_t count)
{
    cgt_context *context = NULL;
    assert_int_equal(cgt_context_create(options, &context), CGT_OK);
    if (!in_visitor)
        atomic_store(&f->allowed, count);
    api_results *const r = make_all(f->world, context);
    assert_non_null(r);
    if (in_visitor) {
        cgt_frame frame = r->frame;
        frame.visitor = visit_and_fork;
        frame.visitor_user = f;
        frame.visitor_fields = CGT_FIELD_T;
        atomic_store(&f->allowed, count);
        assert_int_equal(cgt_trace_camera(r->scene, &f->world->camera, &frame, NULL), CGT_OK);
    }
    assert_true(api_results_equal(r, f->expected));
    assert_int_equal(atomic_load(&f->failed), 0);
    atomic_store(&f->allowed, 0);
    free_all(r);
    cgt_context_release(context);
}

TEST(forks_in_hooks_change_nothing)
{
    api_world world = api_world_make(32, 2000, 1000, 200, 130);
    cgt_context *const context = context_make(3, NULL);
    forks f = {.world = &world, .expected = make_all(&world, context)};
    assert_non_null(f.expected);
    for (int trace = 0; trace < 2; trace++) {
        const uint32_t count = trace ? 2 : 6;
        f.children_trace = trace;
        trace_and_fork(&f, &(cgt_context_options){.threads = 3, .memory = {&f, allocate_and_fork, release}}, false,
                       count);
        trace_and_fork(&f, &(cgt_context_options){.tasks = {&f, run_and_fork}}, false, count);
        trace_and_fork(&f, &(cgt_context_options){.threads = 3}, true, count);
    }
    print_message("%u children\n", atomic_load(&f.made));
    assert_int_equal(atomic_load(&f.made), 3 * (6 + 2));
    free_all((api_results *)(uintptr_t)f.expected);
    cgt_context_release(context);
    api_world_free(&world);
}
#endif

SEEDED_SUITE("test_interruptions", NULL, NULL)
