/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays at one primitive, for the stage of double precision: ordinary rays, and rays whose terms cancel in double. */
#ifndef DOUBLE_CASES_H
#define DOUBLE_CASES_H

#include "support/oracle/oracle.h"
#include "support/random.h"
#include "exact/decide.h"

typedef enum double_family {
    ANYWHERE,
    AT_EDGES,
    FAR_AWAY,
    SLIVERS,
    LATTICE, /* small whole numbers: rays go exactly through edges, vertices and silhouettes, and start on surfaces */
    HUGE_OR_TINY,
    GRAZING, /* spheres whose silhouette is passed within 2^-40 to 2^-60 of the distance */
    DOUBLE_FAMILIES
} double_family;

const char *double_family_name(double_family f);

/* A sphere or a triangle, and a ray aimed at a point inside it, on its border, or just outside the border. */
void double_case_shape(test_random *r, double_family f, bool sphere, oracle_primitive *q);
truth_ray double_case_ray(test_random *r, double_family f, const oracle_primitive *q);

/* A ray and its primitive. Family HUGE_OR_TINY scales both by one power of two and the direction by another. Only here
 * GRAZING is a family of its own. */
void double_case_make(test_random *r, double_family f, bool sphere, oracle_primitive *q, truth_ray *ray);

/* The same in the library's own types. */
cgt_primitive double_case_shape_of(const oracle_primitive *q);
cgt_ray double_case_ray_of(const truth_ray *ray);

#endif
