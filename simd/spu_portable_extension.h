/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Portable mapping: four-lane forms of the extension words (spux_*, see vector.h): what the SPU does in several words.
 * A part of spu_portable.h. */
#ifndef CGT_SPU_PORTABLE_EXTENSION_H
#define CGT_SPU_PORTABLE_EXTENSION_H

/* bit i is set where lane i of a comparison's result is true */
#ifndef CGT_SPU_OWN_MASK_BITS
CGT_SPU_INLINE unsigned cgt_spux_mask_bits_u32(vec_uint4 m)
{
    return (m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8);
}
CGT_SPU_INLINE unsigned cgt_spux_mask_bits_u16(vec_ushort8 m)
{
    unsigned bits = 0;
    for (unsigned i = 0; i < 8; i++)
        bits |= m[i] & 1u << i;
    return bits;
}
#endif

/* min, max: b where a and b do not compare */
#ifndef CGT_SPU_OWN_MIN_MAX
CGT_SPU_INLINE vec_float4 cgt_spux_min_f32(vec_float4 a, vec_float4 b)
{
    return cgt_spu_sel_f32(b, a, (vec_uint4)(a < b));
}
CGT_SPU_INLINE vec_float4 cgt_spux_max_f32(vec_float4 a, vec_float4 b)
{
    return cgt_spu_sel_f32(b, a, (vec_uint4)(a > b));
}
#endif

/* ge: a >= b, false where they do not compare (two words on an SPU) */
CGT_SPU_INLINE vec_uint4 cgt_spux_cmpge_f32(vec_float4 a, vec_float4 b) { return (vec_uint4)(a >= b); }

/* quotient and square root: relative error at most 2^-21 on any mapping, correctly rounded on this one */
CGT_SPU_INLINE vec_float4 cgt_spux_div_f32(vec_float4 a, vec_float4 b) { return a / b; }
#ifndef CGT_SPU_OWN_SQRT
CGT_SPU_INLINE vec_float4 cgt_spux_sqrt_f32(vec_float4 a)
{
    return (vec_float4){__builtin_sqrtf(a[0]), __builtin_sqrtf(a[1]), __builtin_sqrtf(a[2]), __builtin_sqrtf(a[3])};
}
#endif

/* select by whole lanes: the mask is a comparison's result */
#ifndef CGT_SPU_OWN_SELECT
CGT_SPU_INLINE vec_float4 cgt_spux_select_f32(vec_float4 a, vec_float4 b, vec_uint4 m)
{
    return cgt_spu_sel_f32(a, b, m);
}
CGT_SPU_INLINE vec_uint4 cgt_spux_select_u32(vec_uint4 a, vec_uint4 b, vec_uint4 m) { return cgt_spu_sel_u32(a, b, m); }
#endif

#endif
