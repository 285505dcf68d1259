/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPU's estimates, four elements at once in integers: they need no mode. A part of spu_exact.h; spu_float_model.h
 * explains the lines. */
#ifndef CGT_SPU_EXACT_ESTIMATE_H
#define CGT_SPU_EXACT_ESTIMATE_H

#define CGT_SPU_EXACT_EXPONENT 0x7f800000

CGT_SPU_INLINE vec_uint4 cgt_spu_exact_lines(const uint32_t *lines, vec_uint4 index)
{
    return (vec_uint4){lines[index[0]], lines[index[1]], lines[index[2]], lines[index[3]]};
}

/* Exponents stay in place in the word. The exponent of a line is 255, all bits set, where that of a is 0. */
CGT_SPU_INLINE vec_float4 cgt_spu_frest_f32(vec_float4 a)
{
    const vec_uint4 x = (vec_uint4)a, lines = cgt_spu_exact_lines(cgt_spu_model_frest_lines, x >> 18 & 31);
    const vec_int4 exponent = (vec_int4)x & CGT_SPU_EXACT_EXPONENT, difference = 0x7e800000 - exponent; /* 253 - e */
    const vec_int4 above_zero = difference & (vec_int4)(difference > 0);
    const vec_int4 of_zero = (vec_int4)(exponent == 0) & CGT_SPU_EXACT_EXPONENT;
    return (vec_float4)(lines | (x & CGT_SPU_MODEL_SIGN) | (vec_uint4)(above_zero | of_zero));
}

CGT_SPU_INLINE vec_float4 cgt_spu_frsqest_f32(vec_float4 a)
{
    const vec_uint4 x = (vec_uint4)a, lines = cgt_spu_exact_lines(cgt_spu_model_frsqest_lines, x >> 18 & 63);
    const vec_uint4 exponent = x & CGT_SPU_EXACT_EXPONENT;
    const vec_uint4 half = (exponent + 0x00800000) >> 1 & CGT_SPU_EXACT_EXPONENT; /* (e + 1) / 2 */
    const vec_uint4 of_zero = (vec_uint4)(exponent == 0) & CGT_SPU_EXACT_EXPONENT;
    return (vec_float4)(lines | (0x5f000000 - half) | of_zero); /* 190 - half */
}

/* The model's 33 bits without the lowest 8, which truncation drops in any case: step * y is rounded up to compensate.
 * The value has 24 or 25 bits; the number with exponent 126 or 127 is scaled to the exponent of the line. */
CGT_SPU_INLINE vec_float4 cgt_spu_fi_f32(vec_float4 a, vec_float4 b)
{
    const vec_uint4 x = (vec_uint4)a, line = (vec_uint4)b;
    const vec_uint4 base = (line >> 10 & 8191) | 8192, down = (line & 1023) * (x & 0x7ffff);
    const vec_uint4 value = (base << 11) - ((down + 255) >> 8);
    const vec_uint4 is_wide = (vec_uint4)((vec_int4)value > 0x00ffffff);
    const vec_uint4 below_one =
        value - 0x01000000; /* 24 bits: the exponent is one lower, and the top bit falls into it */
    const vec_uint4 from_one = (value >> 1) - 0x00800000;
    const vec_uint4 offset = (below_one & ~is_wide) | (from_one & is_wide); /* from the number 1 of exponent 0 */
    const vec_int4 magnitude = (vec_int4)(offset + (line & CGT_SPU_EXACT_EXPONENT));
    const vec_int4 is_number = (vec_int4)(magnitude > 0x007fffff);
    return (vec_float4)(is_number & (magnitude | (vec_int4)(line & CGT_SPU_MODEL_SIGN)));
}

#endif
