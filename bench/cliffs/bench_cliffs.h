/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench cliffs: the time of scenes with one trouble, compared with the same scenes without it and with Embree.
 *   what is measured in which order  bench_cliffs.c
 *   one scene, by one way            cliffs_measure.c
 *   rows, and the worst of them      cliffs_table.c */
#ifndef BENCH_CLIFFS_H
#define BENCH_CLIFFS_H

#include <stdbool.h>

#include "support/cliffs/cliffs.h"
#include "ways/bench_tracer.h"

/* Calls grow: step k has CLIFFS_RAYS * 4^k rays, or a picture of as many pixels, until one takes too long. */
enum { CLIFFS_WIDTH = 16, CLIFFS_HEIGHT = 12, CLIFFS_RAYS = CLIFFS_WIDTH * CLIFFS_HEIGHT, CLIFFS_STEPS = 7 };

/* The times of one call, step by step. Commits have one step. */
typedef struct cliffs_times {
    uint32_t steps; /* that were measured; 0: the call was not */
    double ms[CLIFFS_STEPS];
    uint64_t rays[CLIFFS_STEPS]; /* or points */
    uint64_t hits[CLIFFS_STEPS];
} cliffs_times;

/* All that is measured of a scene by one way. */
typedef struct cliffs_result {
    cliffs_times call[CLIFF_CALLS];
} cliffs_result;

/* A scene with its rays, and room for results. */
typedef struct cliffs_input {
    const bench_settings *settings;
    const cliff *cliff;
    bool disturbed;
    cliff_scene scene;
    float *arrays;                  /* memory of the last step's rays */
    cgt_rays rays, embree;          /* embree: without those that are beyond its range */
    bool is_for_embree;             /* most rays are within it */
    cgt_rays light_of_embree;       /* t_min of rays from points: it cannot skip a primitive */
    bench_set points[CLIFFS_STEPS]; /* to be lit, of each step; no rays: there are none */
    cgt_light light;
    bench_found found;
    bench_session session;
} cliffs_input;

/* Makes a scene of so many primitives, its rays, and its ways. Free it after a failure, too. */
int cliffs_input_make(cliffs_input *input, const bench_settings *settings, const cliff *c, bool disturbed,
                      uint32_t count);
void cliffs_input_free(cliffs_input *input);

/* Measures the calls that concern the cliff. PROGRAM_OK, or PROGRAM_FAILED after a message. */
int cliffs_measure(cliffs_input *input, bench_tracer *tracer, cliffs_result *result);

/* ---- table ---- */

typedef struct cliffs_row {
    const char *scene, *config;
    uint32_t primitives;
    cliff_call call;
    uint64_t rays, hits;
    double ms;
    double twin_ratio;   /* NaN: no twin */
    double embree_ms;    /* for as many rays; NaN: no Embree, or it misses most hits */
    double embree_ratio; /* the library's time over Embree's */
} cliffs_row;

/* Rows of all calls of a scene, which are printed and kept. */
typedef struct cliffs_rows {
    cliffs_row *row;
    size_t count, room;
} cliffs_rows;
int cliffs_add_rows(cliffs_rows *rows, bench_table *table, const cliffs_row *name, const cliffs_result *of,
                    const cliffs_result *twin, const cliffs_result *embree);

/* The worst rows against the twin, and against Embree, each a section. Sorts the rows. */
void cliffs_print_worst(cliffs_rows *rows, bench_table *table, uint32_t worst);

#endif
