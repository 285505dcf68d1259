/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Skins of a glTF file: it lists the joints of each vertex, a scene the vertices of each bone. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/gltf/gltf_reader.h"

#include <inttypes.h>
#include <stdlib.h>

/* One set of four joints a vertex, with their weights. */
typedef struct joint_set {
    uint32_t *joint;
    float *weight;
} joint_set;

static int read_set(const gltf_reader *r, const gltf_primitive *p, int number, uint32_t vertices, joint_set *set)
{
    uint32_t joints = 0, weights = 0;
    if (p->joints[number] == GLTF_NONE)
        return 1;
    if (gltf_read_whole(r, p->joints[number], 4, "joints", &set->joint, &joints) < 0 ||
        gltf_read_floats(r, p->weights[number], 4, "weights of joints", &set->weight, &weights) < 0)
        return -1;
    if (joints != vertices || weights != vertices)
        return trajectory_fail(r->t, 0, "%" PRIu32 " joints and %" PRIu32 " weights for %" PRIu32 " vertices", joints,
                               weights, vertices);
    return 1;
}

/* Counts the vertices of each bone, and then lists them. Weights of 0 pull nothing, whatever joint they name. */
static int count_weights(const gltf_reader *r, const joint_set *sets, struct aiMesh *mesh)
{
    for (int s = 0; s < GLTF_JOINT_SETS; s++) {
        for (size_t i = 0; sets[s].joint != NULL && i < 4 * (size_t)mesh->mNumVertices; i++) {
            if (sets[s].weight[i] == 0.0f)
                continue;
            if (sets[s].joint[i] >= mesh->mNumBones)
                return trajectory_fail(r->t, 0, "vertex %zu follows joint %" PRIu32 " of %u", i / 4, sets[s].joint[i],
                                       mesh->mNumBones);
            mesh->mBones[sets[s].joint[i]]->mNumWeights++;
        }
    }
    return 1;
}

static void list_weights(const joint_set *sets, struct aiMesh *mesh)
{
    for (int s = 0; s < GLTF_JOINT_SETS; s++) {
        for (size_t i = 0; sets[s].joint != NULL && i < 4 * (size_t)mesh->mNumVertices; i++) {
            if (sets[s].weight[i] != 0.0f) {
                struct aiBone *const bone = mesh->mBones[sets[s].joint[i]];
                bone->mWeights[bone->mNumWeights++] = (struct aiVertexWeight){(unsigned)(i / 4), sets[s].weight[i]};
            }
        }
    }
}

static int make_weights(const gltf_reader *r, const joint_set *sets, struct aiMesh *mesh)
{
    if (count_weights(r, sets, mesh) < 0)
        return -1;
    for (unsigned b = 0; b < mesh->mNumBones; b++) {
        struct aiBone *const bone = mesh->mBones[b];
        bone->mWeights = calloc((size_t)bone->mNumWeights + 1, sizeof *bone->mWeights);
        if (bone->mWeights == NULL)
            return trajectory_fail(r->t, 0, "not enough memory for %u weights", bone->mNumWeights);
        bone->mNumWeights = 0; /* list_weights counts again */
    }
    list_weights(sets, mesh);
    return 1;
}

/* The joints as bones; without matrices they bend the mesh from where it is. */
static int make_bones(const gltf_reader *r, const gltf_skin *skin, struct aiMesh *mesh)
{
    float *matrices = NULL;
    uint32_t count = 0;
    if (skin->inverse_binds != GLTF_NONE &&
        gltf_read_floats(r, skin->inverse_binds, 16, "inverse bind matrices", &matrices, &count) < 0) {
        free(matrices);
        return -1;
    }
    if (matrices != NULL && count < skin->joints.count) {
        free(matrices);
        return trajectory_fail(r->t, 0, "%" PRIu32 " inverse bind matrices for %zu joints", count, skin->joints.count);
    }
    if (gltf_make(r, skin->joints.count * sizeof(struct aiBone)) < 0) {
        free(matrices);
        return -1;
    }
    mesh->mBones = calloc(skin->joints.count + 1, sizeof(struct aiBone *));
    for (size_t b = 0; mesh->mBones != NULL && b < skin->joints.count; b++) {
        struct aiBone *const bone = calloc(1, sizeof *bone);
        if (bone == NULL)
            break;
        const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        const float *const m = matrices != NULL ? matrices + 16 * b : identity;
        bone->mOffsetMatrix = (struct aiMatrix4x4){m[0], m[4], m[8],  m[12], m[1], m[5], m[9],  m[13],
                                                   m[2], m[6], m[10], m[14], m[3], m[7], m[11], m[15]};
        gltf_name_node(&bone->mName, r->f->number[skin->joints.first + b]);
        mesh->mBones[mesh->mNumBones++] = bone;
    }
    free(matrices);
    return mesh->mNumBones == skin->joints.count ? 1 : trajectory_fail(r->t, 0, "not enough memory for bones");
}

int gltf_read_bones(const gltf_reader *r, const gltf_primitive *p, const gltf_skin *skin, struct aiMesh *mesh)
{
    joint_set sets[GLTF_JOINT_SETS] = {{NULL, NULL}};
    int result = p->more_joints
                     ? trajectory_fail(r->t, 0, "more than %d joints a vertex cannot be read", 4 * GLTF_JOINT_SETS)
                     : make_bones(r, skin, mesh);
    for (int s = 0; result > 0 && s < GLTF_JOINT_SETS; s++)
        result = read_set(r, p, s, mesh->mNumVertices, &sets[s]);
    if (result > 0)
        result = make_weights(r, sets, mesh);
    for (int s = 0; s < GLTF_JOINT_SETS; s++) {
        free(sets[s].joint);
        free(sets[s].weight);
    }
    return result;
}
