/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres as the grid program's image in main memory. */
#ifndef CGT_GRID_SCENE_H
#define CGT_GRID_SCENE_H

#include "cell/ppe/camera_tables.h"
#include "model/primitive.h"

typedef struct cgt_grid_scene {
    cgt_grid_image image;
    float (*object)[4]; /* image.spheres of them, padded to 8; NULL: none */
    size_t bytes;       /* of `object` */
    cgt_memory_hooks memory;
} cgt_grid_scene;

/* Makes the image.
 *   memory       both functions set; used until the release
 *   sphere       `count` of them: the id of a hit is the number here. Those that are not finite or have a radius below
 *                0 take no part. NULL where count is 0
 *   resolution   cells along each axis; NULL: 16, 16, 16
 *   message      gets a sentence where the result is not CGT_OK
 * TOO_LARGE where the program's local store has no room: the sentence says for what; INVALID_ARGUMENT for coordinates
 * beyond CGT_SPE_MAX_COORDINATE and a resolution with a 0; OUT_OF_MEMORY. The scene needs no release then. Thread-safe
 * for different scenes. */
cgt_result cgt_grid_scene_init(cgt_grid_scene *scene, const cgt_memory_hooks *memory, const cgt_sphere *sphere,
                               uint32_t count, const uint32_t resolution[3], char message[CGT_PPE_MESSAGE_BYTES]);

void cgt_grid_scene_release(cgt_grid_scene *scene);

#endif
