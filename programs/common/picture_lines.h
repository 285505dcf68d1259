/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What makes a picture that is seen once more: the command line of cgt-render, and lines of Python. */
#ifndef PICTURE_LINES_H
#define PICTURE_LINES_H

#include <cgt/trajectory.h>

/* The picture of frame `number`, to which the `lead` before it belong. */
typedef struct picture_lines {
    const char *settings; /* lines "name = value", of the figure and others of cgt-render */
    const char *const *inputs;
    size_t input_count;
    const char *mesh;                      /* one that stands still beside the run; NULL: none */
    const cgt_trajectory_options *reading; /* whose origin is in `origin`; NULL: the file's own */
    const double *origin;
    uint64_t number, lead;
    const char *output;
} picture_lines;

/* Ended by a line feed. The caller frees them; NULL: no memory. */
char *picture_lines_command(const picture_lines *p);
char *picture_lines_python(const picture_lines *p);

/* Settings as options of a command line, each ended by 0, and an empty one. The caller frees them; NULL: no memory. */
char *picture_lines_options(const char *settings);

#endif
