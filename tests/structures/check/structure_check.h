/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What every structure promises, for the variant that a test is compiled for: each structure has a checker that
 * recounts it from its primitives, exactly, and compares the statistics. Only the BVH depends on the variant. */
#ifndef STRUCTURE_CHECK_H
#define STRUCTURE_CHECK_H

#include "papers/model/paper_structures.h"
#include "scene/scene.h"
#include "support/scenes.h"

/* Checks what a commit has built, by its structure, and the BVH beside it. A failure fails the test. */
void structure_check(const cgt_scene *scene);

/* Whether two scenes have the same structures, bit by bit. */
bool structure_same(const cgt_committed_scene *a, const cgt_committed_scene *b);

/* ---- the checkers; each scene has a valid primitive ---- */

/* Every valid primitive lies in one cell, in ascending order, and within reach of the cell's box. Levels hold similar
 * sizes, and there are as many cells as specified. */
void loose_grid_check(const cgt_scene *scene);

/* Checks the cells of one level alone; returns how many primitives they hold. */
uint32_t loose_level_check(const cgt_committed_scene *committed_scene, const cgt_loose_level *level);

/* Cells that a primitive touches refer to it, once: points of a sphere decide that in long double, clipping of a
 * triangle in double. Queues and overflow list are in order. Every step-th primitive is looked for; *near gets the
 * number of cells that triangles touch or nearly touch. Also of a scene without primitives, which has no grid. */
cgt_research_scene_statistics queue_grid_check(const cgt_scene *scene, uint32_t step, uint64_t *near);

/* A triangle's corners in cells of a grid. */
void queue_grid_corners(const cgt_queue_grid *grid, const float corner[3][3], double at[3][3]);

/* Every valid primitive is in one leaf, within all planes on the way there and away from them by the margin. */
void bih_check(const cgt_bih *tree, const cgt_committed_scene *committed_scene);
bool bih_same(const cgt_bih *a, const cgt_bih *b);

#endif
