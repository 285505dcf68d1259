/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The rows of cgt-bench cell, see cell_tables.h. */
#include "cell/cell_tables.h"

#include <math.h>

#include "cell/spu/timing/model.h"

const char *const cell_assignments[CGT_ASSIGNMENTS] = {"interleaved", "static", "dynamic", "hybrid"};

double cell_share(uint64_t part, uint64_t all) { return all ? (double)part / (double)all : NAN; }

static void cause_cells(bench_table *table, const cgt_spu_counts *counts)
{
    for (int i = 0; i < CGT_SPU_CAUSES; i++)
        BENCH_CELLS(table, CELL(cgt_spu_cause_names[i], counts->cycles[i]));
}

void cell_program_row(bench_table *table, const micro_program *program, const micro_result *result)
{
    BENCH_CELLS(table, CELL("program", program->name), CELL("cycles", result->cycles), CELL("by_hand", program->cycles),
                CELL("instructions", result->counts.instructions));
    cause_cells(table, &result->counts);
    BENCH_ROW(table, CELL("mispredicts", result->counts.mispredicts), CELL("shows", program->shows));
}

/* ---- functions ---- */

static void function_row(bench_table *table, const char *name, const cgt_spu_counts *counts, uint64_t all)
{
    const uint64_t cycles = cgt_spu_counts_cycles(counts);
    if (cycles == 0)
        return;
    BENCH_CELLS(table, CELL("function", name), CELL("cycles", cycles), CELL("percent", 100 * cell_share(cycles, all)),
                CELL("instructions", counts->instructions), CELL("ipc", cell_share(counts->instructions, cycles)));
    cause_cells(table, counts);
    BENCH_ROW(table, CELL("mispredicts", counts->mispredicts));
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

/* ---- simulator and model ---- */

static const char *pipe_of(int class) { return cgt_spu_pipes[class].odd ? "odd" : "even"; }

void cell_class_rows(bench_table *table, const cgt_spu_counts *counts)
{
#define X(class, pipe, latency, source)                                                                                \
    BENCH_ROW(table, CELL("class", #class), CELL("pipe", pipe_of(CGT_SPU_##class)),                                    \
              CELL("instructions", counts->classes[CGT_SPU_##class]),                                                  \
              CELL("percent", 100 * cell_share(counts->classes[CGT_SPU_##class], counts->instructions)));
    CGT_SPU_MODEL_CLASSES(X)
#undef X
}

void cell_speed_row(bench_table *table, const char *mode, const cgt_spu *spu, double seconds)
{
    BENCH_ROW(table, CELL("mode", mode), CELL("instructions", spu->instructions), CELL("cycles", spu->cycle),
              CELL("cpu_seconds", seconds),
              CELL("million_instructions_s", seconds > 0 ? (double)spu->instructions / seconds / 1e6 : NAN));
}

void cell_model_rows(bench_table *table)
{
    bench_table_section(table, "pipes");
#define X(class, pipe, latency, source)                                                                                \
    BENCH_ROW(table, CELL("class", #class), CELL("pipe", pipe_of(CGT_SPU_##class)), CELL("latency", latency),          \
              CELL("source", source));
    CGT_SPU_MODEL_CLASSES(X)
#undef X
    bench_table_section(table, "constants");
#define X(name, value, meaning, source)                                                                                \
    BENCH_ROW(table, CELL("constant", #name), CELL("value", value), CELL("meaning", meaning), CELL("source", source));
    CGT_SPU_MODEL_CONSTANTS(X)
#undef X
}
