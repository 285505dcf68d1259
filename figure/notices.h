/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sentences that a library has for a user, who asks for them: what was chosen, or is doubtful. One thread at a time
 * uses them. */
#ifndef NOTICES_H
#define NOTICES_H

#include <stddef.h>

/* All zero: there are none. */
typedef struct notices {
    char **text;
    size_t count, taken;
} notices;

/* Adds a sentence; it is lost where there is no memory. */
void cgt_notices_add(notices *n, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The next sentence, valid until the next call; NULL: there is no more. */
const char *cgt_notices_take(notices *n);

void cgt_notices_free(notices *n);

#endif
