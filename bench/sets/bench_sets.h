/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sets of rays or points, traced by all ways in turns: what the subjects rays, light and bounces have in common.
 *   files, builds, the loop                  sets_measure.c
 *   results, and their comparison            sets_found.c
 *   rows                                     sets_rows.c
 *   the subject rays: kinds, orders          rays_subject.c
 *   the subject light: places, points        light_subject.c, light_places.c, light_points.c
 *   the subject bounces: waves, orders       bounces_subject.c, bounces_orders.c */
#ifndef BENCH_SETS_H
#define BENCH_SETS_H

#include "ways/bench_tracer.h"

/* What was measured of one way. */
typedef struct sets_row {
    double *build_ms;               /* of each round */
    int has_bvh;                    /* they include AUTO's BVH beside its grid */
    double *ms[BENCH_MOST_BATCHES]; /* the same of the current set, all calls */
    bench_counts count;             /* of the current set */
    uint64_t hits,
        different; /* different: results that are not the first way's; of Embree, how many hits more or less */
} sets_row;

typedef struct sets_job {
    const bench_settings *settings;
    bench_table *table;
    bench_session session;
    bench_planes planes; /* the hits that rays and points start from */
    uint32_t *geometry;  /* the same */
    sets_row row[BENCH_MOST_WAYS];
    double *times; /* memory of all rows */
    uint64_t batch[BENCH_MOST_BATCHES];
    size_t batches;
    bench_found expected, found;  /* by the first way; by the current one */
    int expecting;                /* 1: `expected` is of the current set */
    int messages;                 /* about differing results, so far */
    uint64_t compared, different; /* results of all sets, of the library's ways */
} sets_job;

/* Runs a subject over all files: its sets, of one file at a time, all ways of which are built. Returns an exit code. */
int sets_run(const bench_settings *settings, int (*run)(sets_job *job));

/* Traces a set in calls of so many rays each, ascending (or as the set's calls are), all ways in turns; then writes the
 * rows. is_fresh: each run follows a commit and the camera's frame, and what the library builds for the set is in its
 * time. PROGRAM_OK, or PROGRAM_FAILED after a message. */
int sets_measure(sets_job *job, const bench_set *set, const uint64_t *batch, size_t batches, int is_fresh);
void sets_write_rows(sets_job *job, const bench_set *set);

int sets_out_of_memory(void); /* PROGRAM_FAILED, after a message */

/* ---- results ---- */

/* How many results a set has. */
uint64_t sets_results(const sets_job *job, const bench_set *set, const bench_tracer *tracer);

/* Makes planes, without arrays: 0, or -1 where memory is refused. Release them after a failure as well. */
int sets_found_create(bench_found *found, uint32_t width, uint32_t height);
void sets_found_release(bench_found *found);

/* Makes room for `count` results and overwrites old ones with a pattern that no trace writes: 0, or -1. */
int sets_found_reset(bench_found *found, bench_query query, uint64_t count);

/* Results that are hits; is_flags: nearest hits are told by `occluded`. */
uint64_t sets_found_hits(const bench_found *found, bench_query query, int is_flags, uint64_t count);

/* Returns how many results differ in any bit. If any does, text describes the first of them: "ray 7: t 1 (3f800000),
 * primitive 3, not t ...". */
uint64_t sets_found_differ(const bench_found *expected, const bench_found *found, bench_query query, uint64_t count,
                           char *text, size_t size);

#endif
