/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Registers as vectors, and what isa/rows/element.h and shift.h need beyond the compiler's operators.
 *
 * A register has its words in the host's order, so bytes and halfwords of a word are reversed on a little-endian host.
 * Operations element by element do not mind. */
#ifndef CGT_CELL_ELEMENTS_H
#define CGT_CELL_ELEMENTS_H

#include <string.h>

#include "cell/spu/spu.h"
#include "spu/spu_types.h"

#define CGT_SPU_VIEW(name, vec)                                                                                        \
    CGT_SPU_INLINE vec name(const cgt_spu_register *r)                                                                 \
    {                                                                                                                  \
        vec v;                                                                                                         \
        memcpy(&v, r, sizeof v);                                                                                       \
        return v;                                                                                                      \
    }
CGT_SPU_VIEW(cgt_spu_as_u8, vec_uchar16)
CGT_SPU_VIEW(cgt_spu_as_s8, vec_char16)
CGT_SPU_VIEW(cgt_spu_as_u16, vec_ushort8)
CGT_SPU_VIEW(cgt_spu_as_s16, vec_short8)
CGT_SPU_VIEW(cgt_spu_as_u32, vec_uint4)
CGT_SPU_VIEW(cgt_spu_as_s32, vec_int4)
CGT_SPU_VIEW(cgt_spu_as_f32, vec_float4)
#undef CGT_SPU_VIEW

CGT_SPU_INLINE void cgt_spu_put(cgt_spu_register *rt, vec_uint4 v) { memcpy(rt, &v, sizeof v); }

/* The lower halves of words, with their signs. */
CGT_SPU_INLINE vec_int4 cgt_spu_low_s16(const cgt_spu_register *r) { return (vec_int4)(cgt_spu_as_u32(r) << 16) >> 16; }

CGT_SPU_INLINE vec_uint4 cgt_spu_splat(uint32_t a) { return (vec_uint4){a, a, a, a}; }
CGT_SPU_INLINE vec_ushort8 cgt_spu_splat16(uint32_t a)
{
    const uint16_t h = (uint16_t)a;
    return (vec_ushort8){h, h, h, h, h, h, h, h};
}

/* ---- shifts: the low six bits of a word's count, five of a halfword's; C defines fewer ---- */

#define CGT_SPU_SHIFTS(bits, unsigned_vec, signed_vec)                                                                 \
    CGT_SPU_INLINE unsigned_vec cgt_spu_left##bits(unsigned_vec a, unsigned_vec n)                                     \
    {                                                                                                                  \
        return (a << (n & ((bits)-1))) & (unsigned_vec)((n & (bits)) == 0);                                            \
    }                                                                                                                  \
    CGT_SPU_INLINE unsigned_vec cgt_spu_right##bits(unsigned_vec a, unsigned_vec n)                                    \
    {                                                                                                                  \
        return (a >> (n & ((bits)-1))) & (unsigned_vec)((n & (bits)) == 0);                                            \
    }                                                                                                                  \
    CGT_SPU_INLINE signed_vec cgt_spu_arithmetic##bits(signed_vec a, unsigned_vec n)                                   \
    {                                                                                                                  \
        const unsigned_vec all = (unsigned_vec)((n & (bits)) != 0);                                                    \
        return a >> (signed_vec)((n | all) & ((bits)-1));                                                              \
    }                                                                                                                  \
    CGT_SPU_INLINE unsigned_vec cgt_spu_rotate##bits(unsigned_vec a, unsigned_vec n)                                   \
    {                                                                                                                  \
        return a << (n & ((bits)-1)) | a >> (-n & ((bits)-1));                                                         \
    }
CGT_SPU_SHIFTS(32, vec_uint4, vec_int4)
CGT_SPU_SHIFTS(16, vec_ushort8, vec_short8)
#undef CGT_SPU_SHIFTS

/* ---- bytes ---- */

CGT_SPU_INLINE vec_uchar16 cgt_spu_difference(vec_uchar16 a, vec_uchar16 b)
{
    const vec_uchar16 more = (vec_uchar16)(a > b);
    return ((a - b) & more) | ((b - a) & ~more);
}

/* The count of ones of each byte. */
CGT_SPU_INLINE uint32_t cgt_spu_count_bits(uint32_t a)
{
    a -= a >> 1 & 0x55555555u;
    a = (a & 0x33333333u) + (a >> 2 & 0x33333333u);
    return (a + (a >> 4)) & 0x0f0f0f0fu;
}

CGT_SPU_INLINE uint32_t cgt_spu_sum_bytes(uint32_t a)
{
    return (a & 255) + (a >> 8 & 255) + (a >> 16 & 255) + (a >> 24);
}

/* The lower words of doublewords, with their signs, to doublewords. */
CGT_SPU_INLINE void cgt_spu_extend_words(cgt_spu_register *rt, const cgt_spu_register *ra)
{
    const uint32_t first = ra->word[1], second = ra->word[3];
    cgt_spu_put(rt, (vec_uint4){first >> 31 ? UINT32_MAX : 0, first, second >> 31 ? UINT32_MAX : 0, second});
}

#endif
