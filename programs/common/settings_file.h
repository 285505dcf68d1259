/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Settings files: options, one a line, which cgt-render, cgt-view and the page read and write:
 *     # a comment
 *     style = paper
 *     transparent
 *     type-color = 2=red
 * A value reaches to the end of its line; blanks around names and values do not count, and quotes are letters. But a
 * value in double quotes that begins or ends with a blank inside of them is what they have between them: " two ". */
#ifndef SETTINGS_FILE_H
#define SETTINGS_FILE_H

#include <stddef.h>
#include <stdio.h>

#include "options/option_row.h"

/* Takes an option; value: NULL: it has none. Returns 0, or -1 with a sentence. */
typedef int settings_taker(void *user, const char *name, const char *value, char *error, size_t error_size);

/* Hands over a file's options in their order. Returns 0, or -1 with a sentence that names file and line. */
int settings_read(const char *path, settings_taker *take, void *user, char *error, size_t error_size);

/* Whether a value can be one of a row, whose place is in the struct `options`, which gets it: what needs several
 * options is left to others. Returns 0, or -1 with a sentence that names the option. */
int settings_check(const option_row *row, const char *value, void *options, char *error, size_t error_size);

/* The options of a figure in a file, whose values are checked one by one, as lines for cgt_figure_set_lines, which the
 * caller frees. NULL with a sentence that names file and line.
 *   without_size   1: without the size, which a window or a page has of its own
 *   left_out       gets the names of the others, which are of files or a program, with ", " between them; "": none */
char *settings_read_figure(const char *path, int without_size, char *left_out, size_t left_out_size, char *error,
                           size_t error_size);

/* Of such lines: the next; the letters of a line's name. */
const char *settings_next_line(const char *line);
size_t settings_name_length(const char *line);

/* Copies or prints those whose names are a figure's options, or the others. to: as long as `lines`; returns the length,
 * without an end. */
size_t settings_copy_part(const char *lines, int of_figure, char *to);
void settings_print_part(FILE *to, const char *lines, int of_figure);

/* The same lines as files have them, with quotes around values whose blanks would not count. The caller frees them.
 * NULL: no memory. */
char *settings_quote(const char *lines);

/* Writes a file of lines "name = value", quoted, whole or not at all. Returns 0, or -1 with a sentence. */
int settings_write(const char *path, const char *lines, char *error, size_t error_size);

#endif
