/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The vocabulary at the width of a variant: what a kernel includes.
 *
 *   vfloat, vint, vuint   CGT_LANES elements
 *   vmask                 the result of a comparison
 *   spu_*                 the SPU's words on these types (spu_intrinsics.h)
 *   spux_*                words that the SPU lacks or does in several, defined on every variant:
 *     spux_vfloat(x) vint vuint   x in every lane of the variant's width
 *     spux_load, spux_store       aligned to the vector; spux_load_uint, spux_store_uint for vuint
 *     spux_lane_index()           0, 1, 2 ...
 *     spux_min, spux_max          b where a and b do not compare
 *     spux_abs                    sign bit cleared
 *     spux_div, spux_sqrt         relative error at most 2^-21
 *     spux_cmpge(a, b)            a >= b, false for NaN
 *     spux_select(a, b, m)        b in the lanes where m is true, else a
 *     spux_mask_bits(m)           bit i = lane i
 *     spux_count_bits(b)          how many lanes of such bits
 *     spux_not(m)                 the other lanes
 *     spux_hmin, spux_hmax        least and greatest lane
 *
 * CGT_LANES and, for the portable row, CGT_SPU_PORTABLE come from the variant's row in the build. A new width adds its
 * types and typed functions in a mapping file and a block here. */
#ifndef CGT_VECTOR_H
#define CGT_VECTOR_H

#include <string.h>

#include "spu_intrinsics.h"

#if CGT_LANES == 4
typedef vec_float4 vfloat;
typedef vec_int4 vint;
typedef vec_uint4 vuint;
typedef vec_uint4 vmask;
#define spux_vfloat(x) cgt_spu_splats_f32(x)
#define spux_vint(x) cgt_spu_splats_s32(x)
#define spux_vuint(x) cgt_spu_splats_u32(x)
#define spux_lane_index() ((vuint){0, 1, 2, 3})
#define spux_min(a, b) cgt_spux_min_f32(a, b)
#define spux_max(a, b) cgt_spux_max_f32(a, b)
#define spux_div(a, b) cgt_spux_div_f32(a, b)
#define spux_sqrt(a) cgt_spux_sqrt_f32(a)
#define spux_cmpge(a, b) cgt_spux_cmpge_f32(a, b)
#define spux_select(a, b, m) _Generic((a), vec_float4 : cgt_spux_select_f32, vec_uint4 : cgt_spux_select_u32)(a, b, m)
#define spux_mask_bits(m) cgt_spux_mask_bits_u32(m)
#define spux_count_bits(b) ((uint32_t)(UINT64_C(0x4332322132212110) >> (4 * (b)) & 7))
#define spux_not(m) (~(m))
#else
#error "CGT_LANES: no mapping has this width"
#endif

#define CGT_VECTOR_BYTES (4 * CGT_LANES)
#define CGT_ALL_LANES ((1u << CGT_LANES) - 1)

#define spux_abs(a) spu_andc(a, spux_vfloat(-0.f))

CGT_SPU_INLINE vfloat spux_load(const float *p)
{
    vfloat v;
    memcpy(&v, __builtin_assume_aligned(p, CGT_VECTOR_BYTES), sizeof v);
    return v;
}
CGT_SPU_INLINE vuint spux_load_uint(const uint32_t *p)
{
    vuint v;
    memcpy(&v, __builtin_assume_aligned(p, CGT_VECTOR_BYTES), sizeof v);
    return v;
}
CGT_SPU_INLINE void spux_store(float *p, vfloat v)
{
    memcpy(__builtin_assume_aligned(p, CGT_VECTOR_BYTES), &v, sizeof v);
}
CGT_SPU_INLINE void spux_store_uint(uint32_t *p, vuint v)
{
    memcpy(__builtin_assume_aligned(p, CGT_VECTOR_BYTES), &v, sizeof v);
}

CGT_SPU_INLINE float spux_hmin(vfloat a)
{
    float m = a[0];
    for (int i = 1; i < CGT_LANES; i++)
        m = a[i] < m ? a[i] : m;
    return m;
}
CGT_SPU_INLINE float spux_hmax(vfloat a)
{
    float m = a[0];
    for (int i = 1; i < CGT_LANES; i++)
        m = a[i] > m ? a[i] : m;
    return m;
}

#endif
