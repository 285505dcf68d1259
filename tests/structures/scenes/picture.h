/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera's frame with all fields, pixel by pixel as an array of hits. A failure here fails the test. */
#ifndef PICTURE_H
#define PICTURE_H

#include "hard_cases/hard_scene.h"
#include "support/ray_arrays.h"
#include "support/scenes.h"

typedef struct picture {
    planes p;
    float *uv;     /* u, then v */
    full_hit *hit; /* row by row */
} picture;

picture picture_make(uint32_t width, uint32_t height);
void picture_free(picture *q);

/* Traces all fields into q->hit; a pixel that is not written keeps a pattern. */
void picture_trace(const cgt_scene *scene, const cgt_camera *camera, const cgt_trace_options *options, picture *q);

/* Makes the camera's pixels the scene's rays, in the order of q->hit. */
void picture_aim(hard_scene *s, const cgt_camera *camera, uint32_t width, uint32_t height);

#endif
