/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Random rays and primitives for the exact stage, in families, from ordinary input to the ends of the range of
 * float. */
#ifndef EXACT_CASES_H
#define EXACT_CASES_H

#include "exact/integer/exact.h"
#include "support/random.h"

typedef enum exact_family {
    EXACT_ORDINARY, /* coordinates to 100, origins to 10 */
    EXACT_FAR,      /* from 1e5 away */
    EXACT_GRID,     /* quarters up to 4: lines through edges and vertices, tangents, ties */
    EXACT_PLACES,   /* the same with one vertex 2^-32 or 2^-70 times as far from 0: needs wider arithmetic */
    EXACT_AIMED,    /* at edges and vertices, as far as rounding allows; spheres that the line just touches */
    EXACT_ALIKE,    /* the second primitive is the first one rotated, copied, or one ulp off */
    EXACT_CLOSE,    /* triangles through the points where the line enters and leaves the sphere */
    EXACT_SPREAD,   /* coordinates from 1e-3 to 1e6 */
    EXACT_SCALES,   /* from 2^-60 to 2^60 */
    EXACT_ANY,      /* any finite floats */
    EXACT_ENDS,     /* the largest and the smallest mixed: the widest integers possible */
    EXACT_DENORMAL, /* denormals and the smallest normal floats */
    EXACT_LEAST,    /* small multiples of the smallest float: whole numbers of few bits */
    EXACT_FAMILIES
} exact_family;

typedef struct exact_case {
    cgt_exact_ray ray;
    cgt_primitive primitive[6]; /* two triangles, two spheres, two capsules */
} exact_case;

const char *exact_family_name(exact_family family);

/* Whether the line of the ray meets the primitive. */
bool exact_meets(const cgt_exact_ray *ray, const cgt_primitive *primitive);

exact_case exact_case_make(test_random *r, exact_family family);

#endif
