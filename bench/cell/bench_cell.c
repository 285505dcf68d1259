/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench cell: where the cycles of an SPU program go, by the simulator's timing model. */
#include <argp.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cell/cell_frames.h"
#include "cell/cell_tables.h"
#include "cell/kd_frames.h"
#include "cell/micro_programs.h"
#include "cell/spu/elf.h"
#include "common/bench.h"
#include "common/bench_table.h"
#include "common/program.h"
#include "core/memory.h"

enum {
    OPTION_CYCLES = 0x700,
    OPTION_FRAMES,
    OPTION_KD,
    OPTION_PROFILE,
    OPTION_PIXELS,
    OPTION_SPHERES,
    OPTION_SECTION,
    OPTION_BIH
};
#define DEFAULT_CYCLES UINT64_C(100000000000)
#define MOST_FILE_BYTES ((size_t)16 << 20)

typedef struct cell_settings {
    const char *path;     /* NULL: the built-in programs */
    const char *bih_path; /* NULL: none */
    const char *json_path;
    uint64_t cycles;
    bool frames, kd, profile;
    cell_frames frame; /* its size, and spheres */
} cell_settings;

static const struct argp_option options[] = {
    {"cycles", OPTION_CYCLES, "COUNT", 0, "most cycles of a program (default 10^11)", 0},
    {"frames", OPTION_FRAMES, NULL, 0, "FILE is spe_grid.elf: trace frames of spheres on 1 to 8 SPEs", 0},
    {"profile", OPTION_PROFILE, NULL, 0, "with --frames: one frame on one SPE, function by function", 0},
    {"pixels", OPTION_PIXELS, "WxH", 0, "of a frame (default 320x180)", 0},
    {"spheres", OPTION_SPHERES, "COUNT", 0, "of a frame's scene (default 2000)", 0},
    {"kd", OPTION_KD, NULL, 0, "FILE is spe_kd.elf: trace frames of triangles through caches", 0},
    {"bih", OPTION_BIH, "FILE", 0, "with --kd: spe_bih.elf, to compare bounding interval hierarchies with kd-trees", 0},
    {"section", OPTION_SECTION, "NAME", 0, "with --frames or --kd: this section of the rows alone", 0},
    {"json", 'j', "FILE", 0, "write the rows as JSON, too", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

/* Width and height as "320x180". */
static bool parse_pixels(const char *text, cell_frames *frame)
{
    uint32_t number[2] = {0};
    for (int k = 0; k < 2; k++) {
        uint32_t digits = 0;
        for (; *text >= '0' && *text <= '9' && digits < 4; digits++)
            number[k] = number[k] * 10 + (uint32_t)(*text++ - '0');
        if (number[k] == 0 || *text++ != (k ? 0 : 'x'))
            return false;
    }
    frame->width = number[0];
    frame->height = number[1];
    return true;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    cell_settings *settings = state->input;
    char error[PROGRAM_ERROR_SIZE] = "";
    uint64_t count = 0;
    switch (key) {
    case OPTION_CYCLES:
        if (program_parse_u64(argument, 1, UINT64_MAX, &settings->cycles, error, sizeof error))
            argp_error(state, "--cycles: %s", error);
        return 0;
    case OPTION_FRAMES: settings->frames = true; return 0;
    case OPTION_PROFILE: settings->profile = true; return 0;
    case OPTION_SECTION: settings->frame.section = argument; return 0;
    case OPTION_PIXELS:
        if (!parse_pixels(argument, &settings->frame))
            argp_error(state, "--pixels: %s is no WxH of 1 to 9999", argument);
        return 0;
    case OPTION_SPHERES:
        if (program_parse_u64(argument, 1, UINT32_MAX, &count, error, sizeof error))
            argp_error(state, "--spheres: %s", error);
        settings->frame.spheres = (uint32_t)count;
        return 0;
    case OPTION_KD: settings->kd = true; return 0;
    case OPTION_BIH: settings->bih_path = argument; return 0;
    case 'j': settings->json_path = argument; return 0;
    case ARGP_KEY_ARG:
        if (settings->path)
            argp_error(state, "one FILE is wanted, not also %s", argument);
        settings->path = argument;
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* Of the processor: other programs on the machine do not count. */
static double cpu_seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

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
        const double start = cpu_seconds();
        const bool stopped = micro_kernel_run(&spu);
        cell_speed_row(table, mode ? "timed" : "untimed", &spu, cpu_seconds() - start);
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

static int run_trees(bench_table *table, const cell_settings *settings, const void *elf, size_t size)
{
    kd_programs programs = {.kd = elf, .kd_bytes = size};
    unsigned char *const bih = settings->bih_path ? read_file(settings->bih_path, &programs.bih_bytes) : NULL;
    if (settings->bih_path && !bih)
        return PROGRAM_FAILED;
    programs.bih = bih;
    const bool done = kd_frames_run(table, &programs, settings->frame.section);
    free(bih);
    return done ? PROGRAM_OK : PROGRAM_FAILED;
}

static int run_file(bench_table *table, const cell_settings *settings)
{
    cgt_spu spu;
    size_t size = 0;
    unsigned char *const bytes = read_file(settings->path, &size);
    if (!bytes)
        return PROGRAM_FAILED;
    if (settings->frames) {
        cell_frames frame = settings->frame;
        frame.elf = bytes;
        frame.bytes = size;
        const bool done = settings->profile ? cell_frames_profile(table, &frame) : cell_frames_run(table, &frame);
        free(bytes);
        return done ? PROGRAM_OK : PROGRAM_FAILED;
    }
    if (settings->kd) {
        const int done = run_trees(table, settings, bytes, size);
        free(bytes);
        return done;
    }
    if (create(&spu, CGT_SPU_TIMED)) {
        free(bytes);
        return PROGRAM_FAILED;
    }
    int code = PROGRAM_FAILED;
    if (cgt_spu_load_elf(&spu, bytes, size, settings->path)) {
        program_error("%s", spu.message);
    } else {
        const double start = cpu_seconds();
        const cgt_spu_end end = cgt_spu_run(&spu, NULL, settings->cycles);
        const double seconds = cpu_seconds() - start;
        code = explain_end(settings->path, &spu, end);
        bench_table_section(table, "functions");
        cell_function_rows(table, spu.timing);
        bench_table_section(table, "simulator");
        cell_speed_row(table, "timed", &spu, seconds);
    }
    cgt_spu_destroy(&spu);
    free(bytes);
    return code;
}

int bench_cell(int argc, char **argv)
{
    static const struct argp parser = {
        .options = options,
        .parser = parse,
        .args_doc = "[FILE]",
        .doc = "Simulates a program of an SPU, an ELF file, and prints where its cycles go, function by function. "
               "Without FILE: programs of a few instructions whose cycles can be counted by hand, and the numbers of "
               "the timing model with their sources. Cycles are the model's; it was never compared with a console. "
               "The program has no channels: it cannot use DMA or mailboxes."};
    cell_settings settings = {.cycles = DEFAULT_CYCLES};
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    if (settings.frames && !settings.path) {
        program_error("--frames wants the program's FILE, spe_grid.elf");
        return PROGRAM_USAGE;
    }
    if (settings.kd && !settings.path) {
        program_error("--kd wants the program's FILE, spe_kd.elf");
        return PROGRAM_USAGE;
    }
    if (settings.bih_path && !settings.kd) {
        program_error("--bih wants --kd and the FILE of that, spe_kd.elf");
        return PROGRAM_USAGE;
    }
    bench_table *const table = bench_table_open(settings.json_path);
    if (!table)
        return PROGRAM_FAILED;
    int code = settings.path ? run_file(table, &settings) : run_built_in(table);
    if (bench_table_close(table))
        code = PROGRAM_FAILED;
    return code;
}
