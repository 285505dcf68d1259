/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Constant operands. A mapping may take another way with counts, indices and patterns that it knows at compile time,
 * and the compiler computes words of constants itself, not always as the machine would: so every overload meets
 * constants too. test_spu_words.c has the variables. */
#include "support/test.h"
#include "support/suite.h"

#include <math.h>
#include <string.h>

#include "simd/spu_overloads.h"

/* ---- every overload on constants ---- */

/* Four values of each token; operands take them in turn. Those of floats reach what a conversion saturates at. */
#define A_u8 ((vec_uchar16){0, 1, 2, 0x7f, 0x80, 0x81, 0xfe, 0xff, 16, 31, 0xc0, 0xe0, 0x55, 0xaa, 15, 7})
#define B_u8 ((vec_uchar16){15, 14, 13, 12, 16, 17, 18, 19, 0x80, 0xc0, 0xe0, 0xff, 0, 0x20, 5, 6})
#define C_u8 ((vec_uchar16){4, 5, 6, 7, 0, 1, 2, 3, 20, 21, 22, 23, 24, 25, 26, 27})
#define D_u8 ((vec_uchar16){0xff, 0xff, 0, 0, 0xff, 1, 0x80, 0x7f, 3, 0, 0xf0, 0x0f, 1, 2, 4, 8})
#define A_u16 ((vec_ushort8){0, 1, 15, 16, 17, 31, 32, 0xffff})
#define B_u16 ((vec_ushort8){0x8000, 0x8001, 0x7fff, 0xfffe, 0x1234, 0x00ff, 0xff00, 3})
#define C_u16 ((vec_ushort8){0xffff, 0xfff1, 0xfff0, 0xffef, 0xffe0, 1, 2, 0x8000})
#define D_u16 ((vec_ushort8){0x5555, 0xaaaa, 0x00ff, 7, 0xffff, 0, 0x8000, 0x7fff})
#define A_u32 ((vec_uint4){1, 31, 32, 64})
#define B_u32 ((vec_uint4){0x80000001, 0xffffffff, 0x7fffffff, 0x00ff00ff})
#define C_u32 ((vec_uint4){0xffffffff, 0xffffffe1, 0xffffffe0, 0x80000000})
#define D_u32 ((vec_uint4){0, 0x12345678, 0x80000080, 0xffffff7f})
#define A_u64 ((vec_ullong2){1, 0x8000000000000000})
#define B_u64 ((vec_ullong2){0x0123456789abcdef, 0xffffffff00000000})
#define C_u64 ((vec_ullong2){0xffffffffffffffff, 0x7fffffffffffffff})
#define D_u64 ((vec_ullong2){0, 0x00ff00ff12345678})
#define A_f32 ((vec_float4){0x1p31f, -0x1p31f, 0x1p32f, -1.5f})
#define B_f32 ((vec_float4){0x1.fffffep30f, -0x1.000002p31f, 3e38f, 0x1.000002p0f})
#define C_f32 ((vec_float4){0, -0.f, 0x1p-149f, 0x1.000002p0f})
#define D_f32 ((vec_float4){INFINITY, -INFINITY, 2.5f, NAN})
#define A_f64 ((vec_double2){1, -0.})
#define B_f64 ((vec_double2){0x1.0000000000001p0, 1e300})
#define C_f64 ((vec_double2){0x1.0000000000002p0, -INFINITY})
#define D_f64 ((vec_double2){NAN, 0x1p-1074})
#define A_s8 ((vec_char16)A_u8)
#define B_s8 ((vec_char16)B_u8)
#define C_s8 ((vec_char16)C_u8)
#define D_s8 ((vec_char16)D_u8)
#define A_s16 ((vec_short8)A_u16)
#define B_s16 ((vec_short8)B_u16)
#define C_s16 ((vec_short8)C_u16)
#define D_s16 ((vec_short8)D_u16)
#define A_s32 ((vec_int4)A_u32)
#define B_s32 ((vec_int4)B_u32)
#define C_s32 ((vec_int4)C_u32)
#define D_s32 ((vec_int4)D_u32)
#define A_s64 ((vec_llong2)A_u64)
#define B_s64 ((vec_llong2)B_u64)
#define C_s64 ((vec_llong2)C_u64)
#define D_s64 ((vec_llong2)D_u64)
#define A_x_u8 ((unsigned char)0x81)
#define B_x_u8 ((unsigned char)3)
#define C_x_u8 ((unsigned char)0xff)
#define D_x_u8 ((unsigned char)0)
#define A_x_s8 ((signed char)-127)
#define B_x_s8 ((signed char)3)
#define C_x_s8 ((signed char)-1)
#define D_x_s8 ((signed char)0x7f)
#define A_x_u16 ((unsigned short)0x8001)
#define B_x_u16 ((unsigned short)3)
#define C_x_u16 ((unsigned short)0xffff)
#define D_x_u16 ((unsigned short)0x7f80)
#define A_x_s16 ((short)-3)
#define B_x_s16 ((short)17)
#define C_x_s16 ((short)-0x8000)
#define D_x_s16 ((short)12)
#define A_x_u32 13u
#define B_x_u32 0x80000001u
#define C_x_u32 0xffffffe0u
#define D_x_u32 4u
#define A_x_s32 (-13)
#define B_x_s32 33
#define C_x_s32 (-32)
#define D_x_s32 2
#define A_x_u64 0x8123456789abcdefull
#define B_x_u64 1ull
#define C_x_u64 0xffffffff00000000ull
#define D_x_u64 0ull
#define A_x_s64 (-1ll)
#define B_x_s64 0x123456789abcdefll
#define C_x_s64 (-0x7fffffffffffffffll)
#define D_x_s64 0ll
#define A_x_f32 (-0.f)
#define B_x_f32 0x1p31f
#define C_x_f32 1e-40f
#define D_x_f32 INFINITY
#define A_x_f64 0.1
#define B_x_f64 (-0.)
#define C_x_f64 1e-310
#define D_x_f64 1e300
#define A_n_scale 0
#define B_n_scale 4
#define C_n_scale 32
#define D_n_scale 127
#define A_n_special SPU_SV_NAN
#define B_n_special (SPU_SV_POS_ZERO | SPU_SV_POS_INFINITY)
#define C_n_special 0x7f
#define D_n_special (SPU_SV_NEG_ZERO | SPU_SV_NEG_INFINITY | SPU_SV_POS_DENORM)

#define SETS 4
typedef struct constant_call {
    spu_quad operand[3], result;
} constant_call;
typedef void spu_constant_calls(constant_call calls[SETS]);

#define AT1(word, r, a, k, A)                                                                                          \
    calls[k] = (constant_call) { {store_##a(A##_##a)}, store_##r(spu_##word(A##_##a)) }
#define AT2(word, r, a, b, k, A, B)                                                                                    \
    calls[k] = (constant_call) { {store_##a(A##_##a), store_##b(B##_##b)}, store_##r(spu_##word(A##_##a, B##_##b)) }
#define AT3(word, r, a, b, c, k, A, B, C)                                                                              \
    calls[k] = (constant_call)                                                                                         \
    {                                                                                                                  \
        {store_##a(A##_##a), store_##b(B##_##b), store_##c(C##_##c)}, store_##r(spu_##word(A##_##a, B##_##b, C##_##c)) \
    }
#define CONSTANT1(word, r, a)                                                                                          \
    static void constant_##word##_##r##_##a(constant_call calls[SETS])                                                 \
    {                                                                                                                  \
        AT1(word, r, a, 0, A);                                                                                         \
        AT1(word, r, a, 1, B);                                                                                         \
        AT1(word, r, a, 2, C);                                                                                         \
        AT1(word, r, a, 3, D);                                                                                         \
    }
#define CONSTANT2(word, r, a, b)                                                                                       \
    static void constant_##word##_##r##_##a##_##b(constant_call calls[SETS])                                           \
    {                                                                                                                  \
        AT2(word, r, a, b, 0, A, B);                                                                                   \
        AT2(word, r, a, b, 1, B, A);                                                                                   \
        AT2(word, r, a, b, 2, B, C);                                                                                   \
        AT2(word, r, a, b, 3, D, D);                                                                                   \
    }
#define CONSTANT3(word, r, a, b, c)                                                                                    \
    static void constant_##word##_##r##_##a##_##b##_##c(constant_call calls[SETS])                                     \
    {                                                                                                                  \
        AT3(word, r, a, b, c, 0, A, B, C);                                                                             \
        AT3(word, r, a, b, c, 1, B, C, D);                                                                             \
        AT3(word, r, a, b, c, 2, C, D, A);                                                                             \
        AT3(word, r, a, b, c, 3, D, A, B);                                                                             \
    }
CGT_SPU_WORDS(CONSTANT1, CONSTANT2, CONSTANT3)

#define CONSTANT_NAME1(word, r, a) constant_##word##_##r##_##a,
#define CONSTANT_NAME2(word, r, a, b) constant_##word##_##r##_##a##_##b,
#define CONSTANT_NAME3(word, r, a, b, c) constant_##word##_##r##_##a##_##b##_##c,
static spu_constant_calls *const constant_calls[] = {CGT_SPU_WORDS(CONSTANT_NAME1, CONSTANT_NAME2, CONSTANT_NAME3)};
static const spu_row rows[] = {CGT_SPU_WORDS(SPU_ROW1, SPU_ROW2, SPU_ROW3)};

TEST(every_overload_on_constants)
{
    uint32_t failed = 0;
    for (size_t i = 0; i < TEST_COUNT(rows); i++) {
        const spu_form form = spu_form_of(&rows[i]);
        constant_call call[SETS];
        if (spu_is_left_to_exact(&rows[i]))
            continue;
        constant_calls[i](call);
        for (int k = 0; k < SETS; k++) {
            const spu_quad expected = spu_reference_result(&form, call[k].operand);
            const int wrong = spu_reference_mismatch(&form, call[k].operand, &call[k].result, &expected);
            if (wrong >= 0)
                spu_report(&form, call[k].operand, &call[k].result, &expected, wrong);
            failed += wrong >= 0;
        }
    }
    assert_int_equal(failed, 0);
}

/* ---- constants that a mapping may require, with variables ---- */

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
