/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * When a BVH is built beside a grid: by cgt_scene_prepare, or by rays; and in place of the grid, where frame after
 * frame brought such rays alone. Hits are the same whatever is built. */
#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define SPHERES 4000u
#define RAYS 600u /* more than 1/32 of the spheres */

typedef struct setting {
    cgt_context *context;
    cgt_scene *scene;
    cloud spheres;
    truth_ray ray[RAYS];
    ray_hit hit[RAYS];
} setting;

static void rays_of(setting *s)
{
    test_random r = random_make(2);
    for (uint32_t i = 0; i < RAYS; i++)
        s->ray[i] = ray_random(&r, &s->spheres);
}

static setting *open(cgt_context *context, const cgt_scene_options *options)
{
    setting *s = calloc(1, sizeof *s);
    test_random r = random_make(1);
    assert_non_null(s);
    s->spheres = cloud_make(&r, CLOUD_UNIFORM, SPHERES);
    s->context = context;
    s->scene = scene_of(context, options, (const float(*)[4])s->spheres.sphere, SPHERES);
    rays_of(s);
    rays_trace(s->scene, s->ray, RAYS, s->hit, NULL);
    assert_int_equal(cgt_scene_commit(s->scene), CGT_OK); /* no BVH again */
    return s;
}

static void close(setting *s)
{
    cgt_scene_release(s->scene);
    cgt_context_release(s->context);
    cloud_free(&s->spheres);
    free(s);
}

static cgt_scene_statistics statistics_of(const cgt_scene *scene)
{
    cgt_scene_statistics st;
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    return st;
}

/* Traces the first rays; returns how many went through a BVH. */
static uint64_t bvh_rays(const setting *s, uint32_t count)
{
    static ray_hit hit[RAYS];
    cgt_trace_statistics st;
    rays_trace(s->scene, s->ray, count, hit, &(cgt_trace_options){.statistics = &st});
    assert_memory_equal(hit, s->hit, count * sizeof *hit);
    return st.bvh_rays;
}

static void draw(const setting *s)
{
    const cgt_camera camera = camera_before(&s->spheres);
    planes p = planes_make(64, 64);
    frame_trace(s->scene, &camera, &p, NULL);
    planes_free(&p);
}

/* ---- prepared ---- */

TEST(a_bvh_is_built_when_the_caller_wants)
{
    unsigned allocations = 0;
    setting *s = open(context_counting(&allocations), NULL);
    assert_int_equal(statistics_of(s->scene).structure, CGT_STRUCTURE_LOOSE_GRID);
    assert_int_equal(cgt_scene_prepare(s->scene, CGT_RAY_KIND_COHERENT), CGT_OK);
    assert_int_equal(statistics_of(s->scene).bvh_bytes, 0);
    assert_int_equal(bvh_rays(s, 1), 0); /* one ray does not pay for a BVH */
    assert_int_equal(cgt_scene_prepare(s->scene, CGT_RAY_KIND_INCOHERENT), CGT_OK);
    const cgt_scene_statistics built = statistics_of(s->scene);
    assert_true(built.bvh_bytes > 0 && built.bvh_build_ms > 0);
    const unsigned before = allocations;
    assert_int_equal(bvh_rays(s, 1), 1);
    assert_int_equal(cgt_scene_prepare(s->scene, CGT_RAY_KIND_INCOHERENT), CGT_OK);
    assert_true(bvh_rays(s, RAYS) >= RAYS - 100); /* those with a range that is empty do not go */
    assert_int_equal(allocations, before);
    assert_true(statistics_of(s->scene).bvh_build_ms == built.bvh_build_ms); /* not again */
    draw(s); /* else the next commit builds the BVH in place of the grid */
    assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
    assert_int_equal(statistics_of(s->scene).bvh_bytes, 0);
    close(s);
}

/* Rays that meet far more than others count as several: fewer than 1/32 of the primitives build a BVH. */
TEST(rays_that_take_long_build_sooner)
{
    enum { HUGE = 2000, FEW = 60 };
    static float sphere[HUGE][4];
    static truth_ray ray[FEW];
    static ray_hit got[FEW], expected[FEW];
    const cgt_scene_options by_bvh = {.structure = CGT_STRUCTURE_BVH};
    cgt_context *context = context_make(1, NULL);
    test_random r = random_make(3);
    for (int i = 0; i < HUGE; i++)
        for (int a = 0; a < 4; a++)
            sphere[i][a] = a < 3 ? random_float(&r, 0, 1) : 0.3f;
    for (int i = 0; i < FEW; i++)
        for (int a = 0; a < 3; a++) {
            ray[i].org[a] = 0.5f;
            ray[i].dir[a] = random_float(&r, -1, 1);
            ray[i].t_max = INFINITY;
        }
    cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])sphere, HUGE),
              *truth = scene_of(context, &by_bvh, (const float(*)[4])sphere, HUGE);
    cgt_trace_statistics st;
    rays_trace(truth, ray, FEW, expected, NULL);
    rays_trace(scene, ray, FEW, got, &(cgt_trace_options){.statistics = &st});
    assert_int_equal(st.bvh_rays, 0);
    rays_trace(scene, ray, 1, got, &(cgt_trace_options){.statistics = &st});
    assert_int_equal(st.bvh_rays, 1); /* it was paid by the call before */
    rays_trace(scene, ray, FEW, got, NULL);
    assert_memory_equal(got, expected, sizeof expected);
    cgt_scene_release(scene);
    cgt_scene_release(truth);
    cgt_context_release(context);
}

TEST(other_structures_need_nothing)
{
    for (uint32_t k = 0; k < TEST_STRUCTURES; k++) {
        const cgt_scene_options options = structure_in_turn(k);
        setting *s = open(context_make(1, NULL), &options);
        const cgt_scene_statistics before = statistics_of(s->scene);
        assert_int_equal(cgt_scene_prepare(s->scene, CGT_RAY_KIND_INCOHERENT), CGT_OK);
        assert_int_equal(bvh_rays(s, RAYS) > 0, options.structure == CGT_STRUCTURE_BVH);
        assert_int_equal(statistics_of(s->scene).bytes, before.bytes);
        close(s);
    }
}

/* As many calls of one ray. */
static void trace_alone(const setting *s, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const cgt_single_ray ray = single_ray(&s->ray[i]);
        cgt_hit hit;
        assert_int_equal(cgt_trace_ray(s->scene, &ray, &hit, NULL), CGT_OK);
    }
}

/* A 32nd of a ray a primitive pays for a BVH, whatever the number of calls. */
TEST(calls_add_up)
{
    setting *s = open(context_make(2, NULL), NULL);
    for (int round = 0; round < 3; round++) {
        assert_int_equal(cgt_scene_set_options(s->scene, &(cgt_scene_options){0}), CGT_OK); /* forgets what came */
        assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
        bvh_rays(s, SPHERES / 64);
        assert_int_equal(statistics_of(s->scene).bvh_bytes, 0);
        if (round == 2)
            trace_alone(s, SPHERES / 64 + 1);
        else
            bvh_rays(s, SPHERES / 64 + 1);
        assert_true(statistics_of(s->scene).bvh_bytes > 0);
    }
    close(s);
}

/* ---- without memory ---- */

static bool refuse;

static void *allocate(void *user, size_t bytes, size_t alignment)
{
    (void)user;
    return refuse ? NULL : aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

static void release(void *user, void *memory, size_t bytes)
{
    (void)user;
    (void)bytes;
    free(memory);
}

TEST(without_memory_the_grid_serves)
{
    const cgt_context_options options = {.threads = 2, .memory = {NULL, allocate, release}};
    cgt_context *context = NULL;
    cloud spheres;
    test_random r = random_make(1);
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    spheres = cloud_make(&r, CLOUD_UNIFORM, SPHERES);
    setting *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->context = context;
    s->spheres = spheres;
    assert_int_equal(cgt_scene_create(context, NULL, &s->scene), CGT_OK);
    const cgt_spheres described = spheres_of((const float(*)[4])spheres.sphere, SPHERES);
    assert_int_equal(cgt_scene_set_spheres(s->scene, NULL, &described), CGT_OK);
    assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
    rays_of(s);
    rays_trace(s->scene, s->ray, 1, s->hit, NULL);
    refuse = true;
    assert_int_equal(cgt_scene_prepare(s->scene, CGT_RAY_KIND_INCOHERENT), CGT_ERROR_OUT_OF_MEMORY);
    assert_int_equal(bvh_rays(s, 1), 0);
    refuse = false;
    assert_int_equal(cgt_scene_prepare(s->scene, CGT_RAY_KIND_INCOHERENT), CGT_OK);
    assert_int_equal(bvh_rays(s, 1), 1);
    close(s);
}

/* ---- threads ---- */

static atomic_uint asked;

/* Every second one leaves it to its rays. */
static void *prepare_and_trace(void *argument)
{
    const setting *s = argument;
    ray_hit *hit = malloc(RAYS * sizeof *hit);
    const cgt_rays rays = ray_array(s->ray, RAYS);
    const cgt_hits hits = hits_of(hit);
    bool right = atomic_fetch_add(&asked, 1) % 2 || cgt_scene_prepare(s->scene, CGT_RAY_KIND_INCOHERENT) == CGT_OK;
    right = right && hit && cgt_trace_rays(s->scene, &rays, &hits, NULL) == CGT_OK;
    right = right && !memcmp(hit, s->hit, RAYS * sizeof *hit);
    free(hit);
    return right ? argument : NULL;
}

TEST(threads_prepare_at_once)
{
    setting *s = open(context_make(2, NULL), NULL);
    for (uint32_t round = 0; round < 10; round++) {
        pthread_t thread[4];
        assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
        for (int i = 0; i < 4; i++)
            assert_int_equal(pthread_create(&thread[i], NULL, prepare_and_trace, s), 0);
        for (int i = 0; i < 4; i++) {
            void *right = NULL;
            assert_int_equal(pthread_join(thread[i], &right), 0);
            assert_non_null(right);
        }
    }
    close(s);
}

/* ---- frame after frame ---- */

/* What comes in a frame. */
enum { DRAW = 1, TRACE = 2, FEW = 4, PREPARE = 8 };

static void come(const setting *s, int what)
{
    if (what & DRAW)
        draw(s);
    if (what & FEW)
        bvh_rays(s, 1);
    if (what & PREPARE)
        assert_int_equal(cgt_scene_prepare(s->scene, CGT_RAY_KIND_INCOHERENT), CGT_OK);
    if (what & TRACE)
        bvh_rays(s, RAYS);
}

TEST(auto_learns_what_comes)
{
    static const struct {
        int comes[8];  /* in each frame; 0 ends the list */
        int builds[8]; /* 1: the commit before it builds the BVH */
    } story[] = {
        {{TRACE, TRACE, TRACE, TRACE, TRACE}, {0, 0, 1, 1, 1}},
        {{TRACE, TRACE, DRAW, TRACE, TRACE, TRACE}, {0, 0, 1, 0, 0, 1}},
        {{TRACE, DRAW, TRACE, DRAW, TRACE, DRAW}, {0, 0, 0, 0, 0, 0}},
        {{DRAW | TRACE, DRAW | TRACE, DRAW | TRACE, DRAW | TRACE}, {0, 0, 0, 0}},
        {{FEW, FEW, FEW, FEW}, {0, 0, 0, 0}},
        {{PREPARE | FEW, PREPARE | FEW, FEW, FEW, FEW}, {0, 0, 1, 1, 1}},
        {{DRAW, DRAW, DRAW, TRACE, TRACE, TRACE | DRAW, TRACE}, {0, 0, 0, 0, 0, 1, 0}},
    };
    for (size_t k = 0; k < TEST_COUNT(story); k++) {
        setting *s = open(context_make(1 + k % 2, NULL), NULL);
        assert_int_equal(cgt_scene_set_options(s->scene, &(cgt_scene_options){0}), CGT_OK); /* forgets all */
        for (int frame = 0; frame < 8 && story[k].comes[frame]; frame++) {
            assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
            const cgt_scene_statistics st = statistics_of(s->scene);
            const bool bvh = st.structure == CGT_STRUCTURE_BVH;
            if (bvh != (story[k].builds[frame] == 1))
                fail_msg("story %zu, frame %d: %s", k, frame, st.reason);
            assert_int_equal(strstr(st.reason, "nothing that a grid serves") != NULL, bvh);
            come(s, story[k].comes[frame]);
        }
        close(s);
    }
}

/* A commit that fails for want of memory forgets nothing: the one that repeats it builds what it would have built. */
TEST(auto_learns_over_a_failed_commit)
{
    const cgt_context_options options = {.threads = 1, .memory = {NULL, allocate, release}};
    cgt_context *context = NULL;
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    setting *s = open(context, NULL);
    assert_int_equal(cgt_scene_set_options(s->scene, &(cgt_scene_options){0}), CGT_OK);
    for (int frame = 0; frame < 2; frame++) {
        assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
        come(s, TRACE);
    }
    const cgt_spheres more = spheres_of((const float(*)[4])s->spheres.sphere, SPHERES);
    assert_int_equal(cgt_scene_set_spheres(s->scene, NULL, &more), CGT_OK); /* so that it needs memory */
    refuse = true;
    assert_int_equal(cgt_scene_commit(s->scene), CGT_ERROR_OUT_OF_MEMORY);
    refuse = false;
    assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
    assert_int_equal(statistics_of(s->scene).structure, CGT_STRUCTURE_BVH);
    close(s);
}

SEEDED_SUITE("test_prepare", NULL, NULL)
