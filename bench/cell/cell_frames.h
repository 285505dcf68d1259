/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench cell --frames: Chapman's tracer on simulated SPEs. */
#ifndef CELL_FRAMES_H
#define CELL_FRAMES_H

#include <stdbool.h>
#include <stddef.h>

#include "common/bench_table.h"

/* Frames of 2,000 random spheres, 320 x 180 pixels, by the grid program, an ELF file in memory: the sections "kernel",
 * by loop and culling on one SPE, "assignment", by assignment and number of SPEs, and those of
 * cell_waits.h. Returns false after a message. */
bool cell_frames_run(bench_table *table, const void *elf, size_t bytes);

#endif
