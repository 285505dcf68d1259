/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * References that wait until what they stand for has come to the cache. */
#ifndef CGT_WAITING_H
#define CGT_WAITING_H

#include "object_fetch.h"

#define WAITING 256u
#define WAITING_AHEAD 64u /* whose vertices are on their way */

typedef struct waiting {
    uint32_t reference[WAITING + 1];
    uint32_t count;
} waiting;

/* Adds references of spheres while there is room, and asks for those. Returns how many were added. */
CGT_SPU_INLINE uint32_t waiting_add_spheres(waiting *q, const cgt_objects *objects, const uint32_t *reference,
                                            uint32_t count)
{
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

/* The same with triangles, whose indices are asked for. */
CGT_SPU_INLINE uint32_t waiting_add_triangles(waiting *q, const cgt_objects *objects, const uint32_t *reference,
                                              uint32_t count)
{
    const cgt_object_array *a = objects->array;
    const char *index = objects->arrays == 1 ? a->index : NULL;
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

/* Adds clusters while there is room, and asks for those. */
CGT_SPU_INLINE uint32_t waiting_add_clusters(waiting *q, const cgt_cluster *cluster, const uint32_t *reference,
                                             uint32_t count)
{
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
    if (objects->arrays == 1 && objects->array->index && ask > asked)
        fetch_triangles_ask(objects->array, q->reference + asked, ask - asked);
    return ask;
}

/* Takes the first `count` away; what is left over moves up. */
CGT_SPU_INLINE void waiting_remove(waiting *q, uint32_t count)
{
    q->count -= count;
    memmove(q->reference, q->reference + count, q->count * sizeof *q->reference);
}

#endif
