/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Runs of cgt-bench cell --kd, and its sections. */
#ifndef KD_RUN_H
#define KD_RUN_H

#include "cell/kd_scenes.h"
#include "common/bench_table.h"

typedef struct kd_run {
    bench_table *table;
    const void *elf, *bih_elf; /* the programs; bih_elf: of hierarchies, or NULL */
    size_t elf_bytes, bih_bytes;
    uint32_t width, height;
    cgt_cell_frame_result result; /* of the last run */
} kd_run;

/* Traces a frame; on one SPE where the options do not say. output: NULL for none. False after a message. */
bool kd_run_frame(kd_run *run, const kd_bench_scene *scene, const cgt_kd_frame_options *options,
                  const cgt_kd_frame_output *output);

/* All SPEs together. */
typedef struct kd_run_sums {
    double node_fetches, reference_fetches, leaf_fetches, triangle_fetches; /* for each pixel */
    double bytes;                                                           /* of all DMA, for each pixel */
    double waits;                                                           /* percent of the cycles */
    double idle;
    double cycles; /* for each pixel, as if one SPE had done it all */
    uint64_t messages, commands;
} kd_run_sums;

kd_run_sums kd_run_add(const kd_run *run, unsigned spes);

/* The sections; false after a message. */
bool kd_section_layouts(kd_run *run);
bool kd_section_hierarchies(kd_run *run);
bool kd_section_structures(kd_run *run);
bool kd_section_rebuilt(kd_run *run);
bool kd_section_triangles(kd_run *run);
bool kd_section_traversals(kd_run *run);
bool kd_section_envelopes(kd_run *run);
bool kd_section_assignments(kd_run *run);
bool kd_section_parts(kd_run *run);
bool kd_section_modes(kd_run *run);

#endif
