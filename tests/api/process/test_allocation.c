/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Memory through the caller's hook: allocations of a session of all calls (api/calls.h) fail in turn, and each failure
 * is reported as an error, nothing is lost or leaked, and the calls' results are those of any session. In a steady
 * state nothing is allocated. All of it with each structure, and in bands. */
#define _POSIX_C_SOURCE 200809L
#include "api/calls.h"
#include "support/suite.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "core/context.h"
#include "core/memory.h"
#include "core/scratch.h"

/* ---- the hook ---- */

typedef struct block {
    void *memory;
    size_t bytes;
} block;

typedef struct memory {
    block live[256];
    size_t blocks, bytes, calls;
    size_t fail_at, fails; /* the first call that returns NULL, counted from 1, and how many do; 0: none */
    bool failed;
    pthread_t caller;
    const char *wrong;
} memory;

static void *hook_allocate(void *user, size_t bytes, size_t alignment)
{
    memory *m = user;
    const cgt_memory_hooks system = cgt_memory_default();
    void *p = NULL;
    if (!pthread_equal(pthread_self(), m->caller))
        m->wrong = "allocate is called from a worker";
    if (!alignment || alignment & (alignment - 1) || alignment > 64)
        m->wrong = "an alignment is not a power of two up to 64";
    if (!bytes)
        m->wrong = "allocate is called for 0 bytes";
    if (++m->calls >= m->fail_at && m->calls < m->fail_at + m->fails) {
        m->failed = true;
        return NULL;
    }
    if (m->blocks == TEST_COUNT(m->live))
        m->wrong = "more blocks than the test has room for";
    else if ((p = system.allocate(NULL, bytes, alignment)) != NULL) {
        memset(p, 0xa5, bytes); /* the library must not rely on its contents */
        m->live[m->blocks++] = (block){p, bytes};
        m->bytes += bytes;
    }
    return p;
}

static void hook_release(void *user, void *p, size_t bytes)
{
    const cgt_memory_hooks system = cgt_memory_default();
    memory *m = user;
    if (!pthread_equal(pthread_self(), m->caller))
        m->wrong = "release is called from a worker";
    for (size_t i = 0; i < m->blocks; i++)
        if (m->live[i].memory == p) {
            if (m->live[i].bytes != bytes)
                m->wrong = "release gets a size that differs from allocate's";
            m->bytes -= m->live[i].bytes;
            m->live[i] = m->live[--m->blocks];
            system.release(NULL, p, bytes);
            return;
        }
    m->wrong = p ? "release gets a pointer that allocate did not return" : "release gets NULL";
}

static void check_memory(const memory *m)
{
    if (m->wrong)
        fail_msg("%s", m->wrong);
}

static cgt_result create(memory *m, uint32_t threads, cgt_context **context)
{
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.threads = threads;
    options.memory = (cgt_memory_hooks){m, hook_allocate, hook_release};
    m->caller = pthread_self();
    const cgt_result result = cgt_context_create(&options, context);
    if (result != CGT_OK) {
        cgt_context_release(*context); /* the message alone */
        *context = NULL;
    }
    return result;
}

/* ---- a session ---- */

/* A call that may fail. If the hook failed, the call must say so, or have done without, and it succeeds when the hook
 * does. */
#define TRY(m, call)                                                                                                   \
    do {                                                                                                               \
        cgt_result result_;                                                                                            \
        do {                                                                                                           \
            (m)->failed = false;                                                                                       \
            result_ = (call);                                                                                          \
            check_memory(m);                                                                                           \
            assert_true(result_ == CGT_OK || (result_ == CGT_ERROR_OUT_OF_MEMORY && (m)->failed));                     \
        } while (result_ != CGT_OK);                                                                                   \
    } while (0)

static const double doubles[][3] = {{-1, 0, 0}, {0, 0.5, 0}, {0.5, 0, 1}}; /* each commit copies them */

static cgt_result make_scene(const api_world *world, cgt_context *context, const test_way *w, cgt_scene **scene)
{
    const cgt_spheres copied = {.count = 3, .centers = cgt_doubles(doubles[0], 0), .radius = 0.25f};
    *scene = api_scene_make(world, context, SCENE_OPTIONS(&w->scene));
    if (*scene && cgt_scene_set_spheres(*scene, NULL, &copied) != CGT_OK) {
        cgt_scene_release(*scene);
        *scene = NULL;
    }
    return *scene ? CGT_OK : CGT_ERROR_OUT_OF_MEMORY;
}

/* A failed commit leaves a message, and a scene that reports that it is not committed. */
static cgt_result commit(memory *m, const cgt_context *context, api_results *r)
{
    const cgt_result result = cgt_scene_commit(r->scene);
    if (m->failed && result != CGT_OK) {
        assert_non_null(strstr(context_message(context), "out of memory"));
        assert_int_equal(cgt_trace_camera(r->scene, &r->world->camera, &r->frame, NULL), CGT_ERROR_NOT_COMMITTED);
    }
    return result;
}

/* Returns the results of all calls. */
static api_results *session(memory *m, const api_world *world, const test_way *w, uint32_t threads)
{
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    TRY(m, create(m, threads, &context));
    TRY(m, make_scene(world, context, w, &scene));
    api_results *r = api_results_make(world, scene);
    assert_non_null(r);
    TRY(m, commit(m, context, r));
    for (size_t i = 0; i < api_call_count; i++)
        TRY(m, api_calls[i].make(r));
    cgt_scene_release(scene);
    cgt_context_release(context);
    check_memory(m);
    assert_int_equal(m->blocks, 0);
    assert_int_equal(m->bytes, 0);
    return r;
}

/* step: how many allocations are left out between two that fail. Consecutive ones fail, too. */
static void fail_in_turn(const api_world *world, const test_way *w, uint32_t threads, uint32_t step,
                         const api_results *expected)
{
    memory m = {0};
    api_results *r = session(&m, world, w, threads);
    assert_true(api_results_equal(r, expected));
    api_results_free(r);
    print_message("%s, %u threads: %zu allocations\n", w->name, threads, m.calls);
    assert_true(m.calls >= 9);
    for (size_t n = 1 + test_sample_start(threads, step); n <= m.calls + 1; n += step) {
        memory failing = {.fail_at = n, .fails = 1 + n % 3};
        r = session(&failing, world, w, threads);
        assert_true(failing.calls >= m.calls);
        if (!api_results_equal(r, expected))
            fail_msg("%s: other results after allocation %zu has failed", w->name, n);
        api_results_free(r);
    }
}

TEST(every_allocation_fails_in_turn)
{
    const test_way *chosen = way_next(NULL, WAY_CHOSEN);
    for (int bands = 0; bands < 2; bands++) {
        api_world world = api_world_make(1, 600, 300, 40, 30);
        memory m = {0};
        world.far_sphere[0] = bands ? 0x1p62f : 0;
        world.far_sphere[3] = bands ? 0x1p60f : 0;
        api_results *expected = session(&m, &world, chosen, 1);
        for (uint32_t threads = 1; threads <= 3; threads += 2) {
            fail_in_turn(&world, chosen, threads, (bands ? 8 : 1) * (test_samples() ? 12 : 1), expected);
            FOR_EACH_WAY(w, WAY_BUILDER)
            if (!bands)
                fail_in_turn(&world, w, threads, test_samples() ? 12 : 1, expected);
        }
        api_results_free(expected);
        api_world_free(&world);
    }
}

/* ---- steady state ---- */

static float sphere[900][4]; /* of all scenes below */

/* Spheres move through a cycle of four states: from the fifth round on, no state is new. */
static void keep_steady(const test_way *w, uint32_t threads)
{
    api_world world = api_world_make(2, 600, 300, 40, 30);
    memory m = {0};
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    size_t calls = 0, bytes = 0;
    assert_int_equal(create(&m, threads, &context), CGT_OK);
    memcpy(sphere, world.sphere, world.spheres * sizeof *sphere);
    const float(*const given)[4] = world.sphere;
    world.sphere = (const float(*)[4])sphere;
    assert_int_equal(make_scene(&world, context, w, &scene), CGT_OK);
    api_results *r = api_results_make(&world, scene);
    assert_non_null(r);
    for (int round = 0; round < 8; round++) {
        for (uint32_t i = 0; i < world.spheres; i++)
            sphere[i][0] = given[i][0] + 0.01f * (float)(round % 4);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        for (size_t i = 0; i < api_call_count; i++)
            assert_int_equal(api_calls[i].make(r), CGT_OK);
        if (round < 4)
            calls = m.calls, bytes = m.bytes;
        assert_int_equal(m.calls, calls);
        assert_int_equal(m.bytes, bytes);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
    check_memory(&m);
    assert_int_equal(m.blocks, 0);
    api_results_free(r);
    api_world_free(&world);
}

TEST(steady_state_allocates_nothing)
{
    const uint32_t step = test_samples() ? 3 : 1; /* on slow machines each way gets another number of threads */
    uint32_t number = 0;
    keep_steady(way_next(NULL, WAY_CHOSEN), 2);
    FOR_EACH_WAY(w, WAY_BUILDER)
    for (uint32_t k = test_sample_start(number++, step); k < 3; k += step)
        keep_steady(w, 1 + k);
}

/* The same number of spheres at ever new positions. The grid's shape changes, its memory does not: spheres smaller than
 * their spacing overflow no queue. A tree takes memory only if it, or a buffer of its build, is larger than ever
 * before. */
static void move_without_growing(const test_way *c)
{
    enum { COUNT = TEST_COUNT(sphere), STEPS = 40 };
    memory m = {0};
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    uint64_t cells = 0, most_bytes = 0;
    size_t before = 0, shapes = 0, grown = 0;
    test_random r = random_make(77);
    assert_int_equal(create(&m, 2, &context), CGT_OK);
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(&c->scene), &scene), CGT_OK);
    const cgt_spheres moving = spheres_of((const float(*)[4])sphere, COUNT);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &moving), CGT_OK);
    for (int step = 0; step < STEPS; step++) {
        const float size[3] = {random_float(&r, 5, 60), random_float(&r, 5, 60), random_float(&r, 5, 60)};
        for (int i = 0; i < COUNT; i++) {
            for (int a = 0; a < 3; a++)
                sphere[i][a] = random_float(&r, 0, size[a]);
            sphere[i][3] = 0.05f;
        }
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        cgt_scene_statistics st;
        assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
        const cgt_research_scene_statistics research = research_of(scene);
        const uint64_t nodes = research.kd_nodes + research.bih_nodes + research.bvh_nodes;
        const bool grid = !nodes;
        if (before && !(grid ? research.overflow_references > 0 : st.bytes > most_bytes))
            assert_int_equal(m.calls, before);
        grown += before && m.calls != before;
        before = m.calls;
        shapes += grid ? research.cells != cells : nodes != cells;
        cells = grid ? research.cells : nodes;
        most_bytes = st.bytes > most_bytes ? st.bytes : most_bytes;
    }
    assert_true(shapes > 10 && grown <= 4);
    cgt_scene_release(scene);
    cgt_context_release(context);
    check_memory(&m);
}

TEST(moving_without_growing_allocates_nothing)
{
    FOR_EACH_WAY(c, WAY_BUILDER)
    move_without_growing(c);
}

/* Bytes of the scratch that a context keeps for the tasks of all its scenes. */
static size_t scratch_bytes(const cgt_context *context)
{
    size_t bytes = 0;
    for (const cgt_scratch *s = context->scratch; s; s = s->next)
        bytes += CGT_SCRATCH_BYTES;
    return bytes;
}

static void compare_bytes(const test_way *c)
{
    memory m = {0};
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    cgt_scene_statistics st;
    uint32_t id = CGT_INVALID_ID;
    assert_int_equal(create(&m, 2, &context), CGT_OK);
    const size_t without = m.bytes;
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(&c->scene), &scene), CGT_OK);
    for (uint32_t count = 10; count <= 900; count += 89) {
        const cgt_spheres s = spheres_of((const float(*)[4])sphere, count); /* as they were left */
        assert_int_equal(cgt_scene_set_spheres(scene, &id, &s), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
        assert_int_equal(st.bytes, m.bytes - without - scratch_bytes(context));
        assert_true(st.structure_bytes > 0 && st.structure_bytes < st.bytes);
    }
    cgt_scene_release(scene);
    assert_int_equal(m.bytes, without + scratch_bytes(context));
    cgt_context_release(context);
    check_memory(&m);
    assert_int_equal(m.bytes, 0);
}

TEST(statistics_report_the_bytes)
{
    FOR_EACH_WAY(c, WAY_BUILDER)
    compare_bytes(c);
}

SEEDED_SUITE("test_allocation", NULL, NULL)
