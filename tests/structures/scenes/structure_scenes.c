/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes for which every structure must find the same hits. */
#include "structures/scenes/structure_scenes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- scenes ---- */

static void take_cloud(structure_scene *s, cloud_kind kind, uint32_t count)
{
    cloud c = cloud_make(&s->scene.random, kind, count);
    for (uint32_t i = 0; i < count; i++)
        hard_raw_sphere(&s->scene, c.sphere[i]);
    s->where = c;
    s->where.sphere = NULL;
    cloud_free(&c);
}

/* In the last geometry, or in a new one. */
static void any_sphere(hard_scene *s)
{
    double center[3];
    hard_point(s, -1, 1, center);
    hard_sphere(s, center, hard_real(s, 0.02, 0.3));
}

static void any_triangle(hard_scene *s)
{
    double center[3], v[3][3];
    hard_point(s, -1, 1, center);
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            v[k][a] = center[a] + hard_real(s, -0.3, 0.3);
    hard_triangle(s, (const double(*)[3])v);
}

static void coincide(hard_scene *s, uint32_t copies)
{
    float vertex[3][3], sphere[4];
    any_triangle(s);
    assert_true(hard_any_triangle(s, vertex));
    for (uint32_t i = 0; i < copies; i++)
        hard_raw_triangle(s, (const float(*)[3])vertex);
    any_sphere(s);
    memcpy(sphere, s->geometry[s->geometries - 1].sphere[0], sizeof sphere);
    for (uint32_t i = 0; i < copies; i++)
        hard_raw_sphere(s, sphere);
}

/* Primitives that no ray can hit: NaNs and infinities, a negative radius, triangles without an area. */
static void spoilt(structure_scene *s, uint32_t number)
{
    float vertex[3][3] = {{0.25f, 0.5f, -0.5f}, {0.5f, -0.25f, 0.125f}, {-0.5f, 0.5f, 0.5f}};
    float sphere[4] = {0.25f, -0.5f, 0.125f, 0.5f};
    s->skipped++;
    switch (number % 5) {
    case 0: sphere[number % 4] = NAN; break;
    case 1: sphere[number % 4] = -INFINITY; break;
    case 2: sphere[3] = -0.25f; break;
    case 3: vertex[number % 3][number / 3 % 3] = number & 8 ? NAN : INFINITY; break;
    default: memcpy(vertex[1], vertex[number % 2 * 2], sizeof vertex[1]); break;
    }
    if (number % 5 < 3)
        hard_raw_sphere(&s->scene, sphere);
    else
        hard_raw_triangle(&s->scene, (const float(*)[3])vertex);
}

static void skipped(structure_scene *s, bool all)
{
    for (uint32_t g = 0; g < 3; g++) {
        hard_new_geometry(&s->scene);
        for (uint32_t i = 0; i < 40; i++) {
            const uint32_t number = g == 1 ? 3 + i % 2 + 5 * i : i % 3 + 5 * i; /* one kind per geometry */
            if (!all && random_below(&s->scene.random, 3) == 0)
                (g == 1 ? any_triangle : any_sphere)(&s->scene);
            else
                spoilt(s, number);
        }
        hard_new_geometry(&s->scene); /* stays empty, or receives the next primitives */
    }
}

static void fill(structure_scene *s, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        (i < count / 2 ? any_triangle : any_sphere)(&s->scene);
}

const char *structure_name(structure_kind kind)
{
    static const char *const name[] = {"coincident",   "skipped", "all skipped", "none", "one sphere",
                                       "one triangle", "tiny",    "beyond 2^55", "large"};
    return kind < STRUCTURE_CLOUD        ? soup_name((soup_kind)kind)
           : kind < STRUCTURE_COINCIDENT ? cloud_name((cloud_kind)(kind - STRUCTURE_CLOUD))
                                         : name[kind - STRUCTURE_COINCIDENT];
}

structure_scene structure_scene_make(structure_kind kind, uint64_t stream)
{
    structure_scene s = {.where = {.reach = 1}, .scene = {.place = {.scale = 1}, .random = random_make(stream)}};
    const uint32_t count = 20 + random_below(&s.scene.random, 600);
    if (kind < STRUCTURE_CLOUD)
        s.scene = soup_make((soup_kind)kind, stream, count);
    else if (kind < STRUCTURE_COINCIDENT)
        take_cloud(&s, (cloud_kind)(kind - STRUCTURE_CLOUD), count);
    else if (kind == STRUCTURE_COINCIDENT)
        coincide(&s.scene, count / 8);
    else if (kind == STRUCTURE_SKIPPED || kind == STRUCTURE_ALL_SKIPPED)
        skipped(&s, kind == STRUCTURE_ALL_SKIPPED);
    else if (kind == STRUCTURE_ONE_SPHERE)
        any_sphere(&s.scene);
    else if (kind == STRUCTURE_ONE_TRIANGLE)
        any_triangle(&s.scene);
    else if (kind == STRUCTURE_TINY || kind == STRUCTURE_BEYOND) {
        s.scene.place.scale = kind == STRUCTURE_TINY ? 0x1p-60 : 0x1p57;
        s.where.reach = (float)s.scene.place.scale;
        fill(&s, 60);
    } else if (kind == STRUCTURE_LARGE)
        s.scene = soup_make(SOUP_MIXED, stream, 6000);
    snprintf(s.name, sizeof s.name, "%s, %u primitives", structure_name(kind), hard_scene_primitives(&s.scene));
    assert_false(s.scene.failed);
    return s;
}

void structure_scene_free(structure_scene *s) { hard_scene_free(&s->scene); }

/* ---- rays ---- */

/* From a lattice point, in sixteenths of the scene's size, along an axis or a diagonal. */
static truth_ray lattice_ray(structure_scene *s)
{
    test_random *r = &s->scene.random;
    truth_ray ray = {.t_max = INFINITY};
    const float unit = s->where.reach / 16;
    for (int a = 0; a < 3; a++) {
        ray.org[a] = s->where.middle[a] + unit * (float)((int)random_below(r, 49) - 24);
        ray.dir[a] = (float)((int)random_below(r, 3) - 1);
    }
    if (ray.dir[0] == 0 && ray.dir[1] == 0 && ray.dir[2] == 0)
        ray.dir[random_below(r, 3)] = random_below(r, 2) ? 1 : -1;
    return ray;
}

void structure_rays(structure_scene *s, uint32_t count)
{
    truth_ray first = {.t_max = INFINITY};
    s->scene.rays = 0;
    s->scene.wanted = count;
    for (uint32_t i = 0; hard_wants_ray(&s->scene); i++) {
        truth_ray ray = i % 3 == 2 ? lattice_ray(s) : ray_random(&s->scene.random, &s->where);
        if (i / 64 % 3 == 1) /* from one point in all directions */
            memcpy(ray.org, first.org, sizeof ray.org);
        else
            first = ray;
        hard_raw_ray(&s->scene, &ray);
    }
    assert_false(s->scene.failed);
    assert_int_equal(s->scene.rays, count);
}
