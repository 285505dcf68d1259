/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The rows of cgt-bench cell, see cell_tables.h. */
#include "cell/cell_tables.h"

#include <math.h>

#include "cell/spu/timing/model.h"

/* ---- programs ---- */

static void cause_cells(bench_table *table, const cgt_spu_counts *counts)
{
    for (int i = 0; i < CGT_SPU_CAUSES; i++)
        bench_table_count(table, cgt_spu_cause_names[i], counts->cycles[i]);
}

void cell_program_row(bench_table *table, const micro_program *program, const micro_result *result)
{
    bench_table_text(table, "program", program->name);
    bench_table_count(table, "cycles", result->cycles);
    bench_table_count(table, "by_hand", program->cycles);
    bench_table_count(table, "instructions", result->counts.instructions);
    cause_cells(table, &result->counts);
    bench_table_count(table, "mispredicts", result->counts.mispredicts);
    bench_table_text(table, "shows", program->shows);
    bench_table_end_row(table);
}

/* ---- functions ---- */

static void function_row(bench_table *table, const char *name, const cgt_spu_counts *counts, uint64_t all)
{
    const uint64_t cycles = cgt_spu_counts_cycles(counts);
    if (cycles == 0)
        return;
    bench_table_text(table, "function", name);
    bench_table_count(table, "cycles", cycles);
    bench_table_real(table, "percent", 100 * (double)cycles / (double)all);
    bench_table_count(table, "instructions", counts->instructions);
    bench_table_real(table, "ipc", (double)counts->instructions / (double)cycles);
    cause_cells(table, counts);
    bench_table_count(table, "mispredicts", counts->mispredicts);
    bench_table_end_row(table);
}

/* The function with most cycles below `most`, and of those with equally many the first behind `last`. */
static const cgt_spu_function *find_next(const cgt_spu_timing *timing, uint64_t most, const cgt_spu_function *last)
{
    const cgt_spu_function *found = NULL;
    uint64_t best = 0;
    for (uint32_t i = 0; i < timing->functions; i++) {
        const cgt_spu_function *const f = &timing->function[i];
        const uint64_t cycles = cgt_spu_counts_cycles(&f->counts);
        const bool is_next = cycles < most || (cycles == most && last && f > last);
        if (is_next && cycles > best) {
            found = f;
            best = cycles;
        }
    }
    return found;
}

void cell_function_rows(bench_table *table, const cgt_spu_timing *timing)
{
    const cgt_spu_counts total = cgt_spu_timing_total(timing);
    const uint64_t all = cgt_spu_counts_cycles(&total);
    const cgt_spu_function *f = find_next(timing, UINT64_MAX, NULL);
    while (f) {
        function_row(table, f->name, &f->counts, all);
        f = find_next(timing, cgt_spu_counts_cycles(&f->counts), f);
    }
    function_row(table, "(other)", &timing->other, all);
    function_row(table, "(all)", &total, all);
}

void cell_class_rows(bench_table *table, const cgt_spu_counts *counts)
{
#define X(class, pipe, latency, source)                                                                                \
    bench_table_text(table, "class", #class);                                                                          \
    bench_table_text(table, "pipe", cgt_spu_pipes[CGT_SPU_##class].odd ? "odd" : "even");                              \
    bench_table_count(table, "instructions", counts->classes[CGT_SPU_##class]);                                        \
    bench_table_real(table, "percent", 100 * (double)counts->classes[CGT_SPU_##class] / (double)counts->instructions); \
    bench_table_end_row(table);
    CGT_SPU_MODEL_CLASSES(X)
#undef X
}

/* ---- simulator ---- */

void cell_speed_row(bench_table *table, const char *mode, const cgt_spu *spu, double seconds)
{
    bench_table_text(table, "mode", mode);
    bench_table_count(table, "instructions", spu->instructions);
    bench_table_count(table, "cycles", spu->cycle);
    bench_table_real(table, "cpu_seconds", seconds);
    bench_table_real(table, "million_instructions_s", seconds > 0 ? (double)spu->instructions / seconds / 1e6 : NAN);
    bench_table_end_row(table);
}

/* ---- model ---- */

void cell_model_rows(bench_table *table)
{
    bench_table_section(table, "pipes");
#define X(class, pipe, latency, source)                                                                                \
    bench_table_text(table, "class", #class);                                                                          \
    bench_table_text(table, "pipe", cgt_spu_pipes[CGT_SPU_##class].odd ? "odd" : "even");                              \
    bench_table_count(table, "latency", latency);                                                                      \
    bench_table_text(table, "source", source);                                                                         \
    bench_table_end_row(table);
    CGT_SPU_MODEL_CLASSES(X)
#undef X
    bench_table_section(table, "constants");
#define X(name, value, meaning, source)                                                                                \
    bench_table_text(table, "constant", #name);                                                                        \
    bench_table_count(table, "value", value);                                                                          \
    bench_table_text(table, "meaning", meaning);                                                                       \
    bench_table_text(table, "source", source);                                                                         \
    bench_table_end_row(table);
    CGT_SPU_MODEL_CONSTANTS(X)
#undef X
}
