/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Batches of points against a light, and the hits of a frame's tile as one, in blocks of 4x4 pixels along a Morton
 * curve: whatever traces some of them together gets neighbours in both directions, as rows would not give it. */
#ifndef CGT_FRAME_POINTS_H
#define CGT_FRAME_POINTS_H

#include "query/camera.h"
#include "query/trace_settings.h"

/* Of an array: the arrays' elements would lie in one set of the cache where they were a multiple of a page apart. */
#define CGT_BATCH_STRIDE (CGT_RAYS_CHUNK + 16u)

typedef struct cgt_point_batch {
    float position[3][CGT_BATCH_STRIDE], t_min[CGT_BATCH_STRIDE], t_max[CGT_BATCH_STRIDE];
    uint32_t mask[CGT_BATCH_STRIDE], primitive[CGT_BATCH_STRIDE], geometry[CGT_BATCH_STRIDE];
    uint8_t occluded[CGT_RAYS_CHUNK];
    cgt_rays rays; /* the arrays above, as far as they are in use */
} cgt_point_batch;

#define CGT_SHADOW_TILE 64u  /* pixels along a tile's edge */
#define CGT_SHADOW_SQUARE 32 /* of a square, whose points are computed together */
#define CGT_SHADOW_BLOCK 4u

_Static_assert(CGT_SHADOW_TILE *CGT_SHADOW_TILE <= CGT_RAYS_CHUNK, "a tile is a batch");

/* Where a call's points come from. */
typedef struct cgt_frame_source {
    const cgt_frame *frame;
    const cgt_camera_rays *camera;
    const cgt_light *light;
    size_t row_stride; /* of the frame's planes, elements */
    float t_min;
    bool has_masks; /* the camera's mask leaves something out */
} cgt_frame_source;

/* A block with live points. */
typedef struct cgt_frame_block {
    uint16_t corner; /* y * CGT_SHADOW_TILE + x, in the tile */
    uint16_t live;   /* pixels, as bits: a row is four */
} cgt_frame_block;

/* The points of a square, row by row. */
typedef struct cgt_frame_square {
    float position[3][CGT_SHADOW_SQUARE + 1][CGT_SHADOW_SQUARE];
    uint32_t id[2][CGT_SHADOW_SQUARE + 1][CGT_SHADOW_SQUARE]; /* primitives and geometries, where points skip them */
    uint8_t live[CGT_SHADOW_SQUARE][CGT_SHADOW_SQUARE];       /* 0 or 1; 0 beyond the picture */
    uint32_t points;                                          /* that are live */
} cgt_frame_square;

/* A tile's live points. */
typedef struct cgt_frame_points {
    cgt_point_batch batch;
    uint32_t live, invalid, blocks;
    cgt_frame_block block[CGT_SHADOW_TILE * CGT_SHADOW_TILE / (CGT_SHADOW_BLOCK * CGT_SHADOW_BLOCK)];
    cgt_frame_square square;
} cgt_frame_points;

#endif
