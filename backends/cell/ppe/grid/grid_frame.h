/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One frame of spheres by the grid program: the PPE hands out strips, decides doubts, and reads the picture. */
#ifndef CGT_GRID_FRAME_H
#define CGT_GRID_FRAME_H

#include "cell/ppe/frame.h"
#include "cell/ppe/grid/grid_light.h"

/* 0 is the right default of all but what cgt_cell_frame_options wants. */
typedef struct cgt_grid_frame_options {
    cgt_cell_frame_options cell;
    bool nested;   /* three loops over cells; else one, which is faster */
    cgt_cull cull; /* all but NONE are FRUSTUM: 16 rays are one block */
    bool retest; /* SPEs test a sphere again where a packet meets it in several cells; else they remember the last eight
                      that they tested (mailboxing) */
    const cgt_grid_light *light; /* rays from the hits; NULL: none */
    uint32_t *occluded; /* not NULL where there is a light. occluded[y * width + x], bit k: whether set k of the pixel's
                           rays meets anything but the sphere that it starts from; 0 without a hit */
} cgt_grid_frame_options;

/* Traces a frame: ids[y * width + x] becomes the number of the sphere that the pixel's canonical ray hits first,
 * CGT_INVALID_ID where there is none. They are those of CGT_PRECISION_EXACT, for any options but keep_doubts; so are
 * the rays from hits, which start where an SPE's single precision finds the hit (cgt_grid_lighting_ray).
 * INVALID_ARGUMENT, TOO_LARGE for what does not fit, OUT_OF_MEMORY, THREADS, STOPPED where the program broke a rule;
 * result->message says it. ids are undefined then. */
cgt_result cgt_grid_frame_trace(const cgt_grid_scene *scene, const cgt_camera *camera, uint32_t width, uint32_t height,
                                const cgt_grid_frame_options *options, uint32_t *ids, cgt_cell_frame_result *result);

#endif
