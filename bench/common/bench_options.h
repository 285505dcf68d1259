/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The one table of options of cgt-bench. Each row says who takes the option, and where its value goes. */
#ifndef BENCH_OPTIONS_H
#define BENCH_OPTIONS_H

#include "common/bench.h"
#include "common/options.h"

typedef struct bench_option {
    unsigned subjects; /* that take it; of a heading any */
    option_row row;
} bench_option;

extern const bench_option bench_options[];
extern const size_t bench_option_count;

#endif
