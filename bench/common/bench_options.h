/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The one table of options of cgt-bench. Each row says who takes the option, and where its value goes. */
#ifndef BENCH_OPTIONS_H
#define BENCH_OPTIONS_H

#include "common/bench.h"

typedef enum bench_option_kind {
    BENCH_OPTION_FLAG, /* int, set to 1 */
    BENCH_OPTION_U32,
    BENCH_OPTION_U64,
    BENCH_OPTION_TEXT,
    BENCH_OPTION_ONE,  /* an enum of the library, by its name */
    BENCH_OPTION_LIST, /* int for each name; a list with commas, or the option several times */
    BENCH_OPTION_CALL  /* by a function */
} bench_option_kind;

/* Takes an option's value: 0, or -1 with a text. */
typedef int bench_option_call(bench_settings *settings, const char *text, char *error, size_t error_size);

typedef struct bench_option {
    const char *name;
    char letter; /* 0: none */
    const char *argument, *doc;
    int group;
    unsigned subjects;
    bench_option_kind kind;
    size_t offset;        /* of the value in the settings */
    uint64_t least, most; /* of numbers */
    const char *const *names;
    bench_option_call *call;
} bench_option;

enum { BENCH_OPTION_GROUPS = 6 };

extern const bench_option bench_options[];
extern const size_t bench_option_count;
extern const char *const bench_option_groups[BENCH_OPTION_GROUPS];

/* Copies the next name of a list with commas, cut where it is too long, and advances *list, which is NULL at the end.
 * Returns 0 where no name is left. */
#define BENCH_LISTED_SIZE 32
int bench_next_name(const char **list, char name[BENCH_LISTED_SIZE]);

/* The number of a name; -1, with a text, where there is none. */
int bench_find_name(const char *const *names, const char *name, char *error, size_t error_size);

#endif
