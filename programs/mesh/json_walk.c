/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A walk over the JSON of a glTF file; see json_walk.h. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/json_walk.h"

#include <string.h>

#define GLB_HEADER 20 /* bytes before the JSON of a binary file */

static uint32_t u32_at(const unsigned char *b)
{
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

json_walk json_walk_begin(const char *bytes, size_t size)
{
    json_walk w = {.at = bytes, .end = bytes + size};
    if (size >= GLB_HEADER && memcmp(bytes, "glTF", 4) == 0) {
        const uint32_t length = u32_at((const unsigned char *)bytes + 12);
        w.at += GLB_HEADER;
        w.end = length < size - GLB_HEADER ? w.at + length : w.end;
    }
    return w;
}

int json_walk_is_at(const json_walk *w, const char *const *keys, uint32_t count)
{
    if (w->depth != count)
        return 0;
    for (uint32_t i = 0; i < count; i++) {
        const int is_array = w->kind[i] == '[';
        if (is_array != (*keys[i] == '\0') || (!is_array && !text_is(w->key[i], keys[i])))
            return 0;
    }
    return 1;
}

/* Takes the string or the word at the walk's place. */
static text_span take_scalar(json_walk *w)
{
    text_span word;
    if (*w->at == '"') {
        word.begin = ++w->at;
        while (w->at < w->end && *w->at != '"')
            w->at += *w->at == '\\' && w->end - w->at > 1 ? 2 : 1;
        word.end = w->at;
        w->at += w->at < w->end;
        return word;
    }
    word.begin = w->at++;
    while (w->at < w->end && strchr(" \t\r\n,:]}\"", *w->at) == NULL)
        w->at++;
    word.end = w->at;
    return word;
}

static void enter(json_walk *w, char bracket)
{
    if (w->depth < JSON_LEVELS) {
        w->kind[w->depth] = bracket;
        w->key[w->depth] = (text_span){w->at, w->at};
    }
    w->depth++;
    w->deepest = w->depth > w->deepest ? w->depth : w->deepest;
}

int json_walk_run(json_walk *w, int (*judge)(void *user, const json_walk *w, text_span word), void *user)
{
    int is_key = 0;
    while (w->at < w->end) {
        const char c = *w->at;
        if (c == '{' || c == '[') {
            enter(w, c);
            is_key = c == '{';
        } else if (c == '}' || c == ']') {
            if (w->depth == 0)
                return 1;
            w->depth--;
            is_key = 0;
        } else if (c == ',') {
            is_key = w->depth > 0 && w->depth <= JSON_LEVELS && w->kind[w->depth - 1] == '{';
        } else if (c != ':' && strchr(" \t\r\n", c) == NULL) {
            const text_span word = take_scalar(w);
            if (is_key && w->depth > JSON_LEVELS) {
                is_key = 0;
            } else if (is_key && w->depth > 0) {
                w->key[w->depth - 1] = word;
                is_key = 0;
            } else if (judge(user, w, word) < 0) {
                return -1;
            }
            continue;
        }
        w->at++;
    }
    return 1;
}
