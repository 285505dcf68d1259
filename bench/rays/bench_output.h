/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The file of a frame's hits that -o names: whole, or not there. */
#ifndef BENCH_OUTPUT_H
#define BENCH_OUTPUT_H

#include "common/out_file.h"
#include "rays/bench_planes.h"

typedef struct bench_output {
    const char *path;
    const char *temporary; /* NULL: there is no file, or it is finished */
    out_file file;
} bench_output;

/* Begins a file. path: NULL for none. Returns PROGRAM_OK, or PROGRAM_FAILED after a message. */
int bench_output_begin(bench_output *output, const char *path);

/* Writes the hits, and ends the file; planes: NULL where there are none: no file stays. Returns as above. Does nothing
 * where no file was begun. */
int bench_output_end(bench_output *output, const bench_planes *planes);

#endif
