/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reads a file of meshes by assimp, with checks before, during and after: assimp may drop what it does not understand
 * with no more than a line in its log, and aborts the program where a mesh contradicts itself. */
#define _GNU_SOURCE /* strcasestr */
#include "mesh/mesh_files.h"
#include "mesh/mesh_model.h"

#include <inttypes.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include <assimp/cimport.h>
#include <assimp/postprocess.h>

/* ---- assimp's log ------------------------------------------------------------------------------------------- */

typedef struct import_log {
    cgt_trajectory_mesh *facts;
    char lost[256]; /* the first line that reports lost triangles; "" for none */
} import_log;

/* Phrases in log lines that report a loss. The import succeeds after each of them. */
static const char *const loss_phrases[] = {
    "vertices were dropped",
    "number of faces in the header is incorrect", /* OFF */
    "number of verts in the header is incorrect",
    "skipping this element instance", /* PLY */
    "unexpected eof",
    "unexpected end",
};

static int mentions_loss(const char *line)
{
    for (size_t i = 0; i < sizeof loss_phrases / sizeof loss_phrases[0]; i++)
        if (strcasestr(line, loss_phrases[i]) != NULL)
            return 1;
    return 0;
}

/* Copies one line without its line feed. */
static void copy_line(char *copy, size_t size, const char *line)
{
    const size_t length = strcspn(line, "\r\n");
    snprintf(copy, size, "%.*s", (int)(length < size ? length : size - 1), line);
}

/* Lines read "Warn,  T0: text"; the level comes first. */
static void on_log_line(const char *line, char *user)
{
    import_log *const log = (import_log *)(void *)user;
    if (strncmp(line, "Warn", 4) != 0 && strncmp(line, "Error", 5) != 0)
        return;
    const char *colon = strstr(line, ": ");
    const char *text = colon != NULL ? colon + 2 : line;
    log->facts->warnings++;
    if (log->facts->warning[0] == '\0')
        copy_line(log->facts->warning, sizeof log->facts->warning, text);
    if (log->lost[0] == '\0' && mentions_loss(text))
        copy_line(log->lost, sizeof log->lost, text);
}

/* ---- Faces -------------------------------------------------------------------------------------------------- */

/* Adds up the faces of the scene. A polygon of n corners is n - 2 triangles. */
static uint64_t count_faces(const struct aiScene *scene, uint64_t *points, uint64_t *lines)
{
    uint64_t triangles = 0;
    *points = *lines = 0;
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        const struct aiMesh *const mesh = scene->mMeshes[m];
        for (unsigned f = 0; f < mesh->mNumFaces; f++) {
            const unsigned corners = mesh->mFaces[f].mNumIndices;
            *points += corners == 1;
            *lines += corners == 2;
            triangles += corners > 2 ? corners - 2 : 0;
        }
    }
    return triangles;
}

static uint64_t count_triangles(const struct aiScene *scene)
{
    uint64_t triangles = 0;
    for (unsigned m = 0; m < scene->mNumMeshes; m++)
        for (unsigned f = 0; f < scene->mMeshes[m]->mNumFaces; f++)
            triangles += scene->mMeshes[m]->mFaces[f].mNumIndices == 3;
    return triangles;
}

static int has_polygon(const struct aiMesh *mesh)
{
    for (unsigned f = 0; f < mesh->mNumFaces; f++)
        if (mesh->mFaces[f].mNumIndices > 3)
            return 1;
    return 0;
}

/* Cuts polygons into triangles. assimp aborts the program where a mesh claims to have polygons and has none. */
static int cut_polygons(cgt_trajectory *t, mesh_model *model)
{
    int has_polygons = 0;
    for (unsigned m = 0; m < model->scene->mNumMeshes; m++) {
        const struct aiMesh *const mesh = model->scene->mMeshes[m];
        const int found = has_polygon(mesh);
        if ((mesh->mPrimitiveTypes & aiPrimitiveType_POLYGON) != 0 && !found)
            return trajectory_fail(t, 0, "mesh %u claims to have polygons, but has none: the file is damaged", m);
        has_polygons |= found;
    }
    if (has_polygons) {
        /* frees the scene on a failure */
        model->scene = aiApplyPostProcessing(model->scene, aiProcess_Triangulate);
    }
    return model->scene != NULL ? 1 : trajectory_fail(t, 0, "assimp: %s", aiGetErrorString());
}

/* ---- The file ----------------------------------------------------------------------------------------------- */

static const struct aiScene *import_file(const cgt_trajectory *t, import_log *log, uint64_t *bytes)
{
    const struct aiLogStream stream = {on_log_line, (char *)(void *)log};
    aiAttachLogStream(&stream);
    /* assimp must not join vertices: it treats near ones as equal, and a NaN as equal to anything. */
    mesh_opened opened = {.t = t};
    struct aiFileIO files = mesh_files(&opened);
    const struct aiScene *const scene = aiImportFileEx(t->path, aiProcess_ValidateDataStructure, &files);
    aiDetachLogStream(&stream);
    *bytes = opened.bytes;
    return scene;
}

int mesh_import_scene(cgt_trajectory *t, mesh_model *model)
{
    import_log log = {.facts = &model->facts};
    model->scene = import_file(t, &log, &model->bytes);
    if (model->scene == NULL) {
        char text[600];
        copy_line(text, sizeof text, aiGetErrorString());
        return trajectory_fail(t, 0, "assimp: %s", text);
    }
    if (log.lost[0] != '\0')
        return trajectory_fail(t, 0, "not all of the file could be read; assimp: %s", log.lost);
    if (model->scene->mRootNode == NULL)
        return trajectory_fail(t, 0, "the file holds no mesh");
    const uint64_t expected = count_faces(model->scene, &model->facts.points, &model->facts.lines);
    if (expected == 0)
        return trajectory_fail(t, 0, "the file holds no triangles: %" PRIu64 " points, %" PRIu64 " lines",
                               model->facts.points, model->facts.lines);
    if (cut_polygons(t, model) < 0)
        return -1;
    model->facts.lost_triangles = expected - count_triangles(model->scene);
    model->facts.meshes = model->scene->mNumMeshes;
    model->facts.clips = model->scene->mNumAnimations;
    return 1;
}

int mesh_import(cgt_trajectory *t, mesh_model *model)
{
    if (mesh_check_file(t) < 0)
        return -1;
    if (mesh_is_gltf(strrchr(t->path, '.'))) {
#ifdef CGT_HAVE_GLTF
        return mesh_import_gltf(t, model);
#else /* assimp plays steps as lines, and leaves out morph targets and extensions that a file requires */
        return trajectory_fail(t, 0, "glTF is read by tinygltf, which this build does not have");
#endif
    }
    /* assimp's logger and its last error are those of the process; and a child that is made while another thread holds
     * one of assimp's locks never gets it */
    static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&one_at_a_time);
    const int status = mesh_rehearse(t) < 0 ? -1 : mesh_import_scene(t, model);
    pthread_mutex_unlock(&one_at_a_time);
    return status;
}
