/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Command lines by one table: each option has a row with its name, its values, its limits, the place where its value
 * goes, and its help. From the table come parsing, --help, --usage and so the man page, the words that the shell
 * completes, the option's line in a settings file, and the sentences about wrong values. Command lines are read as
 * GNU's getopt_long does: options and operands in any order, names shortened, -- ends the options. */
#ifndef OPTIONS_H
#define OPTIONS_H

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
    int is_running; /* it changes no pixel: settings files leave it out */
} option_row;

typedef struct option_table {
    const option_row *rows;
    size_t count;
    int names_letters;     /* 1: sentences about a value name an option by its letter where it has one */
    const char *arguments; /* "INPUT... OUTPUT" */
    const char *text;      /* for --help: before the options, \v, and after them */
    const char *program;   /* how messages name it; NULL: as program_init was told */
    int is_command;        /* 1: the first operand ends the options, and all that follows are operands */
    /* Checks that need the whole command line, and takes what is no option. Returns 0, or -1 with a sentence. */
    int (*finish)(void *options, const char **operands, size_t count, char *error, size_t error_size);
} option_table;

option_parser option_parse_origin; /* double[3] */

/* For parsers of lists: copies the next item, cut where it is too long, and advances *list, which is NULL at the end.
 * Returns 0 where none is left. */
enum { OPTION_ITEM_SIZE = 32 };
int option_next(const char **list, char item[OPTION_ITEM_SIZE]);

/* The number of a name; -1 with a sentence where there is none such. */
int option_find(const char *const *names, const char *name, char *error, size_t error_size);

enum { OPTIONS_MOST = 160 };

typedef struct options_given {
    char *settings; /* the command line as a settings file; the caller frees it; NULL: no memory */
    char is_given[OPTIONS_MOST];
} options_given;

/* Parses a command line into the struct `options`. Ends the program on --help, --version (PROGRAM_OK) and errors
 * (PROGRAM_USAGE). Operands are moved to the front of argv, behind argv[0]. given: may be NULL. */
void options_parse(const option_table *table, void *options, int argc, char **argv, options_given *given);

/* Prints the options that were not given, as comments of a settings file. */
void options_print_others(const option_table *table, const options_given *given);

#endif
