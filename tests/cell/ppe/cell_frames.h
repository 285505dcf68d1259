/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What tests of a Cell's frames share: spheres, cameras, frames of the grid program and scenes of the library, and the
 * comparison of a native run with a simulated one. */
#ifndef CELL_FRAMES_H
#define CELL_FRAMES_H

#include <cgt/research.h>

#include "cell/ppe/grid/grid_frame.h"
#include "support/test.h"

/* The SPU's own compiler's programs; NULL: not built, nothing is simulated. */
#ifndef SPE_GRID_ELF
#define SPE_GRID_ELF NULL
#endif
#ifndef SPE_KD_ELF
#define SPE_KD_ELF NULL
#define SPE_BIH_ELF NULL
#endif

extern cgt_sphere cell_sphere[CGT_GRID_SPHERES + 1]; /* those of the next frame */
extern cgt_cell_frame_result cell_result;            /* of the last frame */

void cell_random_spheres(test_random *r, uint32_t count, float largest);
cgt_camera cell_random_camera(test_random *r, float far);

/* `count` times x, y, z, radius, committed. */
cgt_scene *cell_library_scene(cgt_context *context, const float *sphere, uint32_t count);

/* The image of the first spheres, and a frame of it. */
cgt_result cell_grid_trace(uint32_t spheres, const cgt_camera *camera, uint32_t width, uint32_t height,
                           const cgt_grid_frame_options *options, uint32_t *ids, cgt_cell_frame_result *result);

/* A result with a sentence that has these words. */
void cell_expect(cgt_result got, const char *message, cgt_result code, const char *words);

/* The same run, simulated by a program. False: path is NULL, or the order of SPEs may change what they do. */
bool cell_simulate(cgt_cell_frame_options *options, const char *path);

/* What SPEs of the kd program, or of the grid program, report and count is the same, but for times. Clears those. */
void cell_compare_spes(cgt_cell_frame_result *a, cgt_cell_frame_result *b, unsigned spes, bool kd);

#endif
