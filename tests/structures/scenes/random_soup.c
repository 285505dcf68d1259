/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Random scenes of triangles, and their cameras. */
#include "structures/scenes/random_soup.h"

#include <math.h>
#include <string.h>

#define CLUMPS 8

const char *soup_name(soup_kind kind)
{
    static const char *const name[SOUP_KINDS] = {"six orders of size", "clustered",  "planar",
                                                 "axis-aligned",       "degenerate", "triangles and spheres"};
    return name[kind];
}

/* ---- primitives ---- */

static void place_vertices(hard_scene *s, const double center[3], double size, double v[3][3])
{
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            v[k][a] = center[a] + hard_real(s, -size, size);
}

static void six_orders(hard_scene *s, double typical, double v[3][3])
{
    double center[3], factor = (double)random_log(&s->random, 1e-3f, 1e3f);
    if (factor > 10 && random_below(&s->random, 50))
        factor = 1; /* they would occlude everything else */
    hard_point(s, -1, 1, center);
    place_vertices(s, center, typical * factor, v);
}

static void clustered(hard_scene *s, double typical, const double (*clump)[3], double v[3][3])
{
    double center[3];
    const double *around = clump[random_below(&s->random, CLUMPS)];
    hard_point(s, -0.15, 0.15, center);
    for (int a = 0; a < 3; a++)
        center[a] += around[a];
    place_vertices(s, center, 0.6 * typical, v);
}

static void planar(hard_scene *s, double typical, double v[3][3])
{
    double center[3];
    const double slope = random_below(&s->random, 2) ? 0.5 : 0;
    hard_point(s, -1, 1, center);
    place_vertices(s, center, typical, v);
    for (int k = 0; k < 3; k++)
        v[k][2] = 0.125 + slope * v[k][0];
}

static void axis_aligned(hard_scene *s, double v[3][3])
{
    const int axis = (int)random_below(&s->random, 3);
    double corner[3];
    hard_lattice_point(s, -16, 16, 0.0625, corner);
    for (int k = 0; k < 3; k++) {
        hard_lattice_point(s, -4, 4, 0.0625, v[k]);
        for (int a = 0; a < 3; a++)
            v[k][a] = a == axis ? corner[a] : corner[a] + v[k][a];
    }
}

/* v: a valid triangle, which is spoilt in one of several ways or left unchanged. */
static void spoil(hard_scene *s, double v[3][3])
{
    switch (random_below(&s->random, 8)) {
    case 0: memcpy(v[1], v[0], sizeof v[1]); /* a point, together with the next case */ /* fall through */
    case 1: memcpy(v[2], v[0], sizeof v[2]); break;
    case 2:
        for (int a = 0; a < 3; a++)
            v[2][a] = (v[0][a] + v[1][a]) / 2; /* a line, except for rounding */
        break;
    case 3:
        for (int a = 0; a < 3; a++)
            v[2][a] = v[1][a] + 1e-6 * (v[2][a] - v[1][a]); /* a needle */
        break;
    case 4: v[random_below(&s->random, 3)][random_below(&s->random, 3)] = random_below(&s->random, 2) ? NAN : INFINITY;
    default: break;
    }
}

static void degenerate(hard_scene *s, double typical)
{
    double center[3], v[3][3];
    float copy[3][3];
    if (random_below(&s->random, 4) == 0 && hard_any_triangle(s, copy)) {
        hard_raw_triangle(s, (const float(*)[3])copy);
        return;
    }
    hard_point(s, -1, 1, center);
    place_vertices(s, center, typical, v);
    spoil(s, v);
    hard_triangle(s, (const double(*)[3])v);
}

static void mixed(hard_scene *s, double typical, uint32_t i, uint32_t primitives)
{
    double center[3], v[3][3];
    if (i % (primitives / 4 + 1) == 0)
        hard_new_geometry(s);
    hard_point(s, -1, 1, center);
    place_vertices(s, center, typical, v);
    if (s->geometries % 2)
        hard_triangle(s, (const double(*)[3])v);
    else
        hard_sphere(s, center, hard_real(s, 0.2, 0.7) * typical);
}

hard_scene soup_make(soup_kind kind, uint64_t stream, uint32_t primitives)
{
    hard_scene s = {.place = {.scale = 1}, .random = random_make(stream)};
    const double typical = 1 / cbrt(primitives + 1.0);
    double clump[CLUMPS][3], v[3][3];
    for (int i = 0; i < CLUMPS; i++)
        hard_point(&s, -1, 1, clump[i]);
    for (uint32_t i = 0; i < primitives; i++) {
        switch (kind) {
        case SOUP_SIX_ORDERS: six_orders(&s, typical, v); break;
        case SOUP_CLUSTERED: clustered(&s, typical, (const double(*)[3])clump, v); break;
        case SOUP_PLANAR: planar(&s, typical, v); break;
        case SOUP_AXIS_ALIGNED: axis_aligned(&s, v); break;
        case SOUP_DEGENERATE: degenerate(&s, typical); continue;
        case SOUP_MIXED: mixed(&s, typical, i, primitives); continue;
        case SOUP_KINDS: break;
        }
        hard_triangle(&s, (const double(*)[3])v);
    }
    assert_false(s.failed);
    assert_int_equal(hard_scene_primitives(&s), primitives);
    return s;
}

/* ---- cameras ---- */

cgt_camera soup_camera(hard_scene *s)
{
    const cloud where = {.middle = {0, 0, 0}, .reach = 1};
    return camera_random(&s->random, &where);
}
