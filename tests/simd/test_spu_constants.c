/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Constant operands. A mapping may take another way with counts, indices and patterns that it knows at compile time:
 * they give what variables of the same value give, which test_spu_words.c compares. */
#include "support/test.h"
#include "support/suite.h"

#include <string.h>

#include "simd/spu_overloads.h"

static const vec_uchar16 bytes = {0xf0, 0x81, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 0x8f};
static const vec_uint4 words = {0x80010203, 0x04050607, 0x88090a0b, 0x0c0d0e0f};
static const vec_short8 halves = {-0x7fff, 2, 3, 0x4567, -5, 6, 7, 0x7ffe};
static const vec_double2 doubles = {1.1, -2.2};

#define CHECK_SAME(text, type, constant, variable)                                                                     \
    do {                                                                                                               \
        const type constant_ = (constant), variable_ = (variable);                                                     \
        if (memcmp(&constant_, &variable_, sizeof constant_) != 0)                                                     \
            fail_msg("%s differs from the same with a variable", text);                                                \
    } while (0)

/* ---- counts ---- */

/* The value is the same, and the compiler does not know it. */
static int variable(int n)
{
    volatile int hidden = n;
    return hidden;
}

#define CHECK_COUNT(word, type, a, n)                                                                                  \
    CHECK_SAME("spu_" #word " by " #n, type, spu_##word(a, n), spu_##word(a, variable(n)))
#define CHECK_COUNTS(word, type, a)                                                                                    \
    do {                                                                                                               \
        CHECK_COUNT(word, type, a, 0);                                                                                 \
        CHECK_COUNT(word, type, a, 1);                                                                                 \
        CHECK_COUNT(word, type, a, 3);                                                                                 \
        CHECK_COUNT(word, type, a, 4);                                                                                 \
        CHECK_COUNT(word, type, a, 7);                                                                                 \
        CHECK_COUNT(word, type, a, 8);                                                                                 \
        CHECK_COUNT(word, type, a, 15);                                                                                \
        CHECK_COUNT(word, type, a, 16);                                                                                \
        CHECK_COUNT(word, type, a, 31);                                                                                \
        CHECK_COUNT(word, type, a, 32);                                                                                \
        CHECK_COUNT(word, type, a, 63);                                                                                \
        CHECK_COUNT(word, type, a, 64);                                                                                \
        CHECK_COUNT(word, type, a, 100);                                                                               \
        CHECK_COUNT(word, type, a, -1);                                                                                \
        CHECK_COUNT(word, type, a, -4);                                                                                \
        CHECK_COUNT(word, type, a, -13);                                                                               \
        CHECK_COUNT(word, type, a, -16);                                                                               \
        CHECK_COUNT(word, type, a, -31);                                                                               \
        CHECK_COUNT(word, type, a, -32);                                                                               \
        CHECK_COUNT(word, type, a, -100);                                                                              \
    } while (0)

#define ELEMENT_SHIFT(word)                                                                                            \
    TEST(word##_by_constants)                                                                                          \
    {                                                                                                                  \
        (void)state;                                                                                                   \
        CHECK_COUNTS(word, vec_uint4, words);                                                                          \
        CHECK_COUNTS(word, vec_short8, halves);                                                                        \
    }
#define QUAD_SHIFT(word)                                                                                               \
    TEST(word##_by_constants)                                                                                          \
    {                                                                                                                  \
        (void)state;                                                                                                   \
        CHECK_COUNTS(word, vec_uchar16, bytes);                                                                        \
        CHECK_COUNTS(word, vec_short8, halves);                                                                        \
        CHECK_COUNTS(word, vec_uint4, words);                                                                          \
        CHECK_COUNTS(word, vec_double2, doubles);                                                                      \
    }
ELEMENT_SHIFT(sl)
ELEMENT_SHIFT(sr)
ELEMENT_SHIFT(sra)
ELEMENT_SHIFT(rl)
ELEMENT_SHIFT(rlmask)
ELEMENT_SHIFT(rlmaska)
QUAD_SHIFT(slqw)
QUAD_SHIFT(slqwbyte)
QUAD_SHIFT(slqwbytebc)
QUAD_SHIFT(srqw)
QUAD_SHIFT(srqwbyte)
QUAD_SHIFT(srqwbytebc)
QUAD_SHIFT(rlqw)
QUAD_SHIFT(rlqwbyte)
QUAD_SHIFT(rlqwbytebc)
QUAD_SHIFT(rlmaskqw)
QUAD_SHIFT(rlmaskqwbyte)
QUAD_SHIFT(rlmaskqwbytebc)

/* ---- indices ---- */

#define CHECK_INDEX(n)                                                                                                 \
    do {                                                                                                               \
        CHECK_SAME("spu_extract at " #n, unsigned char, spu_extract(bytes, n), spu_extract(bytes, variable(n)));       \
        CHECK_SAME("spu_extract at " #n, short, spu_extract(halves, n), spu_extract(halves, variable(n)));             \
        CHECK_SAME("spu_extract at " #n, unsigned, spu_extract(words, n), spu_extract(words, variable(n)));            \
        CHECK_SAME("spu_extract at " #n, double, spu_extract(doubles, n), spu_extract(doubles, variable(n)));          \
        CHECK_SAME("spu_insert at " #n, vec_uchar16, spu_insert(99, bytes, n), spu_insert(99, bytes, variable(n)));    \
        CHECK_SAME("spu_insert at " #n, vec_uint4, spu_insert(99, words, n), spu_insert(99, words, variable(n)));      \
        CHECK_SAME("spu_insert at " #n, vec_double2, spu_insert(.5, doubles, n),                                       \
                   spu_insert(.5, doubles, variable(n)));                                                              \
    } while (0)

TEST(constant_indices)
{
    CHECK_INDEX(0);
    CHECK_INDEX(1);
    CHECK_INDEX(2);
    CHECK_INDEX(3);
    CHECK_INDEX(5);
    CHECK_INDEX(15);
    CHECK_INDEX(16);
    CHECK_INDEX(-1);
}

/* ---- patterns ---- */

static vec_uchar16 variable_pattern(vec_uchar16 pattern)
{
    volatile uint8_t hidden[16];
    for (int k = 0; k < 16; k++)
        hidden[k] = pattern[k];
    for (int k = 0; k < 16; k++)
        pattern[k] = hidden[k];
    return pattern;
}

#define CHECK_PATTERN(...)                                                                                             \
    do {                                                                                                               \
        const vec_uchar16 p_ = {__VA_ARGS__};                                                                          \
        CHECK_SAME("spu_shuffle of bytes", vec_uchar16, spu_shuffle(bytes, ~bytes, p_),                                \
                   spu_shuffle(bytes, ~bytes, variable_pattern(p_)));                                                  \
        CHECK_SAME("spu_shuffle of halfwords", vec_short8, spu_shuffle(halves, ~halves, p_),                           \
                   spu_shuffle(halves, ~halves, variable_pattern(p_)));                                                \
        CHECK_SAME("spu_shuffle of words", vec_uint4, spu_shuffle(words, ~words, p_),                                  \
                   spu_shuffle(words, ~words, variable_pattern(p_)));                                                  \
        CHECK_SAME("spu_shuffle of doubles", vec_double2, spu_shuffle(doubles, -doubles, p_),                          \
                   spu_shuffle(doubles, -doubles, variable_pattern(p_)));                                              \
    } while (0)

TEST(constant_patterns)
{
    CHECK_PATTERN(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    CHECK_PATTERN(16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31);
    CHECK_PATTERN(12, 13, 14, 15, 8, 9, 10, 11, 4, 5, 6, 7, 0, 1, 2, 3); /* words of one operand */
    CHECK_PATTERN(0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23);
    CHECK_PATTERN(8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23);
    CHECK_PATTERN(2, 3, 0, 1, 18, 19, 16, 17, 10, 11, 8, 9, 26, 27, 24, 25); /* halfwords */
    CHECK_PATTERN(3, 2, 1, 0, 7, 6, 5, 4, 31, 30, 29, 28, 0x80, 0xc0, 0xe0, 0xff);
    CHECK_PATTERN(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16);
}

VARIANT_SUITE("test_spu_constants", NULL, NULL)
