/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All hits of a ray by brute force: every primitive decided in whole numbers, and the hits sorted by exact comparisons
 * alone. */
#ifndef ALL_HITS_REFERENCE_H
#define ALL_HITS_REFERENCE_H

#include <cgt/all_hits.h>

#include "exact/decide.h"
#include "scene/scene.h"

typedef struct reference_hit {
    uint32_t prim, geometry, primitive;
    bool far;
    cgt_primitive shape; /* that is hit: at the end of a capsule, the sphere there */
    float t;             /* canonical, rounded */
} reference_hit;

typedef struct reference_hits {
    reference_hit *hit; /* in order */
    uint32_t count, room;
} reference_hits;

/* The hits of ray i of the arrays, after `after`, if it is not NULL; *hits is used again. A failure here fails the
 * test. */
void reference_all_hits(const cgt_scene *scene, const cgt_rays *rays, uint64_t i, reference_hits *hits);

/* The number of the first hit after one of the ray's line; hits->count: none. */
uint32_t reference_after(const cgt_rays *rays, uint64_t i, const reference_hits *hits, const reference_hit *after);

#endif
