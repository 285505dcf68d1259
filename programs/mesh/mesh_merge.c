/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All meshes of the tree as one indexed set of triangles. Vertices of a mesh are merged where their position, normal
 * and bones have the same bits: most files, or assimp, repeat a vertex for each of its faces. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/mesh_model.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- Equal vertices ----------------------------------------------------------------------------------------- */

typedef struct join {
    const struct aiMesh *mesh;
    const mesh_skin *skin;
    size_t mask;        /* slots - 1, a power of two */
    uint32_t *slot;     /* hash table of vertices of the part; MESH_NONE is free */
    uint32_t *local_of; /* vertex of the part for each of the mesh; MESH_NONE: not added yet */
    uint32_t *source;   /* and the other way round */
    uint32_t count;     /* vertices of the part */
} join;

static uint64_t hash_bits(uint64_t hash, const struct aiVector3D *v)
{
    uint32_t bits[3];
    memcpy(bits, v, sizeof bits);
    for (int i = 0; i < 3; i++) {
        hash = (hash ^ bits[i]) * UINT64_C(0x9e3779b97f4a7c15);
        hash ^= hash >> 29;
    }
    return hash;
}

static uint64_t hash_vertex(const join *j, uint32_t v)
{
    const uint64_t hash = hash_bits(1, &j->mesh->mVertices[v]);
    return j->mesh->mNormals != NULL ? hash_bits(hash, &j->mesh->mNormals[v]) : hash;
}

static int same_influences(const mesh_skin *skin, uint32_t a, uint32_t b)
{
    if (skin->bone_count == 0)
        return 1;
    const size_t count = skin->first[a + 1] - skin->first[a];
    return count == skin->first[b + 1] - skin->first[b] &&
           memcmp(&skin->influences[skin->first[a]], &skin->influences[skin->first[b]],
                  count * sizeof *skin->influences) == 0;
}

static int same_vertex(const join *j, uint32_t a, uint32_t b)
{
    const struct aiMesh *const mesh = j->mesh;
    return memcmp(&mesh->mVertices[a], &mesh->mVertices[b], sizeof mesh->mVertices[a]) == 0 &&
           (mesh->mNormals == NULL || memcmp(&mesh->mNormals[a], &mesh->mNormals[b], sizeof mesh->mNormals[a]) == 0) &&
           same_influences(j->skin, a, b);
}

/* The part's vertex for vertex v of the mesh; a new one where none is equal. */
static uint32_t join_vertex(join *j, uint32_t v)
{
    if (j->local_of[v] != MESH_NONE)
        return j->local_of[v];
    size_t slot_index = (size_t)hash_vertex(j, v) & j->mask;
    while (j->slot[slot_index] != MESH_NONE && !same_vertex(j, j->source[j->slot[slot_index]], v))
        slot_index = (slot_index + 1) & j->mask;
    if (j->slot[slot_index] == MESH_NONE) {
        j->slot[slot_index] = j->count;
        j->source[j->count++] = v;
    }
    j->local_of[v] = j->slot[slot_index];
    return j->slot[slot_index];
}

static int join_begin(join *j, const mesh_part *part)
{
    const size_t vertices = part->mesh->mNumVertices;
    memset(j, 0, sizeof *j);
    j->mesh = part->mesh;
    j->skin = part->skin;
    size_t slots = 16;
    while (slots / 2 < vertices && slots <= SIZE_MAX / 2)
        slots *= 2;
    j->mask = slots - 1;
    if (trajectory_grow(&j->slot, slots, sizeof *j->slot) ||
        trajectory_grow(&j->local_of, vertices, sizeof *j->local_of) ||
        trajectory_grow(&j->source, vertices, sizeof *j->source))
        return -1;
    memset(j->slot, 0xff, slots * sizeof *j->slot);
    memset(j->local_of, 0xff, vertices * sizeof *j->local_of);
    return 0;
}

static void join_end(join *j)
{
    free(j->slot);
    free(j->local_of);
    free(j->source);
}

/* ---- Parts -------------------------------------------------------------------------------------------------- */

static int same_position(const struct aiMesh *mesh, uint32_t a, uint32_t b)
{
    const struct aiVector3D *const p = &mesh->mVertices[a], *const q = &mesh->mVertices[b];
    return p->x == q->x && p->y == q->y && p->z == q->z;
}

static int is_degenerate(const struct aiMesh *mesh, const unsigned *v)
{
    return same_position(mesh, v[0], v[1]) || same_position(mesh, v[1], v[2]) || same_position(mesh, v[2], v[0]);
}

/* Appends the triangles of a part. Under a mirroring transform their orientation is reversed, so that the outside stays
 * outside. */
static void add_triangles(mesh_model *model, const mesh_part *part, join *j)
{
    const int mirrored = part->skin->bone_count == 0 && mesh_determinant(&model->nodes[part->node].global) < 0.0;
    for (unsigned f = 0; f < part->mesh->mNumFaces; f++) {
        const struct aiFace *const face = &part->mesh->mFaces[f];
        if (face->mNumIndices == 3) {
            uint32_t *const index = model->index + 3 * (size_t)model->triangles++;
            for (int k = 0; k < 3; k++) {
                const int corner = mirrored && k > 0 ? 3 - k : k;
                index[corner] = part->first + join_vertex(j, face->mIndices[k]);
            }
            model->facts.degenerate += (uint64_t)is_degenerate(part->mesh, face->mIndices);
        }
    }
}

static int add_part(cgt_trajectory *t, mesh_model *model, mesh_part *part, int first_of_mesh)
{
    join j;
    part->first = model->vertices;
    if (join_begin(&j, part)) {
        join_end(&j);
        return trajectory_fail(t, 0, "not enough memory for %u vertices", part->mesh->mNumVertices);
    }
    add_triangles(model, part, &j);
    for (unsigned v = 0; first_of_mesh && v < part->mesh->mNumVertices; v++)
        model->facts.unused += j.local_of[v] == MESH_NONE;
    part->count = j.count;
    part->source = j.source;
    j.source = NULL;
    join_end(&j);
    model->has_normals |= part->mesh->mNormals != NULL;
    if (j.count > t->options.max_count - model->vertices)
        return trajectory_fail(t, 0, "more vertices than the limit of %" PRIu64, t->options.max_count);
    model->vertices += j.count;
    return 1;
}

/* ---- The tree ----------------------------------------------------------------------------------------------- */

static uint64_t triangles_of(const struct aiMesh *mesh)
{
    uint64_t triangles = 0;
    for (unsigned f = 0; f < mesh->mNumFaces; f++)
        triangles += mesh->mFaces[f].mNumIndices == 3;
    return triangles;
}

/* All indices must be those of existing vertices. */
static int check_mesh(cgt_trajectory *t, const struct aiMesh *mesh)
{
    for (unsigned f = 0; f < mesh->mNumFaces; f++) {
        const struct aiFace *const face = &mesh->mFaces[f];
        for (unsigned k = 0; k < face->mNumIndices; k++)
            if (face->mIndices[k] >= mesh->mNumVertices)
                return trajectory_fail(t, 0, "face %u has vertex %u of %u", f, face->mIndices[k], mesh->mNumVertices);
    }
    return 1;
}

/* Counts the triangles and parts of the tree. Sums of 2^30 nodes stay far below 2^64. */
static int count_tree(cgt_trajectory *t, const mesh_model *model, const uint64_t *mesh_triangles, uint64_t *triangles,
                      uint64_t *parts)
{
    uint64_t made = 0;
    *triangles = *parts = 0;
    for (uint32_t n = 0; n < model->node_count; n++) {
        const struct aiNode *const node = model->nodes[n].node;
        for (unsigned k = 0; k < node->mNumMeshes; k++) {
            if (node->mMeshes[k] >= model->scene->mNumMeshes)
                return trajectory_fail(t, 0, "a node shows mesh %u of %u", node->mMeshes[k], model->scene->mNumMeshes);
            *triangles += mesh_triangles[node->mMeshes[k]];
            *parts += mesh_triangles[node->mMeshes[k]] > 0;
            made += sizeof(mesh_part) + 12 * (mesh_triangles[node->mMeshes[k]] +
                                              (uint64_t)model->scene->mMeshes[node->mMeshes[k]]->mNumVertices);
        }
    }
    if (*triangles > t->options.max_count || *parts >= UINT32_MAX)
        return trajectory_fail(t, 0, "%" PRIu64 " triangles are more than the limit of %" PRIu64, *triangles,
                               t->options.max_count);
    if (!t->options.no_limit && trajectory_input_is_blown_up(model->bytes, made))
        return trajectory_fail(t, 0, "with meshes that many nodes show the file becomes " INPUT_BLOWN_UP,
                               INPUT_MOST_TIMES);
    return *triangles > 0 ? 1 : trajectory_fail(t, 0, "no node of the file shows a triangle");
}

/* Traverses the tree again and adds what was counted. shown: one byte a mesh, zero at first. */
static int add_tree(cgt_trajectory *t, mesh_model *model, const uint64_t *mesh_triangles, unsigned char *shown)
{
    for (uint32_t n = 0; n < model->node_count; n++) {
        const struct aiNode *const node = model->nodes[n].node;
        for (unsigned k = 0; k < node->mNumMeshes; k++) {
            const unsigned m = node->mMeshes[k];
            const int first_of_mesh = !shown[m];
            shown[m] = 1;
            if (mesh_triangles[m] == 0)
                continue;
            mesh_part *const part = &model->parts[model->part_count++];
            part->mesh = model->scene->mMeshes[m];
            part->skin = &model->skins[m];
            part->node = n;
            if (add_part(t, model, part, first_of_mesh) < 0)
                return -1;
        }
    }
    for (unsigned m = 0; m < model->scene->mNumMeshes; m++)
        model->facts.unshown += !shown[m];
    model->facts.instances = model->part_count;
    return 1;
}

static int merge(cgt_trajectory *t, mesh_model *model, uint64_t *mesh_triangles, unsigned char *shown)
{
    uint64_t triangles = 0, parts = 0;
    for (unsigned m = 0; m < model->scene->mNumMeshes; m++) {
        if (check_mesh(t, model->scene->mMeshes[m]) < 0)
            return -1;
        mesh_triangles[m] = triangles_of(model->scene->mMeshes[m]);
    }
    if (count_tree(t, model, mesh_triangles, &triangles, &parts) < 0)
        return -1;
    model->parts = calloc(parts > 0 ? (size_t)parts : 1, sizeof *model->parts);
    if (model->parts == NULL || trajectory_grow(&model->index, (size_t)triangles, 3 * sizeof *model->index))
        return trajectory_fail(t, 0, "not enough memory for %" PRIu64 " triangles", triangles);
    return add_tree(t, model, mesh_triangles, shown);
}

int mesh_merge(cgt_trajectory *t, mesh_model *model)
{
    uint64_t *mesh_triangles = calloc(model->scene->mNumMeshes, sizeof *mesh_triangles);
    unsigned char *shown = calloc(model->scene->mNumMeshes, 1);
    const int result = mesh_triangles == NULL || shown == NULL ? trajectory_fail(t, 0, "not enough memory")
                                                               : merge(t, model, mesh_triangles, shown);
    free(mesh_triangles);
    free(shown);
    return result;
}
