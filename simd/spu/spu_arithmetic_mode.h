/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The mode of the host's floating-point unit in which the words of spu_exact.h give the SPU's results:
 *
 *   const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
 *   ... spu_madd(a, b, c) ...
 *   cgt_spu_leave_arithmetic(saved);
 *
 * Truncation, no denormals, no traps. The mode is per thread; pairs may be nested; leaving restores the whole earlier
 * state, exception flags included. It costs about twenty nanoseconds: put it around a kernel, not a word.
 *
 * With CGT_SPU_EXACT each single-precision word stays between the two calls (spu_exact.h says how). Other arithmetic
 * on floats and doubles does not: the compiler may move plain C arithmetic across them, and what stays is truncated,
 * double precision included. So keep plain arithmetic out of the function that enters and leaves.
 *
 * The calls do nothing where the words need no mode: without CGT_SPU_EXACT, in the portable form, and on an SPU. All
 * files of a program that enter, leave or compute in the mode must be compiled with the same choice. */
#ifndef CGT_SPU_ARITHMETIC_MODE_H
#define CGT_SPU_ARITHMETIC_MODE_H

#include <stdint.h>

/* Selects the form of the exact words, for spu_exact.h too. There is no fast form under -ffast-math: the compiler would
 * remove the tests for infinities and NaN. */
#if defined(CGT_SPU_EXACT) && !defined(CGT_SPU_PORTABLE) && !(defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#if defined(__SSE4_1__)
#define CGT_SPU_EXACT_X86
#elif defined(__aarch64__) && !defined(__AARCH64EB__)
#define CGT_SPU_EXACT_AARCH64
#endif
#endif

typedef struct cgt_spu_arithmetic {
    uint64_t state; /* MXCSR, or FPSR and FPCR */
} cgt_spu_arithmetic;

#define CGT_SPU_MODE static inline __attribute__((always_inline, unused))

#if defined(CGT_SPU_EXACT_X86)

/* MXCSR: flush to zero (bit 15), truncate (14, 13), all exceptions masked (12 to 7), denormals are zero (6). Without
 * the first, denormal results would still become zero, by the addition of zero, but slowly. */
CGT_SPU_MODE cgt_spu_arithmetic cgt_spu_enter_arithmetic(void)
{
    const uint32_t mode = 0xffc0;
    uint32_t saved;
    __asm__ volatile("stmxcsr %0" : "=m"(saved) : : "memory");
    __asm__ volatile("ldmxcsr %0" : : "m"(mode) : "memory");
    return (cgt_spu_arithmetic){saved};
}
CGT_SPU_MODE void cgt_spu_leave_arithmetic(cgt_spu_arithmetic saved)
{
    const uint32_t mode = (uint32_t)saved.state;
    __asm__ volatile("ldmxcsr %0" : : "m"(mode) : "memory");
}

#elif defined(CGT_SPU_EXACT_AARCH64)

/* FPCR: flush to zero, operands and results (bit 24), truncate (23, 22); all exceptions masked. FPSR has the flags. */
CGT_SPU_MODE cgt_spu_arithmetic cgt_spu_enter_arithmetic(void)
{
    const uint64_t mode = 0x01c00000;
    uint64_t control, flags;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control) : : "memory");
    __asm__ volatile("mrs %0, fpsr" : "=r"(flags) : : "memory");
    __asm__ volatile("msr fpcr, %0" : : "r"(mode) : "memory");
    return (cgt_spu_arithmetic){flags << 32 | control};
}
CGT_SPU_MODE void cgt_spu_leave_arithmetic(cgt_spu_arithmetic saved)
{
    const uint64_t control = saved.state & UINT32_MAX, flags = saved.state >> 32;
    __asm__ volatile("msr fpsr, %0" : : "r"(flags) : "memory");
    __asm__ volatile("msr fpcr, %0" : : "r"(control) : "memory");
}

#else

CGT_SPU_MODE cgt_spu_arithmetic cgt_spu_enter_arithmetic(void) { return (cgt_spu_arithmetic){0}; }
CGT_SPU_MODE void cgt_spu_leave_arithmetic(cgt_spu_arithmetic saved) { (void)saved; }

#endif
#endif
