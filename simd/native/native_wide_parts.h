/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: types of the forms of native_wide.h, and instructions
 * by the width of the variant.
 *
 *   W(op)    _mm_op, _mm256_op, _mm512_op
 *   SI(op)   the same of whole registers, _mm_op_si128 ... */
#ifndef CGT_NATIVE_WIDE_PARTS_H
#define CGT_NATIVE_WIDE_PARTS_H

#define FLOATS ((const float *)(const void *)m->table)

#if defined(__aarch64__)

typedef float32x4_t SIMD_TYPE_vf;
typedef int32x4_t SIMD_TYPE_vi;
typedef uint32x4_t SIMD_TYPE_vu, SIMD_TYPE_vm;
#define SIMD_CLASS_vm VECTOR

#else

#if CGT_LANES == 4
#define W(op) _mm_##op
#define SI(op) _mm_##op##_si128
typedef __m128 SIMD_TYPE_vf;
typedef __m128i SIMD_TYPE_vi, SIMD_TYPE_vu, SIMD_TYPE_vm;
#elif CGT_LANES == 8
#define W(op) _mm256_##op
#define SI(op) _mm256_##op##_si256
typedef __m256 SIMD_TYPE_vf;
typedef __m256i SIMD_TYPE_vi, SIMD_TYPE_vu, SIMD_TYPE_vm;
#else
#define W(op) _mm512_##op
#define SI(op) _mm512_##op##_si512
typedef __m512 SIMD_TYPE_vf;
typedef __m512i SIMD_TYPE_vi, SIMD_TYPE_vu;
typedef __mmask16 SIMD_TYPE_vm;
#endif

#if CGT_LANES == 16

#define SIMD_CLASS_vm MASK
#define SIMD_HOLD_MASK(m) __asm__ volatile("" : "+k"(m))
#define SIMD_USE_MASK(m) __asm__ volatile("" : : "k"(m))
#define COMPARE_PS(a, b, how, name) _mm512_cmp_ps_mask(a, b, how)
#define NOR(a, b) _mm512_ternarylogic_epi32(a, a, b, 0x05)

#else

#define SIMD_CLASS_vm VECTOR
#if CGT_LANES == 8
#define COMPARE_PS(a, b, how, name) SI(castps)(_mm256_cmp_ps(a, b, how))
#else
#define COMPARE_PS(a, b, how, name) SI(castps)(_mm_##name##_ps(a, b))
#endif
#define FULL W(set1_epi32)(-1)
#define NOR(a, b) SI (xor)(SI(or)(a, b), FULL)
#define TOP W(set1_epi32)(INT32_MIN)

static inline SIMD_TYPE_vf simd_convtf_vu(SIMD_TYPE_vu a)
{
    const SIMD_TYPE_vu low = W(blend_epi16)(a, W(set1_epi32)(0x4b000000), 0xaa);
    const SIMD_TYPE_vu high = W(blend_epi16)(W(srli_epi32)(a, 16), W(set1_epi32)(0x53000000), 0xaa);
#if CGT_LANES == 8
    return W(add_ps)(W(sub_ps)(W(castsi256_ps)(high), W(set1_ps)(549764202496.f)), W(castsi256_ps)(low));
#else
    return W(add_ps)(W(sub_ps)(W(castsi128_ps)(high), W(set1_ps)(549764202496.f)), W(castsi128_ps)(low));
#endif
}

#endif

static inline __m128 simd_half_min(__m128 a) { return _mm_min_ps(a, _mm_movehl_ps(a, a)); }
static inline __m128 simd_half_max(__m128 a) { return _mm_max_ps(a, _mm_movehl_ps(a, a)); }
static inline float simd_hmin4(__m128 a)
{
    const __m128 two = simd_half_min(a);
    return _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps(two, two, 0x55)));
}
static inline float simd_hmax4(__m128 a)
{
    const __m128 two = simd_half_max(a);
    return _mm_cvtss_f32(_mm_max_ss(two, _mm_shuffle_ps(two, two, 0x55)));
}
static inline unsigned simd_hmin4u(__m128i a)
{
    const __m128i two = _mm_min_epu32(a, _mm_shuffle_epi32(a, 0x4e));
    return (unsigned)_mm_cvtsi128_si32(_mm_min_epu32(two, _mm_shuffle_epi32(two, 0xb1)));
}
static inline unsigned simd_hmax4u(__m128i a)
{
    const __m128i two = _mm_max_epu32(a, _mm_shuffle_epi32(a, 0x4e));
    return (unsigned)_mm_cvtsi128_si32(_mm_max_epu32(two, _mm_shuffle_epi32(two, 0xb1)));
}

#endif
#endif
