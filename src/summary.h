/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the pass over all objects of a commit finds: what is skipped, bounds, sizes. Structures are planned from it. */
#ifndef CGT_SUMMARY_H
#define CGT_SUMMARY_H

#include <stdint.h>

/* Lengths in world units. */
typedef struct cgt_object_summary {
    uint32_t valid; /* not skipped */
    uint32_t skipped_not_finite;
    uint32_t skipped_radius;
    uint32_t skipped_degenerate;
    uint32_t bad_index;   /* the first object with an index out of range; CGT_NONE: none */
    float min[3], max[3]; /* outwards rounded */
    double diameter[4];   /* sums of the powers 0 to 3 of the diameters */
    float magnitude;      /* largest coordinate of any bound */
} cgt_object_summary;

#endif
