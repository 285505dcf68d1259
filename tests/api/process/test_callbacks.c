/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The caller's code runs inside calls of the library: hooks of memory and log, the task runner and whatever else it
 * runs. It may ask for statistics and messages and trace the scene. An alarm ends a test that waits for itself. */
#define _POSIX_C_SOURCE 200809L
#include "support/scenes.h"
#include "support/suite.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define COUNT 20000u
#define RAYS 1000u /* more than COUNT / 32: AUTO builds a BVH */
#define PATIENCE 60u

typedef struct callbacks {
    const cgt_context *context;
    const cgt_scene *scene;   /* to ask about; NULL: not yet */
    const truth_ray *rays;    /* to trace; NULL: only ask, since the scene is not committed */
    const ray_hit *expected;  /* hits of the rays */
    unsigned calls, in_tasks; /* of ask; of those, in a task of the runner */
    unsigned depth;           /* what a callback calls calls it back */
    unsigned wrong;
    bool refuse_memory;
} callbacks;

static unsigned trace_rays(const callbacks *c)
{
    const cgt_rays rays = ray_array(c->rays, RAYS);
    ray_hit *hits = calloc(RAYS, sizeof *hits);
    uint8_t *occluded = calloc(RAYS, 1);
    const cgt_hits to = hits_of(hits);
    unsigned wrong = cgt_trace_rays(c->scene, &rays, &to, NULL) != CGT_OK;
    wrong += cgt_occluded_rays(c->scene, &rays, occluded, NULL) != CGT_OK;
    wrong += memcmp(hits, c->expected, RAYS * sizeof *hits) != 0;
    free(occluded);
    free(hits);
    return wrong;
}

/* What the caller's code may call. */
static void ask(callbacks *c)
{
    cgt_scene_statistics statistics;
    cgt_research_scene_statistics research;
    char message[300];
    if (!c->scene || c->depth)
        return;
    c->depth++;
    c->calls++;
    c->wrong += cgt_scene_get_statistics(c->scene, &statistics) != CGT_OK;
    c->wrong += cgt_research_get_scene_statistics(c->scene, &research) != CGT_OK;
    /* of a commit that has ended, or of none: never of half a commit */
    c->wrong += statistics.primitives != 0 && (statistics.primitives != COUNT || statistics.bytes == 0);
    (void)cgt_context_get_error_message(c->context, message, sizeof message);
    if (c->rays)
        c->wrong += trace_rays(c);
    c->depth--;
}

static void *allocate(void *user, size_t bytes, size_t alignment)
{
    callbacks *c = user;
    void *memory = NULL;
    ask(c);
    if (c->refuse_memory || posix_memalign(&memory, alignment < sizeof memory ? sizeof memory : alignment, bytes))
        return NULL;
    return memory;
}

static void release(void *user, void *memory, size_t bytes)
{
    (void)bytes;
    ask(user);
    free(memory);
}

static void write_log(void *user, cgt_log_level level, const char *message)
{
    (void)level;
    (void)message;
    ask(user);
}

/* A runner that does other work of the caller's between tasks, as one that steals work does. */
static void run(void *user, cgt_task *task, void *argument, uint32_t count)
{
    callbacks *c = user;
    for (uint32_t i = 0; i < count; i++) {
        if (i % 16 == 0) {
            c->in_tasks += !c->depth;
            ask(c);
        }
        task(argument, i);
    }
}

static cgt_context *make_context(callbacks *c)
{
    cgt_context_options options;
    cgt_context *context = NULL;
    cgt_context_options_init(&options);
    options.memory = (cgt_memory_hooks){c, allocate, release};
    options.log = (cgt_log_hook){c, write_log};
    options.tasks = (cgt_task_runner){c, run};
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    c->context = context;
    return context;
}

/* The rays' hits by a context without hooks. */
static void find_hits(const cloud *spheres, const truth_ray *rays, ray_hit *hits)
{
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])spheres->sphere, spheres->count);
    rays_trace(scene, rays, RAYS, hits, NULL);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

TEST(callbacks_call_the_library)
{
    callbacks c = {0};
    test_random r = random_make(1);
    cloud spheres = cloud_make(&r, CLOUD_UNIFORM, COUNT);
    truth_ray rays[RAYS];
    ray_hit hits[RAYS] = {0};
    for (uint32_t i = 0; i < RAYS; i++)
        rays[i] = ray_random(&r, &spheres);
    find_hits(&spheres, rays, hits);
    alarm(PATIENCE);
    cgt_context *context = make_context(&c);
    cgt_scene *scene = NULL;
    const cgt_spheres described = spheres_of((const float(*)[4])spheres.sphere, COUNT);
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    c.scene = scene;
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &described), CGT_OK);
    for (int round = 0; round < 3; round++) {
        c.rays = NULL;
        /* AUTO forgets that rays alone came, and builds a grid again */
        assert_int_equal(cgt_scene_set_options(scene, &(cgt_scene_options){0}), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        c.rays = rays;
        c.expected = hits;
        /* the first call of a commit builds the BVH: once without memory for it */
        c.refuse_memory = round == 0;
        const unsigned calls = c.calls, in_tasks = c.in_tasks;
        cgt_scene_statistics statistics;
        const cgt_rays array = ray_array(rays, RAYS);
        uint8_t occluded[RAYS];
        const cgt_result result = cgt_occluded_rays(scene, &array, occluded, NULL);
        assert_int_equal(result, round == 0 ? CGT_ERROR_OUT_OF_MEMORY : CGT_OK);
        assert_true(c.calls > calls);
        assert_true(round == 0 || c.in_tasks > in_tasks);
        assert_int_equal(cgt_scene_get_statistics(scene, &statistics), CGT_OK);
        assert_true((statistics.bvh_bytes > 0) == (round != 0));
        c.refuse_memory = false;
        c.wrong += trace_rays(&c);
        assert_int_equal(c.wrong, 0);
    }
    c.scene = NULL;
    cgt_scene_release(scene);
    cgt_context_release(context);
    alarm(0);
    cloud_free(&spheres);
}

SEEDED_SUITE("test_callbacks", NULL, NULL)
