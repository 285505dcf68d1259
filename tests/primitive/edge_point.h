/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points where triangles meet, as targets of rays. */
#ifndef EDGE_POINT_H
#define EDGE_POINT_H

#include "hard_cases/hard_scene.h"

/* A vertex of a random triangle of the scene, one time in three, otherwise a rounded point of an edge. Returns false if
 * the scene has no triangle. */
static inline bool edge_point(hard_scene *s, float point[3])
{
    float v[3][3];
    const double along = random_below(&s->random, 3) ? hard_real(s, 0, 1) : 0;
    if (!hard_any_triangle(s, v))
        return false;
    const int k = (int)random_below(&s->random, 3), l = (k + 1) % 3;
    for (int a = 0; a < 3; a++)
        point[a] = (float)(v[k][a] + along * ((double)v[l][a] - v[k][a]));
    return true;
}

#endif
