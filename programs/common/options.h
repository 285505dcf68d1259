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

#include "options/option_row.h"

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
