/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A mesh at a time of its animation.
 *   clip   which animation, and how many frames it has
 *   pose   the nodes at one time */
#ifndef MESH_POSE_H
#define MESH_POSE_H

#include "mesh/mesh_model.h"

typedef struct mesh_clip {
    const struct aiAnimation *animation; /* NULL: none in the file */
    double ticks_per_second;
    double seconds;  /* duration */
    uint64_t frames; /* at the options' rate, both ends included; 1 where the duration is 0 */
} mesh_clip;

typedef struct mesh_pose {
    const struct aiNodeAnim **channel; /* of each node; NULL: it does not move */
    mesh_transform *global;            /* of each node */
    mesh_transform *bones;             /* scratch: from the mesh to the world, for the bones of one skin */
} mesh_pose;

/* mesh_clip.c: chooses the clip of the options. Returns 1, or -1 with an error noted: no such clip. */
int mesh_clip_choose(cgt_trajectory *t, const mesh_model *model, mesh_clip *clip);

/* Seconds from the start of the clip to frame `number`, at most the clip's length. */
double mesh_clip_time(const mesh_clip *clip, double fps, uint64_t number);

/* Allocates a pose. Returns 1, or -1 with an error noted; end the pose in either case. */
int mesh_pose_begin(cgt_trajectory *t, const mesh_model *model, const mesh_clip *clip, mesh_pose *pose);
void mesh_pose_end(mesh_pose *pose);

/* Sets all nodes for this time. */
void mesh_pose_set(mesh_pose *pose, const mesh_model *model, const mesh_clip *clip, double seconds);

/* mesh_deform.c: the vertices under a pose: 3 floats each, as many as the model has. normal: NULL for none. */
void mesh_deform(const mesh_model *model, mesh_pose *pose, float *position, float *normal);

#endif
