/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPU's single precision in integers: the reference for spu_exact.h, and its fallback where the host's floats do
 * not suffice. Bits in, bits out; no floating-point operation, so that no rounding mode, compiler or host changes a
 * result.
 *
 *   cgt_spu_model_add(a, b), sub, mul          a + b, a - b, a * b
 *   cgt_spu_model_madd(a, b, c), msub, nmsub   a * b + c, a * b - c, c - a * b
 *   cgt_spu_model_cmpgt(a, b), cmpeq           all ones where true, else zero
 *   cgt_spu_model_cmpabsgt(a, b), cmpabseq     likewise, of the absolute values
 *   cgt_spu_model_convtf_s32(i, n), _u32       i / 2^n, n from 0 to 127
 *   cgt_spu_model_convts(a, n), convtu         a * 2^n as a signed and an unsigned integer, n from 0 to 127
 *   cgt_spu_model_frest(a), frsqest            base and step of a line near 1 / a and 1 / sqrt(|a|)
 *   cgt_spu_model_fi(a, b)                     the value of line b at a
 *
 * The numbers: a sign, 8 bits of exponent, 23 of fraction, as in IEEE 754, but exponent 255 is a binade like any other
 * and exponent 0 is zero whatever the fraction. So there are no infinities, NaN or denormals: the numbers go from
 * 2^-126 (0x00800000) to (2 - 2^-23) * 2^128 (0x7fffffff). A result is the exact one, truncated; beyond the largest
 * number it is the largest, below the smallest it is zero, and a zero result is always +0. Multiply-adds are fused, and
 * their products have no range limits.
 *
 * Source: Synergistic Processor Unit Instruction Set Architecture, version 1.2 (2007), section 9, pages 195 to 234. */
#ifndef CGT_SPU_FLOAT_MODEL_H
#define CGT_SPU_FLOAT_MODEL_H

#include <stdint.h>

#define CGT_SPU_MODEL static inline __attribute__((unused))
#define CGT_SPU_MODEL_SIGN 0x80000000u
#define CGT_SPU_MODEL_LARGEST 0x7fffffffu

/* (-1)^negative * magnitude * 2^scale; no limits of range. */
typedef struct cgt_spu_model_number {
    uint64_t magnitude;
    int scale;
    uint32_t negative;
} cgt_spu_model_number;

CGT_SPU_MODEL cgt_spu_model_number cgt_spu_model_unpack(uint32_t a)
{
    const uint32_t exponent = a >> 23 & 255, fraction = a & 0x7fffffu;
    return (cgt_spu_model_number){exponent ? 0x800000u | fraction : 0, (int)exponent - 150, a >> 31};
}

/* The position of the highest bit; not for 0. */
CGT_SPU_MODEL int cgt_spu_model_top(uint64_t magnitude) { return 63 - __builtin_clzll(magnitude); }

CGT_SPU_MODEL uint32_t cgt_spu_model_pack(cgt_spu_model_number a)
{
    if (a.magnitude == 0)
        return 0;
    const int top = cgt_spu_model_top(a.magnitude), exponent = top + a.scale + 127;
    if (exponent < 1)
        return 0;
    if (exponent > 255)
        return a.negative << 31 | CGT_SPU_MODEL_LARGEST;
    const uint64_t bits = top > 23 ? a.magnitude >> (top - 23) : a.magnitude << (23 - top);
    return a.negative << 31 | (uint32_t)exponent << 23 | ((uint32_t)bits & 0x7fffffu);
}

/* ---- arithmetic ---- */

/* Moves the highest bit to position 61, which leaves room for a sum. A magnitude of up to 48 bits keeps 14 zeros below
 * it. */
CGT_SPU_MODEL cgt_spu_model_number cgt_spu_model_raise(cgt_spu_model_number a)
{
    const int up = 61 - cgt_spu_model_top(a.magnitude);
    return (cgt_spu_model_number){a.magnitude << up, a.scale - up, a.negative};
}

/* a + b, truncated; one magnitude of at most 48 bits, one of at most 24.
 *
 * The smaller one is shifted to the scale of the larger one. The lost bits are less than a unit of the sum's lowest
 * position, and lower the floor of the sum by one where they are subtracted. The floor suffices: bits are lost only
 * where the two are at least 2^14 apart, so the sum keeps 60 of its 62 bits, of which 24 remain. */
CGT_SPU_MODEL uint32_t cgt_spu_model_sum(cgt_spu_model_number a, cgt_spu_model_number b)
{
    if (a.magnitude == 0 || b.magnitude == 0)
        return cgt_spu_model_pack(a.magnitude ? a : b);
    const cgt_spu_model_number ra = cgt_spu_model_raise(a), rb = cgt_spu_model_raise(b);
    const int a_is_larger = ra.scale != rb.scale ? ra.scale > rb.scale : ra.magnitude >= rb.magnitude;
    const cgt_spu_model_number large = a_is_larger ? ra : rb, small = a_is_larger ? rb : ra;
    const int down = large.scale - small.scale;
    const uint64_t kept = down < 64 ? small.magnitude >> down : 0;
    const int lost = down >= 64 || kept << down != small.magnitude;
    const uint64_t sum =
        large.negative == small.negative ? large.magnitude + kept : large.magnitude - kept - (lost ? 1 : 0);
    return cgt_spu_model_pack((cgt_spu_model_number){sum, large.scale, large.negative});
}

CGT_SPU_MODEL cgt_spu_model_number cgt_spu_model_product(uint32_t a, uint32_t b)
{
    const cgt_spu_model_number na = cgt_spu_model_unpack(a), nb = cgt_spu_model_unpack(b);
    return (cgt_spu_model_number){na.magnitude * nb.magnitude, na.scale + nb.scale, na.negative ^ nb.negative};
}

CGT_SPU_MODEL uint32_t cgt_spu_model_add(uint32_t a, uint32_t b)
{
    return cgt_spu_model_sum(cgt_spu_model_unpack(a), cgt_spu_model_unpack(b));
}
CGT_SPU_MODEL uint32_t cgt_spu_model_sub(uint32_t a, uint32_t b)
{
    return cgt_spu_model_add(a, b ^ CGT_SPU_MODEL_SIGN);
}
CGT_SPU_MODEL uint32_t cgt_spu_model_mul(uint32_t a, uint32_t b)
{
    return cgt_spu_model_pack(cgt_spu_model_product(a, b));
}
CGT_SPU_MODEL uint32_t cgt_spu_model_madd(uint32_t a, uint32_t b, uint32_t c)
{
    return cgt_spu_model_sum(cgt_spu_model_product(a, b), cgt_spu_model_unpack(c));
}
CGT_SPU_MODEL uint32_t cgt_spu_model_msub(uint32_t a, uint32_t b, uint32_t c)
{
    return cgt_spu_model_madd(a, b, c ^ CGT_SPU_MODEL_SIGN);
}
CGT_SPU_MODEL uint32_t cgt_spu_model_nmsub(uint32_t a, uint32_t b, uint32_t c)
{
    return cgt_spu_model_madd(a ^ CGT_SPU_MODEL_SIGN, b, c);
}

/* ---- comparison ---- */

/* Maps to integers in the order of the numbers; all zeros are equal. */
CGT_SPU_MODEL int32_t cgt_spu_model_key(uint32_t a)
{
    const int32_t magnitude = (int32_t)(a & CGT_SPU_MODEL_LARGEST);
    if (magnitude < 0x00800000)
        return 0;
    return a >> 31 ? -magnitude : magnitude;
}
CGT_SPU_MODEL uint32_t cgt_spu_model_cmpgt(uint32_t a, uint32_t b)
{
    return cgt_spu_model_key(a) > cgt_spu_model_key(b) ? UINT32_MAX : 0;
}
CGT_SPU_MODEL uint32_t cgt_spu_model_cmpeq(uint32_t a, uint32_t b)
{
    return cgt_spu_model_key(a) == cgt_spu_model_key(b) ? UINT32_MAX : 0;
}
CGT_SPU_MODEL uint32_t cgt_spu_model_cmpabsgt(uint32_t a, uint32_t b)
{
    return cgt_spu_model_cmpgt(a & CGT_SPU_MODEL_LARGEST, b & CGT_SPU_MODEL_LARGEST);
}
CGT_SPU_MODEL uint32_t cgt_spu_model_cmpabseq(uint32_t a, uint32_t b)
{
    return cgt_spu_model_cmpeq(a & CGT_SPU_MODEL_LARGEST, b & CGT_SPU_MODEL_LARGEST);
}

/* ---- conversion ---- */

CGT_SPU_MODEL uint32_t cgt_spu_model_convtf_u32(uint32_t i, int n)
{
    return cgt_spu_model_pack((cgt_spu_model_number){i, -n, 0});
}
CGT_SPU_MODEL uint32_t cgt_spu_model_convtf_s32(uint32_t i, int n)
{
    return cgt_spu_model_pack((cgt_spu_model_number){i >> 31 ? 0u - i : i, -n, i >> 31});
}

/* |a| * 2^n without its fraction; 2^32 stands for all larger values. */
CGT_SPU_MODEL uint64_t cgt_spu_model_whole(uint32_t a, int n)
{
    const cgt_spu_model_number number = cgt_spu_model_unpack(a);
    const int up = number.scale + n;
    if (up <= -24)
        return 0;
    if (up < 0)
        return number.magnitude >> -up;
    if (number.magnitude == 0)
        return 0;
    return up > 8 ? UINT64_C(1) << 32 : number.magnitude << up;
}
CGT_SPU_MODEL uint32_t cgt_spu_model_convtu(uint32_t a, int n)
{
    const uint64_t whole = a >> 31 ? 0 : cgt_spu_model_whole(a, n);
    return whole > UINT32_MAX ? UINT32_MAX : (uint32_t)whole;
}
CGT_SPU_MODEL uint32_t cgt_spu_model_convts(uint32_t a, int n)
{
    const uint64_t whole = cgt_spu_model_whole(a, n);
    if (a >> 31)
        return whole > CGT_SPU_MODEL_SIGN ? CGT_SPU_MODEL_SIGN : 0u - (uint32_t)whole;
    return whole > CGT_SPU_MODEL_LARGEST ? CGT_SPU_MODEL_LARGEST : (uint32_t)whole;
}

/* ---- estimates ----
 *
 * frest and frsqest return a line encoded as a number: sign, exponent, 13 bits of base, 10 of step. fi evaluates it:
 * the base less the step times the bits of the operand that did not select the line, and one that did:
 *
 *   (-1)^S * (1.base - 0.000step * Y) * 2^(E - 127)    Y = 0.(fraction bits 18..0)
 *
 * Bases and steps, by the upper 5 bits of the fraction, and by the lowest bit of the exponent and the upper 5 bits of
 * the fraction. They are facts of the hardware: no formula gives them, and the architecture leaves them to the
 * implementation. The values are those of RPCS3 (rpcs3/Emu/Cell/SPUThread.cpp: spu_frest_fraction_lut and
 * spu_frsqest_fraction_lut, which its authors compared with a console's results); ps3recomp (runtime/spu/spu_helpers.h)
 * has the same. They satisfy the architecture's statements about one step of Newton-Raphson for every fraction. */
static const uint32_t cgt_spu_model_frest_lines[32] = {
    0x7ffbe0, 0x7f87a6, 0x70ef72, 0x708b40, 0x638b12, 0x633aea, 0x5792c4, 0x574aa0, 0x4cca7e, 0x4c9262, 0x430a44,
    0x42d62a, 0x3a2e12, 0x39fdfa, 0x3215e4, 0x31f1d2, 0x2aa9be, 0x2a85ac, 0x23d59a, 0x23bd8e, 0x1d8576, 0x1d8576,
    0x17ad5a, 0x17ad5a, 0x124543, 0x124543, 0x0d392d, 0x0d392d, 0x08851a, 0x08851a, 0x041d07, 0x041d07};

static const uint32_t cgt_spu_model_frsqest_lines[64] = {
    /* even exponent */
    0x350160, 0x34e954, 0x2f993d, 0x2f993d, 0x2aa523, 0x2aa523, 0x26190d, 0x26190d, 0x21e4f9, 0x21e4f9, 0x1e00e9,
    0x1e00e9, 0x1a5cd9, 0x1a5cd9, 0x16f8cb, 0x16f8cb, 0x13ccc0, 0x13ccc0, 0x10ccb3, 0x10ccb3, 0x0e00aa, 0x0e00aa,
    0x0b58a1, 0x0b58a1, 0x08d498, 0x08d498, 0x067491, 0x067491, 0x043089, 0x043089, 0x020c83, 0x020c83,
    /* odd exponent */
    0x7ffdf4, 0x7fd1de, 0x7859c8, 0x783dba, 0x71559c, 0x71559c, 0x6ae57c, 0x6ae57c, 0x64f561, 0x64f561, 0x5f7149,
    0x5f7149, 0x5a4d33, 0x5a4d33, 0x55811f, 0x55811f, 0x51050f, 0x51050f, 0x4cc8fe, 0x4cc8fe, 0x48d0f0, 0x48d0f0,
    0x4510e4, 0x4510e4, 0x4180d7, 0x4180d7, 0x3e24cc, 0x3e24cc, 0x3af4c3, 0x3af4c3, 0x37e8ba, 0x37e8ba};

/* The line of zero has the largest exponent: its estimate is 2^128 times the line's value. Where 1 / a is too small to
 * be represented, the exponent is 0. */
CGT_SPU_MODEL uint32_t cgt_spu_model_frest(uint32_t a)
{
    const uint32_t exponent = a >> 23 & 255;
    const uint32_t line_exponent = exponent == 0 ? 255 : exponent < 253 ? 253 - exponent : 0;
    return (a & CGT_SPU_MODEL_SIGN) | line_exponent << 23 | cgt_spu_model_frest_lines[a >> 18 & 31];
}

CGT_SPU_MODEL uint32_t cgt_spu_model_frsqest(uint32_t a)
{
    const uint32_t exponent = a >> 23 & 255;
    const uint32_t line_exponent = exponent == 0 ? 255 : 190 - (exponent + 1) / 2;
    return line_exponent << 23 | cgt_spu_model_frsqest_lines[a >> 18 & 63];
}

/* In units of 2^-32: the base has 13 bits of fraction, the step ends 13 places after the point, Y has 19. */
CGT_SPU_MODEL uint32_t cgt_spu_model_fi(uint32_t a, uint32_t b)
{
    const uint64_t base = 8192 | (b >> 10 & 8191), step = b & 1023, y = a & 0x7ffffu;
    const int exponent = (int)(b >> 23 & 255);
    return cgt_spu_model_pack((cgt_spu_model_number){(base << 19) - step * y, exponent - 127 - 32, b >> 31});
}

#endif
