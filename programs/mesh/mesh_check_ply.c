/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Walks through a .ply file from its header to its end before assimp sees it: assimp reads a truncated file as a
 * smaller one, or never returns from it, and turns a list of triangle strips into one triangle. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "mesh/mesh_model.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

#define MOST_ELEMENTS 64
#define MOST_PROPERTIES 256

/* ---- Header ------------------------------------------------------------------------------------------------- */

typedef enum ply_encoding { PLY_TEXT, PLY_LITTLE, PLY_BIG } ply_encoding;

typedef struct ply_type {
    const char *name, *old_name;
    uint32_t bytes;
    int is_float;
} ply_type;

static const ply_type types[] = {
    {"int8", "char", 1, 0}, {"uint8", "uchar", 1, 0}, {"int16", "short", 2, 0},   {"uint16", "ushort", 2, 0},
    {"int32", "int", 4, 0}, {"uint32", "uint", 4, 0}, {"float32", "float", 4, 1}, {"float64", "double", 8, 1},
};

typedef struct ply_property {
    const ply_type *count; /* of a list's length; NULL where it is no list */
    const ply_type *value;
} ply_property;

typedef struct ply_element {
    char name[32];
    uint64_t count;
    uint32_t first, property_count; /* of the header's properties */
} ply_element;

typedef struct ply_header {
    ply_encoding encoding;
    uint32_t element_count, property_count;
    ply_element element[MOST_ELEMENTS];
    ply_property property[MOST_PROPERTIES];
} ply_header;

static const ply_type *find_type(text_span word)
{
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
        if (text_is(word, types[i].name) || text_is(word, types[i].old_name))
            return &types[i];
    return NULL;
}

static int read_format(cgt_trajectory *t, const text_reader *r, text_span remaining, ply_header *h)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    text_span word;
    char quote[TEXT_QUOTE_SIZE];
    text_word(&remaining, &word);
    for (int i = 0; i < 3; i++) {
        if (text_is(word, names[i])) {
            h->encoding = (ply_encoding)i;
            return 1;
        }
    }
    return trajectory_fail(t, r->line, "'%s' is no format of a .ply file", text_quote(word, quote));
}

static int read_element(cgt_trajectory *t, const text_reader *r, text_span remaining, ply_header *h)
{
    text_span name, word;
    char quote[TEXT_QUOTE_SIZE];
    if (h->element_count == MOST_ELEMENTS)
        return trajectory_fail(t, r->line, "more than %d elements", MOST_ELEMENTS);
    ply_element *const e = &h->element[h->element_count++];
    text_word(&remaining, &name);
    text_word(&remaining, &word);
    if (!text_u64(word, UINT64_MAX, &e->count))
        return trajectory_fail(t, r->line, "'%s' is not a number of elements", text_quote(word, quote));
    if (e->count > t->file_size)
        return trajectory_fail(t, r->line, "%" PRIu64 " elements cannot lie in %" PRIu64 " bytes", e->count,
                               t->file_size);
    if (text_is(name, "tristrips"))
        return trajectory_fail(t, r->line, "triangle strips are not read right by assimp: write the file with faces");
    snprintf(e->name, sizeof e->name, "%s", text_quote(name, quote));
    e->first = h->property_count;
    e->property_count = 0;
    return 1;
}

/* "list uchar int vertex_indices" or "float x" */
static int read_property(cgt_trajectory *t, const text_reader *r, text_span remaining, ply_header *h)
{
    text_span word;
    char quote[TEXT_QUOTE_SIZE];
    if (h->element_count == 0)
        return trajectory_fail(t, r->line, "a property without an element");
    if (h->property_count == MOST_PROPERTIES)
        return trajectory_fail(t, r->line, "more than %d properties", MOST_PROPERTIES);
    ply_property *const p = &h->property[h->property_count++];
    h->element[h->element_count - 1].property_count++;
    p->count = NULL;
    text_word(&remaining, &word);
    if (text_is(word, "list")) {
        text_word(&remaining, &word);
        p->count = find_type(word);
        if (p->count == NULL || p->count->is_float)
            return trajectory_fail(t, r->line, "'%s' is no type of a list's length", text_quote(word, quote));
        text_word(&remaining, &word);
    }
    p->value = find_type(word);
    return p->value != NULL ? 1 : trajectory_fail(t, r->line, "'%s' is no type", text_quote(word, quote));
}

static int read_line(cgt_trajectory *t, text_reader *r, text_span *line, const char *section)
{
    const char *reason = "";
    const int status = text_reader_next(r, line, &reason);
    if (status < 0)
        return trajectory_fail(t, r->line, "%s", reason);
    return status > 0 ? 1 : trajectory_fail(t, r->line, "the file ends in the %s: it is cut off", section);
}

static int read_header(cgt_trajectory *t, text_reader *r, ply_header *h)
{
    text_span line, word;
    memset(h, 0, sizeof *h);
    if (read_line(t, r, &line, "header") < 0)
        return -1;
    if (!text_begins(line, "ply") && !text_begins(line, "PLY"))
        return trajectory_fail(t, r->line, "not a .ply file: it does not begin with ply");
    while (1) {
        if (read_line(t, r, &line, "header") < 0)
            return -1;
        int result = 1;
        text_word(&line, &word);
        if (text_is(word, "end_header"))
            return 1;
        if (text_is(word, "format")) {
            result = read_format(t, r, line, h);
        } else if (text_is(word, "element")) {
            result = read_element(t, r, line, h);
        } else if (text_is(word, "property")) {
            result = read_property(t, r, line, h);
        } /* all else is a comment, or treated as one, as in assimp */
        if (result < 0)
            return -1;
    }
}

/* ---- Text --------------------------------------------------------------------------------------------------- */

/* One element is one line; further numbers on it are ignored, as in assimp. */
static int walk_text_element(cgt_trajectory *t, const text_reader *r, const ply_header *h, const ply_element *e,
                             text_span line)
{
    for (uint32_t p = 0; p < e->property_count; p++) {
        const ply_property *const property = &h->property[e->first + p];
        text_span word;
        char quote[TEXT_QUOTE_SIZE];
        uint64_t values = 1;
        if (property->count != NULL && text_word(&line, &word) && !text_u64(word, UINT64_MAX, &values))
            return trajectory_fail(t, r->line, "'%s' is not the length of a list", text_quote(word, quote));
        for (uint64_t i = 0; i < values; i++)
            if (!text_word(&line, &word))
                return trajectory_fail(t, r->line, "the line of this %s has too few numbers", e->name);
    }
    return 1;
}

static int walk_text(cgt_trajectory *t, text_reader *r, const ply_header *h)
{
    for (uint32_t k = 0; k < h->element_count; k++) {
        const ply_element *const e = &h->element[k];
        for (uint64_t i = 0; e->property_count > 0 && i < e->count; i++) {
            text_span line;
            do {
                const char *reason = "";
                const int status = text_reader_next(r, &line, &reason);
                if (status < 0)
                    return trajectory_fail(t, r->line, "%s", reason);
                if (status == 0)
                    return trajectory_fail(t, r->line, "the file ends after %" PRIu64 " of %" PRIu64 " elements '%s'",
                                           i, e->count, e->name);
            } while (text_is_blank(line));
            if (walk_text_element(t, r, h, e, line) < 0)
                return -1;
        }
    }
    return 1;
}

/* ---- Binary ------------------------------------------------------------------------------------------------- */

typedef struct walk {
    cgt_trajectory *t;
    FILE *file;
    uint64_t remaining; /* bytes left in the file */
} walk;

static int cut_off(const walk *w, const ply_element *e, uint64_t i)
{
    return trajectory_fail(w->t, 0, "the file ends after %" PRIu64 " of %" PRIu64 " elements '%s'", i, e->count,
                           e->name);
}

/* Skips `bytes`, a byte at a time where they are few: a seek discards the buffer. */
static int skip_bytes(walk *w, uint64_t bytes)
{
    if (bytes > w->remaining)
        return 0;
    w->remaining -= bytes;
    if (bytes > 4096)
        return fseeko(w->file, (off_t)bytes, SEEK_CUR) == 0;
    while (bytes > 0 && getc_unlocked(w->file) != EOF)
        bytes--;
    return bytes == 0;
}

/* Reads a list's length: 1, or 0 where the file ends, or the length is below zero. */
static int read_length(walk *w, const ply_type *type, ply_encoding encoding, uint64_t *length)
{
    *length = 0;
    if (type->bytes > w->remaining)
        return 0;
    w->remaining -= type->bytes;
    for (uint32_t i = 0; i < type->bytes; i++) {
        const int byte = getc_unlocked(w->file);
        if (byte == EOF)
            return 0;
        const uint32_t place = encoding == PLY_LITTLE ? i : type->bytes - 1 - i;
        *length |= (uint64_t)byte << (8 * place);
    }
    return 1;
}

/* Bytes of an element without lists; 0 where it has one. */
static uint64_t fixed_size(const ply_header *h, const ply_element *e)
{
    uint64_t bytes = 0;
    for (uint32_t p = 0; p < e->property_count; p++) {
        const ply_property *const property = &h->property[e->first + p];
        if (property->count != NULL)
            return 0;
        bytes += property->value->bytes;
    }
    return bytes;
}

static int walk_lists(walk *w, const ply_header *h, const ply_element *e)
{
    for (uint64_t i = 0; i < e->count; i++) {
        for (uint32_t p = 0; p < e->property_count; p++) {
            const ply_property *const property = &h->property[e->first + p];
            uint64_t length = 1;
            if (property->count != NULL && !read_length(w, property->count, h->encoding, &length))
                return cut_off(w, e, i);
            /* a length has at most 32 bits */
            if (!skip_bytes(w, length * property->value->bytes))
                return cut_off(w, e, i);
        }
    }
    return 1;
}

static int walk_binary(cgt_trajectory *t, text_reader *r, const ply_header *h)
{
    const off_t offset = ftello(r->file) - (off_t)(r->end - r->begin); /* the reader has buffered more */
    if (offset < 0 || (uint64_t)offset > t->file_size || fseeko(r->file, offset, SEEK_SET) != 0)
        return trajectory_fail(t, 0, "%s", strerror(errno));
    /* assimp skips line feeds after the header, and takes such a byte of the data for one: all that follows shifts */
    const int first = getc_unlocked(r->file);
    if (first == '\n')
        return trajectory_fail(t, 0,
                               "the data begin with the byte 0x0a, which assimp takes for a line feed of the header: "
                               "move the first vertex by a little, or convert the file to text");
    if (first != EOF && fseeko(r->file, offset, SEEK_SET) != 0)
        return trajectory_fail(t, 0, "%s", strerror(errno));
    walk w = {t, r->file, t->file_size - (uint64_t)offset};
    for (uint32_t k = 0; k < h->element_count; k++) {
        const ply_element *const e = &h->element[k];
        const uint64_t size = fixed_size(h, e);
        if (size > 0 && e->count > w.remaining / size)
            return cut_off(&w, e, w.remaining / size);
        if (size > 0 && !skip_bytes(&w, e->count * size))
            return trajectory_fail(t, 0, "%s", strerror(errno));
        if (size == 0 && walk_lists(&w, h, e) < 0)
            return -1;
    }
    return 1;
}

int mesh_check_ply(cgt_trajectory *t, text_reader *r)
{
    ply_header header;
    if (read_header(t, r, &header) < 0)
        return -1;
    return header.encoding == PLY_TEXT ? walk_text(t, r, &header) : walk_binary(t, r, &header);
}
