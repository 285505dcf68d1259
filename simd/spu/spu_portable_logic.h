/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Portable mapping: logic, selection and integer comparison. A part of spu_portable.h. */
#ifndef CGT_SPU_PORTABLE_LOGIC_H
#define CGT_SPU_PORTABLE_LOGIC_H

#ifndef CGT_SPU_OWN_COMPLEMENTS
#define CGT_SPU_ORC(mask, a, b) ((a) | ~(b))
#define CGT_SPU_NAND(mask, a, b) (~((a) & (b)))
#define CGT_SPU_NOR(mask, a, b) (~((a) | (b)))
#define CGT_SPU_EQV(mask, a, b) (~((a) ^ (b)))
#endif
#define CGT_SPU_BITWISE(word, type, vec, mask, expression)                                                             \
    CGT_SPU_INLINE vec cgt_spu_##word##_##type(vec v, vec w)                                                           \
    {                                                                                                                  \
        const mask a = (mask)v, b = (mask)w;                                                                           \
        return (vec)(expression);                                                                                      \
    }
#define CGT_SPU_X(type, vec, element, mask, n)                                                                         \
    CGT_SPU_BITWISE(and, type, vec, mask, a &b)                                                                        \
    CGT_SPU_BITWISE(or, type, vec, mask, a | b)                                                                        \
    CGT_SPU_BITWISE(xor, type, vec, mask, a ^ b)                                                                       \
    CGT_SPU_BITWISE(andc, type, vec, mask, a & ~b)                                                                     \
    CGT_SPU_BITWISE(orc, type, vec, mask, CGT_SPU_ORC(mask, a, b))                                                     \
    CGT_SPU_BITWISE(nand, type, vec, mask, CGT_SPU_NAND(mask, a, b))                                                   \
    CGT_SPU_BITWISE(nor, type, vec, mask, CGT_SPU_NOR(mask, a, b))                                                     \
    CGT_SPU_BITWISE(eqv, type, vec, mask, CGT_SPU_EQV(mask, a, b))                                                     \
    /* bits of b where the mask is one, else of a */                                                                   \
    CGT_SPU_INLINE vec cgt_spu_sel_##type(vec v, vec w, mask m)                                                        \
    {                                                                                                                  \
        const mask a = (mask)v, b = (mask)w;                                                                           \
        return (vec)((a & ~m) | (b & m));                                                                              \
    }
CGT_SPU_EACH(CGT_SPU_X)
#undef CGT_SPU_X

#define CGT_SPU_X(type, vec, element, mask, n)                                                                         \
    CGT_SPU_INLINE vec cgt_spu_and_##type##_x(vec a, element b)                                                        \
    {                                                                                                                  \
        return cgt_spu_and_##type(a, cgt_spu_splats_##type(b));                                                        \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_or_##type##_x(vec a, element b)                                                         \
    {                                                                                                                  \
        return cgt_spu_or_##type(a, cgt_spu_splats_##type(b));                                                         \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_xor_##type##_x(vec a, element b)                                                        \
    {                                                                                                                  \
        return cgt_spu_xor_##type(a, cgt_spu_splats_##type(b));                                                        \
    }                                                                                                                  \
    CGT_SPU_INLINE mask cgt_spu_cmpeq_##type(vec a, vec b) { return (mask)(a == b); }                                  \
    CGT_SPU_INLINE mask cgt_spu_cmpgt_##type(vec a, vec b) { return (mask)(a > b); }                                   \
    CGT_SPU_INLINE mask cgt_spu_cmpeq_##type##_x(vec a, element b) { return (mask)(a == cgt_spu_splats_##type(b)); }   \
    CGT_SPU_INLINE mask cgt_spu_cmpgt_##type##_x(vec a, element b) { return (mask)(a > cgt_spu_splats_##type(b)); }
CGT_SPU_EACH_INT(CGT_SPU_X)
#undef CGT_SPU_X
#undef CGT_SPU_BITWISE

/* orx: the four words or-ed, in element 0 */
#ifndef CGT_SPU_OWN_ORX
CGT_SPU_INLINE vec_uint4 cgt_spu_orx_u32(vec_uint4 a) { return (vec_uint4){a[0] | a[1] | a[2] | a[3], 0, 0, 0}; }
#endif
CGT_SPU_INLINE vec_int4 cgt_spu_orx_s32(vec_int4 a) { return (vec_int4)cgt_spu_orx_u32((vec_uint4)a); }

#endif
