/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From what the module cgt-gltf parsed to a scene of assimp's structures, which the rest of the readers of meshes
 * understands. The scene is plain C memory; mesh_free_gltf frees it, not assimp.
 *   group   the primitives of a mesh with one skin and one set of morph weights: consecutive meshes of the scene */
#ifndef GLTF_READER_H
#define GLTF_READER_H

#include "mesh/gltf/gltf_module.h"
#include "mesh/mesh_model.h"

typedef struct gltf_group {
    int mesh, skin;        /* skin: GLTF_NONE for none */
    const double *weights; /* of morph targets; NULL for none */
    size_t weight_count;
    unsigned first, count; /* meshes of the scene */
} gltf_group;

typedef struct gltf_reader {
    cgt_trajectory *t;
    const gltf_file *f;
    cgt_trajectory_mesh *facts;
    struct aiScene *scene;
    gltf_group *groups;
    size_t group_count, group_capacity;
    size_t *slot; /* hash table of groups, by mesh and skin: 1 + their number; 0 is free */
    size_t mask;  /* slots - 1, a power of two */
    uint64_t *made;
    size_t mesh_capacity; /* of the scene */
} gltf_reader;

/* Each function below that returns int returns 1, or -1 with an error noted. */

/* gltf_scene.c: notes bytes that are made of those of the file, before they are: a file may use the same ones again and
 * again. Returns -1 where that is too much to be meant. */
int gltf_make(const gltf_reader *r, uint64_t bytes);

/* gltf_accessor.c: an accessor's elements of `components` numbers each, normalised where it says so, as floats. what:
 * for errors, "positions". *out: memory to be freed. */
int gltf_read_floats(const gltf_reader *r, int accessor, int components, const char *what, float **out,
                     uint32_t *count);

/* The same for whole numbers that are not negative. */
int gltf_read_whole(const gltf_reader *r, int accessor, int components, const char *what, uint32_t **out,
                    uint32_t *count);

/* gltf_mesh.c: adds the meshes of a group to the scene. */
int gltf_add_group(gltf_reader *r, gltf_group *group);

/* gltf_skin.c: the bones of a mesh of `vertices` vertices; its scene's nodes are named by gltf_name_node. */
int gltf_read_bones(const gltf_reader *r, const gltf_primitive *p, const gltf_skin *skin, struct aiMesh *mesh);

/* gltf_nodes.c: nodes, and the groups that they show. */
int gltf_read_nodes(gltf_reader *r);
void gltf_name_node(struct aiString *name, int node); /* names in files need not be unique */

/* gltf_animation.c: clips. */
int gltf_read_clips(gltf_reader *r);

/* gltf_scene.c: all of it; facts: points, lines, clips and meshes are set. *scene: to be freed in either case. */
int gltf_make_scene(cgt_trajectory *t, const gltf_file *f, struct aiScene **scene, cgt_trajectory_mesh *facts);

#endif
