/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A file of meshes, step by step. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/mesh_model.h"

#include <stdlib.h>
#include <string.h>

#include <assimp/cimport.h>

int mesh_model_read(cgt_trajectory *t, mesh_model *model)
{
    memset(model, 0, sizeof *model);
    if (mesh_import(t, model) < 0 || mesh_read_nodes(t, model) < 0 || mesh_read_skins(t, model) < 0)
        return -1;
    return mesh_merge(t, model);
}

void mesh_model_free(mesh_model *model)
{
    for (unsigned m = 0; model->skins != NULL && m < model->scene->mNumMeshes; m++) {
        free(model->skins[m].bones);
        free(model->skins[m].first);
        free(model->skins[m].influences);
    }
    for (uint32_t p = 0; p < model->part_count; p++)
        free(model->parts[p].source);
    free(model->skins);
    free(model->parts);
    free(model->nodes);
    free(model->by_name);
    free(model->index);
#ifdef CGT_HAVE_GLTF
    if (model->is_gltf) {
        mesh_free_gltf((struct aiScene *)(uintptr_t)model->scene);
        model->scene = NULL;
    }
#endif
    if (model->scene != NULL)
        aiReleaseImport(model->scene);
    memset(model, 0, sizeof *model);
}
