/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The vocabulary at the width of a variant. Kernels include this file.
 *
 *   vfloat, vint, vuint   CGT_LANES elements
 *   vmask                 the result of a comparison: a vector or a k register, depending on the width. Use words
 *                         on it, never C operators
 *   spu_*                 the SPU's words on these types (spu_intrinsics.h): add, sub, mul, madd, msub, nmsub, re,
 *                         rsqrte, cmpgt, cmpeq, cmpabsgt, and, or, xor, andc, nor, sel, convtf, convts, and sl, sr, sra
 *                         by a scalar; and, or, xor, andc, nor take masks too. Words of 16 bytes (spu_splats,
 *                         spu_shuffle ...) stay on four lanes
 *   spux_*                words that the SPU lacks or needs several for, with the same result on every variant, lane by
 *                         lane. T is any of vfloat, vint, vuint; W float or uint (the word ends in _uint then)
 *
 *   spux_vfloat(x) vint vuint     x in every lane
 *   spux_lane_index()             0, 1, 2 ...
 *
 *   spux_load(p), store(p, v)     W, aligned to the vector
 *   spux_load_unaligned(p), store_unaligned(p, v)   W, aligned to the element
 *   spux_stream(p, v)             W, aligned to the vector: a store past the caches where a vector fills a cache line;
 *                                 storing parts of lines so is several times slower on some processors
 *   spux_stream_line(to, from)    64 bytes, aligned to 64: streaming stores where SPUX_STREAMS is 1, otherwise a copy
 *   spux_stream_line_unaligned(to, from)   the same, `from` aligned to the element
 *   spux_stream_end()             call it before another thread reads streamed data
 *   spux_load_mask(p, m)          W, aligned to the element; 0 where m is false; memory there is not accessed
 *   spux_store_mask(p, v, m)      likewise; memory where m is false keeps its content, and need not exist
 *   spux_gather(base, i)          W; base[i] by a vint of indices. Not spu_gather, which gathers bits
 *   spux_load_records4(base, stride, d)   CGT_LANES records of 4 floats, record k at base + k * stride floats, to the
 *                                         four vectors d[0] to d[3], one per element of the record
 *   spux_load_records4_at(base, at, d)    the same, record k at base + at[k]
 *   spux_load_records4_by(base, stride, number, step, d)   the same, record k at base + stride * number[k * step]
 *   spux_load_records8_at(base, at, d)    as spux_load_records4_at, of 8 floats, to the vectors d[8]
 *   spux_store_records4(base, stride, d)  the reverse of the first
 *   spux_load_bytes(p)            vuint; CGT_LANES bytes at p
 *
 *   spux_min, max(a, b)           T; b where a and b are unordered; which of two zeros is undefined
 *   spux_abs(a)                   float, sign bit cleared
 *   spux_div(a, b), sqrt(a)       float, rounded as IEEE has it; on an SPU, relative error at most 2^-21
 *   SPUX_ROUNDOFF                 the relative error of a float sum, difference, product or conversion is at most this
 *   spux_cmpge(a, b)              float, a >= b, false for NaN
 *   spux_rsqrte(a)                float; as spu_rsqrte where a > 0, NaN where a < 0 (undefined on an SPU), undefined
 *                                 for 0 and denormals
 *   spux_truncate(a)              vint; a towards zero, undefined beyond int32
 *   spux_select(a, b, m)          T; b in the lanes where m is true, else a
 *
 *   spux_not(m)                   the other lanes
 *   spux_any, all, none(m)        bool
 *   spux_mask_none, mask_all()    no lane, every lane
 *   spux_mask_first(n)            lanes 0 to n - 1
 *   spux_mask_bits(m)             bit i = lane i
 *   spux_mask_from_bits(b)        the reverse; bits beyond the lanes are ignored
 *   spux_count_bits(b)            number of lanes in such bits
 *
 *   spux_permute(a, i)            T; lane k is a's lane i[k] modulo CGT_LANES, i a vuint
 *   spux_compress(a, m)           T; the lanes where m is true side by side from lane 0, then zeros
 *   spux_compress_store(p, a, m)  W; stores only those to p and returns their number
 *   spux_hmin, hmax(a)            float and vuint: least and greatest lane; undefined where a lane is NaN
 *   spux_find16(p, x)             index of the first x among the 16 halfwords at p, aligned to the element; 16 for none
 *   spux_unzip(v)                 vuint v[2]: the even lanes of both, in order, to v[0], the odd ones to v[1]
 *   spux_transpose(row)           vfloat row[CGT_LANES] as a square matrix, in place
 *   spux_transpose_fours(v)       vuint v[CGT_LANES / 4] as a square matrix of groups of four lanes, in place
 *   spux_transpose4, 8, 16(from, from_stride, to, to_stride)   transposes a square matrix of floats in memory; rows
 *                                 from_stride and to_stride floats apart, aligned to the element
 *
 * CGT_LANES and, for the portable row, CGT_SPU_PORTABLE come from the variant's row in the build. A new width adds its
 * types and typed functions in mapping files of its own (spu_avx2.h, spux_avx2.h) and a line here and in spu_wide.h. */
#ifndef CGT_VECTOR_H
#define CGT_VECTOR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "spu_intrinsics.h"

#ifndef CGT_SPU_INLINE /* the SPU's own header does not define it */
#define CGT_SPU_INLINE static inline __attribute__((always_inline, unused))
#endif

#if CGT_LANES == 4
#include "spux/spux_four.h"
#elif CGT_LANES == 8
#include "spux/spux_avx2.h"
#elif CGT_LANES == 16
#include "spux/spux_avx512.h"
#else
#error "CGT_LANES: no mapping has this width"
#endif

#ifndef SPUX_ROUNDOFF
#define SPUX_ROUNDOFF 0x1p-24f
#endif
#define CGT_VECTOR_BYTES (4 * CGT_LANES)
#define CGT_ALL_LANES ((1u << CGT_LANES) - 1)

/* ---- one word for several types ---- */

CGT_SPU_INLINE vint cgt_spux_select_s32w(vint a, vint b, vmask m)
{
    return (vint)cgt_spux_select_u32w((vuint)a, (vuint)b, m);
}
CGT_SPU_INLINE vfloat cgt_spux_permute_f32w(vfloat a, vuint i) { return (vfloat)cgt_spux_permute_w((vuint)a, i); }
CGT_SPU_INLINE vint cgt_spux_permute_s32w(vint a, vuint i) { return (vint)cgt_spux_permute_w((vuint)a, i); }
CGT_SPU_INLINE vuint cgt_spux_permute_u32w(vuint a, vuint i) { return cgt_spux_permute_w(a, i); }
CGT_SPU_INLINE vfloat cgt_spux_compress_f32w(vfloat a, vmask m) { return (vfloat)cgt_spux_compress_w((vuint)a, m); }
CGT_SPU_INLINE vint cgt_spux_compress_s32w(vint a, vmask m) { return (vint)cgt_spux_compress_w((vuint)a, m); }
CGT_SPU_INLINE vuint cgt_spux_compress_u32w(vuint a, vmask m) { return cgt_spux_compress_w(a, m); }

/* clang-format off */
#define CGT_SPUX_SU(word) vint : cgt_spux_##word##_s32w, vuint : cgt_spux_##word##_u32w
#define CGT_SPUX_FU(word) vfloat : cgt_spux_##word##_f32w, vuint : cgt_spux_##word##_u32w
#define CGT_SPUX_FSU(word) vfloat : cgt_spux_##word##_f32w, CGT_SPUX_SU(word)
#define spux_min(a, b) _Generic((a), CGT_SPUX_FSU(min))(a, b)
#define spux_max(a, b) _Generic((a), CGT_SPUX_FSU(max))(a, b)
#define spux_select(a, b, m) _Generic((a), CGT_SPUX_FSU(select))(a, b, m)
#define spux_permute(a, i) _Generic((a), CGT_SPUX_FSU(permute))(a, i)
#define spux_compress(a, m) _Generic((a), CGT_SPUX_FSU(compress))(a, m)
#define spux_hmin(a) _Generic((a), CGT_SPUX_FU(hmin))(a)
#define spux_hmax(a) _Generic((a), CGT_SPUX_FU(hmax))(a)
/* clang-format on */

/* ---- words made of words ---- */

CGT_SPU_INLINE vfloat spux_abs(vfloat a) { return spu_andc(a, spux_vfloat(-0.f)); }
CGT_SPU_INLINE bool spux_none(vmask m) { return !spux_any(m); }

CGT_SPU_INLINE vfloat spux_load(const float *p) { return (vfloat)cgt_spux_load_w(p); }
CGT_SPU_INLINE vuint spux_load_uint(const uint32_t *p) { return cgt_spux_load_w(p); }
CGT_SPU_INLINE void spux_store(float *p, vfloat v) { cgt_spux_store_w(p, (vuint)v); }
CGT_SPU_INLINE void spux_store_uint(uint32_t *p, vuint v) { cgt_spux_store_w(p, v); }
CGT_SPU_INLINE void spux_stream(float *p, vfloat v) { cgt_spux_stream_w(p, (vuint)v); }
CGT_SPU_INLINE void spux_stream_uint(uint32_t *p, vuint v) { cgt_spux_stream_w(p, v); }
#ifdef CGT_SPUX_OWN_STREAM
#define SPUX_STREAMS 1
#else
#define SPUX_STREAMS 0
CGT_SPU_INLINE void spux_stream_line(void *to, const void *from) { memcpy(to, from, 64); }
CGT_SPU_INLINE void spux_stream_line_unaligned(void *to, const void *from) { memcpy(to, from, 64); }
CGT_SPU_INLINE void spux_stream_end(void) {}
#endif
CGT_SPU_INLINE vfloat spux_load_unaligned(const float *p) { return (vfloat)cgt_spux_load_unaligned_w(p); }
CGT_SPU_INLINE vuint spux_load_unaligned_uint(const uint32_t *p) { return cgt_spux_load_unaligned_w(p); }
CGT_SPU_INLINE void spux_store_unaligned(float *p, vfloat v) { cgt_spux_store_unaligned_w(p, (vuint)v); }
CGT_SPU_INLINE void spux_store_unaligned_uint(uint32_t *p, vuint v) { cgt_spux_store_unaligned_w(p, v); }
CGT_SPU_INLINE vfloat spux_load_mask(const float *p, vmask m) { return (vfloat)cgt_spux_load_mask_w(p, m); }
CGT_SPU_INLINE vuint spux_load_mask_uint(const uint32_t *p, vmask m) { return cgt_spux_load_mask_w(p, m); }
CGT_SPU_INLINE void spux_store_mask(float *p, vfloat v, vmask m) { cgt_spux_store_mask_w(p, (vuint)v, m); }
CGT_SPU_INLINE void spux_store_mask_uint(uint32_t *p, vuint v, vmask m) { cgt_spux_store_mask_w(p, v, m); }
CGT_SPU_INLINE vfloat spux_gather(const float *base, vint i) { return (vfloat)cgt_spux_gather_w(base, i); }
CGT_SPU_INLINE vuint spux_gather_uint(const uint32_t *base, vint i) { return cgt_spux_gather_w(base, i); }

/* compressed in a register first: compressing stores are slow on some CPUs */
CGT_SPU_INLINE uint32_t spux_compress_store_uint(uint32_t *p, vuint a, vmask m)
{
    const uint32_t count = spux_count_bits(spux_mask_bits(m));
    cgt_spux_store_mask_w(p, cgt_spux_compress_w(a, m), spux_mask_first(count));
    return count;
}
CGT_SPU_INLINE uint32_t spux_compress_store(float *p, vfloat a, vmask m)
{
    const uint32_t count = spux_count_bits(spux_mask_bits(m));
    cgt_spux_store_mask_w(p, cgt_spux_compress_w((vuint)a, m), spux_mask_first(count));
    return count;
}

/* ---- records and matrices ---- */

CGT_SPU_INLINE void spux_load_records4(const float *base, size_t stride, vfloat d[4])
{
#define CGT_SPUX_AT(k) (base + (size_t)(k)*stride)
    CGT_SPUX_LOAD_RECORDS4(CGT_SPUX_AT, d);
#undef CGT_SPUX_AT
}
CGT_SPU_INLINE void spux_load_records4_at(const float *base, const uint32_t at[CGT_LANES], vfloat d[4])
{
#define CGT_SPUX_AT(k) (base + at[k])
    CGT_SPUX_LOAD_RECORDS4(CGT_SPUX_AT, d);
#undef CGT_SPUX_AT
}
CGT_SPU_INLINE void spux_load_records4_by(const float *base, size_t stride, const uint32_t *number, size_t step,
                                          vfloat d[4])
{
#define CGT_SPUX_AT(k) (base + stride * number[(size_t)(k)*step])
    CGT_SPUX_LOAD_RECORDS4(CGT_SPUX_AT, d);
#undef CGT_SPUX_AT
}
#ifndef CGT_SPUX_OWN_RECORDS8
CGT_SPU_INLINE void spux_load_records8_at(const float *base, const uint32_t at[CGT_LANES], vfloat d[8])
{
    spux_load_records4_at(base, at, d);
    spux_load_records4_at(base + 4, at, d + 4);
}
#endif
CGT_SPU_INLINE void spux_store_records4(float *base, size_t stride, const vfloat d[4])
{
    vfloat row[4];
    cgt_spux_transpose4_w(d, row);
    for (size_t four = 0; four < CGT_LANES; four += 4)
        for (size_t k = 0; k < 4; k++)
            memcpy(base + (four + k) * stride, (const char *)&row[k] + four * sizeof(float), 4 * sizeof(float));
}
#ifndef CGT_SPUX_OWN_LOAD_BYTES
CGT_SPU_INLINE vuint spux_load_bytes(const uint8_t *p)
{
    typedef uint8_t bytes __attribute__((vector_size(CGT_LANES)));
    bytes b;
    memcpy(&b, p, sizeof b);
    return __builtin_convertvector(b, vuint);
}
#endif

/* A larger matrix by squares of CGT_LANES. */
CGT_SPU_INLINE void cgt_spux_transpose_blocks(const float *from, size_t from_stride, float *to, size_t to_stride,
                                              size_t edge)
{
    for (size_t y = 0; y < edge; y += CGT_LANES)
        for (size_t x = 0; x < edge; x += CGT_LANES) {
            vfloat row[CGT_LANES];
            for (size_t k = 0; k < CGT_LANES; k++)
                row[k] = spux_load_unaligned(from + (y + k) * from_stride + x);
            spux_transpose(row);
            for (size_t k = 0; k < CGT_LANES; k++)
                spux_store_unaligned(to + (x + k) * to_stride + y, row[k]);
        }
}
/* Fewer floats than lanes: rows padded with zeros. */
CGT_SPU_INLINE void cgt_spux_transpose_corner(const float *from, size_t from_stride, float *to, size_t to_stride,
                                              size_t edge)
{
    const vmask inside = spux_mask_first((unsigned)edge);
    vfloat row[CGT_LANES];
    for (size_t k = 0; k < CGT_LANES; k++)
        row[k] = k < edge ? spux_load_mask(from + k * from_stride, inside) : spux_vfloat(0);
    spux_transpose(row);
    for (size_t k = 0; k < edge; k++)
        spux_store_mask(to + k * to_stride, row[k], inside);
}
#if CGT_LANES == 4
#define CGT_SPUX_TRANSPOSE8 cgt_spux_transpose_blocks
#define CGT_SPUX_TRANSPOSE4 cgt_spux_transpose_blocks
#elif CGT_LANES == 8
#define CGT_SPUX_TRANSPOSE8 cgt_spux_transpose_blocks
#define CGT_SPUX_TRANSPOSE4 cgt_spux_transpose_corner
#else
#define CGT_SPUX_TRANSPOSE8 cgt_spux_transpose_corner
#define CGT_SPUX_TRANSPOSE4 cgt_spux_transpose_corner
#endif
CGT_SPU_INLINE void spux_transpose4(const float *from, size_t from_stride, float *to, size_t to_stride)
{
    CGT_SPUX_TRANSPOSE4(from, from_stride, to, to_stride, 4);
}
CGT_SPU_INLINE void spux_transpose8(const float *from, size_t from_stride, float *to, size_t to_stride)
{
    CGT_SPUX_TRANSPOSE8(from, from_stride, to, to_stride, 8);
}
CGT_SPU_INLINE void spux_transpose16(const float *from, size_t from_stride, float *to, size_t to_stride)
{
    cgt_spux_transpose_blocks(from, from_stride, to, to_stride, 16);
}

#endif
