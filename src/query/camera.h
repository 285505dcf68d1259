/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera, checked and turned into what makes its rays. */
#ifndef CGT_CAMERA_H
#define CGT_CAMERA_H

#include <cgt/cgt.h>

/* With px = (x + 0.5f) * pixel[0] - 1 and py = 1 - (y + 0.5f) * pixel[1], all in float and unfused, the ray of pixel
 * (x, y) is the canonical one:
 *   perspective   org = eye, dir = (fwd + px * right) + py * up
 *   orthographic  org = (eye + px * right) + py * up, dir = fwd */
typedef struct cgt_camera_rays {
    float eye[3];
    float fwd[3];   /* unit */
    float right[3]; /* half the picture's width long */
    float up[3];    /* half the picture's height long */
    float pixel[2]; /* 2 / width, 2 / height */
    float t_min, t_max;
    uint32_t mask; /* all bits set where it hides nothing */
    uint32_t width, height;
    bool orthographic;
} cgt_camera_rays;

/* The ray of a pixel. */
static inline void cgt_camera_pixel(const cgt_camera_rays *c, uint32_t x, uint32_t y, float org[3], float dir[3])
{
    const float px = ((float)x + 0.5f) * c->pixel[0] - 1, py = 1 - ((float)y + 0.5f) * c->pixel[1];
    for (int a = 0; a < 3; a++) {
        const float sum = ((c->orthographic ? c->eye[a] : c->fwd[a]) + px * c->right[a]) + py * c->up[a];
        org[a] = c->orthographic ? sum : c->eye[a];
        dir[a] = c->orthographic ? c->fwd[a] : sum;
    }
}

#define CGT_CAMERA_MESSAGE_BYTES 160

/* Makes the rays of a camera. INVALID_ARGUMENT with a message where its values are bad. */
cgt_result cgt_camera_prepare(const cgt_camera *camera, uint32_t width, uint32_t height, cgt_camera_rays *rays,
                              char message[CGT_CAMERA_MESSAGE_BYTES]);

#endif
