/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Memory through the caller's hook: every allocation of a whole session fails in turn, and each failure is reported as
 * an error, nothing is lost or leaked, and scenes work afterwards. In a steady state nothing is allocated. All of it
 * with the grids, and with the kd-tree of each builder, with and without ropes. */
#define _POSIX_C_SOURCE 200809L
#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "core/context.h"
#include "core/scratch.h"

/* ---- the hook ---- */

typedef struct block {
    void *memory;
    size_t bytes;
} block;

typedef struct memory {
    block live[256];
    size_t blocks, bytes, calls;
    size_t fail_at; /* the call that returns NULL, counted from 1; 0: none */
    bool failed;
    pthread_t caller;
    const char *wrong;
} memory;

static void *hook_allocate(void *user, size_t bytes, size_t alignment)
{
    memory *m = user;
    void *p = NULL;
    if (!pthread_equal(pthread_self(), m->caller))
        m->wrong = "allocate is called from a worker";
    if (!alignment || alignment & (alignment - 1) || alignment > 64)
        m->wrong = "an alignment is not a power of two up to 64";
    if (!bytes)
        m->wrong = "allocate is called for 0 bytes";
    if (++m->calls == m->fail_at) {
        m->failed = true;
        return NULL;
    }
    if (m->blocks == TEST_COUNT(m->live))
        m->wrong = "more blocks than the test has room for";
    else if (posix_memalign(&p, alignment < sizeof p ? sizeof p : alignment, bytes) == 0) {
        memset(p, 0xa5, bytes); /* the library must not rely on its contents */
        m->live[m->blocks++] = (block){p, bytes};
        m->bytes += bytes;
    }
    return p;
}

static void hook_release(void *user, void *p, size_t bytes)
{
    memory *m = user;
    if (!pthread_equal(pthread_self(), m->caller))
        m->wrong = "release is called from a worker";
    for (size_t i = 0; i < m->blocks; i++)
        if (m->live[i].memory == p) {
            if (m->live[i].bytes != bytes)
                m->wrong = "release gets a size that differs from allocate's";
            m->bytes -= m->live[i].bytes;
            m->live[i] = m->live[--m->blocks];
            free(p);
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
    return cgt_context_create(&options, context);
}

/* ---- a session ---- */

#define GEOMETRIES 9
#define MOST_SIDE 48u
#define SIDE test_between(16, MOST_SIDE)
#define TRIANGLES 120

static cloud spheres;       /* grows from frame to frame: the first quarter of each geometry, then all */
static double pile[300][3]; /* the commit copies it */
static float pile_radius;
static float mesh[TRIANGLES][3][3];
static planes expected[2], got;
static cgt_camera camera;

static cgt_spheres piled(uint32_t count)
{
    return (cgt_spheres){.count = count, .centers_double = pile[0], .radius = pile_radius};
}

/* A call that may fail. If the hook failed, the call must report it, and must succeed when repeated. */
#define TRY(m, call)                                                                                                   \
    do {                                                                                                               \
        (m)->failed = false;                                                                                           \
        const cgt_result first_ = (call);                                                                              \
        check_memory(m);                                                                                               \
        if ((m)->failed) {                                                                                             \
            assert_int_equal(first_, CGT_ERROR_OUT_OF_MEMORY);                                                         \
            (m)->failed = false;                                                                                       \
            assert_int_equal((call), CGT_OK);                                                                          \
            check_memory(m);                                                                                           \
        } else {                                                                                                       \
            assert_int_equal(first_, CGT_OK);                                                                          \
        }                                                                                                              \
    } while (0)

static void check_frame(const cgt_scene *scene, const planes *want)
{
    frame_trace(scene, &camera, &got, NULL);
    if (want)
        assert_true(planes_equal(&got, want));
}

/* A failed commit leaves a message, and a scene that reports that it is not committed. */
static void commit(memory *m, const cgt_context *context, cgt_scene *scene)
{
    const cgt_frame frame = frame_of(&got);
    m->failed = false;
    const cgt_result first = cgt_scene_commit(scene);
    if (m->failed) {
        assert_int_equal(first, CGT_ERROR_OUT_OF_MEMORY);
        assert_non_null(strstr(context_message(context), "out of memory"));
        assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_ERROR_NOT_COMMITTED);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    } else {
        assert_int_equal(first, CGT_OK);
    }
    check_memory(m);
}

static void set_spheres(memory *m, cgt_scene *scene, uint32_t geometry, bool add, cgt_spheres s)
{
    uint32_t id = geometry;
    if (add)
        TRY(m, cgt_scene_add_spheres(scene, &s, &id));
    else
        TRY(m, cgt_scene_update_spheres(scene, geometry, &s));
    assert_int_equal(id, geometry);
}

static void set_triangles(memory *m, cgt_scene *scene, uint32_t geometry, bool add, uint32_t count)
{
    const cgt_triangles t = {.count = count, .vertex_count = 3 * count, .vertices = mesh[0][0]};
    uint32_t id = geometry;
    if (add)
        TRY(m, cgt_scene_add_triangles(scene, &t, &id));
    else
        TRY(m, cgt_scene_update_triangles(scene, geometry, &t));
    assert_int_equal(id, geometry);
}

/* want: the frames that every structure must show; NULL to record them. */
static void session(memory *m, const test_way *c, uint32_t threads, const planes want[2])
{
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    TRY(m, create(m, threads, &context));
    TRY(m, cgt_scene_create(context, SCENE_OPTIONS(&c->scene), &scene));
    for (int frame = 0; frame < 2; frame++) {
        const uint32_t each = spheres.count / GEOMETRIES, count = frame ? each : each / 4;
        const bool add = frame == 0;
        for (uint32_t g = 0; g < GEOMETRIES; g++)
            set_spheres(m, scene, g, add, spheres_of((const float(*)[4])spheres.sphere + g * each, count));
        set_spheres(m, scene, GEOMETRIES, add, piled(frame ? 300 : 30));
        set_triangles(m, scene, GEOMETRIES + 1, add, frame ? TRIANGLES : 20);
        commit(m, context, scene);
        cgt_scene_statistics st;
        assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
        assert_int_equal(st.structure, c->scene.structure);
        assert_true(c->scene.structure != CGT_STRUCTURE_QUEUE_GRID ||
                    research_of(scene).overflow_references > 0); /* more of them in the second frame */
        check_frame(scene, want ? &want[frame] : NULL);
        if (!want)
            memcpy(expected[frame].memory, got.memory, 6 * got.elements * sizeof(uint32_t));
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
    check_memory(m);
    assert_int_equal(m->blocks, 0);
    assert_int_equal(m->bytes, 0);
}

static int make_session(void **state)
{
    (void)state;
    test_random r = random_make(1);
    spheres = cloud_make(&r, CLOUD_UNIFORM, 900);
    for (int i = 0; i < 300; i++)
        for (int a = 0; a < 3; a++)
            pile[i][a] = (double)spheres.middle[a] + (double)random_float(&r, -0.01f, 0.01f);
    pile_radius = 0.02f * spheres.reach;
    for (int i = 0; i < TRIANGLES; i++)
        for (int a = 0; a < 3; a++) {
            const float at = spheres.middle[a] + random_float(&r, -spheres.reach, spheres.reach);
            for (int k = 0; k < 3; k++)
                mesh[i][k][a] = at + random_float(&r, -0.2f, 0.2f) * spheres.reach;
        }
    camera = camera_before(&spheres);
    got = planes_make(SIDE, SIDE);
    for (int i = 0; i < 2; i++)
        expected[i] = planes_make(SIDE, SIDE);
    return 0;
}

static int free_session(void **state)
{
    (void)state;
    cloud_free(&spheres);
    planes_free(&got);
    for (int i = 0; i < 2; i++)
        planes_free(&expected[i]);
    return 0;
}

TEST(every_allocation_fails_in_turn)
{
    const uint32_t step = test_samples() ? 12 : 1; /* every 12th allocation on slow machines */
    bool shown = false;
    for (uint32_t k = 0; k < 2 * way_count(WAY_BUILDER); k++) {
        const test_way *c = way_in_turn(WAY_BUILDER, k / 2);
        const uint32_t start = test_sample_start(7 * (k / 2), step), threads = k % 2 ? 3 : 1;
        if (test_samples() && k % 2 != test_sample_start(k / 2, 2))
            continue;
        memory m = {0};
        session(&m, c, threads, shown ? expected : NULL); /* counts allocations; records or checks the frames */
        shown = true;
        const size_t calls = m.calls;
        print_message("%s, %u threads: %zu allocations\n", c->name, threads, calls);
        assert_true(calls >= (threads == 1 ? 8 : 9));
        for (size_t n = 1 + start % calls; n <= calls + 1; n += step) {
            memory failing = {.fail_at = n};
            session(&failing, c, threads, expected);
            assert_true(failing.calls >= calls);
        }
    }
}

/* Consecutive failures: the second attempt fails too, and the third. */
static void fail_again_and_again(const test_way *c)
{
    memory m = {0};
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    uint32_t id = 77;
    assert_int_equal(create(&m, 2, &context), CGT_OK);
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(&c->scene), &scene), CGT_OK);
    const cgt_spheres s = spheres_of((const float(*)[4])spheres.sphere, spheres.count);
    for (int i = 0; i < 5; i++) {
        m.fail_at = m.calls + 1;
        assert_int_equal(cgt_scene_add_spheres(scene, &s, &id), CGT_ERROR_OUT_OF_MEMORY);
        assert_non_null(strstr(context_message(context), "memory"));
    }
    assert_int_equal(id, 77);
    assert_int_equal(cgt_scene_add_spheres(scene, &s, &id), CGT_OK);
    assert_int_equal(id, 0);
    for (int i = 0; i < 5; i++) {
        m.fail_at = m.calls + 1;
        assert_int_equal(cgt_scene_commit(scene), CGT_ERROR_OUT_OF_MEMORY);
    }
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    cgt_scene_release(scene);
    cgt_context_release(context);
    check_memory(&m);
    assert_int_equal(m.blocks, 0);
}

TEST(repeated_failures_lose_nothing)
{
    FOR_EACH_WAY(c, WAY_BUILDER)
    fail_again_and_again(c);
}

/* ---- steady state ---- */

/* The same frame number selects the same options. */
static void trace_all(const cgt_scene *scene, uint32_t frame)
{
    ray_hit hit[MOST_SIDE];
    uint8_t occluded[MOST_SIDE];
    truth_ray *rays = frame_rays(&camera, SIDE, 1);
    const cgt_rays r = ray_array(rays, SIDE);
    frame_trace(scene, &camera, &got, NULL);
    const uint32_t step = test_samples() ? 5 : 1; /* coprime to the number of options */
    for (uint32_t way = test_sample_start(frame, step); way < 12; way += step) {
        test_trace_options o = {0};
        cgt_trace_statistics st;
        o.tile = way % 2 ? CGT_TILE_SHAPE_STRIP : CGT_TILE_SHAPE_SQUARE;
        o.loop = way / 2 % 2 ? CGT_LOOP_FLATTENED : CGT_LOOP_NESTED;
        o.mailbox = mailbox_of(way / 4 % 2);
        o.kd_traversal = (cgt_kd_traversal)(way % 3);
        o.statistics = &st;
        frame_trace(scene, &camera, &got, TRACE_OPTIONS(&o));
    }
    rays_trace(scene, rays, SIDE, hit, NULL);
    assert_int_equal(cgt_occluded_rays(scene, &r, occluded, NULL), CGT_OK);
    free(rays);
}

/* All primitives move and counts change through a cycle of four states: from the fifth commit on, no state is new. */
static void keep_steady(const test_way *c, uint32_t threads)
{
    memory m = {0};
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    uint32_t id;
    assert_int_equal(create(&m, threads, &context), CGT_OK);
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(&c->scene), &scene), CGT_OK);
    const cgt_spheres cloud_spheres = spheres_of((const float(*)[4])spheres.sphere, spheres.count);
    const cgt_spheres pile_spheres = piled(300);
    const cgt_triangles triangles = {.count = TRIANGLES, .vertex_count = 3 * TRIANGLES, .vertices = mesh[0][0]};
    assert_int_equal(cgt_scene_add_spheres(scene, &cloud_spheres, &id), CGT_OK);
    assert_int_equal(cgt_scene_add_spheres(scene, &pile_spheres, &id), CGT_OK);
    assert_int_equal(cgt_scene_add_triangles(scene, &triangles, &id), CGT_OK);
    size_t calls = 0, bytes = 0;
    double start[300];
    for (int k = 0; k < 300; k++)
        start[k] = pile[k][0];
    for (int i = 0; i < (test_samples() ? 8 : 12); i++) {
        for (int k = 0; k < 300; k++)
            pile[k][0] = start[k] + 0.001 * (i % 4);
        const cgt_spheres spheres_now =
            spheres_of((const float(*)[4])spheres.sphere, spheres.count - 100 * (uint32_t)(i % 4));
        assert_int_equal(cgt_scene_update_spheres(scene, 0, &spheres_now), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        trace_all(scene, (uint32_t)i % 4);
        if (i < 4)
            calls = m.calls, bytes = m.bytes;
        assert_int_equal(m.calls, calls);
        assert_int_equal(m.bytes, bytes);
    }
    for (int k = 0; k < 300; k++)
        pile[k][0] = start[k];
    cgt_scene_release(scene);
    cgt_context_release(context);
    check_memory(&m);
    assert_int_equal(m.blocks, 0);
}

TEST(steady_state_allocates_nothing)
{
    const uint32_t step = test_samples() ? 3 : 1; /* on slow machines each way gets another number of threads */
    for (uint32_t number = 0; number < way_count(WAY_BUILDER); number++)
        for (uint32_t k = test_sample_start(number, step); k < 3; k += step)
            keep_steady(way_in_turn(WAY_BUILDER, number), 1 + k);
}

/* The same number of spheres at ever new positions. The grid's shape changes, its memory does not: spheres smaller than
 * their spacing overflow no queue. A tree takes memory only if it, or a buffer of its build, is larger than ever
 * before. */
static void move_without_growing(const test_way *c)
{
    enum { COUNT = 900, STEPS = 40 };
    static float sphere[COUNT][4];
    memory m = {0};
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    uint32_t id;
    uint64_t cells = 0, most_bytes = 0;
    size_t before = 0, shapes = 0, grown = 0;
    test_random r = random_make(77);
    assert_int_equal(create(&m, 2, &context), CGT_OK);
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(&c->scene), &scene), CGT_OK);
    const cgt_spheres spheres_moving = spheres_of((const float(*)[4])sphere, COUNT);
    assert_int_equal(cgt_scene_add_spheres(scene, &spheres_moving, &id), CGT_OK);
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
    uint32_t id;
    assert_int_equal(create(&m, 2, &context), CGT_OK);
    const size_t without = m.bytes;
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(&c->scene), &scene), CGT_OK);
    for (uint32_t count = 10; count <= 900; count += 89) {
        const cgt_spheres s = spheres_of((const float(*)[4])spheres.sphere, count);
        assert_int_equal(count == 10 ? cgt_scene_add_spheres(scene, &s, &id) : cgt_scene_update_spheres(scene, 0, &s),
                         CGT_OK);
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

SEEDED_SUITE("test_allocation", make_session, free_session)
