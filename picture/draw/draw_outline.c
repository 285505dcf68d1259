/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Outlines, from the planes of a frame: at the rim of what is in front of something farther off, on the nearer side, so
 * that the background stays clean; and, lighter, where two primitives meet at an angle (Saito, Takahashi,
 * "Comprehensible Rendering of 3-D Shapes", SIGGRAPH 1990). */
#include <math.h>

#include "draw/draw.h"

static const float crease_share = 0.45f;  /* how dark a crease is */
static const float crease_cosine = 0.75f; /* of normals that make one */
static const float rim_rays = 6.0f;       /* a step in depth of so many rays' widths, times the line's, is a rim */

/* How dark the line is because of the neighbour k. */
static float line_between(const drawing *d, size_t center, size_t k, float step)
{
    if (d->primitive[k] == CGT_INVALID_ID) /* of a layer: what is opaque may hide that it goes on */
        return d->behind && d->behind->t[k] < d->t[center] ? 0.0f : 1.0f;
    if (d->primitive[k] == d->primitive[center] && d->geometry[k] == d->geometry[center])
        return 0.0f;
    /* Where the surface goes on in its own plane, only the normals tell; a step behind it is a rim. */
    const float depth = d->t[k] - d->t[center];
    if (depth > step)
        return 1.0f;
    float cosine = 0.0f;
    for (int c = 0; c < 3; c++)
        cosine += d->normal[c][center] * d->normal[c][k];
    return depth >= 0.0f && fabsf(cosine) < crease_cosine ? crease_share : 0.0f;
}

float cgt_draw_outline_at(const drawing *d, uint32_t x, uint32_t y)
{
    static const float around[8][2] = {{1, 0},  {0.7071f, 0.7071f},   {0, 1},  {-0.7071f, 0.7071f},
                                       {-1, 0}, {-0.7071f, -0.7071f}, {0, -1}, {0.7071f, -0.7071f}};
    const size_t center = (size_t)y * d->ray_width + x;
    const picture_look *look = draw_look(d, d->geometry[center]);
    if (look->of.lineless_from && d->primitive[center] >= look->of.lineless_from - 1)
        return 0.0f;
    const float width = fmaxf(1.0f, d->options->style.outline * (float)d->options->antialias);
    /* A ray's width and height in the world at this depth. */
    float size = 0.0f;
    for (int c = 0; c < 3; c++)
        size += d->up[c] * d->up[c];
    size = sqrtf(size) * 2.0f / (float)d->ray_height;
    if (d->camera.projection == CGT_PROJECTION_PERSPECTIVE)
        size *= d->t[center];
    float line = 0.0f;
    for (int i = 0; i < 8; i++) {
        const int64_t nx = (int64_t)x + lrintf(around[i][0] * width), ny = (int64_t)y + lrintf(around[i][1] * width);
        if (nx < 0 || ny < 0 || nx >= (int64_t)d->ray_width || ny >= (int64_t)d->ray_height)
            continue;
        line = fmaxf(line, line_between(d, center, (size_t)ny * d->ray_width + (size_t)nx, rim_rays * width * size));
    }
    return line;
}
