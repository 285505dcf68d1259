/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench cell --kd: the thesis' tracer on simulated SPEs. */
#ifndef KD_FRAMES_H
#define KD_FRAMES_H

#include <stdbool.h>
#include <stddef.h>

#include "common/bench_table.h"

/* ELF files in memory: of kd-trees, and of bounding interval hierarchies or NULL. */
typedef struct kd_programs {
    const void *kd, *bih;
    size_t kd_bytes, bih_bytes;
} kd_programs;

/* Frames of a hilly sheet of 20,164 triangles by the kd program, in sections: "kernel", with its "functions"; then, on
 * smaller pictures, what each choice costs: "layouts", "triangles", "traversals", "envelopes", "assignments", "parts",
 * "modes"; with both programs "structures", "hierarchies" and "rebuilt". section: the only one that is wanted; NULL: all.
 * Returns false after a message. */
bool kd_frames_run(bench_table *table, const kd_programs *programs, const char *section);

#endif
