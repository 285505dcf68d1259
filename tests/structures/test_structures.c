/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Every structure finds the same hits, bit for bit: grids, BVH, kd-tree and kd-tree with ropes, by each builder, in
 * each layout, traversed by single rays and by packets, with one thread, with three, and with a task runner that
 * runs backwards. A grid of one cell, in which every ray tests every primitive, is the reference; points against lights
 * are compared with the rays to them that cgt.h specifies. */
#include "structures/scenes/structure_scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "structures/scenes/picture.h"
#include "hard_cases/hard_run.h"

/* ---- contexts: every variant that this machine runs, with each kind of threads ---- */

#define MOST_CONTEXTS 24u

static cgt_context *contexts[MOST_CONTEXTS];
static uint32_t context_count;

static int make_contexts(void **state)
{
    (void)state;
    FOR_EACH_VARIANT(variant)
    for (uint32_t kind = 0; kind < 3 && context_count < MOST_CONTEXTS; kind++) {
        cgt_context_options o;
        cgt_context_options_init(&o);
        o.variant = variant;
        o.threads = kind == 1 ? 3 : 1;
        o.tasks.run = kind == 2 ? run_backwards : NULL;
        if (cgt_context_create(&o, &contexts[context_count++]) != CGT_OK)
            return -1;
    }
    return 0;
}

static int free_contexts(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < context_count; i++)
        cgt_context_release(contexts[i]);
    return 0;
}

/* ---- ways to the same hits ---- */

typedef struct way_counts {
    cgt_trace_statistics trace;
    cgt_research_trace_statistics research;
} way_counts;

static test_trace_options trace_way(uint32_t number, way_counts *counts)
{
    test_trace_options o = {0};
    o.kd_traversal = (cgt_kd_traversal)((number + number / 3) % 3);
    o.mailbox = mailbox_of(number / 2 % 2);
    o.packet = (uint32_t[]){0, 4, 8, 16}[number / 3 % 4];
    o.tile = o.packet == 4 ? CGT_TILE_SHAPE_STRIP : CGT_TILE_SHAPE_AUTO;
    o.loop = (cgt_loop)(number / 5 % 3);
    o.cull = (cgt_cull)(number % 4);
    o.statistics = &counts->trace;
    o.research_statistics = &counts->research;
    return o;
}

/* ---- scene, cameras, rays, and the reference hits of one cell ---- */

#define MOST_RAYS 640u
#define RAYS test_between(320, MOST_RAYS)
#define PRECISIONS ((uint32_t)CGT_PRECISION_FAST + 1)
#define FRAMES 2 /* perspective, orthographic */
static const uint32_t sizes[FRAMES][2] = {{37, 21}, {19, 43}};

typedef struct reference_hits {
    full_hit *frame[FRAMES], *ray;
} reference_hits;

/* Points where rays hit the scene, or begin, and a light of each kind; with ranges or without. */
typedef struct lit_points {
    float point[MOST_RAYS][5]; /* x, y, z, t_min, t_max */
    cgt_light light[2];
    uint8_t occluded[2][2][MOST_RAYS]; /* by light, without and with ranges: of the rays to the light */
    uint64_t invalid[2][2];
} lit_points;

typedef struct query {
    structure_scene s;
    cgt_camera camera[FRAMES];
    reference_hits reference[PRECISIONS];
    picture picture[FRAMES];
    lit_points *lit;
    uint64_t hits, fast, fast_rays; /* fast: hits of tests in single precision that differ */
} query;

static void fail_way(const query *q, const test_scene_options *so, const test_trace_options *to, const char *what,
                     uint32_t i, const full_hit *got, const full_hit *reference)
{
    fail_msg("%s: structure %d, layout %d, break level %u, traversal %d, mailbox %d, packet %u, loop %d, "
             "cull %d, precision "
             "%d: %s %u: geometry %d, primitive %d, t %a; in one cell %d, %d, %a",
             q->s.name, (int)so->structure, (int)so->kd_layout, so->kd_break_level, (int)to->kd_traversal, to->mailbox,
             to->packet, (int)to->loop, (int)to->cull, (int)to->precision, what, i, (int)got->geometry,
             (int)got->primitive, (double)got->t, (int)reference->geometry, (int)reference->primitive,
             (double)reference->t);
}

static cgt_scene *commit(const query *q, cgt_context *context, const test_scene_options *options)
{
    cgt_scene *scene;
    if (hard_commit_with(context, &q->s.scene, SCENE_OPTIONS(options), &scene) != CGT_OK)
        fail_msg("%s: %s", q->s.name, context_message(context));
    return scene;
}

static full_hit *copy_of(const full_hit *hits, size_t count)
{
    full_hit *copy = malloc((count + 1) * sizeof *copy);
    assert_non_null(copy);
    memcpy(copy, hits, count * sizeof *copy);
    return copy;
}

static void place_points(query *q, lit_points *lit, uint32_t number)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY, 0x1p60f, -0x1p100f, 0x1p-140f};
    test_random *r = &q->s.scene.random;
    for (int kind = 0; kind < 2; kind++) {
        const bool at = kind == CGT_LIGHT_POINT;
        const float far = (float[]){0.5f, 2, 30, 1e4f}[number % 4] * q->s.where.reach;
        lit->light[kind].kind = (cgt_light_kind)kind;
        for (int a = 0; a < 3; a++) /* sometimes along an axis, or above the scene */
            lit->light[kind].position[a] =
                (at ? q->s.where.middle[a] : 0) + (number % 3 == 0 && a ? 0 : random_float(r, 0.1f, 1) * far);
    }
    for (uint32_t i = 0; i < RAYS; i++) {
        float *p = lit->point[i];
        const truth_ray *ray = &q->s.scene.ray[i];
        const full_hit *hit = &q->reference[0].ray[i];
        const bool near = i % 64 && random_below(r, 2); /* beside the point before */
        for (int a = 0; a < 3; a++)
            p[a] = near ? lit->point[i - 1][a] + random_float(r, -1e-3f, 1e-3f) * q->s.where.reach
                        : ray->org[a] + (hit->geometry == CGT_INVALID_ID ? 0 : hit->t * ray->dir[a]);
        p[3] = (float[]){0, 1e-4f, -0.5f, 0.25f}[random_below(r, 4)];
        p[4] = (float[]){1, 1, 0.9f, 3, -1, INFINITY}[random_below(r, 6)];
    }
    for (uint32_t k = 0; number % 2 && k < RAYS / 100; k++)
        lit->point[random_below(r, RAYS)][random_below(r, 5)] = bad[random_below(r, TEST_COUNT(bad))];
    memcpy(lit->point[random_below(r, RAYS)], lit->light[CGT_LIGHT_POINT].position, sizeof(float[3]));
}

/* The rays to a light exactly as cgt.h specifies them. */
static void trace_rays_to_light(const cgt_scene *scene, lit_points *lit, int kind, bool ranges)
{
    static truth_ray ray[MOST_RAYS];
    const bool at = kind == CGT_LIGHT_POINT;
    cgt_trace_statistics statistics;
    for (uint32_t i = 0; i < RAYS; i++) {
        const float *p = lit->point[i];
        ray[i].t_min = ranges ? p[3] : 0;
        ray[i].t_max = ranges ? p[4] : at ? 1 : INFINITY;
        for (int a = 0; a < 3; a++) {
            ray[i].org[a] = p[a];
            ray[i].dir[a] = lit->light[kind].position[a] - (at ? p[a] : 0);
        }
    }
    const cgt_rays rays = ray_array(ray, RAYS);
    const cgt_trace_options options = {.statistics = &statistics};
    assert_int_equal(cgt_occluded_rays(scene, &rays, lit->occluded[kind][ranges], &options), CGT_OK);
    lit->invalid[kind][ranges] = statistics.invalid_rays;
}

/* Traces the scene as one cell. */
static query query_make(structure_kind kind, uint64_t stream)
{
    query q = {.s = structure_scene_make(kind, stream)};
    full_hit hit[MOST_RAYS];
    structure_rays(&q.s, RAYS);
    cgt_scene *scene = commit(&q, contexts[0], &one_cell.scene);
    for (int f = 0; f < FRAMES; f++) {
        q.camera[f] = camera_random(&q.s.scene.random, &q.s.where);
        q.camera[f].projection = f ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
        q.camera[f].height = 2 * q.s.where.reach;
        q.picture[f] = picture_make(sizes[f][0], sizes[f][1]);
    }
    for (uint32_t k = 0; k < PRECISIONS; k++) {
        test_trace_options o = {.precision = (cgt_precision)k};
        for (int f = 0; f < FRAMES; f++) {
            picture_trace(scene, &q.camera[f], TRACE_OPTIONS(&o), &q.picture[f]);
            q.reference[k].frame[f] = copy_of(q.picture[f].hit, q.picture[f].p.elements);
        }
        assert_int_equal(trace_array(scene, q.s.scene.ray, RAYS, hit, TRACE_OPTIONS(&o)), CGT_OK);
        q.reference[k].ray = copy_of(hit, RAYS);
    }
    for (uint32_t i = 0; i < RAYS; i++)
        q.hits += q.reference[0].ray[i].geometry != CGT_INVALID_ID;
    assert_non_null(q.lit = malloc(sizeof *q.lit));
    place_points(&q, q.lit, (uint32_t)stream + kind);
    for (int k = 0; k < 4; k++)
        trace_rays_to_light(scene, q.lit, k / 2, k % 2);
    cgt_scene_release(scene);
    return q;
}

static void query_free(query *q)
{
    for (int f = 0; f < FRAMES; f++) {
        picture_free(&q->picture[f]);
        for (uint32_t k = 0; k < PRECISIONS; k++)
            free(q->reference[k].frame[f]);
    }
    for (uint32_t k = 0; k < PRECISIONS; k++)
        free(q->reference[k].ray);
    free(q->lit);
    structure_scene_free(&q->s);
}

/* ---- statistics ---- */

static cgt_structure chosen(const cgt_scene *scene)
{
    cgt_scene_statistics st;
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    return st.structure;
}

static bool is_tree(const test_scene_options *o)
{
    return o->structure == CGT_STRUCTURE_KD || o->structure == CGT_STRUCTURE_KD_ROPES;
}

/* Returns whether a structure was built: there is none for an empty scene, or if coordinates are too large. */
static bool check_commit(const query *q, const cgt_scene *scene, const test_scene_options *o)
{
    const cgt_research_scene_statistics research = research_of(scene);
    cgt_scene_statistics st;
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    const bool tree = is_tree(o);
    assert_int_equal(st.structure, o->structure);
    assert_true(q->s.skipped == 0 || st.skipped_not_finite + st.skipped_radius + st.skipped_degenerate == q->s.skipped);
    assert_int_equal(st.primitives, hard_scene_primitives(&q->s.scene));
    assert_int_equal(st.geometries, q->s.scene.geometries);
    const bool built = research.cells || research.kd_nodes || research.bvh_nodes || research.bih_nodes,
               wide = o->structure == CGT_STRUCTURE_BVH, intervals = o->structure == CGT_STRUCTURE_BIH;
    const bool has_valid = st.primitives > st.skipped_not_finite + st.skipped_radius + st.skipped_degenerate;
    assert_true(built || !has_valid || strstr(q->s.name, "beyond"));
    assert_int_equal(research.cells != 0, built && !tree && !wide && !intervals);
    assert_int_equal(research.bih_nodes != 0, built && intervals);
    assert_int_equal(research.bvh_nodes != 0, built && wide);
    assert_int_equal(research.kd_leaves != 0, built && tree);
    return built;
}

static void check_counts(const cgt_trace_statistics *c, const cgt_research_trace_statistics *research,
                         const test_scene_options *o, bool built, uint64_t rays, uint64_t hits)
{
    const bool tree = built && (is_tree(o) || o->structure == CGT_STRUCTURE_BVH || o->structure == CGT_STRUCTURE_BIH);
    assert_int_equal(c->rays, rays);
    assert_int_equal(c->hits, hits);
    assert_int_equal(research->rope_loops, 0);
    assert_true(!hits || !tree || research->leaves);
    assert_int_equal(c->bvh_rays != 0, o->structure == CGT_STRUCTURE_BVH && built && rays);
    assert_true(!hits || !built || !is_tree(o) || research->references);
    assert_true(o->structure != CGT_STRUCTURE_KD_ROPES || research->rope_steps <= research->leaves);
    assert_true(tree ? !research->cells && !research->slices : !research->nodes && !research->leaves);
    assert_true(o->structure == CGT_STRUCTURE_KD_ROPES || !research->rope_steps);
    assert_true(c->exact_tests <= c->double_tests && c->double_tests <= c->ray_tests);
}

/* ---- one way ---- */

static void compare(const query *q, const test_scene_options *so, const test_trace_options *to, const char *what,
                    const full_hit *got, const full_hit *reference, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (memcmp(&got[i], &reference[i], sizeof *got) != 0)
            fail_way(q, so, to, what, i, &got[i], &reference[i]);
}

/* The rays as separate arrays with gaps; arrays of ranges are omitted if all values are the defaults. */
static void trace_strided(const cgt_scene *scene, const truth_ray *ray, uint32_t step, full_hit *hit,
                          const test_trace_options *o)
{
    float *in = malloc(8 * (size_t)RAYS * step * sizeof *in), *array[8];
    assert_non_null(in);
    for (uint32_t k = 0; k < 8; k++) {
        array[k] = in + (size_t)k * RAYS * step;
        for (uint32_t i = 0; i < RAYS * step; i++)
            array[k][i] = NAN; /* in the gaps */
        for (uint32_t i = 0; i < RAYS; i++)
            memcpy(&array[k][i * step], (const float *)(const void *)&ray[i] + k, sizeof(float));
    }
    const cgt_rays rays = {.count = RAYS,
                           .stride = step * sizeof(float),
                           .org = {array[0], array[1], array[2]},
                           .dir = {array[3], array[4], array[5]},
                           .t_min = array[6],
                           .t_max = array[7]};
    const cgt_hits hits = hit_array(hit);
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, TRACE_OPTIONS(o)), CGT_OK);
    free(in);
}

static void check_any_hit(const query *q, const cgt_scene *scene, const test_scene_options *so,
                          const test_trace_options *to)
{
    uint8_t occluded[MOST_RAYS];
    const cgt_rays rays = ray_array(q->s.scene.ray, RAYS);
    memset(occluded, 0x77, sizeof occluded);
    assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, TRACE_OPTIONS(to)), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++)
        if (occluded[i] != (q->reference[0].ray[i].geometry != CGT_INVALID_ID))
            fail_way(q, so, to, "any hit of ray", i, &q->reference[0].ray[i], &q->reference[0].ray[i]);
}

/* Points against lights give what rays to them give. */
static void check_lights(const query *q, const cgt_scene *scene, const test_scene_options *so,
                         const test_trace_options *to, uint32_t turn)
{
    const lit_points *lit = q->lit;
    for (uint32_t kind = 0; kind < 2; kind++) {
        uint8_t occluded[MOST_RAYS + 1];
        const bool ranges = (turn + kind) % 2;
        const uint32_t count = turn % 7 ? RAYS : 1 + turn % 70;
        const float *p = lit->point[0];
        const cgt_points points = {.count = count,
                                   .stride = sizeof lit->point[0],
                                   .position = {p, p + 1, p + 2},
                                   .t_min = ranges ? p + 3 : NULL,
                                   .t_max = ranges ? p + 4 : NULL};
        uint64_t hits = 0;
        memset(occluded, 0x77, sizeof occluded);
        assert_int_equal(cgt_occluded_points(scene, &lit->light[kind], &points, occluded, TRACE_OPTIONS(to)), CGT_OK);
        for (uint32_t i = 0; i < count; i++) {
            hits += occluded[i];
            if (occluded[i] != lit->occluded[kind][ranges][i])
                fail_way(q, so, to, kind == CGT_LIGHT_POINT ? "point at a point light" : "point at a directional light",
                         i, &q->reference[0].ray[i], &q->reference[0].ray[i]);
        }
        assert_int_equal(occluded[count], 0x77);
        assert_int_equal(to->statistics->rays, count);
        assert_int_equal(to->statistics->hits, hits);
        assert_true(count < RAYS || to->statistics->invalid_rays == lit->invalid[kind][ranges]);
    }
}

/* Counts the hits of tests in single precision that differ, which are to be rare. */
static void count_fast(query *q, const cgt_scene *scene, test_trace_options o)
{
    full_hit hit[MOST_RAYS];
    o.precision = CGT_PRECISION_FAST;
    o.triangle_test = CGT_TRIANGLE_TEST_WATERTIGHT;
    assert_int_equal(trace_array(scene, q->s.scene.ray, RAYS, hit, TRACE_OPTIONS(&o)), CGT_OK);
    assert_int_equal(o.research_statistics->rope_loops, 0);
    q->fast_rays += RAYS;
    for (uint32_t i = 0; i < RAYS; i++)
        q->fast +=
            hit[i].primitive != q->reference[0].ray[i].primitive || hit[i].geometry != q->reference[0].ray[i].geometry;
}

/* turn: distributes options and precisions, so that each way meets others in other scenes */
static void check_way(query *q, cgt_context *context, const test_way *w, uint32_t number, uint32_t turn)
{
    test_scene_options so = w->scene;
    way_counts counts;
    full_hit hit[MOST_RAYS];
    cgt_scene *scene = commit(q, context, &so);
    so.structure = w->serves & WAY_CHOSEN ? chosen(scene) : so.structure;
    const bool built = check_commit(q, scene, &so), counted = so.structure == w->scene.structure; /* AUTO: either */
    for (uint32_t traversal = 0; traversal < 2; traversal++) {
        test_trace_options to = trace_way(2 * (number + 7 * turn) + traversal, &counts);
        to.precision = (cgt_precision)((number + turn + traversal) % PRECISIONS);
        const reference_hits *reference = &q->reference[to.precision];
        for (int f = 0; f < FRAMES; f++) {
            picture_trace(scene, &q->camera[f], TRACE_OPTIONS(&to), &q->picture[f]);
            compare(q, &so, &to, f ? "orthographic pixel" : "pixel", q->picture[f].hit, reference->frame[f],
                    sizes[f][0] * sizes[f][1]);
        }
        memset(hit, 0x77, sizeof hit);
        if ((number + traversal) % 3)
            trace_strided(scene, q->s.scene.ray, 1 + number % 3, hit, &to);
        else
            assert_int_equal(trace_array(scene, q->s.scene.ray, RAYS, hit, TRACE_OPTIONS(&to)), CGT_OK);
        compare(q, &so, &to, "ray", hit, reference->ray, RAYS);
        if (counted)
            check_counts(&counts.trace, &counts.research, &so, built, RAYS, q->hits);
        check_any_hit(q, scene, &so, &to);
        if (counted)
            check_counts(&counts.trace, &counts.research, &so, built, RAYS, q->hits);
        count_fast(q, scene, to);
        check_lights(q, scene, &so, &to, turn + number + traversal);
    }
    cgt_scene_release(scene);
}

/* ---- all ways ---- */

static void test_kind(void **state)
{
    const structure_kind kind = *(const structure_kind *)*state;
    const uint32_t scaled = test_scaled(4), rounds = kind == STRUCTURE_LARGE || kind == STRUCTURE_BEYOND ? 1 : scaled;
    /* on slow machines a sample of the ways: the step is coprime to their number */
    const uint32_t step = test_samples() ? 11 : test_scaled(10) < 2 ? 3 : 1, ways = way_count(0);
    for (uint32_t round = 0; round < rounds; round++) {
        query q = query_make(kind, 100 * (uint64_t)kind + round);
        for (uint32_t number = test_sample_start(round + (uint32_t)kind, step); number < ways; number += step)
            check_way(&q, contexts[(number + 7 * round + (uint32_t)kind) % context_count], way_in_turn(0, number),
                      number, round + (uint32_t)kind);
        print_message("%s: %llu of %u rays hit; single precision: %llu of %llu hits differ\n", q.s.name,
                      (unsigned long long)q.hits, RAYS, (unsigned long long)q.fast, (unsigned long long)q.fast_rays);
        if (kind < STRUCTURE_COINCIDENT) {
            assert_true(q.hits > RAYS / 100);
            assert_true(q.fast < q.fast_rays / 50);
        }
        if (kind == STRUCTURE_NONE || kind == STRUCTURE_ALL_SKIPPED)
            assert_int_equal(q.hits, 0);
        query_free(&q);
    }
}

int main(void)
{
    static struct CMUnitTest tests[STRUCTURE_KINDS];
    static structure_kind kinds[STRUCTURE_KINDS];
    static char name[STRUCTURE_KINDS][64];
    test_begin("test_structures");
    for (size_t i = 0; i < TEST_COUNT(tests); i++) {
        kinds[i] = (structure_kind)i;
        snprintf(name[i], sizeof name[i], "%s: %s",
                 i < STRUCTURE_CLOUD        ? "triangles"
                 : i < STRUCTURE_COINCIDENT ? "spheres"
                                            : "scene",
                 structure_name(kinds[i]));
        tests[i] = (struct CMUnitTest){.name = name[i], .test_func = test_kind, .initial_state = &kinds[i]};
    }
    return cmocka_run_group_tests(tests, make_contexts, free_contexts);
}
