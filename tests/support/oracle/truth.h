/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where a line meets a sphere: the textbook quadratic, unrelated to the library's form, in the widest arithmetic of the
 * machine. oracle.h decides and judges hits. In binary128 the discriminant of float input with similar exponents is
 * exact: products of four 25-bit differences fit 113 bits except for the last sums. */
#ifndef TRUTH_H
#define TRUTH_H

#include <stdbool.h>
#include <stdint.h>

#if defined(__x86_64__) && defined(__SIZEOF_FLOAT128__)
typedef __float128 truth_real; /* binary128 by the compiler's run-time library */
#else
typedef long double truth_real; /* binary128 on AArch64, a pair of doubles on POWER */
#endif

/* Accurate to a few units in the last place; 0 for operands that are not positive. */
truth_real truth_square_root(truth_real a);

typedef struct truth_roots {
    bool hit;             /* the line meets the closed ball */
    truth_real near, far; /* its parameters, near <= far */
    double h;             /* r^2 - (distance of centre and line)^2, negative for a miss */
    double doubt_h;       /* error that double precision may have in h */
} truth_roots;

truth_roots truth_sphere(const float org[3], const float dir[3], const float sphere[4]);

/* True where hit or miss is beyond the reach of double precision. */
bool truth_in_doubt(const truth_roots *roots);

/* ---- rays ---- */

typedef struct truth_ray {
    float org[3], dir[3];
    float t_min, t_max;
} truth_ray;

#endif
