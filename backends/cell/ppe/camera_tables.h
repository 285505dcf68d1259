/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera's image, and the tables of columns and rows that make its canonical rays. */
#ifndef CGT_CAMERA_TABLES_H
#define CGT_CAMERA_TABLES_H

#include <float.h>
#include <math.h>

#include "cell/image/control_block.h"
#include "core/memory.h"
#include "query/camera.h"

#define CGT_PPE_MESSAGE_BYTES 256

/* Coordinates that an SPU's arithmetic is sure of, of primitives and eyes (docs/reports/cell_sizes.md). */
#define CGT_SPE_MAX_COORDINATE 0x1p40f

/* An SPU takes subnormal numbers for 0; images have none, so that all forms of a program see the same. */
static inline float cgt_spe_normal(float x) { return fabsf(x) < FLT_MIN ? 0 : x; }

typedef struct cgt_camera_tables {
    cgt_camera_rays rays;
    cgt_camera_image image;
    float (*column)[4], (*row)[4]; /* as many as the picture has, and up to a multiple of 4 the last one again */
    size_t column_bytes, row_bytes;
    cgt_memory_hooks memory;
} cgt_camera_tables;

/* INVALID_ARGUMENT for what is no camera, for one that is not perspective, for an eye beyond CGT_SPE_MAX_COORDINATE and
 * a view wider than a SPU's bounds allow; TOO_LARGE above CGT_FRAME_MAX_EDGE pixels; OUT_OF_MEMORY. The message is a
 * sentence then, and there is nothing to release. */
cgt_result cgt_camera_tables_init(cgt_camera_tables *tables, const cgt_memory_hooks *memory, const cgt_camera *camera,
                                  uint32_t width, uint32_t height, char message[CGT_PPE_MESSAGE_BYTES]);

void cgt_camera_tables_release(cgt_camera_tables *tables);

#endif
