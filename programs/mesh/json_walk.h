/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A walk over the JSON of a glTF file, without memory: looks at each word in its place. Whether the text is JSON is
 * left to the library that reads it. */
#ifndef JSON_WALK_H
#define JSON_WALK_H

#include <stddef.h>
#include <stdint.h>

#include "trajectory/text/text_reader.h"

#define JSON_LEVELS 32 /* keys beyond matter to no judgement */

/* A place in the tree: the keys of the objects around it; empty for arrays. */
typedef struct json_walk {
    const char *at;
    const char *end;
    uint64_t depth, deepest;
    text_span key[JSON_LEVELS];
    char kind[JSON_LEVELS]; /* the bracket of each level */
} json_walk;

/* A walk over a file's document: that behind the header of a binary file, or the whole text. A zero follows the
 * bytes. */
json_walk json_walk_begin(const char *bytes, size_t size);

/* Calls judge with each value that is no object and no array: a string without its quotes, or another word. judge
 * returns 1 to go on, or -1. Returns 1 at the end, or -1. */
int json_walk_run(json_walk *w, int (*judge)(void *user, const json_walk *w, text_span word), void *user);

/* Whether the walk is at keys[0] / keys[1] / ..., with "" for any index of an array. */
int json_walk_is_at(const json_walk *w, const char *const *keys, uint32_t count);

#endif
