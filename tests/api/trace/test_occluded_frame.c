/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames and what is made of them: positions are org + t dir of the rays that cgt_camera_get_ray gives; these rays, as
 * an array, have the frame's hits; and the shadows of a frame are those of cgt_occluded_points at its positions, for
 * every structure, variant and number of threads, several lights, masks, and planes with gaps. Invalid points, and a
 * hit at a light's own place, are among them. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/scenes.h"
#include "support/suite.h"

#define WIDTH 150u
#define HEIGHT 77u
#define STRIDE 163u
#define PIXELS (STRIDE * HEIGHT)
#define LIGHTS 3u

typedef struct view {
    float t[PIXELS], position[3][PIXELS], t_min[PIXELS];
    uint32_t primitive[PIXELS], geometry[PIXELS], mask[PIXELS];
    uint8_t occluded[LIGHTS][PIXELS], expected[PIXELS];
    cgt_camera camera;
    cgt_frame frame;
} view;

static bool inside(uint32_t i) { return i % STRIDE < WIDTH; }

static void view_init(view *v, const cgt_camera *camera, bool with_ids)
{
    memset(v, 0x55, sizeof *v);
    v->camera = *camera;
    cgt_frame_init(&v->frame, WIDTH, HEIGHT);
    v->frame.row_stride = STRIDE;
    v->frame.t = v->t;
    v->frame.primitive = with_ids ? v->primitive : NULL;
    v->frame.geometry = with_ids ? v->geometry : NULL;
    for (int a = 0; a < 3; a++)
        v->frame.position[a] = v->position[a];
}

/* A cloud on a floor, in two geometries with masks of their own. */
static cgt_scene *scene_make(cgt_context *context, uint32_t structure, const cloud *c)
{
    static float corner[4][3];
    static const uint32_t index[2][3] = {{0, 1, 2}, {0, 2, 3}};
    const cgt_scene_options made = structure_in_turn(structure);
    cgt_spheres spheres = spheres_of((const float(*)[4])c->sphere, c->count);
    const cgt_triangles triangles = {.count = 2,
                                     .indices = cgt_uint32s(index[0], 0),
                                     .vertex_count = 4,
                                     .vertices = cgt_floats(corner[0], 0),
                                     .mask = 2};
    cgt_scene *scene;
    for (int k = 0; k < 4; k++) {
        corner[k][0] = c->middle[0] + (k == 0 || k == 3 ? -2.f : 2.f) * c->reach;
        corner[k][1] = c->middle[1] - 1.1f * c->reach;
        corner[k][2] = c->middle[2] + (k < 2 ? -2.f : 2.f) * c->reach;
    }
    spheres.mask = 1;
    assert_int_equal(cgt_scene_create(context, &made, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

static void make_lights(test_random *r, const cloud *c, cgt_light light[LIGHTS])
{
    for (uint32_t k = 0; k < LIGHTS; k++) {
        light[k].kind = k == 1 ? CGT_LIGHT_DIRECTIONAL : CGT_LIGHT_POINT;
        for (int a = 0; a < 3; a++)
            light[k].position[a] = (k == 1 ? 0 : c->middle[a]) + random_float(r, -1, 1) * c->reach * (k ? 3.f : 0.5f);
    }
}

/* ---- positions and rays ---- */

static uint32_t check_positions(const view *v)
{
    uint32_t hits = 0;
    for (uint32_t i = 0; i < PIXELS; i++) {
        float org[3], dir[3];
        if (!inside(i)) {
            assert_memory_equal(&v->position[i % 3][i], "\x55\x55\x55\x55", 4);
            continue;
        }
        assert_int_equal(cgt_camera_get_ray(&v->camera, WIDTH, HEIGHT, i % STRIDE, i / STRIDE, org, dir), CGT_OK);
        hits += !isinf(v->t[i]);
        for (int a = 0; a < 3; a++) {
            const float product = v->t[i] * dir[a], expected = isinf(v->t[i]) ? INFINITY : org[a] + product;
            if (!same_bits(v->position[a][i], expected))
                fail_msg("pixel %u, %u: position %d is %a, not %a", i % STRIDE, i / STRIDE, a,
                         (double)v->position[a][i], (double)expected);
        }
    }
    return hits;
}

/* The pixels' rays as an array find what the frame has found. */
static void check_rays(const cgt_scene *scene, const view *v)
{
    static float org[3][WIDTH], dir[3][WIDTH], t_min[WIDTH], t_max[WIDTH], t[WIDTH];
    const uint32_t y = HEIGHT / 2;
    for (uint32_t x = 0; x < WIDTH; x++) {
        float o[3], d[3];
        assert_int_equal(cgt_camera_get_ray(&v->camera, WIDTH, HEIGHT, x, y, o, d), CGT_OK);
        for (int a = 0; a < 3; a++) {
            org[a][x] = o[a];
            dir[a][x] = d[a];
        }
        t_min[x] = v->camera.t_min;
        t_max[x] = v->camera.t_max == 0 ? INFINITY : v->camera.t_max;
    }
    const cgt_rays rays = {.count = WIDTH,
                           .org = {org[0], org[1], org[2]},
                           .dir = {dir[0], dir[1], dir[2]},
                           .t_min = t_min,
                           .t_max = t_max};
    const cgt_hits hits = {.t = t};
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
    assert_memory_equal(t, v->t + y * STRIDE, sizeof t);
}

typedef struct visited {
    view *v;
    uint32_t pixels;
} visited;

static cgt_visit compare_tile(void *user, const cgt_tile *tile)
{
    visited *w = user;
    for (uint32_t y = 0; y < tile->height; y++)
        for (int a = 0; a < 3; a++)
            assert_memory_equal(tile->position[a] + y * tile->row_stride,
                                w->v->position[a] + (tile->y + y) * STRIDE + tile->x, tile->width * sizeof(float));
    w->pixels += tile->width * tile->height;
    return CGT_VISIT_CONTINUE;
}

TEST(positions_are_on_the_rays)
{
    static view v;
    test_random r = random_make(950);
    cgt_context *context = context_make(1, NULL);
    for (uint32_t k = 0; k < TEST_STRUCTURES; k++) {
        cloud c = cloud_make(&r, (cloud_kind)(k % CLOUD_KINDS), 300);
        cgt_scene *scene = scene_make(context, k, &c);
        cgt_camera camera = camera_before(&c);
        camera.projection = k % 3 == 2 ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
        camera.height = 2 * c.reach;
        view_init(&v, &camera, true);
        assert_int_equal(cgt_trace_camera(scene, &camera, &v.frame, NULL), CGT_OK);
        assert_true(check_positions(&v) > 0);
        check_rays(scene, &v);
        /* the visitor's, alone; and planes of positions alone */
        visited w = {.v = &v};
        cgt_frame frame;
        cgt_frame_init(&frame, WIDTH, HEIGHT);
        frame.visitor = compare_tile;
        frame.visitor_user = &w;
        frame.visitor_fields = CGT_FIELD_POSITION;
        assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_OK);
        assert_int_equal(w.pixels, WIDTH * HEIGHT);
        frame.visitor = NULL;
        frame.row_stride = STRIDE;
        for (int a = 0; a < 3; a++) {
            frame.position[a] = v.position[a];
            memset(v.position[a], 0x55, sizeof v.position[a]);
        }
        assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_OK);
        check_positions(&v);
        cgt_scene_release(scene);
        cloud_free(&c);
    }
    cgt_context_release(context);
}

/* ---- shadows ---- */

/* Some hits get a t whose place is no number, or beyond all numbers; a light moves to the place of another hit. */
static void spoil(view *v, cgt_light *light)
{
    static const float bad[] = {NAN, FLT_MAX, -FLT_MAX, 0};
    uint32_t spoilt = 0;
    for (uint32_t i = 5; i < PIXELS && spoilt < TEST_COUNT(bad); i++) {
        if (!inside(i) || isinf(v->t[i]) || i % 7)
            continue;
        v->t[i] = bad[spoilt] == 0 ? v->t[i] : bad[spoilt];
        float org[3], dir[3];
        assert_int_equal(cgt_camera_get_ray(&v->camera, WIDTH, HEIGHT, i % STRIDE, i / STRIDE, org, dir), CGT_OK);
        for (int a = 0; a < 3; a++) {
            const float product = v->t[i] * dir[a];
            v->position[a][i] = org[a] + product;
            light->position[a] = v->position[a][i];
        }
        spoilt++;
    }
    assert_int_equal(spoilt, TEST_COUNT(bad));
}

/* Returns how many points are invalid. */
static uint64_t expect_shadows(const cgt_scene *scene, view *v, const cgt_light *light, float t_min)
{
    cgt_trace_statistics s;
    for (uint32_t i = 0; i < PIXELS; i++) {
        v->t_min[i] = t_min;
        v->mask[i] = v->camera.mask;
        if (!inside(i)) /* the gap holds points, too */
            for (int a = 0; a < 3; a++)
                v->position[a][i] = INFINITY;
    }
    const cgt_points points = {.count = PIXELS,
                               .position = {v->position[0], v->position[1], v->position[2]},
                               .t_min = v->t_min,
                               .mask = v->mask,
                               .skip_primitive = v->frame.primitive,
                               .skip_geometry = v->frame.geometry};
    assert_int_equal(cgt_occluded_points(scene, light, &points, v->expected, &(cgt_trace_options){.statistics = &s}),
                     CGT_OK);
    return s.invalid_rays;
}

static uint64_t check_shadows(const cgt_scene *scene, view *v, const cgt_light light[LIGHTS], float t_min)
{
    const cgt_shadow_options shadows = {.t_min = t_min};
    cgt_trace_statistics s;
    const cgt_trace_options options = {.statistics = &s};
    uint64_t hits = 0, occluded = 0, invalid = 0;
    assert_int_equal(cgt_occluded_frame(scene, &v->camera, &v->frame, light, LIGHTS, t_min == 0 ? NULL : &shadows,
                                        v->occluded[0], &options),
                     CGT_OK);
    for (uint32_t k = 0; k < LIGHTS; k++) {
        invalid += expect_shadows(scene, v, &light[k], t_min);
        for (uint32_t i = 0; i < PIXELS; i++) {
            const uint8_t right = inside(i) ? v->expected[i] : 0x55;
            if (v->occluded[k][i] != right)
                fail_msg("light %u, pixel %u, %u: %u, not %u", k, i % STRIDE, i / STRIDE, v->occluded[k][i], right);
            hits += inside(i) && !isinf(v->t[i]);
            occluded += inside(i) && right;
        }
    }
    assert_int_equal(s.rays, hits);
    assert_int_equal(s.hits, occluded);
    assert_int_equal(s.invalid_rays, invalid - (LIGHTS * PIXELS - hits)); /* pixels without a hit are no points */
    assert_true(s.invalid_rays > LIGHTS);                                 /* the NaN for each, and the place of one */
    return occluded;
}

TEST(shadows_are_those_of_points)
{
    static view v;
    uint64_t occluded = 0;
    FOR_EACH_VARIANT(variant)
    for (uint32_t k = 0; k < TEST_STRUCTURES + 1; k++) {
        test_random r = random_make(960 + k);
        cgt_context *context = context_make(1 + k % 3, variant);
        cloud c = cloud_make(&r, k % 2 ? CLOUD_UNIFORM : CLOUD_CLUSTERED, k % 3 == 2 ? 3000 : 200);
        cgt_scene *scene = scene_make(context, k, &c);
        if (k == TEST_STRUCTURES)
            assert_int_equal(cgt_scene_set_options(scene, &(cgt_scene_options){0}), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        cgt_camera camera = camera_before(&c);
        cgt_light light[LIGHTS];
        make_lights(&r, &c, light);
        for (int a = 0; a < 3; a++)
            camera.eye[a] += random_float(&r, -0.5f, 0.5f) * c.reach;
        camera.mask = k % 4 == 3 ? 1 : 0;
        view_init(&v, &camera, k % 2);
        assert_int_equal(cgt_trace_camera(scene, &camera, &v.frame, NULL), CGT_OK);
        spoil(&v, &light[0]);
        occluded += check_shadows(scene, &v, light, k % 2 ? 0 : 1e-3f);
        cgt_scene_release(scene);
        cgt_context_release(context);
        cloud_free(&c);
    }
    print_message("%llu pixels in shadow\n", (unsigned long long)occluded);
    assert_true(occluded > 1000);
}

SEEDED_SUITE("test_occluded_frame", NULL, NULL)
