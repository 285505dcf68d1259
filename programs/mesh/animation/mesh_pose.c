/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The nodes of a mesh file at a time. Between two keys, positions and scales are interpolated linearly and rotations
 * along an arc; before the first key and after the last they are constant. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/animation/mesh_pose.h"

#include <stdlib.h>

#include <assimp/cimport.h>

/* ---- Keys --------------------------------------------------------------------------------------------------- */

/* The two keys around a time, and its share of the interval: 0 at the first, 1 at the second. */
typedef struct key_place {
    unsigned first, second;
    double share;
} key_place;

/* times: mTime of the first key; keys are `stride` bytes apart, with ascending times. */
static key_place find_key(const void *times, size_t stride, unsigned count, double time)
{
    const char *const base = times;
    unsigned low = 0, high = count; /* keys below low are not later than the time, those from high on are */
    while (low < high) {
        const unsigned middle = low + (high - low) / 2;
        if (*(const double *)(const void *)(base + middle * stride) <= time)
            low = middle + 1;
        else
            high = middle;
    }
    if (low == 0 || low == count) {
        const unsigned index = low == 0 ? 0 : count - 1;
        return (key_place){index, index, 0.0};
    }
    const double a = *(const double *)(const void *)(base + (low - 1) * stride);
    const double b = *(const double *)(const void *)(base + low * stride);
    const double share = (time - a) / (b - a);
    return (key_place){low - 1, low, share >= 0.0 && share <= 1.0 ? share : 0.0};
}

static void vector_at(const struct aiVectorKey *keys, unsigned count, double time, double value[3])
{
    const key_place k = find_key(&keys->mTime, sizeof *keys, count, time);
    const struct aiVector3D *const a = &keys[k.first].mValue, *const b = &keys[k.second].mValue;
    value[0] = (1.0 - k.share) * (double)a->x + k.share * (double)b->x;
    value[1] = (1.0 - k.share) * (double)a->y + k.share * (double)b->y;
    value[2] = (1.0 - k.share) * (double)a->z + k.share * (double)b->z;
}

static mesh_rotation rotation_of(const struct aiQuaternion *q)
{
    return mesh_rotation_unit((mesh_rotation){(double)q->w, (double)q->x, (double)q->y, (double)q->z});
}

static mesh_rotation rotation_at(const struct aiQuatKey *keys, unsigned count, double time)
{
    const key_place k = find_key(&keys->mTime, sizeof *keys, count, time);
    return mesh_slerp(rotation_of(&keys[k.first].mValue), rotation_of(&keys[k.second].mValue), k.share);
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

static mesh_transform local_at(const mesh_node *node, const struct aiNodeAnim *channel, double time)
{
    struct aiVector3D file_scale = {1.0f, 1.0f, 1.0f}, file_move = {0.0f, 0.0f, 0.0f};
    struct aiQuaternion file_turn = {1.0f, 0.0f, 0.0f, 0.0f};
    /* Components without keys stay as in the file. */
    if (channel->mNumScalingKeys == 0 || channel->mNumRotationKeys == 0 || channel->mNumPositionKeys == 0)
        aiDecomposeMatrix(&node->node->mTransformation, &file_scale, &file_turn, &file_move);
    double scale[3] = {(double)file_scale.x, (double)file_scale.y, (double)file_scale.z};
    double move[3] = {(double)file_move.x, (double)file_move.y, (double)file_move.z};
    mesh_rotation turn = rotation_of(&file_turn);
    if (channel->mNumScalingKeys > 0)
        vector_at(channel->mScalingKeys, channel->mNumScalingKeys, time, scale);
    if (channel->mNumRotationKeys > 0)
        turn = rotation_at(channel->mRotationKeys, channel->mNumRotationKeys, time);
    if (channel->mNumPositionKeys > 0)
        vector_at(channel->mPositionKeys, channel->mNumPositionKeys, time, move);
    return mesh_compose(scale, turn, move);
}

void mesh_pose_set(mesh_pose *pose, const mesh_model *model, const mesh_clip *clip, double seconds)
{
    const double time = seconds * clip->ticks_per_second;
    for (uint32_t n = 0; n < model->node_count; n++) {
        const mesh_node *const node = &model->nodes[n];
        const mesh_transform local = pose->channel[n] != NULL ? local_at(node, pose->channel[n], time) : node->local;
        pose->global[n] = node->parent == MESH_NONE ? local : mesh_multiply(&pose->global[node->parent], &local);
    }
}

int mesh_pose_begin(cgt_trajectory *t, const mesh_model *model, const mesh_clip *clip, mesh_pose *pose)
{
    size_t bones = 1;
    for (uint32_t p = 0; p < model->part_count; p++)
        bones = model->parts[p].skin->bone_count > bones ? model->parts[p].skin->bone_count : bones;
    pose->channel = calloc(model->node_count, sizeof(const struct aiNodeAnim *));
    pose->global = calloc(model->node_count, sizeof *pose->global);
    pose->bones = calloc(bones, sizeof *pose->bones);
    if (pose->channel == NULL || pose->global == NULL || pose->bones == NULL)
        return trajectory_fail(t, 0, "not enough memory for the animation of %u nodes", (unsigned)model->node_count);
    for (unsigned c = 0; clip->animation != NULL && c < clip->animation->mNumChannels; c++) {
        const struct aiNodeAnim *const channel = clip->animation->mChannels[c];
        const uint32_t node = mesh_model_find(model, &channel->mNodeName);
        if (node == MESH_NONE)
            return trajectory_fail(t, 0, "the clip moves '%.200s', which is no node", channel->mNodeName.data);
        pose->channel[node] = channel;
    }
    return 1;
}

void mesh_pose_end(mesh_pose *pose)
{
    free(pose->channel);
    free(pose->global);
    free(pose->bones);
}
