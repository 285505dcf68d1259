/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Collects the items of a tree, chunk by chunk: valid primitives are counted first, where some are not. */
#include "papers/build/tree_items.h"

#include <stdatomic.h>

#include "exact/valid_primitive.h"

#define PRIMS_PER_CHUNK 8192u

typedef struct items_job {
    const cgt_committed_scene *scene;
    bool all; /* primitives are valid */
    uint32_t *number;
    cgt_tree_store_fn *store;
    void *of;
    atomic_bool changed;
} items_job;

uint32_t cgt_tree_chunks(const cgt_primitives *prims)
{
    return (uint32_t)(((uint64_t)prims->count + PRIMS_PER_CHUNK - 1) / PRIMS_PER_CHUNK);
}

static uint32_t chunk_end(const items_job *j, uint32_t first)
{
    const uint32_t count = j->scene->prims.count;
    return count - first < PRIMS_PER_CHUNK ? count : first + PRIMS_PER_CHUNK;
}

static void count_chunk(void *argument, uint32_t index)
{
    const items_job *j = argument;
    const uint32_t first = index * PRIMS_PER_CHUNK, end = chunk_end(j, first);
    uint32_t count = 0;
    for (uint32_t prim = first; prim < end; prim++) {
        const cgt_primitive primitive = cgt_primitives_get(&j->scene->prims, prim);
        count += cgt_primitive_check(&primitive) == CGT_PRIMITIVE_VALID;
    }
    j->number[index] = count;
}

/* Whether a primitive is within the bounds of all; a NaN is not. Bounds are floats: rounding does not pass them. */
static bool lies_within(const cgt_committed_scene *s, const cgt_primitive *p)
{
    const bool is_sphere = p->kind == CGT_KIND_SPHERES;
    const double center[3] = {p->sphere.x, p->sphere.y, p->sphere.z}, r = p->sphere.r;
    for (int a = 0; a < 3; a++)
        for (int k = 0; k < (is_sphere ? 1 : 3); k++) {
            const double low = is_sphere ? center[a] - r : (double)p->triangle.v[k][a];
            const double high = is_sphere ? center[a] + r : (double)p->triangle.v[k][a];
            if (!(low >= (double)s->low[a] && high <= (double)s->high[a]))
                return false;
        }
    return true;
}

static void collect_chunk(void *argument, uint32_t index)
{
    items_job *j = argument;
    const cgt_primitives *prims = &j->scene->prims;
    const uint32_t first = index * PRIMS_PER_CHUNK, end = chunk_end(j, first);
    const cgt_primitive_array *a = cgt_primitives_array(prims, first);
    uint32_t place = j->all ? first : j->number[index];
    const uint32_t stop = j->all ? end : end < prims->count ? j->number[index + 1] : j->scene->valid;
    bool same = true;
    for (uint32_t prim = first; prim < end; prim++) {
        while (prim - a->first >= a->count)
            a++;
        const cgt_primitive primitive = cgt_array_primitive(a, prim - a->first);
        if (!j->all && cgt_primitive_check(&primitive) != CGT_PRIMITIVE_VALID)
            continue;
        same = same && place < stop && lies_within(j->scene, &primitive);
        if (same)
            j->store(j->of, place++, prim, &primitive);
    }
    if (!same || place < stop)
        atomic_store_explicit(&j->changed, true, memory_order_relaxed);
}

void *cgt_tree_carve(char *block, size_t *used_bytes, size_t bytes)
{
    void *part = block ? block + *used_bytes : NULL;
    *used_bytes += (bytes + CGT_ALIGNMENT - 1) / CGT_ALIGNMENT * CGT_ALIGNMENT;
    return part;
}

cgt_result cgt_tree_collect(cgt_context *context, const cgt_committed_scene *scene, uint32_t *number,
                            cgt_tree_store_fn *store, void *of)
{
    items_job j = {
        .scene = scene, .all = scene->valid == scene->prims.count, .number = number, .store = store, .of = of};
    const uint32_t chunks = cgt_tree_chunks(&scene->prims);
    uint32_t sum = 0;
    if (!j.all)
        cgt_run_tasks(context, count_chunk, &j, chunks);
    for (uint32_t i = 0; !j.all && i < chunks; i++) {
        const uint32_t count = number[i];
        number[i] = sum;
        sum += count < scene->valid - sum ? count : scene->valid - sum;
    }
    cgt_run_tasks(context, collect_chunk, &j, chunks);
    if (!atomic_load_explicit(&j.changed, memory_order_relaxed))
        return CGT_OK;
    return cgt_fail(context, CGT_ERROR_INVALID_ARGUMENT, "commit: arrays change while it reads them");
}
