/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The table of the vocabulary: every typed overload of every word that computes. It drives the tests, the micro-bench
 * and the check of docs/guide/spu.md; programs that include spu_intrinsics.h do not need it.
 *
 * CGT_SPU_WORDS(W1, W2, W3) expands to one macro call per overload, by the number of operands:
 *   W1(word, result, a)   W2(word, result, a, b)   W3(word, result, a, b, c)
 *
 * Types are tokens:
 *   u8 s8 u16 s16 u32 s32 u64 s64 f32 f64   vectors: vec_uchar16, vec_char16 ... vec_double2
 *   x_u8 ... x_f64                          scalars: an element of that vector
 *   n_scale                                 an int from 0 to 127 (on an SPU a constant)
 *   n_special                               a sum of SPU_SV_* (on an SPU a constant)
 *
 * Words that do not compute are not here: channels, control, DMA (spu_channels.h) and the halting comparisons, four
 * overloads. Source: the language extension for the Cell Broadband Engine as GCC 9 implements it, 447 overloads of 62
 * words (those of spu_hcmpeq and spu_hcmpgt included) and 12 words of one type. */
#ifndef CGT_SPU_WORDS_H
#define CGT_SPU_WORDS_H

/* ---- rows of one form, for all ten types ---- */

#define CGT_SPU_SAME2(W, word)                                                                                         \
    W(word, u8, u8, u8)                                                                                                \
    W(word, s8, s8, s8)                                                                                                \
    W(word, u16, u16, u16)                                                                                             \
    W(word, s16, s16, s16)                                                                                             \
    W(word, u32, u32, u32)                                                                                             \
    W(word, s32, s32, s32)                                                                                             \
    W(word, u64, u64, u64)                                                                                             \
    W(word, s64, s64, s64)                                                                                             \
    W(word, f32, f32, f32)                                                                                             \
    W(word, f64, f64, f64)
#define CGT_SPU_QUAD(W, word, count)                                                                                   \
    W(word, u8, u8, count)                                                                                             \
    W(word, s8, s8, count)                                                                                             \
    W(word, u16, u16, count)                                                                                           \
    W(word, s16, s16, count)                                                                                           \
    W(word, u32, u32, count)                                                                                           \
    W(word, s32, s32, count)                                                                                           \
    W(word, u64, u64, count)                                                                                           \
    W(word, s64, s64, count)                                                                                           \
    W(word, f32, f32, count)                                                                                           \
    W(word, f64, f64, count)
#define CGT_SPU_THIRD(W, word, m8, m16, m32, m64)                                                                      \
    W(word, u8, u8, u8, m8)                                                                                            \
    W(word, s8, s8, s8, m8)                                                                                            \
    W(word, u16, u16, u16, m16)                                                                                        \
    W(word, s16, s16, s16, m16)                                                                                        \
    W(word, u32, u32, u32, m32)                                                                                        \
    W(word, s32, s32, s32, m32)                                                                                        \
    W(word, u64, u64, u64, m64)                                                                                        \
    W(word, s64, s64, s64, m64)                                                                                        \
    W(word, f32, f32, f32, m32)                                                                                        \
    W(word, f64, f64, f64, m64)

/* ---- rows of one form, for fewer types ---- */

#define CGT_SPU_SCALAR_INTS(W, word)                                                                                   \
    W(word, u8, u8, x_u8)                                                                                              \
    W(word, s8, s8, x_s8)                                                                                              \
    W(word, u16, u16, x_u16)                                                                                           \
    W(word, s16, s16, x_s16)                                                                                           \
    W(word, u32, u32, x_u32)                                                                                           \
    W(word, s32, s32, x_s32)
#define CGT_SPU_SUM(W, word)                                                                                           \
    W(word, u16, u16, u16)                                                                                             \
    W(word, s16, s16, s16)                                                                                             \
    W(word, u32, u32, u32)                                                                                             \
    W(word, s32, s32, s32)                                                                                             \
    W(word, f32, f32, f32)                                                                                             \
    W(word, f64, f64, f64)
#define CGT_SPU_COMPARE(W, word)                                                                                       \
    W(word, u8, u8, u8)                                                                                                \
    W(word, u8, s8, s8)                                                                                                \
    W(word, u16, u16, u16)                                                                                             \
    W(word, u16, s16, s16)                                                                                             \
    W(word, u32, u32, u32)                                                                                             \
    W(word, u32, s32, s32)                                                                                             \
    W(word, u32, f32, f32)                                                                                             \
    W(word, u64, f64, f64)                                                                                             \
    W(word, u8, u8, x_u8)                                                                                              \
    W(word, u8, s8, x_s8)                                                                                              \
    W(word, u16, u16, x_u16)                                                                                           \
    W(word, u16, s16, x_s16)                                                                                           \
    W(word, u32, u32, x_u32)                                                                                           \
    W(word, u32, s32, x_s32)
#define CGT_SPU_SHIFT(W, word, v16, v32, x)                                                                            \
    W(word, u16, u16, v16)                                                                                             \
    W(word, s16, s16, v16)                                                                                             \
    W(word, u32, u32, v32)                                                                                             \
    W(word, s32, s32, v32)                                                                                             \
    W(word, u16, u16, x)                                                                                               \
    W(word, s16, s16, x)                                                                                               \
    W(word, u32, u32, x)                                                                                               \
    W(word, s32, s32, x)
#define CGT_SPU_WORDS32_2(W, word) W(word, u32, u32, u32) W(word, s32, s32, s32)
#define CGT_SPU_WORDS32_3(W, word) W(word, u32, u32, u32, u32) W(word, s32, s32, s32, s32)
#define CGT_SPU_FLOATS2(W, word) W(word, f32, f32, f32) W(word, f64, f64, f64)
#define CGT_SPU_FLOATS3(W, word) W(word, f32, f32, f32, f32) W(word, f64, f64, f64, f64)
#define CGT_SPU_COMPARE_ABS(W, word) W(word, u32, f32, f32) W(word, u64, f64, f64)
#define CGT_SPU_MASK(W, word, result)                                                                                  \
    W(word, result, x_u16) W(word, result, x_s16) W(word, result, x_u32) W(word, result, x_s32)

/* ---- the table ---- */

#define CGT_SPU_WORDS(W1, W2, W3)                                                                                      \
    CGT_SPU_WORDS_SCALAR(W1, W2, W3)                                                                                   \
    CGT_SPU_WORDS_CONVERT(W1, W2, W3)                                                                                  \
    CGT_SPU_WORDS_ARITHMETIC(W1, W2, W3)                                                                               \
    CGT_SPU_WORDS_BYTE(W1, W2, W3)                                                                                     \
    CGT_SPU_WORDS_COMPARE(W1, W2, W3)                                                                                  \
    CGT_SPU_WORDS_BITS(W1, W2, W3)                                                                                     \
    CGT_SPU_WORDS_LOGIC(W1, W2, W3)                                                                                    \
    CGT_SPU_WORDS_SHIFT(W1, W2, W3)                                                                                    \
    CGT_SPU_WORDS_SHIFT_QUAD(W1, W2, W3)

#define CGT_SPU_WORDS_SCALAR(W1, W2, W3)                                                                               \
    W1(splats, u8, x_u8)                                                                                               \
    W1(splats, s8, x_s8)                                                                                               \
    W1(splats, u16, x_u16)                                                                                             \
    W1(splats, s16, x_s16)                                                                                             \
    W1(splats, u32, x_u32)                                                                                             \
    W1(splats, s32, x_s32)                                                                                             \
    W1(splats, u64, x_u64)                                                                                             \
    W1(splats, s64, x_s64)                                                                                             \
    W1(splats, f32, x_f32)                                                                                             \
    W1(splats, f64, x_f64)                                                                                             \
    W2(extract, x_u8, u8, x_s32)                                                                                       \
    W2(extract, x_s8, s8, x_s32)                                                                                       \
    W2(extract, x_u16, u16, x_s32)                                                                                     \
    W2(extract, x_s16, s16, x_s32)                                                                                     \
    W2(extract, x_u32, u32, x_s32)                                                                                     \
    W2(extract, x_s32, s32, x_s32)                                                                                     \
    W2(extract, x_u64, u64, x_s32)                                                                                     \
    W2(extract, x_s64, s64, x_s32)                                                                                     \
    W2(extract, x_f32, f32, x_s32)                                                                                     \
    W2(extract, x_f64, f64, x_s32)                                                                                     \
    W3(insert, u8, x_u8, u8, x_s32)                                                                                    \
    W3(insert, s8, x_s8, s8, x_s32)                                                                                    \
    W3(insert, u16, x_u16, u16, x_s32)                                                                                 \
    W3(insert, s16, x_s16, s16, x_s32)                                                                                 \
    W3(insert, u32, x_u32, u32, x_s32)                                                                                 \
    W3(insert, s32, x_s32, s32, x_s32)                                                                                 \
    W3(insert, u64, x_u64, u64, x_s32)                                                                                 \
    W3(insert, s64, x_s64, s64, x_s32)                                                                                 \
    W3(insert, f32, x_f32, f32, x_s32)                                                                                 \
    W3(insert, f64, x_f64, f64, x_s32)                                                                                 \
    W2(promote, u8, x_u8, x_s32)                                                                                       \
    W2(promote, s8, x_s8, x_s32)                                                                                       \
    W2(promote, u16, x_u16, x_s32)                                                                                     \
    W2(promote, s16, x_s16, x_s32)                                                                                     \
    W2(promote, u32, x_u32, x_s32)                                                                                     \
    W2(promote, s32, x_s32, x_s32)                                                                                     \
    W2(promote, u64, x_u64, x_s32)                                                                                     \
    W2(promote, s64, x_s64, x_s32)                                                                                     \
    W2(promote, f32, x_f32, x_s32)                                                                                     \
    W2(promote, f64, x_f64, x_s32)

#define CGT_SPU_WORDS_CONVERT(W1, W2, W3)                                                                              \
    W2(convtf, f32, u32, n_scale)                                                                                      \
    W2(convtf, f32, s32, n_scale)                                                                                      \
    W2(convts, s32, f32, n_scale)                                                                                      \
    W2(convtu, u32, f32, n_scale)                                                                                      \
    W1(extend, s16, s8)                                                                                                \
    W1(extend, s32, s16)                                                                                               \
    W1(extend, s64, s32)                                                                                               \
    W1(extend, f64, f32)                                                                                               \
    W1(roundtf, f32, f64)

#define CGT_SPU_WORDS_ARITHMETIC(W1, W2, W3)                                                                           \
    CGT_SPU_SUM(W2, add)                                                                                               \
    W2(add, u16, u16, x_u16)                                                                                           \
    W2(add, s16, s16, x_s16)                                                                                           \
    W2(add, u32, u32, x_u32)                                                                                           \
    W2(add, s32, s32, x_s32)                                                                                           \
    CGT_SPU_SUM(W2, sub)                                                                                               \
    W2(sub, u16, x_u16, u16)                                                                                           \
    W2(sub, s16, x_s16, s16)                                                                                           \
    W2(sub, u32, x_u32, u32)                                                                                           \
    W2(sub, s32, x_s32, s32)                                                                                           \
    CGT_SPU_WORDS32_3(W3, addx)                                                                                        \
    CGT_SPU_WORDS32_3(W3, subx)                                                                                        \
    CGT_SPU_WORDS32_2(W2, genc)                                                                                        \
    CGT_SPU_WORDS32_3(W3, gencx)                                                                                       \
    CGT_SPU_WORDS32_2(W2, genb)                                                                                        \
    CGT_SPU_WORDS32_3(W3, genbx)                                                                                       \
    CGT_SPU_FLOATS2(W2, mul)                                                                                           \
    CGT_SPU_FLOATS3(W3, madd)                                                                                          \
    W3(madd, s32, s16, s16, s32)                                                                                       \
    CGT_SPU_FLOATS3(W3, msub)                                                                                          \
    CGT_SPU_FLOATS3(W3, nmsub)                                                                                         \
    W3(nmadd, f64, f64, f64, f64)                                                                                      \
    W2(mule, u32, u16, u16)                                                                                            \
    W2(mule, s32, s16, s16)                                                                                            \
    W2(mulo, u32, u16, u16)                                                                                            \
    W2(mulo, s32, s16, s16)                                                                                            \
    W2(mulo, u32, u16, x_u16)                                                                                          \
    W2(mulo, s32, s16, x_s16)                                                                                          \
    W2(mulh, s32, s16, s16)                                                                                            \
    W2(mulsr, s32, s16, s16)                                                                                           \
    W3(mhhadd, u32, u16, u16, u32)                                                                                     \
    W3(mhhadd, s32, s16, s16, s32)                                                                                     \
    W1(re, f32, f32)                                                                                                   \
    W1(rsqrte, f32, f32)

#define CGT_SPU_WORDS_BYTE(W1, W2, W3)                                                                                 \
    W2(absd, u8, u8, u8)                                                                                               \
    W2(avg, u8, u8, u8)                                                                                                \
    W2(sumb, u16, u8, u8)

#define CGT_SPU_WORDS_COMPARE(W1, W2, W3)                                                                              \
    CGT_SPU_COMPARE(W2, cmpeq)                                                                                         \
    CGT_SPU_COMPARE(W2, cmpgt)                                                                                         \
    CGT_SPU_COMPARE_ABS(W2, cmpabseq)                                                                                  \
    CGT_SPU_COMPARE_ABS(W2, cmpabsgt)                                                                                  \
    W2(testsv, u64, f64, n_special)

#define CGT_SPU_WORDS_BITS(W1, W2, W3)                                                                                 \
    W1(cntb, u8, u8)                                                                                                   \
    W1(cntb, u8, s8)                                                                                                   \
    W1(cntlz, u32, u32)                                                                                                \
    W1(cntlz, u32, s32)                                                                                                \
    W1(cntlz, u32, f32)                                                                                                \
    W1(gather, u32, u8)                                                                                                \
    W1(gather, u32, s8)                                                                                                \
    W1(gather, u32, u16)                                                                                               \
    W1(gather, u32, s16)                                                                                               \
    W1(gather, u32, u32)                                                                                               \
    W1(gather, u32, s32)                                                                                               \
    W1(gather, u32, f32)                                                                                               \
    CGT_SPU_MASK(W1, maskb, u8)                                                                                        \
    CGT_SPU_MASK(W1, maskh, u16)                                                                                       \
    W1(maskh, u16, x_u8)                                                                                               \
    W1(maskh, u16, x_s8)                                                                                               \
    CGT_SPU_MASK(W1, maskw, u32)                                                                                       \
    W1(maskw, u32, x_u8)                                                                                               \
    W1(maskw, u32, x_s8)                                                                                               \
    CGT_SPU_THIRD(W3, sel, u8, u16, u32, u64)                                                                          \
    CGT_SPU_THIRD(W3, shuffle, u8, u8, u8, u8)

#define CGT_SPU_WORDS_LOGIC(W1, W2, W3)                                                                                \
    CGT_SPU_SAME2(W2, and)                                                                                             \
    CGT_SPU_SCALAR_INTS(W2, and)                                                                                       \
    CGT_SPU_SAME2(W2, or)                                                                                              \
    CGT_SPU_SCALAR_INTS(W2, or)                                                                                        \
    CGT_SPU_SAME2(W2, xor)                                                                                             \
    CGT_SPU_SCALAR_INTS(W2, xor)                                                                                       \
    CGT_SPU_SAME2(W2, andc)                                                                                            \
    CGT_SPU_SAME2(W2, orc)                                                                                             \
    CGT_SPU_SAME2(W2, nand)                                                                                            \
    CGT_SPU_SAME2(W2, nor)                                                                                             \
    CGT_SPU_SAME2(W2, eqv)                                                                                             \
    W1(orx, u32, u32)                                                                                                  \
    W1(orx, s32, s32)

#define CGT_SPU_WORDS_SHIFT(W1, W2, W3)                                                                                \
    CGT_SPU_SHIFT(W2, sl, u16, u32, x_u32)                                                                             \
    CGT_SPU_SHIFT(W2, sr, u16, u32, x_u32)                                                                             \
    CGT_SPU_SHIFT(W2, sra, u16, u32, x_u32)                                                                            \
    W2(rl, u16, u16, s16)                                                                                              \
    W2(rl, s16, s16, s16)                                                                                              \
    W2(rl, u32, u32, s32)                                                                                              \
    W2(rl, s32, s32, s32)                                                                                              \
    W2(rl, u16, u16, x_s16)                                                                                            \
    W2(rl, s16, s16, x_s16)                                                                                            \
    W2(rl, u32, u32, x_s32)                                                                                            \
    W2(rl, s32, s32, x_s32)                                                                                            \
    CGT_SPU_SHIFT(W2, rlmask, s16, s32, x_s32)                                                                         \
    CGT_SPU_SHIFT(W2, rlmaska, s16, s32, x_s32)

#define CGT_SPU_WORDS_SHIFT_QUAD(W1, W2, W3)                                                                           \
    CGT_SPU_QUAD(W2, slqw, x_u32)                                                                                      \
    CGT_SPU_QUAD(W2, slqwbyte, x_u32)                                                                                  \
    CGT_SPU_QUAD(W2, slqwbytebc, x_u32)                                                                                \
    CGT_SPU_QUAD(W2, srqw, x_u32)                                                                                      \
    CGT_SPU_QUAD(W2, srqwbyte, x_u32)                                                                                  \
    CGT_SPU_QUAD(W2, srqwbytebc, x_u32)                                                                                \
    CGT_SPU_QUAD(W2, rlqw, x_s32)                                                                                      \
    CGT_SPU_QUAD(W2, rlqwbyte, x_s32)                                                                                  \
    CGT_SPU_QUAD(W2, rlqwbytebc, x_s32)                                                                                \
    CGT_SPU_QUAD(W2, rlmaskqw, x_s32)                                                                                  \
    CGT_SPU_QUAD(W2, rlmaskqwbyte, x_s32)                                                                              \
    CGT_SPU_QUAD(W2, rlmaskqwbytebc, x_s32)

#endif
