/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * How far the hits of a frame are from those of another one that is taken for the truth: pixels with another
 * primitive, and t in units in the last place where the primitive is the same. */
#ifndef BENCH_PARETO_ERROR_H
#define BENCH_PARETO_ERROR_H

#include <stdint.h>

#include "common/bench_planes.h"

/* Bins of distances: one each below PARETO_SINGLE, then PARETO_PER_OCTAVE to each power of two. */
enum { PARETO_SINGLE = 1024, PARETO_PER_OCTAVE = 64, PARETO_BINS = PARETO_SINGLE + (32 - 10) * PARETO_PER_OCTAVE };

/* Sums over frames; all zero at the begin. */
typedef struct pareto_error {
    uint64_t rays;
    uint64_t hits;     /* of the truth */
    uint64_t missed;   /* the truth hits, and nothing is hit */
    uint64_t invented; /* something is hit where the truth hits nothing */
    uint64_t wrong;    /* both hit, but not the same primitive */
    uint64_t same;     /* both hit the same primitive: their t are compared */
    uint32_t t_worst;  /* ulp, of those */
    uint64_t t_bins[PARETO_BINS];
} pareto_error;

/* Steps of float from a to b; +0 and -0 are one. Neither is a NaN. */
uint32_t pareto_ulp(float a, float b);

/* Adds one ray: whether the truth hits and something is found, whether that is the same primitive, and both t. */
void pareto_error_ray(pareto_error *error, int hit, int found, int same, float truth, float t);

/* Adds the comparison of a frame with the truth; both have the same size. */
void pareto_error_add(pareto_error *error, const bench_planes *truth, const bench_planes *frame);

/* Ulp that `share` of the t compared do not exceed, at most 1/64 too large; 0 where none was compared. */
uint32_t pareto_error_t(const pareto_error *error, double share);

/* Share of the rays that were missed, invented or wrong. */
double pareto_error_share(const pareto_error *error);

#endif
