/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rows of tables of options: their names, values, limits, the place where a value goes, and their help. Command lines
 * and figures are set by them. */
#ifndef OPTION_ROW_H
#define OPTION_ROW_H

#include <stddef.h>
#include <stdint.h>

#include "options/numbers.h"

typedef enum option_type {
    OPTION_FLAG,   /* int: becomes `first` */
    OPTION_BOOL,   /* bool: becomes true */
    OPTION_TEXT,   /* const char *: the argument itself, which stays valid */
    OPTION_WORD,   /* int or an enum: the number of one of `words` or `names`, plus `first` */
    OPTION_NAME,   /* const char *: one of `words` */
    OPTION_LIST,   /* an array of int: 1 for each of `names` that is given, with commas, or by several options */
    OPTION_FLOAT,  /* float from low to high */
    OPTION_DOUBLE, /* double, read as a float from low to high */
    OPTION_U32,    /* uint32_t or int from first to last */
    OPTION_U64,    /* uint64_t from first to last */
    OPTION_PARSED, /* as parse does */
    OPTION_FIGURE, /* none: a figure's row of that name takes its place */
    OPTION_REFUSED /* none: `help` says why not, and --help does not show it */
} option_type;

typedef struct option_row {
    const char *name;  /* NULL: `help` is a heading, and the rows that follow are shown in the order of its `group` */
    char letter;       /* 0: none */
    const char *value; /* what --help calls its value; NULL: it has none */
    const char *help;
    int group; /* of a heading, from 1 on */
    option_type type;
    size_t at;             /* offset of the value */
    size_t given;          /* offset of an int that becomes 1, plus 1; 0: none */
    size_t given_bool;     /* the same of a bool */
    int is_optional;       /* the value may be left out, and is then `otherwise` */
    const char *otherwise; /* NULL: the value stays as it is */
    /* With blanks or ", " between them: what completion offers, and of OPTION_WORD and OPTION_NAME all there is. */
    const char *words;
    const char *const *names; /* the same of OPTION_WORD and OPTION_LIST, ended by NULL; NULL: there are `words` */
    double low, high;
    uint64_t first, last;
    option_parser *parse;
    int repeats;    /* each value is added to those before it */
    int is_running; /* it changes no pixel: settings files leave it out */
} option_row;

/* For parsers of lists: copies the next item, cut where it is too long, and advances *list, which is NULL at the end.
 * Returns 0 where none is left. */
enum { OPTION_ITEM_SIZE = 32 };
int cgt_option_next(const char **list, char item[OPTION_ITEM_SIZE]);

/* The number of a name; -1 with a sentence where there is none such. */
int cgt_option_find(const char *const *names, const char *name, char *error, size_t error_size);

/* Sets the value of a row in the struct `options`. text: NULL: there is none, which the row allows; it stays valid, as
 * long as the options do. Returns 0, or -1 with a sentence. */
int cgt_option_set(const option_row *row, const char *text, void *options, char *error, size_t error_size);

/* The rows of a figure, whose places are in figure_options, with headings. */
extern const option_row cgt_figure_rows[];
extern const size_t cgt_figure_row_count;

/* The figure's row of a name; NULL: there is none. */
const option_row *cgt_figure_find_row(const char *name);

#endif
