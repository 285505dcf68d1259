/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sets the default floating-point environment for a piece of work. On x86-64 all arithmetic is SSE, and its single
 * control register is set in a few cycles; fesetenv also writes the x87 state, which takes a hundred times as long. */
#ifndef NATIVE_ENVIRONMENT_H
#define NATIVE_ENVIRONMENT_H

#if defined(__x86_64__)
#include <xmmintrin.h>
typedef unsigned int native_environment;
/* Returns the state for native_environment_end. */
static inline native_environment native_environment_begin(void)
{
    const unsigned int callers = _mm_getcsr();
    _mm_setcsr(0x1f80u); /* round to nearest, keep denormals, mask all exceptions */
    return callers;
}
static inline void native_environment_end(native_environment callers) { _mm_setcsr(callers); }
#else
#include <fenv.h>
typedef fenv_t native_environment;
static inline native_environment native_environment_begin(void)
{
    fenv_t callers;
    fegetenv(&callers);
    fesetenv(FE_DFL_ENV);
    return callers;
}
static inline void native_environment_end(native_environment callers) { fesetenv(&callers); }
#endif

#endif
