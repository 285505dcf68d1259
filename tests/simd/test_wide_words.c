/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The vocabulary at the width of the variant that this is compiled for. The SPU's words are compared lane by lane with
 * the same words on four lanes, which have a test against their definition of their own; what vector.h adds (spux_*)
 * is compared with plain C. */
#include "simd/lanes.h"
#include "support/suite.h"

/* The word at both widths on operands of one type (f, s, u): d and e. */
#define WORD2(word, t)                                                                                                 \
    d.t = spu_##word(a.t, b.t);                                                                                        \
    for (int g = 0; g < BLOCK_ROWS; g++)                                                                               \
    e.t##4 [g] = spu_##word(a.t##4 [g], b.t##4 [g])
#define COMPARE(word, t)                                                                                               \
    do {                                                                                                               \
        for (int g = 0; g < BLOCK_ROWS; g++)                                                                           \
            e.u4[g] = (vec_uint4)spu_##word(a.t##4 [g], b.t##4 [g]);                                                   \
        check_mask("spu_" #word " " #t, spu_##word(a.t, b.t), &e);                                                     \
    } while (0)

/* ---- the SPU's words ---- */

/* Wide madd, msub, nmsub are fused; those on four lanes are where the mapping has it. */
static void check_fused(const lanes a, const lanes b, const lanes c)
{
    lanes d[3], e[3];
    d[0].f = spu_madd(a.f, b.f, c.f);
    d[1].f = spu_msub(a.f, b.f, c.f);
    d[2].f = spu_nmsub(a.f, b.f, c.f);
    for (int i = 0; i < CGT_LANES; i++) {
        e[0].ef[i] = fmaf(a.ef[i], b.ef[i], c.ef[i]);
        e[1].ef[i] = fmaf(a.ef[i], b.ef[i], -c.ef[i]);
        e[2].ef[i] = fmaf(-a.ef[i], b.ef[i], c.ef[i]);
    }
    if (CGT_LANES == 4)
        for (int g = 0; g < BLOCK_ROWS; g++) {
            e[0].f4[g] = spu_madd(a.f4[g], b.f4[g], c.f4[g]);
            e[1].f4[g] = spu_msub(a.f4[g], b.f4[g], c.f4[g]);
            e[2].f4[g] = spu_nmsub(a.f4[g], b.f4[g], c.f4[g]);
        }
    check_floats("spu_madd", &d[0], &e[0]);
    check_floats("spu_msub", &d[1], &e[1]);
    check_floats("spu_nmsub", &d[2], &e[2]);
}

static void check_float_words(const lanes a, const lanes b, const lanes c)
{
    lanes d, e;
    WORD2(add, f);
    check_floats("spu_add", &d, &e);
    WORD2(sub, f);
    check_floats("spu_sub", &d, &e);
    WORD2(mul, f);
    check_floats("spu_mul", &d, &e);
    check_fused(a, b, c);
    COMPARE(cmpgt, f);
    COMPARE(cmpeq, f);
    COMPARE(cmpabsgt, f);
    WORD2(and, f);
    check_bits("spu_and f", &d, &e);
    WORD2(or, f);
    check_bits("spu_or f", &d, &e);
    WORD2(xor, f);
    check_bits("spu_xor f", &d, &e);
    WORD2(andc, f);
    check_bits("spu_andc f", &d, &e);
    WORD2(nor, f);
    check_bits("spu_nor f", &d, &e);
    d.f = spu_sel(a.f, b.f, c.u);
    for (int g = 0; g < BLOCK_ROWS; g++)
        e.f4[g] = spu_sel(a.f4[g], b.f4[g], c.u4[g]);
    check_bits("spu_sel f", &d, &e);
}

TEST(float_words)
{
    test_random r = random_make(1);
    for (size_t i = 0; i < TEST_COUNT(edge); i++)
        for (size_t j = 0; j < TEST_COUNT(edge); j++)
            check_float_words(edges(i), edges(j), edges(i + 2 * j + random_below(&r, 99)));
    for (uint32_t k = test_scaled(ROUNDS); k; k--)
        check_float_words(any_floats(&r), any_floats(&r), any_floats(&r));
}

TEST(wide_madd_rounds_once)
{
    const float a = 0x1.000002p0f, c = -0x1.000004p0f,
                d = spux_hmin(spu_madd(spux_vfloat(a), spux_vfloat(a), spux_vfloat(c)));
    if (CGT_LANES > 4)
        assert_true(d == 0x1p-46f);
    else
        assert_true(d == 0x1p-46f || d == 0);
}

static void check_int_words(const lanes a, const lanes b, const lanes m)
{
    lanes d, e;
#define BITS(word)                                                                                                     \
    WORD2(word, u);                                                                                                    \
    check_bits("spu_" #word " u", &d, &e);                                                                             \
    WORD2(word, s);                                                                                                    \
    check_bits("spu_" #word " s", &d, &e)
    BITS(add);
    BITS(sub);
    BITS(and);
    BITS(or);
    BITS(xor);
    BITS(andc);
    BITS(nor);
    COMPARE(cmpgt, u);
    COMPARE(cmpgt, s);
    COMPARE(cmpeq, u);
    COMPARE(cmpeq, s);
    d.u = spu_sel(a.u, b.u, m.u);
    for (int g = 0; g < BLOCK_ROWS; g++)
        e.u4[g] = spu_sel(a.u4[g], b.u4[g], m.u4[g]);
    check_bits("spu_sel u", &d, &e);
    d.s = spu_sel(a.s, b.s, m.u);
    check_bits("spu_sel s", &d, &e);
}

TEST(int_words)
{
    test_random r = random_make(2);
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        const lanes a = any_words(&r);
        check_int_words(a, random_below(&r, 4) ? any_words(&r) : a, any_words(&r));
    }
}

#define CONVTS(n)                                                                                                      \
    d.s = spu_convts(a.f, n);                                                                                          \
    for (int g = 0; g < BLOCK_ROWS; g++)                                                                               \
        e.s4[g] = spu_convts(a.f4[g], n);                                                                              \
    check_bits("spu_convts " #n, &d, &e)
#define CONVTF(n)                                                                                                      \
    d.f = spu_convtf(i.s, n);                                                                                          \
    for (int g = 0; g < BLOCK_ROWS; g++)                                                                               \
        e.f4[g] = spu_convtf(i.s4[g], n);                                                                              \
    check_bits("spu_convtf s " #n, &d, &e);                                                                            \
    d.f = spu_convtf(i.u, n);                                                                                          \
    for (int g = 0; g < BLOCK_ROWS; g++)                                                                               \
        e.f4[g] = spu_convtf(i.u4[g], n);                                                                              \
    check_bits("spu_convtf u " #n, &d, &e)

static void check_conversions(const lanes a, const lanes i)
{
    lanes d, e;
    CONVTS(0);
    CONVTS(1);
    CONVTS(16);
    CONVTS(31);
    CONVTS(127);
    CONVTF(0);
    CONVTF(1);
    CONVTF(16);
    CONVTF(31);
    CONVTF(126);
    CONVTF(127);
}

TEST(conversions)
{
    test_random r = random_make(3);
    for (size_t k = 0; k < TEST_COUNT(edge); k++)
        check_conversions(edges(k), any_words(&r));
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        lanes a = any_floats(&r);
        a.ef[random_below(&r, CGT_LANES)] = random_float(&r, -3e9f, 3e9f);
        check_conversions(a, any_words(&r));
    }
}

TEST(estimates_are_near)
{
    test_random r = random_make(4);
    double worst[2] = {0, 0};
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        lanes a, re, root;
        for (int i = 0; i < CGT_LANES; i++)
            a.ef[i] = random_log(&r, 1e-30f, 1e30f) * (random_below(&r, 2) ? 1.f : -1.f);
        re.f = spu_re(a.f);
        root.f = spu_rsqrte(a.f); /* of the absolute value, as on the SPU */
        for (int i = 0; i < CGT_LANES; i++) {
            const double errors[2] = {fabs(re.ef[i] * (double)a.ef[i] - 1),
                                      fabs(root.ef[i] * sqrt(fabs((double)a.ef[i])) - 1)};
            for (int w = 0; w < 2; w++)
                worst[w] = errors[w] > worst[w] ? errors[w] : worst[w];
        }
    }
    print_message("largest relative errors: re 2^%.2f, rsqrte 2^%.2f\n", log2(worst[0] + 1e-30),
                  log2(worst[1] + 1e-30));
    const double bound = CGT_LANES == 16 ? 0x1p-14 : CGT_LANES == 8 ? 1.5 * 0x1p-12 : 0x1p-11;
    assert_true(worst[0] <= bound && worst[1] <= bound);
}

/* ---- masks ---- */

TEST(masks)
{
    test_random r = random_make(5);
    check_number("mask_none", spux_mask_bits(spux_mask_none()), 0);
    check_number("mask_all", spux_mask_bits(spux_mask_all()), CGT_ALL_LANES);
    for (unsigned n = 0; n <= CGT_LANES; n++)
        check_number("mask_first", spux_mask_bits(spux_mask_first(n)), (1u << n) - 1);
    for (unsigned bits = 0; bits <= CGT_ALL_LANES; bits++) {
        const unsigned other = any_bits(&r);
        const vmask m = spux_mask_from_bits(bits), o = spux_mask_from_bits(other);
        check_number("mask_from_bits", spux_mask_bits(m), bits);
        check_number("mask_from_bits, more", spux_mask_bits(spux_mask_from_bits(bits | 1u << CGT_LANES)), bits);
        check_number("not", spux_mask_bits(spux_not(m)), ~bits & CGT_ALL_LANES);
        check_number("any", spux_any(m), bits != 0);
        check_number("none", spux_none(m), bits == 0);
        check_number("all", spux_all(m), bits == CGT_ALL_LANES);
        check_number("count_bits", spux_count_bits(bits), (uint32_t)__builtin_popcount(bits));
        check_number("and", spux_mask_bits(spu_and(m, o)), bits & other);
        check_number("or", spux_mask_bits(spu_or(m, o)), bits | other);
        check_number("xor", spux_mask_bits(spu_xor(m, o)), bits ^ other);
        check_number("andc", spux_mask_bits(spu_andc(m, o)), bits & ~other);
        check_number("nor", spux_mask_bits(spu_nor(m, o)), ~(bits | other) & CGT_ALL_LANES);
    }
}

TEST(selection)
{
    test_random r = random_make(6);
    for (unsigned bits = 0; bits <= CGT_ALL_LANES; bits++) {
        const lanes a = any_words(&r), b = any_words(&r);
        const vmask m = spux_mask_from_bits(bits);
        lanes d, e;
        for (int i = 0; i < CGT_LANES; i++)
            e.eu[i] = bits >> i & 1 ? b.eu[i] : a.eu[i];
        d.u = spux_select(a.u, b.u, m);
        check_bits("spux_select u", &d, &e);
        d.s = spux_select(a.s, b.s, m);
        check_bits("spux_select s", &d, &e);
        d.f = spux_select(a.f, b.f, m);
        check_bits("spux_select f", &d, &e);
    }
}

/* Masks as kernels make them, where compilers fold comparisons, their complements and selection into each other. */
TEST(selection_by_comparisons)
{
    test_random r = random_make(16);
    for (unsigned round = 0; round < 64; round++) {
        lanes a, b, c, d, e;
        for (int i = 0; i < CGT_LANES; i++) {
            a.ef[i] = (float)random_below(&r, 3);
            b.ef[i] = (float)random_below(&r, 3);
            c.ef[i] = (float)random_below(&r, 3);
        }
        const vmask either = spu_or(spu_cmpgt(a.f, b.f), spu_cmpgt(b.f, c.f));
        d.u = spux_select(a.u, spu_or(a.u, spux_vuint(5)), spux_not(either));
        for (int i = 0; i < CGT_LANES; i++)
            e.eu[i] = a.ef[i] > b.ef[i] || b.ef[i] > c.ef[i] ? a.eu[i] : a.eu[i] | 5;
        check_bits("spux_select u, not of two", &d, &e);
        d.f = spux_select(a.f, c.f, spux_not(either));
        for (int i = 0; i < CGT_LANES; i++)
            e.ef[i] = a.ef[i] > b.ef[i] || b.ef[i] > c.ef[i] ? a.ef[i] : c.ef[i];
        check_bits("spux_select f, not of two", &d, &e);
        d.u = spux_select(a.u, c.u, spu_nor(spux_cmpge(a.f, b.f), spu_cmpeq(b.u, c.u)));
        for (int i = 0; i < CGT_LANES; i++)
            e.eu[i] = a.ef[i] >= b.ef[i] || b.eu[i] == c.eu[i] ? a.eu[i] : c.eu[i];
        check_bits("spux_select u, nor", &d, &e);
        d.u = spux_select(a.u, c.u, spu_andc(spu_cmpgt(a.f, b.f), spu_cmpgt(b.u, c.u)));
        for (int i = 0; i < CGT_LANES; i++)
            e.eu[i] = a.ef[i] > b.ef[i] && b.eu[i] <= c.eu[i] ? c.eu[i] : a.eu[i];
        check_bits("spux_select u, andc", &d, &e);
    }
}

/* ---- arithmetic of vector.h ---- */

static void check_extremes(const lanes a, const lanes b)
{
    lanes d, e, ge;
    for (int i = 0; i < CGT_LANES; i++) {
        e.ef[i] = a.ef[i] < b.ef[i] ? a.ef[i] : b.ef[i];
        ge.eu[i] = a.ef[i] >= b.ef[i] ? UINT32_MAX : 0;
    }
    check_mask("spux_cmpge", spux_cmpge(a.f, b.f), &ge);
    d.f = spux_min(a.f, b.f);
    check_bits("spux_min f", &d, &e);
    for (int i = 0; i < CGT_LANES; i++)
        e.ef[i] = a.ef[i] > b.ef[i] ? a.ef[i] : b.ef[i];
    d.f = spux_max(a.f, b.f);
    check_bits("spux_max f", &d, &e);
    d.f = spux_abs(a.f);
    for (int i = 0; i < CGT_LANES; i++)
        e.eu[i] = a.eu[i] & 0x7fffffff;
    check_bits("spux_abs", &d, &e);
}

static void check_estimate(const lanes a)
{
    lanes d;
    d.f = spux_rsqrte(a.f);
    for (int i = 0; i < CGT_LANES; i++) {
        const double x = (double)a.ef[i];
        if (x <= -0x1p-126)
            assert_true(isnan(d.ef[i]));
        else if (x >= 0x1p-120 && x <= 0x1p120)
            assert_true(fabs((double)d.ef[i] * sqrt(x) - 1) <= 0x1.8p-12 + 0x1p-20);
    }
}

static void check_truncation(const lanes a)
{
    lanes d;
    d.s = spux_truncate(a.f);
    for (int i = 0; i < CGT_LANES; i++)
        if (fabsf(a.ef[i]) < 0x1p31f)
            assert_int_equal(d.es[i], (int32_t)a.ef[i]);
}

static void check_int_extremes(const lanes a, const lanes b)
{
    lanes d, e;
#define EXTREME(word, t, op)                                                                                           \
    d.t = spux_##word(a.t, b.t);                                                                                       \
    for (int i = 0; i < CGT_LANES; i++)                                                                                \
        e.e##t[i] = a.e##t[i] op b.e##t[i] ? a.e##t[i] : b.e##t[i];                                                    \
    check_bits("spux_" #word " " #t, &d, &e)
    EXTREME(min, u, <);
    EXTREME(max, u, >);
    EXTREME(min, s, <);
    EXTREME(max, s, >);
}

TEST(extremes)
{
    test_random r = random_make(7);
    for (size_t i = 0; i < TEST_COUNT(edge); i++)
        for (size_t j = 0; j < TEST_COUNT(edge); j++)
            check_extremes(edges(i), edges(j));
    for (size_t i = 0; i < TEST_COUNT(edge); i++)
        check_truncation(edges(i));
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        check_extremes(any_floats(&r), any_floats(&r));
        check_estimate(any_floats(&r));
        check_truncation(any_floats(&r));
        check_int_extremes(any_words(&r), any_words(&r));
    }
}

TEST(quotient_and_root_are_near)
{
    test_random r = random_make(8);
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        lanes a, b, quotient, root;
        for (int i = 0; i < CGT_LANES; i++) {
            a.ef[i] = random_log(&r, 1e-18f, 1e18f);
            b.ef[i] = -random_log(&r, 1e-18f, 1e18f);
        }
        quotient.f = spux_div(a.f, b.f);
        root.f = spux_sqrt(a.f);
        for (int i = 0; i < CGT_LANES; i++) {
            assert_true(fabs(quotient.ef[i] / ((double)a.ef[i] / b.ef[i]) - 1) <= 0x1p-21);
            assert_true(fabs(root.ef[i] / sqrt((double)a.ef[i]) - 1) <= 0x1p-21);
        }
    }
    assert_true(spux_hmax(spux_sqrt(spux_vfloat(0))) == 0);
    assert_true(spux_hmin(spux_sqrt(spux_vfloat(4))) == 2);
}

TEST(shifts)
{
    test_random r = random_make(9);
    for (uint32_t n = 0; n < 200; n++) {
        const lanes a = any_words(&r);
        const uint32_t k = n & 63;
        lanes left, right, sign, d;
        for (int i = 0; i < CGT_LANES; i++) {
            left.eu[i] = k < 32 ? a.eu[i] << k : 0;
            right.eu[i] = k < 32 ? a.eu[i] >> k : 0;
            sign.es[i] = (int32_t)(a.es[i] < 0 ? ~(~a.eu[i] >> (k < 32 ? k : 31)) : a.eu[i] >> (k < 32 ? k : 31));
        }
        d.u = spu_sl(a.u, n);
        check_bits("spu_sl u", &d, &left);
        d.s = spu_sl(a.s, n);
        check_bits("spu_sl s", &d, &left);
        d.u = spu_sr(a.u, n);
        check_bits("spu_sr u", &d, &right);
        d.s = spu_sr(a.s, n);
        check_bits("spu_sr s", &d, &right);
        d.u = spu_sra(a.u, n);
        check_bits("spu_sra u", &d, &sign);
        d.s = spu_sra(a.s, n);
        check_bits("spu_sra s", &d, &sign);
    }
}

/* ---- between lanes ---- */

TEST(splats_and_lanes)
{
    const lanes f = {.f = spux_vfloat(2.5f)}, s = {.s = spux_vint(-3)}, u = {.u = spux_vuint(0xdeadbeef)};
    const lanes index = {.u = spux_lane_index()};
    for (int i = 0; i < CGT_LANES; i++)
        assert_true(f.ef[i] == 2.5f && s.es[i] == -3 && u.eu[i] == 0xdeadbeef && index.eu[i] == (uint32_t)i);
}

TEST(permutation)
{
    test_random r = random_make(10);
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        const lanes a = any_words(&r);
        lanes index = any_words(&r), d, e;
        for (int i = 0; i < CGT_LANES; i++) {
            if (k % 2)
                index.eu[i] %= CGT_LANES;
            e.eu[i] = a.eu[index.eu[i] % CGT_LANES];
        }
        d.u = spux_permute(a.u, index.u);
        check_bits("spux_permute u", &d, &e);
        d.s = spux_permute(a.s, index.u);
        check_bits("spux_permute s", &d, &e);
        d.f = spux_permute(a.f, index.u);
        check_bits("spux_permute f", &d, &e);
    }
}

TEST(compression)
{
    test_random r = random_make(11);
    for (unsigned bits = 0; bits <= CGT_ALL_LANES; bits++) {
        const lanes a = any_words(&r);
        const vmask m = spux_mask_from_bits(bits);
        lanes d, e = {.u = spux_vuint(0)};
        int n = 0;
        for (int i = 0; i < CGT_LANES; i++)
            if (bits >> i & 1)
                e.eu[n++] = a.eu[i];
        d.u = spux_compress(a.u, m);
        check_bits("spux_compress u", &d, &e);
        d.s = spux_compress(a.s, m);
        check_bits("spux_compress s", &d, &e);
        d.f = spux_compress(a.f, m);
        check_bits("spux_compress f", &d, &e);
    }
}

TEST(least_and_greatest_lane)
{
    test_random r = random_make(12);
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        const lanes u = any_words(&r);
        lanes f;
        for (int i = 0; i < CGT_LANES; i++)
            f.ef[i] = random_below(&r, 20) ? random_float(&r, -10, 10) : random_below(&r, 2) ? INFINITY : -INFINITY;
        f.ef[random_below(&r, CGT_LANES)] *= 8;
        float low = f.ef[0], high = f.ef[0];
        uint32_t least = u.eu[0], most = u.eu[0];
        for (int i = 1; i < CGT_LANES; i++) {
            low = f.ef[i] < low ? f.ef[i] : low;
            high = f.ef[i] > high ? f.ef[i] : high;
            least = u.eu[i] < least ? u.eu[i] : least;
            most = u.eu[i] > most ? u.eu[i] : most;
        }
        assert_true(spux_hmin(f.f) == low && spux_hmax(f.f) == high);
        assert_true(spux_hmin(u.u) == least && spux_hmax(u.u) == most);
    }
}

VARIANT_SUITE("test_wide_words", NULL, NULL)
