/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres on which the quadratic loses its digits: far away, huge and close, grazed, tangent, of radius 0. Haines et
 * al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019, ch. 7. */
#include <math.h>
#include <string.h>

#include "hard_cases/hard_cases.h"

/* A target at distance `reach` from the line through `org` and the centre, in the plane perpendicular to it that
 * contains the centre. */
static void offset_target(hard_scene *s, const double org[3], const double center[3], double reach, double target[3])
{
    double d[3], c[3], cc = 0, dc = 0, dd = 0;
    hard_direction(s, d);
    for (int a = 0; a < 3; a++) {
        c[a] = center[a] - org[a];
        cc += c[a] * c[a];
        dc += c[a] * d[a];
    }
    for (int a = 0; a < 3; a++) {
        d[a] -= cc > 0 ? dc / cc * c[a] : 0;
        dd += d[a] * d[a];
    }
    for (int a = 0; a < 3; a++)
        target[a] = center[a] + (dd > 0 ? reach * d[a] / sqrt(dd) : 0);
}

static void aim_at(hard_scene *s, const double from[3], const double to[3])
{
    float org[3], target[3];
    hard_put(s, from, org);
    hard_put(s, to, target);
    hard_aim(s, org, target, hard_length(s));
}

/* Distance from the centre, measured in the plane through it, at which a line from `distance` is tangent to the unit
 * sphere. */
static double outline(double distance) { return distance > 1.0001 ? 1 / sqrt(1 - 1 / (distance * distance)) : 1; }

static void spheres_about(hard_scene *s, int count, double reach, double r)
{
    for (int i = 0; i < count; i++) {
        double c[3];
        hard_point(s, -reach, reach, c);
        hard_sphere(s, c, r);
    }
}

/* From 1e1 to 1e6 radii away, aimed within 1.02 r of the centre or, to within rounding, at the outline. */
static void from_afar(hard_scene *s, bool tangent)
{
    spheres_about(s, 24, 20, 1);
    while (hard_wants_ray(s)) {
        const hard_geometry *g = &s->geometry[0];
        const double distance = (double)random_log(&s->random, 1e1f, 1e6f);
        double org[3], center[3], target[3];
        const float *sphere = g->sphere[random_below(&s->random, g->spheres)];
        for (int a = 0; a < 3; a++)
            center[a] = (sphere[a] - s->place.offset[a]) / s->place.scale;
        hard_direction(s, org);
        for (int a = 0; a < 3; a++)
            org[a] = center[a] + distance * org[a];
        const double low = random_below(&s->random, 2) ? 0.98 : 0;
        const double reach = tangent ? outline(distance) * (1 + 1e-7 * hard_real(s, -1, 1)) : hard_real(s, low, 1.02);
        offset_target(s, org, center, reach, target);
        aim_at(s, org, target);
    }
}

static void far_spheres(hard_scene *s) { from_afar(s, false); }
static void tangent_far(hard_scene *s) { from_afar(s, true); }

/* Spheres of radius 1e4 that fill half of the view, the origin a tenth above, on or below the surface. */
static void huge_spheres(hard_scene *s)
{
    const double r = 1e4;
    hard_sphere(s, (const double[3]){0, -r, 0}, r);
    hard_sphere(s, (const double[3]){0, r + 2, 0}, r);
    spheres_about(s, 12, 1, 0.05);
    while (hard_wants_ray(s)) {
        double org[3], target[3];
        hard_point(s, -1, 1, org);
        const uint32_t how = random_below(&s->random, 4);
        const double height = how == 0 ? 0 : how == 1 ? -0.1 : how == 2 ? 1e-4 : 0.1;
        org[1] = sqrt(r * r - org[0] * org[0] - org[2] * org[2]) - r + height;
        const double horizon = 2 * sqrt(2 * r * fmax(height, 1e-3));
        target[0] = org[0] + hard_real(s, -1, 1) * horizon;
        target[2] = org[2] + hard_real(s, -1, 1) * horizon;
        target[1] = org[1] - height * hard_real(s, 0, 4);
        aim_at(s, org, target);
    }
}

/* Grazing rays: at the outline of medium-sized spheres, to within a few parts in 1e7. */
static void grazing(hard_scene *s)
{
    spheres_about(s, 48, 2, 0.3);
    while (hard_wants_ray(s)) {
        const hard_geometry *g = &s->geometry[0];
        const float *sphere = g->sphere[random_below(&s->random, g->spheres)];
        double org[3], center[3], target[3];
        const double distance = hard_real(s, 1.001, 12);
        hard_direction(s, org);
        for (int a = 0; a < 3; a++) {
            center[a] = (sphere[a] - s->place.offset[a]) / s->place.scale;
            org[a] = center[a] + 0.3 * distance * org[a];
        }
        offset_target(s, org, center, 0.3 * outline(distance) * (1 + 3e-7 * hard_real(s, -1, 1)), target);
        aim_at(s, org, target);
    }
}

/* Lattice spheres with rays along the axes that touch them in exactly one point, pass through the touching points of
 * two, or begin on the surface. */
static void touched(hard_scene *s)
{
    for (int i = 0; i < 64; i++) {
        double c[3];
        hard_lattice_point(s, -4, 4, 0.5, c);
        hard_sphere(s, c, 0.25 * (1 + (int)random_below(&s->random, 4)));
    }
    while (hard_wants_ray(s)) {
        const hard_geometry *g = &s->geometry[0];
        const float *sphere = g->sphere[random_below(&s->random, g->spheres)];
        const int axis = (int)random_below(&s->random, 3), other = (axis + 1 + (int)random_below(&s->random, 2)) % 3;
        const float steps = (float)((int)random_below(&s->random, 17) - 8) * (float)(0.5 * s->place.scale);
        const float side = random_below(&s->random, 2) ? 1.f : -1.f;
        float org[3] = {sphere[0], sphere[1], sphere[2]}, target[3];
        org[other] += side * sphere[3];
        memcpy(target, org, sizeof target);
        org[axis] += steps;
        if (random_below(&s->random, 4) == 0)
            target[3 - axis - other] += steps; /* displaced within the tangent plane */
        hard_aim(s, org, target, 1);
    }
}

/* Points: spheres of radius 0 at lattice points, hit by rays that pass exactly through them and missed by all
 * others. */
static void points(hard_scene *s)
{
    for (int i = 0; i < 256; i++) {
        double c[3];
        hard_lattice_point(s, -8, 8, 0.25, c);
        hard_sphere(s, c, 0);
    }
    while (hard_wants_ray(s)) {
        const hard_geometry *g = &s->geometry[0];
        double from[3];
        float org[3];
        hard_lattice_point(s, -16, 16, 0.25, from);
        hard_put(s, from, org);
        hard_aim(s, org, g->sphere[random_below(&s->random, g->spheres)], 1);
    }
}

#define AFAR "far origin sphere"
#define CLOSE "huge sphere, origin close; grazing"

static const hard_case cases[] = {
    {AFAR, "1e1 to 1e6 radii", far_spheres, HARD_HERE, HARD_DOUBLE | HARD_MISSES, NULL},
    {AFAR, "1e1 to 1e6 radii, 1e-6", far_spheres, HARD_TINY, HARD_DOUBLE | HARD_MISSES, NULL},
    {AFAR, "1e1 to 1e6 radii, 2^50", far_spheres, HARD_2P50, HARD_DOUBLE | HARD_MISSES, NULL},
    {AFAR, "1e1 to 1e6 radii, at (148376, 1234, -223423)", far_spheres, HARD_FAR, HARD_DOUBLE | HARD_MISSES, NULL},
    {AFAR, "tangent", tangent_far, HARD_HERE, HARD_DOUBLE | HARD_FAST_FAILS | HARD_MISSES, NULL},
    {CLOSE, "radius 1e4, height 0.1", huge_spheres, HARD_HERE, HARD_DOUBLE | HARD_MISSES, NULL},
    {CLOSE, "radius 1e4, height 0.1, 2^-50", huge_spheres, HARD_2M50, HARD_DOUBLE | HARD_MISSES, NULL},
    {CLOSE, "grazing", grazing, HARD_HERE, HARD_DOUBLE | HARD_FAST_FAILS | HARD_MISSES, NULL},
    {CLOSE, "grazing, 1e6", grazing, HARD_LARGE, HARD_DOUBLE | HARD_MISSES, NULL},
    {CLOSE, "grazing, 2^-50", grazing, HARD_2M50, HARD_DOUBLE | HARD_MISSES, NULL},
    {CLOSE, "touched in one point", touched, HARD_HERE, HARD_DOUBLE | HARD_EXACT, NULL},
    {CLOSE, "touched in one point, 2^50", touched, HARD_2P50, HARD_DOUBLE | HARD_EXACT, NULL},
    {CLOSE, "touched in one point, at (148376, 1234, -223423)", touched, HARD_FAR, HARD_DOUBLE | HARD_EXACT, NULL},
    {CLOSE, "points", points, HARD_HERE, HARD_DOUBLE | HARD_EXACT, NULL},
    {CLOSE, "points, 2^-50", points, HARD_2M50, HARD_DOUBLE | HARD_EXACT, NULL},
};
const hard_table hard_cases_spheres = HARD_TABLE(cases);
