/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shared by the parts of test_spu_arithmetic: a table of the exact words and their integer model, operands, and a
 * reference in arithmetic that neither of them uses. Numbers are bits, uint32_t, throughout. */
#ifndef SPU_ARITHMETIC_H
#define SPU_ARITHMETIC_H

#include "support/test.h"

#include <stdio.h>

#ifndef CGT_SPU_EXACT
#error "this test is of the SPU's arithmetic: compile it with CGT_SPU_EXACT defined"
#endif
#include "spu_intrinsics.h"

#define ONE 0x3f800000u
#define HALF 0x3f000000u
#define SIGN 0x80000000u
#define SMALLEST 0x00800000u
#define LARGEST 0x7fffffffu

/* ---- spu_arithmetic_words.c: each word and its model ---- */

typedef struct word {
    const char *name;
    vec_uint4 (*compute)(vec_uint4 a, vec_uint4 b, vec_uint4 c, int n); /* what it does not take does not count */
    uint32_t (*model)(uint32_t a, uint32_t b, uint32_t c, int n);
} word;

extern const word frest, frsqest, re, rsqrte;
extern const word add, sub, mul, cmpgt, cmpeq, cmpabsgt, cmpabseq, fi;
extern const word madd, msub, nmsub;
extern const word convtf_s32, convtf_u32, convts, convtu; /* n: the scale */

/* The word in the SPU's mode, on 4 * vectors numbers, against the model; fails at the first difference. */
#define BATCH 1024 /* the most vectors that it takes */
void check(const word *w, const vec_uint4 *a, const vec_uint4 *b, const vec_uint4 *c, int n, uint32_t vectors);
#define check1(w, a, vectors) check(w, a, a, a, 0, vectors)
#define check2(w, a, b, vectors) check(w, a, b, b, 0, vectors)
#define check3(w, a, b, c, vectors) check(w, a, b, c, 0, vectors)
#define check_scaled(w, a, n, vectors) check(w, a, a, a, n, vectors)

/* ---- spu_arithmetic_operands.c ---- */

extern const uint32_t edges[];
extern const uint32_t edge_count;
uint32_t random_fraction(test_random *r);               /* 23 bits, often all ones, all zeros or few of either */
void random_operands(test_random *r, uint32_t bits[3]); /* for a * b + c and a + b: near exponents, cancellation ... */

/* ---- spu_arithmetic_truth.c: exact, then truncated ---- */

uint32_t true_sum(uint32_t a, uint32_t b);
uint32_t true_madd(uint32_t a, uint32_t b, uint32_t c); /* in fixed point of 576 bits */
double true_value(uint32_t a);
uint32_t true_number(double a); /* truncated; any double */

/* ---- the tests, by file ---- */

void words_match_model_on_edges(void **state); /* spu_arithmetic_match.c */
void words_match_model_at_all_exponent_gaps(void **state);
void words_match_model_on_random_operands(void **state);
void conversions_match_model_at_all_scales(void **state);
void lines_match_model(void **state);

void estimates_match_model_for_all_fractions(void **state); /* spu_arithmetic_estimates.c */
void estimates_have_twelve_bits(void **state);
void reciprocal_after_one_step(void **state);
void root_after_one_step(void **state);
void root_of_zero_exponent_after_one_step(void **state);

void constants_are_not_folded(void **state); /* spu_arithmetic_switch.c */
void operations_stay_on_their_side_of_the_switch(void **state);
void leaving_restores_the_state(void **state);

#endif
