/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The kd-tree of a commit: built, flattened, and linked where ropes are requested. */
#include <stdio.h>

#include "builders/report.h"
#include "papers/build/papers_build.h"
#include "papers/build/kd/kd_build.h"

#define DEFAULT_BREAK_LEVEL 8u
_Static_assert(CGT_MAX_BREAK_LEVEL == CGT_KD_MAX_DEPTH, "the limit of the option is that of trees");

/* Counts the references in all leaves, including those that hold their only primitive in the node; and in the
 * largest. */
static void count_references(const cgt_kd_tree *tree, cgt_research_scene_statistics *research)
{
    for (uint32_t i = 0; i < tree->nodes; i++) {
        const cgt_kd_node n = tree->node[i];
        if (i == 1 || !cgt_kd_is_leaf(n))
            continue;
        research->references += cgt_kd_count(n);
        if (cgt_kd_count(n) > research->kd_largest_leaf)
            research->kd_largest_leaf = cgt_kd_count(n);
    }
}

static void report(cgt_scene *scene, const cgt_kd_raw *raw)
{
    cgt_scene_statistics *st = &scene->statistics;
    cgt_research_scene_statistics *research = &scene->research_statistics;
    const cgt_committed_scene *committed_scene = &scene->committed_scene;
    const cgt_kd_tree *tree = &committed_scene->papers->kd;
    research->kd_nodes = tree->nodes - (tree->nodes > 1); /* without the one that is not used */
    research->kd_leaves = tree->leaves;
    research->kd_empty_leaves = tree->empty_leaves;
    research->kd_depth = tree->depth;
    count_references(tree, research);
    research->kd_cost = raw->cost;
    research->reference_bits = 32;
    st->structure_bytes = tree->nodes * sizeof(cgt_kd_node) + (size_t)tree->references * sizeof(uint32_t) +
                          (tree->leaf ? tree->leaves * sizeof(cgt_kd_leaf) : 0);
    cgt_report_local_store(scene, sizeof(cgt_sphere), sizeof(cgt_leaf_triangle));
}

cgt_result cgt_kd_commit(cgt_scene *scene, bool ropes)
{
    const cgt_research_scene_options *o = scene->options.research;
    const cgt_kd_memory memory = {&scene->buffer[CGT_BUFFER_KD_NODES], &scene->buffer[CGT_BUFFER_KD_REFERENCES],
                                  &scene->buffer[CGT_BUFFER_KD_LEAVES]};
    cgt_research_scene_statistics *research = &scene->research_statistics;
    cgt_kd_raw raw;
    research->kd_layout = o->kd_layout == CGT_KD_LAYOUT_AUTO ? CGT_KD_LAYOUT_DEPTH_FIRST : o->kd_layout;
    cgt_result result = cgt_kd_build(scene->context, &scene->buffer[CGT_BUFFER_KD_WORK], &scene->committed_scene,
                                     &cgt_kd_default_costs, &raw);
    if (result == CGT_OK)
        result = cgt_kd_flatten(scene->context, &memory, &raw, research->kd_layout,
                                o->kd_break_level ? o->kd_break_level : DEFAULT_BREAK_LEVEL, ropes,
                                &scene->committed_scene.papers->kd);
    if (result == CGT_OK && scene->committed_scene.prims.triangles)
        result =
            cgt_leaf_triangles_init(scene->context, &scene->buffer[CGT_BUFFER_LEAF_TRIANGLES], &scene->committed_scene);
    if (result == CGT_OK)
        report(scene, &raw);
    return result;
}
