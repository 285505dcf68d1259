/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The report of a run: the summary on standard output and the log file. */
#ifndef RENDER_REPORT_H
#define RENDER_REPORT_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cgt/research.h>

#include <cgt/trajectory.h>

/* One frame. All times are measured by this program. */
typedef struct frame_record {
    uint64_t number; /* in the file */
    int64_t step;
    uint32_t primitives; /* spheres or triangles */
    uint32_t skipped_not_finite, skipped_radius, skipped_degenerate;
    uint64_t hits;   /* rays */
    double read_ms;  /* reading, with the speeds from positions */
    double color_ms; /* values to palette entries */
    double build_ms; /* cgt_scene_commit */
    double trace_ms; /* cgt_trace_camera, shading included */
    double write_ms; /* encoding and writing pictures, scaling for the contact sheet */
} frame_record;

/* What the library counted in a frame. */
typedef struct render_counts {
    cgt_trace_statistics trace;
    cgt_research_trace_statistics research;
    cgt_research_scene_statistics scene;
} render_counts;

typedef struct render_report {
    cgt_trajectory_kind kind; /* of the primitives; set before the first frame is added */
    const char *log_path;     /* NULL: no log */
    FILE *log;
    frame_record *frames;
    size_t count, capacity;
    int has_stats;
    render_counts traced;       /* where has_stats: sums over the frames; scene as the next */
    cgt_scene_statistics scene; /* of the frame with the most primitives, where has_stats */
} render_report;

/* Starts a report; log_path: NULL for none. Returns 0, or -1 with a text. */
int render_report_open(render_report *report, const char *log_path, char *error, size_t error_size);

/* Adds a frame. scene: statistics of its commit; traced: NULL if nothing was counted. Returns 0, or -1 with a text. */
int render_report_add(render_report *report, const frame_record *frame, const cgt_scene_statistics *scene,
                      const render_counts *traced, char *error, size_t error_size);

/* Prints the summary: sums, medians, frames per second. rays: of one frame. images: pictures per frame. */
void render_report_print(const render_report *report, uint64_t rays, uint32_t images, FILE *to);

/* Closes the log and frees the memory. Returns 0, or -1 with a text where the log could not be written. */
int render_report_close(render_report *report, char *error, size_t error_size);

#endif
