/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Vertices under a pose. Without bones a vertex follows its node; with bones it follows their transforms, blended by
 * its weights (linear blend skinning). */
#define _POSIX_C_SOURCE 200809L
#include "mesh/animation/mesh_pose.h"

#include <string.h>

/* A unit normal. One without direction, or not finite, stays as the transform leaves it. */
static void set_normal(float *out, const mesh_transform *transform, const struct aiVector3D *n)
{
    const float value[3] = {n->x, n->y, n->z};
    double moved[3];
    mesh_apply(transform, value, moved);
    const double length = sqrt(moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2]);
    const double factor = length > 0.0 && isfinite(length) ? 1.0 / length : 1.0;
    for (int i = 0; i < 3; i++)
        out[i] = (float)(moved[i] * factor);
}

static void set_position(float *out, const mesh_transform *transform, const struct aiVector3D *p)
{
    const float value[3] = {p->x, p->y, p->z};
    double moved[3];
    mesh_apply(transform, value, moved);
    for (int i = 0; i < 3; i++)
        out[i] = (float)moved[i];
}

/* ---- Without bones ------------------------------------------------------------------------------------------ */

/* Copies the bits of the file: -0 and NaN stay, which a multiplication by 1 and 0 would change. */
static void copy_part(const mesh_part *part, float *position, float *normal)
{
    for (uint32_t v = 0; v < part->count; v++) {
        memcpy(position + 3 * (size_t)v, &part->mesh->mVertices[part->source[v]], 3 * sizeof *position);
        if (normal != NULL && part->mesh->mNormals != NULL)
            memcpy(normal + 3 * (size_t)v, &part->mesh->mNormals[part->source[v]], 3 * sizeof *normal);
    }
}

static void move_part(const mesh_part *part, const mesh_transform *transform, float *position, float *normal)
{
    const mesh_transform normals = mesh_normal_transform(transform);
    for (uint32_t v = 0; v < part->count; v++) {
        set_position(position + 3 * (size_t)v, transform, &part->mesh->mVertices[part->source[v]]);
        if (normal != NULL && part->mesh->mNormals != NULL)
            set_normal(normal + 3 * (size_t)v, &normals, &part->mesh->mNormals[part->source[v]]);
    }
}

/* ---- With bones --------------------------------------------------------------------------------------------- */

static mesh_transform blend(const mesh_skin *skin, const mesh_transform *bones, uint32_t vertex)
{
    mesh_transform sum = {{{0}}};
    for (size_t i = skin->first[vertex]; i < skin->first[vertex + 1]; i++) {
        const mesh_influence *const influence = &skin->influences[i];
        const double weight = (double)influence->weight;
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 4; column++)
                sum.m[row][column] += weight * bones[influence->bone].m[row][column];
    }
    return sum;
}

static void bend_part(const mesh_part *part, const mesh_transform *bones, const mesh_transform *node, float *position,
                      float *normal)
{
    const mesh_skin *const skin = part->skin;
    for (uint32_t v = 0; v < part->count; v++) {
        const uint32_t source = part->source[v];
        const int free_vertex = skin->first[source] == skin->first[source + 1];
        const mesh_transform transform = free_vertex ? *node : blend(skin, bones, source);
        set_position(position + 3 * (size_t)v, &transform, &part->mesh->mVertices[source]);
        if (normal != NULL && part->mesh->mNormals != NULL) {
            const mesh_transform normals = mesh_normal_transform(&transform);
            set_normal(normal + 3 * (size_t)v, &normals, &part->mesh->mNormals[source]);
        }
    }
}

void mesh_deform(const mesh_model *model, mesh_pose *pose, float *position, float *normal)
{
    for (uint32_t p = 0; p < model->part_count; p++) {
        const mesh_part *const part = &model->parts[p];
        const mesh_transform *const node = &pose->global[part->node];
        float *const position_out = position + 3 * (size_t)part->first;
        float *const normal_out = normal != NULL ? normal + 3 * (size_t)part->first : NULL;
        if (normal_out != NULL && part->mesh->mNormals == NULL)
            memset(normal_out, 0, (size_t)part->count * 3 * sizeof *normal_out);
        for (uint32_t b = 0; b < part->skin->bone_count; b++) {
            const mesh_bone *const bone = &part->skin->bones[b];
            pose->bones[b] = mesh_multiply(&pose->global[bone->node], &bone->offset);
        }
        if (part->skin->bone_count > 0)
            bend_part(part, pose->bones, node, position_out, normal_out);
        else if (mesh_is_identity(node))
            copy_part(part, position_out, normal_out);
        else
            move_part(part, node, position_out, normal_out);
    }
}
