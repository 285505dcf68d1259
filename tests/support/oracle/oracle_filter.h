/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A filter in double precision: the primitives of a scene that a ray certainly misses. Exact arithmetic decides the
 * others. Its margins are thousands of times the rounding errors, and floats are read from their bits, so that flushing
 * of denormals does not reach it. No product of floats leaves the range of double. */
#ifndef ORACLE_FILTER_H
#define ORACLE_FILTER_H

#include "support/oracle/oracle.h"

#define ORACLE_BLOCK 64

/* Balls around 64 primitives: centre and square of the radius, which is -infinity for invalid primitives. */
typedef struct oracle_bounds {
    double x[ORACLE_BLOCK], y[ORACLE_BLOCK], z[ORACLE_BLOCK], rr[ORACLE_BLOCK];
} oracle_bounds;

void oracle_bound(const oracle_primitive *primitive, uint32_t count, oracle_bounds *bounds);

typedef struct oracle_filter {
    double org[3], dir[3];
    double dd, length;
    double t_min, t_max; /* hits outside do not count */
} oracle_filter;

oracle_filter oracle_filter_make(const truth_ray *ray);

/* For each ball: below 0 if the line certainly misses it. */
void oracle_filter_line(const oracle_filter *filter, const oracle_bounds *bounds, double margin[ORACLE_BLOCK]);

/* False if primitive i of the block is certainly not hit between t_min and t_max. */
bool oracle_filter_keeps(const oracle_filter *filter, const oracle_bounds *bounds, uint32_t i,
                         const oracle_primitive *primitive);

/* From now on, hits certainly beyond t do not count. */
void oracle_filter_cut(oracle_filter *filter, truth_real t);

#endif
