/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench SUBJECT: measures the library on moving spheres and triangles, beside Embree where it is installed. */
#include <argp.h>
#include <string.h>

#include "common/bench.h"
#include "common/out_file.h"

typedef struct subject {
    const char *name;
    char *full_name; /* the program's name as argp shows it */
    bench_subject subject;
    int (*run)(const bench_settings *settings);
} subject;

static char accuracy_name[] = "cgt-bench accuracy", bounces_name[] = "cgt-bench bounces",
            cell_name[] = "cgt-bench cell", cliffs_name[] = "cgt-bench cliffs", frame_name[] = "cgt-bench frame",
            light_name[] = "cgt-bench light", make_name[] = "cgt-bench make", rays_name[] = "cgt-bench rays";
static const subject subjects[] = {{"accuracy", accuracy_name, BENCH_ACCURACY, bench_accuracy},
                                   {"bounces", bounces_name, BENCH_BOUNCES, bench_bounces},
                                   {"cell", cell_name, BENCH_CELL, bench_cell},
                                   {"cliffs", cliffs_name, BENCH_CLIFFS, bench_cliffs},
                                   {"frame", frame_name, BENCH_FRAME, bench_frame},
                                   {"light", light_name, BENCH_LIGHT, bench_light},
                                   {"make", make_name, BENCH_MAKE, bench_make},
                                   {"rays", rays_name, BENCH_RAYS, bench_rays_of_kinds}};

#define SUBJECTS "accuracy, bounces, cell, cliffs, frame, light, make or rays"

typedef struct choice {
    const subject *subject;
    int first; /* where the subject stands in argv */
} choice;

static error_t parse(int key, char *argument, struct argp_state *state)
{
    choice *chosen = state->input;
    switch (key) {
    case ARGP_KEY_ARG:
        for (size_t i = 0; i < sizeof subjects / sizeof subjects[0]; i++)
            if (!strcmp(argument, subjects[i].name))
                chosen->subject = &subjects[i];
        if (!chosen->subject)
            argp_error(state, "no subject %s: " SUBJECTS, argument);
        chosen->first = state->next - 1;
        state->next = state->argc; /* the rest is the subject's */
        return 0;
    case ARGP_KEY_NO_ARGS: argp_error(state, "a subject is missing: " SUBJECTS); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

int main(int argc, char **argv)
{
    static const struct argp parser = {
        .parser = parse,
        .args_doc = "accuracy [FILE...] [OPTION...]\nbounces FILE... [OPTION...]\ncell [FILE] [OPTION...]\n"
                    "cliffs [OPTION...]\nframe FILE [OPTION...]\nlight FILE... [OPTION...]\n"
                    "make SCENE FILE [OPTION...]\nrays FILE... [OPTION...]",
        .doc = "Measures libcgt on moving spheres and triangles, rebuilding the structure every frame, beside Embree "
               "where "
               "it is installed; prints tab-separated values."
               "\v  accuracy  sets time against error, of rays and whole frames\n"
               "  bounces   times the rays of mirrors and glass, by structure and order\n"
               "  cell      simulates a program of an SPU and counts its cycles\n"
               "  cliffs    times scenes with one trouble against the same scenes without it\n"
               "  frame     times building and tracing, as a renderer spends it\n"
               "  light     times shadow rays to lights anywhere, for points in any order\n"
               "  make      writes a procedural scene\n"
               "  rays      times rays by structure, kind, order and number in a call\n\n"
               "cgt-bench frame --help and its like list the options of each."};
    choice chosen = {NULL, 0};
    bench_settings settings;

    program_init("cgt-bench");
    out_file_catch_signals(NULL);
    if (argp_parse(&parser, argc, argv, ARGP_IN_ORDER, NULL, &chosen))
        return program_exit(PROGRAM_USAGE);
    argv[chosen.first] = chosen.subject->full_name;
    if (bench_parse(&settings, chosen.subject->subject, argc - chosen.first, argv + chosen.first))
        return program_exit(PROGRAM_USAGE);
    return program_exit(chosen.subject->run(&settings));
}
