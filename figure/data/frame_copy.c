/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Copies of frames; see frame_copy.h. */
#include "data/frame_copy.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Copies count elements of `floats` floats each; the array is not NULL even where there are none. */
static int copy_floats(void **array, size_t *capacity, const float *from, size_t count, size_t floats)
{
    if (count > SIZE_MAX / (floats * sizeof(float)))
        return -1;
    const size_t bytes = count * floats * sizeof(float), wanted = bytes ? bytes : 1;
    if (wanted > *capacity) {
        free(*array); /* what it held is of another frame */
        *array = malloc(wanted);
        *capacity = *array ? wanted : 0;
        if (!*array)
            return -1;
    }
    if (bytes)
        memcpy(*array, from, bytes);
    return 0;
}

int cgt_frame_copy_set(frame_copy *copy, const cgt_trajectory_frame *frame)
{
    const int triangles = frame->kind == CGT_TRAJECTORY_TRIANGLES;
    copy->frame = *frame;
    copy->frame.id = copy->frame.type = NULL;
    copy->frame.velocity = NULL;
    if (copy_floats(&copy->places, &copy->place_bytes, triangles ? frame->position : frame->xyzr, frame->count,
                    triangles ? 3 : 4))
        return -1;
    if (triangles)
        copy->frame.position = copy->places;
    else
        copy->frame.xyzr = copy->places;
    if (!frame->vertex_normal)
        return 0;
    if (copy_floats(&copy->normals, &copy->normal_bytes, frame->vertex_normal, frame->count, 3))
        return -1;
    copy->frame.vertex_normal = copy->normals;
    return 0;
}

void cgt_frame_copy_free(frame_copy *copy)
{
    free(copy->places);
    free(copy->normals);
    memset(copy, 0, sizeof *copy);
}
