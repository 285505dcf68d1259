/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words that work element by element: the definition of each on one element. */
#include <math.h>

#include "simd/spu_reference_parts.h"

uint64_t word_splats(const element *e) { return e->a; }

uint64_t word_add(const element *e)
{
    if (e->type == SPU_f32)
        return float_bits(float_of(e->a) + float_of(e->b));
    if (e->type == SPU_f64)
        return double_bits(double_of(e->a) + double_of(e->b));
    return e->a + e->b;
}

uint64_t word_sub(const element *e)
{
    if (e->type == SPU_f32)
        return float_bits(float_of(e->a) - float_of(e->b));
    if (e->type == SPU_f64)
        return double_bits(double_of(e->a) - double_of(e->b));
    return e->a - e->b;
}

uint64_t word_mul(const element *e)
{
    if (e->type == SPU_f32)
        return float_bits(float_of(e->a) * float_of(e->b));
    return double_bits(double_of(e->a) * double_of(e->b));
}

/* a * b + c, the product negated or not, c negated or not */
static float float_madd(const element *e, float product_sign, float c_sign)
{
    const float a = product_sign * float_of(e->a), b = float_of(e->b), c = c_sign * float_of(e->c);
    const float product = a * b;
    return e->is_fused ? fmaf(a, b, c) : product + c;
}

static double double_madd(const element *e, double c_sign)
{
    const double a = double_of(e->a), b = double_of(e->b), c = c_sign * double_of(e->c);
    const double product = a * b;
    return e->is_fused ? fma(a, b, c) : product + c;
}

uint64_t element_madd(const element *e)
{
    return e->type == SPU_f32 ? float_bits(float_madd(e, 1, 1)) : double_bits(double_madd(e, 1));
}

uint64_t word_msub(const element *e)
{
    return e->type == SPU_f32 ? float_bits(float_madd(e, 1, -1)) : double_bits(double_madd(e, -1));
}

/* c - a * b in single precision (fnms); in double the machine negates a * b - c after rounding it (dfnms), so that
 * where they are equal the zero is negative */
uint64_t word_nmsub(const element *e)
{
    return e->type == SPU_f32 ? float_bits(float_madd(e, -1, 1)) : double_bits(-double_madd(e, -1));
}

uint64_t word_nmadd(const element *e) { return double_bits(-double_madd(e, 1)); }

uint64_t word_addx(const element *e) { return e->a + e->b + (e->c & 1); }
uint64_t word_subx(const element *e) { return e->a - e->b - (1 - (e->c & 1)); }
/* words in 64 bits: the carry is bit 32 */
uint64_t word_genc(const element *e) { return (e->a + e->b) >> 32; }
uint64_t word_gencx(const element *e) { return (e->a + e->b + (e->c & 1)) >> 32; }
uint64_t word_genb(const element *e) { return e->a >= e->b; }
uint64_t word_genbx(const element *e) { return e->c & 1 ? e->a >= e->b : e->a > e->b; }

uint64_t word_re(const element *e) { return float_bits((float)(1 / (double)float_of(e->a))); }
uint64_t word_rsqrte(const element *e) { return float_bits((float)(1 / sqrt(fabs((double)float_of(e->a))))); }

uint64_t word_absd(const element *e) { return e->a > e->b ? e->a - e->b : e->b - e->a; }
uint64_t word_avg(const element *e) { return (e->a + e->b + 1) >> 1; }

/* the nearest float of the integer, then an exact division: the least result, 2^-127, is a denormal */
uint64_t word_convtf(const element *e)
{
    const int scale = (int)e->b;
    const float value = e->type == SPU_u32 ? (float)(uint32_t)e->a : (float)(int32_t)signed_value(e->a, 32);
    return float_bits((float)ldexp((double)value, -scale));
}

static uint64_t convert_to_int(const element *e, double least, double most)
{
    const double value = ldexp((double)float_of(e->a), (int)e->b);
    if (isnan(value))
        return 0;
    return (uint64_t)(int64_t)(value >= most ? most : value <= least ? least : trunc(value));
}

uint64_t word_convts(const element *e) { return convert_to_int(e, -2147483648.0, 2147483647.0); }
uint64_t word_convtu(const element *e) { return convert_to_int(e, 0, 4294967295.0); }

uint64_t word_cmpeq(const element *e)
{
    const bool yes = spu_is_float(e->type) ? number_of(e->a, e->type) == number_of(e->b, e->type) : e->a == e->b;
    return yes ? UINT64_MAX : 0;
}

uint64_t word_cmpgt(const element *e)
{
    bool yes = e->a > e->b;
    if (spu_is_float(e->type))
        yes = number_of(e->a, e->type) > number_of(e->b, e->type);
    else if (is_signed(e->type))
        yes = signed_value(e->a, e->bits) > signed_value(e->b, e->bits);
    return yes ? UINT64_MAX : 0;
}

uint64_t word_cmpabseq(const element *e)
{
    return fabs(number_of(e->a, e->type)) == fabs(number_of(e->b, e->type)) ? UINT64_MAX : 0;
}

uint64_t word_cmpabsgt(const element *e)
{
    return fabs(number_of(e->a, e->type)) > fabs(number_of(e->b, e->type)) ? UINT64_MAX : 0;
}

/* The classes are bits of the mask: NaN, +infinity, -infinity, +0, -0, +denormal, -denormal from 0x40 down to 1. */
uint64_t word_testsv(const element *e)
{
    const bool negative = is_negative(e->a, 64);
    const uint64_t exponent = e->a >> 52 & 0x7ff, fraction = e->a & UINT64_C(0xfffffffffffff);
    unsigned class = 0;
    if (exponent == 0x7ff)
        class = fraction ? 0x40 : negative ? 0x10 : 0x20;
    else if (exponent == 0)
        class = fraction ? (negative ? 0x01 : 0x02) : (negative ? 0x04 : 0x08);
    return e->b & class ? UINT64_MAX : 0;
}

uint64_t word_cntb(const element *e)
{
    unsigned count = 0;
    for (int i = 0; i < 8; i++)
        count += e->a >> i & 1;
    return count;
}

uint64_t word_cntlz(const element *e)
{
    unsigned count = 0;
    while (count < 32 && !(e->a >> (31 - count) & 1))
        count++;
    return count;
}

uint64_t word_sel(const element *e) { return (e->a & ~e->c) | (e->b & e->c); }
uint64_t word_and(const element *e) { return e->a & e->b; }
uint64_t word_or(const element *e) { return e->a | e->b; }
uint64_t word_xor(const element *e) { return e->a ^ e->b; }
uint64_t word_andc(const element *e) { return e->a & ~e->b; }
uint64_t word_orc(const element *e) { return e->a | ~e->b; }
uint64_t word_nand(const element *e) { return ~(e->a & e->b); }
uint64_t word_nor(const element *e) { return ~(e->a | e->b); }
uint64_t word_eqv(const element *e) { return ~(e->a ^ e->b); }

/* Shifts take one bit more of the count than rotations do: 5 of a halfword's, 6 of a word's. */
static int shift_count(uint64_t count, int bits) { return (int)(count & (2 * (unsigned)bits - 1)); }

static uint64_t shift_right(const element *e, int n) { return n < e->bits ? e->a >> n : 0; }

static uint64_t shift_right_sign(const element *e, int n)
{
    uint64_t value = e->a;
    for (int i = 0; i < n; i++) /* bit by bit: the sign bit stays and is copied */
        value = value >> 1 | (value & UINT64_C(1) << (e->bits - 1));
    return value;
}

uint64_t word_sl(const element *e)
{
    const int n = shift_count(e->b, e->bits);
    return n < e->bits ? e->a << n : 0;
}

uint64_t word_sr(const element *e) { return shift_right(e, shift_count(e->b, e->bits)); }
uint64_t word_sra(const element *e) { return shift_right_sign(e, shift_count(e->b, e->bits)); }
uint64_t word_rlmask(const element *e) { return shift_right(e, shift_count(0 - e->b, e->bits)); }
uint64_t word_rlmaska(const element *e) { return shift_right_sign(e, shift_count(0 - e->b, e->bits)); }

uint64_t word_rl(const element *e)
{
    const int n = (int)(e->b & ((unsigned)e->bits - 1));
    return n ? e->a << n | e->a >> (e->bits - n) : e->a;
}
