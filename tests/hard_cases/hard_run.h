/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Traces scenes with hard rays through the library and has the oracle judge the answers; for tests and for
 * cgt-bench. */
#ifndef HARD_RUN_H
#define HARD_RUN_H

#include <cgt/research.h>

#include "hard_cases/hard_cases.h"
#include "support/oracle/oracle.h"
#include "support/ray_arrays.h"

/* A committed scene. resolution: NULL for the scene's own. The arrays stay in s. On an error *scene is NULL. */
cgt_result hard_commit(cgt_context *context, const hard_scene *s, const uint32_t resolution[3], cgt_scene **scene);
cgt_result hard_commit_with(cgt_context *context, const hard_scene *s, const cgt_scene_options *options,
                            cgt_scene **scene);

/* For a case that is traced twice: traces its rays with default options, and rewrites them from their hits. */
cgt_result hard_follow(cgt_context *context, const hard_case *c, hard_scene *s);

/* The exact hit of every ray. */
typedef struct hard_truth {
    oracle_scene scene;
    oracle_hit *hit; /* one for each ray */
} hard_truth;

/* False where memory is refused. */
bool hard_truth_make(const hard_scene *s, hard_truth *truth);
void hard_truth_free(hard_truth *truth);

/* Judges the answer to ray i; *exact gets the hit to measure its values against. */
oracle_verdict hard_judge(const hard_scene *s, const hard_truth *truth, uint32_t i, const full_hit *answer,
                          oracle_hit *exact);

typedef struct hard_tally {
    uint64_t rays, hits;              /* hits by exact arithmetic */
    uint64_t missed, invented, wrong; /* wrong decisions */
} hard_tally;

hard_tally hard_judge_all(const hard_scene *s, const hard_truth *truth, const full_hit *answers);

static inline uint64_t hard_errors(const hard_tally *t) { return t->missed + t->invented + t->wrong; }

#endif
