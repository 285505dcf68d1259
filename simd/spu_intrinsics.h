/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The door to the spu_* vocabulary. On an SPU it is the compiler's own header; elsewhere a mapping gives the same
 * names, types, lane order and results. The words that libcgt's kernels speak are here:
 *
 *   spu_splats(x)           x in every element
 *   spu_extract(a, n)       element n
 *   spu_add, sub, mul       element by element
 *   spu_madd(a, b, c)       a * b + c     fused where the mapping has it (SPU, NEON)
 *   spu_msub(a, b, c)       a * b - c     likewise
 *   spu_nmsub(a, b, c)      c - a * b     likewise
 *   spu_cmpgt, cmpeq        all ones where true, else zero; false where a float is NaN
 *   spu_and, or, xor, andc  bits; andc is a & ~b
 *   spu_sel(a, b, m)        bits of b where m is one, else of a
 *   spu_convtf(a, n)        int to float, divided by 2^n, n from 0 to 127
 *   spu_convts(a, n)        float times 2^n to int, towards zero, saturated
 *   spu_gather(a)           lowest bits of the elements, element 0 highest, in element 0
 *   spu_shuffle(a, b, c)    bytes of a and b as the pattern c says, in the SPU's byte order on every host
 *
 * The mapping: CGT_SPU_PORTABLE forces plain C; else SSE4.1 or AArch64 NEON where the compiler is told that it may
 * use them; else plain C. */
#if defined(__SPU__)
#include_next <spu_intrinsics.h> /* before any guard: found beside a file that includes it, this one is next to itself */
#elif !defined(CGT_SPU_INTRINSICS_H)
#define CGT_SPU_INTRINSICS_H

#if defined(CGT_SPU_PORTABLE)
#include "spu_portable.h"
#elif defined(__SSE4_1__)
#include "spu_sse.h"
#elif defined(__aarch64__) && !defined(__AARCH64EB__)
#include "spu_neon.h"
#else
#include "spu_portable.h"
#endif
#include "spu_wide.h"

#define spu_splats(a)                                                                                                  \
    _Generic((a), float                                                                                                \
             : cgt_spu_splats_f32, int32_t                                                                             \
             : cgt_spu_splats_s32, uint32_t                                                                            \
             : cgt_spu_splats_u32, uint16_t                                                                            \
             : cgt_spu_splats_u16)(a)
#define spu_extract(a, n)                                                                                              \
    _Generic((a), vec_float4                                                                                           \
             : cgt_spu_extract_f32, vec_int4                                                                           \
             : cgt_spu_extract_s32, vec_uint4                                                                          \
             : cgt_spu_extract_u32, vec_ushort8                                                                        \
             : cgt_spu_extract_u16)(a, n)
/* until the door has them */
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpabsgt_f32(vec_float4 a, vec_float4 b)
{
    const vec_uint4 magnitude = {0x7fffffff, 0x7fffffff, 0x7fffffff, 0x7fffffff};
    return (vec_uint4)((vec_float4)((vec_uint4)a & magnitude) > (vec_float4)((vec_uint4)b & magnitude));
}
CGT_SPU_INLINE vec_uint4 cgt_spu_nor_u32(vec_uint4 a, vec_uint4 b) { return ~(a | b); }
CGT_SPU_INLINE vec_int4 cgt_spu_nor_s32(vec_int4 a, vec_int4 b) { return ~(a | b); }
CGT_SPU_INLINE vec_float4 cgt_spu_nor_f32(vec_float4 a, vec_float4 b)
{
    return (vec_float4)(~((vec_uint4)a | (vec_uint4)b));
}
CGT_SPU_INLINE vec_float4 cgt_spu_re_f32(vec_float4 a) { return 1.f / a; }
CGT_SPU_INLINE vec_float4 cgt_spu_rsqrte_f32(vec_float4 a)
{
    return (vec_float4){1.f / __builtin_sqrtf(__builtin_fabsf(a[0])), 1.f / __builtin_sqrtf(__builtin_fabsf(a[1])),
                        1.f / __builtin_sqrtf(__builtin_fabsf(a[2])), 1.f / __builtin_sqrtf(__builtin_fabsf(a[3]))};
}
/* clang-format off */
#define spu_add(a, b) _Generic((a), CGT_SPU_WIDE_FSU(add) vec_float4 : cgt_spu_add_f32, vec_int4 : cgt_spu_add_s32, vec_uint4 : cgt_spu_add_u32)(a, b)
#define spu_sub(a, b) _Generic((a), CGT_SPU_WIDE_FSU(sub) vec_float4 : cgt_spu_sub_f32, vec_int4 : cgt_spu_sub_s32, vec_uint4 : cgt_spu_sub_u32)(a, b)
#define spu_mul(a, b) _Generic((a), CGT_SPU_WIDE_F(mul) vec_float4 : cgt_spu_mul_f32)(a, b)
#define spu_cmpabsgt(a, b) _Generic((a), CGT_SPU_WIDE_F(cmpabsgt) vec_float4 : cgt_spu_cmpabsgt_f32)(a, b)
#define spu_madd(a, b, c) _Generic((a), CGT_SPU_WIDE_F(madd) vec_float4 : cgt_spu_madd_f32)(a, b, c)
#define spu_msub(a, b, c) _Generic((a), CGT_SPU_WIDE_F(msub) vec_float4 : cgt_spu_msub_f32)(a, b, c)
#define spu_nmsub(a, b, c) _Generic((a), CGT_SPU_WIDE_F(nmsub) vec_float4 : cgt_spu_nmsub_f32)(a, b, c)
#define spu_re(a) _Generic((a), CGT_SPU_WIDE_F(re) vec_float4 : cgt_spu_re_f32)(a)
#define spu_rsqrte(a) _Generic((a), CGT_SPU_WIDE_F(rsqrte) vec_float4 : cgt_spu_rsqrte_f32)(a)
#define spu_cmpgt(a, b) _Generic((a), CGT_SPU_WIDE_FSU(cmpgt) vec_float4 : cgt_spu_cmpgt_f32, vec_int4 : cgt_spu_cmpgt_s32, vec_uint4 : cgt_spu_cmpgt_u32)(a, b)
#define spu_cmpeq(a, b) _Generic((a), CGT_SPU_WIDE_FSU(cmpeq) vec_float4 : cgt_spu_cmpeq_f32, vec_int4 : cgt_spu_cmpeq_s32, vec_uint4 : cgt_spu_cmpeq_u32, vec_ushort8 : cgt_spu_cmpeq_u16)(a, b)
#define spu_and(a, b) _Generic((a), CGT_SPU_WIDE_FSUM(and) vec_float4 : cgt_spu_and_f32, vec_int4 : cgt_spu_and_s32, vec_uint4 : cgt_spu_and_u32, vec_ushort8 : cgt_spu_and_u16)(a, b)
#define spu_or(a, b) _Generic((a), CGT_SPU_WIDE_FSUM(or) vec_float4 : cgt_spu_or_f32, vec_int4 : cgt_spu_or_s32, vec_uint4 : cgt_spu_or_u32)(a, b)
#define spu_xor(a, b) _Generic((a), CGT_SPU_WIDE_FSUM(xor) vec_float4 : cgt_spu_xor_f32, vec_int4 : cgt_spu_xor_s32, vec_uint4 : cgt_spu_xor_u32)(a, b)
#define spu_andc(a, b) _Generic((a), CGT_SPU_WIDE_FSUM(andc) vec_float4 : cgt_spu_andc_f32, vec_int4 : cgt_spu_andc_s32, vec_uint4 : cgt_spu_andc_u32)(a, b)
#define spu_nor(a, b) _Generic((a), CGT_SPU_WIDE_FSUM(nor) vec_float4 : cgt_spu_nor_f32, vec_int4 : cgt_spu_nor_s32, vec_uint4 : cgt_spu_nor_u32)(a, b)
#define spu_sel(a, b, m) _Generic((a), CGT_SPU_WIDE_FSU(sel) vec_float4 : cgt_spu_sel_f32, vec_int4 : cgt_spu_sel_s32, vec_uint4 : cgt_spu_sel_u32)(a, b, m)
/* the scale is a power of two, so that the product is exact unless it leaves the range */
CGT_SPU_INLINE vec_float4 cgt_spu_convtf_s32_scaled(vec_int4 a, int n)
{
    return cgt_spu_convtf_s32(a) * cgt_spu_splats_f32(__builtin_ldexpf(1.f, -n));
}
CGT_SPU_INLINE vec_float4 cgt_spu_convtf_u32_scaled(vec_uint4 a, int n)
{
    return __builtin_convertvector(a, vec_float4) * cgt_spu_splats_f32(__builtin_ldexpf(1.f, -n));
}
CGT_SPU_INLINE vec_int4 cgt_spu_convts_f32_scaled(vec_float4 a, int n)
{
    return cgt_spu_convts_f32(a * cgt_spu_splats_f32(__builtin_ldexpf(1.f, n)));
}
#define spu_convtf(a, n) _Generic((a), CGT_SPU_WIDE_SU(convtf) vec_int4 : cgt_spu_convtf_s32_scaled, vec_uint4 : cgt_spu_convtf_u32_scaled)(a, n)
#define spu_convts(a, n) _Generic((a), CGT_SPU_WIDE_F(convts) vec_float4 : cgt_spu_convts_f32_scaled)(a, n)
/* clang-format on */
#define spu_gather(a) cgt_spu_gather_u32(a)
#define spu_shuffle(a, b, c) cgt_spu_shuffle_u16(a, b, c)

#endif
