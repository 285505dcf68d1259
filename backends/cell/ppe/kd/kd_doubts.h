/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decides the pairs of ray and triangle that the kd program leaves undecided, exactly: of pixels as doubts.h does; of
 * secondary rays, which are read from main memory, whether the triangle is hit at all. */
#ifndef CGT_KD_DOUBTS_H
#define CGT_KD_DOUBTS_H

#include "cell/ppe/camera_tables.h"
#include "cell/ppe/kd/kd_scene.h"
#include "exact/decide.h"

typedef struct cgt_kd_doubts {
    const cgt_camera_rays *rays;
    const cgt_kd_scene *scene;
    uint32_t *nearest;               /* of each pixel, row by row; CGT_INVALID_ID: none */
    uint64_t doubts, exact, changed; /* all; decided in whole numbers; pixels that got another id */
    uint64_t bad;                    /* doubts and ids of no pixel or no triangle: the program is broken */
} cgt_kd_doubts;

/* nearest: room for all pixels of the camera's picture. */
void cgt_kd_doubts_init(cgt_kd_doubts *doubts, const cgt_camera_rays *rays, const cgt_kd_scene *scene,
                        uint32_t *nearest);

/* A doubt of a pixel. */
void cgt_kd_doubts_add(cgt_kd_doubts *doubts, const cgt_doubt *doubt);

/* Whether a ray hits the triangle in its range. */
bool cgt_kd_doubts_hit(cgt_kd_doubts *doubts, const cgt_ray *ray, uint32_t object);

/* A doubt of any other ray, of which the nearest is kept: *nearest, CGT_INVALID_ID: none so far. */
void cgt_kd_doubts_keep(cgt_kd_doubts *doubts, const cgt_ray *ray, uint32_t object, uint32_t *nearest);

/* The nearer one of a ray's best hit and of its nearest doubt, each CGT_INVALID_ID for none. */
uint32_t cgt_kd_doubts_merge(cgt_kd_doubts *doubts, const cgt_ray *ray, uint32_t best, uint32_t nearest);

/* Puts the nearest doubt of a pixel into *id where it beats that. Returns whether it does. */
bool cgt_kd_doubts_finish(cgt_kd_doubts *doubts, uint32_t x, uint32_t y, uint32_t *id);

/* The ray of a pixel. */
cgt_ray cgt_kd_doubts_ray(const cgt_kd_doubts *doubts, uint32_t x, uint32_t y);

/* A triangle of the scene as something that a ray may hit. */
cgt_decided_hit cgt_kd_doubts_object(const cgt_kd_doubts *doubts, uint32_t object);

#endif
