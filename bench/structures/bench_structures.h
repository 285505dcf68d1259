/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench structures: grids and kd-trees beside each other on the same scenes and rays.
 *   rows      what is compared, and how one of them is measured   bench_structures_rows.c
 *   rays      shadow, ambient-occlusion and random rays           bench_structures_rays.h
 *   results   what rays found, and whether it is the same bits    bench_structures_results.h
 *   measure   all rows over all frames, interleaved               bench_structures_measure.c
 *   table     the rows, printed                                   bench_structures_table.c
 *   fetch     transfers of nodes into a small memory, by layout   bench_structures_fetch.c */
#ifndef BENCH_STRUCTURES_H
#define BENCH_STRUCTURES_H

#include <stddef.h>
#include <stdint.h>

#include "common/bench.h"
#include "accuracy/bench_accuracy_report.h"
#include "common/bench_input.h"
#include "frame/bench_frame_rays.h"
#include "common/bench_scene.h"
#include "structures/bench_structures_rays.h"
#include "structures/bench_structures_results.h"

#define STRUCTURES_MOST_FILES 32
#define STRUCTURES_MOST_RAYS 100000000u

typedef struct structures_settings {
    bench_settings shared;
    bench_structure_settings structure;
    const char *paths[STRUCTURES_MOST_FILES];
    size_t files;
    int lit;
    float light[3];
    uint32_t ao;     /* ambient-occlusion rays from every hit */
    uint32_t random; /* random rays */
    const char *json_path;
    int all;
    int fetch;
} structures_settings;

enum {
    STRUCTURES_BUILD,
    STRUCTURES_PRIMARY,
    STRUCTURES_SHADOW,
    STRUCTURES_AO,
    STRUCTURES_RANDOM,
    STRUCTURES_FRAME, /* all but RANDOM together */
    STRUCTURES_COLUMNS
};

/* What is built once per frame; rows of a group trace the same structure, and lie together. */
typedef bench_build structures_group;

typedef struct structures_row {
    size_t group;
    cgt_kd_traversal traversal;
    cgt_loop loop;                          /* of a queue grid */
    uint32_t packet;                        /* of a camera; 0: the library's choice, in a loose grid tiles */
    double *ms[STRUCTURES_COLUMNS];         /* one value per measured frame */
    bench_counts count[STRUCTURES_COLUMNS]; /* of all frames, by kind of ray */
} structures_row;

enum { STRUCTURES_MOST_GROUPS = 16, STRUCTURES_MOST_ROWS = 32 };

typedef struct structures_job {
    const structures_settings *settings;
    const char *path; /* of the file in work */
    char scene_name[BENCH_NAME_SIZE];
    bench_input input;
    cgt_context *context;
    const char *variant;
    bench_threads *threads;
    bench_camera_axes axes;
    bench_scene scene; /* one for all groups */
    structures_group groups[STRUCTURES_MOST_GROUPS];
    size_t group_count;
    structures_row rows[STRUCTURES_MOST_ROWS];
    size_t row_count;
    size_t measured; /* frames */
    structures_rays shadow, ao, random;
    structures_results expected, found; /* of the frame's first row, and of the row in work */
    bench_rays *maker;                  /* of the rays that start at expected's hits */
    uint64_t compared, different;       /* traces beside others, and those with other bits */
} structures_job;

/* All return an exit code and print what failed, but for those that return a cgt_result. */

/* Opens and closes what one file needs. close: also after open failed. */
int structures_open(structures_job *job, const structures_settings *settings, const char *path);
void structures_close(structures_job *job);

/* The list of groups and rows that the settings ask for, with room for the measurements of all frames. */
int structures_plan(structures_job *job);
void structures_plan_release(structures_job *job);

/* The name of a row after the first commit of its group; AUTO's is "auto", with the kind of rays that it is told. */
void structures_row_name(const structures_job *job, const structures_row *row, char name[BENCH_NAME_SIZE]);

/* Builds a group over the frame as it is; leaves the group out with a message where the library has no such
 * structure. */
cgt_result structures_commit(structures_job *job, structures_group *group, uint32_t count, double *ms);

/* Traces a row into results; counts: one per column, or NULL where nothing is to be counted. ms gets the columns
 * of the rays. primary fills the planes; the others take the rays as they are in the job. */
cgt_result structures_trace_primary(structures_job *job, const structures_row *row, structures_results *results,
                                    bench_counts *counts, double ms[STRUCTURES_COLUMNS]);
cgt_result structures_trace_others(structures_job *job, const structures_row *row, structures_results *results,
                                   bench_counts *counts, double ms[STRUCTURES_COLUMNS]);

/* Makes the rays that follow from the planes of `expected` and from the scene's bounds. */
cgt_result structures_make_rays(structures_job *job, const structures_group *group);

/* Counts, times and compares all rows. */
int structures_measure(structures_job *job);

void structures_table_begin(accuracy_report *report);
int structures_table_rows(const structures_job *job, accuracy_report *report);

/* The simulation of transfers, for one file. */
void structures_fetch_begin(accuracy_report *report);
int structures_fetch_rows(structures_job *job, accuracy_report *report);

#endif
