/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: hand-written forms for the vectors of a variant: SSE4.1, AVX2, AVX-512, NEON.
 * bench/simd/simd_native.c explains the lines and includes this file twice. Words that are sequences of intrinsics
 * themselves (compress on eight lanes, the transposes) have no form here. */

/* clang-format off */

#if defined(__SSE4_1__)

/* ---- the SPU's words, eight and sixteen lanes ---- */

#if CGT_LANES > 4
N2(SAME, spu_add, vf, vf, vf, W(add_ps)(a, b))
N2(SAME, spu_add, vi, vi, vi, W(add_epi32)(a, b))
N2(SAME, spu_add, vu, vu, vu, W(add_epi32)(a, b))
N2(SAME, spu_sub, vf, vf, vf, W(sub_ps)(a, b))
N2(SAME, spu_sub, vi, vi, vi, W(sub_epi32)(a, b))
N2(SAME, spu_sub, vu, vu, vu, W(sub_epi32)(a, b))
N2(SAME, spu_mul, vf, vf, vf, W(mul_ps)(a, b))
N3(SAME, spu_madd, vf, vf, vf, vf, W(fmadd_ps)(a, b, c))
N3(SAME, spu_msub, vf, vf, vf, vf, W(fmsub_ps)(a, b, c))
N3(SAME, spu_nmsub, vf, vf, vf, vf, W(fnmadd_ps)(a, b, c))
N2(SAME, spu_cmpeq, vm, vf, vf, COMPARE_PS(a, b, _CMP_EQ_OQ, cmpeq))
N2(SAME, spu_cmpgt, vm, vf, vf, COMPARE_PS(a, b, _CMP_GT_OQ, cmpgt))
N2(SAME, spu_cmpabsgt, vm, vf, vf, COMPARE_PS(W(andnot_ps)(W(set1_ps)(-0.f), a), W(andnot_ps)(W(set1_ps)(-0.f),
    b), _CMP_GT_OQ, cmpgt))
N2(SAME, spu_and, vf, vf, vf, W(and_ps)(a, b))
N2(SAME, spu_and, vu, vu, vu, SI(and)(a, b))
N2(SAME, spu_or, vf, vf, vf, W(or_ps)(a, b))
N2(SAME, spu_or, vu, vu, vu, SI(or)(a, b))
N2(SAME, spu_xor, vf, vf, vf, W(xor_ps)(a, b))
N2(SAME, spu_xor, vu, vu, vu, SI(xor)(a, b))
N2(SAME, spu_andc, vf, vf, vf, W(andnot_ps)(b, a))
N2(SAME, spu_andc, vu, vu, vu, SI(andnot)(b, a))
N2(SAME, spu_nor, vu, vu, vu, NOR(a, b))
N2(SAME, spu_convtf, vf, vi, n_scale, W(mul_ps)(W(cvtepi32_ps)(a), W(set1_ps)(1 / 256.f)))
N2(SAME, spu_convts, vi, vf, n_scale, W(cvttps_epi32)(W(mul_ps)(a, W(set1_ps)(256.f))))
#endif
#if CGT_LANES == 8
N1(SAME, spu_re, vf, vf, _mm256_rcp_ps(a))
N1(SAME, spu_rsqrte, vf, vf, _mm256_rsqrt_ps(a))
N2(SAME, spu_cmpeq, vm, vi, vi, _mm256_cmpeq_epi32(a, b))
N2(SAME, spu_cmpeq, vm, vu, vu, _mm256_cmpeq_epi32(a, b))
N2(SAME, spu_cmpgt, vm, vi, vi, _mm256_cmpgt_epi32(a, b))
N2(SAME, spu_cmpgt, vm, vu, vu, _mm256_cmpgt_epi32(SI(xor)(a, TOP), SI(xor)(b, TOP)))
N2(SAME, spu_and, vm, vm, vm, SI(and)(a, b))
N2(SAME, spu_or, vm, vm, vm, SI(or)(a, b))
N2(SAME, spu_xor, vm, vm, vm, SI(xor)(a, b))
N2(SAME, spu_andc, vm, vm, vm, SI(andnot)(b, a))
N2(SAME, spu_nor, vm, vm, vm, NOR(a, b))
N2(SAME, spu_nor, vf, vf, vf, _mm256_castsi256_ps(NOR(_mm256_castps_si256(a), _mm256_castps_si256(b))))
N3(SAME, spu_sel, vf, vf, vf, vu, _mm256_blendv_ps(a, b, _mm256_castsi256_ps(c)))
N3(SAME, spu_sel, vu, vu, vu, vu, _mm256_blendv_epi8(a, b, c))
N2(SAME, spu_convtf, vf, vu, n_scale, _mm256_mul_ps(simd_convtf_vu(a), _mm256_set1_ps(1 / 256.f)))
#elif CGT_LANES == 16
N1(SAME, spu_re, vf, vf, _mm512_rcp14_ps(a))
N1(SAME, spu_rsqrte, vf, vf, _mm512_rsqrt14_ps(a))
N2(SAME, spu_cmpeq, vm, vi, vi, _mm512_cmpeq_epi32_mask(a, b))
N2(SAME, spu_cmpeq, vm, vu, vu, _mm512_cmpeq_epi32_mask(a, b))
N2(SAME, spu_cmpgt, vm, vi, vi, _mm512_cmpgt_epi32_mask(a, b))
N2(SAME, spu_cmpgt, vm, vu, vu, _mm512_cmpgt_epu32_mask(a, b))
N2(SAME, spu_and, vm, vm, vm, _kand_mask16(a, b))
N2(SAME, spu_or, vm, vm, vm, _kor_mask16(a, b))
N2(SAME, spu_xor, vm, vm, vm, _kxor_mask16(a, b))
N2(SAME, spu_andc, vm, vm, vm, _kandn_mask16(b, a))
N2(SAME, spu_nor, vm, vm, vm, _knot_mask16(_kor_mask16(a, b)))
N2(SAME, spu_nor, vf, vf, vf, _mm512_castsi512_ps(NOR(_mm512_castps_si512(a), _mm512_castps_si512(b))))
N3(SAME, spu_sel, vf, vf, vf, vu, _mm512_castsi512_ps(_mm512_ternarylogic_epi32(_mm512_castps_si512(a),
    _mm512_castps_si512(b), c, 0xd8)))
N3(SAME, spu_sel, vu, vu, vu, vu, _mm512_ternarylogic_epi32(a, b, c, 0xd8))
N2(SAME, spu_convtf, vf, vu, n_scale, _mm512_mul_ps(_mm512_cvtepu32_ps(a), _mm512_set1_ps(1 / 256.f)))
#endif

/* ---- extension words ---- */

N2(SAME, spux_min, vf, vf, vf, W(min_ps)(a, b))
N2(SAME, spux_max, vf, vf, vf, W(max_ps)(a, b))
N1(SAME, spux_abs, vf, vf, W(andnot_ps)(W(set1_ps)(-0.f), a))
N2(SAME, spux_div, vf, vf, vf, W(div_ps)(a, b))
N1(SAME, spux_sqrt, vf, vf, W(sqrt_ps)(a))
N2(SAME, spux_cmpge, vm, vf, vf, COMPARE_PS(a, b, _CMP_GE_OQ, cmpge))
N2(SAME, spux_min, vi, vi, vi, W(min_epi32)(a, b))
N2(SAME, spux_min, vu, vu, vu, W(min_epu32)(a, b))
N2(SAME, spux_max, vi, vi, vi, W(max_epi32)(a, b))
N2(SAME, spux_max, vu, vu, vu, W(max_epu32)(a, b))
N2(SAME, spu_sl, vu, vu, x_u32, W(sll_epi32)(a, COUNT(b)))
N2(SAME, spu_sr, vu, vu, x_u32, W(srl_epi32)(a, COUNT(b)))
N2(SAME, spu_sra, vi, vi, x_u32, W(sra_epi32)(a, COUNT(b)))
N1(SAME, spux_load_unaligned, vf, x_u32, W(loadu_ps)(FLOATS + a))
#if CGT_LANES == 16
N3(SAME, spux_select, vf, vf, vf, vm, _mm512_mask_blend_ps(c, a, b))
N3(SAME, spux_select, vu, vu, vu, vm, _mm512_mask_blend_epi32(c, a, b))
N1(SAME, spux_not, vm, vm, _knot_mask16(a))
N1(SAME, spux_mask_bits, x_u32, vm, _cvtmask16_u32(a))
N1(SAME, spux_mask_from_bits, vm, x_u32, _cvtu32_mask16(a))
N1(SAME, spux_mask_first, vm, x_u32, _cvtu32_mask16((1u << a) - 1))
N1(SAME, spux_any, x_u32, vm, !_kortestz_mask16_u8(a, a))
N1(SAME, spux_all, x_u32, vm, _kortestc_mask16_u8(a, a))
N1(SAME, spux_load_mask, vf, vm, _mm512_maskz_loadu_ps(a, FLOATS + 1))
N1(SAME, spux_gather, vf, vi, _mm512_mask_i32gather_ps(_mm512_setzero_ps(), 0xffff, a, FLOATS, 4))
N2(SAME, spux_permute, vf, vf, vu, _mm512_maskz_permutexvar_ps(0xffff, b, a))
N2(SAME, spux_compress, vf, vf, vm, _mm512_maskz_compress_ps(b, a))
#else
N1(SAME, spux_not, vm, vm, SI(xor)(a, FULL))
N3(SAME, spux_select, vu, vu, vu, vm, W(blendv_epi8)(a, b, c))
N1(SAME, spux_any, x_u32, vm, !SI(testz)(a, a))
N1(SAME, spux_all, x_u32, vm, (unsigned)SI(testc)(a, FULL))
#endif
#if CGT_LANES == 8
N3(SAME, spux_select, vf, vf, vf, vm, _mm256_blendv_ps(a, b, _mm256_castsi256_ps(c)))
N1(SAME, spux_mask_bits, x_u32, vm, (unsigned)_mm256_movemask_ps(_mm256_castsi256_ps(a)))
N1(SAME, spux_load_mask, vf, vm, _mm256_maskload_ps(FLOATS + 1, a))
N1(SAME, spux_gather, vf, vi, _mm256_i32gather_ps(FLOATS, a, 4))
N2(SAME, spux_permute, vf, vf, vu, _mm256_permutevar8x32_ps(a, b))
N1(SAME, spux_hmin, x_f32, vf, simd_hmin4(_mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1))))
N1(SAME, spux_hmax, x_f32, vf, simd_hmax4(_mm_max_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1))))
N1(SAME, spux_hmin, x_u32, vu, simd_hmin4u(_mm_min_epu32(_mm256_castsi256_si128(a), _mm256_extracti128_si256(a, 1))))
N1(SAME, spux_hmax, x_u32, vu, simd_hmax4u(_mm_max_epu32(_mm256_castsi256_si128(a), _mm256_extracti128_si256(a, 1))))
#elif CGT_LANES == 4
N3(SAME, spux_select, vf, vf, vf, vm, _mm_blendv_ps(a, b, _mm_castsi128_ps(c)))
N1(SAME, spux_mask_bits, x_u32, vm, (unsigned)_mm_movemask_ps(_mm_castsi128_ps(a)))
N1(SAME, spux_hmin, x_f32, vf, simd_hmin4(a))
N1(SAME, spux_hmax, x_f32, vf, simd_hmax4(a))
N1(SAME, spux_hmin, x_u32, vu, simd_hmin4u(a))
N1(SAME, spux_hmax, x_u32, vu, simd_hmax4u(a))
#endif

#else

/* ---- NEON ---- */

N2(SAME, spux_min, vf, vf, vf, vminq_f32(a, b))
N2(SAME, spux_max, vf, vf, vf, vmaxq_f32(a, b))
N1(SAME, spux_abs, vf, vf, vabsq_f32(a))
N2(SAME, spux_div, vf, vf, vf, vdivq_f32(a, b))
N1(SAME, spux_sqrt, vf, vf, vsqrtq_f32(a))
N2(SAME, spux_cmpge, vm, vf, vf, vcgeq_f32(a, b))
N3(SAME, spux_select, vf, vf, vf, vm, vbslq_f32(c, b, a))
N3(SAME, spux_select, vu, vu, vu, vm, vbslq_u32(c, b, a))
N1(SAME, spux_not, vm, vm, vmvnq_u32(a))
N1(SAME, spux_mask_bits, x_u32, vm, vaddvq_u32(vandq_u32(a, ((const uint32x4_t){1, 2, 4, 8}))))
N1(SAME, spux_hmin, x_f32, vf, vminvq_f32(a))
N1(SAME, spux_hmax, x_f32, vf, vmaxvq_f32(a))
N2(SAME, spux_min, vi, vi, vi, vminq_s32(a, b))
N2(SAME, spux_min, vu, vu, vu, vminq_u32(a, b))
N2(SAME, spux_max, vi, vi, vi, vmaxq_s32(a, b))
N2(SAME, spux_max, vu, vu, vu, vmaxq_u32(a, b))
N1(SAME, spux_any, x_u32, vm, vmaxvq_u32(a) != 0)
N1(SAME, spux_all, x_u32, vm, vminvq_u32(a) != 0)
N2(SAME, spu_sl, vu, vu, x_u32, vshlq_u32(a, vdupq_n_s32((int)b)))
N2(SAME, spu_sr, vu, vu, x_u32, vshlq_u32(a, vdupq_n_s32(-(int)b)))
N2(SAME, spu_sra, vi, vi, x_u32, vshlq_s32(a, vdupq_n_s32(-(int)b)))
N1(SAME, spux_load_unaligned, vf, x_u32, vld1q_f32(FLOATS + a))
N1(SAME, spux_hmin, x_u32, vu, vminvq_u32(a))
N1(SAME, spux_hmax, x_u32, vu, vmaxvq_u32(a))

#endif

/* clang-format on */
