/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Words of vector.h on four lanes for which AArch64 NEON has an instruction. fmin and fmax are not used: they do not
 * return b where a and b are unordered. */
#ifndef CGT_SPUX_NEON_H
#define CGT_SPUX_NEON_H

#include <arm_neon.h>

#define CGT_SPUX_OWN_MASK_BITS
CGT_SPU_INLINE unsigned spux_mask_bits(vmask m)
{
    const uint32x4_t weight = {1, 2, 4, 8};
    return vaddvq_u32(vandq_u32((uint32x4_t)m, weight));
}

#define CGT_SPUX_OWN_SQRT
CGT_SPU_INLINE vfloat spux_sqrt(vfloat a) { return (vfloat)vsqrtq_f32((float32x4_t)a); }
CGT_SPU_INLINE vfloat spux_rsqrte(vfloat a)
{
    const float32x4_t x = vrsqrteq_f32((float32x4_t)a);
    return (vfloat)vmulq_f32(x, vrsqrtsq_f32(vmulq_f32((float32x4_t)a, x), x));
}

#define CGT_SPUX_OWN_TRUNCATE
CGT_SPU_INLINE vint spux_truncate(vfloat a) { return (vint)vcvtq_s32_f32((float32x4_t)a); }

/* Bytes 4n to 4n + 3 for each lane number n. */
#define CGT_SPUX_OWN_PERMUTE
CGT_SPU_INLINE vuint cgt_spux_permute_w(vuint a, vuint index)
{
    const uint32x4_t lane = vandq_u32((uint32x4_t)index, vdupq_n_u32(3));
    const uint32x4_t bytes = vmlaq_n_u32(vdupq_n_u32(0x03020100), lane, 0x04040404);
    return (vuint)vqtbl1q_u8((uint8x16_t)a, vreinterpretq_u8_u32(bytes));
}

/* four bits a halfword */
#define CGT_SPUX_OWN_FIND16
CGT_SPU_INLINE uint32_t spux_find16(const uint16_t *p, uint16_t x)
{
    const uint16x8_t wanted = vdupq_n_u16(x), front = vceqq_u16(vld1q_u16(p), wanted),
                     back = vceqq_u16(vld1q_u16(p + 8), wanted);
    const uint8x16_t bytes = vcombine_u8(vmovn_u16(front), vmovn_u16(back));
    const uint64_t bits = vget_lane_u64(vreinterpret_u64_u8(vshrn_n_u16(vreinterpretq_u16_u8(bytes), 4)), 0);
    return bits ? (uint32_t)__builtin_ctzll(bits) / 4 : 16;
}

#define CGT_SPUX_OWN_TRANSPOSE
CGT_SPU_INLINE void cgt_spux_transpose4_w(const vfloat r[4], vfloat d[4])
{
    const float32x4x2_t a = vtrnq_f32((float32x4_t)r[0], (float32x4_t)r[1]);
    const float32x4x2_t b = vtrnq_f32((float32x4_t)r[2], (float32x4_t)r[3]);
    for (int j = 0; j < 2; j++) {
        d[j] = (vfloat)vcombine_f32(vget_low_f32(a.val[j]), vget_low_f32(b.val[j]));
        d[2 + j] = (vfloat)vcombine_f32(vget_high_f32(a.val[j]), vget_high_f32(b.val[j]));
    }
}

#endif
