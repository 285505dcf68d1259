/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Names of output files: a pattern with at most one number in it, and the folders of its path. A pattern comes from the
 * command line, so it is parsed here and never handed to printf. */
#ifndef OUT_PATH_H
#define OUT_PATH_H

#include <stddef.h>
#include <stdint.h>

typedef struct out_path {
    const char *pattern; /* "out/frame_%04d.png"; %% stands for a % */
    size_t number_at;    /* where its %d or %04d begins; the pattern's length where it has none */
    size_t number_end;   /* the first character after it */
    int digits;          /* at least this many, with leading zeros */
    int numbered;
} out_path;

/* Takes a pattern apart; it must stay valid. Returns 0, or -1 with a sentence in error. */
int out_path_parse(out_path *path, const char *pattern, char *error, size_t error_size);

/* Writes the name with that number into text. Returns 0, or -1 where it does not fit into size. */
int out_path_name(const out_path *path, uint64_t number, char *text, size_t size);

/* Whether a pattern makes that name with some number. */
int out_path_makes(const out_path *path, const char *name);

/* Makes the folder that name lies in, and those above it, where they are missing. Returns 0, or -1 with a text. */
int out_path_make_folder(const char *name, char *error, size_t error_size);

/* Returns 1 where name ends in ending, in any case of letters: ".png". */
int out_path_ends_in(const char *name, const char *ending);

#endif
