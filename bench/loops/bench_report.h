/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What cgt-bench loops prints: a table with a row per configuration, then the ratios that it is about. */
#ifndef BENCH_REPORT_H
#define BENCH_REPORT_H

#include <stddef.h>

#include "loops/bench_plan.h"

/* frames: the number of frames that the statistics were summed over. Returns 0, or -1 where memory is refused. */
int bench_report_table(const bench_plan *plan, size_t frames);

/* Lines that start with "#": nested over flattened, culling's cut of the ray tests, mailbox on over off. Ratios of
 * times are of the same frame, then median and quartiles over the frames. Returns 0, or -1 where memory is refused. */
int bench_report_ratios(const bench_plan *plan);

#endif
