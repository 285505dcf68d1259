/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: types and helpers shared by the forms of
 * native_sse.h. */
#ifndef CGT_NATIVE_SSE_PARTS_H
#define CGT_NATIVE_SSE_PARTS_H

typedef __m128i SIMD_TYPE_u8, SIMD_TYPE_s8, SIMD_TYPE_u16, SIMD_TYPE_s16;
typedef __m128i SIMD_TYPE_u32, SIMD_TYPE_s32, SIMD_TYPE_u64, SIMD_TYPE_s64;
typedef __m128 SIMD_TYPE_f32;
typedef __m128d SIMD_TYPE_f64;

#define ONES _mm_set1_epi32(-1)
#define ZERO _mm_setzero_si128()
#define ONE _mm_set1_epi32(1)
#define EVEN _mm_set1_epi32(0x0000ffff)
#define ODD _mm_set1_epi32((int)0xffff0000)
#define COUNT(b) _mm_cvtsi32_si128((int)(b))
#define NEGATED(b) _mm_cvtsi32_si128(-(int)(b))
#define TO_F32 _mm_castsi128_ps
#define TO_F64 _mm_castsi128_pd
#define OF_F32 _mm_castps_si128
#define OF_F64 _mm_castpd_si128

/* Controls of pshufb: sixteen bytes from simd_bytes + 16 + n on move the
 * elements n bytes towards element 0, from simd_bytes + 16 - n on the other
 * way; from simd_around + n on they rotate. */
#define OUT 128, 128, 128, 128, 128, 128, 128, 128, 128, 128, 128, 128, 128, 128, 128, 128
#define IN 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
static const unsigned char simd_bytes[48] = {OUT, IN, OUT}, simd_around[32] = {IN, IN};
/* From simd_hole + 16 - n on: all ones in the first bytes of position n, as
 * many as the element has. */
static const unsigned char simd_hole[4][32] = {
    {[16] = 255}, {[16] = 255, 255}, {[16] = 255, 255, 255, 255}, {[16] = 255, 255, 255, 255, 255, 255, 255, 255}};

static inline __m128i simd_at(const unsigned char *p) { return _mm_loadu_si128((const __m128i *)(const void *)p); }
static inline __m128i simd_towards(__m128i a, int n) { return _mm_shuffle_epi8(a, simd_at(simd_bytes + 16 + n)); }
static inline __m128i simd_around_by(__m128i a, int n) { return _mm_shuffle_epi8(a, simd_at(simd_around + n)); }
static inline __m128i simd_put(__m128i a, __m128i b, int n, int log_bytes)
{
    return _mm_blendv_epi8(b, a, simd_at(simd_hole[log_bytes] + 16 - (n << log_bytes)));
}

/* ---- comparison of unsigned numbers ---- */

static inline __m128i simd_cmpgt_u8(__m128i a, __m128i b)
{
#if defined(__AVX512BW__)
    return _mm_movm_epi8(_mm_cmpgt_epu8_mask(a, b));
#else
    const __m128i top = _mm_set1_epi8(-128);
    return _mm_cmpgt_epi8(_mm_xor_si128(a, top), _mm_xor_si128(b, top));
#endif
}
static inline __m128i simd_cmpgt_u16(__m128i a, __m128i b)
{
#if defined(__AVX512BW__)
    return _mm_movm_epi16(_mm_cmpgt_epu16_mask(a, b));
#else
    const __m128i top = _mm_set1_epi16(-32768);
    return _mm_cmpgt_epi16(_mm_xor_si128(a, top), _mm_xor_si128(b, top));
#endif
}
static inline __m128i simd_cmpgt_u32(__m128i a, __m128i b)
{
#if defined(__AVX512VL__) && defined(__AVX512DQ__)
    return _mm_movm_epi32(_mm_cmpgt_epu32_mask(a, b));
#else
    const __m128i top = _mm_set1_epi32(INT32_MIN);
    return _mm_cmpgt_epi32(_mm_xor_si128(a, top), _mm_xor_si128(b, top));
#endif
}

/* ---- carries ---- */

#if defined(__AVX512VL__)
static inline __m128i simd_genc(__m128i a, __m128i b)
{
    return _mm_maskz_set1_epi32(_mm_cmplt_epu32_mask(_mm_add_epi32(a, b), a), 1);
}
static inline __m128i simd_genb(__m128i a, __m128i b) { return _mm_maskz_set1_epi32(_mm_cmpge_epu32_mask(a, b), 1); }
#else
static inline __m128i simd_genc(__m128i a, __m128i b)
{
    const __m128i sum = _mm_add_epi32(a, b);
    return _mm_andnot_si128(_mm_cmpeq_epi32(_mm_max_epu32(sum, a), sum), ONE);
}
static inline __m128i simd_genb(__m128i a, __m128i b)
{
    return _mm_srli_epi32(_mm_cmpeq_epi32(_mm_max_epu32(a, b), a), 31);
}
#endif
/* the carry out of a + b + c: where ~a is below b, or equal with c's lowest bit
 */
static inline __m128i simd_gencx(__m128i a, __m128i b, __m128i c)
{
    const __m128i x = _mm_xor_si128(a, ONES), none = _mm_cmpeq_epi32(_mm_max_epu32(x, b), x);
    return _mm_andnot_si128(_mm_andnot_si128(_mm_and_si128(_mm_cmpeq_epi32(x, b), c), none), ONE);
}
/* of a - b: where a is not below b, except equal without c */
static inline __m128i simd_genbx(__m128i a, __m128i b, __m128i c)
{
    const __m128i some = _mm_cmpeq_epi32(_mm_max_epu32(a, b), a), not_c = _mm_andnot_si128(c, _mm_cmpeq_epi32(a, b));
    return _mm_and_si128(_mm_andnot_si128(not_c, some), ONE);
}

/* ---- shifts by one count per element ---- */

#if defined(__AVX2__)
#define simd_sllv32 _mm_sllv_epi32
#define simd_srlv32 _mm_srlv_epi32
#define simd_srav32 _mm_srav_epi32
#else
static inline __m128i simd_sllv32(__m128i a, __m128i n)
{
    const __m128i power = _mm_add_epi32(_mm_slli_epi32(n, 23), _mm_set1_epi32(0x3f800000));
    return _mm_mullo_epi32(a, _mm_cvttps_epi32(TO_F32(power)));
}
/* element by element: the count is the lowest 64 bits */
#define SIMD_APART(name, shift)                                                                                        \
    static inline __m128i name(__m128i a, __m128i n)                                                                   \
    {                                                                                                                  \
        const __m128i n01 = _mm_unpacklo_epi32(n, ZERO), n23 = _mm_unpackhi_epi32(n, ZERO);                            \
        const __m128i x = shift(a, n01), y = shift(a, _mm_srli_si128(n01, 8));                                         \
        const __m128i z = shift(a, n23), w = shift(a, _mm_srli_si128(n23, 8));                                         \
        return _mm_blend_epi16(_mm_blend_epi16(x, y, 0x0c), _mm_blend_epi16(z, w, 0xc0), 0xf0);                        \
    }
SIMD_APART(simd_srlv32, _mm_srl_epi32)
SIMD_APART(simd_srav32, _mm_sra_epi32)
#endif

#if defined(__AVX512BW__) && defined(__AVX512VL__)
#define simd_sllv16 _mm_sllv_epi16
#define simd_srlv16 _mm_srlv_epi16
#define simd_srav16 _mm_srav_epi16
#elif defined(__AVX2__)
/* the two halfwords of a word separately */
static inline __m128i simd_sllv16(__m128i a, __m128i n)
{
    const __m128i low = _mm_sllv_epi32(a, _mm_and_si128(n, EVEN));
    const __m128i high = _mm_sllv_epi32(_mm_and_si128(a, ODD), _mm_srli_epi32(n, 16));
    return _mm_blend_epi16(low, high, 0xaa);
}
static inline __m128i simd_srlv16(__m128i a, __m128i n)
{
    const __m128i low = _mm_srlv_epi32(_mm_and_si128(a, EVEN), _mm_and_si128(n, EVEN));
    return _mm_blend_epi16(low, _mm_srlv_epi32(a, _mm_srli_epi32(n, 16)), 0xaa);
}
static inline __m128i simd_srav16(__m128i a, __m128i n)
{
    const __m128i signs = _mm_srai_epi32(_mm_slli_epi32(a, 16), 16);
    const __m128i low = _mm_srav_epi32(signs, _mm_and_si128(n, EVEN));
    return _mm_blend_epi16(low, _mm_srav_epi32(a, _mm_srli_epi32(n, 16)), 0xaa);
}
#else
/* 2^n for n below 16, from two tables of its bytes */
static inline __m128i simd_power16(__m128i n)
{
    const __m128i low = _mm_setr_epi8(1, 2, 4, 8, 16, 32, 64, -128, 0, 0, 0, 0, 0, 0, 0, 0);
    const __m128i high = _mm_setr_epi8(0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 4, 8, 16, 32, 64, -128);
    const __m128i of_low = _mm_shuffle_epi8(low, _mm_or_si128(n, _mm_set1_epi16((short)0x8000)));
    return _mm_or_si128(of_low, _mm_slli_epi16(_mm_shuffle_epi8(high, n), 8));
}
static inline __m128i simd_sllv16(__m128i a, __m128i n) { return _mm_mullo_epi16(a, simd_power16(n)); }
/* the upper half of twice the product by 2^(15 - n) */
static inline __m128i simd_srlv16(__m128i a, __m128i n)
{
    const __m128i power = simd_power16(_mm_sub_epi16(_mm_set1_epi16(15), n));
    const __m128i high = _mm_slli_epi16(_mm_mulhi_epu16(a, power), 1);
    return _mm_or_si128(high, _mm_srli_epi16(_mm_mullo_epi16(a, power), 15));
}
static inline __m128i simd_srav16(__m128i a, __m128i n)
{
    const __m128i sign = _mm_srai_epi16(a, 15);
    return _mm_xor_si128(simd_srlv16(_mm_xor_si128(a, sign), n), sign);
}
#endif

#if defined(__AVX512VL__)
#define simd_rolv32 _mm_rolv_epi32
#elif defined(__AVX2__)
static inline __m128i simd_rolv32(__m128i a, __m128i n)
{
    return _mm_or_si128(_mm_sllv_epi32(a, n), _mm_srlv_epi32(a, _mm_sub_epi32(_mm_set1_epi32(32), n)));
}
#else
/* both halves of the product by 2^n */
static inline __m128i simd_rolv32(__m128i a, __m128i n)
{
    const __m128i power = _mm_cvttps_epi32(TO_F32(_mm_add_epi32(_mm_slli_epi32(n, 23), _mm_set1_epi32(0x3f800000))));
    const __m128i even = _mm_mul_epu32(a, power);
    const __m128i odd = _mm_mul_epu32(_mm_srli_epi64(a, 32), _mm_srli_epi64(power, 32));
    const __m128i low = _mm_blend_epi16(even, _mm_slli_epi64(odd, 32), 0xcc);
    return _mm_or_si128(low, _mm_blend_epi16(_mm_srli_epi64(even, 32), odd, 0xcc));
}
#endif
#if defined(__AVX2__)
static inline __m128i simd_rolv16(__m128i a, __m128i n)
{
    return _mm_or_si128(simd_sllv16(a, n), simd_srlv16(a, _mm_sub_epi16(_mm_set1_epi16(16), n)));
}
#else
static inline __m128i simd_rolv16(__m128i a, __m128i n)
{
    const __m128i power = simd_power16(n);
    return _mm_or_si128(_mm_mullo_epi16(a, power), _mm_mulhi_epu16(a, power));
}
#endif

#if defined(__AVX512VL__)
#define simd_rol32(a, n) _mm_rolv_epi32(a, _mm_set1_epi32(n))
#define simd_roli32(a, n) _mm_rol_epi32(a, n)
#else
static inline __m128i simd_rol32(__m128i a, int n)
{
    return _mm_or_si128(_mm_sll_epi32(a, COUNT(n)), _mm_srl_epi32(a, COUNT(32 - n)));
}
#define simd_roli32(a, n) _mm_or_si128(_mm_slli_epi32(a, n), _mm_srli_epi32(a, 32 - (n)))
#endif
static inline __m128i simd_rol16(__m128i a, int n)
{
    return _mm_or_si128(_mm_sll_epi16(a, COUNT(n)), _mm_srl_epi16(a, COUNT(16 - n)));
}

/* ---- the quadword by bits: each element takes the bits shifted out of the next
 * or the previous one ---- */

#define SIMD_ROUND8(a) _mm_shuffle_epi8(a, _mm_setr_epi8(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0))
#define SIMD_QUAD_BITS(bits, bytes)                                                                                    \
    static inline __m128i simd_slqw##bits(__m128i a, int n)                                                            \
    {                                                                                                                  \
        const __m128i over = _mm_srli_si128(_mm_srl_epi##bits(a, COUNT(bits - n)), bytes);                             \
        return _mm_or_si128(_mm_sll_epi##bits(a, COUNT(n)), over);                                                     \
    }                                                                                                                  \
    static inline __m128i simd_srqw##bits(__m128i a, int n)                                                            \
    {                                                                                                                  \
        const __m128i over = _mm_slli_si128(_mm_sll_epi##bits(a, COUNT(bits - n)), bytes);                             \
        return _mm_or_si128(_mm_srl_epi##bits(a, COUNT(n)), over);                                                     \
    }                                                                                                                  \
    static inline __m128i simd_rlqw##bits(__m128i a, int n)                                                            \
    {                                                                                                                  \
        const __m128i over = _mm_srl_epi##bits(a, COUNT(bits - n));                                                    \
        return _mm_or_si128(_mm_sll_epi##bits(a, COUNT(n)), _mm_alignr_epi8(over, over, bytes));                       \
    }
SIMD_QUAD_BITS(16, 2)
SIMD_QUAD_BITS(32, 4)
SIMD_QUAD_BITS(64, 8)
/* bytes: the reversed register is a number of the host */
static inline __m128i simd_slqw8(__m128i a, int n)
{
    const __m128i x = SIMD_ROUND8(a), over = _mm_slli_si128(_mm_srl_epi64(x, COUNT(64 - n)), 8);
    return SIMD_ROUND8(_mm_or_si128(_mm_sll_epi64(x, COUNT(n)), over));
}
static inline __m128i simd_srqw8(__m128i a, int n)
{
    const __m128i x = SIMD_ROUND8(a), over = _mm_srli_si128(_mm_sll_epi64(x, COUNT(64 - n)), 8);
    return SIMD_ROUND8(_mm_or_si128(_mm_srl_epi64(x, COUNT(n)), over));
}
static inline __m128i simd_rlqw8(__m128i a, int n)
{
    const __m128i x = SIMD_ROUND8(a), over = _mm_shuffle_epi32(_mm_srl_epi64(x, COUNT(64 - n)), 0x4e);
    return SIMD_ROUND8(_mm_or_si128(_mm_sll_epi64(x, COUNT(n)), over));
}

/* ---- bytes ---- */

static inline __m128i simd_sumb(__m128i a, __m128i b)
{
    const __m128i one = _mm_set1_epi8(1), pair = _mm_set1_epi16(1);
    const __m128i sum_a = _mm_madd_epi16(_mm_maddubs_epi16(a, one), pair);
    const __m128i sum_b = _mm_madd_epi16(_mm_maddubs_epi16(b, one), pair);
    return _mm_or_si128(sum_b, _mm_slli_epi32(sum_a, 16));
}
static inline __m128i simd_cntb(__m128i a)
{
    const __m128i ones = _mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4), low = _mm_set1_epi8(15);
    return _mm_add_epi8(_mm_shuffle_epi8(ones, _mm_and_si128(a, low)),
                        _mm_shuffle_epi8(ones, _mm_and_si128(_mm_srli_epi16(a, 4), low)));
}
/* the exponent of the number as a float; bits below the highest are cleared so
 * that it is not rounded up */
static inline __m128i simd_cntlz(__m128i a)
{
    const __m128i top = _mm_andnot_si128(_mm_srli_epi32(a, 1), a);
    const __m128i exponent = _mm_srli_epi32(OF_F32(_mm_cvtepi32_ps(top)), 23);
    const __m128i zeros = _mm_subs_epu16(_mm_set1_epi32(158), exponent); /* 0 where the sign bit is set */
    return _mm_min_epi16(zeros, _mm_set1_epi32(32));
}
static inline __m128i simd_maskb(unsigned a)
{
    const __m128i bit = _mm_set1_epi64x(0x0102040810204080),
                  of = _mm_setr_epi8(1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0);
    return _mm_cmpeq_epi8(_mm_and_si128(_mm_shuffle_epi8(COUNT(a), of), bit), bit);
}
static inline __m128i simd_maskh(unsigned a)
{
    const __m128i bit = _mm_setr_epi16(128, 64, 32, 16, 8, 4, 2, 1);
    return _mm_cmpeq_epi16(_mm_and_si128(_mm_set1_epi16((short)a), bit), bit);
}
static inline __m128i simd_maskw(unsigned a)
{
    const __m128i bit = _mm_setr_epi32(8, 4, 2, 1);
    return _mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32((int)a), bit), bit);
}
static inline __m128i simd_orx(__m128i a)
{
    const __m128i x = _mm_or_si128(a, _mm_shuffle_epi32(a, 0x4e)), y = _mm_or_si128(x, _mm_srli_epi64(x, 32));
    return _mm_blend_epi16(ZERO, y, 0x03);
}
/* for indices 0 to 31 only; bit 4 moves to the top to select */
static inline __m128i simd_shuffle(__m128i a, __m128i b, __m128i c)
{
    return _mm_blendv_epi8(_mm_shuffle_epi8(a, c), _mm_shuffle_epi8(b, c), _mm_slli_epi16(c, 3));
}

/* ---- conversion ---- */

static inline __m128 simd_convtf_u32(__m128i a)
{
#if defined(__AVX512VL__)
    return _mm_cvtepu32_ps(a);
#else
    const __m128i low = _mm_blend_epi16(a, _mm_set1_epi32(0x4b000000), 0xaa);
    const __m128i high = _mm_blend_epi16(_mm_srli_epi32(a, 16), _mm_set1_epi32(0x53000000), 0xaa);
    return _mm_add_ps(_mm_sub_ps(TO_F32(high), _mm_set1_ps(549764202496.f)), TO_F32(low));
#endif
}
static inline __m128i simd_convtu(__m128 a)
{
#if defined(__AVX512VL__)
    return _mm_cvttps_epu32(a);
#else
    const __m128i small = _mm_cvttps_epi32(a), large = _mm_cvttps_epi32(_mm_sub_ps(a, _mm_set1_ps(2147483648.f)));
    return _mm_or_si128(small, _mm_and_si128(large, _mm_srai_epi32(small, 31)));
#endif
}

#if defined(__FMA__)
#define simd_madd_ps _mm_fmadd_ps
#define simd_msub_ps _mm_fmsub_ps
#define simd_nmsub_ps _mm_fnmadd_ps
#define simd_madd_pd _mm_fmadd_pd
#define simd_msub_pd _mm_fmsub_pd
#define simd_nmsub_pd _mm_fnmadd_pd
#define simd_nmadd_pd _mm_fnmsub_pd
#else
#define simd_madd_ps(a, b, c) _mm_add_ps(_mm_mul_ps(a, b), c)
#define simd_msub_ps(a, b, c) _mm_sub_ps(_mm_mul_ps(a, b), c)
#define simd_nmsub_ps(a, b, c) _mm_sub_ps(c, _mm_mul_ps(a, b))
#define simd_madd_pd(a, b, c) _mm_add_pd(_mm_mul_pd(a, b), c)
#define simd_msub_pd(a, b, c) _mm_sub_pd(_mm_mul_pd(a, b), c)
#define simd_nmsub_pd(a, b, c) _mm_sub_pd(c, _mm_mul_pd(a, b))
#define simd_nmadd_pd(a, b, c) _mm_xor_pd(_mm_add_pd(_mm_mul_pd(a, b), c), _mm_set1_pd(-0.))
#endif

/* ---- logic in two instructions, where there is no single one ---- */

#if defined(__AVX512VL__)
#define simd_sel(a, b, c) _mm_ternarylogic_epi32(a, b, c, 0xd8)
#define simd_orc(a, b) _mm_ternarylogic_epi32(a, a, b, 0xf5)
#define simd_nand(a, b) _mm_ternarylogic_epi32(a, a, b, 0x5f)
#define simd_nor(a, b) _mm_ternarylogic_epi32(a, a, b, 0x05)
#define simd_eqv(a, b) _mm_ternarylogic_epi32(a, a, b, 0xa5)
#else
#define simd_sel(a, b, c) _mm_blendv_epi8(a, b, c)
#define simd_orc(a, b) _mm_or_si128(a, _mm_xor_si128(b, ONES))
#define simd_nand(a, b) _mm_xor_si128(_mm_and_si128(a, b), ONES)
#define simd_nor(a, b) _mm_xor_si128(_mm_or_si128(a, b), ONES)
#define simd_eqv(a, b) _mm_xor_si128(_mm_xor_si128(a, b), ONES)
#endif

#endif
