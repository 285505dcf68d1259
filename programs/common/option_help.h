/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * --help and --usage of a table of options, laid out as the programs of GNU do. */
#ifndef OPTION_HELP_H
#define OPTION_HELP_H

#include <stdio.h>

#include "common/options.h"

/* The options that every program has, after those of its table. */
enum { OPTION_HELP, OPTION_USAGE, OPTION_VERSION, OPTION_STANDARD_ROWS };
extern const option_row option_standard_rows[OPTION_STANDARD_ROWS];

void option_print_help(const option_table *table, const char *program, FILE *to);
void option_print_usage(const option_table *table, const char *program, FILE *to);

/* "Try ... for more information", behind an error. */
void option_print_hint(const char *program, FILE *to);

#endif
