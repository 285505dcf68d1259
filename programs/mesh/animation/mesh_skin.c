/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Skins: assimp lists the vertices of each bone; blending needs the bones of each vertex. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/mesh_model.h"

#include <math.h>
#include <stdlib.h>

/* Weights that are zero, or cannot be summed, are ignored. */
static int counts(const struct aiVertexWeight *w) { return w->mWeight > 0.0f && isfinite(w->mWeight); }

static int read_bone(cgt_trajectory *t, const mesh_model *model, const struct aiMesh *mesh, const struct aiBone *bone,
                     mesh_bone *out)
{
    for (unsigned w = 0; w < bone->mNumWeights; w++) {
        if (bone->mWeights[w].mVertexId >= mesh->mNumVertices)
            return trajectory_fail(t, 0, "bone '%.200s' pulls vertex %u of %u", bone->mName.data,
                                   bone->mWeights[w].mVertexId, mesh->mNumVertices);
    }
    out->offset = mesh_from_matrix(&bone->mOffsetMatrix);
    out->node = mesh_model_find(model, &bone->mName);
    if (out->node == MESH_NONE && bone->mNumWeights > 0)
        return trajectory_fail(t, 0, "bone '%.200s' has no node", bone->mName.data);
    out->node = out->node == MESH_NONE ? 0 : out->node; /* no vertex follows it */
    return 1;
}

/* Counts influences into skin->first[vertex + 1] and sums them. Returns their number. */
static size_t count_influences(const struct aiMesh *mesh, mesh_skin *skin)
{
    for (unsigned b = 0; b < mesh->mNumBones; b++) {
        for (unsigned w = 0; w < mesh->mBones[b]->mNumWeights; w++) {
            const struct aiVertexWeight *const weight = &mesh->mBones[b]->mWeights[w];
            skin->first[(size_t)weight->mVertexId + 1] += (size_t)counts(weight);
        }
    }
    for (size_t v = 0; v < mesh->mNumVertices; v++)
        skin->first[v + 1] += skin->first[v];
    return skin->first[mesh->mNumVertices];
}

/* Stores the influences by vertex. first[v] advances to first[v + 1] meanwhile and is restored. */
static void place_influences(const struct aiMesh *mesh, mesh_skin *skin)
{
    for (unsigned b = 0; b < mesh->mNumBones; b++) {
        for (unsigned w = 0; w < mesh->mBones[b]->mNumWeights; w++) {
            const struct aiVertexWeight *const weight = &mesh->mBones[b]->mWeights[w];
            if (counts(weight))
                skin->influences[skin->first[weight->mVertexId]++] = (mesh_influence){b, weight->mWeight};
        }
    }
    for (size_t v = mesh->mNumVertices; v > 0; v--)
        skin->first[v] = skin->first[v - 1];
    skin->first[0] = 0;
}

static void normalise(const struct aiMesh *mesh, mesh_skin *skin)
{
    for (size_t v = 0; v < mesh->mNumVertices; v++) {
        double sum = 0.0;
        for (size_t i = skin->first[v]; i < skin->first[v + 1]; i++)
            sum += (double)skin->influences[i].weight;
        for (size_t i = skin->first[v]; i < skin->first[v + 1]; i++)
            skin->influences[i].weight = (float)((double)skin->influences[i].weight / sum);
    }
}

static int read_skin(cgt_trajectory *t, mesh_model *model, const struct aiMesh *mesh, mesh_skin *skin)
{
    skin->bones = calloc(mesh->mNumBones, sizeof *skin->bones);
    skin->first = calloc((size_t)mesh->mNumVertices + 1, sizeof *skin->first);
    if (skin->bones == NULL || skin->first == NULL)
        return trajectory_fail(t, 0, "not enough memory for %u bones", mesh->mNumBones);
    skin->bone_count = mesh->mNumBones;
    for (unsigned b = 0; b < mesh->mNumBones; b++) {
        if (read_bone(t, model, mesh, mesh->mBones[b], &skin->bones[b]) < 0)
            return -1;
        model->facts.bones += mesh->mBones[b]->mNumWeights > 0;
    }
    const size_t count = count_influences(mesh, skin);
    if (trajectory_grow(&skin->influences, count > 0 ? count : 1, sizeof *skin->influences))
        return trajectory_fail(t, 0, "not enough memory for %zu weights", count);
    place_influences(mesh, skin);
    normalise(mesh, skin);
    return 1;
}

int mesh_read_skins(cgt_trajectory *t, mesh_model *model)
{
    const struct aiScene *const scene = model->scene;
    model->skins = calloc(scene->mNumMeshes, sizeof *model->skins);
    if (model->skins == NULL)
        return trajectory_fail(t, 0, "not enough memory for %u meshes", scene->mNumMeshes);
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        const struct aiMesh *const mesh = scene->mMeshes[m];
        if (mesh->mNumBones > 0 && read_skin(t, model, mesh, &model->skins[m]) < 0)
            return -1;
    }
    return 1;
}
