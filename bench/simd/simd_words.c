/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: every overload of the vocabulary's table on the mapping of a
 * variant. Counts, positions and patterns are measured twice: as operands that
 * are loaded, and as literals.
 *
 * With CGT_SPU_EXACT: those that compute in single precision, as an SPU does.
 */
#include "vector.h"

#include "spu_words.h"

#define SIMD_VECTORS (SIMD_BYTES / 16)
#define SIMD_ENTER const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
#define SIMD_LEAVE cgt_spu_leave_arithmetic(saved);
#include "simd/simd_loop.h"

typedef vec_uchar16 SIMD_TYPE_u8;
typedef vec_char16 SIMD_TYPE_s8;
typedef vec_ushort8 SIMD_TYPE_u16;
typedef vec_short8 SIMD_TYPE_s16;
typedef vec_uint4 SIMD_TYPE_u32;
typedef vec_int4 SIMD_TYPE_s32;
typedef vec_ullong2 SIMD_TYPE_u64;
typedef vec_llong2 SIMD_TYPE_s64;
typedef vec_float4 SIMD_TYPE_f32;
typedef vec_double2 SIMD_TYPE_f64;

/* ---- literals in place of the last operand ---- */

#define SIMD_LITERAL_extract 1
#define SIMD_LITERAL_insert 1
#define SIMD_LITERAL_promote 0
#define SIMD_LITERAL_sl 5
#define SIMD_LITERAL_sr 5
#define SIMD_LITERAL_sra 5
#define SIMD_LITERAL_rl 5
#define SIMD_LITERAL_rlmask (-5)
#define SIMD_LITERAL_rlmaska (-5)
#define SIMD_LITERAL_slqw 3
#define SIMD_LITERAL_srqw 3
#define SIMD_LITERAL_rlqw 3
#define SIMD_LITERAL_rlmaskqw (-3)
#define SIMD_LITERAL_slqwbyte 8
#define SIMD_LITERAL_srqwbyte 8
#define SIMD_LITERAL_rlqwbyte 8
#define SIMD_LITERAL_rlmaskqwbyte (-8)
#define SIMD_LITERAL_slqwbytebc 64
#define SIMD_LITERAL_srqwbytebc 64
#define SIMD_LITERAL_rlqwbytebc 64
#define SIMD_LITERAL_rlmaskqwbytebc (-64)

/* a0 b0 a1 b1 in words, as transposes need it; a0 b1 in doublewords */
#define SIMD_PATTERN_WORDS ((vec_uchar16){0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23})
#define SIMD_PATTERN_DOUBLEWORDS ((vec_uchar16){0, 1, 2, 3, 4, 5, 6, 7, 24, 25, 26, 27, 28, 29, 30, 31})
#define SIMD_PATTERN_u8 SIMD_PATTERN_WORDS
#define SIMD_PATTERN_s8 SIMD_PATTERN_WORDS
#define SIMD_PATTERN_u16 SIMD_PATTERN_WORDS
#define SIMD_PATTERN_s16 SIMD_PATTERN_WORDS
#define SIMD_PATTERN_u32 SIMD_PATTERN_WORDS
#define SIMD_PATTERN_s32 SIMD_PATTERN_WORDS
#define SIMD_PATTERN_f32 SIMD_PATTERN_WORDS
#define SIMD_PATTERN_u64 SIMD_PATTERN_DOUBLEWORDS
#define SIMD_PATTERN_s64 SIMD_PATTERN_DOUBLEWORDS
#define SIMD_PATTERN_f64 SIMD_PATTERN_DOUBLEWORDS

/* shifts by a vector of counts have no literal row */
#define SIMD_IF_SCALAR_u16(...)
#define SIMD_IF_SCALAR_s16(...)
#define SIMD_IF_SCALAR_u32(...)
#define SIMD_IF_SCALAR_s32(...)
#define SIMD_IF_SCALAR_x_u32(...) __VA_ARGS__
#define SIMD_IF_SCALAR_x_s16(...) __VA_ARGS__
#define SIMD_IF_SCALAR_x_s32(...) __VA_ARGS__

#define SIMD_COUNT_OF_sel SIMD_PLAIN
#define SIMD_COUNT_OF_shuffle SIMD_VARIABLE

/* ---- functions ---- */

#define NONE(...)
#define RUN1(word, R, A) SIMD_LOOP1(run_##word##_##A, R, A, spu_##word(a))
#define RUN2(word, R, A, B) SIMD_LOOP2(run_##word##_##A##_##B, R, A, B, spu_##word(a, b))
#define RUN3(word, R, A, B, C) SIMD_LOOP3(run_##word##_##A##_##B##_##C, R, A, B, C, spu_##word(a, b, c))
#define LITERAL2(word, R, A, B)                                                                                        \
    SIMD_IF_SCALAR_##B(SIMD_LOOP1(literal_##word##_##A##_##B, R, A, spu_##word(a, SIMD_LITERAL_##word)))
#define LITERAL3(word, R, A, B, C)                                                                                     \
    SIMD_LOOP2(literal_##word##_##A##_##B##_##C, R, A, B, spu_##word(a, b, SIMD_LITERAL_##word))
#define SHUFFLE3(word, R, A, B, C)                                                                                     \
    SIMD_LOOP2(literal_##word##_##A##_##B##_##C, R, A, B, spu_##word(a, b, SIMD_PATTERN_##A))

/* ---- rows ---- */

#define PLAIN1(word, R, A) SIMD_ROW1("spu_" #word, SIMD_PLAIN, true, R, A, run_##word##_##A)
#define PLAIN2(word, R, A, B) SIMD_ROW2("spu_" #word, SIMD_PLAIN, true, R, A, B, run_##word##_##A##_##B)
#define PLAIN3(word, R, A, B, C) SIMD_ROW3("spu_" #word, SIMD_PLAIN, true, R, A, B, C, run_##word##_##A##_##B##_##C)
#define VARIABLE2(word, R, A, B) SIMD_ROW2("spu_" #word, SIMD_VARIABLE, true, R, A, B, run_##word##_##A##_##B)
#define VARIABLE3(word, R, A, B, C)                                                                                    \
    SIMD_ROW3("spu_" #word, SIMD_VARIABLE, true, R, A, B, C, run_##word##_##A##_##B##_##C)
#define BITS3(word, R, A, B, C)                                                                                        \
    SIMD_ROW3("spu_" #word, SIMD_COUNT_OF_##word, true, R, A, B, C, run_##word##_##A##_##B##_##C)
#define CONSTANT2(word, R, A, B)                                                                                       \
    SIMD_IF_SCALAR_##B(SIMD_ROW2("spu_" #word, SIMD_CONSTANT, true, R, A, B, literal_##word##_##A##_##B))
#define CONSTANT3(word, R, A, B, C)                                                                                    \
    SIMD_ROW3("spu_" #word, SIMD_CONSTANT, true, R, A, B, C, literal_##word##_##A##_##B##_##C)

/* ---- the table ---- */

#if defined(CGT_SPU_EXACT)

#define SIMD_PART exact
CGT_SPU_WORDS_CONVERT(RUN1, RUN2, RUN3)
CGT_SPU_WORDS_ARITHMETIC(RUN1, RUN2, RUN3)
CGT_SPU_WORDS_COMPARE(RUN1, RUN2, RUN3)

static const simd_row rows[] = {
    CGT_SPU_WORDS_CONVERT(PLAIN1, PLAIN2, PLAIN3)    /* convtf, convts, convtu */
    CGT_SPU_WORDS_ARITHMETIC(PLAIN1, PLAIN2, PLAIN3) /* those with floats */
    CGT_SPU_WORDS_COMPARE(PLAIN1, PLAIN2, PLAIN3)    /* likewise; the rest is as without CGT_SPU_EXACT */
};

#else

#define SIMD_PART words
SIMD_LOOP1(load_store_1, f32, f32, a)
SIMD_LOOP2(load_store_2, f32, f32, f32, a)
SIMD_LOOP3(load_store_3, f32, f32, f32, f32, a)

CGT_SPU_WORDS(RUN1, RUN2, RUN3)
CGT_SPU_WORDS_SCALAR(NONE, LITERAL2, LITERAL3)
CGT_SPU_WORDS_SHIFT(NONE, LITERAL2, NONE)
CGT_SPU_WORDS_SHIFT_QUAD(NONE, LITERAL2, NONE)
CGT_SPU_THIRD(SHUFFLE3, shuffle, u8, u8, u8, u8)

static const simd_row rows[] = {
    SIMD_ROW1("load_store", SIMD_PLAIN, true, f32, f32, load_store_1)
        SIMD_ROW2("load_store", SIMD_PLAIN, true, f32, f32, f32, load_store_2)
            SIMD_ROW3("load_store", SIMD_PLAIN, true, f32, f32, f32, f32, load_store_3)
                CGT_SPU_WORDS_SCALAR(PLAIN1, VARIABLE2, VARIABLE3) CGT_SPU_WORDS_SCALAR(NONE, CONSTANT2, CONSTANT3)
                    CGT_SPU_WORDS_CONVERT(PLAIN1, PLAIN2, PLAIN3) CGT_SPU_WORDS_ARITHMETIC(PLAIN1, PLAIN2, PLAIN3)
                        CGT_SPU_WORDS_BYTE(PLAIN1, PLAIN2, PLAIN3) CGT_SPU_WORDS_COMPARE(PLAIN1, PLAIN2, PLAIN3)
                            CGT_SPU_WORDS_BITS(PLAIN1, PLAIN2, BITS3) CGT_SPU_THIRD(CONSTANT3, shuffle, u8, u8, u8, u8)
                                CGT_SPU_WORDS_LOGIC(PLAIN1, PLAIN2, PLAIN3)
                                    CGT_SPU_WORDS_SHIFT(PLAIN1, VARIABLE2, VARIABLE3)
                                        CGT_SPU_WORDS_SHIFT(NONE, CONSTANT2, NONE)
                                            CGT_SPU_WORDS_SHIFT_QUAD(PLAIN1, VARIABLE2, VARIABLE3)
                                                CGT_SPU_WORDS_SHIFT_QUAD(NONE, CONSTANT2, NONE)};

#endif

SIMD_TABLE(SIMD_PART, rows)
