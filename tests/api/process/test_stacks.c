/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small stacks: every call on 64 KB of its caller's, tasks included where they run there, and tasks on 128 KB of the
 * threads of a caller's runner; single rays on 16 KB. Stacks are painted, and what was written is counted. The
 * library's own workers have room to spare, under a sanitizer, too. */
#define _GNU_SOURCE /* pthread_getattr_np, mincore */
#include "api/calls.h"
#include "core/memory.h"
#include "core/sanitized.h"
#include "core/tasks.h"
#include "support/suite.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#define CALL_BYTES (64u * 1024)
#define TASK_BYTES (128u * 1024)
#define STACK_BYTES (2u * 1024 * 1024) /* painted, so that a call that takes too much is measured */
#define PAINT 0xa7

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
    if (CGT_SANITIZED)
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

/* ---- single rays ---- */

static bool trace_both(const cgt_scene *scene, const cgt_single_ray *ray)
{
    cgt_hit hit;
    bool occluded;
    return cgt_trace_ray(scene, ray, &hit, NULL) == CGT_OK && cgt_occluded_ray(scene, ray, &occluded, NULL) == CGT_OK;
}

/* Four surfaces that meet the line x = 0.25, y = 0 at z = 0.0625, so that whole numbers decide which is the nearest. */
static const float meeting_spheres[2][4] = {{0.25f, 0, 0, 0.0625f}, {0.25f, 0, -0.03125f, 0.09375f}};
static const float meeting_triangles[6][3] = {{0, -0.5f, 0.0625f}, {0.5f, -0.5f, 0.0625f}, {0.25f, 0.5f, 0.0625f},
                                              {0, -0.5f, 0},       {0.5f, 0, 0.0625f},     {0, 0.5f, 0.125f}};

/* Lines through these places, and a tangent, and along an edge of a triangle: from near and afar, of any length. */
static bool trace_undecided(const cgt_scene *scene)
{
    static const float from[] = {1, 5, 1000, 1e10f, 1e17f, 1e30f}, length[] = {1, 1e-30f, 1e30f};
    static const float place[][2] = {{0.25f, 0}, {0.3125f, 0}, {0.25f, 0.5f}, {0.375f, 0}, {0.25f, -0.5f}};
    bool good = true;
    for (size_t i = 0; i < TEST_COUNT(from); i++)
        for (size_t j = 0; j < TEST_COUNT(length); j++)
            for (size_t k = 0; k < TEST_COUNT(place); k++) {
                cgt_single_ray ray = {.org = {place[k][0], place[k][1], from[i]}, .dir = {0, 0, -length[j]}};
                good &= trace_both(scene, &ray);
                ray.dir[0] = ray.dir[1] = 1e-38f; /* many bits apart */
                good &= trace_both(scene, &ray);
            }
    return good;
}

static cgt_result trace_single_rays(api_results *q)
{
    bool good = trace_undecided(q->scene);
    for (uint32_t i = 0; i < 1600; i++) {
        const float x = (float)(i % 40) * 0.05f - 1, y = (float)(i / 40) * 0.05f - 1;
        const cgt_single_ray ray = {.org = {x, y, 5}, .dir = {0.01f, 0.02f, -1}};
        good &= trace_both(q->scene, &ray);
    }
    return good ? CGT_OK : CGT_ERROR_STOPPED;
}

/* Less than 16 KB through a BVH, however hard the ray. */
TEST(single_rays_take_less)
{
    if (CGT_SANITIZED || test_scaled(10) < 10)
        skip();
    const cgt_scene_options options = {.rays = CGT_RAY_KIND_INCOHERENT};
    const cgt_spheres spheres = spheres_of(meeting_spheres, 2);
    const cgt_triangles triangles = {.count = 2, .vertex_count = 6, .vertices = cgt_floats(meeting_triangles[0], 0)};
    api_world world = api_world_make(774, 2000, 9, 8, 8);
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = api_scene_make(&world, context, &options);
        assert_non_null(scene);
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        api_results *q = api_results_make(&world, scene);
        assert_non_null(q);
        const size_t without = stack_used(make_no_call, q), with = stack_used(trace_single_rays, q);
        print_message("%s: %zu bytes of stack for single rays\n", variant, with - without);
        assert_true(with >= without && with - without < 16384);
        api_results_free(q);
        cgt_scene_release(scene);
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
    pthread_attr_setstacksize(&attributes, CGT_SANITIZED ? 4 * STACK_BYTES : TASK_BYTES + 16384);
    atomic_init(&b.next, 0);
    while (started < RUNNER_THREADS && !pthread_create(&thread[started], &attributes, runner_thread, &b))
        started++;
    atomic_fetch_add((atomic_uint *)user, (unsigned)started);
    runner_thread(&b);
    for (int i = 0; i < started; i++)
        pthread_join(thread[i], NULL);
    pthread_attr_destroy(&attributes);
}

/* All calls, with all contents, by all ways and variants, whose tasks a runner gets. */
static void run_all_calls(const api_world *world, cgt_task_runner runner)
{
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = NULL;
        cgt_context_options options;
        cgt_context_options_init(&options);
        options.tasks = runner;
        options.variant = variant;
        assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
        for (contents c = BOTH; c < CONTENTS; c++)
            FOR_EACH_WAY(w, ways_of(c))
            {
                api_results *q = work_make(world, c, w, context);
                for (size_t i = 0; i < api_call_count; i++)
                    assert_int_equal(api_calls[i].make(q), CGT_OK);
                work_free(q);
            }
        cgt_context_release(context);
    }
}

TEST(runners_may_have_small_stacks)
{
    api_world world = make_world(772);
    atomic_uint started = 0;
    run_all_calls(&world, (cgt_task_runner){&started, run_on_small_stacks});
    assert_true(started > 0);
    api_world_free(&world);
}

/* ---- the library's workers ---- */

typedef struct worker_stack {
    pthread_barrier_t both;
    pthread_t caller;
    size_t bytes, guard;
} worker_stack;

/* Two tasks, none of which ends before the other begins: one runs on the worker. */
static void note_stack(void *argument, uint32_t index)
{
    worker_stack *const w = argument;
    pthread_attr_t attributes;
    (void)index;
    pthread_barrier_wait(&w->both);
    if (pthread_equal(pthread_self(), w->caller) || pthread_getattr_np(pthread_self(), &attributes))
        return;
    pthread_attr_getstacksize(&attributes, &w->bytes);
    pthread_attr_getguardsize(&attributes, &w->guard);
    pthread_attr_destroy(&attributes);
}

static worker_stack stack_of_worker(void)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    worker_stack w = {.caller = pthread_self()};
    void *pool = NULL;
    assert_int_equal(pthread_barrier_init(&w.both, NULL, 2), 0);
    assert_int_equal(cgt_backend_host.create(&memory, 2, &pool), CGT_OK);
    cgt_backend_host.run(pool, note_stack, &w, 2);
    cgt_backend_host.destroy(&memory, pool);
    pthread_barrier_destroy(&w.both);
    return w;
}

typedef struct measured_runner {
    size_t bytes, page, most; /* of the stack, of a page, of what a batch touched */
    unsigned char *touched;
} measured_runner;

/* All tasks on one thread, whose stack is as large as a worker's; its pages are fresh, so those in memory were
 * touched. */
static void run_measured(void *user, cgt_task *task, void *argument, uint32_t count)
{
    measured_runner *const m = user;
    batch b = {.task = task, .argument = argument, .count = count};
    pthread_attr_t attributes;
    pthread_t thread;
    size_t first = 0;
    void *const stack = mmap(NULL, m->bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (stack == MAP_FAILED)
        abort();
    (void)madvise(stack, m->bytes, MADV_NOHUGEPAGE);
    atomic_init(&b.next, 0);
    pthread_attr_init(&attributes);
    if (pthread_attr_setstack(&attributes, stack, m->bytes) || pthread_create(&thread, &attributes, runner_thread, &b))
        abort();
    pthread_join(thread, NULL);
    pthread_attr_destroy(&attributes);
    if (mincore(stack, m->bytes, m->touched))
        abort();
    while (first < m->bytes / m->page && !(m->touched[first] & 1))
        first++;
    m->most = m->bytes - first * m->page > m->most ? m->bytes - first * m->page : m->most;
    munmap(stack, m->bytes);
}

/* Corners and centres on a lattice, seen along an axis: hits at equal distances, and edges that rays graze, take the
 * exact decisions, which need most. */
static api_world make_lattice(void)
{
    api_world w = api_world_make(773, 300, 300, 70, 40);
    float(*const vertex)[3] = (float(*)[3])(uintptr_t)w.vertex, (*const sphere)[4] = (float(*)[4])(uintptr_t)w.sphere;
    for (uint32_t i = 0; i < 9 * w.triangles; i++)
        vertex[i / 3][i % 3] = roundf(2 * vertex[i / 3][i % 3]) / 2;
    for (uint32_t i = 0; i < 4 * w.spheres; i++)
        sphere[i / 4][i % 4] = i % 4 == 3 ? 0.25f : roundf(2 * sphere[i / 4][i % 4]) / 2;
    w.camera = (cgt_camera){.projection = CGT_PROJECTION_ORTHOGRAPHIC, .eye = {0, 0, 9}, .height = 4};
    return w;
}

/* At most a quarter of a worker's stack is taken; what goes beyond it meets a guard wider than a promised task. */
TEST(workers_have_room)
{
    const worker_stack worker = stack_of_worker();
    measured_runner m = {.bytes = worker.bytes, .page = (size_t)sysconf(_SC_PAGESIZE)};
    m.touched = malloc(m.bytes / m.page);
    assert_non_null(m.touched);
    assert_true(worker.guard > TASK_BYTES);
    api_world world = make_lattice();
    run_all_calls(&world, (cgt_task_runner){&m, run_measured});
    print_message("a task touches at most %zu of %zu bytes, guard %zu\n", m.most, m.bytes, worker.guard);
    assert_true(m.most > 0 && m.most < m.bytes / 4);
    free(m.touched);
    api_world_free(&world);
}

SEEDED_SUITE("test_stacks", NULL, NULL)
