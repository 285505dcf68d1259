/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See crossing_cases.h. */
#include "all_hits/crossing_cases.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- meshes ---- */

#define FINE 512
#define COARSE 4 /* at most, doubled to give edges middles */

/* Whether the reach keeps the shift within 128 bits. */
static bool is_coarse(crossing_shape shape) { return shape == CROSSING_COARSE || shape == CROSSING_TANGLED; }

static void place_vertex(const crossing_mesh *m, const double at[3], const int thin, test_random *r, int place[3])
{
    const int size = is_coarse(m->shape) ? COARSE / 2 : FINE / 2;
    for (int a = 0; a < 3; a++) {
        const double unit = m->shape == CROSSING_THIN && a == thin ? 0.75 : size;
        place[a] = 2 * (int)lrint(at[a] * unit);
        if (m->shape == CROSSING_TANGLED)
            place[a] = 2 * ((int)random_below(r, 2 * COARSE + 1) - COARSE);
    }
}

static void append(crossing_mesh *m, const int a[3], const int b[3], const int c[3])
{
    int(*t)[3] = m->corner[m->triangles++];
    memcpy(t[0], a, sizeof t[0]);
    memcpy(t[1], b, sizeof t[1]);
    memcpy(t[2], c, sizeof t[2]);
    for (int k = 0; k < 9; k++)
        m->reach = abs(t[k / 3][k % 3]) > m->reach ? abs(t[k / 3][k % 3]) : m->reach;
}

static void append_triangle(crossing_mesh *m, const int a[3], const int b[3], const int c[3], test_random *r)
{
    const uint32_t way = random_below(r, 12);
    if (way == 0) { /* and a pair that cancels */
        append(m, a, b, c);
        append(m, b, a, c);
    }
    if (way != 1) {
        append(m, a, b, c);
        return;
    }
    const int middle[3] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
    append(m, a, middle, c);
    append(m, middle, b, c);
    append(m, a, b, middle);
}

bool crossing_mesh_make(crossing_mesh *m, closed_kind kind, crossing_shape shape, test_random *r)
{
    closed_mesh mesh;
    const bool rings = kind == CLOSED_TORUS || kind == CLOSED_COLUMN;
    const uint32_t detail = rings ? 4 + random_below(r, 5) : 1 + random_below(r, 4);
    const int thin = (int)random_below(r, 3);
    *m = (crossing_mesh){.kind = kind, .shape = shape};
    if (!closed_mesh_make(&mesh, kind, detail))
        return false;
    int(*place)[3] = malloc((mesh.vertices + 1) * sizeof *place);
    m->corner = malloc((3 * mesh.triangles + 1) * sizeof *m->corner);
    const bool made = place && m->corner;
    for (uint32_t i = 0; made && i < mesh.vertices; i++)
        place_vertex(m, mesh.vertex[i], thin, r, place[i]);
    for (uint32_t i = 0; made && i < mesh.triangles; i++)
        append_triangle(m, place[mesh.index[i][0]], place[mesh.index[i][1]], place[mesh.index[i][2]], r);
    free(place);
    closed_mesh_free(&mesh);
    if (!made)
        crossing_mesh_free(m);
    return made;
}

void crossing_mesh_free(crossing_mesh *m)
{
    free(m->corner);
    *m = (crossing_mesh){.kind = m->kind};
}

/* ---- rays ---- */

crossing_ray crossing_ray_make(const crossing_mesh *m, test_random *r)
{
    const int(*t)[3] = m->corner[random_below(r, m->triangles)];
    const uint32_t from = random_below(r, 3), to = (from + 1 + random_below(r, 2)) % 3, way = random_below(r, 6);
    const int parts = random_below(r, 2) ? 1 : 1 + (int)random_below(r, 8),
              part = (int)random_below(r, 9) % (parts + 1);
    const int steps[2] = {(int)random_below(r, 7) - 3, (int)random_below(r, 7) - 3}, range = 3 * m->reach + 4;
    const int axis = (int)random_below(r, 3);
    crossing_ray ray = {{0}, {0}};
    for (int a = 0; a < 3; a++) {
        const int edge = t[to][a] - t[from][a], other = t[3 - from - to][a] - t[from][a];
        const int target = parts * t[from][a] + part * edge; /* times parts */
        ray.org[a] = (int)random_below(r, (uint32_t)range) - range / 2;
        if (way == 1 && a != axis) /* along an axis, at a vertex */
            ray.org[a] = t[from][a];
        if (way == 2 || way == 3) /* from the surface */
            ray.org[a] = t[from][a] + (way == 3 ? edge / 2 : 0);
        if (way == 4) /* from the triangle's plane */
            ray.org[a] = t[from][a] + steps[0] * edge + steps[1] * other;
        ray.dir[a] = target - parts * ray.org[a];
        if (way == 1)
            ray.dir[a] = a == axis ? t[from][a] - ray.org[a] : 0;
        if (way == 5) { /* along the edge */
            ray.org[a] = t[from][a] + steps[0] * edge;
            ray.dir[a] = edge;
        }
        if (way == 2)
            ray.dir[a] = (int)random_below(r, 9) - 4;
    }
    if (!ray.dir[0] && !ray.dir[1] && !ray.dir[2])
        ray.dir[axis] = random_below(r, 2) ? 1 : -1;
    return ray;
}

/* ---- the judge ---- */

#if CROSSING_JUDGE
__extension__ typedef __int128 wide;

/* The side of direction d on which the edge from p to q passes the origin. */
static wide side_of(const wide d[3], const wide p[3], const wide q[3])
{
    return d[0] * (p[1] * q[2] - p[2] * q[1]) + d[1] * (p[2] * q[0] - p[0] * q[2]) + d[2] * (p[0] * q[1] - p[1] * q[0]);
}

static bool has_area(int (*t)[3])
{
    int e[2][3];
    for (int a = 0; a < 3; a++) {
        e[0][a] = t[1][a] - t[0][a];
        e[1][a] = t[2][a] - t[0][a];
    }
    return e[0][1] * e[1][2] != e[0][2] * e[1][1] || e[0][2] * e[1][0] != e[0][0] * e[1][2] ||
           e[0][0] * e[1][1] != e[0][1] * e[1][0];
}

/* Adds the crossings ahead along d. 1: done, 0: d is not in general position, -1: the origin is on the surface. */
static int add_crossings(const crossing_mesh *m, const wide org[3], wide unit, const wide d[3], int *winding)
{
    *winding = 0;
    for (uint32_t i = 0; i < m->triangles; i++) {
        wide p[3][3], w[3];
        if (!has_area(m->corner[i]))
            continue;
        for (int k = 0; k < 9; k++)
            p[k / 3][k % 3] = unit * m->corner[i][k / 3][k % 3] - org[k % 3];
        for (int k = 0; k < 3; k++) {
            w[k] = side_of(d, p[(k + 1) % 3], p[(k + 2) % 3]);
            if (!w[k])
                return 0;
        }
        if ((w[0] > 0) != (w[1] > 0) || (w[0] > 0) != (w[2] > 0))
            continue;
        const wide height = side_of(p[0], p[1], p[2]); /* t times the sum of w */
        if (!height)
            return -1;
        if ((height > 0) == (w[0] > 0))
            *winding += w[0] > 0 ? 1 : -1;
    }
    return 1;
}

/* Normals are below 2^10 in coarse meshes, so that with h = 2^-12 each power of h outweighs the next ones. In units of
 * h^3 coordinates are below 2^42, products of two with a direction below 2^96. */
bool crossing_winding(const crossing_mesh *m, const int org[3], test_random *r, int *winding)
{
    const bool coarse = is_coarse(m->shape);
    const wide unit = coarse ? (wide)1 << 36 : 1, shift[3] = {(wide)1 << 24, (wide)1 << 12, 1};
    wide from[3], d[3];
    for (int a = 0; a < 3; a++)
        from[a] = org[a] * unit + (coarse ? shift[a] : 0);
    for (int tries = 0; tries < 100; tries++) {
        for (int a = 0; a < 3; a++)
            d[a] = (int)random_below(r, 2001) - 1000;
        const int done = add_crossings(m, from, unit, d, winding);
        if (done)
            return done > 0;
    }
    return false;
}
#else
bool crossing_winding(const crossing_mesh *m, const int org[3], test_random *r, int *winding)
{
    (void)m, (void)org, (void)r, (void)winding;
    return false;
}
#endif
