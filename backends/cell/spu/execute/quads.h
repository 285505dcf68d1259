/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whole quadwords: what isa/rows/quad.h needs. Byte 0 of an SPU is the most significant one of word 0. */
#ifndef CGT_CELL_QUADS_H
#define CGT_CELL_QUADS_H

#include "cell/spu/execute/elements.h"

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define CGT_SPU_BYTE_SWAP 0
#else
#define CGT_SPU_BYTE_SWAP 3 /* byte i of an SPU is byte i ^ 3 of the host's vector */
#endif

/* ---- shuffle ---- */

/* The bytes of a and b that the low five bits of the control bytes name. */
CGT_SPU_INLINE vec_uchar16 cgt_spu_pick(vec_uchar16 a, vec_uchar16 b, vec_uchar16 control)
{
    const vec_uchar16 index = (control & 31) ^ CGT_SPU_BYTE_SWAP;
#if defined(__GNUC__) && !defined(__clang__)
    return __builtin_shuffle(a, b, index);
#else
    unsigned char from[32], to[16], at[16];
    vec_uchar16 picked;
    memcpy(from, &a, 16);
    memcpy(from + 16, &b, 16);
    memcpy(at, &index, 16);
    for (int i = 0; i < 16; i++)
        to[i] = from[at[i]];
    memcpy(&picked, to, 16);
    return picked;
#endif
}

/* Control bytes 10xxxxxx give 0, 110xxxxx 0xff, 111xxxxx 0x80. */
CGT_SPU_INLINE vec_uchar16 cgt_spu_shuffle(vec_uchar16 a, vec_uchar16 b, vec_uchar16 control)
{
    const vec_uchar16 special = (vec_uchar16)(control > 0x7f), high = (vec_uchar16)(control > 0xdf);
    const vec_uchar16 ones = (vec_uchar16)(control > 0xbf) & ~high;
    return (cgt_spu_pick(a, b, control) & ~special) | ones | (high & 0x80);
}

/* The control that inserts the first bytes of the preferred slot (byte, halfword, word, doubleword of `size` bytes)
 * into a quadword at an address. */
CGT_SPU_INLINE void cgt_spu_insertion(cgt_spu_register *rt, uint32_t address, uint32_t size)
{
    const uint32_t at = address & 15 & (0 - size), first = size < 4 ? 4 - size : 0;
    for (uint32_t i = 0; i < 4; i++)
        rt->word[i] = 0x10111213u + 0x04040404u * i;
    for (uint32_t i = 0; i < size; i++) {
        const uint32_t byte = at + i, shift = 24 - 8 * (byte & 3);
        rt->word[byte >> 2] = (rt->word[byte >> 2] & ~(255u << shift)) | (first + i) << shift;
    }
}

/* ---- shifts of 128 bits ---- */

typedef struct cgt_spu_wide {
    uint64_t high, low;
} cgt_spu_wide;

CGT_SPU_INLINE cgt_spu_wide cgt_spu_get_wide(const cgt_spu_register *r)
{
    return (cgt_spu_wide){(uint64_t)r->word[0] << 32 | r->word[1], (uint64_t)r->word[2] << 32 | r->word[3]};
}
CGT_SPU_INLINE void cgt_spu_put_wide(cgt_spu_register *rt, cgt_spu_wide w)
{
    cgt_spu_put(rt, (vec_uint4){(uint32_t)(w.high >> 32), (uint32_t)w.high, (uint32_t)(w.low >> 32), (uint32_t)w.low});
}

/* n up to 255; C leaves shifts of 64 undefined */
CGT_SPU_INLINE cgt_spu_wide cgt_spu_wide_left(cgt_spu_wide a, uint32_t n)
{
    if (n >= 128)
        return (cgt_spu_wide){0, 0};
    if (n >= 64)
        return (cgt_spu_wide){a.low << (n - 64), 0};
    return n ? (cgt_spu_wide){a.high << n | a.low >> (64 - n), a.low << n} : a;
}
CGT_SPU_INLINE cgt_spu_wide cgt_spu_wide_right(cgt_spu_wide a, uint32_t n)
{
    if (n >= 128)
        return (cgt_spu_wide){0, 0};
    if (n >= 64)
        return (cgt_spu_wide){0, a.high >> (n - 64)};
    return n ? (cgt_spu_wide){a.high >> n, a.low >> n | a.high << (64 - n)} : a;
}

CGT_SPU_INLINE void cgt_spu_quad_left(cgt_spu_register *rt, const cgt_spu_register *ra, uint32_t n)
{
    cgt_spu_put_wide(rt, cgt_spu_wide_left(cgt_spu_get_wide(ra), n));
}
CGT_SPU_INLINE void cgt_spu_quad_right(cgt_spu_register *rt, const cgt_spu_register *ra, uint32_t n)
{
    cgt_spu_put_wide(rt, cgt_spu_wide_right(cgt_spu_get_wide(ra), n));
}
CGT_SPU_INLINE void cgt_spu_quad_rotate(cgt_spu_register *rt, const cgt_spu_register *ra, uint32_t n)
{
    const cgt_spu_wide a = cgt_spu_get_wide(ra), up = cgt_spu_wide_left(a, n), down = cgt_spu_wide_right(a, 128 - n);
    cgt_spu_put_wide(rt, (cgt_spu_wide){up.high | down.high, up.low | down.low});
}

/* ---- masks from bits, bits from masks: the most significant bit belongs to element 0 ---- */

CGT_SPU_INLINE void cgt_spu_form_words(cgt_spu_register *rt, uint32_t bits)
{
    for (uint32_t i = 0; i < 4; i++)
        rt->word[i] = bits >> (3 - i) & 1 ? UINT32_MAX : 0;
}
CGT_SPU_INLINE void cgt_spu_form_halves(cgt_spu_register *rt, uint32_t bits)
{
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t two = bits >> (6 - 2 * i);
        rt->word[i] = (two & 2 ? 0xffff0000u : 0) | (two & 1 ? 0xffffu : 0);
    }
}
CGT_SPU_INLINE void cgt_spu_form_bytes(cgt_spu_register *rt, uint32_t bits)
{
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t four = bits >> (12 - 4 * i);
        rt->word[i] = (four & 8 ? 0xff000000u : 0) | (four & 4 ? 0xff0000u : 0) | (four & 2 ? 0xff00u : 0) |
                      (four & 1 ? 0xffu : 0);
    }
}

CGT_SPU_INLINE uint32_t cgt_spu_gather_words(const cgt_spu_register *ra)
{
    return (ra->word[0] & 1) << 3 | (ra->word[1] & 1) << 2 | (ra->word[2] & 1) << 1 | (ra->word[3] & 1);
}
CGT_SPU_INLINE uint32_t cgt_spu_gather_halves(const cgt_spu_register *ra)
{
    uint32_t bits = 0;
    for (uint32_t i = 0; i < 4; i++)
        bits = bits << 2 | (ra->word[i] >> 15 & 2) | (ra->word[i] & 1);
    return bits;
}
CGT_SPU_INLINE uint32_t cgt_spu_gather_bytes(const cgt_spu_register *ra)
{
    uint32_t bits = 0;
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t a = ra->word[i];
        bits = bits << 4 | (a >> 21 & 8) | (a >> 14 & 4) | (a >> 7 & 2) | (a & 1);
    }
    return bits;
}

#endif
