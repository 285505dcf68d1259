/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The mapping to AArch64 NEON: the words for which an instruction exists that the compiler does not find from its own
 * vectors. Little-endian, as are all known AArch64 hosts. */
#ifndef CGT_SPU_NEON_H
#define CGT_SPU_NEON_H

#include <arm_neon.h>

#include "spu_types.h"

/* ---- floating point ---- */

/* fused, as on the SPU */
#define CGT_SPU_OWN_MADD
#define CGT_SPU_FUSED 1
#define CGT_SPU_FUSED_DOUBLE 1
#ifndef CGT_SPU_OWN_FLOAT
CGT_SPU_INLINE vec_float4 cgt_spu_madd_f32(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return (vec_float4)vfmaq_f32((float32x4_t)c, (float32x4_t)a, (float32x4_t)b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_msub_f32(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return (vec_float4)vfmaq_f32(vnegq_f32((float32x4_t)c), (float32x4_t)a, (float32x4_t)b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_nmsub_f32(vec_float4 a, vec_float4 b, vec_float4 c)
{
    return (vec_float4)vfmsq_f32((float32x4_t)c, (float32x4_t)a, (float32x4_t)b);
}
#endif
CGT_SPU_INLINE vec_double2 cgt_spu_madd_f64(vec_double2 a, vec_double2 b, vec_double2 c)
{
    return (vec_double2)vfmaq_f64((float64x2_t)c, (float64x2_t)a, (float64x2_t)b);
}
CGT_SPU_INLINE vec_double2 cgt_spu_msub_f64(vec_double2 a, vec_double2 b, vec_double2 c)
{
    return (vec_double2)vfmaq_f64(vnegq_f64((float64x2_t)c), (float64x2_t)a, (float64x2_t)b);
}
/* rounded, then negated, as the SPU's doubles are */
CGT_SPU_INLINE vec_double2 cgt_spu_nmsub_f64(vec_double2 a, vec_double2 b, vec_double2 c)
{
    return -cgt_spu_msub_f64(a, b, c);
}
CGT_SPU_INLINE vec_double2 cgt_spu_nmadd_f64(vec_double2 a, vec_double2 b, vec_double2 c)
{
    return -cgt_spu_madd_f64(a, b, c);
}

/* estimates: eight bits from the table, sixteen after one step */
#define CGT_SPU_OWN_ESTIMATE
#ifndef CGT_SPU_OWN_FLOAT
CGT_SPU_INLINE vec_float4 cgt_spu_re_f32(vec_float4 a)
{
    const float32x4_t x = vrecpeq_f32((float32x4_t)a);
    return (vec_float4)vmulq_f32(x, vrecpsq_f32((float32x4_t)a, x));
}
CGT_SPU_INLINE vec_float4 cgt_spu_rsqrte_f32(vec_float4 a)
{
    const float32x4_t m = vabsq_f32((float32x4_t)a), x = vrsqrteq_f32(m); /* of the magnitude, as on an SPU */
    return (vec_float4)vmulq_f32(x, vrsqrtsq_f32(vmulq_f32(m, x), x));
}
#endif

/* fcvtzs and fcvtzu saturate and turn NaN into 0, as the contract requires */
#define CGT_SPU_OWN_CONVTS
CGT_SPU_INLINE vec_int4 cgt_spu_to_int_f32(vec_float4 a) { return (vec_int4)vcvtq_s32_f32((float32x4_t)a); }
CGT_SPU_INLINE vec_uint4 cgt_spu_to_uint_f32(vec_float4 a) { return (vec_uint4)vcvtq_u32_f32((float32x4_t)a); }

/* ---- integers: the even halfword is the lower half of its word, the odd one the upper half ---- */

#define CGT_SPU_OWN_MULTIPLY
CGT_SPU_INLINE vec_int4 cgt_spu_mulo_s16(vec_short8 a, vec_short8 b)
{
    const int16x8_t x = (int16x8_t)a, y = (int16x8_t)b;
    return (vec_int4)vmull_s16(vget_low_s16(vuzp2q_s16(x, x)), vget_low_s16(vuzp2q_s16(y, y)));
}
CGT_SPU_INLINE vec_int4 cgt_spu_mulsr_s16(vec_short8 a, vec_short8 b) { return cgt_spu_mulo_s16(a, b) >> 16; }
CGT_SPU_INLINE vec_int4 cgt_spu_mule_s16(vec_short8 a, vec_short8 b)
{
    return (vec_int4)vmull_s16(vmovn_s32((int32x4_t)a), vmovn_s32((int32x4_t)b));
}
CGT_SPU_INLINE vec_uint4 cgt_spu_mulo_u16(vec_ushort8 a, vec_ushort8 b)
{
    const uint16x8_t x = (uint16x8_t)a, y = (uint16x8_t)b;
    return (vec_uint4)vmull_u16(vget_low_u16(vuzp2q_u16(x, x)), vget_low_u16(vuzp2q_u16(y, y)));
}
CGT_SPU_INLINE vec_uint4 cgt_spu_mule_u16(vec_ushort8 a, vec_ushort8 b)
{
    return (vec_uint4)vmull_u16(vmovn_u32((uint32x4_t)a), vmovn_u32((uint32x4_t)b));
}
CGT_SPU_INLINE vec_int4 cgt_spu_mulh_s16(vec_short8 a, vec_short8 b)
{
    return (vec_int4)((vec_uint4)(a * (vec_short8)((vec_uint4)b >> 16)) << 16);
}

#define CGT_SPU_OWN_EXTEND
CGT_SPU_INLINE vec_short8 cgt_spu_extend_s8(vec_char16 a) { return (vec_short8)a >> 8; }
CGT_SPU_INLINE vec_int4 cgt_spu_extend_s16(vec_short8 a) { return (vec_int4)a >> 16; }
CGT_SPU_INLINE vec_llong2 cgt_spu_extend_s32(vec_int4 a) { return (vec_llong2)a >> 32; }

/* ---- bytes and bits ---- */

#define CGT_SPU_OWN_BYTE
CGT_SPU_INLINE vec_uchar16 cgt_spu_absd_u8(vec_uchar16 a, vec_uchar16 b)
{
    return (vec_uchar16)vabdq_u8((uint8x16_t)a, (uint8x16_t)b);
}
CGT_SPU_INLINE vec_uchar16 cgt_spu_avg_u8(vec_uchar16 a, vec_uchar16 b)
{
    return (vec_uchar16)vrhaddq_u8((uint8x16_t)a, (uint8x16_t)b);
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_sumb_u8(vec_uchar16 a, vec_uchar16 b)
{
    const uint32x4_t x = vpaddlq_u16(vpaddlq_u8((uint8x16_t)a)), y = vpaddlq_u16(vpaddlq_u8((uint8x16_t)b));
    return (vec_ushort8)vsliq_n_u32(y, x, 16);
}
CGT_SPU_INLINE vec_uchar16 cgt_spu_cntb_u8(vec_uchar16 a) { return (vec_uchar16)vcntq_u8((uint8x16_t)a); }

#define CGT_SPU_OWN_CNTLZ
CGT_SPU_INLINE vec_uint4 cgt_spu_cntlz_u32(vec_uint4 a) { return (vec_uint4)vclzq_u32((uint32x4_t)a); }

#define CGT_SPU_OWN_GATHER
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_u32(vec_uint4 a)
{
    const int32x4_t shift = {3, 2, 1, 0};
    const uint32x4_t bit = vshlq_u32(vandq_u32((uint32x4_t)a, vdupq_n_u32(1)), shift);
    return (vec_uint4){vaddvq_u32(bit), 0, 0, 0};
}
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_u16(vec_ushort8 a)
{
    const int16x8_t shift = {7, 6, 5, 4, 3, 2, 1, 0};
    const uint16x8_t bit = vshlq_u16(vandq_u16((uint16x8_t)a, vdupq_n_u16(1)), shift);
    return (vec_uint4){vaddvq_u16(bit), 0, 0, 0};
}
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_u8(vec_uchar16 a)
{
    const int8x16_t shift = {7, 6, 5, 4, 3, 2, 1, 0, 7, 6, 5, 4, 3, 2, 1, 0};
    const uint8x16_t bit = vshlq_u8(vandq_u8((uint8x16_t)a, vdupq_n_u8(1)), shift);
    return (vec_uint4){(unsigned)vaddv_u8(vget_low_u8(bit)) << 8 | vaddv_u8(vget_high_u8(bit)), 0, 0, 0};
}

/* one table look-up of 32 bytes; an index beyond the table gives zero */
#define CGT_SPU_OWN_SHUFFLE
CGT_SPU_INLINE vec_uchar16 cgt_spu_shuffle_bytes(vec_uchar16 a, vec_uchar16 b, vec_uchar16 pattern, unsigned flip)
{
    const vec_uchar16 iota = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
#if defined(__clang__)
    const vec_uchar16 c =
        flip ? (vec_uchar16)vqtbl1q_u8((uint8x16_t)pattern, (uint8x16_t)(iota ^ (unsigned char)flip)) : pattern;
#else
    const vec_uchar16 c = flip ? __builtin_shuffle(pattern, iota ^ (unsigned char)flip) : pattern;
    /* a constant pattern without constant bytes: the compiler knows the best instructions */
    const unsigned long long special_bytes = (((vec_ullong2)c)[0] | ((vec_ullong2)c)[1]) & 0x8080808080808080u;
    if (__builtin_constant_p(special_bytes) && !special_bytes)
        return __builtin_shuffle(a, b, (c & 31) ^ (unsigned char)flip);
#endif
    const vec_uchar16 special = (vec_uchar16)(c > 0x7f), index = ((c & 31) ^ (unsigned char)flip) | special;
    const vec_uchar16 family = c & 0xe0;
    const vec_uchar16 constant = (vec_uchar16)(family == 0xc0) | ((vec_uchar16)(family == 0xe0) & 0x80);
    const uint8x16x2_t table = {{(uint8x16_t)a, (uint8x16_t)b}};
    return (vec_uchar16)vqtbl2q_u8(table, (uint8x16_t)index) | constant;
}

/* ---- shifts: one instruction shifts both ways, by the lowest byte of each count, signed; from the width on it
 * leaves zeros or sign bits ---- */

#define CGT_SPU_OWN_SHIFT
#define CGT_SPU_X(type, stype, vec, uvec, svec)                                                                        \
    CGT_SPU_INLINE vec cgt_spu_left_##type(vec a, vec n) { return (vec)vshlq_##type((uvec)a, (svec)n); }               \
    CGT_SPU_INLINE vec cgt_spu_right_##type(vec a, vec n) { return (vec)vshlq_##type((uvec)a, (svec)(-n)); }           \
    CGT_SPU_INLINE vec cgt_spu_right_signed_##type(vec a, vec n) { return (vec)vshlq_##stype((svec)a, (svec)(-n)); }
CGT_SPU_X(u16, s16, vec_ushort8, uint16x8_t, int16x8_t)
CGT_SPU_X(u32, s32, vec_uint4, uint32x4_t, int32x4_t)
#undef CGT_SPU_X
#define CGT_SPU_X(type, vec, element)                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_left_##type##_x(vec a, unsigned n)                                                      \
    {                                                                                                                  \
        return cgt_spu_left_##type(a, (vec)vdupq_n_##type((element)n));                                                \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_right_##type##_x(vec a, unsigned n)                                                     \
    {                                                                                                                  \
        return cgt_spu_right_##type(a, (vec)vdupq_n_##type((element)n));                                               \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_right_signed_##type##_x(vec a, unsigned n)                                              \
    {                                                                                                                  \
        return cgt_spu_right_signed_##type(a, (vec)vdupq_n_##type((element)n));                                        \
    }
CGT_SPU_X(u16, vec_ushort8, unsigned short)
CGT_SPU_X(u32, vec_uint4, unsigned)
#undef CGT_SPU_X

/* ---- the quadword ---- */

/* Byte p of the SPU's quadword lies at p ^ flip: positions are converted before and after. An index beyond
 * 15 gives zero. */
#define CGT_SPU_OWN_QUAD
CGT_SPU_INLINE vec_ullong2 cgt_neon_bytes(vec_ullong2 a, vec_uchar16 index)
{
#if !defined(__clang__)
    /* a constant rotation: the compiler knows the best instruction */
    const unsigned long long outside = (((vec_ullong2)index)[0] | ((vec_ullong2)index)[1]) & 0xf0f0f0f0f0f0f0f0u;
    if (__builtin_constant_p(outside) && !outside)
        return (vec_ullong2)__builtin_shuffle((vec_uchar16)a, index);
#endif
    return (vec_ullong2)vqtbl1q_u8((uint8x16_t)a, (uint8x16_t)index);
}
CGT_SPU_INLINE vec_uchar16 cgt_neon_flip(vec_uchar16 positions, unsigned size)
{
    return positions ^ (unsigned char)(size - 1);
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_left_bytes(vec_ullong2 a, unsigned n, unsigned size)
{
    const vec_uchar16 iota = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return cgt_neon_bytes(a, cgt_neon_flip(cgt_neon_flip(iota, size) + (unsigned char)n, size));
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_right_bytes(vec_ullong2 a, unsigned n, unsigned size)
{
    return cgt_spu_quad_left_bytes(a, -n, size);
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_rotate_bytes(vec_ullong2 a, unsigned n, unsigned size)
{
    const vec_uchar16 iota = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return cgt_neon_bytes(a, cgt_neon_flip((cgt_neon_flip(iota, size) + (unsigned char)n) & 15, size));
}

/* By bits: in words of 64 bits, highest first. A shift by 64 gives zero. */
CGT_SPU_INLINE uint64x2_t cgt_neon_reorder(uint64x2_t a, unsigned size)
{
    const vec_uchar16 iota = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return size == 8 ? a : (uint64x2_t)cgt_neon_bytes((vec_ullong2)a, iota ^ (unsigned char)(8 - size));
}
CGT_SPU_INLINE uint64x2_t cgt_neon_shift(uint64x2_t a, int n) { return vshlq_u64(a, vdupq_n_s64(n)); }
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_left_bits(vec_ullong2 a, unsigned n, unsigned size)
{
    const uint64x2_t x = cgt_neon_reorder((uint64x2_t)a, size), low = vextq_u64(x, vdupq_n_u64(0), 1);
    const uint64x2_t d = vorrq_u64(cgt_neon_shift(x, (int)n), cgt_neon_shift(low, (int)n - 64));
    return (vec_ullong2)cgt_neon_reorder(d, size);
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_right_bits(vec_ullong2 a, unsigned n, unsigned size)
{
    const uint64x2_t x = cgt_neon_reorder((uint64x2_t)a, size), high = vextq_u64(vdupq_n_u64(0), x, 1);
    const uint64x2_t d = vorrq_u64(cgt_neon_shift(x, -(int)n), cgt_neon_shift(high, 64 - (int)n));
    return (vec_ullong2)cgt_neon_reorder(d, size);
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_rotate_bits(vec_ullong2 a, unsigned n, unsigned size)
{
    const uint64x2_t x = cgt_neon_reorder((uint64x2_t)a, size), other = vextq_u64(x, x, 1);
    const uint64x2_t d = vorrq_u64(cgt_neon_shift(x, (int)n), cgt_neon_shift(other, (int)n - 64));
    return (vec_ullong2)cgt_neon_reorder(d, size);
}

#include "spu_portable.h"

#endif
