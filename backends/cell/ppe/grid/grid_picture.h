/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A picture of spheres by a Cell, for programs that shade: ids by the SPEs, t and normals of them by the PPE, in the
 * bits that cgt_trace_camera gives. */
#ifndef CGT_GRID_PICTURE_H
#define CGT_GRID_PICTURE_H

#include "cell/ppe/grid/grid_frame.h"

typedef struct cgt_grid_picture {
    const float *sphere; /* `count` times x, y, z, radius; the id of a hit is the number here. NULL where count is 0 */
    uint32_t count;
    cgt_camera camera;
    uint32_t width, height;         /* pixels */
    cgt_grid_frame_options options; /* keep_doubts stays false, or ids are not exact */
    cgt_tile_visitor *visitor;      /* gets t, primitive and normal; what else a tile has is NULL */
    void *user;
    const cgt_memory_hooks *memory; /* NULL: the C library's functions */
} cgt_grid_picture;

/* Traces the picture, then calls the visitor with its strips of CGT_STRIP_ROWS whole rows, from top to bottom, on the
 * calling thread. Primitive, t and normal have the bits of cgt_trace_camera with default options for a scene of these
 * spheres: an id is exact (grid_frame.h), and t and normal are functions of ray and sphere. A miss is CGT_INVALID_ID,
 * infinity, 0. For the host's threads at once, as long as the pictures are different ones.
 * As cgt_grid_scene_init and cgt_grid_frame_trace: INVALID_ARGUMENT, TOO_LARGE, OUT_OF_MEMORY, THREADS, STOPPED, with a
 * sentence in result->message; STOPPED without one where the visitor stopped. */
cgt_result cgt_grid_picture_trace(const cgt_grid_picture *picture, cgt_cell_frame_result *result);

#endif
