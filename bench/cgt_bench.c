/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench: measures the library on moving spheres and triangles.
 *   cgt-bench accuracy  time against error, of rays, whole frames and intersection tests
 *   cgt-bench bounces   mirrors and glass: waves of rays by structure and order, beside Embree
 *   cgt-bench cell      where the cycles of a program of an SPU go, by simulation
 *   cgt-bench cliffs    scenes with one trouble, against their twins and Embree
 *   cgt-bench floor     what the machine allows, and how close frames come to it
 *   cgt-bench frame     one frame at a time, like a renderer: build, primary, shadow and ambient-occlusion rays
 *   cgt-bench light     lights anywhere, points in any order, beside Embree
 *   cgt-bench loops     the ways to traverse a grid, compared with each other
 *   cgt-bench make      procedural scenes to measure on
 *   cgt-bench scaling   time and memory against primitives, pixels and threads
 *   cgt-bench simd      the vector words compared with native instructions
 *   cgt-bench structures  structures by kind of rays, their order and their number in a call */
#include <string.h>

#include "common/bench.h"
#include "common/out_file.h"

#define SUB_COMMANDS "accuracy, bounces, cell, cliffs, floor, frame, light, loops, make, scaling, simd or structures"

typedef struct command {
    const char *name;
    char *full_name; /* the program's name as argp shows it */
    int (*run)(int argc, char **argv);
} command;

static char accuracy_name[] = "cgt-bench accuracy", bounces_name[] = "cgt-bench bounces";
static char cell_name[] = "cgt-bench cell";
static char cliffs_name[] = "cgt-bench cliffs";
static char floor_name[] = "cgt-bench floor", scaling_name[] = "cgt-bench scaling";
static char frame_name[] = "cgt-bench frame", light_name[] = "cgt-bench light", loops_name[] = "cgt-bench loops",
            make_name[] = "cgt-bench make";
static char simd_name[] = "cgt-bench simd", structures_name[] = "cgt-bench structures";
static const command commands[] = {{"accuracy", accuracy_name, bench_accuracy},
                                   {"bounces", bounces_name, bench_bounces},
                                   {"cell", cell_name, bench_cell},
                                   {"cliffs", cliffs_name, bench_cliffs},
                                   {"floor", floor_name, bench_floor},
                                   {"frame", frame_name, bench_frame},
                                   {"light", light_name, bench_light},
                                   {"loops", loops_name, bench_loops},
                                   {"make", make_name, bench_make},
                                   {"scaling", scaling_name, bench_scaling},
                                   {"simd", simd_name, bench_simd},
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
            "floor [FILE...] [OPTION...]\nframe FILE "
            "[OPTION...]\nlight FILE... [OPTION...]\nloops FILE "
            "[OPTION...]\n"
            "make SCENE FILE [OPTION...]\n"
            "scaling [OPTION...]\nsimd [OPTION...]\n"
            "structures FILE... [OPTION...]",
        .doc = "Measures libcgt on moving spheres and triangles, rebuilding the structure every frame; prints "
               "tab-separated values."
               "\v  accuracy  sets time against error: of rays, whole frames and intersection tests\n"
               "  bounces   times the rays of mirrors and glass, by structure and order, beside Embree\n"
               "  cell      simulates a program of an SPU and counts its cycles\n"
               "  cliffs    times scenes with one trouble against the same scenes without it, and Embree\n"
               "  floor     measures what the machine allows, and how close frames come to it\n"
               "  frame     times building and tracing, as a renderer spends it\n"
               "  light     times shadow rays to lights anywhere, for points in any order, beside Embree\n"
               "  loops     compares the ways to traverse the structure\n"
               "  make      writes a procedural scene\n"
               "  scaling   sets time and memory against primitives, pixels and threads\n"
               "  simd      times the vector words against native instructions\n"
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
