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

#define LEAST 8192u   /* fewest triangles that get clusters */
#define PARTS 5u      /* maximum number of geometries */
#define HIDDEN_PART 3 /* the geometry that rays of VISIBLE_MASK do not see */
#define VISIBLE_MASK 1u

extern const uint32_t uneven[PARTS]; /* counts of triangles */

extern const cgt_scene_options automatic, loose_grid, bvh, kd_tree;

/* A geometry, in separate memory that ends where its arrays do. */
typedef struct part {
    cgt_triangles triangles;
    uint32_t first, held; /* first triangle, and number of triangles in its arrays */
    float *vertex;
    uint32_t *index;
} part;

typedef struct mesh {
    uint32_t count, parts;
    float (*triangle)[3][3]; /* of all parts */
    part part[PARTS];
} mesh;

/* Places all triangles, row by row; the phase moves the mesh. */
void mesh_place(mesh *m, double phase);

/* beyond: number of triangles that each part's arrays hold after the last one, and that must not be hit. form: with or
 * without indices, with or without gaps in the arrays. */
mesh mesh_make(const uint32_t *counts, uint32_t parts, uint32_t beyond, uint32_t form);
mesh mesh_of(uint32_t count, uint32_t form);
void mesh_free(mesh *m);
uint32_t *index_at(const part *p, uint32_t i);

/* Stores the triangles in the arrays, with indices from the last vertex to the first. Triangles beyond the last one cut
 * through the centre. */
void mesh_store(const mesh *m);

/* Makes triangles that are skipped: all or every other one of some clusters, and single ones. Some lie far away, where
 * boxes must not reach. */
void mesh_spoil(const mesh *m);

/* Sets coordinates to +0 or -0, of which neither is less. */
void mesh_flatten(const mesh *m);

/* Makes clusters eight times as long as necessary, and useful only in grids. */
void mesh_loosen(const mesh *m);

void mesh_shuffle(const mesh *m, test_random *r);

/* Returns an uncommitted scene. */
cgt_scene *scene_with(cgt_context *context, const cgt_scene_options *options, const mesh *m);

void commit(cgt_scene *scene);
cgt_scene *committed(cgt_context *context, const cgt_scene_options *options, const mesh *m);

#endif
