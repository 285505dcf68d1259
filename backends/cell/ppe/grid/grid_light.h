/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays from the hits of a frame, the PPE's side: the image that tells SPEs of them, and the rays that SPEs leave open:
 * those of doubts, and all of a pixel whose sphere the PPE has changed. */
#ifndef CGT_PPE_GRID_LIGHT_H
#define CGT_PPE_GRID_LIGHT_H

#include "cell/ppe/doubts.h"
#include "cell/ppe/grid/grid_scene.h"

/* What hits look at. 0 is the default of all. */
typedef struct cgt_grid_light {
    bool shadow;       /* a ray from each hit to a light: its set is 0, the others follow */
    float position[3]; /* the light's, world units; each 0 or from 2^-70 to 2^40 in size */
    uint32_t
        ambient;   /* rays along directions that all pixels share, each towards the side of its hit's normal; with the
                          shadow ray at most CGT_LIGHT_SETS */
    float radius;  /* ambient rays meet nothing beyond, world units; 0: they have no end */
    uint32_t seed; /* another one turns the directions */
} cgt_grid_light;

typedef struct cgt_grid_lighting {
    cgt_light_image image;
    cgt_doubts *decide; /* decides rays, and counts what it takes; set before the first doubt */
    const cgt_camera_tables *tables;
    const cgt_grid_scene *scene;
    uint32_t *word; /* as SPEs write them: of four scanlines `word_row` bytes */
    size_t word_bytes, word_row;
    uint32_t *decided; /* of each pixel: sets that doubts found occluded, as bits; bit 31: the PPE traces all of them */
    size_t decided_bytes;
    uint64_t doubts, pixels; /* of rays from hits; traced by the PPE */
    cgt_memory_hooks memory;
} cgt_grid_lighting;

#define CGT_LIGHT_ALL 0x80000000u

/* light: NULL for none: nothing is allocated. INVALID_ARGUMENT for numbers that are not finite or out of range;
 * TOO_LARGE, OUT_OF_MEMORY: with a sentence, and there is nothing to release. tables and scene are used until the
 * release. */
cgt_result cgt_grid_lighting_init(cgt_grid_lighting *light, const cgt_memory_hooks *memory, const cgt_grid_light *from,
                                  const cgt_camera_tables *tables, const cgt_grid_scene *scene,
                                  char message[CGT_PPE_MESSAGE_BYTES]);
void cgt_grid_lighting_release(cgt_grid_lighting *light);

/* The ray of a set from where a pixel's ray hits sphere `id`, as SPEs make it. False: it has no direction, and meets
 * nothing. */
bool cgt_grid_lighting_ray(const cgt_grid_lighting *light, uint32_t x, uint32_t y, uint32_t id, uint32_t set,
                           cgt_ray *ray);

/* A doubt about a ray from a hit. */
void cgt_grid_lighting_doubt(cgt_grid_lighting *light, const cgt_doubt *doubt);

/* occluded[y * width + x]: bit k says whether set k of the pixel meets anything. ids: of the frame, in rows of `stride`
 * words, final. */
void cgt_grid_lighting_finish(cgt_grid_lighting *light, const uint32_t *ids, size_t stride, uint32_t *occluded);

/* ---- grid_light_hit.c: hits as SPEs compute them (cell/image/light_rays.h), one at a time ---- */

/* Where a ray hits a sphere, x, y, z, radius, that it is known to hit, and the normal there, of the radius' length. */
void cgt_grid_light_hit(const float eye[3], const float dir[3], float t_min, const float sphere[4], float point[3],
                        float normal[3]);
bool cgt_grid_light_looks_away(const float normal[3], const float dir[3]);

#endif
