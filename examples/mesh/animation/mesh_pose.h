/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A mesh at a time of its animation.
 *   clip   which animation, and how many frames it has
 *   pose   where the nodes are at one time */
#ifndef MESH_POSE_H
#define MESH_POSE_H

#include "mesh/mesh_model.h"

typedef struct mesh_clip {
    const struct aiAnimation *animation; /* NULL: the file has none */
    double ticks_per_second;
    double seconds;  /* how long it lasts */
    uint64_t frames; /* at the options' rate, first and last moment included; 1 where it lasts no time */
} mesh_clip;

typedef struct mesh_pose {
    const struct aiNodeAnim **channel; /* what moves each node; NULL: nothing */
    mesh_transform *global;            /* of each node */
    mesh_transform *bones;             /* scratch: from the mesh to the world, for the bones of one skin */
} mesh_pose;

/* mesh_clip.c: chooses the clip of the options. Returns 1, or -1 with an error noted: there is no such clip. */
int mesh_clip_choose(trajectory *t, const mesh_model *model, mesh_clip *clip);

/* Seconds from the begin of the clip to frame `number`, at most the clip's length. */
double mesh_clip_time(const mesh_clip *clip, double fps, uint64_t number);

/* Makes room for a pose. Returns 1, or -1 with an error noted; the pose has to be given back in either case. */
int mesh_pose_begin(trajectory *t, const mesh_model *model, const mesh_clip *clip, mesh_pose *pose);
void mesh_pose_end(mesh_pose *pose);

/* Puts all nodes where they are at this time. */
void mesh_pose_set(mesh_pose *pose, const mesh_model *model, const mesh_clip *clip, double seconds);

/* mesh_deform.c: the vertices under a pose: 3 floats each, as many as the model has. normal: NULL for none. */
void mesh_deform(const mesh_model *model, mesh_pose *pose, float *position, float *normal);

#endif
