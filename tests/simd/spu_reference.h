/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What every word of the vocabulary means: a scalar definition of each on the SPU's register image, written from the
 * definition of the SPU's instruction, knowing nothing of the mappings.
 *
 *   scalar    a quad that holds the value in its element 0
 *   form      one overload: a word and the types of its operands and result
 *
 * Floats are IEEE, rounded to nearest: the default arithmetic of the vocabulary. */
#ifndef SPU_REFERENCE_H
#define SPU_REFERENCE_H

#include "simd/spu_quad.h"

typedef struct spu_kind {
    spu_type type;
    bool is_scalar;
} spu_kind;

typedef struct spu_form {
    const char *word; /* without spu_ */
    const char *text; /* "word(operands) -> result" in the table's tokens */
    int operands;
    spu_kind result, operand[3];
    bool is_fused; /* madd, msub, nmsub, nmadd of floats round once */
} spu_form;

typedef struct spu_reference spu_reference;

/* The definition of a word, NULL if there is none. */
const spu_reference *spu_reference_find(const char *word);
int spu_reference_count(void);

spu_quad spu_reference_result(const spu_reference *reference, const spu_form *form, const spu_quad operand[3]);

/* The first element that a result may not have, -1 where it is right: the same bits, except that one NaN of arithmetic
 * is as good as another, that promote defines one element only, and that an estimate lies within 2^-11. */
int spu_reference_mismatch(const spu_reference *reference, const spu_form *form, const spu_quad operand[3],
                           const spu_quad *got, const spu_quad *expected);

#endif
