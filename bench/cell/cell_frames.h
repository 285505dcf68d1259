/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench cell --frames: Chapman's tracer on simulated SPEs. */
#ifndef CELL_FRAMES_H
#define CELL_FRAMES_H

#include <stdbool.h>
#include <stddef.h>

#include "cell/cell_tables.h"

/* The frames; 0: the default. */
typedef struct cell_frames {
    const void *elf; /* the grid program, `bytes` long */
    size_t bytes;
    uint32_t width, height; /* 320 x 180 */
    uint32_t spheres;       /* 2,000, random, of radius 0.03 in a cube of edge 2 */
} cell_frames;

/* Sections, on one SPE where they do not say: "kernel", by loop, culling, and whether tests are remembered; "push";
 * "light", rays from hits; "memory", by the bandwidth of main memory; "assignment", by assignment and number of SPEs;
 * those of cell_waits.h; "spheres", by their number. Returns false after a message. */
bool cell_frames_run(bench_table *table, const cell_frames *frames);

/* One frame on one SPE: the section "functions", where its cycles go, and a row of "kernel". */
bool cell_frames_profile(bench_table *table, const cell_frames *frames);

#endif
