/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes for which every structure must find the same hits: of all sizes and positions, empty and spoilt ones included;
 * and rays for them, many along the planes at which structures split. A failure here fails the test. */
#ifndef STRUCTURE_SCENES_H
#define STRUCTURE_SCENES_H

#include "structures/scenes/random_soup.h"

typedef enum structure_kind {
    STRUCTURE_SOUP,                                       /* the kinds of random_soup.h in order */
    STRUCTURE_CLOUD = STRUCTURE_SOUP + (int)SOUP_KINDS,   /* the kinds of scenes.h */
    STRUCTURE_COINCIDENT = STRUCTURE_CLOUD + CLOUD_KINDS, /* copies of a sphere and of a triangle */
    STRUCTURE_SKIPPED,                                    /* several geometries, some empty, most primitives skipped */
    STRUCTURE_ALL_SKIPPED,
    STRUCTURE_NONE,
    STRUCTURE_ONE_SPHERE,
    STRUCTURE_ONE_TRIANGLE,
    STRUCTURE_TINY,   /* 2^-60 in size, at the origin */
    STRUCTURE_BEYOND, /* coordinates beyond 2^55 */
    STRUCTURE_LARGE,  /* thousands of primitives: builders use several tasks */
    STRUCTURE_KINDS
} structure_kind;

typedef struct structure_scene {
    hard_scene scene;
    cloud where; /* without spheres: approximate position and extent only */
    char name[48];
    uint32_t skipped;
} structure_scene;

const char *structure_name(structure_kind kind);

structure_scene structure_scene_make(structure_kind kind, uint64_t stream);
void structure_scene_free(structure_scene *s);

/* Replaces the scene's rays: random ones; with a common origin; and through corners and along edges of a lattice. */
void structure_rays(structure_scene *s, uint32_t count);

#endif
