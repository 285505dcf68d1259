/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes that stress bounds, sizes and cells: spheres and triangles in several geometries with several strides. Each
 * array has memory of its own that ends with its last element. */
#ifndef LOOSE_SCENES_H
#define LOOSE_SCENES_H

#include "support/scenes.h"

typedef enum loose_kind {
    LOOSE_UNIFORM,
    LOOSE_CLUSTERED,
    LOOSE_FLAT,   /* all centres in one plane perpendicular to z */
    LOOSE_LINE,   /* along y */
    LOOSE_ORDERS, /* sizes over 30 orders of magnitude, and points */
    LOOSE_POINTS,
    LOOSE_COINCIDENT,
    LOOSE_LATTICE, /* integers: centres on the cells' planes, degenerate triangles */
    LOOSE_FAR,     /* small and far from the origin */
    LOOSE_HUGE,
    LOOSE_TINY,
    LOOSE_SPOILED, /* a third is not finite, negative or has no area */
    LOOSE_STADIUM, /* few large primitives, most in a small corner */
    LOOSE_LAYERS,  /* flat, in a few planes perpendicular to each axis, +0 and -0 among them */
    LOOSE_WIDE,    /* all numbers from near the smallest to 2^53, with overlaps */
    LOOSE_FAN,     /* all share a point */
    LOOSE_GARBAGE, /* arbitrary bits: most are skipped */
    LOOSE_POWERS,  /* each half as far away as the one before it, along an axis */
    LOOSE_SPACE,   /* so, along three */
    LOOSE_STRAY,   /* one far from a plane of small ones */
    LOOSE_HEAPS,   /* at two places, one unit in the last place apart */
    LOOSE_DENORMAL,
    LOOSE_KINDS
} loose_kind;

const char *loose_name(loose_kind kind);

typedef enum loose_what { LOOSE_SPHERES, LOOSE_TRIANGLES, LOOSE_BOTH } loose_what;

#define LOOSE_ARRAYS 16

typedef struct loose_scene {
    void *array[LOOSE_ARRAYS];
    uint32_t arrays;
    cgt_spheres spheres[8];
    cgt_triangles triangles[8];
    uint32_t geometries;
    bool sphere[8]; /* whether geometry i has spheres */
} loose_scene;

loose_scene loose_make(test_random *r, loose_kind kind, loose_what what, uint32_t count);
void loose_free(loose_scene *s);

/* Not committed. */
cgt_scene *loose_add(const loose_scene *s, cgt_context *context, const cgt_scene_options *options);

#endif
