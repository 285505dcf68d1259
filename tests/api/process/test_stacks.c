/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small stacks: every call on 64 KB of its caller's, tasks included where they run there, and tasks on 128 KB of the
 * threads of a caller's runner. Stacks are painted, and what was written is counted. */
#define _POSIX_C_SOURCE 200809L
#include "support/closed_meshes.h"
#include "support/scenes.h"

#include <math.h>
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

/* ---- the calls ---- */

enum { WIDTH = 200, HEIGHT = 130, PIXELS = WIDTH * HEIGHT, RAYS = 20000 };

typedef struct world {
    cloud spheres;
    uint32_t triangles;
    float (*vertex)[3]; /* three of each triangle */
    float org[3][RAYS], dir[3][RAYS];
} world;

/* What a call is asked for, and what it writes. */
typedef struct work {
    const world *world;
    cgt_context *context;
    cgt_scene_options options;
    cgt_scene *scene;
    cgt_camera camera;
    cgt_frame frame;
    float plane[6][PIXELS], value[PIXELS > RAYS ? PIXELS : RAYS];
    uint32_t primitive[PIXELS], geometry[PIXELS];
    uint8_t occluded[PIXELS > RAYS ? PIXELS : RAYS];
} work;

typedef cgt_result stack_call(work *w);

static cgt_result call_nothing(work *w)
{
    (void)w;
    return CGT_OK;
}
static cgt_result call_commit(work *w) { return cgt_scene_commit(w->scene); }
static cgt_result call_prepare(work *w) { return cgt_scene_prepare(w->scene, CGT_RAY_KIND_INCOHERENT); }
static cgt_result call_camera(work *w) { return cgt_trace_camera(w->scene, &w->camera, &w->frame, NULL); }
static cgt_result call_orthographic(work *w)
{
    cgt_camera c = w->camera;
    c.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    c.height = 2;
    return cgt_trace_camera(w->scene, &c, &w->frame, NULL);
}

static cgt_visit visit(void *user, const cgt_tile *tile)
{
    (void)tile;
    atomic_fetch_add((atomic_uint *)user, 1);
    return CGT_VISIT_CONTINUE;
}

static cgt_result call_visitor(work *w)
{
    atomic_uint tiles = 0;
    cgt_frame f;
    cgt_frame_init(&f, WIDTH, HEIGHT);
    f.visitor = visit;
    f.visitor_user = &tiles;
    f.visitor_fields = CGT_FIELD_T | CGT_FIELD_NORMAL | CGT_FIELD_UV | CGT_FIELD_PRIMITIVE | CGT_FIELD_POSITION;
    const cgt_result result = cgt_trace_camera(w->scene, &w->camera, &f, NULL);
    return tiles ? result : CGT_ERROR_STOPPED;
}

static cgt_rays rays_of_world(const world *w)
{
    return (cgt_rays){
        .count = RAYS, .org = {w->org[0], w->org[1], w->org[2]}, .dir = {w->dir[0], w->dir[1], w->dir[2]}};
}
static cgt_result call_closest(work *w)
{
    const cgt_rays rays = rays_of_world(w->world);
    const cgt_hits hits = {.t = w->value};
    return cgt_trace_rays(w->scene, &rays, &hits, NULL);
}
static cgt_result call_any(work *w)
{
    const cgt_rays rays = rays_of_world(w->world);
    return cgt_occluded_rays(w->scene, &rays, w->occluded, NULL);
}

static cgt_result trace_points(work *w, cgt_light light, uint64_t count)
{
    const float *const *org = (const float *const[3]){w->world->org[0], w->world->org[1], w->world->org[2]};
    const cgt_points points = {.count = count, .position = {org[0], org[1], org[2]}};
    return cgt_occluded_points(w->scene, &light, &points, w->occluded, NULL);
}
static const cgt_light lights[] = {{.kind = CGT_LIGHT_POINT, .position = {3, 4, 5}},
                                   {.kind = CGT_LIGHT_DIRECTIONAL, .position = {1, 2, 3}}};
static cgt_result call_point_light(work *w) { return trace_points(w, lights[0], RAYS); }
static cgt_result call_directional_light(work *w) { return trace_points(w, lights[1], RAYS); }
static cgt_result call_few_points(work *w) { return trace_points(w, lights[0], 100); }
static cgt_result call_shadows(work *w)
{
    cgt_result result = CGT_OK;
    for (int k = 0; k < 2 && result == CGT_OK; k++)
        result = cgt_occluded_frame(w->scene, &w->camera, &w->frame, &lights[k], 1, NULL, w->occluded, NULL);
    return result;
}
static cgt_result call_ambient(work *w)
{
    return cgt_ambient_occlusion(w->scene, &w->camera, &w->frame, NULL, w->value, NULL);
}
static cgt_result call_one_ray(work *w)
{
    cgt_single_hit hit;
    bool occluded;
    for (int i = 0; i < 200; i++) {
        const cgt_single_ray ray = {.org = {w->world->org[0][i], w->world->org[1][i], w->world->org[2][i]},
                                    .dir = {w->world->dir[0][i], w->world->dir[1][i], w->world->dir[2][i]}};
        cgt_result result = cgt_trace_ray(w->scene, &ray, &hit, NULL);
        if (result == CGT_OK)
            result = cgt_occluded_ray(w->scene, &ray, &occluded, NULL);
        if (result != CGT_OK)
            return result;
    }
    return CGT_OK;
}

/* In this order: a BVH is built by the first call that pays for it, or prepared. */
static const struct {
    const char *name;
    stack_call *call;
} calls[] = {{"commit", call_commit},
             {"camera", call_camera},
             {"orthographic", call_orthographic},
             {"visitor", call_visitor},
             {"one ray", call_one_ray},
             {"few points", call_few_points},
             {"point light", call_point_light},
             {"shadows", call_shadows},
             {"directional light", call_directional_light},
             {"closest", call_closest},
             {"any", call_any},
             {"ambient", call_ambient},
             {"prepare", call_prepare},
             {"point light, BVH", call_point_light},
             {"shadows, BVH", call_shadows},
             {"one ray, BVH", call_one_ray},
             {"second commit", call_commit}};

/* ---- stacks ---- */

typedef struct stack_job {
    stack_call *call;
    work *work;
    cgt_result result;
} stack_job;

static void *run_job(void *argument)
{
    stack_job *j = argument;
    j->result = j->call(j->work);
    return NULL;
}

/* Returns the bytes of a painted stack that a call wrote. */
static size_t stack_used(stack_call *call, work *w)
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

static const struct {
    const char *name;
    cgt_structure structure;
    bool spheres, triangles;
    float scale; /* of the spheres that are added far out; 0: none, beyond 2^40 the scene is in bands */
} kinds[] = {{"grid, spheres", CGT_STRUCTURE_AUTO, true, false, 0},
             {"grid, triangles", CGT_STRUCTURE_AUTO, false, true, 0},
             {"grid, both", CGT_STRUCTURE_LOOSE_GRID, true, true, 0},
             {"BVH, spheres", CGT_STRUCTURE_BVH, true, false, 0},
             {"BVH, both", CGT_STRUCTURE_BVH, true, true, 0},
             {"queue grid", CGT_STRUCTURE_QUEUE_GRID, true, true, 0},
             {"kd-tree", CGT_STRUCTURE_KD, true, true, 0},
             {"kd-tree with ropes", CGT_STRUCTURE_KD_ROPES, true, true, 0},
             {"BIH", CGT_STRUCTURE_BIH, true, true, 0},
             {"bands", CGT_STRUCTURE_AUTO, true, true, 0x1p60f}};

static world *world_make(uint64_t seed)
{
    world *w = malloc(sizeof *w);
    test_random r = random_make(seed);
    assert_non_null(w);
    w->spheres = cloud_make(&r, CLOUD_UNIFORM, 3000);
    for (uint32_t i = 0; i < w->spheres.count; i++) {
        for (int a = 0; a < 3; a++)
            w->spheres.sphere[i][a] = random_float(&r, -1, 1);
        w->spheres.sphere[i][3] = random_float(&r, 0.001f, 0.05f);
    }
    closed_mesh mesh;
    assert_true(closed_mesh_make(&mesh, CLOSED_ICOSPHERE, 12));
    w->triangles = mesh.triangles;
    w->vertex = calloc(3 * (size_t)mesh.triangles, sizeof *w->vertex);
    assert_non_null(w->vertex);
    for (uint32_t i = 0; i < 3 * mesh.triangles; i++)
        for (int a = 0; a < 3; a++)
            w->vertex[i][a] = (float)mesh.vertex[mesh.index[i / 3][i % 3]][a];
    closed_mesh_free(&mesh);
    for (int i = 0; i < RAYS; i++)
        for (int a = 0; a < 3; a++) {
            w->org[a][i] = random_float(&r, -1.5f, 1.5f);
            w->dir[a][i] = random_float(&r, -1, 1);
        }
    /* numbers that bounds in single precision do not cover, and undecided hits: through the middle of a sphere */
    w->org[0][7] = 0x1p100f;
    w->dir[1][8] = 0x1p-140f;
    return w;
}

static void world_free(world *w)
{
    cloud_free(&w->spheres);
    free(w->vertex);
    free(w);
}

static work *work_make(const world *w, cgt_context *context, size_t kind)
{
    static float far_sphere[1][4];
    work *q = calloc(1, sizeof *q);
    uint32_t id;
    assert_non_null(q);
    q->world = w;
    q->context = context;
    q->options.structure = kinds[kind].structure;
    assert_int_equal(cgt_scene_create(context, &q->options, &q->scene), CGT_OK);
    const cgt_spheres spheres = spheres_of((const float(*)[4])w->spheres.sphere, w->spheres.count);
    if (kinds[kind].spheres)
        assert_int_equal(cgt_scene_add_spheres(q->scene, &spheres, &id), CGT_OK);
    const cgt_triangles triangles = {.count = w->triangles, .vertex_count = 3 * w->triangles, .vertices = w->vertex[0]};
    if (kinds[kind].triangles)
        assert_int_equal(cgt_scene_add_triangles(q->scene, &triangles, &id), CGT_OK);
    if (kinds[kind].scale > 0) {
        far_sphere[0][0] = 4 * kinds[kind].scale;
        far_sphere[0][3] = kinds[kind].scale;
        const cgt_spheres far = spheres_of((const float(*)[4])far_sphere, 1);
        assert_int_equal(cgt_scene_add_spheres(q->scene, &far, &id), CGT_OK);
    }
    cgt_camera_init(&q->camera);
    q->camera.eye[0] = 0.5f;
    q->camera.eye[2] = 4;
    cgt_frame_init(&q->frame, WIDTH, HEIGHT);
    q->frame.t = q->plane[0];
    for (int a = 0; a < 3; a++)
        q->frame.normal[a] = q->plane[1 + a];
    q->frame.u = q->plane[4];
    q->frame.v = q->plane[5];
    q->frame.primitive = q->primitive;
    q->frame.geometry = q->geometry;
    return q;
}

static void work_free(work *q)
{
    cgt_scene_release(q->scene);
    free(q);
}

/* Calls one after the other; one thread does all the work. Returns the most that one took. */
static size_t measure_calls(const world *w, cgt_context *context, const char *variant, size_t kind)
{
    size_t most = 0;
    work *q = work_make(w, context, kind);
    const size_t without = stack_used(call_nothing, q);
    for (size_t i = 0; i < TEST_COUNT(calls); i++) {
        const size_t used = stack_used(calls[i].call, q) - without;
        if (used > CALL_BYTES)
            print_message("%s: %s: %s: %zu bytes of stack\n", variant, kinds[kind].name, calls[i].name, used);
        most = used > most ? used : most;
    }
    work_free(q);
    return most;
}

static void calls_take_little_stack(void **state)
{
    (void)state;
    if (SANITIZED)
        skip(); /* larger frames there */
    world *w = world_make(771);
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        size_t most = 0;
        for (size_t kind = 0; kind < TEST_COUNT(kinds); kind++) {
            const size_t used = measure_calls(w, context, variant, kind);
            most = used > most ? used : most;
        }
        print_message("%s: at most %zu bytes of stack\n", variant, most);
        assert_true(most <= CALL_BYTES);
        cgt_context_release(context);
    }
    world_free(w);
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

static void runners_may_have_small_stacks(void **state)
{
    (void)state;
    world *w = world_make(772);
    atomic_uint started = 0;
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.tasks = (cgt_task_runner){&started, run_on_small_stacks};
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = NULL;
        options.variant = variant;
        assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
        for (size_t kind = 0; kind < TEST_COUNT(kinds); kind++) {
            work *q = work_make(w, context, kind);
            for (size_t i = 0; i < TEST_COUNT(calls); i++)
                assert_int_equal(calls[i].call(q), CGT_OK);
            work_free(q);
        }
        cgt_context_release(context);
    }
    assert_true(started > 0);
    world_free(w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(calls_take_little_stack),
                                       cmocka_unit_test(runners_may_have_small_stacks)};
    test_begin("test_stacks");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
