/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Meshes as a trajectory: the file is read once, when it is opened; each frame is a pose. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/animation/mesh_pose.h"

#include <stdlib.h>

#include <assimp/cimport.h>

typedef struct mesh_state {
    int opened; /* model, clip and pose are ready: rewinding does not read the file again */
    mesh_model model;
    mesh_clip clip;
    mesh_pose pose;
    float *position;
    float *normal; /* NULL where the file has no normals */
} mesh_state;

/* glTF is known without assimp, which takes a tenth of a second to load. */
static int mesh_knows(const char *ending) { return mesh_is_gltf(ending) || aiIsExtensionSupported(ending) == AI_TRUE; }

static int open_mesh(cgt_trajectory *t, mesh_state *s)
{
    if (!t->regular)
        return trajectory_fail(t, 0, "a mesh has to be a regular file");
    if (mesh_model_read(t, &s->model) < 0 || mesh_clip_choose(t, &s->model, &s->clip) < 0 ||
        mesh_pose_begin(t, &s->model, &s->clip, &s->pose) < 0)
        return -1;
    if (s->clip.animation != NULL)
        s->model.facts.still_channels = s->clip.animation->mNumMeshChannels + s->clip.animation->mNumMorphMeshChannels;
    if (trajectory_grow(&s->position, s->model.vertices, 3 * sizeof *s->position) ||
        (s->model.has_normals && trajectory_grow(&s->normal, s->model.vertices, 3 * sizeof *s->normal)))
        return trajectory_fail(t, 0, "not enough memory for %u vertices", (unsigned)s->model.vertices);
    s->opened = 1;
    return 1;
}

static int mesh_begin(cgt_trajectory *t)
{
    mesh_state *const s = t->state;
    return s->opened ? 1 : open_mesh(t, s);
}

static int mesh_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    mesh_state *const s = t->state;
    if (t->next >= s->clip.frames)
        return 0;
    mesh_pose_set(&s->pose, &s->model, &s->clip, mesh_clip_time(&s->clip, t->options.fps, t->next));
    mesh_deform(&s->model, &s->pose, s->position, s->normal);
    for (size_t axis = 0; axis < 3; axis++)
        trajectory_move(t, axis, s->position + axis, 3, s->model.vertices);
    trajectory_frame_fill_triangles(t, frame, s->model.vertices, s->model.triangles);
    frame->index = s->model.index;
    frame->position = s->position;
    frame->vertex_normal = s->normal;
    return 1;
}

static int mesh_skip(cgt_trajectory *t)
{
    const mesh_state *const s = t->state;
    return t->next < s->clip.frames;
}

static void mesh_end(cgt_trajectory *t)
{
    mesh_state *const s = t->state;
    mesh_pose_end(&s->pose);
    mesh_model_free(&s->model);
    free(s->position);
    free(s->normal);
}

static const cgt_trajectory_mesh *mesh_facts(const cgt_trajectory *t)
{
    const mesh_state *const s = t->state;
    return &s->model.facts;
}

static double mesh_progress(const cgt_trajectory *t)
{
    const mesh_state *const s = t->state;
    return (double)t->next / (double)s->clip.frames;
}

const trajectory_format trajectory_format_mesh = {
    .knows = mesh_knows,
    .keeps_state = 1,
    .state_size = sizeof(mesh_state),
    .begin = mesh_begin,
    .read = mesh_read,
    .skip = mesh_skip,
    .end = mesh_end,
    .mesh = mesh_facts,
    .progress = mesh_progress,
};
