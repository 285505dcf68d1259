/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What every word of the vocabulary means, on the SPU's register image: what the SPU's instruction does, by the rows of
 * the interpreter (backends/cell/spu/isa/rows), which programs of the SPU's own compiler check in the suite `spu`. It
 * knows nothing of the mappings.
 *
 *   scalar    a quad that holds the value in its element 0
 *   form      one overload: a word and the types of its operands and result
 *
 * Floats are IEEE, rounded to nearest: the default arithmetic of the vocabulary. So they are defined here, in C. */
#ifndef SPU_REFERENCE_H
#define SPU_REFERENCE_H

#include <string.h>

#include "cell/spu/isa/isa.h"
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

/* Whether a list, of words with a space before and behind each, has a word. */
static inline bool spu_is_word_of(const char *word, const char *list)
{
    const char *at = list;
    while ((at = strstr(at + 1, word)))
        if (at[-1] == ' ' && at[strlen(word)] == ' ')
            return true;
    return false;
}

/* Fails the test where the word has no definition. */
spu_quad spu_reference_result(const spu_form *form, const spu_quad operand[3]);

/* The first element that a result may not have, -1 where it is right: the same bits, except that one NaN of arithmetic
 * is as good as another, that promote defines one element only, and that an estimate lies within 2^-11. */
int spu_reference_mismatch(const spu_form *form, const spu_quad operand[3], const spu_quad *got,
                           const spu_quad *expected);

/* Whether a word is defined by this instruction. */
bool spu_reference_uses(cgt_spu_op op);

#endif
