/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPU's single precision, bit by bit, on a host with different floats: all arithmetic words of type f32. They
 * replace those of the mapping where CGT_SPU_EXACT is defined. spu_float_model.h defines the SPU's results, in
 * integers. Three forms give the same bits:
 *
 *   portable   element by element through the model, no mode needed: spu_exact_portable.h; for CGT_SPU_PORTABLE, other
 *              hosts, and -ffast-math
 *   x86        SSE4.1, with FMA3 where the flags allow it: spu_exact_x86.h
 *   AArch64    NEON: spu_exact_aarch64.h
 *
 * The fast forms hold between cgt_spu_enter_arithmetic and cgt_spu_leave_arithmetic (spu_arithmetic_mode.h), which make
 * the host truncate and treat denormals as zero. Then an operation gives the SPU's result except in two cases:
 *
 *   zero           may be -0: x + 0 makes it +0, and changes nothing else when truncating
 *   exponent 255   of an operand is an infinity or NaN to the host, and so is the result; a result that needs it
 *                  stops at the host's largest number. Results at or beyond that number are taken from the model.
 *
 * The compiler does not know the mode or its switches. CGT_SPU_HOLD makes a value opaque: an empty volatile asm claims
 * to change it. Held operands cannot be constant-folded in another rounding mode; a held result cannot be reassociated
 * or contracted with later operations. The compiler keeps volatile asms in order, the mode switch included, so an
 * operation between two of them stays on its side of the switch. The price: unused results and loop invariants are
 * computed anyway, every time. */
#ifndef CGT_SPU_EXACT_H
#define CGT_SPU_EXACT_H

#include "spu_arithmetic_mode.h"

#if defined(CGT_SPU_EXACT_X86)
#include <immintrin.h>
#elif defined(CGT_SPU_EXACT_AARCH64)
#include <arm_neon.h>
#endif

#include "spu_float_model.h"
#include "spu_types.h"

/* the mapping omits its own single-precision arithmetic, comparison, estimates and conversion */
#define CGT_SPU_OWN_FLOAT
#define CGT_SPU_FUSED 1

/* ---- through the model, element by element ---- */

#define CGT_SPU_EXACT_ASIDE static __attribute__((noinline, unused)) /* not inlined into every caller */

CGT_SPU_EXACT_ASIDE vec_uint4 cgt_spu_exact_each1(uint32_t (*word)(uint32_t), vec_uint4 a)
{
    return (vec_uint4){word(a[0]), word(a[1]), word(a[2]), word(a[3])};
}
CGT_SPU_EXACT_ASIDE vec_uint4 cgt_spu_exact_each2(uint32_t (*word)(uint32_t, uint32_t), vec_uint4 a, vec_uint4 b)
{
    return (vec_uint4){word(a[0], b[0]), word(a[1], b[1]), word(a[2], b[2]), word(a[3], b[3])};
}
CGT_SPU_EXACT_ASIDE vec_uint4 cgt_spu_exact_each3(uint32_t (*word)(uint32_t, uint32_t, uint32_t), vec_uint4 a,
                                                  vec_uint4 b, vec_uint4 c)
{
    return (vec_uint4){word(a[0], b[0], c[0]), word(a[1], b[1], c[1]), word(a[2], b[2], c[2]), word(a[3], b[3], c[3])};
}
CGT_SPU_EXACT_ASIDE vec_uint4 cgt_spu_exact_each_scaled(uint32_t (*word)(uint32_t, int), vec_uint4 a, int n)
{
    return (vec_uint4){word(a[0], n), word(a[1], n), word(a[2], n), word(a[3], n)};
}

#if defined(CGT_SPU_EXACT_X86)
#include "exact/spu_exact_x86.h"
#include "exact/spu_exact_fast.h"
#include "exact/spu_exact_estimate.h"
#elif defined(CGT_SPU_EXACT_AARCH64)
#include "exact/spu_exact_aarch64.h"
#include "exact/spu_exact_fast.h"
#include "exact/spu_exact_estimate.h"
#else
#include "exact/spu_exact_portable.h"
#endif

/* ---- an estimate: a line, then its value ---- */

CGT_SPU_INLINE vec_float4 cgt_spu_re_f32(vec_float4 a) { return cgt_spu_fi_f32(a, cgt_spu_frest_f32(a)); }
CGT_SPU_INLINE vec_float4 cgt_spu_rsqrte_f32(vec_float4 a) { return cgt_spu_fi_f32(a, cgt_spu_frsqest_f32(a)); }

#endif
