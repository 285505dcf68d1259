/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A commit for a structure of the papers. */
#include "builders/commit.h"
#include "papers/build/papers_build.h"

cgt_result cgt_papers_commit(cgt_scene *scene, const cgt_primitive_bounds *bounds)
{
    cgt_buffer *memory = &scene->buffer[CGT_BUFFER_PAPERS];
    const cgt_result result = cgt_buffer_reserve(&scene->context->memory, memory, 1, sizeof(cgt_paper_structures));
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory");
    cgt_paper_structures *papers = memory->data;
    *papers = (cgt_paper_structures){0};
    scene->committed_scene.papers = papers;
    switch ((int)scene->committed_scene.structure) {
    case CGT_STRUCTURE_QUEUE_GRID: return cgt_queue_grid_commit(scene, bounds);
    case CGT_STRUCTURE_BIH: return cgt_bih_commit(scene);
    default: return cgt_kd_commit(scene, scene->committed_scene.structure == CGT_STRUCTURE_KD_ROPES);
    }
}
