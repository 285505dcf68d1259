/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pairs of an .xyz comment. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/xyz/xyz_comment.h"

#include <math.h>
#include <string.h>
#include <strings.h>

static int is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

static const char *skip_blanks(const char *p, const char *end)
{
    while (p < end && is_blank(*p))
        p++;
    return p;
}

/* The quote that ends the one at p, or NULL where none does. */
static const char *find_quote(const char *p, const char *end)
{
    const char quote = *p;
    for (p++; p < end; p++)
        if (*p == '\\' && p + 1 < end)
            p++;
        else if (*p == quote)
            return p;
    return NULL;
}

/* The bracket that ends the one at p, or NULL where none does: values have few levels. The limit also bounds the
 * search: of brackets that nothing ends, those before a byte are so many levels there, so that no byte is searched more
 * often. */
#define MOST_LEVELS 16

static const char *find_bracket(const char *p, const char *end)
{
    int depth = 0;
    for (; p < end && depth <= MOST_LEVELS; p++) {
        depth += *p == '[' || *p == '{';
        depth -= *p == ']' || *p == '}';
        if (depth == 0)
            return p;
    }
    return NULL;
}

/* Takes a key or a value from p. stop: a character that ends a bare word, beside blanks. Returns what follows it. A
 * quote or bracket that nothing ends is an ordinary character: the comment is free text. */
static const char *take_item(const char *p, const char *end, char stop, int is_value, text_span *item)
{
    const int quoted = p < end && (*p == '"' || (is_value && *p == '\''));
    const int bracketed = is_value && p < end && (*p == '[' || *p == '{');
    const char *close = quoted ? find_quote(p, end) : bracketed ? find_bracket(p, end) : NULL;
    if (close != NULL) {
        item->begin = p + 1;
        item->end = close;
        return close + 1;
    }
    item->begin = p;
    while (p < end && !is_blank(*p) && *p != stop)
        p++;
    item->end = p;
    return p;
}

int comment_next(text_span *rest, text_span *key, text_span *value)
{
    const char *p = skip_blanks(rest->begin, rest->end);
    if (p == rest->end)
        return 0;
    p = take_item(p, rest->end, '=', 0, key);
    const char *equals = skip_blanks(p, rest->end);
    value->begin = value->end = p;
    if (equals < rest->end && *equals == '=') {
        const char *begin = skip_blanks(equals + 1, rest->end);
        p = take_item(begin, rest->end, '\0', 1, value);
    }
    rest->begin = p;
    return 1;
}

int comment_find(text_span comment, const char *key, text_span *value)
{
    text_span name;
    const size_t length = strlen(key);
    while (comment_next(&comment, &name, value)) {
        /* "key=" has an empty value, which lies behind the equals sign */
        if (text_length(name) == length && strncasecmp(name.begin, key, length) == 0 && value->begin > name.end &&
            memchr(name.end, '=', (size_t)(value->begin - name.end)) != NULL)
            return 1;
    }
    return 0;
}

static int separates(char c) { return is_blank(c) || (c != '\0' && strchr(",[]{}", c) != NULL); }

int comment_word(text_span *rest, text_span *word)
{
    const char *p = rest->begin;
    while (p < rest->end && separates(*p))
        p++;
    word->begin = p;
    while (p < rest->end && !separates(*p))
        p++;
    word->end = rest->begin = p;
    return word->begin < word->end;
}

/* Words are copied, since a quote or a bracket may follow the number. */
int comment_numbers(text_span text, int count, double *values)
{
    text_span word;
    for (int i = 0; i < count; i++) {
        char copy[64];
        if (!comment_word(&text, &word) || text_length(word) >= sizeof copy)
            return 0;
        memcpy(copy, word.begin, text_length(word));
        copy[text_length(word)] = '\0';
        const text_span number = {copy, copy + text_length(word)};
        if (!text_double(number, &values[i]) || !isfinite(values[i]))
            return 0;
    }
    return !comment_word(&text, &word);
}
