/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tokens of CIF (S. R. Hall, F. H. Allen, I. D. Brown, Acta Cryst. A47, 1991; syntax of CIF 1.1). */
#ifndef CIF_TOKENS_H
#define CIF_TOKENS_H

#include "trajectory/trajectory_internal.h"

typedef enum cif_kind { CIF_END = 0, CIF_DATA, CIF_LOOP, CIF_TAG, CIF_VALUE, CIF_OTHER } cif_kind;

typedef struct cif_tokens {
    text_span rest; /* of the line */
} cif_tokens;

/* Reads the next token: its kind, or -1. The text (without quotes; empty for text of several lines) is valid until the
 * next call. */
int cif_next(cgt_trajectory *t, cif_tokens *c, text_span *text);

#endif
