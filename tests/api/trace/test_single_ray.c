/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray a call: the bits of cgt_trace_rays and cgt_occluded_rays, for every structure, variant and precision, ranges,
 * masks, skipped primitives and bad numbers. */
#include <math.h>
#include <string.h>

#include <cgt/all_hits.h>

#include "structures/scenes/structure_scenes.h"
#include "support/suite.h"
#include "hard_cases/hard_run.h"

#define RAYS 300u

/* ---- the same bits as arrays ---- */

/* Ranges, ids and bad numbers for some rays; skip: room for a hit that it skips. */
static cgt_single_ray vary(test_random *r, const truth_ray *from, uint32_t primitives, cgt_hit *skip)
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
        skip->primitive = random_below(r, 8) ? random_below(r, primitives) : CGT_INVALID_ID;
        skip->geometry = random_below(r, 3);
        ray.skip = skip;
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
                         .skip_primitive = ray->skip ? &ray->skip->primitive : NULL,
                         .skip_geometry = ray->skip ? &ray->skip->geometry : NULL};
}

static uint32_t check_ray(const cgt_scene *scene, const cgt_single_ray *ray, cgt_precision precision, const char *name)
{
    cgt_trace_statistics one, many;
    const cgt_trace_options one_options = {.precision = precision, .statistics = &one};
    const cgt_trace_options many_options = {.precision = precision, .statistics = &many};
    cgt_hit hit, expected, first = {.surface = CGT_SURFACE_NEAR};
    uint32_t count;
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
    assert_int_equal(cgt_trace_all_ray(scene, ray, NULL, &first, 1, &count, NULL, NULL), CGT_OK);
    expected.surface = first.surface;
    if (memcmp(&hit, &expected, sizeof hit) != 0)
        fail_msg(
            "%s, precision %d: from %a %a %a to %a %a %a: t %a, %u of %u, surface %u, not %a, %u of %u, surface %u",
            name, (int)precision, (double)ray->org[0], (double)ray->org[1], (double)ray->org[2], (double)ray->dir[0],
            (double)ray->dir[1], (double)ray->dir[2], (double)hit.t, hit.primitive, hit.geometry, hit.surface,
            (double)expected.t, expected.primitive, expected.geometry, expected.surface);
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
                cgt_hit skip;
                const cgt_single_ray ray = vary(&s.scene.random, &s.scene.ray[i], 1 + statistics.primitives, &skip);
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

SEEDED_SUITE("test_single_ray", NULL, NULL)
