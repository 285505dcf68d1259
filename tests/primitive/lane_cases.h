/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays and primitives for the tests of leaves, and their exact hits. The rays of a case are aimed at its first
 * primitive; the others are copies of it, copies moved a little, or lie elsewhere. */
#ifndef LANE_CASES_H
#define LANE_CASES_H

#include "support/oracle/oracle.h"
#include "support/test.h"

#define CASE_LANES 16 /* whole vectors of any width */

typedef enum case_family {
    CASE_INTERIOR,
    CASE_EDGES,    /* or the silhouette of a sphere */
    CASE_VERTICES, /* of spheres: from the surface */
    CASE_LATTICE,  /* small integers: hits exactly at vertices and edges, and along the plane */
    CASE_COPLANAR, /* nearly, and exactly; of spheres: silhouettes from afar */
    CASE_NEEDLES,  /* of spheres: radius 0 and slightly above */
    CASE_TINY,     /* in a large scene */
    CASE_FAR,
    CASE_INSIDE,
    CASE_RANGES, /* that begin behind the origin, near the hit or beyond it */
    CASE_AXES,   /* directions with components of 0, -0 or tiny ones */
    CASE_FLAT,   /* of triangles: in the plane within a fraction of a unit roundoff, starting next to a corner */
    CASE_ANY,    /* any numbers that rays in a structure may have */
    CASE_FAMILIES
} case_family;

const char *case_name(case_family f);

typedef struct lane_case {
    case_family family;
    oracle_primitive prim[CASE_LANES];
    truth_ray ray[CASE_LANES]; /* with unbounded ranges */
    float magnitude;           /* the scene's largest coordinate */
} lane_case;

void case_make(test_random *r, oracle_kind kind, case_family f, lane_case *c);

/* The truth for each ray with the first primitive, and for the first ray with each primitive. */
typedef struct case_truth {
    bool hit[2][CASE_LANES];
    truth_real t[2][CASE_LANES];
} case_truth;

void case_judge(const lane_case *c, case_truth *truth);

#endif
