/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes and flattened kd-trees for the tests of kd-trees. A failure here fails the test. */
#ifndef KD_TREES_H
#define KD_TREES_H

#include "structures/check/kd_check.h"
#include "kd/random_tree.h"
#include "support/scenes.h"

/* A committed scene: a cloud of spheres with as many triangles among them, some of both invalid. committed_of(scene)
 * returns its committed form. */
cgt_scene *mixed_scene(cgt_context *context, cloud_kind kind, uint64_t stream, uint32_t prims);
const cgt_committed_scene *committed_of(const cgt_scene *scene);
void mixed_scene_free(cgt_scene *scene);

/* A flattened tree and its memory. */
typedef struct flat_tree {
    cgt_context *context;
    cgt_buffer nodes, references, leaves;
    cgt_kd_tree tree;
} flat_tree;

/* Flattens into the buffers of flat; zero it before the first call. */
cgt_result flatten(flat_tree *flat, cgt_context *context, const cgt_kd_raw *raw, cgt_kd_layout layout,
                   uint32_t break_level, bool ropes);
void flat_tree_free(flat_tree *flat);

const char *layout_name(cgt_kd_layout layout);

#endif
