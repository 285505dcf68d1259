/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All frames of a trajectory in memory, so that no file is read between measurements. */
#ifndef BENCH_INPUT_H
#define BENCH_INPUT_H

#include <stddef.h>
#include <stdint.h>

#include "common/bench.h"
#include <cgt/trajectory.h>

typedef struct bench_input {
    cgt_trajectory_kind kind;
    size_t frames;
    uint32_t *count;    /* spheres, vertices, or ends of capsules, of each frame */
    float **data;       /* of each frame: centre and radius of each sphere or end, or each vertex */
    uint32_t triangles; /* of all frames; 0 of others */
    uint32_t *index;    /* three vertices of each triangle, or the first end of each capsule; NULL of spheres */
    int is_soup;        /* 1: the vertices are those of one triangle after the other */
    uint32_t most;      /* elements of the fullest frame */
    float *moving;      /* room for the fullest frame: the array that the scene refers to */
} bench_input;

/* Reads the frames that the settings ask for, with their radius and coordinates. A file without a frame is an error.
 * Returns PROGRAM_OK, or PROGRAM_FAILED after a message. */
int bench_input_load_file(bench_input *input, const bench_settings *settings, const char *path);

/* Whether all FILEs can be opened, before a command works for long: PROGRAM_OK, or PROGRAM_FAILED after a message. */
int bench_input_check_files(const bench_settings *settings);

void bench_input_release(bench_input *input);

/* Moves the spheres or vertices: copies a frame to input->moving, and returns its count. */
uint32_t bench_input_move(const bench_input *input, size_t frame);

#endif
