/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Primitives of a glTF file as meshes: lists, strips and fans of triangles, with or without indices, and with the morph
 * targets that their weights add. Points and lines are counted. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/gltf/gltf_reader.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN };

/* What is read of a primitive; freed by the caller. */
typedef struct vertices {
    float *position, *normal; /* 3 numbers each; normal: NULL for none */
    uint32_t *index;          /* NULL: 0, 1, 2... */
    uint32_t count, indices;
} vertices;

/* ---- Triangles ----------------------------------------------------------------------------------------------- */

/* Corner k of triangle i, as glTF orders them so that all of a strip or fan face one way. */
static uint32_t corner(int mode, uint32_t i, uint32_t k)
{
    if (mode == TRIANGLES)
        return 3 * i + k;
    if (mode == TRIANGLE_STRIP)
        return k == 0 ? i : k == 1 ? i + 1 + i % 2 : i + 2 - i % 2;
    return k == 2 ? 0 : i + 1 + k;
}

static int count_faces(const gltf_reader *r, int mode, uint32_t corners, uint32_t *faces)
{
    *faces = mode == TRIANGLES ? corners / 3 : corners < 3 ? 0 : corners - 2;
    if (*faces == 0 || (mode == TRIANGLES && corners % 3 != 0))
        return trajectory_fail(r->t, 0, "a primitive of triangles has %" PRIu32 " corners", corners);
    return *faces <= r->t->options.max_count
               ? 1
               : trajectory_fail(r->t, 0, "%" PRIu32 " triangles are more than the limit of %" PRIu64, *faces,
                                 r->t->options.max_count);
}

static int make_faces(const gltf_reader *r, const gltf_primitive *p, const vertices *v, struct aiMesh *mesh)
{
    uint32_t faces = 0;
    if (count_faces(r, p->mode, v->indices, &faces) < 0)
        return -1;
    if (gltf_make(r, faces * (3 * sizeof(unsigned) + sizeof *mesh->mFaces)) < 0)
        return -1;
    unsigned *const index = calloc(3 * (size_t)faces + 1, sizeof *index);
    mesh->mFaces = calloc((size_t)faces + 1, sizeof *mesh->mFaces);
    if (index == NULL || mesh->mFaces == NULL) {
        free(index);
        return trajectory_fail(r->t, 0, "not enough memory for %" PRIu32 " triangles", faces);
    }
    mesh->mNumFaces = faces;
    mesh->mFaces[0].mIndices = index; /* from here on the mesh owns it */
    for (uint32_t i = 0; i < faces; i++) {
        mesh->mFaces[i] = (struct aiFace){3, index + 3 * (size_t)i};
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t c = corner(p->mode, i, k);
            const uint32_t vertex = v->index != NULL ? v->index[c] : c;
            if (vertex >= v->count)
                return trajectory_fail(r->t, 0,
                                       "triangle %" PRIu32 " of a primitive has vertex %" PRIu32 " of %" PRIu32, i,
                                       vertex, v->count);
            index[3 * (size_t)i + k] = vertex;
        }
    }
    return 1;
}

static void count_points(const gltf_reader *r, int mode, uint32_t corners)
{
    if (mode == POINTS)
        r->facts->points += corners;
    else
        r->facts->lines += mode == LINES ? corners / 2 : mode == LINE_LOOP ? corners : corners - 1;
}

/* ---- Vertices ------------------------------------------------------------------------------------------------ */

static int add_target(const gltf_reader *r, int accessor, double weight, const char *what, float *to, uint32_t count)
{
    float *moves = NULL;
    uint32_t move_count = 0;
    int result = gltf_read_floats(r, accessor, 3, what, &moves, &move_count);
    if (result > 0 && move_count != count)
        result = trajectory_fail(r->t, 0, "%" PRIu32 " %s for %" PRIu32 " vertices", move_count, what, count);
    for (size_t i = 0; result > 0 && i < 3 * (size_t)count; i++)
        to[i] = (float)((double)to[i] + weight * (double)moves[i]);
    free(moves);
    return result;
}

/* Adds the morph targets; those of weight 0 are not even read. */
static int morph(const gltf_reader *r, const gltf_primitive *p, const gltf_group *group, const vertices *v)
{
    if (group->weight_count > p->target_positions.count)
        return trajectory_fail(r->t, 0, "mesh %d has %zu weights, and %zu morph targets", group->mesh,
                               group->weight_count, p->target_positions.count);
    for (size_t k = 0; k < group->weight_count; k++) {
        const double weight = group->weights[k];
        const int position = r->f->number[p->target_positions.first + k];
        const int normal = r->f->number[p->target_normals.first + k];
        if (weight != 0.0 && position != GLTF_NONE &&
            add_target(r, position, weight, "positions of a morph target", v->position, v->count) < 0)
            return -1;
        if (weight != 0.0 && normal != GLTF_NONE && v->normal != NULL &&
            add_target(r, normal, weight, "normals of a morph target", v->normal, v->count) < 0)
            return -1;
    }
    return 1;
}

static int has_no_bytes(const gltf_reader *r, int accessor)
{
    return accessor >= 0 && (size_t)accessor < r->f->accessors && r->f->accessor[accessor].view == GLTF_NONE &&
           !r->f->accessor[accessor].is_sparse;
}

static int read_vertices(const gltf_reader *r, const gltf_primitive *p, const gltf_group *group, vertices *v)
{
    uint32_t normals = 0;
    if (p->is_draco && (has_no_bytes(r, p->position) || has_no_bytes(r, p->indices)))
        return trajectory_fail(r->t, 0, "mesh %d is compressed by Draco, which cannot be read here", group->mesh);
    if (p->position == GLTF_NONE)
        return trajectory_fail(r->t, 0, "mesh %d has a primitive without positions", group->mesh);
    if (gltf_read_floats(r, p->position, 3, "positions", &v->position, &v->count) < 0 ||
        (p->normal != GLTF_NONE && gltf_read_floats(r, p->normal, 3, "normals", &v->normal, &normals) < 0))
        return -1;
    if (v->normal != NULL && normals != v->count)
        return trajectory_fail(r->t, 0, "%" PRIu32 " normals for %" PRIu32 " vertices", normals, v->count);
    v->indices = v->count;
    return p->indices == GLTF_NONE ? 1 : gltf_read_whole(r, p->indices, 1, "indices", &v->index, &v->indices);
}

/* ---- Meshes -------------------------------------------------------------------------------------------------- */

static int make_mesh(const gltf_reader *r, const gltf_primitive *p, const gltf_group *group, struct aiMesh *mesh)
{
    vertices v = {NULL, NULL, NULL, 0, 0};
    int result = p->mode >= POINTS && p->mode <= TRIANGLE_FAN
                     ? read_vertices(r, p, group, &v)
                     : trajectory_fail(r->t, 0, "mesh %d has a primitive of mode %d", group->mesh, p->mode);
    if (result > 0 && p->mode < TRIANGLES) {
        count_points(r, p->mode, v.indices);
        free(v.position);
        free(v.normal);
        free(v.index);
        return 1;
    }
    if (result > 0)
        result = make_faces(r, p, &v, mesh) < 0 || morph(r, p, group, &v) < 0 ? -1 : 1;
    _Static_assert(sizeof(struct aiVector3D) == 3 * sizeof(float), "an array of vectors is one of floats");
    mesh->mVertices = (struct aiVector3D *)(void *)v.position;
    mesh->mNormals = (struct aiVector3D *)(void *)v.normal;
    mesh->mNumVertices = v.count;
    mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    free(v.index);
    if (result > 0 && group->skin != GLTF_NONE)
        result = gltf_read_bones(r, p, &r->f->skin[group->skin], mesh);
    return result;
}

int gltf_add_group(gltf_reader *r, gltf_group *group)
{
    const gltf_list *const primitives = &r->f->mesh[group->mesh].primitives;
    group->first = r->scene->mNumMeshes;
    for (size_t i = 0; i < primitives->count; i++) {
        if (r->scene->mNumMeshes == r->mesh_capacity) {
            const size_t capacity = r->mesh_capacity == 0 ? 16 : 2 * r->mesh_capacity;
            if (capacity > UINT32_MAX / 2 || trajectory_grow(&r->scene->mMeshes, capacity, sizeof(struct aiMesh *)))
                return trajectory_fail(r->t, 0, "not enough memory for %zu meshes", capacity);
            r->mesh_capacity = capacity;
        }
        struct aiMesh *const mesh = calloc(1, sizeof *mesh);
        if (mesh == NULL)
            return trajectory_fail(r->t, 0, "not enough memory for a mesh");
        r->scene->mMeshes[r->scene->mNumMeshes++] = mesh;
        group->count++;
        if (make_mesh(r, &r->f->primitive[primitives->first + i], group, mesh) < 0)
            return -1;
    }
    return 1;
}
