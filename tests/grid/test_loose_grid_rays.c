/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays that hit primitives of a loose grid where these extend farthest beyond their cells: at the rims of spheres
 * and the corners of triangles, all of one size, so that each has its level's full reach. Single rays give the
 * tightest frusta; small bundles share an origin, are parallel, or lead to a light. A grid of one cell is the
 * reference. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hard_cases/hard_run.h"
#include "support/suite.h"
#include "support/scenes.h"

#define PRIMITIVES 700u
#define RAYS 1200u
#define SIZE 0.06f

static hard_scene make_scene(test_random *r, bool triangles, float (*middle)[3])
{
    hard_scene s = {.place = {.scale = 1}};
    hard_new_geometry(&s);
    for (uint32_t i = 0; i < PRIMITIVES; i++) {
        float sphere[4] = {0, 0, 0, SIZE}, v[3][3];
        for (int a = 0; a < 3; a++) {
            middle[i][a] = sphere[a] = random_float(r, -1, 1);
            /* two corners of its box, and a third point off their line */
            const float side = random_below(r, 2) ? SIZE : -SIZE;
            v[0][a] = sphere[a] + side;
            v[1][a] = sphere[a] - side;
            v[2][a] = sphere[a] + random_float(r, -1, 1) * SIZE;
        }
        if (triangles)
            hard_raw_triangle(&s, (const float(*)[3])v);
        else
            hard_raw_sphere(&s, sphere);
    }
    assert_false(s.failed);
    return s;
}

/* A unit vector orthogonal to another one. For a triangle any will do: its corners lie along the diagonals. */
static void rim_of(test_random *r, const float dir[3], bool triangle, float rim[3])
{
    float length = 0, along = 0;
    for (int a = 0; a < 3; a++) {
        rim[a] = triangle ? (random_below(r, 2) ? 1.f : -1.f) : random_float(r, -1, 1);
        if (!triangle && random_below(r, 3) == 0)
            rim[a] = 0; /* towards a cell's face */
        length += dir[a] * dir[a];
        along += rim[a] * dir[a];
    }
    if (triangle)
        return;
    float square = 0;
    for (int a = 0; a < 3; a++) {
        rim[a] -= along / length * dir[a];
        square += rim[a] * rim[a];
    }
    for (int a = 0; a < 3; a++)
        rim[a] /= square > 0 ? sqrtf(square) : 1;
}

/* A ray close to the rim of a primitive, mostly (nearly) parallel to an axis, so that it runs along faces of cells. */
static truth_ray rim_ray(test_random *r, bool triangle, const float middle[3])
{
    truth_ray ray = {.t_min = random_below(r, 4) ? 0 : -10, .t_max = random_below(r, 3) ? INFINITY : 1};
    const uint32_t axis = random_below(r, 3), how = random_below(r, 4);
    float rim[3];
    for (int a = 0; a < 3; a++)
        ray.dir[a] = how == 0 || a == (int)axis ? random_float(r, -3, 3) : how == 1 ? 0 : random_float(r, -0.1f, 0.1f);
    rim_of(r, ray.dir, triangle, rim);
    const float share = 1 - random_log(r, 1e-4f, 0.1f);
    for (int a = 0; a < 3; a++)
        ray.org[a] = middle[a] + rim[a] * SIZE * share - ray.dir[a];
    return ray;
}

static cgt_scene *commit(cgt_context *context, const hard_scene *s, const test_scene_options *options)
{
    cgt_scene *scene;
    if (hard_commit_with(context, s, SCENE_OPTIONS(options), &scene) != CGT_OK)
        fail_msg("%s", context_message(context));
    return scene;
}

/* Traces calls of `bundle` neighbouring rays; 1: each ray has its own call. */
static void check_rays(const cgt_scene *loose, const truth_ray *ray, const full_hit *expected, uint32_t bundle,
                       const test_scene_options *options)
{
    static full_hit hit[RAYS];
    static uint8_t occluded[RAYS];
    for (uint32_t i = 0; i < RAYS; i += bundle) {
        const uint32_t count = RAYS - i < bundle ? RAYS - i : bundle;
        const cgt_rays rays = ray_array(ray + i, count);
        assert_int_equal(trace_array(loose, ray + i, count, hit + i, NULL), CGT_OK);
        assert_int_equal(cgt_occluded_rays(loose, &rays, occluded + i, NULL), CGT_OK);
    }
    for (uint32_t i = 0; i < RAYS; i++)
        if (memcmp(&hit[i], &expected[i], sizeof expected[i]) != 0 ||
            occluded[i] != (expected[i].primitive != CGT_INVALID_ID))
            fail_msg("%u x %u x %u cells, bundles of %u: ray %u, org %a %a %a, dir %a %a %a: primitive %d at %a, any "
                     "hit %d; in one cell %d at %a",
                     options->resolution[0], options->resolution[1], options->resolution[2], bundle, i,
                     (double)ray[i].org[0], (double)ray[i].org[1], (double)ray[i].org[2], (double)ray[i].dir[0],
                     (double)ray[i].dir[1], (double)ray[i].dir[2], (int)hit[i].primitive, (double)hit[i].t, occluded[i],
                     (int)expected[i].primitive, (double)expected[i].t);
}

/* Rays of one bundle share their origin, their direction or their end point. */
static void bundle_rays(test_random *r, truth_ray *ray, uint32_t bundle)
{
    for (uint32_t i = 0; i < RAYS; i += bundle) {
        const uint32_t how = random_below(r, 3);
        for (uint32_t k = i + 1; k < i + bundle && k < RAYS; k++)
            for (int a = 0; a < 3; a++) {
                const float off = random_float(r, -0.01f, 0.01f);
                ray[k] = k == i + 1 && a == 0 ? ray[i] : ray[k];
                ray[k].org[a] = how == 0 ? ray[i].org[a] : ray[i].org[a] + off;
                ray[k].dir[a] = how == 0   ? ray[i].dir[a] + off
                                : how == 1 ? ray[i].dir[a]
                                           : ray[i].org[a] + ray[i].dir[a] - ray[k].org[a];
            }
    }
}

TEST(rays_find_primitives_beyond_their_cells)
{
    static const uint32_t resolution[][3] = {{0, 0, 0}, {9, 7, 5}, {40, 40, 40}, {1, 1, 64}};
    static const uint32_t bundles[] = {1, 2, 4, 16, 64};
    static float middle[PRIMITIVES][3];
    static truth_ray ray[RAYS];
    static full_hit expected[RAYS];
    uint64_t hits = 0, rays = 0;
    for (uint32_t round = 0; round < 2 * test_scaled(10); round++) {
        test_random r = random_make(900 + round);
        hard_scene s = make_scene(&r, round % 2, middle);
        FOR_EACH_VARIANT(variant)
        {
            cgt_context *context = context_make(1, variant);
            test_scene_options o = {.structure = CGT_STRUCTURE_LOOSE_GRID};
            memcpy(o.resolution, resolution[round / 2 % TEST_COUNT(resolution)], sizeof o.resolution);
            const uint32_t bundle = bundles[random_below(&r, TEST_COUNT(bundles))];
            cgt_scene *cell = commit(context, &s, &one_cell.scene), *loose = commit(context, &s, &o);
            for (uint32_t i = 0; i < RAYS; i++)
                ray[i] = rim_ray(&r, round % 2, middle[random_below(&r, PRIMITIVES)]);
            for (uint32_t way = 0; way < 2; way++) { /* one by one, then in bundles */
                if (way)
                    bundle_rays(&r, ray, bundle);
                assert_int_equal(trace_array(cell, ray, RAYS, expected, NULL), CGT_OK);
                check_rays(loose, ray, expected, way ? bundle : 1, &o);
                for (uint32_t i = 0; i < RAYS; i++)
                    hits += expected[i].primitive != CGT_INVALID_ID;
                rays += RAYS;
            }
            cgt_scene_release(cell);
            cgt_scene_release(loose);
            cgt_context_release(context);
        }
        hard_scene_free(&s);
    }
    print_message("%llu of %llu rays hit\n", (unsigned long long)hits, (unsigned long long)rays);
    assert_true(hits > rays / 4);
}

SEEDED_SUITE("test_loose_grid_rays", NULL, NULL)
