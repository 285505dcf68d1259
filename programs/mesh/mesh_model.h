/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A file of meshes, read by assimp and merged into one indexed set of triangles.
 *   node   a transform of the file's tree; parents precede their children
 *   skin   which bones move each vertex of a mesh, with weights
 *   part   a mesh under a node; a mesh under three nodes is three parts */
#ifndef MESH_MODEL_H
#define MESH_MODEL_H

#include <stddef.h>
#include <stdint.h>
#include <strings.h>

#include <assimp/scene.h>

#include "mesh/mesh_math.h"
#include "trajectory/trajectory_internal.h"

#define MESH_NONE UINT32_MAX

typedef struct mesh_node {
    const struct aiNode *node;
    uint32_t parent;       /* MESH_NONE for the root */
    mesh_transform local;  /* as in the file */
    mesh_transform global; /* in the file's own pose; a mesh_pose has its own */
} mesh_node;

typedef struct mesh_name {
    const char *name;
    uint32_t node;
} mesh_name;

typedef struct mesh_bone {
    uint32_t node;
    mesh_transform offset; /* from the mesh to the bone, in the bind pose */
} mesh_bone;

typedef struct mesh_influence {
    uint32_t bone; /* of the skin */
    float weight;  /* those of a vertex sum to 1 */
} mesh_influence;

typedef struct mesh_skin {
    uint32_t bone_count; /* 0: no skin, the other members are NULL */
    mesh_bone *bones;
    size_t *first; /* vertex v has influences first[v] to first[v + 1]; none where it follows its node */
    mesh_influence *influences;
} mesh_skin;

typedef struct mesh_part {
    const struct aiMesh *mesh;
    const mesh_skin *skin;
    uint32_t node;
    uint32_t first, count; /* vertices of the model */
    uint32_t *source;      /* the mesh's vertex for each of them */
} mesh_part;

typedef struct mesh_model {
    const struct aiScene *scene;
    uint64_t bytes; /* of the file, and of others that it names */
    int is_gltf;    /* the scene was made here: mesh_free_gltf frees it, not assimp */
    uint32_t node_count, part_count;
    size_t node_capacity;
    mesh_node *nodes;
    mesh_name *by_name; /* sorted; nodes of one name in the tree's order */
    mesh_skin *skins;   /* one for each mesh of the scene */
    mesh_part *parts;
    uint32_t vertices, triangles;
    uint32_t *index;
    int has_normals; /* of some mesh */
    cgt_trajectory_mesh facts;
} mesh_model;

/* Reads t's file. Returns 1, or -1 with an error noted; free the model in either case. */
int mesh_model_read(cgt_trajectory *t, mesh_model *model);
void mesh_model_free(mesh_model *model);

/* A matrix of assimp's, without its fourth row. */
mesh_transform mesh_from_matrix(const struct aiMatrix4x4 *a);

/* The first node of this name, or MESH_NONE. */
uint32_t mesh_model_find(const mesh_model *model, const struct aiString *name);

/* ---- The steps of reading, in files of their own; each returns 1, or -1 with an error noted ----------------- */

/* mesh_import.c: imports the checked file and cuts polygons into triangles: scene and some facts. mesh_import_scene
 * does so without the checks that protect the program. */
int mesh_import(cgt_trajectory *t, mesh_model *model);
int mesh_import_scene(cgt_trajectory *t, mesh_model *model);

/* mesh_rehearse.c: tries the import in a child process. */
int mesh_rehearse(cgt_trajectory *t);

/* mesh_nodes.c: nodes, by_name. */
int mesh_read_nodes(cgt_trajectory *t, mesh_model *model);

/* mesh_skin.c: skins. */
int mesh_read_skins(cgt_trajectory *t, mesh_model *model);

/* mesh_merge.c: parts, index. */
int mesh_merge(cgt_trajectory *t, mesh_model *model);

/* Whether an ending is that of glTF, as text or binary. */
static inline int mesh_is_gltf(const char *ending)
{
    return strcasecmp(ending, ".gltf") == 0 || strcasecmp(ending, ".glb") == 0;
}

/* gltf/gltf_import.c: the same for glTF, without assimp. */
int mesh_import_gltf(cgt_trajectory *t, mesh_model *model);
void mesh_free_gltf(struct aiScene *scene);

/* mesh_check.c: all bytes of t's file, with a zero behind them. *bytes: to be freed after 1. */
int mesh_read_bytes(cgt_trajectory *t, char **bytes, size_t *size);

/* mesh_check.c: finds damage in t's file that assimp does not notice, or does not survive. */
int mesh_check_file(cgt_trajectory *t);
int mesh_check_ply(cgt_trajectory *t, text_reader *r); /* mesh_check_ply.c; r is at the start */

#endif
