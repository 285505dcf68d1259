/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Every call hands out the same bits for the same ray, the signs of zeros included: arrays long and short, one ray, a
 * camera's planes and tiles, through any structure, in any variant and in both precisions. Spheres and triangles lie on
 * a lattice, and rays run along its axes and diagonals, so that places and components of normals are exactly 0; the
 * lattice has any scale, and offsets at which its step is the last bit of a float. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "primitive/triangle_scenes.h"
#include "support/suite.h"
#include "structures/scenes/picture.h"

enum { SPHERES = 40, TRIANGLES = 40, EDGE = 33, RAYS = 3 * EDGE * EDGE };

static float sphere[SPHERES][4];
static triangle given[TRIANGLES];
static truth_ray ray[RAYS];
static full_hit expected[RAYS], hit[RAYS];

typedef struct lattice {
    int step;     /* its step is a power of two */
    float offset; /* of the place where rays and primitives lie, in steps */
} lattice;

static const lattice lattices[] = {{0, 0},    {0, 3},    {-20, 0},   {20, 0x1p22f}, {-3, 0x1p22f}, {40, 0},
                                   {-60, 5},  {60, 0},   {-100, 0},  {-100, 9},     {100, 0},      {100, 0x1p23f},
                                   {-140, 0}, {-126, 1}, {118, 100}, {-146, 0},     {-40, 0x1p23f}};

static float place(const lattice *l, int steps) { return ldexpf(l->offset + (float)steps, l->step); }

static int within(test_random *r, int most) { return (int)random_below(r, 2 * (uint32_t)most + 1) - most; }

static void make_scene(test_random *r, const lattice *l)
{
    for (int i = 0; i < SPHERES; i++) {
        for (int a = 0; a < 3; a++)
            sphere[i][a] = place(l, within(r, 6));
        sphere[i][3] = i % 8 ? ldexpf(i % 3 ? 1 + (float)random_below(r, 3) : random_float(r, 0.5f, 3), l->step) : 0;
    }
    for (int i = 0; i < TRIANGLES; i++)
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                given[i][k][a] = place(l, i % 3 == a ? 4 : within(r, 6)); /* most lie in a plane of the lattice */
}

/* Rays along axes and diagonals, with zeros of both signs; where float allows it, from the camera too. */
static uint32_t make_rays(test_random *r, const lattice *l)
{
    const float component[] = {0, -0.f, 1, -1, 0.5f, -2};
    for (uint32_t i = 0; i < RAYS; i++) {
        ray[i] = (truth_ray){.t_min = i % 5 ? 0 : -INFINITY, .t_max = INFINITY};
        for (int a = 0; a < 3; a++) {
            ray[i].org[a] = place(l, within(r, 9));
            ray[i].dir[a] = i % 7 ? component[random_below(r, TEST_COUNT(component))] : random_float(r, -1, 1);
        }
        if (i % 2)
            for (int a = 0; a < 3; a++)
                ray[i].dir[a] = ldexpf(ray[i].dir[a], within(r, 8));
    }
    return RAYS;
}

static void same(const char *what, const char *variant, const lattice *l, uint32_t first, uint32_t count)
{
    for (uint32_t i = first; i < first + count; i++)
        if (memcmp(&hit[i], &expected[i], sizeof hit[i]) != 0)
            fail_msg("%s, %s, step 2^%d, offset %g, ray %u: %u.%u, t %a, normal %a %a %a, u %a; first found: %u.%u, "
                     "t %a, normal %a %a %a, u %a",
                     what, variant, l->step, (double)l->offset, i, hit[i].geometry, hit[i].primitive, (double)hit[i].t,
                     (double)hit[i].normal[0], (double)hit[i].normal[1], (double)hit[i].normal[2], (double)hit[i].uv[0],
                     expected[i].geometry, expected[i].primitive, (double)expected[i].t, (double)expected[i].normal[0],
                     (double)expected[i].normal[1], (double)expected[i].normal[2], (double)expected[i].uv[0]);
}

/* ---- arrays and single rays ---- */

static full_hit trace_one(const cgt_scene *scene, const truth_ray *from, const cgt_trace_options *options)
{
    cgt_single_ray one = {.t_min = from->t_min, .t_max = from->t_max};
    cgt_hit h;
    memcpy(one.org, from->org, sizeof one.org);
    memcpy(one.dir, from->dir, sizeof one.dir);
    assert_int_equal(cgt_trace_ray(scene, &one, &h, options), CGT_OK);
    return (full_hit){h.t, h.primitive, h.geometry, {h.normal[0], h.normal[1], h.normal[2]}, {h.u, h.v}};
}

static void compare_rays(const cgt_scene *scene, const char *variant, const lattice *l, uint32_t count,
                         const cgt_trace_options *options)
{
    const uint32_t few = count / 8;
    trace_all(scene, ray, count, hit, options);
    same("an array", variant, l, 0, count);
    for (uint32_t i = 0; i < few; i += 5) {
        trace_all(scene, ray + i, 5, hit + i, options);
        same("an array of five", variant, l, i, 5);
    }
    for (uint32_t i = few; i < 2 * few; i++)
        hit[i] = trace_one(scene, &ray[i], options);
    same("one ray", variant, l, few, few);
}

/* ---- cameras ---- */

static cgt_visit keep_tile(void *user, const cgt_tile *tile)
{
    (void)user;
    for (uint32_t i = 0; i < tile->width * tile->height; i++) {
        const size_t at = i / tile->width * tile->row_stride + i % tile->width;
        hit[(tile->y + i / tile->width) * EDGE + tile->x + i % tile->width] =
            (full_hit){tile->t[at],
                       tile->primitive[at],
                       tile->geometry[at],
                       {tile->normal[0][at], tile->normal[1][at], tile->normal[2][at]},
                       {tile->u[at], tile->v[at]}};
    }
    return CGT_VISIT_CONTINUE;
}

static cgt_camera camera_on(const lattice *l, int number)
{
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.projection = number % 2 ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
    camera.height = ldexpf(16, l->step);
    for (int a = 0; a < 3; a++) {
        camera.eye[a] = place(l, a == number / 2 ? 16 : 0);
        camera.target[a] = place(l, 0);
        camera.up[a] = a == (number / 2 + 1) % 3 ? 1 : 0;
    }
    return camera;
}

static void compare_camera(const cgt_scene *scene, const char *variant, const lattice *l, const cgt_camera *camera,
                           const cgt_trace_options *options)
{
    picture q = picture_make(EDGE, EDGE);
    cgt_frame tiles = {.width = EDGE, .height = EDGE, .visitor = keep_tile, .visitor_fields = 31};
    picture_trace(scene, camera, options, &q);
    memcpy(hit, q.hit, EDGE * EDGE * sizeof *hit);
    same("planes", variant, l, 0, EDGE * EDGE);
    memset(hit, 0x55, sizeof hit);
    assert_int_equal(cgt_trace_camera(scene, camera, &tiles, options), CGT_OK);
    same("tiles", variant, l, 0, EDGE * EDGE);
    picture_free(&q);
}

/* The camera's rays become the rays of arrays. Returns whether float has room for it. */
static bool aim(const lattice *l, const cgt_camera *camera)
{
    float line[6][EDGE * EDGE];
    if (abs(l->step) > 60 ||
        cgt_camera_get_rays(camera, EDGE, EDGE, 0, 0, EDGE, EDGE, 0, (float *[]){line[0], line[1], line[2]},
                            (float *[]){line[3], line[4], line[5]}) != CGT_OK)
        return false;
    for (uint32_t i = 0; i < EDGE * EDGE; i++) {
        ray[i] = (truth_ray){.t_min = 0, .t_max = INFINITY};
        for (int a = 0; a < 3; a++) {
            ray[i].org[a] = line[a][i];
            ray[i].dir[a] = line[3 + a][i];
        }
    }
    return true;
}

/* ---- tests ---- */

typedef enum content { SPHERES_ALONE, TRIANGLES_ALONE, BOTH, CONTENTS } content;

static cgt_scene *commit(cgt_context *context, content c, const cgt_scene_options *made)
{
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, made, &scene), CGT_OK);
    if (c != TRIANGLES_ALONE)
        scene_add_spheres(scene, (const float(*)[4])sphere, SPHERES);
    if (c != SPHERES_ALONE)
        scene_add_triangles(scene, (const triangle *)given, TRIANGLES);
    scene_commit(context, scene);
    return scene;
}

/* All variants and structures against the first of them. camera: NULL for rays of their own. Returns the hits. */
static uint32_t compare_all(content c, const lattice *l, uint32_t rays, const cgt_camera *camera,
                            cgt_precision precision)
{
    const cgt_trace_options options = with_precision(precision);
    bool first = true;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        for (uint32_t k = 0; k < TEST_STRUCTURES; k++) {
            const cgt_scene_options made = structure_in_turn(k);
            cgt_scene *scene = commit(context, c, &made);
            if (first)
                trace_all(scene, ray, rays, expected, &options);
            first = false;
            compare_rays(scene, variant, l, rays, &options);
            if (camera)
                compare_camera(scene, variant, l, camera, &options);
            cgt_scene_release(scene);
        }
        cgt_context_release(context);
    }
    return hits_in(expected, rays);
}

TEST(bits_are_those_of_any_call)
{
    const uint32_t step = test_scaled(100) < 20 ? 3 : 1; /* slow builds take each third */
    uint32_t hits = 0, pixels = 0, zeros = 0, cases = 0, number = test_sample_start(0, step);
    for (size_t i = 0; i < TEST_COUNT(lattices); i++)
        for (int c = 0; c < CONTENTS; c++, number++) {
            const lattice *l = &lattices[i];
            if (number % step)
                continue;
            cases++;
            const cgt_precision precision = number % 4 == 3 ? CGT_PRECISION_FAST : CGT_PRECISION_EXACT;
            test_random r = random_make(40 + number);
            make_scene(&r, l);
            hits += compare_all((content)c, l, make_rays(&r, l), NULL, precision);
            for (int k = 0; k < RAYS; k++)
                for (int a = 0; a < 3 && expected[k].geometry != CGT_INVALID_ID; a++)
                    zeros += expected[k].normal[a] == 0;
            const cgt_camera camera = camera_on(l, (int)(number % 6));
            if (aim(l, &camera))
                pixels += compare_all((content)c, l, EDGE * EDGE, &camera, precision);
        }
    print_message("%u hits of rays, %u of pixels, %u components of normals are 0\n", hits, pixels, zeros);
    assert_true(hits > cases * 200 && pixels > cases * 50 && zeros > hits / 10);
}

/* A ray through a sphere's centre, along an axis: arrays had -0 where one ray had +0. */
TEST(zeros_have_one_sign)
{
    const float ball[1][4] = {{0, 0, 0, 1}};
    const truth_ray along = {{0, 0, 4}, {-0.f, 0, -1}, 0, INFINITY};
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene = scene_of(context, NULL, ball, 1);
        trace_all(scene, &along, 1, hit, NULL);
        const full_hit one = trace_one(scene, &along, NULL);
        assert_memory_equal(&one, &hit[0], sizeof one);
        assert_true(one.normal[2] == 1 && signbit(one.normal[0]) && !signbit(one.normal[1]));
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* A sliver whose normal is right in double, with a -0: a ray that begins on it, whose t takes whole numbers, had +0. */
TEST(zeros_have_one_sign_for_any_fields)
{
    const triangle sliver = {{0, 0, 0}, {-1, 0, -1}, {1, 0, 1 - 0x1p-24f}};
    const truth_ray rays[2] = {{{0, 0, 0}, {0, 1, 0}, 0, INFINITY}, {{0, -1, 0}, {0, 1, 0}, 0, INFINITY}};
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene;
        assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
        scene_add_triangles(scene, &sliver, 1);
        scene_commit(context, scene);
        for (int k = 0; k < 4; k++) {
            const cgt_rays from = ray_array(&rays[k % 2], 1);
            cgt_hits to = hit_array(hit);
            if (k / 2)
                to.t = to.u = to.v = NULL;
            memset(hit, 0, sizeof *hit);
            assert_int_equal(cgt_trace_rays(scene, &from, &to, NULL), CGT_OK);
            assert_int_equal(hit->primitive, 0);
            assert_true(hit->normal[1] == -1 && !signbit(hit->normal[0]) && signbit(hit->normal[2]));
        }
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

SEEDED_SUITE("test_value_bits", NULL, NULL)
