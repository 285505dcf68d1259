/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPU's single precision: the integer model against the architecture's literal results and against the truth, and
 * the words of the variant that this is compiled for against the model, bit by bit. This file: literals and truth. The
 * rest is in spu_arithmetic_*.c. */
#include "simd/arithmetic/spu_arithmetic.h"

#include <math.h>

/* ---- literals ----
 *
 * "ISA" is Synergistic Processor Unit Instruction Set Architecture, version 1.2, section 9; where no page is named, the
 * vector follows by hand from its pages 195 to 199 (the format) or from the page of the instruction. */

static vec_uint4 all(uint32_t a) { return (vec_uint4){a, a, a, a}; }

/* Both the model and the word, in each element. */
static void expect(const word *w, uint32_t a, uint32_t b, uint32_t c, int n, uint32_t expected)
{
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    const vec_uint4 got = w->compute(all(a), all(b), all(c), n);
    cgt_spu_leave_arithmetic(saved);
    const uint32_t model = w->model(a, b, c, n);
    if (model != expected)
        fail_msg("model of %s: %08x, expected %08x", w->name, model, expected);
    for (int i = 0; i < 4; i++)
        if (got[i] != expected)
            fail_msg("%s, element %d: %08x, expected %08x", w->name, i, got[i], expected);
}
#define expect1(w, a, expected) expect(w, a, 0, 0, 0, expected)
#define expect2(w, a, b, expected) expect(w, a, b, 0, 0, expected)
#define expect3(w, a, b, c, expected) expect(w, a, b, c, 0, expected)
#define expect_scaled(w, a, n, expected) expect(w, a, 0, 0, n, expected)

/* ISA pages 195 to 199: the range is 2^-126 to (2 - 2^-23) * 2^128, zero is +0, results are truncated */
static void literal_sums_and_products(void **state)
{
    (void)state;
    expect2(&add, ONE, 0x33ffffff, ONE); /* 1 + less than an ulp */
    expect2(&add, ONE, 0x34000000, 0x3f800001);
    expect2(&sub, ONE, 0x00800000, 0x3f7fffff);        /* 1 - the smallest, truncated */
    expect2(&add, 0xbf800000, 0x33ffffff, 0xbf7ffffe); /* towards zero on the negative side too */
    expect2(&mul, 0x3dcccccd, 0x40400000, 0x3e999999); /* 0.1f * 3 = 0.3000000045 */
    expect2(&add, 0x7f800000, 0x7f000000, 0x7fc00000); /* exponent 255 is a binade */
    expect2(&sub, LARGEST, 0x7f800000, 0x7f7ffffe);    /* (1 - 2^-23) * 2^128 */
    expect2(&mul, 0x7fc00000, HALF, 0x7f400000);       /* not a NaN */
    expect2(&add, 0x7f7fffff, 0x7f7fffff, 0x7fffffff); /* the host's largest, twice, is the SPU's largest */
    expect2(&add, 0x7f800000, 0x7f800000, LARGEST);    /* 2^129 */
    expect2(&mul, 0xff800000, 0x7f800000, SIGN | LARGEST);
    expect2(&sub, LARGEST, LARGEST, 0);
    expect2(&mul, SMALLEST, HALF, 0);        /* below the smallest */
    expect2(&mul, SIGN | SMALLEST, HALF, 0); /* +0 */
    expect2(&sub, SMALLEST, 0x00800001, 0);  /* -2^-149 */
    expect2(&add, 0x00400000, ONE, ONE);     /* exponent 0 is zero */
    expect2(&mul, 0x007fffff, LARGEST, 0);
    expect2(&add, 0x00400000, 0x00400000, 0);
    expect2(&add, SIGN, SIGN, 0); /* -0 + -0 = +0 */
    expect2(&sub, SIGN, 0, 0);
    expect2(&sub, 0x42280000, 0x42280000, 0);
    expect2(&mul, SIGN, ONE, 0);     /* -0 * 1 = +0 */
    expect2(&mul, SIGN, LARGEST, 0); /* 0 * the largest, no NaN */
}

/* ISA pages 208 to 212: the product is exact and has no limits of range */
static void literal_fused_operations(void **state)
{
    (void)state;
    expect3(&madd, LARGEST, 0x40000000, SIGN | LARGEST, LARGEST); /* 2 Smax - Smax */
    expect3(&madd, 0x1f800000, 0x1f800000, SMALLEST, 0x00a00000); /* 2^-64 * 2^-64 + Smin */
    expect3(&madd, ONE, ONE, 0xa1800000, 0x3f7fffff);             /* 1 - 2^-60 */
    expect3(&msub, LARGEST, 0x40000000, LARGEST, LARGEST);
    expect3(&msub, LARGEST, 0x40000000, SIGN | LARGEST, LARGEST);   /* 3 Smax */
    expect3(&nmsub, LARGEST, 0x40000000, LARGEST, SIGN | LARGEST);  /* c - a * b */
    expect3(&nmsub, ONE, 0x40000000, 0x40400000, ONE);              /* 3 - 1 * 2 */
    expect3(&msub, ONE, 0x40000000, 0x40400000, 0xbf800000);        /* 1 * 2 - 3 */
    expect3(&madd, 0x3f800001, 0x3f800001, 0xbf800002, 0x28800000); /* the square's 2^-46 */
    expect3(&madd, 0x1f800000, 0x9f800000, SMALLEST, 0);            /* Smin - 2^-128: below Smin */
    expect3(&nmsub, SIGN, ONE, SIGN, 0);
    expect3(&madd, SIGN, ONE, SIGN, 0);
    expect3(&msub, 0x40000000, ONE, 0x40000000, 0);
    expect3(&madd, 0x007fffff, LARGEST, ONE, ONE);                /* 0 * Smax + 1 */
    expect3(&nmsub, 0x7f800000, 0x7f800000, ONE, SIGN | LARGEST); /* 1 - 2^256 */
}

/* ISA pages 231 to 234: all of exponent 0 is one zero; the rest in the order of its bits */
static void literal_comparisons(void **state)
{
    (void)state;
    expect2(&cmpeq, 0x00000001, SIGN, UINT32_MAX);
    expect2(&cmpeq, 0x007fffff, 0x807fffff, UINT32_MAX);
    expect2(&cmpgt, 0x007fffff, 0x80000001, 0);
    expect2(&cmpgt, SMALLEST, 0x007fffff, UINT32_MAX);
    expect2(&cmpgt, 0x007fffff, SIGN | SMALLEST, UINT32_MAX);
    expect2(&cmpgt, LARGEST, 0x7ffffffe, UINT32_MAX);
    expect2(&cmpgt, 0x7f800000, 0x7f7fffff, UINT32_MAX);
    expect2(&cmpgt, 0x7f800001, 0x7f800000, UINT32_MAX);
    expect2(&cmpgt, 0xff800000, 0xff800001, UINT32_MAX);
    expect2(&cmpeq, 0x7fc00000, 0x7fc00000, UINT32_MAX);
    expect2(&cmpeq, 0x7fc00000, 0x7fc00001, 0);
    expect2(&cmpeq, ONE, SIGN | ONE, 0);
    expect2(&cmpabseq, 0xffc00000, 0x7fc00000, UINT32_MAX);
    expect2(&cmpabseq, 0x80000001, 0x00400000, UINT32_MAX);
    expect2(&cmpabsgt, 0xc0000000, ONE, UINT32_MAX);
    expect2(&cmpabsgt, 0xffffffff, 0x7ffffffe, UINT32_MAX);
    expect2(&cmpabsgt, ONE, 0xc0000000, 0);
}

/* ISA, pages of cflts, cfltu, csflt, cuflt: truncated and saturated; n is the scale */
static void literal_conversions(void **state)
{
    (void)state;
    expect_scaled(&convts, 0x4effffff, 0, 0x7fffff80);
    expect_scaled(&convts, 0x4f000000, 0, 0x7fffffff);
    expect_scaled(&convts, 0xcf000000, 0, 0x80000000);
    expect_scaled(&convts, 0xcf000001, 0, 0x80000000);
    expect_scaled(&convts, 0xbfffffff, 0, 0xffffffff); /* -1.99 */
    expect_scaled(&convts, 0x7fc00000, 0, 0x7fffffff);
    expect_scaled(&convts, 0xffc00000, 127, 0x80000000);
    expect_scaled(&convts, 0x3f7fffff, 31, 0x7fffff80);
    expect_scaled(&convts, SMALLEST, 127, 2);
    expect_scaled(&convts, 0x007fffff, 127, 0);
    expect_scaled(&convtu, 0x4f7fffff, 0, 0xffffff00);
    expect_scaled(&convtu, 0x4f800000, 0, 0xffffffff);
    expect_scaled(&convtu, 0x4f000001, 0, 0x80000100);
    expect_scaled(&convtu, 0xbf800000, 0, 0);
    expect_scaled(&convtu, 0xffc00000, 0, 0);
    expect_scaled(&convtu, 0x7f800001, 4, 0xffffffff);
    expect_scaled(&convtu, 0x3f800000, 4, 16);
    expect_scaled(&convtf_u32, 0xffffffff, 0, 0x4f7fffff);
    expect_scaled(&convtf_u32, 0x80000000, 32, HALF);
    expect_scaled(&convtf_u32, 1, 126, SMALLEST);
    expect_scaled(&convtf_u32, 1, 127, 0); /* 2^-127 */
    expect_scaled(&convtf_u32, 3, 127, 0x00c00000);
    expect_scaled(&convtf_s32, 0x7fffffff, 0, 0x4effffff);
    expect_scaled(&convtf_s32, 0x80000000, 0, 0xcf000000);
    expect_scaled(&convtf_s32, 0x80000001, 0, 0xceffffff);
    expect_scaled(&convtf_s32, 0xffffffff, 127, 0);
    expect_scaled(&convtf_s32, 0xfffffffe, 127, SIGN | SMALLEST);
    expect_scaled(&convtf_s32, 0, 5, 0);
}

/* ISA pages 214 to 219, with the lines of the Cell's own table */
static void literal_estimates(void **state)
{
    (void)state;
    expect1(&frest, 0, 0x7ffffbe0);
    expect1(&frest, SIGN, 0xfffffbe0);
    expect1(&frest, 0x807fffff, 0xff841d07);
    expect1(&frest, ONE, 0x3f7ffbe0);
    expect1(&frest, 0x7e000000, 0x00fffbe0); /* 2^125: the last exponent that has a reciprocal */
    expect1(&frest, 0x7e800000, 0x007ffbe0); /* 2^126: exponent 0 */
    expect1(&frest, LARGEST, 0x00041d07);
    expect1(&frsqest, 0, 0x7fb50160);
    expect1(&frsqest, SIGN | ONE, 0x3f7ffdf4); /* of the magnitude */
    expect1(&frsqest, LARGEST, 0x1f37e8ba);
    expect1(&re, ONE, 0x3f7ff800);
    expect1(&re, 0, 0x7ffff800);
    expect1(&re, SIGN, 0xfffff800);
    expect1(&re, 0x7e800000, 0); /* at and above 2^126 */
    expect1(&re, SIGN | LARGEST, 0);
    /* base 0, step 3ff, Y all ones: 1 - 1023 * 2^-13 * (1 - 2^-19) = 1 - 0.124878 */
    expect2(&fi, 0x0007ffff, 0x3f8003ff, 0x3f600803);
    expect2(&fi, 0xfff80000, 0x3f8003ff, ONE); /* Y 0; sign and exponent do not matter */
    expect2(&fi, 0x0007ffff, 0x008003ff, 0);   /* the same at exponent 1: below the smallest */
    expect2(&fi, 0x0007ffff, 0xffffffff, 0xfff00001);
}

#ifdef CGT_VARIANT_PORTABLE /* the model is the same in each row */

/* ---- model against truth ---- */

static void model_is_true_for(uint32_t a, uint32_t b, uint32_t c)
{
    const struct {
        const char *name;
        uint32_t model, truth;
    } row[] = {
        {"add", cgt_spu_model_add(a, b), true_sum(a, b)},
        {"sub", cgt_spu_model_sub(a, b), true_sum(a, b ^ SIGN)},
        {"mul", cgt_spu_model_mul(a, b), true_madd(a, b, 0)},
        {"madd", cgt_spu_model_madd(a, b, c), true_madd(a, b, c)},
        {"msub", cgt_spu_model_msub(a, b, c), true_madd(a, b, c ^ SIGN)},
        {"nmsub", cgt_spu_model_nmsub(a, b, c), true_madd(a ^ SIGN, b, c)},
        {"cmpgt", cgt_spu_model_cmpgt(a, b), true_value(a) > true_value(b) ? UINT32_MAX : 0},
        {"cmpeq", cgt_spu_model_cmpeq(a, b), true_value(a) == true_value(b) ? UINT32_MAX : 0},
        {"cmpabsgt", cgt_spu_model_cmpabsgt(a, b), fabs(true_value(a)) > fabs(true_value(b)) ? UINT32_MAX : 0},
        {"cmpabseq", cgt_spu_model_cmpabseq(a, b), fabs(true_value(a)) == fabs(true_value(b)) ? UINT32_MAX : 0},
    };
    for (size_t i = 0; i < TEST_COUNT(row); i++)
        if (row[i].model != row[i].truth)
            fail_msg("model of %s(%08x, %08x, %08x): %08x, but the truth is %08x", row[i].name, a, b, c, row[i].model,
                     row[i].truth);
}

static void model_of_arithmetic_is_true(void **state)
{
    (void)state;
    test_random r = random_make(1);
    for (uint32_t i = 0; i < edge_count; i++)
        for (uint32_t j = 0; j < edge_count; j++)
            for (uint32_t k = 0; k < edge_count; k++)
                model_is_true_for(edges[i], edges[j], edges[k]);
    for (uint32_t i = test_scaled(400000); i > 0; i--) {
        uint32_t bits[3];
        random_operands(&r, bits);
        model_is_true_for(bits[0], bits[1], bits[2]);
    }
}

static double clamp(double a, double low, double high) { return a < low ? low : a > high ? high : a; }

static void model_of_conversion_is_true(void **state)
{
    (void)state;
    test_random r = random_make(2);
    for (int n = 0; n < 128; n++)
        for (uint32_t i = test_scaled(3000); i > 0; i--) {
            const uint32_t bits = (uint32_t)random_bits(&r), whole = bits >> random_below(&r, 32);
            uint32_t a = i <= edge_count ? edges[i - 1] : bits;
            if (random_below(&r, 2)) /* where it does not all saturate */
                a = (a & 0x807fffff) | (uint32_t)(120 + random_below(&r, 50)) << 23;
            const double scaled = trunc(ldexp(true_value(a), n));
            assert_int_equal((int32_t)cgt_spu_model_convts(a, n), (int32_t)clamp(scaled, INT32_MIN, INT32_MAX));
            assert_int_equal(cgt_spu_model_convtu(a, n), (uint32_t)clamp(scaled, 0, UINT32_MAX));
            assert_int_equal(cgt_spu_model_convtf_u32(whole, n), true_number(ldexp(whole, -n)));
            assert_int_equal(cgt_spu_model_convtf_s32(whole, n), true_number(ldexp((int32_t)whole, -n)));
            assert_int_equal(cgt_spu_model_convtf_s32(0 - whole, n), true_number(ldexp((int32_t)(0 - whole), -n)));
        }
}

static void model_of_line_is_true(void **state)
{
    (void)state;
    test_random r = random_make(3);
    for (uint32_t i = test_scaled(400000); i > 0; i--) {
        const uint64_t bits = random_bits(&r);
        const uint32_t a = (uint32_t)bits, b = (uint32_t)(bits >> 32) | (i % 3 == 0 ? 0x3ff : 0);
        const double base = 1 + ldexp(b >> 10 & 8191, -13), step = ldexp(b & 1023, -13), y = ldexp(a & 0x7ffff, -19);
        const double line = ldexp(base - step * y, (int)(b >> 23 & 255) - 127); /* 33 bits at most: exact */
        assert_int_equal(cgt_spu_model_fi(a, b), true_number(b & SIGN ? -line : line));
    }
}

#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(literal_sums_and_products),
        cmocka_unit_test(literal_fused_operations),
        cmocka_unit_test(literal_comparisons),
        cmocka_unit_test(literal_conversions),
        cmocka_unit_test(literal_estimates),
#ifdef CGT_VARIANT_PORTABLE
        cmocka_unit_test(model_of_arithmetic_is_true),
        cmocka_unit_test(model_of_conversion_is_true),
        cmocka_unit_test(model_of_line_is_true),
#endif
        cmocka_unit_test(words_match_model_on_edges),
        cmocka_unit_test(words_match_model_at_all_exponent_gaps),
        cmocka_unit_test(words_match_model_on_random_operands),
        cmocka_unit_test(conversions_match_model_at_all_scales),
        cmocka_unit_test(lines_match_model),
        cmocka_unit_test(estimates_match_model_for_all_fractions),
        cmocka_unit_test(estimates_have_twelve_bits),
        cmocka_unit_test(reciprocal_after_one_step),
        cmocka_unit_test(root_after_one_step),
        cmocka_unit_test(root_of_zero_exponent_after_one_step),
        cmocka_unit_test(constants_are_not_folded),
        cmocka_unit_test(operations_stay_on_their_side_of_the_switch),
        cmocka_unit_test(leaving_restores_the_state),
    };
    test_begin("test_spu_arithmetic");
    if (!test_variant_runs(CGT_VARIANT_NAME))
        return TEST_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
