/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: hand-written forms for SSE4.1, and AVX2, FMA and AVX-512 where the variant has them.
 * bench/simd/simd_native.c explains the lines and includes this file twice. */

/* clang-format off */

/* for all types of an integer register, of a float one */
#define INTS2(word, expression)                                                                                        \
    N2(SAME, word, u8, u8, u8, expression) N2(SAME, word, s8, s8, s8, expression)                                      \
    N2(SAME, word, u16, u16, u16, expression) N2(SAME, word, s16, s16, s16, expression)                                \
    N2(SAME, word, u32, u32, u32, expression) N2(SAME, word, s32, s32, s32, expression)                                \
    N2(SAME, word, u64, u64, u64, expression) N2(SAME, word, s64, s64, s64, expression)
#define FLOATS2(word, expression)                                                                                      \
    N2(SAME, word, f32, f32, f32, TO_F32(expression(OF_F32(a), OF_F32(b))))                                            \
    N2(SAME, word, f64, f64, f64, TO_F64(expression(OF_F64(a), OF_F64(b))))

/* ---- scalars ---- */

N1(SAME, spu_splats, u8, x_u8, _mm_set1_epi8((char)a))
N1(SAME, spu_splats, s8, x_s8, _mm_set1_epi8((char)a))
N1(SAME, spu_splats, u16, x_u16, _mm_set1_epi16((short)a))
N1(SAME, spu_splats, s16, x_s16, _mm_set1_epi16(a))
N1(SAME, spu_splats, u32, x_u32, _mm_set1_epi32((int)a))
N1(SAME, spu_splats, s32, x_s32, _mm_set1_epi32(a))
N1(SAME, spu_splats, u64, x_u64, _mm_set1_epi64x((long long)a))
N1(SAME, spu_splats, s64, x_s64, _mm_set1_epi64x(a))
N1(SAME, spu_splats, f32, x_f32, _mm_set1_ps(a))
N1(SAME, spu_splats, f64, x_f64, _mm_set1_pd(a))

V2(SAME, spu_extract, x_u8, u8, x_s32, (unsigned char)_mm_cvtsi128_si32(simd_towards(a, b)))
V2(SAME, spu_extract, x_s8, s8, x_s32, (signed char)_mm_cvtsi128_si32(simd_towards(a, b)))
V2(SAME, spu_extract, x_u16, u16, x_s32, (unsigned short)_mm_cvtsi128_si32(simd_towards(a, 2 * b)))
V2(SAME, spu_extract, x_s16, s16, x_s32, (short)_mm_cvtsi128_si32(simd_towards(a, 2 * b)))
V2(SAME, spu_extract, x_u32, u32, x_s32, (unsigned)_mm_cvtsi128_si32(simd_towards(a, 4 * b)))
V2(SAME, spu_extract, x_s32, s32, x_s32, _mm_cvtsi128_si32(simd_towards(a, 4 * b)))
V2(SAME, spu_extract, x_u64, u64, x_s32, (unsigned long long)_mm_cvtsi128_si64(simd_towards(a, 8 * b)))
V2(SAME, spu_extract, x_s64, s64, x_s32, _mm_cvtsi128_si64(simd_towards(a, 8 * b)))
V2(SAME, spu_extract, x_f32, f32, x_s32, _mm_cvtss_f32(TO_F32(simd_towards(OF_F32(a), 4 * b))))
V2(SAME, spu_extract, x_f64, f64, x_s32, _mm_cvtsd_f64(TO_F64(simd_towards(OF_F64(a), 8 * b))))
K2(SAME, spu_extract, x_u8, u8, x_s32, (unsigned char)_mm_extract_epi8(a, 1))
K2(SAME, spu_extract, x_s8, s8, x_s32, (signed char)_mm_extract_epi8(a, 1))
K2(SAME, spu_extract, x_u16, u16, x_s32, (unsigned short)_mm_extract_epi16(a, 1))
K2(SAME, spu_extract, x_s16, s16, x_s32, (short)_mm_extract_epi16(a, 1))
K2(SAME, spu_extract, x_u32, u32, x_s32, (unsigned)_mm_extract_epi32(a, 1))
K2(SAME, spu_extract, x_s32, s32, x_s32, _mm_extract_epi32(a, 1))
K2(SAME, spu_extract, x_u64, u64, x_s32, (unsigned long long)_mm_extract_epi64(a, 1))
K2(SAME, spu_extract, x_s64, s64, x_s32, _mm_extract_epi64(a, 1))
K2(SAME, spu_extract, x_f32, f32, x_s32, _mm_cvtss_f32(_mm_shuffle_ps(a, a, 0x55)))
K2(SAME, spu_extract, x_f64, f64, x_s32, _mm_cvtsd_f64(_mm_unpackhi_pd(a, a)))

V3(SAME, spu_insert, u8, x_u8, u8, x_s32, simd_put(_mm_set1_epi8((char)a), b, c, 0))
V3(SAME, spu_insert, s8, x_s8, s8, x_s32, simd_put(_mm_set1_epi8((char)a), b, c, 0))
V3(SAME, spu_insert, u16, x_u16, u16, x_s32, simd_put(_mm_set1_epi16((short)a), b, c, 1))
V3(SAME, spu_insert, s16, x_s16, s16, x_s32, simd_put(_mm_set1_epi16(a), b, c, 1))
V3(SAME, spu_insert, u32, x_u32, u32, x_s32, simd_put(_mm_set1_epi32((int)a), b, c, 2))
V3(SAME, spu_insert, s32, x_s32, s32, x_s32, simd_put(_mm_set1_epi32(a), b, c, 2))
V3(SAME, spu_insert, u64, x_u64, u64, x_s32, simd_put(_mm_set1_epi64x((long long)a), b, c, 3))
V3(SAME, spu_insert, s64, x_s64, s64, x_s32, simd_put(_mm_set1_epi64x(a), b, c, 3))
V3(SAME, spu_insert, f32, x_f32, f32, x_s32, TO_F32(simd_put(OF_F32(_mm_set1_ps(a)), OF_F32(b), c, 2)))
V3(SAME, spu_insert, f64, x_f64, f64, x_s32, TO_F64(simd_put(OF_F64(_mm_set1_pd(a)), OF_F64(b), c, 3)))
K3(SAME, spu_insert, u8, x_u8, u8, x_s32, _mm_insert_epi8(b, a, 1))
K3(SAME, spu_insert, s8, x_s8, s8, x_s32, _mm_insert_epi8(b, a, 1))
K3(SAME, spu_insert, u16, x_u16, u16, x_s32, _mm_insert_epi16(b, a, 1))
K3(SAME, spu_insert, s16, x_s16, s16, x_s32, _mm_insert_epi16(b, a, 1))
K3(SAME, spu_insert, u32, x_u32, u32, x_s32, _mm_insert_epi32(b, (int)a, 1))
K3(SAME, spu_insert, s32, x_s32, s32, x_s32, _mm_insert_epi32(b, a, 1))
K3(SAME, spu_insert, u64, x_u64, u64, x_s32, _mm_insert_epi64(b, (long long)a, 1))
K3(SAME, spu_insert, s64, x_s64, s64, x_s32, _mm_insert_epi64(b, a, 1))
K3(SAME, spu_insert, f32, x_f32, f32, x_s32, _mm_insert_ps(b, _mm_set_ss(a), 0x10))
K3(SAME, spu_insert, f64, x_f64, f64, x_s32, _mm_unpacklo_pd(b, _mm_set_sd(a)))

/* promote leaves the other elements undefined: at position 0 it is one move of the scalar */
V2(SAME, spu_promote, u8, x_u8, x_s32, _mm_set1_epi8((char)a))
V2(SAME, spu_promote, s8, x_s8, x_s32, _mm_set1_epi8((char)a))
V2(SAME, spu_promote, u16, x_u16, x_s32, _mm_set1_epi16((short)a))
V2(SAME, spu_promote, s16, x_s16, x_s32, _mm_set1_epi16(a))
V2(SAME, spu_promote, u32, x_u32, x_s32, _mm_set1_epi32((int)a))
V2(SAME, spu_promote, s32, x_s32, x_s32, _mm_set1_epi32(a))
V2(SAME, spu_promote, u64, x_u64, x_s32, _mm_set1_epi64x((long long)a))
V2(SAME, spu_promote, s64, x_s64, x_s32, _mm_set1_epi64x(a))
V2(SAME, spu_promote, f32, x_f32, x_s32, _mm_set1_ps(a))
V2(SAME, spu_promote, f64, x_f64, x_s32, _mm_set1_pd(a))
K2(OTHER, spu_promote, u8, x_u8, x_s32, _mm_cvtsi32_si128(a))
K2(OTHER, spu_promote, s8, x_s8, x_s32, _mm_cvtsi32_si128(a))
K2(OTHER, spu_promote, u16, x_u16, x_s32, _mm_cvtsi32_si128(a))
K2(OTHER, spu_promote, s16, x_s16, x_s32, _mm_cvtsi32_si128(a))
K2(OTHER, spu_promote, u32, x_u32, x_s32, _mm_cvtsi32_si128((int)a))
K2(OTHER, spu_promote, s32, x_s32, x_s32, _mm_cvtsi32_si128(a))
K2(OTHER, spu_promote, u64, x_u64, x_s32, _mm_cvtsi64_si128((long long)a))
K2(OTHER, spu_promote, s64, x_s64, x_s32, _mm_cvtsi64_si128(a))
K2(OTHER, spu_promote, f32, x_f32, x_s32, _mm_set_ss(a))
K2(OTHER, spu_promote, f64, x_f64, x_s32, _mm_set_sd(a))

/* ---- conversion; by a scale of 8 ---- */

N2(SAME, spu_convtf, f32, s32, n_scale, _mm_mul_ps(_mm_cvtepi32_ps(a), _mm_set1_ps(1 / 256.f)))
N2(SAME, spu_convtf, f32, u32, n_scale, _mm_mul_ps(simd_convtf_u32(a), _mm_set1_ps(1 / 256.f)))
N2(SAME, spu_convts, s32, f32, n_scale, _mm_cvttps_epi32(_mm_mul_ps(a, _mm_set1_ps(256.f))))
N2(SAME, spu_convtu, u32, f32, n_scale, simd_convtu(_mm_mul_ps(a, _mm_set1_ps(256.f))))
N1(SAME, spu_extend, s16, s8, _mm_srai_epi16(a, 8))
N1(SAME, spu_extend, s32, s16, _mm_srai_epi32(a, 16))
#if defined(__AVX512VL__)
N1(SAME, spu_extend, s64, s32, _mm_srai_epi64(a, 32))
#else
N1(SAME, spu_extend, s64, s32, _mm_cvtepi32_epi64(_mm_shuffle_epi32(a, 0x0d)))
#endif
N1(SAME, spu_extend, f64, f32, _mm_cvtps_pd(_mm_shuffle_ps(a, a, 0x08)))
N1(SAME, spu_roundtf, f32, f64, _mm_unpacklo_ps(_mm_cvtpd_ps(a), _mm_setzero_ps()))

/* ---- arithmetic ---- */

N2(SAME, spu_add, u16, u16, u16, _mm_add_epi16(a, b))
N2(SAME, spu_add, s16, s16, s16, _mm_add_epi16(a, b))
N2(SAME, spu_add, u32, u32, u32, _mm_add_epi32(a, b))
N2(SAME, spu_add, s32, s32, s32, _mm_add_epi32(a, b))
N2(SAME, spu_add, f32, f32, f32, _mm_add_ps(a, b))
N2(SAME, spu_add, f64, f64, f64, _mm_add_pd(a, b))
N2(SAME, spu_add, u16, u16, x_u16, _mm_add_epi16(a, _mm_set1_epi16((short)b)))
N2(SAME, spu_add, s16, s16, x_s16, _mm_add_epi16(a, _mm_set1_epi16(b)))
N2(SAME, spu_add, u32, u32, x_u32, _mm_add_epi32(a, _mm_set1_epi32((int)b)))
N2(SAME, spu_add, s32, s32, x_s32, _mm_add_epi32(a, _mm_set1_epi32(b)))
N2(SAME, spu_sub, u16, u16, u16, _mm_sub_epi16(a, b))
N2(SAME, spu_sub, s16, s16, s16, _mm_sub_epi16(a, b))
N2(SAME, spu_sub, u32, u32, u32, _mm_sub_epi32(a, b))
N2(SAME, spu_sub, s32, s32, s32, _mm_sub_epi32(a, b))
N2(SAME, spu_sub, f32, f32, f32, _mm_sub_ps(a, b))
N2(SAME, spu_sub, f64, f64, f64, _mm_sub_pd(a, b))
N2(SAME, spu_sub, u16, x_u16, u16, _mm_sub_epi16(_mm_set1_epi16((short)a), b))
N2(SAME, spu_sub, s16, x_s16, s16, _mm_sub_epi16(_mm_set1_epi16(a), b))
N2(SAME, spu_sub, u32, x_u32, u32, _mm_sub_epi32(_mm_set1_epi32((int)a), b))
N2(SAME, spu_sub, s32, x_s32, s32, _mm_sub_epi32(_mm_set1_epi32(a), b))
#define WORDS3(word, expression)                                                                                       \
    N3(SAME, word, u32, u32, u32, u32, expression) N3(SAME, word, s32, s32, s32, s32, expression)
#define WORDS2(word, expression) N2(SAME, word, u32, u32, u32, expression) N2(SAME, word, s32, s32, s32, expression)
WORDS3(spu_addx, _mm_add_epi32(_mm_add_epi32(a, b), _mm_and_si128(c, ONE)))
WORDS3(spu_subx, _mm_sub_epi32(_mm_sub_epi32(a, b), _mm_andnot_si128(c, ONE)))
WORDS2(spu_genc, simd_genc(a, b))
WORDS2(spu_genb, simd_genb(a, b))
WORDS3(spu_gencx, simd_gencx(a, b, c))
WORDS3(spu_genbx, simd_genbx(a, b, c))
#undef WORDS3
#undef WORDS2
N2(SAME, spu_mul, f32, f32, f32, _mm_mul_ps(a, b))
N2(SAME, spu_mul, f64, f64, f64, _mm_mul_pd(a, b))
N3(SAME, spu_madd, f32, f32, f32, f32, simd_madd_ps(a, b, c))
N3(SAME, spu_msub, f32, f32, f32, f32, simd_msub_ps(a, b, c))
N3(SAME, spu_nmsub, f32, f32, f32, f32, simd_nmsub_ps(a, b, c))
N3(SAME, spu_madd, f64, f64, f64, f64, simd_madd_pd(a, b, c))
N3(SAME, spu_msub, f64, f64, f64, f64, simd_msub_pd(a, b, c))
N3(SAME, spu_nmsub, f64, f64, f64, f64, simd_nmsub_pd(a, b, c))
N3(SAME, spu_nmadd, f64, f64, f64, f64, simd_nmadd_pd(a, b, c))
N3(SAME, spu_madd, s32, s16, s16, s32, _mm_add_epi32(_mm_madd_epi16(a, _mm_and_si128(b, ODD)), c))
N2(SAME, spu_mule, s32, s16, s16, _mm_madd_epi16(a, _mm_and_si128(b, EVEN)))
N2(SAME, spu_mulo, s32, s16, s16, _mm_madd_epi16(a, _mm_and_si128(b, ODD)))
N2(SAME, spu_mulo, s32, s16, x_s16, _mm_madd_epi16(a, _mm_set1_epi32((int)((unsigned)b << 16))))
N2(SAME, spu_mule, u32, u16, u16, _mm_blend_epi16(_mm_mullo_epi16(a, b), _mm_slli_epi32(_mm_mulhi_epu16(a, b),
    16), 0xaa))
N2(SAME, spu_mulo, u32, u16, u16, _mm_blend_epi16(_mm_srli_epi32(_mm_mullo_epi16(a, b), 16), _mm_mulhi_epu16(a,
    b), 0xaa))
N2(SAME, spu_mulo, u32, u16, x_u16, _mm_mullo_epi32(_mm_srli_epi32(a, 16), _mm_set1_epi32(b)))
N2(SAME, spu_mulh, s32, s16, s16, _mm_mullo_epi16(_mm_slli_epi32(a, 16), b))
N2(SAME, spu_mulsr, s32, s16, s16, _mm_srai_epi32(_mm_mulhi_epi16(a, b), 16))
N3(SAME, spu_mhhadd, s32, s16, s16, s32, _mm_add_epi32(_mm_madd_epi16(a, _mm_and_si128(b, EVEN)), c))
N3(SAME, spu_mhhadd, u32, u16, u16, u32, _mm_add_epi32(_mm_blend_epi16(_mm_mullo_epi16(a, b),
    _mm_slli_epi32(_mm_mulhi_epu16(a, b), 16), 0xaa), c))
/* estimates: the bits depend on the machine */
N1(OTHER, spu_re, f32, f32, _mm_rcp_ps(a))
N1(OTHER, spu_rsqrte, f32, f32, _mm_rsqrt_ps(a))

/* ---- bytes ---- */

N2(SAME, spu_absd, u8, u8, u8, _mm_or_si128(_mm_subs_epu8(a, b), _mm_subs_epu8(b, a)))
N2(SAME, spu_avg, u8, u8, u8, _mm_avg_epu8(a, b))
N2(SAME, spu_sumb, u16, u8, u8, simd_sumb(a, b))

/* ---- comparison ---- */

#define COMPARE(word, b8, b16, b32, unsigned8, unsigned16, unsigned32)                                                 \
    N2(SAME, word, u8, u8, u8, unsigned8(a, b)) N2(SAME, word, u8, s8, s8, b8(a, b))                                   \
    N2(SAME, word, u16, u16, u16, unsigned16(a, b)) N2(SAME, word, u16, s16, s16, b16(a, b))                           \
    N2(SAME, word, u32, u32, u32, unsigned32(a, b)) N2(SAME, word, u32, s32, s32, b32(a, b))                           \
    N2(SAME, word, u8, u8, x_u8, unsigned8(a, _mm_set1_epi8((char)b)))                                                 \
    N2(SAME, word, u8, s8, x_s8, b8(a, _mm_set1_epi8((char)b)))                                                        \
    N2(SAME, word, u16, u16, x_u16, unsigned16(a, _mm_set1_epi16((short)b)))                                           \
    N2(SAME, word, u16, s16, x_s16, b16(a, _mm_set1_epi16(b)))                                                         \
    N2(SAME, word, u32, u32, x_u32, unsigned32(a, _mm_set1_epi32((int)b)))                                             \
    N2(SAME, word, u32, s32, x_s32, b32(a, _mm_set1_epi32(b)))
COMPARE(spu_cmpeq, _mm_cmpeq_epi8, _mm_cmpeq_epi16, _mm_cmpeq_epi32, _mm_cmpeq_epi8, _mm_cmpeq_epi16, _mm_cmpeq_epi32)
COMPARE(spu_cmpgt, _mm_cmpgt_epi8, _mm_cmpgt_epi16, _mm_cmpgt_epi32, simd_cmpgt_u8, simd_cmpgt_u16, simd_cmpgt_u32)
#undef COMPARE
#define ABS_F32(a) _mm_andnot_ps(_mm_set1_ps(-0.f), a)
#define ABS_F64(a) _mm_andnot_pd(_mm_set1_pd(-0.), a)
N2(SAME, spu_cmpeq, u32, f32, f32, OF_F32(_mm_cmpeq_ps(a, b)))
N2(SAME, spu_cmpeq, u64, f64, f64, OF_F64(_mm_cmpeq_pd(a, b)))
N2(SAME, spu_cmpgt, u32, f32, f32, OF_F32(_mm_cmpgt_ps(a, b)))
N2(SAME, spu_cmpgt, u64, f64, f64, OF_F64(_mm_cmpgt_pd(a, b)))
N2(SAME, spu_cmpabseq, u32, f32, f32, OF_F32(_mm_cmpeq_ps(ABS_F32(a), ABS_F32(b))))
N2(SAME, spu_cmpabseq, u64, f64, f64, OF_F64(_mm_cmpeq_pd(ABS_F64(a), ABS_F64(b))))
N2(SAME, spu_cmpabsgt, u32, f32, f32, OF_F32(_mm_cmpgt_ps(ABS_F32(a), ABS_F32(b))))
N2(SAME, spu_cmpabsgt, u64, f64, f64, OF_F64(_mm_cmpgt_pd(ABS_F64(a), ABS_F64(b))))
#if defined(__AVX512DQ__) && defined(__AVX512VL__)
N2(SAME, spu_testsv, u64, f64, n_special, _mm_movm_epi64(_mm_fpclass_pd_mask(a, 0x99)))
#else
N2(SAME, spu_testsv, u64, f64, n_special, OF_F64(_mm_cmpnlt_pd(ABS_F64(a), _mm_set1_pd(__builtin_inf()))))
#endif
#undef ABS_F32
#undef ABS_F64

/* ---- bits and masks ---- */

N1(SAME, spu_cntb, u8, u8, simd_cntb(a))
N1(SAME, spu_cntb, u8, s8, simd_cntb(a))
N1(SAME, spu_cntlz, u32, u32, simd_cntlz(a))
N1(SAME, spu_cntlz, u32, s32, simd_cntlz(a))
N1(SAME, spu_cntlz, u32, f32, simd_cntlz(OF_F32(a)))
/* of a comparison's result, element 0 lowest, as a scalar */
N1(OTHER, spu_gather, x_s32, u8, _mm_movemask_epi8(a))
N1(OTHER, spu_gather, x_s32, s8, _mm_movemask_epi8(a))
N1(OTHER, spu_gather, x_s32, u16, _mm_movemask_epi8(_mm_packs_epi16(a, ZERO)))
N1(OTHER, spu_gather, x_s32, s16, _mm_movemask_epi8(_mm_packs_epi16(a, ZERO)))
N1(OTHER, spu_gather, x_s32, u32, _mm_movemask_ps(TO_F32(a)))
N1(OTHER, spu_gather, x_s32, s32, _mm_movemask_ps(TO_F32(a)))
N1(OTHER, spu_gather, x_s32, f32, _mm_movemask_ps(a))
#define MASK(word, R, function)                                                                                        \
    N1(SAME, word, R, x_u16, function(a)) N1(SAME, word, R, x_s16, function((unsigned)a))                              \
    N1(SAME, word, R, x_u32, function(a)) N1(SAME, word, R, x_s32, function((unsigned)a))
MASK(spu_maskb, u8, simd_maskb)
MASK(spu_maskh, u16, simd_maskh)
MASK(spu_maskw, u32, simd_maskw)
#undef MASK
N1(SAME, spu_maskh, u16, x_u8, simd_maskh(a))
N1(SAME, spu_maskh, u16, x_s8, simd_maskh((unsigned)a))
N1(SAME, spu_maskw, u32, x_u8, simd_maskw(a))
N1(SAME, spu_maskw, u32, x_s8, simd_maskw((unsigned)a))

/* on masks of whole elements, as comparisons give them */
N3(SAME, spu_sel, u8, u8, u8, u8, simd_sel(a, b, c))
N3(SAME, spu_sel, s8, s8, s8, u8, simd_sel(a, b, c))
N3(SAME, spu_sel, u16, u16, u16, u16, simd_sel(a, b, c))
N3(SAME, spu_sel, s16, s16, s16, u16, simd_sel(a, b, c))
N3(SAME, spu_sel, u32, u32, u32, u32, simd_sel(a, b, c))
N3(SAME, spu_sel, s32, s32, s32, u32, simd_sel(a, b, c))
N3(SAME, spu_sel, u64, u64, u64, u64, simd_sel(a, b, c))
N3(SAME, spu_sel, s64, s64, s64, u64, simd_sel(a, b, c))
N3(SAME, spu_sel, f32, f32, f32, u32, TO_F32(simd_sel(OF_F32(a), OF_F32(b), c)))
N3(SAME, spu_sel, f64, f64, f64, u64, TO_F64(simd_sel(OF_F64(a), OF_F64(b), c)))

/* a pattern of the host's own bytes, without constants */
V3(SAME, spu_shuffle, u8, u8, u8, u8, simd_shuffle(a, b, c))
V3(SAME, spu_shuffle, s8, s8, s8, u8, simd_shuffle(a, b, c))
V3(OTHER, spu_shuffle, u16, u16, u16, u8, simd_shuffle(a, b, c))
V3(OTHER, spu_shuffle, s16, s16, s16, u8, simd_shuffle(a, b, c))
V3(OTHER, spu_shuffle, u32, u32, u32, u8, simd_shuffle(a, b, c))
V3(OTHER, spu_shuffle, s32, s32, s32, u8, simd_shuffle(a, b, c))
V3(OTHER, spu_shuffle, u64, u64, u64, u8, simd_shuffle(a, b, c))
V3(OTHER, spu_shuffle, s64, s64, s64, u8, simd_shuffle(a, b, c))
V3(OTHER, spu_shuffle, f32, f32, f32, u8, TO_F32(simd_shuffle(OF_F32(a), OF_F32(b), c)))
V3(OTHER, spu_shuffle, f64, f64, f64, u8, TO_F64(simd_shuffle(OF_F64(a), OF_F64(b), c)))
K3(SAME, spu_shuffle, u8, u8, u8, u8, _mm_unpacklo_epi32(a, b))
K3(SAME, spu_shuffle, s8, s8, s8, u8, _mm_unpacklo_epi32(a, b))
K3(SAME, spu_shuffle, u16, u16, u16, u8, _mm_unpacklo_epi32(a, b))
K3(SAME, spu_shuffle, s16, s16, s16, u8, _mm_unpacklo_epi32(a, b))
K3(SAME, spu_shuffle, u32, u32, u32, u8, _mm_unpacklo_epi32(a, b))
K3(SAME, spu_shuffle, s32, s32, s32, u8, _mm_unpacklo_epi32(a, b))
K3(SAME, spu_shuffle, u64, u64, u64, u8, _mm_blend_epi16(a, b, 0xf0))
K3(SAME, spu_shuffle, s64, s64, s64, u8, _mm_blend_epi16(a, b, 0xf0))
K3(SAME, spu_shuffle, f32, f32, f32, u8, _mm_unpacklo_ps(a, b))
K3(SAME, spu_shuffle, f64, f64, f64, u8, _mm_blend_pd(a, b, 2))

/* ---- logic ---- */

INTS2(spu_and, _mm_and_si128(a, b))
INTS2(spu_or, _mm_or_si128(a, b))
INTS2(spu_xor, _mm_xor_si128(a, b))
INTS2(spu_andc, _mm_andnot_si128(b, a))
INTS2(spu_orc, simd_orc(a, b))
INTS2(spu_nand, simd_nand(a, b))
INTS2(spu_nor, simd_nor(a, b))
INTS2(spu_eqv, simd_eqv(a, b))
N2(SAME, spu_and, f32, f32, f32, _mm_and_ps(a, b))
N2(SAME, spu_and, f64, f64, f64, _mm_and_pd(a, b))
N2(SAME, spu_or, f32, f32, f32, _mm_or_ps(a, b))
N2(SAME, spu_or, f64, f64, f64, _mm_or_pd(a, b))
N2(SAME, spu_xor, f32, f32, f32, _mm_xor_ps(a, b))
N2(SAME, spu_xor, f64, f64, f64, _mm_xor_pd(a, b))
N2(SAME, spu_andc, f32, f32, f32, _mm_andnot_ps(b, a))
N2(SAME, spu_andc, f64, f64, f64, _mm_andnot_pd(b, a))
FLOATS2(spu_orc, simd_orc)
FLOATS2(spu_nand, simd_nand)
FLOATS2(spu_nor, simd_nor)
FLOATS2(spu_eqv, simd_eqv)
#define SCALAR(word, function)                                                                                         \
    N2(SAME, word, u8, u8, x_u8, function(a, _mm_set1_epi8((char)b)))                                                  \
    N2(SAME, word, s8, s8, x_s8, function(a, _mm_set1_epi8((char)b)))                                                  \
    N2(SAME, word, u16, u16, x_u16, function(a, _mm_set1_epi16((short)b)))                                             \
    N2(SAME, word, s16, s16, x_s16, function(a, _mm_set1_epi16(b)))                                                    \
    N2(SAME, word, u32, u32, x_u32, function(a, _mm_set1_epi32((int)b)))                                               \
    N2(SAME, word, s32, s32, x_s32, function(a, _mm_set1_epi32(b)))
SCALAR(spu_and, _mm_and_si128)
SCALAR(spu_or, _mm_or_si128)
SCALAR(spu_xor, _mm_xor_si128)
#undef SCALAR
N1(SAME, spu_orx, u32, u32, simd_orx(a))
N1(SAME, spu_orx, s32, s32, simd_orx(a))

/* ---- shifts of elements, counts within the element; the literal count is 5 ---- */

#define SHIFT16(word, vector, scalar, n16, of16, of_scalar, literal, K16)                                              \
    V2(SAME, word, u16, u16, n16, vector(a, of16(b))) V2(SAME, word, s16, s16, n16, vector(a, of16(b)))                \
    V2(SAME, word, u16, u16, K16, scalar(a, of_scalar(b))) V2(SAME, word, s16, s16, K16, scalar(a, of_scalar(b)))      \
    K2(SAME, word, u16, u16, K16, literal(a, 5)) K2(SAME, word, s16, s16, K16, literal(a, 5))
#define SHIFT32(word, vector, scalar, n32, of32, of_scalar, literal, K32)                                              \
    V2(SAME, word, u32, u32, n32, vector(a, of32(b))) V2(SAME, word, s32, s32, n32, vector(a, of32(b)))                \
    V2(SAME, word, u32, u32, K32, scalar(a, of_scalar(b))) V2(SAME, word, s32, s32, K32, scalar(a, of_scalar(b)))      \
    K2(SAME, word, u32, u32, K32, literal(a, 5)) K2(SAME, word, s32, s32, K32, literal(a, 5))
#define NEGATED16(b) _mm_sub_epi16(ZERO, b)
#define NEGATED32(b) _mm_sub_epi32(ZERO, b)
SHIFT16(spu_sl, simd_sllv16, _mm_sll_epi16, u16, , COUNT, _mm_slli_epi16, x_u32)
SHIFT32(spu_sl, simd_sllv32, _mm_sll_epi32, u32, , COUNT, _mm_slli_epi32, x_u32)
SHIFT16(spu_sr, simd_srlv16, _mm_srl_epi16, u16, , COUNT, _mm_srli_epi16, x_u32)
SHIFT32(spu_sr, simd_srlv32, _mm_srl_epi32, u32, , COUNT, _mm_srli_epi32, x_u32)
SHIFT16(spu_sra, simd_srav16, _mm_sra_epi16, u16, , COUNT, _mm_srai_epi16, x_u32)
SHIFT32(spu_sra, simd_srav32, _mm_sra_epi32, u32, , COUNT, _mm_srai_epi32, x_u32)
SHIFT16(spu_rlmask, simd_srlv16, _mm_srl_epi16, s16, NEGATED16, NEGATED, _mm_srli_epi16, x_s32)
SHIFT32(spu_rlmask, simd_srlv32, _mm_srl_epi32, s32, NEGATED32, NEGATED, _mm_srli_epi32, x_s32)
SHIFT16(spu_rlmaska, simd_srav16, _mm_sra_epi16, s16, NEGATED16, NEGATED, _mm_srai_epi16, x_s32)
SHIFT32(spu_rlmaska, simd_srav32, _mm_sra_epi32, s32, NEGATED32, NEGATED, _mm_srai_epi32, x_s32)
#define ROL16(a, n) _mm_or_si128(_mm_slli_epi16(a, n), _mm_srli_epi16(a, 16 - (n)))
SHIFT16(spu_rl, simd_rolv16, simd_rol16, s16, , , ROL16, x_s16)
SHIFT32(spu_rl, simd_rolv32, simd_rol32, s32, , , simd_roli32, x_s32)
#undef SHIFT16
#undef SHIFT32
#undef NEGATED16
#undef NEGATED32
#undef ROL16

/* ---- shifts of the quadword ---- */

#define QUAD(V, word, K, on8, on16, on32, on64)                                                                        \
    V(SAME, word, u8, u8, K, on8) V(SAME, word, s8, s8, K, on8)                                                        \
    V(SAME, word, u16, u16, K, on16) V(SAME, word, s16, s16, K, on16)                                                  \
    V(SAME, word, u32, u32, K, on32) V(SAME, word, s32, s32, K, on32)                                                  \
    V(SAME, word, u64, u64, K, on64) V(SAME, word, s64, s64, K, on64)
#define QUAD_FLOATS(V, word, K, on32, on64) V(SAME, word, f32, f32, K, on32) V(SAME, word, f64, f64, K, on64)
/* by bits; the literal count is 3 */
#define BITS(word, function, K, count)                                                                                 \
    QUAD(V2, word, K, function##8(a, count), function##16(a, count), function##32(a, count), function##64(a, count))   \
    QUAD_FLOATS(V2, word, K, TO_F32(function##32(OF_F32(a), count)), TO_F64(function##64(OF_F64(a), count)))           \
    QUAD(K2, word, K, function##8(a, 3), function##16(a, 3), function##32(a, 3), function##64(a, 3))                   \
    QUAD_FLOATS(K2, word, K, TO_F32(function##32(OF_F32(a), 3)), TO_F64(function##64(OF_F64(a), 3)))
BITS(spu_slqw, simd_slqw, x_u32, (int)b)
BITS(spu_srqw, simd_srqw, x_u32, (int)b)
BITS(spu_rlqw, simd_rlqw, x_s32, b)
BITS(spu_rlmaskqw, simd_srqw, x_s32, -b)
#undef BITS
/* by bytes, whole elements: all types alike; the literal count is 8 */
#define BYTES(word, K, function, count, literal)                                                                       \
    QUAD(V2, word, K, function(a, count), function(a, count), function(a, count), function(a, count))                  \
    QUAD_FLOATS(V2, word, K, TO_F32(function(OF_F32(a), count)), TO_F64(function(OF_F64(a), count)))                   \
    QUAD(K2, word, K, literal(a), literal(a), literal(a), literal(a))                                                  \
    QUAD_FLOATS(K2, word, K, TO_F32(literal(OF_F32(a))), TO_F64(literal(OF_F64(a))))
#define LEFT8(a) _mm_srli_si128(a, 8)
#define RIGHT8(a) _mm_slli_si128(a, 8)
#define ROUND8(a) _mm_shuffle_epi32(a, 0x4e)
BYTES(spu_slqwbyte, x_u32, simd_towards, (int)b, LEFT8)
BYTES(spu_srqwbyte, x_u32, simd_towards, -(int)b, RIGHT8)
BYTES(spu_rlqwbyte, x_s32, simd_around_by, b, ROUND8)
BYTES(spu_rlmaskqwbyte, x_s32, simd_towards, b, RIGHT8)
BYTES(spu_slqwbytebc, x_u32, simd_towards, (int)(b >> 3), LEFT8)
BYTES(spu_srqwbytebc, x_u32, simd_towards, -(int)(b >> 3), RIGHT8)
BYTES(spu_rlqwbytebc, x_s32, simd_around_by, b >> 3, ROUND8)
BYTES(spu_rlmaskqwbytebc, x_s32, simd_towards, b >> 3, RIGHT8)
#undef BYTES
#undef LEFT8
#undef RIGHT8
#undef ROUND8
#undef QUAD
#undef QUAD_FLOATS
#undef INTS2
#undef FLOATS2

/* clang-format on */
