/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Closed meshes: every edge belongs to two triangles, so that a ray from inside must hit. */
#ifndef CLOSED_MESHES_H
#define CLOSED_MESHES_H

#include <stdbool.h>
#include <stdint.h>

#include "support/random.h"

typedef enum closed_kind {
    CLOSED_CUBE,       /* edge 2, faces of detail^2 squares; vertices and the middles of edges are short fractions where
                          detail is a power of two */
    CLOSED_OCTAHEDRON, /* corners at distance 1, faces divided detail times, all vertices short fractions likewise */
    CLOSED_ICOSPHERE,  /* radius 1, 20 faces divided detail times */
    CLOSED_TORUS,      /* radii 1 and 3/8, detail times detail / 2 squares */
    CLOSED_COLUMN,     /* height 2, radius about 1/2, detail sides, twisted by half a turn: long crooked triangles */
    CLOSED_KINDS
} closed_kind;

typedef struct closed_mesh {
    closed_kind kind;
    uint32_t vertices, triangles;
    double (*vertex)[3]; /* about the origin; not yet rounded to float */
    uint32_t (*index)[3];
} closed_mesh;

/* detail: 1 or more, in meshes of rings 3 or more. False where memory is refused. */
bool closed_mesh_make(closed_mesh *mesh, closed_kind kind, uint32_t detail);
void closed_mesh_free(closed_mesh *mesh);

const char *closed_mesh_name(closed_kind kind);

/* A point inside, no nearer to the surface than about a tenth of the mesh. */
void closed_mesh_inside(const closed_mesh *mesh, test_random *r, double point[3]);

/* Whether every edge is met by two triangles, in opposite directions. */
bool closed_mesh_is_closed(const closed_mesh *mesh);

#endif
