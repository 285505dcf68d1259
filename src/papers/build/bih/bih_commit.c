/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The bounding interval hierarchy of a commit. */
#include "papers/build/bih/bih_build.h"
#include "builders/report.h"
#include "papers/build/papers_build.h"

static void report(cgt_scene *scene)
{
    const cgt_bih *tree = &scene->committed_scene.papers->bih;
    cgt_research_scene_statistics *research = &scene->research_statistics;
    research->bih_nodes = tree->nodes;
    research->bih_leaves = tree->leaves;
    research->bih_depth = tree->depth;
    research->bih_largest_leaf = tree->largest_leaf;
    research->references = scene->committed_scene.valid;
    research->reference_bits = 32;
    scene->statistics.structure_bytes =
        tree->nodes * sizeof(cgt_bih_node) + (size_t)tree->references * sizeof(uint32_t);
    cgt_report_local_store(scene, sizeof(cgt_sphere), sizeof(cgt_leaf_triangle));
}

cgt_result cgt_bih_commit(cgt_scene *scene)
{
    const cgt_bih_memory memory = {&scene->buffer[CGT_BUFFER_BIH_NODES], &scene->buffer[CGT_BUFFER_BIH_REFERENCES],
                                   &scene->buffer[CGT_BUFFER_BIH_WORK]};
    cgt_result result =
        cgt_bih_build(scene->context, &memory, &scene->committed_scene, &scene->committed_scene.papers->bih);
    if (result == CGT_OK && scene->committed_scene.prims.triangles)
        result =
            cgt_leaf_triangles_init(scene->context, &scene->buffer[CGT_BUFFER_LEAF_TRIANGLES], &scene->committed_scene);
    if (result == CGT_OK)
        report(scene);
    return result;
}
