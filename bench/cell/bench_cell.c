/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench cell: where the cycles of an SPU program go, by the simulator's timing model. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cell/cell_tables.h"
#include "cell/spu/elf.h"
#include "common/bench_timing.h"
#include "core/memory.h"

#define MOST_FILE_BYTES ((size_t)16 << 20)

static int create(cgt_spu *spu, cgt_spu_mode mode)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    if (cgt_spu_create(spu, &memory, mode) == CGT_OK)
        return PROGRAM_OK;
    program_error("out of memory for an SPU");
    return PROGRAM_FAILED;
}

/* ---- the built-in programs ---- */

static int run_micro_programs(bench_table *table)
{
    int code = PROGRAM_OK;
    bench_table_section(table, "programs");
    for (uint32_t i = 0; i < micro_program_count && code != PROGRAM_FAILED; i++) {
        cgt_spu spu;
        micro_result result = {0};
        if (create(&spu, CGT_SPU_TIMED))
            return PROGRAM_FAILED;
        if (!micro_program_run(&spu, &micro_programs[i], UINT64_MAX, &result)) {
            program_error("%s: %s", micro_programs[i].name, spu.message);
            code = PROGRAM_FAILED;
        } else {
            cell_program_row(table, &micro_programs[i], &result);
        }
        cgt_spu_destroy(&spu);
    }
    return code;
}

/* A loop as kernels have it, timed and not: how fast the simulator is. */
static int measure_speed(bench_table *table)
{
    bench_table_section(table, "simulator");
    for (int mode = CGT_SPU_UNTIMED; mode <= CGT_SPU_TIMED; mode++) {
        cgt_spu spu;
        if (create(&spu, (cgt_spu_mode)mode))
            return PROGRAM_FAILED;
        const double start = bench_cpu_ms();
        const bool stopped = micro_kernel_run(&spu);
        cell_speed_row(table, mode ? "timed" : "untimed", &spu, 1e-3 * (bench_cpu_ms() - start));
        cgt_spu_destroy(&spu);
        if (!stopped) {
            program_error("the loop does not stop: %s", spu.message);
            return PROGRAM_FAILED;
        }
    }
    return PROGRAM_OK;
}

static int run_built_in(bench_table *table)
{
    int code = run_micro_programs(table);
    if (code == PROGRAM_OK)
        code = measure_speed(table);
    if (code == PROGRAM_OK)
        cell_model_rows(table);
    return code;
}

/* ---- a file ---- */

/* Reads a whole file; NULL after a message. */
static unsigned char *read_file(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    unsigned char *bytes = file ? malloc(MOST_FILE_BYTES + 1) : NULL;
    if (!bytes) {
        program_error("%s: %s", path, strerror(errno));
        if (file)
            fclose(file);
        return NULL;
    }
    *size = fread(bytes, 1, MOST_FILE_BYTES + 1, file);
    const bool failed = ferror(file) != 0;
    fclose(file);
    if (!failed && *size <= MOST_FILE_BYTES)
        return bytes;
    program_error("%s: %s", path, failed ? strerror(errno) : "too large for a program of an SPU");
    free(bytes);
    return NULL;
}

static int explain_end(const char *path, const cgt_spu *spu, cgt_spu_end end)
{
    switch (end.reason) {
    case CGT_SPU_STOPPED:
        if ((end.value & 0x3f00) == 0x2000) /* how exit ends a program: 0x2000 and its status */
            return end.value & 255
                       ? (program_error("%s: exit status %u", path, (unsigned)end.value & 255), PROGRAM_FAILED)
                       : PROGRAM_OK;
        program_error("%s: stops at 0x%05x with 0x%x", path, (unsigned)spu->pc - 4, (unsigned)end.value);
        return PROGRAM_OK;
    case CGT_SPU_HALTED: program_error("%s: halts at 0x%05x", path, (unsigned)spu->pc - 4); return PROGRAM_FAILED;
    case CGT_SPU_CYCLES: program_error("%s: does not stop; --cycles allows more", path); return PROGRAM_FAILED;
    default: program_error("%s: %s", path, spu->message); return PROGRAM_FAILED;
    }
}

/* One program on one SPU. */
static int run_program(bench_table *table, const bench_settings *settings, const cell_programs *programs)
{
    cgt_spu spu;
    int code = PROGRAM_FAILED;
    if (create(&spu, CGT_SPU_TIMED))
        return PROGRAM_FAILED;
    if (cgt_spu_load_elf(&spu, programs->elf, programs->elf_bytes, settings->paths[0])) {
        program_error("%s", spu.message);
    } else {
        const double start = bench_cpu_ms();
        const cgt_spu_end end = cgt_spu_run(&spu, NULL, settings->cycles);
        const double seconds = 1e-3 * (bench_cpu_ms() - start);
        code = explain_end(settings->paths[0], &spu, end);
        bench_table_section(table, "functions");
        cell_function_rows(table, spu.timing);
        bench_table_section(table, "simulator");
        cell_speed_row(table, "timed", &spu, seconds);
    }
    cgt_spu_destroy(&spu);
    return code;
}

static int run_files(bench_table *table, const bench_settings *settings)
{
    cell_programs programs = {.elf = NULL};
    unsigned char *const elf = read_file(settings->paths[0], &programs.elf_bytes);
    unsigned char *const bih = elf && settings->bih_path ? read_file(settings->bih_path, &programs.bih_bytes) : NULL;
    int code = elf && (bih || !settings->bih_path) ? PROGRAM_OK : PROGRAM_FAILED;
    programs.elf = elf;
    programs.bih = bih;
    if (code == PROGRAM_OK && settings->cell_frames)
        code = cell_grid_run(table, settings, &programs) ? PROGRAM_OK : PROGRAM_FAILED;
    else if (code == PROGRAM_OK && settings->cell_kd)
        code = cell_kd_run(table, settings, &programs) ? PROGRAM_OK : PROGRAM_FAILED;
    else if (code == PROGRAM_OK)
        code = run_program(table, settings, &programs);
    free(elf);
    free(bih);
    return code;
}

int bench_cell(const bench_settings *settings)
{
    bench_table *const table = bench_table_open(settings->json_path);
    if (!table)
        return PROGRAM_FAILED;
    int code = settings->files ? run_files(table, settings) : run_built_in(table);
    if (bench_table_close(table))
        code = PROGRAM_FAILED;
    return code;
}
