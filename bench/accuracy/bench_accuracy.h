/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench accuracy: time against error. Each part is a section of the table.
 *   cases      rays of hard cases and files, judged by exact arithmetic    accuracy_cases.c
 *   structure  the same rays through a grid and by brute force             accuracy_structure.c
 *   modes      one picture in all modes of execution                       accuracy_modes.c
 *   frames     whole frames of files, relative to EXACT                    accuracy_frames.c
 *   tests      the bare intersection tests of FAST                     accuracy_tests.c */
#ifndef BENCH_ACCURACY_H
#define BENCH_ACCURACY_H

#include <stddef.h>

#include "common/bench.h"
#include "common/bench_scene.h"
#include "common/bench_table.h"
#include "hard_cases/hard_run.h"

#define ACCURACY_NAME_SIZE 256

enum {
    ACCURACY_CASES,
    ACCURACY_STRUCTURE,
    ACCURACY_MODES,
    ACCURACY_FRAMES,
    ACCURACY_PATHS,
    ACCURACY_TESTS_ALONE,
    ACCURACY_PARTS
};

typedef struct accuracy_job {
    bench_settings shared;
    int part[ACCURACY_PARTS]; /* 1: chosen; none: all */
    uint32_t rays;            /* of each subject */
    const char *filter;       /* only subjects whose name contains it; NULL: all */
    const char *variant[BENCH_MOST_VARIANTS];
    size_t variants;
    bench_table *table;
} accuracy_job;

/* Rays over primitives, with the exact hit of each ray. */
typedef struct accuracy_subject {
    char name[ACCURACY_NAME_SIZE];
    hard_scene scene;
    hard_truth truth;
    uint32_t triangles; /* in the scene */
} accuracy_subject;

/* All functions below return PROGRAM_OK, or PROGRAM_FAILED after they printed what failed. */

/* A hard case; a file's first frame with rays of the camera's picture. */
int accuracy_subject_case(accuracy_subject *subject, const hard_case *hard, uint32_t rays);
int accuracy_subject_file(accuracy_subject *subject, const accuracy_job *job, const char *path);
void accuracy_subject_free(accuracy_subject *subject);

/* One configuration. resolution: NULL for the subject's own. */
typedef struct accuracy_choice {
    const char *variant;
    cgt_precision precision;
    cgt_triangle_test test;
    const uint32_t *resolution;
} accuracy_choice;

/* A committed scene of a subject, and the name of its configuration. */
typedef struct accuracy_scene {
    cgt_context *context;
    cgt_scene *scene;
    char config[BENCH_NAME_SIZE];
    cgt_trace_options options;
    cgt_research_trace_options research;
} accuracy_scene;

int accuracy_scene_make(accuracy_scene *scene, const accuracy_subject *subject, const accuracy_choice *choice);
void accuracy_scene_free(accuracy_scene *scene);

/* Traces the subject's rays into hits, an array for as many. statistics may be NULL. */
int accuracy_trace(const accuracy_scene *scene, const accuracy_subject *subject, full_hit *hits,
                   cgt_trace_statistics *statistics);

/* Calls visit for every configuration that applies to the subject, until one does not return PROGRAM_OK. */
int accuracy_each_choice(const accuracy_job *job, const accuracy_subject *subject,
                         int (*visit)(const accuracy_job *job, const accuracy_subject *subject,
                                      const accuracy_choice *choice));

/* The parts. */
int accuracy_cases(const accuracy_job *job, const accuracy_subject *subject);
int accuracy_structure(const accuracy_job *job, const accuracy_subject *subject);
int accuracy_modes(const accuracy_job *job);
int accuracy_frames(const accuracy_job *job, const char *path);
int accuracy_paths(const accuracy_job *job);
int accuracy_tests(const accuracy_job *job);

#endif
