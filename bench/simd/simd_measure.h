/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: a mapped word and its native form, found, compared and timed.
 */
#ifndef SIMD_MEASURE_H
#define SIMD_MEASURE_H

#include <stdint.h>

#include "simd/simd_rows.h"

/* Above this ratio of mapped to native, a reason must be given. */
#define SIMD_TOLERANCE 1.10

typedef struct simd_pair {
    const simd_row *mapped;
    const simd_row *native; /* NULL: none */
    int lanes;
    bool are_alike; /* both are of one variant and one arithmetic */
} simd_pair;

typedef struct simd_times {
    double mapped_ns, native_ns; /* of one word */
} simd_times;

/* The row with the same word, operands and count; NULL where there is none. */
const simd_row *simd_find(const simd_table *table, const simd_row *row);

/* Whether both forms give the same bits, if the native one is supposed to. */
bool simd_agrees(simd_memory *memory, const simd_pair *pair);

/* Runs a row for as long as a processor may take to reach its speed. */
void simd_warm_up(simd_memory *memory, const simd_row *row, int lanes);

/* samples: of each form, room for SIMD_MOST_SAMPLES(repeat) in each array. */
#define SIMD_MOST_SAMPLES(repeat) (4 * (size_t)(repeat))
simd_times simd_measure(simd_memory *memory, const simd_pair *pair, uint32_t repeat, double *samples[2]);

#endif
