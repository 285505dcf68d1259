/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The rows of cgt-bench cell. */
#ifndef CELL_TABLES_H
#define CELL_TABLES_H

#include "cell/micro_programs.h"
#include "common/bench_table.h"

void cell_program_row(bench_table *table, const micro_program *program, const micro_result *result);

/* Functions that ran, the one with most cycles first, then "(other)" for code without a symbol, and "(all)". */
/* The rows of section "classes": instructions by class and pipe. */
void cell_class_rows(bench_table *table, const cgt_spu_counts *counts);

void cell_function_rows(bench_table *table, const cgt_spu_timing *timing);

/* Instructions a second of the simulator; seconds are the processor's. */
void cell_speed_row(bench_table *table, const char *mode, const cgt_spu *spu, double seconds);

/* The sections "pipes" and "constants": the numbers of the model and their sources. */
void cell_model_rows(bench_table *table);

#endif
