/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Settings files (common/settings_file.h) of a command line; options.h prints its own as such a file. */
#ifndef SETTINGS_ARGUMENTS_H
#define SETTINGS_ARGUMENTS_H

#include <stddef.h>

/* A command line with the options of settings files put in: --settings FILE becomes the file's options, which come
 * before all others, so that the command line overrides them. Valid until the program ends. */
typedef struct settings_arguments {
    int argc;
    char **argv;
} settings_arguments;

/* Expands the files that argv names. Returns 0, or -1 with a sentence that names file and line. A file may not name
 * another one. */
int settings_expand(int argc, char **argv, settings_arguments *expanded, char *error, size_t error_size);

#endif
