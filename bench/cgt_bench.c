/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench SUBJECT: measures the library on moving spheres and triangles, beside Embree where it is installed. */
#include <stdio.h>
#include <string.h>

#include "common/bench.h"
#include "common/options.h"
#include "common/out_file.h"

typedef struct subject {
    const char *name, *full_name; /* the program's name in its messages */
    bench_subject subject;
    int (*run)(const bench_settings *settings);
} subject;

static const subject subjects[] = {{"accuracy", "cgt-bench accuracy", BENCH_ACCURACY, bench_accuracy},
                                   {"bounces", "cgt-bench bounces", BENCH_BOUNCES, bench_bounces},
                                   {"cell", "cgt-bench cell", BENCH_CELL, bench_cell},
                                   {"cliffs", "cgt-bench cliffs", BENCH_CLIFFS, bench_cliffs},
                                   {"frame", "cgt-bench frame", BENCH_FRAME, bench_frame},
                                   {"light", "cgt-bench light", BENCH_LIGHT, bench_light},
                                   {"make", "cgt-bench make", BENCH_MAKE, bench_make},
                                   {"rays", "cgt-bench rays", BENCH_RAYS, bench_rays_of_kinds}};

#define SUBJECTS "accuracy, bounces, cell, cliffs, frame, light, make or rays"

typedef struct choice {
    const subject *subject;
    const char **arguments; /* from the subject on */
    size_t count;
} choice;

static int choose(void *options, const char **operands, size_t count, char *error, size_t size)
{
    choice *const chosen = options;
    *chosen = (choice){.arguments = operands, .count = count};
    for (size_t i = 0; i < sizeof subjects / sizeof subjects[0] && count > 0; i++)
        if (!strcmp(operands[0], subjects[i].name))
            chosen->subject = &subjects[i];
    if (count == 0)
        snprintf(error, size, "a subject is missing: " SUBJECTS);
    else if (!chosen->subject)
        snprintf(error, size, "no subject %s: " SUBJECTS, operands[0]);
    return chosen->subject ? 0 : -1;
}

int main(int argc, char **argv)
{
    static const option_table table = {
        .arguments = "accuracy [FILE...] [OPTION...]\nbounces FILE... [OPTION...]\ncell [FILE] [OPTION...]\n"
                     "cliffs [OPTION...]\nframe FILE [OPTION...]\nlight FILE... [OPTION...]\n"
                     "make SCENE FILE [OPTION...]\nrays FILE... [OPTION...]",
        .text = "Measures libcgt on moving spheres and triangles, rebuilding the structure every frame, beside Embree "
                "where it is installed; prints tab-separated values."
                "\v  accuracy  sets time against error, of rays and whole frames\n"
                "  bounces   times the rays of mirrors and glass, by structure and order\n"
                "  cell      simulates a program of an SPU and counts its cycles\n"
                "  cliffs    times scenes with one trouble against the same scenes without it\n"
                "  frame     times building and tracing, as a renderer spends it\n"
                "  light     times shadow rays to lights anywhere, for points in any order\n"
                "  make      writes a procedural scene\n"
                "  rays      times rays by structure, kind, order and number in a call\n\n"
                "cgt-bench frame --help and its like list the options of each.",
        .is_command = 1,
        .finish = choose};
    choice chosen;
    bench_settings settings;

    program_init("cgt-bench");
    out_file_catch_signals(NULL);
    options_parse(&table, &chosen, argc, argv, NULL);
    bench_parse(&settings, chosen.subject->subject, chosen.subject->full_name, (int)chosen.count,
                (char **)(void *)chosen.arguments);
    return program_exit(chosen.subject->run(&settings));
}
