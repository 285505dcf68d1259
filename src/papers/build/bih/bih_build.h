/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The build of a bounding interval hierarchy, in place: one array of items, 32 bytes a primitive, is divided again and
 * again until each leaf has its own part of it.
 *
 * A split lies in the middle of the centres' bounds, along their longest axis. The paper halves a regular grid instead,
 * to do without these bounds; but then a cluster in a wide world takes a step for each halving of the world. Here both
 * sides always get something, so that a subtree of n items has at most n - 1 splits.
 *
 * Depth and time are bounded: a node with n items at depth d keeps ceil(log2 n) <= CGT_BIH_MAX_DEPTH - d. Where a split
 * in the middle could break that, the items are halved at their median. So no primitive is looked at on more than
 * CGT_BIH_MAX_DEPTH levels: O(N), whatever the scene. Where all centres are the same, boxes differ in size alone, and
 * are halved by that; where they are all equal they make one leaf.
 *
 * Memory, all of it reserved before the build: an item, a reference and 9/8 pairs of nodes for each primitive, 72 bytes
 * in all, and what the top takes. */
#ifndef CGT_BIH_BUILD_H
#define CGT_BIH_BUILD_H

#include "core/context.h"
#include "papers/model/paper_structures.h"

typedef float cgt_bih_float4 __attribute__((vector_size(16)));
typedef int32_t cgt_bih_int4 __attribute__((vector_size(16)));

/* A primitive: the bounds of its box. Sums of spheres are rounded to nearest, which the planes' margin covers. Its
 * number is in the bits of the fourth element of low; that of high is 0. */
typedef struct cgt_bih_item {
    cgt_bih_float4 low, high;
} cgt_bih_item;

typedef struct cgt_bih_box {
    float low[3], high[3];
} cgt_bih_box;

/* Of items: the bounds of their boxes, and of low + high, which is twice the centre. Fourth elements mean nothing. */
typedef struct cgt_bih_bounds {
    cgt_bih_float4 low, high, first_sum, last_sum;
} cgt_bih_bounds;

/* By which number of an item, along an axis, items are divided. */
typedef enum cgt_bih_key { CGT_BIH_KEY_SUM = 0, CGT_BIH_KEY_HIGH, CGT_BIH_KEY_LOW } cgt_bih_key;

/* How a node is divided. */
typedef struct cgt_bih_split {
    bool leaf;   /* not at all: all boxes are equal */
    bool median; /* at the median, not at the threshold */
    cgt_bih_key key;
    uint32_t axis;
    float threshold; /* keys up to this one go to the lower child; some are, and some are not */
} cgt_bih_split;

/* The sides of a division: how many items are below, where these end and where the others begin along the axis. */
typedef struct cgt_bih_sides {
    uint32_t below;
    float end_of_lower, begin_of_upper;
} cgt_bih_sides;

/* A node to be built, over the items from first on, within the box that its ancestors' planes leave. */
typedef struct cgt_bih_part {
    uint32_t node, first, count, depth;
    cgt_bih_box box;
} cgt_bih_part;

/* Nodes are written by one task at a time: a slice of pairs, and what was made. */
typedef struct cgt_bih_output {
    cgt_bih_node *node;
    uint32_t *reference;
    uint32_t next_pair, spare_pairs; /* those that no split can need */
    uint32_t splits, clips, leaves, depth, largest_leaf;
    uint64_t references;
} cgt_bih_output;

/* A subtree that one task builds. */
typedef struct cgt_bih_task {
    cgt_bih_part part;
    cgt_bih_output out;
} cgt_bih_task;

typedef struct cgt_bih_chunk cgt_bih_chunk;

/* The memory of a build. */
typedef struct cgt_bih_workspace {
    cgt_bih_item *item;
    cgt_bih_node *node; /* the top's pairs, then those of the tasks */
    uint32_t *reference;
    cgt_bih_chunk *chunk; /* of the node of the top that is being divided */
    cgt_bih_task *task;
    uint32_t *valid; /* of each chunk of primitives */
    uint32_t tasks, top_pairs, task_items;
} cgt_bih_workspace;

#define CGT_BIH_LEAF_ITEMS 8u    /* as many make a leaf; measured with 16 lanes: three cost a fifth more */
#define CGT_BIH_CHUNK 4096u      /* items that a task takes of a node of the top */
#define CGT_BIH_TASKS_OF_ALL 64u /* a node with this part of all items is a task, */
#define CGT_BIH_MIN_TASK 4096u   /* and one with as many */

/* A node of the top has more than 1/64 of all items, so there are less than 64 at each depth. */
#define CGT_BIH_TOP_SPLITS (CGT_BIH_MAX_DEPTH * CGT_BIH_TASKS_OF_ALL)
#define CGT_BIH_TOP_CLIPS 1024u

/* Pairs of a task's slice: one for each split, and an eighth more for clips. */
static inline uint32_t cgt_bih_task_pairs(uint32_t items) { return items + items / 8; }

/* ---- bih_items.c ---- */

/* Of cgt_tree_collect (tree_items.h); of: the first item. */
void cgt_bih_store_item(void *of, uint32_t place, uint32_t prim, const cgt_primitive *primitive);

cgt_bih_bounds cgt_bih_bound(const cgt_bih_item *item, uint32_t count);
cgt_bih_bounds cgt_bih_merge(const cgt_bih_bounds *a, const cgt_bih_bounds *b);

/* Divides items in place, those below the threshold or at it first. */
cgt_bih_sides cgt_bih_divide(cgt_bih_item *item, uint32_t count, const cgt_bih_split *split);

/* Divides count / 2 items with the lowest keys from the others. */
cgt_bih_sides cgt_bih_divide_at_median(cgt_bih_item *item, uint32_t count, const cgt_bih_split *split);

static inline uint32_t cgt_bih_item_prim(const cgt_bih_item *item)
{
    uint32_t prim;
    memcpy(&prim, (const char *)&item->low + 3 * sizeof(float), sizeof prim);
    return prim;
}

/* ---- bih_subtree.c ---- */

/* Chooses how to divide items of which the bounds are known; item may be NULL where the sums differ. */
cgt_bih_split cgt_bih_choose(const cgt_bih_item *item, uint32_t count, uint32_t depth, const cgt_bih_bounds *bounds);
static inline bool cgt_bih_sums_differ(const cgt_bih_bounds *b)
{
    const cgt_bih_int4 differ = b->first_sum < b->last_sum;
    return differ[0] | differ[1] | differ[2];
}

/* Writes clip nodes while they pay and spare pairs are left; the part's node and box become those of the child. */
void cgt_bih_clip(cgt_bih_output *out, cgt_bih_part *part, const cgt_bih_bounds *bounds);

/* Writes the node and returns its children. */
void cgt_bih_add_split(cgt_bih_output *out, const cgt_bih_part *part, uint32_t axis, const cgt_bih_sides *sides,
                       cgt_bih_part child[2]);

void cgt_bih_build_subtree(cgt_bih_item *item, cgt_bih_task *task);

/* ---- bih_top.c ---- */

size_t cgt_bih_chunk_bytes(uint32_t items);

/* Builds down to subtrees for tasks, and lists these. */
void cgt_bih_build_top(const cgt_context *context, cgt_bih_workspace *workspace, const cgt_bih_part *root,
                       cgt_bih_output *out);

/* ---- bih_build.c ---- */

/* The buffers of a tree: of its nodes, of its references, and of what the build needs while it runs. */
typedef struct cgt_bih_memory {
    cgt_buffer *nodes, *references, *work;
} cgt_bih_memory;

/* Builds over the valid primitives of the scene, of which there is at least one; coordinates are within
 * CGT_MAX_COORDINATE. The tree depends on the primitives alone, not on the threads. Fails with OUT_OF_MEMORY or
 * TOO_LARGE, with a message. */
cgt_result cgt_bih_build(cgt_context *context, const cgt_bih_memory *memory, const cgt_committed_scene *committed_scene,
                         cgt_bih *tree);

#endif
