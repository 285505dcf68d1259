/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes and rays on which a grid may lose primitives or its way: the boundary of the bounds; faces, edges and corners
 * of cells; long walks; primitives in many cells, on planes between cells, or all in one cell. */
#include <math.h>
#include <string.h>

#include "hard_cases/hard_cases.h"

static void set_resolution(hard_scene *s, uint32_t x, uint32_t y, uint32_t z)
{
    s->resolution[0] = x;
    s->resolution[1] = y;
    s->resolution[2] = z;
}

/* From one point to another, both placed. */
static void aim(hard_scene *s, const double from[3], const double to[3])
{
    float org[3], target[3];
    hard_put(s, from, org);
    hard_put(s, to, target);
    hard_aim(s, org, target, 1);
}

/* ---- the boundary of the bounds ---- */

/* A cube, which equals its bounds, with points on its corners; hit at edges and corners, from far and near. */
static void rim(hard_scene *s)
{
    hard_closed_mesh(s, CLOSED_CUBE, 1);
    hard_new_geometry(s);
    for (int k = 0; k < 8; k++)
        hard_sphere(s, (const double[3]){k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1}, 0);
    while (hard_wants_ray(s)) {
        double from[3], to[3];
        const double distance = (double)random_log(&s->random, 1.5f, 1e5f);
        const int free = (int)random_below(&s->random, 4); /* 3: a corner */
        hard_direction(s, from);
        for (int a = 0; a < 3; a++) {
            from[a] = random_below(&s->random, 4) ? from[a] * distance : random_below(&s->random, 2) ? 1 : -1;
            to[a] = a == free ? hard_real(s, -1, 1) : random_below(&s->random, 2) ? 1 : -1;
        }
        aim(s, from, to);
    }
}

/* ---- faces, edges and corners of cells ---- */

/* Bounds from 0 to 8 with cells of edge 1, except for the library's outward rounding. */
static void unit_cells(hard_scene *s)
{
    for (int k = 0; k < 8; k++)
        hard_sphere(s, (const double[3]){k & 1 ? 8 : 0, k & 2 ? 8 : 0, k & 4 ? 8 : 0}, 0);
    for (int i = 0; i < 100; i++) {
        double c[3];
        hard_lattice_point(s, 1, 15, 0.5, c);
        hard_sphere(s, c, 0.25 * random_below(&s->random, 3));
    }
    set_resolution(s, 8, 8, 8);
}

static void walks(hard_scene *s)
{
    unit_cells(s);
    while (hard_wants_ray(s)) {
        double from[3], to[3];
        const int keep = (int)random_below(&s->random, 4);
        hard_lattice_point(s, -1, 9, 1, from);
        hard_lattice_point(s, 0, 16, 0.5, to);
        for (int a = 0; a < 3; a++)
            if (keep == 3 ? random_below(&s->random, 2) : a == keep)
                to[a] = from[a]; /* along a face or an edge of cells */
        aim(s, from, to);
    }
}

/* ---- long walks ---- */

static void long_walks(hard_scene *s, uint32_t x, uint32_t y, uint32_t z)
{
    const double size[3] = {x, y, z};
    for (int i = 0; i < 256; i++) {
        double c[3];
        for (int a = 0; a < 3; a++)
            c[a] = hard_real(s, 0, size[a]);
        hard_sphere(s, c, hard_real(s, 0.01, 0.4));
    }
    set_resolution(s, x, y, z);
    while (hard_wants_ray(s)) {
        const float *sphere = s->geometry[0].sphere[random_below(&s->random, s->geometry[0].spheres)];
        double from[3], to[3];
        for (int a = 0; a < 3; a++) {
            from[a] = random_below(&s->random, 4) ? hard_real(s, -0.2 * size[a], 1.2 * size[a]) : 0;
            to[a] =
                (sphere[a] - s->place.offset[a]) / s->place.scale + sphere[3] / s->place.scale * hard_real(s, -1, 1);
        }
        aim(s, from, to);
    }
}

static void walks_of_1024(hard_scene *s) { long_walks(s, 1024, 2, 2); }
static void diagonal_walks(hard_scene *s) { long_walks(s, 128, 128, 4); }

/* ---- primitives over several cells ---- */

static void spread(hard_scene *s)
{
    for (int i = 0; i < 24; i++) {
        double v[3][3];
        for (int k = 0; k < 3; k++)
            hard_point(s, -1, 1, v[k]);
        hard_triangle(s, (const double(*)[3])v);
    }
    for (int i = 0; i < 24; i++) {
        double c[3];
        hard_point(s, -1, 1, c);
        hard_sphere(s, c, hard_real(s, 0.1, 0.7));
    }
    set_resolution(s, 16, 16, 16);
    while (hard_wants_ray(s)) {
        double from[3], to[3];
        hard_point(s, -2, 2, from);
        hard_point(s, -1, 1, to);
        aim(s, from, to);
    }
}

/* ---- planes between cells, flat scenes ---- */

static void lattice_triangles(hard_scene *s, int flat)
{
    for (int i = 0; i < 120; i++) {
        double v[3][3];
        for (int k = 0; k < 3; k++)
            hard_lattice_point(s, 0, 8, 1, v[k]);
        for (int k = 0; k < 3; k++)
            if (flat >= 0)
                v[k][flat] = 4;
            else if (i % 2)
                v[k][i % 3] = v[0][i % 3]; /* in a plane between cells */
        hard_triangle(s, (const double(*)[3])v);
    }
}

static void aim_at_lattice(hard_scene *s)
{
    while (hard_wants_ray(s)) {
        double from[3], to[3];
        hard_lattice_point(s, -4, 12, 1, from);
        hard_lattice_point(s, 0, 16, 0.5, to);
        aim(s, from, to);
    }
}

static void on_planes(hard_scene *s)
{
    lattice_triangles(s, -1);
    for (int i = 0; i < 60; i++) {
        double c[3];
        hard_lattice_point(s, 0, 8, 1, c);
        hard_sphere(s, c, random_below(&s->random, 2));
    }
    set_resolution(s, 8, 8, 8);
    aim_at_lattice(s);
}

static void flat(hard_scene *s)
{
    const int axis = (int)random_below(&s->random, 3);
    lattice_triangles(s, axis);
    for (int i = 0; i < 40; i++) { /* points in the plane */
        double c[3];
        hard_lattice_point(s, 0, 8, 1, c);
        c[axis] = 4;
        hard_sphere(s, c, 0);
    }
    aim_at_lattice(s);
}

static void in_a_line(hard_scene *s)
{
    for (int i = 0; i < 64; i++)
        hard_sphere(s, (const double[3]){i, 0, 0}, i % 2 ? 0.5 : 0);
    set_resolution(s, 64, 1, 1);
    while (hard_wants_ray(s)) {
        double from[3] = {random_below(&s->random, 64)}, to[3] = {random_below(&s->random, 64)};
        if (random_below(&s->random, 4))
            for (int a = 1; a < 3; a++)
                from[a] = (int)random_below(&s->random, 5) - 2;
        if (random_below(&s->random, 2))
            to[1] = 0.5;
        aim(s, from, to);
    }
}

/* Triangles that share a vertex, each with two sides along axes: cells around them have an edge in it. */
static void add_fan(hard_scene *s)
{
    double v[3][3], side[3];
    hard_lattice_point(s, -40, 40, 1, v[0]);
    for (int a = 0; a < 3; a++)
        side[a] = random_below(&s->random, 2) ? 0.125 : -0.125;
    for (uint32_t i = 0; i < 16; i++) {
        for (uint32_t k = 1; k < 3; k++) {
            memcpy(v[k], v[0], sizeof v[k]);
            v[k][(i + k) % 3] += side[(i + k) % 3] * (1 + random_below(&s->random, 4));
        }
        hard_triangle(s, (const double(*)[3])v);
    }
}

/* Rays touch a triangle in the vertex that its fan shares. All is exact in float but the times at planes. */
static void touched_corners(hard_scene *s)
{
    for (int i = 0; i < 25; i++)
        add_fan(s);
    while (hard_wants_ray(s)) {
        float v[3][3], dir[3];
        double org[3];
        if (!hard_any_triangle(s, v))
            return;
        const double away = ldexp(1, (int)random_below(&s->random, 13)), turned = random_below(&s->random, 2) ? 1 : -1;
        for (int a = 0; a < 3; a++) {
            const int size = 1 + (int)random_below(&s->random, 60);
            const double side = (v[1][a] - v[0][a]) - (v[2][a] - v[0][a]); /* along one, against the other */
            dir[a] = (float)(side > 0 ? turned * size : side < 0 ? -turned * size : size);
            org[a] = v[0][a] - away * dir[a];
        }
        hard_ray(s, org, dir);
    }
}

/* ---- full cells, large primitives ---- */

static void coincident(hard_scene *s)
{
    const double middle[3] = {0, 0, 0}, common[3] = {1, 2, 3};
    hard_sphere(s, middle, 12); /* over the whole grid */
    for (int i = 0; i < 40; i++)
        hard_sphere(s, common, 0.5);
    for (int i = 0; i < 100; i++) {
        double c[3];
        hard_point(s, -8, 8, c);
        hard_sphere(s, c, 0.3);
    }
    for (int i = 0; i < 40; i++)
        hard_triangle(s, (const double[3][3]){{-2, -2, 1}, {3, -2, 1}, {-2, 3, 1}});
    hard_new_geometry(s);
    hard_triangle(s, (const double[3][3]){{-2, -2, 1}, {3, -2, 1}, {-2, 3, 1}});
    hard_sphere(s, common, 0.5);
    set_resolution(s, 8, 8, 8);
    while (hard_wants_ray(s)) {
        double from[3], to[3] = {1, 2, 3};
        hard_direction(s, from);
        for (int a = 0; a < 3; a++) {
            from[a] *= random_below(&s->random, 2) ? 20 : 6;
            to[a] += hard_real(s, -0.6, 0.6);
        }
        if (random_below(&s->random, 2)) {
            to[0] = (int)random_below(&s->random, 6) - 2.5;
            to[1] = hard_real(s, -2, 2);
            to[2] = 1;
        }
        aim(s, from, to);
    }
}

/* A stand-in for the teapot, a millionth of the stadium's size; the eye anywhere in the stadium. */
static void stadium(hard_scene *s)
{
    const double shift[3] = {0.3, 0.2, -0.1};
    closed_mesh teapot = {.kind = CLOSED_TORUS};
    hard_closed_mesh(s, CLOSED_CUBE, 2);
    if (closed_mesh_make(&teapot, CLOSED_TORUS, 16))
        hard_mesh(s, &teapot, 1e-6, shift);
    else
        s->failed = true;
    closed_mesh_free(&teapot);
    for (int i = 0; i < 64; i++) {
        double d[3];
        hard_direction(s, d);
        for (int a = 0; a < 3; a++)
            d[a] = shift[a] + 2e-6 * d[a];
        hard_sphere(s, d, 3e-7);
    }
    while (hard_wants_ray(s)) {
        const double reach = random_below(&s->random, 4) ? 2.5e-6 : 1;
        const double away = (double)random_log(&s->random, 1e-6f, 1);
        double from[3], to[3];
        hard_direction(s, from);
        hard_direction(s, to);
        for (int a = 0; a < 3; a++) {
            from[a] = shift[a] + away * 0.6 * from[a];
            to[a] = shift[a] + reach * to[a];
        }
        aim(s, from, to);
    }
}

#define WALK "origin on voxel face, edge walk, corner"
#define DDA "DDA accumulation"
#define PLANES "primitives on grid planes, flat scenes"
#define FULL "voxel queue overflow, big objects"

static const hard_case cases[] = {
    {"slab rounding", "rim of the bounds", rim, HARD_HERE, HARD_DOUBLE, NULL},
    {"slab rounding", "rim of the bounds, 1e-6", rim, HARD_TINY, HARD_DOUBLE, NULL},
    {"slab rounding", "rim of the bounds, at (148376, 1234, -223423)", rim, HARD_FAR, HARD_DOUBLE, NULL},
    {WALK, "along faces and edges of cells", walks, HARD_HERE, HARD_DOUBLE | HARD_EXACT | HARD_MISSES, NULL},
    {WALK, "along faces and edges of cells, 2^50", walks, HARD_2P50, HARD_DOUBLE | HARD_EXACT | HARD_MISSES, NULL},
    {WALK, "vertices touched in the corners of cells", touched_corners, HARD_HERE, HARD_DOUBLE | HARD_EXACT, NULL},
    {DDA, "1024 cells in a row", walks_of_1024, HARD_HERE, HARD_DOUBLE, NULL},
    {DDA, "diagonals of 128x128x4 cells", diagonal_walks, HARD_HERE, HARD_DOUBLE, NULL},
    {"primitive over several cells", "16x16x16 cells", spread, HARD_HERE, HARD_SPREAD, NULL},
    {PLANES, "all coordinates whole cells", on_planes, HARD_HERE, HARD_DOUBLE | HARD_EXACT | HARD_SPREAD, NULL},
    {PLANES, "all coordinates whole cells, 2^-50", on_planes, HARD_2M50, HARD_DOUBLE | HARD_EXACT | HARD_SPREAD, NULL},
    {PLANES, "one plane", flat, HARD_HERE, HARD_DOUBLE | HARD_EXACT, NULL},
    {PLANES, "one plane, at (148376, 1234, -223423)", flat, HARD_FAR, HARD_DOUBLE | HARD_EXACT, NULL},
    {PLANES, "one line", in_a_line, HARD_HERE, HARD_DOUBLE | HARD_EXACT, NULL},
    {FULL, "coincident, one over the whole grid", coincident, HARD_HERE, HARD_OVERFLOW | HARD_SPREAD, NULL},
    {"teapot in a stadium", "1 to 1e6", stadium, HARD_HERE, HARD_OVERFLOW, NULL},
    {"teapot in a stadium", "1 to 1e6, 1e6", stadium, HARD_LARGE, HARD_OVERFLOW, NULL},
};
const hard_table hard_cases_grid = HARD_TABLE(cases);
