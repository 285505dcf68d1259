/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench structures: the best structure for each kind of rays. One frame of a file in all structures; sets of rays
 * of a kind, in an order, for a query, traced in calls of a given size.
 *   plan      the structures, and the ways to trace them       structures_plan.c
 *   sets      rays of a kind, in an order                      structures_sets.c
 *   measure   structures built and traced in turns             structures_measure.c
 *   found     the hits of rays, and their comparison           structures_found.h
 *   fetch     transfers of nodes into a small memory           structures_fetch.c */
#ifndef BENCH_STRUCTURES_H
#define BENCH_STRUCTURES_H

#include <stddef.h>
#include <stdint.h>

#include "common/bench.h"
#include "common/bench_input.h"
#include "rays/bench_ray_arrays.h"
#include "rays/bench_rays.h"
#include "common/bench_scene.h"
#include "common/bench_table.h"
#include "structures/structures_found.h"

typedef enum structures_kind {
    STRUCTURES_FRAME, /* the camera's frame, in one call of cgt_trace_camera; all other kinds are arrays of rays */
    STRUCTURES_CAMERA,
    STRUCTURES_SHADOW,
    STRUCTURES_AO,
    STRUCTURES_BOUNCE,
    STRUCTURES_RANDOM, /* has no order but shuffled */
    STRUCTURES_KINDS
} structures_kind;

typedef enum structures_order {
    STRUCTURES_BLOCKS,   /* tiles of 64x64 pixels, within them blocks of 4x4 along a Morton curve */
    STRUCTURES_TILES,    /* tiles of 64x64 pixels, row by row, each shuffled */
    STRUCTURES_SHUFFLED, /* as a whole */
    STRUCTURES_ORDERS
} structures_order;

typedef enum structures_query { STRUCTURES_NEAREST, STRUCTURES_ANY, STRUCTURES_QUERIES } structures_query;

enum { STRUCTURES_MOST_BATCHES = 32, STRUCTURES_MOST_GROUPS = 32, STRUCTURES_MOST_ROWS = 64 };

typedef struct structures_settings {
    bench_settings shared;
    bench_structure_settings structure;
    bench_secondary_settings secondary;
    int kind[STRUCTURES_KINDS], order[STRUCTURES_ORDERS], query[STRUCTURES_QUERIES]; /* 1: named; none: the default */
    uint64_t batch[STRUCTURES_MOST_BATCHES]; /* rays in a call, ascending; UINT64_MAX: all of the set */
    size_t batches;
    uint32_t rays;   /* of a set, upper limit */
    uint32_t random; /* random rays */
    int traversals, layouts, fetch;
} structures_settings;

/* A structure over a scene of its own, so that it is built before the first ray and stays. Its rows are neighbours. */
typedef struct structures_group {
    bench_scene scene;
    bench_build build;
    double *build_ms; /* of each round */
} structures_group;

/* A way to trace a group. */
typedef struct structures_row {
    structures_group *group;
    bench_choice choice;
    char config[BENCH_NAME_SIZE];
    double *trace_ms[STRUCTURES_MOST_BATCHES]; /* of each round, all calls of the current set */
    bench_counts count;                        /* of the current set */
    uint64_t different;                        /* rays of the current set whose hit differs from the first row's */
} structures_row;

/* The current set of rays. */
typedef struct structures_set {
    structures_kind kind;
    structures_order order;
    structures_query query;
    uint64_t count;          /* rays */
    bench_ray_array made;    /* in the order of blocks */
    uint64_t first;          /* the set is `count` rays of `made` from here on: those of the picture's middle */
    uint32_t *tile;          /* of each ray of the set */
    uint32_t *turn;          /* the ray at each position of the order */
    bench_ray_array ordered; /* the rays in that order */
} structures_set;

typedef struct structures_job {
    const structures_settings *settings;
    const char *path;
    char scene_name[BENCH_NAME_SIZE];
    bench_input input;
    uint32_t count; /* spheres or vertices of the frame */
    cgt_context *context;
    bench_threads *threads;
    bench_camera_axes axes;
    bench_planes planes; /* of the hits that secondary rays start from */
    bench_rays *maker;   /* of those rays */
    structures_group groups[STRUCTURES_MOST_GROUPS];
    size_t group_count;
    structures_row rows[STRUCTURES_MOST_ROWS];
    size_t row_count;
    structures_set set;
    uint64_t batch[STRUCTURES_MOST_BATCHES]; /* rays in a call, for the current set */
    size_t batches;
    structures_found expected, found; /* by the first row; by the current one */
    int messages;                     /* about differing hits, so far */
    int expecting;                    /* 1: `expected` is of the current set */
    uint64_t hits;                    /* of the current set */
    uint64_t compared, different;     /* rays, of all sets */
} structures_job;

/* The list of groups and rows that the settings request, with their scenes and room for their times. */
cgt_result structures_plan(structures_job *job);
void structures_plan_release(structures_job *job);

/* The row's structure was built: names the configuration. */
void structures_name_row(structures_row *row);

/* Builds all groups in turns, round by round. Groups that the library does not have are marked left_out. */
cgt_result structures_build(structures_job *job);

/* The first group that is not left out; NULL where all are. */
const structures_group *structures_first(const structures_job *job);

/* Makes the rays of a kind; then puts them into an order. The planes hold the frame's hits. */
cgt_result structures_make_set(structures_job *job, structures_kind kind);
cgt_result structures_order_set(structures_job *job, structures_order order);
void structures_release_set(structures_set *set);

/* Traces the current set in calls of each of the job's batches, all rows in turns, and compares their hits. */
cgt_result structures_trace_set(structures_job *job, structures_query query);

/* The rows of the table that counts transfers. Returns an exit code. */
int structures_fetch(structures_job *job, bench_table *table);

#endif
