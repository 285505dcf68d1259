/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Closed meshes: faces are grids of shared vertices, identified by position. */
#include "support/closed_meshes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

const char *closed_mesh_name(closed_kind kind)
{
    static const char *const name[CLOSED_KINDS] = {"cube", "octahedron", "icosphere", "torus", "column"};
    return name[kind];
}

void closed_mesh_free(closed_mesh *mesh)
{
    free(mesh->vertex);
    free(mesh->index);
    *mesh = (closed_mesh){.kind = mesh->kind};
}

static bool make_room(closed_mesh *mesh, size_t vertices, size_t triangles)
{
    mesh->vertex = calloc(vertices, sizeof *mesh->vertex);
    mesh->index = calloc(triangles, sizeof *mesh->index);
    return mesh->vertex && mesh->index;
}

static void add_triangle(closed_mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *index = mesh->index[mesh->triangles++];
    index[0] = a;
    index[1] = b;
    index[2] = c;
}

/* The vertex at a position; faces compute shared positions by the same operations, so that they match exactly. */
static uint32_t vertex_at(closed_mesh *mesh, const double p[3])
{
    for (uint32_t i = 0; i < mesh->vertices; i++)
        if (fabs(mesh->vertex[i][0] - p[0]) + fabs(mesh->vertex[i][1] - p[1]) + fabs(mesh->vertex[i][2] - p[2]) < 1e-9)
            return i;
    memcpy(mesh->vertex[mesh->vertices], p, sizeof *mesh->vertex);
    return mesh->vertices++;
}

/* ---- polyhedra: each face divided into detail^2 triangles ---- */

static void add_face(closed_mesh *mesh, const double a[3], const double b[3], const double c[3], uint32_t detail)
{
    for (uint32_t i = 0; i < detail; i++)
        for (uint32_t j = 0; j + i < detail; j++) {
            uint32_t corner[4];
            for (uint32_t k = 0; k < 4; k++) {
                const double u = (double)(i + (k & 1)) / detail, v = (double)(j + (k >> 1)) / detail;
                double p[3];
                for (int axis = 0; axis < 3; axis++)
                    p[axis] = a[axis] * (1 - u - v) + b[axis] * u + c[axis] * v;
                corner[k] = k < 3 || i + j + 2 <= detail ? vertex_at(mesh, p) : 0;
            }
            add_triangle(mesh, corner[0], corner[1], corner[2]);
            if (i + j + 2 <= detail)
                add_triangle(mesh, corner[1], corner[3], corner[2]);
        }
}

static void make_octahedron(closed_mesh *mesh, uint32_t detail)
{
    for (int octant = 0; octant < 8; octant++) {
        double corner[3][3] = {{0}};
        for (int axis = 0; axis < 3; axis++)
            corner[axis][axis] = octant >> axis & 1 ? -1 : 1;
        const bool mirrored = octant == 1 || octant == 2 || octant == 4 || octant == 7;
        add_face(mesh, corner[0], corner[mirrored ? 2 : 1], corner[mirrored ? 1 : 2], detail);
    }
}

static void make_cube(closed_mesh *mesh, uint32_t detail)
{
    for (int face = 0; face < 6; face++) {
        const int axis = face / 2, x = (axis + 1) % 3, y = (axis + 2) % 3;
        const double side = face % 2 ? -1 : 1;
        double corner[4][3];
        for (int k = 0; k < 4; k++) {
            corner[k][axis] = side;
            corner[k][x] = k & 1 ? side : -side;
            corner[k][y] = k & 2 ? 1 : -1;
        }
        add_face(mesh, corner[0], corner[1], corner[2], detail);
        add_face(mesh, corner[3], corner[2], corner[1], detail);
    }
}

static void make_icosphere(closed_mesh *mesh, uint32_t detail)
{
    static const uint8_t face[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                        {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                        {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                        {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    const double g = (1 + sqrt(5)) / 2;
    const double corner[12][3] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (int i = 0; i < 20; i++)
        add_face(mesh, corner[face[i][0]], corner[face[i][1]], corner[face[i][2]], detail);
    for (uint32_t i = 0; i < mesh->vertices; i++) {
        double *p = mesh->vertex[i];
        const double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        for (int axis = 0; axis < 3; axis++)
            p[axis] /= length;
    }
}

/* ---- rings: rows of quadrilaterals ---- */

static void add_ring_faces(closed_mesh *mesh, uint32_t ring, uint32_t next, uint32_t sides)
{
    for (uint32_t k = 0; k < sides; k++) {
        const uint32_t l = (k + 1) % sides;
        add_triangle(mesh, ring + k, ring + l, next + k);
        add_triangle(mesh, ring + l, next + l, next + k);
    }
}

static void make_torus(closed_mesh *mesh, uint32_t rings, uint32_t sides)
{
    for (uint32_t i = 0; i < rings; i++)
        for (uint32_t k = 0; k < sides; k++) {
            const double along = 2 * PI * i / rings, around = 2 * PI * k / sides, r = 1 + 0.375 * cos(around);
            const double p[3] = {r * cos(along), r * sin(along), 0.375 * sin(around)};
            memcpy(mesh->vertex[mesh->vertices++], p, sizeof p);
        }
    for (uint32_t i = 0; i < rings; i++)
        add_ring_faces(mesh, i * sides, (i + 1) % rings * sides, sides);
}

#define COLUMN_RINGS 4u

static void make_column(closed_mesh *mesh, uint32_t sides)
{
    for (uint32_t i = 0; i < COLUMN_RINGS; i++)
        for (uint32_t k = 0; k < sides; k++) {
            const double turn = 2 * PI * k / sides + PI * i / (COLUMN_RINGS - 1), r = k % 2 ? 0.6 : 0.45;
            const double p[3] = {r * cos(turn), r * sin(turn), 2.0 * i / (COLUMN_RINGS - 1) - 1};
            memcpy(mesh->vertex[mesh->vertices++], p, sizeof p);
        }
    for (uint32_t i = 0; i + 1 < COLUMN_RINGS; i++)
        add_ring_faces(mesh, i * sides, (i + 1) * sides, sides);
    const uint32_t top = (COLUMN_RINGS - 1) * sides, bottom_middle = mesh->vertices, top_middle = bottom_middle + 1;
    mesh->vertex[mesh->vertices++][2] = -1;
    mesh->vertex[mesh->vertices++][2] = 1;
    for (uint32_t k = 0; k < sides; k++) {
        add_triangle(mesh, bottom_middle, (k + 1) % sides, k);
        add_triangle(mesh, top_middle, top + k, top + (k + 1) % sides);
    }
}

/* ---- all ---- */

bool closed_mesh_make(closed_mesh *mesh, closed_kind kind, uint32_t detail)
{
    static const uint32_t faces[CLOSED_KINDS] = {[CLOSED_CUBE] = 12, [CLOSED_OCTAHEDRON] = 8, [CLOSED_ICOSPHERE] = 20};
    const uint32_t sides = detail / 2 > 2 ? detail / 2 : 3;
    *mesh = (closed_mesh){.kind = kind};
    if (detail > 1024)
        return false;
    const size_t triangles = kind == CLOSED_TORUS    ? (size_t)2 * detail * sides
                             : kind == CLOSED_COLUMN ? (size_t)2 * COLUMN_RINGS * detail
                                                     : (size_t)faces[kind] * detail * detail;
    if (!make_room(mesh, triangles + 8, triangles))
        return false;
    switch (kind) {
    case CLOSED_CUBE: make_cube(mesh, detail); break;
    case CLOSED_OCTAHEDRON: make_octahedron(mesh, detail); break;
    case CLOSED_ICOSPHERE: make_icosphere(mesh, detail); break;
    case CLOSED_TORUS: make_torus(mesh, detail, sides); break;
    case CLOSED_COLUMN: make_column(mesh, detail); break;
    case CLOSED_KINDS: break;
    }
    return true;
}

void closed_mesh_inside(const closed_mesh *mesh, test_random *r, double point[3])
{
    /* half the width of a box around the centre that lies well inside */
    static const double half[CLOSED_KINDS][3] = {
        {0.75, 0.75, 0.75}, {0.25, 0.25, 0.25}, {0.4, 0.4, 0.4}, {0, 0, 0.1}, {0.12, 0.12, 0.75}};
    const double turn = 2 * PI * (double)random_float(r, 0, 1);
    for (int axis = 0; axis < 3; axis++)
        point[axis] = half[mesh->kind][axis] * (double)random_float(r, -1, 1);
    if (mesh->kind == CLOSED_TORUS) {
        point[0] = cos(turn);
        point[1] = sin(turn);
    }
}

static int compare_edges(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

bool closed_mesh_is_closed(const closed_mesh *mesh)
{
    const size_t edges = (size_t)3 * mesh->triangles;
    uint64_t *edge = calloc(edges, sizeof *edge);
    bool closed = edge && edges > 0;
    for (size_t i = 0; closed && i < edges; i++)
        edge[i] = (uint64_t)mesh->index[i / 3][i % 3] << 32 | mesh->index[i / 3][(i + 1) % 3];
    if (closed)
        qsort(edge, edges, sizeof *edge, compare_edges);
    for (size_t i = 0; closed && i < edges; i++) {
        const uint64_t back = edge[i] << 32 | edge[i] >> 32;
        closed = (i == 0 || edge[i] != edge[i - 1]) && bsearch(&back, edge, edges, sizeof *edge, compare_edges);
    }
    free(edge);
    return closed;
}
