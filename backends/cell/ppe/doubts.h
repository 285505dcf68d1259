/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decides exactly the pairs of ray and object that SPEs leave undecided. Each pixel keeps the nearest of its doubts so
 * far; when the frame is complete that one meets the SPE's hit. So doubts may come in any order, before or after their
 * pixel, and take no memory. Rays that a program sends from hits are decided one by one. */
#ifndef CGT_DOUBTS_H
#define CGT_DOUBTS_H

#include "cell/image/control_block.h"
#include "exact/decide.h"
#include "query/camera.h"

/* Object `object` of a scene, as something that a ray may hit. False: there is none of that number. */
typedef bool cgt_doubts_object(const void *scene, uint32_t object, cgt_decided_hit *hit);

typedef struct cgt_doubts {
    const cgt_camera_rays *rays;
    cgt_doubts_object *get;
    const void *scene;               /* of `get` */
    uint32_t *nearest;               /* of each pixel, row by row; CGT_INVALID_ID: none */
    uint64_t doubts, exact, changed; /* of pixels; decided in whole numbers; pixels that got another id */
    uint64_t bad;                    /* doubts and ids of no pixel or no object: the program is broken */
} cgt_doubts;

/* A doubt of a pixel. */
void cgt_doubts_add(cgt_doubts *doubts, const cgt_doubt *doubt);

/* Whether a ray hits the object in its range. */
bool cgt_doubts_hit(cgt_doubts *doubts, const cgt_ray *ray, uint32_t object);

/* A doubt of any ray, of which the nearest is kept: *nearest, CGT_INVALID_ID: none so far. */
void cgt_doubts_keep(cgt_doubts *doubts, const cgt_ray *ray, uint32_t object, uint32_t *nearest);

/* The nearer one of a ray's best hit and of its nearest doubt, each CGT_INVALID_ID for none. */
uint32_t cgt_doubts_merge(cgt_doubts *doubts, const cgt_ray *ray, uint32_t best, uint32_t nearest);

/* Puts the nearest doubt of a pixel into *id where it beats that. Returns whether it does. */
bool cgt_doubts_finish(cgt_doubts *doubts, uint32_t x, uint32_t y, uint32_t *id);

/* The ray of a pixel. */
cgt_ray cgt_doubts_ray(const cgt_doubts *doubts, uint32_t x, uint32_t y);

#endif
