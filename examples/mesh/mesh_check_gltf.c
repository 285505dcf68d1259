/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Finds in glTF what assimp takes for something else without a word: extensions that a file requires, keys of animations
 * that are no straight lines, weights of morph targets. The JSON is walked once; assimp reports its errors. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "mesh/mesh_model.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#define MOST_LEVELS 32
#define GLB_HEADER 20 /* bytes before the JSON of a binary file */

/* A place in the tree: the keys of the objects around it; empty for arrays. */
typedef struct json_walk {
    const char *at;
    const char *end;
    uint64_t depth;
    text_span key[MOST_LEVELS];
    char kind[MOST_LEVELS]; /* the bracket of each level */
} json_walk;

/* Extensions that do not change where triangles are: materials, textures, lights, descriptions. */
static int is_harmless(text_span name)
{
    static const char *const beginnings[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_",
                                             "KHR_lights_",    "EXT_lights_",  "KHR_xmp"};
    for (size_t i = 0; i < sizeof beginnings / sizeof beginnings[0]; i++) {
        if (text_begins(name, beginnings[i])) {
            return 1;
        }
    }
    return 0;
}

/* Whether the walk is at keys[0] / keys[1] / ..., with "" for any index of an array. */
static int is_at(const json_walk *w, const char *const *keys, uint32_t count)
{
    if (w->depth != count) {
        return 0;
    }
    for (uint32_t i = 0; i < count; i++) {
        const int is_array = w->kind[i] == '[';
        if (is_array != (*keys[i] == '\0') || (!is_array && !text_is(w->key[i], keys[i]))) {
            return 0;
        }
    }
    return 1;
}

/* Judges a string, without its quotes, or another word. Returns 1 or -1. */
static int judge(trajectory *t, const json_walk *w, text_span word)
{
    static const char *const required[] = {"extensionsRequired", ""};
    static const char *const interpolation[] = {"animations", "", "samplers", "", "interpolation"};
    static const char *const mesh_weights[] = {"meshes", "", "weights", ""};
    static const char *const node_weights[] = {"nodes", "", "weights", ""};
    char quote[TEXT_QUOTE_SIZE];
    if (is_at(w, required, 2) && !is_harmless(word)) {
        return trajectory_fail(t, 0, "the file requires the extension %s, which cannot be read here",
                               text_quote(word, quote));
    }
    if (is_at(w, interpolation, 5) && !text_is(word, "LINEAR")) {
        trajectory_warn(t, DOUBT_INTERPOLATION, 0, "keys of the interpolation %s are played as straight lines",
                        text_quote(word, quote));
    }
    if (is_at(w, mesh_weights, 4) || is_at(w, node_weights, 4)) {
        const int is_zero = text_length(word) > 0 && strspn(word.begin, "-0.eE+") >= text_length(word);
        if (!is_zero) {
            trajectory_warn(t, DOUBT_MORPH, 0, "morph targets are left out: the mesh has its own vertices");
        }
    }
    return 1;
}

/* Takes the string or the word at the walk's place. */
static text_span take_scalar(json_walk *w)
{
    text_span word;
    if (*w->at == '"') {
        word.begin = ++w->at;
        while (w->at < w->end && *w->at != '"') {
            w->at += *w->at == '\\' && w->end - w->at > 1 ? 2 : 1;
        }
        word.end = w->at;
        w->at += w->at < w->end;
        return word;
    }
    word.begin = w->at++;
    while (w->at < w->end && strchr(" \t\r\n,:]}\"", *w->at) == NULL) {
        w->at++;
    }
    word.end = w->at;
    return word;
}

/* Walks over a document. Anything that is no JSON is left to assimp; keys beyond MOST_LEVELS matter
 * to no judgement. Returns 1 or -1. */
static int walk_json(trajectory *t, json_walk *w)
{
    int is_key = 0;
    while (w->at < w->end) {
        const char c = *w->at;
        if (c == '{' || c == '[') {
            if (w->depth < MOST_LEVELS) {
                w->kind[w->depth] = c;
                w->key[w->depth] = (text_span){w->at, w->at};
            }
            w->depth++;
            is_key = c == '{';
        } else if (c == '}' || c == ']') {
            if (w->depth == 0) {
                return 1;
            }
            w->depth--;
            is_key = 0;
        } else if (c == ',') {
            is_key = w->depth > 0 && w->depth <= MOST_LEVELS && w->kind[w->depth - 1] == '{';
        } else if (c != ':' && strchr(" \t\r\n", c) == NULL) {
            const text_span word = take_scalar(w);
            if (is_key && w->depth > MOST_LEVELS) {
                is_key = 0;
            } else if (is_key && w->depth > 0) {
                w->key[w->depth - 1] = word;
                is_key = 0;
            } else if (judge(t, w, word) < 0) {
                return -1;
            }
            continue;
        }
        w->at++;
    }
    return 1;
}

static uint32_t u32_at(const unsigned char *b)
{
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

/* The JSON of a binary file follows its header; text is JSON as a whole. */
static int check_bytes(trajectory *t, const char *bytes, size_t size)
{
    json_walk w = {.at = bytes, .end = bytes + size};
    if (size >= GLB_HEADER && memcmp(bytes, "glTF", 4) == 0) {
        const uint32_t length = u32_at((const unsigned char *)bytes + 12);
        w.at += GLB_HEADER;
        w.end = length < size - GLB_HEADER ? w.at + length : w.end;
    }
    return walk_json(t, &w);
}

int mesh_check_gltf(trajectory *t, text_reader *r)
{
    if (t->file_size > SIZE_MAX - 1) {
        return 1;
    }
    const size_t size = (size_t)t->file_size;
    char *bytes = malloc(size + 1);
    if (bytes == NULL) {
        return trajectory_fail(t, 0, "not enough memory for %zu bytes", size);
    }
    const size_t got = fread(bytes, 1, size, r->file);
    bytes[got] = '\0';
    const int result = ferror(r->file) ? trajectory_fail(t, 0, "%s", strerror(EIO)) : check_bytes(t, bytes, got);
    free(bytes);
    return result;
}
