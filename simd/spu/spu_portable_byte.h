/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Portable mapping: bytes, counting, masks from bits and back, shuffle. A part of spu_portable.h. */
#ifndef CGT_SPU_PORTABLE_BYTE_H
#define CGT_SPU_PORTABLE_BYTE_H

/* Byte p of a quadword, counted as the SPU does (the most significant byte of element 0 is byte 0), lies at byte
 * p ^ CGT_SPU_BYTE_FLIP(size) of memory, where size is that of an element. */
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define CGT_SPU_BYTE_FLIP(size) 0u
#else
#define CGT_SPU_BYTE_FLIP(size) ((unsigned)(size)-1u)
#endif

/* ---- bytes ---- */

#ifndef CGT_SPU_OWN_BYTE
CGT_SPU_INLINE vec_uchar16 cgt_spu_absd_u8(vec_uchar16 a, vec_uchar16 b)
{
    return cgt_spu_sel_u8(b - a, a - b, (vec_uchar16)(a > b));
}
CGT_SPU_INLINE vec_uchar16 cgt_spu_avg_u8(vec_uchar16 a, vec_uchar16 b)
{
    return (a >> 1) + (b >> 1) + ((a | b) & 1); /* (a + b + 1) / 2 without the ninth bit */
}
/* sums of the four bytes of a word: of b in the even halfword, of a in the odd one */
CGT_SPU_INLINE vec_ushort8 cgt_spu_sumb_u8(vec_uchar16 a, vec_uchar16 b)
{
    vec_ushort8 d;
    for (int i = 0; i < 4; i++) {
        d[2 * i] = (unsigned short)(b[4 * i] + b[4 * i + 1] + b[4 * i + 2] + b[4 * i + 3]);
        d[2 * i + 1] = (unsigned short)(a[4 * i] + a[4 * i + 1] + a[4 * i + 2] + a[4 * i + 3]);
    }
    return d;
}
CGT_SPU_INLINE vec_uchar16 cgt_spu_cntb_u8(vec_uchar16 a)
{
    a = a - (a >> 1 & 0x55);
    a = (a & 0x33) + (a >> 2 & 0x33);
    return (a + (a >> 4)) & 0x0f;
}
#endif
CGT_SPU_INLINE vec_uchar16 cgt_spu_cntb_s8(vec_char16 a) { return cgt_spu_cntb_u8((vec_uchar16)a); }

#ifndef CGT_SPU_OWN_CNTLZ
CGT_SPU_INLINE vec_uint4 cgt_spu_cntlz_u32(vec_uint4 a)
{
    vec_uint4 d;
    for (int i = 0; i < 4; i++)
        d[i] = a[i] ? (unsigned)__builtin_clz(a[i]) : 32;
    return d;
}
#endif
CGT_SPU_INLINE vec_uint4 cgt_spu_cntlz_s32(vec_int4 a) { return cgt_spu_cntlz_u32((vec_uint4)a); }
CGT_SPU_INLINE vec_uint4 cgt_spu_cntlz_f32(vec_float4 a) { return cgt_spu_cntlz_u32((vec_uint4)a); }

/* ---- gather: the lowest bit of each element, element 0 highest, in element 0 of the result; the rest is zero ---- */

#ifndef CGT_SPU_OWN_GATHER
#define CGT_SPU_X(type, vec, n)                                                                                        \
    CGT_SPU_INLINE vec_uint4 cgt_spu_gather_##type(vec a)                                                              \
    {                                                                                                                  \
        unsigned bits = 0;                                                                                             \
        for (int i = 0; i < n; i++)                                                                                    \
            bits = bits << 1 | (a[i] & 1u);                                                                            \
        return (vec_uint4){bits, 0, 0, 0};                                                                             \
    }
CGT_SPU_X(u8, vec_uchar16, 16)
CGT_SPU_X(u16, vec_ushort8, 8)
CGT_SPU_X(u32, vec_uint4, 4)
#undef CGT_SPU_X
#endif
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_s8(vec_char16 a) { return cgt_spu_gather_u8((vec_uchar16)a); }
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_s16(vec_short8 a) { return cgt_spu_gather_u16((vec_ushort8)a); }
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_s32(vec_int4 a) { return cgt_spu_gather_u32((vec_uint4)a); }
CGT_SPU_INLINE vec_uint4 cgt_spu_gather_f32(vec_float4 a) { return cgt_spu_gather_u32((vec_uint4)a); }

/* ---- maskb, maskh, maskw: the lowest 16, 8, 4 bits, the highest for element 0, each as all ones or zero ---- */

#ifndef CGT_SPU_OWN_MASKB
CGT_SPU_INLINE vec_uchar16 cgt_spu_maskb(unsigned a)
{
    const vec_uchar16 bit = {128, 64, 32, 16, 8, 4, 2, 1, 128, 64, 32, 16, 8, 4, 2, 1};
    const unsigned char h = (unsigned char)(a >> 8), l = (unsigned char)a;
    return (vec_uchar16)(((vec_uchar16){CGT_SPU_TIMES_8(h), CGT_SPU_TIMES_8(l)} & bit) == bit);
}
#endif
CGT_SPU_INLINE vec_ushort8 cgt_spu_maskh(unsigned a)
{
    const vec_ushort8 bit = {128, 64, 32, 16, 8, 4, 2, 1};
    return (vec_ushort8)((cgt_spu_splats_u16((unsigned short)a) & bit) == bit);
}
CGT_SPU_INLINE vec_uint4 cgt_spu_maskw(unsigned a)
{
    const vec_uint4 bit = {8, 4, 2, 1};
    return (vec_uint4)((cgt_spu_splats_u32(a) & bit) == bit);
}

/* ---- shuffle: byte k of the result is byte (c & 31) of the 32 bytes a, b, where c is byte k of the pattern;
 * c = 10xxxxxx gives 0x00, 110xxxxx 0xff, 111xxxxx 0x80. The pattern's bytes are counted in the order of its elements,
 * those of a, b and the result in the SPU's. ---- */

#ifndef CGT_SPU_OWN_SHUFFLE
CGT_SPU_INLINE vec_uchar16 cgt_spu_shuffle_bytes(vec_uchar16 a, vec_uchar16 b, vec_uchar16 pattern, unsigned flip)
{
    unsigned char x[32], z[16];
    vec_uchar16 d;
#if !defined(__clang__)
    /* a constant pattern without constant bytes: the compiler knows the best instructions. clang finds them itself. */
    const unsigned long long special = (((vec_ullong2)pattern)[0] | ((vec_ullong2)pattern)[1]) & 0x8080808080808080u;
    if (__builtin_constant_p(special) && !special) {
        const vec_uchar16 iota = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
        const vec_uchar16 c = __builtin_shuffle(pattern, iota ^ (unsigned char)flip);
        return __builtin_shuffle(a, b, (c & 31) ^ (unsigned char)flip);
    }
#endif
    memcpy(x, &a, 16);
    memcpy(x + 16, &b, 16);
    for (unsigned k = 0; k < 16; k++) {
        const unsigned char c = pattern[k];
        z[k ^ flip] = c >= 0xe0 ? 0x80 : c >= 0xc0 ? 0xff : c >= 0x80 ? 0x00 : x[(c & 31u) ^ flip];
    }
    memcpy(&d, z, 16);
    return d;
}
#endif
#define CGT_SPU_X(type, vec, element, mask, n)                                                                         \
    CGT_SPU_INLINE vec cgt_spu_shuffle_##type(vec a, vec b, vec_uchar16 pattern)                                       \
    {                                                                                                                  \
        return (vec)cgt_spu_shuffle_bytes((vec_uchar16)a, (vec_uchar16)b, pattern,                                     \
                                          CGT_SPU_BYTE_FLIP(sizeof(element)));                                         \
    }
CGT_SPU_EACH(CGT_SPU_X)
#undef CGT_SPU_X

/* A cast between element sizes as an SPU does it: bytes keep their place in the quadword, not in memory. */
CGT_SPU_INLINE vec_uchar16 cgt_spu_cast_bytes(vec_uchar16 a, unsigned from, unsigned to)
{
    const vec_uchar16 iota = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const unsigned flip = CGT_SPU_BYTE_FLIP(from) ^ CGT_SPU_BYTE_FLIP(to);
    (void)from, (void)to; /* big-endian */
    return flip ? cgt_spu_shuffle_bytes(a, a, iota ^ (unsigned char)flip, 0) : a;
}

#endif
