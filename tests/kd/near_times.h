/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Two planes that a ray crosses at nearly the same t: too close for double. */
#ifndef NEAR_TIMES_H
#define NEAR_TIMES_H

#include "support/random.h"

#include "papers/model/plane_order.h"

/* x1 / d1 and x2 / d2 with x1 d2 - x2 d1 = k, a few units where the products have 72 bits: d1 and d2 of 24 bits, x1 and
 * x2 of 48, each the difference of two floats. Bezout's identity, by Euclid. Everything but the origins is positive.
 * Returns k, from -2 to 2: the order of the times. */
static inline int near_times_make(test_random *r, cgt_plane_time t[2])
{
    int64_t d1, d2, a, b, u, next;
    do {
        d1 = 3 + (int64_t)random_below(r, (1 << 24) - 3);
        d2 = 3 + (int64_t)random_below(r, (1 << 24) - 3);
        a = d2, b = d1, u = 1, next = 0; /* u d2 = a, next d2 = b modulo d1 */
        while (b) {
            const int64_t q = a / b, rest = a - q * b, u_rest = u - q * next;
            a = b;
            b = rest;
            u = next;
            next = u_rest;
        }
    } while (a != 1); /* not coprime */
    const int64_t k = (int64_t)random_below(r, 5) - 2, x0 = (k * u % d1 + d1) % d1, y0 = (x0 * d2 - k) / d1;
    const uint64_t reach = ((UINT64_C(1) << 48) - 1) / (uint64_t)(d1 > d2 ? d1 : d2) - 8;
    const int64_t turns = 4 + (int64_t)(random_bits(r) % reach), x1 = x0 + turns * d1, x2 = y0 + turns * d2;
    t[0] = (cgt_plane_time){(float)(x1 >> 24 << 24), -(float)(x1 & 0xffffff), (float)d1};
    t[1] = (cgt_plane_time){(float)(x2 >> 24 << 24), -(float)(x2 & 0xffffff), (float)d2};
    return (int)k;
}

#endif
