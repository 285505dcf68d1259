/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Degenerate input: NaN, infinities, the largest and the smallest floats; copies; both kinds of primitives in several
 * geometries at equal distances. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "hard_cases/hard_cases.h"

/* ---- invalid numbers ---- */

static float garbage(hard_scene *s)
{
    static const float odd[] = {NAN,     INFINITY,  -INFINITY,  FLT_MAX, -FLT_MAX, 1e30f,
                                -1e-30f, 0x1p-149f, -0x1p-140f, 0.f,     -0.f,     1.f};
    const uint32_t how = random_below(&s->random, 3);
    return how == 0 ? random_any_float(&s->random) : odd[random_below(&s->random, sizeof odd / sizeof odd[0])];
}

static void spoil(hard_scene *s, float (*bad)(hard_scene *s), float *number, uint32_t count)
{
    const uint32_t which = random_below(&s->random, count);
    number[which] = bad(s);
}

/* Valid primitives among invalid ones, which must not affect the bounds. */
static void add_garbage(hard_scene *s, float (*bad)(hard_scene *s))
{
    for (int i = 0; i < 60; i++) {
        float sphere[4] = {0, 0, 0, 0.2f};
        for (int a = 0; a < 3; a++)
            sphere[a] = random_float(&s->random, -1, 1);
        if (i % 2)
            spoil(s, bad, sphere, 4);
        hard_raw_sphere(s, sphere);
    }
    for (int i = 0; i < 60; i++) {
        float v[3][3];
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                v[k][a] = random_float(&s->random, -1, 1);
        if (i % 2)
            spoil(s, bad, v[0], 9);
        hard_raw_triangle(s, (const float(*)[3])v);
    }
}

static void add_garbage_rays(hard_scene *s, float (*bad)(hard_scene *s))
{
    while (hard_wants_ray(s)) {
        truth_ray ray = {.t_min = 0, .t_max = INFINITY};
        const uint32_t spoilt = random_below(&s->random, 4);
        for (int a = 0; a < 3; a++) {
            ray.org[a] = random_float(&s->random, -2, 2);
            ray.dir[a] = random_float(&s->random, -1, 1) - ray.org[a];
        }
        if (spoilt == 1)
            spoil(s, bad, ray.org, 3);
        if (spoilt == 2)
            spoil(s, bad, ray.dir, 3);
        if (spoilt == 3)
            spoil(s, bad, random_below(&s->random, 2) ? &ray.t_min : &ray.t_max, 1);
        if (random_below(&s->random, 32) == 0)
            memset(ray.dir, 0, sizeof ray.dir);
        hard_raw_ray(s, &ray);
    }
}

static void spoilt(hard_scene *s)
{
    add_garbage(s, garbage);
    /* one primitive for each reason to skip, independent of the numbers above */
    hard_raw_triangle(s, (const float[3][3]){{0, 0, 0}, {1, NAN, 0}, {0, 1, 0}});
    hard_raw_sphere(s, (const float[4]){0, 0, -INFINITY, 1});
    hard_raw_sphere(s, (const float[4]){0, 0, 0, -1});
    add_garbage_rays(s, garbage);
}

/* Finite numbers of any size: no primitive is skipped, and their products overflow float. */
static float any_finite(hard_scene *s)
{
    for (;;) {
        const float f = random_any_float(&s->random);
        if (isfinite(f))
            return f;
    }
}

static float any_size(hard_scene *s) { return random_below(&s->random, 2) ? any_finite(s) : fabsf(any_finite(s)); }

static void any_numbers(hard_scene *s)
{
    add_garbage(s, any_size);
    add_garbage_rays(s, any_size);
}

/* All coordinates are denormal; half of the time so are the directions. */
static float denormal(hard_scene *s) { return (float)((int)random_below(&s->random, 2001) - 1000) * 0x1p-149f; }

static void denormals(hard_scene *s)
{
    for (int i = 0; i < 40; i++) {
        float sphere[4];
        for (int a = 0; a < 4; a++)
            sphere[a] = denormal(s);
        sphere[3] = fabsf(sphere[3]) / 4;
        hard_raw_sphere(s, sphere);
    }
    for (int i = 0; i < 40; i++) {
        float v[3][3];
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                v[k][a] = denormal(s);
        hard_raw_triangle(s, (const float(*)[3])v);
    }
    while (hard_wants_ray(s)) {
        truth_ray ray = {.t_min = 0, .t_max = INFINITY};
        const float length = random_below(&s->random, 2) ? 1 : 0x1p100f;
        for (int a = 0; a < 3; a++) {
            ray.org[a] = 2 * denormal(s);
            ray.dir[a] = (denormal(s) - ray.org[a]) * length;
        }
        if (ray.dir[0] == 0 && ray.dir[1] == 0 && ray.dir[2] == 0)
            ray.dir[1] = 1;
        hard_raw_ray(s, &ray);
    }
}

/* Two huge coordinates and a small one in each point: rounding chooses the main axis. */
static void huge(hard_scene *s)
{
    for (int i = 0; i < 60; i++) {
        float v[3][3], sphere[4];
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                v[k][a] = random_float(&s->random, -1, 1) * (a == i % 3 ? 1 : 0x1p100f);
        hard_raw_triangle(s, (const float(*)[3])v);
        for (int a = 0; a < 4; a++)
            sphere[a] = fabsf(random_float(&s->random, 0.1f, 1)) * 0x1p99f;
        if (i == 59) {
            hard_new_geometry(s);
            hard_raw_sphere(s, sphere);
        }
    }
    while (hard_wants_ray(s)) {
        float v[3][3], org[3], target[3];
        if (!hard_any_triangle(s, v))
            return;
        for (int a = 0; a < 3; a++) {
            org[a] = random_float(&s->random, -1, 1);
            org[a] *= random_below(&s->random, 2) ? 0x1p100f : 1;
            target[a] = v[0][a] / 2 + v[1][a] / 4 + v[2][a] / 4;
        }
        hard_aim(s, org, target, random_below(&s->random, 2) ? 1 : 0x1p-100f);
    }
}

/* ---- copies and ties ---- */

static void copied_spheres(hard_scene *s)
{
    for (int i = 0; i < 100; i++) {
        double c[3];
        hard_point(s, -1, 1, c);
        const double r = hard_real(s, 0.05, 0.3);
        if (i == 50)
            hard_new_geometry(s);
        hard_sphere(s, c, r);
        hard_sphere(s, c, r);
    }
    while (hard_wants_ray(s)) {
        double from[3], to[3];
        float org[3], target[3];
        hard_point(s, -2, 2, from);
        hard_point(s, -1, 1, to);
        hard_put(s, from, org);
        hard_put(s, to, target);
        hard_aim(s, org, target, hard_length(s));
    }
}

/* Triangles, spheres, triangles, spheres: lattice planes tangent to lattice spheres, hit where they touch. */
static void mixed(hard_scene *s)
{
    for (int part = 0; part < 4; part++) {
        hard_new_geometry(s);
        for (int i = 0; i < 40; i++) {
            double v[3][3], c[3];
            for (int k = 0; k < 3; k++) {
                hard_lattice_point(s, -3, 3, 1, v[k]);
                v[k][i % 3] = (i & 1) ? 1 : -1;
            }
            hard_lattice_point(s, -2, 2, 1, c);
            if (part % 2)
                hard_sphere(s, c, 1);
            else
                hard_triangle(s, (const double(*)[3])v);
        }
    }
    while (hard_wants_ray(s)) {
        const int axis = (int)random_below(&s->random, 3);
        double from[3], to[3];
        float org[3], target[3];
        hard_lattice_point(s, -3, 3, 1, to);
        memcpy(from, to, sizeof from);
        from[axis] += (int)random_below(&s->random, 9) - 4;
        if (random_below(&s->random, 2))
            hard_lattice_point(s, -6, 6, 1, from);
        hard_put(s, from, org);
        hard_put(s, to, target);
        hard_aim(s, org, target, 1);
    }
}

#define GARBAGE "NaN/Inf/huge/denormal"

static const hard_case cases[] = {
    {GARBAGE, "every second primitive and ray spoilt", spoilt, HARD_HERE, HARD_SKIPPED | HARD_INVALID | HARD_MISSES,
     NULL},
    {GARBAGE, "finite numbers of any size", any_numbers, HARD_HERE, HARD_DOUBLE | HARD_MISSES, NULL},
    {GARBAGE, "denormal coordinates", denormals, HARD_HERE, HARD_DOUBLE | HARD_MISSES, NULL},
    {GARBAGE, "coordinates of 2^100", huge, HARD_HERE, HARD_DOUBLE, NULL},
    {"coplanar duplicates", "every second sphere a copy", copied_spheres, HARD_HERE, HARD_DOUBLE, NULL},
    {"coplanar duplicates", "spheres that touch triangles, four geometries", mixed, HARD_HERE, HARD_DOUBLE | HARD_EXACT,
     NULL},
    {"coplanar duplicates", "spheres that touch triangles, four geometries, 1e6", mixed, HARD_LARGE,
     HARD_DOUBLE | HARD_EXACT, NULL},
};
const hard_table hard_cases_input = HARD_TABLE(cases);
