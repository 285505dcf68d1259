/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the two halves of the definitions share: numbers in bits, and the list of the words that are defined by one
 * element. Only spu_reference*.c include it. */
#ifndef SPU_REFERENCE_PARTS_H
#define SPU_REFERENCE_PARTS_H

#include <string.h>

#include "simd/spu_quad.h"

/* ---- numbers in bits ---- */

static inline uint64_t low_bits(uint64_t value, int bits)
{
    return bits == 64 ? value : value & ((UINT64_C(1) << bits) - 1);
}

static inline bool is_negative(uint64_t value, int bits) { return value >> (bits - 1) & 1; }

/* The value of bits in two's complement. */
static inline int64_t signed_value(uint64_t value, int bits)
{
    const uint64_t sign = UINT64_C(1) << (bits - 1);
    value = (low_bits(value, bits) ^ sign) - sign;
    return value <= INT64_MAX ? (int64_t)value : -(int64_t)~value - 1;
}

static inline bool is_signed(spu_type type)
{
    return type == SPU_s8 || type == SPU_s16 || type == SPU_s32 || type == SPU_s64;
}

static inline float float_of(uint64_t bits)
{
    const uint32_t word = (uint32_t)bits;
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

static inline double double_of(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline uint64_t float_bits(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static inline uint64_t double_bits(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* Either float type as a number: float in double is exact. */
static inline double number_of(uint64_t bits, spu_type type)
{
    return type == SPU_f32 ? (double)float_of(bits) : double_of(bits);
}

/* ---- words defined by one element ---- */

/* One element: the bits of each operand's element (of a scalar its value), and the type of the first operand. The
 * result is cut to the result's width. */
typedef struct element {
    spu_type type;
    int bits;
    uint64_t a, b, c;
    bool is_fused;
} element;

typedef uint64_t element_definition(const element *e);

element_definition word_splats, word_add, word_sub, word_mul, element_madd, word_msub, word_nmsub, word_nmadd,
    word_addx, word_subx, word_genc, word_gencx, word_genb, word_genbx, word_re, word_rsqrte, word_absd, word_avg,
    word_convtf, word_convts, word_convtu, word_cmpeq, word_cmpgt, word_cmpabseq, word_cmpabsgt, word_testsv, word_cntb,
    word_cntlz, word_sel, word_and, word_or, word_xor, word_andc, word_orc, word_nand, word_nor, word_eqv, word_sl,
    word_sr, word_sra, word_rlmask, word_rlmaska, word_rl;

#endif
