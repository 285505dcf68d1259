/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A frame of the kd program at work: its arrays in main memory, checks, the secondary rays of pixels that doubts
 * changed, and its output. */
#ifndef CGT_KD_FRAME_MEMORY_H
#define CGT_KD_FRAME_MEMORY_H

#include "cell/ppe/frame_run.h"
#include "cell/ppe/kd/kd_frame.h"

/* The arrays of a frame. */
enum {
    KD_ARRAY_INFOS,
    KD_ARRAY_RAYS,
    KD_ARRAY_RAY_INFOS,
    KD_ARRAY_HITS,
    KD_ARRAY_SECONDARY,
    KD_ARRAY_OCCLUSION,
    KD_ARRAY_DECIDED,   /* secondary rays that a doubt occludes, as bits */
    KD_ARRAY_REFLECTED, /* the nearest doubt of each ray of each tile; CGT_INVALID_ID: none */
    KD_ARRAYS
};

typedef struct kd_frame {
    cgt_cell_frame run;
    const cgt_kd_scene *scene;
    const cgt_kd_frame_options *options;
    const cgt_kd_frame_output *output;
    union {
        cgt_kd_frame_image image;
        char image_bytes[CGT_KD_FRAME_BYTES];
        float direction[CGT_KD_FRAME_BYTES / 16][4]; /* from 16 on */
    };
    cgt_kd_part parts[CGT_KD_PARTS];
    cgt_kd_control control[CGT_MAX_SPES];
    void *array[KD_ARRAYS];
    size_t bytes[KD_ARRAYS];
    uint32_t tiles, batches; /* of an envelope; of secondary rays */
} kd_frame;

/* What is wrong with the options; with the image that was made of them, the scene and the camera. NULL: nothing. */
const char *cgt_kd_frame_check_options(const cgt_kd_frame_options *options);
const char *cgt_kd_frame_check(const kd_frame *f);

/* Allocates the arrays. TOO_LARGE, OUT_OF_MEMORY with a message. */
cgt_result cgt_kd_frame_allocate(kd_frame *f, char message[CGT_CELL_MESSAGE_BYTES]);

/* Makes the arrays, the image and the scene known to the cell. */
cgt_result cgt_kd_frame_map(cgt_cell_frame *run);

void cgt_kd_frame_release(kd_frame *f);

static inline bool cgt_kd_frame_is_mirror(const kd_frame *f, uint32_t batch)
{
    return batch == f->image.lights + f->image.ambient;
}

/* Ray `lane` of a tile of a batch. */
cgt_ray cgt_kd_frame_secondary_ray(const kd_frame *f, const cgt_kd_secondary_tile *tile, uint32_t batch, uint32_t lane);

/* The first tile of a batch of an envelope. */
cgt_kd_secondary_tile *cgt_kd_frame_secondary(const kd_frame *f, uint32_t envelope, uint32_t batch);
uint32_t *cgt_kd_frame_occlusion(const kd_frame *f, uint32_t envelope, uint32_t batch);

/* Makes the secondary rays of ray `lane` of a tile again, whose hit now is triangle `id`, and traces them. */
cgt_result cgt_kd_frame_secondary_again(kd_frame *f, uint32_t envelope, uint32_t tile, uint32_t lane, uint32_t id);

/* Decides what the SPEs left open, pixel by pixel, and writes the output. Fails where tracing rays again does. */
cgt_result cgt_kd_frame_write(kd_frame *f);

#endif
