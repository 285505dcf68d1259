/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The steps that build a wide tree:
 *   1 sizes and middles of all objects (bound_primitives.c)   2 parts of like objects, and their cells (bvh_plan.c)
 *   3 the cell of each object, its key (kernel/wide_tree_keys.c)   4 objects sorted by key (cell_sort.c)
 *   5 runs of cells that one task takes each (bvh_ranges.c)   6 runs of objects that a leaf holds, and where the
 *     binary tree over them parts (kernel/wide_tree_split.c)
 *   7 leaf blocks, binary nodes with boxes and costs from the leaves to the root (kernel/wide_tree_leaves.c)
 *   8 which of them become wide nodes, then those (kernel/wide_tree_nodes.c)
 * What is built depends on the variant and the objects, not on threads: ranges follow from the cells alone. */
#ifndef CGT_BVH_BUILD_H
#define CGT_BVH_BUILD_H

#include <stdbool.h>

#include "model/loose_grid.h"
#include "model/primitives.h"
#include "model/primitive_bounds.h"
#include "model/triangle_cluster.h"
#include "model/bvh.h"

/* ---- parts ---- */

#define CGT_BVH_PARTS (2 * CGT_LOOSE_LEVELS) /* of each level the spheres and the triangles */
#define CGT_BVH_PART_DEPTH 5u                /* binary nodes over the parts' roots, at most */
#define CGT_BVH_KEY_BITS 24u                 /* of a part's cells */
#define CGT_BVH_PRIMS_PER_CELL 1u            /* at most, were they evenly spread: surfaces crowd few cells */

/* Bits of a cell's number along an axis that go to the cell's key together. */
typedef struct cgt_morton_bits {
    uint32_t axis, mask, shift;
} cgt_morton_bits;

/* Where along a Morton curve the middles of some objects lie: a box of 2^n cells along each axis, halved along its
 * longest edge again and again, each time for one bit of the key. */
typedef struct cgt_morton_curve {
    float low[3], rcell[3], last[3]; /* corner, cells per unit, the last cell's number */
    uint32_t bits, runs;
    cgt_morton_bits run[CGT_BVH_KEY_BITS];
} cgt_morton_curve;

/* Objects of one kind and level of the loose grid's plan. */
typedef struct cgt_bvh_part {
    float least;    /* sizes from here on belong to this part or one of its kind before it */
    uint32_t first; /* cell */
    cgt_morton_curve curve;
} cgt_bvh_part;

typedef struct cgt_bvh_plan {
    cgt_bvh_part part[CGT_BVH_PARTS]; /* spheres, then triangles */
    uint32_t parts[2];                /* of each kind */
    uint32_t cells;
} cgt_bvh_plan;

/* About 2^bits cells for middles between low and high; fewer where there is nothing to halve. */
void cgt_morton_curve_init(const float low[3], const float high[3], uint32_t bits, cgt_morton_curve *curve);

/* From the sizes of at least one object. */
void cgt_bvh_plan_parts(cgt_bvh_plan *plan, const cgt_size_classes *classes, const cgt_primitives *prims);

/* What cells any arrangement of so many objects or clusters gets at most: each part has less than twice as many as
 * those, or one. What is of which kind in a level is not known: it may be all. */
static inline uint64_t cgt_bvh_max_cells(const cgt_primitives *o, uint32_t count)
{
    const uint64_t kinds = (o->spheres > 0) + (o->triangles > 0), most = (uint64_t)CGT_BVH_PARTS << CGT_BVH_KEY_BITS;
    const uint64_t cells = 2 * kinds * count + CGT_BVH_PARTS;
    return cells < most ? cells : most;
}

typedef struct cgt_bvh_keys_job {
    const cgt_bvh_plan *plan;
    const float *middle; /* of triangles, see cgt_bounds_request */
    uint32_t triangles;
    uint32_t skipped; /* key of objects that take no part */
} cgt_bvh_keys_job;

/* ---- ranges ---- */

/* Ranges have no more objects than this, or one cell. Of clusters a share. */
#define CGT_BVH_RANGE_PRIMS 4096u /* at least */
#define CGT_BVH_RANGES 256u       /* of objects evenly spread, about */

#define CGT_BVH_LEAF_REF 0x80000000u /* references to binary nodes: a leaf's record, or an inner one */

/* A run of cells, and the part of the binary tree over it. */
typedef struct cgt_bvh_range {
    cgt_kind kind;
    uint32_t cell, bits;  /* first cell, and how many: 2^bits */
    uint32_t begin, end;  /* objects or clusters, at least one, in the order of the sort */
    uint32_t depth;       /* of its root; the root of all has depth 0 */
    uint32_t parting;     /* depth of the binary node where the range before it parts from it; of the first one: none */
    uint32_t leaves;      /* at least one */
    uint32_t first_leaf;  /* record; they go on in order */
    uint32_t first_block; /* of its kind */
    uint32_t first_inner; /* leaves - 1 of them */
    uint32_t roots;       /* wide nodes whose parents are over ranges */
    uint32_t list_length; /* those, and children of all the range's */
    uint32_t nodes;       /* wide ones */
    uint32_t first_node;
    uint32_t deepest; /* wide nodes above and with its deepest one, 0 where it has none */
} cgt_bvh_range;

/* Lists the ranges in order. Returns how many; range: NULL to count alone. start: of the sort. each: objects in each of
 * what was sorted. */
uint32_t cgt_bvh_list_ranges(const cgt_bvh_plan *plan, const uint32_t *start, uint32_t prims, uint32_t prims_each,
                             cgt_bvh_range *range);

/* ---- the tree ---- */

#define CGT_BVH_NO_REF UINT32_MAX

/* What the kernels' steps work on. With clusters these are what is sorted and split, and stand wherever the comments
 * have objects; leaves hold their triangles. */
typedef struct cgt_bvh_build {
    const cgt_primitives *prims;
    const cgt_cluster *cluster; /* NULL: none */
    float scale;                /* of the world */
    const uint32_t *start;
    uint32_t *prim;    /* by cell; a range's split sorts on in its cells */
    uint32_t sorted;   /* objects there */
    uint32_t *key;     /* room for a key of each object */
    uint32_t *scratch; /* for an object */
    float *middle[3];  /* and for its middle */
    uint16_t *leaf; /* by object: a range's leaves, from its first object on: count less one, parting << 8. By cluster:
                         from `leaves_each` times its first one on */
    uint32_t leaves_each; /* that a cluster is enough for; 1 of objects */
    cgt_bvh_range *range;
    uint32_t ranges;
    uint32_t leaves;
    void *record;          /* of leaves, then inner ones: ranges' and those over ranges; then lists of children */
    bool nontemporal;      /* blocks are more than caches hold */
    void *branch;          /* of each range's root, see kernel/wide_tree_binary.h */
    uint32_t root;         /* reference */
    float low[3], high[3]; /* of all */
    cgt_bvh_range top;     /* the wide nodes over ranges */
    void *node, *block[2]; /* results, blocks by kind */
} cgt_bvh_build;

/* A variant's steps. */
typedef struct cgt_bvh_builder {
    uint32_t node_bytes, block_bytes[2], leaf_bytes, inner_bytes, branch_bytes;
    uint32_t lanes;

    /* The cells of objects first to end - 1, all of one array, to key[0] and on; skipped ones get job->skipped. */
    void (*keys)(const cgt_bvh_keys_job *job, const cgt_primitive_array *array, uint32_t first, uint32_t end,
                 uint32_t *key);

    /* The same of clusters, to key[0] and on. */
    void (*cluster_keys)(const cgt_bvh_keys_job *job, const cgt_cluster *cluster, uint32_t count, uint32_t *key);

    /* Finds a range's leaves. */
    void (*split)(const cgt_bvh_build *build, cgt_bvh_range *range);

    /* Makes a range's leaf blocks and records, when it is known where they go. */
    void (*leaves)(const cgt_bvh_build *build, uint32_t range);

    /* Makes the records over the ranges, then chooses the wide nodes over them. */
    void (*join)(cgt_bvh_build *build);

    /* Chooses a range's wide nodes. */
    void (*choose)(const cgt_bvh_build *build, cgt_bvh_range *range);

    /* Makes the nodes of a range, or of the top, when it is known where they go. */
    void (*nodes)(const cgt_bvh_build *build, const cgt_bvh_range *range);
} cgt_bvh_builder;

#endif
