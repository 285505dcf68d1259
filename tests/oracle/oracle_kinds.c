/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small random scenes of 22 kinds, each hard in its own way, and rays through their vertices, edges and centres, along
 * tangents, with ranges that end at a hit, directions of any length, masks and skipped primitives. Arrays are judged by
 * exact arithmetic; single rays, points against a light and frames must say the same. */
#include "oracle/hard_rays.h"
#include "oracle/kind_scenes.h"
#include "support/scenes.h"
#include "support/suite.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "query/camera.h"
#include "support/oracle/oracle.h"
#include "support/ray_arrays.h"

#define RAYS 40u
#define SCENES 6u /* of each kind */
#define WIDTH 9u
#define HEIGHT 7u

/* ---- the truth ---- */

typedef struct kind_truth {
    oracle_scene whole;
    oracle_primitive left[3 * KIND_MOST]; /* without what a ray does not see */
} kind_truth;

/* What a ray that skips a primitive and has a mask sees: geometry g has the mask 1 << g. */
static oracle_scene seen_by(kind_truth *t, uint32_t mask, uint32_t geometry, uint32_t primitive)
{
    oracle_scene scene = {.primitive = t->left};
    for (uint32_t i = 0; i < t->whole.count; i++) {
        const oracle_primitive *const p = &t->whole.primitive[i];
        if ((!mask || mask >> p->geometry & 1) && (p->geometry != geometry || p->primitive != primitive))
            t->left[scene.count++] = *p;
    }
    return scene;
}

typedef struct kind_run {
    kind_scene scene;
    kind_truth truth;
    cgt_scene *traced;
    const char *name, *variant;
    cgt_structure structure;
    uint64_t rays, hits; /* judged so far */
} kind_run;

static void judge(kind_run *run, const oracle_scene *scene, const truth_ray *ray, const full_hit *got, const char *what)
{
    const char *const wrong = oracle_check(scene, ray, got->geometry, got->primitive, got->t);
    run->rays++;
    run->hits += got->primitive != CGT_INVALID_ID;
    if (wrong)
        fail_msg("%s, %s, %s, structure %d: %s: %d.%d at %a; org %a %a %a dir %a %a %a range %a %a", run->name, what,
                 run->variant, (int)run->structure, wrong, (int)got->geometry, (int)got->primitive, (double)got->t,
                 (double)ray->org[0], (double)ray->org[1], (double)ray->org[2], (double)ray->dir[0],
                 (double)ray->dir[1], (double)ray->dir[2], (double)ray->t_min, (double)ray->t_max);
}

/* ---- calls ---- */

static void same_alone(const kind_run *run, const truth_ray *ray, const full_hit *expected)
{
    cgt_single_ray one = single_ray(ray);
    cgt_single_hit hit;
    bool occluded;
    if (ray->t_max == 0) /* infinity there */
        return;
    assert_int_equal(cgt_trace_ray(run->traced, &one, &hit, NULL), CGT_OK);
    assert_int_equal(cgt_occluded_ray(run->traced, &one, &occluded, NULL), CGT_OK);
    const full_hit got = {
        hit.t, hit.primitive, hit.geometry, {hit.normal[0], hit.normal[1], hit.normal[2]}, {hit.u, hit.v}};
    if (memcmp(&got, expected, sizeof got) != 0 || occluded != (got.primitive != CGT_INVALID_ID))
        fail_msg("%s, %s, structure %d: alone %d.%d at %a, in an array %d.%d at %a", run->name, run->variant,
                 (int)run->structure, (int)got.geometry, (int)got.primitive, (double)got.t, (int)expected->geometry,
                 (int)expected->primitive, (double)expected->t);
}

/* All rays, then each again in a range that its hit ends. */
static void judge_rays(kind_run *run)
{
    truth_ray ray[2 * RAYS];
    full_hit hit[2 * RAYS];
    uint8_t occluded[2 * RAYS];
    for (uint32_t i = 0; i < RAYS; i++)
        ray[i] = kind_ray(&run->scene);
    assert_int_equal(trace_array(run->traced, ray, RAYS, hit, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++)
        ray[RAYS + i] = hit[i].primitive == CGT_INVALID_ID ? kind_ray(&run->scene)
                                                           : hard_ray_cut(&run->scene.random, ray[i], hit[i].t);
    const cgt_rays rays = ray_array(ray, 2 * RAYS);
    assert_int_equal(trace_array(run->traced, ray, 2 * RAYS, hit, NULL), CGT_OK);
    assert_int_equal(cgt_occluded_rays(run->traced, &rays, occluded, NULL), CGT_OK);
    for (uint32_t i = 0; i < 2 * RAYS; i++) {
        judge(run, &run->truth.whole, &ray[i], &hit[i], "rays");
        assert_int_equal(occluded[i], hit[i].primitive != CGT_INVALID_ID);
        same_alone(run, &ray[i], &hit[i]);
    }
}

static void judge_filtered(kind_run *run)
{
    truth_ray ray[RAYS];
    full_hit hit[RAYS];
    uint32_t mask[RAYS], primitive[RAYS], geometry[RAYS];
    for (uint32_t i = 0; i < RAYS; i++) {
        ray[i] = kind_ray(&run->scene);
        mask[i] = random_below(&run->scene.random, 8);
    }
    assert_int_equal(trace_array(run->traced, ray, RAYS, hit, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        primitive[i] = hit[i].primitive;
        geometry[i] = hit[i].geometry;
    }
    /* words of their own stride: all arrays of rays have one */
    float column[8][RAYS];
    for (uint32_t i = 0; i < RAYS; i++)
        for (uint32_t k = 0; k < 8; k++)
            column[k][i] = ((const float *)(const void *)&ray[i])[k];
    const cgt_rays rays = {.count = RAYS,
                           .org = {column[0], column[1], column[2]},
                           .dir = {column[3], column[4], column[5]},
                           .t_min = column[6],
                           .t_max = column[7],
                           .mask = mask,
                           .skip_primitive = primitive,
                           .skip_geometry = geometry};
    const cgt_hits hits = hit_array(hit);
    assert_int_equal(cgt_trace_rays(run->traced, &rays, &hits, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        const oracle_scene seen = seen_by(&run->truth, mask[i], geometry[i], primitive[i]);
        judge(run, &seen, &ray[i], &hit[i], "masks and skips");
    }
}

/* Points against a light are rays to it. */
static void compare_points(kind_run *run)
{
    truth_ray ray[RAYS];
    uint8_t occluded[RAYS], expected[RAYS];
    cgt_light light = {.kind = CGT_LIGHT_POINT};
    (void)kind_target(&run->scene, light.position);
    if (!isfinite(light.position[0] + light.position[1] + light.position[2]))
        return;
    for (uint32_t i = 0; i < RAYS; i++) {
        ray[i] = kind_ray(&run->scene);
        ray[i].t_max = 1;
        for (int a = 0; a < 3; a++)
            ray[i].dir[a] = light.position[a] - ray[i].org[a];
    }
    const cgt_rays rays = ray_array(ray, RAYS);
    const cgt_points at = {.count = RAYS, .stride = rays.stride, .position = {rays.org[0], rays.org[1], rays.org[2]}};
    assert_int_equal(cgt_occluded_points(run->traced, &light, &at, occluded, NULL), CGT_OK);
    assert_int_equal(cgt_occluded_rays(run->traced, &rays, expected, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++)
        if (occluded[i] != expected[i] && isfinite(ray[i].dir[0] + ray[i].dir[1] + ray[i].dir[2]))
            fail_msg("%s, %s, structure %d: a point is %d to a light, its ray %d", run->name, run->variant,
                     (int)run->structure, occluded[i], expected[i]);
}

static void judge_frame(kind_run *run)
{
    float t[WIDTH * HEIGHT];
    uint32_t primitive[WIDTH * HEIGHT], geometry[WIDTH * HEIGHT];
    char message[CGT_CAMERA_MESSAGE_BYTES];
    cgt_camera camera;
    cgt_camera_rays prepared;
    cgt_frame frame;
    const truth_ray view = kind_ray(&run->scene);
    cgt_camera_init(&camera);
    camera.projection = (cgt_projection)random_below(&run->scene.random, 2);
    camera.height = hypotf(view.dir[0], hypotf(view.dir[1], view.dir[2])) / 4;
    memcpy(camera.eye, view.org, sizeof camera.eye);
    for (int a = 0; a < 3; a++)
        camera.target[a] = view.org[a] + view.dir[a];
    if (cgt_camera_prepare(&camera, WIDTH, HEIGHT, &prepared, message) != CGT_OK)
        return;
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame.t = t;
    frame.primitive = primitive;
    frame.geometry = geometry;
    assert_int_equal(cgt_trace_camera(run->traced, &camera, &frame, NULL), CGT_OK);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const truth_ray ray = camera_ray(&prepared, i % WIDTH, i / WIDTH);
        const full_hit got = {.t = t[i], .primitive = primitive[i], .geometry = geometry[i]};
        judge(run, &run->truth.whole, &ray, &got, "frame");
    }
}

/* ---- all of it ---- */

static void run_scene(kind_run *run, uint32_t kind, uint32_t number, cgt_context *context)
{
    kind_scene *const s = &run->scene;
    kind_scene_make(s, kind, 1000 * kind + number);
    test_scene_options options = structure_random(&s->random);
    cgt_spheres spheres = spheres_of((const float(*)[4])s->sphere, s->spheres);
    cgt_triangles triangles = {.count = s->triangles, .vertex_count = 3 * s->triangles, .vertices = &s->vertex[0][0]};
    const cgt_capsules capsules = {.count = s->capsules,
                                   .vertex_count = s->capsules,
                                   .vertices = s->capsule[0],
                                   .vertex_stride = sizeof s->capsule[0],
                                   .ends = s->capsule[0] + 3,
                                   .radii = s->capsule[0] + 6,
                                   .radius_stride = sizeof s->capsule[0],
                                   .mask = 4};
    if (s->capsules && options.structure != CGT_STRUCTURE_AUTO && options.structure != CGT_STRUCTURE_LOOSE_GRID)
        options.structure = CGT_STRUCTURE_BVH;
    spheres.mask = 1;
    triangles.mask = 2;
    run->truth.whole = (oracle_scene){0};
    run->structure = options.structure;
    oracle_scene_add_spheres(&run->truth.whole, 0, (const float(*)[4])s->sphere, s->spheres);
    oracle_scene_add_triangles(&run->truth.whole, 1, (const float(*)[3])s->vertex, 3 * s->triangles, NULL,
                               s->triangles);
    oracle_scene_add_capsules(&run->truth.whole, 2, (const float(*)[7])s->capsule, s->capsules);
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(&options), &run->traced), CGT_OK);
    assert_int_equal(cgt_scene_add_spheres(run->traced, &spheres, NULL), CGT_OK);
    assert_int_equal(cgt_scene_add_triangles(run->traced, &triangles, NULL), CGT_OK);
    assert_int_equal(cgt_scene_add_capsules(run->traced, &capsules, NULL), CGT_OK);
    if (cgt_scene_commit(run->traced) != CGT_OK)
        fail_msg("%s: %s", run->name, context_message(context));
    judge_rays(run);
    judge_filtered(run);
    compare_points(run);
    judge_frame(run);
    cgt_scene_release(run->traced);
    oracle_scene_free(&run->truth.whole);
}

TEST(scenes_of_every_kind)
{
    static kind_run run;
    uint64_t rays = 0, hits = 0;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *const context = context_make(2, variant);
        for (uint32_t kind = 0; kind < kind_count(); kind++) {
            run.name = kind_name(kind);
            run.variant = variant;
            run.rays = run.hits = 0;
            for (uint32_t number = 0; number < test_scaled(SCENES); number++)
                run_scene(&run, kind, number, context);
            assert_true(run.rays > 0);
            if (run.hits * 50 < run.rays)
                fail_msg("%s: %u of %u rays hit: nothing is tested", run.name, (unsigned)run.hits, (unsigned)run.rays);
            rays += run.rays;
            hits += run.hits;
        }
        cgt_context_release(context);
    }
    print_message("%llu of %llu rays hit\n", (unsigned long long)hits, (unsigned long long)rays);
}

SEEDED_SUITE("oracle_kinds", NULL, NULL)
