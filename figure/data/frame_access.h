/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a frame holds. */
#ifndef FRAME_ACCESS_H
#define FRAME_ACCESS_H

#include <string.h>

#include <cgt/trajectory.h>

/* The primitives of a frame: spheres or triangles. */
static inline uint32_t frame_primitives(const cgt_trajectory_frame *frame)
{
    return frame->kind == CGT_TRAJECTORY_TRIANGLES ? frame->triangles : frame->count;
}

/* The position of a sphere or a vertex. */
static inline const float *frame_place(const cgt_trajectory_frame *frame, uint32_t i)
{
    return frame->kind == CGT_TRAJECTORY_TRIANGLES ? frame->position + 3 * (size_t)i : frame->xyzr + 4 * (size_t)i;
}

/* The column of a name; NULL: there is none. */
static inline const cgt_trajectory_column *frame_column(const cgt_trajectory_frame *frame, const char *name)
{
    for (uint32_t i = 0; i < frame->columns; i++)
        if (strcmp(frame->column[i].name, name) == 0)
            return &frame->column[i];
    return NULL;
}

/* Whether it has a box: an edge that is not 0. */
static inline int frame_has_box(const cgt_trajectory_frame *frame)
{
    int has = 0;
    for (int e = 0; e < 3; e++)
        for (int c = 0; c < 3; c++)
            has |= frame->box_edge[e][c] != 0.0;
    return has;
}

#endif
