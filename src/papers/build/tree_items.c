/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Collects the items of a tree, chunk by chunk: valid primitives are counted first, where some are not. */
#include "papers/build/tree_items.h"

#include "exact/valid_primitive.h"

#define PRIMS_PER_CHUNK 8192u

typedef struct items_job {
    const cgt_primitives *prims;
    bool all; /* primitives are valid */
    uint32_t *number;
    cgt_tree_store_fn *store;
    void *of;
} items_job;

uint32_t cgt_tree_chunks(const cgt_primitives *prims)
{
    return (uint32_t)(((uint64_t)prims->count + PRIMS_PER_CHUNK - 1) / PRIMS_PER_CHUNK);
}

void *cgt_tree_carve(char *block, size_t *used_bytes, size_t bytes)
{
    void *part = block ? block + *used_bytes : NULL;
    *used_bytes += (bytes + CGT_ALIGNMENT - 1) / CGT_ALIGNMENT * CGT_ALIGNMENT;
    return part;
}

static uint32_t chunk_end(const items_job *j, uint32_t first)
{
    return j->prims->count - first < PRIMS_PER_CHUNK ? j->prims->count : first + PRIMS_PER_CHUNK;
}

static void count_chunk(void *argument, uint32_t index)
{
    const items_job *j = argument;
    const uint32_t first = index * PRIMS_PER_CHUNK, end = chunk_end(j, first);
    uint32_t count = 0;
    for (uint32_t prim = first; prim < end; prim++) {
        const cgt_primitive primitive = cgt_primitives_get(j->prims, prim);
        count += cgt_primitive_check(&primitive) == CGT_PRIMITIVE_VALID;
    }
    j->number[index] = count;
}

static void collect_chunk(void *argument, uint32_t index)
{
    const items_job *j = argument;
    const uint32_t first = index * PRIMS_PER_CHUNK, end = chunk_end(j, first);
    const cgt_primitive_array *a = cgt_primitives_array(j->prims, first);
    uint32_t place = j->all ? first : j->number[index];
    for (uint32_t prim = first; prim < end; prim++) {
        while (prim - a->first >= a->count)
            a++;
        const cgt_primitive primitive = cgt_array_primitive(a, prim - a->first);
        if (j->all || cgt_primitive_check(&primitive) == CGT_PRIMITIVE_VALID)
            j->store(j->of, place++, prim, &primitive);
    }
}

void cgt_tree_collect(const cgt_context *context, const cgt_primitives *prims, uint32_t valid, uint32_t *number,
                      cgt_tree_store_fn *store, void *of)
{
    items_job j = {.prims = prims, .all = valid == prims->count, .number = number, .store = store, .of = of};
    const uint32_t chunks = cgt_tree_chunks(prims);
    uint32_t sum = 0;
    if (!j.all)
        cgt_run_tasks(context, count_chunk, &j, chunks);
    for (uint32_t i = 0; !j.all && i < chunks; i++) {
        const uint32_t count = number[i];
        number[i] = sum;
        sum += count;
    }
    cgt_run_tasks(context, collect_chunk, &j, chunks);
}
