/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench accuracy: time against error. Each part is a section of the table.
 *   cases      rays of hard cases and files, judged by exact arithmetic    accuracy_cases.c
 *   frames     whole frames of files, relative to EXACT                    accuracy_frames.c
 *   paths      paths between mirrors                                       bench_accuracy.c */
#ifndef BENCH_ACCURACY_H
#define BENCH_ACCURACY_H

#include "ways/bench_tracer.h"

typedef struct accuracy_job {
    const bench_settings *settings;
    const char *variant[BENCH_MOST_VARIANTS];
    size_t variants;
    bench_table *table;
} accuracy_job;

/* Precisions, and of FAST the tests of triangles. Of frames those from ACCURACY_SPHERE_WAYS on are of triangles alone,
 * of cases those behind: a test makes spheres decide in single precision, too. */
typedef struct accuracy_way {
    cgt_precision precision;
    cgt_triangle_test test;
} accuracy_way;

enum { ACCURACY_EXACT, ACCURACY_FAST, ACCURACY_SPHERE_WAYS, ACCURACY_WAYS = 5 };
extern const accuracy_way accuracy_ways[ACCURACY_WAYS];

/* The way of a variant; the name of its configuration through a structure. */
bench_way accuracy_way_of(const bench_settings *settings, const char *variant, size_t which);

/* Rows of all cases and files whose names contain the settings' text, or of a file's frames: PROGRAM_OK, or
 * PROGRAM_FAILED after a message. */
int accuracy_cases(const accuracy_job *job);
int accuracy_frames(const accuracy_job *job, const char *path);

#endif
