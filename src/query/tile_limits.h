/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The frames that go tile by tile (kernel/tile_frame/tile_trace.c), and the lights that points go to so. All others go
 * ray by ray. A header, so that tests see its parts. */
#ifndef CGT_TILE_LIMITS_H
#define CGT_TILE_LIMITS_H

#include <math.h>

#include "query/camera.h"
#include "model/committed_scene.h"

/* Limits of half a picture's width and height at distance 1: openings of 0.11 to 165 degrees. */
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

/* Whether rounding of the origins is at most a sixteenth of a pixel. The bounds of windows assume half of one, but
 * beyond this single precision decides too little, and streams of rays are faster. */
static inline bool cgt_tile_supports_origins(const cgt_camera_rays *c, double right, double up)
{
    const double off = (2 * sqrt(cgt_tile_dot(c->eye, c->eye)) + 3 * right + 2 * up) * 0x1p-23;
    return 8 * off <= right * (double)c->pixel[0] && 8 * off <= up * (double)c->pixel[1];
}

/* Whether the bounds of tile_spheres.h and tile_triangles.h hold for the camera's axes. Comparisons fail for a NaN. */
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

/* The largest distance of a light from which points go to it by tiles or packets, in sizes of the scene: from farther
 * away, single precision could not tell primitives apart by the terms that all rays share at the light. */
#define CGT_LIGHT_MAX_DISTANCE 64.0f

/* Whether points against a light may go by tiles. */
static inline bool cgt_tile_supports_light(const cgt_committed_scene *s, const cgt_light *light)
{
    float distance = 0;
    for (int a = 0; a < 3; a++)
        distance += light->kind == CGT_LIGHT_POINT ? fabsf(light->position[a]) * s->scale : 0;
    return s->loose.levels && s->valid && !s->brute_force && distance <= CGT_LIGHT_MAX_DISTANCE;
}

/* Whether a frame may go by tiles: a loose grid, no masks, and a camera of usual size. */
static inline bool cgt_tile_supports(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera)
{
    return committed_scene->valid && !committed_scene->brute_force && committed_scene->loose.levels &&
           camera->mask == UINT32_MAX && cgt_tile_supports_camera(camera);
}

#endif
