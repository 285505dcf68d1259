/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rows of cgt-bench cell, and its programs. */
#ifndef CELL_TABLES_H
#define CELL_TABLES_H

#include "cell/micro_programs.h"
#include "cell/ppe/assignment.h"
#include "common/bench.h"
#include "common/bench_table.h"

/* ELF files in memory; none: NULL. */
typedef struct cell_programs {
    const void *elf, *bih;
    size_t elf_bytes, bih_bytes;
} cell_programs;

extern const char *const cell_assignments[CGT_ASSIGNMENTS];

/* part / all; NaN where there is nothing. */
double cell_share(uint64_t part, uint64_t all);

/* Functions that ran, the one with most cycles first, then "(other)" for code without a symbol, and "(all)". */
void cell_function_rows(bench_table *table, const cgt_spu_timing *timing);

/* Instructions by class and pipe. */
void cell_class_rows(bench_table *table, const cgt_spu_counts *counts);

/* A built-in program; instructions a second of the simulator, seconds being the processor's. */
void cell_program_row(bench_table *table, const micro_program *program, const micro_result *result);
void cell_speed_row(bench_table *table, const char *mode, const cgt_spu *spu, double seconds);

/* The sections "pipes" and "constants": the numbers of the model and their sources. */
void cell_model_rows(bench_table *table);

/* Chapman's tracer on simulated SPEs, in sections, on one SPE where they do not say: "kernel", by loop, culling, and
 * whether tests are remembered; "push"; "light", rays from hits; "memory", by the bandwidth of main memory;
 * "assignment", by assignment and number of SPEs; "waits" and "ppe", what SPEs wait for; "spheres", by their number.
 * With --profile one frame on one SPE: "functions", "classes" and "kernel". Returns false after a message. */
bool cell_grid_run(bench_table *table, const bench_settings *settings, const cell_programs *programs);

/* The thesis' tracer: frames of a hilly sheet of 20,164 triangles, in sections: "kernel", with its "functions"; then,
 * on smaller pictures, what each choice costs: "layouts", "triangles", "traversals", "envelopes", "assignments",
 * "parts", "modes"; with both programs "structures", "hierarchies" and "rebuilt". Returns false after a message. */
bool cell_kd_run(bench_table *table, const bench_settings *settings, const cell_programs *programs);

#endif
