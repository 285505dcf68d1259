/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decides the pairs of pixel and object that SPEs leave undecided, exactly. Each pixel keeps the nearest of its doubts
 * so far; when the frame is complete that one meets the SPE's hit. So doubts may come in any order, before or after
 * their pixel, and take no memory. */
#ifndef CGT_DOUBTS_H
#define CGT_DOUBTS_H

#include "cell/ppe/light/light.h"

typedef struct cgt_doubts {
    const cgt_camera_rays *rays;
    const cgt_grid_scene *scene;
    cgt_frame_light *light; /* takes the doubts of rays from hits, and pixels that change; NULL: there are none */
    uint32_t *nearest;      /* of each pixel, row by row; CGT_INVALID_ID: none */
    uint64_t doubts, exact, changed; /* all; decided in whole numbers; pixels that got another id */
    uint64_t bad;                    /* doubts and ids of no pixel or no object: the program is broken */
} cgt_doubts;

/* nearest: room for all pixels of the camera's picture. */
void cgt_doubts_init(cgt_doubts *doubts, const cgt_camera_rays *rays, const cgt_grid_scene *scene, uint32_t *nearest);

void cgt_doubts_add(cgt_doubts *doubts, const cgt_doubt *doubt, uint32_t count);

/* Puts the nearest doubts into the frame where they beat its hits. ids: rows of `stride` words. */
void cgt_doubts_finish(cgt_doubts *doubts, uint32_t *ids, size_t stride);

#endif
