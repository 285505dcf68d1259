/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Runs of cgt-bench cell --kd. */
#ifndef KD_RUN_H
#define KD_RUN_H

#include "cell/cell_tables.h"
#include "cell/kd_scenes.h"

typedef struct kd_run {
    bench_table *table;
    const cell_programs *programs;
    uint64_t cycle_limit;
    uint32_t width, height;
    kd_bench_scene scene;
    double build_ms, image_ms;    /* of the scene, where a section asks for them */
    cgt_cell_frame_result result; /* of the last frame */
} kd_run;

/* Traces a frame of the scene; on one SPE where the options do not say. output: NULL for none. False after a
 * message. */
bool kd_run_frame(kd_run *run, const cgt_kd_frame_options *options, const cgt_kd_frame_output *output);

/* The thesis' table of errors between modes of execution. */
bool kd_run_modes(kd_run *run);

#endif
