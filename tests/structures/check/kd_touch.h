/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whether a primitive touches a closed box, decided exactly: a leaf of a kd-tree must list it. */
#ifndef KD_TOUCH_H
#define KD_TOUCH_H

#include "model/primitive.h"

typedef struct kd_box {
    float low[3], high[3];
} kd_box;

/* A sphere is its surface: a box within the ball does not touch it. The primitive is finite, a triangle has an area,
 * and coordinates are within CGT_MAX_COORDINATE. */
bool kd_touches(const cgt_primitive *primitive, const kd_box *box);

#endif
