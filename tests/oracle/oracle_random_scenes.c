/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Random scenes of triangles and spheres against the exact oracle. In a grid of one cell every ray tests every
 * primitive, so an error there is the kernel's. A difference between it and another grid, kd-tree, packet, tile, loop
 * or cull setting is an error of the structure or the traversal. */
#include "support/test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "primitive/edge_point.h"
#include "structures/scenes/picture.h"
#include "structures/scenes/random_soup.h"
#include "hard_cases/hard_run.h"

#define WIDTH test_between(31, 61) /* size of frames; smaller where it is slow, and never a multiple of the tile size */
#define HEIGHT test_between(21, 43)
#define PIXELS (WIDTH * HEIGHT)
#define ROUNDS 8u
#define RAYS 1500u

/* Every structure, by its defaults and in grids of given resolutions. */
static unsigned tested(void) { return WAY_CELLS | (clusters_always() ? WAY_CLUSTERS : 0); }

/* ---- the kernel ---- */

typedef struct subject {
    soup_kind kind;
    hard_scene scene;
    hard_truth truth;
    const char *variant;
    bool is_outer; /* the narrowest and the widest variant run all; the others a sample */
} subject;

static void set_variant(subject *s, const char *variant)
{
    s->variant = variant;
    s->is_outer = variant_is_outer(variant);
}

static cgt_scene *commit(const subject *s, cgt_context *context, const test_scene_options *options)
{
    cgt_scene *scene;
    if (hard_commit_with(context, &s->scene, SCENE_OPTIONS(options), &scene) != CGT_OK)
        fail_msg("%s, %s: %s", soup_name(s->kind), s->variant, context_message(context));
    return scene;
}

static void judge_kernel(const subject *s, const full_hit *answers)
{
    for (uint32_t i = 0; i < s->scene.rays; i++) {
        oracle_hit exact;
        const oracle_verdict verdict = hard_judge(&s->scene, &s->truth, i, &answers[i], &exact);
        static const char *const name[] = {"right", "missed", "invented", "wrong"};
        if (verdict != ORACLE_RIGHT)
            fail_msg("the kernel: %s, %s: ray %u: %s: geometry %d, primitive %d, t %a; exactly %a", s->variant,
                     soup_name(s->kind), i, name[verdict], (int)answers[i].geometry, (int)answers[i].primitive,
                     (double)answers[i].t, (double)exact.t);
        if (exact.index != ORACLE_NONE && answers[i].geometry != CGT_INVALID_ID &&
            oracle_ulp(exact.t, answers[i].t) > 0.51)
            fail_msg("the kernel: %s, %s: ray %u: t is %g ulp off", s->variant, soup_name(s->kind), i,
                     oracle_ulp(exact.t, answers[i].t));
    }
}

/* ---- the structure ---- */

static void check_same(const subject *s, const full_hit *expected, const full_hit *got, const test_scene_options *so,
                       const test_trace_options *o)
{
    for (uint32_t i = 0; i < s->scene.rays; i++)
        if (memcmp(&expected[i], &got[i], sizeof *got) != 0)
            fail_msg("the structure: %s, %s, structure %d, grid %ux%ux%u, packet %u, tile %d, loop %d, cull %d, "
                     "traversal %d, mailbox %d, precision %d: ray %u: geometry %d, primitive %d, t %a; in one cell: "
                     "%d, %d, %a",
                     s->variant, soup_name(s->kind), (int)so->structure, so->resolution[0], so->resolution[1],
                     so->resolution[2], o->packet, (int)o->tile, (int)o->loop, (int)o->cull, (int)o->kd_traversal,
                     o->mailbox, (int)o->precision, i, (int)got[i].geometry, (int)got[i].primitive, (double)got[i].t,
                     (int)expected[i].geometry, (int)expected[i].primitive, (double)expected[i].t);
}

/* All ways to trace a frame: packets of 4, 8 and 16 in squares, of 4 in strips; loops; culls. */
#define WAYS (4u * 2 * 3)

/* Whether to take all of them, and not an evenly distributed sample. In one cell only the packets' shapes matter, in
 * other grids of given resolutions as little as test_structures varies them; tiles and the BVH know no such options. */
static bool takes_all_ways(const subject *s, const test_way *w)
{
    return s->is_outer && w->papers && w->serves & WAY_EACH;
}

static test_trace_options way(uint32_t number)
{
    const uint32_t shape = number / 6, loop = number / 3 % 2, cull = number % 3;
    test_trace_options o = {0};
    o.packet = shape == 3 ? 4 : 4u << shape;
    o.tile = shape == 3 ? CGT_TILE_SHAPE_STRIP : CGT_TILE_SHAPE_SQUARE;
    o.loop = loop ? CGT_LOOP_FLATTENED : CGT_LOOP_NESTED;
    o.cull = cull == 0 ? CGT_CULL_NONE : cull == 1 ? CGT_CULL_FRUSTUM : CGT_CULL_BLOCKS;
    o.mailbox = mailbox_of(cull % 2 == loop);
    o.kd_traversal = (cgt_kd_traversal)((loop + cull) % 3);
    return o;
}

static void sweep(const subject *s, const cgt_scene *scene, const cgt_camera *camera, const test_way *w,
                  const full_hit *expected, picture *q)
{
    const test_scene_options *so = &w->scene;
    const bool all = test_scaled(WAYS) >= WAYS && takes_all_ways(s, w);
    const uint32_t step = all ? 1 : test_samples() ? 11 : 5; /* coprime to WAYS */
    const uint32_t start = test_sample_start(5 * (uint32_t)s->kind + so->resolution[0] + (uint32_t)so->structure, step);
    for (uint32_t number = start; number < WAYS; number += step) {
        const test_trace_options o = way(number);
        picture_trace(scene, camera, TRACE_OPTIONS(&o), q);
        check_same(s, expected, q->hit, so, &o);
    }
}

/* One scene, one camera, one variant. answers: hits of the one-cell grid, for comparison between variants. */
static void check_frame(const subject *s, const cgt_camera *camera, bool all_options, full_hit *answers)
{
    picture q = picture_make(WIDTH, HEIGHT);
    cgt_context *context = context_make(2, s->variant);
    cgt_scene *scene = commit(s, context, &one_cell.scene);
    picture_trace(scene, camera, NULL, &q);
    judge_kernel(s, q.hit);
    memcpy(answers, q.hit, PIXELS * sizeof *answers);
    if (all_options && !clusters_always())
        sweep(s, scene, camera, &one_cell, answers, &q);
    cgt_scene_release(scene);

    FOR_EACH_WAY(w, tested())
    {
        scene = commit(s, context, &w->scene);
        if (all_options)
            sweep(s, scene, camera, w, answers, &q);
        picture_trace(scene, camera, NULL, &q);
        check_same(s, answers, q.hit, &w->scene, &(test_trace_options){0});
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
    picture_free(&q);
}

/* ---- frames ---- */

/* Cameras: inside, orthographic, wide, and random, one of each per four rounds. */
static cgt_camera camera_of_round(hard_scene *s, uint32_t round)
{
    cgt_camera camera = soup_camera(s);
    if (round % 4 == 1)
        for (int a = 0; a < 3; a++)
            camera.eye[a] = (float)hard_real(s, -0.3, 0.3);
    if (round % 2) {
        camera.projection = CGT_PROJECTION_PERSPECTIVE;
        camera.fov = random_float(&s->random, 40, 120);
    }
    if (round % 4 == 2) {
        camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
        camera.height = random_float(&s->random, 0.5f, 3);
    }
    return camera;
}

static void test_frames(void **state)
{
    const soup_kind kind = *(const soup_kind *)*state;
    if (clusters_always() && kind == SOUP_MIXED)
        skip();
    full_hit *first = malloc(PIXELS * sizeof *first), *other = malloc(PIXELS * sizeof *other);
    uint32_t hits = 0, rays = 0;
    const uint32_t rounds = test_scaled(ROUNDS);
    assert_true(first && other);
    for (uint32_t round = 1; round <= rounds; round++) {
        subject s = {.kind = kind, .scene = soup_make(kind, 100 * kind + round, round % 2 ? 150 : 700)};
        const cgt_camera camera = camera_of_round(&s.scene, round);
        uint32_t number = 0;
        picture_aim(&s.scene, &camera, WIDTH, HEIGHT);
        assert_true(hard_truth_make(&s.scene, &s.truth));
        FOR_EACH_VARIANT(variant)
        {
            set_variant(&s, variant);
            check_frame(&s, &camera, (round + number) % 4 == 1, number ? other : first);
            if (number++)
                assert_memory_equal(first, other, PIXELS * sizeof *first);
        }
        for (uint32_t i = 0; i < PIXELS; i++)
            hits += s.truth.hit[i].index != ORACLE_NONE;
        rays += PIXELS;
        hard_truth_free(&s.truth);
        hard_scene_free(&s.scene);
    }
    print_message("%u of %u rays hit\n", (unsigned)hits, (unsigned)rays);
    assert_true(hits > rays / 400);
    free(first);
    free(other);
}

/* ---- arrays of rays ---- */

static void check_rays(const subject *s, full_hit *expected, full_hit *got, uint8_t *occluded)
{
    const uint32_t rays = s->scene.rays;
    test_trace_options options = {0};
    cgt_context *context = context_make(1, s->variant);
    cgt_scene *scene = commit(s, context, &one_cell.scene);
    assert_int_equal(trace_array(scene, s->scene.ray, rays, expected, NULL), CGT_OK);
    judge_kernel(s, expected);
    cgt_scene_release(scene);
    uint32_t number = 0;
    FOR_EACH_WAY(w, tested())
    {
        const cgt_rays arrays = ray_array(s->scene.ray, rays);
        scene = commit(s, context, &w->scene);
        const uint32_t step = test_samples() || !takes_all_ways(s, w) ? 4 : 1; /* a sample of culls and loops */
        for (uint32_t k = test_sample_start((uint32_t)s->kind + number++, step); k < 3 * 2; k += step) {
            options.cull = (cgt_cull)(CGT_CULL_NONE + k / 2);
            options.loop = (cgt_loop)(CGT_LOOP_NESTED + k % 2);
            options.kd_traversal = (cgt_kd_traversal)options.loop; /* single, packet */
            memset(got, 0x77, rays * sizeof *got);
            assert_int_equal(trace_array(scene, s->scene.ray, rays, got, TRACE_OPTIONS(&options)), CGT_OK);
            check_same(s, expected, got, &w->scene, &options);
        }
        assert_int_equal(cgt_occluded_rays(scene, &arrays, occluded, NULL), CGT_OK);
        for (uint32_t i = 0; i < rays; i++)
            assert_int_equal(occluded[i], expected[i].geometry != CGT_INVALID_ID);
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

/* Rays from anywhere; half of them at an edge or a vertex, where single precision cannot decide. */
static void make_rays(hard_scene *s)
{
    const cloud where = {.middle = {0, 0, 0}, .reach = 1};
    while (hard_wants_ray(s)) {
        truth_ray ray = ray_random(&s->random, &where);
        float target[3];
        if (random_below(&s->random, 2) && edge_point(s, target)) {
            for (int a = 0; a < 3; a++)
                ray.dir[a] = target[a] - ray.org[a];
            ray.t_min = 0;
            ray.t_max = INFINITY;
        }
        hard_raw_ray(s, &ray);
    }
}

static void test_rays(void **state)
{
    const soup_kind kind = *(const soup_kind *)*state;
    if (clusters_always() && kind == SOUP_MIXED)
        skip();
    const uint32_t rays = test_between(150, RAYS);
    full_hit *expected = calloc(rays, sizeof *expected), *got = calloc(rays, sizeof *got);
    uint8_t *occluded = malloc(rays);
    uint32_t hits = 0;
    assert_true(expected && got && occluded);
    subject s = {.kind = kind, .scene = soup_make(kind, 1000 + kind, 800)};
    s.scene.wanted = rays;
    make_rays(&s.scene);
    assert_int_equal(s.scene.rays, rays);
    assert_true(hard_truth_make(&s.scene, &s.truth));
    FOR_EACH_VARIANT(variant)
    {
        set_variant(&s, variant);
        check_rays(&s, expected, got, occluded);
    }
    for (uint32_t i = 0; i < rays; i++)
        hits += expected[i].geometry != CGT_INVALID_ID;
    assert_true(hits > rays / 100 && hits < rays);
    hard_truth_free(&s.truth);
    hard_scene_free(&s.scene);
    free(expected);
    free(got);
    free(occluded);
}

int main(void)
{
    static struct CMUnitTest tests[2 * SOUP_KINDS];
    static soup_kind kinds[SOUP_KINDS];
    static char name[2 * SOUP_KINDS][64];
    test_begin("oracle_random_scenes");
    for (size_t i = 0; i < TEST_COUNT(tests); i++) {
        kinds[i / 2] = (soup_kind)(i / 2);
        snprintf(name[i], sizeof name[i], "%s: %s", soup_name(kinds[i / 2]), i % 2 ? "rays" : "frames");
        tests[i] = (struct CMUnitTest){
            .name = name[i], .test_func = i % 2 ? test_rays : test_frames, .initial_state = &kinds[i / 2]};
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
