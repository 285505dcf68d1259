/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A frame with arrays of its own, so that the next one can be read while this one is drawn. */
#ifndef FRAME_COPY_H
#define FRAME_COPY_H

#include <stddef.h>

#include <cgt/trajectory.h>

typedef struct frame_copy {
    cgt_trajectory_frame frame; /* its arrays are those below; NULL where they were not copied */
    void *places;               /* xyzr or position */
    void *normals;              /* vertex_normal */
    void *corners;              /* index, where cgt_frame_copy_index was called */
    size_t place_bytes, normal_bytes, corner_bytes;
} frame_copy;

/* Copies what drawing takes: spheres, or vertices and their normals. Other arrays of the copy are NULL, but for the
 * triangles' indices, which are those of the trajectory, since all its frames share them. Arrays grow and are used
 * again; a copy begins as all zero. Returns 0, or -1 where there is no memory. */
int cgt_frame_copy_set(frame_copy *copy, const cgt_trajectory_frame *frame);

/* Copies these indices, too, so that the copy outlives the trajectory. Returns as above. */
int cgt_frame_copy_index(frame_copy *copy);

/* As cgt_frame_copy_set, but places and normals are the frame's own, which must stay as they are. */
void cgt_frame_copy_refer(frame_copy *copy, const cgt_trajectory_frame *frame);

void cgt_frame_copy_free(frame_copy *copy);

/* A frame with all arrays its own, in one block that free() takes. NULL: no memory. *bytes gets the block's size. */
cgt_trajectory_frame *cgt_frame_clone(const cgt_trajectory_frame *frame, size_t *bytes);

#endif
