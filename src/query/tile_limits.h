/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which frames tiles serve (kernel/tile_trace.c). All others go packet by packet. */
#ifndef CGT_TILE_SERVES_H
#define CGT_TILE_SERVES_H

#include <math.h>

#include "query/camera.h"
#include "model/committed_scene.h"

/* Half a picture's width and height at distance 1: openings of 0.11 to 165 degrees. */
#define CGT_TILE_MIN_EXTENT 0x1p-10
#define CGT_TILE_MAX_EXTENT 8.0

/* The same of an orthographic picture: squares and their reciprocals stay far from the ends of float's range. */
#define CGT_TILE_MIN_PARALLEL_EXTENT 0x1p-40
#define CGT_TILE_MAX_PARALLEL_EXTENT 0x1p40

static inline double cgt_tile_dot(const float a[3], const float b[3])
{
    return (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
}

static inline bool cgt_tile_in_range(double length, double least, double most)
{
    return length >= least && length <= most;
}

/* Whether the picture has room for the windows' slack: rounding of the origins is at most half a pixel. Beyond that all
 * would be left open, and packets are faster. */
static inline bool cgt_tile_supports_origins(const cgt_camera_rays *c, double right, double up)
{
    const double off = (2 * sqrt(cgt_tile_dot(c->eye, c->eye)) + 3 * right + 2 * up) * 0x1p-23;
    return off <= right * (double)c->pixel[0] && off <= up * (double)c->pixel[1];
}

/* The bounds of tile_spheres.h and tile_triangles.h hold for axes like these. Comparisons fail for what is not a number. */
static inline bool cgt_tile_supports_camera(const cgt_camera_rays *c)
{
    const double right = sqrt(cgt_tile_dot(c->right, c->right)), up = sqrt(cgt_tile_dot(c->up, c->up));
    const bool unit = fabs(cgt_tile_dot(c->fwd, c->fwd) - 1) <= 0x1p-22;
    const bool orthogonal = fabs(cgt_tile_dot(c->fwd, c->right)) <= 0x1p-22 * right &&
                            fabs(cgt_tile_dot(c->fwd, c->up)) <= 0x1p-22 * up &&
                            fabs(cgt_tile_dot(c->right, c->up)) <= 0x1p-22 * right * up;
    for (int a = 0; a < 3; a++)
        if (!(fabsf(c->eye[a]) <= CGT_MAX_COORDINATE))
            return false;
    const double least = c->orthographic ? CGT_TILE_MIN_PARALLEL_EXTENT : CGT_TILE_MIN_EXTENT;
    const double most = c->orthographic ? CGT_TILE_MAX_PARALLEL_EXTENT : CGT_TILE_MAX_EXTENT;
    return unit && orthogonal && cgt_tile_in_range(right, least, most) && cgt_tile_in_range(up, least, most) &&
           (!c->orthographic || cgt_tile_supports_origins(c, right, up)) && c->t_min >= 0;
}

static inline bool cgt_tile_supports(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera)
{
    return committed_scene->valid && !committed_scene->brute_force && committed_scene->loose.levels &&
           cgt_tile_supports_camera(camera);
}

#endif
