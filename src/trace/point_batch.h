/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against a light, packed: those that are live lie side by side in dense arrays, so that the others cost nothing.
 * Others are off (an empty range), or invalid (a NaN, an infinity, or the light's own place). */
#ifndef CGT_POINT_BATCH_H
#define CGT_POINT_BATCH_H

#include <math.h>

#include "dispatch/frame_points.h"
#include "dispatch/kernel.h"

/* Whether the arrays are dense and all points live, as the order of a call has it (order/call_order.c). */
bool cgt_points_are_live(const cgt_rays *points, const cgt_light *light);

/* Packs `count` points, at most CGT_RAYS_CHUNK, by their numbers. */
void cgt_point_batch_fill(cgt_point_batch *b, const cgt_rays *points, const uint32_t *number, uint32_t count);

#endif
