/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The mapping to SSE4.1. The compiler's vectors already become SSE instructions; here are the words for which one
 * instruction exists that it would not find. Little-endian only, as x86 is. */
#ifndef CGT_SPU_SSE_H
#define CGT_SPU_SSE_H

#include <smmintrin.h>

#include "spu_types.h"

#define CGT_SPU_OWN_CONVTS
/* cvttps gives 0x80000000 for whatever does not fit: flip that to the largest int where the operand was large, and to
 * 0 where it was NaN */
CGT_SPU_INLINE vec_int4 cgt_spu_convts_f32(vec_float4 a)
{
    const __m128i d = _mm_cvttps_epi32((__m128)a);
    const __m128i large = _mm_castps_si128(_mm_cmpge_ps((__m128)a, _mm_set1_ps(2147483648.f)));
    const __m128i number = _mm_castps_si128(_mm_cmpord_ps((__m128)a, (__m128)a));
    return (vec_int4)_mm_and_si128(_mm_xor_si128(d, large), number);
}

#define CGT_SPU_OWN_MASK_BITS
CGT_SPU_INLINE unsigned cgt_spux_mask_bits_u32(vec_uint4 m)
{
    return (unsigned)_mm_movemask_ps(_mm_castsi128_ps((__m128i)m));
}
CGT_SPU_INLINE unsigned cgt_spux_mask_bits_u16(vec_ushort8 m)
{
    return (unsigned)_mm_movemask_epi8(_mm_packs_epi16((__m128i)m, _mm_setzero_si128()));
}

#define CGT_SPU_OWN_GATHER
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_u32(vec_uint4 a)
{
    const __m128i reversed = _mm_shuffle_epi32((__m128i)a, 0x1b);
    const int bits = _mm_movemask_ps(_mm_castsi128_ps(_mm_slli_epi32(reversed, 31)));
    return (vec_uint4)_mm_cvtsi32_si128(bits);
}

#define CGT_SPU_OWN_MIN_MAX
CGT_SPU_INLINE vec_float4 cgt_spux_min_f32(vec_float4 a, vec_float4 b)
{
    return (vec_float4)_mm_min_ps((__m128)a, (__m128)b);
}
CGT_SPU_INLINE vec_float4 cgt_spux_max_f32(vec_float4 a, vec_float4 b)
{
    return (vec_float4)_mm_max_ps((__m128)a, (__m128)b);
}

#define CGT_SPU_OWN_SQRT
CGT_SPU_INLINE vec_float4 cgt_spux_sqrt_f32(vec_float4 a) { return (vec_float4)_mm_sqrt_ps((__m128)a); }

#define CGT_SPU_OWN_SELECT
CGT_SPU_INLINE vec_float4 cgt_spux_select_f32(vec_float4 a, vec_float4 b, vec_uint4 m)
{
    return (vec_float4)_mm_blendv_ps((__m128)a, (__m128)b, _mm_castsi128_ps((__m128i)m));
}
CGT_SPU_INLINE vec_uint4 cgt_spux_select_u32(vec_uint4 a, vec_uint4 b, vec_uint4 m)
{
    return (vec_uint4)_mm_blendv_epi8((__m128i)a, (__m128i)b, (__m128i)m);
}

/* Two byte shuffles and an or: a byte with its top bit set gives zero, so each half of the table takes its own bytes.
 * The pattern is turned from the SPU's byte order first; that part leaves the loop where the pattern is constant. */
#define CGT_SPU_OWN_SHUFFLE
CGT_SPU_INLINE __m128i cgt_spu_shuffle_sse(__m128i a, __m128i b, __m128i c, __m128i flip_position, __m128i flip_value)
{
    const __m128i k = _mm_shuffle_epi8(c, flip_position),
                  index = _mm_xor_si128(_mm_and_si128(k, _mm_set1_epi8(15)), flip_value);
    const __m128i special = _mm_cmplt_epi8(k, _mm_setzero_si128());
    const __m128i from_b = _mm_cmpeq_epi8(_mm_and_si128(k, _mm_set1_epi8(16)), _mm_set1_epi8(16));
    const __m128i ones = _mm_cmpeq_epi8(_mm_and_si128(k, _mm_set1_epi8((char)0xe0)), _mm_set1_epi8((char)0xc0));
    const __m128i sign = _mm_cmpeq_epi8(_mm_and_si128(k, _mm_set1_epi8((char)0xe0)), _mm_set1_epi8((char)0xe0));
    const __m128i constant = _mm_or_si128(ones, _mm_and_si128(sign, _mm_set1_epi8((char)0x80)));
    const __m128i index_a = _mm_or_si128(index, _mm_or_si128(special, from_b));
    const __m128i index_b = _mm_or_si128(index, _mm_or_si128(special, _mm_xor_si128(from_b, _mm_set1_epi8(-1))));
    return _mm_or_si128(constant, _mm_or_si128(_mm_shuffle_epi8(a, index_a), _mm_shuffle_epi8(b, index_b)));
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_shuffle_u16(vec_ushort8 a, vec_ushort8 b, vec_uchar16 pattern)
{
    return (vec_ushort8)cgt_spu_shuffle_sse((__m128i)a, (__m128i)b, (__m128i)pattern,
                                            _mm_setr_epi8(1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14),
                                            _mm_set1_epi8(1));
}

#include "spu_portable.h"

#endif
