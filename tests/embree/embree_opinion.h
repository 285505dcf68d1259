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
    double *exact_t;  /* of the named primitive, for each ray; NaN where no hit was found, or a wrong one */
    double *t_error;  /* ulp, for each ray; NaN where no hit was found, or a wrong one */
    double *uv_error; /* the larger one of u and v, in 2^-24; NaN likewise, and on spheres */
} opinion;

/* Allocates answers for this many rays; false if memory is refused. */
bool opinion_make(opinion *o, const char *config, uint32_t rays);
void opinion_free(opinion *o);

/* Fills in all but the answers from the answers. */
void opinion_judge(opinion *o, const hard_scene *s, const hard_truth *truth);

/* The primitive that an answer names, NULL for none. The oracle's are in the order of ids. */
const oracle_primitive *opinion_named(const oracle_scene *scene, const full_hit *hit);

/* Of numbers, those that are NaN left out; all NaN where none is left. */
typedef struct opinion_spread {
    double median, p99, worst;
} opinion_spread;

/* Only numbers with a bit in `among`, where that is not NULL. False where memory is refused. */
bool opinion_spread_of(const double *number, const uint8_t *among, uint32_t count, opinion_spread *spread);

/* ---- the table: tab-separated, "-" where there is no number ---- */

void opinion_print_head(FILE *file);

/* left_out: what of the case this ray caster was not asked, or "-". False where memory is refused. */
bool opinion_print_row(FILE *file, const char *row, const char *name, const opinion *o, uint32_t rays,
                       const char *left_out);

#endif
