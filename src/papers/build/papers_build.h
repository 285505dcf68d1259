/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The builders of the papers. Each builds its structure over the valid primitives, of which there is at least one, in
 * scene->committed_scene.papers, and sets its statistics. */
#ifndef CGT_PAPERS_BUILD_H
#define CGT_PAPERS_BUILD_H

#include "papers/model/paper_structures.h"
#include "scene/scene.h"

cgt_result cgt_queue_grid_commit(cgt_scene *scene, const cgt_primitive_bounds *bounds);
cgt_result cgt_kd_commit(cgt_scene *scene, bool ropes);
cgt_result cgt_bih_commit(cgt_scene *scene);

#endif
