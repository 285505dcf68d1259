/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Options of an emulated Cell; see render_cell_options.h. */
#define _GNU_SOURCE
#include "render/options/render_cell_options.h"

#include <argp.h>
#include <string.h>

#include "common/program.h"

enum { OPTION_CELL = 0x400, OPTION_SPES, OPTION_CELL_ASSIGNMENT, OPTION_CELL_PROGRAM };

const char *const render_cell_assignments[4] = {"interleaved", "static", "dynamic", "hybrid"};

static const struct argp_option table[] = {
    {NULL, 0, NULL, 0, "On an emulated Cell:", 15},
    {"cell", OPTION_CELL, "native|sim|real", 0,
     "Trace spheres by Chapman's program on SPEs of 256 KB each, to the same picture: native, the program compiled "
     "for this machine, or sim, the SPU's own, by instructions and cycles, seconds a frame; real: that on SPEs of this "
     "machine",
     0},
    {"spes", OPTION_SPES, "N", 0, "SPEs, 1 to 16; default 6. Without --cell: native", 0},
    {"cell-assignment", OPTION_CELL_ASSIGNMENT, "NAME", 0,
     "Who traces which strip: interleaved (default), static, dynamic or hybrid", 0},
    {"cell-program", OPTION_CELL_PROGRAM, "FILE", 0, "Of sim and real: spe_grid.elf; default: the installed one", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

static void parse_mode(const char *arg, render_cell_options *o, struct argp_state *state)
{
    if (strcmp(arg, "native") == 0)
        o->mode = RENDER_CELL_NATIVE;
    else if (strcmp(arg, "sim") == 0)
        o->mode = RENDER_CELL_SIM;
    else if (strcmp(arg, "real") == 0)
        o->mode = RENDER_CELL_REAL;
    else
        argp_error(state, "--cell: \"%s\" is not native, sim or real", arg);
}

static void parse_assignment(const char *arg, render_cell_options *o, struct argp_state *state)
{
    for (uint32_t i = 0; i < sizeof render_cell_assignments / sizeof render_cell_assignments[0]; i++)
        if (strcmp(arg, render_cell_assignments[i]) == 0) {
            o->assignment = i;
            return;
        }
    argp_error(state, "--cell-assignment: \"%s\" is not interleaved, static, dynamic or hybrid", arg);
}

static void finish(render_cell_options *o, struct argp_state *state)
{
    if (o->mode == RENDER_CELL_NONE && o->spes)
        o->mode = RENDER_CELL_NATIVE;
    if (o->mode == RENDER_CELL_NONE && (o->assignment || o->program))
        argp_error(state, "--cell-assignment and --cell-program are for --cell");
    if (o->mode == RENDER_CELL_NATIVE && o->program)
        argp_error(state, "--cell-program is for --cell sim: a native Cell has its program built in");
}

static error_t parse(int key, char *arg, struct argp_state *state)
{
    render_cell_options *const o = state->input;
    char error[PROGRAM_ERROR_SIZE];
    switch (key) {
    case OPTION_CELL: parse_mode(arg, o, state); return 0;
    case OPTION_SPES:
        if (program_parse_u32(arg, 1, 16, &o->spes, error, sizeof error))
            argp_error(state, "--spes: %s", error);
        return 0;
    case OPTION_CELL_ASSIGNMENT: parse_assignment(arg, o, state); return 0;
    case OPTION_CELL_PROGRAM: o->program = arg; return 0;
    case ARGP_KEY_END: finish(o, state); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

const struct argp render_cell_argp = {table, parse, NULL, NULL, NULL, NULL, NULL};
