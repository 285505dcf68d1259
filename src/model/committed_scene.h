/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What rays are traced against: the primitives of a commit, their bounds, and the structure that was built over
 * them. */
#ifndef CGT_COMMITTED_SCENE_H
#define CGT_COMMITTED_SCENE_H

#include <stdbool.h>
#include <string.h>

#include "core/memory.h"
#include "model/loose_grid.h"
#include "model/primitive_bounds.h"
#include "model/primitives.h"
#include "model/bvh.h"

/* Beyond this, squares of coordinates leave the range of float: no structure then. */
#define CGT_MAX_COORDINATE 0x1p55f

typedef struct cgt_committed_scene {
    cgt_primitives prims;
    uint32_t valid;          /* primitives that were not skipped */
    float low[3], high[3];   /* bounds of those, rounded outwards */
    float scale;             /* a power of two: the largest coordinate times it is between 1/2 and 2 */
    bool has_masks;          /* some primitive's geometry has a mask with a bit unset */
    bool brute_force;        /* in bands, so there is no structure: what is asked past them tests every primitive */
    cgt_structure structure; /* which of the next is built; none where brute_force is set, or no primitive is valid */
    struct cgt_paper_structures *papers; /* papers/model/paper_structures.h; NULL: none of them */
    cgt_loose_grid loose;
    const struct cgt_cluster *cluster; /* what loose grids are of (triangle_cluster.h); NULL: primitives */
    bool bvh_of_clusters;              /* BVHs are, too */
    cgt_bvh bvh; /* node is NULL until it is built: at the commit, or for the first rays that need it */
} cgt_committed_scene;

#endif
