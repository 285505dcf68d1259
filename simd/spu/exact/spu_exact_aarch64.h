/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The host functions that spu_exact_fast.h needs, with AArch64 NEON. A part of spu_exact.h. */
#ifndef CGT_SPU_EXACT_AARCH64_H
#define CGT_SPU_EXACT_AARCH64_H

#define CGT_SPU_HOLD(v) __asm__ volatile("" : "+w"(v))

/* the comparison of magnitudes is false for NaN */
CGT_SPU_INLINE int cgt_spu_exact_is_outside(vec_float4 r)
{
    const float32x4_t largest = vreinterpretq_f32_u32(vdupq_n_u32(0x7f7fffff));
    return vminvq_u32(vcagtq_f32(largest, (float32x4_t)r)) == 0;
}

CGT_SPU_INLINE int cgt_spu_exact_is_unordered(vec_float4 a, vec_float4 b)
{
    const float32x4_t a4 = (float32x4_t)a, b4 = (float32x4_t)b;
    return vminvq_u32(vandq_u32(vceqq_f32(a4, a4), vceqq_f32(b4, b4))) == 0;
}

CGT_SPU_INLINE vec_float4 cgt_spu_exact_fused_madd(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return (vec_float4)vfmaq_f32((float32x4_t)c, (float32x4_t)a, (float32x4_t)b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_exact_fused_msub(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return (vec_float4)vfmaq_f32(vnegq_f32((float32x4_t)c), (float32x4_t)a, (float32x4_t)b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_exact_fused_nmsub(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return (vec_float4)vfmsq_f32((float32x4_t)c, (float32x4_t)a, (float32x4_t)b);
}

CGT_SPU_INLINE vec_float4 cgt_spu_exact_to_float_s32(vec_int4 a) { return (vec_float4)vcvtq_f32_s32((int32x4_t)a); }
CGT_SPU_INLINE vec_float4 cgt_spu_exact_to_float_u32(vec_uint4 a) { return (vec_float4)vcvtq_f32_u32((uint32x4_t)a); }

/* fcvtzs and fcvtzu saturate, but turn NaN into 0: an infinity of its sign saturates correctly. */
CGT_SPU_INLINE float32x4_t cgt_spu_exact_no_nan(vec_float4 p, vec_int4 sign)
{
    const uint32x4_t infinity = vdupq_n_u32(0x7f800000), is_number = vceqq_f32((float32x4_t)p, (float32x4_t)p);
    const uint32x4_t signed_infinity = vorrq_u32(infinity, vshlq_n_u32((uint32x4_t)sign, 31));
    return vbslq_f32(is_number, (float32x4_t)p, vreinterpretq_f32_u32(signed_infinity));
}
CGT_SPU_INLINE vec_int4 cgt_spu_exact_to_int(vec_float4 p, vec_int4 sign)
{
    vec_int4 r = (vec_int4)vcvtq_s32_f32(cgt_spu_exact_no_nan(p, sign));
    CGT_SPU_HOLD(r);
    return r;
}
CGT_SPU_INLINE vec_uint4 cgt_spu_exact_to_uint(vec_float4 p, vec_int4 sign)
{
    vec_uint4 r = (vec_uint4)vcvtq_u32_f32(cgt_spu_exact_no_nan(p, sign));
    CGT_SPU_HOLD(r);
    return r;
}

#endif
