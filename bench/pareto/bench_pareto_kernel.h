/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The tests of FAST precision alone, without structure and choice: every primitive against every ray of a packet. One
 * function per row of the variant table, and where vectors are an SPU's one more in the SPU's own arithmetic. */
#ifndef BENCH_PARETO_KERNEL_H
#define BENCH_PARETO_KERNEL_H

#include <stdint.h>

enum { PARETO_RAYS = 256 }; /* of a packet */

typedef enum pareto_test {
    PARETO_SPHERE,
    PARETO_WATERTIGHT,
    PARETO_MOLLER_TRUMBORE,
    PARETO_ACCELERATED,
    PARETO_TESTS
} pareto_test;

typedef struct pareto_work {
    pareto_test test;
    float org[3]; /* of all rays */
    const float (*dir)[3];
    uint32_t primitives;         /* a multiple of 16 */
    const float (*primitive)[9]; /* x, y, z, r of a sphere; three vertices of a triangle */
    float *t;                    /* PARETO_RAYS for each primitive, aligned to 64 bytes: +infinity where it is missed */
} pareto_work;

typedef void pareto_kernel(const pareto_work *work);

#endif
