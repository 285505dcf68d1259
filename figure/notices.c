/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sentences for a user; see notices.h. */
#include "notices.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void cgt_notices_add(notices *n, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    const size_t size = strlen(text) + 1;
    char *const copy = malloc(size);
    char **const more = copy ? realloc(n->text, (n->count + 1) * sizeof *more) : NULL;
    if (!more) {
        free(copy);
        return;
    }
    memcpy(copy, text, size);
    n->text = more;
    n->text[n->count++] = copy;
}

const char *cgt_notices_take(notices *n)
{
    if (n->taken < n->count)
        return n->text[n->taken++];
    cgt_notices_free(n);
    return NULL;
}

void cgt_notices_free(notices *n)
{
    for (size_t i = 0; i < n->count; i++)
        free(n->text[i]);
    free(n->text);
    memset(n, 0, sizeof *n);
}
