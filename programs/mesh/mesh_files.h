/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The files that assimp may open for a mesh: the mesh itself, and regular files in its folder and those below. What a
 * file names may lie nowhere else. */
#ifndef MESH_FILES_H
#define MESH_FILES_H

#include <assimp/cfileio.h>

#include "trajectory/trajectory_internal.h"

typedef struct mesh_opened {
    const cgt_trajectory *t;
    uint64_t bytes; /* of all files that were opened */
} mesh_opened;

/* Opens files for assimp as long as *opened exists. */
struct aiFileIO mesh_files(mesh_opened *opened);

#endif
