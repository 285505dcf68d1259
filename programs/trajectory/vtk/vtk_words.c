/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reading legacy VTK files word by word. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/vtk/vtk_words.h"

#include <inttypes.h>
#include <string.h>
#include <strings.h>

static const struct {
    const char *name;
    vtk_type type;
} types[] = {
    {"char", VTK_I8},          {"signed_char", VTK_I8},     {"unsigned_char", VTK_U8},
    {"short", VTK_I16},        {"unsigned_short", VTK_U16}, {"int", VTK_I32},
    {"unsigned_int", VTK_U32}, {"long", VTK_I64},           {"unsigned_long", VTK_U64},
    {"vtktypeint64", VTK_I64}, {"vtktypeuint64", VTK_U64},  {"vtkidtype", VTK_I32},
    {"float", VTK_F32},        {"double", VTK_F64},         {"bit", VTK_BIT},
    {"string", VTK_STRING},
};

vtk_type vtk_find_type(const char *name)
{
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
        if (strcasecmp(name, types[i].name) == 0)
            return types[i].type;
    return VTK_NONE;
}

int vtk_is_whole(vtk_type type) { return type != VTK_F32 && type != VTK_F64; }

static size_t size_of(vtk_type type)
{
    static const uint8_t size[] = {0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 0, 0};
    return size[type];
}

/* ---- Text --------------------------------------------------------------------------------------------------- */

static int next_byte(vtk_words *w)
{
    const int c = getc(w->in.t->file);
    w->in.read += c != EOF;
    w->line += c == '\n';
    return c;
}

static void give_back(vtk_words *w, int c)
{
    if (c != EOF && ungetc(c, w->in.t->file) == c) {
        w->in.read--;
        w->line -= c == '\n';
    }
}

static int is_blank(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/* Takes a word whose first byte is c. */
static int take_word(vtk_words *w, int c, char word[VTK_WORD])
{
    size_t length = 0;
    while (c != EOF && !is_blank(c)) {
        if (length + 1 == VTK_WORD)
            return trajectory_fail(w->in.t, w->line, "a word of more than 255 bytes: this is not a VTK file");
        word[length++] = (char)c;
        c = next_byte(w);
    }
    give_back(w, c);
    word[length] = '\0';
    return length > 0;
}

int vtk_word(vtk_words *w, char word[VTK_WORD])
{
    int c = next_byte(w);
    while (is_blank(c))
        c = next_byte(w);
    return take_word(w, c, word);
}

int vtk_word_inside(vtk_words *w, char word[VTK_WORD], const char *name)
{
    const int status = vtk_word(w, word);
    return status == 0 ? trajectory_fail(w->in.t, w->line, "the file ends in %s: it is cut off", name) : status;
}

int vtk_word_of_line(vtk_words *w, char word[VTK_WORD])
{
    int c = next_byte(w);
    while (is_blank(c) && c != '\n')
        c = next_byte(w);
    if (c == '\n') {
        give_back(w, c);
        word[0] = '\0';
        return 0;
    }
    return take_word(w, c, word);
}

int vtk_end_line(vtk_words *w, char line[VTK_WORD])
{
    size_t length = 0;
    int c, any = 0;
    while ((c = next_byte(w)) != EOF && c != '\n') {
        any = 1;
        if (line != NULL && length + 1 < VTK_WORD && c != '\r')
            line[length++] = (char)c;
    }
    if (line != NULL)
        line[length] = '\0';
    return any || c == '\n';
}

int vtk_count(vtk_words *w, uint64_t *count, const char *name)
{
    char word[VTK_WORD], quote[TEXT_QUOTE_SIZE];
    if (vtk_word_inside(w, word, name) < 0)
        return -1;
    const text_span span = {word, word + strlen(word)};
    if (!text_u64(span, (uint64_t)1 << 48, count))
        return trajectory_fail(w->in.t, w->line, "'%s' is not a count", text_quote(span, quote));
    return 1;
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

static double from_bytes(vtk_type type, const unsigned char *b)
{
    const uint32_t half = (uint32_t)b[0] << 8 | b[1];
    switch (type) {
    case VTK_I8: return (double)b[0] - (b[0] > 127 ? 256.0 : 0.0);
    case VTK_U8: return (double)b[0];
    case VTK_I16: return (double)half - (half > 32767 ? 65536.0 : 0.0);
    case VTK_U16: return (double)half;
    case VTK_I32: {
        const uint32_t bits = binary_get_u32(b, 1);
        return (double)bits - (bits > INT32_MAX ? 4294967296.0 : 0.0);
    }
    case VTK_U32: return (double)binary_get_u32(b, 1);
    case VTK_I64: {
        const uint64_t bits = binary_get_u64(b, 1);
        return bits > INT64_MAX ? -(double)(~bits + 1) : (double)bits;
    }
    case VTK_U64: return (double)binary_get_u64(b, 1);
    case VTK_F32: return (double)binary_get_f32(b, 1);
    default: return binary_get_f64(b, 1);
    }
}

int vtk_value(vtk_words *w, vtk_type type, double *value, const char *name)
{
    char word[VTK_WORD], quote[TEXT_QUOTE_SIZE];
    unsigned char bytes[8];
    if (w->is_binary) {
        if (binary_bytes(&w->in, bytes, size_of(type), name) < 0)
            return -1;
        *value = from_bytes(type, bytes);
        return 1;
    }
    if (vtk_word_inside(w, word, name) < 0)
        return -1;
    const text_span span = {word, word + strlen(word)};
    float number;
    if (type == VTK_F32 && text_float(span, &number)) { /* rounded once */
        *value = (double)number;
        return 1;
    }
    return text_double(span, value)
               ? 1
               : trajectory_fail(w->in.t, w->line, "'%s' is not a number", text_quote(span, quote));
}

/* Strings: each on a line of its own, or with its length before it, whose first two bits tell its bytes. */
static int skip_strings(vtk_words *w, uint64_t count, const char *name)
{
    for (uint64_t i = 0; i < count; i++) {
        unsigned char bytes[8];
        if (!w->is_binary) {
            if (!vtk_end_line(w, NULL))
                return trajectory_fail(w->in.t, w->line, "the file ends in %s: it is cut off", name);
            continue;
        }
        if (binary_bytes(&w->in, bytes, 1, name) < 0)
            return -1;
        const size_t size = (size_t)8 >> (bytes[0] >> 6);
        uint64_t length = bytes[0] & 63u;
        if (size > 1 && binary_bytes(&w->in, bytes + 1, size - 1, name) < 0)
            return -1;
        for (size_t k = 1; k < size; k++)
            length = length << 8 | bytes[k];
        if (binary_skip(&w->in, length, name) < 0)
            return -1;
    }
    return 1;
}

int vtk_skip(vtk_words *w, vtk_type type, uint64_t count, const char *name)
{
    char word[VTK_WORD];
    if (type == VTK_STRING)
        return skip_strings(w, count, name);
    if (type == VTK_BIT && w->is_binary)
        return binary_skip(&w->in, count / 8 + (count % 8 > 0), name);
    if (w->is_binary)
        return binary_skip(&w->in, count * size_of(type), name);
    for (uint64_t i = 0; i < count; i++)
        if (vtk_word_inside(w, word, name) < 0)
            return -1;
    return 1;
}

/* ---- What is passed over: cells and colours ----------------------------------------------------------------- */

static const char array[] = "an array";

int vtk_read_type(vtk_words *w, vtk_type *type)
{
    cgt_trajectory *const t = w->in.t;
    char word[VTK_WORD];
    if (vtk_word_inside(w, word, array) < 0)
        return -1;
    *type = vtk_find_type(word);
    return *type != VTK_NONE ? 1 : trajectory_fail(t, w->line, "arrays of %.40s cannot be read", word);
}

int vtk_skip_colors(vtk_words *w, int are_coordinates, uint64_t tuples, uint64_t fixed_parts)
{
    cgt_trajectory *const t = w->in.t;
    char name[VTK_WORD];
    uint64_t parts = fixed_parts;
    vtk_type type = w->is_binary ? VTK_U8 : VTK_F32;
    if (vtk_word_inside(w, name, array) < 0 || (fixed_parts == 0 && vtk_count(w, &parts, array) < 0) ||
        (are_coordinates && vtk_read_type(w, &type) < 0) || (fixed_parts > 0 && vtk_count(w, &tuples, array) < 0))
        return -1;
    vtk_end_line(w, NULL);
    if (parts > 65536)
        return trajectory_fail(t, w->line, "the array %.40s has more than 65536 columns", name);
    return vtk_skip(w, type, parts * tuples, array);
}
