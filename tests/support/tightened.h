/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bounds tightened until they fail: a test whose bound never fails proves nothing, and a bound that fails only when far
 * tighter is wasteful. */
#ifndef TIGHTENED_H
#define TIGHTENED_H

#include <string.h>

#include "support/test.h"

/* From 1 down in steps of 2^-1/2. */
#define STEPS 24

/* Slow builds, emulators and sanitizers, do not tighten them: their arithmetic is that of others. */
static inline int bound_steps(void) { return test_scaled(100) < 20 ? 1 : STEPS; }

/* tallies: STEPS structures of `size` bytes, with a uint64_t that counts failures at byte `offset`. The bounds must
 * hold unchanged, and fail before they are as tight as `least`. */
static inline void check_break(const char *what, const void *tallies, size_t size, size_t offset, double least)
{
    double at = 0, scale = 1;
    for (int step = 0; step < bound_steps() && at == 0; step++, scale *= 0.70710678) {
        uint64_t count;
        memcpy(&count, (const char *)tallies + (size_t)step * size + offset, sizeof count);
        if (count)
            at = scale;
    }
    print_message("%s: first at %.3g of the bounds\n", what, at);
    assert_true((bound_steps() == 1 || at > least) && at < 1);
}

#endif
