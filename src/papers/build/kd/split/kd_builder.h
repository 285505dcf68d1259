/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the files of this folder share: boxes, the planes that a node can hold, the rules of a build, and the output of
 * a task. */
#ifndef CGT_KD_BUILDER_H
#define CGT_KD_BUILDER_H

#include <math.h>

#include "papers/build/kd/kd_build.h"

typedef float cgt_float4 __attribute__((vector_size(16)));
typedef int32_t cgt_int4 __attribute__((vector_size(16)));

static inline cgt_float4 cgt_load4(const float *p)
{
    cgt_float4 v;
    memcpy(&v, p, sizeof v);
    return v;
}

static inline cgt_float4 cgt_all4(float x) { return (cgt_float4){x, x, x, x}; }

static inline cgt_float4 cgt_select4(cgt_int4 mask, cgt_float4 yes, cgt_float4 no)
{
    return (cgt_float4)(((cgt_int4)yes & mask) | ((cgt_int4)no & ~mask));
}

typedef struct cgt_kd_box {
    float low[3], high[3];
} cgt_kd_box;

/* A primitive in a node: the bounds of its part within the node's box, and what a test costs. low and high are each
 * read as a vector of four. */
typedef struct cgt_kd_item {
    float low[3];
    float weight;
    float high[3];
    uint32_t prim;
} cgt_kd_item;

/* The rules of a build. */
typedef struct cgt_kd_rules {
    const cgt_primitives *prims;
    cgt_kd_costs costs;
    uint32_t max_leaf_depth; /* of a leaf */
    double root_area;        /* half the surface of the root's box */
} cgt_kd_rules;

/* The output of a task: its slices of the raw tree. Numbers count from the start of the whole arrays.
 * There is always room for the references of all items that are not in a leaf yet: a task can stop splitting, but not
 * fail. */
typedef struct cgt_kd_output {
    cgt_kd_node *node;
    uint32_t *reference;
    uint32_t next_node, end_node;
    uint32_t next_reference, end_reference;
    double cost;
    uint32_t limited_leaves;
} cgt_kd_output;

/* A plane across an axis, and what the node costs if it is split there, as a multiple of its area. */
typedef struct cgt_kd_plane {
    uint32_t axis; /* 3: none */
    float split, cost;
    bool lower_empty, upper_empty;
    bool upper_larger; /* more items are in the upper box than in the lower one */
} cgt_kd_plane;

/* Half areas as shares of a node's: of the two sides across each axis together, and of what is around it for each unit
 * of length. The fourth element is undefined. */
typedef struct cgt_kd_shares {
    cgt_float4 side, around;
} cgt_kd_shares;

/* Half the surface, in double: coordinates of 2^55 and steps of 2^-149 both have squares there. */
static inline double cgt_kd_half_area(const cgt_kd_box *b)
{
    const double x = (double)b->high[0] - (double)b->low[0], y = (double)b->high[1] - (double)b->low[1],
                 z = (double)b->high[2] - (double)b->low[2];
    return x * y + y * z + z * x;
}

static inline cgt_kd_shares cgt_kd_area_shares(const cgt_kd_box *box)
{
    const double x = (double)box->high[0] - (double)box->low[0], y = (double)box->high[1] - (double)box->low[1],
                 z = (double)box->high[2] - (double)box->low[2];
    const double yz = y * z, zx = z * x, xy = x * y, of = 1 / (yz + zx + xy);
    return (cgt_kd_shares){{(float)(yz * of), (float)(zx * of), (float)(xy * of), 0},
                           {(float)((y + z) * of), (float)((z + x) * of), (float)((x + y) * of), 0}};
}

/* The planes that a node can hold are the floats whose two lowest bits are zero. Numbered in ascending order, 0 is
 * the plane at zero: */
static inline int32_t cgt_kd_plane_number(float plane)
{
    uint32_t bits;
    memcpy(&bits, &plane, sizeof bits);
    const int32_t magnitude = (int32_t)((bits & 0x7fffffffu) >> 2);
    return bits >> 31 ? -magnitude : magnitude;
}

static inline float cgt_kd_plane_at(int32_t number)
{
    const uint32_t bits = number < 0 ? (uint32_t)-number * 4 | 0x80000000u : (uint32_t)number * 4;
    float plane;
    memcpy(&plane, &bits, sizeof plane);
    return plane;
}

/* The last plane before x: what ends there is not beyond it; and the first plane after x. x is finite. */
static inline int32_t cgt_kd_plane_below(float x)
{
    const float plane = cgt_kd_round_split(x);
    const int32_t number = cgt_kd_plane_number(plane);
    return plane < x ? number : number - 1;
}

static inline int32_t cgt_kd_plane_above(float x)
{
    const float plane = cgt_kd_round_split(x);
    const int32_t number = cgt_kd_plane_number(plane);
    return plane > x ? number : number + 1;
}

static inline bool cgt_kd_is_inside(const cgt_kd_box *box, uint32_t axis, float split)
{
    return split > box->low[axis] && split < box->high[axis];
}

static inline cgt_kd_box cgt_kd_child_box(const cgt_kd_box *box, uint32_t axis, float split, bool upper)
{
    cgt_kd_box child = *box;
    (upper ? child.low : child.high)[axis] = split;
    return child;
}

/* ---- nodes: kd_node.c ---- */

/* A leaf of the items in the box; out has room for them. */
void cgt_kd_add_leaf(const cgt_kd_rules *rules, cgt_kd_output *out, uint32_t node, const cgt_kd_box *box,
                     const cgt_kd_item *item, uint32_t count);

/* An inner node, whose children get the next two numbers. Returns the lower one. */
uint32_t cgt_kd_add_inner(const cgt_kd_rules *rules, cgt_kd_output *out, uint32_t node, const cgt_kd_box *box,
                          const cgt_kd_plane *plane);

/* Whether there is room for both children of a node, whatever they get; sizes are not known before triangles are
 * clipped. stack: items that the stack takes. */
static inline bool cgt_kd_has_room(const cgt_kd_output *out, uint32_t items, size_t stack)
{
    return out->end_node - out->next_node >= 2 && items <= stack &&
           out->end_reference - out->next_reference >= 2 * (uint64_t)items;
}

/* Ends of an output's room. */
typedef struct cgt_kd_ends {
    uint32_t node, reference;
} cgt_kd_ends;

/* Leaves a child with as much of the room as it has of the items. Returns the ends to be restored after it. */
cgt_kd_ends cgt_kd_share_room(cgt_kd_output *out, uint32_t items, uint32_t sibling_items);

static inline void cgt_kd_restore_room(cgt_kd_output *out, cgt_kd_ends ends)
{
    out->end_node = ends.node;
    out->end_reference = ends.reference;
}

/* Whether any split could be cheaper than a leaf. */
static inline bool cgt_kd_may_split(const cgt_kd_rules *rules, float weight)
{
    return weight > rules->costs.inner * (1 - rules->costs.empty_cut_off);
}

/* Adds, where the plane leaves one side empty, the inner node and the empty leaf; box becomes that of the other child,
 * whose number is returned. */
uint32_t cgt_kd_cut_off(const cgt_kd_rules *rules, cgt_kd_output *out, uint32_t node, cgt_kd_box *box,
                        const cgt_kd_plane *plane);

/* What happens to a node whose plane was chosen. */
typedef enum cgt_kd_step { CGT_KD_STOP = 0, CGT_KD_CUT, CGT_KD_DIVIDE } cgt_kd_step;

/* STOP where there is no plane, or no depth or room (counted as a limited leaf); CUT where the plane leaves one side
 * empty, and the node became the other child; else DIVIDE. room: items that the stack takes. */
cgt_kd_step cgt_kd_next_step(const cgt_kd_rules *rules, cgt_kd_output *out, const cgt_kd_plane *plane, uint32_t count,
                             size_t room, uint32_t *node, uint32_t *depth, cgt_kd_box *box);

/* ---- items: kd_items.c ---- */

typedef struct cgt_kd_items {
    const cgt_kd_rules *rules;
    cgt_kd_item *item;
} cgt_kd_items;

/* Of cgt_tree_collect (tree_items.h); of: cgt_kd_items. */
void cgt_kd_store_item(void *of, uint32_t place, uint32_t prim, const cgt_primitive *primitive);

/* Divides an item that lies on both sides of a plane. Bit 0: something is in the lower box, bit 1: in the upper one. A
 * triangle is cut by the plane alone; with `whole` by all of the child's box. */
unsigned cgt_kd_split_item(const cgt_kd_rules *rules, const cgt_kd_item *item, const cgt_kd_box *box, uint32_t axis,
                           float split, bool clip_to_box, cgt_kd_item half[2]);

/* Sorts items to sides, in their order. to[0] or to[1] may be where they are. keep: an item whose bounds touch a side
 * is put there even where the clipped triangle turns out not to. */
void cgt_kd_partition(const cgt_kd_rules *rules, const cgt_kd_box *box, const cgt_kd_plane *plane,
                      const cgt_kd_item *item, uint32_t count, bool include_touching, cgt_kd_item *const to[2],
                      uint32_t counts[2]);

/* ---- subtrees: kd_binned.c ---- */

/* The work of a task: a node and its subtree. Its memory holds its items and a stack of as many. */
typedef struct cgt_kd_subtree {
    uint32_t number, depth, count;
    cgt_kd_box box;
    cgt_kd_item *item, *stack;
    size_t room; /* of item and of stack */
    cgt_kd_output out;
} cgt_kd_subtree;

void cgt_kd_build_binned(const cgt_kd_rules *rules, cgt_kd_subtree *subtree);

/* ---- the top of the tree: kd_top.c ---- */

#define CGT_KD_MAX_TASKS 1024u /* the top has fewer active nodes, and produces fewer tasks */
#define CGT_KD_TOP_NODES (16 * CGT_KD_MAX_TASKS)
#define CGT_KD_TASKS_OF_ALL 64u /* a node with this part of all items is a task, */
#define CGT_KD_MIN_TASK 256u    /* and one with as many */
#define CGT_KD_CHUNK 4096u      /* items that a task takes of a large node */
#define CGT_KD_NODES_PER_SLOT 4u
#define CGT_KD_REFERENCES_PER_SLOT 4u

typedef struct cgt_kd_chunk cgt_kd_chunk;
typedef struct cgt_kd_top_node cgt_kd_top_node;

/* The memory of a build, all of it in one buffer. A slot is room for an item, in two places: there are about twice as
 * many slots as primitives. A node of the top owns a range of slots in both places; its items are in one of them,
 * those of its children in the other. Each child gets its share of the slots, and so do the tasks in the end. Slices of
 * the output belong to slots as well. */
typedef struct cgt_kd_workspace {
    uint32_t slots;
    cgt_kd_item *item[2];
    cgt_kd_node *node; /* of the raw tree: the top's first, then those of each slot */
    uint32_t *reference;
    cgt_kd_subtree *task;
    uint32_t tasks;
    cgt_kd_top_node *active[2];
    cgt_kd_chunk *chunk;
    uint32_t *valid; /* of each chunk of primitives */
} cgt_kd_workspace;

/* Bytes of the chunks of the top, and of the nodes of a level. */
size_t cgt_kd_chunk_bytes(uint32_t slots);
size_t cgt_kd_level_bytes(void);

/* Builds down to subtrees that are small enough for a task, and lists these. */
void cgt_kd_build_top(const cgt_context *context, const cgt_kd_rules *rules, cgt_kd_workspace *room,
                      const cgt_kd_box *box, uint32_t count, cgt_kd_output *out);

#endif
