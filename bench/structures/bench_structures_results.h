/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What one row found in one frame, and whether another row found the same bits. */
#ifndef BENCH_STRUCTURES_RESULTS_H
#define BENCH_STRUCTURES_RESULTS_H

#include <stddef.h>
#include <stdint.h>

#include "common/bench_planes.h"

/* Hits of an array of rays. */
typedef struct structures_hits {
    uint64_t count, room;
    float *t;
    uint32_t *primitive, *geometry;
} structures_hits;

/* Answers of an array of occlusion rays. */
typedef struct structures_occluded {
    uint64_t count, room;
    uint8_t *occluded;
} structures_occluded;

typedef struct structures_results {
    bench_planes planes;
    uint32_t *geometry; /* of the planes' pixels */
    structures_occluded shadow, ao;
    structures_hits random;
} structures_results;

/* 0, or -1 where memory is refused. */
int structures_results_create(structures_results *results, uint32_t width, uint32_t height);
void structures_results_release(structures_results *results);

/* Make room for `count` answers, and forget the old ones: 0, or -1 where memory is refused. */
int structures_hits_reset(structures_hits *hits, uint64_t count);
int structures_occluded_reset(structures_occluded *occluded, uint64_t count);
void structures_planes_reset(structures_results *results);
void structures_hits_release(structures_hits *hits);

/* The first ray of each kind that found something else, in words: "primary ray 7 (pixel 7,0): t 1 (3f800000) ..., not
 * ...". Returns 0 and leaves text empty where all bits are the same. */
int structures_results_differ(const structures_results *expected, const structures_results *found, char *text,
                              size_t size);

#endif
