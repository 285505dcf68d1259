/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which frames tiles serve (kernel/tile_trace.c). All others go packet by packet. */
#ifndef CGT_TILE_SERVES_H
#define CGT_TILE_SERVES_H

#include <math.h>

#include "camera.h"
#include "world.h"

/* Half a picture's width and height at distance 1: openings of 0.11 to 165 degrees. */
#define CGT_TILE_NARROWEST 0x1p-10
#define CGT_TILE_WIDEST 8.0

static inline double cgt_tile_dot(const float a[3], const float b[3])
{
    return (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
}

/* The bounds of tile_spheres.h and tile_triangles.h hold for axes like these. Comparisons fail for what is not a number. */
static inline bool cgt_tile_serves_camera(const cgt_camera_rays *c)
{
    const double right = sqrt(cgt_tile_dot(c->right, c->right)), up = sqrt(cgt_tile_dot(c->up, c->up));
    const bool unit = fabs(cgt_tile_dot(c->fwd, c->fwd) - 1) <= 0x1p-22;
    const bool orthogonal = fabs(cgt_tile_dot(c->fwd, c->right)) <= 0x1p-22 * right &&
                            fabs(cgt_tile_dot(c->fwd, c->up)) <= 0x1p-22 * up &&
                            fabs(cgt_tile_dot(c->right, c->up)) <= 0x1p-22 * right * up;
    for (int a = 0; a < 3; a++)
        if (!(fabsf(c->eye[a]) <= CGT_WORLD_LARGEST))
            return false;
    return !c->orthographic && unit && orthogonal && right >= CGT_TILE_NARROWEST && up >= CGT_TILE_NARROWEST &&
           right <= CGT_TILE_WIDEST && up <= CGT_TILE_WIDEST && c->t_min >= 0;
}

static inline bool cgt_tile_serves(const cgt_world *world, const cgt_camera_rays *camera)
{
    return world->valid && !world->everything && world->loose.levels && cgt_tile_serves_camera(camera);
}

#endif
