/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The steps of a commit. Each fails with a message. */
#ifndef CGT_COMMIT_H
#define CGT_COMMIT_H

#include "scene/scene.h"

/* Reserves the float copies of the arrays that cannot be read in place, and makes the listed arrays point to them.
 * Their numbers are undefined until cgt_compute_bounds. */
cgt_result cgt_reserve_copies(cgt_scene *scene);

/* Reads, copies, checks and bounds all primitives, as the structure of scene->committed_scene needs. Fails where a
 * triangle's index is out of range. Loose grid and BVH get size classes and middles of triangles
 * (CGT_BUFFER_SIZE_CLASSES, CGT_BUFFER_CELL_SORT_WORK), or those of clusters (committed_scene->cluster); the queue grid
 * gets diameters. */
cgt_result cgt_compute_bounds(cgt_scene *scene, cgt_primitive_bounds *bounds);

/* Computes size classes and middles of triangles for a BVH after a commit that computed those of clusters. Rays may be
 * traced meanwhile. */
cgt_result cgt_compute_size_classes(cgt_scene *scene);

/* Build a structure over the valid primitives, of which there is at least one, and set the statistics of that
 * structure. */
cgt_result cgt_loose_grid_commit(cgt_scene *scene);
cgt_result cgt_bvh_commit(cgt_scene *scene);
cgt_result cgt_papers_commit(cgt_scene *scene, const cgt_primitive_bounds *bounds); /* those of research.h */

#endif
