/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Denormals as zero, in what is computed and in what is read, for a thread of compare-embree: Embree's manual asks for
 * it. Nothing where there is no such mode. */
#ifndef NATIVE_FLUSH_H
#define NATIVE_FLUSH_H

#if defined(__SSE2__)
#include <xmmintrin.h>
/* Returns what native_flush_end takes back. */
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
