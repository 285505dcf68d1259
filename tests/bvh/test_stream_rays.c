/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Traces arrays of rays through the BVH with one variant. Hits have the bits that exact arithmetic finds by brute
 * force: for any rays, batch sizes, orders, layouts and ranges, as streams and interleaved, with large and with
 * minimal buffers, and with skipped primitives. Then the bounds of slabs are tightened until hits are lost. The test
 * compiles the streams itself and links them in place of the library's. */
#include "exact/valid_primitive.h"
#include "support/suite.h"
#include "support/ray_arrays.h"
#include "support/scenes.h"
#include "support/tightened.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"

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

typedef struct given_ray {
    truth_ray ray;
    uint32_t primitive, geometry; /* that it skips */
} given_ray;

typedef struct found {
    float t;
    uint32_t primitive, geometry;
} found;

typedef struct subject {
    cgt_context *context;
    cgt_scene *scene;
    cloud spheres;
    float (*corner)[9]; /* of triangles */
    bool skips;
} subject;

static given_ray given[ALL_RAYS];
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

/* A ray that is hard for slabs and ranges. */
static truth_ray hard_ray(test_random *r, const subject *s)
{
    truth_ray q = ray_random(r, &s->spheres);
    const float *sphere = s->spheres.sphere[random_below(r, PRIMITIVES)];
    const uint32_t axis = random_below(r, 3);
    switch (random_below(r, 11)) {
    case 0: /* along an axis, at a surface or a corner, with nearly zero components */
        for (uint32_t a = 0; a < 3; a++) {
            static const float none[] = {0, -0.f, 0x1p-149f, -0x1p-140f, 0x1p-60f, -0x1p-41f, 0x1p-39f};
            q.dir[a] = a == axis ? 1 : none[random_below(r, TEST_COUNT(none))];
            q.org[a] = random_below(r, 2) ? sphere[a] + sphere[3] * ((float)random_below(r, 3) - 1)
                                          : s->corner[random_below(r, PRIMITIVES)][a];
        }
        q.org[axis] -= random_float(r, -3, 3) * s->spheres.reach;
        break;
    case 1: /* from far away */
        for (int a = 0; a < 3; a++)
            q.org[a] = s->spheres.middle[a] + s->spheres.reach * random_log(r, 10, 1e9f) * random_float(r, -1, 1);
        aim(r, s, &q);
        break;
    case 2: /* from a corner */ memcpy(q.org, s->corner[random_below(r, PRIMITIVES)], sizeof q.org); break;
    case 3: /* from inside a sphere */
        for (int a = 0; a < 3; a++)
            q.org[a] = sphere[a] + 0.5f * sphere[3] * random_float(r, -1, 1);
        break;
    case 4: /* any length */
        for (int a = 0; a < 3; a++)
            q.dir[a] *= ldexpf(1, (int)random_below(r, 100) - 50);
        break;
    case 5: /* hits behind the origin count */
        q.t_min = random_below(r, 2) ? -INFINITY : -random_log(r, 1e-3f, 1e3f);
        break;
    case 6: /* an invalid ray, or an empty range */
        q.t_max = random_below(r, 2) ? NAN : q.t_min - 1;
        if (random_below(r, 2))
            q.dir[axis] = NAN;
        break;
    case 7: /* ends at infinity */
        q.t_min = random_below(r, 2) ? INFINITY : -INFINITY;
        q.t_max = random_below(r, 2) ? INFINITY : -INFINITY;
        break;
    case 8: /* beyond single precision */ q.dir[axis] *= 0x1p70f; break;
    case 9: /* ends so far behind the origin that its normalised end is -infinity */
        for (int a = 0; a < 3; a++)
            q.dir[a] *= 16;
        q.t_min = -INFINITY;
        q.t_max = -FLT_MAX * random_float(r, 0.1f, 1);
        break;
    default: aim(r, s, &q); break;
    }
    return q;
}

/* ---- the truth ---- */

static bool ray_counts(const truth_ray *q)
{
    float zero = 0;
    bool nonzero = false;
    for (int a = 0; a < 3; a++) {
        zero += q->org[a] * 0 + q->dir[a] * 0;
        nonzero |= q->dir[a] != 0;
    }
    return zero == 0 && nonzero && q->t_min <= q->t_max;
}

static found find_truth(const subject *s, const given_ray *g)
{
    const cgt_primitives *prims = &s->scene->committed_scene.prims;
    found f = {INFINITY, CGT_INVALID_ID, CGT_INVALID_ID};
    cgt_counts counts = {0};
    cgt_ray ray = {.t_min = g->ray.t_min < -FLT_MAX ? -FLT_MAX : g->ray.t_min, .t_max = g->ray.t_max};
    uint32_t closest = CGT_INVALID_ID;
    double t;
    memcpy(ray.line.org, g->ray.org, sizeof g->ray.org);
    memcpy(ray.line.dir, g->ray.dir, sizeof g->ray.dir);
    if (!ray_counts(&g->ray))
        return f;
    for (uint32_t i = 0; i < prims->count; i++) {
        const cgt_primitive_array *a = cgt_primitives_array(prims, i);
        const cgt_primitive primitive = cgt_primitives_get(prims, i);
        if (cgt_primitive_check(&primitive) != CGT_PRIMITIVE_VALID ||
            (s->skips && g->geometry == a->geometry && g->primitive == i - a->first))
            continue;
        if (!filter_is_closer(prims, &ray, closest, i, &t, &counts))
            continue;
        closest = i;
        f = (found){(float)t, i - a->first, a->geometry};
    }
    return f;
}

static void make_rays(test_random *r, subject *s, uint32_t count)
{
    const uint32_t arrays = s->scene->committed_scene.prims.arrays;
    for (uint32_t i = 0; i < count; i++) {
        given_ray *g = &given[i];
        *g = (given_ray){.ray = i % 2 ? hard_ray(r, s) : ray_random(r, &s->spheres)};
        if (i % 3 == 0)
            aim(r, s, &g->ray);
        s->skips = false;
        const found f = find_truth(s, g);
        if (f.primitive != CGT_INVALID_ID && i % 5 == 0) /* ranges that begin or end exactly at the hit */
            *(random_below(r, 2) ? &g->ray.t_max : &g->ray.t_min) = f.t;
        if (f.primitive != CGT_INVALID_ID && i % 11 == 0)
            *(random_below(r, 2) ? &g->ray.t_max : &g->ray.t_min) =
                nextafterf(f.t, random_below(r, 2) ? INFINITY : -INFINITY);
        const uint32_t which = random_below(r, 4);
        g->primitive = which == 0 ? CGT_INVALID_ID : which == 1 ? random_below(r, 2 * PRIMITIVES) : f.primitive;
        g->geometry = which == 1 ? random_below(r, arrays + 1) : f.geometry;
    }
}

/* ---- comparing ---- */

static cgt_rays array_of(const given_ray *q, uint64_t count, bool skips)
{
    return (cgt_rays){.count = count,
                      .stride = sizeof *q,
                      .org = {&q->ray.org[0], &q->ray.org[1], &q->ray.org[2]},
                      .dir = {&q->ray.dir[0], &q->ray.dir[1], &q->ray.dir[2]},
                      .t_min = &q->ray.t_min,
                      .t_max = &q->ray.t_max,
                      .skip_primitive = skips ? &q->primitive : NULL,
                      .skip_geometry = skips ? &q->geometry : NULL};
}

/* Returns the number of wrong hits. */
/* t is not judged where `any_t`. */
static uint64_t wrong_hits_but_t(const subject *s, uint32_t count, bool tell, bool any_t)
{
    uint64_t wrong = 0;
    for (uint32_t i = 0; i < count; i++) {
        const bool none = truth[i].primitive == CGT_INVALID_ID;
        if ((any_t || same_bits(hit[i].t, truth[i].t)) && hit[i].primitive == truth[i].primitive &&
            hit[i].geometry == truth[i].geometry && occluded[i] == !none)
            continue;
        const truth_ray *q = &given[i].ray;
        if (tell && wrong++ < 3)
            print_message("ray %u: t %a, %u of %u, occluded %u; true: %a, %u of %u\n  org %a %a %a dir %a %a %a "
                          "range %a %a, scale of the scene %a\n",
                          i, (double)hit[i].t, hit[i].primitive, hit[i].geometry, occluded[i], (double)truth[i].t,
                          truth[i].primitive, truth[i].geometry, (double)q->org[0], (double)q->org[1],
                          (double)q->org[2], (double)q->dir[0], (double)q->dir[1], (double)q->dir[2], (double)q->t_min,
                          (double)q->t_max, (double)s->scene->committed_scene.scale);
        wrong += !tell;
    }
    return wrong;
}

static uint64_t wrong_hits(const subject *s, uint32_t count, bool tell)
{
    return wrong_hits_but_t(s, count, tell, false);
}

static void trace(const subject *s, const cgt_rays *rays, uint64_t first, const cgt_trace_options *options)
{
    const cgt_hits hits = {.stride = sizeof(found),
                           .t = &hit[first].t,
                           .primitive = &hit[first].primitive,
                           .geometry = &hit[first].geometry};
    memset(hit + first, 7, rays->count * sizeof *hit);
    memset(occluded + first, 7, rays->count);
    assert_int_equal(cgt_trace_rays(s->scene, rays, &hits, options), CGT_OK);
    assert_int_equal(cgt_occluded_rays(s->scene, rays, occluded + first, options), CGT_OK);
}

/* Which rays of a call are interleaved. */
enum { INTERLEAVED_NONE, INTERLEAVED_ALL, INTERLEAVED_REST, INTERLEAVED_WAYS };

static void set_interleaved(int which)
{
    interleave_min = interleave_max = which == INTERLEAVED_ALL ? 2.f * CGT_RAYS_CHUNK : 0;
    interleave_spread = 0;
    interleave_share = which == INTERLEAVED_REST ? -1 : 2;
}

static void check(subject *s, uint32_t count)
{
    static const uint32_t least = CGT_BVH_MAX_DEPTH * STREAM_MIN_WORDS, arenas[] = {CGT_STREAM_ARENA, least},
                          stacks[] = {INTERLEAVED_STACK, 1};
    for (int skips = 0; skips < 2; skips++) {
        s->skips = skips;
        for (uint32_t i = 0; i < count; i++)
            truth[i] = find_truth(s, &given[i]);
        for (size_t k = 0; k < TEST_COUNT(arenas); k++)
            for (int way = 0; way < INTERLEAVED_WAYS; way++) {
                const cgt_rays rays = array_of(given, count, skips);
                arena_used = arenas[k];
                interleaved_stack = stacks[k];
                set_interleaved(way);
                trace(s, &rays, 0, NULL);
                assert_int_equal(wrong_hits(s, count, true), 0);
            }
        arena_used = CGT_STREAM_ARENA;
        interleaved_stack = INTERLEAVED_STACK;
    }
}

/* Rays without t_max, whose array is omitted; some begin exactly at a second root. */
static void check_endless(test_random *r, subject *s, uint32_t count)
{
    s->skips = false;
    for (uint32_t i = 0; i < count; i++) {
        given_ray *g = &given[i];
        g->ray.t_max = INFINITY;
        truth[i] = find_truth(s, g);
        if (i % 3 || truth[i].primitive == CGT_INVALID_ID)
            continue;
        g->ray.t_min = nextafterf(truth[i].t, INFINITY);
        truth[i] = find_truth(s, g);
        if (truth[i].primitive == CGT_INVALID_ID)
            continue;
        g->ray.t_min = random_below(r, 2) ? truth[i].t : nextafterf(truth[i].t, INFINITY);
        truth[i] = find_truth(s, g);
    }
    cgt_rays rays = array_of(given, count, false);
    rays.t_max = NULL;
    for (int way = 0; way < INTERLEAVED_WAYS; way++) {
        set_interleaved(way);
        trace(s, &rays, 0, NULL);
        assert_int_equal(wrong_hits(s, count, true), 0);
    }
}

/* ---- tests ---- */

/* Beyond 2^-60 rays are extreme; beyond 2^55 there is no BVH. */
static float scale_of(int kind, int what)
{
    static const float scales[] = {1, 0x1p-50f, 0x1p30f, 0x1p-80f};
    return scales[(kind + what) % 4];
}

TEST(hits_are_exact)
{
    for (int kind = 0; kind < CLOUD_KINDS; kind++)
        for (int what = SPHERES; what <= BOTH; what++) {
            if (clusters_always() && what != TRIANGLES)
                continue;
            test_random r = random_make(10 * (uint64_t)kind + (uint64_t)what);
            subject s;
            subject_make(&r, (cloud_kind)kind, (content)what, scale_of(kind, what), &s);
            const uint32_t count =
                (uint32_t)((is_slow() ? 50 : 100) + test_scaled(scale_of(kind, what) < 0x1p-60f ? 100 : RAYS));
            make_rays(&r, &s, count);
            check(&s, count);
            check_endless(&r, &s, count);
            subject_free(&s);
        }
}

/* Rays of a stream that start near each other, at a surface or a corner, exactly where boxes and primitives end; in any
 * octant. */
static void make_neighbours(test_random *r, subject *s, uint32_t count)
{
    static const float spreads[] = {0, 0x1p-24f, 1e-5f, 1e-3f, 0.1f};
    const float spread = spreads[random_below(r, TEST_COUNT(spreads))] * s->spheres.reach;
    const float *sphere = s->spheres.sphere[random_below(r, PRIMITIVES)];
    const uint32_t axis = random_below(r, 3), ends = random_below(r, 3), before = random_below(r, 4);
    const bool along = random_below(r, 3) == 0; /* to a pole, where box and sphere end, all equal */
    const float side = random_below(r, 2) ? 1 : -1;
    float from[3];
    memcpy(from, s->corner[random_below(r, PRIMITIVES)] + 3 * random_below(r, 3), sizeof from);
    if (random_below(r, 2))
        for (uint32_t a = 0; a < 3; a++)
            from[a] = sphere[a] + (a == axis ? side * sphere[3] : 0);
    if (along)
        for (uint32_t a = 0; a < 3; a++)
            from[a] = sphere[a] + (a == axis ? 0.5f * side * s->spheres.reach : 0);
    for (uint32_t i = 0; i < count; i++) {
        given_ray *g = &given[i];
        *g = (given_ray){.ray = ray_random(r, &s->spheres), .primitive = CGT_INVALID_ID};
        g->ray.t_min = before == 0 && i % 64 == 5 ? -random_log(r, 1e-6f, 1) : 0;
        g->ray.t_max = INFINITY;
        for (uint32_t a = 0; a < 3; a++)
            g->ray.org[a] = from[a] + spread * (i % 8 && !along ? random_float(r, -1, 1) : 0);
        if (i % 4 == 1)
            aim(r, s, &g->ray);
        if (i % 4 == 2)
            g->ray.dir[random_below(r, 3)] = random_below(r, 2) ? 0 : -0.f;
        for (uint32_t a = 0; a < 3 && along; a++)
            g->ray.dir[a] = a == axis ? -side : 0;
        if (ends)
            g->ray.t_max = along ? INFINITY : random_float(r, 0, 0.3f) * s->spheres.reach;
        s->skips = false;
        const found f = find_truth(s, g);
        if (f.primitive != CGT_INVALID_ID && ends == 2)
            g->ray.t_max = random_below(r, 4) ? f.t : nextafterf(f.t, 0);
    }
}

TEST(neighbours_are_exact)
{
    for (int kind = 0; kind < CLOUD_KINDS; kind++)
        for (int what = SPHERES; what <= BOTH; what++) {
            if (clusters_always() && what != TRIANGLES)
                continue;
            test_random r = random_make(500 + 10 * (uint64_t)kind + (uint64_t)what);
            const uint32_t rounds = (uint32_t)(1 + test_scaled(6)), count = is_slow() ? 40 : 150;
            subject s;
            subject_make(&r, (cloud_kind)kind, (content)what, what == BOTH ? 0x1p-50f : 1, &s);
            for (uint32_t k = 0; k < rounds; k++) {
                make_neighbours(&r, &s, count);
                check(&s, count);
            }
            subject_free(&s);
        }
}

/* Batches of any size, in any order, as structure of arrays and as array of structures; and in FAST precision. */
TEST(batches_do_not_matter)
{
    static float plain[8][ALL_RAYS];
    static const uint32_t sizes[] = {1, 2, 3, 15, 16, 17, 64, 300, 1000, 4096, 4097, 2 * CGT_STREAM_CHUNK, ALL_RAYS};
    test_random r = random_make(77);
    subject s;
    interleave_min = 8;
    interleave_spread = 300;
    interleave_max = 160;
    subject_make(&r, CLOUD_UNIFORM, clusters_always() ? TRIANGLES : BOTH, 1, &s);
    make_rays(&r, &s, RAYS);
    for (uint32_t i = 0; i < RAYS; i++)
        truth[i] = find_truth(&s, &given[i]);
    for (uint32_t i = RAYS; i < ALL_RAYS; i++) {
        const uint32_t k = random_below(&r, RAYS);
        given[i] = given[k];
        truth[i] = truth[k];
    }
    for (uint32_t i = 0; i < ALL_RAYS; i++)
        for (int a = 0; a < 3; a++) {
            plain[a][i] = given[i].ray.org[a];
            plain[3 + a][i] = given[i].ray.dir[a];
            plain[6][i] = given[i].ray.t_min;
            plain[7][i] = given[i].ray.t_max;
        }
    cgt_trace_options options;
    cgt_trace_options_init(&options);
    for (size_t k = 0; k < TEST_COUNT(sizes); k++)
        for (int layout = 0; layout < 2; layout++) {
            /* on slow machines little more than a batch */
            const uint32_t least = sizes[k] + 70 < ALL_RAYS ? sizes[k] + 70 : ALL_RAYS;
            const uint32_t all = is_slow() ? least : ALL_RAYS;
            if (all < ALL_RAYS && layout != (int)(k % 2))
                continue;
            for (uint32_t i = 0; i < all; i += sizes[k]) {
                const uint32_t count = all - i < sizes[k] ? all - i : sizes[k];
                cgt_rays rays = array_of(given + i, count, false);
                if (layout)
                    rays = (cgt_rays){.count = count,
                                      .org = {plain[0] + i, plain[1] + i, plain[2] + i},
                                      .dir = {plain[3] + i, plain[4] + i, plain[5] + i},
                                      .t_min = plain[6] + i,
                                      .t_max = plain[7] + i};
                options.precision = k % 2 ? CGT_PRECISION_FAST : CGT_PRECISION_EXACT;
                trace(&s, &rays, i, &options);
            }
            assert_int_equal(wrong_hits_but_t(&s, all, true, options.precision == CGT_PRECISION_FAST), 0);
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
TEST(rays_to_an_end_are_exact)
{
    for (uint32_t turn = 0; turn < 6; turn++) {
        test_random r = random_make(90 + turn);
        const float amount = ldexpf(1, -12 - 3 * (int)turn);
        subject s;
        uint64_t hits = 0;
        cgt_trace_statistics n;
        const cgt_trace_options options = {.statistics = &n};
        float lamp[3];
        subject_make(&r, CLOUD_UNIFORM, clusters_always() ? TRIANGLES : turn % 2 ? SPHERES : TRIANGLES, 1, &s);
        memset(s.spheres.middle, 0, sizeof s.spheres.middle);
        make_dense(&s, amount);
        for (int a = 0; a < 3; a++)
            lamp[a] = amount * s.spheres.reach * random_float(&r, -1, 1);
        for (uint32_t i = 0; i < RAYS; i++) {
            truth_ray q = {.t_max = 1};
            for (int a = 0; a < 3; a++) {
                q.org[a] = s.spheres.reach * random_float(&r, -1, 1);
                q.dir[a] = lamp[a] - q.org[a];
            }
            given[i] = (given_ray){.ray = q};
            truth[i] = find_truth(&s, &given[i]);
            if (i % 5 == 0 && truth[i].t > 0.999f && truth[i].t < 1) { /* ends exactly there, or just before */
                given[i].ray.t_max = i % 2 ? truth[i].t : nextafterf(truth[i].t, 0);
                truth[i] = find_truth(&s, &given[i]);
            }
            hits += truth[i].primitive != CGT_INVALID_ID;
        }
        assert_true(hits > RAYS / 10);
        const cgt_rays rays = array_of(given, RAYS, false);
        for (int way = 0; way < INTERLEAVED_WAYS; way++) {
            set_interleaved(way);
            trace(&s, &rays, 0, NULL);
            assert_int_equal(wrong_hits(&s, RAYS, true), 0);
            assert_int_equal(cgt_occluded_rays(s.scene, &rays, occluded, &options), CGT_OK);
            if (!clusters_always()) /* clusters of strewn triangles are as large as the world: nothing small is seen */
                assert_in_range(n.double_tests, 0, 4 * RAYS);
        }
        subject_free(&s);
    }
}

/* Lays most triangles into the plane across an axis through the origin, and all spheres, as points. */
static void flatten(subject *s, uint32_t axis)
{
    for (uint32_t i = 0; i < PRIMITIVES; i++) {
        s->spheres.sphere[i][axis] = s->spheres.sphere[i][3] = 0;
        for (uint32_t k = axis; i % 8 && k < 9; k += 3)
            s->corner[i][k] = 0;
    }
    assert_int_equal(cgt_scene_commit(s->scene), CGT_OK);
}

/* Most rays lie in that plane, some through a point or above it. Those of `vanishing` move along the axis, too, by so
 * little that a normalised direction does not: they begin on a triangle. Returns how many meet a point or begin so. */
static uint64_t make_flat_rays(test_random *r, const subject *s, uint32_t axis, bool vanishing, uint32_t count)
{
    uint64_t met = 0;
    for (uint32_t i = 0; i < count; i++) {
        truth_ray q = ray_random(r, &s->spheres);
        const float *corner = s->corner[random_below(r, PRIMITIVES)];
        const uint32_t other = (axis + 1 + random_below(r, 2)) % 3;
        q.t_max = INFINITY;
        for (uint32_t a = 0; a < 3 && i % 4 == 1; a++)
            q.dir[a] = a == other;
        for (uint32_t a = 0; a < 3 && i % 4 == 1; a++)
            q.org[a] = s->spheres.sphere[i % PRIMITIVES][a] - 2 * s->spheres.reach * q.dir[a];
        for (uint32_t a = 0; a < 3 && vanishing && i % 4 == 2; a++)
            q.org[a] = 0.5f * corner[a] + 0.25f * (corner[3 + a] + corner[6 + a]);
        if (i % 8)
            q.org[axis] = 0;
        if (i % 16 != 7)
            q.dir[axis] = i % 2 ? 0 : -0.f;
        if (vanishing && i % 4 == 2) {
            q.dir[axis] = 0x1p-149f;
            q.dir[other] = 4;
        }
        given[i] = (given_ray){.ray = q, .primitive = CGT_INVALID_ID};
        truth[i] = find_truth(s, &given[i]);
        met += truth[i].primitive != CGT_INVALID_ID && i % 4 == (vanishing ? 2 : 1);
    }
    return met;
}

/* Flat boxes are dropped for rays that are parallel to them, and for no others. */
TEST(rays_in_a_plane_are_exact)
{
    for (uint32_t turn = 0; turn < 12; turn++) {
        const uint32_t axis = turn % 3, count = is_slow() ? 100 : 300;
        const content what = clusters_always() || turn / 6 ? TRIANGLES : SPHERES;
        const bool vanishing = what == TRIANGLES && turn / 3 % 2;
        test_random r = random_make(120 + turn);
        subject s;
        subject_make(&r, CLOUD_UNIFORM, what, 1, &s);
        flatten(&s, axis);
        s.skips = false;
        const uint64_t met = make_flat_rays(&r, &s, axis, vanishing, count);
        assert_true(what == TRIANGLES && !vanishing ? true : met > count / 8);
        check(&s, count);
        for (uint32_t i = 0; i < count; i++) {
            const cgt_single_ray ray = single_ray(&given[i].ray);
            cgt_hit single;
            assert_int_equal(cgt_trace_ray(s.scene, &ray, &single, NULL), CGT_OK);
            assert_int_equal(single.primitive, truth[i].primitive);
        }
        subject_free(&s);
    }
}

/* Rays so slow that t is no float where they meet most things, which is no hit; from within boxes of leaves. */
TEST(slow_rays_are_exact)
{
    for (uint32_t turn = 0; turn < 12; turn++) {
        test_random r = random_make(150 + turn);
        const content what = clusters_always() || turn % 2 ? TRIANGLES : SPHERES;
        subject s;
        subject_make(&r, CLOUD_UNIFORM, what, 1, &s);
        const uint32_t near = random_below(&r, PRIMITIVES);
        const float *sphere = s.spheres.sphere[near];
        for (uint32_t i = 0; i < 200; i++) {
            truth_ray q = {.t_max = INFINITY};
            for (int a = 0; a < 3; a++) {
                q.org[a] = what == SPHERES ? sphere[a] - sphere[3] * 0.75f : s.corner[near][4 * a];
                q.dir[a] = ldexpf(random_float(&r, -1, 1), -140);
            }
            given[i] = (given_ray){.ray = q};
        }
        check_endless(&r, &s, 200);
        subject_free(&s);
    }
}

TEST(counts_add_up)
{
    test_random r = random_make(78);
    subject s;
    uint64_t invalid = 0, hits = 0;
    subject_make(&r, CLOUD_UNIFORM, clusters_always() ? TRIANGLES : BOTH, 1, &s);
    make_rays(&r, &s, RAYS);
    for (uint32_t i = 0; i < RAYS; i++) {
        float zero = 0;
        const truth_ray *q = &given[i].ray;
        for (int a = 0; a < 3; a++)
            zero += q->org[a] * 0 + q->dir[a] * 0;
        invalid += zero != 0 || q->t_min != q->t_min || q->t_max != q->t_max ||
                   (q->dir[0] == 0 && q->dir[1] == 0 && q->dir[2] == 0);
        s.skips = false;
        truth[i] = find_truth(&s, &given[i]);
        hits += truth[i].primitive != CGT_INVALID_ID;
    }
    for (int turn = 0; turn < 4; turn++) {
        const bool any = turn % 2;
        const cgt_rays rays = array_of(given, RAYS, false);
        const cgt_hits none = {0};
        cgt_trace_statistics n;
        cgt_research_trace_statistics visits;
        const cgt_research_trace_options research = {.statistics = &visits};
        const cgt_trace_options options = {.statistics = &n, .research = &research};
        set_interleaved((int)turn / 2);
        if (any)
            assert_int_equal(cgt_occluded_rays(s.scene, &rays, occluded, &options), CGT_OK);
        else
            assert_int_equal(cgt_trace_rays(s.scene, &rays, &none, &options), CGT_OK);
        assert_int_equal(n.rays, RAYS);
        assert_int_equal(n.bvh_rays, RAYS);
        assert_int_equal(n.invalid_rays, invalid);
        assert_int_equal(n.hits, hits);
        assert_true(visits.nodes && visits.leaves && n.packet_tests && n.ray_tests >= n.packet_tests);
        assert_true(n.double_tests && n.exact_tests <= n.double_tests && n.double_tests < n.ray_tests);
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

/* Ray i passes exactly through the centre of a speck, which is that many steps of dir away from its origin. */
static void aim_at_speck(test_random *r, const subject *s, uint32_t i, uint32_t steps, const float dir[3])
{
    const float *sphere = s->spheres.sphere[random_below(r, PRIMITIVES)];
    truth_ray q = {.t_max = INFINITY};
    for (uint32_t a = 0; a < 3; a++) {
        q.dir[a] = dir[a];
        q.org[a] = sphere[a] - (float)steps * dir[a];
    }
    given[i] = (given_ray){.ray = q};
    truth[i] = find_truth(s, &given[i]);
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
        for (uint32_t i = 0; i < RAYS; i++) {
            float dir[3];
            for (uint32_t a = 0; a < 3; a++)
                dir[a] = ((float)random_below(&r, 127) - 63) / 64;
            aim_at_speck(&r, &s, i, 1 + random_below(&r, 12), dir);
            hits += truth[i].primitive != CGT_INVALID_ID;
        }
        const cgt_rays rays = array_of(given, RAYS, false);
        for (int step = 0; step < STEPS; step++, scale *= 0.70710678f) {
            error_scale = scale;
            set_interleaved((int)turn % 2);
            trace(&s, &rays, 0, NULL);
            sum[step].lost += wrong_hits(&s, RAYS, false);
        }
        error_scale = 1;
        subject_free(&s);
    }
    assert_true(hits > RAYS);
    check_break("a hit lost", sum, sizeof *sum, offsetof(tally, lost), 0x1p-9);
}

/* Errors of slabs grow with the distance of the origins, which may all have negative coordinates. */
TEST(origins_may_lie_on_one_side)
{
    if (clusters_always()) /* its specks are spheres */
        skip();
    for (uint32_t turn = 0; turn < 4; turn++) {
        test_random r = random_make(350 + turn);
        subject s;
        subject_make(&r, CLOUD_UNIFORM, SPHERES, 1, &s);
        make_specks(&r, &s);
        for (uint32_t i = 0; i < RAYS; i++) {
            float dir[3];
            for (uint32_t a = 0; a < 3; a++)
                dir[a] = (float)(32 + random_below(&r, 32)) / (turn % 2 ? 64.f : -64.f);
            aim_at_speck(&r, &s, i, 6 + random_below(&r, 6), dir);
        }
        const cgt_rays rays = array_of(given, RAYS, false);
        set_interleaved((int)turn / 2);
        trace(&s, &rays, 0, NULL);
        assert_int_equal(wrong_hits(&s, RAYS, true), 0);
        subject_free(&s);
    }
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
            given[i] = (given_ray){.ray = q};
            truth[i] = find_truth(&s, &given[i]);
        }
        const cgt_rays rays = array_of(given, RAYS, false);
        for (int step = 0; step < STEPS; step++, scale *= 0.70710678f) {
            filter_u = scale;
            set_interleaved((int)turn / 2 % 2);
            trace(&s, &rays, 0, NULL);
            sum[step].wrong += wrong_hits(&s, RAYS, step == 0);
        }
        filter_u = 0x1p-24f;
        subject_free(&s);
    }
    check_break("a wrong hit", sum, sizeof *sum, offsetof(tally, wrong), 0x1p-11);
}

VARIANT_SUITE("test_stream_rays", NULL, NULL)
