/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One frame of triangles by the kd program: the PPE makes info packets, hands out envelopes, holds the barriers,
 * decides doubts, and reads the picture. */
#ifndef CGT_KD_FRAME_H
#define CGT_KD_FRAME_H

#include "cell/ppe/frame.h"
#include "cell/ppe/kd/kd_scene.h"

/* Sizes of caches where 0 is given: nodes 64 x 512 bytes, references 16 x 1 KB, leaves 16 x 640 bytes (with ropes
 * alone), 1,024 triangles and as many entries of their index. Nodes of a bounding interval hierarchy are twice as
 * large. */
#define CGT_KD_NODE_BLOCKS ((cgt_kd_cache_size){64, 6})
#define CGT_KD_BIH_BLOCKS ((cgt_kd_cache_size){64, 5})
#define CGT_KD_REFERENCE_BLOCKS ((cgt_kd_cache_size){16, 8})
#define CGT_KD_LEAF_BLOCKS ((cgt_kd_cache_size){16, 3})
#define CGT_KD_TRIANGLE_SLOTS ((cgt_kd_cache_size){1024, 10})
#define CGT_KD_TILES_EDGE 4u

/* 0 is the right default of all but what cgt_cell_frame_options wants. */
typedef struct cgt_kd_frame_options {
    cgt_cell_frame_options cell;
    uint32_t tiles_x, tiles_y; /* of 2x2 pixels in an envelope, product at most CGT_KD_TILES; 0: 4 */
    cgt_kd_cache_size nodes, references, leaves, triangles; /* of caches; blocks 0: see above */
    uint32_t batch;  /* triangles that a leaf's test takes together, at most 32; 0: 16 */
    bool prefetch;   /* with a stack: fetch a leaf's triangles where its sibling is visited first */
    uint32_t lights; /* shadow rays of each pixel: towards points, at most CGT_KD_LIGHTS */
    float light[CGT_KD_LIGHTS][3];
    float light_t_min; /* a shadow ray's range is from here to 1, in units of the way to the light; above 0 */
    uint32_t ambient;  /* ambient rays of each pixel, at most CGT_KD_DIRECTIONS */
    float ambient_t_min, ambient_t_max; /* their range, in world units; above 0 */
    bool mirror; /* one reflected ray of each pixel, to its nearest triangle; the image has one part */
    float mirror_t_min, mirror_t_max; /* its range, in lengths of the pixel's direction; above 0 */
} cgt_kd_frame_options;

/* What a frame gives; NULL: not wanted. A batch of secondary rays is one of each pixel: lights, then ambient ones, then
 * the reflected one. Element [(batch * height + y) * width + x]. */
typedef struct cgt_kd_frame_output {
    uint32_t *ids; /* of the triangle that the pixel's canonical ray hits first, or CGT_INVALID_ID */
    float (
        *direction)[3];  /* of the pixel's ray, as an SPE made it: that of the library, but for subnormal components */
    float (*ray)[6];     /* secondary: origin, direction */
    uint8_t *occluded;   /* secondary: 0 or 1; CGT_KD_NO_RAY: the pixel hits nothing, or there is no direction */
    uint32_t *reflected; /* with a mirror: the nearest triangle of the pixel's reflected ray, or CGT_INVALID_ID */
} cgt_kd_frame_output;

#define CGT_KD_NO_RAY 2

/* Traces a frame. Ids are those of CGT_PRECISION_EXACT, and occluded those of cgt_occluded_rays for the rays that are
 * given, reflected those of cgt_trace_rays in EXACT precision, for any options but keep_doubts. A ray starts where the
 * pixel's hit is within the rounding of an SPU. INVALID_ARGUMENT, TOO_LARGE for what does not fit, OUT_OF_MEMORY,
 * THREADS, STOPPED where the program broke a rule or is for the other kind of trees; result->message says it. The
 * output is undefined then. */
cgt_result cgt_kd_frame_trace(const cgt_kd_scene *scene, const cgt_camera *camera, uint32_t width, uint32_t height,
                              const cgt_kd_frame_options *options, const cgt_kd_frame_output *output,
                              cgt_cell_frame_result *result);

#endif
