/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays that are hard on any scene: along axes with zeros of either sign, from surfaces, with range ends at hits, of any
 * length, in packets of every kind. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "hard_cases/hard_cases.h"

/* Lattice spheres and a lattice cube around them, on a grid of 4x4x4 cells. */
static void lattice_scene(hard_scene *s)
{
    for (int i = 0; i < 40; i++) {
        double c[3];
        hard_lattice_point(s, -3, 3, 0.25, c);
        hard_sphere(s, c, 0.125 * (1 + (int)random_below(&s->random, 2)));
    }
    hard_closed_mesh(s, CLOSED_CUBE, 2);
    for (int a = 0; a < 3; a++)
        s->resolution[a] = 4;
}

/* ---- directions ---- */

/* All 26 axes and diagonals; zeros are +0, -0 or denormal; origins on faces, edges and corners of cells and cube. */
static void axes(hard_scene *s)
{
    static const float zero[] = {0.f, -0.f, 0x1p-149f, -0x1p-149f, 0x1p-127f, -0x1p-140f};
    lattice_scene(s);
    for (uint32_t n = 0; hard_wants_ray(s); n++) {
        const uint32_t way = n % 27 == 13 ? 0 : n % 27;
        const int sign[3] = {(int)(way % 3) - 1, (int)(way / 3 % 3) - 1, (int)(way / 9) - 1};
        double org[3];
        float dir[3];
        hard_lattice_point(s, -6, 6, random_below(&s->random, 2) ? 0.25 : 0.5, org);
        for (int a = 0; a < 3; a++)
            dir[a] = sign[a] ? (float)sign[a] : zero[random_below(&s->random, sizeof zero / sizeof zero[0])];
        hard_ray(s, org, dir);
    }
}

/* ---- ends of the range, secondary rays ---- */

static void soup(hard_scene *s, int triangles, int spheres)
{
    for (int i = 0; i < triangles; i++) {
        double v[3][3], c[3];
        hard_point(s, -1, 1, c);
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                v[k][a] = c[a] + hard_real(s, -0.4, 0.4);
        hard_triangle(s, (const double(*)[3])v);
    }
    for (int i = 0; i < spheres; i++) {
        double c[3];
        hard_point(s, -1, 1, c);
        hard_sphere(s, c, hard_real(s, 0.02, 0.3));
    }
}

static void random_ray(hard_scene *s)
{
    double from[3], to[3];
    float org[3], target[3];
    hard_point(s, -2, 2, from);
    hard_point(s, -1, 1, to);
    hard_put(s, from, org);
    hard_put(s, to, target);
    hard_aim(s, org, target, hard_length(s));
}

static void random_scene(hard_scene *s)
{
    soup(s, 60, 60);
    while (hard_wants_ray(s))
        random_ray(s);
}

static void end_at_hit(hard_scene *s, uint32_t i, const hard_found *found)
{
    truth_ray *ray = &s->ray[i];
    if (!isfinite(found->t))
        return;
    switch (i % 6) {
    case 0: ray->t_max = found->t; break;
    case 1: ray->t_max = nextafterf(found->t, -INFINITY); break;
    case 2: ray->t_min = found->t; break;
    case 3: ray->t_min = nextafterf(found->t, INFINITY); break;
    case 4: ray->t_min = ray->t_max = found->t; break;
    default: ray->t_min = -found->t; ray->t_max = nextafterf(found->t, INFINITY);
    }
}

/* From the hit, rounded to float: backwards, onwards, along the surface or in a random direction. */
static void leave_hit(hard_scene *s, uint32_t i, const hard_found *found)
{
    truth_ray *ray = &s->ray[i];
    double d[3];
    if (!isfinite(found->t))
        return;
    hard_direction(s, d);
    float along = 0;
    for (int a = 0; a < 3; a++) {
        ray->org[a] += found->t * ray->dir[a];
        along += (float)d[a] * found->normal[a];
    }
    for (int a = 0; a < 3; a++) {
        if (i % 4 == 0)
            ray->dir[a] = -ray->dir[a];
        if (i % 4 == 1)
            ray->dir[a] = (float)d[a];
        if (i % 4 == 2)
            ray->dir[a] = (float)d[a] - along * found->normal[a];
    }
    if (ray->dir[0] == 0 && ray->dir[1] == 0 && ray->dir[2] == 0)
        ray->dir[2] = 1;
}

/* ---- packets ---- */

/* Packets like a camera's: 64 adjacent rays of a common origin. Openings range from a ten-thousandth of a degree to far
 * beyond 180 degrees, include zero width and straddle the borders between main axes; the scene is in front, around or
 * behind. */
static void packets(hard_scene *s)
{
    static const float opening[] = {0, 1e-6f, 1e-2f, 0.5f, 4, 1e3f};
    const float scale = (float)s->place.scale;
    soup(s, 80, 80);
    while (hard_wants_ray(s)) {
        const float width = opening[random_below(&s->random, 6)];
        const bool diagonal = random_below(&s->random, 3) == 0;
        const bool aimed = random_below(&s->random, 4) != 0;
        double org[3], to[3], axis[3][3];
        hard_point(s, -2, 2, org);
        hard_point(s, -0.5, 0.5, to);
        for (int k = 0; k < 3; k++)
            hard_direction(s, axis[k]);
        for (int a = 0; a < 3; a++)
            axis[0][a] = diagonal ? (random_below(&s->random, 2) ? 1 : -1) : aimed ? to[a] - org[a] : axis[0][a];
        const uint32_t size = random_below(&s->random, 4) ? 64 : 1 + random_below(&s->random, 64);
        const bool ranged = random_below(&s->random, 4) == 0;
        for (uint32_t n = 0; n < size && hard_wants_ray(s); n++) {
            truth_ray ray = {.t_min = 0, .t_max = INFINITY};
            const float x = width * ((float)(n % 8) - 3.5f) / 8, y = width * ((float)(n / 8) - 3.5f) / 8;
            hard_put(s, org, ray.org);
            for (int a = 0; a < 3; a++)
                ray.dir[a] = (float)axis[0][a] + x * (float)axis[1][a] + y * (float)axis[2][a];
            if (ranged) {
                ray.t_min = random_float(&s->random, 0, 1) * scale;
                ray.t_max = ray.t_min + random_float(&s->random, -0.25f, 2) * scale;
            }
            hard_raw_ray(s, &ray);
        }
    }
}

/* ---- estimates ---- */

/* Components from 2^-60 to 2^60 in one ray, their fractions at the ends and at the breakpoints of the tables that
 * reciprocal estimates use. */
static void lengths(hard_scene *s)
{
    soup(s, 60, 60);
    while (hard_wants_ray(s)) {
        truth_ray ray = {.t_min = 0, .t_max = INFINITY};
        double org[3];
        float v[3][3];
        const float length = random_log(&s->random, 0x1p-60f, 0x1p60f);
        const bool free_direction = random_below(&s->random, 2);
        hard_point(s, -2, 2, org);
        if (!hard_any_triangle(s, v))
            return;
        hard_put(s, org, ray.org);
        for (int a = 0; a < 3; a++) {
            const uint32_t joint = random_below(&s->random, 257);
            const float fraction = nextafterf(1 + (float)joint / 256, random_below(&s->random, 2) ? 0.f : 4.f);
            const int exponent = (int)random_below(&s->random, 120) - 60;
            ray.dir[a] =
                free_direction ? ldexpf(fraction, exponent) : ((v[0][a] + v[1][a] + v[2][a]) / 3 - ray.org[a]) * length;
            if (free_direction && random_below(&s->random, 2))
                ray.dir[a] = -ray.dir[a];
        }
        hard_raw_ray(s, &ray);
    }
}

#define SIGNS "dir component +0, -0, tiny; 0*inf"
#define SECONDARY "hit at origin / secondary rays"
#define RANGE "hit at tmin / tmax"
#define FRUSTUM "frustum slice bounds and culling"
#define ESTIMATE "estimate ops"
#define LANES "scalar = SIMD"

static const hard_case cases[] = {
    {SIGNS, "26 directions", axes, HARD_HERE, HARD_DOUBLE | HARD_EXACT | HARD_MISSES, NULL},
    {SIGNS, "26 directions, 2^-50", axes, HARD_2M50, HARD_DOUBLE | HARD_EXACT | HARD_MISSES, NULL},
    {SIGNS, "26 directions, at (148376, 1234, -223423)", axes, HARD_FAR, HARD_DOUBLE | HARD_EXACT | HARD_MISSES, NULL},
    {SECONDARY, "from hits", random_scene, HARD_HERE, HARD_DOUBLE | HARD_FAST_FAILS, leave_hit},
    {SECONDARY, "from hits, 1e6", random_scene, HARD_LARGE, HARD_DOUBLE, leave_hit},
    {SECONDARY, "from hits, at (148376, 1234, -223423)", random_scene, HARD_FAR, HARD_DOUBLE, leave_hit},
    {RANGE, "ends at the found t and beside it", random_scene, HARD_HERE, HARD_DOUBLE | HARD_FAST_FAILS, end_at_hit},
    {RANGE, "ends at the found t and beside it, 2^50", random_scene, HARD_2P50, HARD_DOUBLE, end_at_hit},
    {FRUSTUM, "common origin, 0 to beyond 180 degrees", packets, HARD_HERE, HARD_SPLITS | HARD_MISSES, NULL},
    {FRUSTUM, "common origin, 0 to beyond 180 degrees, 2^-50", packets, HARD_2M50, HARD_MISSES, NULL},
    {ESTIMATE, "directions of any length", lengths, HARD_HERE, HARD_MISSES, NULL},
    {LANES, "random rays", random_scene, HARD_HERE, HARD_MISSES, NULL},
    {LANES, "random rays, at (148376, 1234, -223423)", random_scene, HARD_FAR, HARD_MISSES, NULL},
};
const hard_table hard_cases_rays = HARD_TABLE(cases);
