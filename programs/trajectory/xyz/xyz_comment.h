/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The comment of an .xyz file as the extended format has it: pairs key=value, with blanks around = or without, and keys
 * that stand alone. Values are words, or lie in quotes "...", '...' with \ before a quote inside, or in brackets [...],
 * {...} of up to 16 levels. A comment may also be free text, so nothing in it is an error. */
#ifndef XYZ_COMMENT_H
#define XYZ_COMMENT_H

#include "trajectory/text/text_reader.h"

/* Takes the next pair from the front of rest; value is empty where the key stands alone. Returns 1, or 0 at the end. */
int comment_next(text_span *rest, text_span *key, text_span *value);

/* Finds the value of a key, whose case does not matter; of several the first. Returns 1 or 0. */
int comment_find(text_span comment, const char *key, text_span *value);

/* Takes the next word from the front of a value; blanks, commas and brackets lie between them. Returns 1, or 0 at the
 * end. */
int comment_word(text_span *rest, text_span *word);

/* Reads `count` finite numbers with blanks, commas or brackets between them. Returns 1, or 0: something else is
 * there. */
int comment_numbers(text_span text, int count, double *values);

#endif
