/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Numbers in text files: the fast path gives the bits of strtof and strtod for every kind of number. */
#include "support/random.h"
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "trajectory/text/text_reader.h"

static test_random numbers;

static uint64_t next_random(void) { return random_bits(&numbers); }

static text_span span_of(const char *text)
{
    const text_span span = {text, text + strlen(text)};
    return span;
}

static uint32_t float_bits(float f)
{
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    return bits;
}

static uint64_t double_bits(double d)
{
    uint64_t bits;
    memcpy(&bits, &d, sizeof bits);
    return bits;
}

/* Reads text both ways and compares the bits. */
static void compare(const char *text)
{
    float f = 0, f_wanted = strtof(text, NULL);
    double d = 0, d_wanted = strtod(text, NULL);
    if (!text_float(span_of(text), &f) || (float_bits(f) != float_bits(f_wanted) && !isnan(f_wanted)))
        fail_msg("'%s' as a float: %.9g, not %.9g", text, (double)f, (double)f_wanted);
    if (!text_double(span_of(text), &d) || (double_bits(d) != double_bits(d_wanted) && !isnan(d_wanted)))
        fail_msg("'%s' as a double: %.17g, not %.17g", text, d, d_wanted);
}

TEST(random_numbers_have_the_right_bits)
{
    static const char formats[7][8] = {"%g", "%.3f", "%.9g", "%.17g", "%.8e", "%.0f", "%+.12f"};
    for (int i = 0; i < 40000; i++) {
        const uint64_t bits = next_random();
        const uint32_t low = (uint32_t)bits;
        char text[512];
        double d;
        float f;
        memcpy(&d, &bits, sizeof d);
        memcpy(&f, &low, sizeof f);
        snprintf(text, sizeof text, formats[i % 7], (double)f);
        compare(text);
        snprintf(text, sizeof text, formats[i % 7], ((double)(bits >> 40) - 8388608.0) / 1000.0);
        compare(text);
        snprintf(text, sizeof text, formats[i % 5 == 1 ? 0 : i % 5], d);
        compare(text);
    }
}

/* Half-way between two floats, and next to it: where double rounding fails. */
TEST(numbers_between_two_floats)
{
    for (int i = 0; i < 20000; i++) {
        char text[128];
        const uint32_t mantissa = (uint32_t)(next_random() >> 41) | 0x800000u;
        const int shift = (int)(next_random() % 40) - 30;
        const double middle = ldexp((double)mantissa + 0.5, shift);
        snprintf(text, sizeof text, "%.17g", middle);
        compare(text);
        const double exact_digits = (double)mantissa + 0.5;
        snprintf(text, sizeof text, "%.1f", exact_digits);
        compare(text);
        snprintf(text, sizeof text, "%.1f00000001", exact_digits);
        compare(text);
        snprintf(text, sizeof text, "%.0f.49999999", (double)mantissa);
        compare(text);
        snprintf(text, sizeof text, "%.17g", nextafter(middle, i % 2 ? INFINITY : -INFINITY));
        compare(text);
    }
}

TEST(other_spellings)
{
    /* clang-format off */
    static const char *const right[] = {
        "0", "-0", "+0.0", "5.", ".5", "-.5e+3", "1e22", "1e23", "1e-22", "1e-23", "1E5", "00012.50", "1e+05", "1e0000",
        "0e12345", "inf", "-inf", "Infinity", "nan", "-nan", "1e39", "-1e39", "1e-46", "7e-46", "1.17549e-38",
        "3.4028236e38", "1e999", "1e-999", "9007199254740993", "123456789012345678901234567890",
        "0.000000000000000000000000000001",
    };
    static const char *const wrong[] = {
        "", "-", "+", ".", "e5", "1e", "1e+", "1.2.3", "1,5", "0x10", "0X1p3", "1f", "--1", "+-1", "1 2", "one",
        "1e5.0",
    };
    /* clang-format on */
    for (size_t i = 0; i < sizeof right / sizeof right[0]; i++)
        compare(right[i]);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        float f = 7;
        double d = 7;
        if (text_float(span_of(wrong[i]), &f) || text_double(span_of(wrong[i]), &d) || f != 7 || d != 7)
            fail_msg("'%s' was read as a number", wrong[i]);
    }
}

/* Exponents as Fortran and Mathematica write them give the bits of C's own. */
TEST(foreign_exponents)
{
    static const char *const pairs[][2] = {
        {"0.1D+01", "1"},
        {"2.0D0", "2"},
        {"3.0d-1", "0.3"},
        {"6.3*^-6", "6.3e-6"},
        {"-1.5-101", "-1.5e-101"},
        {"1.25+002", "125"},
        {".5D3", "500"},
        {"1.D+01", "10"},
        {"1.7D+38", "1.7e38"},
        {"1.D-45", "1e-45"},
        {"123456789012345678901D-20", "1.23456789012345678901"},
    };
    static const char *const wrong[] = {"D",   "1D",    "1D+", "D5",      "1*5",  "1*^",
                                        "1^5", "1d5d5", "1-",  "1.5-1-1", "1D5x", "--1D5"};
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        float f = 0;
        double d = 0;
        assert_true(text_float(span_of(pairs[i][0]), &f) && text_double(span_of(pairs[i][0]), &d));
        assert_true(f == strtof(pairs[i][1], NULL) && d == strtod(pairs[i][1], NULL));
    }
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        double d;
        if (text_double(span_of(wrong[i]), &d))
            fail_msg("'%s' was read as a number", wrong[i]);
    }
}

TEST(whole_numbers)
{
    uint64_t u = 0;
    int64_t i = 0;
    assert_true(text_u64(span_of("18446744073709551615"), UINT64_MAX, &u) && u == UINT64_MAX);
    assert_false(text_u64(span_of("18446744073709551616"), UINT64_MAX, &u));
    assert_false(text_u64(span_of("99999999999999999999"), UINT64_MAX, &u));
    assert_true(text_u64(span_of("+007"), 7, &u) && u == 7);
    assert_false(text_u64(span_of("8"), 7, &u));
    assert_false(text_u64(span_of("17"), 7, &u));
    assert_false(text_u64(span_of(""), 7, &u) || text_u64(span_of("+"), 7, &u) || text_u64(span_of("-1"), 7, &u));
    assert_true(text_i64(span_of("-9223372036854775807"), &i) && i == -INT64_MAX);
    assert_true(text_i64(span_of("9223372036854775807"), &i) && i == INT64_MAX);
    assert_false(text_i64(span_of("9223372036854775808"), &i));
    assert_false(text_i64(span_of("-+1"), &i) || text_i64(span_of("--1"), &i) || text_i64(span_of("1.0"), &i));
}

TEST(quotes_are_safe_to_print)
{
    char buffer[TEXT_QUOTE_SIZE];
    assert_string_equal(text_quote(span_of("a\033[2Jb\xff"), buffer), "a?[2Jb?");
    assert_string_equal(text_quote(span_of(""), buffer), "");
    char longer[200];
    memset(longer, 'x', sizeof longer - 1);
    longer[sizeof longer - 1] = '\0';
    assert_int_equal(strlen(text_quote(span_of(longer), buffer)), TEXT_QUOTE_SIZE - 1);
    assert_string_equal(buffer + TEXT_QUOTE_SIZE - 4, "...");
}

int main(void)
{
    test_begin("test_trajectory_text");
    numbers = random_make(1);
    return SUITE_RUN(NULL, NULL);
}
