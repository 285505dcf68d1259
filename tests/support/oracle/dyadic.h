/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Exact arithmetic on dyadic rationals, whole numbers times powers of two: sums and products of floats, without any
 * rounding. A number is a row of 32-bit limbs, trimmed at both ends, so that ordinary input stays short at any scale.
 * The capacity covers 32 factors of any finite floats, as the order of two cylinders takes: each spans 288 bits, from
 * 2^-160 to 2^128, and the sums of such products that the oracle forms take less than 500 bits more. */
#ifndef DYADIC_H
#define DYADIC_H

#include <stdint.h>

#include "support/oracle/truth.h"

#define DYADIC_LIMBS 304

typedef struct dyadic {
    int sign;  /* -1, 0, 1 */
    int low;   /* the value is sign * sum of limb[i] * 2^(32 (low + i)) */
    int count; /* limbs in use; neither the first nor the last of them is 0 */
    uint32_t limb[DYADIC_LIMBS];
} dyadic;

/* m * 2^exponent */
dyadic dyadic_make(int32_t m, int exponent);

/* The value of a finite float, read from its bits: flushing of denormals does not reach it. */
dyadic dyadic_of_float(float f);

dyadic dyadic_add(const dyadic *a, const dyadic *b);
dyadic dyadic_sub(const dyadic *a, const dyadic *b);
dyadic dyadic_mul(const dyadic *a, const dyadic *b);

/* times: -1, 0 or 1 */
dyadic dyadic_signed(const dyadic *a, int times);

/* The nearest values of truth_real, to within a few units in the last place. */
truth_real dyadic_real(const dyadic *a);

/* ---- vectors ---- */

dyadic dyadic_dot(const dyadic a[3], const dyadic b[3]);
void dyadic_cross(const dyadic a[3], const dyadic b[3], dyadic result[3]);

#endif
