/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The portable mapping: every word in plain C on the compiler's vectors, right on hosts of either byte order.
 * The other mappings include this file and replace single words: a mapping that has its own NAME defines
 * CGT_SPU_OWN_NAME before. */
#ifndef CGT_SPU_PORTABLE_H
#define CGT_SPU_PORTABLE_H

#include <string.h>

#include "spu_types.h"

/* Byte p of a quadword, counted as the SPU does (the most significant byte of element 0 is byte 0), lies at byte
 * p ^ CGT_SPU_BYTE_FLIP(size) of memory, where size is that of an element. */
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define CGT_SPU_BYTE_FLIP(size) 0u
#else
#define CGT_SPU_BYTE_FLIP(size) ((unsigned)(size)-1u)
#endif

/* ---- splats, extract ---- */
CGT_SPU_INLINE vec_float4 cgt_spu_splats_f32(float a) { return (vec_float4){a, a, a, a}; }
CGT_SPU_INLINE vec_int4 cgt_spu_splats_s32(int32_t a) { return (vec_int4){a, a, a, a}; }
CGT_SPU_INLINE vec_uint4 cgt_spu_splats_u32(uint32_t a) { return (vec_uint4){a, a, a, a}; }
CGT_SPU_INLINE vec_ushort8 cgt_spu_splats_u16(uint16_t a) { return (vec_ushort8){a, a, a, a, a, a, a, a}; }

CGT_SPU_INLINE float cgt_spu_extract_f32(vec_float4 a, int n) { return a[n & 3]; }
CGT_SPU_INLINE int32_t cgt_spu_extract_s32(vec_int4 a, int n) { return a[n & 3]; }
CGT_SPU_INLINE uint32_t cgt_spu_extract_u32(vec_uint4 a, int n) { return a[n & 3]; }
CGT_SPU_INLINE uint16_t cgt_spu_extract_u16(vec_ushort8 a, int n) { return a[n & 7]; }

/* ---- arithmetic: IEEE, unfused unless a mapping has a fused instruction for madd, msub, nmsub ---- */
CGT_SPU_INLINE vec_float4 cgt_spu_add_f32(vec_float4 a, vec_float4 b) { return a + b; }
CGT_SPU_INLINE vec_int4 cgt_spu_add_s32(vec_int4 a, vec_int4 b) { return (vec_int4)((vec_uint4)a + (vec_uint4)b); }
CGT_SPU_INLINE vec_uint4 cgt_spu_add_u32(vec_uint4 a, vec_uint4 b) { return a + b; }
CGT_SPU_INLINE vec_float4 cgt_spu_sub_f32(vec_float4 a, vec_float4 b) { return a - b; }
CGT_SPU_INLINE vec_int4 cgt_spu_sub_s32(vec_int4 a, vec_int4 b) { return (vec_int4)((vec_uint4)a - (vec_uint4)b); }
CGT_SPU_INLINE vec_uint4 cgt_spu_sub_u32(vec_uint4 a, vec_uint4 b) { return a - b; }
CGT_SPU_INLINE vec_float4 cgt_spu_mul_f32(vec_float4 a, vec_float4 b) { return a * b; }
#ifndef CGT_SPU_OWN_MADD
CGT_SPU_INLINE vec_float4 cgt_spu_madd_f32(vec_float4 a, vec_float4 b, vec_float4 c) { return a * b + c; }
CGT_SPU_INLINE vec_float4 cgt_spu_msub_f32(vec_float4 a, vec_float4 b, vec_float4 c) { return a * b - c; }
CGT_SPU_INLINE vec_float4 cgt_spu_nmsub_f32(vec_float4 a, vec_float4 b, vec_float4 c) { return c - a * b; }
#endif

/* ---- compare ---- */
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpgt_f32(vec_float4 a, vec_float4 b) { return (vec_uint4)(a > b); }
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpgt_s32(vec_int4 a, vec_int4 b) { return (vec_uint4)(a > b); }
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpgt_u32(vec_uint4 a, vec_uint4 b) { return (vec_uint4)(a > b); }
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpeq_f32(vec_float4 a, vec_float4 b) { return (vec_uint4)(a == b); }
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpeq_s32(vec_int4 a, vec_int4 b) { return (vec_uint4)(a == b); }
CGT_SPU_INLINE vec_uint4 cgt_spu_cmpeq_u32(vec_uint4 a, vec_uint4 b) { return (vec_uint4)(a == b); }
CGT_SPU_INLINE vec_ushort8 cgt_spu_cmpeq_u16(vec_ushort8 a, vec_ushort8 b) { return (vec_ushort8)(a == b); }

/* ---- bits ---- */
CGT_SPU_INLINE vec_uint4 cgt_spu_and_u32(vec_uint4 a, vec_uint4 b) { return a & b; }
CGT_SPU_INLINE vec_uint4 cgt_spu_or_u32(vec_uint4 a, vec_uint4 b) { return a | b; }
CGT_SPU_INLINE vec_uint4 cgt_spu_xor_u32(vec_uint4 a, vec_uint4 b) { return a ^ b; }
CGT_SPU_INLINE vec_uint4 cgt_spu_andc_u32(vec_uint4 a, vec_uint4 b) { return a & ~b; }
CGT_SPU_INLINE vec_ushort8 cgt_spu_and_u16(vec_ushort8 a, vec_ushort8 b) { return a & b; }
CGT_SPU_INLINE vec_int4 cgt_spu_and_s32(vec_int4 a, vec_int4 b) { return a & b; }
CGT_SPU_INLINE vec_int4 cgt_spu_or_s32(vec_int4 a, vec_int4 b) { return a | b; }
CGT_SPU_INLINE vec_int4 cgt_spu_xor_s32(vec_int4 a, vec_int4 b) { return a ^ b; }
CGT_SPU_INLINE vec_int4 cgt_spu_andc_s32(vec_int4 a, vec_int4 b) { return a & ~b; }
CGT_SPU_INLINE vec_float4 cgt_spu_and_f32(vec_float4 a, vec_float4 b)
{
    return (vec_float4)((vec_uint4)a & (vec_uint4)b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_or_f32(vec_float4 a, vec_float4 b)
{
    return (vec_float4)((vec_uint4)a | (vec_uint4)b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_xor_f32(vec_float4 a, vec_float4 b)
{
    return (vec_float4)((vec_uint4)a ^ (vec_uint4)b);
}
CGT_SPU_INLINE vec_float4 cgt_spu_andc_f32(vec_float4 a, vec_float4 b)
{
    return (vec_float4)((vec_uint4)a & ~(vec_uint4)b);
}

/* sel: bits of b where the mask is one, else of a */
CGT_SPU_INLINE vec_uint4 cgt_spu_sel_u32(vec_uint4 a, vec_uint4 b, vec_uint4 m) { return (a & ~m) | (b & m); }
CGT_SPU_INLINE vec_int4 cgt_spu_sel_s32(vec_int4 a, vec_int4 b, vec_uint4 m)
{
    return (vec_int4)cgt_spu_sel_u32((vec_uint4)a, (vec_uint4)b, m);
}
CGT_SPU_INLINE vec_float4 cgt_spu_sel_f32(vec_float4 a, vec_float4 b, vec_uint4 m)
{
    return (vec_float4)cgt_spu_sel_u32((vec_uint4)a, (vec_uint4)b, m);
}

/* ---- convert ---- */
CGT_SPU_INLINE vec_float4 cgt_spu_convtf_s32(vec_int4 a) { return __builtin_convertvector(a, vec_float4); }

/* convts: towards zero, saturated; NaN, which an SPU does not have, gives 0 here */
#ifndef CGT_SPU_OWN_CONVTS
CGT_SPU_INLINE vec_int4 cgt_spu_convts_f32(vec_float4 a)
{
    vec_int4 d;
    for (int i = 0; i < 4; i++)
        d[i] = a[i] >= 2147483648.f ? INT32_MAX : a[i] <= -2147483648.f ? INT32_MIN : a[i] == a[i] ? (int32_t)a[i] : 0;
    return d;
}
#endif

/* gather: the lowest bit of each element, element 0 highest, in element 0 of the result; the rest is zero */
#ifndef CGT_SPU_OWN_GATHER
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_u32(vec_uint4 a)
{
    return (vec_uint4){(a[0] & 1) << 3 | (a[1] & 1) << 2 | (a[2] & 1) << 1 | (a[3] & 1), 0, 0, 0};
}
#endif

/* shuffle: byte k of the result is byte (c & 31) of the 32 bytes a, b, where c is byte k of the pattern; c = 10xxxxxx
 * gives 0x00, 110xxxxx 0xff, 111xxxxx 0x80. The pattern's bytes are counted in the order of its elements. */
#ifndef CGT_SPU_OWN_SHUFFLE
CGT_SPU_INLINE void cgt_spu_shuffle_bytes(const uint8_t *a, const uint8_t *b, vec_uchar16 pattern, uint8_t *d,
                                          unsigned flip)
{
    for (unsigned k = 0; k < 16; k++) {
        const unsigned c = pattern[k], s = c & 15;
        d[k ^ flip] = c >= 0xe0 ? 0x80 : c >= 0xc0 ? 0xff : c >= 0x80 ? 0x00 : c & 16 ? b[s ^ flip] : a[s ^ flip];
    }
}
CGT_SPU_INLINE vec_ushort8 cgt_spu_shuffle_u16(vec_ushort8 a, vec_ushort8 b, vec_uchar16 pattern)
{
    uint8_t x[16], y[16], z[16];
    vec_ushort8 d;
    memcpy(x, &a, 16);
    memcpy(y, &b, 16);
    cgt_spu_shuffle_bytes(x, y, pattern, z, CGT_SPU_BYTE_FLIP(2));
    memcpy(&d, z, 16);
    return d;
}
#endif

/* ---- extensions (spux_*): what the SPU does in several words ---- */

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
