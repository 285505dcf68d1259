/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The results of the pass over all primitives of a commit: skipped ones, bounds, sizes. Structures are planned from
 * these. */
#ifndef CGT_PRIMITIVE_BOUNDS_H
#define CGT_PRIMITIVE_BOUNDS_H

#include <stdbool.h>
#include <stdint.h>

/* Primitives by size, the largest half extent of their bounds, for structures with levels by size. Class k holds
 * the sizes whose float has exponent bits k: within a factor of 2; class 0 those below 2^-126, points among them. */
#define CGT_SIZE_CLASSES 256u

typedef struct cgt_size_class {
    uint32_t count;
    float low[3], high[3]; /* of the middles of the primitives' bounds */
    float half[3];         /* largest half extents of the bounds, seen from those middles, rounded upwards */
} cgt_size_class;

typedef struct cgt_size_classes {
    uint32_t used_classes[CGT_SIZE_CLASSES / 32]; /* bit k: class k has primitives; else its entry is undefined */
    cgt_size_class of[CGT_SIZE_CLASSES];
} cgt_size_classes;

static inline bool cgt_size_class_is_used(const cgt_size_classes *c, uint32_t k)
{
    return c->used_classes[k / 32] >> k % 32 & 1;
}

/* Adds the primitives of one class to another, which may have none; sums and extremes do not depend on the order. */
static inline void cgt_size_class_add(cgt_size_class *to, const cgt_size_class *c)
{
    if (!to->count) {
        *to = *c;
        return;
    }
    to->count += c->count;
    for (int a = 0; a < 3; a++) {
        to->low[a] = c->low[a] < to->low[a] ? c->low[a] : to->low[a];
        to->high[a] = c->high[a] > to->high[a] ? c->high[a] : to->high[a];
        to->half[a] = c->half[a] > to->half[a] ? c->half[a] : to->half[a];
    }
}

/* Adds primitives, of which there is at least one, to class k. */
static inline void cgt_size_classes_add(cgt_size_classes *to, uint32_t k, const cgt_size_class *c)
{
    if (!cgt_size_class_is_used(to, k)) {
        to->used_classes[k / 32] |= UINT32_C(1) << k % 32;
        to->of[k].count = 0;
    }
    cgt_size_class_add(&to->of[k], c);
}

/* Returns how many primitives were added. */
static inline uint32_t cgt_size_classes_count(const cgt_size_classes *c)
{
    uint32_t count = 0;
    for (uint32_t k = 0; k < CGT_SIZE_CLASSES; k++)
        count += cgt_size_class_is_used(c, k) ? c->of[k].count : 0;
    return count;
}

struct cgt_cluster;
struct cgt_scratch; /* core/scratch.h */

/* Additional results. With classes, the pass stores for each primitive that is not a sphere, by its number among those,
 * the middle of its box and its size, -1 where it is skipped, so that its scattered points are fetched once. Or it
 * stores clusters, and the classes hold their sizes. */
typedef struct cgt_bounds_request {
    bool diameters;              /* sums of the diameters' powers, added in order: slower than all the rest */
    cgt_size_classes *classes;   /* gets the sizes; NULL: none */
    float *middle;               /* of those: planes of x, y, z and size; NULL where there are no classes */
    uint32_t boxed;              /* floats of a plane */
    struct cgt_cluster *cluster; /* triangle_cluster.h; NULL: none */
    struct cgt_scratch *scratch; /* of the task, for classes */
} cgt_bounds_request;

/* Lengths in world units. */
typedef struct cgt_primitive_bounds {
    uint32_t valid; /* not skipped */
    uint32_t skipped_not_finite;
    uint32_t skipped_radius;
    uint32_t skipped_degenerate;
    uint32_t large_clusters; /* clusters that are larger than their sample promised */
    uint32_t bad_index;      /* the first primitive with an index out of range; CGT_INVALID_ID: none */
    float min[3], max[3];    /* outwards rounded */
    double diameter[4];      /* sums of the powers 0 to 3 of the diameters; 0 where not requested */
    float magnitude;         /* largest coordinate of any bound */
} cgt_primitive_bounds;

#endif
