/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sets a thread's floating-point mode for a piece of work, and restores the caller's. On x86-64 all arithmetic is SSE,
 * and its single control register is set in a few cycles; fesetenv also writes the x87 state, which takes a hundred
 * times as long. Windows' log2 and its like compute by the x87, whose control word counts there, too. */
#ifndef FLOAT_MODE_H
#define FLOAT_MODE_H

#if defined(__x86_64__)
#include <xmmintrin.h>
typedef struct float_mode {
    unsigned int sse;
    unsigned short x87; /* of Windows alone */
} float_mode;
#if defined(_WIN32)
static inline void float_mode_get_x87(float_mode *mode) { __asm__ volatile("fnstcw %0" : "=m"(mode->x87)); }
static inline void float_mode_set_x87(const float_mode *mode) { __asm__ volatile("fldcw %0" : : "m"(mode->x87)); }
#else
static inline void float_mode_get_x87(float_mode *mode) { mode->x87 = 0; }
static inline void float_mode_set_x87(const float_mode *mode) { (void)mode; }
#endif
static inline float_mode float_mode_get(void)
{
    float_mode mode = {.sse = _mm_getcsr()};
    float_mode_get_x87(&mode);
    return mode;
}
static inline void float_mode_restore(float_mode mode)
{
    float_mode_set_x87(&mode);
    _mm_setcsr(mode.sse);
}
/* Rounds to nearest, keeps denormals, masks all exceptions. Returns the mode for float_mode_restore. */
static inline float_mode float_mode_default(void)
{
    const float_mode callers = float_mode_get();
    float_mode_restore((float_mode){.sse = 0x1f80u, .x87 = 0x37f});
    return callers;
}
/* Flushes denormals to zero, results and operands, as Embree's manual requires. Elsewhere there is no such mode. */
static inline float_mode float_mode_flush(void)
{
    const float_mode callers = float_mode_get();
    _mm_setcsr(callers.sse | 0x8040u);
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
