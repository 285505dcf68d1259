/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words of the SPU's arithmetic against the model: all pairs of edge values, every difference of exponents,
 * random operands. */
#include "simd/arithmetic/spu_arithmetic.h"

/* ---- batches ---- */

typedef struct batch {
    vec_uint4 a[BATCH], b[BATCH], c[BATCH];
    uint32_t numbers;
} batch;

static void check_batch(batch *x)
{
    static const word *const two[] = {&add, &sub, &mul, &cmpgt, &cmpeq, &cmpabsgt, &cmpabseq};
    static const word *const three[] = {&madd, &msub, &nmsub};
    const uint32_t vectors = (x->numbers + 3) / 4; /* the rest of the last vector is from an earlier batch, or zero */
    x->numbers = 0;                                /* now: a failing check does not return */
    for (size_t i = 0; i < TEST_COUNT(two); i++)
        check2(two[i], x->a, x->b, vectors);
    for (size_t i = 0; i < TEST_COUNT(three); i++)
        check3(three[i], x->a, x->b, x->c, vectors);
}

static void put(batch *x, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t i = x->numbers++;
    x->a[i / 4][i % 4] = a;
    x->b[i / 4][i % 4] = b;
    x->c[i / 4][i % 4] = c;
    if (x->numbers == 4 * BATCH)
        check_batch(x);
}

static batch work;

/* ---- arithmetic and comparison ---- */

void words_match_model_on_edges(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < edge_count; i++)
        for (uint32_t j = 0; j < edge_count; j++)
            for (uint32_t k = 0; k < edge_count; k++)
                put(&work, edges[i], edges[j], edges[k]);
    check_batch(&work);
    for (uint32_t i = 0; i < edge_count; i++)
        for (uint32_t j = 0; j < edge_count; j++) {
            const vec_uint4 a = {edges[i], edges[j], edges[i], edges[j]};
            const vec_uint4 b = {edges[i], edges[i], edges[j], edges[j]};
            check2(&fi, &a, &b, 1);
            check1(&frest, &a, 1);
            check1(&frsqest, &a, 1);
        }
}

/* a and b are gap apart, by all signs; and so are the product of a and a number near one and c = b. */
static void put_gap(test_random *r, uint32_t gap, uint32_t fraction_a, uint32_t fraction_b)
{
    const uint32_t low = random_below(r, 256 - gap), high = low + gap;
    const uint32_t factor = random_below(r, 2) ? ONE : ONE | random_fraction(r);
    for (uint32_t signs = 0; signs < 4; signs++) {
        const uint32_t a = signs << 31 | high << 23 | fraction_a, b = signs >> 1 << 31 | low << 23 | fraction_b;
        put(&work, a, b, b);
        put(&work, b, a, a);
        put(&work, a, factor, b);
        put(&work, factor, b, a);
    }
}

void words_match_model_at_all_exponent_gaps(void **state)
{
    (void)state;
    static const uint32_t fractions[] = {0, 1, 0x400000, 0x7ffffe, 0x7fffff};
    test_random r = random_make(4);
    for (uint32_t gap = 0; gap < 256; gap++) {
        for (size_t i = 0; i < TEST_COUNT(fractions); i++)
            for (size_t j = 0; j < TEST_COUNT(fractions); j++)
                put_gap(&r, gap, fractions[i], fractions[j]);
        for (uint32_t i = test_scaled(200); i > 0; i--)
            put_gap(&r, gap, random_fraction(&r), random_fraction(&r));
    }
    check_batch(&work);
}

/* ten words each */
void words_match_model_on_random_operands(void **state)
{
    (void)state;
    test_random r = random_make(5);
    for (uint32_t i = test_scaled(1500000); i > 0; i--) {
        uint32_t bits[3];
        random_operands(&r, bits);
        put(&work, bits[0], bits[1], bits[2]);
    }
    check_batch(&work);
}

/* ---- conversion ---- */

void conversions_match_model_at_all_scales(void **state)
{
    (void)state;
    test_random r = random_make(6);
    for (int n = 0; n < 128; n++) {
        vec_uint4 number[BATCH], whole[BATCH];
        const uint32_t vectors = BATCH;
        for (uint32_t i = 0; i < 4 * vectors; i++) {
            const uint32_t bits = (uint32_t)random_bits(&r), magnitude = bits >> random_below(&r, 32);
            /* edges; any bits; numbers that come out near 2^-3 to 2^34 */
            number[i / 4][i % 4] = i < edge_count ? edges[i]
                                   : i % 2        ? bits
                                           : (bits & 0x807fffff) | (125u + (i >> 1) % 37 - (uint32_t)n % 125) << 23;
            whole[i / 4][i % 4] = i < edge_count ? edges[i] : i % 2 ? magnitude : 0 - magnitude;
        }
        check_scaled(&convts, number, n, vectors);
        check_scaled(&convtu, number, n, vectors);
        check_scaled(&convtf_s32, whole, n, vectors);
        check_scaled(&convtf_u32, whole, n, vectors);
    }
}

/* ---- lines: b of any bits, not only those that the tables have ---- */

void lines_match_model(void **state)
{
    (void)state;
    test_random r = random_make(7);
    vec_uint4 a[BATCH], b[BATCH];
    for (uint32_t round = test_scaled(150); round > 0; round--) {
        for (uint32_t i = 0; i < 4 * BATCH; i++) {
            const uint64_t bits = random_bits(&r);
            const uint32_t step = i % 4 == 1 ? 1023 : 0, y = i % 8 == 1 ? 0x7ffff : 0;
            const uint32_t exponent = i % 16 < 8 ? (uint32_t)bits >> 23 & 255 : (i % 16 < 12 ? i % 2 : 255 - i % 2);
            a[i / 4][i % 4] = (uint32_t)(bits >> 32) | y;
            b[i / 4][i % 4] = ((uint32_t)bits & 0x807fffff) | exponent << 23 | step;
            if (i % 32 == 5)
                b[i / 4][i % 4] &= 0xff8003ff; /* base 0: the value falls below one */
        }
        check2(&fi, a, b, BATCH);
    }
}
