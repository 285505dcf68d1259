/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Every word of the vocabulary against its scalar definition, for the mapping of the variant that this is compiled
 * for. The definitions are those of the SPU language extension, with IEEE floats: they know nothing of the mappings.
 * The literal vectors say what byte order, element order and bit order are. */
#include "support/test.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "spu_intrinsics.h"

#define ROUNDS 20000

/* ---- operands ---- */

static const float edge[] = {0.f,
                             -0.f,
                             0x1p-149f,
                             -0x1p-149f,
                             0x1p-126f,
                             -0x1p-126f,
                             0.5f,
                             -0.5f,
                             1.f,
                             -1.f,
                             1.5f,
                             -1.5f,
                             0x1.fffffep-1f,
                             0x1p23f,
                             0x1.000002p23f,
                             -0x1p24f,
                             0x1p31f,
                             -0x1p31f,
                             0x1.fffffep30f,
                             -0x1.000002p31f,
                             0x1p32f,
                             0x1.fffffep127f,
                             -0x1.fffffep127f,
                             INFINITY,
                             -INFINITY,
                             NAN};
static const uint32_t edge_bits[] = {0,          1,          2,          0x7fffffff, 0x80000000,
                                     0x80000001, 0xffffffff, 0xfffffffe, 0x0000ffff, 0xaaaaaaaa};

static float any_float(test_random *r)
{
    switch (random_below(r, 4)) {
    case 0: return edge[random_below(r, TEST_COUNT(edge))];
    case 1: return random_any_float(r);
    default: return random_float(r, -100, 100);
    }
}

static uint32_t any_bits(test_random *r)
{
    return random_below(r, 3) ? (uint32_t)random_bits(r) : edge_bits[random_below(r, TEST_COUNT(edge_bits))];
}

static vec_float4 any_floats(test_random *r)
{
    return (vec_float4){any_float(r), any_float(r), any_float(r), any_float(r)};
}
static vec_uint4 any_words(test_random *r) { return (vec_uint4){any_bits(r), any_bits(r), any_bits(r), any_bits(r)}; }

/* Equal as results of arithmetic: the bits, where any NaN is as good as another. */
static bool equal(float a, float b) { return same_bits(a, b) || (isnan(a) && isnan(b)); }

#define CHECK_FLOAT(word, got, expected)                                                                               \
    do {                                                                                                               \
        const float g_ = (got), e_ = (expected);                                                                       \
        if (!equal(g_, e_))                                                                                            \
            fail_msg("%s: %a, expected %a", word, (double)g_, (double)e_);                                             \
    } while (0)
#define CHECK_BITS(word, got, expected)                                                                                \
    do {                                                                                                               \
        const uint32_t g_ = (uint32_t)(got), e_ = (uint32_t)(expected);                                                \
        if (g_ != e_)                                                                                                  \
            fail_msg("%s: 0x%08x, expected 0x%08x", word, g_, e_);                                                     \
    } while (0)

/* ---- elements ---- */

static void elements_lie_in_order_in_memory(void **state)
{
    (void)state;
    const vec_float4 f = {1, 2, 3, 4};
    const vec_uint4 u = {1, 2, 3, 4};
    const vec_ushort8 h = {1, 2, 3, 4, 5, 6, 7, 8};
    float mf[4];
    uint32_t mu[4];
    uint16_t mh[8];
    memcpy(mf, &f, 16);
    memcpy(mu, &u, 16);
    memcpy(mh, &h, 16);
    for (int i = 0; i < 4; i++) {
        assert_true(mf[i] == (float)(i + 1) && mu[i] == (uint32_t)i + 1);
        assert_true(spu_extract(f, i) == mf[i] && spu_extract(u, i) == mu[i] && spu_extract((vec_int4)u, i) == i + 1);
    }
    for (int i = 0; i < 8; i++)
        assert_true(mh[i] == i + 1 && spu_extract(h, i) == i + 1);
}

static void splats_fills_every_element(void **state)
{
    (void)state;
    const vec_float4 f = spu_splats(-0.f);
    const vec_int4 s = spu_splats((int32_t)-7);
    const vec_uint4 u = spu_splats(UINT32_C(0xdeadbeef));
    const vec_ushort8 h = spu_splats((uint16_t)0xcafe);
    for (int i = 0; i < 4; i++)
        assert_true(same_bits(f[i], -0.f) && s[i] == -7 && u[i] == 0xdeadbeef);
    for (int i = 0; i < 8; i++)
        assert_int_equal(h[i], 0xcafe);
}

/* ---- arithmetic ---- */

/* Whether madd, msub, nmsub round once (SPU, NEON) or twice; a mapping does one or the other for all operands. */
static bool is_fused(void)
{
    const vec_float4 a = spu_splats(0x1.000002p0f), c = spu_splats(-0x1.000004p0f);
    const float d = spu_extract(spu_madd(a, a, c), 0);
    assert_true(d == 0 || d == 0x1p-46f);
    return d != 0;
}

static void check_arithmetic(vec_float4 a, vec_float4 b, vec_float4 c, bool fused)
{
    const vec_float4 add = spu_add(a, b), sub = spu_sub(a, b), mul = spu_mul(a, b);
    const vec_float4 madd = spu_madd(a, b, c), msub = spu_msub(a, b, c), nmsub = spu_nmsub(a, b, c);
    for (int i = 0; i < 4; i++) {
        const float product = a[i] * b[i];
        CHECK_FLOAT("spu_add", add[i], a[i] + b[i]);
        CHECK_FLOAT("spu_sub", sub[i], a[i] - b[i]);
        CHECK_FLOAT("spu_mul", mul[i], product);
        CHECK_FLOAT("spu_madd", madd[i], fused ? fmaf(a[i], b[i], c[i]) : product + c[i]);
        CHECK_FLOAT("spu_msub", msub[i], fused ? fmaf(a[i], b[i], -c[i]) : product - c[i]);
        CHECK_FLOAT("spu_nmsub", nmsub[i], fused ? fmaf(-a[i], b[i], c[i]) : c[i] - product);
    }
}

static void float_arithmetic(void **state)
{
    (void)state;
    test_random r = random_make(1);
    const bool fused = is_fused();
    print_message("madd is %s\n", fused ? "fused" : "not fused");
    for (size_t i = 0; i < TEST_COUNT(edge); i++)
        for (size_t j = 0; j < TEST_COUNT(edge); j++)
            check_arithmetic(spu_splats(edge[i]), spu_splats(edge[j]), any_floats(&r), fused);
    for (uint32_t k = test_scaled(ROUNDS); k; k--)
        check_arithmetic(any_floats(&r), any_floats(&r), any_floats(&r), fused);
}

static void integer_arithmetic_wraps(void **state)
{
    (void)state;
    test_random r = random_make(2);
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        const vec_uint4 a = any_words(&r), b = any_words(&r), add = spu_add(a, b), sub = spu_sub(a, b);
        const vec_int4 sadd = spu_add((vec_int4)a, (vec_int4)b), ssub = spu_sub((vec_int4)a, (vec_int4)b);
        for (int i = 0; i < 4; i++) {
            CHECK_BITS("spu_add", add[i], a[i] + b[i]);
            CHECK_BITS("spu_sub", sub[i], a[i] - b[i]);
            CHECK_BITS("spu_add signed", sadd[i], a[i] + b[i]);
            CHECK_BITS("spu_sub signed", ssub[i], a[i] - b[i]);
        }
    }
}

/* ---- comparison and bits ---- */

static void check_compare(vec_float4 a, vec_float4 b)
{
    const vec_uint4 gt = spu_cmpgt(a, b), eq = spu_cmpeq(a, b);
    for (int i = 0; i < 4; i++) {
        CHECK_BITS("spu_cmpgt", gt[i], a[i] > b[i] ? UINT32_MAX : 0);
        CHECK_BITS("spu_cmpeq", eq[i], a[i] == b[i] ? UINT32_MAX : 0);
    }
}

static void float_comparison(void **state)
{
    (void)state;
    test_random r = random_make(3);
    for (size_t i = 0; i < TEST_COUNT(edge); i++)
        for (size_t j = 0; j < TEST_COUNT(edge); j++)
            check_compare(spu_splats(edge[i]), spu_splats(edge[j]));
    for (uint32_t k = test_scaled(ROUNDS); k; k--)
        check_compare(any_floats(&r), any_floats(&r));
}

static void integer_comparison_and_bits(void **state)
{
    (void)state;
    test_random r = random_make(4);
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        const vec_uint4 a = any_words(&r), b = random_below(&r, 4) ? any_words(&r) : a, m = any_words(&r);
        const vec_int4 sa = (vec_int4)a, sb = (vec_int4)b;
        const vec_float4 fa = (vec_float4)a, fb = (vec_float4)b;
        const vec_ushort8 ha = (vec_ushort8)a, hb = (vec_ushort8)b, heq = spu_cmpeq(ha, hb), hand = spu_and(ha, hb);
        const vec_uint4 gt = spu_cmpgt(a, b), sgt = spu_cmpgt(sa, sb), eq = spu_cmpeq(a, b), seq = spu_cmpeq(sa, sb);
        const vec_uint4 all[] = {spu_and(a, b),
                                 spu_or(a, b),
                                 spu_xor(a, b),
                                 spu_andc(a, b),
                                 spu_sel(a, b, m),
                                 (vec_uint4)spu_and(sa, sb),
                                 (vec_uint4)spu_or(sa, sb),
                                 (vec_uint4)spu_xor(sa, sb),
                                 (vec_uint4)spu_andc(sa, sb),
                                 (vec_uint4)spu_sel(sa, sb, m),
                                 (vec_uint4)spu_and(fa, fb),
                                 (vec_uint4)spu_or(fa, fb),
                                 (vec_uint4)spu_xor(fa, fb),
                                 (vec_uint4)spu_andc(fa, fb),
                                 (vec_uint4)spu_sel(fa, fb, m)};
        for (int i = 0; i < 4; i++) {
            const uint32_t expected[] = {a[i] & b[i], a[i] | b[i], a[i] ^ b[i], a[i] & ~b[i],
                                         (a[i] & ~m[i]) | (b[i] & m[i])};
            for (int w = 0; w < 15; w++)
                CHECK_BITS("spu_and, or, xor, andc, sel", all[w][i], expected[w % 5]);
            CHECK_BITS("spu_cmpgt", gt[i], a[i] > b[i] ? UINT32_MAX : 0);
            CHECK_BITS("spu_cmpgt signed", sgt[i], sa[i] > sb[i] ? UINT32_MAX : 0);
            CHECK_BITS("spu_cmpeq", eq[i], a[i] == b[i] ? UINT32_MAX : 0);
            CHECK_BITS("spu_cmpeq signed", seq[i], a[i] == b[i] ? UINT32_MAX : 0);
        }
        for (int i = 0; i < 8; i++) {
            CHECK_BITS("spu_cmpeq 16", heq[i], ha[i] == hb[i] ? 0xffff : 0);
            CHECK_BITS("spu_and 16", hand[i], ha[i] & hb[i]);
        }
    }
}

/* ---- conversion ---- */

/* Times 2^n, towards zero, saturated; NaN gives 0. In double, where the product is exact. */
static int32_t convts(float a, int n)
{
    const double x = ldexp((double)a, n);
    return isnan(x) ? 0 : x >= 2147483647.0 ? INT32_MAX : x <= -2147483648.0 ? INT32_MIN : (int32_t)x;
}

static void check_convts(vec_float4 a)
{
    const vec_int4 d[] = {spu_convts(a, 0), spu_convts(a, 1), spu_convts(a, 8), spu_convts(a, 31)};
    const int n[] = {0, 1, 8, 31};
    for (int w = 0; w < 4; w++)
        for (int i = 0; i < 4; i++)
            CHECK_BITS("spu_convts", d[w][i], convts(a[i], n[w]));
}

static void float_to_int(void **state)
{
    (void)state;
    test_random r = random_make(5);
    const vec_int4 literal = spu_convts(((vec_float4){2.9f, -2.9f, 0x1p31f, -0x1p40f}), 0);
    assert_true(literal[0] == 2 && literal[1] == -2 && literal[2] == INT32_MAX && literal[3] == INT32_MIN);
    for (size_t i = 0; i < TEST_COUNT(edge); i++)
        check_convts(spu_splats(edge[i]));
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        check_convts(any_floats(&r));
        check_convts(
            (vec_float4){random_float(&r, -3e9f, 3e9f), random_float(&r, -2, 2), random_log(&r, 1e-3f, 1e12f), 0});
    }
}

static void int_to_float(void **state)
{
    (void)state;
    test_random r = random_make(6);
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        const vec_int4 a = (vec_int4)any_words(&r);
        const vec_float4 d[] = {spu_convtf(a, 0), spu_convtf(a, 4), spu_convtf(a, 31)};
        const int n[] = {0, 4, 31};
        for (int w = 0; w < 3; w++)
            for (int i = 0; i < 4; i++)
                CHECK_FLOAT("spu_convtf", d[w][i], (float)ldexp((double)(float)a[i], -n[w]));
    }
}

/* ---- gather, shuffle ---- */

static void gather_takes_lowest_bits_element_0_first(void **state)
{
    (void)state;
    for (uint32_t bits = 0; bits < 16; bits++) {
        const vec_uint4 a = {bits >> 3 & 1, bits >> 2 & 1, bits >> 1 & 1, bits & 1};
        const vec_uint4 noise = {0xfffffffe, 0x12345678, 0x80000000, 0};
        const vec_uint4 d[] = {spu_gather(a), spu_gather(a | noise), spu_gather(~(a - 1))};
        for (int w = 0; w < 3; w++) {
            CHECK_BITS("spu_gather", d[w][0], bits);
            for (int i = 1; i < 4; i++)
                CHECK_BITS("spu_gather, other elements", d[w][i], 0);
        }
    }
}

/* Byte p of a holds p and byte p of b 16 + p, most significant byte of an element first. */
static const vec_ushort8 numbered_a = {0x0001, 0x0203, 0x0405, 0x0607, 0x0809, 0x0a0b, 0x0c0d, 0x0e0f};
static const vec_ushort8 numbered_b = {0x1011, 0x1213, 0x1415, 0x1617, 0x1819, 0x1a1b, 0x1c1d, 0x1e1f};

/* The byte that a selector picks, where get(p) is byte p of a and b. */
static unsigned selected(unsigned c, vec_ushort8 a, vec_ushort8 b)
{
    if (c >= 0xe0)
        return 0x80;
    if (c >= 0xc0)
        return 0xff;
    if (c >= 0x80)
        return 0x00;
    const unsigned p = c & 31, element = p < 16 ? a[p / 2] : b[p / 2 - 8];
    return p % 2 ? element & 0xff : element >> 8;
}

static void check_shuffle(vec_ushort8 a, vec_ushort8 b, vec_uchar16 c)
{
    const vec_ushort8 d = spu_shuffle(a, b, c);
    for (int i = 0; i < 8; i++)
        CHECK_BITS("spu_shuffle", d[i], selected(c[2 * i], a, b) << 8 | selected(c[2 * i + 1], a, b));
}

static void shuffle_selects_bytes(void **state)
{
    (void)state;
    test_random r = random_make(7);
    const vec_uchar16 identity_a = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const vec_uchar16 push = {0, 1, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29};
    const vec_uchar16 constants = {0x80, 0xbf, 0xc0, 0xdf, 0xe0, 0xff, 0x9f, 0xc5, 0, 0, 0, 0, 0, 0, 0, 0};
    const vec_ushort8 same = spu_shuffle(numbered_a, numbered_b, identity_a);
    const vec_ushort8 pushed = spu_shuffle(numbered_a, numbered_b, push);
    const vec_ushort8 fixed = spu_shuffle(numbered_a, numbered_b, constants);
    for (int i = 0; i < 8; i++)
        assert_int_equal(same[i], numbered_a[i]);
    assert_int_equal(pushed[0], numbered_a[0]);
    for (int i = 1; i < 8; i++)
        assert_int_equal(pushed[i], numbered_b[i - 1]);
    assert_true(fixed[0] == 0x0000 && fixed[1] == 0xffff && fixed[2] == 0x8080 && fixed[3] == 0x00ff && fixed[4] == 0);
    for (int c = 0; c < 256; c++)
        for (int k = 0; k < 16; k++) {
            vec_uchar16 pattern = identity_a;
            pattern[k] = (uint8_t)c;
            check_shuffle(numbered_a, numbered_b, pattern);
        }
    for (uint32_t k = test_scaled(ROUNDS); k; k--)
        check_shuffle((vec_ushort8)any_words(&r), (vec_ushort8)any_words(&r), (vec_uchar16)any_words(&r));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elements_lie_in_order_in_memory),
        cmocka_unit_test(splats_fills_every_element),
        cmocka_unit_test(float_arithmetic),
        cmocka_unit_test(integer_arithmetic_wraps),
        cmocka_unit_test(float_comparison),
        cmocka_unit_test(integer_comparison_and_bits),
        cmocka_unit_test(float_to_int),
        cmocka_unit_test(int_to_float),
        cmocka_unit_test(gather_takes_lowest_bits_element_0_first),
        cmocka_unit_test(shuffle_selects_bytes),
    };
    test_begin("test_spu_words");
    if (!test_variant_runs(CGT_VARIANT_NAME))
        return TEST_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
