/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A ray caster's answers to all rays of a scene, judged by the exact oracle: decisions counted, errors of t, u and
 * v, and the table that compares ray casters. */
#ifndef EMBREE_OPINION_H
#define EMBREE_OPINION_H

#include <stdio.h>

#include "hard_cases/hard_run.h"

typedef struct opinion {
    const char *config;
    full_hit *hit;    /* one for each ray */
    hard_tally tally; /* without ties */
    uint64_t tied;    /* another primitive at exactly the same distance: only libcgt promises which one */
    double *exact_t;  /* t of the named primitive, for each ray; NaN for a miss or a wrong hit */
    double *t_error;  /* ulp, for each ray; NaN for a miss or a wrong hit */
    double *uv_error; /* the larger one of u and v, in 2^-24; NaN likewise, and for spheres */
} opinion;

/* Allocates answers for `rays` rays; false if memory is refused. */
bool opinion_make(opinion *o, const char *config, uint32_t rays);
void opinion_free(opinion *o);

/* Computes everything else from the answers. */
void opinion_judge(opinion *o, const hard_scene *s, const hard_truth *truth);

/* The primitive that an answer names, NULL for none. The oracle's are in the order of ids. */
const oracle_primitive *opinion_named(const oracle_scene *scene, const full_hit *hit);

/* Order statistics of numbers other than NaN; all NaN where there is none. */
typedef struct opinion_quantiles {
    double median, p99, worst;
} opinion_quantiles;

/* `among`: a bit for each number to include, or NULL for all. False where memory is refused. */
bool opinion_quantiles_of(const double *number, const uint8_t *among, uint32_t count, opinion_quantiles *spread);

/* ---- the table: tab-separated, "-" where there is no number ---- */

void opinion_print_head(FILE *file);

/* left_out: the part of the case that this ray caster was not given, or "-". False where memory is refused. */
bool opinion_print_row(FILE *file, const char *row, const char *name, const opinion *o, uint32_t rays,
                       const char *left_out);

#endif
