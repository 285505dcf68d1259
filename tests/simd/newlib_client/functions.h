/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One loop and one truth per function. The file that includes this gives the vector types of its functions:
 * CLIENT_FLOATS, CLIENT_INTS of as many bits, and CLIENT_MASKS. */
#ifndef FUNCTIONS_H
#define FUNCTIONS_H

#include <math.h>

#include "simd/newlib_client/client.h"

#define FUNCTION(name, result, call, value)                                                                            \
    static void run_##name(const void *xs, const void *ys, void *outs, size_t vectors)                                 \
    {                                                                                                                  \
        const CLIENT_FLOATS *const x = xs, *const y = ys;                                                              \
        const CLIENT_INTS *const n = ys;                                                                               \
        result *const out = outs;                                                                                      \
        for (size_t i = 0; i < vectors; i++)                                                                           \
            out[i] = call;                                                                                             \
        (void)x, (void)y, (void)n;                                                                                     \
    }                                                                                                                  \
    static long double true_##name(long double x, long double y)                                                       \
    {                                                                                                                  \
        (void)x, (void)y;                                                                                              \
        return value;                                                                                                  \
    }
#define OF_X(name, value) FUNCTION(name, CLIENT_FLOATS, _##name(x[i]), value)
#define OF_X_Y(name, value) FUNCTION(name, CLIENT_FLOATS, _##name(x[i], y[i]), value)
#define OF_X_N(name, value) FUNCTION(name, CLIENT_FLOATS, _##name(x[i], n[i]), value)
#define MASK_OF_X(name, value) FUNCTION(name, CLIENT_MASKS, _##name(x[i]), value)

/* The beginning of a row of the table, and a function of one operand. */
#define NAMED(text, name) text, run_##name, true_##name
#define F(name) NAMED(#name, name)
#define NO_Y                                                                                                           \
    {                                                                                                                  \
        NONE, 0, 0                                                                                                     \
    }

#endif
