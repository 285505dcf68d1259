/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A ray on its way through the BVH to its first hits (query/hit_list.h). */
#ifndef CGT_BVH_LIST_H
#define CGT_BVH_LIST_H

#include "kernel/bvh/bvh_single.h"
#include "query/hit_list.h"

typedef struct list_query {
    const bvh_call *call;
    cgt_hit_list *list;
    bvh_ray ray; /* `near` and `far` as the list allows */
    bvh_leaf_ray leaf;
    float first, last; /* hits whose intervals are between them are certainly in the range and after `after` */
    bvh_slabs slabs;
    uint32_t code; /* of the next node or leaf; CGT_BVH_NO_CHILD: there is none */
    bvh_stack stack;
} list_query;

/* T is that of the normalised ray (bvh_ray.h). */
static inline void list_set_units(cgt_hit_list *list, float scale)
{
    float longest = 0;
    int exponent;
    for (int a = 0; a < 3; a++)
        longest = fabsf(list->ray->line.dir[a]) > longest ? fabsf(list->ray->line.dir[a]) : longest;
    frexpf(longest, &exponent); /* 2^exponent is twice 2^k */
    cgt_hit_list_set_units(list, ldexp((double)scale, exponent - 1), 0);
}

/* Puts a ray, whose origin, direction, range and slabs are set, at a node or leaf. */
static inline void list_start(list_query *q, uint32_t code)
{
    q->first = q->ray.near + fabsf(q->ray.near) * 0x1p-18f + q->call->range_error[0];
    q->last = q->ray.best.low;
    if (q->list->has_after) {
        const cgt_listed_hit *after = &q->list->after;
        q->first = after->high > q->first ? after->high : q->first;
        q->ray.near = after->low > q->ray.near ? after->low : q->ray.near;
    }
    bvh_leaf_ray_init(q->call, &q->ray, &q->leaf);
    bvh_slabs_init(&q->ray, &q->slabs);
    q->stack.top = 0;
    q->code = q->ray.near <= q->ray.far ? code : CGT_BVH_NO_CHILD;
}

/* Takes it to its end. */
void CGT_KERNEL(cgt_list_finish)(list_query *q);

/* Rays that take turns; unusual ones by cgt_list_unusual. */
void CGT_KERNEL(cgt_list_turns)(const cgt_committed_scene *committed_scene, cgt_hit_list *const *lists, uint32_t count,
                                cgt_counts *counts);

/* Neighbours in streams (kernel/stream), at most LIST_CHUNK, of one kind, all with spheres or all without. Those that
 * streams do not take go by the function above. */
#define LIST_CHUNK 1024u
void CGT_KERNEL(cgt_list_streams)(const cgt_committed_scene *committed_scene, cgt_hit_list *const *lists,
                                  uint32_t count, cgt_counts *counts);

#endif
