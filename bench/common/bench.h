/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Code shared by the sub-commands of cgt-bench: settings, and the parsers of command-line options. Each sub-command
 * has a folder of its own; common/ has
 *
 *   input      the frames of a file, in memory             bench_input.h
 *   scene      a scene of the library over a frame         bench_scene.h
 *   planes     the hits of camera rays                    bench_planes.h
 *   rays       shadow, ambient-occlusion and bounce rays   bench_rays.h
 *   threads    the threads that make those rays           bench_threads.h
 *   timing     clock, medians, quartiles                   bench_timing.h
 *   table      rows as text and JSON                       bench_table.h */
#ifndef BENCH_H
#define BENCH_H

#include <argp.h>
#include <stdint.h>

#include <cgt/cgt.h>

#include "common/bench_scene.h"
#include "common/program.h"

#define BENCH_MOST_PIXELS ((uint64_t)1 << 28)

#define BENCH_MOST_FILES 32
#define BENCH_MOST_VARIANTS 16

/* Of the scenes of cgt-bench make, in cgt-bench's form of a camera. */
#define BENCH_PROCEDURAL_CAMERA "0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46"

/* Options of all sub-commands that measure frames. */
typedef struct bench_settings {
    const char *paths[BENCH_MOST_FILES];
    size_t files;
    size_t least_files, most_files; /* number of FILEs a sub-command takes; set before parsing (default: 1, 1) */
    cgt_camera camera;
    uint32_t width, height;
    uint32_t threads;
    uint64_t frames; /* frames read of a file; 0: all */
    uint32_t repeat;
    const char *variant;    /* NULL: the widest that the CPU runs, or all where variants are compared */
    uint32_t packet;        /* 0: the library's choice, or all where packets are compared */
    uint32_t resolution[3]; /* of a queue grid; 0, 0, 0: the library's choice, or several where they are compared */
    float radius;           /* for files without one; 0: the reader's default */
    int wrapped;
    int verbose;
    const char *json_path; /* NULL: none */
} bench_settings;

void bench_settings_init(bench_settings *settings);
void bench_settings_use_procedural_camera(bench_settings *settings);

/* Parses these options and the FILEs: a child of a sub-command's parser, with the settings as its input. */
extern const struct argp bench_settings_argp;

/* The variants that the CPU runs, narrowest first, or the one that the settings name. Returns how many. */
size_t bench_variants(const bench_settings *settings, const char *variants[BENCH_MOST_VARIANTS]);

/* A whole number from least to most; other text is an error of the command line. */
void bench_parse_u32(struct argp_state *state, const char *option, const char *text, uint32_t least, uint32_t most,
                     uint32_t *value);

/* Copies the next name of a list with commas, cut where it is too long, and advances *list, which is NULL at the end.
 * Returns 0 where no name is left. */
#define BENCH_LISTED_SIZE 32
int bench_next_name(const char **list, char name[BENCH_LISTED_SIZE]);

/* Sets chosen[i] for each name of a list with commas. An unknown name is an error of the command line. */
void bench_choose(struct argp_state *state, const char *option, const char *list, const char *const *names, int count,
                  int *chosen);

/* Whether chosen[which] is set. Where none is set, all count as chosen. */
int bench_is_chosen(const int *chosen, int count, int which);

/* Options of the structure. */
typedef struct bench_structure_settings {
    size_t most; /* structures that may be named; set before parsing */
    cgt_structure requested[7];
    size_t count; /* 0: none was named */
    bench_kd_choice kd;
} bench_structure_settings;

/* Options of the precision. */
typedef struct bench_precision_settings {
    cgt_precision precision;
    int named; /* 1: -p was given */
    cgt_triangle_test test;
} bench_precision_settings;

/* Options of secondary rays. */
typedef struct bench_secondary_settings {
    int lit; /* 1: the light was given */
    float light[3];
    uint32_t ao; /* ambient-occlusion rays from every hit */
} bench_secondary_settings;

/* The trace settings given by these options. structure and precision may be NULL. */
bench_choice bench_choice_of(const bench_settings *settings, const bench_structure_settings *structure,
                             const bench_precision_settings *precision);

/* Children of a sub-command's parser, each with its settings as its input. */
extern const struct argp bench_structure_argp, bench_precision_argp, bench_secondary_argp;

/* The sub-commands: argv[0] is "cgt-bench NAME"; they return an exit code. */
int bench_accuracy(int argc, char **argv);
int bench_bounces(int argc, char **argv);
int bench_cliffs(int argc, char **argv);
int bench_frame(int argc, char **argv);
int bench_light(int argc, char **argv);
int bench_make(int argc, char **argv);
int bench_cell(int argc, char **argv);
int bench_structures(int argc, char **argv);

#endif
