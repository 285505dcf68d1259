/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays through the BVH with one variant: batches of any size, as streams and interleaved, with large and with
 * minimal buffers, find the same hits, which the profile `streams` of tests/driver judges. Then bounds are tightened
 * until hits are lost. The test compiles the streams itself and links them in place of the library's. */
#include "support/suite.h"
#include "support/ray_arrays.h"
#include "support/scenes.h"
#include "support/tightened.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint32_t arena_used = 16384, interleaved_stack = 64;
static float interleave_min, interleave_spread, interleave_max; /* when the rays of a call are interleaved */
static float interleave_share;                                  /* and when those that are left are */
static float error_scale = 1, filter_u = 0x1p-24f;
#define FILTER_ROUNDOFF filter_u
#define INTERLEAVED_STACK_USED interleaved_stack
#define STREAM_ARENA_USED arena_used
#define INTERLEAVE_MIN_RAYS interleave_min
#define INTERLEAVE_SPREAD_RAYS interleave_spread
#define INTERLEAVE_MAX_RAYS interleave_max
#define INTERLEAVE_SHARE(any_hit) interleave_share
#define INTERLEAVE_JUDGED_RAYS 1u
#define BVH_ERROR_SCALE error_scale
#include "kernel/stream/stream_hits.c"
#include "kernel/stream/stream_move.c"
#include "kernel/stream/stream_single.c"
#include "kernel/stream/stream_trace.c"

/* Whether an emulator or sanitizers slow the test down. */
static bool is_slow(void) { return test_scaled(10) < 2; }

#define PRIMITIVES 240u
#define RAYS (is_slow() ? 600u : 1000u)
#define ALL_RAYS 20000u /* more than two large chunks */

typedef struct found {
    float t;
    uint32_t primitive, geometry;
} found;

typedef struct subject {
    cgt_context *context;
    cgt_scene *scene;
    cloud spheres;
    float (*corner)[9]; /* of triangles */
} subject;

static truth_ray given[ALL_RAYS];
static found truth[ALL_RAYS], hit[ALL_RAYS];
static uint8_t occluded[ALL_RAYS];

/* ---- scenes ---- */

typedef enum content { SPHERES = 1, TRIANGLES = 2, BOTH = 3 } content;

static void subject_make(test_random *r, cloud_kind kind, content what, float scale, subject *s)
{
    cgt_scene_options options;
    cgt_scene_options_init(&options);
    options.structure = CGT_STRUCTURE_BVH;
    memset(s, 0, sizeof *s);
    s->context = context_make(1, CGT_VARIANT_NAME);
    s->spheres = cloud_make(r, kind, PRIMITIVES);
    s->corner = malloc(PRIMITIVES * sizeof *s->corner);
    assert_non_null(s->corner);
    assert_int_equal(cgt_scene_create(s->context, &options, &s->scene), CGT_OK);
    for (uint32_t i = 0; i < PRIMITIVES; i++)
        for (int k = 0; k < 9; k++) /* some neighbours share an edge */
            s->corner[i][k] =
                i % 4 == 1 && k >= 3
                    ? s->corner[i - 1][k]
                    : scale * (s->spheres.sphere[i][k % 3] + 3 * s->spheres.sphere[i][3] * random_float(r, -1, 1));
    for (uint32_t i = 0; i < PRIMITIVES; i++)
        for (int k = 0; k < 4; k++)
            s->spheres.sphere[i][k] *= scale;
    for (int k = 0; k < 3; k++)
        s->spheres.middle[k] *= scale;
    s->spheres.reach *= scale;
    if (what & SPHERES) {
        const cgt_spheres spheres = spheres_of((const float(*)[4])s->spheres.sphere, PRIMITIVES);
        assert_int_equal(cgt_scene_set_spheres(s->scene, NULL, &spheres), CGT_OK);
    }
    if (what & TRIANGLES) {
        const cgt_triangles triangles = {
            .count = PRIMITIVES, .vertex_count = 3 * PRIMITIVES, .vertices = cgt_floats(&s->corner[0][0], 0)};
        assert_int_equal(cgt_scene_set_triangles(s->scene, NULL, &triangles), CGT_OK);
    }
    assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
}

static void subject_free(subject *s)
{
    cgt_scene_release(s->scene);
    cgt_context_release(s->context);
    cloud_free(&s->spheres);
    free(s->corner);
}

/* ---- rays ---- */

static void aim(test_random *r, const subject *s, truth_ray *q)
{
    const float *to = random_below(r, 2) ? s->spheres.sphere[random_below(r, PRIMITIVES)]
                                         : &s->corner[random_below(r, PRIMITIVES)][3 * random_below(r, 3)];
    for (int a = 0; a < 3; a++)
        q->dir[a] = to[a] - q->org[a];
}

static void make_rays(test_random *r, const subject *s, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        given[i] = ray_random(r, &s->spheres);
        if (i % 3 == 0)
            aim(r, s, &given[i]);
    }
}

/* ---- comparing ---- */

static uint64_t wrong_hits(uint32_t count)
{
    uint64_t wrong = 0;
    for (uint32_t i = 0; i < count; i++)
        wrong += memcmp(&hit[i], &truth[i], sizeof *hit) != 0 || occluded[i] != (truth[i].primitive != CGT_INVALID_ID);
    return wrong;
}

static void trace(const subject *s, uint32_t first, uint32_t count, const cgt_trace_options *options)
{
    const cgt_rays rays = ray_array(given + first, count);
    const cgt_hits hits = {.stride = sizeof(found),
                           .t = &hit[first].t,
                           .primitive = &hit[first].primitive,
                           .geometry = &hit[first].geometry};
    memset(hit + first, 7, count * sizeof *hit);
    memset(occluded + first, 7, count);
    assert_int_equal(cgt_trace_rays(s->scene, &rays, &hits, options), CGT_OK);
    assert_int_equal(cgt_occluded_rays(s->scene, &rays, occluded + first, options), CGT_OK);
}

/* Which rays of a call are interleaved. */
enum { INTERLEAVED_NONE, INTERLEAVED_ALL, INTERLEAVED_REST, INTERLEAVED_WAYS };

static void set_interleaved(int which)
{
    interleave_min = interleave_max = which == INTERLEAVED_ALL ? 2.f * CGT_RAYS_CHUNK : 0;
    interleave_spread = 0;
    interleave_share = which == INTERLEAVED_REST ? -1 : 2;
}

/* What is right: the hits in small batches. */
static uint64_t find_truth(const subject *s, uint32_t count)
{
    uint64_t hits = 0;
    set_interleaved(INTERLEAVED_NONE);
    for (uint32_t i = 0; i < count; i += 64)
        trace(s, i, count - i < 64 ? count - i : 64, NULL);
    memcpy(truth, hit, count * sizeof *hit);
    for (uint32_t i = 0; i < count; i++)
        hits += hit[i].primitive != CGT_INVALID_ID;
    return hits;
}

/* ---- tests ---- */

TEST(buffers_do_not_matter)
{
    static const uint32_t least = CGT_BVH_MAX_DEPTH * STREAM_MIN_WORDS, arenas[] = {CGT_STREAM_ARENA, least},
                          stacks[] = {INTERLEAVED_STACK, 1};
    for (int kind = 0; kind < CLOUD_KINDS; kind++)
        for (int what = clusters_always() ? TRIANGLES : SPHERES; what <= (clusters_always() ? TRIANGLES : BOTH);
             what++) {
            test_random r = random_make(10 * (uint64_t)kind + (uint64_t)what);
            subject s;
            subject_make(&r, (cloud_kind)kind, (content)what, what == BOTH ? 0x1p-50f : 1, &s);
            make_rays(&r, &s, RAYS);
            assert_true(find_truth(&s, RAYS) > 0);
            for (size_t k = 0; k < TEST_COUNT(arenas); k++)
                for (int way = 0; way < INTERLEAVED_WAYS; way++) {
                    arena_used = arenas[k];
                    interleaved_stack = stacks[k];
                    set_interleaved(way);
                    trace(&s, 0, RAYS, NULL);
                    assert_int_equal(wrong_hits(RAYS), 0);
                }
            arena_used = CGT_STREAM_ARENA;
            interleaved_stack = INTERLEAVED_STACK;
            subject_free(&s);
        }
}

TEST(batches_do_not_matter)
{
    static const uint32_t sizes[] = {1, 3, 17, 300, 1000, 4096, 4097, 2 * CGT_STREAM_CHUNK, ALL_RAYS};
    test_random r = random_make(77);
    subject s;
    subject_make(&r, CLOUD_UNIFORM, clusters_always() ? TRIANGLES : BOTH, 1, &s);
    make_rays(&r, &s, ALL_RAYS);
    assert_true(find_truth(&s, ALL_RAYS) > ALL_RAYS / 10);
    interleave_min = 8;
    interleave_spread = 300;
    interleave_max = 160;
    for (size_t k = 0; k < TEST_COUNT(sizes); k++) {
        /* on slow machines little more than a batch */
        const uint32_t all = is_slow() && sizes[k] + 70 < ALL_RAYS ? sizes[k] + 70 : ALL_RAYS;
        for (uint32_t i = 0; i < all; i += sizes[k])
            trace(&s, i, all - i < sizes[k] ? all - i : sizes[k], NULL);
        assert_int_equal(wrong_hits(all), 0);
    }
    subject_free(&s);
}

/* All but every tenth primitive in a small part of the world, around the middle. */
static void make_dense(subject *s, float amount)
{
    for (uint32_t i = 0; i < PRIMITIVES; i++)
        for (int k = 0; i % 10 && k < 9; k++) {
            const float middle = s->spheres.middle[k % 3];
            if (k < 3)
                s->spheres.sphere[i][k] = middle + amount * (s->spheres.sphere[i][k] - middle);
            s->corner[i][k] = middle + amount * (s->corner[i][k] - middle);
        }
    for (uint32_t i = 0; i < PRIMITIVES; i++)
        s->spheres.sphere[i][3] *= i % 10 ? amount : 1;
    assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
}

/* Shadow rays to a lamp among small primitives, from far away: single precision decides most of them, since they are
 * moved to the lamp. */
TEST(rays_to_an_end_are_cheap)
{
    for (uint32_t turn = 0; turn < 6 && !clusters_always(); turn++) { /* those of strewn triangles are large */
        test_random r = random_make(90 + turn);
        const float amount = ldexpf(1, -12 - 3 * (int)turn);
        subject s;
        cgt_trace_statistics n;
        const cgt_trace_options options = {.statistics = &n};
        float lamp[3];
        subject_make(&r, CLOUD_UNIFORM, turn % 2 ? SPHERES : TRIANGLES, 1, &s);
        memset(s.spheres.middle, 0, sizeof s.spheres.middle);
        make_dense(&s, amount);
        for (int a = 0; a < 3; a++)
            lamp[a] = amount * s.spheres.reach * random_float(&r, -1, 1);
        for (uint32_t i = 0; i < RAYS; i++) {
            given[i] = (truth_ray){.t_max = 1};
            for (int a = 0; a < 3; a++) {
                given[i].org[a] = s.spheres.reach * random_float(&r, -1, 1);
                given[i].dir[a] = lamp[a] - given[i].org[a];
            }
        }
        assert_true(find_truth(&s, RAYS) > RAYS / 10);
        for (int way = 0; way < INTERLEAVED_WAYS; way++) {
            set_interleaved(way);
            trace(&s, 0, RAYS, &options);
            assert_int_equal(wrong_hits(RAYS), 0);
            assert_in_range(n.double_tests, 0, 4 * RAYS);
        }
        subject_free(&s);
    }
}

TEST(counts_add_up)
{
    test_random r = random_make(78);
    subject s;
    subject_make(&r, CLOUD_UNIFORM, clusters_always() ? TRIANGLES : BOTH, 1, &s);
    make_rays(&r, &s, RAYS);
    given[3].dir[1] = NAN;
    const uint64_t hits = find_truth(&s, RAYS);
    for (int turn = 0; turn < 4; turn++) {
        const cgt_rays rays = ray_array(given, RAYS);
        const cgt_hits none = {0};
        cgt_trace_statistics n;
        cgt_research_trace_statistics visits;
        const cgt_research_trace_options research = {.statistics = &visits};
        const cgt_trace_options options = {.statistics = &n, .research = &research};
        set_interleaved((int)turn / 2);
        if (turn % 2)
            assert_int_equal(cgt_occluded_rays(s.scene, &rays, occluded, &options), CGT_OK);
        else
            assert_int_equal(cgt_trace_rays(s.scene, &rays, &none, &options), CGT_OK);
        assert_int_equal(n.rays, RAYS);
        assert_int_equal(n.bvh_rays, RAYS);
        assert_int_equal(n.invalid_rays, 1);
        assert_int_equal(n.hits, hits);
        assert_true(visits.nodes && visits.leaves && n.packet_tests && n.ray_tests >= n.packet_tests);
        assert_true(n.exact_tests <= n.double_tests && n.double_tests < n.ray_tests);
    }
    subject_free(&s);
}

/* Leaves with boxes smaller than the rounding error of slabs: clumps of spheres that are nearly points. */
static void make_specks(test_random *r, subject *s)
{
    float middle[16][3];
    for (int k = 0; k < 16; k++)
        for (int a = 0; a < 3; a++)
            middle[k][a] = ((float)random_below(r, 1 << 17) - 0x1p16f) * 0x1p-16f;
    for (uint32_t i = 0; i < PRIMITIVES; i++) {
        memcpy(s->spheres.sphere[i], middle[i % 16], sizeof middle[0]);
        s->spheres.sphere[i][3] = 0x1p-30f;
    }
    assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
}

/* Ray i passes exactly through the centre of a speck, a few short steps away. */
static void aim_at_speck(test_random *r, const subject *s, uint32_t i)
{
    const float *sphere = s->spheres.sphere[random_below(r, PRIMITIVES)];
    const float steps = (float)(1 + random_below(r, 12));
    given[i] = (truth_ray){.t_max = INFINITY};
    for (uint32_t a = 0; a < 3; a++) {
        given[i].dir[a] = ((float)random_below(r, 127) - 63) / 64;
        given[i].org[a] = sphere[a] - steps * given[i].dir[a];
    }
}

TEST(bounds_of_slabs_break_where_they_are_tightened)
{
    typedef struct tally {
        uint64_t lost;
    } tally;
    tally sum[STEPS] = {{0}};
    uint64_t hits = 0;
    if (clusters_always()) /* specks are spheres */
        skip();
    for (uint32_t turn = 0; turn < 4; turn++) {
        test_random r = random_make(300 + turn);
        subject s;
        float scale = 1;
        subject_make(&r, CLOUD_UNIFORM, SPHERES, 1, &s);
        make_specks(&r, &s);
        for (uint32_t i = 0; i < RAYS; i++)
            aim_at_speck(&r, &s, i);
        hits += find_truth(&s, RAYS);
        for (int step = 0; step < bound_steps(); step++, scale *= 0.70710678f) {
            error_scale = scale;
            set_interleaved((int)turn % 2);
            trace(&s, 0, RAYS, NULL);
            sum[step].lost += wrong_hits(RAYS);
        }
        error_scale = 1;
        subject_free(&s);
    }
    assert_true(hits > RAYS);
    check_break("a hit lost", sum, sizeof *sum, offsetof(tally, lost), 0x1p-9);
}

/* Rays past the edges of triangles and the silhouettes of spheres, to within rounding. */
TEST(bounds_of_leaves_break_where_they_are_tightened)
{
    typedef struct tally {
        uint64_t wrong;
    } tally;
    tally sum[STEPS] = {{0}};
    for (uint32_t turn = 0; turn < 4; turn++) {
        test_random r = random_make(400 + turn);
        subject s;
        float scale = 0x1p-24f;
        if (clusters_always() && turn % 2)
            continue;
        subject_make(&r, CLOUD_UNIFORM, turn % 2 ? SPHERES : TRIANGLES, 1, &s);
        for (uint32_t i = 0; i < RAYS; i++) {
            const float *sphere = s.spheres.sphere[random_below(&r, PRIMITIVES)], share = random_float(&r, 0, 1);
            const float *corner = s.corner[random_below(&r, PRIMITIVES)];
            truth_ray q = ray_random(&r, &s.spheres);
            float c[3], cc = 0, side[3];
            for (int a = 0; a < 3; a++) {
                c[a] = sphere[a] - q.org[a];
                cc += c[a] * c[a];
            }
            /* orthogonal to c and y: to the point of the silhouette there, seen from afar */
            const float across = sqrtf(c[0] * c[0] + c[2] * c[2]), root = sqrtf(1 - sphere[3] * sphere[3] / cc);
            side[0] = c[2] / across;
            side[1] = 0;
            side[2] = -c[0] / across;
            for (int a = 0; a < 3; a++) {
                if (turn % 2 && cc > sphere[3] * sphere[3])
                    q.dir[a] = c[a] * root + side[a] * sphere[3];
                else
                    q.dir[a] = corner[a] + share * (corner[3 + a] - corner[a]) - q.org[a];
            }
            given[i] = q;
        }
        find_truth(&s, RAYS);
        for (int step = 0; step < bound_steps(); step++, scale *= 0.70710678f) {
            filter_u = scale;
            set_interleaved((int)turn / 2 % 2);
            trace(&s, 0, RAYS, NULL);
            sum[step].wrong += wrong_hits(RAYS);
        }
        filter_u = 0x1p-24f;
        subject_free(&s);
    }
    check_break("a wrong hit", sum, sizeof *sum, offsetof(tally, wrong), 0x1p-11);
}

VARIANT_SUITE("test_stream_bounds", NULL, NULL)
