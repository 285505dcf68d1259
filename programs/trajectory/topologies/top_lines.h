/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Lines of a GROMACS topology after its preprocessor: #include, #define, #undef, #ifdef, #ifndef, #else, #endif,
 * comments behind ";", lines that go on behind "\". As grompp without definitions of a run. */
#ifndef TOP_LINES_H
#define TOP_LINES_H

#include "trajectory/topologies/word_map.h"
#include "trajectory/trajectory_internal.h"

enum {
    TOP_DEEPEST = 32, /* files that include each other */
    TOP_FILES = 1000, /* in all */
    TOP_IFS = 64      /* conditions one within the other */
};

/* A file that is included. */
typedef struct top_file {
    trajectory_input input;
    text_reader text;
    char *path;
} top_file;

typedef struct top_lines {
    top_file *file[TOP_DEEPEST]; /* the last one is read; none: the topology itself is */
    uint32_t depth, files;
    uint8_t is_on[TOP_IFS], was_else[TOP_IFS]; /* of each condition: whether its lines count, by itself */
    uint32_t ifs, on;                          /* of those the first ones that count */
    word_map defined;
    uint8_t *is_defined; /* of each word */
    char *line;          /* one that goes on */
    size_t line_capacity;
    uint32_t missing; /* files that were not found */
    char first_missing[256];
} top_lines;

/* The next line with something in it: 1, 0 at the end, -1 error noted. Valid until the next call. */
int top_lines_next(cgt_trajectory *t, top_lines *l, text_span *line);

/* Notes an error at the last line, of whichever file. Returns -1. */
int top_lines_fail(cgt_trajectory *t, const top_lines *l, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void top_lines_free(top_lines *l);

#endif
