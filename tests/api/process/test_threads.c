/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Threads: how many the library starts, the caller's own task runner, scenes and contexts used by many threads at
 * once, and a system that refuses threads. The thread sanitizer watches the same tests. */
#define _POSIX_C_SOURCE 200809L
#include "api/calls.h"
#include "support/suite.h"

#include <dirent.h>
#include <errno.h>
#include <fenv.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cgt/research.h>

#include "core/context.h"
#include "core/sanitized.h"

/* ---- the system's threads ---- */

/* The linker redirects the library's calls here. The call that finds refuse_after at 0 fails; negative: none does. */
static int refuse_after = -1;
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument)
{
    if (refuse_after >= 0 && refuse_after-- == 0)
        return EAGAIN;
    return __real_pthread_create(thread, attributes, start, argument);
}

/* Threads of this process; 0 if the system does not report it. */
static unsigned count_threads(void)
{
    unsigned threads = 0;
#ifdef _WIN32 /* Wine has that folder, with threads of its own */
    return 0;
#endif
    DIR *folder = opendir("/proc/self/task");
    if (!folder)
        return 0;
    for (const struct dirent *entry; (entry = readdir(folder));)
        threads += entry->d_name[0] != '.';
    closedir(folder);
    return threads;
}

/* The same once it has been stable for a while: a joined thread may remain listed for a moment. */
static unsigned count_settled_threads(void)
{
    const struct timespec moment = {0, 5000000};
    unsigned threads = count_threads();
    for (int same = 0, i = 0; same < 10 && i < 1000; i++) {
        nanosleep(&moment, NULL);
        const unsigned now = count_threads();
        same = now == threads ? same + 1 : 0;
        threads = now;
    }
    return threads;
}

static void expect_threads(unsigned expected)
{
    const struct timespec moment = {0, 2000000};
    unsigned threads = count_threads();
    for (int i = 0; i < 2000 && threads != expected; i++) {
        nanosleep(&moment, NULL);
        threads = count_threads();
    }
    assert_int_equal(threads, expected);
}

/* ---- a scene large enough for several tasks ---- */

#define WIDTH 150u /* several tiles in each direction */
#define HEIGHT 70u
#define TILES ((WIDTH + 63) / 64 * ((HEIGHT + 63) / 64))

typedef struct committed_scene {
    api_world world;
    api_results *expected; /* of one thread */
} committed_scene;

static committed_scene *make_world(uint64_t stream, uint32_t count)
{
    committed_scene *w = malloc(sizeof *w);
    assert_non_null(w);
    w->world = api_world_make(stream, count, 5000, WIDTH, HEIGHT);
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = api_scene_make(&w->world, context, NULL);
    w->expected = scene ? api_results_make(&w->world, scene) : NULL;
    assert_non_null(w->expected);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_int_equal(api_trace_all(w->expected), CGT_OK);
    cgt_scene_release(scene);
    cgt_context_release(context);
    return w;
}

static void free_world(committed_scene *w)
{
    api_results_free(w->expected);
    api_world_free(&w->world);
    free(w);
}

static cgt_scene *commit_world(const committed_scene *w, cgt_context *context, const cgt_scene_options *options)
{
    cgt_scene *scene = api_scene_make(&w->world, context, options);
    assert_non_null(scene);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* Makes all calls that trace; returns whether a result differs from those of one thread. Callable from any thread. */
static unsigned trace_everything(cgt_scene *scene, const committed_scene *w)
{
    api_results *r = api_results_make(&w->world, scene);
    const bool right = r && api_trace_all(r) == CGT_OK && api_results_equal(r, w->expected);
    if (r)
        api_results_free(r);
    return !right;
}

/* ---- number of threads ---- */

typedef struct watch {
    pthread_t caller;
    atomic_uint other_threads, tiles;
    atomic_uint most_threads; /* of the process while tiles were visited */
} watch;

static cgt_visit watch_tile(void *user, const cgt_tile *tile)
{
    watch *w = user;
    const unsigned threads = count_threads();
    unsigned most = atomic_load(&w->most_threads);
    (void)tile;
    while (threads > most && !atomic_compare_exchange_weak(&w->most_threads, &most, threads))
        continue;
    if (!pthread_equal(pthread_self(), w->caller))
        atomic_fetch_add(&w->other_threads, 1);
    atomic_fetch_add(&w->tiles, 1);
    return 0;
}

static void watch_frame(const cgt_scene *scene, const committed_scene *w, watch *seen)
{
    cgt_frame frame;
    seen->caller = pthread_self();
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame.visitor = watch_tile;
    frame.visitor_user = seen;
    frame.visitor_fields = CGT_FIELD_T;
    assert_int_equal(cgt_trace_camera(scene, &w->world.camera, &frame, NULL), CGT_OK);
    assert_int_equal(seen->tiles, TILES);
}

TEST(one_thread_starts_none)
{
    const unsigned before = count_settled_threads();
    if (!before)
        skip();
    committed_scene *w = make_world(1, 12000);
    watch seen = {0};
    cgt_context *context = context_make(1, NULL);
    assert_int_equal(cgt_context_get_threads(context), 1);
    assert_int_equal(count_threads(), before);
    const cgt_scene_options grid = {.structure = CGT_STRUCTURE_QUEUE_GRID};
    cgt_scene *scene = commit_world(w, context, &grid);
    watch_frame(scene, w, &seen);
    assert_int_equal(seen.other_threads, 0);
    assert_int_equal(seen.most_threads, before);
    assert_int_equal(trace_everything(scene, w), 0);
    assert_int_equal(count_threads(), before);
    cgt_scene_release(scene);
    cgt_context_release(context);
    free_world(w);
}

TEST(a_pool_starts_one_less_and_ends_them)
{
    static const unsigned threads[] = {2, 3, 7, 16};
    const unsigned before = count_settled_threads();
    if (!before)
        skip();
    committed_scene *w = make_world(2, 1000);
    for (size_t i = 0; i < TEST_COUNT(threads); i++) {
        watch seen = {0};
        cgt_context *context = context_make(threads[i], NULL);
        assert_int_equal(count_threads(), before + threads[i] - 1);
        const cgt_scene_options made = structure_in_turn((uint32_t)i);
        cgt_scene *scene = commit_world(w, context, &made);
        watch_frame(scene, w, &seen);
        assert_int_equal(seen.most_threads, before + threads[i] - 1); /* no extra threads during the work */
        assert_int_equal(trace_everything(scene, w), 0);
        cgt_scene_release(scene);
        cgt_context_release(context);
        expect_threads(before);
    }
    free_world(w);
}

TEST(refused_threads_are_an_error)
{
    const unsigned before = count_settled_threads();
    for (int n = 0; n < 5; n++) {
        cgt_context_options options;
        cgt_context *context = (cgt_context *)(void *)&options;
        cgt_context_options_init(&options);
        options.threads = 6;
        refuse_after = n;
        assert_int_equal(cgt_context_create(&options, &context), CGT_ERROR_THREADS);
        assert_int_equal(refuse_after, -1);
        assert_int_equal(cgt_context_get_threads(context), 0);
        cgt_context_release(context);
        if (before)
            expect_threads(before);
    }
    refuse_after = 5; /* six threads are the caller's and five more: a sixth call would fail */
    cgt_context_release(context_make(6, NULL));
    assert_int_equal(refuse_after, 0);
    refuse_after = -1;
}

enum { BATCH = 3 };

typedef struct batch {
    atomic_uint arrived, runs[BATCH + 1]; /* the last: tasks that there are not */
} batch;

/* Tasks 0 and 1 wait for each other, so that both threads ask for the last one at about the same time. */
static void meet_and_count(void *argument, uint32_t index)
{
    batch *b = argument;
    atomic_fetch_add(&b->runs[index < BATCH ? index : BATCH], 1);
    if (index >= 2)
        return;
    atomic_fetch_add(&b->arrived, 1);
    for (int i = 0; i < 10000 && atomic_load(&b->arrived) < 2; i++) /* the other one may not come */
        continue;
}

TEST(every_task_runs_once)
{
    const uint32_t batches = test_scaled(50000);
    batch b = {0};
    cgt_context *context = context_make(2, NULL);
    for (uint32_t i = 0; i < batches; i++) {
        atomic_store(&b.arrived, 0);
        cgt_run_tasks(context, meet_and_count, &b, BATCH);
    }
    for (int index = 0; index < BATCH; index++)
        assert_int_equal(b.runs[index], batches);
    assert_int_equal(b.runs[BATCH], 0);
    cgt_context_release(context);
}

/* ---- the caller's runner ---- */

typedef struct runner {
    unsigned runs, tasks;
    uint32_t last_count;
    pthread_t caller;
    bool wrong_thread; /* run was called on a thread other than the library's caller */
} runner;

static void run_even_then_odd(void *user, cgt_task *task, void *argument, uint32_t count)
{
    runner *r = user;
    r->runs++;
    r->tasks += count;
    r->last_count = count;
    r->wrong_thread |= !pthread_equal(pthread_self(), r->caller);
    for (uint32_t start = 0; start < 2; start++)
        for (uint32_t i = start; i < count; i += 2)
            task(argument, i);
}

TEST(a_runner_does_all_the_work)
{
    const unsigned before = count_settled_threads();
    committed_scene *w = make_world(3, 12000);
    runner r = {.caller = pthread_self()};
    watch seen = {0};
    cgt_context_options options;
    cgt_context *context = NULL;
    cgt_context_options_init(&options);
    options.threads = 8; /* ignored with a runner */
    options.tasks = (cgt_task_runner){&r, run_even_then_odd};
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    assert_int_equal(cgt_context_get_threads(context), 0);
    assert_int_equal(count_threads(), before);
    const cgt_scene_options grid = {.structure = CGT_STRUCTURE_QUEUE_GRID};
    cgt_scene *scene = commit_world(w, context, &grid);
    assert_true(r.runs > 0);
    const unsigned runs = r.runs, tasks = r.tasks;
    watch_frame(scene, w, &seen);
    assert_int_equal(seen.other_threads, 0);
    assert_int_equal(r.runs, runs + 1);
    assert_true(r.tasks > tasks && r.tasks <= tasks + TILES); /* a task may do several tiles */
    assert_int_equal(trace_everything(scene, w), 0);
    assert_false(r.wrong_thread);
    assert_int_equal(count_threads(), before);
    cgt_scene_release(scene);
    cgt_context_release(context);
    free_world(w);
}

/* ---- the caller's own tasks ---- */

typedef struct own_tasks {
    cgt_context *context;
    atomic_uint done[64];
    atomic_uint wrong;
} own_tasks;

static void do_inner(void *argument, uint32_t index) { atomic_fetch_add((atomic_uint *)argument + index, 1); }

/* By the arithmetic of floats, which may have a rounding mode of its own. */
static bool rounds_to_nearest(void)
{
    volatile float one = 1, little = 0x1p-30f;
    return one + little == one && -one - little == -one;
}

/* Runs tasks in its turn. */
static void do_outer(void *argument, uint32_t index)
{
    own_tasks *const o = argument;
    atomic_uint inner[3] = {0};
    if (cgt_context_run_tasks(o->context, do_inner, inner, 3) || inner[0] != 1 || inner[1] != 1 || inner[2] != 1 ||
        !rounds_to_nearest())
        atomic_fetch_add(&o->wrong, 1);
    atomic_fetch_add(&o->done[index], 1);
}

static void check_own_tasks(cgt_context *context, uint32_t count)
{
    own_tasks o = {.context = context};
    const int rounding = fegetround();
    fesetround(FE_UPWARD);
    assert_int_equal(cgt_context_run_tasks(context, do_outer, &o, count), CGT_OK);
    assert_int_equal(fegetround(), FE_UPWARD);
    fesetround(rounding);
    assert_int_equal(o.wrong, 0);
    for (uint32_t i = 0; i < TEST_COUNT(o.done); i++)
        assert_int_equal(o.done[i], i < count);
}

TEST(callers_have_tasks_of_their_own)
{
    runner r = {.caller = pthread_self()};
    char text[100];
    for (uint32_t threads = 0; threads < 4; threads++) { /* 0: a runner */
        cgt_context *context = NULL;
        const cgt_context_options options = {.threads = threads, .tasks = {&r, threads ? NULL : run_even_then_odd}};
        assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
        for (uint32_t count = 0; count <= 64; count += count ? 21 : 1)
            check_own_tasks(context, count);
        assert_int_equal(cgt_context_run_tasks(context, NULL, NULL, 1), CGT_ERROR_INVALID_ARGUMENT);
        cgt_context_get_error_message(context, text, sizeof text);
        assert_non_null(strstr(text, "task"));
        cgt_context_release(context);
    }
    assert_true(r.runs > 3 && !r.wrong_thread);
    assert_int_equal(cgt_context_run_tasks(NULL, do_inner, NULL, 0), CGT_ERROR_INVALID_ARGUMENT);
}

/* ---- many callers ---- */

#define CALLERS (CGT_SANITIZED ? 3 : 6)

typedef struct caller {
    pthread_t thread;
    cgt_context *context; /* shared, or NULL: one of its own */
    cgt_scene *scene;     /* shared, or NULL: one of its own */
    const committed_scene *committed_scene;
    unsigned rounds, wrong;
} caller;

/* Commits and traces; errors are counted, since cmocka works only on the main thread. */
static void *call(void *argument)
{
    caller *c = argument;
    cgt_context *context = c->context;
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.threads = 2;
    if (!context && cgt_context_create(&options, &context) != CGT_OK)
        c->wrong++;
    for (unsigned round = 0; round < c->rounds && !c->wrong; round++) {
        cgt_scene *scene = c->scene;
        const cgt_spheres bad = {.count = 1};
        const cgt_scene_options made = structure_in_turn(round);
        char message[64];
        if (!scene) {
            scene = api_scene_make(&c->committed_scene->world, context, &made);
            c->wrong += !scene;
            c->wrong +=
                cgt_scene_set_spheres(scene, NULL, &bad) != CGT_ERROR_INVALID_ARGUMENT; /* concurrent messages */
            c->wrong += cgt_context_get_error_message(context, message, sizeof message) == 0;
            c->wrong += cgt_scene_commit(scene) != CGT_OK;
        }
        c->wrong += trace_everything(scene, c->committed_scene);
        if (!c->scene)
            cgt_scene_release(scene);
    }
    if (!c->context)
        cgt_context_release(context);
    return NULL;
}

static void run_callers(caller *c)
{
    for (int i = 0; i < CALLERS; i++)
        assert_int_equal(pthread_create(&c[i].thread, NULL, call, &c[i]), 0);
    for (int i = 0; i < CALLERS; i++)
        assert_int_equal(pthread_join(c[i].thread, NULL), 0);
    for (int i = 0; i < CALLERS; i++)
        assert_int_equal(c[i].wrong, 0);
}

TEST(many_threads_trace_one_scene)
{
    committed_scene *w = make_world(4, 800);
    for (uint32_t threads = 1; threads <= 3; threads++) {
        cgt_context *context = context_make(threads, NULL);
        const cgt_scene_options made = structure_in_turn(threads + 2); /* ropes, the loose grid, the queue grid */
        cgt_scene *scene = commit_world(w, context, &made);
        caller c[CALLERS] = {0};
        for (int i = 0; i < CALLERS; i++)
            c[i] = (caller){.context = context, .scene = scene, .committed_scene = w, .rounds = test_scaled(10)};
        run_callers(c);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
    free_world(w);
}

TEST(many_threads_have_scenes_of_one_context)
{
    committed_scene *w[2] = {make_world(5, 9000), make_world(6, 300)};
    cgt_context *context = context_make(3, NULL);
    caller c[CALLERS] = {0};
    for (int i = 0; i < CALLERS; i++)
        c[i] = (caller){.context = context, .committed_scene = w[i % 2], .rounds = test_scaled(10)};
    run_callers(c);
    cgt_context_release(context);
    for (int i = 0; i < 2; i++)
        free_world(w[i]);
}

TEST(many_threads_have_contexts)
{
    const unsigned before = count_settled_threads();
    committed_scene *w[2] = {make_world(7, 9000), make_world(8, 300)};
    caller c[CALLERS] = {0};
    for (int i = 0; i < CALLERS; i++)
        c[i] = (caller){.committed_scene = w[i % 2], .rounds = test_scaled(10)};
    run_callers(c);
    for (int i = 0; i < 2; i++)
        free_world(w[i]);
    if (before)
        expect_threads(before);
}

int main(void)
{
    test_begin("test_threads");
    /* a sanitizer starts its own thread with the program's first: let that happen before threads are counted */
    cgt_context_release(context_make(2, NULL));
    return SUITE_RUN(NULL, NULL);
}
