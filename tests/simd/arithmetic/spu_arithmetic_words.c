/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The exact words as functions of bits, and their comparison with the model. A word's results are collected in the
 * SPU's mode and checked outside it: a failing test jumps away, and the mode must not stay on. */
#include "simd/arithmetic/spu_arithmetic.h"

#define F(a) ((vec_float4)(a))
#define WORD(name, text, word_of, model_of)                                                                            \
    static vec_uint4 compute_##name(vec_uint4 a, vec_uint4 b, vec_uint4 c, int n)                                      \
    {                                                                                                                  \
        (void)b, (void)c, (void)n;                                                                                     \
        return (vec_uint4)word_of;                                                                                     \
    }                                                                                                                  \
    static uint32_t model_##name(uint32_t a, uint32_t b, uint32_t c, int n)                                            \
    {                                                                                                                  \
        (void)b, (void)c, (void)n;                                                                                     \
        return model_of;                                                                                               \
    }                                                                                                                  \
    const word name = {text, compute_##name, model_##name};
#define WORD1(name) WORD(name, #name, cgt_spu_##name##_f32(F(a)), cgt_spu_model_##name(a))
#define WORD2(name) WORD(name, #name, cgt_spu_##name##_f32(F(a), F(b)), cgt_spu_model_##name(a, b))
#define WORD3(name) WORD(name, #name, cgt_spu_##name##_f32(F(a), F(b), F(c)), cgt_spu_model_##name(a, b, c))
WORD1(frest)
WORD1(frsqest)
/* the model has the estimates' two steps only */
WORD(re, "re", cgt_spu_re_f32(F(a)), cgt_spu_model_fi(a, cgt_spu_model_frest(a)))
WORD(rsqrte, "rsqrte", cgt_spu_rsqrte_f32(F(a)), cgt_spu_model_fi(a, cgt_spu_model_frsqest(a)))
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
WORD(convtf_s32, "convtf of int", cgt_spu_convtf_s32((vec_int4)a, n), cgt_spu_model_convtf_s32(a, n))
WORD(convtf_u32, "convtf of unsigned", cgt_spu_convtf_u32(a, n), cgt_spu_model_convtf_u32(a, n))
WORD(convts, "convts", cgt_spu_convts_f32(F(a), n), cgt_spu_model_convts(a, n))
WORD(convtu, "convtu", cgt_spu_convtu_f32(F(a), n), cgt_spu_model_convtu(a, n))

void check(const word *w, const vec_uint4 *a, const vec_uint4 *b, const vec_uint4 *c, int n, uint32_t vectors)
{
    static vec_uint4 got[BATCH];
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    for (uint32_t i = 0; i < vectors; i++)
        got[i] = w->compute(a[i], b[i], c[i], n);
    cgt_spu_leave_arithmetic(saved);
    for (uint32_t i = 0; i < 4 * vectors; i++) {
        const uint32_t x = a[i / 4][i % 4], y = b[i / 4][i % 4], z = c[i / 4][i % 4];
        const uint32_t g = got[i / 4][i % 4], e = w->model(x, y, z, n);
        if (g != e)
            fail_msg("%s(%08x, %08x, %08x, %d): %08x, the model has %08x", w->name, x, y, z, n, g, e);
    }
}
