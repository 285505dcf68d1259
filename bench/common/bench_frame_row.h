/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The rows of cgt-bench frame and compare-embree, which have the same columns. */
#ifndef BENCH_FRAME_ROW_H
#define BENCH_FRAME_ROW_H

#include <stddef.h>

#include "rays/bench_planes.h"
#include "common/bench_table.h"
#include "common/bench_timing.h"

/* Milliseconds of a frame; FRAME is the sum of the others. */
enum { BENCH_BUILD, BENCH_PRIMARY, BENCH_SHADOW, BENCH_AO, BENCH_FRAME, BENCH_FRAME_TIMES };

/* Medians of `measured` frames, which get sorted; hits of the last frame's planes; ao_open: rays that hit nothing. */
static inline void bench_frame_row(bench_table *table, const char *config, uint32_t threads,
                                   double *const ms[BENCH_FRAME_TIMES], size_t measured, const bench_planes *planes,
                                   uint64_t ao_open)
{
    static const char *const columns[] = {"build_ms", "primary_ms", "shadow_ms", "ao_ms", "frame_ms"};
    bench_table_text(table, "config", config);
    bench_table_count(table, "threads", threads);
    for (int c = 0; c < BENCH_FRAME_TIMES; c++)
        bench_table_real(table, columns[c], bench_median(ms[c], measured));
    bench_table_count(table, "hit_pixels", bench_planes_hits(planes));
    bench_table_count(table, "ao_open", ao_open);
    bench_table_end_row(table);
}

#endif
