/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench rays: which structure for which rays. One frame of a file in all structures; sets of rays of a kind, in
 * orders from a camera's to a shuffled one, traced in calls of so many rays each.
 *   command line, one set after another     bench_rays.c
 *   the sets and their orders               bench_rays_sets.c
 *   structures built and traced in turns    bench_rays_measure.c */
#ifndef BENCH_SWEEP_H
#define BENCH_SWEEP_H

#include <stddef.h>
#include <stdint.h>

#include "common/bench.h"
#include "accuracy/bench_accuracy_report.h"
#include "common/bench_input.h"
#include "frame/bench_frame_rays.h"
#include "structures/bench_structures_rays.h"
#include "structures/bench_structures_results.h"

typedef enum sweep_kind {
    SWEEP_CAMERA,
    SWEEP_SHADOW,
    SWEEP_AO,
    SWEEP_BOUNCE,
    SWEEP_RANDOM, /* in no order but shuffled */
    SWEEP_KINDS
} sweep_kind;

typedef enum sweep_order {
    SWEEP_BLOCKS,   /* tiles of 64x64 pixels, in them blocks of 4x4 along a Morton curve */
    SWEEP_TILES,    /* tiles of 64x64 pixels, row by row, shuffled within each */
    SWEEP_SHUFFLED, /* as a whole */
    SWEEP_ORDERS
} sweep_order;

typedef enum sweep_query { SWEEP_NEAREST, SWEEP_ANY, SWEEP_QUERIES } sweep_query;

enum { SWEEP_MOST_BATCHES = 32, SWEEP_MOST_SUBJECTS = 6 };

typedef struct sweep_settings {
    bench_settings shared;
    bench_structure_settings structure;
    int kind[SWEEP_KINDS], order[SWEEP_ORDERS], query[SWEEP_QUERIES]; /* 1: asked for; none of them: the default */
    uint64_t batch[SWEEP_MOST_BATCHES];                               /* rays in a call; UINT64_MAX: all of the set */
    size_t batches;
    uint64_t rays; /* of a set, at most */
    uint32_t ao;   /* ambient-occlusion rays from every hit */
    float light[3];
    const char *json_path;
} sweep_settings;

/* A structure over a scene of its own, so that it is built before the first ray and stays. */
typedef struct sweep_subject {
    bench_scene scene;
    bench_build build;
    char config[BENCH_NAME_SIZE];
    double *build_ms;                     /* of each round */
    double *trace_ms[SWEEP_MOST_BATCHES]; /* of each round, all calls of the set in work */
    uint64_t different;                   /* rays of the set in work that found something else than the first one's */
} sweep_subject;

/* Rays of a kind. */
typedef struct sweep_rays {
    structures_rays made; /* in the order of blocks */
    uint64_t first;       /* those that are traced: of the picture's middle where they are limited */
    uint64_t count;
    uint32_t *tile;          /* of each of these */
    uint32_t *turn;          /* of each place in the order, which of these stands there */
    structures_rays ordered; /* what is traced */
} sweep_rays;

/* What rays found: hits or occluded, by query. */
typedef struct sweep_found {
    structures_hits hits;
    structures_occluded occluded;
} sweep_found;

typedef struct sweep_job {
    const sweep_settings *settings;
    char scene_name[BENCH_NAME_SIZE];
    bench_input input;
    uint32_t count; /* spheres or vertices of the frame */
    cgt_context *context;
    bench_threads *threads;
    bench_camera_axes axes;
    bench_planes planes;
    bench_rays *maker;
    sweep_subject subjects[SWEEP_MOST_SUBJECTS];
    size_t subject_count;
    sweep_rays rays;
    size_t batches; /* the settings' that are smaller than the set, and all of it where asked for */
    uint64_t batch[SWEEP_MOST_BATCHES];
    sweep_found expected, found;
    int expecting;                /* 1: `expected` is of the set in work */
    uint64_t hits;                /* of that set */
    uint64_t compared, different; /* rays, of all sets */
} sweep_job;

/* Makes the rays of a kind; then puts them into an order. Planes and subjects are ready. */
cgt_result sweep_rays_make(sweep_job *job, sweep_kind kind);
cgt_result sweep_rays_order(sweep_job *job, sweep_order order);
void sweep_rays_release(sweep_rays *rays);

/* Builds all subjects in turns, round by round; those are left out that the library does not have. */
cgt_result sweep_build(sweep_job *job);

/* The first one that is not left out; NULL where all are. */
const sweep_subject *sweep_first(const sweep_job *job);

/* Traces the ordered rays in calls of each of the job's batches, subjects in turns, and compares what they find. */
cgt_result sweep_trace(sweep_job *job, sweep_query query);

void sweep_found_release(sweep_found *found);

#endif
