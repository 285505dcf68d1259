/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sets a thread's floating-point mode for a piece of work, and restores the caller's. On x86-64 all arithmetic is SSE,
 * and its single control register is set in a few cycles; fesetenv also writes the x87 state, which takes a hundred
 * times as long. */
#ifndef FLOAT_MODE_H
#define FLOAT_MODE_H

#if defined(__x86_64__)
#include <xmmintrin.h>
typedef unsigned int float_mode;
static inline void float_mode_restore(float_mode callers) { _mm_setcsr(callers); }
/* Rounds to nearest, keeps denormals, masks all exceptions. Returns the mode for float_mode_restore. */
static inline float_mode float_mode_default(void)
{
    const float_mode callers = _mm_getcsr();
    _mm_setcsr(0x1f80u);
    return callers;
}
/* Flushes denormals to zero, results and operands, as Embree's manual requires. Elsewhere there is no such mode. */
static inline float_mode float_mode_flush(void)
{
    const float_mode callers = _mm_getcsr();
    _mm_setcsr(callers | 0x8040u);
    return callers;
}
#else
#include <fenv.h>
typedef fenv_t float_mode;
static inline void float_mode_restore(float_mode callers) { fesetenv(&callers); }
static inline float_mode float_mode_default(void)
{
    fenv_t callers;
    fegetenv(&callers);
    fesetenv(FE_DFL_ENV);
    return callers;
}
static inline float_mode float_mode_flush(void)
{
    fenv_t callers;
    fegetenv(&callers);
    return callers;
}
#endif

#endif
