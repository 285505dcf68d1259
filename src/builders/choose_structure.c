/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Grid or tree. A loose grid is built in a hundredth of a kd-tree's time, and camera frames go through it several times
 * as fast. It takes a level for each class of sizes, so that a teapot in a stadium crowds no cells but its own. Rays
 * that run apart share no cells: they want a tree, and a wide one is built in a few times what the grid takes. Where a
 * scene is said to be traced by a camera, arrays of rays get theirs when they come (bvh_on_demand.h). */
#include "builders/choose_structure.h"

cgt_structure cgt_choose_structure(const cgt_scene_options *options, const char **reason)
{
    *reason = options->structure == CGT_STRUCTURE_BVH ? "wide tree: asked for" : "kd-tree: asked for";
    if (options->structure != CGT_STRUCTURE_AUTO)
        return options->structure;
    if (options->research->resolution[0]) /* who asks for cells asks for voxels */
        return CGT_STRUCTURE_QUEUE_GRID;
    *reason = "wide tree: incoherent rays share no cells of a grid";
    return options->rays == CGT_RAY_KIND_INCOHERENT ? CGT_STRUCTURE_BVH : CGT_STRUCTURE_LOOSE_GRID;
}
