/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Meshes in a build without assimp: the usual endings are recognised, so that the error tells what is missing. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_internal.h"

#include <strings.h>

static int absent_knows(const char *ending)
{
    static const char *const endings[] = {".3ds",     ".blend", ".dae", ".fbx", ".glb", ".gltf", ".ifc", ".lwo",
                                          ".md5mesh", ".obj",   ".off", ".ply", ".stl", ".x",    ".x3d", ".zae"};
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++)
        if (strcasecmp(ending, endings[i]) == 0)
            return 1;
    return 0;
}

static int absent_begin(cgt_trajectory *t)
{
    return trajectory_fail(t, 0, "meshes are read by assimp, which this build does not have");
}

static int absent_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    (void)frame;
    return absent_begin(t);
}

const trajectory_format trajectory_format_mesh = {
    .knows = absent_knows,
    .state_size = 1,
    .begin = absent_begin,
    .read = absent_read,
};
