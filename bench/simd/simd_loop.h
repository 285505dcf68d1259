/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: the loop that every row runs, mapped or native. The including file defines
 *
 *   SIMD_TYPE_<token>   the C type of each kind of operand and result
 *   SIMD_CLASS_vm       how masks are held, see below: VECTOR, or MASK with SIMD_HOLD_MASK and SIMD_USE_MASK
 *   SIMD_VECTORS        in an array
 *   SIMD_ENTER, SIMD_LEAVE   around the loop; may be empty
 *
 * For each element of the arrays: the operands are loaded, the word is applied SIMD_APPLIED times, and the last result
 * is stored. Empty asms hold operands, which tells the compiler that they change, and use results. So nothing is folded
 * into a load, moved out of the loop, merged with its neighbours or removed. The compiler unrolls neither form. */
#ifndef SIMD_LOOP_H
#define SIMD_LOOP_H

#include <string.h>

#include "simd/simd_rows.h"

/* ---- holding operands, using results: by the class of the token ---- */

#if defined(__x86_64__)
#define SIMD_REGISTER "x"
#elif defined(__aarch64__)
#define SIMD_REGISTER "w"
#else /* where vectors live is the compiler's choice: through memory, mapped   \
         and native alike */
#define SIMD_REGISTER "m"
#endif
#define SIMD_HOLD_VECTOR(v) __asm__ volatile("" : "+" SIMD_REGISTER(v))
#define SIMD_USE_VECTOR(v) __asm__ volatile("" : : SIMD_REGISTER(v))
#define SIMD_HOLD_INT(v) __asm__ volatile("" : "+r"(v))
#define SIMD_USE_INT(v) __asm__ volatile("" : : "r"(v))
/* literals: what was loaded is not used, nor is the literal where the
 * expression has its own */
#define SIMD_HOLD_SCALE(v) v = SIMD_SCALE, (void)v
#define SIMD_HOLD_SPECIAL(v) v = SIMD_SPECIAL, (void)v

#define SIMD_CLASS_u8 VECTOR
#define SIMD_CLASS_s8 VECTOR
#define SIMD_CLASS_u16 VECTOR
#define SIMD_CLASS_s16 VECTOR
#define SIMD_CLASS_u32 VECTOR
#define SIMD_CLASS_s32 VECTOR
#define SIMD_CLASS_u64 VECTOR
#define SIMD_CLASS_s64 VECTOR
#define SIMD_CLASS_f32 VECTOR
#define SIMD_CLASS_f64 VECTOR
#define SIMD_CLASS_x_f32 VECTOR
#define SIMD_CLASS_x_f64 VECTOR
#define SIMD_CLASS_vf VECTOR
#define SIMD_CLASS_vi VECTOR
#define SIMD_CLASS_vu VECTOR
#define SIMD_CLASS_x_u8 INT
#define SIMD_CLASS_x_s8 INT
#define SIMD_CLASS_x_u16 INT
#define SIMD_CLASS_x_s16 INT
#define SIMD_CLASS_x_u32 INT
#define SIMD_CLASS_x_s32 INT
#define SIMD_CLASS_x_u64 INT
#define SIMD_CLASS_x_s64 INT
#define SIMD_CLASS_n_scale SCALE
#define SIMD_CLASS_n_special SPECIAL
#define SIMD_PASTE_(a, b) a##b
#define SIMD_PASTE(a, b) SIMD_PASTE_(a, b)
#define SIMD_HOLD(K, v) SIMD_PASTE(SIMD_HOLD_, SIMD_CLASS_##K)(v);
#define SIMD_USE(K, v) SIMD_PASTE(SIMD_USE_, SIMD_CLASS_##K)(v);

typedef int SIMD_TYPE_n_scale, SIMD_TYPE_n_special;
typedef unsigned char SIMD_TYPE_x_u8;
typedef signed char SIMD_TYPE_x_s8;
typedef unsigned short SIMD_TYPE_x_u16;
typedef short SIMD_TYPE_x_s16;
typedef unsigned SIMD_TYPE_x_u32;
typedef int SIMD_TYPE_x_s32;
typedef unsigned long long SIMD_TYPE_x_u64;
typedef long long SIMD_TYPE_x_s64;
typedef float SIMD_TYPE_x_f32;
typedef double SIMD_TYPE_x_f64;

/* Literals: a scale of 8, and the classes of all that is not finite. */
#define SIMD_SCALE 8
#define SIMD_SPECIAL 0x70

/* ---- the loop ---- */

#if defined(__clang__)
#define SIMD_NOT_UNROLLED _Pragma("clang loop unroll(disable)")
#elif defined(__GNUC__)
#define SIMD_NOT_UNROLLED _Pragma("GCC unroll 1")
#endif

/* Element i of an array. The arrays begin at multiples of their 1024 bytes, so
 * each element at one of its own size. */
#define SIMD_LOAD(value, array) memcpy(&value, (array) + i * sizeof value, sizeof value);
#define SIMD_STORE(array, value) memcpy((array) + i * sizeof value, &value, sizeof value);

#define SIMD_LOOP_BEGIN(name)                                                                                          \
    static __attribute__((aligned(64))) void name(simd_memory *memory, size_t passes)                                  \
    {                                                                                                                  \
        simd_memory *const m = __builtin_assume_aligned(memory, 4096);                                                 \
        SIMD_ENTER                                                                                                     \
        for (size_t pass = 0; pass < passes; pass++) {                                                                 \
            __asm__ volatile("" : : "r"(m) : "memory");                                                                \
            SIMD_NOT_UNROLLED for (size_t i = 0; i < (SIMD_VECTORS); i++)                                              \
            {
#define SIMD_LOOP_END(R)                                                                                               \
    SIMD_HOLD(R, r)                                                                                                    \
    SIMD_STORE(m->result, r)                                                                                           \
    }                                                                                                                  \
    }                                                                                                                  \
    SIMD_LEAVE                                                                                                         \
    }
#define SIMD_FOUR_TIMES(step) step step step step /* SIMD_APPLIED */

#define SIMD_LOOP1(name, R, A, expression)                                                                             \
    SIMD_LOOP_BEGIN(name)                                                                                              \
    SIMD_TYPE_##A a;                                                                                                   \
    SIMD_LOAD(a, m->a)                                                                                                 \
    SIMD_TYPE_##R r;                                                                                                   \
    SIMD_FOUR_TIMES(SIMD_HOLD(A, a) r = (expression); SIMD_USE(R, r))                                                  \
    SIMD_LOOP_END(R)
#define SIMD_LOOP2(name, R, A, B, expression)                                                                          \
    SIMD_LOOP_BEGIN(name)                                                                                              \
    SIMD_TYPE_##A a;                                                                                                   \
    SIMD_LOAD(a, m->a)                                                                                                 \
    SIMD_TYPE_##B b;                                                                                                   \
    SIMD_LOAD(b, m->b)                                                                                                 \
    SIMD_TYPE_##R r;                                                                                                   \
    SIMD_FOUR_TIMES(SIMD_HOLD(A, a) SIMD_HOLD(B, b) r = (expression); SIMD_USE(R, r))                                  \
    SIMD_LOOP_END(R)
#define SIMD_LOOP3(name, R, A, B, C, expression)                                                                       \
    SIMD_LOOP_BEGIN(name)                                                                                              \
    SIMD_TYPE_##A a;                                                                                                   \
    SIMD_LOAD(a, m->a)                                                                                                 \
    SIMD_TYPE_##B b;                                                                                                   \
    SIMD_LOAD(b, m->b)                                                                                                 \
    SIMD_TYPE_##C c;                                                                                                   \
    SIMD_LOAD(c, m->c)                                                                                                 \
    SIMD_TYPE_##R r;                                                                                                   \
    SIMD_FOUR_TIMES(SIMD_HOLD(A, a) SIMD_HOLD(B, b) SIMD_HOLD(C, c) r = (expression); SIMD_USE(R, r))                  \
    SIMD_LOOP_END(R)

/* ---- rows ---- */

#define SIMD_ROW1(word, count, is_same, R, A, run)                                                                     \
    {word, count, is_same, SIMD_##R, {SIMD_##A, SIMD_NONE, SIMD_NONE}, run},
#define SIMD_ROW2(word, count, is_same, R, A, B, run)                                                                  \
    {word, count, is_same, SIMD_##R, {SIMD_##A, SIMD_##B, SIMD_NONE}, run},
#define SIMD_ROW3(word, count, is_same, R, A, B, C, run)                                                               \
    {word, count, is_same, SIMD_##R, {SIMD_##A, SIMD_##B, SIMD_##C}, run},

/* The name of a table: bench_simd_PART_VARIANT. */
#define SIMD_JOIN_(part, variant) bench_simd_##part##_##variant
#define SIMD_JOIN(part, variant) SIMD_JOIN_(part, variant)
#define SIMD_TEXT_(x) #x
#define SIMD_TEXT(x) SIMD_TEXT_(x)
#define SIMD_TABLE(part, rows)                                                                                         \
    extern const simd_table SIMD_JOIN(part, CGT_VARIANT);                                                              \
    const simd_table SIMD_JOIN(part, CGT_VARIANT) = {SIMD_TEXT(CGT_VARIANT), CGT_LANES,                                \
                                                     sizeof(rows) / sizeof(rows)[0], rows};

#endif
