/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Random scenes of triangles, and of triangles and spheres, of size 1 about the origin, and cameras for them. */
#ifndef RANDOM_SOUP_H
#define RANDOM_SOUP_H

#include "hard_cases/hard_scene.h"
#include "support/scenes.h"

typedef enum soup_kind {
    SOUP_SIX_ORDERS,   /* 1e-3 to 1e3 times the typical size, few of the largest */
    SOUP_CLUSTERED,    /* in a few dense clumps */
    SOUP_PLANAR,       /* in one plane, half of them exactly, the others tilted by a slope of one half */
    SOUP_AXIS_ALIGNED, /* each in a plane perpendicular to an axis, vertices on a lattice */
    SOUP_DEGENERATE,   /* three of four are points, lines, needles, copies or not finite */
    SOUP_MIXED,        /* triangles and spheres in four geometries */
    SOUP_KINDS
} soup_kind;

const char *soup_name(soup_kind kind);

/* A scene without rays. A failure here fails the test. Release it with hard_scene_free. */
hard_scene soup_make(soup_kind kind, uint64_t stream, uint32_t primitives);

/* Around or inside the soup, with any projection and field of view. */
cgt_camera soup_camera(hard_scene *s);

#endif
