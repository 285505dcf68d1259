/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray a call: the bits of cgt_trace_rays and cgt_occluded_rays, for every structure, variant and precision, ranges,
 * masks, skipped primitives and bad numbers; and less than 16 KB of stack through a BVH. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "core/sanitized.h"
#include "structures/scenes/structure_scenes.h"
#include "support/suite.h"
#include "hard_cases/hard_run.h"

#define RAYS 300u

/* ---- the same bits as arrays ---- */

/* Ranges, ids and bad numbers for some rays. */
static cgt_single_ray vary(test_random *r, const truth_ray *from, uint32_t primitives)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY, 0x1p60f, 0x1p-140f};
    cgt_single_ray ray = {.t_min = from->t_min, .t_max = from->t_max};
    memcpy(ray.org, from->org, sizeof ray.org);
    memcpy(ray.dir, from->dir, sizeof ray.dir);
    switch (random_below(r, 12)) {
    case 0: ray.org[random_below(r, 3)] = bad[random_below(r, TEST_COUNT(bad))]; break;
    case 1: ray.dir[random_below(r, 3)] = bad[random_below(r, TEST_COUNT(bad))]; break;
    case 2: memset(ray.dir, 0, sizeof ray.dir); break;
    case 3: ray.t_max = NAN; break;
    case 4: ray.t_max = -1; break;
    case 5: ray.t_max = 0; break; /* the default */
    case 6: ray.t_min = -2; break;
    case 7:
    case 8:
        ray.skips = true;
        ray.skip_primitive = random_below(r, 8) ? random_below(r, primitives) : CGT_INVALID_ID;
        ray.skip_geometry = random_below(r, 3);
        break;
    case 9: ray.mask = random_below(r, 4); break;
    default: break;
    }
    return ray;
}

/* The same ray as an array. */
typedef struct one_array {
    float t_max;
    cgt_rays rays;
} one_array;

static void array_of(const cgt_single_ray *ray, one_array *a)
{
    a->t_max = ray->t_max == 0 ? INFINITY : ray->t_max;
    a->rays = (cgt_rays){.count = 1,
                         .org = {ray->org, ray->org + 1, ray->org + 2},
                         .dir = {ray->dir, ray->dir + 1, ray->dir + 2},
                         .t_min = &ray->t_min,
                         .t_max = &a->t_max,
                         .mask = &ray->mask,
                         .skip_primitive = ray->skips ? &ray->skip_primitive : NULL,
                         .skip_geometry = &ray->skip_geometry};
}

static uint32_t check_ray(const cgt_scene *scene, const cgt_single_ray *ray, cgt_precision precision, const char *name)
{
    cgt_trace_statistics one, many;
    const cgt_trace_options one_options = {.precision = precision, .statistics = &one};
    const cgt_trace_options many_options = {.precision = precision, .statistics = &many};
    cgt_single_hit hit, expected;
    one_array array;
    bool occluded;
    uint8_t expected_occluded;
    memset(&hit, 0x55, sizeof hit);
    memset(&expected, 0x66, sizeof expected);
    array_of(ray, &array);
    const cgt_hits hits = {.t = &expected.t,
                           .primitive = &expected.primitive,
                           .geometry = &expected.geometry,
                           .normal = {&expected.normal[0], &expected.normal[1], &expected.normal[2]},
                           .u = &expected.u,
                           .v = &expected.v};
    assert_int_equal(cgt_trace_ray(scene, ray, &hit, &one_options), CGT_OK);
    assert_int_equal(cgt_trace_rays(scene, &array.rays, &hits, &many_options), CGT_OK);
    if (memcmp(&hit, &expected, sizeof hit) != 0)
        fail_msg("%s, precision %d: from %a %a %a to %a %a %a: t %a, %u of %u, not %a, %u of %u", name, (int)precision,
                 (double)ray->org[0], (double)ray->org[1], (double)ray->org[2], (double)ray->dir[0],
                 (double)ray->dir[1], (double)ray->dir[2], (double)hit.t, hit.primitive, hit.geometry,
                 (double)expected.t, expected.primitive, expected.geometry);
    assert_true(one.rays == 1 && one.hits == many.hits && one.invalid_rays == many.invalid_rays);
    if (precision != CGT_PRECISION_EXACT)
        return 0;
    /* without options, too: that is a way of its own */
    memset(&hit, 0x55, sizeof hit);
    assert_int_equal(cgt_trace_ray(scene, ray, &hit, NULL), CGT_OK);
    assert_memory_equal(&hit, &expected, sizeof hit);
    assert_int_equal(cgt_occluded_rays(scene, &array.rays, &expected_occluded, NULL), CGT_OK);
    for (int k = 0; k < 2; k++) {
        occluded = !expected_occluded;
        assert_int_equal(cgt_occluded_ray(scene, ray, &occluded, k ? &one_options : NULL), CGT_OK);
        assert_int_equal(occluded, expected_occluded);
    }
    return expected_occluded;
}

TEST(bits_of_arrays)
{
    uint32_t hits = 0, rays = 0;
    FOR_EACH_VARIANT(variant)
    for (int kind = 0; kind < STRUCTURE_KINDS; kind++) {
        cgt_context *context = context_make(1, variant);
        structure_scene s = structure_scene_make((structure_kind)kind, 970 + (uint64_t)kind);
        structure_rays(&s, RAYS);
        for (uint32_t k = 0; k < TEST_STRUCTURES; k++) {
            const cgt_scene_options made = structure_in_turn(k);
            cgt_scene *scene;
            cgt_scene_statistics statistics;
            assert_int_equal(hard_commit_with(context, &s.scene, &made, &scene), CGT_OK);
            assert_int_equal(cgt_scene_get_statistics(scene, &statistics), CGT_OK);
            const bool all = made.structure == CGT_STRUCTURE_BVH;
            for (uint32_t i = 0; i < (all ? test_between(20, RAYS) : 10u); i++) {
                const cgt_single_ray ray = vary(&s.scene.random, &s.scene.ray[i], 1 + statistics.primitives);
                hits += check_ray(scene, &ray, CGT_PRECISION_EXACT, s.name);
                check_ray(scene, &ray, CGT_PRECISION_FAST, s.name);
                rays++;
            }
            cgt_scene_release(scene);
        }
        structure_scene_free(&s);
        cgt_context_release(context);
    }
    print_message("%u of %u rays hit\n", hits, rays);
    assert_true(hits > rays / 20 && hits < rays);
}

/* Where AUTO has a grid, single rays make it build a BVH, as arrays do. */
TEST(auto_builds_a_bvh)
{
    test_random r = random_make(980);
    cloud c = cloud_make(&r, CLOUD_UNIFORM, 320);
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])c.sphere, c.count);
    cgt_scene_statistics before, after;
    assert_int_equal(cgt_scene_get_statistics(scene, &before), CGT_OK);
    assert_true(before.structure == CGT_STRUCTURE_LOOSE_GRID && !before.bvh_bytes);
    for (uint32_t i = 0; i < 20; i++) {
        const truth_ray from = ray_random(&r, &c);
        const cgt_single_ray ray = {.org = {from.org[0], from.org[1], from.org[2]},
                                    .dir = {from.dir[0], from.dir[1], from.dir[2]}};
        check_ray(scene, &ray, CGT_PRECISION_EXACT, "auto");
    }
    assert_int_equal(cgt_scene_get_statistics(scene, &after), CGT_OK);
    assert_true(after.bvh_bytes > 0);
    cgt_scene_release(scene);
    cgt_context_release(context);
    cloud_free(&c);
}

TEST(refused)
{
    const float sphere[1][4] = {{0, 0, 0, 1}};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, sphere, 1), *empty;
    const cgt_single_ray ray = {.org = {0, 0, 5}, .dir = {0, 0, -1}};
    cgt_single_hit hit;
    bool occluded;
    assert_int_equal(cgt_trace_ray(NULL, &ray, &hit, NULL), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_trace_ray(scene, NULL, &hit, NULL), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_trace_ray(scene, &ray, NULL, NULL), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_occluded_ray(scene, &ray, NULL, NULL), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_trace_ray(scene, &ray, &hit, &(cgt_trace_options){.precision = (cgt_precision)7}),
                     CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_trace_ray(scene, &ray, &hit, NULL), CGT_OK);
    assert_true(hit.t == 4 && hit.primitive == 0 && hit.geometry == 0 && hit.normal[2] == 1);
    assert_int_equal(cgt_scene_create(context, NULL, &empty), CGT_OK);
    assert_int_equal(cgt_occluded_ray(empty, &ray, &occluded, NULL), CGT_ERROR_NOT_COMMITTED);
    assert_int_equal(cgt_scene_commit(empty), CGT_OK);
    assert_int_equal(cgt_occluded_ray(empty, &ray, &occluded, NULL), CGT_OK);
    assert_false(occluded);
    cgt_scene_release(empty);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* ---- stack ---- */

#define STACK_BYTES (256u * 1024)
#define PAINT 0xa7

typedef struct stack_job {
    const cgt_scene *scene;
    uint32_t rays;
} stack_job;

static bool trace_both(const cgt_scene *scene, const cgt_single_ray *ray)
{
    cgt_single_hit hit;
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

static void *trace_some(void *argument)
{
    const stack_job *job = argument;
    bool good = !job->rays || trace_undecided(job->scene);
    for (uint32_t i = 0; i < job->rays; i++) {
        const float x = (float)(i % 40) * 0.05f - 1, y = (float)(i / 40) * 0.05f - 1;
        const cgt_single_ray ray = {.org = {x, y, 5}, .dir = {0.01f, 0.02f, -1}};
        good &= trace_both(job->scene, &ray);
    }
    return good ? NULL : argument;
}

/* The bytes of a thread's stack that were written. */
static size_t stack_used(const cgt_scene *scene, uint32_t rays)
{
    stack_job job = {scene, rays};
    unsigned char *stack = aligned_alloc(65536, STACK_BYTES);
    pthread_attr_t attributes;
    pthread_t thread;
    void *failed = &job;
    size_t unused = 0;
    assert_non_null(stack);
    memset(stack, PAINT, STACK_BYTES);
    assert_int_equal(pthread_attr_init(&attributes), 0);
    assert_int_equal(pthread_attr_setstack(&attributes, stack, STACK_BYTES), 0);
    assert_int_equal(pthread_create(&thread, &attributes, trace_some, &job), 0);
    assert_int_equal(pthread_join(thread, &failed), 0);
    assert_null(failed);
    pthread_attr_destroy(&attributes);
    while (unused < STACK_BYTES && stack[unused] == PAINT)
        unused++;
    free(stack);
    return STACK_BYTES - unused;
}

TEST(little_stack)
{
    if (CGT_SANITIZED || test_scaled(10) < 10) /* larger frames there */
        skip();
    test_random r = random_make(990);
    cloud c = cloud_make(&r, CLOUD_UNIFORM, 2000);
    for (uint32_t i = 0; i < c.count; i++) {
        for (int a = 0; a < 3; a++)
            c.sphere[i][a] = random_float(&r, -1, 1);
        c.sphere[i][3] = 0.05f;
    }
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        const cgt_scene_options options = {.rays = CGT_RAY_KIND_INCOHERENT};
        cgt_scene *scene = scene_of(context, &options, (const float(*)[4])c.sphere, c.count);
        const cgt_spheres spheres = spheres_of(meeting_spheres, 2);
        const cgt_triangles triangles = {.count = 2, .vertex_count = 6, .vertices = meeting_triangles[0]};
        assert_int_equal(cgt_scene_add_spheres(scene, &spheres, NULL), CGT_OK);
        assert_int_equal(cgt_scene_add_triangles(scene, &triangles, NULL), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        const size_t without = stack_used(scene, 0), with = stack_used(scene, 1600);
        print_message("%s: %zu bytes of stack\n", variant, with - without);
        assert_true(with >= without && with - without < 16384);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
    cloud_free(&c);
}

SEEDED_SUITE("test_single_ray", NULL, NULL)
