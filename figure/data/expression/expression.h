/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Formulas over the columns of a frame, such as sqrt(vx^2 + vy^2) or c_pe/2:
 *   + - * / ^ and ( ), in the usual order; ^ binds tighter than a sign and groups from the right
 *   < <= > >= == != && || !, whose results are 0 and 1; and, or, not, which is applied after comparisons; NaN
 *   is no, as 0 is
 *   sqrt abs exp log log10 sin cos tan floor ceil sign, min(a, b), max(a, b), mod(a, b), if(condition, a, b); pi
 *   x y z radius id type element speed step time index, and every column of the file under its name, which may contain
 *   digits, _ . : [ ] after its first letter; site is 0 where no column has it
 *   column == word, column != word: of a column of words, such as chain == "A" or name != CA, and of element, such as
 * element == O. Quotes, single or double, may be left out where the word is like a name and no column has it. "" is
 * what atoms without a word have. protein, water, backbone: 1 for atoms of such residues, by the columns resname and
 * name (residue_names.h); a backbone is N, CA, C and O of proteins.
 * Values are computed in double, one for each sphere or vertex. */
#ifndef EXPRESSION_H
#define EXPRESSION_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include <cgt/trajectory.h>

typedef struct expression expression;

/* Parses a formula. Returns NULL with a sentence in error that shows where it fails. */
expression *cgt_expression_parse(const char *text, char *error, size_t error_size);
void cgt_expression_free(expression *e); /* NULL is ignored */

/* The names in it that are no functions or constants, each once; valid as long as e. */
const char *const *cgt_expression_names(const expression *e, size_t *count);

/* Whether the formula uses this name. */
int cgt_expression_uses(const expression *e, const char *name);

/* Whether the formula is one name alone, such as that of a column. */
int cgt_expression_is_name(const expression *e);

/* Binds the names to a frame. speed: one for each sphere or vertex, NULL where they are not known. Returns 0, or -1
 * with a sentence that tells which name the frame does not have, and which it has, or which word does not fit. */
int cgt_expression_bind(expression *e, const cgt_trajectory_frame *frame, const float *speed, char *error,
                        size_t error_size);

/* The column of words that the formula is in the frame it is bound to; NULL: it is another. */
const cgt_trajectory_column *cgt_expression_words(const expression *e, const cgt_trajectory_frame *frame);

/* Values of the bound frame's spheres or vertices from `first` on. */
void cgt_expression_values(const expression *e, uint32_t first, uint32_t count, double *values);

/* Whether a value says yes: 0 and NaN do not. */
static inline int cgt_expression_holds(double value) { return value != 0.0 && !isnan(value); }

#endif
