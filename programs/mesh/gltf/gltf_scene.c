/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A glTF file as a scene: what it requires, its meshes, nodes and clips. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/gltf/gltf_reader.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- Making -------------------------------------------------------------------------------------------------- */

/* Extensions that are understood, and those that do not change where triangles are: materials, textures, lights,
 * descriptions. */
static int is_known(const char *name)
{
    static const char *const beginnings[] = {"KHR_mesh_quantization",
                                             "EXT_mesh_gpu_instancing",
                                             "KHR_materials_",
                                             "KHR_texture_",
                                             "EXT_texture_",
                                             "MSFT_texture_",
                                             "KHR_lights_",
                                             "EXT_lights_",
                                             "KHR_xmp"};
    for (size_t i = 0; i < sizeof beginnings / sizeof beginnings[0]; i++)
        if (strncmp(name, beginnings[i], strlen(beginnings[i])) == 0)
            return 1;
    return 0;
}

static int check_required(cgt_trajectory *t, const gltf_file *f)
{
    for (size_t i = 0; i < f->extensions_required; i++) {
        if (!is_known(f->required[i]))
            return trajectory_fail(t, 0, "the file requires the extension %.80s, which cannot be read here",
                                   f->required[i]);
    }
    return 1;
}

int gltf_make(const gltf_reader *r, uint64_t bytes)
{
    *r->made += bytes;
    if (r->t->options.no_limit || !trajectory_input_is_blown_up(r->t->file_size + r->f->bytes, *r->made))
        return 1;
    return trajectory_fail(r->t, 0, "with what it uses again and again the file becomes " INPUT_BLOWN_UP,
                           INPUT_MOST_TIMES);
}

int gltf_make_scene(cgt_trajectory *t, const gltf_file *f, struct aiScene **scene, cgt_trajectory_mesh *facts)
{
    uint64_t triangles = 0, made = 0;
    gltf_reader r = {.t = t, .f = f, .facts = facts, .made = &made};
    *scene = r.scene = calloc(1, sizeof **scene);
    if (r.scene == NULL)
        return trajectory_fail(t, 0, "not enough memory for a scene");
    const int result = check_required(t, f) < 0 || gltf_read_nodes(&r) < 0 || gltf_read_clips(&r) < 0 ? -1 : 1;
    free(r.groups);
    free(r.slot);
    for (unsigned m = 0; m < r.scene->mNumMeshes; m++)
        triangles += r.scene->mMeshes[m]->mNumFaces;
    if (result > 0 && triangles == 0)
        return trajectory_fail(t, 0, "the file holds no triangles: %" PRIu64 " points, %" PRIu64 " lines",
                               facts->points, facts->lines);
    facts->meshes = r.scene->mNumMeshes;
    facts->clips = r.scene->mNumAnimations;
    return result;
}

/* ---- Freeing ------------------------------------------------------------------------------------------------- */

static void free_mesh(struct aiMesh *mesh)
{
    free(mesh->mVertices);
    free(mesh->mNormals);
    if (mesh->mNumFaces > 0)
        free(mesh->mFaces[0].mIndices); /* one array for all */
    free(mesh->mFaces);
    for (unsigned b = 0; b < mesh->mNumBones; b++) {
        free(mesh->mBones[b]->mWeights);
        free(mesh->mBones[b]);
    }
    free(mesh->mBones);
    free(mesh);
}

/* Children first, without recursion: a tree may be a chain. A node's count of children goes down meanwhile. */
static void free_nodes(struct aiNode *node)
{
    while (node != NULL) {
        if (node->mNumChildren > 0) {
            node = node->mChildren[--node->mNumChildren];
            continue;
        }
        struct aiNode *const parent = node->mParent;
        free(node->mChildren);
        free(node->mMeshes);
        free(node);
        node = parent;
    }
}

static void free_animation(struct aiAnimation *a)
{
    for (unsigned c = 0; c < a->mNumChannels; c++) {
        free(a->mChannels[c]->mPositionKeys);
        free(a->mChannels[c]->mRotationKeys);
        free(a->mChannels[c]->mScalingKeys);
        free(a->mChannels[c]);
    }
    free(a->mChannels);
    free(a);
}

void mesh_free_gltf(struct aiScene *scene)
{
    if (scene == NULL)
        return;
    for (unsigned m = 0; m < scene->mNumMeshes; m++)
        free_mesh(scene->mMeshes[m]);
    free(scene->mMeshes);
    free_nodes(scene->mRootNode);
    for (unsigned a = 0; a < scene->mNumAnimations; a++)
        free_animation(scene->mAnimations[a]);
    free(scene->mAnimations);
    free(scene);
}
