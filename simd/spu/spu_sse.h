/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The mapping to SSE4.1, and to FMA, AVX2 and AVX-512 where the flags allow them. The compiler's vectors already become
 * SSE instructions; here are the words for which instructions exist that the compiler does not find. Little-endian
 * only, as x86 is.
 *
 * Where operands may be constants the code is in the compiler's vectors and shuffles, not in intrinsics, so that it
 * folds: a shuffle with a constant pattern costs three instructions, a quadword shift by a constant count one. */
#ifndef CGT_SPU_SSE_H
#define CGT_SPU_SSE_H

#include <immintrin.h>

#include "spu_types.h"

/* byte k of the result is byte index[k] of a, zero where the index has its top bit set */
CGT_SPU_INLINE vec_uchar16 cgt_sse_bytes(vec_uchar16 a, vec_uchar16 index)
{
    return (vec_uchar16)_mm_shuffle_epi8((__m128i)a, (__m128i)index);
}
/* the same for an index below 16; folds where both are constant */
CGT_SPU_INLINE vec_uchar16 cgt_sse_permute(vec_uchar16 a, vec_uchar16 index)
{
#if defined(__clang__)
    return cgt_sse_bytes(a, index);
#else
    return __builtin_shuffle(a, index);
#endif
}

/* ---- floating point ---- */

#if defined(__FMA__)
#define CGT_SPU_OWN_MADD
#define CGT_SPU_FUSED 1
#define CGT_SPU_FUSED_DOUBLE 1
#define CGT_SPU_X(word, instruction)                                                                                   \
    CGT_SPU_INLINE vec_double2 cgt_spu_##word##_f64(vec_double2 a, vec_double2 b, vec_double2 c)                       \
    {                                                                                                                  \
        return (vec_double2)instruction((__m128d)a, (__m128d)b, (__m128d)c);                                           \
    }
CGT_SPU_X(madd, _mm_fmadd_pd)
CGT_SPU_X(msub, _mm_fmsub_pd)
#undef CGT_SPU_X
/* rounded, then negated, like the SPU's doubles: not vfnmadd and vfnmsub, whose zeros have the other sign */
CGT_SPU_INLINE vec_double2 cgt_spu_nmsub_f64(vec_double2 a, vec_double2 b, vec_double2 c)
{
    return -cgt_spu_msub_f64(a, b, c);
}
CGT_SPU_INLINE vec_double2 cgt_spu_nmadd_f64(vec_double2 a, vec_double2 b, vec_double2 c)
{
    return -cgt_spu_madd_f64(a, b, c);
}
#ifndef CGT_SPU_OWN_FLOAT
#define CGT_SPU_X(word, instruction)                                                                                   \
    CGT_SPU_INLINE vec_float4 cgt_spu_##word##_f32(vec_float4 a, vec_float4 b, vec_float4 c)                           \
    {                                                                                                                  \
        return (vec_float4)instruction((__m128)a, (__m128)b, (__m128)c);                                               \
    }
CGT_SPU_X(madd, _mm_fmadd_ps)
CGT_SPU_X(msub, _mm_fmsub_ps)
CGT_SPU_X(nmsub, _mm_fnmadd_ps)
#undef CGT_SPU_X
#endif
#endif

/* estimates: relative error at most 1.5 * 2^-12; the bits differ between makers of processors */
#define CGT_SPU_OWN_ESTIMATE
#ifndef CGT_SPU_OWN_FLOAT
CGT_SPU_INLINE vec_float4 cgt_spu_re_f32(vec_float4 a) { return (vec_float4)_mm_rcp_ps((__m128)a); }
CGT_SPU_INLINE vec_float4 cgt_spu_rsqrte_f32(vec_float4 a) /* of the magnitude, as on an SPU */
{
    return (vec_float4)_mm_rsqrt_ps(_mm_andnot_ps(_mm_set1_ps(-0.f), (__m128)a));
}
#endif

/* cvttps gives 0x80000000 for values out of range. GCC folds such constants differently, so they are hidden from it. */
CGT_SPU_INLINE vec_int4 cgt_sse_truncate(vec_float4 a)
{
#if !defined(__clang__)
    __asm__("" : "+x"(a));
#endif
    return (vec_int4)_mm_cvttps_epi32((__m128)a);
}

/* Out of range: flip 0x80000000 to the largest int where the operand was large, and to 0 where it was NaN. */
#define CGT_SPU_OWN_CONVTS
CGT_SPU_INLINE vec_int4 cgt_spu_to_int_f32(vec_float4 a)
{
    const vec_int4 d = cgt_sse_truncate(a);
    return (d ^ (vec_int4)(a >= 2147483648.f)) & (vec_int4)_mm_cmpord_ps((__m128)a, (__m128)a);
}
/* from 2^31 on, 2^31 is subtracted and restored as the top bit */
CGT_SPU_INLINE vec_uint4 cgt_spu_to_uint_f32(vec_float4 a)
{
#if defined(__AVX512VL__)
    return (vec_uint4)_mm_cvttps_epu32(_mm_max_ps((__m128)a, _mm_setzero_ps())); /* too large: all ones */
#else
    const vec_float4 positive = (vec_float4)_mm_max_ps((__m128)a, _mm_setzero_ps()); /* 0 for NaN */
    const vec_uint4 large = (vec_uint4)(positive >= 2147483648.f);
    const vec_float4 rest = positive - (vec_float4)(large & 0x4f000000);
    const vec_uint4 d = (vec_uint4)cgt_sse_truncate(rest);
    return (d ^ (large & 0x80000000u)) | (vec_uint4)(positive >= 4294967296.f);
#endif
}
#define CGT_SPU_OWN_CONVTF
CGT_SPU_INLINE vec_float4 cgt_spu_to_float_s32(vec_int4 a) { return (vec_float4)_mm_cvtepi32_ps((__m128i)a); }
CGT_SPU_INLINE vec_float4 cgt_spu_to_float_u32(vec_uint4 a)
{
#if defined(__AVX512VL__)
    return (vec_float4)_mm_cvtepu32_ps((__m128i)a);
#else
    /* both halves become lowest bits of 2^23 and 2^39; the excess is subtracted exactly, and the sum is rounded once */
    const __m128i low = _mm_blend_epi16((__m128i)a, _mm_set1_epi32(0x4b000000), 0xaa);
    const __m128i high = _mm_blend_epi16((__m128i)(a >> 16), _mm_set1_epi32(0x53000000), 0xaa);
    return ((vec_float4)high - 0x1.0001p39f) + (vec_float4)low;
#endif
}

#define CGT_SPU_OWN_ROUNDTF
CGT_SPU_INLINE vec_float4 cgt_spu_roundtf_f64(vec_double2 a)
{
    return (vec_float4)_mm_unpacklo_ps(_mm_cvtpd_ps((__m128d)a), _mm_setzero_ps());
}

/* ---- integers ---- */

/* Products of halfwords: pmaddwd multiplies pairs and adds; with one of each pair zero it is a single product. Unsigned
 * ones are products of words. */
#define CGT_SPU_OWN_MULTIPLY
CGT_SPU_INLINE vec_int4 cgt_spu_mulo_s16(vec_short8 a, vec_short8 b)
{
    return (vec_int4)_mm_madd_epi16((__m128i)a, (__m128i)((vec_uint4)b & 0xffff0000u));
}
CGT_SPU_INLINE vec_int4 cgt_spu_mule_s16(vec_short8 a, vec_short8 b)
{
    return (vec_int4)_mm_madd_epi16((__m128i)a, (__m128i)((vec_uint4)b & 0x0000ffffu));
}
CGT_SPU_INLINE vec_uint4 cgt_spu_mulo_u16(vec_ushort8 a, vec_ushort8 b)
{
    return ((vec_uint4)a >> 16) * ((vec_uint4)b >> 16);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_mule_u16(vec_ushort8 a, vec_ushort8 b)
{
    return ((vec_uint4)a & 0xffff) * ((vec_uint4)b & 0xffff);
}
/* only the low half of the product remains, in the odd halfword, where the even halfword of a goes */
CGT_SPU_INLINE vec_int4 cgt_spu_mulh_s16(vec_short8 a, vec_short8 b)
{
    return (vec_int4)_mm_mullo_epi16(_mm_slli_epi32((__m128i)a, 16), (__m128i)b);
}
CGT_SPU_INLINE vec_int4 cgt_spu_mulsr_s16(vec_short8 a, vec_short8 b)
{
    return (vec_int4)_mm_mulhi_epi16((__m128i)a, (__m128i)b) >> 16;
}

#define CGT_SPU_OWN_CARRY
CGT_SPU_INLINE vec_uint4 cgt_spu_genc_u32(vec_uint4 a, vec_uint4 b)
{
    const __m128i sum = (__m128i)(a + b); /* the sum is below a where it overflowed */
    return (vec_uint4)_mm_andnot_si128(_mm_cmpeq_epi32(_mm_max_epu32(sum, (__m128i)a), sum), _mm_set1_epi32(1));
}
CGT_SPU_INLINE vec_uint4 cgt_spu_genb_u32(vec_uint4 a, vec_uint4 b)
{
    const __m128i larger = _mm_max_epu32((__m128i)a, (__m128i)b);
    return (vec_uint4)_mm_srli_epi32(_mm_cmpeq_epi32(larger, (__m128i)a), 31);
}
/* where a is not below b, except equal without c */
CGT_SPU_INLINE vec_uint4 cgt_spu_genbx_u32(vec_uint4 a, vec_uint4 b, vec_uint4 c)
{
    const __m128i some = _mm_cmpeq_epi32(_mm_max_epu32((__m128i)a, (__m128i)b), (__m128i)a);
    const __m128i except = _mm_andnot_si128((__m128i)c, _mm_cmpeq_epi32((__m128i)a, (__m128i)b));
    return (vec_uint4)_mm_and_si128(_mm_andnot_si128(except, some), _mm_set1_epi32(1));
}
/* where ~a is below b, or equal with c */
CGT_SPU_INLINE vec_uint4 cgt_spu_gencx_u32(vec_uint4 a, vec_uint4 b, vec_uint4 c)
{
    const __m128i x = _mm_xor_si128((__m128i)a, _mm_set1_epi32(-1));
    const __m128i none = _mm_cmpeq_epi32(_mm_max_epu32(x, (__m128i)b), x);
    const __m128i met = _mm_and_si128(_mm_cmpeq_epi32(x, (__m128i)b), (__m128i)c);
    return (vec_uint4)_mm_andnot_si128(_mm_andnot_si128(met, none), _mm_set1_epi32(1));
}

#define CGT_SPU_OWN_EXTEND
CGT_SPU_INLINE vec_short8 cgt_spu_extend_s8(vec_char16 a) { return (vec_short8)a >> 8; }
CGT_SPU_INLINE vec_int4 cgt_spu_extend_s16(vec_short8 a) { return (vec_int4)a >> 16; }
CGT_SPU_INLINE vec_llong2 cgt_spu_extend_s32(vec_int4 a)
{
#if defined(__AVX512VL__)
    return (vec_llong2)_mm_srai_epi64((__m128i)a, 32);
#else
    return (vec_llong2)_mm_cvtepi32_epi64(_mm_shuffle_epi32((__m128i)a, 0x0d));
#endif
}

/* ---- bytes and bits ---- */

#define CGT_SPU_OWN_BYTE
CGT_SPU_INLINE vec_uchar16 cgt_spu_absd_u8(vec_uchar16 a, vec_uchar16 b)
{
    return (vec_uchar16)_mm_or_si128(_mm_subs_epu8((__m128i)a, (__m128i)b), _mm_subs_epu8((__m128i)b, (__m128i)a));
}
CGT_SPU_INLINE vec_uchar16 cgt_spu_avg_u8(vec_uchar16 a, vec_uchar16 b)
{
    return (vec_uchar16)_mm_avg_epu8((__m128i)a, (__m128i)b);
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_sumb_u8(vec_uchar16 a, vec_uchar16 b)
{
    const __m128i one = _mm_set1_epi8(1), pair = _mm_set1_epi16(1);
    const __m128i sum_a = _mm_madd_epi16(_mm_maddubs_epi16((__m128i)a, one), pair);
    const __m128i sum_b = _mm_madd_epi16(_mm_maddubs_epi16((__m128i)b, one), pair);
    return (vec_ushort8)_mm_or_si128(sum_b, _mm_slli_epi32(sum_a, 16));
}
/* bits set in each half of a byte, from a table of sixteen */
CGT_SPU_INLINE vec_uchar16 cgt_spu_cntb_u8(vec_uchar16 a)
{
    const vec_uchar16 ones = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
    return cgt_sse_bytes(ones, a & 15) + cgt_sse_bytes(ones, (vec_uchar16)((vec_ushort8)a >> 4) & 15);
}

#if defined(__AVX512CD__) && defined(__AVX512VL__)
#define CGT_SPU_OWN_CNTLZ
CGT_SPU_INLINE vec_uint4 cgt_spu_cntlz_u32(vec_uint4 a) { return (vec_uint4)_mm_lzcnt_epi32((__m128i)a); }
#else
#define CGT_SPU_OWN_CNTLZ
/* The exponent of the number as a float gives its highest bit. Bits that could round it up to the next power of two are
 * cleared first: those whose upper neighbour is set. Zero has exponent field 0, which gives 158: limit it. With the
 * sign bit set the field is above 158: saturate at 0. */
CGT_SPU_INLINE vec_uint4 cgt_spu_cntlz_u32(vec_uint4 a)
{
    const vec_uint4 top = a & ~(a >> 1);
    const vec_uint4 exponent = (vec_uint4)_mm_cvtepi32_ps((__m128i)top) >> 23;
    const __m128i zeros = _mm_subs_epu16(_mm_set1_epi32(158), (__m128i)exponent);
    return (vec_uint4)_mm_min_epi16(zeros, _mm_set1_epi32(32));
}
#endif

#define CGT_SPU_OWN_MASKB
CGT_SPU_INLINE vec_uchar16 cgt_spu_maskb(unsigned a)
{
    const vec_uchar16 bit = {128, 64, 32, 16, 8, 4, 2, 1, 128, 64, 32, 16, 8, 4, 2, 1};
    const vec_uchar16 high_low = {1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0};
    const vec_uchar16 bits = cgt_sse_bytes((vec_uchar16)_mm_cvtsi32_si128((int)a), high_low);
    return (vec_uchar16)((bits & bit) == bit);
}

#define CGT_SPU_OWN_ORX
CGT_SPU_INLINE vec_uint4 cgt_spu_orx_u32(vec_uint4 a)
{
    const __m128i b = _mm_or_si128((__m128i)a, _mm_shuffle_epi32((__m128i)a, 0x4e));
    return (vec_uint4)_mm_blend_epi16(_mm_setzero_si128(), _mm_or_si128(b, _mm_shuffle_epi32(b, 0xb1)), 0x03);
}

/* movemask puts element 0 lowest: reverse the elements first */
#define CGT_SPU_OWN_GATHER
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_u32(vec_uint4 a)
{
    const __m128i reversed = _mm_shuffle_epi32((__m128i)a, 0x1b);
    const int bits = _mm_movemask_ps(_mm_castsi128_ps(_mm_slli_epi32(reversed, 31)));
    return (vec_uint4)_mm_cvtsi32_si128(bits);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_u16(vec_ushort8 a)
{
    const vec_uchar16 low_bytes = {14, 12, 10, 8, 6, 4, 2, 0, 128, 128, 128, 128, 128, 128, 128, 128};
    const vec_uchar16 reversed = cgt_sse_bytes((vec_uchar16)a, low_bytes);
    return (vec_uint4)_mm_cvtsi32_si128(_mm_movemask_epi8(_mm_slli_epi16((__m128i)reversed, 7)));
}
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_u8(vec_uchar16 a)
{
    const vec_uchar16 backwards = {15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0};
    const vec_uchar16 reversed = cgt_sse_bytes(a, backwards);
    return (vec_uint4)_mm_cvtsi32_si128(_mm_movemask_epi8(_mm_slli_epi16((__m128i)reversed, 7)));
}

/* Two byte shuffles and an or: an index with its top bit set gives zero, so each half of the table supplies its own
 * bytes. */
#define CGT_SPU_OWN_SHUFFLE
CGT_SPU_INLINE vec_uchar16 cgt_spu_shuffle_bytes(vec_uchar16 a, vec_uchar16 b, vec_uchar16 pattern, unsigned flip)
{
    const vec_uchar16 iota = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const vec_uchar16 c = flip ? cgt_sse_permute(pattern, iota ^ (unsigned char)flip) : pattern;
#if !defined(__clang__)
    /* a constant pattern without constant bytes: the compiler finds the best instructions */
    const unsigned long long special_bytes = (((vec_ullong2)c)[0] | ((vec_ullong2)c)[1]) & 0x8080808080808080u;
    if (__builtin_constant_p(special_bytes) && !special_bytes)
        return __builtin_shuffle(a, b, (c & 31) ^ (unsigned char)flip);
#endif
    const vec_uchar16 constants = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff, 0x80, 0x80};
    const vec_uchar16 constant = cgt_sse_permute(constants, (vec_uchar16)((vec_ushort8)c >> 4) & 15);
    /* pshufb reads the lowest four bits and, for zero, the top one: so bit 4, which selects b, moves to the top */
    const vec_uchar16 index = c ^ (unsigned char)flip, which = (vec_uchar16)((vec_ushort8)c << 3);
    return constant | cgt_sse_bytes(a, index | (which & 0x80)) | cgt_sse_bytes(b, index | (~which & 0x80));
}

/* ---- shifts ---- */

/* By one count the instructions do what the SPU does: from the width on, zeros or sign bits. */
#define CGT_SPU_OWN_SHIFT
#define CGT_SPU_X(type, vec, bits)                                                                                     \
    CGT_SPU_INLINE vec cgt_spu_left_##type##_x(vec a, unsigned n)                                                      \
    {                                                                                                                  \
        return (vec)_mm_sll_epi##bits((__m128i)a, _mm_cvtsi32_si128((int)n));                                          \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_right_##type##_x(vec a, unsigned n)                                                     \
    {                                                                                                                  \
        return (vec)_mm_srl_epi##bits((__m128i)a, _mm_cvtsi32_si128((int)n));                                          \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_right_signed_##type##_x(vec a, unsigned n)                                              \
    {                                                                                                                  \
        return (vec)_mm_sra_epi##bits((__m128i)a, _mm_cvtsi32_si128((int)n));                                          \
    }
CGT_SPU_X(u16, vec_ushort8, 16)
CGT_SPU_X(u32, vec_uint4, 32)
#undef CGT_SPU_X
/* By one count per element */
#if defined(__AVX2__)
CGT_SPU_INLINE vec_uint4 cgt_spu_left_u32(vec_uint4 a, vec_uint4 n)
{
    return (vec_uint4)_mm_sllv_epi32((__m128i)a, (__m128i)n);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_right_u32(vec_uint4 a, vec_uint4 n)
{
    return (vec_uint4)_mm_srlv_epi32((__m128i)a, (__m128i)n);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_right_signed_u32(vec_uint4 a, vec_uint4 n)
{
    return (vec_uint4)_mm_srav_epi32((__m128i)a, (__m128i)n);
}
#else
/* left: a product by a power of two, built as a float's exponent; 2^31 becomes the conversion's 0x80000000, and so do
 * counts from 32 on: clear them */
CGT_SPU_INLINE vec_uint4 cgt_spu_left_u32(vec_uint4 a, vec_uint4 n)
{
    const vec_uint4 power = (vec_uint4)cgt_sse_truncate((vec_float4)((n << 23) + 0x3f800000));
    return a * power & (vec_uint4)((vec_int4)n < 32);
}
/* right: element by element, by the instruction that reads its count from 64 bits */
#define CGT_SPU_X(name, instruction)                                                                                   \
    CGT_SPU_INLINE vec_uint4 cgt_spu_##name##_u32(vec_uint4 a, vec_uint4 n)                                            \
    {                                                                                                                  \
        const __m128i low = _mm_cvtepu32_epi64((__m128i)n),                                                            \
                      high = _mm_unpackhi_epi32((__m128i)n, _mm_setzero_si128());                                      \
        const __m128i x = instruction((__m128i)a, low), z = instruction((__m128i)a, high);                             \
        const __m128i y = instruction((__m128i)a, _mm_unpackhi_epi64(low, low));                                       \
        const __m128i w = instruction((__m128i)a, _mm_unpackhi_epi64(high, high));                                     \
        return (vec_uint4)_mm_blend_epi16(_mm_blend_epi16(x, y, 0x0c), _mm_blend_epi16(z, w, 0xc0), 0xf0);             \
    }
CGT_SPU_X(right, _mm_srl_epi32)
CGT_SPU_X(right_signed, _mm_sra_epi32)
#undef CGT_SPU_X
#endif
#if defined(__AVX512BW__) && defined(__AVX512VL__)
CGT_SPU_INLINE vec_ushort8 cgt_spu_left_u16(vec_ushort8 a, vec_ushort8 n)
{
    return (vec_ushort8)_mm_sllv_epi16((__m128i)a, (__m128i)n);
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_right_u16(vec_ushort8 a, vec_ushort8 n)
{
    return (vec_ushort8)_mm_srlv_epi16((__m128i)a, (__m128i)n);
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_right_signed_u16(vec_ushort8 a, vec_ushort8 n)
{
    return (vec_ushort8)_mm_srav_epi16((__m128i)a, (__m128i)n);
}
#elif defined(__AVX2__)
/* the two halfwords of a word separately */
CGT_SPU_INLINE vec_ushort8 cgt_sse_halfwords(vec_uint4 even, vec_uint4 odd)
{
    return (vec_ushort8)_mm_blend_epi16((__m128i)even, (__m128i)odd, 0xaa);
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_left_u16(vec_ushort8 a, vec_ushort8 n)
{
    const vec_uint4 x = (vec_uint4)a, k = (vec_uint4)n;
    return cgt_sse_halfwords(cgt_spu_left_u32(x, k & 0xffff), cgt_spu_left_u32(x & 0xffff0000u, k >> 16));
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_right_u16(vec_ushort8 a, vec_ushort8 n)
{
    const vec_uint4 x = (vec_uint4)a, k = (vec_uint4)n;
    return cgt_sse_halfwords(cgt_spu_right_u32(x & 0xffff, k & 0xffff), cgt_spu_right_u32(x, k >> 16));
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_right_signed_u16(vec_ushort8 a, vec_ushort8 n)
{
    const vec_uint4 x = (vec_uint4)a, k = (vec_uint4)n, even = (vec_uint4)((vec_int4)(x << 16) >> 16);
    return cgt_sse_halfwords(cgt_spu_right_signed_u32(even, k & 0xffff), cgt_spu_right_signed_u32(x, k >> 16));
}
#else
/* 2^n for n in 0 .. 15, else 0, from two tables of its bytes */
CGT_SPU_INLINE vec_ushort8 cgt_sse_power_of_two(vec_ushort8 n)
{
    const vec_uchar16 low = {1, 2, 4, 8, 16, 32, 64, 128}, high = {0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 4, 8, 16, 32, 64, 128};
    const vec_uchar16 outside = (vec_uchar16)(n > 15) & 0x80, k = (vec_uchar16)n | outside;
    return ((vec_ushort8)cgt_sse_bytes(low, k) & 0xff) | (vec_ushort8)cgt_sse_bytes(high, k) << 8;
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_left_u16(vec_ushort8 a, vec_ushort8 n) { return a * cgt_sse_power_of_two(n); }
/* right: the upper half of the product by 2^(16 - n) */
CGT_SPU_INLINE vec_ushort8 cgt_spu_right_u16(vec_ushort8 a, vec_ushort8 n)
{
    const __m128i high = _mm_mulhi_epu16((__m128i)a, (__m128i)cgt_sse_power_of_two(16 - n));
    return (vec_ushort8)_mm_blendv_epi8(high, (__m128i)a, (__m128i)(n == 0));
}
/* a negative number's complement is shifted without its sign */
CGT_SPU_INLINE vec_ushort8 cgt_spu_right_signed_u16(vec_ushort8 a, vec_ushort8 n)
{
    const vec_ushort8 sign = (vec_ushort8)((vec_short8)a >> 15);
    return cgt_spu_right_u16(a ^ sign, n) ^ sign;
}
#endif

#if defined(__AVX512VL__)
#define CGT_SPU_OWN_ROTATE
CGT_SPU_INLINE vec_uint4 cgt_spu_rotate_u32(vec_uint4 a, vec_uint4 n)
{
    return (vec_uint4)_mm_rolv_epi32((__m128i)a, (__m128i)n);
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_rotate_u16(vec_ushort8 a, vec_ushort8 n)
{
    return cgt_spu_left_u16(a, n) | cgt_spu_right_u16(a, 16 - n);
}
#elif !defined(__AVX2__)
/* both halves of the product by 2^n */
#define CGT_SPU_OWN_ROTATE
CGT_SPU_INLINE vec_uint4 cgt_spu_rotate_u32(vec_uint4 a, vec_uint4 n)
{
    const vec_uint4 power = (vec_uint4)cgt_sse_truncate((vec_float4)((n << 23) + 0x3f800000));
    const __m128i even = _mm_mul_epu32((__m128i)a, (__m128i)power);
    const __m128i odd = _mm_mul_epu32(_mm_srli_epi64((__m128i)a, 32), _mm_srli_epi64((__m128i)power, 32));
    const __m128i low = _mm_blend_epi16(even, _mm_slli_epi64(odd, 32), 0xcc);
    return (vec_uint4)_mm_or_si128(low, _mm_blend_epi16(_mm_srli_epi64(even, 32), odd, 0xcc));
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_rotate_u16(vec_ushort8 a, vec_ushort8 n)
{
    const vec_ushort8 power = cgt_sse_power_of_two(n);
    return (vec_ushort8)_mm_or_si128((__m128i)(a * power), _mm_mulhi_epu16((__m128i)a, (__m128i)power));
}
#endif

/* ---- the quadword ---- */

/* Byte p of the SPU's quadword lies at p ^ flip: positions are converted before and after. Bytes from outside
 * get an index with the top bit set. */
#define CGT_SPU_OWN_QUAD
CGT_SPU_INLINE vec_uchar16 cgt_sse_positions(unsigned size)
{
    const vec_uchar16 iota = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return iota ^ (unsigned char)(size - 1);
}
CGT_SPU_INLINE vec_ullong2 cgt_sse_fetch(vec_ullong2 a, vec_uchar16 from, unsigned size)
{
    const vec_uchar16 outside = (vec_uchar16)(from > 15);
    return (vec_ullong2)cgt_sse_bytes((vec_uchar16)a, (from ^ (unsigned char)(size - 1)) | outside);
}
/* By a variable count: positions of bytes p + n, from sixteen neighbours in memory. */
CGT_SPU_INLINE vec_ullong2 cgt_sse_fetch_window(vec_ullong2 a, const unsigned char *window, unsigned size)
{
    vec_uchar16 from;
    __builtin_memcpy(&from, window, sizeof from);
    if (size > 1)
        from = cgt_sse_permute(from, cgt_sse_positions(size)) ^ (unsigned char)(size - 1);
    return (vec_ullong2)cgt_sse_bytes((vec_uchar16)a, from);
}
#define CGT_SSE_OUTSIDE 128, 128, 128, 128, 128, 128, 128, 128, 128, 128, 128, 128, 128, 128, 128, 128
#define CGT_SSE_INSIDE 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
CGT_SPU_INLINE vec_ullong2 cgt_sse_move(vec_ullong2 a, int n, unsigned size)
{
    static const unsigned char window[] = {CGT_SSE_OUTSIDE, CGT_SSE_OUTSIDE, CGT_SSE_INSIDE, CGT_SSE_OUTSIDE,
                                           CGT_SSE_OUTSIDE};
    if (__builtin_constant_p(n))
        return cgt_sse_fetch(a, cgt_sse_positions(size) + (unsigned char)n, size);
    return cgt_sse_fetch_window(a, window + 32 + n, size);
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_left_bytes(vec_ullong2 a, unsigned n, unsigned size)
{
    return cgt_sse_move(a, (int)n, size);
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_right_bytes(vec_ullong2 a, unsigned n, unsigned size)
{
    return cgt_sse_move(a, -(int)n, size);
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_rotate_bytes(vec_ullong2 a, unsigned n, unsigned size)
{
    static const unsigned char window[] = {CGT_SSE_INSIDE, CGT_SSE_INSIDE};
    if (__builtin_constant_p(n))
        return cgt_sse_fetch(a, (cgt_sse_positions(size) + (unsigned char)n) & 15, size);
    return cgt_sse_fetch_window(a, window + n, size);
}

/* By bits: shift each element and add the bits that its neighbour shifts out. Bytes, for which there is no shift,
 * become words of 64 bits, highest first, and are converted back. */
CGT_SPU_INLINE __m128i cgt_sse_reorder(__m128i a, unsigned size)
{
    const vec_uchar16 iota = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return size > 1 ? a : (__m128i)cgt_sse_bytes((vec_uchar16)a, iota ^ 7);
}
CGT_SPU_INLINE __m128i cgt_sse_elements_left(__m128i a, unsigned n, unsigned size)
{
    const __m128i count = _mm_cvtsi32_si128((int)n);
    return size == 2 ? _mm_sll_epi16(a, count) : size == 4 ? _mm_sll_epi32(a, count) : _mm_sll_epi64(a, count);
}
CGT_SPU_INLINE __m128i cgt_sse_elements_right(__m128i a, unsigned n, unsigned size)
{
    const __m128i count = _mm_cvtsi32_si128((int)n);
    return size == 2 ? _mm_srl_epi16(a, count) : size == 4 ? _mm_srl_epi32(a, count) : _mm_srl_epi64(a, count);
}
/* of elements of `size` bytes each takes the place of the one before it, or after it */
CGT_SPU_INLINE __m128i cgt_sse_advance(__m128i a, unsigned size)
{
    return size == 2 ? _mm_srli_si128(a, 2) : size == 4 ? _mm_srli_si128(a, 4) : _mm_srli_si128(a, 8);
}
CGT_SPU_INLINE __m128i cgt_sse_fall_back(__m128i a, unsigned size)
{
    return size == 2 ? _mm_slli_si128(a, 2) : size == 4 ? _mm_slli_si128(a, 4) : _mm_slli_si128(a, 8);
}
CGT_SPU_INLINE __m128i cgt_sse_advance_around(__m128i a, unsigned size)
{
    return size == 2 ? _mm_alignr_epi8(a, a, 2) : size == 4 ? _mm_shuffle_epi32(a, 0x39) : _mm_shuffle_epi32(a, 0x4e);
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_left_bits(vec_ullong2 a, unsigned n, unsigned size)
{
    const __m128i x = cgt_sse_reorder((__m128i)a, size),
                  over = cgt_sse_elements_right(x, (size > 1 ? 8 * size : 64) - n, size);
    return (vec_ullong2)cgt_sse_reorder(_mm_or_si128(cgt_sse_elements_left(x, n, size), cgt_sse_advance(over, size)),
                                        size);
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_right_bits(vec_ullong2 a, unsigned n, unsigned size)
{
    const __m128i x = cgt_sse_reorder((__m128i)a, size),
                  over = cgt_sse_elements_left(x, (size > 1 ? 8 * size : 64) - n, size);
    return (vec_ullong2)cgt_sse_reorder(_mm_or_si128(cgt_sse_elements_right(x, n, size), cgt_sse_fall_back(over, size)),
                                        size);
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_rotate_bits(vec_ullong2 a, unsigned n, unsigned size)
{
    const __m128i x = cgt_sse_reorder((__m128i)a, size),
                  over = cgt_sse_elements_right(x, (size > 1 ? 8 * size : 64) - n, size);
    return (vec_ullong2)cgt_sse_reorder(
        _mm_or_si128(cgt_sse_elements_left(x, n, size), cgt_sse_advance_around(over, size)), size);
}

/* GCC compiles a complement to an instruction that depends on the register's old value */
#if defined(__AVX512VL__) && !defined(__clang__)
#define CGT_SPU_OWN_COMPLEMENTS
#define CGT_SSE_TABLE(mask, a, b, table) ((mask)_mm_ternarylogic_epi32((__m128i)(a), (__m128i)(a), (__m128i)(b), table))
#define CGT_SPU_ORC(mask, a, b) CGT_SSE_TABLE(mask, a, b, 0xf5)
#define CGT_SPU_NAND(mask, a, b) CGT_SSE_TABLE(mask, a, b, 0x5f)
#define CGT_SPU_NOR(mask, a, b) CGT_SSE_TABLE(mask, a, b, 0x05)
#define CGT_SPU_EQV(mask, a, b) CGT_SSE_TABLE(mask, a, b, 0xa5)
#endif

#include "spu_portable.h"

#endif
