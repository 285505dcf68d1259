/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: the interface between the parts compiled once per variant and the part compiled once.
 *
 *   row      one word on operands of certain types, and the function that executes it repeatedly
 *   table    the rows of one file
 *   mapped   the word of the vocabulary; native: the same, written by hand for one instruction set
 *
 * A mapped row is matched with its native one by word, operands and count. */
#ifndef SIMD_ROWS_H
#define SIMD_ROWS_H

#include <stdalign.h>
#include <stdbool.h>
#include <stddef.h>

/* Kinds of operands and results, named as the tokens of simd/spu_words.h are;
 * then those of simd/vector.h. */
typedef enum simd_kind {
    SIMD_NONE,
    SIMD_u8,
    SIMD_s8,
    SIMD_u16,
    SIMD_s16,
    SIMD_u32,
    SIMD_s32,
    SIMD_u64,
    SIMD_s64,
    SIMD_f32,
    SIMD_f64,
    SIMD_x_u8,
    SIMD_x_s8,
    SIMD_x_u16,
    SIMD_x_s16,
    SIMD_x_u32,
    SIMD_x_s32,
    SIMD_x_u64,
    SIMD_x_s64,
    SIMD_x_f32,
    SIMD_x_f64,
    SIMD_n_scale,
    SIMD_n_special,
    SIMD_vf, /* vfloat */
    SIMD_vi, /* vint */
    SIMD_vu, /* vuint */
    SIMD_vm  /* vmask */
} simd_kind;

/* A shift's count, an element's position, a shuffle's pattern, a scale: loaded
 * with the other operands, or a literal. */
typedef enum simd_count { SIMD_PLAIN, SIMD_VARIABLE, SIMD_CONSTANT } simd_count;

enum {
    SIMD_BYTES = 1024, /* of an operand's array: 64 vectors of 16 bytes, 32 of 32,
                        16 of 64 */
    SIMD_APPLIED = 4   /* times that the word is applied per load of the operands */
};

/* Four arrays in a page, so that no store shares the lower address bits with a following load. */
typedef struct simd_memory {
    alignas(4096) unsigned char a[SIMD_BYTES];
    unsigned char b[SIMD_BYTES], c[SIMD_BYTES], result[SIMD_BYTES];
    unsigned char table[SIMD_BYTES]; /* for words that read memory: floats */
} simd_memory;

typedef struct simd_row {
    const char *word; /* "spu_add" */
    simd_count count;
    bool is_same; /* of a native row: it gives the same bits for the measured operands */
    simd_kind result, operand[3];
    void (*run)(simd_memory *memory, size_t passes); /* over the arrays */
} simd_row;

typedef struct simd_table {
    const char *variant;
    int lanes; /* of vfloat and its like */
    size_t count;
    const simd_row *row;
} simd_table;

/* ---- simd_operands.c ---- */

const char *simd_kind_name(simd_kind kind);
int simd_kind_elements(simd_kind kind, int lanes); /* 1 for scalars */
size_t simd_kind_bytes(simd_kind kind, int lanes);
int simd_row_vectors(const simd_row *row, int lanes); /* in an array */
int simd_row_lanes(const simd_row *row, int lanes);   /* elements of the vector that the word works on */

/* Numbers on which mapped and native form do the same: counts and positions
 * within the element, finite floats. */
void simd_fill(simd_memory *memory, const simd_row *row, int lanes);

/* ---- simd_reasons.c ---- */

/* The reason why a mapped word takes more time than its native form; NULL if none is known. */
const char *simd_reason(const char *variant, const simd_row *row);

#endif
