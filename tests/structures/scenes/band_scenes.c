/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Random numbers of all magnitudes that keep within the range of float. */
#include "structures/scenes/band_scenes.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* A size between powers of two, not only powers. */
static float size_between(test_random *r, int least, int most)
{
    const int exponent = least + (int)random_below(r, (uint32_t)(most - least + 1));
    return ldexpf(random_below(r, 2) ? 1 : random_float(r, 0.5f, 1), exponent);
}

static float clamp(double v) { return v > (double)FLT_MAX ? FLT_MAX : v < -(double)FLT_MAX ? -FLT_MAX : (float)v; }

static float choose_size(test_random *r, band_kind kind, float common, uint32_t i)
{
    if (kind == BAND_ONE_SCALE || kind == BAND_DENORMAL)
        return common;
    if (kind == BAND_MIXED)
        return size_between(r, -147, 126);
    return i % 8 ? 1 : size_between(r, 40, 126);
}

static void make_point(test_random *r, band_kind kind, float size, float p[3])
{
    for (int a = 0; a < 3; a++) {
        p[a] = clamp((double)size * (double)random_float(r, -1, 1));
        if (kind == BAND_FLAT && size > 2 && random_below(r, 3) == 0)
            p[a] = random_below(r, 2) ? 0 : random_float(r, -1e-12f, 1e-12f);
    }
}

band_scene band_scene_make(test_random *r, band_kind kind, uint32_t spheres, uint32_t triangles)
{
    band_scene s = {.spheres = spheres,
                    .triangles = triangles,
                    .sphere = calloc(spheres + 1, sizeof *s.sphere),
                    .vertex = calloc(3 * triangles + 1, sizeof *s.vertex),
                    .size = calloc(spheres + triangles + 1, sizeof(float))};
    const float common =
        kind != BAND_DENORMAL ? size_between(r, -147, 126) : size_between(r, random_below(r, 2) ? -147 : -133, -124);
    const double radius = 0.5 / cbrt(1.0 + spheres);
    assert_non_null(s.sphere);
    assert_non_null(s.vertex);
    assert_non_null(s.size);
    for (uint32_t i = 0; i < spheres; i++) {
        const float size = s.size[i] = choose_size(r, kind, common, i);
        make_point(r, kind, size, s.sphere[i]);
        s.sphere[i][3] = clamp((double)size * radius * (double)random_float(r, 0.1f, 1));
    }
    for (uint32_t i = 0; i < triangles; i++) {
        const float size = s.size[spheres + i] = choose_size(r, kind, common, i);
        make_point(r, kind, size, s.vertex[3 * i]);
        for (int k = 1; k < 3; k++)
            for (int a = 0; a < 3; a++)
                s.vertex[3 * i + k][a] =
                    clamp((double)s.vertex[3 * i][a] + (double)size * radius * (double)random_float(r, -2, 2));
    }
    return s;
}

void band_scene_free(band_scene *s)
{
    free(s->sphere);
    free(s->vertex);
    free(s->size);
}

static void add_geometries(cgt_scene *scene, const band_scene *s)
{
    const uint32_t half = s->triangles / 2;
    const cgt_spheres spheres = spheres_of((const float(*)[4])s->sphere, s->spheres);
    const cgt_triangles first = {.count = half, .vertices = cgt_floats(s->vertex[0], 0), .vertex_count = 3 * half};
    const cgt_triangles second = {.count = s->triangles - half,
                                  .vertices = cgt_floats(s->vertex[3 * half], 0),
                                  .vertex_count = 3 * (s->triangles - half),
                                  .mask = 1};
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &first), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &second), CGT_OK);
}

cgt_scene *band_scene_commit(cgt_context *context, const test_scene_options *options, const band_scene *s)
{
    cgt_scene *scene = NULL;
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(options), &scene), CGT_OK);
    add_geometries(scene, s);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

static const float *any_point(test_random *r, const band_scene *s, float *size)
{
    const uint32_t i = random_below(r, s->spheres + s->triangles);
    *size = s->size[i];
    return i < s->spheres ? s->sphere[i] : s->vertex[3 * (i - s->spheres)];
}

static void near_point(test_random *r, const band_scene *s, float away, float p[3])
{
    float size;
    const float *at = any_point(r, s, &size);
    for (int a = 0; a < 3; a++)
        p[a] = clamp((double)at[a] + (double)size * (double)random_float(r, -away, away));
}

/* From org towards a point, with a length that is the distance's, or any. */
static void make_direction(test_random *r, const band_scene *s, const float org[3], float dir[3])
{
    float to[3], longest = 0;
    double way[3], largest = 0;
    near_point(r, s, random_below(r, 2) ? 0.1f : 1, to);
    for (int a = 0; a < 3; a++) {
        way[a] = (double)to[a] - (double)org[a];
        largest = fmax(largest, fabs(way[a]));
    }
    const double length = random_below(r, 3)   ? 1
                          : random_below(r, 2) ? ldexp(1, (int)random_below(r, 240) - 130) / fmax(largest, 1e-300)
                                               : 1 / fmax(largest, 1e-300);
    for (int a = 0; a < 3; a++) {
        dir[a] = clamp(way[a] * length);
        longest = fmaxf(longest, fabsf(dir[a]));
    }
    if (longest == 0)
        dir[random_below(r, 3)] = size_between(r, -149, 120);
}

void band_rays_make(test_random *r, const band_scene *s, band_rays *q)
{
    for (uint32_t i = 0; i < BAND_RAYS; i++) {
        float org[3], dir[3];
        near_point(r, s, random_below(r, 3) ? 2 : 0, org);
        make_direction(r, s, org, dir);
        for (int a = 0; a < 3; a++) {
            q->org[a][i] = org[a];
            q->dir[a][i] = dir[a];
        }
        q->t_min[i] = 0;
        q->t_max[i] = INFINITY;
        if (random_below(r, 4) == 0)
            q->t_min[i] = random_below(r, 2) ? size_between(r, -149, 20) : -size_between(r, -149, 60);
        if (random_below(r, 4) == 0)
            q->t_max[i] = random_below(r, 4) ? size_between(r, -40, 127) : 0;
        q->mask[i] = random_below(r, 3) ? 0 : 2;
        q->skip_geometry[i] = random_below(r, 3);
        q->skip_primitive[i] = random_below(r, 2) ? CGT_INVALID_ID : random_below(r, s->spheres + s->triangles / 2);
    }
}

cgt_rays band_rays_all(const band_rays *q)
{
    return (cgt_rays){.count = BAND_RAYS,
                      .org = {q->org[0], q->org[1], q->org[2]},
                      .dir = {q->dir[0], q->dir[1], q->dir[2]},
                      .t_min = q->t_min,
                      .t_max = q->t_max,
                      .mask = q->mask,
                      .skip_primitive = q->skip_primitive,
                      .skip_geometry = q->skip_geometry};
}
