/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Turns hits into pixels, tile by tile while the hits are in cache: a visitor for cgt_trace_camera. Spheres and
 * triangles are matt (Lambert) under a directional light, with a headlight at the eye that brightens the shadowed side.
 * Triangles are lit on the side that the eye sees, with vertex normals where there are any. Light adds linearly. */
#ifndef SHADE_H
#define SHADE_H

#include <stdatomic.h>
#include <stdint.h>

#include <cgt/cgt.h>

#include "common/stop_flag.h"
#include "picture/files/image_write.h"
#include "picture/color/srgb.h"
#include "picture/draw/surface.h"

enum { SHADE_MAX_SAMPLES = 4 };

/* The state of a frame. Threads share it; each writes the pixels of its own tiles. */
typedef struct shade_job {
    uint32_t width, height; /* pixels of the picture; the traced frame has `samples` times as many each way */
    uint32_t samples;       /* 1, 2 or 4: edge of the block of hits that a pixel is the mean of; divides any tile */
    uint8_t *rgb;           /* 3 * width * height: sRGB */
    image_pixel *pixels;    /* width * height: linear, with depth and primitive of the closest hit; NULL: none */
    surface surface;        /* of the one geometry */
    float background[3];    /* linear */
    float light[3];         /* unit vector towards the light */
    cgt_camera camera;      /* the frame's */
    float right[3], up[3], forward[3]; /* set by shade_begin: right and up scaled to half a picture */
    const srgb_tables *tables;
    const stop_flag *stop;     /* not 0: stop the frame; NULL: never */
    atomic_uint_fast64_t hits; /* of the frame, in samples; shade_begin sets 0 */
} shade_job;

/* Prepares for a frame; call it when camera, pointers and sizes are set. */
void shade_begin(shade_job *job);

/* The cgt_field values that shade_tile reads. */
uint32_t shade_fields(const shade_job *job);

/* The visitor: user is a shade_job. */
cgt_visit shade_tile(void *user, const cgt_tile *tile);

#endif
