/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Meshes and scenes for tests of clusters (triangle_cluster.h): a rolled-up sheet of triangles in several
 * geometries, with neighbours in order or shuffled, some of them skipped. */
#ifndef CGT_TESTS_CLUSTER_MESHES_H
#define CGT_TESTS_CLUSTER_MESHES_H

#include "scene/scene.h"
#include "support/scenes.h"
#include "model/triangle_cluster.h"

#define LEAST 8192u   /* triangles that get clusters */
#define PARTS 5u      /* geometries at most */
#define HIDDEN_PART 3 /* the geometry that rays of SOME do not see */
#define SOME 1u

extern const uint32_t uneven[PARTS]; /* counts of triangles */

extern const cgt_scene_options automatic, loose_grid, bvh, kd_tree;

/* A geometry, in memory of its own that ends where its arrays do. */
typedef struct part {
    cgt_triangles triangles;
    uint32_t first, held; /* triangles in its arrays */
    float *vertex;
    uint32_t *index;
} part;

typedef struct mesh {
    uint32_t count, parts;
    float (*triangle)[3][3]; /* of all parts */
    part part[PARTS];
} mesh;

/* All triangles, row by row; another phase: elsewhere. */
void mesh_place(mesh *m, double phase);

/* beyond: triangles that each part's arrays hold after the last one, and that must not be seen. form: with indices or
 * without, with gaps in the arrays or without. */
mesh mesh_make(const uint32_t *counts, uint32_t parts, uint32_t beyond, uint32_t form);
mesh mesh_of(uint32_t count, uint32_t form);
void mesh_free(mesh *m);
uint32_t *index_at(const part *p, uint32_t i);

/* To the arrays, with indices from the last vertex to the first. What lies beyond cuts through the middle. */
void mesh_store(const mesh *m);

/* Triangles that are skipped: of some clusters all are, of some each other one, and single ones. Where they lie far
 * off, the boxes must not. */
void mesh_spoil(const mesh *m);

/* To zeros of either sign, of which neither is the lesser. */
void mesh_flatten(const mesh *m);

/* Makes clusters eight times as long as necessary, and of use only to grids. */
void mesh_loosen(const mesh *m);

void mesh_shuffle(const mesh *m, test_random *r);

/* Not committed. */
cgt_scene *scene_with(cgt_context *context, const cgt_scene_options *options, const mesh *m);

void commit(cgt_scene *scene);
cgt_scene *committed(cgt_context *context, const cgt_scene_options *options, const mesh *m);

#endif
