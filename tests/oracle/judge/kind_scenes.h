/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small random scenes of many kinds, each hard in its own way. */
#ifndef KIND_SCENES_H
#define KIND_SCENES_H

#include <stdint.h>

#include "support/random.h"

#define KIND_MOST 48u /* of each sort: spheres, triangles, capsules */

typedef struct kind_scene {
    float sphere[KIND_MOST][4], vertex[3 * KIND_MOST][3], capsule[KIND_MOST][7];
    uint32_t spheres, triangles, capsules;
    test_random random;
    float shared[3]; /* a point that primitives may share */
} kind_scene;

uint32_t kind_count(void);
const char *kind_name(uint32_t kind);
void kind_scene_make(kind_scene *s, uint32_t kind, uint64_t stream);

#endif
