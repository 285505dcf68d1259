/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Closed meshes on lattices of whole numbers, rays aimed exactly at their edges and vertices, and what is inside by
 * arithmetic of its own: 128 bits, a direction in general position, and a shift of the origin by real numbers. Shares
 * no code with the library. Free of the test framework. */
#ifndef CROSSING_CASES_H
#define CROSSING_CASES_H

#include "support/closed_meshes.h"

#ifdef __SIZEOF_INT128__
#define CROSSING_JUDGE 1
#else
#define CROSSING_JUDGE 0 /* no judge without integers of 128 bits */
#endif

typedef enum crossing_shape {
    CROSSING_FINE,    /* the mesh rounded to a fine lattice: all origins but those on the surface are judged */
    CROSSING_THIN,    /* fine, but one or two units thick */
    CROSSING_COARSE,  /* rounded to a lattice of few units: triangles coincide, or have no area; all are judged */
    CROSSING_TANGLED, /* vertices anywhere on such a lattice */
    CROSSING_SHAPES
} crossing_shape;

typedef struct crossing_mesh {
    closed_kind kind;
    crossing_shape shape;
    int reach; /* no coordinate is beyond it */
    uint32_t triangles;
    int (*corner)[3][3]; /* x, y, z of each triangle's corners, oriented outwards */
} crossing_mesh;

/* Some triangles have a partner that runs the other way, some are cut at the middle of an edge, whose other side keeps
 * it, with a triangle without area between. False where memory is refused. */
bool crossing_mesh_make(crossing_mesh *m, closed_kind kind, crossing_shape shape, test_random *r);
void crossing_mesh_free(crossing_mesh *m);

/* A ray through a vertex or an edge, or along one; from anywhere, along an axis, in a triangle's plane, or from the
 * surface. */
typedef struct crossing_ray {
    int org[3], dir[3];
} crossing_ray;
crossing_ray crossing_ray_make(const crossing_mesh *m, test_random *r);

/* The winding number of the origin, moved by (h^4, h^5, h^6) with an h small enough for the lattice. False where it is
 * not known: on the surface of a fine mesh. */
bool crossing_winding(const crossing_mesh *m, const int org[3], test_random *r, int *winding);

#endif
