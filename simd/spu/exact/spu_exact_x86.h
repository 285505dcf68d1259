/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The host functions that spu_exact_fast.h needs, with SSE4.1. A part of spu_exact.h. */
#ifndef CGT_SPU_EXACT_X86_H
#define CGT_SPU_EXACT_X86_H

#define CGT_SPU_HOLD(v) __asm__ volatile("" : "+x"(v))

CGT_SPU_INLINE int cgt_spu_exact_is_outside(vec_float4 r)
{
    const __m128 magnitude = _mm_and_ps((__m128)r, _mm_castsi128_ps(_mm_set1_epi32(0x7fffffff)));
    const __m128 largest = _mm_castsi128_ps(_mm_set1_epi32(0x7f7fffff));
    return _mm_movemask_ps(_mm_cmpnlt_ps(magnitude, largest));
}

CGT_SPU_INLINE int cgt_spu_exact_is_unordered(vec_float4 a, vec_float4 b)
{
    return _mm_movemask_ps(_mm_cmpunord_ps((__m128)a, (__m128)b));
}

/* ---- fused operations ---- */

#if defined(__FMA__)

CGT_SPU_INLINE vec_float4 cgt_spu_exact_fused_madd(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return (vec_float4)_mm_fmadd_ps((__m128)a, (__m128)b, (__m128)c);
}
CGT_SPU_INLINE vec_float4 cgt_spu_exact_fused_msub(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return (vec_float4)_mm_fmsub_ps((__m128)a, (__m128)b, (__m128)c);
}
CGT_SPU_INLINE vec_float4 cgt_spu_exact_fused_nmsub(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return (vec_float4)_mm_fnmadd_ps((__m128)a, (__m128)b, (__m128)c);
}

#else

/* In doubles, truncated twice. The product of two floats has 48 bits and an exponent from -252 to 255, so it is exact
 * in double. The sum is truncated to 53 bits, then to the 24 of a float. That equals truncating the exact sum once:
 * every float is a double, so no float lies between the exact sum and its truncation to double. A sum other than 0 is
 * at least 2^-298, a normal double; the conversion flushes values below the smallest float and stops at the largest. */
CGT_SPU_INLINE __m128 cgt_spu_exact_half_madd(__m128 a, __m128 b, __m128 c)
{
    const __m128d product = _mm_mul_pd(_mm_cvtps_pd(a), _mm_cvtps_pd(b));
    return _mm_cvtpd_ps(_mm_add_pd(product, _mm_cvtps_pd(c)));
}
CGT_SPU_INLINE vec_float4 cgt_spu_exact_fused_madd(vec_float4 a, vec_float4 b, vec_float4 c)
{
    const __m128 a4 = (__m128)a, b4 = (__m128)b, c4 = (__m128)c;
    const __m128 low = cgt_spu_exact_half_madd(a4, b4, c4);
    const __m128 high = cgt_spu_exact_half_madd(_mm_movehl_ps(a4, a4), _mm_movehl_ps(b4, b4), _mm_movehl_ps(c4, c4));
    return (vec_float4)_mm_movelh_ps(low, high);
}
CGT_SPU_INLINE vec_float4 cgt_spu_exact_negate(vec_float4 a) { return (vec_float4)((vec_uint4)a ^ 0x80000000u); }
CGT_SPU_INLINE vec_float4 cgt_spu_exact_fused_msub(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return cgt_spu_exact_fused_madd(a, b, cgt_spu_exact_negate(c));
}
CGT_SPU_INLINE vec_float4 cgt_spu_exact_fused_nmsub(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return cgt_spu_exact_fused_madd(cgt_spu_exact_negate(a), b, c);
}

#endif

/* ---- conversion ---- */

CGT_SPU_INLINE vec_float4 cgt_spu_exact_to_float_s32(vec_int4 a) { return (vec_float4)_mm_cvtepi32_ps((__m128i)a); }

/* A 32-bit integer loses its lowest 8 bits in any case: it is converted without them, then scaled back. */
CGT_SPU_INLINE vec_float4 cgt_spu_exact_to_float_u32(vec_uint4 a)
{
    const vec_uint4 is_large = (vec_uint4)((vec_int4)a >> 31);
    vec_float4 r = (vec_float4)_mm_cvtepi32_ps((__m128i)((a & ~is_large) | (a >> 8 & is_large)));
    CGT_SPU_HOLD(r);
    return (vec_float4)((vec_uint4)r + (is_large & 0x04000000)); /* 8 in the exponent */
}

/* cvttps gives 0x80000000 for all values out of range. */
CGT_SPU_INLINE vec_int4 cgt_spu_exact_to_int(vec_float4 p, vec_int4 sign)
{
    vec_int4 r = (vec_int4)_mm_cvttps_epi32((__m128)p);
    CGT_SPU_HOLD(r);
    return r ^ ((vec_int4)(r == INT32_MIN) & ~sign);
}

/* From 2^31 on, 2^31 is subtracted, which is exact, and restored as a bit. Values still out of range are too large. */
CGT_SPU_INLINE vec_uint4 cgt_spu_exact_to_uint(vec_float4 p, vec_int4 sign)
{
    const __m128 limit = _mm_castsi128_ps(_mm_set1_epi32(0x4f000000)); /* 2^31 */
    const __m128 is_large = _mm_cmpnlt_ps((__m128)p, limit);
    vec_uint4 r = (vec_uint4)_mm_cvttps_epi32(_mm_sub_ps((__m128)p, _mm_and_ps(is_large, limit)));
    CGT_SPU_HOLD(r);
    const vec_uint4 too_large = (vec_uint4)(r == CGT_SPU_MODEL_SIGN);
    return ((r ^ ((vec_uint4)is_large & CGT_SPU_MODEL_SIGN)) | too_large) & ~(vec_uint4)sign;
}

#endif
