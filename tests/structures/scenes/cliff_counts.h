/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The work that cliffs take, by the library's counters, and the rows whose work is known to be out of proportion. A
 * failure here fails the test. */
#ifndef CLIFF_COUNTS_H
#define CLIFF_COUNTS_H

#include "support/cliffs/cliffs.h"
#include "support/scenes.h"

/* Size of what is counted: meshes are large enough for clusters, all are small enough for seconds. */
#define CLIFF_PRIMITIVES 4000u
#define CLIFF_MESH_PRIMITIVES 8200u
#define CLIFF_WIDTH 32u
#define CLIFF_HEIGHT 24u
#define CLIFF_RAYS_COUNTED 256u
#define CLIFF_SINGLE_RAYS 8u

typedef struct cliff_counts {
    double work[CLIFF_CALLS]; /* of a ray or point; of the commit: bytes of structures for a primitive */
    uint64_t exact;           /* tests and values that took whole numbers, of all calls */
    full_hit hit[CLIFF_RAYS_COUNTED];
    uint8_t occluded[CLIFF_RAYS_COUNTED];
    planes frame;
} cliff_counts;

/* Makes the scene of a cliff, or its twin's, commits and traces it. Release with cliff_counts_free. */
void cliff_counts_make(cliff_counts *counts, cgt_context *context, const cliff *c, bool disturbed,
                       cliff_structure structure);
void cliff_counts_free(cliff_counts *counts);

/* Fails unless all hits are the same bits. */
void cliff_counts_compare(const cliff *c, const cliff_counts *a, const cliff_counts *b);

/* The bound of a known row, or 0 where the row is not known. */
double cliff_known_bound(const char *name, cliff_call call, cliff_structure structure);

/* Fails where a known row names no cliff, or comes twice. Returns how many there are. */
uint32_t cliff_known_check(void);

#endif
