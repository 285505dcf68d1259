/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * References that wait until what they stand for has come to the cache. */
#ifndef CGT_WAITING_H
#define CGT_WAITING_H

#include "kernel/primitive/gather_primitives.h"

#define PREFETCH_QUEUE_CAPACITY 256u
#define PREFETCH_QUEUE_AHEAD 64u /* whose vertices are on their way */

/* Indices and vertices of fewer triangles are mostly in a cache as they are, and are not asked for. */
#define PREFETCH_QUEUE_MIN_TRIANGLES 131072u

typedef struct prefetch_queue {
    uint32_t reference[PREFETCH_QUEUE_CAPACITY + 1];
    uint32_t count;
} prefetch_queue;

/* Adds references while there is room, and asks for what they stand for. Returns how many were added. */
typedef uint32_t prefetch_append_fn(prefetch_queue *q, const cgt_committed_scene *committed_scene,
                                    const uint32_t *reference, uint32_t count);

/* References of spheres. */
CGT_SPU_INLINE uint32_t prefetch_append_spheres(prefetch_queue *q, const cgt_committed_scene *committed_scene,
                                                const uint32_t *reference, uint32_t count)
{
    const cgt_primitives *prims = &committed_scene->prims;
    const bool single_array = prims->arrays == 1;
    const uint32_t room = PREFETCH_QUEUE_CAPACITY - q->count, added = count < room ? count : room;
    uint32_t *tail = q->reference + q->count;
    for (uint32_t k = 0; k < added; k++) {
        tail[k] = reference[k];
        if (single_array)
            __builtin_prefetch(cgt_array_point(prims->array, reference[k]));
    }
    q->count += added;
    return added;
}

/* Of triangles, whose indices are asked for. */
CGT_SPU_INLINE uint32_t prefetch_append_triangles(prefetch_queue *q, const cgt_committed_scene *committed_scene,
                                                  const uint32_t *reference, uint32_t count)
{
    const cgt_primitives *prims = &committed_scene->prims;
    const cgt_primitive_array *a = prims->array;
    const char *index = prims->arrays == 1 && prims->count >= PREFETCH_QUEUE_MIN_TRIANGLES ? a->index : NULL;
    const uint32_t room = PREFETCH_QUEUE_CAPACITY - q->count, added = count < room ? count : room;
    uint32_t *tail = q->reference + q->count;
    for (uint32_t k = 0; k < added; k++) {
        tail[k] = reference[k];
        if (index)
            __builtin_prefetch(index + (size_t)reference[k] * a->index_stride);
    }
    q->count += added;
    return added;
}

/* Of clusters. */
CGT_SPU_INLINE uint32_t prefetch_append_clusters(prefetch_queue *q, const cgt_committed_scene *committed_scene,
                                                 const uint32_t *reference, uint32_t count)
{
    const cgt_cluster *cluster = committed_scene->cluster;
    const uint32_t room = PREFETCH_QUEUE_CAPACITY - q->count, added = count < room ? count : room;
    uint32_t *tail = q->reference + q->count;
    for (uint32_t k = 0; k < added; k++) {
        tail[k] = reference[k];
        __builtin_prefetch(&cluster[reference[k]]);
    }
    q->count += added;
    return added;
}

/* Adds the triangles of a cluster, for which there must be room, and asks for their indices. */
CGT_SPU_INLINE void prefetch_append_members(prefetch_queue *q, const cgt_primitives *prims, uint32_t number,
                                            uint32_t valid)
{
    const cgt_primitive_array *a = prims->array;
    const uint32_t first = number * CGT_CLUSTER;
    if (prims->arrays == 1 && a->index) {
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

/* Asks for the vertices of triangles up to PREFETCH_QUEUE_AHEAD after reference k, of the first `count`, from `asked` on. Returns
 * up to which they are asked for now. */
CGT_SPU_INLINE uint32_t prefetch_queue_vertices(const prefetch_queue *q, const cgt_primitives *prims, uint32_t k,
                                                uint32_t count, uint32_t prefetched)
{
    const uint32_t end = k + PREFETCH_QUEUE_AHEAD < count ? k + PREFETCH_QUEUE_AHEAD : count;
    if (prims->arrays == 1 && prims->count >= PREFETCH_QUEUE_MIN_TRIANGLES && prims->array->index && end > prefetched)
        prefetch_triangles(prims->array, q->reference + prefetched, end - prefetched);
    return end;
}

/* Takes the first `count` away; what is left over moves up. */
CGT_SPU_INLINE void prefetch_queue_remove(prefetch_queue *q, uint32_t count)
{
    q->count -= count;
    memmove(q->reference, q->reference + count, q->count * sizeof *q->reference);
}

/* ---- runs of references, each to its own list ---- */

typedef struct prefetch_queues {
    prefetch_queue spheres, triangles, clusters;
} prefetch_queues;

CGT_SPU_INLINE void prefetch_queues_clear(prefetch_queues *q)
{
    q->spheres.count = q->triangles.count = q->clusters.count = 0;
}

/* Takes the first `count` references of a list of the owner's. */
typedef void prefetch_drain_fn(void *owner, uint32_t count);

/* Functions of a list's owner: constants where runs are added. */
typedef struct prefetch_drain_fns {
    prefetch_drain_fn *spheres, *triangles, *clusters;
} prefetch_drain_fns;

CGT_SPU_INLINE void prefetch_append_and_drain(prefetch_queue *q, const cgt_committed_scene *committed_scene,
                                              const uint32_t *reference, uint32_t count, prefetch_append_fn *add,
                                              prefetch_drain_fn *drain, void *owner)
{
    while (count) {
        const uint32_t added = add(q, committed_scene, reference, count);
        reference += added;
        count -= added;
        if (q->count == PREFETCH_QUEUE_CAPACITY)
            drain(owner, PREFETCH_QUEUE_CAPACITY / 2);
    }
}

/* Adds a run of what a loose grid refers to; takes half of a list when it is full. */
CGT_SPU_INLINE void prefetch_append_run(prefetch_queues *q, const cgt_committed_scene *committed_scene,
                                        const uint32_t *reference, uint32_t count, prefetch_drain_fns drain,
                                        void *owner)
{
    const cgt_primitives *o = &committed_scene->prims;
    if (committed_scene->cluster)
        prefetch_append_and_drain(&q->clusters, committed_scene, reference, count, prefetch_append_clusters,
                                  drain.clusters, owner);
    else if (!o->triangles)
        prefetch_append_and_drain(&q->spheres, committed_scene, reference, count, prefetch_append_spheres,
                                  drain.spheres, owner);
    else if (!o->spheres)
        prefetch_append_and_drain(&q->triangles, committed_scene, reference, count, prefetch_append_triangles,
                                  drain.triangles, owner);
    else
        for (uint32_t k = 0; k < count; k++)
            if (cgt_primitives_array(o, reference[k])->kind == CGT_KIND_SPHERES)
                prefetch_append_and_drain(&q->spheres, committed_scene, reference + k, 1, prefetch_append_spheres,
                                          drain.spheres, owner);
            else
                prefetch_append_and_drain(&q->triangles, committed_scene, reference + k, 1, prefetch_append_triangles,
                                          drain.triangles, owner);
}

#endif
