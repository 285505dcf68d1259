/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Words of vector.h on four lanes for which WebAssembly has an instruction. */
#ifndef CGT_SPUX_WASM_H
#define CGT_SPUX_WASM_H

#include <wasm_simd128.h>

#include "spux_packed.h"

#define CGT_SPUX_OWN_MASK_BITS
CGT_SPU_INLINE unsigned spux_mask_bits(vmask m) { return (unsigned)wasm_i32x4_bitmask((v128_t)m); }

#define CGT_SPUX_OWN_MASK_FROM_BITS
CGT_SPU_INLINE vmask spux_mask_from_bits(unsigned bits)
{
    const vuint bit = {1, 2, 4, 8};
    return (vmask)(((vuint)wasm_i32x4_splat((int32_t)bits) & bit) == bit);
}

#define CGT_SPUX_OWN_ANY_ALL
CGT_SPU_INLINE bool spux_any(vmask m) { return wasm_v128_any_true((v128_t)m); }
CGT_SPU_INLINE bool spux_all(vmask m) { return wasm_i32x4_all_true((v128_t)m); }

/* pmin(b, a) is a < b ? a : b; f32x4.min would return NaN where one is NaN */
#define CGT_SPUX_OWN_MIN_MAX
CGT_SPU_INLINE vfloat cgt_spux_min_f32w(vfloat a, vfloat b) { return (vfloat)wasm_f32x4_pmin((v128_t)b, (v128_t)a); }
CGT_SPU_INLINE vfloat cgt_spux_max_f32w(vfloat a, vfloat b) { return (vfloat)wasm_f32x4_pmax((v128_t)b, (v128_t)a); }
CGT_SPU_INLINE vint cgt_spux_min_s32w(vint a, vint b) { return (vint)wasm_i32x4_min((v128_t)a, (v128_t)b); }
CGT_SPU_INLINE vint cgt_spux_max_s32w(vint a, vint b) { return (vint)wasm_i32x4_max((v128_t)a, (v128_t)b); }
CGT_SPU_INLINE vuint cgt_spux_min_u32w(vuint a, vuint b) { return (vuint)wasm_u32x4_min((v128_t)a, (v128_t)b); }
CGT_SPU_INLINE vuint cgt_spux_max_u32w(vuint a, vuint b) { return (vuint)wasm_u32x4_max((v128_t)a, (v128_t)b); }

#define CGT_SPUX_OWN_HORIZONTAL
#define CGT_SPUX_X(word, type, element, vec)                                                                           \
    CGT_SPU_INLINE element cgt_spux_h##word##_##type##w(vec a)                                                         \
    {                                                                                                                  \
        const vec two = cgt_spux_##word##_##type##w(a, (vec)wasm_i32x4_shuffle((v128_t)a, (v128_t)a, 2, 3, 0, 1));     \
        return cgt_spux_##word##_##type##w(two, (vec)wasm_i32x4_shuffle((v128_t)two, (v128_t)two, 1, 0, 3, 2))[0];     \
    }
CGT_SPUX_X(min, f32, float, vfloat)
CGT_SPUX_X(max, f32, float, vfloat)
CGT_SPUX_X(min, u32, uint32_t, vuint)
CGT_SPUX_X(max, u32, uint32_t, vuint)
#undef CGT_SPUX_X

#define CGT_SPUX_OWN_SQRT
CGT_SPU_INLINE vfloat spux_sqrt(vfloat a) { return (vfloat)wasm_f32x4_sqrt((v128_t)a); }
CGT_SPU_INLINE vfloat spux_rsqrte(vfloat a) { return 1.f / spux_sqrt(a); }

#define CGT_SPUX_OWN_SELECT
CGT_SPU_INLINE vfloat cgt_spux_select_f32w(vfloat a, vfloat b, vmask m)
{
    return (vfloat)wasm_v128_bitselect((v128_t)b, (v128_t)a, (v128_t)m);
}
CGT_SPU_INLINE vuint cgt_spux_select_u32w(vuint a, vuint b, vmask m)
{
    return (vuint)wasm_v128_bitselect((v128_t)b, (v128_t)a, (v128_t)m);
}

/* Bytes 4n to 4n + 3 for each lane number n. */
#define CGT_SPUX_OWN_PERMUTE
CGT_SPU_INLINE vuint cgt_spux_permute_w(vuint a, vuint index)
{
    return (vuint)wasm_i8x16_swizzle((v128_t)a, (v128_t)((index & 3) * 0x04040404 + 0x03020100));
}

#define CGT_SPUX_OWN_COMPRESS
CGT_SPU_INLINE vuint cgt_spux_compress_w(vuint a, vmask m)
{
    return (vuint)wasm_i8x16_swizzle((v128_t)a, wasm_v128_load(cgt_spux_packed_bytes(spux_mask_bits(m))));
}

#define CGT_SPUX_OWN_FIND16
CGT_SPU_INLINE uint32_t spux_find16(const uint16_t *p, uint16_t x)
{
    const v128_t wanted = wasm_i16x8_splat((int16_t)x);
    const v128_t front = wasm_i16x8_eq(wasm_v128_load(p), wanted), back = wasm_i16x8_eq(wasm_v128_load(p + 8), wanted);
    return (uint32_t)__builtin_ctz((unsigned)wasm_i8x16_bitmask(wasm_i8x16_narrow_i16x8(front, back)) | 1u << 16);
}

#define CGT_SPUX_OWN_TRANSPOSE
CGT_SPU_INLINE void cgt_spux_transpose4_w(const vfloat r[4], vfloat d[4])
{
    const v128_t low01 = wasm_i32x4_shuffle((v128_t)r[0], (v128_t)r[1], 0, 4, 1, 5);
    const v128_t low23 = wasm_i32x4_shuffle((v128_t)r[2], (v128_t)r[3], 0, 4, 1, 5);
    const v128_t high01 = wasm_i32x4_shuffle((v128_t)r[0], (v128_t)r[1], 2, 6, 3, 7);
    const v128_t high23 = wasm_i32x4_shuffle((v128_t)r[2], (v128_t)r[3], 2, 6, 3, 7);
    d[0] = (vfloat)wasm_i64x2_shuffle(low01, low23, 0, 2);
    d[1] = (vfloat)wasm_i64x2_shuffle(low01, low23, 1, 3);
    d[2] = (vfloat)wasm_i64x2_shuffle(high01, high23, 0, 2);
    d[3] = (vfloat)wasm_i64x2_shuffle(high01, high23, 1, 3);
}

#define CGT_SPUX_OWN_LOAD_BYTES
CGT_SPU_INLINE vuint spux_load_bytes(const uint8_t *p)
{
    return (vuint)wasm_u32x4_extend_low_u16x8(wasm_u16x8_extend_low_u8x16(wasm_v128_load32_zero(p)));
}

#endif
