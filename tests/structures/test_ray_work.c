/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What unusual rays may cost, through every structure and call: directions of any length, origins from afar, rays that
 * start inside many spheres. They test about as many primitives as others do. What they hit, the profile `unusual` of
 * tests/driver judges; tests/support/cliffs has more troubles, of the structures that AUTO chooses. */
#include <math.h>

#include "hard_cases/hard_run.h"
#include "support/scenes.h"
#include "support/suite.h"

#define STRUCTURES (TEST_STRUCTURES + 1) /* and a loose grid with a BVH beside it */

/* The scene of a turn. */
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

/* Spheres most of which overlap most others. */
static void add_overlapping(hard_scene *s, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        double center[3];
        hard_point(s, -1, 1, center);
        hard_sphere(s, center, hard_real(s, 0.4, 1.2));
    }
}

/* Each ray starts in hundreds of spheres: their second roots are certain. */
TEST(rays_inside_spheres_are_certain)
{
    static truth_ray ray[WORK_RAYS];
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

SEEDED_SUITE("test_ray_work", NULL, NULL)
