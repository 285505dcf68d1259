/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Entry point of the spu_* vocabulary: the generic intrinsics of the SPU's C language extension. On an SPU it includes
 * the compiler's own header; elsewhere a mapping provides the same names, types, lane order and results, so that SPU
 * source compiles on today's machines. Compile source that tests `#ifdef __SPU__` with -D__SPU__ -DCGT_SPU_HOST.
 *
 * The mapping: CGT_SPU_PORTABLE forces plain C; otherwise SSE4.1, AArch64 NEON or WebAssembly's vectors where the
 * compiler flags allow them; otherwise plain C.
 *
 * Floating point: the host's IEEE arithmetic, faster than the SPU's but different. CGT_SPU_FUSED and
 * CGT_SPU_FUSED_DOUBLE tell whether madd, msub, nmsub and nmadd round once (1), as on an SPU, or twice (0). With
 * CGT_SPU_EXACT defined, single precision is the SPU's, bit by bit: see spu_exact.h, and spu_arithmetic_mode.h for the
 * two calls that enclose it.
 *
 * Elements are in the order of the SPU on every host, each in the host's byte order. Words that work on bytes (shuffle,
 * the quadword's shifts) count them as an SPU does, by the type of the operand; spu_types.h explains casts.
 *
 * A macro picks the typed function, cgt_spu_WORD_TYPE, by the type of an operand. It evaluates each operand once; a
 * wrong type is a compile error. The words, their overloads and what they cost are in docs/guide/spu.md, their table in
 * spu_words.h.
 *
 * Thread safety: no word keeps state, except the host interface of spu_channels.h, which is per thread. */
#if defined(__SPU__) && !defined(CGT_SPU_HOST)
#include_next <spu_intrinsics.h> /* before any guard: a file in this folder that includes it finds this header again */
#elif !defined(CGT_SPU_INTRINSICS_H)
#define CGT_SPU_INTRINSICS_H

#if defined(CGT_SPU_EXACT)
#include "spu/spu_exact.h"
#endif
#if defined(CGT_SPU_PORTABLE)
#include "spu/spu_portable.h"
#elif defined(__SSE4_1__)
#include "spu/spu_sse.h"
#elif defined(__aarch64__) && !defined(__AARCH64EB__)
#include "spu/spu_neon.h"
#elif defined(__wasm_simd128__)
#include "spu/spu_wasm.h"
#else
#include "spu/spu_portable.h"
#endif

#include "spu/spu_arithmetic_mode.h"

#include "spu/spu_operand_check.h"
#include "spu/spu_wide.h" /* in kernels at eight or sixteen lanes the words know the wide types too */

/* ---- selection by the type of x, among the types for which a word exists; `wide` adds the wide ones ---- */

/* clang-format off */
#define CGT_SPU_OF_HALFWORDS(word) vec_ushort8: cgt_spu_##word##_u16, vec_short8: cgt_spu_##word##_s16
#define CGT_SPU_OF_WORDS(word) vec_uint4: cgt_spu_##word##_u32, vec_int4: cgt_spu_##word##_s32
#define CGT_SPU_OF_BYTES(word) vec_uchar16: cgt_spu_##word##_u8, vec_char16: cgt_spu_##word##_s8
#define CGT_SPU_OF_FLOATS(word) vec_float4: cgt_spu_##word##_f32, vec_double2: cgt_spu_##word##_f64
#define CGT_SPU_OF_LONGS(word) vec_ullong2: cgt_spu_##word##_u64, vec_llong2: cgt_spu_##word##_s64
#define CGT_SPU_OF_INTS(word) CGT_SPU_OF_BYTES(word), CGT_SPU_OF_HALFWORDS(word), CGT_SPU_OF_WORDS(word)
#define CGT_SPU_OF_ALL(word) CGT_SPU_OF_INTS(word), CGT_SPU_OF_LONGS(word), CGT_SPU_OF_FLOATS(word)

#define CGT_SPU_PICK_ALL(word, wide, x) _Generic((x), wide CGT_SPU_OF_ALL(word))
#define CGT_SPU_PICK_FLOATS(word, wide, x) _Generic((x), wide CGT_SPU_OF_FLOATS(word))
#define CGT_SPU_PICK_WORDS32(word, wide, x) _Generic((x), wide CGT_SPU_OF_WORDS(word))

/* Scalar operands, by their exact type; long has the width that it has on the host, char is unsigned as on an SPU. */
#if __SIZEOF_LONG__ == 8
#define CGT_SPU_OF_LONG(word) long: cgt_spu_##word##_s64, unsigned long: cgt_spu_##word##_u64
#else
#define CGT_SPU_OF_LONG(word) long: cgt_spu_##word##_s32, unsigned long: cgt_spu_##word##_u32
#endif
#define CGT_SPU_PICK_SCALAR(word, x)                                                                                   \
    _Generic((x), float: cgt_spu_##word##_f32, double: cgt_spu_##word##_f64,                                           \
             signed char: cgt_spu_##word##_s8, unsigned char: cgt_spu_##word##_u8, char: cgt_spu_##word##_u8,          \
             short: cgt_spu_##word##_s16, unsigned short: cgt_spu_##word##_u16,                                        \
             int: cgt_spu_##word##_s32, unsigned: cgt_spu_##word##_u32, CGT_SPU_OF_LONG(word),                         \
             long long: cgt_spu_##word##_s64, unsigned long long: cgt_spu_##word##_u64)

/* Words whose second operand is a vector or a scalar. Where b is a scalar, a selects. Any other pair ends at
 * a function that takes no operands and whose name states the mistake. */
struct cgt_spu_no_operand;
void cgt_spu_operands_have_no_such_overload(struct cgt_spu_no_operand);
#define CGT_SPU_HALFWORDS_X(word)                                                                                      \
    vec_ushort8: cgt_spu_##word##_u16_x, vec_short8: cgt_spu_##word##_s16_x
#define CGT_SPU_WORDS_X(word) vec_uint4: cgt_spu_##word##_u32_x, vec_int4: cgt_spu_##word##_s32_x
#define CGT_SPU_BYTES_X(word) vec_uchar16: cgt_spu_##word##_u8_x, vec_char16: cgt_spu_##word##_s8_x
#define CGT_SPU_ELSE_NONE default: cgt_spu_operands_have_no_such_overload

/* b, a vector of a's type, for the types of `list`; or a scalar */
#define CGT_SPU_PICK_OR_INT(word, list, wide, a, b)                                                                    \
    _Generic((b), wide list(word), default:                                                                            \
             _Generic((a), CGT_SPU_BYTES_X(word), CGT_SPU_HALFWORDS_X(word), CGT_SPU_WORDS_X(word), CGT_SPU_ELSE_NONE))
#define CGT_SPU_LIST_SUM(word)                                                                                         \
    CGT_SPU_OF_HALFWORDS(word), CGT_SPU_OF_WORDS(word), CGT_SPU_OF_FLOATS(word)
#define CGT_SPU_PICK_SUM(word, wide, a, b)                                                                             \
    _Generic((b), wide CGT_SPU_LIST_SUM(word), default:                                                                \
             _Generic((a), CGT_SPU_HALFWORDS_X(word), CGT_SPU_WORDS_X(word), CGT_SPU_ELSE_NONE))
#define CGT_SPU_LIST_COMPARE(word) CGT_SPU_OF_INTS(word), CGT_SPU_OF_FLOATS(word)
/* a shift: a selects, then the count, a scalar or a vector of the type that goes with a */
#define CGT_SPU_COUNTED(word, type, vec, n)                                                                            \
    _Generic((n), vec: cgt_spu_##word##_##type, default: cgt_spu_##word##_##type##_x)
#define CGT_SPU_PICK_SHIFT(word, wide, count16, count32, a, n)                                                         \
    _Generic((a), wide vec_ushort8: CGT_SPU_COUNTED(word, u16, count16, n),                                            \
             vec_short8: CGT_SPU_COUNTED(word, s16, count16, n), vec_uint4: CGT_SPU_COUNTED(word, u32, count32, n),    \
             vec_int4: CGT_SPU_COUNTED(word, s32, count32, n))

/* ---- scalars and elements ---- */

#define spu_splats(a) CGT_SPU_PICK_SCALAR(splats, a)(a)
#define spu_extract(a, position) CGT_SPU_PICK_ALL(extract, , a)(a, position)
#define spu_insert(a, b, position) CGT_SPU_PICK_ALL(insert, , b)(a, b, position)
#define spu_promote(a, position) CGT_SPU_PICK_SCALAR(promote, a)(a, position)

/* ---- conversion ---- */

#define spu_convtf(a, scale) CGT_SPU_PICK_WORDS32(convtf, CGT_SPU_WIDE_SU(convtf), a)(a, scale)
#define spu_convts(a, scale) _Generic((a), CGT_SPU_WIDE_F(convts) vec_float4: cgt_spu_convts_f32)(a, scale)
#define spu_convtu(a, scale) _Generic((a), vec_float4: cgt_spu_convtu_f32)(a, scale)
#define spu_extend(a)                                                                                                  \
    _Generic((a), vec_char16: cgt_spu_extend_s8, vec_short8: cgt_spu_extend_s16, vec_int4: cgt_spu_extend_s32,         \
             vec_float4: cgt_spu_extend_f32)(a)
#define spu_roundtf(a) _Generic((a), vec_double2: cgt_spu_roundtf_f64)(a)

/* ---- arithmetic ---- */

#define spu_add(a, b) CGT_SPU_PICK_SUM(add, CGT_SPU_WIDE_FSU(add), a, b)(CGT_SPU_OPERAND_LIKE(b, a), b)
/* a scalar minuend stands first; then b is the vector */
#define spu_sub(a, b)                                                                                                  \
    _Generic((a), CGT_SPU_WIDE_FSU(sub) CGT_SPU_LIST_SUM(sub), default:                                                \
             _Generic((b), CGT_SPU_HALFWORDS_X(sub), CGT_SPU_WORDS_X(sub), CGT_SPU_ELSE_NONE))                         \
    (a, CGT_SPU_OPERAND_LIKE(a, b))
#define spu_addx(a, b, c) CGT_SPU_PICK_WORDS32(addx, , a)(a, CGT_SPU_OPERAND_SAME(a, b), CGT_SPU_OPERAND_SAME(a, c))
#define spu_subx(a, b, c) CGT_SPU_PICK_WORDS32(subx, , a)(a, CGT_SPU_OPERAND_SAME(a, b), CGT_SPU_OPERAND_SAME(a, c))
#define spu_genc(a, b) CGT_SPU_PICK_WORDS32(genc, , a)(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_gencx(a, b, c) CGT_SPU_PICK_WORDS32(gencx, , a)(a, CGT_SPU_OPERAND_SAME(a, b), CGT_SPU_OPERAND_SAME(a, c))
#define spu_genb(a, b) CGT_SPU_PICK_WORDS32(genb, , a)(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_genbx(a, b, c) CGT_SPU_PICK_WORDS32(genbx, , a)(a, CGT_SPU_OPERAND_SAME(a, b), CGT_SPU_OPERAND_SAME(a, c))
#define spu_mul(a, b) CGT_SPU_PICK_FLOATS(mul, CGT_SPU_WIDE_F(mul), a)(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_madd(a, b, c)                                                                                              \
    _Generic((a), CGT_SPU_WIDE_F(madd) CGT_SPU_OF_FLOATS(madd), vec_short8: cgt_spu_madd_s16)                          \
    (a, CGT_SPU_OPERAND_SAME(a, b), CGT_SPU_OPERAND_ADDEND(a, c))
#define spu_msub(a, b, c) CGT_SPU_PICK_FLOATS(msub, CGT_SPU_WIDE_F(msub), a)                                           \
    (a, CGT_SPU_OPERAND_SAME(a, b), CGT_SPU_OPERAND_SAME(a, c))
#define spu_nmsub(a, b, c) CGT_SPU_PICK_FLOATS(nmsub, CGT_SPU_WIDE_F(nmsub), a)                                        \
    (a, CGT_SPU_OPERAND_SAME(a, b), CGT_SPU_OPERAND_SAME(a, c))
#define spu_nmadd(a, b, c) _Generic((a), vec_double2: cgt_spu_nmadd_f64)                                               \
    (a, CGT_SPU_OPERAND_SAME(a, b), CGT_SPU_OPERAND_SAME(a, c))
#define spu_mule(a, b) _Generic((a), CGT_SPU_OF_HALFWORDS(mule))(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_mulo(a, b)                                                                                                 \
    _Generic((b), CGT_SPU_OF_HALFWORDS(mulo), default:                                                                 \
             _Generic((a), CGT_SPU_HALFWORDS_X(mulo), CGT_SPU_ELSE_NONE))(CGT_SPU_OPERAND_LIKE(b, a), b)
#define spu_mulh(a, b) _Generic((a), vec_short8: cgt_spu_mulh_s16)(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_mulsr(a, b) _Generic((a), vec_short8: cgt_spu_mulsr_s16)(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_mhhadd(a, b, c) _Generic((a), CGT_SPU_OF_HALFWORDS(mhhadd))                                                \
    (a, CGT_SPU_OPERAND_SAME(a, b), CGT_SPU_OPERAND_ADDEND(a, c))
#define spu_re(a) _Generic((a), CGT_SPU_WIDE_F(re) vec_float4: cgt_spu_re_f32)(a)
#define spu_rsqrte(a) _Generic((a), CGT_SPU_WIDE_F(rsqrte) vec_float4: cgt_spu_rsqrte_f32)(a)
/* the estimates as the SPU's two instructions, on quadwords: even generic SPU source uses these three */
#define si_frest(a) ((qword)cgt_spu_frest_f32((vec_float4)(a)))
#define si_frsqest(a) ((qword)cgt_spu_frsqest_f32((vec_float4)(a)))
#define si_fi(a, b) ((qword)cgt_spu_fi_f32((vec_float4)(a), (vec_float4)(b)))
#define spu_absd(a, b) _Generic((a), vec_uchar16: cgt_spu_absd_u8)(a, CGT_SPU_OPERAND_IS(vec_uchar16, b))
#define spu_avg(a, b) _Generic((a), vec_uchar16: cgt_spu_avg_u8)(a, CGT_SPU_OPERAND_IS(vec_uchar16, b))
#define spu_sumb(a, b) _Generic((a), vec_uchar16: cgt_spu_sumb_u8)(a, CGT_SPU_OPERAND_IS(vec_uchar16, b))

/* ---- comparison ---- */

#define spu_cmpeq(a, b) CGT_SPU_PICK_OR_INT(cmpeq, CGT_SPU_LIST_COMPARE, CGT_SPU_WIDE_FSU(cmpeq), a, b)                \
    (CGT_SPU_OPERAND_LIKE(b, a), b)
#define spu_cmpgt(a, b) CGT_SPU_PICK_OR_INT(cmpgt, CGT_SPU_LIST_COMPARE, CGT_SPU_WIDE_FSU(cmpgt), a, b)                \
    (CGT_SPU_OPERAND_LIKE(b, a), b)
#define spu_cmpabseq(a, b) CGT_SPU_PICK_FLOATS(cmpabseq, , a)(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_cmpabsgt(a, b) CGT_SPU_PICK_FLOATS(cmpabsgt, CGT_SPU_WIDE_F(cmpabsgt), a)(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_testsv(a, classes) _Generic((a), vec_double2: cgt_spu_testsv_f64)(a, classes)

/* ---- bits and masks ---- */

#define spu_cntb(a) _Generic((a), CGT_SPU_OF_BYTES(cntb))(a)
#define spu_cntlz(a) _Generic((a), CGT_SPU_OF_WORDS(cntlz), vec_float4: cgt_spu_cntlz_f32)(a)
#define spu_gather(a) _Generic((a), CGT_SPU_OF_INTS(gather), vec_float4: cgt_spu_gather_f32)(a)
#define spu_maskb(a) cgt_spu_maskb((unsigned)(a))
#define spu_maskh(a) cgt_spu_maskh((unsigned)(a))
#define spu_maskw(a) cgt_spu_maskw((unsigned)(a))
#define spu_sel(a, b, m) CGT_SPU_PICK_ALL(sel, CGT_SPU_WIDE_FSU(sel), a)                                               \
    (a, CGT_SPU_OPERAND_SAME(a, b), CGT_SPU_OPERAND_MASK(a, m))
#define spu_shuffle(a, b, pattern) CGT_SPU_PICK_ALL(shuffle, , a)                                                      \
    (a, CGT_SPU_OPERAND_SAME(a, b), CGT_SPU_OPERAND_IS(vec_uchar16, pattern))

/* Casts a to a vector type with the SPU's result on hosts of either byte order. It matters where the element sizes
 * differ. Not a word of the SPU, where a plain cast does the same. */
#define spux_cast(type, a)                                                                                             \
    ((type)cgt_spu_cast_bytes((vec_uchar16)(a), (unsigned)sizeof((a)[0]), (unsigned)sizeof(((type){0})[0])))

/* ---- logic ---- */

#define spu_and(a, b) CGT_SPU_PICK_OR_INT(and, CGT_SPU_OF_ALL, CGT_SPU_WIDE_FSUM(and), a, b)                           \
    (CGT_SPU_OPERAND_LIKE(b, a), b)
#define spu_or(a, b) CGT_SPU_PICK_OR_INT(or, CGT_SPU_OF_ALL, CGT_SPU_WIDE_FSUM(or), a, b)(CGT_SPU_OPERAND_LIKE(b, a), b)
#define spu_xor(a, b) CGT_SPU_PICK_OR_INT(xor, CGT_SPU_OF_ALL, CGT_SPU_WIDE_FSUM(xor), a, b)                           \
    (CGT_SPU_OPERAND_LIKE(b, a), b)
#define spu_andc(a, b) CGT_SPU_PICK_ALL(andc, CGT_SPU_WIDE_FSUM(andc), a)(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_orc(a, b) CGT_SPU_PICK_ALL(orc, , a)(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_nand(a, b) CGT_SPU_PICK_ALL(nand, , a)(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_nor(a, b) CGT_SPU_PICK_ALL(nor, CGT_SPU_WIDE_FSUM(nor), a)(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_eqv(a, b) CGT_SPU_PICK_ALL(eqv, , a)(a, CGT_SPU_OPERAND_SAME(a, b))
#define spu_orx(a) CGT_SPU_PICK_WORDS32(orx, , a)(a)

/* ---- shifts and rotations of elements; counts from the element's width on leave zeros or sign bits ---- */

#define spu_sl(a, count) CGT_SPU_PICK_SHIFT(sl, CGT_SPU_WIDE_SU(sl), vec_ushort8, vec_uint4, a, count)(a, count)
#define spu_sr(a, count) CGT_SPU_PICK_SHIFT(sr, CGT_SPU_WIDE_SU(sr), vec_ushort8, vec_uint4, a, count)(a, count)
#define spu_sra(a, count) CGT_SPU_PICK_SHIFT(sra, CGT_SPU_WIDE_SU(sra), vec_ushort8, vec_uint4, a, count)(a, count)
#define spu_rl(a, count) CGT_SPU_PICK_SHIFT(rl, , vec_short8, vec_int4, a, count)(a, count)
#define spu_rlmask(a, count) CGT_SPU_PICK_SHIFT(rlmask, , vec_short8, vec_int4, a, count)(a, count)
#define spu_rlmaska(a, count) CGT_SPU_PICK_SHIFT(rlmaska, , vec_short8, vec_int4, a, count)(a, count)

/* ---- shifts and rotations of the quadword ---- */

#define spu_slqw(a, count) CGT_SPU_PICK_ALL(slqw, , a)(a, count)
#define spu_slqwbyte(a, count) CGT_SPU_PICK_ALL(slqwbyte, , a)(a, count)
#define spu_slqwbytebc(a, count) CGT_SPU_PICK_ALL(slqwbytebc, , a)(a, count)
#define spu_srqw(a, count) CGT_SPU_PICK_ALL(srqw, , a)(a, count)
#define spu_srqwbyte(a, count) CGT_SPU_PICK_ALL(srqwbyte, , a)(a, count)
#define spu_srqwbytebc(a, count) CGT_SPU_PICK_ALL(srqwbytebc, , a)(a, count)
#define spu_rlqw(a, count) CGT_SPU_PICK_ALL(rlqw, , a)(a, count)
#define spu_rlqwbyte(a, count) CGT_SPU_PICK_ALL(rlqwbyte, , a)(a, count)
#define spu_rlqwbytebc(a, count) CGT_SPU_PICK_ALL(rlqwbytebc, , a)(a, count)
#define spu_rlmaskqw(a, count) CGT_SPU_PICK_ALL(rlmaskqw, , a)(a, count)
#define spu_rlmaskqwbyte(a, count) CGT_SPU_PICK_ALL(rlmaskqwbyte, , a)(a, count)
#define spu_rlmaskqwbytebc(a, count) CGT_SPU_PICK_ALL(rlmaskqwbytebc, , a)(a, count)
/* clang-format on */

#ifndef CGT_LANES /* kernels have no channels, and their objects none of these symbols */
#include "spu_channels.h"
#endif

#endif
