/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Flushes denormals to zero, results and operands, for a thread of compare-embree, as Embree's manual requires. Does
 * nothing where there is no such mode. */
#ifndef NATIVE_FLUSH_H
#define NATIVE_FLUSH_H

#if defined(__SSE2__)
#include <xmmintrin.h>
/* Returns the state for native_flush_end. */
static inline unsigned int native_flush_begin(void)
{
    const unsigned int callers = _mm_getcsr();
    _mm_setcsr(callers | 0x8040u);
    return callers;
}
static inline void native_flush_end(unsigned int callers) { _mm_setcsr(callers); }
#else
static inline unsigned int native_flush_begin(void) { return 0; }
static inline void native_flush_end(unsigned int callers) { (void)callers; }
#endif

#endif
