/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Words and values of a legacy VTK file: text, with arrays that are text or big-endian binary. */
#ifndef VTK_WORDS_H
#define VTK_WORDS_H

#include "trajectory/binary/binary_reader.h"

#define VTK_WORD 256 /* bytes of a word, its zero included */

typedef struct vtk_words {
    binary_reader in;
    int is_binary;
    uint64_t line;
} vtk_words;

/* Types of values. */
typedef enum vtk_type {
    VTK_NONE = 0,
    VTK_I8,
    VTK_U8,
    VTK_I16,
    VTK_U16,
    VTK_I32,
    VTK_U32,
    VTK_I64,
    VTK_U64,
    VTK_F32,
    VTK_F64,
    VTK_BIT, /* these two are passed over */
    VTK_STRING
} vtk_type;

/* The type of this name, VTK_NONE for one that is not known. */
vtk_type vtk_find_type(const char *name);
int vtk_is_whole(vtk_type type);

/* The next word, wherever it stands: 1, 0 at the end of the file, -1: it is too long. */
int vtk_word(vtk_words *w, char word[VTK_WORD]);

/* The same where one must be; name: "the header". */
int vtk_word_inside(vtk_words *w, char word[VTK_WORD], const char *name);

/* The next word of this line: 1, or 0 where the line ends before it; then the line feed is not taken. */
int vtk_word_of_line(vtk_words *w, char word[VTK_WORD]);

/* Goes past the next line feed. *line (may be NULL) gets the text before it, cut to 255 bytes. Returns 1, or 0: the
 * file ends. */
int vtk_end_line(vtk_words *w, char line[VTK_WORD]);

/* A count that must be the next word. Returns 1 or -1. */
int vtk_count(vtk_words *w, uint64_t *count, const char *name);

/* A value of an array. Returns 1 or -1. */
int vtk_value(vtk_words *w, vtk_type type, double *value, const char *name);

/* Skips values of an array. Returns 1 or -1. */
int vtk_skip(vtk_words *w, vtk_type type, uint64_t count, const char *name);

/* ---- Parts that are passed over. All return 1 or -1 ---- */

/* The type that an array's values have, which must be the next word. */
int vtk_read_type(vtk_words *w, vtk_type *type);

/* After COLOR_SCALARS and LOOKUP_TABLE: bytes in binary files, floats in text; TEXTURE_COORDINATES tell their number
 * and type. fixed_parts: columns, where the file tells the rows; 0: it tells the columns, and there are `tuples`
 * rows. */
int vtk_skip_colors(vtk_words *w, int are_coordinates, uint64_t tuples, uint64_t fixed_parts);

#endif
