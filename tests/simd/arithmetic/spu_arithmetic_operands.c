/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Operands for the test of the SPU's arithmetic: the limits of its format, and random ones that cancel, underflow and
 * overflow far more often than random bits do. */
#include "simd/arithmetic/spu_arithmetic.h"

#define BOTH(a) (a), (a) | SIGN

const uint32_t edges[] = {
    BOTH(0x00000000),                                                       /* zero: exponent 0 with any fraction */
    BOTH(0x00000001), BOTH(0x00400000), BOTH(0x007fffff),                   /* denormals to the host, zeros to an SPU */
    BOTH(0x00800000), BOTH(0x00800001), BOTH(0x00ffffff), BOTH(0x01000000), /* the smallest */
    BOTH(0x1f800000), BOTH(0x20000000), BOTH(0x3f000000), BOTH(0x3f7fffff), /* squares at the smallest; up to one */
    BOTH(0x3f800000), BOTH(0x3f800001), BOTH(0x3fffffff), BOTH(0x40000000), /* one, two */
    BOTH(0x4effffff), BOTH(0x4f000000), BOTH(0x4f7fffff), BOTH(0x4f800000), /* 2^31, 2^32 */
    BOTH(0x5f800000), BOTH(0x5fffffff), BOTH(0x60000000), BOTH(0x7e800000), /* squares at the largest */
    BOTH(0x7f000000), BOTH(0x7f7ffffe), BOTH(0x7f7fffff),                   /* the host's largest */
    BOTH(0x7f800000), BOTH(0x7f800001), BOTH(0x7fc00000), BOTH(0x7ffffffe), BOTH(0x7fffffff), /* exponent 255 */
};
const uint32_t edge_count = TEST_COUNT(edges);

static uint32_t bits32(test_random *r) { return (uint32_t)(random_bits(r) >> 32); }

uint32_t random_fraction(test_random *r)
{
    const uint32_t bits = bits32(r) & 0x7fffff;
    switch (random_below(r, 6)) {
    case 0: return 0;
    case 1: return 0x7fffff;
    case 2: return UINT32_C(1) << random_below(r, 23);
    case 3: return bits & bits32(r) & bits32(r) & bits32(r); /* few ones */
    default: return bits;
    }
}

static uint32_t number(test_random *r, int exponent)
{
    const uint32_t e = exponent < 0 ? 0 : exponent > 255 ? 255 : (uint32_t)exponent;
    return (bits32(r) & SIGN) | e << 23 | random_fraction(r);
}

/* low .. high, both possible */
static int between(test_random *r, int low, int high) { return low + (int)random_below(r, (uint32_t)(high - low + 1)); }

/* a and b whose product has about that exponent */
static void product_of_exponent(test_random *r, int exponent, uint32_t bits[3])
{
    const int sum = exponent + 127, least = sum > 255 ? sum - 255 : 0, most = sum < 255 ? sum : 255;
    const int ea = least <= most ? between(r, least, most) : 255;
    bits[0] = number(r, ea);
    bits[1] = number(r, sum - ea);
}

/* a few units in the last place up or down, mostly none */
static uint32_t near(test_random *r, uint32_t a) { return random_below(r, 2) ? a : a + random_below(r, 5) - 2; }

void random_operands(test_random *r, uint32_t bits[3])
{
    for (int i = 0; i < 3; i++)
        bits[i] = bits32(r);
    switch (random_below(r, 8)) {
    case 0: break;
    case 1: /* sum of neighbours in size */
    case 2: {
        const int exponent = between(r, 0, 255);
        product_of_exponent(r, exponent, bits);
        bits[2] = number(r, exponent + between(r, -50, 50));
        break;
    }
    case 3: { /* c cancels the product, or most of it */
        product_of_exponent(r, between(r, 0, 260), bits);
        bits[2] = near(r, true_madd(bits[0], bits[1], 0) ^ (bits32(r) & SIGN));
        break;
    }
    case 4: { /* a and b cancel, or nearly */
        const int exponent = between(r, 0, 255);
        bits[0] = number(r, exponent);
        bits[1] = random_below(r, 2) ? near(r, bits[0] ^ SIGN) : number(r, exponent + between(r, -26, 26));
        break;
    }
    case 5: /* at the smallest */
        product_of_exponent(r, between(r, -30, 4), bits);
        bits[2] = number(r, between(r, 0, 30));
        break;
    case 6: /* at the largest, and beyond it with c taking the product back */
        product_of_exponent(r, between(r, 250, 260), bits);
        bits[2] = number(r, between(r, 230, 255));
        break;
    default:
        for (int i = 0; i < 3; i++)
            if (random_below(r, 2))
                bits[i] = edges[random_below(r, edge_count)];
    }
}
