/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: native forms of the words, written by hand in the intrinsics
 * of the variant's instruction set: the best form that its flags allow. The
 * portable variant has none; it is compared with those of the machine's
 * narrowest variant.
 *
 * The forms are in simd/native, since all code that names an instruction set is in simd: native_sse.h, native_neon.h
 * and native_wide.h, each included twice: lines of
 *
 *   N1(same, word, result, a, expression)                with operands a, b, c
 *   N2(same, word, result, a, b, expression), N3(...)
 *   V2, V3   the last operand is a count, a position or a pattern
 *   K2, K3   likewise, and a literal: the expression does without it
 *
 * same: SAME where the result has the bits of the word's, OTHER where the native form does less or works in another
 * order, as code written for it only would. */
#include "vector.h"

#define SIMD_VECTORS (SIMD_BYTES / 16)
#define SIMD_ENTER
#define SIMD_LEAVE
#include "simd/simd_loop.h"

#if defined(CGT_SPU_PORTABLE) || !(defined(__SSE4_1__) || (defined(__aarch64__) && !defined(__AARCH64EB__)))

extern const simd_table SIMD_JOIN(native, CGT_VARIANT);
const simd_table SIMD_JOIN(native, CGT_VARIANT) = {SIMD_TEXT(CGT_VARIANT), CGT_LANES, 0, NULL};

#else

#if defined(__SSE4_1__)
#include "native/native_sse_parts.h"
#else
#include "native/native_neon_parts.h"
#endif
#include "native/native_wide_parts.h"

/* ---- functions ---- */

#define N1(same, word, R, A, expression) SIMD_LOOP1(native_##word##_##A, R, A, expression)
#define N2(same, word, R, A, B, expression) SIMD_LOOP2(native_##word##_##A##_##B, R, A, B, expression)
#define N3(same, word, R, A, B, C, expression) SIMD_LOOP3(native_##word##_##A##_##B##_##C, R, A, B, C, expression)
#define V2 N2
#define V3 N3
#define K2(same, word, R, A, B, expression) SIMD_LOOP1(literal_##word##_##A##_##B, R, A, expression)
#define K3(same, word, R, A, B, C, expression) SIMD_LOOP2(literal_##word##_##A##_##B##_##C, R, A, B, expression)
#if defined(__SSE4_1__)
#include "native/native_sse.h"
#else
#include "native/native_neon.h"
#endif
#undef SIMD_VECTORS
#define SIMD_VECTORS (SIMD_BYTES / (4 * CGT_LANES))
#include "native/native_wide.h"
#undef N1
#undef N2
#undef N3
#undef V2
#undef V3
#undef K2
#undef K3

/* ---- rows ---- */

#define SAME true
#define OTHER false
#define N1(same, word, R, A, expression) SIMD_ROW1(#word, SIMD_PLAIN, same, R, A, native_##word##_##A)
#define N2(same, word, R, A, B, expression) SIMD_ROW2(#word, SIMD_PLAIN, same, R, A, B, native_##word##_##A##_##B)
#define N3(same, word, R, A, B, C, expression)                                                                         \
    SIMD_ROW3(#word, SIMD_PLAIN, same, R, A, B, C, native_##word##_##A##_##B##_##C)
#define V2(same, word, R, A, B, expression) SIMD_ROW2(#word, SIMD_VARIABLE, same, R, A, B, native_##word##_##A##_##B)
#define V3(same, word, R, A, B, C, expression)                                                                         \
    SIMD_ROW3(#word, SIMD_VARIABLE, same, R, A, B, C, native_##word##_##A##_##B##_##C)
#define K2(same, word, R, A, B, expression) SIMD_ROW2(#word, SIMD_CONSTANT, same, R, A, B, literal_##word##_##A##_##B)
#define K3(same, word, R, A, B, C, expression)                                                                         \
    SIMD_ROW3(#word, SIMD_CONSTANT, same, R, A, B, C, literal_##word##_##A##_##B##_##C)

/* clang-format off */
static const simd_row rows[] = {
#if defined(__SSE4_1__)
#include "native/native_sse.h"
#else
#include "native/native_neon.h"
#endif
#include "native/native_wide.h"
};
/* clang-format on */

SIMD_TABLE(native, rows)

#endif
