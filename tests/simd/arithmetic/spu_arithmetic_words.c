/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact words as functions of bits, and their comparison with the model. A word's results are collected in the
 * SPU's mode and checked outside it: a failing test jumps away, and the mode must not stay on. */
#include "simd/arithmetic/spu_arithmetic.h"

#define WORD1(name)                                                                                                    \
    static vec_uint4 compute_##name(vec_uint4 a) { return (vec_uint4)cgt_spu_##name##_f32((vec_float4)a); }
#define WORD2(name)                                                                                                    \
    static vec_uint4 compute_##name(vec_uint4 a, vec_uint4 b)                                                          \
    {                                                                                                                  \
        return (vec_uint4)cgt_spu_##name##_f32((vec_float4)a, (vec_float4)b);                                          \
    }
#define WORD3(name)                                                                                                    \
    static vec_uint4 compute_##name(vec_uint4 a, vec_uint4 b, vec_uint4 c)                                             \
    {                                                                                                                  \
        return (vec_uint4)cgt_spu_##name##_f32((vec_float4)a, (vec_float4)b, (vec_float4)c);                           \
    }
WORD1(frest)
WORD1(frsqest)
WORD1(re)
WORD1(rsqrte)
WORD2(add)
WORD2(sub)
WORD2(mul)
WORD2(cmpgt)
WORD2(cmpeq)
WORD2(cmpabsgt)
WORD2(cmpabseq)
WORD2(fi)
WORD3(madd)
WORD3(msub)
WORD3(nmsub)
static vec_uint4 compute_convtf_s32(vec_uint4 a, int n) { return (vec_uint4)cgt_spu_convtf_s32((vec_int4)a, n); }
static vec_uint4 compute_convtf_u32(vec_uint4 a, int n) { return (vec_uint4)cgt_spu_convtf_u32(a, n); }
static vec_uint4 compute_convts(vec_uint4 a, int n) { return (vec_uint4)cgt_spu_convts_f32((vec_float4)a, n); }
static vec_uint4 compute_convtu(vec_uint4 a, int n) { return cgt_spu_convtu_f32((vec_float4)a, n); }

/* the model has the estimates' two steps only */
static uint32_t model_re(uint32_t a) { return cgt_spu_model_fi(a, cgt_spu_model_frest(a)); }
static uint32_t model_rsqrte(uint32_t a) { return cgt_spu_model_fi(a, cgt_spu_model_frsqest(a)); }

const word1 frest = {"frest", compute_frest, cgt_spu_model_frest};
const word1 frsqest = {"frsqest", compute_frsqest, cgt_spu_model_frsqest};
const word1 re = {"re", compute_re, model_re};
const word1 rsqrte = {"rsqrte", compute_rsqrte, model_rsqrte};
const word2 add = {"add", compute_add, cgt_spu_model_add};
const word2 sub = {"sub", compute_sub, cgt_spu_model_sub};
const word2 mul = {"mul", compute_mul, cgt_spu_model_mul};
const word2 cmpgt = {"cmpgt", compute_cmpgt, cgt_spu_model_cmpgt};
const word2 cmpeq = {"cmpeq", compute_cmpeq, cgt_spu_model_cmpeq};
const word2 cmpabsgt = {"cmpabsgt", compute_cmpabsgt, cgt_spu_model_cmpabsgt};
const word2 cmpabseq = {"cmpabseq", compute_cmpabseq, cgt_spu_model_cmpabseq};
const word2 fi = {"fi", compute_fi, cgt_spu_model_fi};
const word3 madd = {"madd", compute_madd, cgt_spu_model_madd};
const word3 msub = {"msub", compute_msub, cgt_spu_model_msub};
const word3 nmsub = {"nmsub", compute_nmsub, cgt_spu_model_nmsub};
const word_scaled convtf_s32 = {"convtf of int", compute_convtf_s32, cgt_spu_model_convtf_s32};
const word_scaled convtf_u32 = {"convtf of unsigned", compute_convtf_u32, cgt_spu_model_convtf_u32};
const word_scaled convts = {"convts", compute_convts, cgt_spu_model_convts};
const word_scaled convtu = {"convtu", compute_convtu, cgt_spu_model_convtu};

static vec_uint4 got[BATCH];

void check1(const word1 *word, const vec_uint4 *a, uint32_t vectors)
{
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    for (uint32_t i = 0; i < vectors; i++)
        got[i] = word->compute(a[i]);
    cgt_spu_leave_arithmetic(saved);
    for (uint32_t i = 0; i < 4 * vectors; i++) {
        const uint32_t a1 = a[i / 4][i % 4], g = got[i / 4][i % 4], e = word->model(a1);
        if (g != e)
            fail_msg("%s(%08x): %08x, the model has %08x", word->name, a1, g, e);
    }
}

void check2(const word2 *word, const vec_uint4 *a, const vec_uint4 *b, uint32_t vectors)
{
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    for (uint32_t i = 0; i < vectors; i++)
        got[i] = word->compute(a[i], b[i]);
    cgt_spu_leave_arithmetic(saved);
    for (uint32_t i = 0; i < 4 * vectors; i++) {
        const uint32_t a1 = a[i / 4][i % 4], b1 = b[i / 4][i % 4], g = got[i / 4][i % 4], e = word->model(a1, b1);
        if (g != e)
            fail_msg("%s(%08x, %08x): %08x, the model has %08x", word->name, a1, b1, g, e);
    }
}

void check3(const word3 *word, const vec_uint4 *a, const vec_uint4 *b, const vec_uint4 *c, uint32_t vectors)
{
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    for (uint32_t i = 0; i < vectors; i++)
        got[i] = word->compute(a[i], b[i], c[i]);
    cgt_spu_leave_arithmetic(saved);
    for (uint32_t i = 0; i < 4 * vectors; i++) {
        const uint32_t a1 = a[i / 4][i % 4], b1 = b[i / 4][i % 4], c1 = c[i / 4][i % 4];
        const uint32_t g = got[i / 4][i % 4], e = word->model(a1, b1, c1);
        if (g != e)
            fail_msg("%s(%08x, %08x, %08x): %08x, the model has %08x", word->name, a1, b1, c1, g, e);
    }
}

void check_scaled(const word_scaled *word, const vec_uint4 *a, int n, uint32_t vectors)
{
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    for (uint32_t i = 0; i < vectors; i++)
        got[i] = word->compute(a[i], n);
    cgt_spu_leave_arithmetic(saved);
    for (uint32_t i = 0; i < 4 * vectors; i++) {
        const uint32_t a1 = a[i / 4][i % 4], g = got[i / 4][i % 4], e = word->model(a1, n);
        if (g != e)
            fail_msg("%s(%08x, %d): %08x, the model has %08x", word->name, a1, n, g, e);
    }
}
