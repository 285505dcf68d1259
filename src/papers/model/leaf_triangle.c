/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles prepared for the leaves of trees. */
#include "core/context.h"
#include "papers/model/paper_structures.h"

#define CHUNK 4096u /* primitives of one task */

typedef struct triangles_job {
    const cgt_primitives *prims;
    float scale;
    cgt_leaf_triangle *triangle;
} triangles_job;

static void prepare_chunk(void *argument, uint32_t index)
{
    const triangles_job *job = argument;
    const cgt_primitives *o = job->prims;
    const uint32_t first = index * CHUNK, end = o->count - first < CHUNK ? o->count : first + CHUNK;
    const cgt_primitive_array *a = cgt_primitives_array(o, first);
    for (uint32_t prim = first; prim < end; prim++) {
        if (prim - a->first == a->count)
            a++;
        if (a->kind != CGT_KIND_TRIANGLES)
            continue;
        const cgt_triangle q = cgt_array_triangle(a, prim - a->first);
        cgt_leaf_triangle_prepare(&q, job->scale, &job->triangle[cgt_array_boxed_number(a, prim)]);
    }
}

cgt_result cgt_leaf_triangles_init(cgt_context *context, cgt_buffer *memory, cgt_committed_scene *committed_scene)
{
    const cgt_primitives *o = &committed_scene->prims;
    const cgt_result result =
        cgt_buffer_reserve_scattered(&context->memory, memory, o->triangles, sizeof(cgt_leaf_triangle));
    if (result != CGT_OK)
        return cgt_fail(context, result, "commit: out of memory for %u triangles in leaves", o->triangles);
    triangles_job job = {.prims = o, .scale = committed_scene->scale, .triangle = memory->data};
    if (o->triangles)
        cgt_run_tasks(context, prepare_chunk, &job, (uint32_t)(((uint64_t)o->count + CHUNK - 1) / CHUNK));
    committed_scene->papers->triangle = memory->data;
    return CGT_OK;
}
