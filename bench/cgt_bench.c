/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench: measures the library on moving spheres and triangles.
 *   cgt-bench accuracy  time against error, of rays, whole frames and intersection tests
 *   cgt-bench bounces   mirrors and glass: waves of rays by structure and order, beside Embree
 *   cgt-bench cell      where the cycles of a program of an SPU go, by simulation
 *   cgt-bench cliffs    scenes with one trouble, against their twins and Embree
 *   cgt-bench frame     one frame at a time, like a renderer: build, primary, shadow and ambient-occlusion rays
 *   cgt-bench light     lights anywhere, points in any order, beside Embree
 *   cgt-bench make      procedural scenes to measure on
 *   cgt-bench structures  structures by kind of rays, their order and their number in a call */
#include <string.h>

#include "common/bench.h"
#include "common/out_file.h"

#define SUB_COMMANDS "accuracy, bounces, cell, cliffs, frame, light, make or structures"

typedef struct command {
    const char *name;
    char *full_name; /* the program's name as argp shows it */
    int (*run)(int argc, char **argv);
} command;

static char accuracy_name[] = "cgt-bench accuracy", bounces_name[] = "cgt-bench bounces";
static char cell_name[] = "cgt-bench cell";
static char cliffs_name[] = "cgt-bench cliffs";
static char frame_name[] = "cgt-bench frame", light_name[] = "cgt-bench light", make_name[] = "cgt-bench make";
static char structures_name[] = "cgt-bench structures";
static const command commands[] = {{"accuracy", accuracy_name, bench_accuracy},
                                   {"bounces", bounces_name, bench_bounces},
                                   {"cell", cell_name, bench_cell},
                                   {"cliffs", cliffs_name, bench_cliffs},
                                   {"frame", frame_name, bench_frame},
                                   {"light", light_name, bench_light},
                                   {"make", make_name, bench_make},
                                   {"structures", structures_name, bench_structures}};

typedef struct choice {
    const command *command;
    int first; /* where the sub-command stands in argv */
} choice;

static error_t parse(int key, char *argument, struct argp_state *state)
{
    choice *chosen = state->input;
    switch (key) {
    case ARGP_KEY_ARG:
        for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
            if (!strcmp(argument, commands[i].name))
                chosen->command = &commands[i];
        if (!chosen->command)
            argp_error(state, "no sub-command %s: " SUB_COMMANDS, argument);
        chosen->first = state->next - 1;
        state->next = state->argc; /* the rest is the sub-command's */
        return 0;
    case ARGP_KEY_NO_ARGS: argp_error(state, "a sub-command is missing: " SUB_COMMANDS); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

int main(int argc, char **argv)
{
    static const struct argp parser = {
        .parser = parse,
        .args_doc =
            "accuracy [FILE...] [OPTION...]\nbounces FILE... [OPTION...]\ncell [FILE] [OPTION...]\ncliffs [OPTION...]\n"
            "frame FILE [OPTION...]\nlight FILE... [OPTION...]\nmake SCENE FILE [OPTION...]\n"
            "structures FILE... [OPTION...]",
        .doc = "Measures libcgt on moving spheres and triangles, rebuilding the structure every frame; prints "
               "tab-separated values."
               "\v  accuracy  sets time against error: of rays, whole frames and intersection tests\n"
               "  bounces   times the rays of mirrors and glass, by structure and order, beside Embree\n"
               "  cell      simulates a program of an SPU and counts its cycles\n"
               "  cliffs    times scenes with one trouble against the same scenes without it, and Embree\n"
               "  frame     times building and tracing, as a renderer spends it\n"
               "  light     times shadow rays to lights anywhere, for points in any order, beside Embree\n"
               "  make      writes a procedural scene\n"
               "  structures  compares structures by kind of rays, their order and their number in a call\n\n"
               "cgt-bench frame --help and its like list the options of each."};
    choice chosen = {NULL, 0};

    program_init("cgt-bench");
    out_file_catch_signals(NULL);
    if (argp_parse(&parser, argc, argv, ARGP_IN_ORDER, NULL, &chosen))
        return program_exit(PROGRAM_USAGE);
    argv[chosen.first] = chosen.command->full_name;
    return program_exit(chosen.command->run(argc - chosen.first, argv + chosen.first));
}
