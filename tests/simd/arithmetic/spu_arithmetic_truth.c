/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The reference for the SPU's model. Sums and fused operations: fixed point with room for every product of two numbers
 * and every sum with a third, so that nothing is aligned, rounded or lost. All else: doubles, where they are exact. */
#include "simd/arithmetic/spu_arithmetic.h"

#include <math.h>
#include <string.h>

/* Units of 2^-298, the lowest bit of the smallest product; the largest product is below 2^258. */
#define LIMBS 18
#define UNIT (-298)

typedef struct fixed {
    uint32_t limb[LIMBS]; /* lowest first */
} fixed;

static void add_bits(fixed *sum, uint64_t bits, int place)
{
    uint64_t carry = 0;
    for (int i = place / 32, part = 0; i < LIMBS; i++, part++) {
        const int down = 32 * part - place % 32;
        const uint64_t piece = down >= 64 ? 0 : down >= 0 ? bits >> down : bits << -down;
        carry += (uint64_t)sum->limb[i] + (uint32_t)piece;
        sum->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
}

static int compare(const fixed *a, const fixed *b)
{
    for (int i = LIMBS - 1; i >= 0; i--)
        if (a->limb[i] != b->limb[i])
            return a->limb[i] > b->limb[i] ? 1 : -1;
    return 0;
}

static fixed difference(const fixed *a, const fixed *b)
{
    fixed d;
    uint64_t borrow = 0;
    for (int i = 0; i < LIMBS; i++) {
        const uint64_t step = (uint64_t)a->limb[i] - b->limb[i] - borrow;
        d.limb[i] = (uint32_t)step;
        borrow = step >> 63;
    }
    return d;
}

static uint32_t bit(const fixed *a, int place) { return a->limb[place / 32] >> (place % 32) & 1; }

static uint32_t number_of(const fixed *a, uint32_t sign)
{
    int top = 32 * LIMBS - 1;
    while (top >= 0 && !bit(a, top))
        top--;
    const int exponent = top + UNIT + 127;
    if (top < 0 || exponent < 1)
        return 0;
    if (exponent > 255)
        return sign | LARGEST;
    uint32_t significand = 0;
    for (int place = top; place > top - 24; place--)
        significand = significand << 1 | bit(a, place);
    return sign | (uint32_t)exponent << 23 | (significand & 0x7fffff);
}

static uint64_t significand_of(uint32_t a) { return (a >> 23 & 255) ? (a & 0x7fffff) | 0x800000 : 0; }

/* ab + c, ab with the sign of its highest bit and its lowest bit at place_ab */
static uint32_t sum_of(uint64_t ab, uint32_t sign_ab, int place_ab, uint32_t c)
{
    fixed side[2]; /* sums of the positive and of the negative terms */
    memset(side, 0, sizeof side);
    if (ab)
        add_bits(&side[sign_ab >> 31], ab, place_ab);
    if (significand_of(c))
        add_bits(&side[c >> 31], significand_of(c), (int)(c >> 23 & 255) - 150 - UNIT);
    const int larger = compare(&side[0], &side[1]) >= 0 ? 0 : 1;
    const fixed sum = difference(&side[larger], &side[!larger]);
    return number_of(&sum, larger ? SIGN : 0);
}

uint32_t true_sum(uint32_t a, uint32_t b)
{
    return sum_of(significand_of(a), a & SIGN, (int)(a >> 23 & 255) - 150 - UNIT, b);
}

uint32_t true_madd(uint32_t a, uint32_t b, uint32_t c)
{
    const int place = (int)(a >> 23 & 255) + (int)(b >> 23 & 255) - 300 - UNIT;
    return sum_of(significand_of(a) * significand_of(b), (a ^ b) & SIGN, place, c);
}

double true_value(uint32_t a)
{
    const double magnitude = ldexp((double)significand_of(a), (int)(a >> 23 & 255) - 150);
    return a & SIGN ? -magnitude : magnitude;
}

uint32_t true_number(double a)
{
    const uint32_t sign = a < 0 ? SIGN : 0;
    int exponent;
    const double fraction = frexp(fabs(a), &exponent); /* 0.5 .. 1, or 0 */
    if (fraction == 0 || exponent + 126 < 1)
        return 0;
    if (exponent + 126 > 255)
        return sign | LARGEST;
    return sign | (uint32_t)(exponent + 126) << 23 | ((uint32_t)floor(ldexp(fraction, 24)) & 0x7fffff);
}
