/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Portable mapping: integer arithmetic. A part of spu_portable.h. Sums and differences wrap; even and odd elements are
 * counted from 0. */
#ifndef CGT_SPU_PORTABLE_INTEGER_H
#define CGT_SPU_PORTABLE_INTEGER_H

/* signed sums in unsigned elements: they may wrap */
#define CGT_SPU_X(type, vec, element, mask)                                                                            \
    CGT_SPU_INLINE vec cgt_spu_add_##type(vec a, vec b) { return (vec)((mask)a + (mask)b); }                           \
    CGT_SPU_INLINE vec cgt_spu_sub_##type(vec a, vec b) { return (vec)((mask)a - (mask)b); }                           \
    CGT_SPU_INLINE vec cgt_spu_add_##type##_x(vec a, element b)                                                        \
    {                                                                                                                  \
        return cgt_spu_add_##type(a, cgt_spu_splats_##type(b));                                                        \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_sub_##type##_x(element a, vec b)                                                        \
    {                                                                                                                  \
        return cgt_spu_sub_##type(cgt_spu_splats_##type(a), b);                                                        \
    }
CGT_SPU_X(u16, vec_ushort8, unsigned short, vec_ushort8)
CGT_SPU_X(s16, vec_short8, signed short, vec_ushort8)
CGT_SPU_X(u32, vec_uint4, unsigned int, vec_uint4)
CGT_SPU_X(s32, vec_int4, signed int, vec_uint4)
#undef CGT_SPU_X

/* ---- carries and borrows, for sums of several words; of the third operand the lowest bit counts ---- */

CGT_SPU_INLINE vec_uint4 cgt_spu_addx_u32(vec_uint4 a, vec_uint4 b, vec_uint4 c) { return a + b + (c & 1); }
CGT_SPU_INLINE vec_uint4 cgt_spu_subx_u32(vec_uint4 a, vec_uint4 b, vec_uint4 c) { return a - b - (~c & 1); }
#ifndef CGT_SPU_OWN_CARRY
CGT_SPU_INLINE vec_uint4 cgt_spu_genb_u32(vec_uint4 a, vec_uint4 b) { return (vec_uint4)(a >= b) & 1; }
CGT_SPU_INLINE vec_uint4 cgt_spu_genc_u32(vec_uint4 a, vec_uint4 b) { return (vec_uint4)(~a < b) & 1; }
CGT_SPU_INLINE vec_uint4 cgt_spu_gencx_u32(vec_uint4 a, vec_uint4 b, vec_uint4 c)
{
    return ((vec_uint4)(~a < b) | ((vec_uint4)(~a == b) & c)) & 1;
}
CGT_SPU_INLINE vec_uint4 cgt_spu_genbx_u32(vec_uint4 a, vec_uint4 b, vec_uint4 c)
{
    return ((vec_uint4)(a > b) | ((vec_uint4)(a == b) & c)) & 1;
}
#endif
#define CGT_SPU_X2(word)                                                                                               \
    CGT_SPU_INLINE vec_int4 cgt_spu_##word##_s32(vec_int4 a, vec_int4 b)                                               \
    {                                                                                                                  \
        return (vec_int4)cgt_spu_##word##_u32((vec_uint4)a, (vec_uint4)b);                                             \
    }
#define CGT_SPU_X3(word)                                                                                               \
    CGT_SPU_INLINE vec_int4 cgt_spu_##word##_s32(vec_int4 a, vec_int4 b, vec_int4 c)                                   \
    {                                                                                                                  \
        return (vec_int4)cgt_spu_##word##_u32((vec_uint4)a, (vec_uint4)b, (vec_uint4)c);                               \
    }
CGT_SPU_X3(addx)
CGT_SPU_X3(subx)
CGT_SPU_X2(genc)
CGT_SPU_X3(gencx)
CGT_SPU_X2(genb)
CGT_SPU_X3(genbx)
#undef CGT_SPU_X2
#undef CGT_SPU_X3

/* ---- products of halfwords ---- */

/* even and odd halfwords, each in a word of its own */
CGT_SPU_INLINE vec_int4 cgt_spu_even_s16(vec_short8 a) { return (vec_int4){a[0], a[2], a[4], a[6]}; }
CGT_SPU_INLINE vec_int4 cgt_spu_odd_s16(vec_short8 a) { return (vec_int4){a[1], a[3], a[5], a[7]}; }
CGT_SPU_INLINE vec_uint4 cgt_spu_even_u16(vec_ushort8 a) { return (vec_uint4){a[0], a[2], a[4], a[6]}; }
CGT_SPU_INLINE vec_uint4 cgt_spu_odd_u16(vec_ushort8 a) { return (vec_uint4){a[1], a[3], a[5], a[7]}; }

#ifndef CGT_SPU_OWN_MULTIPLY
CGT_SPU_INLINE vec_int4 cgt_spu_mule_s16(vec_short8 a, vec_short8 b)
{
    return cgt_spu_even_s16(a) * cgt_spu_even_s16(b);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_mule_u16(vec_ushort8 a, vec_ushort8 b)
{
    return cgt_spu_even_u16(a) * cgt_spu_even_u16(b);
}
CGT_SPU_INLINE vec_int4 cgt_spu_mulo_s16(vec_short8 a, vec_short8 b) { return cgt_spu_odd_s16(a) * cgt_spu_odd_s16(b); }
CGT_SPU_INLINE vec_uint4 cgt_spu_mulo_u16(vec_ushort8 a, vec_ushort8 b)
{
    return cgt_spu_odd_u16(a) * cgt_spu_odd_u16(b);
}
/* even halfword of a times odd halfword of b, in the upper half of the word: one step of a 32-bit product */
CGT_SPU_INLINE vec_int4 cgt_spu_mulh_s16(vec_short8 a, vec_short8 b)
{
    return (vec_int4)((vec_uint4)(cgt_spu_even_s16(a) * cgt_spu_odd_s16(b)) << 16);
}
#endif
CGT_SPU_INLINE vec_int4 cgt_spu_mulo_s16_x(vec_short8 a, signed short b)
{
    return cgt_spu_mulo_s16(a, cgt_spu_splats_s16(b));
}
CGT_SPU_INLINE vec_uint4 cgt_spu_mulo_u16_x(vec_ushort8 a, unsigned short b)
{
    return cgt_spu_mulo_u16(a, cgt_spu_splats_u16(b));
}
#ifndef CGT_SPU_OWN_MULTIPLY
CGT_SPU_INLINE vec_int4 cgt_spu_mulsr_s16(vec_short8 a, vec_short8 b) { return cgt_spu_mulo_s16(a, b) >> 16; }
#endif
CGT_SPU_INLINE vec_int4 cgt_spu_madd_s16(vec_short8 a, vec_short8 b, vec_int4 c)
{
    return cgt_spu_add_s32(cgt_spu_mulo_s16(a, b), c);
}
CGT_SPU_INLINE vec_int4 cgt_spu_mhhadd_s16(vec_short8 a, vec_short8 b, vec_int4 c)
{
    return cgt_spu_add_s32(cgt_spu_mule_s16(a, b), c);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_mhhadd_u16(vec_ushort8 a, vec_ushort8 b, vec_uint4 c)
{
    return cgt_spu_mule_u16(a, b) + c;
}

/* ---- sign extension: of the odd elements, which become the whole ---- */

#ifndef CGT_SPU_OWN_EXTEND
CGT_SPU_INLINE vec_short8 cgt_spu_extend_s8(vec_char16 a)
{
    return (vec_short8){a[1], a[3], a[5], a[7], a[9], a[11], a[13], a[15]};
}
CGT_SPU_INLINE vec_int4 cgt_spu_extend_s16(vec_short8 a) { return cgt_spu_odd_s16(a); }
CGT_SPU_INLINE vec_llong2 cgt_spu_extend_s32(vec_int4 a) { return (vec_llong2){a[1], a[3]}; }
#endif

#endif
