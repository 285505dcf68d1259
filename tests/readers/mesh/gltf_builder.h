/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Builds small glTF files, as text with a data URI, as a binary file, or with its buffer in a file of its own. */
#ifndef GLTF_BUILDER_H
#define GLTF_BUILDER_H

#include "readers/trajectory_scratch.h"

typedef struct gltf_builder {
    unsigned char bytes[4096];
    size_t size;
    char views[4096], accessors[8192];
    int count; /* of views and of accessors: one view each */
} gltf_builder;

/* Adds little-endian data as a view and, where rest is not NULL, an accessor of it. rest: its members after bufferView;
 * view: further members of the view, or "". Returns its number. */
static inline int gltf_add(gltf_builder *b, const void *data, size_t size, const char *view, const char *rest)
{
    assert_true(b->size + size + 4 <= sizeof b->bytes);
    memcpy(b->bytes + b->size, data, size);
    const size_t used = strlen(b->views), more = strlen(b->accessors);
    snprintf(b->views + used, sizeof b->views - used, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu%s}",
             b->count > 0 ? "," : "", b->size, size, view);
    snprintf(b->accessors + more, sizeof b->accessors - more, "%s{\"bufferView\":%d,%s}", b->count > 0 ? "," : "",
             b->count, rest != NULL ? rest : "\"componentType\":5126,\"count\":1,\"type\":\"SCALAR\"");
    b->size += (size + 3) / 4 * 4;
    return b->count++;
}

/* Adds `count` floats as elements of a type: "VEC3". */
static inline int gltf_floats(gltf_builder *b, const float *values, size_t count, const char *type)
{
    static const struct {
        const char *type;
        size_t width;
    } rows[] = {{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    unsigned char bytes[2048];
    char rest[160];
    size_t width = 0;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        width = strcmp(type, rows[i].type) == 0 ? rows[i].width : width;
    assert_true(width > 0 && 4 * count <= sizeof bytes);
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        scratch_put_u32(bytes, 4 * i, bits);
    }
    snprintf(rest, sizeof rest, "\"componentType\":5126,\"count\":%zu,\"type\":\"%s\"", count / width, type);
    return gltf_add(b, bytes, 4 * count, "", rest);
}

/* Adds indices of `bytes` bytes each. */
static inline int gltf_indices(gltf_builder *b, const uint32_t *values, size_t count, size_t bytes)
{
    unsigned char out[1024];
    char rest[160];
    assert_true(count * bytes <= sizeof out);
    for (size_t i = 0; i < count * bytes; i++)
        out[i] = (unsigned char)(values[i / bytes] >> (8 * (i % bytes)));
    snprintf(rest, sizeof rest, "\"componentType\":%d,\"count\":%zu,\"type\":\"SCALAR\"",
             bytes == 1   ? 5121
             : bytes == 2 ? 5123
                          : 5125,
             count);
    return gltf_add(b, out, count * bytes, "", rest);
}

/* The document; uri: of the buffer with its quotes, NULL for none. members: all that is no asset, accessor, view or
 * buffer. */
static inline char *gltf_document(const gltf_builder *b, const char *members, const char *uri)
{
    const size_t size = strlen(members) + strlen(b->views) + strlen(b->accessors) + (uri ? strlen(uri) : 0) + 400;
    char *const text = malloc(size);
    assert_non_null(text);
    snprintf(text, size,
             "{\"asset\":{\"version\":\"2.0\"},%s,\"accessors\":[%s],\"bufferViews\":[%s],"
             "\"buffers\":[{\"byteLength\":%zu%s%s}]}",
             members, b->accessors, b->views, b->size, uri ? ",\"uri\":" : "", uri ? uri : "");
    return text;
}

/* A file of text with its data inside. */
static inline const char *gltf_text(const gltf_builder *b, const char *members)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    static char uri[8192];
    size_t at = (size_t)sprintf(uri, "\"data:application/octet-stream;base64,");
    for (size_t i = 0; i < b->size; i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; k++)
            bits = bits << 8 | (i + k < b->size ? b->bytes[i + k] : 0u);
        for (size_t k = 0; k < 4; k++)
            uri[at++] = i + k > b->size ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    strcpy(uri + at, "\"");
    char *const text = gltf_document(b, members, uri);
    const char *const path = scratch_text(".gltf", text);
    free(text);
    return path;
}

/* The bytes of a binary file; returns their number. */
static inline size_t gltf_binary(const gltf_builder *b, const char *members, unsigned char *out, size_t room)
{
    char *const text = gltf_document(b, members, NULL);
    const size_t length = (strlen(text) + 3) / 4 * 4, size = 12 + 8 + length + 8 + b->size;
    assert_true(size <= room);
    memset(out, ' ', size);
    scratch_put_u32(out, 0, 0x46546c67); /* glTF */
    scratch_put_u32(out, 4, 2);
    scratch_put_u32(out, 8, (uint32_t)size);
    scratch_put_u32(out, 12, (uint32_t)length);
    scratch_put_u32(out, 16, 0x4e4f534a); /* JSON */
    for (size_t i = 0; text[i] != '\0'; i++)
        out[20 + i] = (unsigned char)text[i];
    scratch_put_u32(out, 20 + length, (uint32_t)b->size);
    scratch_put_u32(out, 24 + length, 0x004e4942); /* BIN */
    memcpy(out + 28 + length, b->bytes, b->size);
    free(text);
    return size;
}

#endif
