/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench cell --frames: what SPEs wait for. */
#ifndef CELL_WAITS_H
#define CELL_WAITS_H

#include <stdbool.h>

#include "cell/ppe/grid/grid_frame.h"
#include "common/bench_table.h"

/* Frames of a scene, 320 x 180 pixels, on simulated SPEs: the section "waits", by number of SPEs and assignment, and
 * "ppe", six SPEs by the cycles that the PPE takes to answer. Cycles of all SPEs together, split: for DMA, a place in its
 * queue, mailboxes, signals. options: the program. Returns false after a message. */
bool cell_waits_run(bench_table *table, const cgt_grid_scene *scene, const cgt_grid_frame_options *options);

#endif
