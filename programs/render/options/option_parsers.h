/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Values of cgt-render's own options that are more than a number. Each is an option_parser: it returns 0, or -1 with a
 * sentence in error. `to` is what option_table.c says. */
#ifndef OPTION_PARSERS_H
#define OPTION_PARSERS_H

#include "common/options.h"
#include "options/figure_values.h"
#include "render/options/render_options.h"

/* The table of cgt-render; first called by one thread. */
const option_table *render_option_table(void);

/* render_options.c: an option_table's finish. */
int render_options_finish(void *options, const char **operands, size_t count, char *error, size_t size);

/* output_parsers.c */
option_parser parse_output, parse_grid; /* render_options */
option_parser parse_sheet, parse_part;  /* const char *, output_options */

#endif
