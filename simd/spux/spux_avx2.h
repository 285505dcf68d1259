/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words of vector.h that the SPU lacks, on eight lanes of AVX2. Words that move data are written for vuint;
 * vector.h wraps them for the other types. */
#ifndef CGT_SPUX_AVX2_H
#define CGT_SPUX_AVX2_H

#include "spu/spu_avx2.h"

/* ---- making ---- */
CGT_SPU_INLINE vfloat spux_vfloat(float x) { return (vfloat)_mm256_set1_ps(x); }
CGT_SPU_INLINE vint spux_vint(int32_t x) { return (vint)_mm256_set1_epi32(x); }
CGT_SPU_INLINE vuint spux_vuint(uint32_t x) { return (vuint)_mm256_set1_epi32((int)x); }
CGT_SPU_INLINE vuint spux_lane_index(void) { return (vuint){0, 1, 2, 3, 4, 5, 6, 7}; }

/* ---- masks ---- */
CGT_SPU_INLINE unsigned spux_mask_bits(vmask m) { return (unsigned)_mm256_movemask_ps((__m256)m); }
CGT_SPU_INLINE vmask spux_mask_from_bits(unsigned bits)
{
    const __m256i weight = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    return (vmask)_mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32((int)bits), weight), weight);
}
CGT_SPU_INLINE vmask spux_mask_first(unsigned n) { return (vmask)(spux_lane_index() < spux_vuint(n)); }
CGT_SPU_INLINE vmask spux_mask_none(void) { return (vmask)_mm256_setzero_si256(); }
CGT_SPU_INLINE vmask spux_mask_all(void) { return (vmask)_mm256_set1_epi32(-1); }
CGT_SPU_INLINE vmask spux_not(vmask m) { return ~m; }
CGT_SPU_INLINE uint32_t spux_count_bits(unsigned bits) { return (uint32_t)__builtin_popcount(bits); }
CGT_SPU_INLINE bool spux_any(vmask m) { return !_mm256_testz_si256((__m256i)m, (__m256i)m); }
CGT_SPU_INLINE bool spux_all(vmask m) { return _mm256_testc_si256((__m256i)m, _mm256_set1_epi32(-1)); }

/* ---- arithmetic ---- */
CGT_SPU_INLINE vfloat cgt_spux_min_f32w(vfloat a, vfloat b) { return (vfloat)_mm256_min_ps((__m256)a, (__m256)b); }
CGT_SPU_INLINE vfloat cgt_spux_max_f32w(vfloat a, vfloat b) { return (vfloat)_mm256_max_ps((__m256)a, (__m256)b); }
CGT_SPU_INLINE vint cgt_spux_min_s32w(vint a, vint b) { return (vint)_mm256_min_epi32((__m256i)a, (__m256i)b); }
CGT_SPU_INLINE vint cgt_spux_max_s32w(vint a, vint b) { return (vint)_mm256_max_epi32((__m256i)a, (__m256i)b); }
CGT_SPU_INLINE vuint cgt_spux_min_u32w(vuint a, vuint b) { return (vuint)_mm256_min_epu32((__m256i)a, (__m256i)b); }
CGT_SPU_INLINE vuint cgt_spux_max_u32w(vuint a, vuint b) { return (vuint)_mm256_max_epu32((__m256i)a, (__m256i)b); }
CGT_SPU_INLINE vfloat spux_div(vfloat a, vfloat b) { return a / b; }
CGT_SPU_INLINE vfloat spux_sqrt(vfloat a) { return (vfloat)_mm256_sqrt_ps((__m256)a); }
CGT_SPU_INLINE vfloat spux_rsqrte(vfloat a) { return (vfloat)_mm256_rsqrt_ps((__m256)a); }
CGT_SPU_INLINE vint spux_truncate(vfloat a) { return (vint)_mm256_cvttps_epi32((__m256)a); }
CGT_SPU_INLINE vmask spux_cmpge(vfloat a, vfloat b) { return (vmask)(a >= b); }

/* ---- selection ---- */
#if defined(__AVX512VL__) /* no blend: see spux_sse.h */
CGT_SPU_INLINE vfloat cgt_spux_select_f32w(vfloat a, vfloat b, vmask m) { return cgt_spu_sel_f32w(a, b, m); }
CGT_SPU_INLINE vuint cgt_spux_select_u32w(vuint a, vuint b, vmask m) { return cgt_spu_sel_u32w(a, b, m); }
#else
CGT_SPU_INLINE vfloat cgt_spux_select_f32w(vfloat a, vfloat b, vmask m)
{
    return (vfloat)_mm256_blendv_ps((__m256)a, (__m256)b, (__m256)m);
}
CGT_SPU_INLINE vuint cgt_spux_select_u32w(vuint a, vuint b, vmask m)
{
    return (vuint)_mm256_blendv_epi8((__m256i)a, (__m256i)b, (__m256i)m);
}
#endif

/* ---- memory ---- */
CGT_SPU_INLINE vuint cgt_spux_load_w(const void *p) { return (vuint)_mm256_load_si256(p); }
CGT_SPU_INLINE void cgt_spux_store_w(void *p, vuint v) { _mm256_store_si256(p, (__m256i)v); }
CGT_SPU_INLINE void cgt_spux_stream_w(void *p, vuint v) { cgt_spux_store_w(p, v); }
#define CGT_SPUX_OWN_STREAM
CGT_SPU_INLINE void spux_stream_line(void *to, const void *from)
{
    const __m256i *line = from;
    _mm256_stream_si256((__m256i *)to, _mm256_load_si256(line));
    _mm256_stream_si256((__m256i *)to + 1, _mm256_load_si256(line + 1));
}
CGT_SPU_INLINE void spux_stream_line_unaligned(void *to, const void *from)
{
    const __m256i *line = from;
    _mm256_stream_si256((__m256i *)to, _mm256_loadu_si256(line));
    _mm256_stream_si256((__m256i *)to + 1, _mm256_loadu_si256(line + 1));
}
CGT_SPU_INLINE void spux_stream_end(void) { _mm_sfence(); }
CGT_SPU_INLINE vuint cgt_spux_load_unaligned_w(const void *p) { return (vuint)_mm256_loadu_si256(p); }
CGT_SPU_INLINE void cgt_spux_store_unaligned_w(void *p, vuint v) { _mm256_storeu_si256(p, (__m256i)v); }
CGT_SPU_INLINE vuint cgt_spux_load_mask_w(const void *p, vmask m)
{
    return (vuint)_mm256_maskload_epi32(p, (__m256i)m);
}
CGT_SPU_INLINE void cgt_spux_store_mask_w(void *p, vuint v, vmask m)
{
    _mm256_maskstore_epi32(p, (__m256i)m, (__m256i)v);
}
CGT_SPU_INLINE vuint cgt_spux_gather_w(const void *base, vint index)
{
    return (vuint)_mm256_i32gather_epi32(base, (__m256i)index, 4);
}

/* ---- between lanes ---- */
CGT_SPU_INLINE vuint cgt_spux_permute_w(vuint a, vuint index)
{
    return (vuint)_mm256_permutevar8x32_epi32((__m256i)a, (__m256i)index);
}

/* The table holds the numbers of the true lanes of four, four bits each: two look-ups in sequence, where a table for
 * all eight lanes would have 256 entries. */
CGT_SPU_INLINE vuint cgt_spux_compress_w(vuint a, vmask m)
{
    static const uint16_t packed[16] = {0x0000, 0x0000, 0x0001, 0x0010, 0x0002, 0x0020, 0x0021, 0x0210,
                                        0x0003, 0x0030, 0x0031, 0x0310, 0x0032, 0x0320, 0x0321, 0x3210};
    const unsigned bits = spux_mask_bits(m), low = bits & 15, high = bits >> 4;
    const unsigned lanes = packed[low] | (packed[high] + 0x4444u) << 4 * spux_count_bits(low);
    const __m256i place = _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28);
    const __m256i index = _mm256_srlv_epi32(_mm256_set1_epi32((int)lanes), place);
    return cgt_spux_permute_w(a, (vuint)index) & spux_mask_first(spux_count_bits(bits));
}

/* two bits a halfword; beyond the last one lies a sentinel */
CGT_SPU_INLINE uint32_t spux_find16(const uint16_t *p, uint16_t x)
{
    const __m256i equal = _mm256_cmpeq_epi16(_mm256_loadu_si256((const void *)p), _mm256_set1_epi16((short)x));
    return (uint32_t)__builtin_ctzll((uint32_t)_mm256_movemask_epi8(equal) | UINT64_C(1) << 32) / 2;
}

CGT_SPU_INLINE float cgt_spux_hmin_f32w(vfloat a)
{
    const __m128 four = _mm_min_ps(_mm256_castps256_ps128((__m256)a), _mm256_extractf128_ps((__m256)a, 1));
    const __m128 two = _mm_min_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)));
}
CGT_SPU_INLINE float cgt_spux_hmax_f32w(vfloat a)
{
    const __m128 four = _mm_max_ps(_mm256_castps256_ps128((__m256)a), _mm256_extractf128_ps((__m256)a, 1));
    const __m128 two = _mm_max_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_max_ss(two, _mm_movehdup_ps(two)));
}
CGT_SPU_INLINE uint32_t cgt_spux_hmin_u32w(vuint a)
{
    const __m128i four = _mm_min_epu32(_mm256_castsi256_si128((__m256i)a), _mm256_extracti128_si256((__m256i)a, 1));
    const __m128i two = _mm_min_epu32(four, _mm_shuffle_epi32(four, 0x4e));
    return (uint32_t)_mm_cvtsi128_si32(_mm_min_epu32(two, _mm_shuffle_epi32(two, 0xb1)));
}
CGT_SPU_INLINE uint32_t cgt_spux_hmax_u32w(vuint a)
{
    const __m128i four = _mm_max_epu32(_mm256_castsi256_si128((__m256i)a), _mm256_extracti128_si256((__m256i)a, 1));
    const __m128i two = _mm_max_epu32(four, _mm_shuffle_epi32(four, 0x4e));
    return (uint32_t)_mm_cvtsi128_si32(_mm_max_epu32(two, _mm_shuffle_epi32(two, 0xb1)));
}

/* ---- transposes ---- */

/* Each half of four vectors as a matrix of 4x4. */
CGT_SPU_INLINE void cgt_spux_transpose4_w(const vfloat r[4], vfloat d[4])
{
    const __m256 low01 = _mm256_unpacklo_ps((__m256)r[0], (__m256)r[1]);
    const __m256 low23 = _mm256_unpacklo_ps((__m256)r[2], (__m256)r[3]);
    const __m256 high01 = _mm256_unpackhi_ps((__m256)r[0], (__m256)r[1]);
    const __m256 high23 = _mm256_unpackhi_ps((__m256)r[2], (__m256)r[3]);
    d[0] = (vfloat)_mm256_shuffle_ps(low01, low23, 0x44);
    d[1] = (vfloat)_mm256_shuffle_ps(low01, low23, 0xee);
    d[2] = (vfloat)_mm256_shuffle_ps(high01, high23, 0x44);
    d[3] = (vfloat)_mm256_shuffle_ps(high01, high23, 0xee);
}

CGT_SPU_INLINE void spux_transpose_fours(vuint v[2])
{
    const __m256i a = (__m256i)v[0], b = (__m256i)v[1];
    v[0] = (vuint)_mm256_permute2x128_si256(a, b, 0x20);
    v[1] = (vuint)_mm256_permute2x128_si256(a, b, 0x31);
}

CGT_SPU_INLINE void spux_unzip(vuint v[2])
{
    const __m256 a = (__m256)v[0], b = (__m256)v[1];
    const __m256d even = (__m256d)_mm256_shuffle_ps(a, b, 0x88), odd = (__m256d)_mm256_shuffle_ps(a, b, 0xdd);
    v[0] = (vuint)_mm256_permute4x64_pd(even, 0xd8);
    v[1] = (vuint)_mm256_permute4x64_pd(odd, 0xd8);
}

CGT_SPU_INLINE void spux_transpose(vfloat row[8])
{
    vfloat t[8];
    cgt_spux_transpose4_w(row, t);
    cgt_spux_transpose4_w(row + 4, t + 4);
    for (int j = 0; j < 4; j++) {
        row[j] = (vfloat)_mm256_permute2f128_ps((__m256)t[j], (__m256)t[4 + j], 0x20);
        row[4 + j] = (vfloat)_mm256_permute2f128_ps((__m256)t[j], (__m256)t[4 + j], 0x31);
    }
}

/* Lane k's record at AT(k), an expression: compilers would put an array of pointers into vectors. */
#define CGT_SPUX_LOAD_RECORDS4(AT, d)                                                                                  \
    do {                                                                                                               \
        vfloat r_[4];                                                                                                  \
        for (int k_ = 0; k_ < 4; k_++)                                                                                 \
            r_[k_] = (vfloat)_mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(AT(k_))),                        \
                                                  _mm_loadu_ps(AT(k_ + 4)), 1);                                        \
        cgt_spux_transpose4_w(r_, d);                                                                                  \
    } while (0)

#endif
