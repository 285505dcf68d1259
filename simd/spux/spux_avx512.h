/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words of vector.h that the SPU lacks, on sixteen lanes of AVX-512. Words that move data are written for vuint;
 * vector.h wraps them for the other types. */
#ifndef CGT_SPUX_AVX512_H
#define CGT_SPUX_AVX512_H

#include "spu/spu_avx512.h"

/* ---- making ---- */
CGT_SPU_INLINE vfloat spux_vfloat(float x) { return (vfloat)_mm512_set1_ps(x); }
CGT_SPU_INLINE vint spux_vint(int32_t x) { return (vint)_mm512_set1_epi32(x); }
CGT_SPU_INLINE vuint spux_vuint(uint32_t x) { return (vuint)_mm512_set1_epi32((int)x); }
CGT_SPU_INLINE vuint spux_lane_index(void) { return (vuint){0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}; }

/* ---- masks ---- */
/* GCC 12 may keep the bits in a mask register, spill 16 of them and reload 32: the empty asm prevents that. */
CGT_SPU_INLINE unsigned spux_mask_bits(vmask m)
{
    unsigned bits = _cvtmask16_u32(m.bits);
    __asm__("" : "+r"(bits));
    return bits;
}
CGT_SPU_INLINE vmask spux_mask_from_bits(unsigned bits) { return (vmask){_cvtu32_mask16(bits)}; }
CGT_SPU_INLINE vmask spux_mask_first(unsigned n) { return spux_mask_from_bits(n < 16 ? (1u << n) - 1 : 0xffff); }
CGT_SPU_INLINE vmask spux_mask_none(void) { return (vmask){0}; }
CGT_SPU_INLINE vmask spux_mask_all(void) { return (vmask){0xffff}; }
CGT_SPU_INLINE vmask spux_not(vmask m) { return (vmask){_knot_mask16(m.bits)}; }
CGT_SPU_INLINE uint32_t spux_count_bits(unsigned bits) { return (uint32_t)__builtin_popcount(bits); }
CGT_SPU_INLINE bool spux_any(vmask m) { return !_kortestz_mask16_u8(m.bits, m.bits); }
CGT_SPU_INLINE bool spux_all(vmask m) { return _kortestc_mask16_u8(m.bits, m.bits); }

/* ---- arithmetic ---- */
CGT_SPU_INLINE vfloat cgt_spux_min_f32w(vfloat a, vfloat b) { return (vfloat)_mm512_min_ps((__m512)a, (__m512)b); }
CGT_SPU_INLINE vfloat cgt_spux_max_f32w(vfloat a, vfloat b) { return (vfloat)_mm512_max_ps((__m512)a, (__m512)b); }
CGT_SPU_INLINE vint cgt_spux_min_s32w(vint a, vint b) { return (vint)_mm512_min_epi32((__m512i)a, (__m512i)b); }
CGT_SPU_INLINE vint cgt_spux_max_s32w(vint a, vint b) { return (vint)_mm512_max_epi32((__m512i)a, (__m512i)b); }
CGT_SPU_INLINE vuint cgt_spux_min_u32w(vuint a, vuint b) { return (vuint)_mm512_min_epu32((__m512i)a, (__m512i)b); }
CGT_SPU_INLINE vuint cgt_spux_max_u32w(vuint a, vuint b) { return (vuint)_mm512_max_epu32((__m512i)a, (__m512i)b); }
CGT_SPU_INLINE vfloat spux_div(vfloat a, vfloat b) { return a / b; }
CGT_SPU_INLINE vfloat spux_sqrt(vfloat a) { return (vfloat)_mm512_sqrt_ps((__m512)a); }
CGT_SPU_INLINE vfloat spux_rsqrte(vfloat a) { return (vfloat)_mm512_rsqrt14_ps((__m512)a); }
CGT_SPU_INLINE vint spux_truncate(vfloat a) { return (vint)_mm512_cvttps_epi32((__m512)a); }
CGT_SPU_INLINE vmask spux_cmpge(vfloat a, vfloat b)
{
    return (vmask){_mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_GE_OQ)};
}

/* ---- selection ---- */
CGT_SPU_INLINE vfloat cgt_spux_select_f32w(vfloat a, vfloat b, vmask m)
{
    return (vfloat)_mm512_mask_mov_ps((__m512)a, m.bits, (__m512)b);
}
CGT_SPU_INLINE vuint cgt_spux_select_u32w(vuint a, vuint b, vmask m)
{
    return (vuint)_mm512_mask_mov_epi32((__m512i)a, m.bits, (__m512i)b);
}

/* ---- memory ---- */
CGT_SPU_INLINE vuint cgt_spux_load_w(const void *p) { return (vuint)_mm512_load_si512(p); }
CGT_SPU_INLINE void cgt_spux_store_w(void *p, vuint v) { _mm512_store_si512(p, (__m512i)v); }
CGT_SPU_INLINE void cgt_spux_stream_w(void *p, vuint v) { _mm512_stream_si512(p, (__m512i)v); }
#define CGT_SPUX_OWN_STREAM
CGT_SPU_INLINE void spux_stream_line(void *to, const void *from) { _mm512_stream_si512(to, _mm512_load_si512(from)); }
CGT_SPU_INLINE void spux_stream_line_unaligned(void *to, const void *from)
{
    _mm512_stream_si512(to, _mm512_loadu_si512(from));
}
CGT_SPU_INLINE void spux_stream_end(void) { _mm_sfence(); }
CGT_SPU_INLINE vuint cgt_spux_load_unaligned_w(const void *p) { return (vuint)_mm512_loadu_si512(p); }
CGT_SPU_INLINE void cgt_spux_store_unaligned_w(void *p, vuint v) { _mm512_storeu_si512(p, (__m512i)v); }
CGT_SPU_INLINE vuint cgt_spux_load_mask_w(const void *p, vmask m) { return (vuint)_mm512_maskz_loadu_epi32(m.bits, p); }
CGT_SPU_INLINE void cgt_spux_store_mask_w(void *p, vuint v, vmask m)
{
    _mm512_mask_storeu_epi32(p, m.bits, (__m512i)v);
}
CGT_SPU_INLINE vuint cgt_spux_gather_w(const void *base, vint index)
{
    return (vuint)_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xffff, (__m512i)index, base, 4);
}

/* ---- between lanes ---- */
CGT_SPU_INLINE vuint cgt_spux_permute_w(vuint a, vuint index)
{
    return (vuint)_mm512_maskz_permutexvar_epi32(0xffff, (__m512i)index, (__m512i)a);
}
CGT_SPU_INLINE vuint cgt_spux_compress_w(vuint a, vmask m)
{
    return (vuint)_mm512_maskz_compress_epi32(m.bits, (__m512i)a);
}

CGT_SPU_INLINE uint32_t spux_find16(const uint16_t *p, uint16_t x)
{
    const __m256i v = _mm256_loadu_si256((const void *)p);
    return (uint32_t)__builtin_ctz(_mm256_cmpeq_epi16_mask(v, _mm256_set1_epi16((short)x)) | 1u << 16);
}

/* Upper and lower half; _mm512_extractf32x8_ps and the reductions warn of an uninitialised value in gcc 12. */
CGT_SPU_INLINE __m256 cgt_spux_half_w(vfloat a, int upper)
{
    const __m512d d = _mm512_castps_pd((__m512)a);
    return _mm256_castpd_ps(upper ? _mm512_maskz_extractf64x4_pd(0xff, d, 1) : _mm512_castpd512_pd256(d));
}
CGT_SPU_INLINE float cgt_spux_hmin_f32w(vfloat a)
{
    const __m256 eight = _mm256_min_ps(cgt_spux_half_w(a, 0), cgt_spux_half_w(a, 1));
    const __m128 four = _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
    const __m128 two = _mm_min_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)));
}
CGT_SPU_INLINE float cgt_spux_hmax_f32w(vfloat a)
{
    const __m256 eight = _mm256_max_ps(cgt_spux_half_w(a, 0), cgt_spux_half_w(a, 1));
    const __m128 four = _mm_max_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
    const __m128 two = _mm_max_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_max_ss(two, _mm_movehdup_ps(two)));
}
CGT_SPU_INLINE uint32_t cgt_spux_hmin_u32w(vuint a)
{
    const __m256i low = _mm256_castps_si256(cgt_spux_half_w((vfloat)a, 0));
    const __m256i eight = _mm256_min_epu32(low, _mm256_castps_si256(cgt_spux_half_w((vfloat)a, 1)));
    const __m128i four = _mm_min_epu32(_mm256_castsi256_si128(eight), _mm256_extracti128_si256(eight, 1));
    const __m128i two = _mm_min_epu32(four, _mm_shuffle_epi32(four, 0x4e));
    return (uint32_t)_mm_cvtsi128_si32(_mm_min_epu32(two, _mm_shuffle_epi32(two, 0xb1)));
}
CGT_SPU_INLINE uint32_t cgt_spux_hmax_u32w(vuint a)
{
    const __m256i low = _mm256_castps_si256(cgt_spux_half_w((vfloat)a, 0));
    const __m256i eight = _mm256_max_epu32(low, _mm256_castps_si256(cgt_spux_half_w((vfloat)a, 1)));
    const __m128i four = _mm_max_epu32(_mm256_castsi256_si128(eight), _mm256_extracti128_si256(eight, 1));
    const __m128i two = _mm_max_epu32(four, _mm_shuffle_epi32(four, 0x4e));
    return (uint32_t)_mm_cvtsi128_si32(_mm_max_epu32(two, _mm_shuffle_epi32(two, 0xb1)));
}

/* ---- transposes ---- */

/* Each quarter of four vectors as a matrix of 4x4. */
CGT_SPU_INLINE void cgt_spux_transpose4_w(const vfloat r[4], vfloat d[4])
{
    const __m512 low01 = _mm512_unpacklo_ps((__m512)r[0], (__m512)r[1]);
    const __m512 low23 = _mm512_unpacklo_ps((__m512)r[2], (__m512)r[3]);
    const __m512 high01 = _mm512_unpackhi_ps((__m512)r[0], (__m512)r[1]);
    const __m512 high23 = _mm512_unpackhi_ps((__m512)r[2], (__m512)r[3]);
    d[0] = (vfloat)_mm512_shuffle_ps(low01, low23, 0x44);
    d[1] = (vfloat)_mm512_shuffle_ps(low01, low23, 0xee);
    d[2] = (vfloat)_mm512_shuffle_ps(high01, high23, 0x44);
    d[3] = (vfloat)_mm512_shuffle_ps(high01, high23, 0xee);
}

CGT_SPU_INLINE void spux_transpose_fours(vuint v[4])
{
    const __m512i even01 = _mm512_shuffle_i32x4((__m512i)v[0], (__m512i)v[1], 0x88);
    const __m512i even23 = _mm512_shuffle_i32x4((__m512i)v[2], (__m512i)v[3], 0x88);
    const __m512i odd01 = _mm512_shuffle_i32x4((__m512i)v[0], (__m512i)v[1], 0xdd);
    const __m512i odd23 = _mm512_shuffle_i32x4((__m512i)v[2], (__m512i)v[3], 0xdd);
    v[0] = (vuint)_mm512_shuffle_i32x4(even01, even23, 0x88);
    v[1] = (vuint)_mm512_shuffle_i32x4(odd01, odd23, 0x88);
    v[2] = (vuint)_mm512_shuffle_i32x4(even01, even23, 0xdd);
    v[3] = (vuint)_mm512_shuffle_i32x4(odd01, odd23, 0xdd);
}

CGT_SPU_INLINE void spux_unzip(vuint v[2])
{
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    const __m512i odd = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
    const __m512i a = (__m512i)v[0], b = (__m512i)v[1];
    v[0] = (vuint)_mm512_permutex2var_epi32(a, even, b);
    v[1] = (vuint)_mm512_permutex2var_epi32(a, odd, b);
}

/* Transposes quarters of 4x4, then the quarters themselves. */
CGT_SPU_INLINE void spux_transpose(vfloat row[16])
{
    vfloat t[16];
    for (int g = 0; g < 16; g += 4)
        cgt_spux_transpose4_w(row + g, t + g);
    for (int j = 0; j < 4; j++) {
        vuint v[4] = {(vuint)t[j], (vuint)t[4 + j], (vuint)t[8 + j], (vuint)t[12 + j]};
        spux_transpose_fours(v);
        for (int g = 0; g < 4; g++)
            row[4 * g + j] = (vfloat)v[g];
    }
}

/* Lane k's record at AT(k), an expression: compilers would put an array of pointers into vectors. */
#define CGT_SPUX_LOAD_RECORDS4(AT, d)                                                                                  \
    do {                                                                                                               \
        vfloat r_[4];                                                                                                  \
        for (int k_ = 0; k_ < 4; k_++) {                                                                               \
            __m512 v_ = _mm512_castps128_ps512(_mm_loadu_ps(AT(k_)));                                                  \
            v_ = _mm512_insertf32x4(v_, _mm_loadu_ps(AT(k_ + 4)), 1);                                                  \
            v_ = _mm512_insertf32x4(v_, _mm_loadu_ps(AT(k_ + 8)), 2);                                                  \
            r_[k_] = (vfloat)_mm512_insertf32x4(v_, _mm_loadu_ps(AT(k_ + 12)), 3);                                     \
        }                                                                                                              \
        cgt_spux_transpose4_w(r_, d);                                                                                  \
    } while (0)

/* Two whole records in each vector: half as many insertions as with quarters. */
#define CGT_SPUX_OWN_RECORDS8
CGT_SPU_INLINE void spux_load_records8_at(const float *base, const uint32_t at[16], vfloat d[8])
{
    vfloat t[2][4];
    for (int g = 0; g < 2; g++) {
        vfloat r[4];
        for (int k = 0; k < 4; k++) {
            const __m256 lower = _mm256_loadu_ps(base + at[8 * g + k]),
                         upper = _mm256_loadu_ps(base + at[8 * g + k + 4]);
            r[k] =
                (vfloat)_mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(lower)), _mm256_castps_pd(upper), 1);
        }
        cgt_spux_transpose4_w(r, t[g]);
    }
    for (int j = 0; j < 4; j++) {
        d[j] = (vfloat)_mm512_shuffle_f32x4((__m512)t[0][j], (__m512)t[1][j], 0x88);
        d[4 + j] = (vfloat)_mm512_shuffle_f32x4((__m512)t[0][j], (__m512)t[1][j], 0xdd);
    }
}

#endif
