/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The intersection tests of FAST without a structure and without choosing the closest hit: every primitive against
 * every ray of a packet. One function per variant, and one more in the SPU's own arithmetic for a variant of four
 * lanes. */
#ifndef ACCURACY_KERNEL_H
#define ACCURACY_KERNEL_H

#include <stdint.h>

enum { ACCURACY_RAYS = 256 }; /* of a packet */

typedef enum accuracy_test {
    ACCURACY_SPHERE,
    ACCURACY_WATERTIGHT,
    ACCURACY_MOLLER_TRUMBORE,
    ACCURACY_ACCELERATED,
    ACCURACY_TESTS
} accuracy_test;

typedef struct accuracy_work {
    accuracy_test test;
    float org[3]; /* of all rays */
    const float (*dir)[3];
    uint32_t primitives;         /* a multiple of 16 */
    const float (*primitive)[9]; /* x, y, z, r of a sphere; three vertices of a triangle */
    float *t; /* ACCURACY_RAYS for each primitive, aligned to 64 bytes: +infinity where it is missed */
} accuracy_work;

typedef void accuracy_kernel(const accuracy_work *work);

#endif
