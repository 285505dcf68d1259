/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles that are hard individually: far away along one axis, seen edge-on, thin, of zero area, coplanar. */
#include <math.h>
#include <string.h>

#include "hard_cases/hard_cases.h"

/* ---- one axis a hundred thousand times the others ---- */

static void sheared(hard_scene *s)
{
    const int axis = (int)random_below(&s->random, 3);
    for (int i = 0; i < 64; i++) {
        double v[3][3];
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                v[k][a] = a == axis ? hard_real(s, -1e5, 1e5) : hard_real(s, -1, 1);
        hard_triangle(s, (const double(*)[3])v);
    }
    while (hard_wants_ray(s)) {
        double from[3];
        float org[3], v[3][3], target[3];
        const double u = hard_real(s, 0, 0.5), w = hard_real(s, 0, 0.5);
        for (int a = 0; a < 3; a++)
            from[a] = a == axis ? hard_real(s, -1e5, 1e5) : hard_real(s, -2, 2);
        hard_put(s, from, org);
        if (!hard_any_triangle(s, v))
            return;
        for (int a = 0; a < 3; a++)
            target[a] = (float)(v[0][a] + u * ((double)v[1][a] - v[0][a]) + w * ((double)v[2][a] - v[0][a]));
        hard_aim(s, org, target, hard_length(s));
    }
}

/* ---- rays in the plane, or nearly ---- */

/* Planes through lattice points: every edge is a short vector, so sums of edges lie exactly in the plane. */
static void lattice_triangles(hard_scene *s, int count)
{
    for (int i = 0; i < count; i++) {
        double v[3][3];
        for (int k = 0; k < 3; k++)
            hard_lattice_point(s, -8, 8, 0.125, v[k]);
        hard_triangle(s, (const double(*)[3])v);
    }
}

static void in_plane(hard_scene *s)
{
    lattice_triangles(s, 96);
    while (hard_wants_ray(s)) {
        float v[3][3], org[3], target[3];
        if (!hard_any_triangle(s, v))
            return;
        const float p = (float)random_below(&s->random, 9) - 4, q = (float)random_below(&s->random, 9) - 4;
        const float m = (float)random_below(&s->random, 9) / 8, n = (float)random_below(&s->random, 9) / 8;
        for (int a = 0; a < 3; a++) {
            const float e1 = v[1][a] - v[0][a], e2 = v[2][a] - v[0][a];
            org[a] = v[0][a] + p * e1 + q * e2;
            target[a] = v[0][a] + m * e1 + n * e2;
        }
        hard_aim(s, org, target, 1);
    }
}

/* At angles from 1e-1 down to 1e-7 to the plane, towards a point of the triangle. */
static void near_plane(hard_scene *s)
{
    for (int i = 0; i < 96; i++) {
        double v[3][3];
        for (int k = 0; k < 3; k++)
            hard_point(s, -1, 1, v[k]);
        hard_triangle(s, (const double(*)[3])v);
    }
    while (hard_wants_ray(s)) {
        float v[3][3], org[3], target[3];
        double n[3], e1[3], e2[3];
        if (!hard_any_triangle(s, v))
            return;
        for (int a = 0; a < 3; a++) {
            e1[a] = (double)v[1][a] - v[0][a];
            e2[a] = (double)v[2][a] - v[0][a];
        }
        for (int a = 0; a < 3; a++)
            n[a] = e1[(a + 1) % 3] * e2[(a + 2) % 3] - e1[(a + 2) % 3] * e2[(a + 1) % 3];
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        const double sign = random_below(&s->random, 2) ? 1 : -1;
        const double angle = sign * (double)random_log(&s->random, 1e-7f, 1e-1f);
        const double p = hard_real(s, -2, 3), q = hard_real(s, -2, 3), u = hard_real(s, 0, 0.5),
                     w = hard_real(s, 0, 0.5);
        for (int a = 0; a < 3; a++) {
            target[a] = (float)(v[0][a] + u * e1[a] + w * e2[a]);
            org[a] = (float)(v[0][a] + p * e1[a] + q * e2[a] + (length > 0 ? angle * n[a] / length : 0));
        }
        hard_aim(s, org, target, hard_length(s));
    }
}

/* ---- needles, triangles without area, points ---- */

static void aim_at_triangles(hard_scene *s)
{
    while (hard_wants_ray(s)) {
        double from[3];
        float org[3], v[3][3], target[3];
        const double distance = hard_real(s, 1, 4);
        hard_direction(s, from);
        for (int a = 0; a < 3; a++)
            from[a] *= distance;
        hard_put(s, from, org);
        if (!hard_any_triangle(s, v))
            return;
        const double u = random_below(&s->random, 3) ? hard_real(s, 0, 1) : 0;
        const double w = random_below(&s->random, 3) ? hard_real(s, 0, 1 - u) : 0;
        for (int a = 0; a < 3; a++)
            target[a] = (float)(v[0][a] + u * ((double)v[1][a] - v[0][a]) + w * ((double)v[2][a] - v[0][a]));
        hard_aim(s, org, target, hard_length(s));
    }
}

/* Fans of needles about as long as the scene, aspect ratio from 1 to 1e7; neighbours share their long edges. */
static void needles(hard_scene *s)
{
    for (int fan = 0; fan < 24; fan++) {
        const double aspect = pow(10, fan * 7.0 / 23);
        double middle[3], along[3], across[3], v[3][3];
        hard_direction(s, middle);
        hard_direction(s, along);
        hard_direction(s, across);
        for (int needle = 0; needle < 4; needle++) {
            for (int a = 0; a < 3; a++) {
                const double base = 0.5 * middle[a] + along[a];
                v[0][a] = 0.5 * middle[a] - along[a];
                v[1][a] = base + across[a] * 2 * needle / aspect;
                v[2][a] = base + across[a] * 2 * (needle + 1) / aspect;
            }
            hard_triangle(s, (const double(*)[3])v);
        }
    }
    aim_at_triangles(s);
}

/* Half of the triangles have no area: three equal vertices, two equal vertices, or three collinear ones. */
static void without_area(hard_scene *s)
{
    for (int i = 0; i < 96; i++) {
        double v[3][3];
        for (int k = 0; k < 3; k++)
            hard_lattice_point(s, -8, 8, 0.125, v[k]);
        if (i % 6 == 0)
            memcpy(v[1], v[0], sizeof v[1]);
        if (i % 6 == 0 || i % 6 == 2)
            memcpy(v[2], v[0], sizeof v[2]);
        if (i % 6 == 4)
            for (int a = 0; a < 3; a++)
                v[2][a] = (v[0][a] + v[1][a]) / 2;
        hard_triangle(s, (const double(*)[3])v);
    }
    aim_at_triangles(s);
}

/* ---- overlapping triangles ---- */

/* Overlapping triangles in three lattice planes. Some are repeated with another first vertex, flipped, or in another
 * geometry. */
static void coplanar(hard_scene *s)
{
    for (int part = 0; part < 2; part++) {
        hard_new_geometry(s);
        for (int i = 0; i < 40; i++) {
            double v[3][3];
            float placed[3][3], turned[3][3];
            for (int k = 0; k < 3; k++) {
                hard_lattice_point(s, -4, 4, 0.25, v[k]);
                v[k][i % 3] = 0.25 * (i % 2);
                hard_put(s, v[k], placed[k]);
            }
            hard_raw_triangle(s, (const float(*)[3])placed);
            if (!hard_any_triangle(s, placed))
                return;
            for (int k = 0; k < 3; k++)
                memcpy(turned[i % 2 ? 2 - k : (k + 1) % 3], placed[k], sizeof turned[0]);
            hard_raw_triangle(s, (const float(*)[3])turned);
        }
    }
    while (hard_wants_ray(s)) {
        double from[3], to[3];
        float org[3], target[3];
        hard_lattice_point(s, -8, 8, 0.25, from);
        hard_lattice_point(s, -8, 8, 0.125, to);
        hard_put(s, from, org);
        hard_put(s, to, target);
        hard_aim(s, org, target, 1);
    }
}

/* A height field in which every second triangle is a bitwise copy of the one before it. */
static void copied_triangles(hard_scene *s)
{
    for (int i = 0; i < 96; i++) {
        double v[3][3];
        for (int k = 0; k < 3; k++)
            hard_point(s, -1, 1, v[k]);
        hard_triangle(s, (const double(*)[3])v);
        hard_triangle(s, (const double(*)[3])v);
    }
    aim_at_triangles(s);
}

#define SHEAR "t accuracy after shear"
#define PLANE "ray in or near the triangle plane"
#define NEEDLE "needle, zero-area, point triangles"
#define TWICE "coplanar duplicates"

static const hard_case cases[] = {
    {SHEAR, "one axis 1e5 times the others", sheared, HARD_HERE, HARD_DOUBLE, NULL},
    {SHEAR, "one axis 1e5 times the others, 2^-50", sheared, HARD_2M50, HARD_DOUBLE, NULL},
    {PLANE, "in it", in_plane, HARD_HERE, HARD_DOUBLE | HARD_EXACT | HARD_MISSES, NULL},
    {PLANE, "in it, 2^50", in_plane, HARD_2P50, HARD_DOUBLE | HARD_EXACT | HARD_MISSES, NULL},
    {PLANE, "angles 1e-1 to 1e-7", near_plane, HARD_HERE, HARD_DOUBLE | HARD_FAST_FAILS, NULL},
    {PLANE, "angles 1e-1 to 1e-7, 1e-6", near_plane, HARD_TINY, HARD_DOUBLE, NULL},
    {NEEDLE, "aspect 1 to 1e7", needles, HARD_HERE, HARD_DOUBLE | HARD_FAST_FAILS, NULL},
    {NEEDLE, "aspect 1 to 1e7, 1e-6", needles, HARD_TINY, HARD_DOUBLE, NULL},
    {NEEDLE, "aspect 1 to 1e7, 1e6", needles, HARD_LARGE, HARD_DOUBLE, NULL},
    {NEEDLE, "aspect 1 to 1e7, 2^-50", needles, HARD_2M50, HARD_DOUBLE, NULL},
    {NEEDLE, "without area", without_area, HARD_HERE, HARD_FLAT, NULL},
    {NEEDLE, "without area, 2^50", without_area, HARD_2P50, HARD_FLAT, NULL},
    {TWICE, "lattice planes", coplanar, HARD_HERE, HARD_DOUBLE | HARD_EXACT, NULL},
    {TWICE, "lattice planes, at (148376, 1234, -223423)", coplanar, HARD_FAR, HARD_DOUBLE | HARD_EXACT, NULL},
    {TWICE, "every second triangle a copy", copied_triangles, HARD_HERE, HARD_DOUBLE, NULL},
};
const hard_table hard_cases_triangles = HARD_TABLE(cases);
