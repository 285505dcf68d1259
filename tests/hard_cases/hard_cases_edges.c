/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays at the edges and vertices that the triangles of a mesh share: Woop, Benthin, Wald, "Watertight Ray/Triangle
 * Intersection", JCGT 2013. */
#include <string.h>

#include "hard_cases/hard_cases.h"

#define ROW "shared edge / vertex"

/* From outside or, half of the time, from inside, to a point of a random edge; to a vertex a third of the time. */
static void aim_at_edges(hard_scene *s, closed_kind kind, bool exactly)
{
    const closed_mesh mesh = {.kind = kind};
    while (hard_wants_ray(s)) {
        double from[3];
        float org[3], v[3][3], target[3];
        if (exactly)
            hard_lattice_point(s, -3, 3, random_below(&s->random, 2) ? 0.125 : 1, from);
        else if (random_below(&s->random, 2))
            closed_mesh_inside(&mesh, &s->random, from);
        else {
            const double distance = hard_real(s, 1.8, 4);
            hard_direction(s, from);
            for (int a = 0; a < 3; a++)
                from[a] *= distance;
        }
        if (!hard_any_triangle(s, v))
            return;
        const int k = (int)random_below(&s->random, 3), l = (k + 1) % 3;
        const float share = (float)random_below(&s->random, 5) / 4;
        const double along = random_below(&s->random, 3) ? hard_real(s, 0, 1) : 0;
        hard_put(s, from, org);
        for (int a = 0; a < 3; a++)
            target[a] = exactly ? v[k][a] + (v[l][a] - v[k][a]) * share
                                : (float)(v[k][a] + along * ((double)v[l][a] - v[k][a]));
        hard_aim(s, org, target, exactly ? 1 : hard_length(s));
    }
}

static void rounded_icosphere(hard_scene *s)
{
    hard_closed_mesh(s, CLOSED_ICOSPHERE, 4);
    aim_at_edges(s, CLOSED_ICOSPHERE, false);
}

static void rounded_torus(hard_scene *s)
{
    hard_closed_mesh(s, CLOSED_TORUS, 16);
    aim_at_edges(s, CLOSED_TORUS, false);
}

static void rounded_column(hard_scene *s)
{
    hard_closed_mesh(s, CLOSED_COLUMN, 24);
    aim_at_edges(s, CLOSED_COLUMN, false);
}

static void exact_cube(hard_scene *s)
{
    hard_closed_mesh(s, CLOSED_CUBE, 4);
    aim_at_edges(s, CLOSED_CUBE, true);
}

static void exact_octahedron(hard_scene *s)
{
    hard_closed_mesh(s, CLOSED_OCTAHEDRON, 4);
    aim_at_edges(s, CLOSED_OCTAHEDRON, true);
}

/* ---- height fields whose vertices lie on the rays of pixels ---- */

#define FIELD 10

/* Vertex (i, j) of a field at depth near `depth` below the eye (0, 0, 0), on the ray of direction (i/8, j/8, -1): at a
 * whole number of eighths of it, so that all coordinates are short fractions. */
static void field_vertex(hard_scene *s, int i, int j, double depth, bool perspective, double v[3])
{
    const double k = depth + random_below(&s->random, 4) * 0.25;
    v[0] = (perspective ? k : 4) * (i - FIELD / 2) / 8;
    v[1] = (perspective ? k : 4) * (j - FIELD / 2) / 8;
    v[2] = -k;
}

static void add_field(hard_scene *s, double depth, bool perspective)
{
    double v[FIELD + 1][FIELD + 1][3];
    for (int i = 0; i <= FIELD; i++)
        for (int j = 0; j <= FIELD; j++)
            field_vertex(s, i, j, depth, perspective, v[i][j]);
    for (int i = 0; i < FIELD; i++)
        for (int j = 0; j < FIELD; j++) {
            double lower[3][3], upper[3][3];
            const size_t size = sizeof lower[0];
            memcpy(lower[0], v[i][j], size);
            memcpy(lower[1], v[i + 1][j], size);
            memcpy(lower[2], v[i][j + 1], size);
            memcpy(upper[0], v[i + 1][j], size);
            memcpy(upper[1], v[i + 1][j + 1], size);
            memcpy(upper[2], v[i][j + 1], size);
            hard_triangle(s, (const double(*)[3])lower);
            hard_triangle(s, (const double(*)[3])upper);
        }
}

/* Pixels at half the fields' spacing, in 4x4 packets like a camera's: every fourth one hits a vertex. */
static void aim_at_fields(hard_scene *s, bool perspective)
{
    for (uint32_t n = 0; hard_wants_ray(s); n++) {
        const uint32_t packet = n / 16 * 5 % 36, x = packet % 6 * 4 + n % 4, y = packet / 6 * 4 + n / 4 % 4;
        const double px = ((int)x - FIELD) / 16.0, py = ((int)y - FIELD) / 16.0;
        const double eye[3] = {perspective ? 0 : 4 * px, perspective ? 0 : 4 * py, 0};
        const float dir[3] = {perspective ? (float)px : 0, perspective ? (float)py : 0, -1};
        hard_ray(s, eye, dir);
    }
}

static void perspective_fields(hard_scene *s)
{
    add_field(s, 4, true);
    add_field(s, 4.5, true);
    aim_at_fields(s, true);
}

static void orthographic_fields(hard_scene *s)
{
    add_field(s, 4, false);
    add_field(s, 4.5, false);
    aim_at_fields(s, false);
}

static const hard_case cases[] = {
    {ROW, "icosphere", rounded_icosphere, HARD_HERE, HARD_DOUBLE | HARD_FAST_FAILS, NULL},
    {ROW, "icosphere, 1e-6", rounded_icosphere, HARD_TINY, HARD_DOUBLE, NULL},
    {ROW, "icosphere, 1e6", rounded_icosphere, HARD_LARGE, HARD_DOUBLE, NULL},
    {ROW, "icosphere, 2^-50", rounded_icosphere, HARD_2M50, HARD_DOUBLE, NULL},
    {ROW, "icosphere, 2^50", rounded_icosphere, HARD_2P50, HARD_DOUBLE, NULL},
    {ROW, "icosphere, at (148376, 1234, -223423)", rounded_icosphere, HARD_FAR, HARD_DOUBLE, NULL},
    {ROW, "torus", rounded_torus, HARD_HERE, HARD_DOUBLE | HARD_FAST_FAILS, NULL},
    {ROW, "torus, at (148376, 1234, -223423)", rounded_torus, HARD_FAR, HARD_DOUBLE, NULL},
    {ROW, "twisted column", rounded_column, HARD_HERE, HARD_DOUBLE | HARD_FAST_FAILS, NULL},
    {ROW, "exact on a cube", exact_cube, HARD_HERE, HARD_DOUBLE | HARD_EXACT, NULL},
    {ROW, "exact on a cube, 2^-50", exact_cube, HARD_2M50, HARD_DOUBLE | HARD_EXACT, NULL},
    {ROW, "exact on a cube, 2^50", exact_cube, HARD_2P50, HARD_DOUBLE | HARD_EXACT, NULL},
    {ROW, "exact on an octahedron", exact_octahedron, HARD_HERE, HARD_DOUBLE | HARD_EXACT, NULL},
    {ROW, "exact on an octahedron, at (148376, 1234, -223423)", exact_octahedron, HARD_FAR, HARD_DOUBLE | HARD_EXACT,
     NULL},
    {ROW, "vertices on pixel rays, perspective", perspective_fields, HARD_HERE, HARD_DOUBLE | HARD_EXACT, NULL},
    {ROW, "vertices on pixel rays, orthographic", orthographic_fields, HARD_HERE, HARD_DOUBLE | HARD_EXACT, NULL},
};
const hard_table hard_cases_edges = HARD_TABLE(cases);
