/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The nodes of a glTF file as a tree, and what each shows. All nodes are in the tree, since joints and clips may name
 * any of them; those outside the scene show nothing. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/gltf/gltf_reader.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define OUTSIDE 1 /* of a node's place: reached, not in the scene */
#define INSIDE 2

/* Scratch of one entry a node. */
typedef struct places {
    int *parent;       /* GLTF_NONE: a root */
    unsigned char *at; /* 0: not reached yet */
    size_t *queue;
    size_t queued;
    struct aiNode **made;
} places;

void gltf_name_node(struct aiString *name, int node)
{
    name->length = (ai_uint32)snprintf(name->data, sizeof name->data, "node %d", node);
}

static int is_node(const gltf_reader *r, int node) { return node >= 0 && (size_t)node < r->f->nodes; }

/* ---- The tree ------------------------------------------------------------------------------------------------ */

static int find_parents(const gltf_reader *r, places *p)
{
    for (size_t n = 0; n < r->f->nodes; n++)
        p->parent[n] = GLTF_NONE;
    for (size_t n = 0; n < r->f->nodes; n++) {
        const gltf_list *const children = &r->f->node[n].children;
        for (size_t c = 0; c < children->count; c++) {
            const int child = r->f->number[children->first + c];
            if (!is_node(r, child) || p->parent[child] != GLTF_NONE)
                return trajectory_fail(r->t, 0, "node %zu has the child %d, which %s", n, child,
                                       is_node(r, child) ? "has a parent already" : "does not exist");
            p->parent[child] = (int)n;
        }
    }
    return 1;
}

static void reach(places *p, size_t node, unsigned char at)
{
    p->at[node] = at;
    p->queue[p->queued++] = node;
}

/* Marks the nodes of the scene, then all others, parents first. What is not reached lies in a circle. */
static int find_places(const gltf_reader *r, places *p)
{
    size_t done = 0;
    for (size_t i = 0; i < r->f->roots.count; i++) {
        const int root = r->f->number[r->f->roots.first + i];
        if (!is_node(r, root) || p->parent[root] != GLTF_NONE)
            return trajectory_fail(r->t, 0, "the scene shows node %d, which %s", root,
                                   is_node(r, root) ? "has a parent" : "does not exist");
        if (p->at[root] == 0)
            reach(p, (size_t)root, INSIDE);
    }
    for (size_t n = 0; n < r->f->nodes; n++)
        if (p->parent[n] == GLTF_NONE && p->at[n] == 0)
            reach(p, n, r->f->has_scene ? OUTSIDE : INSIDE);
    while (done < p->queued) {
        const size_t n = p->queue[done++];
        const gltf_list *const children = &r->f->node[n].children;
        for (size_t c = 0; c < children->count; c++)
            reach(p, (size_t)r->f->number[children->first + c], p->at[n]);
    }
    return done == r->f->nodes ? 1 : trajectory_fail(r->t, 0, "nodes of the file are their own parents");
}

/* ---- What a node shows --------------------------------------------------------------------------------------- */

static int same_group(const gltf_group *g, const gltf_group *wanted)
{
    return g->mesh == wanted->mesh && g->skin == wanted->skin && g->weights == wanted->weights &&
           g->weight_count == wanted->weight_count;
}

static uint64_t hash_group(const gltf_group *g)
{
    uint64_t hash = ((uint64_t)(unsigned)g->mesh << 32 | (unsigned)g->skin) * UINT64_C(0x9e3779b97f4a7c15);
    hash = (hash ^ hash >> 29 ^ (uintptr_t)g->weights) * UINT64_C(0x9e3779b97f4a7c15);
    return hash ^ hash >> 32;
}

/* The group that a node shows: an existing one where mesh, skin and weights are the same. */
static int find_group(gltf_reader *r, const gltf_group *wanted, size_t *found)
{
    size_t slot = (size_t)hash_group(wanted) & r->mask;
    for (; r->slot[slot] > 0; slot = (slot + 1) & r->mask) {
        *found = r->slot[slot] - 1;
        if (same_group(&r->groups[*found], wanted))
            return 1;
    }
    if (r->group_count == r->group_capacity) {
        const size_t capacity = r->group_capacity == 0 ? 16 : 2 * r->group_capacity;
        if (trajectory_grow(&r->groups, capacity, sizeof *r->groups))
            return trajectory_fail(r->t, 0, "not enough memory for %zu meshes", capacity);
        r->group_capacity = capacity;
    }
    *found = r->group_count++;
    r->groups[*found] = *wanted;
    r->slot[slot] = r->group_count;
    return gltf_add_group(r, &r->groups[*found]);
}

static gltf_group group_of(const gltf_reader *r, int mesh, int skin, const gltf_list *weights)
{
    const gltf_list *const own = &r->f->mesh[mesh].weights;
    const gltf_list *const used = weights != NULL && weights->count > 0 ? weights : own;
    return (gltf_group){.mesh = mesh,
                        .skin = skin,
                        .weights = used->count > 0 ? r->f->real + used->first : NULL,
                        .weight_count = used->count};
}

static int show(gltf_reader *r, unsigned char *shown, size_t n, struct aiNode *out)
{
    const gltf_node *const node = &r->f->node[n];
    const int skin = node->skin;
    if (node->mesh < 0 || (size_t)node->mesh >= r->f->meshes ||
        (skin != GLTF_NONE && (skin < 0 || (size_t)skin >= r->f->skins)))
        return trajectory_fail(r->t, 0, "node %zu shows mesh %d of %zu, skin %d of %zu", n, node->mesh, r->f->meshes,
                               skin, r->f->skins);
    const gltf_group wanted = group_of(r, node->mesh, skin, &node->weights);
    size_t g = 0;
    shown[node->mesh] = 1;
    if (find_group(r, &wanted, &g) < 0 || gltf_make(r, r->groups[g].count * sizeof *out->mMeshes) < 0)
        return -1;
    out->mMeshes = calloc((size_t)r->groups[g].count + 1, sizeof *out->mMeshes);
    if (out->mMeshes == NULL)
        return trajectory_fail(r->t, 0, "not enough memory for the nodes");
    for (unsigned i = 0; i < r->groups[g].count; i++)
        out->mMeshes[out->mNumMeshes++] = r->groups[g].first + i;
    return 1;
}

/* Meshes that no node shows are in the scene, so that they are counted. */
static int add_unshown(gltf_reader *r, const unsigned char *shown)
{
    for (size_t m = 0; m < r->f->meshes; m++) {
        const gltf_group wanted = group_of(r, (int)m, GLTF_NONE, NULL);
        size_t g = 0;
        if (!shown[m] && find_group(r, &wanted, &g) < 0)
            return -1;
    }
    return 1;
}

/* ---- Nodes --------------------------------------------------------------------------------------------------- */

static struct aiMatrix4x4 matrix_of(const mesh_transform *a)
{
    const double(*const m)[4] = a->m;
    return (struct aiMatrix4x4){(float)m[0][0], (float)m[0][1], (float)m[0][2], (float)m[0][3],
                                (float)m[1][0], (float)m[1][1], (float)m[1][2], (float)m[1][3],
                                (float)m[2][0], (float)m[2][1], (float)m[2][2], (float)m[2][3],
                                0.0f,           0.0f,           0.0f,           1.0f};
}

static struct aiMatrix4x4 transform_of(const gltf_node *n)
{
    const double *const m = n->matrix;
    const mesh_rotation turn = {n->rotation[3], n->rotation[0], n->rotation[1], n->rotation[2]};
    const mesh_transform given = {{{m[0], m[4], m[8], m[12]}, {m[1], m[5], m[9], m[13]}, {m[2], m[6], m[10], m[14]}}};
    const mesh_transform composed = mesh_compose(n->scale, mesh_rotation_unit(turn), n->translation);
    return matrix_of(n->has_matrix ? &given : &composed);
}

static struct aiNode *add_child(struct aiNode *parent, int name)
{
    struct aiNode *const child = calloc(1, sizeof *child);
    if (child != NULL) {
        child->mParent = parent;
        gltf_name_node(&child->mName, name);
        parent->mChildren[parent->mNumChildren++] = child;
    }
    return child;
}

/* EXT_mesh_gpu_instancing: the node's meshes once under each of these transforms. */
typedef struct instances {
    float *translation, *rotation, *scale;
    uint32_t count;
} instances;

static int read_instances(const gltf_reader *r, const gltf_node *n, instances *in)
{
    const struct {
        int accessor, components;
        float **to;
    } rows[] = {{n->instance_translation, 3, &in->translation},
                {n->instance_rotation, 4, &in->rotation},
                {n->instance_scale, 3, &in->scale}};
    for (int i = 0; i < 3; i++) {
        uint32_t count = in->count;
        if (rows[i].accessor != GLTF_NONE &&
            gltf_read_floats(r, rows[i].accessor, rows[i].components, "instances", rows[i].to, &count) < 0)
            return -1;
        if (in->count != 0 && count != in->count)
            return trajectory_fail(r->t, 0, "transforms of %" PRIu32 " and of %" PRIu32 " instances", in->count, count);
        in->count = count;
    }
    return in->count > 0 ? 1 : trajectory_fail(r->t, 0, "a node has instances without transforms");
}

/* The instances as further children of the node, which show what it would have shown. */
static int add_instances(const gltf_reader *r, const instances *in, struct aiNode *node)
{
    if (gltf_make(r, in->count * (sizeof *node + node->mNumMeshes * sizeof *node->mMeshes)) < 0)
        return -1;
    for (uint32_t i = 0; i < in->count; i++) {
        double scale[3], move[3];
        mesh_rotation turn = {1, 0, 0, 0};
        for (size_t k = 0; k < 3; k++) {
            scale[k] = in->scale != NULL ? (double)in->scale[3 * (size_t)i + k] : 1.0;
            move[k] = in->translation != NULL ? (double)in->translation[3 * (size_t)i + k] : 0.0;
        }
        if (in->rotation != NULL) {
            const float *const q = in->rotation + 4 * (size_t)i;
            turn = mesh_rotation_unit((mesh_rotation){(double)q[3], (double)q[0], (double)q[1], (double)q[2]});
        }
        const mesh_transform transform = mesh_compose(scale, turn, move);
        struct aiNode *const child = add_child(node, GLTF_NONE);
        unsigned *const shown = calloc((size_t)node->mNumMeshes + 1, sizeof *shown);
        if (child == NULL || shown == NULL) {
            free(shown);
            return trajectory_fail(r->t, 0, "not enough memory for %" PRIu32 " instances", in->count);
        }
        memcpy(shown, node->mMeshes, node->mNumMeshes * sizeof *shown);
        child->mTransformation = matrix_of(&transform);
        child->mMeshes = shown;
        child->mNumMeshes = node->mNumMeshes;
    }
    node->mNumMeshes = in->count > 0 ? 0 : node->mNumMeshes;
    return 1;
}

/* Fills the node's own place, and makes its children. */
static int make_node(gltf_reader *r, places *p, unsigned char *shown, size_t n)
{
    const gltf_node *const node = &r->f->node[n];
    struct aiNode *const out = p->made[n];
    instances in = {NULL, NULL, NULL, 0};
    out->mTransformation = transform_of(node);
    int result = node->mesh != GLTF_NONE && p->at[n] == INSIDE ? show(r, shown, n, out) : 1;
    if (result > 0 && node->is_instanced && out->mNumMeshes > 0)
        result = read_instances(r, node, &in);
    out->mChildren = calloc(in.count + node->children.count + 1, sizeof(struct aiNode *));
    if (result > 0 && out->mChildren == NULL)
        result = trajectory_fail(r->t, 0, "not enough memory for the nodes");
    if (result > 0)
        result = add_instances(r, &in, out);
    for (size_t c = 0; result > 0 && c < node->children.count; c++) {
        const int child = r->f->number[node->children.first + c];
        p->made[child] = add_child(out, child);
        result = p->made[child] != NULL ? 1 : trajectory_fail(r->t, 0, "not enough memory for the nodes");
    }
    free(in.translation);
    free(in.rotation);
    free(in.scale);
    return result;
}

static int make_tree(gltf_reader *r, places *p, unsigned char *shown)
{
    struct aiNode *const root = calloc(1, sizeof *root);
    const mesh_transform identity = mesh_identity();
    r->scene->mRootNode = root;
    if (root == NULL || (root->mChildren = calloc(r->f->nodes + 1, sizeof(struct aiNode *))) == NULL)
        return trajectory_fail(r->t, 0, "not enough memory for the nodes");
    root->mTransformation = matrix_of(&identity);
    for (size_t i = 0; i < p->queued; i++) {
        const size_t n = p->queue[i];
        if (p->parent[n] == GLTF_NONE)
            p->made[n] = add_child(root, (int)n);
        if (p->made[n] == NULL)
            return trajectory_fail(r->t, 0, "not enough memory for the nodes");
        if (make_node(r, p, shown, n) < 0)
            return -1;
    }
    return add_unshown(r, shown);
}

int gltf_read_nodes(gltf_reader *r)
{
    const size_t nodes = r->f->nodes + 1;
    places p = {calloc(nodes, sizeof *p.parent), calloc(nodes, 1), calloc(nodes, sizeof *p.queue), 0,
                calloc(nodes, sizeof(struct aiNode *))};
    unsigned char *const shown = calloc(r->f->meshes + 1, 1); /* of each mesh */
    size_t slots = 16;
    while (slots / 2 < r->f->nodes + r->f->meshes && slots <= SIZE_MAX / 2)
        slots *= 2;
    r->mask = slots - 1;
    r->slot = calloc(slots, sizeof *r->slot);
    int result = 1;
    if (p.parent == NULL || p.at == NULL || p.queue == NULL || p.made == NULL || shown == NULL || r->slot == NULL)
        result = trajectory_fail(r->t, 0, "not enough memory for %zu nodes", r->f->nodes);
    if (result > 0)
        result = find_parents(r, &p) < 0 || find_places(r, &p) < 0 ? -1 : make_tree(r, &p, shown);
    free(p.parent);
    free(p.at);
    free(p.queue);
    free(p.made);
    free(shown);
    return result;
}
