/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Errors of hits, relative to reference hits ("the truth"): rays with another primitive, and the distance of t in units
 * in the last place where the primitive is the same. */
#ifndef ACCURACY_ERROR_H
#define ACCURACY_ERROR_H

#include <stdint.h>

#include "rays/bench_planes.h"
#include "common/bench_table.h"

/* Bins of distances: one each below ACCURACY_SINGLE, then ACCURACY_PER_OCTAVE to each power of two. */
enum {
    ACCURACY_SINGLE = 1024,
    ACCURACY_PER_OCTAVE = 64,
    ACCURACY_BINS = ACCURACY_SINGLE + (32 - 10) * ACCURACY_PER_OCTAVE
};

/* Sums over frames; start from zero. */
typedef struct accuracy_error {
    uint64_t rays;
    uint64_t hits;     /* of the truth */
    uint64_t missed;   /* missed: the truth hits */
    uint64_t invented; /* invented: the truth hits nothing */
    uint64_t wrong;    /* both hit, but not the same primitive */
    uint64_t same;     /* both hit the same primitive: their t are compared */
    uint32_t t_worst;  /* ulp, of those */
    uint64_t t_bins[ACCURACY_BINS];
} accuracy_error;

/* Adds one ray: whether the truth hits, whether something is found, whether that is the same primitive, and both t. */
void accuracy_error_ray(accuracy_error *error, int hit, int found, int same, float truth, float t);

/* Adds the comparison of a frame with the truth. Both have the same size. */
void accuracy_error_add(accuracy_error *error, const bench_planes *truth, const bench_planes *frame);

/* The cells "rays" to "t_ulp_worst". */
void accuracy_error_cells(const accuracy_error *error, bench_table *table);

#endif
