/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * For an SPU: every overload of simd/spu/spu_words.h by the compiler's own header, one function each, in the order of
 * the table. A record is three operands and the result, a quadword each; a scalar lies in element 0 of its own. */
#include "spu/serve.h"

#include "spu/spu_words.h"

/* ---- tokens ---- */

typedef int TYPE_n_scale, TYPE_n_special;
#define LOAD_n_scale LOAD_x_s32
#define LOAD_n_special LOAD_x_s32

/* Scalars go through memory, not through words that are under test. */
#define TOKEN(name, vec, scalar)                                                                                       \
    typedef vec TYPE_##name;                                                                                           \
    typedef scalar TYPE_x_##name;                                                                                      \
    static inline vec LOAD_##name(const vec_uint4 *quad) { return (vec)*quad; }                                        \
    static inline scalar LOAD_x_##name(const vec_uint4 *quad)                                                          \
    {                                                                                                                  \
        const union {                                                                                                  \
            vec_uint4 quad;                                                                                            \
            scalar element;                                                                                            \
        } u = {*quad};                                                                                                 \
        return u.element;                                                                                              \
    }                                                                                                                  \
    static inline vec_uint4 STORE_##name(vec v) { return (vec_uint4)v; }                                               \
    static inline vec_uint4 STORE_x_##name(scalar x)                                                                   \
    {                                                                                                                  \
        union {                                                                                                        \
            vec_uint4 quad;                                                                                            \
            scalar element;                                                                                            \
        } u = {{0, 0, 0, 0}};                                                                                          \
        u.element = x;                                                                                                 \
        return u.quad;                                                                                                 \
    }
#pragma GCC diagnostic ignored "-Wunused-function" /* no word returns some of the scalars */
TOKEN(u8, vec_uchar16, unsigned char)
TOKEN(s8, vec_char16, signed char)
TOKEN(u16, vec_ushort8, unsigned short)
TOKEN(s16, vec_short8, short)
TOKEN(u32, vec_uint4, unsigned int)
TOKEN(s32, vec_int4, int)
TOKEN(u64, vec_ullong2, unsigned long long)
TOKEN(s64, vec_llong2, long long)
TOKEN(f32, vec_float4, float)
TOKEN(f64, vec_double2, double)

/* ---- an operand that has to be a constant: one case for each ---- */

/* clang-format off */
#define EACH_OF_8(M, n) M(n) M((n) + 1) M((n) + 2) M((n) + 3) M((n) + 4) M((n) + 5) M((n) + 6) M((n) + 7)
#define EACH_OF_128(M)                                                                                                 \
    EACH_OF_8(M, 0) EACH_OF_8(M, 8) EACH_OF_8(M, 16) EACH_OF_8(M, 24) EACH_OF_8(M, 32) EACH_OF_8(M, 40)                \
    EACH_OF_8(M, 48) EACH_OF_8(M, 56) EACH_OF_8(M, 64) EACH_OF_8(M, 72) EACH_OF_8(M, 80) EACH_OF_8(M, 88)              \
    EACH_OF_8(M, 96) EACH_OF_8(M, 104) EACH_OF_8(M, 112) EACH_OF_8(M, 120)

#define VARIABLE(result, word, x, y) result = spu_##word(x, y)
#define CONSTANT(result, word, x, y)                                                                                   \
    switch (y) {                                                                                                       \
        EACH_OF_128(CASE_##word)                                                                                       \
    default: break;                                                                                                    \
    }
#define CASE_convtf(n) case n: z = spu_convtf(x, n); break;
#define CASE_convts(n) case n: z = spu_convts(x, n); break;
#define CASE_convtu(n) case n: z = spu_convtu(x, n); break;
#define CASE_testsv(n) case n: z = spu_testsv(x, n); break;
/* clang-format on */

#define SECOND_n_scale CONSTANT
#define SECOND_n_special CONSTANT
#define SECOND_u8 VARIABLE
#define SECOND_s8 VARIABLE
#define SECOND_u16 VARIABLE
#define SECOND_s16 VARIABLE
#define SECOND_u32 VARIABLE
#define SECOND_s32 VARIABLE
#define SECOND_u64 VARIABLE
#define SECOND_s64 VARIABLE
#define SECOND_f32 VARIABLE
#define SECOND_f64 VARIABLE
#define SECOND_x_u8 VARIABLE
#define SECOND_x_s8 VARIABLE
#define SECOND_x_u16 VARIABLE
#define SECOND_x_s16 VARIABLE
#define SECOND_x_u32 VARIABLE
#define SECOND_x_s32 VARIABLE

/* ---- one function per overload ---- */

#define CALL1(word, r, a)                                                                                              \
    static void call_##word##_##r##_##a(vec_uint4 *record) { record[3] = STORE_##r(spu_##word(LOAD_##a(&record[0]))); }
#define CALL2(word, r, a, b)                                                                                           \
    static void call_##word##_##r##_##a##_##b(vec_uint4 *record)                                                       \
    {                                                                                                                  \
        const TYPE_##a x = LOAD_##a(&record[0]);                                                                       \
        const TYPE_##b y = LOAD_##b(&record[1]);                                                                       \
        TYPE_##r z = {0};                                                                                              \
        SECOND_##b(z, word, x, y);                                                                                     \
        record[3] = STORE_##r(z);                                                                                      \
    }
#define CALL3(word, r, a, b, c)                                                                                        \
    static void call_##word##_##r##_##a##_##b##_##c(vec_uint4 *record)                                                 \
    {                                                                                                                  \
        const TYPE_##a x = LOAD_##a(&record[0]);                                                                       \
        const TYPE_##b y = LOAD_##b(&record[1]);                                                                       \
        const TYPE_##c z = LOAD_##c(&record[2]);                                                                       \
        record[3] = STORE_##r(spu_##word(x, y, z));                                                                    \
    }
CGT_SPU_WORDS(CALL1, CALL2, CALL3)

#define NAME1(word, r, a) call_##word##_##r##_##a,
#define NAME2(word, r, a, b) call_##word##_##r##_##a##_##b,
#define NAME3(word, r, a, b, c) call_##word##_##r##_##a##_##b##_##c,
static serve_call *const calls[] = {CGT_SPU_WORDS(NAME1, NAME2, NAME3)};

int main(void) { return serve(calls, sizeof calls / sizeof calls[0], 4); }
