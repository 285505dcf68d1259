/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The steps of a commit. Each fails with a message. */
#ifndef CGT_COMMIT_H
#define CGT_COMMIT_H

#include "scene/scene.h"

/* Reads, checks and bounds all objects. Fails where a triangle's index is out of range. Loose grid and wide tree get
 * size classes and middles of triangles (CGT_BUFFER_SIZE_CLASSES, CGT_BUFFER_CELL_SORT_WORK), or those of
 * clusters (world.cluster); the queue grid diameters. */
cgt_result cgt_compute_bounds(cgt_scene *scene, cgt_primitive_bounds *bounds);

/* The same once more, for a wide tree of triangles after a commit that has got clusters: size classes and middles. Rays
 * may be traced meanwhile. */
cgt_result cgt_compute_size_classes(cgt_scene *scene);

/* Build a structure over the valid objects, of which there is at least one, and fill in the statistics that are the
 * structure's own. */
cgt_result cgt_queue_grid_commit(cgt_scene *scene, const cgt_primitive_bounds *bounds);
cgt_result cgt_kd_commit(cgt_scene *scene, bool ropes);
cgt_result cgt_loose_grid_commit(cgt_scene *scene);
cgt_result cgt_bvh_commit(cgt_scene *scene);

#endif
