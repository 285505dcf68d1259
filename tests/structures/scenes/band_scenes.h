/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes of spheres and triangles whose coordinates have any magnitude that a float has, and rays for them. */
#ifndef BAND_SCENES_H
#define BAND_SCENES_H

#include "support/scenes.h"

typedef enum band_kind {
    BAND_ONE_SCALE, /* a cloud of one size, anywhere in the range of float */
    BAND_STRAYS,    /* a cloud of usual size, and strays at 2^40 and more */
    BAND_MIXED,     /* each primitive has a magnitude of its own */
    BAND_FLAT,      /* strays with coordinates near 0, whose last bits a small power of two would lose */
    BAND_DENORMAL,  /* or nearly so, where t of many bits is denormal: it could be rounded twice */
    BAND_KINDS
} band_kind;

typedef struct band_scene {
    uint32_t spheres, triangles;
    float (*sphere)[4], (*vertex)[3];
    float *size; /* of each primitive, spheres first: about how far it and its neighbours extend */
} band_scene;

band_scene band_scene_make(test_random *r, band_kind kind, uint32_t spheres, uint32_t triangles);
void band_scene_free(band_scene *s);

/* Commits a scene of two or three geometries; the last one has mask 1. */
cgt_scene *band_scene_commit(cgt_context *context, const test_scene_options *options, const band_scene *s);

#define BAND_RAYS 256u

/* Rays between primitives, of any length and range; with masks, and primitives that they skip. */
typedef struct band_rays {
    float org[3][BAND_RAYS], dir[3][BAND_RAYS], t_min[BAND_RAYS], t_max[BAND_RAYS];
    uint32_t mask[BAND_RAYS], skip_primitive[BAND_RAYS], skip_geometry[BAND_RAYS];
} band_rays;

void band_rays_make(test_random *r, const band_scene *s, band_rays *rays);
cgt_rays band_rays_all(const band_rays *rays);

#endif
