/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The scene: geometries that the caller described, and the structure of the last commit. */
#ifndef CGT_SCENE_H
#define CGT_SCENE_H

#include "context.h"
#include "queue_grid.h"

typedef struct cgt_geometry {
    bool used;
    cgt_kind kind;
    union { /* strides filled in */
        cgt_spheres spheres;
        cgt_triangles triangles;
    };
} cgt_geometry;

struct cgt_scene {
    cgt_context *context;
    cgt_scene_options options;
    cgt_buffer geometry; /* cgt_geometry, by id */
    uint32_t geometries; /* length of it, free ones included */
    bool committed;      /* nothing changed since the last commit */

    cgt_buffer arrays;      /* cgt_object_array of the commit */
    cgt_buffer summaries;   /* cgt_object_summary, one per chunk of objects */
    cgt_buffer voxels;      /* cgt_voxel or cgt_wide_voxel */
    cgt_buffer overflow[2]; /* cgt_overflow: as they came, and room to sort */
    cgt_queue_grid grid;
    cgt_scene_statistics statistics;
};

#endif
