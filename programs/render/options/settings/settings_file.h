/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Settings files: the options of a command line, one a line,
 *     # a comment
 *     style = paper
 *     transparent
 *     type-color = 2=red
 * and the command line as such a text, for --print-settings and for what pictures say of themselves. */
#ifndef SETTINGS_FILE_H
#define SETTINGS_FILE_H

#include <argp.h>
#include <stddef.h>

/* A command line with the options of settings files put in: --settings FILE becomes the file's options, which come before
 * all others, so that the command line overrides them. Valid until the program ends. */
typedef struct settings_arguments {
    int argc;
    char **argv;
} settings_arguments;

/* Expands the files that argv names. Returns 0, or -1 with a sentence that names file and line. A file may not name
 * another one. */
int settings_expand(int argc, char **argv, settings_arguments *expanded, char *error, size_t error_size);

/* The options of a command line as a settings file, in the order in which they were given; with `all`, options that were
 * not given follow as comments. Options that change no pixel of a frame (threads, output,
 * first, quiet...) are left out. The caller frees the text;
 * NULL where there is no memory. */
char *settings_text(const struct argp *parser, int argc, char **argv, int all);

#endif
