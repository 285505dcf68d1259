/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Invariants of every answer, for any scene, rays and options. */
#ifndef FUZZ_CHECK_H
#define FUZZ_CHECK_H

#include "fuzz/scene/fuzz_model.h"
#include "driver/judge/judge.h"
#include "support/random.h"
#include "support/ray_arrays.h"

/* Options for a trace, some outside the documented range: *legal tells whether the call may succeed. */
test_trace_options fuzz_options(fuzz_model *m, bool camera, bool *legal);

/* A ray that is worth it: at vertices, edges and spheres, from anywhere, or a neighbour of the last; and a camera. */
truth_ray fuzz_any_ray(fuzz_model *m, const truth_ray *before);
cgt_camera fuzz_any_camera(fuzz_model *m);

/* Makes a call that traces, which must succeed if it is legal, else fail with a message. */
void fuzz_must(fuzz_model *m, cgt_result result, bool legal);
#define FUZZ_MUST(m, call, legal)                                                                                      \
    do {                                                                                                               \
        cgt_result result_;                                                                                            \
        FUZZ_TRACE(m, result_, call);                                                                                  \
        fuzz_must(m, result_, legal);                                                                                  \
    } while (0)

/* The results of a camera's frame or of an array of rays, checked in the same way. */
typedef struct fuzz_answers {
    const truth_ray *ray;
    uint32_t count;
    full_hit *exact, *other; /* with default options, and with arbitrary ones */
} fuzz_answers;

fuzz_answers fuzz_answers_make(const truth_ray *ray, uint32_t count);
void fuzz_answers_free(fuzz_answers *a);

/* A hit names a primitive that exists and is not skipped, in the ray's range, without a NaN; a miss is all misses. */
void fuzz_check_hits(const fuzz_model *m, const fuzz_answers *a, const full_hit *hit, cgt_precision precision);

/* The counts of a call are consistent with each other and with the hits. */
void fuzz_check_counts(const fuzz_answers *a, const full_hit *hit, const cgt_trace_statistics *s,
                       const cgt_research_trace_statistics *research);

/* `other` holds the hits of the default options, unless it is FAST. */
void fuzz_check_same(const fuzz_model *m, const fuzz_answers *a, cgt_precision precision_of_other);

/* Judges the hits of the default options by whole numbers, as tests/driver does. */
void fuzz_check_truth(const fuzz_model *m, const judge_ray *rays, uint32_t count, const full_hit *hit);

/* A ray that sees everything. */
judge_ray fuzz_judge_ray(const truth_ray *ray);

/* Whether a ray is invalid, and so hits nothing. */
bool fuzz_ray_is_invalid(const truth_ray *ray);

#endif
