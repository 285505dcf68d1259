/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Portable mapping: shifts and rotations, of elements and of the quadword. A part of spu_portable.h.
 *
 * Counts are taken modulo twice the width of a halfword or word: from the width on, a shift leaves zeros or sign bits.
 * rlmask and rlmaska shift right by a negative count. */
#ifndef CGT_SPU_PORTABLE_SHIFT_H
#define CGT_SPU_PORTABLE_SHIFT_H

/* ---- elements: the three shifts by counts in 0 .. 2 * width - 1, and the rotation ---- */

#ifndef CGT_SPU_OWN_SHIFT
#define CGT_SPU_X(type, vec, signed_vec, width)                                                                        \
    CGT_SPU_INLINE vec cgt_spu_left_##type(vec a, vec n) { return (a << (n & (width - 1))) & (vec)(n < width); }       \
    CGT_SPU_INLINE vec cgt_spu_right_##type(vec a, vec n) { return (a >> (n & (width - 1))) & (vec)(n < width); }      \
    CGT_SPU_INLINE vec cgt_spu_right_signed_##type(vec a, vec n)                                                       \
    {                                                                                                                  \
        const vec most = cgt_spu_splats_##type(width - 1);                                                             \
        return (vec)((signed_vec)a >> (signed_vec)cgt_spu_sel_##type(n, most, (vec)(n > most)));                       \
    }
CGT_SPU_X(u16, vec_ushort8, vec_short8, 16)
CGT_SPU_X(u32, vec_uint4, vec_int4, 32)
#undef CGT_SPU_X
#endif
/* the same by one count for all elements */
#if !defined(CGT_SPU_OWN_SHIFT) && !defined(CGT_SPU_OWN_SHIFT_X)
#define CGT_SPU_X(type, vec, element)                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_left_##type##_x(vec a, unsigned n)                                                      \
    {                                                                                                                  \
        return cgt_spu_left_##type(a, cgt_spu_splats_##type((element)n));                                              \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_right_##type##_x(vec a, unsigned n)                                                     \
    {                                                                                                                  \
        return cgt_spu_right_##type(a, cgt_spu_splats_##type((element)n));                                             \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_right_signed_##type##_x(vec a, unsigned n)                                              \
    {                                                                                                                  \
        return cgt_spu_right_signed_##type(a, cgt_spu_splats_##type((element)n));                                      \
    }
CGT_SPU_X(u16, vec_ushort8, unsigned short)
CGT_SPU_X(u32, vec_uint4, unsigned)
#undef CGT_SPU_X
#endif

/* by counts in 0 .. width - 1 */
#ifndef CGT_SPU_OWN_ROTATE
CGT_SPU_INLINE vec_ushort8 cgt_spu_rotate_u16(vec_ushort8 a, vec_ushort8 n)
{
    return cgt_spu_left_u16(a, n) | cgt_spu_right_u16(a, 16 - n);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_rotate_u32(vec_uint4 a, vec_uint4 n)
{
    return cgt_spu_left_u32(a, n) | cgt_spu_right_u32(a, 32 - n);
}
#endif

#define CGT_SPU_X(type, vec, uns, uvec, svec, width)                                                                   \
    CGT_SPU_INLINE vec cgt_spu_sl_##type(vec a, uvec n)                                                                \
    {                                                                                                                  \
        return (vec)cgt_spu_left_##uns((uvec)a, n & (2 * width - 1));                                                  \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_sr_##type(vec a, uvec n)                                                                \
    {                                                                                                                  \
        return (vec)cgt_spu_right_##uns((uvec)a, n & (2 * width - 1));                                                 \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_sra_##type(vec a, uvec n)                                                               \
    {                                                                                                                  \
        return (vec)cgt_spu_right_signed_##uns((uvec)a, n & (2 * width - 1));                                          \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_rlmask_##type(vec a, svec n) { return cgt_spu_sr_##type(a, -(uvec)n); }                 \
    CGT_SPU_INLINE vec cgt_spu_rlmaska_##type(vec a, svec n) { return cgt_spu_sra_##type(a, -(uvec)n); }               \
    CGT_SPU_INLINE vec cgt_spu_rl_##type(vec a, svec n)                                                                \
    {                                                                                                                  \
        return (vec)cgt_spu_rotate_##uns((uvec)a, (uvec)n & (width - 1));                                              \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_sl_##type##_x(vec a, unsigned n)                                                        \
    {                                                                                                                  \
        return (vec)cgt_spu_left_##uns##_x((uvec)a, n & (2 * width - 1));                                              \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_sr_##type##_x(vec a, unsigned n)                                                        \
    {                                                                                                                  \
        return (vec)cgt_spu_right_##uns##_x((uvec)a, n & (2 * width - 1));                                             \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_sra_##type##_x(vec a, unsigned n)                                                       \
    {                                                                                                                  \
        return (vec)cgt_spu_right_signed_##uns##_x((uvec)a, n & (2 * width - 1));                                      \
    }                                                                                                                  \
    CGT_SPU_INLINE vec cgt_spu_rlmask_##type##_x(vec a, int n) { return cgt_spu_sr_##type##_x(a, -(unsigned)n); }      \
    CGT_SPU_INLINE vec cgt_spu_rlmaska_##type##_x(vec a, int n) { return cgt_spu_sra_##type##_x(a, -(unsigned)n); }    \
    CGT_SPU_INLINE vec cgt_spu_rl_##type##_x(vec a, int n)                                                             \
    {                                                                                                                  \
        const unsigned k = (unsigned)n & (width - 1);                                                                  \
        return (vec)(cgt_spu_left_##uns##_x((uvec)a, k) | cgt_spu_right_##uns##_x((uvec)a, width - k));                \
    }
CGT_SPU_X(u16, vec_ushort8, u16, vec_ushort8, vec_short8, 16)
CGT_SPU_X(s16, vec_short8, u16, vec_ushort8, vec_short8, 16)
CGT_SPU_X(u32, vec_uint4, u32, vec_uint4, vec_int4, 32)
CGT_SPU_X(s32, vec_int4, u32, vec_uint4, vec_int4, 32)
#undef CGT_SPU_X

/* ---- the quadword: one number of 128 bits, element 0 highest ---- */

#ifndef CGT_SPU_OWN_QUAD
typedef struct cgt_spu_quadword {
    unsigned long long high, low;
} cgt_spu_quadword;

/* Each element of `size` bytes is in the host's byte order; reverse the elements within 8 bytes instead. */
CGT_SPU_INLINE unsigned long long cgt_spu_reorder(unsigned long long a, unsigned size)
{
#if !defined(__BYTE_ORDER__) || __BYTE_ORDER__ != __ORDER_BIG_ENDIAN__
    if (size == 1)
        return __builtin_bswap64(a);
    if (size < 4)
        a = (a & 0x0000ffff0000ffffu) << 16 | (a >> 16 & 0x0000ffff0000ffffu);
    if (size < 8)
        a = a << 32 | a >> 32;
#endif
    (void)size;
    return a;
}
CGT_SPU_INLINE cgt_spu_quadword cgt_spu_quad_of(vec_ullong2 a, unsigned size)
{
    return (cgt_spu_quadword){cgt_spu_reorder(a[0], size), cgt_spu_reorder(a[1], size)};
}
CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_vector(cgt_spu_quadword q, unsigned size)
{
    return (vec_ullong2){cgt_spu_reorder(q.high, size), cgt_spu_reorder(q.low, size)};
}

/* left and right by n bits, 0 <= n < 256 */
CGT_SPU_INLINE cgt_spu_quadword cgt_spu_quad_left(cgt_spu_quadword q, unsigned n)
{
    if (n == 0)
        return q;
    if (n < 64)
        return (cgt_spu_quadword){q.high << n | q.low >> (64 - n), q.low << n};
    return (cgt_spu_quadword){n < 128 ? q.low << (n - 64) : 0, 0};
}
CGT_SPU_INLINE cgt_spu_quadword cgt_spu_quad_right(cgt_spu_quadword q, unsigned n)
{
    if (n == 0)
        return q;
    if (n < 64)
        return (cgt_spu_quadword){q.high >> n, q.low >> n | q.high << (64 - n)};
    return (cgt_spu_quadword){0, n < 128 ? q.high >> (n - 64) : 0};
}
CGT_SPU_INLINE cgt_spu_quadword cgt_spu_quad_rotate(cgt_spu_quadword q, unsigned n)
{
    const cgt_spu_quadword l = cgt_spu_quad_left(q, n), r = cgt_spu_quad_right(q, 128 - n);
    return (cgt_spu_quadword){l.high | r.high, l.low | r.low};
}

/* By bits: n in 0 .. 7. By bytes: n in 0 .. 31, in 0 .. 15 for a rotation. */
#define CGT_SPU_X(name, move, scale)                                                                                   \
    CGT_SPU_INLINE vec_ullong2 cgt_spu_quad_##name(vec_ullong2 a, unsigned n, unsigned size)                           \
    {                                                                                                                  \
        return cgt_spu_quad_vector(move(cgt_spu_quad_of(a, size), n * scale), size);                                   \
    }
CGT_SPU_X(left_bits, cgt_spu_quad_left, 1)
CGT_SPU_X(right_bits, cgt_spu_quad_right, 1)
CGT_SPU_X(rotate_bits, cgt_spu_quad_rotate, 1)
CGT_SPU_X(left_bytes, cgt_spu_quad_left, 8)
CGT_SPU_X(right_bytes, cgt_spu_quad_right, 8)
CGT_SPU_X(rotate_bytes, cgt_spu_quad_rotate, 8)
#undef CGT_SPU_X
#endif

#define CGT_SPU_QUAD_WORD(word, type, vec, element, count, name, n)                                                    \
    CGT_SPU_INLINE vec cgt_spu_##word##_##type(vec a, count c)                                                         \
    {                                                                                                                  \
        return (vec)cgt_spu_quad_##name((vec_ullong2)a, n, sizeof(element));                                           \
    }
#define CGT_SPU_X(type, vec, element, mask, elements)                                                                  \
    CGT_SPU_QUAD_WORD(slqw, type, vec, element, unsigned, left_bits, c & 7)                                            \
    CGT_SPU_QUAD_WORD(slqwbyte, type, vec, element, unsigned, left_bytes, c & 31)                                      \
    CGT_SPU_QUAD_WORD(slqwbytebc, type, vec, element, unsigned, left_bytes, c >> 3 & 31)                               \
    CGT_SPU_QUAD_WORD(srqw, type, vec, element, unsigned, right_bits, c & 7)                                           \
    CGT_SPU_QUAD_WORD(srqwbyte, type, vec, element, unsigned, right_bytes, c & 31)                                     \
    CGT_SPU_QUAD_WORD(srqwbytebc, type, vec, element, unsigned, right_bytes, c >> 3 & 31)                              \
    CGT_SPU_QUAD_WORD(rlqw, type, vec, element, int, rotate_bits, (unsigned)c & 7)                                     \
    CGT_SPU_QUAD_WORD(rlqwbyte, type, vec, element, int, rotate_bytes, (unsigned)c & 15)                               \
    CGT_SPU_QUAD_WORD(rlqwbytebc, type, vec, element, int, rotate_bytes, (unsigned)c >> 3 & 15)                        \
    CGT_SPU_QUAD_WORD(rlmaskqw, type, vec, element, int, right_bits, -(unsigned)c & 7)                                 \
    CGT_SPU_QUAD_WORD(rlmaskqwbyte, type, vec, element, int, right_bytes, -(unsigned)c & 31)                           \
    CGT_SPU_QUAD_WORD(rlmaskqwbytebc, type, vec, element, int, right_bytes, -((unsigned)c >> 3) & 31)
CGT_SPU_EACH(CGT_SPU_X)
#undef CGT_SPU_X
#undef CGT_SPU_QUAD_WORD

#endif
