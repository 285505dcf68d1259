/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The table simd/spu/spu_words.h for tests: what its tokens stand for, and a row of data per overload. It includes
 * spu_intrinsics.h, so that a test sees the words of the mapping that it is compiled for.
 *
 * For each token (u8, x_u8 ... f64, x_f64, n_scale, n_special) there are
 *   TYPE_token         the C type
 *   TOKEN_token        a number
 *   load_token(quad)   the operand that a quad holds; of a scalar its element 0
 *   store_token(x)     the quad of a result; no result has an n_ type */
#ifndef SPU_OVERLOADS_H
#define SPU_OVERLOADS_H

#include <string.h>

#include "spu_intrinsics.h"
#include "spu/spu_words.h"

#include "simd/spu_operands.h"

#define SPU_OVERLOADS 455
#define SPU_WORDS 72 /* 74 with the halting comparisons, which compute nothing */

/* ---- tokens ---- */

enum { TOKEN_n_scale = 100, TOKEN_n_special };
typedef int TYPE_n_scale, TYPE_n_special;
#define load_n_scale load_x_s32
#define load_n_special load_x_s32
#define store_n_scale store_x_s32
#define store_n_special store_x_s32

#define SPU_TOKEN(name, vec, scalar)                                                                                   \
    enum { TOKEN_##name = 2 * SPU_##name, TOKEN_x_##name };                                                            \
    typedef vec TYPE_##name;                                                                                           \
    typedef scalar TYPE_x_##name;                                                                                      \
    static inline vec load_##name(const spu_quad *quad)                                                                \
    {                                                                                                                  \
        vec v;                                                                                                         \
        spu_to_host(quad, SPU_##name, &v);                                                                             \
        return v;                                                                                                      \
    }                                                                                                                  \
    static inline scalar load_x_##name(const spu_quad *quad)                                                           \
    {                                                                                                                  \
        scalar v[16 / sizeof(scalar)];                                                                                 \
        spu_to_host(quad, SPU_##name, v);                                                                              \
        return v[0];                                                                                                   \
    }                                                                                                                  \
    static inline spu_quad store_##name(vec v) { return spu_from_host(&v, SPU_##name); }                               \
    static inline spu_quad store_x_##name(scalar x)                                                                    \
    {                                                                                                                  \
        scalar v[16 / sizeof(scalar)] = {x};                                                                           \
        return spu_from_host(v, SPU_##name);                                                                           \
    }
SPU_TOKEN(u8, vec_uchar16, unsigned char)
SPU_TOKEN(s8, vec_char16, signed char)
SPU_TOKEN(u16, vec_ushort8, unsigned short)
SPU_TOKEN(s16, vec_short8, short)
SPU_TOKEN(u32, vec_uint4, unsigned int)
SPU_TOKEN(s32, vec_int4, int)
SPU_TOKEN(u64, vec_ullong2, unsigned long long)
SPU_TOKEN(s64, vec_llong2, long long)
SPU_TOKEN(f32, vec_float4, float)
SPU_TOKEN(f64, vec_double2, double)

/* ---- rows ---- */

typedef struct spu_row {
    const char *word, *text;
    int operands, result, operand[3]; /* numbers of tokens */
} spu_row;

/* static const spu_row rows[] = {CGT_SPU_WORDS(SPU_ROW1, SPU_ROW2, SPU_ROW3)}; */
#define SPU_ROW1(word, r, a) {#word, #word "(" #a ") -> " #r, 1, TOKEN_##r, {TOKEN_##a}},
#define SPU_ROW2(word, r, a, b) {#word, #word "(" #a ", " #b ") -> " #r, 2, TOKEN_##r, {TOKEN_##a, TOKEN_##b}},
#define SPU_ROW3(word, r, a, b, c)                                                                                     \
    {#word, #word "(" #a ", " #b ", " #c ") -> " #r, 3, TOKEN_##r, {TOKEN_##a, TOKEN_##b, TOKEN_##c}},

static inline spu_kind spu_kind_of(int token)
{
    if (token >= TOKEN_n_scale)
        return (spu_kind){SPU_s32, true};
    return (spu_kind){(spu_type)(token / 2), token % 2 != 0};
}

static inline spu_form spu_form_of(const spu_row *row)
{
    spu_form form = {
        .word = row->word, .text = row->text, .operands = row->operands, .result = spu_kind_of(row->result)};
    for (int k = 0; k < row->operands; k++)
        form.operand[k] = spu_kind_of(row->operand[k]);
    form.is_fused = form.result.type == SPU_f64 ? CGT_SPU_FUSED_DOUBLE : CGT_SPU_FUSED;
    return form;
}

/* The role of an operand: shifts and rotations have their count second, the words of one element their index last. */
static inline spu_role spu_role_of(const spu_row *row, int operand)
{
    if (row->operand[operand] >= TOKEN_n_scale)
        return SPU_0_TO_127;
    const bool shifts = spu_is_word_of(row->word, " sl sr sra rl rlmask rlmaska slqw slqwbyte slqwbytebc srqw srqwbyte "
                                                  "srqwbytebc rlqw rlqwbyte rlqwbytebc rlmaskqw rlmaskqwbyte "
                                                  "rlmaskqwbytebc ");
    const bool has_index = spu_is_word_of(row->word, " extract insert promote ");
    return (shifts && operand == 1) || (has_index && operand == row->operands - 1) ? SPU_COUNT : SPU_DATA;
}

/* Whether the reference, whose floats are IEEE, does not speak of this overload: with CGT_SPU_EXACT single precision
 * follows the SPU's arithmetic, which has a reference and a test of its own. */
static inline bool spu_is_left_to_exact(const spu_row *row)
{
#ifdef CGT_SPU_EXACT
    const bool computes = spu_is_word_of(row->word, " add sub mul madd msub nmsub convtf convts convtu cmpeq cmpgt "
                                                    "cmpabseq cmpabsgt re rsqrte ");
    return computes && (spu_kind_of(row->operand[0]).type == SPU_f32 || spu_kind_of(row->result).type == SPU_f32);
#else
    (void)row;
    return false;
#endif
}

/* Prints what a word made of which operands. */
static inline void spu_report(const spu_form *form, const spu_quad in[3], const spu_quad *got, const spu_quad *expected,
                              int element)
{
    char text[48];
    print_error("spu_%s, element %d\n", form->text, element);
    for (int k = 0; k <= form->operands + 1; k++) {
        const spu_kind kind = k < form->operands ? form->operand[k] : form->result;
        const spu_quad *quad = k < form->operands ? &in[k] : k == form->operands ? got : expected;
        const char *name = k < form->operands ? "operand" : k == form->operands ? "got" : "expected";
        print_error("    %-10s %s\n", name,
                    spu_text(quad, kind.type, kind.is_scalar ? spu_bits(kind.type) / 8 : 16, text));
    }
}

#endif
