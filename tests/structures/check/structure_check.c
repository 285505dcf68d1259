/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A checker for each structure. */
#include "structures/check/structure_check.h"

#include <math.h>
#include <string.h>

#include "kd/random_tree.h"
#include "model/triangle_cluster.h"
#include "structures/check/bvh_check.h"
#include "structures/check/kd_check.h"
#include "structures/check/kd_touch.h"

static void expect_no_fault(const char *fault)
{
    if (fault)
        fail_msg("%s", fault);
}

/* ---- kd-trees ---- */

static double half_area(const kd_box *b)
{
    const double x = (double)b->high[0] - b->low[0], y = (double)b->high[1] - b->low[1],
                 z = (double)b->high[2] - b->low[2];
    return x * y + y * z + z * x;
}

/* Whether the bounds, as a builder rounds them to floats, touch the box. */
static bool bounds_touch(const cgt_primitives *prims, uint32_t prim, const kd_box *box)
{
    double low[3], high[3];
    bool touch = true;
    object_bounds(prims, prim, low, high);
    for (int a = 0; a < 3; a++)
        touch &=
            nextafterf((float)low[a], -INFINITY) <= box->high[a] && nextafterf((float)high[a], INFINITY) >= box->low[a];
    return touch;
}

/* What the surface-area heuristic says of a node and all below it, times the root's area. A builder's splits lie inside
 * of boxes, and its leaves list nothing that lies elsewhere. */
static double cost_below(const cgt_committed_scene *w, uint32_t node, const kd_box *box)
{
    const cgt_kd_tree *tree = &w->papers->kd;
    const cgt_kd_node n = tree->node[node];
    double cost = cgt_kd_default_costs.inner;
    if (cgt_kd_is_leaf(n)) {
        const uint32_t *prim = cgt_kd_references(tree, &tree->node[node]);
        cost = 0;
        for (uint32_t i = 0; i < cgt_kd_count(n); i++) {
            assert_true(bounds_touch(&w->prims, prim[i], box));
            cost += cgt_kd_default_costs.test[cgt_primitives_get(&w->prims, prim[i]).kind];
        }
        return cost * half_area(box);
    }
    const uint32_t axis = cgt_kd_axis(n);
    kd_box lower = *box, upper = *box;
    lower.high[axis] = upper.low[axis] = cgt_kd_split(n);
    assert_true(lower.high[axis] > box->low[axis] && upper.low[axis] < box->high[axis]);
    return cost * half_area(box) + cost_below(w, n.word[1], &lower) + cost_below(w, n.word[1] + 1, &upper);
}

static void check_kd(const cgt_scene *scene)
{
    const cgt_committed_scene *w = &scene->committed_scene;
    const cgt_kd_tree *tree = &w->papers->kd;
    const cgt_research_scene_statistics research = research_of(scene);
    kd_box root;
    expect_no_fault(kd_check(tree, w));
    memcpy(root.low, tree->low, sizeof root.low);
    memcpy(root.high, tree->high, sizeof root.high);
    const double area = half_area(&root), cost = cost_below(w, 0, &root);
    if (fabs(cost - research.kd_cost * area) > 1e-9 * cost)
        fail_msg("the cost is %.17g, not %.17g", cost / area, research.kd_cost);
    assert_true(tree->depth <= 8 + 1.3 * log2(w->valid));
    assert_true(!tree->leaf == (w->structure == CGT_STRUCTURE_KD));
    assert_int_equal(research.kd_nodes, tree->nodes - (tree->nodes > 1));
    assert_int_equal(research.kd_leaves, tree->leaves);
    assert_int_equal(research.kd_empty_leaves, tree->empty_leaves);
    assert_int_equal(research.kd_depth, tree->depth);
}

static bool same_kd(const cgt_kd_tree *a, const cgt_kd_tree *b)
{
    return a->nodes == b->nodes && a->references == b->references && a->leaves == b->leaves && !a->leaf == !b->leaf &&
           memcmp(a->node, b->node, a->nodes * sizeof *a->node) == 0 &&
           (!a->references || memcmp(a->reference, b->reference, a->references * sizeof *a->reference) == 0) &&
           (!a->leaf || memcmp(a->leaf, b->leaf, a->leaves * sizeof *a->leaf) == 0);
}

/* ---- other structures ---- */

static void check_bih(const cgt_scene *scene)
{
    const cgt_bih *tree = &scene->committed_scene.papers->bih;
    const cgt_research_scene_statistics research = research_of(scene);
    bih_check(tree, &scene->committed_scene);
    assert_int_equal(research.bih_nodes, tree->nodes);
    assert_int_equal(research.bih_leaves, tree->leaves);
    assert_int_equal(research.bih_depth, tree->depth);
    assert_int_equal(research.bih_largest_leaf, tree->largest_leaf);
}

static void check_bvh(const cgt_scene *scene)
{
    const cgt_bvh *tree = &scene->committed_scene.bvh;
    const cgt_research_scene_statistics research = research_of(scene);
    cgt_scene_statistics st;
    expect_no_fault(bvh_check(&scene->committed_scene));
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    assert_int_equal(research.bvh_nodes, tree->nodes);
    assert_int_equal(research.bvh_leaves, tree->sphere_blocks + tree->triangle_blocks + tree->capsule_blocks);
    assert_int_equal(research.bvh_depth, tree->depth);
    assert_true(st.bytes >= st.bvh_bytes && !st.bvh_bytes == !research.bvh_nodes);
}

static bool same_clusters(const cgt_committed_scene *a, const cgt_committed_scene *b)
{
    return !a->cluster == !b->cluster &&
           (!a->cluster || memcmp(a->cluster, b->cluster, cgt_clusters(a->prims.count) * sizeof *a->cluster) == 0);
}

static bool same_loose(const cgt_loose_grid *a, const cgt_loose_grid *b)
{
    return a->levels == b->levels && a->cells == b->cells &&
           memcmp(a->level, b->level, a->levels * sizeof a->level[0]) == 0 &&
           (!a->levels || (memcmp(a->start, b->start, (a->cells + (size_t)1) * sizeof a->start[0]) == 0 &&
                           memcmp(a->prim, b->prim, a->start[a->cells] * sizeof a->prim[0]) == 0));
}

static bool same_queue(const cgt_queue_grid *a, const cgt_queue_grid *b)
{
    return a->cells == b->cells && a->overflows == b->overflows && a->refs_are_32_bits == b->refs_are_32_bits &&
           memcmp(a->voxel, b->voxel, a->cells * cgt_queue_grid_voxel_bytes(a)) == 0 &&
           (!a->overflows || memcmp(a->overflow, b->overflow, a->overflows * sizeof *a->overflow) == 0);
}

/* ---- any structure ---- */

void structure_check(const cgt_scene *scene)
{
    cgt_scene_statistics st;
    uint64_t near;
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    assert_true(st.reason[0] && memchr(st.reason, 0, sizeof st.reason) && st.bytes >= st.structure_bytes);
    if (scene->committed_scene.structure == CGT_STRUCTURE_BVH || scene->committed_scene.bvh.node)
        check_bvh(scene);
    if (!scene->committed_scene.valid)
        return;
    assert_false(scene->committed_scene.brute_force);
    assert_int_equal(st.structure, scene->committed_scene.structure);
    switch ((int)scene->committed_scene.structure) {
    case CGT_STRUCTURE_LOOSE_GRID: loose_grid_check(scene); break;
    case CGT_STRUCTURE_QUEUE_GRID: queue_grid_check(scene, 1, &near); break;
    case CGT_STRUCTURE_KD:
    case CGT_STRUCTURE_KD_ROPES: check_kd(scene); break;
    case CGT_STRUCTURE_BIH: check_bih(scene); break;
    default: break;
    }
}

bool structure_same(const cgt_committed_scene *a, const cgt_committed_scene *b)
{
    if (a->valid != b->valid || !bvh_equal(&a->bvh, &b->bvh) || !same_clusters(a, b))
        return false;
    switch (a->valid ? (int)a->structure : CGT_STRUCTURE_AUTO) {
    case CGT_STRUCTURE_LOOSE_GRID: return same_loose(&a->loose, &b->loose);
    case CGT_STRUCTURE_QUEUE_GRID: return same_queue(&a->papers->grid, &b->papers->grid);
    case CGT_STRUCTURE_KD:
    case CGT_STRUCTURE_KD_ROPES: return same_kd(&a->papers->kd, &b->papers->kd);
    case CGT_STRUCTURE_BIH: return bih_same(&a->papers->bih, &b->papers->bih);
    default: return true;
    }
}
