/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ends of ranges next to a hit, where two formulas round its t to neighbouring floats, or to 0: all calls agree. No
 * profile of tests/driver: its random cases do not meet them. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "support/scenes.h"
#include "support/suite.h"

enum { RAYS = 64 /* enough for a stream */ };

/* The t of a ray through all calls, +infinity for none. */
static float t_of(const cgt_scene *scene, const cgt_single_ray *ray, const cgt_camera *camera)
{
    float org[3][RAYS], dir[3][RAYS], t_min[RAYS], t_max[RAYS], t[RAYS], pixel;
    uint32_t primitive[RAYS];
    uint8_t occluded[RAYS];
    cgt_hit hit;
    for (int i = 0; i < RAYS; i++) {
        for (int a = 0; a < 3; a++) {
            org[a][i] = ray->org[a];
            dir[a][i] = ray->dir[a];
        }
        t_min[i] = ray->t_min;
        t_max[i] = ray->t_max == 0 ? INFINITY : ray->t_max;
    }
    assert_int_equal(cgt_trace_ray(scene, ray, &hit, NULL), CGT_OK);
    for (int ranges = ray->t_min != 0 || ray->t_max != 0; ranges < 2; ranges++) {
        const cgt_rays rays = {.count = RAYS,
                               .org = {org[0], org[1], org[2]},
                               .dir = {dir[0], dir[1], dir[2]},
                               .t_min = ranges ? t_min : NULL,
                               .t_max = ranges ? t_max : NULL};
        const cgt_hits hits = {.t = t, .primitive = primitive};
        assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
        assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, NULL), CGT_OK);
        for (int i = 0; i < RAYS; i++)
            if (t[i] != hit.t || occluded[i] != (hit.primitive != CGT_INVALID_ID))
                fail_msg("ray %d: %a, occluded %u; alone %a", i, (double)t[i], occluded[i], (double)hit.t);
    }
    if (!camera)
        return hit.t;
    cgt_camera view = *camera;
    cgt_frame frame;
    view.t_min = ray->t_min;
    view.t_max = ray->t_max;
    cgt_frame_init(&frame, 1, 1);
    frame.t = &pixel;
    assert_int_equal(cgt_trace_camera(scene, &view, &frame, NULL), CGT_OK);
    if (pixel != hit.t)
        fail_msg("a frame has %a, a ray %a", (double)pixel, (double)hit.t);
    return hit.t;
}

static cgt_scene *scene_by(cgt_context *context, const float sphere[1][4], cgt_structure structure)
{
    const cgt_scene_options options = {.structure = structure};
    return scene_of(context, &options, sphere, 1);
}

static const cgt_structure structures[] = {CGT_STRUCTURE_AUTO, CGT_STRUCTURE_LOOSE_GRID, CGT_STRUCTURE_BVH};

/* The short formula rounds the near root to 0x1.ffbff8p-1, the long one to the next float. */
TEST(a_root_has_one_t)
{
    static const float sphere[1][4] = {{0x1.e0348p-11f, 0x1p-28f, -1, 0x1.101dcp-10f}};
    cgt_context *context = context_make(1, NULL);
    for (size_t k = 0; k < TEST_COUNT(structures); k++) {
        cgt_scene *scene = scene_by(context, sphere, structures[k]);
        const cgt_camera camera = {.target = {0, 0, -1}, .up = {0, 1, 0}};
        cgt_single_ray ray = {.dir = {0, 0, -1}};
        const float near = t_of(scene, &ray, &camera);
        assert_true(near == 0x1.ffbff8p-1f);
        ray.t_min = ray.t_max = near;
        assert_true(t_of(scene, &ray, &camera) == near);
        ray.t_min = nextafterf(near, 2);
        ray.t_max = 0;
        assert_true(t_of(scene, &ray, &camera) > 1);
        ray.t_min = 0;
        ray.t_max = nextafterf(near, 0);
        assert_true(t_of(scene, &ray, &camera) == INFINITY);
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

/* A surface so little behind the origin that t rounds to -0 counts. */
TEST(behind_the_origin_by_nothing)
{
    static const float point[1][4] = {{0, 0, 0, 0}}, corner[9] = {0, 0, 0, 0.9f, 0, 0, 0, 0.9f, 0};
    static const cgt_single_ray rays[2][2] = {
        {{.org = {1e-28f, 0, 0}, .dir = {0x1p59f, 0, 0}}, {.org = {-1e-28f, 0, 0}, .dir = {-0x1p59f, 0, 0}}},
        {{.org = {0.25f, 0.25f, 1e-28f}, .dir = {0, 0, 0x1p59f}},
         {.org = {0.25f, 0.25f, -1e-28f}, .dir = {0, 0, -0x1p59f}}}};
    const cgt_triangles triangle = {.count = 1, .vertex_count = 3, .vertices = cgt_floats(corner, 0)};
    cgt_context *context = context_make(1, NULL);
    for (size_t k = 0; k < TEST_COUNT(structures); k++)
        for (int kind = 0; kind < 2; kind++) {
            cgt_scene *scene = scene_by(context, point, structures[k]);
            if (kind) {
                const cgt_spheres none = {.count = 0};
                uint32_t geometry = 0;
                assert_int_equal(cgt_scene_set_spheres(scene, &geometry, &none), CGT_OK);
                assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangle), CGT_OK);
                assert_int_equal(cgt_scene_commit(scene), CGT_OK);
            }
            for (int way = 0; way < 2; way++)
                assert_true(t_of(scene, &rays[kind][way], NULL) == 0);
            cgt_scene_release(scene);
        }
    cgt_context_release(context);
}

/* Capsules with exchanged ends are one surface, but the t of the first one rounds to before the range. */
TEST(exchanged_ends_at_the_range)
{
    static const float end[2][3] = {{-0x1.4bcp-1f, -0x1.064p-1f, -0x1.78p+0f}, {0x1.ca2p+0f, 0x1.8cep+0f, 0x1.22p+2f}};
    static const uint32_t index[4] = {0, 1, 1, 0};
    const cgt_capsules capsules = {.count = 2,
                                   .indices = cgt_uint32s(index, 0),
                                   .vertices = cgt_floats(end[0], 0),
                                   .vertex_count = 2,
                                   .radius = 0x1.4p-5f};
    const cgt_camera camera = {.eye = {0, 0, 0x1p-30f}, .target = {0, 0, 1}, .up = {0, 1, 0}};
    const cgt_single_ray ray = {.org = {0, 0, 0x1p-30f}, .dir = {0, 0, 1}, .t_min = 0x1.8p-6f};
    cgt_context *context = context_make(1, NULL);
    for (size_t k = 0; k < TEST_COUNT(structures); k++) {
        const cgt_scene_options options = {.structure = structures[k]};
        cgt_scene *scene;
        assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
        assert_int_equal(cgt_scene_set_capsules(scene, NULL, &capsules), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_true(t_of(scene, &ray, &camera) == ray.t_min);
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

/* Rays that begin beyond all reach, and do not move along an axis, take nothing from those beside them. */
TEST(beginning_nowhere)
{
    enum { ROW = 32, MANY = 60 * ROW };
    static const float unit = 0x1p-20f; /* the scene's: in that of a tree they begin at infinity */
    static float sphere[ROW][4], org[3][MANY], dir[3][MANY], t_min[MANY], t[MANY];
    static uint8_t occluded[MANY];
    const cgt_spheres spheres = spheres_of(sphere, ROW);
    const cgt_rays rays = {
        .count = MANY, .org = {org[0], org[1], org[2]}, .dir = {dir[0], dir[1], dir[2]}, .t_min = t_min};
    const cgt_hits hits = {.t = t};
    for (uint32_t i = 0; i < ROW; i++) {
        sphere[i][0] = unit * (float)i;
        sphere[i][3] = 0.25f * unit;
    }
    for (uint32_t i = 0; i < MANY; i++) {
        org[0][i] = unit * (float)(i % ROW);
        org[2][i] = 5 * unit;
        dir[2][i] = -1;
        t_min[i] = i % ROW < 8 || i % ROW > 24 || i % 3 ? 0 : FLT_MAX;
    }
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene;
        assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
        assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, NULL), CGT_OK);
        for (uint32_t i = 0; i < MANY; i++)
            assert_true(t[i] == (t_min[i] == 0 ? 4.75f * unit : INFINITY) && occluded[i] == (t_min[i] == 0));
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* Rays that end together among small spheres, and one from far away that goes on beyond by as much as half its way. */
TEST(ending_far_behind)
{
    enum { MANY = 512, FAR = 300 };
    static float sphere[MANY][4], org[3][MANY], dir[3][MANY], t_min[MANY], t_max[MANY];
    static uint8_t occluded[MANY];
    const cgt_spheres spheres = spheres_of(sphere, MANY);
    const cgt_rays rays = {.count = MANY,
                           .org = {org[0], org[1], org[2]},
                           .dir = {dir[0], dir[1], dir[2]},
                           .t_min = t_min,
                           .t_max = t_max};
    for (uint32_t i = 0; i < MANY; i++) {
        const float unit = i < MANY / 2 ? 0x1p-18f : 1;
        sphere[i][0] = 0.2f * unit * (float)(i % 8);
        sphere[i][1] = 0.2f * unit * (float)(i / 8 % 8);
        sphere[i][2] = 0.2f * unit * (float)(i / 64);
        sphere[i][3] = 0x1p-24f;
    }
    for (uint32_t i = 0; i < MANY; i++) {
        for (int a = 0; a < 3; a++) {
            org[a][i] = i == FAR ? sphere[9][a] : 0.7f + 0.1f * (float)((int)(i % 7) * (a + 1));
            dir[a][i] = sphere[9][a] - org[a][i];
        }
        t_max[i] = 1;
    }
    org[2][FAR] = -0x1p105f;
    dir[2][FAR] = 0x1p105f;
    t_min[FAR] = 0.25f;
    t_max[FAR] = 1.25f;
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, NULL), CGT_OK);
    for (uint32_t i = 0; i < MANY; i++)
        assert_int_equal(occluded[i], 1);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_ranges", NULL, NULL)
