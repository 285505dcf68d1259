/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Options of cgt-render about movies, and about sharing a run among processes: a child of its argp parser. */
#ifndef OUTPUT_OPTIONS_H
#define OUTPUT_OPTIONS_H

#include <argp.h>
#include <stdint.h>

typedef struct output_options {
    double rate;          /* of movies, frames a second; 0: not given */
    int quality;          /* of movies and JPEG: 1 to 100; 0: not given */
    const char *preset;   /* of x264; NULL: not given */
    uint32_t part, parts; /* renders part `part` of `parts`, from 1; 0, 0: all */
    uint64_t survey;      /* frames to look at before the first is rendered; UINT64_MAX: all */
} output_options;

void output_options_init(output_options *options);

/* Its input is an output_options. */
extern const struct argp output_options_argp;

#endif
