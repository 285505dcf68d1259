/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Words of vector.h on four lanes for which SSE4.1 has an instruction. */
#ifndef CGT_SPUX_SSE_H
#define CGT_SPUX_SSE_H

#include <smmintrin.h>

#include "spux_packed.h"

#define CGT_SPUX_OWN_MASK_BITS
CGT_SPU_INLINE unsigned spux_mask_bits(vmask m) { return (unsigned)_mm_movemask_ps((__m128)m); }

#define CGT_SPUX_OWN_STREAM
CGT_SPU_INLINE void spux_stream_line(void *to, const void *from)
{
    for (int i = 0; i < 4; i++)
        _mm_stream_si128((__m128i *)to + i, _mm_load_si128((const __m128i *)from + i));
}
CGT_SPU_INLINE void spux_stream_line_unaligned(void *to, const void *from)
{
    for (int i = 0; i < 4; i++)
        _mm_stream_si128((__m128i *)to + i, _mm_loadu_si128((const __m128i *)from + i));
}
CGT_SPU_INLINE void spux_stream_end(void) { _mm_sfence(); }

#define CGT_SPUX_OWN_ANY_ALL
CGT_SPU_INLINE bool spux_any(vmask m) { return !_mm_testz_si128((__m128i)m, (__m128i)m); }
CGT_SPU_INLINE bool spux_all(vmask m) { return _mm_testc_si128((__m128i)m, _mm_set1_epi32(-1)); }

#define CGT_SPUX_OWN_MIN_MAX
CGT_SPU_INLINE vfloat cgt_spux_min_f32w(vfloat a, vfloat b) { return (vfloat)_mm_min_ps((__m128)a, (__m128)b); }
CGT_SPU_INLINE vfloat cgt_spux_max_f32w(vfloat a, vfloat b) { return (vfloat)_mm_max_ps((__m128)a, (__m128)b); }
CGT_SPU_INLINE vint cgt_spux_min_s32w(vint a, vint b) { return (vint)_mm_min_epi32((__m128i)a, (__m128i)b); }
CGT_SPU_INLINE vint cgt_spux_max_s32w(vint a, vint b) { return (vint)_mm_max_epi32((__m128i)a, (__m128i)b); }
CGT_SPU_INLINE vuint cgt_spux_min_u32w(vuint a, vuint b) { return (vuint)_mm_min_epu32((__m128i)a, (__m128i)b); }
CGT_SPU_INLINE vuint cgt_spux_max_u32w(vuint a, vuint b) { return (vuint)_mm_max_epu32((__m128i)a, (__m128i)b); }

#define CGT_SPUX_OWN_HORIZONTAL
CGT_SPU_INLINE float cgt_spux_hmin_f32w(vfloat a)
{
    const __m128 two = _mm_min_ps((__m128)a, _mm_movehl_ps((__m128)a, (__m128)a));
    return _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps(two, two, 0x55)));
}
CGT_SPU_INLINE float cgt_spux_hmax_f32w(vfloat a)
{
    const __m128 two = _mm_max_ps((__m128)a, _mm_movehl_ps((__m128)a, (__m128)a));
    return _mm_cvtss_f32(_mm_max_ss(two, _mm_shuffle_ps(two, two, 0x55)));
}
CGT_SPU_INLINE uint32_t cgt_spux_hmin_u32w(vuint a)
{
    const __m128i two = _mm_min_epu32((__m128i)a, _mm_shuffle_epi32((__m128i)a, 0x4e));
    return (uint32_t)_mm_cvtsi128_si32(_mm_min_epu32(two, _mm_shuffle_epi32(two, 0xb1)));
}
CGT_SPU_INLINE uint32_t cgt_spux_hmax_u32w(vuint a)
{
    const __m128i two = _mm_max_epu32((__m128i)a, _mm_shuffle_epi32((__m128i)a, 0x4e));
    return (uint32_t)_mm_cvtsi128_si32(_mm_max_epu32(two, _mm_shuffle_epi32(two, 0xb1)));
}

#define CGT_SPUX_OWN_SQRT
CGT_SPU_INLINE vfloat spux_sqrt(vfloat a) { return (vfloat)_mm_sqrt_ps((__m128)a); }
CGT_SPU_INLINE vfloat spux_rsqrte(vfloat a) { return (vfloat)_mm_rsqrt_ps((__m128)a); }

#define CGT_SPUX_OWN_TRUNCATE
CGT_SPU_INLINE vint spux_truncate(vfloat a) { return (vint)_mm_cvttps_epi32((__m128)a); }

/* With AVX-512VL selection is bitwise, one vpternlog, like spu_sel: gcc 12 up to 12.3 and 13 up to 13.2 mistake a blend
 * by ~m for one by m there (gcc bug 112443). */
#if !defined(__AVX512VL__)
#define CGT_SPUX_OWN_SELECT
CGT_SPU_INLINE vfloat cgt_spux_select_f32w(vfloat a, vfloat b, vmask m)
{
    return (vfloat)_mm_blendv_ps((__m128)a, (__m128)b, (__m128)m);
}
CGT_SPU_INLINE vuint cgt_spux_select_u32w(vuint a, vuint b, vmask m)
{
    return (vuint)_mm_blendv_epi8((__m128i)a, (__m128i)b, (__m128i)m);
}
#endif

/* Bytes 4n to 4n + 3 for each lane number n. */
#define CGT_SPUX_OWN_PERMUTE
CGT_SPU_INLINE vuint cgt_spux_permute_w(vuint a, vuint index)
{
    const __m128i lane = _mm_and_si128((__m128i)index, _mm_set1_epi32(3));
    const __m128i first = _mm_mullo_epi32(lane, _mm_set1_epi32(0x04040404));
    return (vuint)_mm_shuffle_epi8((__m128i)a, _mm_add_epi8(first, _mm_set1_epi32(0x03020100)));
}

#define CGT_SPUX_OWN_COMPRESS
CGT_SPU_INLINE vuint cgt_spux_compress_w(vuint a, vmask m)
{
    const __m128i order = _mm_load_si128((const __m128i *)(const void *)cgt_spux_packed_bytes(spux_mask_bits(m)));
    return (vuint)_mm_shuffle_epi8((__m128i)a, order);
}

#define CGT_SPUX_OWN_FIND16
CGT_SPU_INLINE uint32_t spux_find16(const uint16_t *p, uint16_t x)
{
    const __m128i wanted = _mm_set1_epi16((short)x);
    const __m128i front = _mm_cmpeq_epi16(_mm_loadu_si128((const void *)p), wanted);
    const __m128i back = _mm_cmpeq_epi16(_mm_loadu_si128((const void *)(p + 8)), wanted);
    return (uint32_t)__builtin_ctz((unsigned)_mm_movemask_epi8(_mm_packs_epi16(front, back)) | 1u << 16);
}

#define CGT_SPUX_OWN_TRANSPOSE
CGT_SPU_INLINE void cgt_spux_transpose4_w(const vfloat r[4], vfloat d[4])
{
    const __m128 low01 = _mm_unpacklo_ps((__m128)r[0], (__m128)r[1]);
    const __m128 low23 = _mm_unpacklo_ps((__m128)r[2], (__m128)r[3]);
    const __m128 high01 = _mm_unpackhi_ps((__m128)r[0], (__m128)r[1]);
    const __m128 high23 = _mm_unpackhi_ps((__m128)r[2], (__m128)r[3]);
    d[0] = (vfloat)_mm_movelh_ps(low01, low23);
    d[1] = (vfloat)_mm_movehl_ps(low23, low01);
    d[2] = (vfloat)_mm_movelh_ps(high01, high23);
    d[3] = (vfloat)_mm_movehl_ps(high23, high01);
}

#endif
