/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Double precision in integers, see double.h. Every operation is a fused multiply-add: a + b is a * 1 + b, and a
 * product is a * b plus a zero of the product's sign. */
#include "cell/spu/execute/double.h"

#define SIGN 0x8000000000000000u
#define INFINITE 0x7ff0000000000000u
#define ONLY_NAN 0x7ff8000000000000u
#define ONE 0x3ff0000000000000u

/* ---- 128 bits ---- */

typedef struct wide {
    uint64_t high, low;
} wide;

static wide multiply(uint64_t a, uint64_t b)
{
    const uint64_t a0 = (uint32_t)a, a1 = a >> 32, b0 = (uint32_t)b, b1 = b >> 32;
    const uint64_t middle = a1 * b0 + (a0 * b0 >> 32), other = a0 * b1 + (uint32_t)middle;
    return (wide){a1 * b1 + (middle >> 32) + (other >> 32), other << 32 | (uint32_t)(a0 * b0)};
}
static wide add(wide a, wide b)
{
    const uint64_t low = a.low + b.low;
    return (wide){a.high + b.high + (low < a.low), low};
}
static wide subtract(wide a, wide b) { return (wide){a.high - b.high - (a.low < b.low), a.low - b.low}; }
static bool is_zero(wide a) { return (a.high | a.low) == 0; }
static bool is_less(wide a, wide b) { return a.high != b.high ? a.high < b.high : a.low < b.low; }
static int leading_zeros(wide a) { return a.high ? __builtin_clzll(a.high) : 64 + __builtin_clzll(a.low); }

static wide shift_left(wide a, int n)
{
    if (n >= 64)
        return (wide){a.low << (n - 64), 0};
    return n ? (wide){a.high << n | a.low >> (64 - n), a.low << n} : a;
}
/* What is shifted out sets the lowest bit, so that no rounding takes the result for exact. */
static wide shift_right_sticky(wide a, int64_t n)
{
    if (n >= 128)
        return (wide){0, !is_zero(a)};
    if (n >= 64) {
        const uint64_t lost = n > 64 ? a.high << (128 - n) : 0;
        return (wide){0, a.high >> (n - 64) | ((a.low | lost) != 0)};
    }
    if (n <= 0)
        return a;
    return (wide){a.high >> n, a.high << (64 - n) | a.low >> n | (a.low << (64 - n) != 0)};
}

/* (-1)^negative * magnitude * 2^scale */
typedef struct number {
    wide magnitude;
    int scale;
    bool negative;
} number;

/* ---- rounding ---- */

/* A format of the result: bits of its significand, exponent of its least normal number, its largest exponent. */
typedef struct format {
    int bits, least, most;
} format;

static const format double_format = {53, -1022, 1023}, single_format = {24, -126, 127};

static bool rounds_up(uint64_t kept, uint64_t rest, uint64_t half, bool negative, cgt_spu_rounding rounding)
{
    switch (rounding) {
    case CGT_SPU_TO_NEAREST: return rest > half || (rest == half && (kept & 1));
    case CGT_SPU_UPWARD: return rest && !negative;
    case CGT_SPU_DOWNWARD: return rest && negative;
    default: return false;
    }
}

/* Beyond the largest number: that number or infinity, as exponent and fraction. */
static uint64_t overflow(const format *f, bool negative, cgt_spu_rounding rounding)
{
    const uint64_t infinite = (uint64_t)(f->most * 2 + 1) << (f->bits - 1);
    const bool stays = rounding == CGT_SPU_TO_ZERO || rounding == (negative ? CGT_SPU_UPWARD : CGT_SPU_DOWNWARD);
    return infinite - stays;
}

/* The exponent and fraction of a nonzero number in a format, rounded. */
static uint64_t round_magnitude(number a, const format *f, cgt_spu_rounding rounding, uint32_t *flags)
{
    /* highest bit to position 127, then the significand to the bits from 63 - bits on, with 10 or more below it */
    const int up = leading_zeros(a.magnitude), exponent = 127 - up + a.scale;
    const bool tiny = exponent < f->least;
    const int drop = tiny ? f->least - exponent : 0;
    const wide top = shift_right_sticky(shift_left(a.magnitude, up), 65 + (int64_t)drop);
    const int below = 63 - f->bits; /* top.low has its highest bit at 62 where nothing was dropped */
    const uint64_t rest = top.low & (((uint64_t)1 << below) - 1), half = (uint64_t)1 << (below - 1);
    uint64_t kept = top.low >> below;
    if (rest)
        *flags |= CGT_SPU_DOUBLE_INEXACT | (tiny ? CGT_SPU_DOUBLE_UNDERFLOW : 0);
    kept += rounds_up(kept, rest, half, a.negative, rounding);
    /* the leading bit adds one to the exponent below it; a carry out of the significand does the same */
    const uint64_t biased = tiny ? 0 : (uint64_t)(exponent - f->least);
    const uint64_t result = (biased << (f->bits - 1)) + kept;
    if (exponent <= f->most && result >> (f->bits - 1) <= (uint64_t)f->most * 2)
        return result;
    *flags |= CGT_SPU_DOUBLE_OVERFLOW | CGT_SPU_DOUBLE_INEXACT;
    return overflow(f, a.negative, rounding);
}

/* ---- operands ---- */

static bool is_nan(uint64_t a) { return (a & ~SIGN) > INFINITE; }
static bool is_signalling(uint64_t a) { return is_nan(a) && !(a & 0x0008000000000000u); }
static bool is_infinite(uint64_t a) { return (a & ~SIGN) == INFINITE; }
static bool is_zero_double(uint64_t a) { return (a & ~SIGN) == 0; }

static uint64_t flush(uint64_t a, uint32_t *flags)
{
    if ((a & INFINITE) || is_zero_double(a))
        return a;
    *flags |= CGT_SPU_DOUBLE_DENORMAL;
    return a & SIGN;
}

/* The significand and the scale of a finite double that is no denormal. */
static uint64_t significand(uint64_t a)
{
    return is_zero_double(a) ? 0 : (a & 0x000fffffffffffffu) | 0x0010000000000000u;
}
static int scale_of(uint64_t a) { return (int)(a >> 52 & 0x7ff) - 1075; }

/* ---- the operation ---- */

/* The exact sum, but for a sticky lowest bit. Both have their highest bit at position 126 or are zero. Of a product 20
 * low bits are zeros, of a double 73, so bits are lost only where the scales differ by more than 20: then the sum has
 * its highest bit at 125 or above, and the sticky bit stays far below what is rounded. */
static number exact_sum(number a, number b)
{
    if (is_zero(a.magnitude) || is_zero(b.magnitude))
        return is_zero(a.magnitude) ? b : a;
    if (a.scale < b.scale) {
        const number c = a;
        a = b;
        b = c;
    }
    b.magnitude = shift_right_sticky(b.magnitude, (int64_t)a.scale - b.scale);
    if (a.negative == b.negative)
        a.magnitude = add(a.magnitude, b.magnitude);
    else if (is_less(a.magnitude, b.magnitude))
        a = (number){subtract(b.magnitude, a.magnitude), a.scale, b.negative};
    else
        a.magnitude = subtract(a.magnitude, b.magnitude);
    return a;
}

static number raise(number a)
{
    if (is_zero(a.magnitude))
        return a;
    const int up = leading_zeros(a.magnitude) - 1;
    return (number){shift_left(a.magnitude, up), a.scale - up, a.negative};
}

static uint64_t fused_finite(uint64_t a, uint64_t b, uint64_t c, cgt_spu_rounding rounding, uint32_t *flags)
{
    const bool product_negative = (a ^ b) >> 63, c_negative = c >> 63;
    const number product = {multiply(significand(a), significand(b)), scale_of(a) + scale_of(b), product_negative};
    const number addend = {{0, significand(c)}, scale_of(c), c_negative};
    const number sum = exact_sum(raise(product), raise(addend));
    if (is_zero(sum.magnitude)) {
        /* of two zeros of one sign that sign; else a difference that cancels: +0, or -0 downward */
        const bool both_zero = is_zero(product.magnitude) && is_zero(addend.magnitude);
        if (both_zero && product_negative == c_negative)
            return c & SIGN;
        return rounding == CGT_SPU_DOWNWARD ? SIGN : 0;
    }
    return (sum.negative ? SIGN : 0) | round_magnitude(sum, &double_format, rounding, flags);
}

uint64_t cgt_spu_double_fused(uint64_t a, uint64_t b, uint64_t c, cgt_spu_rounding rounding, uint32_t *flags)
{
    a = flush(a, flags);
    b = flush(b, flags);
    c = flush(c, flags);
    const bool bad_product = (is_infinite(a) && is_zero_double(b)) || (is_zero_double(a) && is_infinite(b));
    if (is_nan(a) || is_nan(b) || is_nan(c)) {
        *flags |= CGT_SPU_DOUBLE_NAN;
        if (is_signalling(a) || is_signalling(b) || is_signalling(c) || bad_product)
            *flags |= CGT_SPU_DOUBLE_INVALID;
        return ONLY_NAN;
    }
    const bool product_infinite = is_infinite(a) || is_infinite(b);
    if (bad_product || (product_infinite && is_infinite(c) && (a ^ b ^ c) >> 63)) {
        *flags |= CGT_SPU_DOUBLE_INVALID;
        return ONLY_NAN;
    }
    if (product_infinite)
        return ((a ^ b) & SIGN) | INFINITE;
    if (is_infinite(c))
        return c;
    return fused_finite(a, b, c, rounding, flags);
}

/* ---- registers ---- */

static uint64_t get(const cgt_spu_register *r, int i) { return (uint64_t)r->word[2 * i] << 32 | r->word[2 * i + 1]; }
static void put(cgt_spu_register *r, int i, uint64_t a)
{
    r->word[2 * i] = (uint32_t)(a >> 32);
    r->word[2 * i + 1] = (uint32_t)a;
}
static cgt_spu_rounding rounding_of(const uint32_t fpscr[4], int i)
{
    return (cgt_spu_rounding)(fpscr[0] >> (10 - 2 * i) & 3);
}

void cgt_spu_double_add(cgt_spu_register *rt, const cgt_spu_register *ra, const cgt_spu_register *rb, int subtracts,
                        uint32_t fpscr[4])
{
    for (int i = 0; i < 2; i++) {
        const uint64_t b = get(rb, i) ^ (subtracts ? SIGN : 0);
        put(rt, i, cgt_spu_double_fused(get(ra, i), ONE, b, rounding_of(fpscr, i), &fpscr[1 + i]));
    }
}

void cgt_spu_double_mul(cgt_spu_register *rt, const cgt_spu_register *ra, const cgt_spu_register *rb, uint32_t fpscr[4])
{
    for (int i = 0; i < 2; i++) {
        const uint64_t a = get(ra, i), b = get(rb, i);
        put(rt, i, cgt_spu_double_fused(a, b, (a ^ b) & SIGN, rounding_of(fpscr, i), &fpscr[1 + i]));
    }
}

void cgt_spu_double_madd(cgt_spu_register *rt, const cgt_spu_register *ra, const cgt_spu_register *rb, int subtracts,
                         int negate, uint32_t fpscr[4])
{
    for (int i = 0; i < 2; i++) {
        const uint64_t c = get(rt, i) ^ (subtracts ? SIGN : 0);
        const uint64_t sum = cgt_spu_double_fused(get(ra, i), get(rb, i), c, rounding_of(fpscr, i), &fpscr[1 + i]);
        put(rt, i, negate && !is_nan(sum) ? sum ^ SIGN : sum);
    }
}

/* ---- between the precisions ---- */

static uint64_t extend(uint32_t a, uint32_t *flags)
{
    const uint64_t sign = (uint64_t)(a >> 31) << 63, exponent = a >> 23 & 255, fraction = a & 0x7fffffu;
    if (exponent == 255 && fraction) {
        *flags |= CGT_SPU_DOUBLE_NAN | (fraction & 0x400000u ? 0 : CGT_SPU_DOUBLE_INVALID);
        return ONLY_NAN;
    }
    if (exponent == 255)
        return sign | INFINITE;
    if (exponent == 0) {
        *flags |= fraction ? CGT_SPU_DOUBLE_DENORMAL : 0;
        return sign;
    }
    return sign | (exponent + 1023 - 127) << 52 | fraction << 29;
}

static uint32_t round_to_single(uint64_t a, cgt_spu_rounding rounding, uint32_t *flags)
{
    if (is_nan(a)) {
        *flags |= CGT_SPU_DOUBLE_NAN | (is_signalling(a) ? CGT_SPU_DOUBLE_INVALID : 0);
        return 0x7fc00000u;
    }
    a = flush(a, flags);
    const uint32_t sign = (uint32_t)(a >> 63) << 31;
    if (is_zero_double(a))
        return sign;
    if (is_infinite(a))
        return sign | 0x7f800000u;
    const number n = {{0, significand(a)}, scale_of(a), a >> 63};
    return sign | (uint32_t)round_magnitude(n, &single_format, rounding, flags);
}

void cgt_spu_double_extend(cgt_spu_register *rt, const cgt_spu_register *ra, uint32_t fpscr[4])
{
    for (int i = 0; i < 2; i++)
        put(rt, i, extend(ra->word[2 * i], &fpscr[1 + i]));
}

void cgt_spu_double_round(cgt_spu_register *rt, const cgt_spu_register *ra, uint32_t fpscr[4])
{
    for (int i = 0; i < 2; i++)
        put(rt, i, (uint64_t)round_to_single(get(ra, i), rounding_of(fpscr, i), &fpscr[1 + i]) << 32);
}

/* Rounding of doubles in word 0, division by zero of floats in word 3, flags of doubles in words 1 and 2, flags of
 * floats in the lowest three bits of each (ISA 1.2, section 9.3). */
void cgt_spu_write_fpscr(uint32_t fpscr[4], const cgt_spu_register *ra)
{
    static const uint32_t exists[4] = {0x00000f07, 0x00003f07, 0x00003f07, 0x00000f07};
    for (int i = 0; i < 4; i++)
        fpscr[i] = ra->word[i] & exists[i];
}
