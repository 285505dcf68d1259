/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Texts as JSON has them. */
#ifndef WEB_TEXT_H
#define WEB_TEXT_H

#include <stdio.h>

/* text NULL: null. */
static inline void web_print_string(FILE *to, const char *before, const char *text)
{
    fputs(before, to);
    fputs(text ? "\"" : "null", to);
    for (; text && *text; text++)
        if ((unsigned char)*text < ' ')
            fprintf(to, "\\u%04x", (unsigned)*text);
        else
            fprintf(to, *text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
    if (text)
        fputc('"', to);
}

/* A member of an object after others. */
static inline void web_print_text(FILE *to, const char *name, const char *text)
{
    fprintf(to, ",\"%s\":", name);
    web_print_string(to, "", text);
}

#endif
