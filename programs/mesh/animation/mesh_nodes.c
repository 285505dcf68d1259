/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The tree of a mesh file as an array, and nodes by name. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/mesh_model.h"

#include <stdlib.h>
#include <string.h>

#define MOST_NODES ((uint32_t)1 << 30)

mesh_transform mesh_from_matrix(const struct aiMatrix4x4 *a)
{
    return (mesh_transform){{{(double)a->a1, (double)a->a2, (double)a->a3, (double)a->a4},
                             {(double)a->b1, (double)a->b2, (double)a->b3, (double)a->b4},
                             {(double)a->c1, (double)a->c2, (double)a->c3, (double)a->c4}}};
}

static int add_node(cgt_trajectory *t, mesh_model *model, const struct aiNode *node, uint32_t parent)
{
    if (model->node_count == MOST_NODES)
        return trajectory_fail(t, 0, "more than %u nodes", (unsigned)MOST_NODES);
    if (model->node_count == model->node_capacity) {
        const size_t capacity = model->node_capacity == 0 ? 64 : 2 * model->node_capacity;
        if (trajectory_grow(&model->nodes, capacity, sizeof *model->nodes))
            return trajectory_fail(t, 0, "not enough memory for %zu nodes", capacity);
        model->node_capacity = capacity;
    }
    mesh_node *const n = &model->nodes[model->node_count++];
    n->node = node;
    n->parent = parent;
    n->local = mesh_from_matrix(&node->mTransformation);
    n->global = n->local;
    if (parent != MESH_NONE)
        n->global = mesh_multiply(&model->nodes[parent].global, &n->local);
    return 1;
}

/* A node still to be visited. */
typedef struct pending_node {
    const struct aiNode *node;
    uint32_t parent;
} pending_node;

/* Puts the children on the stack, the first on top. */
static int push_children(const struct aiNode *node, uint32_t number, pending_node **stack, size_t *used,
                         size_t *capacity)
{
    while (*capacity - *used < node->mNumChildren) {
        const size_t larger = *capacity == 0 ? 64 : 2 * *capacity;
        if (trajectory_grow(stack, larger, sizeof **stack))
            return -1;
        *capacity = larger;
    }
    for (unsigned i = node->mNumChildren; i-- > 0;)
        if (node->mChildren[i] != NULL)
            (*stack)[(*used)++] = (pending_node){node->mChildren[i], number};
    return 0;
}

/* Flattens the tree depth first, parents first. Trees may be deep, so the stack is on the heap. */
static int flatten(cgt_trajectory *t, mesh_model *model)
{
    pending_node *stack = NULL;
    size_t used = 0, capacity = 0;
    int result = add_node(t, model, model->scene->mRootNode, MESH_NONE);
    if (result > 0 && push_children(model->scene->mRootNode, 0, &stack, &used, &capacity))
        result = trajectory_fail(t, 0, "not enough memory for the nodes");
    while (result > 0 && used > 0) {
        const pending_node next = stack[--used];
        const uint32_t number = model->node_count;
        result = add_node(t, model, next.node, next.parent);
        if (result > 0 && push_children(next.node, number, &stack, &used, &capacity))
            result = trajectory_fail(t, 0, "not enough memory for the nodes");
    }
    free(stack);
    return result;
}

static int compare_names(const void *left, const void *right)
{
    const mesh_name *const a = left, *const b = right;
    const int order = strcmp(a->name, b->name);
    return order != 0 ? order : (a->node > b->node) - (a->node < b->node);
}

int mesh_read_nodes(cgt_trajectory *t, mesh_model *model)
{
    if (flatten(t, model) < 0)
        return -1;
    if (trajectory_grow(&model->by_name, model->node_count, sizeof *model->by_name))
        return trajectory_fail(t, 0, "not enough memory for %u nodes", (unsigned)model->node_count);
    for (uint32_t n = 0; n < model->node_count; n++)
        model->by_name[n] = (mesh_name){model->nodes[n].node->mName.data, n};
    qsort(model->by_name, model->node_count, sizeof *model->by_name, compare_names);
    return 1;
}

uint32_t mesh_model_find(const mesh_model *model, const struct aiString *name)
{
    uint32_t first = 0, end = model->node_count; /* the first that is not before the name lies in first .. end */
    while (first < end) {
        const uint32_t middle = first + (end - first) / 2;
        if (strcmp(model->by_name[middle].name, name->data) < 0)
            first = middle + 1;
        else
            end = middle;
    }
    const int found = first < model->node_count && strcmp(model->by_name[first].name, name->data) == 0;
    return found ? model->by_name[first].node : MESH_NONE;
}
