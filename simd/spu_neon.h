/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The mapping to AArch64 NEON: the words for which one instruction exists that the compiler would not find by itself
 * from its own vectors. Little-endian, as every AArch64 host that we know runs. */
#ifndef CGT_SPU_NEON_H
#define CGT_SPU_NEON_H

#include <arm_neon.h>

#include "spu_types.h"

/* fused, as on the SPU */
#define CGT_SPU_OWN_MADD
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

/* fcvtzs saturates and takes NaN to 0, as the contract asks */
#define CGT_SPU_OWN_CONVTS
CGT_SPU_INLINE vec_int4 cgt_spu_convts_f32(vec_float4 a) { return (vec_int4)vcvtq_s32_f32((float32x4_t)a); }

#define CGT_SPU_OWN_MASK_BITS
CGT_SPU_INLINE unsigned cgt_spux_mask_bits_u32(vec_uint4 m)
{
    const uint32x4_t weight = {1, 2, 4, 8};
    return vaddvq_u32(vandq_u32((uint32x4_t)m, weight));
}
CGT_SPU_INLINE unsigned cgt_spux_mask_bits_u16(vec_ushort8 m)
{
    const uint16x8_t weight = {1, 2, 4, 8, 16, 32, 64, 128};
    return vaddvq_u16(vandq_u16((uint16x8_t)m, weight));
}

#define CGT_SPU_OWN_GATHER
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_u32(vec_uint4 a)
{
    const int32x4_t shift = {3, 2, 1, 0};
    const uint32x4_t bit = vshlq_u32(vandq_u32((uint32x4_t)a, vdupq_n_u32(1)), shift);
    return (vec_uint4){vaddvq_u32(bit), 0, 0, 0};
}

#define CGT_SPU_OWN_SQRT
CGT_SPU_INLINE vec_float4 cgt_spux_sqrt_f32(vec_float4 a) { return (vec_float4)vsqrtq_f32((float32x4_t)a); }

/* one table look-up of 32 bytes; an index beyond the table gives zero */
#define CGT_SPU_OWN_SHUFFLE
CGT_SPU_INLINE vec_ushort8 cgt_spu_shuffle_u16(vec_ushort8 a, vec_ushort8 b, vec_uchar16 pattern)
{
    const uint8x16_t c = vrev16q_u8((uint8x16_t)pattern);
    const uint8x16_t special = vcgeq_u8(c, vdupq_n_u8(0x80));
    const uint8x16_t index = vorrq_u8(veorq_u8(vandq_u8(c, vdupq_n_u8(31)), vdupq_n_u8(1)), special);
    const uint8x16_t ones = vandq_u8(vcgeq_u8(c, vdupq_n_u8(0xc0)), vcltq_u8(c, vdupq_n_u8(0xe0)));
    const uint8x16_t sign = vandq_u8(vcgeq_u8(c, vdupq_n_u8(0xe0)), vdupq_n_u8(0x80));
    const uint8x16x2_t table = {{(uint8x16_t)a, (uint8x16_t)b}};
    return (vec_ushort8)vorrq_u8(vqtbl2q_u8(table, index), vorrq_u8(ones, sign));
}

#include "spu_portable.h"

#endif
