/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words on sixteen lanes: AVX-512 F, BW, DQ and VL. Lane by lane they do what the words do on four lanes of the
 * same machine; madd, msub and nmsub are fused. A mask has a type of its own, held in a k register: it is neither
 * vector nor number. */
#ifndef CGT_SPU_AVX512_H
#define CGT_SPU_AVX512_H

#if !defined(__AVX512F__) || !defined(__AVX512BW__) || !defined(__AVX512DQ__) || !defined(__AVX512VL__)
#error "CGT_LANES is 16: the compiler must be told of AVX-512 (-mavx512f -mavx512bw -mavx512dq -mavx512vl)"
#endif

#include <immintrin.h>

#include "spu_types.h"

typedef float vfloat __attribute__((vector_size(64)));
typedef int32_t vint __attribute__((vector_size(64)));
typedef uint32_t vuint __attribute__((vector_size(64)));
typedef struct vmask {
    __mmask16 bits;
} vmask;

/* clang-format off */
#define CGT_SPU_WIDE_FSUM(word) CGT_SPU_WIDE_FSU(word) vmask : cgt_spu_##word##_maskw,
/* clang-format on */

/* ---- arithmetic ---- */
CGT_SPU_INLINE vfloat cgt_spu_madd_f32w(vfloat a, vfloat b, vfloat c)
{
    return (vfloat)_mm512_fmadd_ps((__m512)a, (__m512)b, (__m512)c);
}
CGT_SPU_INLINE vfloat cgt_spu_msub_f32w(vfloat a, vfloat b, vfloat c)
{
    return (vfloat)_mm512_fmsub_ps((__m512)a, (__m512)b, (__m512)c);
}
CGT_SPU_INLINE vfloat cgt_spu_nmsub_f32w(vfloat a, vfloat b, vfloat c)
{
    return (vfloat)_mm512_fnmadd_ps((__m512)a, (__m512)b, (__m512)c);
}

/* estimates: relative error at most 2^-14 */
CGT_SPU_INLINE vfloat cgt_spu_re_f32w(vfloat a) { return (vfloat)_mm512_rcp14_ps((__m512)a); }
CGT_SPU_INLINE vfloat cgt_spu_rsqrte_f32w(vfloat a)
{
    return (vfloat)_mm512_rsqrt14_ps(_mm512_andnot_ps(_mm512_set1_ps(-0.f), (__m512)a));
}

/* ---- compare ---- */
CGT_SPU_INLINE vmask cgt_spu_cmpgt_f32w(vfloat a, vfloat b)
{
    return (vmask){_mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_GT_OQ)};
}
CGT_SPU_INLINE vmask cgt_spu_cmpgt_s32w(vint a, vint b)
{
    return (vmask){_mm512_cmpgt_epi32_mask((__m512i)a, (__m512i)b)};
}
CGT_SPU_INLINE vmask cgt_spu_cmpgt_u32w(vuint a, vuint b)
{
    return (vmask){_mm512_cmpgt_epu32_mask((__m512i)a, (__m512i)b)};
}
CGT_SPU_INLINE vmask cgt_spu_cmpeq_f32w(vfloat a, vfloat b)
{
    return (vmask){_mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_EQ_OQ)};
}
CGT_SPU_INLINE vmask cgt_spu_cmpeq_s32w(vint a, vint b)
{
    return (vmask){_mm512_cmpeq_epi32_mask((__m512i)a, (__m512i)b)};
}
CGT_SPU_INLINE vmask cgt_spu_cmpeq_u32w(vuint a, vuint b)
{
    return (vmask){_mm512_cmpeq_epi32_mask((__m512i)a, (__m512i)b)};
}
CGT_SPU_INLINE vmask cgt_spu_cmpabsgt_f32w(vfloat a, vfloat b)
{
    const __m512 sign = _mm512_set1_ps(-0.f);
    return (vmask){
        _mm512_cmp_ps_mask(_mm512_andnot_ps(sign, (__m512)a), _mm512_andnot_ps(sign, (__m512)b), _CMP_GT_OQ)};
}

/* ---- bits ---- */
CGT_SPU_INLINE vmask cgt_spu_and_maskw(vmask a, vmask b) { return (vmask){_kand_mask16(a.bits, b.bits)}; }
CGT_SPU_INLINE vmask cgt_spu_or_maskw(vmask a, vmask b) { return (vmask){_kor_mask16(a.bits, b.bits)}; }
CGT_SPU_INLINE vmask cgt_spu_xor_maskw(vmask a, vmask b) { return (vmask){_kxor_mask16(a.bits, b.bits)}; }
CGT_SPU_INLINE vmask cgt_spu_andc_maskw(vmask a, vmask b) { return (vmask){_kandn_mask16(b.bits, a.bits)}; }
CGT_SPU_INLINE vmask cgt_spu_nor_maskw(vmask a, vmask b) { return (vmask){_knot_mask16(_kor_mask16(a.bits, b.bits))}; }

/* sel: bits of b where m is one, else of a. The immediate is the truth table. */
CGT_SPU_INLINE vuint cgt_spu_sel_u32w(vuint a, vuint b, vuint m)
{
    return (vuint)_mm512_ternarylogic_epi32((__m512i)a, (__m512i)b, (__m512i)m, 0xd8);
}

/* ---- shifts: by one count for all lanes; from 32 on it pushes out all bits ---- */
CGT_SPU_INLINE vuint cgt_spu_sl_u32w(vuint a, unsigned n)
{
    return (vuint)_mm512_sll_epi32((__m512i)a, _mm_cvtsi32_si128((int)(n & 63)));
}
CGT_SPU_INLINE vuint cgt_spu_sr_u32w(vuint a, unsigned n)
{
    return (vuint)_mm512_srl_epi32((__m512i)a, _mm_cvtsi32_si128((int)(n & 63)));
}
CGT_SPU_INLINE vint cgt_spu_sra_s32w(vint a, unsigned n)
{
    return (vint)_mm512_sra_epi32((__m512i)a, _mm_cvtsi32_si128((int)(n & 63)));
}

#include "spu_wide_words.h"

/* ---- convert ---- */

/* convtf: rounded once to float, then divided by 2^n */
CGT_SPU_INLINE vfloat cgt_spu_convtf_s32w(vint a, int n)
{
    return (vfloat)_mm512_cvtepi32_ps((__m512i)a) * cgt_spu_power_w(-n);
}
CGT_SPU_INLINE vfloat cgt_spu_convtf_u32w(vuint a, int n)
{
    return (vfloat)_mm512_cvtepu32_ps((__m512i)a) * cgt_spu_power_w(-n);
}

/* convts: times 2^n, towards zero, saturated; NaN gives 0. cvttps gives 0x80000000 for values out of range: right for
 * small ones, replaced for large ones. */
CGT_SPU_INLINE vint cgt_spu_convts_f32w(vfloat a, int n)
{
    __m512 x = (__m512)(a * cgt_spu_power_w(n));
#if !defined(__clang__)
    __asm__("" : "+v"(x)); /* GCC folds out-of-range constants to another result than the instruction's */
#endif
    const __mmask16 number = _mm512_cmp_ps_mask(x, x, _CMP_ORD_Q);
    const __mmask16 large = _mm512_cmp_ps_mask(x, _mm512_set1_ps(2147483648.f), _CMP_GE_OQ);
    const __m512i d = _mm512_maskz_cvttps_epi32(number, x);
    return (vint)_mm512_mask_mov_epi32(d, large, _mm512_set1_epi32(INT32_MAX));
}

#endif
