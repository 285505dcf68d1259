/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bounds of the part of a triangle that lies on one side of a plane, or in a box. Conservative: nothing of the exact
 * part is ever outside of them. */
#ifndef CGT_KD_CLIP_H
#define CGT_KD_CLIP_H

#include "papers/build/kd/split/kd_builder.h"

/* Bounds as vectors; the fourth elements are 0. */
typedef struct cgt_kd_bounds4 {
    cgt_float4 low, high;
} cgt_kd_bounds4;

/* Bounds the parts of the triangle below and above the plane in side[0] and side[1], except along the plane's axis,
 * which the caller knows; both sides have a point of the triangle. */
void cgt_kd_clip_sides(const cgt_triangle *q, uint32_t axis, float split, cgt_kd_bounds4 side[2]);

/* Narrows `bounds` to those of the triangle's part within the box. Returns false where there is certainly none. */
bool cgt_kd_clip_box(const cgt_triangle *q, const cgt_kd_box *box, cgt_kd_box *bounds);

#endif
