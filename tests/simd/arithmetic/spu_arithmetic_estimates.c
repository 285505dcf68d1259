/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPU's estimates for all 2^23 fractions: the words against the model, and the architecture's guarantees for the
 * estimate and for one step of Newton-Raphson after it. A scale below 1 skips fractions. */
#include "simd/arithmetic/spu_arithmetic.h"

#include <math.h>

#define FRACTIONS 0x800000u

/* Odd, so that its multiples have all low bits; from 1 on. */
static uint32_t stride(void)
{
    const uint32_t count = test_scaled(FRACTIONS);
    return count >= FRACTIONS ? 1 : (FRACTIONS / count) | 1;
}

/* ---- the words ---- */

void estimates_match_model_for_all_fractions(void **state)
{
    (void)state;
    test_random r = random_make(8);
    vec_uint4 a[BATCH];
    uint32_t numbers = 0;
    const uint32_t step = stride();
    for (uint32_t fraction = 0; fraction < FRACTIONS; fraction += step) {
        a[numbers / 4][numbers % 4] = ((uint32_t)random_bits(&r) & 0xff800000) | fraction;
        if (++numbers == 4 * BATCH || fraction + step >= FRACTIONS) {
            check1(&frest, a, (numbers + 3) / 4);
            check1(&frsqest, a, (numbers + 3) / 4);
            check1(&re, a, (numbers + 3) / 4);
            check1(&rsqrte, a, (numbers + 3) / 4);
            numbers = 0;
        }
    }
}

/* ---- the estimate alone ----
 *
 * The architecture leaves the accuracy of the bare estimates to the implementation; 12 bits are the language
 * extension's statement about spu_re and spu_rsqrte. The narrower bounds are those of this table, to three digits. */

static void widen(double range[2], double error)
{
    if (error < range[0])
        range[0] = error;
    if (error > range[1])
        range[1] = error;
}

void estimates_have_twelve_bits(void **state)
{
    (void)state;
    double of_re[2] = {0, 0}, of_rsqrte[2][2] = {{0, 0}, {0, 0}};
    const uint32_t step = stride();
    for (uint32_t fraction = 0; fraction < FRACTIONS; fraction += step) {
        const uint32_t odd = ONE | fraction, even = odd + SMALLEST; /* 1 .. 2, 2 .. 4 */
        widen(of_re, true_value(re.model(odd, 0, 0, 0)) * true_value(odd) - 1);
        widen(of_rsqrte[0], true_value(rsqrte.model(odd, 0, 0, 0)) * sqrt(true_value(odd)) - 1);
        widen(of_rsqrte[1], true_value(rsqrte.model(even, 0, 0, 0)) * sqrt(true_value(even)) - 1);
    }
    printf("relative error of re %.3g .. %.3g, of rsqrte %.3g .. %.3g (1 to 2), %.3g .. %.3g (2 to 4)\n", of_re[0],
           of_re[1], of_rsqrte[0][0], of_rsqrte[0][1], of_rsqrte[1][0], of_rsqrte[1][1]);
    assert_true(of_re[0] >= -2.105e-4 && of_re[1] <= 1.825e-4);
    for (int i = 0; i < 2; i++) {
        const double bound = i == 0 ? 1.445e-4 : 1.715e-4;
        assert_true(of_rsqrte[i][0] >= -bound && of_rsqrte[i][1] <= bound);
    }
    assert_true(-of_re[0] < 0x1p-12 && of_re[1] < 0x1p-12);
}

/* ---- after one step ---- */

/* ISA page 215: frest, fi, fnms, fma */
static uint32_t reciprocal(uint32_t x)
{
    const uint32_t y1 = re.model(x, 0, 0, 0), t = cgt_spu_model_nmsub(x, y1, ONE);
    return cgt_spu_model_madd(t, y1, y1);
}

/* ISA page 217: frsqest, and, fi, fm, fm, fnms, fma */
static uint32_t reciprocal_root(uint32_t x)
{
    const uint32_t magnitude = x & ~SIGN, y1 = cgt_spu_model_fi(magnitude, cgt_spu_model_frsqest(x));
    const uint32_t t1 = cgt_spu_model_mul(magnitude, y1), t2 = cgt_spu_model_mul(y1, HALF);
    return cgt_spu_model_madd(cgt_spu_model_nmsub(t1, y1, ONE), t2, y1);
}

/* ISA page 216: with Y the largest number for which x * Y < 1, the result is Y or the one below. */
void reciprocal_after_one_step(void **state)
{
    (void)state;
    uint32_t exact = 0, one_below = 0;
    const uint32_t step = stride();
    for (uint32_t fraction = 0; fraction < FRACTIONS; fraction += step) {
        const uint64_t x = 0x800000 | fraction;                   /* units of 2^-23 */
        const uint64_t y = ((UINT64_C(1) << 47) + x - 1) / x - 1; /* of 2^-24: x * y < 2^47 */
        const uint32_t best = 0x3f000000 | ((uint32_t)y & 0x7fffff), got = reciprocal(ONE | fraction);
        assert_true(y >> 23 == 1);
        if (got != best && got != best - 1)
            fail_msg("reciprocal of %08x: %08x, expected %08x or one less", ONE | fraction, got, best);
        exact += got == best;
        one_below += got != best;
    }
    printf("reciprocal: %u exact, %u one below\n", exact, one_below);
    if (step == 1) { /* what these tables give: any other bit of one would change a count */
        assert_int_equal(exact, 7780254);
        assert_int_equal(one_below, 608354);
    }
    assert_int_equal(reciprocal(ONE), 0x3f7fffff);
    assert_int_equal(reciprocal(0x40000000), 0x3effffff);
    assert_int_equal(reciprocal(0x40400000), 0x3eaaaaaa);
    assert_int_equal(reciprocal(0), LARGEST); /* ISA page 215 */
    assert_int_equal(reciprocal(SIGN), SIGN | LARGEST);
    assert_int_equal(reciprocal(0x00400000), LARGEST);
    assert_int_equal(reciprocal(0x7e800000), 0); /* ISA page 216: 2^126 and above */
    assert_int_equal(reciprocal(LARGEST), 0);
    assert_int_equal(cgt_spu_model_mul(0, reciprocal(0)), 0); /* 0 / 0 in a slab test: no NaN */
}

/* Whether x * n^2 < 1: x in units of 2^-23, below 2^25 of them; n in units of 2^-24, at most 2^24 of them. The product
 * has more than 64 bits, but its lowest 24 do not matter. */
static bool is_below_root(uint64_t x, uint64_t n)
{
    const uint64_t square = n * n;
    return x * (square >> 24) + (x * (square & 0xffffff) >> 24) < UINT64_C(1) << 47;
}

/* ISA page 218: with Y the largest number for which x * Y^2 < 1, the result is at most one unit in the last place from
 * Y. */
void root_after_one_step(void **state)
{
    (void)state;
    uint32_t count[3] = {0, 0, 0}; /* one below, exact, one above */
    const uint32_t step = stride();
    for (uint32_t fraction = 0; fraction < FRACTIONS; fraction += step)
        for (uint32_t exponent = 127; exponent < 129; exponent++) {
            const uint32_t bits = exponent << 23 | fraction, got = reciprocal_root(bits);
            const uint64_t x = (UINT64_C(0x800000) | fraction) << (exponent - 127);
            uint64_t y = (uint64_t)(0x1p24 / sqrt(true_value(bits))); /* the double is close enough to start from */
            while (is_below_root(x, y + 1))
                y++;
            while (!is_below_root(x, y))
                y--;
            const uint32_t best = 0x3f000000 | ((uint32_t)y & 0x7fffff), place = got - best + 1;
            assert_true(y >> 23 == 1);
            if (place > 2)
                fail_msg("reciprocal root of %08x: %08x, expected %08x", bits, got, best);
            count[place]++;
        }
    printf("reciprocal root: %u one below, %u exact, %u one above\n", count[0], count[1], count[2]);
    if (step == 1) {
        assert_int_equal(count[0], 267652);
        assert_int_equal(count[1], 13268006);
        assert_int_equal(count[2], 3241558);
    }
    assert_int_equal(reciprocal_root(ONE), 0x3f7fffff);
    assert_int_equal(reciprocal_root(SIGN | ONE), 0x3f7fffff); /* of the magnitude */
}

/* ISA page 217: of a number with exponent 0 the result is the largest number while the fraction is at most 0x000ff53c,
 * and at least 0x7fc00000 beyond. There t1 is 0, so the result is 1.5 times the line's value: the place where that
 * passes the largest number depends on the table and on every bit of fi. */
void root_of_zero_exponent_after_one_step(void **state)
{
    (void)state;
    const uint32_t step = stride();
    for (uint32_t fraction = 0; fraction < FRACTIONS; fraction += step) {
        const uint32_t got = reciprocal_root(fraction);
        if (fraction <= 0x000ff53c)
            assert_int_equal(got, LARGEST);
        else
            assert_true(got >= 0x7fc00000 && got < LARGEST);
    }
    assert_int_equal(reciprocal_root(0x000ff53c), LARGEST);
    assert_int_not_equal(reciprocal_root(0x000ff53d), LARGEST);
}
