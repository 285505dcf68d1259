/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench accuracy: speed against error, judged by exact arithmetic.
 *   subjects   hard cases and files, with the truth of every ray   bench_accuracy_subject.c
 *   measure    one subject in one configuration                    bench_accuracy_measure.c
 *   structure  grid against brute force with the same kernel       bench_accuracy_structure.c
 *   modes      the ways to trace the same picture                  bench_accuracy_modes.c
 *   report     the tables, as tab-separated values and JSON        bench_accuracy_report.h */
#ifndef BENCH_ACCURACY_H
#define BENCH_ACCURACY_H

#include <stddef.h>

#include "common/bench.h"
#include "accuracy/bench_accuracy_report.h"
#include "common/bench_scene.h"
#include "hard_cases/hard_run.h"

#define ACCURACY_MOST_FILES 32
#define ACCURACY_MOST_VARIANTS 16
#define ACCURACY_NAME_SIZE 256

typedef struct accuracy_job {
    uint32_t rays;   /* of each subject */
    uint32_t repeat; /* times that each configuration is timed */
    uint64_t frame;  /* of each file, from 0 */
    cgt_camera camera;
    uint32_t width, height; /* of the picture that a file's rays are taken from */
    const char *filter;     /* only subjects whose name contains it; NULL: all */
    const char *json_path;  /* NULL: none */
    const char *path[ACCURACY_MOST_FILES];
    size_t paths;
    const char *variant[ACCURACY_MOST_VARIANTS]; /* that the CPU runs, narrowest first */
    size_t variants;
    accuracy_report *report;
} accuracy_job;

typedef struct accuracy_subject {
    char name[ACCURACY_NAME_SIZE];
    hard_scene scene;
    hard_truth truth;
    uint32_t triangles; /* in the scene */
} accuracy_subject;

/* All return PROGRAM_OK, or PROGRAM_FAILED when what failed has been printed. */
int accuracy_subject_case(accuracy_subject *subject, const hard_case *hard, uint32_t rays);
int accuracy_subject_file(accuracy_subject *subject, const accuracy_job *job, const char *path);
void accuracy_subject_free(accuracy_subject *subject);

/* A configuration: variant, precision, triangle test; resolution NULL for the subject's own. */
typedef struct accuracy_choice {
    const char *variant;
    cgt_precision precision;
    cgt_triangle_test test;
    const uint32_t *resolution;
} accuracy_choice;

/* A committed scene of a subject, and how its configuration is called. */
typedef struct accuracy_scene {
    cgt_context *context;
    cgt_scene *scene;
    char config[BENCH_NAME_SIZE];
    cgt_trace_options options;
    cgt_research_trace_options research;
} accuracy_scene;

int accuracy_scene_make(accuracy_scene *scene, const accuracy_subject *subject, const accuracy_choice *choice);
void accuracy_scene_free(accuracy_scene *scene);

/* Traces the subject's rays into hits, an array for as many; statistics may be NULL. */
int accuracy_trace(const accuracy_scene *scene, const accuracy_subject *subject, full_hit *hits,
                   cgt_trace_statistics *statistics);

/* Calls visit for every configuration that makes sense for the subject; stops where it does not return PROGRAM_OK. */
int accuracy_each_choice(const accuracy_job *job, const accuracy_subject *subject,
                         int (*visit)(const accuracy_job *job, const accuracy_subject *subject,
                                      const accuracy_choice *choice));

/* The tables: begin prints the head, row the rows of one subject. */
void accuracy_table_begin(const accuracy_job *job);
int accuracy_table_rows(const accuracy_job *job, const accuracy_subject *subject);
void accuracy_structure_begin(const accuracy_job *job);
int accuracy_structure_rows(const accuracy_job *job, const accuracy_subject *subject);
int accuracy_modes(const accuracy_job *job);

#endif
