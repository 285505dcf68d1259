/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words of vector.h that the SPU lacks, on four lanes: from the SPU's own words, or in plain C where those are no
 * better, so that they run on an SPU, on the portable mapping and on any other. SSE4.1, NEON, WebAssembly and the SPU
 * itself replace single words for which they have better. Words that move data are written for vuint; vector.h wraps
 * them for the other types. */
#ifndef CGT_SPUX_FOUR_H
#define CGT_SPUX_FOUR_H

#include "spu_intrinsics.h"

typedef vec_float4 vfloat;
typedef vec_int4 vint;
typedef vec_uint4 vuint;
typedef vec_uint4 vmask;

#if (defined(__SPU__) && !defined(CGT_SPU_HOST)) || defined(CGT_SPUX_SPU)
#include "spux_spu.h"
#elif defined(__SPU__) || defined(CGT_SPU_PORTABLE) || defined(CGT_SPU_EXACT)
#elif defined(__SSE4_1__)
#include "spux_sse.h"
#elif defined(__aarch64__) && !defined(__AARCH64EB__)
#include "spux_neon.h"
#elif defined(__wasm_simd128__)
#include "spux_wasm.h"
#endif

/* ---- making ---- */
CGT_SPU_INLINE vfloat spux_vfloat(float x) { return (vfloat){x, x, x, x}; }
CGT_SPU_INLINE vint spux_vint(int32_t x) { return (vint){x, x, x, x}; }
CGT_SPU_INLINE vuint spux_vuint(uint32_t x) { return (vuint){x, x, x, x}; }
CGT_SPU_INLINE vuint spux_lane_index(void) { return (vuint){0, 1, 2, 3}; }

/* ---- masks ---- */
#ifndef CGT_SPUX_OWN_MASK_BITS
CGT_SPU_INLINE unsigned spux_mask_bits(vmask m) { return (m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8); }
#endif
#ifndef CGT_SPUX_OWN_MASK_FROM_BITS
CGT_SPU_INLINE vmask spux_mask_from_bits(unsigned bits)
{
    return (vmask){0 - (bits & 1), 0 - (bits >> 1 & 1), 0 - (bits >> 2 & 1), 0 - (bits >> 3 & 1)};
}
#endif
CGT_SPU_INLINE vmask spux_mask_first(unsigned n) { return (vmask)spu_cmpgt(spux_vuint(n), spux_lane_index()); }
CGT_SPU_INLINE vmask spux_mask_none(void) { return spux_vuint(0); }
CGT_SPU_INLINE vmask spux_mask_all(void) { return spux_vuint(UINT32_MAX); }
CGT_SPU_INLINE vmask spux_not(vmask m) { return ~m; }
#ifndef CGT_SPUX_OWN_COUNT_BITS
CGT_SPU_INLINE uint32_t spux_count_bits(unsigned bits)
{
    return (uint32_t)(UINT64_C(0x4332322132212110) >> (4 * bits) & 7);
}
#endif
#ifndef CGT_SPUX_OWN_ANY_ALL
CGT_SPU_INLINE bool spux_any(vmask m) { return spux_mask_bits(m) != 0; }
CGT_SPU_INLINE bool spux_all(vmask m) { return spux_mask_bits(m) == 15; }
#endif

/* ---- arithmetic ---- */
#ifndef CGT_SPUX_OWN_MIN_MAX
CGT_SPU_INLINE vfloat cgt_spux_min_f32w(vfloat a, vfloat b) { return spu_sel(b, a, spu_cmpgt(b, a)); }
CGT_SPU_INLINE vfloat cgt_spux_max_f32w(vfloat a, vfloat b) { return spu_sel(b, a, spu_cmpgt(a, b)); }
CGT_SPU_INLINE vint cgt_spux_min_s32w(vint a, vint b) { return spu_sel(b, a, spu_cmpgt(b, a)); }
CGT_SPU_INLINE vint cgt_spux_max_s32w(vint a, vint b) { return spu_sel(b, a, spu_cmpgt(a, b)); }
CGT_SPU_INLINE vuint cgt_spux_min_u32w(vuint a, vuint b) { return spu_sel(b, a, spu_cmpgt(b, a)); }
CGT_SPU_INLINE vuint cgt_spux_max_u32w(vuint a, vuint b) { return spu_sel(b, a, spu_cmpgt(a, b)); }
#endif
#if defined(__SPU__) || defined(CGT_SPU_EXACT)
/* An SPU truncates: of a result from 2^e up to 2^(e + 1) it loses less than a unit in the last place, 2^(e - 23), which
 * is at most 2^-23 of the exact result and of what is left of it. Rounding to nearest loses half a unit. */
#define SPUX_ROUNDOFF 0x1p-23f
/* on an SPU, and in its arithmetic elsewhere: one Newton step after the estimates, which are good to 12 bits; the root
 * of 0 is 0 */
CGT_SPU_INLINE vfloat spux_div(vfloat a, vfloat b)
{
    const vfloat r = spu_re(b), y = spu_madd(spu_nmsub(b, r, spux_vfloat(1)), r, r), q = spu_mul(a, y);
    return spu_madd(spu_nmsub(b, q, a), y, q);
}
CGT_SPU_INLINE vfloat spux_sqrt(vfloat a)
{
    const vfloat r = spu_rsqrte(a), x = spu_mul(a, r), half = spu_mul(r, spux_vfloat(0.5f));
    const vfloat root = spu_madd(spu_nmsub(x, x, a), half, x);
    return spu_sel(root, spux_vfloat(0), spu_cmpeq(a, spux_vfloat(0)));
}
CGT_SPU_INLINE vfloat spux_rsqrte(vfloat a) { return spu_rsqrte(a); }
CGT_SPU_INLINE vmask spux_cmpge(vfloat a, vfloat b) { return spu_or(spu_cmpgt(a, b), spu_cmpeq(a, b)); }
#else
CGT_SPU_INLINE vmask spux_cmpge(vfloat a, vfloat b) { return (vmask)(a >= b); }
CGT_SPU_INLINE vfloat spux_div(vfloat a, vfloat b) { return a / b; }
#ifndef CGT_SPUX_OWN_SQRT
CGT_SPU_INLINE vfloat spux_sqrt(vfloat a)
{
    return (vfloat){__builtin_sqrtf(a[0]), __builtin_sqrtf(a[1]), __builtin_sqrtf(a[2]), __builtin_sqrtf(a[3])};
}
CGT_SPU_INLINE vfloat spux_rsqrte(vfloat a) { return 1.f / spux_sqrt(a); }
#endif
#endif
#ifndef CGT_SPUX_OWN_TRUNCATE
CGT_SPU_INLINE vint spux_truncate(vfloat a) { return spu_convts(a, 0); }
#endif

/* ---- selection ---- */
#ifndef CGT_SPUX_OWN_SELECT
CGT_SPU_INLINE vfloat cgt_spux_select_f32w(vfloat a, vfloat b, vmask m) { return spu_sel(a, b, m); }
CGT_SPU_INLINE vuint cgt_spux_select_u32w(vuint a, vuint b, vmask m) { return spu_sel(a, b, m); }
#endif

/* ---- memory ---- */
CGT_SPU_INLINE vuint cgt_spux_load_w(const void *p)
{
    vuint v;
    memcpy(&v, __builtin_assume_aligned(p, 16), sizeof v);
    return v;
}
CGT_SPU_INLINE void cgt_spux_store_w(void *p, vuint v) { memcpy(__builtin_assume_aligned(p, 16), &v, sizeof v); }
CGT_SPU_INLINE void cgt_spux_stream_w(void *p, vuint v) { cgt_spux_store_w(p, v); }
#ifndef CGT_SPUX_OWN_UNALIGNED
CGT_SPU_INLINE vuint cgt_spux_load_unaligned_w(const void *p)
{
    vuint v;
    memcpy(&v, p, sizeof v);
    return v;
}
CGT_SPU_INLINE void cgt_spux_store_unaligned_w(void *p, vuint v) { memcpy(p, &v, sizeof v); }
#endif
#ifndef CGT_SPUX_OWN_LOAD_STORE_MASK
CGT_SPU_INLINE vuint cgt_spux_load_mask_w(const void *p, vmask m)
{
    uint32_t lane[4] = {0, 0, 0, 0};
    for (unsigned left = spux_mask_bits(m); left; left &= left - 1) {
        const size_t i = (size_t)__builtin_ctz(left);
        memcpy(&lane[i], (const char *)p + i * sizeof lane[i], sizeof lane[i]);
    }
    return (vuint){lane[0], lane[1], lane[2], lane[3]};
}
CGT_SPU_INLINE void cgt_spux_store_mask_w(void *p, vuint v, vmask m)
{
    const uint32_t lane[4] = {v[0], v[1], v[2], v[3]};
    for (unsigned left = spux_mask_bits(m); left; left &= left - 1) {
        const size_t i = (size_t)__builtin_ctz(left);
        memcpy((char *)p + i * sizeof lane[i], &lane[i], sizeof lane[i]);
    }
}
#endif
#ifndef CGT_SPUX_OWN_GATHER
CGT_SPU_INLINE vuint cgt_spux_gather_w(const void *base, vint index)
{
    uint32_t lane[4];
    for (int i = 0; i < 4; i++)
        memcpy(&lane[i], (const char *)base + (ptrdiff_t)index[i] * 4, sizeof lane[i]);
    return (vuint){lane[0], lane[1], lane[2], lane[3]};
}
#endif

/* ---- between lanes ---- */
#ifndef CGT_SPUX_OWN_PERMUTE
CGT_SPU_INLINE vuint cgt_spux_permute_w(vuint a, vuint index)
{
    return (vuint){a[index[0] & 3], a[index[1] & 3], a[index[2] & 3], a[index[3] & 3]};
}
#endif
#ifndef CGT_SPUX_OWN_COMPRESS
CGT_SPU_INLINE vuint cgt_spux_compress_w(vuint a, vmask m)
{
    uint32_t lane[5] = {0, 0, 0, 0, 0};
    unsigned n = 0;
    for (int i = 0; i < 4; i++) {
        lane[n] = a[i] & m[i]; /* a false lane becomes zero, and the next true one takes its position */
        n += m[i] & 1;
    }
    return (vuint){lane[0], lane[1], lane[2], lane[3]};
}
#endif

#ifndef CGT_SPUX_OWN_FIND16
CGT_SPU_INLINE uint32_t spux_find16(const uint16_t *p, uint16_t x)
{
    uint32_t i = 0;
    while (i < 16 && p[i] != x)
        i++;
    return i;
}
#endif

#ifndef CGT_SPUX_OWN_HORIZONTAL
#if defined(CGT_SPU_EXACT)
/* by a word: C's comparison is not the SPU's */
CGT_SPU_INLINE float cgt_spux_hmin_f32w(vfloat a)
{
    const vfloat b = {a[2], a[3], a[0], a[1]}, two = spu_sel(a, b, spu_cmpgt(a, b)), c = {two[1], two[0]};
    return spu_sel(two, c, spu_cmpgt(two, c))[0];
}
CGT_SPU_INLINE float cgt_spux_hmax_f32w(vfloat a)
{
    const vfloat b = {a[2], a[3], a[0], a[1]}, two = spu_sel(a, b, spu_cmpgt(b, a)), c = {two[1], two[0]};
    return spu_sel(two, c, spu_cmpgt(c, two))[0];
}
#else
CGT_SPU_INLINE float cgt_spux_hmin_f32w(vfloat a)
{
    const float x = a[1] < a[0] ? a[1] : a[0], y = a[3] < a[2] ? a[3] : a[2];
    return y < x ? y : x;
}
CGT_SPU_INLINE float cgt_spux_hmax_f32w(vfloat a)
{
    const float x = a[1] > a[0] ? a[1] : a[0], y = a[3] > a[2] ? a[3] : a[2];
    return y > x ? y : x;
}
#endif
CGT_SPU_INLINE uint32_t cgt_spux_hmin_u32w(vuint a)
{
    const uint32_t x = a[1] < a[0] ? a[1] : a[0], y = a[3] < a[2] ? a[3] : a[2];
    return y < x ? y : x;
}
CGT_SPU_INLINE uint32_t cgt_spux_hmax_u32w(vuint a)
{
    const uint32_t x = a[1] > a[0] ? a[1] : a[0], y = a[3] > a[2] ? a[3] : a[2];
    return y > x ? y : x;
}
#endif

/* ---- transposes ---- */
#ifndef CGT_SPUX_OWN_TRANSPOSE
CGT_SPU_INLINE void cgt_spux_transpose4_w(const vfloat r[4], vfloat d[4])
{
    for (int j = 0; j < 4; j++)
        d[j] = (vfloat){r[0][j], r[1][j], r[2][j], r[3][j]};
}
#endif
CGT_SPU_INLINE void spux_transpose_fours(vuint v[1]) { (void)v; }
#ifndef CGT_SPUX_OWN_UNZIP
CGT_SPU_INLINE void spux_unzip(vuint v[2])
{
    const vuint even = {v[0][0], v[0][2], v[1][0], v[1][2]}, odd = {v[0][1], v[0][3], v[1][1], v[1][3]};
    v[0] = even;
    v[1] = odd;
}
#endif
CGT_SPU_INLINE void spux_transpose(vfloat row[4])
{
    vfloat t[4];
    cgt_spux_transpose4_w(row, t);
    for (int j = 0; j < 4; j++)
        row[j] = t[j];
}
/* Lane k's record at AT(k). */
#ifndef CGT_SPUX_OWN_LOAD_RECORDS4
#define CGT_SPUX_LOAD_RECORDS4(AT, d)                                                                                  \
    do {                                                                                                               \
        vfloat r_[4];                                                                                                  \
        for (int k_ = 0; k_ < 4; k_++)                                                                                 \
            memcpy(&r_[k_], AT(k_), sizeof r_[k_]);                                                                    \
        cgt_spux_transpose4_w(r_, d);                                                                                  \
    } while (0)
#endif

#endif
