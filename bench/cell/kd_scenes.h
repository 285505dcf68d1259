/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The scene of cgt-bench cell --kd, and frames of it. */
#ifndef KD_SCENES_H
#define KD_SCENES_H

#include <cgt/research.h>

#include "cell/ppe/kd/kd_frame.h"

#define KD_EDGE 71u /* quads across; twice as many along */
#define KD_TRIANGLES (4 * KD_EDGE * KD_EDGE)

/* A sheet of hills that fills the picture: every camera ray hits. parts: of equal numbers of triangles. */
typedef struct kd_bench_scene {
    cgt_context *context;
    cgt_scene *scene[CGT_KD_PARTS];
    uint32_t parts;
    cgt_kd_scene image;
} kd_bench_scene;

/* False after a message; then there is nothing to release. */
bool kd_bench_scene_make(kd_bench_scene *scene, cgt_structure structure, cgt_kd_layout layout, uint32_t parts);
void kd_bench_scene_release(kd_bench_scene *scene);

/* Median milliseconds of the process, on one thread, of a commit of the hills, and of its image for the SPEs. False
 * after a message. */
bool kd_bench_build(cgt_structure structure, double *commit, double *image);

/* Looks at the hills from above, at a slant. */
cgt_camera kd_bench_camera(void);

/* Camera rays alone, and with them shadow, ambient and reflected rays. */
typedef enum kd_bench_rays {
    KD_BENCH_CAMERA,
    KD_BENCH_SHADOW,
    KD_BENCH_AMBIENT,
    KD_BENCH_BOUNCED,
    KD_BENCH_RAYS
} kd_bench_rays;
extern const char *const kd_bench_rays_names[KD_BENCH_RAYS];

/* Adds secondary rays of a kind to the options: a light above a corner; four ambient rays of each pixel; one that
 * its triangle reflects. */
void kd_bench_add_rays(cgt_kd_frame_options *options, kd_bench_rays rays);

#endif
