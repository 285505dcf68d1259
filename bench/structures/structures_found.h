/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The hits of a set's rays, and their bitwise comparison. */
#ifndef STRUCTURES_FOUND_H
#define STRUCTURES_FOUND_H

#include <stddef.h>
#include <stdint.h>

#include "rays/bench_planes.h"

typedef enum found_form {
    FOUND_FRAME,   /* t, primitive and normal, in planes */
    FOUND_HITS,    /* t and primitive */
    FOUND_OCCLUDED /* 0 or 1 */
} found_form;

typedef struct structures_found {
    bench_planes planes; /* of FOUND_FRAME */
    uint64_t room;       /* rays that the arrays of the other forms hold */
    float *t;
    uint32_t *primitive;
    uint8_t *occluded;
} structures_found;

/* Makes planes, without arrays: 0, or -1 where memory is refused. Release them after a failure as well. */
int structures_found_create(structures_found *found, uint32_t width, uint32_t height);
void structures_found_release(structures_found *found);

/* Makes room for `count` answers and overwrites old ones with a pattern that no trace writes: 0, or -1 where memory is
 * refused. */
int structures_found_reset(structures_found *found, found_form form, uint64_t count);

/* Rays that hit. */
uint64_t structures_found_hits(const structures_found *found, found_form form, uint64_t count);

/* Returns how many rays differ in any bit. If any does, text describes the first of them: "ray 7: t 1 (3f800000),
 * primitive 3, not t ...". */
uint64_t structures_found_differ(const structures_found *expected, const structures_found *found, found_form form,
                                 uint64_t count, char *text, size_t size);

#endif
