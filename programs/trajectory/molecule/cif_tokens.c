/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reading CIF token by token. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/cif_tokens.h"

#include <string.h>
#include <strings.h>

static int is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/* Goes past a text field, which ends at the next line that begins with a semicolon. */
static int skip_text(cgt_trajectory *t, cif_tokens *c, text_span *text)
{
    do {
        if (trajectory_line_inside(t, &c->rest, "in a text of several lines") < 0)
            return -1;
    } while (c->rest.begin == c->rest.end || *c->rest.begin != ';');
    c->rest.begin++;
    *text = (text_span){c->rest.begin, c->rest.begin};
    return CIF_VALUE;
}

static int begins(text_span text, const char *word)
{
    const size_t length = strlen(word);
    return text_length(text) >= length && strncasecmp(text.begin, word, length) == 0;
}

static int take_bare(cif_tokens *c, text_span *text)
{
    text_word(&c->rest, text);
    if (*text->begin == '_')
        return CIF_TAG;
    if (begins(*text, "data_"))
        return CIF_DATA;
    if (begins(*text, "loop_") && text_length(*text) == 5)
        return CIF_LOOP;
    return begins(*text, "save_") || begins(*text, "global_") || begins(*text, "stop_") ? CIF_OTHER : CIF_VALUE;
}

/* A quote ends where a blank or the line's end follows it. */
static int take_quoted(cgt_trajectory *t, cif_tokens *c, text_span *text)
{
    const char quote = *c->rest.begin;
    text->begin = c->rest.begin + 1;
    for (const char *p = text->begin; p < c->rest.end; p++) {
        if (*p == quote && (p + 1 == c->rest.end || is_blank(p[1]))) {
            text->end = p;
            c->rest.begin = p + 1;
            return CIF_VALUE;
        }
    }
    return trajectory_fail(t, t->text.line, "a quote without its end");
}

int cif_next(cgt_trajectory *t, cif_tokens *c, text_span *text)
{
    while (1) {
        while (c->rest.begin < c->rest.end && is_blank(*c->rest.begin))
            c->rest.begin++;
        if (c->rest.begin < c->rest.end && *c->rest.begin != '#') {
            const int is_quoted = *c->rest.begin == '\'' || *c->rest.begin == '"';
            return is_quoted ? take_quoted(t, c, text) : take_bare(c, text);
        }
        const int status = trajectory_line(t, &c->rest);
        if (status <= 0)
            return status < 0 ? -1 : CIF_END;
        if (c->rest.begin < c->rest.end && *c->rest.begin == ';')
            return skip_text(t, c, text);
    }
}
