/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench: what its sub-commands share.
 *
 *   input     the trajectory in memory               bench_input.h
 *   scene     the library's scene over it            bench_scene.h
 *   planes    what primary rays found                bench_planes.h
 *   rays      shadow and ambient-occlusion rays      bench_frame_rays.h
 *   threads   who makes those rays                   bench_threads.h
 *   timing    clock and medians                      bench_timing.h
 *   plan      the configurations that loops compares bench_plan.h
 *   report    their table and their ratios           bench_report.h
 *   procedural  scenes made in memory              bench_procedural.h
 *   memory    what the library allocates           bench_memory.h
 *   accuracy  time and error of every configuration  bench_accuracy.h
 *   pareto    time against error, and its pictures   bench_pareto.h
 *   simd      words of the vocabulary, per variant   simd/simd_rows.h
 *   structures  grids and kd-trees beside each other  bench_structures.h
 *   scaling   time and memory against size         bench_scaling.h
 *   sweep     structures by kind of rays, their order and their number in a call  bench_rays.h
 *   floor     the machine's limits, and how far off scenes are  bench_floor.h */
#ifndef BENCH_H
#define BENCH_H

#include <argp.h>
#include <stdint.h>

#include <cgt/cgt.h>

#include "common/bench_scene.h"
#include "common/program.h"

#define BENCH_MOST_PIXELS ((uint64_t)1 << 28)

/* The options that frame and loops share. */
typedef struct bench_settings {
    const char *path;
    cgt_camera camera;
    uint32_t width, height;
    uint32_t threads;
    uint64_t frames; /* 0: all of the file */
    uint32_t repeat;
    const char *variant;    /* NULL: the widest that the CPU runs, or in loops: all */
    uint32_t packet;        /* 0: the library's choice, or in loops: all */
    uint32_t resolution[3]; /* 0, 0, 0: the library's choice, or in loops: several */
    float radius;           /* for files without one; 0: the reader's default */
    int wrapped;
    int verbose;
    int file_optional; /* 1: the sub-command does without a FILE, too; set before parsing */
} bench_settings;

void bench_settings_init(bench_settings *settings);

/* Parses the shared options and the one FILE; a child of each sub-command's parser, with settings as its input. */
extern const struct argp bench_settings_argp;

/* The next name of a list with commas between, copied and cut where it is too long; *list moves behind it, and is NULL
 * at the end. 0 where there is none left. */
#define BENCH_LISTED_SIZE 32
int bench_next_name(const char **list, char name[BENCH_LISTED_SIZE]);

/* Sets chosen[i] for each of a list of names; an error of the command line where there is no such name. */
void bench_choose(struct argp_state *state, const char *option, const char *list, const char *const *names, int count,
                  int *chosen);

/* Whether it was chosen; where nothing was, everything is. */
int bench_is_chosen(const int *chosen, int count, int which);

/* Options of the structure, that frame, rays, scaling and structures share. */
typedef struct bench_structure_settings {
    size_t most; /* structures that may be named; set before parsing */
    cgt_structure asked[6];
    size_t count; /* 0: none was named */
    bench_kd_choice kd;
} bench_structure_settings;

/* A child of the parser, with those settings as its input. */
extern const struct argp bench_structure_argp;

/* The sub-commands: argv[0] is "cgt-bench NAME"; they return an exit code. */
int bench_accuracy(int argc, char **argv);
int bench_floor(int argc, char **argv);
int bench_frame(int argc, char **argv);
int bench_loops(int argc, char **argv);
int bench_make(int argc, char **argv);
int bench_pareto(int argc, char **argv);
int bench_ray_sweep(int argc, char **argv); /* rays */
int bench_scaling(int argc, char **argv);
int bench_simd(int argc, char **argv);
int bench_structures(int argc, char **argv);

#endif
