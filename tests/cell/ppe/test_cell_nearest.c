/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sums to nearest made of truncated ones (grid_nearest.h), compared with doubles: operands of all distances of their
 * exponents, whose bits are random, few, or all ones, so that ties and carries are frequent. */
#include <math.h>
#include <string.h>

#include "cell/programs/grid/grid_nearest.h"
#include "support/suite.h"
#include "support/test.h"

static float float_of(uint32_t bits)
{
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Mantissas that make sums tie, carry and cancel. */
static uint32_t mantissa(test_random *r)
{
    const uint32_t bits = (uint32_t)random_bits(r), shift = bits >> 27;
    switch (bits & 7) {
    case 0: return 0;
    case 1: return 0x7fffff;
    case 2: return 1u << shift % 23;
    case 3: return 0x7fffff & ~(1u << shift % 23);
    case 4: return 0x7fffff & (0x7fffffu << shift % 23);
    case 5: return (1u << shift % 23) - 1;
    default: return (uint32_t)random_bits(r) & 0x7fffff;
    }
}

static float operand(test_random *r, uint32_t exponent)
{
    return float_of((uint32_t)(random_bits(r) & 1) << 31 | exponent << 23 | mantissa(r));
}

static void check(float a, float b)
{
    const float expected = (float)((double)a + (double)b);
    const float found = spu_extract(grid_add_nearest(spu_splats(a), spu_splats(b)), 0);
    if (found != expected)
        fail_msg("%a + %a: %a, not %a", (double)a, (double)b, (double)found, (double)expected);
}

TEST(sums)
{
    test_random r = random_make(3101);
    const uint32_t count = test_scaled(400000);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t high = 100 + (uint32_t)random_bits(&r) % 40, apart = (uint32_t)random_bits(&r) % 30;
        const float a = operand(&r, high), b = operand(&r, high - apart);
        check(a, b);
        check(b, a);
        check(a, -a);
    }
}

/* At the limit, and with zeros and numbers far below. */
TEST(limits)
{
    test_random r = random_make(3102);
    const uint32_t least = 127 - 70;
    for (unsigned k = 0; k < 100000; k++) {
        const float a = operand(&r, least + (uint32_t)random_bits(&r) % 3);
        check(a, operand(&r, least + (uint32_t)random_bits(&r) % 30));
        check(a, 0);
        check(0, a);
        check(a, float_of((uint32_t)random_bits(&r) % 2 << 31 | least << 23));
    }
    check(0, 0);
}

SEEDED_SUITE("test_cell_nearest", NULL, NULL)
