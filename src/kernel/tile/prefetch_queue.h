/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * References of a loose grid's cells, queued until the memory behind them has come to the cache: each is prefetched
 * when it is appended, and tested some hundred references later. Where there are several arrays, runs of one come
 * together.
 *
 *   cells -> clusters -> triangles -> test       a scene with clusters: their boxes are tested first
 *         -> each kind             -> test       others, each kind in a queue of its own */
#ifndef CGT_PREFETCH_QUEUE_H
#define CGT_PREFETCH_QUEUE_H

#include "kernel/primitive/gather_primitives.h"

#define PREFETCH_QUEUE_CAPACITY 256u
#define PREFETCH_QUEUE_AHEAD 64u /* triangles whose vertices are prefetched before their test */

/* Indices and vertices of fewer triangles are mostly in a cache anyway, and are not prefetched. */
#define PREFETCH_QUEUE_MIN_TRIANGLES 131072u

typedef struct prefetch_queue {
    uint32_t reference[PREFETCH_QUEUE_CAPACITY + 1];
    uint32_t count;
} prefetch_queue;

/* ---- appending ---- */

/* Appends references to an array while there is room, and prefetches what they refer to. Returns how many were
 * appended. */
typedef uint32_t prefetch_append_fn(prefetch_queue *q, const cgt_committed_scene *committed_scene,
                                    const cgt_primitive_array *a, const uint32_t *reference, uint32_t count);

CGT_SPU_INLINE uint32_t prefetch_append_spheres(prefetch_queue *q, const cgt_committed_scene *committed_scene,
                                                const cgt_primitive_array *a, const uint32_t *reference, uint32_t count)
{
    (void)committed_scene;
    const uint32_t room = PREFETCH_QUEUE_CAPACITY - q->count, added = count < room ? count : room;
    uint32_t *tail = q->reference + q->count;
    for (uint32_t k = 0; k < added; k++) {
        tail[k] = reference[k];
        __builtin_prefetch(cgt_array_point(a, reference[k] - a->first));
    }
    q->count += added;
    return added;
}

/* Prefetches both ends, which the indices, read here, tell. */
CGT_SPU_INLINE uint32_t prefetch_append_capsules(prefetch_queue *q, const cgt_committed_scene *committed_scene,
                                                 const cgt_primitive_array *a, const uint32_t *reference,
                                                 uint32_t count)
{
    (void)committed_scene;
    const uint32_t room = PREFETCH_QUEUE_CAPACITY - q->count, added = count < room ? count : room;
    uint32_t *tail = q->reference + q->count;
    for (uint32_t k = 0; k < added; k++) {
        uint32_t end[2];
        tail[k] = reference[k];
        cgt_array_ends(a, reference[k] - a->first, end);
        __builtin_prefetch(cgt_array_point(a, end[0]));
        __builtin_prefetch(cgt_array_point(a, end[1]));
    }
    q->count += added;
    return added;
}

/* Prefetches the triangles' indices. */
CGT_SPU_INLINE uint32_t prefetch_append_triangles(prefetch_queue *q, const cgt_committed_scene *committed_scene,
                                                  const cgt_primitive_array *a, const uint32_t *reference,
                                                  uint32_t count)
{
    const cgt_primitives *prims = &committed_scene->prims;
    const char *index = prims->count >= PREFETCH_QUEUE_MIN_TRIANGLES ? a->index : NULL;
    const uint32_t room = PREFETCH_QUEUE_CAPACITY - q->count, added = count < room ? count : room;
    uint32_t *tail = q->reference + q->count;
    for (uint32_t k = 0; k < added; k++) {
        tail[k] = reference[k];
        if (index)
            __builtin_prefetch(index + (size_t)(reference[k] - a->first) * a->index_stride);
    }
    q->count += added;
    return added;
}

CGT_SPU_INLINE uint32_t prefetch_append_clusters(prefetch_queue *q, const cgt_committed_scene *committed_scene,
                                                 const cgt_primitive_array *a, const uint32_t *reference,
                                                 uint32_t count)
{
    (void)a;
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

/* Appends the valid triangles of a cluster, for which there must be room, and prefetches their indices. */
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
        q->reference[q->count] = first + k; /* the next one overwrites it where it is not valid */
        q->count += valid >> k & 1;
    }
}

/* Prefetches the vertices of the queue's triangles up to PREFETCH_QUEUE_AHEAD after number k, among the first `count`,
 * except for the first `prefetched`. Returns how many of the first ones are prefetched now. */
CGT_SPU_INLINE uint32_t prefetch_queue_vertices(const prefetch_queue *q, const cgt_primitives *prims, uint32_t k,
                                                uint32_t count, uint32_t prefetched)
{
    const uint32_t end = k + PREFETCH_QUEUE_AHEAD < count ? k + PREFETCH_QUEUE_AHEAD : count;
    if (prims->arrays == 1 && prims->count >= PREFETCH_QUEUE_MIN_TRIANGLES && prims->array->index && end > prefetched)
        prefetch_triangles(prims->array, q->reference + prefetched, end - prefetched);
    return end;
}

/* Removes the first `count` references; the rest moves up. */
CGT_SPU_INLINE void prefetch_queue_remove(prefetch_queue *q, uint32_t count)
{
    q->count -= count;
    memmove(q->reference, q->reference + count, q->count * sizeof *q->reference);
}

/* ---- draining ---- */

/* What the owner of queues does with references. */
typedef struct prefetch_tests {
    uint32_t sphere_batch;                                                        /* spheres of one call */
    void (*spheres)(void *owner, const uint32_t *reference, uint32_t count);      /* tests them */
    void (*triangles)(void *owner, const uint32_t *reference, uint32_t count);    /* tests at most a vector */
    unsigned (*clusters)(void *owner, const uint32_t *reference, uint32_t count); /* of at most a vector: those whose
                                                                                     boxes are visible, as bits */
    bool (*is_done)(const void *owner);                                           /* whether the rest may be dropped */
    void (*capsules)(void *owner, const uint32_t *reference, uint32_t count);     /* as triangles */
    void (*order_capsules)(void *owner, uint32_t *reference, uint32_t count);     /* before a batch; NULL: as it is */
} prefetch_tests;

typedef struct prefetch_queues {
    prefetch_queue spheres, triangles, capsules, clusters;
} prefetch_queues;

/* Whose queues they are. */
typedef struct prefetch_owner {
    const cgt_committed_scene *committed_scene;
    prefetch_queues *pending;
    void *owner;
} prefetch_owner;

CGT_SPU_INLINE void prefetch_queues_clear(prefetch_queues *q)
{
    q->spheres.count = q->triangles.count = q->capsules.count = q->clusters.count = 0;
}

/* Tests the first `count` references of a queue and removes them. `tests` is the same constant in every call of a file:
 * compilers make copies of these functions with direct calls. */
typedef void prefetch_drain_fn(const prefetch_owner *o, const prefetch_tests *tests, uint32_t count);

__attribute__((unused)) static void prefetch_drain_spheres(const prefetch_owner *o, const prefetch_tests *tests,
                                                           uint32_t count)
{
    prefetch_queue *q = &o->pending->spheres;
    const uint32_t batch = tests->sphere_batch;
    for (uint32_t k = 0; k < count && !tests->is_done(o->owner); k += batch)
        tests->spheres(o->owner, q->reference + k, count - k < batch ? count - k : batch);
    prefetch_queue_remove(q, count);
}

__attribute__((unused)) static void prefetch_drain_triangles(const prefetch_owner *o, const prefetch_tests *tests,
                                                             uint32_t count)
{
    prefetch_queue *q = &o->pending->triangles;
    uint32_t prefetched = 0;
    for (uint32_t k = 0; k < count && !tests->is_done(o->owner); k += CGT_LANES) {
        prefetched = prefetch_queue_vertices(q, &o->committed_scene->prims, k, count, prefetched);
        tests->triangles(o->owner, q->reference + k, count - k < CGT_LANES ? count - k : CGT_LANES);
    }
    prefetch_queue_remove(q, count);
}

__attribute__((unused)) static void prefetch_drain_capsules(const prefetch_owner *o, const prefetch_tests *tests,
                                                            uint32_t count)
{
    prefetch_queue *q = &o->pending->capsules;
    if (tests->order_capsules)
        tests->order_capsules(o->owner, q->reference, count);
    for (uint32_t k = 0; k < count && !tests->is_done(o->owner); k += CGT_LANES)
        tests->capsules(o->owner, q->reference + k, count - k < CGT_LANES ? count - k : CGT_LANES);
    prefetch_queue_remove(q, count);
}

/* Queues the triangles of visible clusters. */
__attribute__((unused)) static void prefetch_drain_clusters(const prefetch_owner *o, const prefetch_tests *tests,
                                                            uint32_t count)
{
    const cgt_cluster *cluster = o->committed_scene->cluster;
    prefetch_queue *q = &o->pending->clusters, *triangles = &o->pending->triangles;
    for (uint32_t k = 0; k < count && !tests->is_done(o->owner); k += CGT_LANES) {
        const uint32_t lanes = count - k < CGT_LANES ? count - k : CGT_LANES;
        for (unsigned left = tests->clusters(o->owner, q->reference + k, lanes); left; left &= left - 1) {
            const uint32_t number = q->reference[k + (uint32_t)__builtin_ctz(left)];
            if (triangles->count > PREFETCH_QUEUE_CAPACITY - CGT_CLUSTER)
                prefetch_drain_triangles(o, tests, PREFETCH_QUEUE_CAPACITY / 2);
            prefetch_append_members(triangles, &o->committed_scene->prims, number, cluster[number].valid);
        }
    }
    prefetch_queue_remove(q, count);
}

/* Drains all queues. */
CGT_SPU_INLINE void prefetch_drain_all(const prefetch_owner *o, const prefetch_tests *tests)
{
    prefetch_drain_clusters(o, tests, o->pending->clusters.count);
    prefetch_drain_spheres(o, tests, o->pending->spheres.count);
    prefetch_drain_triangles(o, tests, o->pending->triangles.count);
    if (o->pending->capsules.count)
        prefetch_drain_capsules(o, tests, o->pending->capsules.count);
}

/* ---- runs of references ---- */

CGT_SPU_INLINE void prefetch_append_and_drain(const prefetch_owner *o, const prefetch_tests *tests, prefetch_queue *q,
                                              const cgt_primitive_array *a, const uint32_t *reference, uint32_t count,
                                              prefetch_append_fn *append, prefetch_drain_fn *drain)
{
    while (count) {
        const uint32_t appended = append(q, o->committed_scene, a, reference, count);
        reference += appended;
        count -= appended;
        if (q->count == PREFETCH_QUEUE_CAPACITY)
            drain(o, tests, PREFETCH_QUEUE_CAPACITY / 2);
    }
}

/* The number of references, from the first on, to one array. */
CGT_SPU_INLINE uint32_t prefetch_array_run(const cgt_primitive_array *a, const uint32_t *reference, uint32_t count)
{
    uint32_t run = 1;
    while (run < count && reference[run] - a->first < a->count)
        run++;
    return run;
}

/* Appends a run of a loose grid's references, each to the queue of its kind; drains half of a queue when it is full. */
CGT_SPU_INLINE void prefetch_append_run(const prefetch_owner *o, const prefetch_tests *tests, const uint32_t *reference,
                                        uint32_t count)
{
    const cgt_primitives *prims = &o->committed_scene->prims;
    const cgt_primitive_array *a = prims->array;
    prefetch_queues *q = o->pending;
    if (o->committed_scene->cluster) {
        prefetch_append_and_drain(o, tests, &q->clusters, a, reference, count, prefetch_append_clusters,
                                  prefetch_drain_clusters);
        return;
    }
    for (uint32_t k = 0, run; k < count; k += run) {
        run = count - k;
        if (prims->arrays > 1) {
            a = reference[k] - a->first < a->count ? a : cgt_primitives_array(prims, reference[k]);
            run = prefetch_array_run(a, reference + k, run);
        }
        if (a->kind == CGT_KIND_SPHERES)
            prefetch_append_and_drain(o, tests, &q->spheres, a, reference + k, run, prefetch_append_spheres,
                                      prefetch_drain_spheres);
        else if (a->kind == CGT_KIND_TRIANGLES)
            prefetch_append_and_drain(o, tests, &q->triangles, a, reference + k, run, prefetch_append_triangles,
                                      prefetch_drain_triangles);
        else
            prefetch_append_and_drain(o, tests, &q->capsules, a, reference + k, run, prefetch_append_capsules,
                                      prefetch_drain_capsules);
    }
}

#endif
