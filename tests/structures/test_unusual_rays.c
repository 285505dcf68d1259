/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays of any finite numbers: directions of any length, origins from afar, and rays that start inside many spheres.
 * Through every structure and variant, in arrays and singly, hits are those of every primitive decided exactly; and
 * such rays test about as many primitives as others do. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exact/decide.h"
#include "support/suite.h"
#include "exact/valid_primitive.h"
#include "hard_cases/hard_run.h"
#include "scene/scene.h"
#include "structures/scenes/random_soup.h"

#define STRUCTURES (TEST_STRUCTURES + 1) /* and a loose grid with a BVH beside it */
#define PRIMITIVES 240u
#define RAYS 420u

/* ---- scenes ---- */

typedef enum scene_kind { SCENE_MIXED, SCENE_TRIANGLES, SCENE_OVERLAPPING, SCENE_FLAT, SCENE_KINDS } scene_kind;

static const char *const scene_name[SCENE_KINDS] = {"mixed", "triangles", "overlapping spheres", "flat"};

/* Spheres most of which overlap most others. */
static void add_overlapping(hard_scene *s, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        double center[3];
        hard_point(s, -1, 1, center);
        hard_sphere(s, center, hard_real(s, 0.4, 1.2));
    }
}

static hard_scene make_scene(scene_kind kind, uint32_t round)
{
    static const float scales[] = {1, 1e-3f, 1e4f, 0x1p-30f, 0x1p40f};
    hard_scene s;
    if (kind == SCENE_OVERLAPPING) {
        s = (hard_scene){.place = HARD_HERE, .random = random_make(round)};
        add_overlapping(&s, PRIMITIVES);
    } else
        s = soup_make(kind == SCENE_MIXED       ? SOUP_MIXED
                      : kind == SCENE_TRIANGLES ? SOUP_SIX_ORDERS
                                                : SOUP_AXIS_ALIGNED,
                      round, PRIMITIVES);
    const float scale = scales[round % TEST_COUNT(scales)];
    for (uint32_t i = 0; i < s.geometries; i++) {
        hard_geometry *g = &s.geometry[i];
        for (uint32_t k = 0; k < g->spheres; k++)
            for (int a = 0; a < 4; a++)
                g->sphere[k][a] *= scale;
        for (uint32_t k = 0; k < g->vertices; k++)
            for (int a = 0; a < 3; a++)
                g->vertex[k][a] *= scale;
    }
    assert_false(s.failed);
    return s;
}

/* ---- rays ---- */

typedef enum ray_family {
    RAY_LENGTH,   /* ordinary but for the length of the direction */
    RAY_PARALLEL, /* along an axis, from anywhere */
    RAY_EXACT,    /* from afar, through a point exactly */
    RAY_AIMED,    /* from afar, as near to a point as floats allow */
    RAY_AWAY,     /* from afar, turned away or anywhere */
    RAY_INSIDE,   /* from within the scene */
    RAY_FAMILIES
} ray_family;

/* A vertex or a centre of the scene, or a point near it. */
static void pick_point(test_random *r, const hard_scene *s, float point[3])
{
    const hard_geometry *g = &s->geometry[random_below(r, s->geometries)];
    const bool spheres = g->spheres > 0;
    const uint32_t count = spheres ? g->spheres : g->vertices;
    memset(point, 0, 3 * sizeof *point);
    if (!count)
        return;
    const float *from = spheres ? g->sphere[random_below(r, count)] : g->vertex[random_below(r, count)];
    for (int a = 0; a < 3; a++) {
        const float q = from[a] + (spheres ? from[3] * random_float(r, -0.9f, 0.9f) : 0);
        point[a] = q * 0 == 0 && fabsf(q) < 0x1p50f ? q : 0;
    }
}

static float power(test_random *r, int low, int high)
{
    return ldexpf(1, low + (int)random_below(r, (uint32_t)(high - low + 1)));
}

/* A direction of few bits, so that multiples of it are exact. */
static void short_direction(test_random *r, float d[3])
{
    do
        for (int a = 0; a < 3; a++)
            d[a] = (float)random_below(r, 65) - 32;
    while (d[0] == 0 && d[1] == 0 && d[2] == 0);
}

static void make_line(test_random *r, const hard_scene *s, ray_family f, truth_ray *ray)
{
    float point[3], d[3];
    const float far = power(r, 4, 121);
    pick_point(r, s, point);
    if (f == RAY_EXACT)
        short_direction(r, d);
    else
        random_direction(r, d);
    if (f == RAY_PARALLEL)
        for (uint32_t a = 0, along = random_below(r, 3); a < 3; a++)
            d[a] = a == along ? 1 : 0;
    for (int a = 0; a < 3; a++) {
        const float side = random_float(r, -2, 2);
        ray->dir[a] = f == RAY_AWAY && random_below(r, 2) ? -d[a] : d[a];
        ray->org[a] = point[a];
        if (f == RAY_LENGTH)
            ray->org[a] += d[a] * -4 * (fabsf(point[0]) + fabsf(point[1]) + fabsf(point[2]));
        else if (f != RAY_INSIDE)
            ray->org[a] = point[a] - d[a] * far + (f == RAY_AWAY ? side * far : 0);
    }
}

/* Lengths of directions from the least float to the largest. */
static void scale_direction(test_random *r, float dir[3])
{
    const float longest = fmaxf(fabsf(dir[0]), fmaxf(fabsf(dir[1]), fabsf(dir[2])));
    const int room = 127 - ilogbf(longest);
    const float scale = power(r, random_below(r, 4) ? -126 : -140, room < 127 ? room : 127);
    float scaled[3];
    for (int a = 0; a < 3; a++)
        scaled[a] = dir[a] * scale;
    if (scaled[0] != 0 || scaled[1] != 0 || scaled[2] != 0)
        memcpy(dir, scaled, sizeof scaled);
}

static truth_ray make_ray(test_random *r, const hard_scene *s, ray_family f)
{
    truth_ray ray = {.t_min = 0, .t_max = INFINITY};
    make_line(r, s, f, &ray);
    if (f == RAY_LENGTH || random_below(r, 2))
        scale_direction(r, ray.dir);
    if (random_below(r, 4) == 0)
        ray.t_min = -INFINITY;
    return ray;
}

/* ---- truth ---- */

typedef struct found {
    float t;
    uint32_t primitive, geometry;
} found;

/* skip: a hit whose primitive does not count. */
static found find_truth(const cgt_primitives *prims, const truth_ray *ray, const found *skip)
{
    cgt_ray line = {.t_min = ray->t_min < -FLT_MAX ? -FLT_MAX : ray->t_min, .t_max = ray->t_max};
    cgt_decided_hit best = {0};
    found f = {INFINITY, CGT_INVALID_ID, CGT_INVALID_ID};
    uint64_t exact = 0;
    memcpy(line.line.org, ray->org, sizeof ray->org);
    memcpy(line.line.dir, ray->dir, sizeof ray->dir);
    for (uint32_t i = 0; i < prims->count; i++) {
        const cgt_primitive_array *a = cgt_primitives_array(prims, i);
        cgt_decided_hit hit = {.primitive = cgt_primitives_get(prims, i)};
        if (i - a->first == skip->primitive && a->geometry == skip->geometry)
            continue;
        if (cgt_primitive_check(&hit.primitive) != CGT_PRIMITIVE_VALID || !cgt_decide_hit(&line, &hit, &exact))
            continue;
        if (f.primitive != CGT_INVALID_ID && cgt_decide_order(&line, &hit, &best, &exact) >= 0)
            continue;
        best = hit;
        f = (found){(float)hit.t, i - a->first, a->geometry};
    }
    return f;
}

/* ---- comparing ---- */

/* All rays first as they are, then so that they skip what they hit. */
typedef struct subject {
    hard_scene scene;
    truth_ray ray[RAYS];
    found truth[2][RAYS];
    full_hit first[2][RAYS]; /* of the first structure and variant */
    uint32_t hits;
    bool traced;
} subject;

static void fail_ray(const subject *s, uint32_t i, const found *truth, const char *variant, uint32_t turn,
                     const full_hit *h)
{
    const truth_ray *q = &s->ray[i];
    fail_msg("%s, structure %u, ray %u of family %u: primitive %d t %a instead of %d t %a: org %a %a %a dir %a %a %a "
             "range %a %a",
             variant, turn, i, i % RAY_FAMILIES, (int)h->primitive, (double)h->t, (int)truth->primitive,
             (double)truth->t, (double)q->org[0], (double)q->org[1], (double)q->org[2], (double)q->dir[0],
             (double)q->dir[1], (double)q->dir[2], (double)q->t_min, (double)q->t_max);
}

/* A ray and what it skips. */
typedef struct skipping_ray {
    truth_ray ray;
    uint32_t primitive, geometry;
} skipping_ray;

static cgt_rays make_arrays(const subject *s, bool skips)
{
    static skipping_ray array[RAYS];
    for (uint32_t i = 0; i < RAYS; i++)
        array[i] = (skipping_ray){s->ray[i], s->truth[0][i].primitive, s->truth[0][i].geometry};
    cgt_rays rays = ray_array(&array->ray, RAYS);
    rays.stride = sizeof *array;
    rays.skip_primitive = skips ? &array->primitive : NULL;
    rays.skip_geometry = skips ? &array->geometry : NULL;
    return rays;
}

static void check_hits(subject *s, const cgt_scene *scene, bool skips, const char *variant, uint32_t turn)
{
    static full_hit hit[RAYS];
    static uint8_t occluded[RAYS];
    const cgt_rays rays = make_arrays(s, skips);
    const cgt_hits hits = hit_array(hit);
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
    assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, NULL), CGT_OK);
    if (!s->traced)
        memcpy(s->first[skips], hit, sizeof hit);
    for (uint32_t i = 0; i < RAYS; i++) {
        const found *t = &s->truth[skips][i];
        const bool has_hit = t->primitive != CGT_INVALID_ID;
        if (hit[i].primitive != t->primitive || hit[i].geometry != t->geometry ||
            (has_hit && !same_bits(hit[i].t, t->t)) || memcmp(&hit[i], &s->first[skips][i], sizeof hit[i]) != 0 ||
            occluded[i] != has_hit)
            fail_ray(s, i, t, variant, turn, &hit[i]);
    }
}

/* Single rays have the bits of arrays. */
static void check_singles(const subject *s, const cgt_scene *scene, bool skips, const char *variant, uint32_t turn)
{
    for (uint32_t i = 0; i < RAYS; i++) {
        cgt_single_ray ray = single_ray(&s->ray[i]);
        const cgt_hit skip = {.primitive = s->truth[0][i].primitive, .geometry = s->truth[0][i].geometry};
        cgt_hit one;
        bool occluded;
        ray.skip = skips ? &skip : NULL;
        if (ray.t_max == 0)
            continue;
        assert_int_equal(cgt_trace_ray(scene, &ray, &one, NULL), CGT_OK);
        const full_hit hit = full_hit_of(&one);
        assert_int_equal(cgt_occluded_ray(scene, &ray, &occluded, NULL), CGT_OK);
        if (memcmp(&hit, &s->first[skips][i], sizeof hit) != 0 || occluded != (hit.primitive != CGT_INVALID_ID))
            fail_ray(s, i, &s->truth[skips][i], variant, turn, &hit);
    }
}

/* The scene of a turn; NULL: out of memory. */
static cgt_scene *commit_in_turn(cgt_context *context, const hard_scene *s, uint32_t turn)
{
    const bool beside = turn == TEST_STRUCTURES;
    const cgt_scene_options options = beside ? (cgt_scene_options){0} : structure_in_turn(turn);
    cgt_scene *scene;
    if (hard_commit_with(context, s, &options, &scene) != CGT_OK)
        fail_msg("%s", context_message(context));
    if (beside)
        assert_int_equal(cgt_scene_prepare(scene, CGT_RAY_KIND_INCOHERENT), CGT_OK);
    return scene;
}

static void check_structure(subject *s, cgt_context *context, const char *variant, uint32_t turn)
{
    cgt_scene *scene = commit_in_turn(context, &s->scene, turn);
    for (int skips = 0; skips < 2; skips++) {
        check_hits(s, scene, skips, variant, turn);
        check_singles(s, scene, skips, variant, turn);
    }
    s->traced = true;
    cgt_scene_release(scene);
}

/* Makes rays and their truth; some ranges begin or end at the hit, or the float next to it. */
static void make_rays(subject *s, cgt_context *context, uint32_t round)
{
    test_random r = random_make(1000 + round);
    cgt_scene *scene = commit_in_turn(context, &s->scene, 0);
    const cgt_primitives *prims = &scene->committed_scene.prims;
    const found none = {INFINITY, CGT_INVALID_ID, CGT_INVALID_ID};
    for (uint32_t i = 0; i < RAYS; i++) {
        truth_ray *ray = &s->ray[i];
        *ray = make_ray(&r, &s->scene, (ray_family)(i % RAY_FAMILIES));
        found *truth = &s->truth[0][i];
        *truth = find_truth(prims, ray, &none);
        s->hits += truth->primitive != CGT_INVALID_ID;
        if (truth->primitive != CGT_INVALID_ID && random_below(&r, 3) == 0) {
            const float t = truth->t, end[3] = {t, nextafterf(t, INFINITY), nextafterf(t, -INFINITY)};
            *(random_below(&r, 2) ? &ray->t_max : &ray->t_min) = end[random_below(&r, 3)];
            *truth = ray->t_min <= ray->t_max ? find_truth(prims, ray, &none) : none;
        }
        s->truth[1][i] = ray->t_min <= ray->t_max ? find_truth(prims, ray, truth) : none;
    }
    cgt_scene_release(scene);
}

TEST(hits_are_exact)
{
    const uint32_t rounds = SCENE_KINDS * (1 + test_scaled(4));
    for (uint32_t round = 0; round < rounds; round++) {
        subject *s = calloc(1, sizeof *s);
        const scene_kind kind = (scene_kind)(round % SCENE_KINDS);
        assert_non_null(s);
        if (clusters_always() && kind != SCENE_TRIANGLES && kind != SCENE_FLAT) {
            free(s);
            continue;
        }
        s->scene = make_scene(kind, round);
        FOR_EACH_VARIANT(variant)
        {
            cgt_context *context = context_make(1, variant);
            if (!s->traced)
                make_rays(s, context, round);
            for (uint32_t turn = 0; turn < STRUCTURES; turn++)
                check_structure(s, context, variant, turn);
            cgt_context_release(context);
        }
        print_message("round %u: %s, %u of %u rays hit\n", round, scene_name[kind], s->hits, RAYS);
        assert_true(s->hits > RAYS / 8);
        hard_scene_free(&s->scene);
        free(s);
    }
}

/* ---- work ---- */

#define CLOUD 20000u
#define WORK_RAYS 256u

/* Work for each ray. places: nodes and cells. */
typedef struct work {
    double tests, places, doubles, exact, hits;
} work;

static const char *const call_name[] = {"array", "occluded", "single", "single occluded"};
#define CALLS TEST_COUNT(call_name)

static cgt_result trace_by(const cgt_scene *scene, uint32_t call, const truth_ray *ray, uint32_t count,
                           const cgt_trace_options *options)
{
    static full_hit hit[WORK_RAYS];
    static uint8_t occluded[WORK_RAYS];
    const cgt_rays rays = ray_array(ray, count);
    const cgt_single_ray one = single_ray(ray);
    cgt_hit single;
    bool is_occluded;
    switch (call) {
    case 0: return trace_array(scene, ray, count, hit, options);
    case 1: return cgt_occluded_rays(scene, &rays, occluded, options);
    case 2: return cgt_trace_ray(scene, &one, &single, options);
    default: return cgt_occluded_ray(scene, &one, &is_occluded, options);
    }
}

static work measure(const cgt_scene *scene, uint32_t call, const truth_ray *ray)
{
    const uint32_t step = call < 2 ? WORK_RAYS : 1;
    cgt_trace_statistics traced;
    cgt_research_trace_statistics research;
    const cgt_research_trace_options research_options = {.statistics = &research};
    const cgt_trace_options options = {.statistics = &traced, .research = &research_options};
    work w = {0};
    for (uint32_t i = 0; i < WORK_RAYS; i += step) {
        assert_int_equal(trace_by(scene, call, ray + i, step, &options), CGT_OK);
        w.tests += (double)traced.ray_tests / WORK_RAYS;
        w.places += (double)(research.nodes + research.leaves + research.cells) / WORK_RAYS;
        w.doubles += (double)traced.double_tests / WORK_RAYS;
        w.exact += (double)traced.exact_tests / WORK_RAYS;
        w.hits += (double)traced.hits / WORK_RAYS;
    }
    return w;
}

/* Each call decides at most so many in double and in whole numbers, takes about as many tests and places as with
 * ordinary rays, and has at least so many hits. usual: NULL: of any number. */
static void check_work(const char *what, uint32_t turn, const cgt_scene *scene, const truth_ray *ray,
                       const work usual[CALLS], double decisions, double exact, double hits)
{
    for (uint32_t call = 0; call < CALLS; call++) {
        const work w = measure(scene, call, ray);
        print_message("structure %u, %s, %s: %.1f tests, %.1f places, %.2f in double, %.2f exact, %.2f hits a ray\n",
                      turn, what, call_name[call], w.tests, w.places, w.doubles, w.exact, w.hits);
        assert_true(w.doubles <= decisions && w.exact <= exact && w.hits >= hits);
        if (usual)
            assert_true(w.tests <= 4 * usual[call].tests + 100 && w.places <= 4 * usual[call].places + 100);
    }
}

/* Rays along axes through a cloud of size 2 about the origin, from `far` away, with directions of a length. */
static void make_work_rays(test_random *r, truth_ray *ray, float far, float length, bool back)
{
    for (uint32_t i = 0; i < WORK_RAYS; i++) {
        ray[i] = (truth_ray){.t_max = INFINITY};
        for (uint32_t a = 0; a < 3; a++) {
            ray[i].org[a] = a == i % 3 ? -far : random_float(r, -0.9f, 0.9f);
            ray[i].dir[a] = a == i % 3  ? (back ? -length : length)
                            : far < 100 ? length * random_float(r, -0.2f, 0.2f)
                                        : 0;
        }
    }
}

TEST(unusual_rays_test_few)
{
    static truth_ray ray[WORK_RAYS];
    if (clusters_always())
        skip();
    cgt_context *context = context_make(1, NULL);
    test_random r = random_make(7);
    hard_scene s = {.place = HARD_HERE, .random = r};
    for (uint32_t i = 0; i < CLOUD; i++) {
        double center[3];
        hard_point(&s, -1, 1, center);
        hard_sphere(&s, center, 0.02);
    }
    assert_false(s.failed);
    for (uint32_t turn = 0; turn < STRUCTURES; turn++) {
        cgt_scene *scene = commit_in_turn(context, &s, turn);
        work usual[CALLS];
        make_work_rays(&r, ray, 3, 1, false);
        check_work("ordinary", turn, scene, ray, NULL, 0.1, 0.1, 0.5);
        for (uint32_t call = 0; call < CALLS; call++)
            usual[call] = measure(scene, call, ray);
        for (int exponent = -148; exponent <= 126; exponent += 137) {
            make_work_rays(&r, ray, 3, ldexpf(1, exponent), false);
            check_work("odd lengths", turn, scene, ray, usual, 0.1, 0.1, exponent == -11 ? 0.5 : 0);
        }
        for (int exponent = 10; exponent <= 126; exponent += 29) {
            make_work_rays(&r, ray, ldexpf(1, exponent), 1, false);
            check_work("from afar", turn, scene, ray, usual, 3, 3, 0.5);
            make_work_rays(&r, ray, ldexpf(1, exponent), 1, true);
            check_work("turned away", turn, scene, ray, usual, 0.1, 0.1, 0);
        }
        cgt_scene_release(scene);
    }
    hard_scene_free(&s);
    cgt_context_release(context);
}

/* Each ray starts in hundreds of spheres: their second roots are certain. */
TEST(rays_inside_spheres_are_certain)
{
    static truth_ray ray[WORK_RAYS];
    if (clusters_always())
        skip();
    cgt_context *context = context_make(1, NULL);
    hard_scene s = {.place = HARD_HERE, .random = random_make(8)};
    add_overlapping(&s, 2000);
    assert_false(s.failed);
    for (uint32_t i = 0; i < WORK_RAYS; i++) {
        ray[i] = (truth_ray){.t_max = i % 2 ? INFINITY : 10};
        random_direction(&s.random, ray[i].dir);
        for (int a = 0; a < 3; a++)
            ray[i].org[a] = random_float(&s.random, -0.5f, 0.5f);
    }
    for (uint32_t turn = 0; turn < STRUCTURES; turn++) {
        cgt_scene *scene = commit_in_turn(context, &s, turn);
        check_work("inside spheres", turn, scene, ray, NULL, 4, 0.1, 1);
        cgt_scene_release(scene);
    }
    hard_scene_free(&s);
    cgt_context_release(context);
}

SEEDED_SUITE("test_unusual_rays", NULL, NULL)
