/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact words on any host: every element through the integer model. A part of spu_exact.h. */
#ifndef CGT_SPU_EXACT_PORTABLE_H
#define CGT_SPU_EXACT_PORTABLE_H

CGT_SPU_INLINE vec_float4 cgt_spu_add_f32(vec_float4 a, vec_float4 b)
{
    return (vec_float4)cgt_spu_exact_each2(cgt_spu_model_add, (vec_uint4)a, (vec_uint4)b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_sub_f32(vec_float4 a, vec_float4 b)
{
    return (vec_float4)cgt_spu_exact_each2(cgt_spu_model_sub, (vec_uint4)a, (vec_uint4)b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_mul_f32(vec_float4 a, vec_float4 b)
{
    return (vec_float4)cgt_spu_exact_each2(cgt_spu_model_mul, (vec_uint4)a, (vec_uint4)b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_madd_f32(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return (vec_float4)cgt_spu_exact_each3(cgt_spu_model_madd, (vec_uint4)a, (vec_uint4)b, (vec_uint4)c);
}
CGT_SPU_INLINE vec_float4 cgt_spu_msub_f32(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return (vec_float4)cgt_spu_exact_each3(cgt_spu_model_msub, (vec_uint4)a, (vec_uint4)b, (vec_uint4)c);
}
CGT_SPU_INLINE vec_float4 cgt_spu_nmsub_f32(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return (vec_float4)cgt_spu_exact_each3(cgt_spu_model_nmsub, (vec_uint4)a, (vec_uint4)b, (vec_uint4)c);
}

CGT_SPU_INLINE vec_uint4 cgt_spu_cmpgt_f32(vec_float4 a, vec_float4 b)
{
    return cgt_spu_exact_each2(cgt_spu_model_cmpgt, (vec_uint4)a, (vec_uint4)b);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpeq_f32(vec_float4 a, vec_float4 b)
{
    return cgt_spu_exact_each2(cgt_spu_model_cmpeq, (vec_uint4)a, (vec_uint4)b);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpabsgt_f32(vec_float4 a, vec_float4 b)
{
    return cgt_spu_exact_each2(cgt_spu_model_cmpabsgt, (vec_uint4)a, (vec_uint4)b);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpabseq_f32(vec_float4 a, vec_float4 b)
{
    return cgt_spu_exact_each2(cgt_spu_model_cmpabseq, (vec_uint4)a, (vec_uint4)b);
}

CGT_SPU_INLINE vec_float4 cgt_spu_convtf_s32(vec_int4 a, int n)
{
    return (vec_float4)cgt_spu_exact_each_scaled(cgt_spu_model_convtf_s32, (vec_uint4)a, n);
}
CGT_SPU_INLINE vec_float4 cgt_spu_convtf_u32(vec_uint4 a, int n)
{
    return (vec_float4)cgt_spu_exact_each_scaled(cgt_spu_model_convtf_u32, a, n);
}
CGT_SPU_INLINE vec_int4 cgt_spu_convts_f32(vec_float4 a, int n)
{
    return (vec_int4)cgt_spu_exact_each_scaled(cgt_spu_model_convts, (vec_uint4)a, n);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_convtu_f32(vec_float4 a, int n)
{
    return cgt_spu_exact_each_scaled(cgt_spu_model_convtu, (vec_uint4)a, n);
}

CGT_SPU_INLINE vec_float4 cgt_spu_frest_f32(vec_float4 a)
{
    return (vec_float4)cgt_spu_exact_each1(cgt_spu_model_frest, (vec_uint4)a);
}
CGT_SPU_INLINE vec_float4 cgt_spu_frsqest_f32(vec_float4 a)
{
    return (vec_float4)cgt_spu_exact_each1(cgt_spu_model_frsqest, (vec_uint4)a);
}
CGT_SPU_INLINE vec_float4 cgt_spu_fi_f32(vec_float4 a, vec_float4 b)
{
    return (vec_float4)cgt_spu_exact_each2(cgt_spu_model_fi, (vec_uint4)a, (vec_uint4)b);
}

#endif
