/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: the words on the vectors of a variant (simd/vector.h): the
 * SPU's where those are wider than four lanes, and the extension words. */
#include "vector.h"

#define SIMD_VECTORS (SIMD_BYTES / (4 * CGT_LANES))
#define SIMD_ENTER
#define SIMD_LEAVE
#include "simd/simd_loop.h"

typedef vfloat SIMD_TYPE_vf;
typedef vint SIMD_TYPE_vi;
typedef vuint SIMD_TYPE_vu;
typedef vmask SIMD_TYPE_vm;
#if CGT_LANES == 16
#define SIMD_CLASS_vm MASK
#define SIMD_HOLD_MASK(m) __asm__ volatile("" : "+k"(m.bits))
#define SIMD_USE_MASK(m) __asm__ volatile("" : : "k"(m.bits))
#else
#define SIMD_CLASS_vm VECTOR
#endif

#define FLOATS ((const float *)(const void *)m->table)

/* ---- X1(word, result, a, expression), X2, X3; K2: the last operand is a
 * literal ---- */

#if CGT_LANES == 4
#define SIMD_WIDE_WORDS(X1, X2, X3) /* the words of the table */
#else
#define SIMD_WIDE_WORDS(X1, X2, X3)                                                                                    \
    X1(load_store, vf, vf, a)                                                                                          \
    X2(load_store, vf, vf, vf, a)                                                                                      \
    X3(load_store, vf, vf, vf, vf, a)                                                                                  \
    X1(spu_re, vf, vf, spu_re(a))                                                                                      \
    X1(spu_rsqrte, vf, vf, spu_rsqrte(a))                                                                              \
    X2(spu_add, vf, vf, vf, spu_add(a, b))                                                                             \
    X2(spu_add, vi, vi, vi, spu_add(a, b))                                                                             \
    X2(spu_add, vu, vu, vu, spu_add(a, b))                                                                             \
    X2(spu_sub, vf, vf, vf, spu_sub(a, b))                                                                             \
    X2(spu_sub, vi, vi, vi, spu_sub(a, b))                                                                             \
    X2(spu_sub, vu, vu, vu, spu_sub(a, b))                                                                             \
    X2(spu_mul, vf, vf, vf, spu_mul(a, b))                                                                             \
    X3(spu_madd, vf, vf, vf, vf, spu_madd(a, b, c))                                                                    \
    X3(spu_msub, vf, vf, vf, vf, spu_msub(a, b, c))                                                                    \
    X3(spu_nmsub, vf, vf, vf, vf, spu_nmsub(a, b, c))                                                                  \
    X2(spu_cmpeq, vm, vf, vf, spu_cmpeq(a, b))                                                                         \
    X2(spu_cmpeq, vm, vi, vi, spu_cmpeq(a, b))                                                                         \
    X2(spu_cmpeq, vm, vu, vu, spu_cmpeq(a, b))                                                                         \
    X2(spu_cmpgt, vm, vf, vf, spu_cmpgt(a, b))                                                                         \
    X2(spu_cmpgt, vm, vi, vi, spu_cmpgt(a, b))                                                                         \
    X2(spu_cmpgt, vm, vu, vu, spu_cmpgt(a, b))                                                                         \
    X2(spu_cmpabsgt, vm, vf, vf, spu_cmpabsgt(a, b))                                                                   \
    X2(spu_and, vf, vf, vf, spu_and(a, b))                                                                             \
    X2(spu_and, vu, vu, vu, spu_and(a, b))                                                                             \
    X2(spu_and, vm, vm, vm, spu_and(a, b))                                                                             \
    X2(spu_or, vf, vf, vf, spu_or(a, b))                                                                               \
    X2(spu_or, vu, vu, vu, spu_or(a, b))                                                                               \
    X2(spu_or, vm, vm, vm, spu_or(a, b))                                                                               \
    X2(spu_xor, vf, vf, vf, spu_xor(a, b))                                                                             \
    X2(spu_xor, vu, vu, vu, spu_xor(a, b))                                                                             \
    X2(spu_xor, vm, vm, vm, spu_xor(a, b))                                                                             \
    X2(spu_andc, vf, vf, vf, spu_andc(a, b))                                                                           \
    X2(spu_andc, vu, vu, vu, spu_andc(a, b))                                                                           \
    X2(spu_andc, vm, vm, vm, spu_andc(a, b))                                                                           \
    X2(spu_nor, vf, vf, vf, spu_nor(a, b))                                                                             \
    X2(spu_nor, vu, vu, vu, spu_nor(a, b))                                                                             \
    X2(spu_nor, vm, vm, vm, spu_nor(a, b))                                                                             \
    X3(spu_sel, vf, vf, vf, vu, spu_sel(a, b, c))                                                                      \
    X3(spu_sel, vu, vu, vu, vu, spu_sel(a, b, c))                                                                      \
    X2(spu_convtf, vf, vi, n_scale, spu_convtf(a, b))                                                                  \
    X2(spu_convtf, vf, vu, n_scale, spu_convtf(a, b))                                                                  \
    X2(spu_convts, vi, vf, n_scale, spu_convts(a, b))
#endif

#define SIMD_EXTENSIONS(X1, X2, X3)                                                                                    \
    X2(spux_min, vf, vf, vf, spux_min(a, b))                                                                           \
    X2(spux_max, vf, vf, vf, spux_max(a, b))                                                                           \
    X1(spux_abs, vf, vf, spux_abs(a))                                                                                  \
    X2(spux_div, vf, vf, vf, spux_div(a, b))                                                                           \
    X1(spux_sqrt, vf, vf, spux_sqrt(a))                                                                                \
    X2(spux_cmpge, vm, vf, vf, spux_cmpge(a, b))                                                                       \
    X3(spux_select, vf, vf, vf, vm, spux_select(a, b, c))                                                              \
    X3(spux_select, vu, vu, vu, vm, spux_select(a, b, c))                                                              \
    X1(spux_not, vm, vm, spux_not(a))                                                                                  \
    X1(spux_mask_bits, x_u32, vm, spux_mask_bits(a))                                                                   \
    X1(spux_hmin, x_f32, vf, spux_hmin(a))                                                                             \
    X1(spux_hmax, x_f32, vf, spux_hmax(a))                                                                             \
    X2(spux_min, vi, vi, vi, spux_min(a, b))                                                                           \
    X2(spux_min, vu, vu, vu, spux_min(a, b))                                                                           \
    X2(spux_max, vi, vi, vi, spux_max(a, b))                                                                           \
    X2(spux_max, vu, vu, vu, spux_max(a, b))                                                                           \
    X2(spu_sl, vu, vu, x_u32, spu_sl(a, b))                                                                            \
    X2(spu_sr, vu, vu, x_u32, spu_sr(a, b))                                                                            \
    X2(spu_sra, vi, vi, x_u32, spu_sra(a, b))                                                                          \
    X1(spux_any, x_u32, vm, spux_any(a))                                                                               \
    X1(spux_all, x_u32, vm, spux_all(a))                                                                               \
    X1(spux_mask_from_bits, vm, x_u32, spux_mask_from_bits(a))                                                         \
    X1(spux_mask_first, vm, x_u32, spux_mask_first(a))                                                                 \
    X1(spux_load_unaligned, vf, x_u32, spux_load_unaligned(FLOATS + a))                                                \
    X1(spux_load_mask, vf, vm, spux_load_mask(FLOATS + 1, a))                                                          \
    X1(spux_gather, vf, vi, spux_gather(FLOATS, a))                                                                    \
    X2(spux_permute, vf, vf, vu, spux_permute(a, b))                                                                   \
    X2(spux_compress, vf, vf, vm, spux_compress(a, b))                                                                 \
    X1(spux_hmin, x_u32, vu, spux_hmin(a))                                                                             \
    X1(spux_hmax, x_u32, vu, spux_hmax(a))

/* ---- functions, rows ---- */

#define RUN1(word, R, A, expression) SIMD_LOOP1(run_##word##_##A, R, A, expression)
#define RUN2(word, R, A, B, expression) SIMD_LOOP2(run_##word##_##A##_##B, R, A, B, expression)
#define RUN3(word, R, A, B, C, expression) SIMD_LOOP3(run_##word##_##A##_##B##_##C, R, A, B, C, expression)
#define PLAIN1(word, R, A, expression) SIMD_ROW1(#word, SIMD_PLAIN, true, R, A, run_##word##_##A)
#define PLAIN2(word, R, A, B, expression) SIMD_ROW2(#word, SIMD_PLAIN, true, R, A, B, run_##word##_##A##_##B)
#define PLAIN3(word, R, A, B, C, expression)                                                                           \
    SIMD_ROW3(#word, SIMD_PLAIN, true, R, A, B, C, run_##word##_##A##_##B##_##C)

SIMD_WIDE_WORDS(RUN1, RUN2, RUN3)
SIMD_EXTENSIONS(RUN1, RUN2, RUN3)

/* clang-format off */
static const simd_row rows[] = {
    SIMD_WIDE_WORDS(PLAIN1, PLAIN2, PLAIN3)
    SIMD_EXTENSIONS(PLAIN1, PLAIN2, PLAIN3)
};
/* clang-format on */

SIMD_TABLE(wide, rows)
