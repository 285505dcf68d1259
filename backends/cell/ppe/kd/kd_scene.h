/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles in kd-trees, or in bounding interval hierarchies, as the kd program's image in main memory. The trees are
 * the library's, built by its commit on the PPE, as in the thesis; nodes, references and boxes of kd-trees are copied
 * as they are (thesis, section 8.1), hierarchies are put into the layout that the scene's options ask of kd-trees. */
#ifndef CGT_KD_SCENE_H
#define CGT_KD_SCENE_H

#include <cgt/research.h>

#include "cell/image/kd_image.h"
#include "cell/ppe/camera_tables.h"
#include "exact/decide.h"
#include "papers/model/bih.h"
#include "papers/model/paper_structures.h"

/* Planes and coordinates along ropes are 0 or at least this: then no difference of two of them underflows. */
#define CGT_KD_MIN_COORDINATE 0x1p-100f

/* With secondary rays coordinates are at most this, so that directions keep within 2^20. */
#define CGT_KD_SECONDARY_COORDINATE 0x1p19f

typedef struct cgt_kd_scene_part {
    const cgt_scene *scene;
    cgt_kd_part image;
    uint32_t first; /* of the numbers of its primitives */
    void *node;     /* cgt_kd_node or cgt_bih_node */
    uint32_t *reference;
    cgt_kd_leaf *leaf;
    size_t node_bytes, reference_bytes, leaf_bytes;
} cgt_kd_scene_part;

typedef struct cgt_kd_scene {
    cgt_kd_scene_part part[CGT_KD_PARTS]; /* those with triangles */
    uint32_t parts, triangles;            /* triangles of all scenes, those that were skipped included */
    float scale, magnitude;               /* magnitude: of the largest coordinate */
    bool ropes, bih;
    cgt_leaf_triangle *triangle;
    size_t triangle_bytes;
    cgt_memory_hooks memory;
} cgt_kd_scene;

/* Makes the image of one committed scene, or of several, each of which becomes a part.
 *   memory    both functions set; used until the release
 *   scene     `count` of them, 1 to CGT_KD_PARTS, of triangles alone, committed with CGT_STRUCTURE_KD, or all with
 *             CGT_STRUCTURE_KD_ROPES, or all with CGT_STRUCTURE_BIH, for the program spe_bih. They stay as they are
 *             until the release. The id of a triangle is its number through all scenes, and in each through all
 *             geometries
 *   message   gets a sentence where the result is not CGT_OK
 * INVALID_ARGUMENT for other scenes, and for coordinates that the bounds of an SPU's single precision do not cover;
 * TOO_LARGE where an array exceeds the 4 GB of addresses that it has; OUT_OF_MEMORY. There is nothing to release then.
 * Thread-safe for different images. */
cgt_result cgt_kd_scene_init(cgt_kd_scene *image, const cgt_memory_hooks *memory, const cgt_scene *const *scene,
                             uint32_t count, char message[CGT_PPE_MESSAGE_BYTES]);

void cgt_kd_scene_release(cgt_kd_scene *image);

/* Fills nodes, references and counts of a part with a bounding interval hierarchy, without gaps and in a layout
 * (cgt_research_scene_options): levels are those of inner nodes. OUT_OF_MEMORY leaves what was allocated in the
 * part. */
cgt_result cgt_kd_scene_add_bih(const cgt_memory_hooks *memory, const cgt_bih *tree, cgt_kd_layout layout,
                                uint32_t break_level, cgt_kd_scene_part *part);

/* A triangle of an image, for cgt_doubts. */
bool cgt_kd_scene_get(const void *image, uint32_t object, cgt_decided_hit *hit);

#endif
