/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The mapping to WebAssembly's vectors of 128 bits: the words for which an instruction exists that the compiler does
 * not find from its own vectors. There is no estimate and no product that rounds once: those are as in plain C. */
#ifndef CGT_SPU_WASM_H
#define CGT_SPU_WASM_H

#include <wasm_simd128.h>

#include "spu_types.h"

/* ---- floating point ---- */

#define CGT_SPU_OWN_ESTIMATE
#ifndef CGT_SPU_OWN_FLOAT
CGT_SPU_INLINE vec_float4 cgt_spu_re_f32(vec_float4 a) { return 1.f / a; }
CGT_SPU_INLINE vec_float4 cgt_spu_rsqrte_f32(vec_float4 a) /* of the magnitude, as on an SPU */
{
    return 1.f / (vec_float4)wasm_f32x4_sqrt(wasm_f32x4_abs((v128_t)a));
}
#endif

/* trunc_sat saturates and turns NaN into 0, as the contract requires */
#define CGT_SPU_OWN_CONVTS
CGT_SPU_INLINE vec_int4 cgt_spu_to_int_f32(vec_float4 a) { return (vec_int4)wasm_i32x4_trunc_sat_f32x4((v128_t)a); }
CGT_SPU_INLINE vec_uint4 cgt_spu_to_uint_f32(vec_float4 a) { return (vec_uint4)wasm_u32x4_trunc_sat_f32x4((v128_t)a); }

#define CGT_SPU_OWN_ROUNDTF
CGT_SPU_INLINE vec_float4 cgt_spu_roundtf_f64(vec_double2 a)
{
    const v128_t b = wasm_f32x4_demote_f64x2_zero((v128_t)a);
    return (vec_float4)wasm_i32x4_shuffle(b, b, 0, 2, 1, 3);
}

/* ---- integers ---- */

/* Products of halfwords: dot multiplies pairs and adds; with one of each pair zero it is a single product. Unsigned
 * ones are products of words. */
#define CGT_SPU_OWN_MULTIPLY
CGT_SPU_INLINE vec_int4 cgt_spu_mulo_s16(vec_short8 a, vec_short8 b)
{
    return (vec_int4)wasm_i32x4_dot_i16x8((v128_t)a, (v128_t)((vec_uint4)b & 0xffff0000u));
}
CGT_SPU_INLINE vec_int4 cgt_spu_mule_s16(vec_short8 a, vec_short8 b)
{
    return (vec_int4)wasm_i32x4_dot_i16x8((v128_t)a, (v128_t)((vec_uint4)b & 0x0000ffffu));
}
CGT_SPU_INLINE vec_uint4 cgt_spu_mulo_u16(vec_ushort8 a, vec_ushort8 b)
{
    return ((vec_uint4)a >> 16) * ((vec_uint4)b >> 16);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_mule_u16(vec_ushort8 a, vec_ushort8 b)
{
    return ((vec_uint4)a & 0xffff) * ((vec_uint4)b & 0xffff);
}
/* only the low half of the product remains, in the odd halfword, where the even halfword of a goes */
CGT_SPU_INLINE vec_int4 cgt_spu_mulh_s16(vec_short8 a, vec_short8 b)
{
    return (vec_int4)wasm_i16x8_mul((v128_t)((vec_uint4)a << 16), (v128_t)b);
}
CGT_SPU_INLINE vec_int4 cgt_spu_mulsr_s16(vec_short8 a, vec_short8 b) { return cgt_spu_mulo_s16(a, b) >> 16; }

#define CGT_SPU_OWN_EXTEND
CGT_SPU_INLINE vec_short8 cgt_spu_extend_s8(vec_char16 a) { return (vec_short8)a >> 8; }
CGT_SPU_INLINE vec_int4 cgt_spu_extend_s16(vec_short8 a) { return (vec_int4)a >> 16; }
CGT_SPU_INLINE vec_llong2 cgt_spu_extend_s32(vec_int4 a) { return (vec_llong2)a >> 32; }

/* ---- bytes and bits ---- */

#define CGT_SPU_OWN_BYTE
CGT_SPU_INLINE vec_uchar16 cgt_spu_absd_u8(vec_uchar16 a, vec_uchar16 b)
{
    return (vec_uchar16)wasm_v128_or(wasm_u8x16_sub_sat((v128_t)a, (v128_t)b),
                                     wasm_u8x16_sub_sat((v128_t)b, (v128_t)a));
}
CGT_SPU_INLINE vec_uchar16 cgt_spu_avg_u8(vec_uchar16 a, vec_uchar16 b)
{
    return (vec_uchar16)wasm_u8x16_avgr((v128_t)a, (v128_t)b);
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_sumb_u8(vec_uchar16 a, vec_uchar16 b)
{
    const v128_t x = wasm_u32x4_extadd_pairwise_u16x8(wasm_u16x8_extadd_pairwise_u8x16((v128_t)a));
    const v128_t y = wasm_u32x4_extadd_pairwise_u16x8(wasm_u16x8_extadd_pairwise_u8x16((v128_t)b));
    return (vec_ushort8)wasm_v128_or(y, wasm_i32x4_shl(x, 16));
}
CGT_SPU_INLINE vec_uchar16 cgt_spu_cntb_u8(vec_uchar16 a) { return (vec_uchar16)wasm_i8x16_popcnt((v128_t)a); }

/* bitmask puts element 0 lowest: the elements are reversed, their lowest bits moved to the top */
#define CGT_SPU_OWN_GATHER
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_u32(vec_uint4 a)
{
    const v128_t reversed = wasm_i32x4_shuffle((v128_t)a, (v128_t)a, 3, 2, 1, 0);
    return (vec_uint4){(unsigned)wasm_i32x4_bitmask(wasm_i32x4_shl(reversed, 31)), 0, 0, 0};
}
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_u16(vec_ushort8 a)
{
    const v128_t reversed = wasm_i16x8_shuffle((v128_t)a, (v128_t)a, 7, 6, 5, 4, 3, 2, 1, 0);
    return (vec_uint4){(unsigned)wasm_i16x8_bitmask(wasm_i16x8_shl(reversed, 15)), 0, 0, 0};
}
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_u8(vec_uchar16 a)
{
    const v128_t reversed =
        wasm_i8x16_shuffle((v128_t)a, (v128_t)a, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    return (vec_uint4){(unsigned)wasm_i8x16_bitmask(wasm_i8x16_shl(reversed, 7)), 0, 0, 0};
}

/* two table look-ups of 16 bytes; an index beyond the table gives zero */
#define CGT_SPU_OWN_SHUFFLE
CGT_SPU_INLINE vec_uchar16 cgt_wasm_bytes(vec_uchar16 a, vec_uchar16 index)
{
    return (vec_uchar16)wasm_i8x16_swizzle((v128_t)a, (v128_t)index);
}
CGT_SPU_INLINE vec_uchar16 cgt_spu_shuffle_bytes(vec_uchar16 a, vec_uchar16 b, vec_uchar16 pattern, unsigned flip)
{
    const vec_uchar16 iota = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const vec_uchar16 c = flip ? cgt_wasm_bytes(pattern, iota ^ (unsigned char)flip) : pattern;
    const vec_uchar16 special = (vec_uchar16)(c > 0x7f), index = ((c & 31) ^ (unsigned char)flip) | special;
    const vec_uchar16 family = c & 0xe0;
    const vec_uchar16 constant = (vec_uchar16)(family == 0xc0) | ((vec_uchar16)(family == 0xe0) & 0x80);
    return cgt_wasm_bytes(a, index) | cgt_wasm_bytes(b, index ^ 16) | constant;
}

/* ---- shifts by one count for all elements; the instructions take it modulo the width ---- */

#define CGT_SPU_OWN_SHIFT_X
#define CGT_SPU_X(type, vec, width, shl, shr, shr_signed)                                                              \
    CGT_SPU_INLINE vec cgt_spu_left_##type##_x(vec a, unsigned n)                                                      \
    {                                                                                                                  \
        return n < width ? (vec)shl((v128_t)a, n) : a ^ a;                                                             \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_right_##type##_x(vec a, unsigned n)                                                     \
    {                                                                                                                  \
        return n < width ? (vec)shr((v128_t)a, n) : a ^ a;                                                             \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_right_signed_##type##_x(vec a, unsigned n)                                              \
    {                                                                                                                  \
        return (vec)shr_signed((v128_t)a, n < width ? n : width - 1);                                                  \
    }
CGT_SPU_X(u16, vec_ushort8, 16, wasm_i16x8_shl, wasm_u16x8_shr, wasm_i16x8_shr)
CGT_SPU_X(u32, vec_uint4, 32, wasm_i32x4_shl, wasm_u32x4_shr, wasm_i32x4_shr)
#undef CGT_SPU_X

#include "spu_portable.h"

#endif
