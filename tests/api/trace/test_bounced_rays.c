/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt_trace_bounced_rays: rays inside spheres meet what is nearer, else their own sphere, and all others hit what
 * cgt_trace_rays finds. Skipped primitives in streams. cgt_camera_get_rays: the rays of cgt_camera_get_ray. */
#include <cgt/bounces.h>

#include <math.h>
#include <string.h>

#include "support/scenes.h"
#include "support/suite.h"

enum { BALLS = 40, RAYS = 6000 };

#define THREE(array)                                                                                                   \
    {                                                                                                                  \
        (array)[0], (array)[1], (array)[2]                                                                             \
    }

typedef struct wave {
    float org[3][RAYS], dir[3][RAYS], t_min[RAYS], t_max[RAYS];
    uint32_t skip_primitive[RAYS], skip_geometry[RAYS], mask[RAYS];
    float t[RAYS], normal[3][RAYS], u[RAYS], v[RAYS];
    uint32_t primitive[RAYS], geometry[RAYS];
} wave;

static wave first, second, plain;
static float ball[BALLS][4];

static cgt_rays rays_of(const wave *w)
{
    return (cgt_rays){.count = RAYS,
                      .org = THREE(w->org),
                      .dir = THREE(w->dir),
                      .t_min = w->t_min,
                      .t_max = w->t_max,
                      .skip_primitive = w->skip_primitive,
                      .skip_geometry = w->skip_geometry};
}

static cgt_hits wave_hits(wave *w)
{
    return (cgt_hits){.t = w->t,
                      .primitive = w->primitive,
                      .geometry = w->geometry,
                      .normal = THREE(w->normal),
                      .u = w->u,
                      .v = w->v};
}

/* Rays into a scene of balls, and those that are refracted there, which run inside. */
static cgt_scene *make_waves(cgt_context *context)
{
    test_random r = random_make(1);
    for (uint32_t i = 0; i < BALLS; i++) {
        for (int a = 0; a < 3; a++)
            ball[i][a] = random_float(&r, -1, 1);
        ball[i][3] = i % 2 ? random_float(&r, 0.2f, 0.6f) : random_float(&r, 0.02f, 0.1f);
    }
    cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])ball, BALLS);
    for (uint32_t i = 0; i < RAYS; i++) {
        for (int a = 0; a < 3; a++) {
            first.org[a][i] = random_float(&r, -3, 3);
            first.dir[a][i] = random_float(&r, -1, 1) - first.org[a][i];
        }
        first.t_min[i] = 0;
        first.t_max[i] = INFINITY;
        first.skip_primitive[i] = first.skip_geometry[i] = CGT_INVALID_ID;
    }
    const cgt_rays rays = rays_of(&first);
    const cgt_hits hits = wave_hits(&first);
    const cgt_media media = {.inside = 1.3f};
    const cgt_bounced_rays refracted = {.org = THREE(second.org),
                                        .dir = THREE(second.dir),
                                        .t_max = second.t_max,
                                        .t_min = second.t_min,
                                        .skip_primitive = second.skip_primitive,
                                        .skip_geometry = second.skip_geometry};
    assert_int_equal(cgt_trace_bounced_rays(scene, &rays, &hits, NULL), CGT_OK);
    assert_int_equal(cgt_bounce_rays(scene, &rays, &hits, &media, NULL, NULL, &refracted, NULL), CGT_OK);
    return scene;
}

TEST(own_spheres_are_met)
{
    uint32_t own = 0, nearer = 0, off = 0;
    cgt_context *context = context_make(2, NULL);
    cgt_scene *scene = make_waves(context);
    const cgt_rays rays = rays_of(&second);
    const cgt_hits hits = wave_hits(&second), plain_hits = wave_hits(&plain);
    assert_int_equal(cgt_trace_bounced_rays(scene, &rays, &hits, NULL), CGT_OK);
    assert_int_equal(cgt_trace_rays(scene, &rays, &plain_hits, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        if (second.t_max[i] < 0) {
            off++;
            assert_int_equal(second.primitive[i], CGT_INVALID_ID);
            continue;
        }
        if (plain.primitive[i] != CGT_INVALID_ID) { /* the range ends at the own sphere */
            assert_int_equal(second.primitive[i], plain.primitive[i]);
            assert_true(same_bits(second.t[i], plain.t[i]) && same_bits(second.normal[1][i], plain.normal[1][i]));
            nearer++;
            continue;
        }
        if (isinf(second.t_max[i])) { /* it has left its sphere */
            assert_int_equal(second.primitive[i], CGT_INVALID_ID);
            continue;
        }
        const float *q = ball[second.skip_primitive[i]];
        double square = 0;
        for (int a = 0; a < 3; a++) {
            const double n = (double)second.org[a][i] + (double)second.t[i] * (double)second.dir[a][i] - (double)q[a];
            square += n * n;
            assert_true(fabs((double)second.normal[a][i] - n / (double)q[3]) < 1e-4);
        }
        assert_true(fabs(sqrt(square) / (double)q[3] - 1) < 1e-4);
        assert_int_equal(second.primitive[i], second.skip_primitive[i]);
        assert_int_equal(second.geometry[i], 0);
        assert_true(same_bits(second.t[i], second.t_max[i]) && second.u[i] == 0 && second.v[i] == 0);
        own++;
    }
    print_message("%u own, %u nearer, %u off\n", (unsigned)own, (unsigned)nearer, (unsigned)off);
    assert_true(own > 200 && nearer > 200 && off > 200);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* Only the bits of the far root tell that a ray is inside; a mask hides the own sphere, too; a scene of two
 * geometries. */
TEST(others_are_as_they_are)
{
    uint32_t moved = 0;
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = make_waves(context);
    cgt_rays rays = rays_of(&second);
    const cgt_hits hits = wave_hits(&second), plain_hits = wave_hits(&plain);
    for (uint32_t i = 0; i < RAYS; i++)
        if (second.t_max[i] > 0 && second.t_max[i] < INFINITY)
            second.t_max[i] = nextafterf(second.t_max[i], i % 2 ? 0 : INFINITY), moved++;
    assert_true(moved > 400);
    assert_int_equal(cgt_trace_bounced_rays(scene, &rays, &hits, NULL), CGT_OK);
    assert_int_equal(cgt_trace_rays(scene, &rays, &plain_hits, NULL), CGT_OK);
    assert_memory_equal(second.primitive, plain.primitive, sizeof plain.primitive);
    assert_memory_equal(second.t, plain.t, sizeof plain.t);
    cgt_scene_release(scene);
    scene = make_waves(context);
    cgt_spheres spheres = spheres_of((const float(*)[4])ball, BALLS);
    spheres.mask = 2;
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){0}, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++)
        second.mask[i] = 1 + i % 2;
    rays.mask = second.mask;
    assert_int_equal(cgt_trace_bounced_rays(scene, &rays, &hits, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++)
        assert_true(i % 2 ? second.t_max[i] < 0 || second.t_max[i] == INFINITY || second.primitive[i] != CGT_INVALID_ID
                          : second.primitive[i] == CGT_INVALID_ID);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* Streams of rays that skip primitives of several geometries find what single rays do. */
TEST(skips_go_by_geometry)
{
    uint32_t changed = 0;
    static const cgt_scene_options incoherent = {.rays = CGT_RAY_KIND_INCOHERENT};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = make_waves(context);
    const cgt_spheres half = spheres_of((const float(*)[4])ball, BALLS / 2);
    const cgt_spheres rest = spheres_of((const float(*)[4])ball + BALLS / 2, BALLS / 2);
    assert_int_equal(cgt_scene_set_options(scene, &incoherent), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){0}, &half), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &rest), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    const cgt_rays rays = rays_of(&first);
    const cgt_hits hits = wave_hits(&first);
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
    memcpy(first.skip_primitive, first.primitive, sizeof first.primitive);
    memcpy(first.skip_geometry, first.geometry, sizeof first.geometry);
    for (uint32_t i = 0; i < RAYS; i += 7)
        first.skip_geometry[i] = i % 3 ? 2 : CGT_INVALID_ID;
    assert_int_equal(cgt_trace_rays(scene, &rays, &hits, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        const cgt_hit skip = {.primitive = first.skip_primitive[i], .geometry = first.skip_geometry[i]};
        const cgt_single_ray ray = {.org = {first.org[0][i], first.org[1][i], first.org[2][i]},
                                    .dir = {first.dir[0][i], first.dir[1][i], first.dir[2][i]},
                                    .skip = &skip};
        cgt_hit hit;
        assert_int_equal(cgt_trace_ray(scene, &ray, &hit, NULL), CGT_OK);
        assert_int_equal(hit.primitive, first.primitive[i]);
        assert_int_equal(hit.geometry, first.geometry[i]);
        assert_true(same_bits(hit.t, first.t[i]));
        changed += hit.primitive != first.skip_primitive[i] || hit.geometry != first.skip_geometry[i];
    }
    assert_true(changed > RAYS / 4);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* ---- rays of cameras ---- */

TEST(rectangles_have_their_rays)
{
    enum { WIDTH = 37, HEIGHT = 23, STRIDE = 28 };
    static char memory[WIDTH * HEIGHT * STRIDE];
    float *const org[3] = {(float *)(void *)memory, (float *)(void *)(memory + 4), (float *)(void *)(memory + 8)};
    float *const dir[3] = {(float *)(void *)(memory + 12), (float *)(void *)(memory + 16),
                           (float *)(void *)(memory + 20)};
    const uint32_t rectangle[][4] = {
        {0, 0, WIDTH, HEIGHT}, {5, 7, 1, 1}, {36, 22, 1, 1}, {3, 0, 11, 23}, {37, 23, 0, 0}};
    cgt_camera camera;
    cgt_camera_init(&camera);
    for (size_t k = 0; k < 2 * TEST_COUNT(rectangle); k++) {
        const uint32_t *at = rectangle[k / 2], x = at[0], y = at[1], columns = at[2], rows = at[3];
        camera.projection = k % 2 ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
        assert_int_equal(cgt_camera_get_rays(&camera, WIDTH, HEIGHT, x, y, columns, rows, STRIDE, org, dir), CGT_OK);
        for (uint32_t i = 0; i < columns * rows; i++) {
            float ray[2][3];
            assert_int_equal(
                cgt_camera_get_ray(&camera, WIDTH, HEIGHT, x + i % columns, y + i / columns, ray[0], ray[1]), CGT_OK);
            assert_memory_equal(memory + (size_t)i * STRIDE, ray, sizeof ray);
        }
    }
}

SEEDED_SUITE("test_bounced_rays", NULL, NULL)
