/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * References that wait until what they stand for has come to the cache. */
#ifndef CGT_WAITING_H
#define CGT_WAITING_H

#include "kernel/primitive/gather_primitives.h"

#define WAITING 256u
#define WAITING_AHEAD 64u /* whose vertices are on their way */

/* Indices and vertices of fewer triangles are mostly in a cache as they are, and are not asked for. */
#define WAITING_TRIANGLES 131072u

typedef struct waiting {
    uint32_t reference[WAITING + 1];
    uint32_t count;
} waiting;

/* Adds references while there is room, and asks for what they stand for. Returns how many were added. */
typedef uint32_t waiting_add(waiting *q, const cgt_world *world, const uint32_t *reference, uint32_t count);

/* References of spheres. */
CGT_SPU_INLINE uint32_t waiting_add_spheres(waiting *q, const cgt_world *world, const uint32_t *reference,
                                            uint32_t count)
{
    const cgt_objects *objects = &world->objects;
    const bool one = objects->arrays == 1;
    const uint32_t room = WAITING - q->count, some = count < room ? count : room;
    uint32_t *to = q->reference + q->count;
    for (uint32_t k = 0; k < some; k++) {
        to[k] = reference[k];
        if (one)
            __builtin_prefetch(cgt_array_point(objects->array, reference[k]));
    }
    q->count += some;
    return some;
}

/* Of triangles, whose indices are asked for. */
CGT_SPU_INLINE uint32_t waiting_add_triangles(waiting *q, const cgt_world *world, const uint32_t *reference,
                                              uint32_t count)
{
    const cgt_objects *objects = &world->objects;
    const cgt_object_array *a = objects->array;
    const char *index = objects->arrays == 1 && objects->count >= WAITING_TRIANGLES ? a->index : NULL;
    const uint32_t room = WAITING - q->count, some = count < room ? count : room;
    uint32_t *to = q->reference + q->count;
    for (uint32_t k = 0; k < some; k++) {
        to[k] = reference[k];
        if (index)
            __builtin_prefetch(index + (size_t)reference[k] * a->index_stride);
    }
    q->count += some;
    return some;
}

/* Of clusters. */
CGT_SPU_INLINE uint32_t waiting_add_clusters(waiting *q, const cgt_world *world, const uint32_t *reference,
                                             uint32_t count)
{
    const cgt_cluster *cluster = world->cluster;
    const uint32_t room = WAITING - q->count, some = count < room ? count : room;
    uint32_t *to = q->reference + q->count;
    for (uint32_t k = 0; k < some; k++) {
        to[k] = reference[k];
        __builtin_prefetch(&cluster[reference[k]]);
    }
    q->count += some;
    return some;
}

/* Adds the triangles of a cluster, for which there must be room, and asks for their indices. */
CGT_SPU_INLINE void waiting_add_cluster(waiting *q, const cgt_objects *objects, uint32_t number, uint32_t valid)
{
    const cgt_object_array *a = objects->array;
    const uint32_t first = number * CGT_CLUSTER;
    if (objects->arrays == 1 && a->index) {
        const char *index = a->index + (size_t)first * a->index_stride;
        __builtin_prefetch(index);
        __builtin_prefetch(index + CGT_CLUSTER / 2 * a->index_stride);
        __builtin_prefetch(index + (CGT_CLUSTER - 1) * a->index_stride);
    }
    for (uint32_t k = 0; k < CGT_CLUSTER; k++) {
        q->reference[q->count] = first + k; /* written over where it is not valid */
        q->count += valid >> k & 1;
    }
}

/* Asks for the vertices of triangles up to WAITING_AHEAD after reference k, of the first `count`, from `asked` on. Returns
 * up to which they are asked for now. */
CGT_SPU_INLINE uint32_t waiting_ask(const waiting *q, const cgt_objects *objects, uint32_t k, uint32_t count,
                                    uint32_t asked)
{
    const uint32_t ask = k + WAITING_AHEAD < count ? k + WAITING_AHEAD : count;
    if (objects->arrays == 1 && objects->count >= WAITING_TRIANGLES && objects->array->index && ask > asked)
        fetch_triangles_ask(objects->array, q->reference + asked, ask - asked);
    return ask;
}

/* Takes the first `count` away; what is left over moves up. */
CGT_SPU_INLINE void waiting_remove(waiting *q, uint32_t count)
{
    q->count -= count;
    memmove(q->reference, q->reference + count, q->count * sizeof *q->reference);
}

/* ---- runs of references, each to its own list ---- */

typedef struct waiting_lists {
    waiting spheres, triangles, clusters;
} waiting_lists;

CGT_SPU_INLINE void waiting_clear(waiting_lists *q) { q->spheres.count = q->triangles.count = q->clusters.count = 0; }

/* Takes the first `count` references of a list of the owner's. */
typedef void waiting_take(void *owner, uint32_t count);

/* Functions of a list's owner: constants where runs are added. */
typedef struct waiting_takers {
    waiting_take *spheres, *triangles, *clusters;
} waiting_takers;

CGT_SPU_INLINE void waiting_feed(waiting *q, const cgt_world *world, const uint32_t *reference, uint32_t count,
                                 waiting_add *add, waiting_take *take, void *owner)
{
    while (count) {
        const uint32_t some = add(q, world, reference, count);
        reference += some;
        count -= some;
        if (q->count == WAITING)
            take(owner, WAITING / 2);
    }
}

/* Adds a run of what a loose grid refers to; takes half of a list when it is full. */
CGT_SPU_INLINE void waiting_run(waiting_lists *q, const cgt_world *world, const uint32_t *reference, uint32_t count,
                                waiting_takers take, void *owner)
{
    const cgt_objects *o = &world->objects;
    if (world->cluster)
        waiting_feed(&q->clusters, world, reference, count, waiting_add_clusters, take.clusters, owner);
    else if (!o->triangles)
        waiting_feed(&q->spheres, world, reference, count, waiting_add_spheres, take.spheres, owner);
    else if (!o->spheres)
        waiting_feed(&q->triangles, world, reference, count, waiting_add_triangles, take.triangles, owner);
    else
        for (uint32_t k = 0; k < count; k++)
            if (cgt_objects_array(o, reference[k])->kind == CGT_KIND_SPHERES)
                waiting_feed(&q->spheres, world, reference + k, 1, waiting_add_spheres, take.spheres, owner);
            else
                waiting_feed(&q->triangles, world, reference + k, 1, waiting_add_triangles, take.triangles, owner);
}

#endif
