/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against a light, packed: those that are live lie side by side in dense arrays, so that the others, which
 * are off or invalid (query/ray_intake.h), cost nothing. */
#ifndef CGT_POINT_BATCH_H
#define CGT_POINT_BATCH_H

#include "dispatch/frame_points.h"
#include "dispatch/kernel.h"

/* Packs `count` points, at most CGT_RAYS_CHUNK, by their numbers. */
void cgt_point_batch_fill(cgt_point_batch *b, const cgt_rays *points, const uint32_t *number, uint32_t count);

#endif
