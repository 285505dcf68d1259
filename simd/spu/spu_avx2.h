/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words on eight lanes: AVX2 with FMA. Lane by lane they do what the words do on four lanes of the same machine;
 * madd, msub and nmsub are fused. A mask is a vuint, all ones where true, else zero. */
#ifndef CGT_SPU_AVX2_H
#define CGT_SPU_AVX2_H

#if !defined(__AVX2__) || !defined(__FMA__)
#error "CGT_LANES is 8: the compiler must be told of AVX2 and FMA (-mavx2 -mfma)"
#endif

#include <immintrin.h>

#include "spu_types.h"

typedef float vfloat __attribute__((vector_size(32)));
typedef int32_t vint __attribute__((vector_size(32)));
typedef uint32_t vuint __attribute__((vector_size(32)));
typedef vuint vmask;

/* clang-format off */
#define CGT_SPU_WIDE_FSUM(word) CGT_SPU_WIDE_FSU(word)
/* clang-format on */

/* ---- arithmetic ---- */
CGT_SPU_INLINE vfloat cgt_spu_madd_f32w(vfloat a, vfloat b, vfloat c)
{
    return (vfloat)_mm256_fmadd_ps((__m256)a, (__m256)b, (__m256)c);
}
CGT_SPU_INLINE vfloat cgt_spu_msub_f32w(vfloat a, vfloat b, vfloat c)
{
    return (vfloat)_mm256_fmsub_ps((__m256)a, (__m256)b, (__m256)c);
}
CGT_SPU_INLINE vfloat cgt_spu_nmsub_f32w(vfloat a, vfloat b, vfloat c)
{
    return (vfloat)_mm256_fnmadd_ps((__m256)a, (__m256)b, (__m256)c);
}

/* estimates: relative error at most 1.5 * 2^-12; the bits differ between CPU vendors */
CGT_SPU_INLINE vfloat cgt_spu_re_f32w(vfloat a) { return (vfloat)_mm256_rcp_ps((__m256)a); }
CGT_SPU_INLINE vfloat cgt_spu_rsqrte_f32w(vfloat a)
{
    return (vfloat)_mm256_rsqrt_ps(_mm256_andnot_ps(_mm256_set1_ps(-0.f), (__m256)a));
}

/* ---- compare ---- */
CGT_SPU_INLINE vmask cgt_spu_cmpgt_f32w(vfloat a, vfloat b) { return (vmask)(a > b); }
CGT_SPU_INLINE vmask cgt_spu_cmpgt_s32w(vint a, vint b) { return (vmask)(a > b); }
CGT_SPU_INLINE vmask cgt_spu_cmpgt_u32w(vuint a, vuint b) { return (vmask)(a > b); }
CGT_SPU_INLINE vmask cgt_spu_cmpeq_f32w(vfloat a, vfloat b) { return (vmask)(a == b); }
CGT_SPU_INLINE vmask cgt_spu_cmpeq_s32w(vint a, vint b) { return (vmask)(a == b); }
CGT_SPU_INLINE vmask cgt_spu_cmpeq_u32w(vuint a, vuint b) { return (vmask)(a == b); }
CGT_SPU_INLINE vmask cgt_spu_cmpabsgt_f32w(vfloat a, vfloat b)
{
    const __m256 sign = _mm256_set1_ps(-0.f);
    return (vmask)((vfloat)_mm256_andnot_ps(sign, (__m256)a) > (vfloat)_mm256_andnot_ps(sign, (__m256)b));
}

/* ---- bits ---- */

/* sel: bits of b where m is one, else of a */
CGT_SPU_INLINE vuint cgt_spu_sel_u32w(vuint a, vuint b, vuint m) { return (a & ~m) | (b & m); }

/* ---- shifts: by one count for all lanes; from 32 on it pushes out all bits ---- */
CGT_SPU_INLINE vuint cgt_spu_sl_u32w(vuint a, unsigned n)
{
    return (vuint)_mm256_sll_epi32((__m256i)a, _mm_cvtsi32_si128((int)(n & 63)));
}
CGT_SPU_INLINE vuint cgt_spu_sr_u32w(vuint a, unsigned n)
{
    return (vuint)_mm256_srl_epi32((__m256i)a, _mm_cvtsi32_si128((int)(n & 63)));
}
CGT_SPU_INLINE vint cgt_spu_sra_s32w(vint a, unsigned n)
{
    return (vint)_mm256_sra_epi32((__m256i)a, _mm_cvtsi32_si128((int)(n & 63)));
}

#include "spu_wide_words.h"

/* ---- convert ---- */

/* convtf: rounded once to float, then divided by 2^n */
CGT_SPU_INLINE vfloat cgt_spu_convtf_s32w(vint a, int n)
{
    return __builtin_convertvector(a, vfloat) * cgt_spu_power_w(-n);
}
CGT_SPU_INLINE vfloat cgt_spu_convtf_u32w(vuint a, int n)
{
    /* both halves become lowest bits of 2^23 and 2^39; the excess is subtracted exactly, and the sum is rounded once */
    const __m256i low = _mm256_blend_epi16((__m256i)a, _mm256_set1_epi32(0x4b000000), 0xaa);
    const __m256i high = _mm256_blend_epi16(_mm256_srli_epi32((__m256i)a, 16), _mm256_set1_epi32(0x53000000), 0xaa);
    return (((vfloat)high - 0x1.0001p39f) + (vfloat)low) * cgt_spu_power_w(-n);
}

/* convts: times 2^n, towards zero, saturated; NaN gives 0. cvttps gives 0x80000000 for values out of range: flip it to
 * the largest int where the operand was large, and to 0 where it was NaN. */
CGT_SPU_INLINE vint cgt_spu_convts_f32w(vfloat a, int n)
{
    __m256 x = (__m256)(a * cgt_spu_power_w(n));
#if !defined(__clang__)
    __asm__("" : "+x"(x)); /* GCC folds out-of-range constants to another result than the instruction's */
#endif
    const __m256i d = _mm256_cvttps_epi32(x);
    const __m256i large = _mm256_castps_si256(_mm256_cmp_ps(x, _mm256_set1_ps(2147483648.f), _CMP_GE_OQ));
    const __m256i number = _mm256_castps_si256(_mm256_cmp_ps(x, x, _CMP_ORD_Q));
    return (vint)_mm256_and_si256(_mm256_xor_si256(d, large), number);
}

#endif
