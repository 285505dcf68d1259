/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bundles of long capsules, whose nodes have turned slabs: rays find what exact arithmetic finds by brute force, as
 * streams, interleaved and one by one, and a list of all hits has each of them once. Bundles without a lean, and rods
 * in all directions, have no slabs. The test compiles the streams itself, to move the slabs inwards until hits are
 * lost. */
#include "support/suite.h"
#include "support/ray_arrays.h"
#include "support/scenes.h"

#include <cgt/all_hits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"
#include "structures/check/bvh_check.h"

static float error_scale = 1, interleave_rays;
#define BVH_ERROR_SCALE error_scale
#define INTERLEAVE_MIN_RAYS interleave_rays
#define INTERLEAVE_SPREAD_RAYS 0
#define INTERLEAVE_MAX_RAYS interleave_rays
#include "kernel/stream/stream_hits.c"
#include "kernel/stream/stream_move.c"
#include "kernel/stream/stream_single.c"
#include "kernel/stream/stream_trace.c"

#define CAPSULES 600u
#define RAYS 400u
#define CAPACITY 64u

typedef struct rods {
    float p[CAPSULES][3], q[CAPSULES][3], radius[CAPSULES];
    float axis[2][3];
} rods;

static rods given;
static truth_ray ray[RAYS];
static uint8_t occluded[RAYS];
static full_hit hit[RAYS];
static uint32_t listed[RAYS][CAPACITY], listed_count[RAYS];

typedef enum bundle { ONE, TWO, STRAIGHT, STREWN } bundle;

/* Rods of length 2 and some more, side by side in a part of space, along one axis or one of two. */
static void make_rods(test_random *r, bundle kind, float scale)
{
    for (int k = 0; k < 2; k++)
        random_direction(r, given.axis[k]);
    for (int a = 0; a < 3; a++)
        given.axis[0][a] = kind == STRAIGHT ? a == 1 : copysignf(0.5f + fabsf(given.axis[0][a]), given.axis[0][a]);
    for (uint32_t i = 0; i < CAPSULES; i++) {
        float n[3], middle[3];
        memcpy(n, given.axis[kind == TWO && i % 2], sizeof n);
        if (kind == STREWN)
            random_direction(r, n);
        const float half = random_float(r, 0.8f, 1.2f), side = random_below(r, 2) ? 1 : -1;
        for (int a = 0; a < 3; a++) {
            middle[a] = random_float(r, -1, 1) + (kind == TWO && i % 2 ? 4.f : 0.f);
            given.p[i][a] = scale * (middle[a] - side * half * n[a]);
            given.q[i][a] = scale * (middle[a] + side * half * n[a]);
        }
        given.radius[i] = scale * random_log(r, 1e-6f, 0.02f);
    }
}

/* Past the silhouette of a rod, within rounding, or at it; from anywhere, from far away, or along the bundle. */
static void make_rays(test_random *r, float scale)
{
    for (uint32_t i = 0; i < RAYS; i++) {
        const uint32_t k = random_below(r, CAPSULES);
        const float u = random_float(r, -0.1f, 1.1f), away = random_below(r, 3) ? 3 : random_log(r, 1, 100);
        float n[3], d[3], across[3], length = 0;
        random_direction(r, d);
        for (int a = 0; a < 3; a++) {
            n[a] = given.q[k][a] - given.p[k][a];
            d[a] = i % 5 ? d[a] : n[a] / scale + (i % 2 ? 1e-4f * d[a] : 0);
        }
        for (int a = 0; a < 3; a++)
            across[a] = n[(a + 1) % 3] * d[(a + 2) % 3] - n[(a + 2) % 3] * d[(a + 1) % 3];
        for (int a = 0; a < 3; a++)
            length += across[a] * across[a];
        const float beside = i % 3 ? (1 + 0x1p-22f * random_float(r, -4, 2)) : random_float(r, -1, 1);
        const float at = length > 0 ? given.radius[k] * beside / sqrtf(length) : 0;
        ray[i] = (truth_ray){.t_max = INFINITY};
        for (int a = 0; a < 3; a++) {
            const float place = given.p[k][a] + u * n[a] + at * across[a];
            ray[i].org[a] = place - away * scale * d[a];
            ray[i].dir[a] = i % 7 ? d[a] : ldexpf(d[a], -40);
        }
    }
}

static cgt_scene *make_scene(cgt_context *context)
{
    const cgt_capsules capsules = {.count = CAPSULES,
                                   .vertex_count = CAPSULES,
                                   .vertices = cgt_floats(&given.p[0][0], 0),
                                   .ends = cgt_floats(&given.q[0][0], 0),
                                   .radii = cgt_floats(given.radius, 0)};
    cgt_scene_options options;
    cgt_scene *scene;
    cgt_scene_options_init(&options);
    options.structure = CGT_STRUCTURE_BVH;
    assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_capsules(scene, NULL, &capsules), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

static cgt_ray plain_ray(const truth_ray *q)
{
    cgt_ray plain = {.t_min = q->t_min, .t_max = q->t_max};
    memcpy(plain.line.org, q->org, sizeof q->org);
    memcpy(plain.line.dir, q->dir, sizeof q->dir);
    return plain;
}

/* The nearest hit, and how many capsules are hit. */
static uint32_t find_truth(const cgt_primitives *prims, const truth_ray *q, uint32_t *all)
{
    const cgt_ray plain = plain_ray(q);
    cgt_counts counts = {0};
    uint32_t closest = CGT_INVALID_ID;
    double t;
    *all = 0;
    for (uint32_t i = 0; i < CAPSULES; i++) {
        *all += filter_is_closer(prims, &plain, CGT_INVALID_ID, i, &t, &counts);
        if (filter_is_closer(prims, &plain, closest, i, &t, &counts))
            closest = i;
    }
    return closest;
}

/* Returns how many rays are wrong as an array. */
static uint32_t trace_arrays(const cgt_scene *scene)
{
    const cgt_rays rays = ray_array(ray, RAYS);
    uint32_t wrong = 0, all;
    assert_int_equal(trace_array(scene, ray, RAYS, hit, NULL), CGT_OK);
    assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        const uint32_t closest = find_truth(&scene->committed_scene.prims, &ray[i], &all);
        wrong += hit[i].primitive != closest || occluded[i] != (closest != CGT_INVALID_ID);
    }
    return wrong;
}

static int compare_ids(const void *a, const void *b)
{
    const uint32_t i = *(const uint32_t *)a, j = *(const uint32_t *)b;
    return i < j ? -1 : i > j;
}

/* Each capsule that is hit is listed, where the ray enters and where it leaves. */
static void check_lists(const cgt_scene *scene)
{
    const cgt_rays rays = ray_array(ray, RAYS);
    cgt_hit_rows rows = {.capacity = CAPACITY, .count = listed_count};
    rows.hits.primitive = &listed[0][0];
    assert_int_equal(cgt_trace_all_rays(scene, &rays, NULL, &rows, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        uint32_t all, distinct = 0, *row = listed[i];
        const uint32_t count = listed_count[i] < CAPACITY ? listed_count[i] : CAPACITY;
        (void)find_truth(&scene->committed_scene.prims, &ray[i], &all);
        qsort(row, count, sizeof *row, compare_ids);
        for (uint32_t k = 0; k < count; k++) {
            distinct += k == 0 || row[k] != row[k - 1];
            assert_true(k < 2 || row[k] != row[k - 2]);
        }
        if (count < CAPACITY)
            assert_int_equal(distinct, all);
    }
}

static bool has_turned(const cgt_scene *scene)
{
    const cgt_bvh *tree = &scene->committed_scene.bvh;
    uint32_t turned = 0;
    for (uint32_t i = 0; i < tree->nodes; i++)
        turned += (((const bvh_node *)tree->node)[i].flat[0] & BVH_TURNED) != 0;
    assert_true(!turned || tree->turned);
    return turned > 0;
}

TEST(bundles_are_exact)
{
    static const float scales[] = {1, 0x1p-30f, 0x1p20f};
    for (uint32_t turn = 0; turn < 4 * TEST_COUNT(scales); turn++) {
        if (test_samples() && (turn % 4 + turn / 4) % 3) /* each kind once, and each scale */
            continue;
        test_random r = random_make(300 + turn);
        const bundle kind = (bundle)(turn % 4);
        const float scale = scales[turn / 4];
        cgt_context *context = context_make(1, CGT_VARIANT_NAME);
        make_rods(&r, kind, scale);
        make_rays(&r, scale);
        cgt_scene *scene = make_scene(context);
        assert_int_equal(has_turned(scene), kind == ONE || kind == TWO);
        assert_null(bvh_check(&scene->committed_scene));
        for (int interleaved = 0; interleaved < 2; interleaved++) {
            interleave_rays = interleaved ? 2.f * CGT_RAYS_CHUNK : 0;
            assert_int_equal(trace_arrays(scene), 0);
        }
        for (uint32_t i = 0; i < RAYS; i++) {
            const cgt_single_ray single = single_ray(&ray[i]);
            cgt_hit found;
            assert_int_equal(cgt_trace_ray(scene, &single, &found, NULL), CGT_OK);
            assert_int_equal(found.primitive, hit[i].primitive);
        }
        check_lists(scene);
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* What the slabs leave out is what they bound. */
TEST(slabs_moved_inwards_lose_hits)
{
    test_random r = random_make(7);
    cgt_context *context = context_make(1, CGT_VARIANT_NAME);
    make_rods(&r, ONE, 1);
    make_rays(&r, 1);
    cgt_scene *scene = make_scene(context);
    for (int interleaved = 0; interleaved < 2; interleaved++) {
        interleave_rays = interleaved ? 2.f * CGT_RAYS_CHUNK : 0;
        error_scale = -4;
        assert_true(trace_arrays(scene) > 0);
        error_scale = 1;
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
}

VARIANT_SUITE("test_turned_slabs", NULL, NULL)
