/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench cliffs: the time of scenes with one trouble, compared with the same scenes without it and with Embree.
 *   command line, loops              bench_cliffs.c
 *   one scene, any program           cliffs_measure.c
 *   the library                      cliffs_library.c
 *   Embree, where it is installed    cliffs_embree.c
 *   rows, and the worst of them      cliffs_table.c */
#ifndef BENCH_CLIFFS_H
#define BENCH_CLIFFS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "common/bench.h"
#include "common/bench_table.h"
#include "support/cliffs/cliffs.h"

/* Calls grow: step k has CLIFFS_RAYS * 4^k rays, or a picture of as many pixels, until one takes too long. */
enum { CLIFFS_WIDTH = 16, CLIFFS_HEIGHT = 12, CLIFFS_RAYS = CLIFFS_WIDTH * CLIFFS_HEIGHT, CLIFFS_STEPS = 7 };

#define CLIFFS_COUNTS 8

typedef struct cliffs_settings {
    bench_settings shared;
    uint32_t count[CLIFFS_COUNTS], counts;              /* primitives; how many of them */
    uint32_t steps;                                     /* of calls, at most CLIFFS_STEPS */
    double limit_ms;                                    /* no call is measured longer, but for its first step */
    int structure[CLIFF_STRUCTURES], call[CLIFF_CALLS]; /* 1: requested; none of them: all */
    const char *text;                                   /* scenes whose names contain it; NULL: all */
    uint32_t worst;                                     /* rows of the summaries */
    int quick, no_embree;
} cliffs_settings;

/* The times of one call, step by step. Commits have one step. */
typedef struct cliffs_times {
    uint32_t steps; /* that were measured; 0: the call was not */
    double ms[CLIFFS_STEPS];
    uint64_t rays[CLIFFS_STEPS]; /* or points */
    uint64_t hits[CLIFFS_STEPS];
} cliffs_times;

/* All that is measured of a scene by one program. */
typedef struct cliffs_result {
    cliffs_times call[CLIFF_CALLS];
} cliffs_result;

/* What every program gets: the scene with its rays, and room for answers. */
typedef struct cliffs_input {
    const cliff *cliff;
    bool disturbed;
    cliff_scene scene;
    truth_ray *rays;                   /* of the last step */
    cliff_points points[CLIFFS_STEPS]; /* to be lit, of each step */
    uint32_t steps;
} cliffs_input;

/* count: primitives. 0, or -1 where memory is refused. */
int cliffs_input_make(cliffs_input *input, const cliff *c, bool disturbed, uint32_t count, uint32_t steps);
void cliffs_input_free(cliffs_input *input);

/* A program that is measured. The first two return 0, or -1 after a message; prepare, which comes before every run,
 * returns 1 where the program does not support the call's rays. */
typedef struct cliffs_program {
    int (*prepare)(void *self, cliff_call call, uint32_t step);         /* not timed */
    int (*run)(void *self, cliff_call call, uint32_t step);             /* timed */
    uint64_t (*hits)(const void *self, cliff_call call, uint32_t step); /* of the last run */
    void *self;
} cliffs_program;

/* Measures the calls that concern the cliff. 0, or -1 after a message. */
int cliffs_measure(const cliffs_settings *settings, const cliffs_input *input, const cliffs_program *program,
                   cliffs_result *result);

/* By the library, through a structure. Makes input->points, too, where they are missing. */
int cliffs_measure_library(const cliffs_settings *settings, cgt_context *context, cliffs_input *input,
                           cliff_structure structure, cliffs_result *result);

/* By Embree 3 on the calling thread, in packets of 16 neighbours where rays are a camera's or go to a light, else ray by
 * ray; its build is the fast one for moving scenes. Spheres are Embree's own. All steps are 0 where Embree is not
 * installed. */
bool cliffs_embree_is_here(void);
int cliffs_measure_embree(const cliffs_settings *settings, const cliffs_input *input, cliffs_result *result);

/* ---- Table ---- */

typedef struct cliffs_row {
    const char *scene;
    uint32_t primitives;
    cliff_structure structure;
    cliff_call call;
    uint64_t rays, hits;
    double ms;
    double twin_ratio;   /* NaN: no twin */
    double embree_ms;    /* for as many rays; NaN: no Embree, or it misses most hits */
    double embree_ratio; /* the library's time over Embree's */
} cliffs_row;

/* Rows of all calls of a scene, which are printed and kept. 0, or -1 after a message. */
typedef struct cliffs_rows {
    cliffs_row *row;
    size_t count, room;
} cliffs_rows;
int cliffs_add_rows(cliffs_rows *rows, bench_table *table, const cliffs_row *name, const cliffs_result *of,
                    const cliffs_result *twin, const cliffs_result *embree);

/* The worst rows against the twin, and against Embree, each a section. Sorts the rows. */
void cliffs_print_worst(cliffs_rows *rows, bench_table *table, uint32_t worst);

#endif
