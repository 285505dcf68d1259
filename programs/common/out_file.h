/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Output files that are whole or not there: written under a temporary name in the same folder, then renamed. A symbolic
 * link stays one: the file that it names is replaced. A signal that ends the program removes the temporary files. Up to
 * OUT_FILE_MOST files are written at once, from any threads. */
#ifndef OUT_FILE_H
#define OUT_FILE_H

#include <stddef.h>

#include "common/stop_flag.h"

#define OUT_FILE_PATH_SIZE 4096
#define OUT_FILE_MOST 64

typedef struct out_file {
    char target[OUT_FILE_PATH_SIZE]; /* what is replaced: the name, links followed */
    unsigned mode;                   /* the target's, or a new file's */
    int slot;                        /* of its temporary file */
} out_file;

/* Takes over signals. INT, TERM, HUP and QUIT remove the temporary files and end the program as they would without;
 * with stop, the first INT, TERM or HUP sets *stop to 1 instead. Signals that are ignored stay so. A file at the limit
 * of its size is an error of the call that writes (XFSZ is ignored). */
void out_file_catch_signals(stop_flag *stop);

/* Creates the temporary file, empty. Returns its name, valid until out_file_end; or NULL with a sentence in error: the
 * target is no regular file, its folder refuses, or OUT_FILE_MOST files are being written. */
const char *out_file_begin(out_file *file, const char *name, char *error, size_t error_size);

/* Ends what out_file_begin began: with keep, moves the file to its name, else removes it. Returns 0, or -1 with a
 * sentence in error: the file was removed. */
int out_file_end(out_file *file, int keep, char *error, size_t error_size);

#endif
