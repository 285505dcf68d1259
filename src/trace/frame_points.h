/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the points of a frame's tile have met, as pixels. */
#ifndef CGT_STORE_FRAME_POINTS_H
#define CGT_STORE_FRAME_POINTS_H

#include "dispatch/frame_points.h"

/* Stores the batch's results to the plane of a light: 0 for pixels without a live point. */
void cgt_frame_points_store(const cgt_frame_source *source, uint32_t x0, uint32_t y0, const cgt_frame_points *points,
                            uint8_t *plane);

#endif
